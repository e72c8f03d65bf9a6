"""Static ratings of GMN's hybrid bearings over those of the same bearings with steel balls."""

from __future__ import annotations

import numpy as np

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, ValueTable, compared
from fem_check.book.cases.gmn_rigidities import column
from fem_check.book.published import bearing, gmn_rows
from qsbearing.readings import static_load_rating

SOURCE = "GMN, catalogue 4000 0813 EN, columns C_0 and C_0 of hybrid bearings"
CATALOGUE_STEEL = qs.Material(210e9, 0.3, 7800.0, name="100Cr6")


def run() -> CaseResult:
    """The ratio that Hertz demands, and the printed ones."""
    rows = [row for row in gmn_rows() if "C0_HY" in row]
    printed = column(rows, "C0_HY") / column(rows, "C0")
    computed = {}
    for steel in (qs.STEEL, CATALOGUE_STEEL):
        hybrid, plain = (
            static_load_rating(bearing(15, 12.7, 70.0, 15.0, 0.518, 0.518, ball_material=ball, ring_material=steel))
            for ball in (qs.SILICON_NITRIDE, steel)
        )
        computed[steel.name] = float(hybrid / plain)
    ratio = computed[qs.STEEL.name]
    error = float(printed.std() / np.sqrt(printed.size))
    case = f"{printed.size} bearings: hybrid over steel"
    table = [
        compared(
            case, "C_0, mean", "1", float(printed.mean()), ratio, SOURCE, 3.0 * error,
            "three standard errors of the mean of the printed ratios, each rounded",
        ),
        compared(
            case, "C_0 with the catalogue's own 210 GPa for steel", "1", float(printed.mean()),
            computed[CATALOGUE_STEEL.name], SOURCE, None,
            "a finding: the catalogue's ratings follow from 208 GPa, not from the 210 GPa of its table",
        ),
    ]  # fmt: skip
    order = column(rows, "C0")
    return CaseResult(
        f"Printed ratio {printed.mean():.4f} ± {printed.std():.4f} over {printed.size} bearings, computed {ratio:.4f}.",
        table,
        [
            Diagram(
                "C₀ with steel balls, N", "C₀ hybrid over C₀ steel",
                [
                    Curve("printed", "circles", order, printed),
                    Curve("computed, steel of 208 GPa", "line", [order.min(), order.max()], [ratio, ratio]),
                    Curve("210 GPa", "dashed", [order.min(), order.max()], [computed[CATALOGUE_STEEL.name]] * 2),
                ],
                x_scale="log",
            )
        ],
        ValueTable(
            "Every bearing.", ["bearing", "C_0 N", "C_0 hybrid N", "ratio"],
            [[row["name"].removesuffix(" TA"), row["C0"], row["C0_HY"], row["C0_HY"] / row["C0"]] for row in rows],
        ),
    )  # fmt: skip
