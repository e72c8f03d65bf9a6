"""TPI's 7014C: axial rigidities of the pair, and the only printed displacements of a catalogue that are known here."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.matched_sets import grooves_that_meet, pair_rigidities, under_thrust
from fem_check.book.published import bearing

SOURCE = "TPI, CAT. NO. 2260/TE, table of 7014C"
STEEL = {"ball_material": qs.STEEL, "ring_material": qs.STEEL}
PRELOADS = np.array([140.0, 280.0, 750.0, 1455.0])
RIGIDITIES = np.array([67.0, 88.0, 136.0, 188.0])
OFFSETS = np.array([-7.0, -14.0, -30.0, -48.0])
"""Of the faces of the pair under MEASURED_AT [µm]."""
MEASURED_AT = 49.0
FITTED = 1
"""Which of the rigidities gives f."""
PRELOAD_STEP, HALF = 5.0, 0.5
"""Preloads are printed in steps of 5 N, the others in whole numbers."""


def row(f: ArrayLike) -> qs.BallBearing:
    """The inferred ball set."""
    return bearing(20, 11.906, 90.0, 15.0, f, f, **STEEL)


def fitted(rigidity: float) -> float:
    """f that meets this rigidity at the fitted preload."""
    return float(grooves_that_meet(row, PRELOADS[FITTED], np.array(rigidity)))


def offsets(f: float, preload: ArrayLike) -> NDArray:
    """What each pair of faces must be ground off so that it closes under the preload, under MEASURED_AT [µm]."""
    ways = np.asarray(under_thrust(row(f), np.append(np.asarray(preload, float), MEASURED_AT)).displacement)[:, 0]
    return np.asarray(-2e6 * (ways[:-1] - ways[-1]))


def run() -> CaseResult:
    """Rigidities and offsets with one f."""
    f = fitted(RIGIDITIES[FITTED])
    ends = [fitted(RIGIDITIES[FITTED] + each) for each in (-HALF, HALF)]
    rigidity, offset = pair_rigidities(row(f), PRELOADS)[0], offsets(f, PRELOADS)
    # What the rounding of the fitted value and of the preloads does to the others, added to their own.
    of_fit = [np.abs(each(ends[0]) - each(ends[1])) / 2.0 for each in (
        lambda f: pair_rigidities(row(f), PRELOADS)[0], lambda f: offsets(f, PRELOADS),
    )]  # fmt: skip
    shifted = PRELOADS + PRELOAD_STEP / 2.0
    of_preload = np.abs(pair_rigidities(row(f), shifted)[0] - rigidity), np.abs(offsets(f, shifted) - offset)
    why = "half a step of the printed value, of its preload, and of the rigidity that f is fitted to"
    rows = []
    for i, preload in enumerate(PRELOADS):
        case = f"7014C DB, preload {preload:.0f} N"
        if i == FITTED:
            rows.append(
                compared(case, "f that meets the printed rigidity", "1", 0.52, f, SOURCE, None, "a finding: fitted")
            )
        else:
            rows.append(
                compared(case, "axial rigidity", "N/µm", RIGIDITIES[i], rigidity[i], SOURCE,
                         HALF + of_fit[0][i] + of_preload[0][i], why)
            )  # fmt: skip
        rows.append(
            compared(case, f"offset of the faces under {MEASURED_AT:.0f} N", "µm", OFFSETS[i], offset[i], SOURCE,
                     HALF + of_fit[1][i] + of_preload[1][i], why)
        )  # fmt: skip
    loads = np.linspace(60.0, 1500.0, 49)
    return CaseResult(
        f"With f = {f:.4f} from one rigidity the pair has {', '.join(f'{each:.1f}' for each in rigidity)} N/µm and "
        f"offsets of {', '.join(f'{each:.1f}' for each in offset)} µm.",
        rows,
        [
            Diagram(
                "preload, N", label,
                [Curve("computed", "line", loads, curve), Curve("printed", "circles", PRELOADS, printed)],
            )
            for label, curve, printed in (
                ("axial rigidity of the pair, N/µm", pair_rigidities(row(f), loads)[0], RIGIDITIES),
                ("offset of the faces, µm", offsets(f, loads), OFFSETS),
            )
        ],
    )  # fmt: skip
