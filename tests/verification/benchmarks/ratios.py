"""The solver's time over that of plain loops, which other machines share: `python -m
tests.verification.benchmarks.ratios FILE`.

Seconds differ between machines; the ratio of two loops in one run differs little. A batch of points, nearly all of it
in the kernel, is set beside a compiled loop of the same kind of work (square roots, angles, multiplications in double
precision); one call of `solve`, nearly all of it Python, beside a loop of plain Python. All are taken in turn, in
processor time, and ratios round by round. What does not depend on the machine at all stands beside: iterations and the
largest residual of the same points.
"""

from __future__ import annotations

import argparse
import json
import math
from functools import partial
from pathlib import Path
from typing import Any

import numba

import qsbearing as qs
from qsbearing.results import provenance
from qsbearing.studies.cost import measuring
from tests.verification.benchmarks import scenes

POINTS = 1000
ROUNDS = {"quick": (10, 1), "release": (30, 3)}
"""Rounds in each process, and fresh processes."""

RATIOS = {"point_over_compiled_loop": ("points", "compiled"), "call_over_python_loop": ("call", "python")}


@numba.njit
def compiled_loop(count: int) -> float:
    """Scalar double precision, each step needing the one before."""
    value = 0.3
    for k in range(count):
        angle = math.atan2(value, 1.0 + value)
        value = math.sqrt(math.cos(angle) + 0.1 * angle * value) / (1.0 + 1e-6 * k)
    return value


class _Point:
    def __init__(self, value: float) -> None:
        self.value = value


def python_loop(count: int) -> float:
    """Objects, a dictionary, calls: what a call of `solve` spends its time on."""
    kept: dict[str, _Point] = {}
    for k in range(count):
        point = _Point(0.5 * k)
        kept[f"{k % 7}"] = point
    return sum(point.value for point in kept.values())


def times(rounds: int) -> measuring.Times:
    """Seconds of each loop, all in turn."""
    batch, one = scenes.random_points(POINTS), scenes.combined()
    calls = {
        "points": partial(qs.solve, batch, threads=1),
        "compiled": partial(compiled_loop, 100_000),
        "call": partial(qs.solve, one, threads=1),
        "python": partial(python_loop, 200),
    }
    return measuring.interleaved(calls, rounds)


def measure(level: str) -> dict[str, Any]:
    """The record."""
    rounds, processes = ROUNDS[level]
    pooled: measuring.Times = {}
    for _ in range(processes):
        for name, values in measuring.in_fresh_process(times, rounds).items():
            pooled.setdefault(name, []).extend(values)
    solution = qs.solve(scenes.random_points(POINTS))
    return {
        "provenance": provenance.of_run(f"python -m tests.verification.benchmarks.ratios --level {level} FILE", level),
        "ratios": {name: measuring.ratio(pooled, *pair) for name, pair in RATIOS.items()},
        "microseconds": {
            "point": measuring.spread([1e6 * value / POINTS for value in pooled["points"]]),
            "call": measuring.spread([1e6 * value for value in pooled["call"]]),
        },
        "points": POINTS,
        "converged": int(solution.converged.sum()),
        "mean_iterations": float(solution.iterations.mean()),
        "largest_residual": float(solution.residual.max()),
    }


def main() -> None:
    """Measure and write."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("file", type=Path)
    parser.add_argument("--level", choices=list(ROUNDS), default="quick")
    asked = parser.parse_args()
    text = json.dumps(measure(asked.level), indent=1) + "\n"
    asked.file.write_text(text, encoding="utf-8")
    print(text, end="")


if __name__ == "__main__":
    main()
