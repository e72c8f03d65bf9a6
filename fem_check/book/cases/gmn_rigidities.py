"""Axial rigidities of GMN's spindle bearings: groove radius from the flat contact angle, the steep one predicted."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, ValueTable, compared
from fem_check.book.matched_sets import pair_rigidities
from fem_check.book.published import bearing, gmn_rows
from qsbearing.readings import static_load_rating

SOURCE = "GMN, catalogue 4000 0813 EN, columns F_v and C_ax"
STEEL = {"ball_material": qs.STEEL, "ring_material": qs.STEEL}
PRELOADS = "LMS"
LEAST_RIGIDITY, LARGEST_FIT = 80.0, 0.9
"""Selection on the flat rows alone: printed C_ax at heavy preload [N/µm], rms of the fit [%]."""

Rows = list[dict[str, Any]]


def rigidity(rows: Rows, f: NDArray) -> NDArray:
    """C_ax of the back-to-back pair at its three preloads [N/µm], shape (row, preload).

    Twice one bearing's tangent stiffness, its contact angle free to change: the catalogue does not define C_ax, and of
    the readings tried this one follows the printed values.
    """
    Z, D, dm, angle = (column(rows, key)[:, None] for key in ("Z", "Dw_mm", "dm_mm", "alpha_deg"))
    preload = columns(rows, "Fv")
    grooves = bearing(Z, D, dm, angle, f[:, None], f[:, None], **STEEL)
    return pair_rigidities(grooves, preload)[0]


def fitted_groove(rows: Rows) -> NDArray:
    """f = r/D, equal in both rings, that meets a row's three rigidities in the least squares of relative deviations."""
    f, printed, step = np.full(len(rows), 0.522), columns(rows, "Cax"), 1e-5
    for _ in range(12):  # Gauss and Newton's method; five steps reach rounding
        residual = rigidity(rows, f) / printed - 1.0
        slope = (rigidity(rows, f + step) / printed - 1.0 - residual) / step
        change = -(residual * slope).sum(axis=1) / (slope**2).sum(axis=1)
        f = np.clip(f + change, 0.504, 0.6)
        if np.abs(change).max() < 1e-9:
            break
    return f


def groove_of_static_rating(rows: Rows) -> NDArray:
    """f of the raceway that governs the printed C0 at 4200 MPa: no stiffness enters."""
    Z, D, dm, angle, printed = (column(rows, key) for key in ("Z", "Dw_mm", "dm_mm", "alpha_deg", "C0"))
    low, high = np.full(len(rows), 0.502), np.full(len(rows), 0.60)
    for _ in range(30):  # a wider groove carries less
        f = 0.5 * (low + high)
        carries = static_load_rating(bearing(Z, D, dm, angle, f, f, **STEEL)) > printed
        low, high = np.where(carries, f, low), np.where(carries, high, f)
    return 0.5 * (low + high)


def column(rows: Rows, key: str) -> NDArray:
    """One column of the catalogue."""
    return np.array([row[key] for row in rows])


def columns(rows: Rows, key: str) -> NDArray:
    """Three columns, of light, medium and heavy preload."""
    return np.array([[row[f"{key}{preload}"] for preload in PRELOADS] for row in rows])


def rounding(printed: NDArray) -> NDArray:
    """Half a step of the printed values [%]: 1 N/µm, above 200 to 250 N/µm mostly 5."""
    step = np.where(printed % 5 == 0, np.where(printed > 200, 5.0, 1.0), 1.0)
    return np.asarray(50.0 * step / printed)


