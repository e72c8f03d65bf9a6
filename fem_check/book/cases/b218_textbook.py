"""The 218 bearing of the textbooks under thrust at rest: printed angle, ball load and displacement."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared

SOURCE = "Harris & Kotzalas, Rolling Bearing Analysis, example of the 218 bearing"
THRUST = 17.8e3
CHART = 896.7
"""Axial load-deflection constant that the book reads off a chart [N/mm^2]."""
PRINTED = {"angle": 41.6, "load": 1676.0, "displacement": 0.0386}


def solved(bearing: qs.BallBearing, thrust: float | np.ndarray = THRUST) -> qs.Solution:
    """The bearing under thrust at rest, Hertz at the free angle."""
    return qs.solve(qs.Scene(bearing, qs.Operation(axial_load=thrust)))


def read(solution: qs.Solution) -> dict[str, float]:
    """Contact angle [degrees], ball load [N] and axial displacement [mm]."""
    return {
        "angle": float(solution.inner.angle[..., 0]) / qs.deg,
        "load": float(solution.inner.load[..., 0]),
        "displacement": float(solution.displacement[..., 0]) / qs.mm,
    }


def constant(bearing: qs.BallBearing, solution: qs.Solution) -> float:
    """K of Q = K D^2 (approach/A)^1.5, A the distance of the groove centres [N/mm^2]."""
    approach = solution.inner.approach[0] + solution.outer.approach[0]
    relative = (approach / bearing.groove_centre_distance) ** 1.5
    return 1e-6 * float(solution.inner.load[0] / relative / np.asarray(bearing.ball_diameter) ** 2)


def run() -> CaseResult:
    """With the chart's constant as the book, and with exact Hertz."""
    b218 = qs.load_scene("b218").bearing
    exact = solved(b218)
    here = constant(b218, exact)
    modulus = float(np.asarray(b218.ball_material.elastic_modulus)) * CHART / here
    soft = replace(b218.ball_material, elastic_modulus=modulus)
    charted = replace(b218, ball_material=soft, ring_material=soft)
    with_chart, without = read(solved(charted)), read(exact)
    steeper = read(solved(charted, THRUST * 1.001))
    slope = (steeper["displacement"] - with_chart["displacement"]) / (steeper["angle"] - with_chart["angle"])
    case = f"17.8 kN thrust at rest, the chart's constant {CHART} N/mm²"
    rows = [
        compared(
            case,
            "contact angle",
            "degrees",
            PRINTED["angle"],
            with_chart["angle"],
            SOURCE,
            0.05,
            "one decimal is printed",
        ),
        compared(case, "ball load", "N", PRINTED["load"], with_chart["load"], SOURCE, 0.5, "printed to 1 N"),
        compared(
            case,
            "axial displacement",
            "mm",
            PRINTED["displacement"],
            with_chart["displacement"],
            SOURCE,
            0.05 * slope,
            "the book takes it from its rounded angle: 0.05 degrees of it",
        ),
    ]
    case = "the same, exact Hertz"
    for name, quantity, unit in (
        ("angle", "contact angle", "degrees"),
        ("load", "ball load", "N"),
        ("displacement", "axial displacement", "mm"),
    ):
        rows.append(
            compared(
                case,
                quantity,
                unit,
                PRINTED[name],
                without[name],
                SOURCE,
                None,
                "a finding: the chart's contact is softer than Hertz's",
            )
        )
    rows.append(
        compared(
            case,
            "constant of the load-deflection law",
            "N/mm²",
            CHART,
            here,
            SOURCE,
            None,
            "a finding: a chart reading",
        )
    )
    thrust = np.linspace(500.0, 45e3, 60)
    curves = {
        "exact Hertz": ("line", solved(b218, thrust)),
        "the chart's constant": ("dashed", solved(charted, thrust)),
    }
    panels = [
        Diagram(
            "axial load, kN",
            label,
            [
                *(Curve(name, style, thrust / 1e3, pick(solution)) for name, (style, solution) in curves.items()),
                Curve("printed", "circles", [THRUST / 1e3], [PRINTED[key]]),
            ],
        )
        for key, label, pick in (
            ("angle", "contact angle, degrees", lambda solution: solution.inner.angle[:, 0] / qs.deg),
            ("displacement", "axial displacement, mm", lambda solution: solution.displacement[:, 0] / qs.mm),
        )
    ]
    return CaseResult(
        f"With the book's chart constant {with_chart['angle']:.3f} degrees, {with_chart['load']:.1f} N, "
        f"{with_chart['displacement']:.4f} mm; exact Hertz {without['angle']:.3f} degrees, {without['load']:.2f} N, "
        f"{without['displacement']:.5f} mm.",
        rows,
        panels,
    )
