"""Axial rigidities of SNFA's pairs and triple sets: unloading stiffnesses, one groove radius for all."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, ValueTable, compared
from fem_check.book.matched_sets import pair_rigidities, unloading_stiffness
from fem_check.book.published import bearing, columns_of
from fem_check.rows.agreement import AgreementRow

SOURCE = "SNFA, general catalogue, pp. 98-101; rigidity defined on p. 34"
STEEL = {"ball_material": qs.STEEL, "ring_material": qs.STEEL}
COEFFICIENT = 0.5485
INCH_64 = 25.4 / 64.0
"""Millimetres: balls are made in steps of it, and printed to 0.01 mm."""
DEKANEWTON = 10.0
SETS = {"pair": 1, "triple set": 2}
"""Rows that carry the load, against one that it unloads."""
Table = dict[str, NDArray]


def rows_of(sizes: Table, f: float = COEFFICIENT) -> qs.BallBearing:
    """Bearings of one ball count, on the mean diameter."""
    ball = INCH_64 * np.round(sizes["D_mm"] / INCH_64)
    pitch = 0.5 * (sizes["bore_mm"] + sizes["outside_mm"])
    return bearing(int(sizes["Z"][0]), ball, pitch, sizes["alpha_deg"], f, f, **STEEL)


def reach(sizes: Table, printed: NDArray) -> NDArray:
    """What rounding may do to a rigidity [%]: its own, and a third of the preload's, as whose cube root it goes."""
    preload = sizes["preload_daN"]
    step = np.where((preload >= 10.0) & (preload % 1.0 == 0.0), 1.0, 0.1)
    return np.asarray(50.0 * 0.1 / printed + 50.0 * step / preload / 3.0)


def computed(sizes: Table, read_as_tangent: bool = False) -> dict[str, NDArray]:
    """Rigidities of pairs and triple sets [daN/µm]; of pairs alone as tangents at the preload."""
    values = {name: np.empty(sizes["Z"].size) for name in SETS}
    for count in np.unique(sizes["Z"]):  # one call solves sets with as many balls
        of_count = sizes["Z"] == count
        rows = rows_of({key: values[of_count] for key, values in sizes.items()})
        preload = DEKANEWTON * sizes["preload_daN"][of_count]
        for name, carrying in SETS.items():
            stiffness = (
                pair_rigidities(rows, preload)[0] if read_as_tangent else unloading_stiffness(carrying, rows, preload)
            )
            values[name][of_count] = stiffness / DEKANEWTON
    return values


def spread(case: str, each: NDArray, bounds: NDArray, names: NDArray) -> list[AgreementRow]:
    """Mean, root mean square and largest of deviations [%]; bounds: what rounding may do to each."""
    limit = 0.01 * float(np.sqrt((bounds**2).mean()))
    why = "root mean square of what rounding of rigidity and preload can do"
    worst = int(np.abs(each).argmax())
    return [
        compared(case, f"axial rigidity, {word} deviation", "relative", 0.0, 0.01 * value, SOURCE, within, reason, at)
        for word, value, within, reason, at in (
            ("mean", each.mean(), 0.5 * limit, f"half of {why}", None),
            ("rms", np.sqrt((each**2).mean()), limit, why, None),
            ("largest", each[worst], None, "a finding: the largest of so many", str(names[worst])),
        )
    ]


def run() -> CaseResult:
    """All sizes with one groove; what the same numbers would be as tangents."""
    sizes = columns_of("snfa_veb_rigidities")
    printed = {"pair": sizes["pair_daN_um"], "triple set": sizes["triple_daN_um"]}
    values, tangent = computed(sizes), computed(sizes, read_as_tangent=True)["pair"]
    off = {name: 100.0 * (each / printed[name] - 1.0) for name, each in values.items()}
    bounds = {name: reach(sizes, each) for name, each in printed.items()}
    as_tangent = 100.0 * (tangent / printed["pair"] - 1.0)
    rows, panels = [], []
    for angle in (15.0, 25.0):
        here = sizes["alpha_deg"] == angle
        for name in SETS:
            case = f"{name}, {angle:.0f} degrees, {here.sum()} numbers, f = {COEFFICIENT}"
            rows += spread(case, off[name][here], bounds[name][here], sizes["name"][here])
        rows.append(
            compared(f"pair, {angle:.0f} degrees, f = {COEFFICIENT}", "read as a tangent, mean deviation", "relative",
                     0.0, 0.01 * as_tangent[here].mean(), SOURCE, None,
                     "a finding: what is printed is no tangent with this groove")
        )  # fmt: skip
        panels.append(
            Diagram(
                "printed rigidity, daN/µm", "computed over printed minus 1, %",
                [
                    *(Curve(name, style, printed[name][here], off[name][here])
                      for name, style in zip(SETS, ("dots", "squares"), strict=True)),
                    Curve("pair, read as a tangent", "crosses", printed["pair"][here], as_tangent[here]),
                ],
                title=f"{angle:.0f}°", x_scale="log", levels=[0.0],
            )
        )  # fmt: skip
    all_off, all_bounds = (np.concatenate(list(each.values())) for each in (off, bounds))
    within = int((np.abs(all_off) <= all_bounds).sum())
    rms = {name: np.sqrt((each**2).mean()) for name, each in off.items()}
    ratio = (values["triple set"] / values["pair"]).mean()
    return CaseResult(
        f"With f = {COEFFICIENT} for all sizes {within} of {all_off.size} rigidities are met within the rounding of "
        f"what is printed, as unloading stiffnesses: pairs rms {rms['pair']:.2f} %, triple sets "
        f"{rms['triple set']:.2f} %, which are {ratio:.3f} times as stiff. As tangents, pairs would be off by "
        f"{as_tangent.mean():+.1f} % on average.",
        rows,
        panels,
        ValueTable(
            "Every number: rigidities printed, what the computed ones are off by, and what rounding may do.",
            ["size and preload", "angle, deg", "pair, daN/µm", "off by, %", "rounding, %", "triple set, daN/µm",
             "off by, %", "rounding, %"],
            [
                [str(size), int(sizes["alpha_deg"][i]),
                 *(value for name in SETS for value in
                   (float(printed[name][i]), f"{off[name][i]:+.2f}", f"{bounds[name][i]:.2f}"))]
                for i, size in enumerate(sizes["name"])
            ],
        ),
    )  # fmt: skip
