"""Traction: the friction of sliding contacts from which the balls' axes and orbits follow, in place of raceway control.

Source        rigid-body mechanics of a ball with friction over both ellipses, derived here; contact surfaces as
              Heathcote 1921 has them, on their common curvature. Coulomb's law is rounded off at small slip
Equation      dF = -f(|v|) p v/|v| dA on the ball, v its surface's velocity less the ring's (`kernel/traction.py`);
              Coulomb: f = mu |v|/sqrt(v^2 + vc^2); linear: f = mu |v|/vc, what Coulomb's is at slips far below vc
Assumes       friction knows pressure and slip alone: no film, no temperature; f does not fall with slip, so that
              dissipation is convex and the motion of a ball under given loads unique
When not      thermal laws, whose friction falls again with slip: motions are then several, and unsteady. The heat of
              the linear law means nothing: it is the limit of small slip
Parameters    friction_coefficient: mu, at most 0.3; friction_range: between which mu lies, for a band of results;
              slip_speed: vc [m/s]; law; has_curvature: False takes contacts for flat, at D/2 from the ball's centre,
              the textbooks' simplification; cage_drag, drag_coefficient with fluid_density: what holds balls back on
              their way; radial_points, points_around: of each contact
Example       Traction(friction_coefficient=0.05, slip_speed=0.1)
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from math import sqrt
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.compiler.compiled import inlined
from qsbearing.model.described import given_in
from qsbearing.model.validation import DENSITY, FORCE, RATIO, VELOCITY, ErrorDetail, choose, raise_if_any, within

FRICTION_COEFFICIENT = 0.07
"""What is assumed where none is given."""
COEFFICIENTS = (1e-3, 0.3)
SLIP_SPEEDS = (1e-4, 10.0)
RADII, ANGLES = 10, 24
"""Points of a contact by default; what they err by: `solution/point_errors.py`."""
MOST_RADII, MOST_ANGLES = 100, 400


class TractionLaw(StrEnum):
    """How friction grows with slip."""

    COULOMB = "coulomb"
    """In proportion to load, whatever the slip, but for slips of about the slip speed and below."""
    LINEAR = "linear"
    """In proportion to slip as well."""


LAW_CODES = {law: code for code, law in enumerate(TractionLaw)}
_LINEAR = 1


@dataclass(frozen=True)
class Traction:
    """The law of friction in the contacts; SI units.

    Raises:
        SceneError: a number out of range, or no such law.
    """

    friction_coefficient: ArrayLike | None = field(default=None, metadata=given_in(range=COEFFICIENTS))
    """mu, at slips far above the slip speed [-]; None: 0.07 is assumed. An array spans cases, as for `slip_speed`."""
    slip_speed: ArrayLike = field(default=0.1, metadata=given_in("m/s", SLIP_SPEEDS))
    """vc, at which friction has reached 0.71 mu [m/s]; it may span cases."""
    law: TractionLaw = TractionLaw.COULOMB
    has_curvature: bool = True
    """Whether contacts lie on the common curvature of ball and groove, whose parts slide; False: they are flat."""
    cage_drag: float = field(default=0.0, metadata=given_in("N", (0.0, 1e5)))
    """Force of the cage on each ball against its orbit [N]."""
    drag_coefficient: float | None = field(default=None, metadata=given_in(range=(0.0, 10.0)))
    """cd of a ball between its neighbours: drag of cd rho (pi D^2/8) v^2 against its orbit [-]."""
    fluid_density: float | None = field(default=None, metadata=given_in("kg/m3", (0.0, 2e3)))
    """rho, of the mixture of air and oil between the rings [kg/m^3]; with `drag_coefficient`."""
    friction_range: tuple[float, float] | None = field(
        default=None, metadata=given_in(range=COEFFICIENTS, is_list=True)
    )
    """The least and the largest mu that the contacts may have: the band of results between them is told [-]."""
    radial_points: int = field(default=RADII, metadata=given_in(range=(1.0, MOST_RADII)))
    """Of each contact, along a radius."""
    points_around: int = field(default=ANGLES, metadata=given_in(range=(4.0, MOST_ANGLES)))
    """Likewise around it: a multiple of 4."""
    name: ClassVar[str] = "traction"

    def __post_init__(self) -> None:
        law, errors = choose("traction.law", self.law, TractionLaw)
        object.__setattr__(self, "law", law)
        errors += within("traction.friction_coefficient", self.coefficient, RATIO, *COEFFICIENTS)
        errors += within("traction.slip_speed", self.slip_speed, VELOCITY, *SLIP_SPEEDS)
        errors += within("traction.cage_drag", self.cage_drag, FORCE, 0.0, 1e5)
        drag = {"drag_coefficient": (RATIO, 10.0), "fluid_density": (DENSITY, 2e3)}
        for name, (quantity, most) in drag.items():
            if getattr(self, name) is not None:
                errors += within(f"traction.{name}", getattr(self, name), quantity, 0.0, most)
        if (self.drag_coefficient is None) != (self.fluid_density is None):
            missing = "fluid_density" if self.fluid_density is None else "drag_coefficient"
            errors.append(
                ErrorDetail(f"traction.{missing}", "missing", cause="Drag needs both; leave both out for none")
            )
        errors += self._range_errors() + self._point_errors()
        raise_if_any(errors)

    def _range_errors(self) -> list[ErrorDetail]:
        if self.friction_range is None:
            return []
        if np.shape(self.friction_range) != (2,):
            cause = "Give the least and the largest coefficient, such as [0.03, 0.1]"
            return [
                ErrorDetail(
                    "traction.friction_range", "is not a pair of numbers", str(self.friction_range), cause=cause
                )
            ]
        object.__setattr__(self, "friction_range", tuple(float(each) for each in self.friction_range))
        errors = [
            each for end in self.friction_range for each in within("traction.friction_range", end, RATIO, *COEFFICIENTS)
        ]
        least, most = self.friction_range
        if not errors and not least < most:
            errors.append(ErrorDetail("traction.friction_range", "does not rise", str(list(self.friction_range))))
        return errors

    def _point_errors(self) -> list[ErrorDetail]:
        """Of what must be whole numbers; those of a file, which are not, become them."""
        errors: list[ErrorDetail] = []
        for name, multiple, most in (("radial_points", 1, MOST_RADII), ("points_around", 4, MOST_ANGLES)):
            value: Any = getattr(self, name)
            if not isinstance(value, int | float) or value != int(value) or value % multiple:
                problem = "is not a whole number" if multiple == 1 else "is not a multiple of 4"
                errors.append(ErrorDetail(f"traction.{name}", problem, value))
                continue
            object.__setattr__(self, name, int(value))
            errors += within(f"traction.{name}", value, RATIO, multiple, most)
        return errors

    @property
    def coefficient(self) -> ArrayLike:
        """mu, which is assumed where it is not given [-]; it may span cases."""
        return FRICTION_COEFFICIENT if self.friction_coefficient is None else self.friction_coefficient

    @property
    def is_assumed(self) -> bool:
        """Whether mu is."""
        return self.friction_coefficient is None


def most_drag(coefficient: NDArray, inner_load: ArrayLike, parallel: NDArray) -> NDArray:
    """mu Qi (1 + cos(ai - ao)) of a ball: the drag at which it slides on both rings and falls behind.

    By equilibrium about the axis through both contacts' tangents: the ball passes what its inner contact drives it with
    on to the outer one.

    Args:
        parallel: cos(ai - ao).
    """
    return np.asarray(coefficient * np.asarray(inner_load) * (1.0 + parallel))


@inlined
def friction_over_slip(law: int, coefficient: float, slip_speed: float, square: float) -> tuple[float, float, float]:
    """(g, k, p) of a slip v of this square: friction is g v and changes by (g - k v v') dv; p: f's integral by |v|."""
    if law == _LINEAR:
        slope = coefficient / slip_speed
        return slope, 0.0, 0.5 * slope * square
    root = sqrt(square + slip_speed * slip_speed)
    inverse = 1.0 / root
    over_slip = coefficient * inverse
    return over_slip, over_slip * inverse * inverse, coefficient * root
