"""Seats out of round: raceways with two or three lobes, which stand nearer to each other at some balls than at others.

Source        a term of the Fourier series by which roundness is measured (ISO 12181-1); a form of one lobe number alone
              has the roundness deviation 2 amplitude by ISO 1101. What it does to the balls: derived here
Equation      r(psi) = amplitude cos n(psi - phase), n = 2 and 3, outwards, of the groove of each ring. The centres of
              its arcs move by as much, so that each ball has A2 = (19.4) + r_i(psi) - r_o(psi). The raceway also turns
              by r'/R, 1e-5 for a micrometre, and its radius in rolling direction changes by (n^2 - 1) r/R of itself,
              1e-4: both are left out
Assumes       the raceway has all of the form of its seat, or the amplitude is that of the mounted raceway, which is
              better; the same form all across the groove; the form before any load, to which elastic rings add their
              deflection. Radii of orbits and the datum of displacements are those of the round bearing. A form that
              turns with its ring is given as it stands at the instant at which the first ball is at its azimuth:
              results are of that instant
When not      four lobes and more, waviness: vibration, which no balance of one instant shows
Parameters    of each ring amplitude and phase of two lobes and of three; the phase is the azimuth of a crest, where the
              raceway's radius is largest
Indicator     the largest change of a ball's approach, beyond what the ring's moving makes up for, over its approach
Example       SeatsOutOfRound(outer_two_lobe_amplitude=1 * um, outer_two_lobe_phase=90 * deg)
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import given_in
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.effects.uneven_balls import uneven_entry
from qsbearing.model.operation import Operation
from qsbearing.model.validation import (
    ANGLE,
    LENGTH,
    ErrorDetail,
    Field,
    Sentence,
    first,
    raise_if_any,
    unit_mistake,
    within,
)

LOBES = {2: "two", 3: "three"}
"""How many, and the word for it in names. One lobe is a ring that stands aside: a displacement."""
SIDES = {"inner": 1.0, "outer": -1.0}
"""The rings, and whether a crest of the groove brings it nearer to the other ring's."""
OTHER_LOBES = (
    "Seats have two lobes or three. One lobe is a ring that stands aside, which is a displacement; four and more are "
    "waviness, which makes vibration, and nothing that the balance of one instant shows"
)
"""Why there are no others."""
LARGEST_AMPLITUDE = 0.01
"""Of the ball diameter: a tenth of a millimetre, which no seat is out of round by; it catches mistakes of unit."""


def radial_form(lobes: int, amplitude: Any, phase: Any, azimuth: Any) -> Any:
    """r(psi) = amplitude cos n(psi - phase), outwards, as long as the amplitude."""
    return amplitude * np.cos(lobes * (azimuth - phase))


