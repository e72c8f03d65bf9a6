"""Friction of one contact ellipse, summed over points: forces and moments on the ball and all their derivatives.

At a contact n points from the ball's centre outward, t = (nz, 0, -nx) across the groove, y = n x t against the orbit.
With the ball's angular velocity w in the frame that goes round at omega_m, the ring's there, W = Omega - omega_m, and
the orbit's radius R,

    ws = w.n - W nx,   wr = w.t - W nz,   wy,   vr = W R                                  spin, roll, turn, ring's speed
    v_t = wy h - ws eta,   v_y = ws xi - wr h + vr                                        ball's surface less the ring's
    dF = -f(|v|) p v/|v| dA,   p = 3 Q/(2 pi a b) sqrt(1 - xi^2/a^2 - eta^2/b^2)
    T = int dF_t,  Y = int dF_y,  Mn = int (xi dF_y - eta dF_t),  Mt = -int h dF_y,  My = int h dF_t

with xi along t and eta along y. The deformed surface lies at h from the ball's centre, on the common curvature 1/Rd of
ball and groove (Heathcote 1921):

    h = sqrt(Rd^2 - xi^2) - sqrt(Rd^2 - a^2) + sqrt(D^2/4 - a^2),   Rd = 2 r D/(2 r + D).

Slips are affine in (wy, ws, wr, vr), so that what friction dissipates, P = int int f d|v| p dA, is convex in them where
f does not fall; (My, Mn, Mt, Y) is less its gradient, and the slopes here are less its Hessian.
"""

from __future__ import annotations

from functools import cache
from math import pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy import ndarray, recarray
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import inlined
from qsbearing.model.effects.traction import ANGLES, RADII, friction_over_slip


class Sums(NamedTuple):
    """Of a contact, per slopes by (wy, ws, wr, vr) and by the load."""

    t: float
    y: float
    mn: float
    mt: float
    my: float
    t_slopes: tuple[float, float, float, float, float]
    y_slopes: tuple[float, float, float, float, float]
    mn_slopes: tuple[float, float, float, float, float]
    mt_slopes: tuple[float, float, float, float, float]
    my_slopes: tuple[float, float, float, float, float]
    heat: float
    dissipation: float  # P


