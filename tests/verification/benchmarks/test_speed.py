"""Timings with pytest-benchmark: `pytest tests/verification/benchmarks --benchmark-only`. They pass whatever the time
is."""

from __future__ import annotations

import sys

import pytest

import qsbearing as qs
from tests.verification.benchmarks import scenes
from tests.verification.benchmarks.record import cold_start


@pytest.mark.parametrize("scene", [scenes.thrust(), scenes.combined()], ids=["thrust", "combined"])
def test_one_warm_solve(benchmark, scene: qs.Scene) -> None:
    """One call of `solve`, everything included."""
    assert benchmark(qs.solve, scene).converged


@pytest.mark.parametrize("threads", [1, 2])
def test_hundred_thousand_points(benchmark, threads: int) -> None:
    """100 000 random B218 points in one call."""
    scene = scenes.random_points(100_000)
    solution = benchmark.pedantic(qs.solve, (scene,), {"threads": threads}, rounds=5, warmup_rounds=1)
    assert solution.converged.all()
    assert solution.residual.max() <= 1e-10


@pytest.mark.parametrize("arguments", [["--help"], ["run", "b218"]], ids=["help", "run"])
def test_cold_start(benchmark, arguments: list[str]) -> None:
    """The command in a fresh process, its compiled kernel cached."""
    command = [sys.executable, "-m", "qsbearing", *arguments]
    benchmark.pedantic(cold_start, (command,), rounds=5, warmup_rounds=1)
