"""Friction of a contact whose slip varies over its ellipse: points over the ellipse, and laws of friction.

A point (X, Y) of the unit circle stands for X a along the major and Y b along the minor axis. With s^2 = 1 - X^2 - Y^2
Hertz's pressure has the resultant

    integral of p dA = 3 Q/(2 pi) int int s^2 ds dphi,

so Gauss's points in s, at angles in the middle of equal parts, sum exactly what is a polynomial in X, Y and s. Friction
of Coulomb turns round where the slip does: there only many points do.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fem_check.independent.contact_problem import Array


@dataclass(frozen=True)
class EllipsePoints:
    """Of an ellipse; arrays (point,)."""

    along: Array
    """X, over the semi-major axis."""
    across: Array
    """Y, over the semi-minor axis."""
    weight: Array
    """Part of the load that each carries."""
    curved: bool = True
    """Whether they lie on the surface that ball and groove share; if not, all at the ball's radius from its centre."""


def over_ellipse(rings: int, angles: int, curved: bool = True) -> EllipsePoints:
    """So many rings of so many points."""
    node, weight = np.polynomial.legendre.leggauss(rings)
    s = 0.5 * (1.0 + node)
    weight = weight * s * s
    radius = np.sqrt(1.0 - s * s)[:, None]
    angle = 2.0 * np.pi * (np.arange(angles) + 0.5) / angles
    each = np.repeat(weight / weight.sum() / angles, angles)
    return EllipsePoints((radius * np.cos(angle)).ravel(), (radius * np.sin(angle)).ravel(), each, curved)


def at_centre() -> EllipsePoints:
    """The load at one point, which no spin makes slip."""
    return EllipsePoints(np.zeros(1), np.zeros(1), np.ones(1), curved=False)


@dataclass(frozen=True)
class Coulomb:
    """mu v/sqrt(v^2 + vc^2) of the load, against the slip v."""

    coefficient: Array
    """mu; of the inner contacts, then of the outer: shape (2, 1) or (2, case)."""
    slip_speed: Array | float
    """vc [m/s]; a number, or of shape (case,)."""

    def over_speed(self, square: Array) -> Array:
        """Friction over load and slip [s/m], of the slip's square; shapes (2, case, point)."""
        slip_speed = np.asarray(self.slip_speed)[..., None]
        return np.asarray(self.coefficient[..., None] / np.sqrt(square + slip_speed * slip_speed))


@dataclass(frozen=True)
class Linear:
    """In proportion to the slip: the limit of other laws for little slip. Its heat is no physics at more."""

    slope: float
    """Friction over load and slip [s/m]."""

    def over_speed(self, square: Array) -> Array:
        """As of `Coulomb`."""
        return np.full_like(square, self.slope)
