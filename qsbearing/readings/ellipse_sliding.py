"""Coulomb friction of a contact that rolls and spins at once, integrated over its ellipse.

Sources: H. Heathcote 1921 (sliding from the groove's curvature); Jones 1959; Harris & Kotzalas, *Advanced Concepts of
Bearing Technology*, 2.5 to 2.7. The pressed surface has the mean curvature of ball and groove across the groove, 1/R =
(2/D + 1/r)/2, so at x along the major axis a rolling contact slides by roll (h - x^2/(2 R)), and spin adds to it:

    v_rolling direction = roll (h - x^2/(2 R)) + spin x          v_across = -spin y

h, which sets where the contact truly rolls, follows from no net traction in the rolling direction: nothing but the
other contact and the cage could balance it. That is also the h of least power, so its own error hardly shows.

In units of the ellipse, X = x/a, Y = y/b, with t = roll a^2/(2 R) and s = spin a, the sliding speeds are
v = t (c - X^2) + s X and -s (b/a) Y, 0 <= c <= 1, and with H^2 = 1 - X^2, m = -(s (b/a) H/v)^2 and the complete
elliptic integrals K(m), E(m)

    power = mu Q (3/(2 pi)) int int sqrt(1 - X^2 - Y^2) speed dX dY
          = mu Q (3/pi) int H^2 |v| [(1 + m) E - (1 - m) K]/(3 m) dX         from -1 to 1
    traction, up to a factor,  int H^2 sign(v) [E - (1 - m) K]/m dX = 0      gives c
"""

from __future__ import annotations

from functools import cache
from math import log, pi

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe, ellipk

from qsbearing.model.compiler.compiled import kernel

NODES = 8
"""Gauss nodes between two lines of pure rolling, where the integrand has its kinks: the power is good to some 1e-5."""

HALVINGS = 8
"""Of the interval of c: to 2e-3, which the power, being least there, sees as its square."""

CHUNK = 2048
"""Contacts whose integrands exist at a time."""

PLACES = (129, 33)
"""Of the table, over the share of spin and the logarithm of the axis ratio: good to 5e-5, and made in 0.2 s."""

SLENDEREST = 2e-3
"""b/a of the table's slenderest ellipse, which stands for those beyond."""

_SMALL = 1e-5
"""Below this |m| the integrals' limits stand, which are right to m^2."""


def deformed_radius(ball_diameter: NDArray, groove_radius: NDArray) -> NDArray:
    """R = 2 r D/(2 r + D), of the pressed surface across the groove [m]."""
    return np.asarray(2.0 * groove_radius * ball_diameter / (2.0 * groove_radius + ball_diameter))


@kernel
def tabulated_sliding_speed(
    table: NDArray, curvature_speed: float, spin_speed: float, logarithm: float, interval: int
) -> float:
    """`mean_sliding_speed` from `sliding_table`, a hundred times faster; NaN for what is not a number.

    It depends on s/(s + t) and b/a alone, times s + t.

    Args:
        logarithm, interval: where ln(b/a) lies, by `place_of_ellipse`.
    """
    t, s = abs(curvature_speed), abs(spin_speed)
    total = t + s
    if not total > 0.0:
        return total
    place = s / total * (PLACES[0] - 1)
    i = min(int(place), PLACES[0] - 2)
    x = place - i
    c = table[interval, i]
    value = 0.0
    for p in range(4):
        row = ((c[p, 0] * logarithm + c[p, 1]) * logarithm + c[p, 2]) * logarithm + c[p, 3]
        value = value * x + row
    return total * value


@kernel
def place_of_ellipse(axis_ratio: float) -> tuple[float, int]:
    """Where ln(b/a) lies in the table: its part of an interval, and which."""
    place = (1.0 - log(min(max(axis_ratio, SLENDEREST), 1.0)) / log(SLENDEREST)) * (PLACES[1] - 1)
    interval = min(int(place), PLACES[1] - 2)
    return place - interval, interval


@cache
def sliding_table() -> NDArray:
    """Coefficients of the bicubic spline through `mean_sliding_speed` at s + t = 1, in units of the intervals.

    Shape (interval of ln(b/a), interval of s, falling power of s, falling power of ln(b/a)).
    """
    from scipy.interpolate import CubicSpline

    share, logarithm = np.linspace(0.0, 1.0, PLACES[0]), np.linspace(np.log(SLENDEREST), 0.0, PLACES[1])
    s, ratio = share[:, None], np.exp(logarithm)
    values = mean_sliding_speed(1.0 - s, s, ratio)[0]
    along = CubicSpline(np.arange(PLACES[0]), values, axis=0).c  # (power, interval, ln(b/a))
    both = CubicSpline(np.arange(PLACES[1]), along, axis=2).c  # (power of ln, its interval, power of s, its interval)
    return np.ascontiguousarray(both.transpose(1, 3, 2, 0))


