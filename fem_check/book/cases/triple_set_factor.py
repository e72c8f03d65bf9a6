"""Two rows against one: the rigidity factors 1.48 and 1.54 of general tables, which the model does not meet."""

from __future__ import annotations

import numpy as np

from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.cases.multiple_sets import PRELOADS_15, ROW_15
from fem_check.book.matched_sets import ground_set

SOURCE = "TPI, CAT. NO. 2260/TE, chapter 5, and a second maker's table"
PRINTED = {"axial": 1.48, "radial": 1.54}
LIGHT = 1e-3
"""Preload of the pair [N]."""


def factors(preload: float) -> dict[str, float]:
    """Rigidities of two rows against one over those of the pair for whose preload the faces are ground."""
    _, *pair = ground_set(1, 1, ROW_15, preload)
    _, *three = ground_set(2, 1, ROW_15, preload)
    return {name: several / two for name, several, two in zip(PRINTED, three, pair, strict=True)}


def run() -> CaseResult:
    """The factor at a light preload, and over the printed preloads."""
    # Ways (F/n)^(2/3) of both sides add up to those of the pair: F = (2/(1 + 2^(-2/3)))^1.5, stiffness n^(2/3) F^(1/3).
    constant_angle = (2.0 / (1.0 + 2.0 ** (-2 / 3))) ** 0.5 * (1.0 + 2.0 ** (2 / 3)) / 2.0
    light, at_each = factors(LIGHT), [factors(float(preload)) for preload in PRELOADS_15]
    rows = []
    for name, printed in PRINTED.items():
        ratios = np.array([each[name] for each in at_each])
        rows += [
            compared("light preload", f"{name} rigidity over that of the pair", "1", constant_angle, light[name],
                     "Hertz at a constant angle, closed form", 1e-4 * constant_angle,
                     "the contact angle turns by 2e-5 of its tangent, of which a rigidity has at most the fifth power"),
            compared(f"preload {PRELOADS_15[0]:.0f} to {PRELOADS_15[-1]:.0f} N",
                     f"{name} rigidity over that of the pair", "1", printed, ratios[np.abs(ratios - printed).argmin()],
                     SOURCE, None,
                     f"a finding: a negative result, the printed factor is not met; computed {ratios.min():.3f} to "
                     f"{ratios.max():.3f}"),
        ]  # fmt: skip
    preloads = np.geomspace(1.0, 1500.0, 9)
    curves = [factors(float(preload)) for preload in preloads]
    return CaseResult(
        f"Two rows against one are {light['axial']:.3f} times as stiff as the pair at a light preload, axially and "
        f"radially; the printed {PRINTED['axial']} and {PRINTED['radial']} are not met at any preload.",
        rows,
        [
            Diagram(
                "preload of the pair, N", "rigidity of the set over it",
                [
                    Curve(name, style, preloads, [each[name] for each in curves])
                    for name, style in zip(PRINTED, ("line", "dashed"), strict=True)
                ],
                x_scale="log", levels=[*PRINTED.values(), constant_angle],
            )
        ],
    )  # fmt: skip