def run() -> CaseResult:
    """Fit the flat rows, predict the steep ones."""
    every = gmn_rows()
    steep = {row["name"]: row for row in every if row["alpha_deg"] == 25.0}
    pairs = [
        (row, steep[name])
        for row in every
        if (name := row["name"].replace(" C ", " E ")) in steep and row["CaxS"] >= 40
    ]
    pairs = [(flat, other) for flat, other in pairs if flat is not other]
    flat, other = [one for one, _ in pairs], [two for _, two in pairs]
    f = fitted_groove(flat)
    fit = 100.0 * np.sqrt(((rigidity(flat, f) / columns(flat, "Cax") - 1.0) ** 2).mean(axis=1))
    predicted, printed = rigidity(other, f), columns(other, "Cax")
    deviation = 100.0 * (predicted / printed - 1.0)
    # What rounding may do: that of the value itself, and the largest of the three that f was fitted to.
    reach = rounding(printed) + rounding(columns(flat, "Cax")).max(axis=1)[:, None]

    is_s = np.array([row["name"].startswith("S") for row in flat])
    stiff = column(flat, "CaxS") >= LEAST_RIGIDITY
    judged = stiff & (fit <= LARGEST_FIT)
    rows = []
    groups = {
        "series S, 15 to 25 degrees": (judged & is_s, True),
        "series KH, 17 to 25 degrees": (judged & ~is_s, True),
        "series S, whatever the quality of the fit": (stiff & is_s, False),
        "series S, C_ax from 40 N/µm, whatever the fit": (is_s, False),
        "series KH, C_ax from 40 N/µm, whatever the fit": (~is_s, False),
    }
    for name, (chosen, gated) in groups.items():
        each, limit = deviation[chosen], float(np.sqrt((reach[chosen] ** 2).mean()))
        case = f"{name}: {int(chosen.sum())} bearings, {each.size} values predicted"
        why = "what the rounding of the printed values alone can do, root mean square of its bounds"
        for quantity, value, bound, reason in (
            ("mean deviation", each.mean(), 0.5 * limit, f"half of {why}"),
            ("rms deviation", np.sqrt((each**2).mean()), limit, why),
            (
                "largest deviation",
                each.flat[np.abs(each).argmax()],
                None,
                "a finding: single rows may be of another program",
            ),
            ("median absolute deviation", np.median(np.abs(each)), None, "a finding: of the same values"),
        ):
            tolerance = 0.01 * bound if gated and bound else None
            rows.append(compared(case, quantity, "relative", 0.0, 0.01 * value, SOURCE, tolerance, reason))
    f0 = groove_of_static_rating(flat)
    apart = (f - f0)[judged & is_s]
    rows.append(
        compared(
            "groove of the rigidities beside that of the printed static rating, series S",
            "mean difference of f", "1", 0.0015, apart.mean(), f"{SOURCE}, C_0", 0.001,
            "regression, no document states it: half of what the outer groove is wider than the inner, which alone "
            "governs C_0; 2 % of E' would move it by 0.0017",
        )
    )  # fmt: skip
    best = deviation[judged & is_s]
    points = [
        [one["name"].removesuffix(" TA"), f"{f[i]:.5f}", f"{f0[i]:.5f}", f"{fit[i]:.2f}", "yes" if judged[i] else "no",
         *map(float, printed[i]), *(f"{each:+.2f}" for each in deviation[i])]
        for i, one in enumerate(flat)
    ]  # fmt: skip
    kh = deviation[judged & ~is_s]
    return CaseResult(
        f"{int((judged & is_s).sum())} bearings of series S, {best.size} rigidities predicted: mean {best.mean():+.2f} "
        f"%, rms {np.sqrt((best**2).mean()):.2f} %, largest {np.abs(best).max():.2f} %. Series KH: {len(kh)} bearings, "
        f"rms {np.sqrt((kh**2).mean()):.2f} %.",
        rows,
        [
                Diagram(
                    "printed rigidity, N/µm", "predicted over printed minus 1, %",
                    [
                        Curve("series S", "dots", printed[is_s].ravel(), deviation[is_s].ravel()),
                        Curve("series KH", "squares", printed[~is_s].ravel(), deviation[~is_s].ravel()),
                    ],
                    title="rigidities predicted at 25°", x_scale="log", levels=[0.0],
                ),
                Diagram(
                    "f from the printed static rating", "f from the rigidities",
                    [
                        Curve("series S", "dots", f0[is_s], f[is_s]),
                        Curve("series KH", "squares", f0[~is_s], f[~is_s]),
                        Curve("equal", "dashed", [0.512, 0.565], [0.512, 0.565]),
                    ],
                    title="groove radii over D",
                ),
            ],
        ValueTable(
            "All bearings with C_ax of at least 40 N/µm at the flat angle and heavy preload. The three rigidities at "
            "25 degrees are printed ones, at light, medium and heavy preload; judged: those of the "
            "rows above that have a tolerance.",
            ["bearing", "f fitted", "f of C_0", "rms of fit, %", "judged", "C_ax light, N/µm", "medium", "heavy",
             "predicted is off by, %", "medium, %", "heavy, %"],
            points,
        ),
    )  # fmt: skip
