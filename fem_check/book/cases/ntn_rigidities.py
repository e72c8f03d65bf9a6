"""Axial and radial rigidities of NTN's spindle bearings, one groove radius for all of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, ValueTable, compared
from fem_check.book.matched_sets import grooves_that_meet, pair_rigidities
from fem_check.book.published import bearing, columns_of
from fem_check.rows.agreement import AgreementRow
from qsbearing.readings import Rating, dynamic_load_rating

SOURCE = "NTN-SNR, high-precision bearings ULTAGE, pp. 5 and 7"
RATINGS = "NTN-SNR, high-precision bearings ULTAGE, pp. 4 and 6"
STEEL = {"ball_material": qs.STEEL, "ring_material": qs.STEEL}
COEFFICIENT = 0.520
SET_REACH = 1.0
"""What an inferred ball set leaves open [%]: it meets C within as much, and C and rigidity both go as Z^(2/3)."""
FOLLOWING = (
    "7011UCG", "7012UCG", "7014UCG", "7015UCG", "7016UCG", "7017UCG", "7018UCG", "7019UCG", "7020UCG", "7021UCG",
    "7022UCG", "7024UCG", "7026UCG", "7924UCG", "7926UCG",
)  # fmt: skip
"""Sizes whose values at 15 degrees follow the common groove, picked after seeing them."""
BALL_SETS = "ball sets are inferred"
DIRECTIONS = ("axial", "radial")
Table = dict[str, NDArray]


def rounding(printed: NDArray, coarse_from: float, fine: float) -> NDArray:
    """Half a step of printed numbers [%]; from `coarse_from` on they are multiples of 5 where they look it."""
    step = np.where((printed >= coarse_from) & (printed % 5 == 0), 5.0, fine)
    return np.asarray(50.0 * step / printed)


def reach(sizes: Table, angle: int, direction: str) -> NDArray:
    """What rounding may do to a rigidity [%]: its own, and a third of the preload's, as whose cube root it goes."""
    preload = rounding(sizes[f"preload_{angle}_N"], 400.0, 1.0)
    return rounding(sizes[f"{direction}_{angle}_N_um"], 300.0, 0.1) + preload / 3.0


def rows_of(sizes: Table, angle: float, f: ArrayLike = COEFFICIENT) -> qs.BallBearing:
    """The inferred ball sets on the mean diameter."""
    pitch = 0.5 * (sizes["bore_mm"] + sizes["outside_mm"])
    return bearing(sizes["Z_inferred"], sizes["Dw_inferred_mm"], pitch, angle, f, f, **STEEL)


def deviations(sizes: Table, angle: int) -> dict[str, NDArray]:
    """Computed over printed rigidities less one [%], axial and radial."""
    rigidities = pair_rigidities(rows_of(sizes, float(angle)), sizes[f"preload_{angle}_N"])
    return {
        direction: 100.0 * (each / sizes[f"{direction}_{angle}_N_um"] - 1.0)
        for direction, each in zip(DIRECTIONS, rigidities, strict=True)
    }


def own_grooves(sizes: Table) -> tuple[NDArray, NDArray]:
    """Of each size f from its axial rigidity at 15 degrees, and what the radial one with it is off by [%]."""
    preload = sizes["preload_15_N"]
    f = grooves_that_meet(lambda f: rows_of(sizes, 15.0, f), preload, sizes["axial_15_N_um"])
    radial = pair_rigidities(rows_of(sizes, 15.0, f), preload)[1]
    return f, np.asarray(100.0 * (radial / sizes["radial_15_N_um"] - 1.0))


def spread(
    case: str, quantity: str, each: NDArray, bounds: NDArray | None, why: str, names: NDArray
) -> list[AgreementRow]:
    """Mean, root mean square and largest of deviations [%]; bounds: of each, None where they are not met."""
    limit = None if bounds is None else 0.01 * float(np.sqrt((bounds**2).mean()))
    worst = int(np.abs(each).argmax())
    return [
        compared(case, f"{quantity}, {word} deviation", "relative", 0.0, 0.01 * value, SOURCE, within, reason, at)
        for word, value, within, reason, at in (
            ("mean", each.mean(), limit and 0.5 * limit, f"half of {why}" if limit else why, None),
            ("rms", np.sqrt((each**2).mean()), limit, why, None),
            ("largest", each[worst], None, f"a finding: {BALL_SETS}" if limit else why, str(names[worst])),
        )
    ]


