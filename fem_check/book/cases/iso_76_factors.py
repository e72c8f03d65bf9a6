"""Static load factors of ISO 76: pressure of Hertz's ellipse on both raceways; the standard's worked example."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fem_check.book.case import CaseResult, Curve, Diagram, ValueTable, compared
from fem_check.book.published import STATIC_RADIAL, STATIC_THRUST, bearing
from fem_check.rows.agreement import AgreementRow
from qsbearing import readings
from qsbearing.model.contact.hertz import STATIC_PRESSURE
from qsbearing.readings import bearing_numbers

SOURCE = "ISO 76:2006, table 1, pp. 5-6 of GOST 18854-2013"
PRINT = 0.06
WHY = "one decimal is printed, and the standard's own arithmetic adds up to 0.01 to the 0.05 of rounding"


def factors(gamma: NDArray, inner_f: float, outer_f: float) -> NDArray:
    """Q(4200 MPa)/D^2 of the weaker raceway [N/mm^2]."""
    sides = ((bearing_numbers.INNER, inner_f), (bearing_numbers.OUTER, outer_f))
    modulus = bearing(9, 10.0, 50.0, 0.0).effective_modulus
    return np.minimum(
        *(bearing_numbers.load_at_pressure(STATIC_PRESSURE, 1e-3, gamma, f, modulus, side) for side, f in sides)
    )


def axial_rows() -> list[AgreementRow]:
    """The axial ratings of the worked examples."""
    forty = bearing(27, 7.5, 7.5 / 0.091, 40.0, 0.52, 0.53)
    sixty = bearing(27, 7.5, 7.5 / 0.091, 60.0, 0.54, 0.54)
    low, high = STATIC_THRUST[4:6]
    return [
        compared(
            "worked example: 27 balls of 7.5 mm, 40 degrees, D/dm 0.091", "C_0ar, of the printed C_0r", "N", 50430.0,
            readings.axial_static_load_rating(forty, 18731.0), "ISO 76, A.5", 1.0, "whole newtons are printed",
        ),
        compared(
            "worked example: 27 balls of 7.5 mm, 60 degrees, D/dm 0.091", "C_0a", "N", 76049.0,
            readings.static_load_rating(sixty), "ISO 76, A.5",
            76049.0 * (0.0005 * abs(high - low) / 0.01 + PRINT) / 57.82,
            "the example reads f0 at gamma 0.046, where it is 0.0455, between two values of one decimal each",
        ),
    ]  # fmt: skip


def run() -> CaseResult:
    """All printed factors and the worked example."""
    kinds = {
        "radial": (STATIC_RADIAL, factors(np.arange(STATIC_RADIAL.size) / 100, 0.52, 0.53) / 5.0),
        "thrust": (STATIC_THRUST, factors(np.arange(STATIC_THRUST.size) / 100, 0.54, 0.54)),
    }
    rows, points = [], []
    for kind, (printed, computed) in kinds.items():
        worst = int(np.abs(computed - printed).argmax())
        rows.append(
            compared(
                f"all {printed.size} {kind} factors", "f0, worst of them", "N/mm²", printed[worst], computed[worst],
                SOURCE,
                PRINT, WHY, f"gamma = {worst / 100:.2f}",
            )
        )  # fmt: skip
        points += [
            [kind, i / 100, float(one), float(two), float(two - one)]
            for i, (one, two) in enumerate(zip(printed, computed, strict=True))
        ]
    rating = readings.static_load_rating(bearing(27, 7.5, 7.5 / 0.091, 40.0, 0.52, 0.53))
    rows.append(
        compared(
            "worked example: 27 balls of 7.5 mm, 40 degrees, D/dm 0.091", "C_0r", "N", 18731.0, rating, "ISO 76, A.5",
            18731.0 * 0.05 / 16.1, "the example rounds f0 to 16.1",
        )
    )  # fmt: skip
    rows += axial_rows()
    apart = np.concatenate([two - one for one, two in kinds.values()])
    largest = float(np.abs(apart).max())
    panels = []
    for kind, (printed, computed) in kinds.items():
        gamma = np.arange(printed.size) / 100
        panels.append(
            Diagram(
                "D cos α / dₘ", "f₀, N/mm²",
                [Curve("computed", "line", gamma, computed), Curve("printed", "circles", gamma, printed)],
                title=f"{kind} bearings",
            )
        )  # fmt: skip
    gammas = np.concatenate([np.arange(printed.size) / 100 for printed, _ in kinds.values()])
    panels.append(
        Diagram(
            "D cos α / dₘ", "computed minus printed, N/mm²", [Curve("all factors", "dots", gammas, apart)],
            title="difference: rounding", levels=[-PRINT, 0.0, PRINT],
        )
    )  # fmt: skip
    return CaseResult(
        f"All {apart.size} factors, largest deviation {largest:.3f} where one decimal is printed.",
        rows,
        panels,
        ValueTable("Every factor of the table.", ["bearings", "gamma", "printed", "computed", "difference"], points),
    )
