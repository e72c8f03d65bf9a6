"""Two rows against one: the factor of their rigidity over a pair's, as a tangent and as an unloading stiffness."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.cases.multiple_sets import PRELOADS_15, ROW_15
from fem_check.book.matched_sets import ground_set, unloading_stiffness
from fem_check.book.published import columns_of

SOURCE = "TPI, CAT. NO. 2260/TE, chapter 5, and a second maker's table"
PRINTED = {"axial": 1.48, "radial": 1.54}
CATALOGUE = "SNFA, general catalogue, series VEB, pp. 98-101"
LIGHT = 1e-3
"""Preload of the pair [N]."""


def factors(preload: float) -> dict[str, float]:
    """Rigidities of two rows against one over those of the pair for whose preload the faces are ground."""
    _, *pair = ground_set(1, 1, ROW_15, preload)
    _, *three = ground_set(2, 1, ROW_15, preload)
    return {name: several / two for name, several, two in zip(PRINTED, three, pair, strict=True)}


def unloading_factor(preload: NDArray) -> NDArray:
    """Of unloading stiffnesses, of two rows against one over those of the pair; shape of the preloads [N]."""
    return unloading_stiffness(2, ROW_15, preload) / unloading_stiffness(1, ROW_15, preload)


def printed_factor() -> tuple[float, float]:
    """Of SNFA's triple sets at 25 degrees and the lightest preload, as their numbers are printed: mean, and three
    standard errors that the rounding of each leaves."""
    sizes = columns_of("snfa_veb_rigidities")
    here = (sizes["alpha_deg"] == 25.0) & np.char.endswith(sizes["name"], " L")
    pair, triple = sizes["pair_daN_um"][here], sizes["triple_daN_um"][here]
    ratio = triple / pair
    rounding = 0.1 / np.sqrt(12.0) * ratio * np.hypot(1.0 / pair, 1.0 / triple)
    return float(ratio.mean()), float(3.0 * np.sqrt((rounding**2).sum()) / ratio.size)


def run() -> CaseResult:
    """Both factors at a light preload, and over the printed preloads."""
    # Ways (F/n)^(2/3) of both sides add up to those of the pair: F = (2/(1 + 2^(-2/3)))^1.5, stiffness n^(2/3) F^(1/3).
    constant_angle = (2.0 / (1.0 + 2.0 ** (-2 / 3))) ** 0.5 * (1.0 + 2.0 ** (2 / 3)) / 2.0
    light, at_each = factors(LIGHT), [factors(float(preload)) for preload in PRELOADS_15]
    # The single row goes by F^(2/3), the two by (F/2)^(2/3) at first: they take the load where it lets go.
    unloaded, loose = ((1.0 + 2.0 ** (2 / 3)) / 2.0) ** 1.5, float(unloading_factor(np.array([LIGHT]))[0])
    catalogue, reach = printed_factor()
    rows = [
        compared("light preload", "axial unloading stiffness over that of the pair", "1", unloaded, loose,
                 "Hertz at a constant angle, closed form", 1e-4 * unloaded,
                 "the contact angle turns by 2e-5 of its tangent"),
        compared("light preload", "axial unloading stiffness over that of the pair, printed", "1", catalogue, loose,
                 CATALOGUE, reach, "three standard errors of the mean of eleven printed ratios, each rounded"),
        compared("light preload", "axial unloading stiffness over that of the pair, general tables", "1",
                 PRINTED["axial"], loose, SOURCE, None,
                 "a finding: how these tables define the factor is not said"),
    ]  # fmt: skip
    for name, printed in PRINTED.items():
        ratios = np.array([each[name] for each in at_each])
        rows += [
            compared("light preload", f"{name} rigidity over that of the pair", "1", constant_angle, light[name],
                     "Hertz at a constant angle, closed form", 1e-4 * constant_angle,
                     "the contact angle turns by 2e-5 of its tangent, of which a rigidity has at most the fifth power"),
            compared(f"preload {PRELOADS_15[0]:.0f} to {PRELOADS_15[-1]:.0f} N",
                     f"{name} rigidity over that of the pair", "1", printed, ratios[np.abs(ratios - printed).argmin()],
                     SOURCE, None,
                     f"a finding: as a tangent it is not the printed factor; computed {ratios.min():.3f} to "
                     f"{ratios.max():.3f}"),
        ]  # fmt: skip
    preloads = np.geomspace(1.0, 1500.0, 9)
    curves = [factors(float(preload)) for preload in preloads]
    return CaseResult(
        f"As unloading stiffness, two rows against one are {loose:.3f} times as stiff as the pair at a light preload, "
        f"and SNFA's printed numbers are {catalogue:.3f} times those of pairs; as tangents {light['axial']:.3f} times, "
        f"axially and radially. The axial {PRINTED['axial']} of general tables is the former within "
        f"{100.0 * (PRINTED['axial'] / loose - 1.0):.1f} %; their radial {PRINTED['radial']} is neither.",
        rows,
        [
            Diagram(
                "preload of the pair, N", "rigidity of the set over it",
                [
                    Curve(name, style, preloads, [each[name] for each in curves])
                    for name, style in zip(PRINTED, ("line", "dashed"), strict=True)
                ] + [Curve("axial, unloading", "crosses", preloads, unloading_factor(preloads))],
                x_scale="log", levels=[*PRINTED.values(), constant_angle, unloaded],
            )
        ],
    )  # fmt: skip
