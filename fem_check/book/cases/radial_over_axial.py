"""The ratio of radial to axial rigidity of pairs, by contact angle and preload."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.matched_sets import pair_rigidities
from fem_check.book.published import bearing

SOURCE = "NSK, super precision bearings, factors of radial rigidity"
STEEL = {"ball_material": qs.STEEL, "ring_material": qs.STEEL}
PRELOADS = {"EL": 145.0, "L": 290.0, "M": 740.0, "H": 1470.0}
"""Of 7014C at 15 degrees [N]."""
BY_PRELOAD = {"EL": 6.5, "L": 6.0, "M": 5.0, "H": 4.5}
"""At 15 degrees, printed in steps of 0.5."""
BY_ANGLE = {18.0: 4.5, 25.0: 2.0, 30.0: 1.4, 40.0: 0.7}
STEP_15, STEP = 0.5, 0.1
NOT_MET = ("EL", 18.0)


def ratios(angle: float) -> NDArray:
    """Radial over axial rigidity at the four preloads."""
    row = bearing(20, 11.906, 90.0, angle, 0.522, 0.522, **STEEL)
    axial, radial = pair_rigidities(row, np.array(list(PRELOADS.values())))
    return np.asarray(radial / axial)


def constant_angle(angle: NDArray) -> NDArray:
    """The same where the contact angle stays what it is."""
    return np.asarray(0.5 / np.tan(np.radians(angle)) ** 2)


def run() -> CaseResult:
    """Each printed factor."""
    by_angle = {angle: ratios(angle) for angle in (15.0, *BY_ANGLE)}
    higher = "a finding: not met, printed higher than computed"
    rows = []
    for (name, printed), value in zip(BY_PRELOAD.items(), by_angle[15.0], strict=True):
        is_met = name not in NOT_MET
        rows.append(
            compared(f"15°, preload {name}, {PRELOADS[name]:.0f} N", "radial over axial rigidity", "1", printed, value,
                     SOURCE, STEP_15 / 2.0 if is_met else None,
                     "half a step: the printed factors at 15 degrees are multiples of 0.5" if is_met else
                     f"{higher}; at a constant angle it would be {constant_angle(np.array(15.0)):.2f}")
        )  # fmt: skip
    for angle, printed in BY_ANGLE.items():
        low, high = by_angle[angle].min(), by_angle[angle].max()
        nearest = float(np.clip(printed, low, high))
        is_met = angle not in NOT_MET
        rows.append(
            compared(f"{angle:.0f}°, {PRELOADS['EL']:.0f} to {PRELOADS['H']:.0f} N",
                     "radial over axial rigidity, nearest of the preloads", "1", printed, nearest, SOURCE,
                     STEP / 2.0 if is_met else None,
                     f"half a step of the printed decimal; computed {low:.2f} to {high:.2f}" if is_met else
                     f"{higher} at any of these preloads, {low:.2f} to {high:.2f}")
        )  # fmt: skip
    angles = np.linspace(14.0, 41.0, 55)
    names = list(by_angle)
    markers = ("dots", "squares", "crosses")
    computed = [
        Curve(f"computed, {name}", marker, names, [by_angle[angle][i] for angle in names])
        for i, (name, marker) in enumerate(zip(PRELOADS, markers, strict=False))
    ]
    printed_at = [15.0] * len(BY_PRELOAD) + list(BY_ANGLE)
    return CaseResult(
        f"At 15 degrees {', '.join(f'{each:.2f}' for each in by_angle[15.0])} with growing preload, printed "
        f"{', '.join(f'{each:g}' for each in BY_PRELOAD.values())}; at 40 degrees "
        f"{by_angle[40.0].min():.2f} to {by_angle[40.0].max():.2f}, printed {BY_ANGLE[40.0]:g}.",
        rows,
        [
            Diagram(
                "contact angle, degrees", "radial over axial rigidity",
                [
                    Curve("constant angle", "line", angles, constant_angle(angles)),
                    *computed,
                    Curve("printed", "circles", printed_at, [*BY_PRELOAD.values(), *BY_ANGLE.values()]),
                ],
                y_scale="log",
            )
        ],
    )  # fmt: skip
