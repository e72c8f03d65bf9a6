"""Sets of three and four rows: their preload and rigidity over those of the pair which their faces are ground for."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.matched_sets import ground_set, pair_rigidities
from fem_check.book.published import bearing

TPI = "TPI, CAT. NO. 2260/TE, chapter 5"
NSK = "NSK, ball screw support bearings TAC B, preload C9"
IBC = "IBC, 60 degree bearings BS, TI-I-5010.2/E"
STEEL = {"ball_material": qs.STEEL, "ring_material": qs.STEEL}
ROW_15 = bearing(20, 11.906, 90.0, 15.0, 0.522, 0.522, **STEEL)
ROW_60 = bearing(17, 7.144, 46.0, 60.0, 0.52, 0.52, **STEEL)
PRELOADS_15, PRELOADS_60 = np.array([140.0, 280.0, 750.0, 1455.0]), np.array([2000.0, 3000.0, 4000.0])
"""Of a pair [N]."""
TWICE = 1.2707
"""IBC's rigidity at twice the preload over that at the preload."""


class PrintedRange(NamedTuple):
    """A printed range of a factor, and the set that it is of: rows that carry in one direction and in the other."""

    case: str
    quantity: str
    source: str
    low: float
    high: float
    step: float
    """Of the printed number."""
    row: qs.BallBearing
    preloads: NDArray
    rows: tuple[int, int]
    is_rigidity: bool = False


PRELOAD, RIGIDITY = "preload over that of the pair", "axial rigidity over that of the pair"
FACTORS = (
    PrintedRange("DBT, 15°", PRELOAD, TPI, 1.35, 1.36, 0.01, ROW_15, PRELOADS_15, (2, 1)),
    PrintedRange("DTTB, three against one, 15°", PRELOAD, TPI, 1.60, 1.60, 0.01, ROW_15, PRELOADS_15, (3, 1)),
    PrintedRange("DBB, two against two, 15°", PRELOAD, TPI, 2.0, 2.0, 0.01, ROW_15, PRELOADS_15, (2, 2)),
    PrintedRange("three rows, 60°", PRELOAD, NSK, 1.360, 1.370, 0.001, ROW_60, PRELOADS_60, (2, 1)),
    PrintedRange("three rows, 60°", RIGIDITY, NSK, 1.430, 1.443, 0.001, ROW_60, PRELOADS_60, (2, 1), True),
    PrintedRange("four rows, 60°", PRELOAD, NSK, 2.0, 2.0, 0.01, ROW_60, PRELOADS_60, (2, 2)),
)


def factors(of: PrintedRange) -> NDArray:
    """The factor at each preload."""
    ratios = []
    for preload in of.preloads:
        pair = ground_set(1, 1, of.row, float(preload))
        several = ground_set(*of.rows, of.row, float(preload))
        ratios.append(several[1] / pair[1] if of.is_rigidity else several[0] / float(preload))
    return np.array(ratios)


def run() -> CaseResult:
    """Every printed factor, and how the preload moves it."""
    rows, summary = [], []
    for each in FACTORS:
        ratios = factors(each)
        outside = np.abs(ratios - np.clip(ratios, each.low, each.high))
        printed = f"{each.low:g}" if each.low == each.high else f"{each.low:g} to {each.high:g}"
        rows += [
            compared(each.case, f"{each.quantity}, printed {printed}: how far the nearest preload is outside", "1", 0.0,
                     outside.min(), each.source, each.step / 2.0, "half a step of the printed numbers"),
            compared(each.case, each.quantity, "1", 0.5 * (each.low + each.high), ratios[outside.argmin()], each.source,
                     None, f"a finding: {ratios.min():.4f} to {ratios.max():.4f} over the preloads"),
        ]  # fmt: skip
        if each.rows == (2, 1):
            summary.append(f"{each.case}: {each.quantity} {ratios.min():.3f} to {ratios.max():.3f}, printed {printed}")
    twice = np.array([pair_rigidities(ROW_60, 2.0 * P)[0] / pair_rigidities(ROW_60, P)[0] for P in PRELOADS_60])
    rows.append(
        compared("pair, 60°", "axial rigidity at twice the preload over that at the preload", "1", TWICE, twice[0], IBC,
                 None, f"a finding: {twice.min():.4f} to {twice.max():.4f} over our preloads, 2^(1/3) = 1.2599 at a "
                 "constant angle; the printed bearing's ball set is not known")
    )  # fmt: skip
    shown = {
        "15°": (ROW_15, np.geomspace(50.0, 1500.0, 8), "line"),
        "60°": (ROW_60, np.geomspace(50.0, 4000.0, 8), "dashed"),
    }
    curves = [
        Curve(f"three rows, {name}", style, P, [ground_set(2, 1, row, float(each))[0] / each for each in P])
        for name, (row, P, style) in shown.items()
    ]
    ends = np.array([50.0, 4000.0])
    bands = [Curve("printed, NSK 60°", "band", ends, low=[1.36, 1.36], high=[1.37, 1.37])]
    return CaseResult(
        f"{'; '.join(summary)}.",
        rows,
        [Diagram("preload of the pair, N", "preload of the set over it", [*bands, *curves], x_scale="log")],
    )
