"""Solve every hard case to fifty digits, with its condition, and write `reference.json`:

    python -m tests.verification.hard_cases.generate [NAME ...]

The equations, and all that solves them here, are those of `tests.verification.reference`, which shares no code with the
package. Its search for a start in double precision does not reach the hardest of these cases; there Newton's method at
fifty digits begins where the package's answer stands, and only there: what it ends at is a solution of the reference's
own equations to fifty digits, wherever it began. `start` in the result says which it was.

The condition number is that of the full system at the solution, 4 Z unknowns of the balls and one for each free
channel, in the reference's exact equations: its Jacobian (differenced with steps of half the working digits, so right
to some forty), rows and columns scaled in turn until each has a largest entry of one, then the ratio of its largest to
its smallest singular value.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from mpmath import mp
from numpy.typing import NDArray

import qsbearing as qs
from tests.verification.hard_cases.cases import CASES, CONVERGED
from tests.verification.hard_cases.scenes import exact_case, scene_of
from tests.verification.reference import jones_harris as jh
from tests.verification.reference.generate import as_text
from tests.verification.reference.scenes import Case

REFERENCE = Path(__file__).with_name("reference.json")
DIGITS = 50

Balls = dict[int, list[Any]]


def main(names: list[str]) -> None:
    """Solve the cases one after the other, one line of progress each."""
    known = {entry["case"]["name"]: entry for entry in load_reference()} if REFERENCE.exists() else {}
    entries = []
    for case in CASES:
        if case["expected"] != CONVERGED:
            continue
        if names and case["name"] not in names and known.get(case["name"], {}).get("case") == case:
            entries.append(known[case["name"]])
            continue
        began = time.perf_counter()
        result = solve(case)
        entries.append({"case": case, "result": result})
        print(
            f"{case['name']:40s} residual {result['residual']:10s} condition {result['condition']:.1e} "
            f"start {result['start']:10s} {time.perf_counter() - began:5.1f} s",
            flush=True,
        )
    REFERENCE.write_text(as_text(entries), encoding="utf-8")


def load_reference() -> list[dict[str, Any]]:
    """The stored cases and results: a list of {"case", "result"}."""
    return json.loads(REFERENCE.read_text(encoding="utf-8"))


def solve(case: Case) -> dict[str, Any]:
    """The result as the reference gives it, and beside it `condition` and `start`."""
    with mp.workdps(DIGITS + jh.GUARD_DIGITS):
        exact = exact_case(case)
        per_ball = case["control"] == "per_ball"
        try:
            scene = placed(jh.read_case(exact), case)
            scene, balls, d = jh.settle_control(scene) if per_ball else (scene, *jh.solve_scene(scene))
            start = "own"
        except (ArithmeticError, np.linalg.LinAlgError, NotImplementedError):
            scene, balls, d = from_package(case, exact)
            start = "package"
        jh.refuse_friction_without_contact(scene, balls, d)
        if per_ball and jh.jones_choices(scene, balls, d) != scene.control:
            raise ArithmeticError(f"{case['name']}: the choices are not Jones's")
        with mp.workdps(DIGITS):
            rounded = {ball: [+value for value in x] for ball, x in balls.items()}
            residual = jh.relative_residual(scene, rounded, [+value for value in d])
        if residual > mp.mpf(10) ** -(0.8 * DIGITS):
            raise ArithmeticError(f"{case['name']}: residual {mp.nstr(residual, 3)}")
        result = jh.result_of(scene, balls, d, residual, jones=per_ball)
        for number, ball in enumerate(result["balls"]):
            ball["azimuth"] = jh.text(mp.mpf(case["first_azimuth"]) + 2 * mp.pi * number / scene.ball_count)
        del result["stiffness"]
        return result | {"condition": float(f"{condition(scene, balls, d):.3g}"), "start": start}


def placed(scene: jh.Scene, case: Case) -> jh.Scene:
    """The scene with its first ball where the case puts it."""
    first, count = mp.mpf(float(case["first_azimuth"])), scene.ball_count
    angles = [first + 2 * mp.pi * j / count for j in range(count)]
    return scene if first == 0 else replace(scene, psi=tuple((mp.cos(angle), mp.sin(angle)) for angle in angles))


def from_package(case: Case, exact: Case) -> tuple[jh.Scene, Balls, list[Any]]:
    """Newton's method at full precision from where the package's answer stands."""
    solution = qs.solve(scene_of(case["name"]))
    if not solution.converged:
        raise ArithmeticError(f"{case['name']}: no start")
    if case["control"] == "per_ball":
        assert solution.raceway_control is not None
        exact = exact | {"ball_control": [str(word) for word in solution.raceway_control]}
    scene = placed(jh.read_case(exact), case)
    d = [
        mp.mpf(float(value)) if scene.held[c] is None else scene.held[c]
        for c, value in enumerate(solution.displacement)
    ]
    balls: Balls = {}
    for ball in range(scene.ball_count):
        angle, approach = float(solution.outer.angle[ball]), float(solution.outer.approach[ball])
        if not np.isfinite(angle):
            continue
        reach = scene.Lo + mp.mpf(approach)
        X1, X2 = reach * mp.sin(mp.mpf(angle)), reach * mp.cos(mp.mpf(angle))
        A1, A2 = jh.groove_centre(scene, ball, d)
        balls[ball] = [X1, X2, mp.hypot(A1 - X1, A2 - X2) - scene.Li, mp.mpf(approach)]
    for _ in range(40):
        balls, d = jh.newton_step(scene, balls, d)
        if jh.relative_residual(scene, balls, d) < mp.mpf(10) ** -(mp.dps - 12):
            return scene, balls, d
    raise ArithmeticError(f"{case['name']}: Newton's method did not reach the working precision")


def condition(scene: jh.Scene, balls: Balls, d: list[Any]) -> float:
    """Of the full system at a solution, rows and columns equilibrated."""
    free = scene.free
    order = sorted(balls)
    size = 4 * len(order) + len(free)
    if size == 0:
        return 1.0
    jacobian = np.zeros((size, size), dtype=object)
    jacobian[:] = mp.mpf(0)
    ring = 4 * len(order)
    for place, ball in enumerate(order):
        part = jh.ball_jacobian(scene, ball, balls[ball], d)
        for r in range(9):
            for c in range(9):
                row = 4 * place + r if r < 4 else ring + free.index(r - 4) if r - 4 in free else None
                column = 4 * place + c if c < 4 else ring + free.index(c - 4) if c - 4 in free else None
                if row is not None and column is not None:
                    jacobian[row, column] += part[r, c]
    return float(np.linalg.cond(equilibrated(jacobian)))


def equilibrated(matrix: NDArray) -> NDArray:
    """Rows and columns scaled in turn by the square root of their largest entry, to convergence; then in floats."""
    scaled = np.abs(matrix)
    rows, columns = np.full(len(matrix), mp.mpf(1)), np.full(len(matrix), mp.mpf(1))
    for _ in range(40):
        by_row = np.array([mp.sqrt(row.max()) if row.max() else mp.mpf(1) for row in scaled])
        scaled = scaled / by_row[:, None]
        by_column = np.array([mp.sqrt(column.max()) if column.max() else mp.mpf(1) for column in scaled.T])
        scaled = scaled / by_column
        rows, columns = rows * by_row, columns * by_column
        if max(abs(1 - value) for value in (*by_row, *by_column)) < 1e-3:
            break
    return (matrix / rows[:, None] / columns).astype(float)


if __name__ == "__main__":
    main(sys.argv[1:])
