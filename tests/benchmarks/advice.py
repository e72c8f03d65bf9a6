"""Makes the table that `qsbearing run --accuracy` chooses by: `python -m tests.benchmarks.advice`, about two minutes.

Random scenes are solved at every model level that simplifies them. Between neighbours one thing is left out; its error
over its indicator is nearly constant, so the table holds what nearly all scenes stay below, and a margin: once for
scenes in which all balls carry, once where some are about to lose a raceway. A trial on other scenes follows.
"""

from __future__ import annotations

import json
import statistics
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.studies.cost import accuracy, indicators, levels, machine, results
from tests.benchmarks import acceptance, random_scenes

TABLE = Path(qs.__file__).parent / "studies" / "cost" / "advice.json"
SEED = 20_240_601
BATCHES, CASES = 600, 50
TIMED = 100
QUANTILE = 0.999
MARGIN = 1.2

Columns = dict[str, np.ndarray]


def ratios(count: int = BATCHES, size: int = CASES, seed: int = SEED) -> dict[str, Columns]:
    """Indicator, whether some ball is nearly unloaded, and error, of every omission over all scenes where both
    neighbours converge."""
    table: dict[str, dict[str, list[np.ndarray]]] = {name: defaultdict(list) for name in indicators.OMISSIONS}
    for scene in random_scenes.batches(seed, count, size):
        found = levels.simplifications(scene)
        solutions = [qs.solve(simple) for _, simple in found]
        read = [results.read(solution) for solution in solutions]
        for k in range(len(found) - 1):
            (name,) = indicators.omissions(found[k][1], found[k + 1][1])
            indicated, nearly_unloaded = indicators.indicators(scene, solutions[k])
            error = results.accuracy(results.errors(read[k], read[k + 1]))
            both = solutions[k].converged & solutions[k + 1].converged & np.isfinite(error)
            for key, values in (("indicator", indicated[name]), ("nearly_unloaded", nearly_unloaded), ("error", error)):
                table[name][key].append(np.broadcast_to(values, error.shape)[both])
    return {name: {key: np.concatenate(parts) for key, parts in columns.items()} for name, columns in table.items()}


def factor(indicator: np.ndarray, error: np.ndarray) -> float:
    """What the error over the indicator nearly always stays below, and a margin."""
    counts = indicator > 0.0
    quantile = np.quantile(error[counts] / indicator[counts], QUANTILE, method="higher")
    return float(f"{MARGIN * quantile:.3g}")


def factors(found: Columns) -> dict[str, Any]:
    """The table's entry of one omission."""
    near = found["nearly_unloaded"]
    return {
        "scenes": int(near.size),
        "loaded": factor(found["indicator"][~near], found["error"][~near]),
        "nearly_unloaded": factor(found["indicator"][near], found["error"][near]),
    }


def times(count: int = TIMED) -> dict[str, float]:
    """Medians over random scenes: what a ball adds at the actual angle to the time of a solve, over the time of the
    coarsest level; and the first solve of a scene over a repeated one."""
    of_a_ball, first = [], []
    for batch in random_scenes.batches(SEED + 1, count, 3):
        for k in range(3):
            scene = random_scenes.case(batch, k)
            coarsest = levels.simplifications(scene)[0][1]
            coarse = statistics.median(_seconds(coarsest) for _ in range(5))
            solution = qs.solve(coarsest)
            indicators.indicators(scene, solution)  # as `accuracy.choose` does: it leaves little in the caches
            begun, *again = (_seconds(scene) for _ in range(6))
            if scene != coarsest:
                first.append(begun / statistics.median(again))
            if scene.hertz_angle is qs.HertzAngle.ACTUAL and scene.hertz_form is qs.HertzForm.EXACT:
                balls = np.unique(solution.inner.load).size
                of_a_ball.append((statistics.median(again) / coarse - 1.0) / balls)
    return {
        "actual_angle_of_a_ball": float(f"{statistics.median(of_a_ball):.3g}"),
        "first_over_repeated": float(f"{statistics.median(first):.3g}"),
    }


def _seconds(scene: qs.Scene) -> float:
    return qs.solve(scene, threads=1).seconds


def make() -> dict[str, Any]:
    """The whole table."""
    return {
        "made_by": "python -m tests.benchmarks.advice",
        "machine": machine.machine(),
        "quantile": QUANTILE,
        "margin": MARGIN,
        "error_over_indicator": {name: factors(found) for name, found in ratios().items()},
        "time": times(),
    }


def main() -> None:
    """Make the table and keep it, with what a trial on other scenes says of it."""
    print("random scenes at every model level, about a minute ...", file=sys.stderr, flush=True)
    table = make()
    keep(table)
    keep(table | {"trial": acceptance.summary(acceptance.outcomes())})


def keep(table: dict[str, Any]) -> None:
    """Write the table to its place, for this process too."""
    TABLE.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    accuracy.factors.cache_clear()


if __name__ == "__main__":
    main()
