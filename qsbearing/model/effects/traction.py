"""Traction: the friction of sliding contacts from which the balls' axes and orbits follow, in place of raceway control.

Source        rigid-body mechanics of a ball with friction over both ellipses, derived here; contact surfaces as
              Heathcote 1921 has them, on their common curvature. Coulomb's law is rounded off at small slip
Equation      dF = -f(|v|) p v/|v| dA on the ball, v its surface's velocity less the ring's (`kernel/traction.py`);
              Coulomb: f = mu |v|/sqrt(v^2 + vc^2); linear: f = mu |v|/vc, what Coulomb's is at slips far below vc
Assumes       friction knows pressure and slip alone: no film, no temperature; f does not fall with slip, so that
              dissipation is convex and the motion of a ball under given loads unique
When not      thermal laws, whose friction falls again with slip: motions are then several, and unsteady. The heat of
              the linear law means nothing: it is the limit of small slip
Parameters    friction_coefficient: mu, at most 0.3; slip_speed: vc [m/s]; law; has_curvature: False takes contacts for
              flat, at D/2 from the ball's centre, the textbooks' simplification; cage_drag, drag_coefficient with
              fluid_density: what holds balls back on their way
Example       Traction(friction_coefficient=0.05, slip_speed=0.1)
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.compiler.compiled import inlined
from qsbearing.model.validation import DENSITY, FORCE, RATIO, ErrorDetail, Quantity, choose, raise_if_any, within

SLIP_SPEED = Quantity("m/s", (("m_s", "metres per second", 1.0), ("mm_s", "millimetres per second", 1e-3)))


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

    friction_coefficient: ArrayLike = 0.07
    """mu, at slips far above the slip speed [-]; an array spans cases, as it does for `slip_speed`."""
    slip_speed: ArrayLike = 0.1
    """vc, at which friction has reached 0.71 mu [m/s]."""
    law: TractionLaw = TractionLaw.COULOMB
    has_curvature: bool = True
    """Whether contacts lie on the common curvature of ball and groove, whose parts slide; False: they are flat."""
    cage_drag: float = 0.0
    """Force of the cage on each ball against its orbit [N]."""
    drag_coefficient: float | None = None
    """cd of a ball between its neighbours: drag of cd rho (pi D^2/8) v^2 against its orbit [-]."""
    fluid_density: float | None = None
    """rho, of the mixture of air and oil between the rings [kg/m^3]; with `drag_coefficient`."""

    def __post_init__(self) -> None:
        law, errors = choose("law", self.law, TractionLaw)
        object.__setattr__(self, "law", law)
        errors += within("friction_coefficient", self.friction_coefficient, RATIO, 1e-3, 0.3)
        errors += within("slip_speed", self.slip_speed, SLIP_SPEED, 1e-4, 10.0)
        errors += within("cage_drag", self.cage_drag, FORCE, 0.0, 1e5)
        drag = {"drag_coefficient": (RATIO, 10.0), "fluid_density": (DENSITY, 2e3)}
        for name, (quantity, most) in drag.items():
            if getattr(self, name) is not None:
                errors += within(name, getattr(self, name), quantity, 0.0, most)
        if (self.drag_coefficient is None) != (self.fluid_density is None):
            missing = "fluid_density" if self.fluid_density is None else "drag_coefficient"
            errors.append(ErrorDetail(missing, "is missing: drag needs both"))
        raise_if_any(errors)


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
