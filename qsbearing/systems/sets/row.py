"""A row of a set: its bearing, where it stands, which way it carries, and what its outer ring sits in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from numpy.typing import ArrayLike

from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import given_in, made_of, one_of
from qsbearing.model.effects import RingEffect
from qsbearing.model.validation import ANGLE, LENGTH, ErrorDetail, choose, within
from qsbearing.systems.sets.shaft import HousingStiffness

FARTHEST = 10.0
"""Metres along the shaft; it catches mistakes of unit."""

WIDEST_OFFSET = 0.01
"""Metres; it catches mistakes of unit."""
OUT_OF_LINE = (
    ("housing_radial_y", LENGTH, WIDEST_OFFSET),
    ("housing_radial_z", LENGTH, WIDEST_OFFSET),
    ("housing_tilt_y", ANGLE, 0.1),
    ("housing_tilt_z", ANGLE, 0.1),
)
"""What a row states of its housing, and the most of it, which catches mistakes of unit."""


class Direction(StrEnum):
    """Which axial load on the shaft a row carries: the one that presses the balls of an angular-contact row, the one
    against which the outer ring of a deep-groove row is held."""

    PLUS = "+x"
    MINUS = "-x"
    BOTH = "both"
    """A deep-groove row that is located: its outer ring is held on both sides."""
    NONE = "none"
    """A deep-groove row that floats: its outer ring slides along the housing."""


ONE_WAY = (Direction.PLUS, Direction.MINUS)


@dataclass(frozen=True)
class Row:
    """One row of balls: its bearing and its place in the set. SI units; numbers may be arrays that span cases."""

    bearing: BallBearing
    """Of this row."""
    position: ArrayLike = field(default=0.0, metadata=given_in("mm"))
    """Of the balls' centres along the shaft, where the rings just touch them at the free contact angle, at the
    reference temperature [m]; of a deep-groove row that no preload presses, of the plane of both grooves."""
    carries: Direction | None = field(default=None, metadata=one_of(Direction))
    """As a member or as its word. None: a deep-groove row both ways, any other in +x."""
    offset: ArrayLike = field(default=0.0, metadata=given_in("um"))
    """How much further than by the preload the row is pressed together while the shaft is at its zero [m]: what ring
    faces are ground off, or a spacer is longer. Below zero it is a gap. Of a row placed by the plane of both grooves,
    how far the inner groove stands beyond it in the direction that the row carries, in +x where that is both or none;
    below zero, of a row that carries one way, the gap between its outer ring and what holds it."""
    sprung: bool = field(default=False, metadata=one_of(bool))
    """Whether its outer ring slides in the housing and a spring presses it; see `Preload.spring`."""
    housing_stiffness: HousingStiffness | None = field(default=None, metadata=made_of(HousingStiffness))
    """Of what its outer ring sits in; None: rigid."""
    housing_radial_y: ArrayLike | None = field(default=None, metadata=given_in("um"))
    """How far its seat in the housing is out of line with the shaft along y, at the balls' centres [m]; None: not."""
    housing_radial_z: ArrayLike | None = field(default=None, metadata=given_in("um"))
    """The same along z [m]."""
    housing_tilt_y: ArrayLike | None = field(default=None, metadata=given_in("mrad"))
    """How far its seat is turned out of the shaft's direction about y, right-handed [rad]; None: straight."""
    housing_tilt_z: ArrayLike | None = field(default=None, metadata=given_in("mrad"))
    """The same about z [rad]."""
    ring_effects: tuple[RingEffect, ...] | None = None
    """Its own; None: those of the set."""
    readings: Mapping[str, Mapping[str, Any]] | None = field(default=None, compare=False)
    """Its own; None: those of the set."""
    is_from_contact: bool | None = None
    """Whether position and offset count from where the balls touch in the direction carried, not from the plane of both
    grooves. None: of an angular-contact row, and of a deep-groove row that a preload presses."""

    @property
    def sign(self) -> float:
        """Direction in which its loads and displacements count: -1 for a row that carries load in -x, else 1."""
        return -1.0 if self.carries == Direction.MINUS else 1.0

    @property
    def out_of_line(self) -> tuple[ArrayLike, ...]:
        """Of its housing, along y and z and about them."""
        given = (getattr(self, name) for name, *_ in OUT_OF_LINE)
        return tuple(0.0 if each is None else each for each in given)

    @property
    def is_out_of_line(self) -> bool:
        """Whether anything states how far its housing is."""
        return any(getattr(self, name) is not None for name, *_ in OUT_OF_LINE)


TWO_ROWS = (
    "Solve it alone. At rest, two opposed rows with one arc in each ring at one position are a four-point bearing with "
    "equal shim angles"
)


def row_errors(rows: tuple[Row, ...]) -> list[ErrorDetail]:
    """Errors of each row alone."""
    errors, placed = [], ("position", "offset", *(name for name, *_ in OUT_OF_LINE))
    for number, row in enumerate(rows, 1):
        path = f"row {number}"
        if not isinstance(row.bearing, BallBearing):
            errors.append(ErrorDetail(f"{path}.bearing", "is not a bearing", row.bearing))
        elif row.bearing.is_arched:
            errors.append(ErrorDetail(f"{path}.bearing", "is a four-point bearing, and no row", cause=TWO_ROWS))
        errors += [] if row.carries is None else choose(f"{path}.carries", row.carries, Direction)[1]
        errors += placement_errors(path, **{name: getattr(row, name) for name in placed})
    return errors


def placement_errors(
    path: str, position: ArrayLike, offset: ArrayLike, **out_of_line: ArrayLike | None
) -> list[ErrorDetail]:
    """Errors of where a row stands, whatever the bearing."""
    errors = within(f"{path}.position", position, LENGTH, -FARTHEST, FARTHEST)
    errors += within(f"{path}.offset", offset, LENGTH, -WIDEST_OFFSET, WIDEST_OFFSET)
    for name, quantity, most in OUT_OF_LINE:
        if out_of_line.get(name) is not None:
            errors += within(f"{path}.{name}", out_of_line[name], quantity, -most, most)
    return errors
