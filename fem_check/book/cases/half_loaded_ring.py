"""Palmgren's and Sjövall's half-loaded ring: a bearing whose load just reaches half of its balls."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.published import bearing

SOURCE = "NSK, technical report E728, chapter 5"
ANGLES = (15.0, 25.0, 40.0)
BALLS = 160
AXIAL, RADIAL = 1.216, 4.37
"""F_a/(F_r tan alpha) and Q_max Z cos(alpha)/F_r at epsilon = 0.5."""


def half_loaded(angle: float, radial: NDArray) -> qs.Solution:
    """A ring pushed sideways [m] from where its balls just touch, upright: half of the balls are loaded."""
    ring = bearing(BALLS, 6.0, 400.0, angle)
    operation = qs.Operation(axial_displacement=0.0, radial_displacement_y=radial, tilt_y=0.0, tilt_z=0.0)
    return qs.solve(qs.Scene(ring, operation))


def run() -> CaseResult:
    """Both numbers of the half-loaded ring, and the ball load under thrust."""
    rows, distribution, drift = [], [], []
    pushes = np.geomspace(1e-8, 3e-5, 15)
    styles = iter(("dots", "squares", "crosses"))
    for angle in ANGLES:
        a = angle * qs.deg
        solution = half_loaded(angle, pushes)
        Fa, Fr, Q = solution.load[:, 0], solution.load[:, 1], solution.inner.load
        ratio, largest = Fa / (Fr * np.tan(a)), Q.max(axis=-1) * BALLS * np.cos(a) / Fr
        case = f"{angle:.0f} degrees, {BALLS} balls, light load"
        rows += [
            compared(
                case,
                "F_a/(F_r tan α) with half of the ring loaded",
                "1",
                AXIAL,
                ratio[0],
                SOURCE,
                5e-4 + 2e-4,
                "half of the last printed digit, and the change of the angle under load",
            ),
            compared(
                case,
                "Q_max Z cos α/F_r",
                "1",
                RADIAL,
                largest[0],
                SOURCE,
                5e-3 + 1e-3,
                "half of the last printed digit, and the number of balls",
            ),
            compared(
                case,
                "balls that are loaded, half of the ring's",
                "balls",
                0.5 * BALLS,
                float((Q[0] > 0.0).sum()),
                SOURCE,
                1.0,
                "one ball",
            ),
        ]
        thrust = qs.solve(qs.Scene(bearing(BALLS, 6.0, 400.0, angle), qs.Operation(axial_load=0.01)))
        rows.append(
            compared(
                case,
                "Q Z sin α/F_a under thrust alone",
                "1",
                1.0,
                100.0 * thrust.inner.load[0] * BALLS * np.sin(a),
                SOURCE,
                1e-4,
                "the change of the angle under 0.01 N",
            )
        )
        drift.append(Curve(f"{angle:.0f}°", next(styles), Fr, ratio))
        if angle == 40.0:
            psi = np.degrees(solution.azimuth[0])
            psi = np.where(psi > 180.0, psi - 360.0, psi)
            order = np.argsort(psi)
            shown = np.cos(np.radians(psi[order])).clip(0.0) ** 1.5
            distribution = [
                Curve("solved", "dots", psi[order], Q[0][order] / Q[0].max()),
                Curve("cos ψ to the power 1.5", "dashed", psi[order], shown),
            ]
            apart = float(np.abs(Q[0][order] / Q[0].max() - shown).max())
            rows.append(
                compared(
                    case,
                    "Q/Q_max less (cos ψ)^1.5, largest",
                    "1",
                    0.0,
                    apart,
                    SOURCE,
                    1e-3,
                    "the change of the angle under load",
                )
            )
    return CaseResult(
        f"F_a/(F_r tan α) = {rows[0].found:.4f} and Q_max Z cos α/F_r = {rows[1].found:.3f} at {ANGLES[0]:.0f} degrees;"
        " the other angles likewise.",
        rows,
        [
            Diagram("azimuth, degrees", "ball load over the largest", distribution, title="half-loaded ring, 40°"),
            Diagram(
                "radial load, N",
                "Fa / (Fr tan α)",
                drift,
                title="the angle opens under load",
                x_scale="log",
                levels=[AXIAL],
            ),
        ],
    )