def mean_sliding_speed(
    curvature_speed: NDArray,
    spin_speed: NDArray,
    axis_ratio: NDArray,
    nodes: int = NODES,
    halvings: int = HALVINGS,
) -> tuple[NDArray, NDArray]:
    """Sliding speed averaged with the pressure [m/s], so that power = mu Q times it; and c, where it truly rolls.

    Args:
        curvature_speed: t = roll a^2/(2 R) [m/s].
        spin_speed: s = spin a [m/s].
        axis_ratio: b/a.
        nodes: of the quadrature.
        halvings: of the interval of c.

    Returns:
        Without spin the contact rolls without sliding at |X| = sqrt(c) = 0.347.
    """
    shape = np.broadcast_shapes(curvature_speed.shape, spin_speed.shape, axis_ratio.shape)
    # The signs of rolling and spin only mirror the ellipse.
    flat = [np.abs(np.broadcast_to(each, shape).ravel()) for each in (curvature_speed, spin_speed, axis_ratio)]
    mean, rolling = np.full(flat[0].shape, np.nan), np.full(flat[0].shape, np.nan)
    known = np.flatnonzero(np.isfinite(flat[0]) & np.isfinite(flat[1]) & np.isfinite(flat[2]))
    for start in range(0, known.size, CHUNK):
        part = known[start : start + CHUNK]
        t, s, ratio = (each[part] for each in flat)
        low, high = np.zeros_like(t), np.ones_like(t)
        for _ in range(halvings):
            c = 0.5 * (low + high)
            backward = _integrals(t, s, ratio, c, nodes)[1] < 0.0
            low, high = np.where(backward, c, low), np.where(backward, high, c)
        rolling[part] = 0.5 * (low + high)
        mean[part] = _integrals(t, s, ratio, rolling[part], nodes)[0]
    return mean.reshape(shape), rolling.reshape(shape)


def _integrals(t: NDArray, s: NDArray, ratio: NDArray, c: NDArray, nodes: int) -> tuple[NDArray, NDArray]:
    """(mean sliding speed, traction up to a factor) of contacts with a given c."""
    X, weight = _nodes(t, s, c, nodes)
    t, s, ratio, c = (each[:, None] for each in (t, s, ratio, c))
    v = t * (c - X**2) + s * X
    across = s * ratio
    size = np.maximum(np.abs(v), 1e-9 * np.maximum(across, np.finfo(float).tiny))
    H2 = 1.0 - X**2
    m = -H2 * (across / size) ** 2
    is_small = np.abs(m) < _SMALL
    safe = np.where(is_small, -1.0, m)
    K, E = ellipk(safe), ellipe(safe)
    of_speed = np.where(is_small, pi / 4.0 - pi * m / 32.0, ((1.0 + safe) * E - (1.0 - safe) * K) / (3.0 * safe))
    of_traction = np.where(is_small, pi / 4.0 + pi * m / 32.0, (E - (1.0 - safe) * K) / safe)
    mean = 3.0 / pi * (weight * H2 * size * of_speed).sum(axis=1)
    return mean, (weight * H2 * np.sign(v) * of_traction).sum(axis=1)


def _nodes(t: NDArray, s: NDArray, c: NDArray, nodes: int) -> tuple[NDArray, NDArray]:
    """X and weights, shape (contact, node): three intervals between the zeros of v, nodes dense towards their ends."""
    # Zeros of t (c - X^2) + s X, the stable way: their product is -c.
    far = 0.5 * (s + np.sqrt(s**2 + 4.0 * t**2 * c))
    with np.errstate(divide="ignore", invalid="ignore"):
        right = np.where(t > 0.0, far / t, 1.0)
        left = np.where(far > 0.0, -c * t / far, 0.0)
    z, w = np.polynomial.legendre.leggauss(nodes)
    place, dense = 0.25 * z * (3.0 - z**2), 0.75 * (1.0 - z**2) * w  # from -1/2 to 1/2
    ends = np.stack([-np.ones_like(t), np.clip(left, -1.0, 1.0), np.clip(right, -1.0, 1.0), np.ones_like(t)], axis=1)
    width = np.diff(ends, axis=1)[:, :, None]
    X = 0.5 * (ends[:, :-1] + ends[:, 1:])[:, :, None] + width * place
    return X.reshape(t.size, -1), (width * dense).reshape(t.size, -1)
