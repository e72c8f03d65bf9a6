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
    """Which axial load on the shaft a row carries; it presses the row's balls."""

    PLUS = "+x"
    MINUS = "-x"


@dataclass(frozen=True)
class Row:
    """One row of balls: its bearing and its place in the set. SI units; numbers may be arrays that span cases."""

    bearing: BallBearing
    position: ArrayLike = field(default=0.0, metadata=given_in("mm"))
    """Of the balls' centres along the shaft, where the rings just touch them at the free contact angle, at the
    reference temperature [m]."""
    carries: Direction = field(default=Direction.PLUS, metadata=one_of(Direction))
    """As a member or as its word."""
    offset: ArrayLike = field(default=0.0, metadata=given_in("um"))
    """How much further than by the preload the row is pressed together while the shaft is at its zero [m]: what ring
    faces are ground off, or a spacer is longer. Below zero it is a gap."""
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

    @property
    def sign(self) -> float:
        """1 for a row that carries load in +x, -1 for one that carries it in -x."""
        return 1.0 if self.carries == Direction.PLUS else -1.0

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
        errors += choose(f"{path}.carries", row.carries, Direction)[1]
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
