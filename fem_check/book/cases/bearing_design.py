"""The "rolling element bearing design" benchmark of constrained optimisation: D 160, d 90, Bw 30 mm, ten variables."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fem_check.book.case import CaseResult, Curve, Diagram, ValueTable, compared
from qsbearing.studies.design.optimum import search
from qsbearing.studies.design.problem import Condition, SearchProblem, Variable

SOURCE = "Gupta, Tiwari & Nair 2007; Kumar et al. 2020, problem 2.3.14"
D, d, BW = 160.0, 90.0, 30.0
BOUNDS = {
    "Dm": (0.5 * (D + d), 0.6 * (D + d)), "Db": (0.15 * (D - d), 0.45 * (D - d)), "fi": (0.515, 0.6),
    "fo": (0.515, 0.6), "KDmin": (0.4, 0.5), "KDmax": (0.6, 0.7), "eps": (0.3, 0.4), "e": (0.02, 0.1),
    "zeta": (0.6, 0.85),
}  # fmt: skip
LIMITS = ("assembly", "least ball", "largest ball", "width", "pitch", "eccentricity", "wall")
PRINTED = {
    "Dm": 125.7191, "Db": 21.42559, "fi": 0.515, "fo": 0.515, "KDmin": 0.424266, "KDmax": 0.633948, "eps": 0.3,
    "e": 0.068858, "zeta": 0.799498, "Z": 11.0,
}  # fmt: skip
"""The first two and the last are the design; the others only have to leave it feasible."""
PRINTED_CAPACITY = 81859.7
ELSEWHERE = {"81,843.3, the optimum that the problem's collection states": 81843.3, "85,549.2": 85549.2}
COUNTS = range(8, 15)

PROBLEM = SearchProblem(
    (*(Variable(key, *ends) for key, ends in BOUNDS.items()), Variable("Z", 4, 50, values=tuple(range(4, 51)))),
    tuple(Condition(name, ">=", 0.0) for name in LIMITS),
    "capacity",
    True,
)


def capacity(x: NDArray) -> NDArray:
    """Limits (>= 0), then the dynamic capacity [N]; x in the order of PROBLEM's variables, shape (point, 10)."""
    Dm, Db, fi, fo, k_min, k_max, eps, e, zeta, Z = x.T
    gamma = Db / Dm
    ratio = 1.04 * ((1 - gamma) / (1 + gamma)) ** 1.72 * (fi * (2 * fo - 1) / (fo * (2 * fi - 1))) ** 0.41
    fc = (
        37.91 * (1 + ratio ** (10 / 3)) ** -0.3
        * gamma**0.3 * (1 - gamma) ** 1.39 / (1 + gamma) ** (1 / 3) * (2 * fi / (2 * fi - 1)) ** 0.41
    )  # fmt: skip
    dynamic_capacity = np.where(Db <= 25.4, fc * Z ** (2 / 3) * Db**1.8, 3.647 * fc * Z ** (2 / 3) * Db**1.4)
    T = D - d - 2 * Db
    inside, outside = (D - d) / 2 - 3 * T / 4, D / 2 - T / 4 - Db
    cosine = (inside**2 + outside**2 - (d / 2 + T / 4) ** 2) / (2 * inside * outside)
    filled = 2 * np.pi - 2 * np.arccos(np.clip(cosine, -1, 1))
    limits = (
        filled / (2 * np.arcsin(np.clip(gamma, 0, 1))) + 1 - Z, 2 * Db - k_min * (D - d), k_max * (D - d) - 2 * Db,
        zeta * BW - Db, Dm - 0.5 * (D + d), (0.5 + e) * (D + d) - Dm, 0.5 * (D - Dm - Db) - eps * Db,
    )  # fmt: skip
    return np.column_stack([*limits, dynamic_capacity])


def best_with(count: int) -> tuple[float, bool]:
    """The largest capacity [N] with so many balls, and whether the limits allow any."""
    variables = (*PROBLEM.variables[:-1], Variable("Z", count, count, values=(float(count),)))
    best = search(replace(PROBLEM, variables=variables), capacity, 1 << 13)
    return float(best.results[-1]), best.is_feasible


def run() -> CaseResult:
    """The printed design by its own formula, and the search for the best."""
    printed = capacity(np.array([[PRINTED[each.key] for each in PROBLEM.variables]]))[0, -1]
    best = search(PROBLEM, capacity, 1 << 14)
    values = dict(zip((each.key for each in PROBLEM.variables), map(float, best.values), strict=True))
    largest = float(best.results[-1])
    by_count = {count: best_with(count) for count in COUNTS}
    rows = [
        compared(
            "the printed design", "Cd by the problem's formula", "N", PRINTED_CAPACITY, printed, SOURCE, 0.05,
            "one decimal is printed",
        ),
        compared(
            "the design found", "Cd", "N", PRINTED_CAPACITY, largest, SOURCE, 0.3,
            "one decimal is printed; limits met to 1e-6 of their spread move it by up to 0.2 N",
        ),
        compared("the design found", "ball diameter", "mm", PRINTED["Db"], values["Db"], SOURCE, 1e-4, "as above"),
        compared("the design found", "ball count", "balls", PRINTED["Z"], values["Z"], SOURCE, 0.0, "a whole number"),
        *(
            compared("the design found", f"Cd, {words}", "N", other, largest, "printed elsewhere", None, "a finding")
            for words, other in ELSEWHERE.items()
        ),
    ]  # fmt: skip
    counts = [count for count, (_, is_feasible) in by_count.items() if is_feasible]
    curve = [by_count[count][0] / 1e3 for count in counts]
    panel = Diagram(
        "number of balls", "largest dynamic capacity, kN",
        [
            Curve("found", "line", counts, curve),
            Curve("printed design", "circles", [PRINTED["Z"]], [PRINTED_CAPACITY / 1e3]),
        ],
    )  # fmt: skip
    return CaseResult(
        f"The search finds {largest:.1f} N with {values['Z']:.0f} balls of {values['Db']:.4f} mm; printed are "
        f"{PRINTED_CAPACITY} N with {PRINTED['Z']:.0f} balls of {PRINTED['Db']} mm.",
        rows,
        [panel],
        ValueTable(
            "The largest capacity with each number of balls.", ["balls", "Cd, N"],
            [[count, by_count[count][0]] for count in counts],
        ),
    )  # fmt: skip