def run() -> CaseResult:
    """All sizes with one groove; then those that do not follow it at 15 degrees."""
    sizes = columns_of("ntn_ultage_rigidities")
    names = sizes["name"]
    follows = np.isin(names, FOLLOWING)
    other = {key: values[~follows] for key, values in sizes.items()}
    steep, flat = deviations(sizes, 25), deviations(sizes, 15)
    printed = "root mean square of what rounding of rigidity and preload can do"
    inferred = f"{printed}, and {SET_REACH:g} % for the inferred ball sets"
    rows = []
    for direction in DIRECTIONS:
        case = f"25 degrees, all {names.size} sizes, f = {COEFFICIENT}"
        bounds = reach(sizes, 25, direction) + SET_REACH
        rows += spread(case, f"{direction} rigidity", steep[direction], bounds, inferred, names)
    for direction in DIRECTIONS:
        case = f"15 degrees, {len(FOLLOWING)} sizes, f = {COEFFICIENT}"
        bounds, each = reach(sizes, 15, direction)[follows], flat[direction][follows]
        rows += spread(case, f"{direction} rigidity", each, bounds, printed, names[follows])
    unknown = "a finding: not met, printed stiffer for a reason that is not known"
    for direction in DIRECTIONS:
        each = flat[direction][~follows]
        case = f"15 degrees, the other {each.size} sizes, f = {COEFFICIENT}"
        rows += spread(case, f"{direction} rigidity", each, None, unknown, other["name"])
        rows.append(
            compared(case, f"{direction} rigidity, least deviation", "relative", 0.0, 0.01 * each.max(), SOURCE, None,
                     unknown, str(other["name"][each.argmax()]))
        )  # fmt: skip
    f, apart = own_grooves(other)
    case = f"15 degrees, the other {f.size} sizes, one f each from the axial rigidity"
    why = "a finding: all are on one side, so the radial rigidity is not that of a tighter groove alone"
    rows += spread(case, "radial rigidity", apart, None, why, other["name"])
    rows.append(
        compared(
            case, "f, mean", "1", COEFFICIENT, f.mean(), SOURCE, None, "a finding: tighter grooves than at 25 degrees"
        )
    )
    ratings = 1e-3 * dynamic_load_rating(rows_of(sizes, 15.0), Rating.ISO_281)
    off = sizes["C"] / ratings - 1.0
    rows.append(
        compared("inferred ball sets, 15 degrees", "printed C over that of the set less one, largest", "relative", 0.0,
                 off[np.abs(off).argmax()], RATINGS, None, "a finding: they were inferred from it",
                 str(names[np.abs(off).argmax()]))
    )  # fmt: skip
    panels = [
        Diagram(
            "printed rigidity, N/µm", "computed over printed minus 1, %",
            [
                Curve(direction, style, sizes[f"{direction}_{angle}_N_um"], each[direction])
                for direction, style in zip(DIRECTIONS, ("dots", "squares"), strict=True)
            ],
            title=f"{angle}°", x_scale="log", levels=[0.0],
        )
        for angle, each in ((25, steep), (15, flat))
    ]  # fmt: skip
    rms = {name: np.sqrt((each**2).mean()) for name, each in steep.items()}
    missed = flat["axial"][~follows]
    return CaseResult(
        f"With f = {COEFFICIENT} for all {names.size} sizes, {2 * names.size} rigidities at 25 degrees: axial rms "
        f"{rms['axial']:.2f} %, radial rms {rms['radial']:.2f} %. At 15 degrees {len(FOLLOWING)} sizes follow it; the "
        f"other {missed.size} are computed {-missed.max():.1f} to {-missed.min():.1f} % too soft axially: not met.",
        rows,
        panels,
        ValueTable(
            "Every size: rigidities printed, and what the computed ones are off by.",
            ["size", "axial at 25°, N/µm", "off by, %", "radial at 25°, N/µm", "off by, %",
             "axial at 15°, N/µm", "off by, %", "radial at 15°, N/µm", "off by, %"],
            [
                [str(name), *(value for angle, each in ((25, steep), (15, flat)) for direction in DIRECTIONS
                 for value in (float(sizes[f"{direction}_{angle}_N_um"][i]), f"{each[direction][i]:+.2f}"))]
                for i, name in enumerate(names)
            ],
        ),
    )  # fmt: skip
