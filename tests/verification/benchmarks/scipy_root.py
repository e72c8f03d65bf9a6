"""What a user would write instead: all 2Z + 3 equations in numpy, handed to `scipy.optimize.root`.

Written from the equations for this comparison, in plain arrays, as a fair user would; it shares nothing with the
package but the bearing's numbers.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

import qsbearing as qs


@dataclass(frozen=True)
class Problem:
    """One planar operating point of a bearing under outer control."""

    bearing: qs.BallBearing
    inner_stiffness: float
    outer_stiffness: float
    axial_load: float
    radial_load: float
    speed: float

    def residual(self, unknowns: NDArray) -> NDArray:
        """Imbalance of ring (3) and balls (2Z), forces over the axial load."""
        b = self.bearing
        count, diameter, pitch = int(b.ball_count), float(b.ball_diameter), float(b.pitch_diameter)
        azimuth = 2 * np.pi * np.arange(count) / count
        lo, li = float(b.outer_groove_radius) - diameter / 2, float(b.inner_groove_radius) - diameter / 2
        alpha0, lever = float(b.free_contact_angle), float(b.inner_groove_centre_radius)
        axial, radial, tilt = unknowns[:3] * 1e-5
        x = unknowns[3:].reshape(count, 2) * 1e-5 + lo * np.array([np.sin(alpha0), np.cos(alpha0)])
        a = np.stack(
            [
                (lo + li) * np.sin(alpha0) + axial - lever * tilt * np.cos(azimuth),
                (lo + li) * np.cos(alpha0) + radial * np.cos(azimuth),
            ],
            axis=1,
        )
        w = a - x
        long_o, long_i = np.hypot(*x.T), np.hypot(*w.T)
        so, co, si, ci = *(x.T / long_o), *(w.T / long_i)
        qo = self.outer_stiffness * np.maximum(long_o - lo, 0) ** 1.5
        qi = self.inner_stiffness * np.maximum(long_i - li, 0) ** 1.5
        g, mass = diameter / pitch, float(b.ball_mass)
        orbit = self.speed * (1 - g * ci) / (1 + np.cos(ai_less_ao(si, ci, so, co)))
        across = -self.speed * so * (1 - g * ci) / (g * (1 + np.cos(ai_less_ao(si, ci, so, co))))
        force = 0.5 * mass * pitch * orbit**2
        friction = 2 * float(b.ball_inertia) * across * orbit / diameter
        balls = np.stack(
            [qi * si - qo * so + friction * co, qi * ci - qo * co - friction * so + force],
            axis=1,
        )
        ring = [
            (qi * si).sum() - self.axial_load,
            (qi * ci * np.cos(azimuth)).sum() - self.radial_load,
            (qi * si * np.cos(azimuth)).sum(),
        ]
        return np.concatenate([ring, balls.ravel()]) / self.axial_load


def ai_less_ao(si: NDArray, ci: NDArray, so: NDArray, co: NDArray) -> NDArray:
    """Difference of the contact angles."""
    return np.arctan2(si, ci) - np.arctan2(so, co)


def solve(problem: Problem, start: NDArray) -> tuple[bool, NDArray]:
    """(converged to 1e-8, ring displacement) by MINPACK's hybrid method, as `root` runs it by default."""
    found = root(problem.residual, start, method="hybr")
    good = bool(np.abs(problem.residual(found.x)).max() <= 1e-8)
    return good, found.x[:3] * 1e-5


def start_of(problem: Problem, solution: qs.Solution, index: int) -> NDArray:
    """The unknowns at a thrust-loaded solution at rest."""
    b = problem.bearing
    angle = solution.outer.angle[index]
    reach = float(b.outer_groove_radius) - float(b.ball_diameter) / 2 + solution.outer.approach[index]
    free = float(b.free_contact_angle)
    lo = float(b.outer_groove_radius) - float(b.ball_diameter) / 2
    moved = np.stack([reach * np.sin(angle) - lo * np.sin(free), reach * np.cos(angle) - lo * np.cos(free)], axis=1)
    return np.concatenate([[solution.displacement[index, 0], 0.0, 0.0], moved.ravel()]) * 1e5
