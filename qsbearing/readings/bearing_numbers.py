"""The numbers of a bearing as its readings need them: arrays, nominal angle, groove coefficients, Hertz per raceway."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing, BearingKind
from qsbearing.model.contact.hertz import point_contact
from qsbearing.model.units import deg

INNER, OUTER = -1.0, 1.0
"""The sign of gamma in the formulas of a raceway: 1 - gamma inside, 1 + gamma outside."""


@dataclass(frozen=True)
class BearingNumbers:
    """A bearing's fields as float arrays that broadcast to its cases."""

    bearing: BallBearing

    def __getattr__(self, name: str) -> NDArray:
        return np.asarray(getattr(self.bearing, name), float)

    @cached_property
    def nominal_angle(self) -> NDArray:
        """The contact angle of the rating standards: zero for deep groove, whatever the clearance."""
        if self.bearing.kind is BearingKind.DEEP_GROOVE:
            return np.zeros(())
        return np.asarray(self.bearing.free_contact_angle, float)

    @cached_property
    def is_thrust(self) -> NDArray:
        """Whether the rating standards count it among thrust bearings: a nominal contact angle above 45 degrees."""
        return np.asarray(self.nominal_angle > 45.0 * deg * (1.0 + 1e-9))

    @cached_property
    def nominal_gamma(self) -> NDArray:
        """D cos(alpha)/dm at the nominal angle."""
        return np.asarray(self.ball_diameter * np.cos(self.nominal_angle) / self.pitch_diameter)

    def groove_radius(self, side: float) -> NDArray:
        """r of a raceway [m]."""
        return self.inner_groove_radius if side < 0 else self.outer_groove_radius

    def groove_coefficient(self, side: float) -> NDArray:
        """f = r/D of a raceway."""
        return np.asarray(self.groove_radius(side) / self.ball_diameter)

    @cached_property
    def is_hybrid(self) -> NDArray:
        """Whether the balls are clearly stiffer than the rings: ceramic in steel."""
        ball, ring = self.bearing.ball_material, self.bearing.ring_material
        return np.asarray(np.asarray(ball.elastic_modulus) > 1.2 * np.asarray(ring.elastic_modulus))


def load_at_pressure(
    max_pressure: ArrayLike, ball_diameter: ArrayLike, gamma: ArrayLike, f: ArrayLike, modulus: ArrayLike, side: float
) -> NDArray:
    """The ball load at which a raceway's contact reaches a maximum pressure [N].

    From p0 = 1.5 Q/(pi a b) and a, b proportional to Q^(1/3): Q = (2 pi a1 b1 p0/3)^3 with the semi-axes under 1 N.

    Args:
        max_pressure: p0 [Pa].
        gamma: D cos(alpha)/dm.
        f: groove radius over ball diameter.
        modulus: E' [Pa].
        side: INNER or OUTER.
    """
    diameter, gamma, f, modulus = (np.asarray(value, float) for value in (ball_diameter, gamma, f, modulus))
    rolling = 2.0 / (diameter * (1.0 + side * gamma))
    transverse = (2.0 * f - 1.0) / (f * diameter)

    def ellipse_area(x: float, y: float, e: float) -> float:
        contact = point_contact(1.0, x, y, e)
        return contact.semi_major_axis * contact.semi_minor_axis

    area: Any = np.vectorize(ellipse_area, otypes=[float])(rolling, transverse, modulus)
    return np.asarray((2.0 * pi / 3.0 * area * np.asarray(max_pressure, float)) ** 3)