@dataclass(frozen=True)
class SeatsOutOfRound:
    """Ask for raceways with two or three lobes. SI units and radians; any number may be an array.

    Raises:
        SceneError: every error, at once.
    """

    inner_two_lobe_amplitude: ArrayLike | None = field(default=None, metadata=given_in("um"))
    """Of the inner raceway: by how much a crest stands out, half the difference of its radii [m]; None: none."""
    inner_two_lobe_phase: ArrayLike | None = field(default=None, metadata=given_in("deg"))
    """Azimuth of a crest, from +y towards +z [rad]; None: 0."""
    inner_three_lobe_amplitude: ArrayLike | None = field(default=None, metadata=given_in("um"))
    """Of three lobes [m]."""
    inner_three_lobe_phase: ArrayLike | None = field(default=None, metadata=given_in("deg"))
    """Likewise [rad]."""
    outer_two_lobe_amplitude: ArrayLike | None = field(default=None, metadata=given_in("um"))
    """Of the outer raceway, likewise: a crest, where its radius is largest, stands farther from the balls [m]."""
    outer_two_lobe_phase: ArrayLike | None = field(default=None, metadata=given_in("deg"))
    """Azimuth of a crest of the outer ring [rad]."""
    outer_three_lobe_amplitude: ArrayLike | None = field(default=None, metadata=given_in("um"))
    """Of three lobes [m]."""
    outer_three_lobe_phase: ArrayLike | None = field(default=None, metadata=given_in("deg"))
    """Likewise [rad]."""
    name: ClassVar[str] = "seats_out_of_round"

    def __post_init__(self) -> None:
        errors = []
        for _, _, names in _FORMS:
            (amplitude, crest), (size, phase) = names, self._of(names)
            if size is not None:
                errors += within(f"{self.name}.{amplitude}", size, LENGTH, 0.0, 1e-3)
            if phase is not None:
                errors += within(f"{self.name}.{crest}", phase, ANGLE, -2.0 * pi, 2.0 * pi)
            if phase is not None and size is None:
                lacking = Field(f"{self.name}.{amplitude}")
                cause = Sentence("Give {amplitude}, or leave the phase out", amplitude=lacking)
                errors.append(ErrorDetail(f"{self.name}.{crest}", "is given without an amplitude", cause=cause))
        if all(each is None for each in vars(self).values()):
            needed = "Give the amplitude of two or of three lobes of a ring, or leave the effect out"
            errors.append(ErrorDetail(self.name, "has no amplitude", cause=needed))
        raise_if_any(errors)

    def _of(self, names: tuple[str, str]) -> tuple[Any, Any]:
        amplitude, phase = names
        return getattr(self, amplitude), getattr(self, phase)

    def errors(self, bearing: BallBearing) -> list[ErrorDetail]:
        """What does not suit this bearing: amplitudes too large for its balls."""
        most, errors = LARGEST_AMPLITUDE * np.asarray(bearing.ball_diameter, float), []
        for _, _, names in _FORMS:
            size = self._of(names)[0]
            if size is None:
                continue
            sizes, limit = np.broadcast_arrays(np.asarray(size, float), most)
            if (beyond := sizes > limit).any():
                worst, largest = first(beyond, sizes, limit)
                problem = f"is more than {LARGEST_AMPLITUDE:.0%} of the ball diameter"
                cause = unit_mistake(worst, LENGTH, 0.0, largest)
                where = f"{self.name}.{names[0]}"
                errors.append(ErrorDetail(where, problem, worst, LENGTH, (0.0, largest), cause, beyond))
        return errors

    def at_rest(self, fitted: bool) -> SeatsOutOfRound | None:
        """What of it a bearing has at rest and cold: all once it is fitted, since it is the seats' form."""
        return self if fitted else None

    def reshape(self, bearing: BallBearing, operation: Operation) -> BallBearing:
        """The bearing as it is: round in the mean."""
        return bearing

    @property
    def is_out_of_round(self) -> Any:
        """Where some amplitude is not 0 (*cases)."""
        return self.is_out_of_round_at("inner") | self.is_out_of_round_at("outer")

    def is_out_of_round_at(self, side: str) -> Any:
        """Where some amplitude of this ring is not 0 (*cases)."""
        is_any: Any = np.zeros((), bool)
        for _, ring, names in _FORMS:
            size = self._of(names)[0]
            if ring == side and size is not None:
                is_any = is_any | (np.asarray(size) != 0.0)
        return is_any

    def apart(self, azimuth: NDArray) -> NDArray:
        """r_i - r_o: by how much farther out the inner groove's centre stands than the outer one's, beyond round ones.

        Args:
            azimuth: (*cases, ball) [rad].

        Returns:
            (*cases, ball) [m].
        """
        total = np.zeros(azimuth.shape)
        for lobes, side, names in _FORMS:
            size, phase = self._of(names)
            if size is not None:
                at, crest = (np.asarray(each, float)[..., None] for each in (size, 0.0 if phase is None else phase))
                total = total + SIDES[side] * radial_form(lobes, at, crest, azimuth)
        return total


_FORMS = tuple(
    (lobes, side, (f"{side}_{word}_lobe_amplitude", f"{side}_{word}_lobe_phase"))
    for side in SIDES
    for lobes, word in LOBES.items()
)
"""Number of lobes, ring, names of amplitude and phase."""


def _nearer(point: OperatingPoint, asked: SeatsOutOfRound) -> tuple[NDArray, NDArray]:
    angle = np.nan_to_num(point.solution.inner.angle)
    lobe = np.nan_to_num(asked.apart(np.asarray(point.solution.azimuth)))
    return lobe * np.cos(angle), -lobe * np.sin(angle)


ENTRY = uneven_entry(
    "seats_out_of_round",
    "the out-of-roundness of the seats",
    SeatsOutOfRound,
    " with amplitude and phase of lobes",
    _nearer,
)
