"""Two contacts of a textbook on mechanics, beside Hertz's ellipse in other integrals."""

from __future__ import annotations

from dataclasses import asdict
from math import cos, radians, sqrt
from typing import NamedTuple

import numpy as np

from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.independent import references
from fem_check.independent.contact_problem import ContactProblem, ElasticConstants
from fem_check.product.hertz import of_qsbearing
from fem_check.rows.row_text import scientific

SOURCE = "Boresi & Schmidt, Advanced Mechanics of Materials, chapter 17"
STEEL = ElasticConstants(200e9, 0.29)


class Example(NamedTuple):
    """A contact: curvatures of the gap x^2/(2 Rx) + y^2/(2 Ry) [1/m], load [N], and what the book reads off charts."""

    name: str
    curvature_x: float
    curvature_y: float
    load: float
    printed: dict[str, tuple[str, float, str]]
    """Quantity to unit, value, and remark."""


def crossed(angle: float, first: tuple[float, float], second: tuple[float, float]) -> tuple[float, float]:
    """Curvatures of the gap of two bodies with radii [m], their principal planes crossed at an angle [rad]."""
    total = sum(1.0 / radius for radius in (*first, *second))
    one, two = 1.0 / first[0] - 1.0 / first[1], 1.0 / second[0] - 1.0 / second[1]
    difference = sqrt(one**2 + two**2 + 2.0 * one * two * cos(2.0 * angle))
    return 0.5 * (total - difference), 0.5 * (total + difference)


CHART = "a finding: read off a chart"
EXAMPLES = (
    Example(
        "example 17.1: two bodies crossed at 60 degrees, 4.5 kN",
        *crossed(radians(60.0), (0.060, 0.130), (0.080, 0.200)),
        4500.0,
        {
            "max_pressure": ("MPa", 1597.0, CHART),
            "max_shear_stress": ("MPa", 529.0, CHART),
            "approach": ("mm", 0.03, CHART),
        },
    ),
    Example(
        "example 17.2, p. 609: ball in a groove, 1750 N",
        1.0 / 0.00476 - 1.0 / 0.00486,
        1.0 / 0.00476 + 1.0 / 0.01824,
        1750.0,
        {
            "max_pressure": ("MPa", 2314.0, CHART),
            "semi_minor_axis": ("mm", 0.16, CHART),
            "semi_major_axis": ("mm", 2.10, CHART),
            "max_shear_stress": ("MPa", 694.0, CHART),
            "max_shear_depth": ("mm", 0.12, CHART),
        },
    ),
)
SCALE = {"MPa": 1e-6, "mm": 1e3}
NAMES = {
    "max_pressure": "largest pressure",
    "semi_minor_axis": "semi-minor axis",
    "semi_major_axis": "semi-major axis",
    "max_shear_stress": "largest shear stress",
    "max_shear_depth": "depth of the largest shear stress",
    "approach": "approach",
}
UNITS = {
    "approach": "mm",
    "semi_major_axis": "mm",
    "semi_minor_axis": "mm",
    "max_pressure": "MPa",
    "max_shear_stress": "MPa",
    "max_shear_depth": "mm",
}


def run() -> CaseResult:
    """Both examples: against exact integrals, and against the book's charts."""
    rows, panels = [], []
    for example in EXAMPLES:
        problem = ContactProblem(example.name, example.curvature_x, example.curvature_y, STEEL, STEEL, example.load)
        exact, here = asdict(references.hertz(problem)), of_qsbearing(problem)
        for name, unit in UNITS.items():
            shear = name.startswith("max_shear")
            rows.append(
                compared(
                    example.name,
                    NAMES[name],
                    unit,
                    SCALE[unit] * exact[name],
                    SCALE[unit] * here[name],
                    references.SHEAR_SOURCE if shear else references.HERTZ_SOURCE,
                    SCALE[unit] * exact[name] * (1e-4 if shear else 1e-9),
                    "a search for a maximum" if shear else "rounding of two exact evaluations",
                )
            )
        for name, (unit, printed, remark) in example.printed.items():
            quantity = f"{NAMES[name]}, as printed"
            rows.append(compared(example.name, quantity, unit, printed, SCALE[unit] * here[name], SOURCE, None, remark))
        x = np.sin(np.linspace(0.0, 0.5 * np.pi, 60))
        a, b, p0 = (1e3 * here["semi_major_axis"], 1e3 * here["semi_minor_axis"], 1e-6 * here["max_pressure"])
        panels.append(
            Diagram(
                "distance from the centre, mm",
                "pressure, MPa",
                [
                    Curve("long axis", "line", a * x, p0 * np.sqrt(1.0 - x**2)),
                    Curve("short axis", "dashed", b * x, p0 * np.sqrt(1.0 - x**2)),
                    Curve("largest pressure as printed", "crosses", [0.0], [example.printed["max_pressure"][1]]),
                ],
                title=example.name.partition(":")[0].partition(",")[0],
            )
        )
    limit = max(row.tolerance_percent or 0.0 for row in rows if row.unit == "MPa" and "shear" not in row.quantity)
    charts = max(abs(row.deviation_percent) for row in rows if row.quantity == "largest pressure, as printed")
    return CaseResult(
        f"Both contacts agree with exact integrals within {scientific(limit, 1)} %; the book's charts are up to "
        f"{charts:.1f} % off in the largest pressure.",
        rows,
        panels,
    )