@cache
def contact_points(radii: int = RADII, angles: int = ANGLES) -> NDArray:
    """Points (point, 3) of a quarter of the unit ellipse: xi/a, eta/b, and each one's part of the load; four times they
    make 1.

    By s = sqrt(1 - rho^2) the load is 3 Q/(2 pi) s^2 ds dtheta: Gauss's points for the weight s^2 on (0, 1), and
    midpoints of equal angles.

    Made once, and not to be changed.

    Args:
        radii, angles: how many points there are along a radius and around.

    Raises:
        ValueError: no radius, or angles that do not make equal quarters.
    """
    if radii < 1 or angles < 4 or angles % 4:
        raise ValueError(f"{radii} radii, {angles} angles: at least 1, and a multiple of 4")
    s, weights = _gauss_of_squares(radii)
    theta = 2.0 * pi * (np.arange(angles // 4) + 0.5) / angles
    rho = np.sqrt(1.0 - s * s)
    xi, eta = np.outer(rho, np.cos(theta)), np.outer(rho, np.sin(theta))
    parts = np.repeat(weights / (weights.sum() * angles), theta.size)
    return np.column_stack([xi.ravel(), eta.ravel(), parts])


def _gauss_of_squares(count: int) -> tuple[NDArray, NDArray]:
    """Points and weights of Gauss on (0, 1) for the weight s^2, by Jacobi's matrix (Golub & Welsch 1969)."""
    k = np.arange(count, dtype=float)
    middle = 4.0 / ((2.0 * k + 2.0) * (2.0 * k + 4.0))  # Jacobi's polynomials for (1 - x)^0 (1 + x)^2
    k = k[1:]
    beside = 4.0 * k * k * (k + 2.0) ** 2 / ((2.0 * k + 2.0) ** 2 * (2.0 * k + 3.0) * (2.0 * k + 1.0))
    x, vectors = np.linalg.eigh(np.diag(middle) + np.diag(np.sqrt(beside), 1) + np.diag(np.sqrt(beside), -1))
    return 0.5 * (1.0 + x), vectors[0] ** 2 / 3.0


@inlined
def contact_sums(
    law: recarray,
    points: ndarray,
    load: float,
    a: float,
    b: float,
    curvature: float,
    slips: tuple[float, float, float, float],
) -> Sums:
    """Friction of a loaded contact of a ball of diameter 1.

    Args:
        law: of friction.
        points: of `contact_points`.
        load: Q > 0; a and b grow with its cubic root.
        curvature: 1/Rd; 0 for a flat contact, at h = D/2.
        slips: wy, ws, wr, vr.
    """
    wy, ws, wr, vr = slips
    is_flat = curvature == 0.0
    edge, rim = 1.0, 0.5
    if not is_flat:
        edge, rim = sqrt(1.0 - curvature * curvature * a * a), sqrt(0.25 - a * a)
    third = 1.0 / (3.0 * load)  # of a and b, d ln a/dQ
    t, y, mn, mt, my, heat, dissipated = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    tt, ty, yy, ct, cy, cn = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    htt, hty, hyy, hct, hcy, hhtt, hhty, hhyy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    t_q, y_q, mn_q, mt_q, my_q = 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(points.shape[0]):
        along, across = a * points[k, 0], b * points[k, 1]
        h, h_q = 0.5, 0.0
        if not is_flat:
            inside = sqrt(1.0 - curvature * curvature * along * along)
            h = rim + curvature * (a * a - along * along) / (inside + edge)
            h_q = third * (curvature * (a * a / edge - along * along / inside) - a * a / rim)
        ft, fy, dtt, dty, dyy, dct, dcy, qt, qy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for xi in (along, -along):
            for eta in (across, -across):
                v_t, v_y = wy * h - ws * eta, ws * xi - wr * h + vr
                square = v_t * v_t + v_y * v_y
                over_slip, less, potential = friction_over_slip(
                    law.law, law.friction_coefficient, law.slip_speed, square
                )
                g, less = points[k, 2] * over_slip, points[k, 2] * less
                f_t, f_y = g * v_t, g * v_y
                d_tt, d_ty, d_yy = g - less * v_t * v_t, -less * v_t * v_y, g - less * v_y * v_y
                c_t, c_y, turning = xi * d_ty - eta * d_tt, xi * d_yy - eta * d_ty, xi * f_y - eta * f_t
                mn, cn = mn + turning, cn + xi * c_y - eta * c_t
                heat, dissipated = heat + g * square, dissipated + points[k, 2] * potential
                ft, fy, dct, dcy = ft + f_t, fy + f_y, dct + c_t, dcy + c_y
                dtt, dty, dyy = dtt + d_tt, dty + d_ty, dyy + d_yy
                v_t, v_y = wy * h_q - third * ws * eta, third * ws * xi - wr * h_q
                q_t, q_y = d_tt * v_t + d_ty * v_y, d_ty * v_t + d_yy * v_y
                qt, qy, mn_q = qt + q_t, qy + q_y, mn_q + third * turning + xi * q_y - eta * q_t
        t, y, mt, my = t + ft, y + fy, mt + h * fy, my + h * ft
        tt, ty, yy, ct, cy = tt + dtt, ty + dty, yy + dyy, ct + dct, cy + dcy
        htt, hty, hyy, hct, hcy = htt + h * dtt, hty + h * dty, hyy + h * dyy, hct + h * dct, hcy + h * dcy
        hhtt, hhty, hhyy = hhtt + h * h * dtt, hhty + h * h * dty, hhyy + h * h * dyy
        t_q, y_q, mt_q, my_q = t_q + qt, y_q + qy, mt_q + h_q * fy + h * qy, my_q + h_q * ft + h * qt
    q = load
    return Sums(
        -q * t, -q * y, -q * mn, q * mt, -q * my,
        (-q * htt, -q * ct, q * hty, -q * ty, -t - q * t_q),
        (-q * hty, -q * cy, q * hyy, -q * yy, -y - q * y_q),
        (-q * hct, -q * cn, q * hcy, -q * cy, -mn - q * mn_q),
        (q * hhty, q * hcy, -q * hhyy, q * hyy, mt + q * mt_q),
        (-q * hhtt, -q * hct, q * hhty, -q * hty, -my - q * my_q),
        q * heat, q * dissipated,
    )  # fmt: skip
