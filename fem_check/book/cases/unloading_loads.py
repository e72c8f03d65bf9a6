"""Limiting axial loads of preloaded sets: TPI's factors for sets of two to four rows, FAG's forces of two pairs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.matched_sets import grooves_that_meet, unloading_load
from fem_check.book.published import bearing

TABLE = "TPI, CAT. NO. 2260/TE, table 5.8"
FORCES = "FAG, super precision bearings, table of the bearing"
STEEL = {"ball_material": qs.STEEL, "ring_material": qs.STEEL}
LIGHT, HEAVY = 1e-3, 490.0
"""Preloads [N]."""


class Arrangement(NamedTuple):
    """Contact angles of the rows that carry the load and of those that it relieves; the printed factor."""

    name: str
    carrying: tuple[float, ...]
    relieved: tuple[float, ...]
    printed: float
    is_met: bool = True
    """Whether the printed digits are met at a light preload."""


ARRANGEMENTS = (
    Arrangement("DB, 15°", (15,), (15,), 2.83),
    Arrangement("one 25° against one 15°", (25,), (15,), 5.90),
    Arrangement("one 15° against one 25°", (15,), (25,), 1.75, False),
    Arrangement("DBT, two against one", (15, 15), (15,), 4.16),
    Arrangement("DBT, one against two", (15,), (15, 15), 2.08),
    Arrangement("two 25° against one 15°", (25, 25), (15,), 9.85),
    Arrangement("one 15° against two 25°", (15,), (25, 25), 1.45),
    Arrangement("DTTB, three against one", (15, 15, 15), (15,), 5.40, False),
    Arrangement("DTTB, one against three", (15,), (15, 15, 15), 1.80),
    Arrangement("three 25° against one 15°", (25, 25, 25), (15,), 13.66, False),
    Arrangement("one 15° against three 25°", (15,), (25, 25, 25), 1.33),
)


class Pair(NamedTuple):
    """One of FAG's pairs: ball count, ball and pitch diameter [mm]; printed preload, rigidity and unloading force."""

    name: str
    Z: int
    D: float
    dm: float
    preload: float
    rigidity: float
    force: float


PAIRS = (
    Pair("B7012C", 18, 11.112, 77.5, 211.0, 64.5, 658.0),
    Pair("B7015C", 19, 12.7, 95.0, 283.0, 76.8, 880.0),
)


def row(angle: float) -> qs.BallBearing:
    """A row of TPI's 7014 size."""
    return bearing(20, 11.906, 90.0, angle, 0.522, 0.522, **STEEL)


def factor(of: Arrangement, preload: float) -> float:
    """Limiting load over preload."""
    return unloading_load([row(a) for a in of.carrying], [row(a) for a in of.relieved], preload) / preload


def constant_angle(of: Arrangement) -> float:
    """The same by Hertz at constant contact angles, where a row's way goes as (F/n)^(2/3) sin(alpha)^(-5/3)."""
    way = [len(rows) ** (-2 / 3) * np.sin(np.radians(rows[0])) ** (-5 / 3) for rows in (of.carrying, of.relieved)]
    return float((1.0 + way[1] / way[0]) ** 1.5)


def force(of: Pair) -> float:
    """Unloading force with the groove radius of the printed rigidity [N]."""

    def set_of(f: float) -> qs.BallBearing:
        return bearing(of.Z, of.D, of.dm, 15.0, f, f, **STEEL)

    f = float(grooves_that_meet(set_of, of.preload, np.array(of.rigidity)))  # type: ignore[arg-type]
    return unloading_load([set_of(f)], [set_of(f)], of.preload)


def run() -> CaseResult:
    """Factors at a light preload, how they grow with it, and FAG's forces."""
    rows = []
    for each in ARRANGEMENTS:
        missed = (
            f"a finding: the printed digit is not met, nor by Hertz at a constant angle, {constant_angle(each):.3f}"
        )
        rows.append(
            compared(f"{each.name}, light preload", "limiting load over preload", "1", each.printed,
                     factor(each, LIGHT), TABLE, 0.005 if each.is_met else None,
                     "two decimals are printed" if each.is_met else missed)
        )  # fmt: skip
    heavy = factor(ARRANGEMENTS[0], HEAVY)
    rows.append(
        compared(f"DB, 15°, preload {HEAVY:.0f} N", "limiting load over preload", "1", ARRANGEMENTS[0].printed, heavy,
                 TABLE, None, "a finding: the printed factor is that of light preloads")
    )  # fmt: skip
    forces = [force(pair) for pair in PAIRS]
    for pair, value in zip(PAIRS, forces, strict=True):
        case = f"{pair.name} DB, preload {pair.preload:.0f} N"
        rows += [
            compared(case, "unloading force", "N", pair.force, value, FORCES, None,
                     "a finding: below the printed force by more than its rounding"),
            compared(case, "unloading force by Hertz at a constant angle", "N", pair.force,
                     2.0**1.5 * pair.preload, FORCES, None, "a finding: the opening angle is most of the difference"),
        ]  # fmt: skip
    preloads = np.geomspace(1.0, 1500.0, 9)
    shown = ("DB, 15°", "DBT, two against one", "one 25° against one 15°")
    chosen = [each for each in ARRANGEMENTS if each.name in shown]
    return CaseResult(
        f"{sum(each.is_met for each in ARRANGEMENTS)} of {len(ARRANGEMENTS)} printed factors are met to the digit at a "
        f"light preload; at {HEAVY:.0f} N a pair of 15 degrees has {heavy:.2f}. FAG's forces come out "
        f"{' and '.join(f'{100 * (value / pair.force - 1):.1f}' for pair, value in zip(PAIRS, forces, strict=True))} % "
        "off.",
        rows,
        [
            Diagram(
                "preload, N", "limiting load over preload",
                [
                    Curve(each.name, style, preloads, [factor(each, preload) for preload in preloads])
                    for each, style in zip(chosen, ("line", "dashed", "dots"), strict=True)
                ],
                x_scale="log", levels=[each.printed for each in chosen],
            )
        ],
    )  # fmt: skip
