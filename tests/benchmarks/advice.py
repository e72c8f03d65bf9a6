"""Makes the table that `qsbearing run --accuracy` chooses by: `python -m tests.benchmarks.advice`.

Random scenes are solved at every fidelity that simplifies them. Between neighbours one thing is left out; its error
over its indicator is nearly constant, so the table holds, for each half decade of the indicator, what nearly all scenes
stay below, and a margin: once for scenes in which all balls carry, once where some are about to lose a raceway.
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
from qsbearing.cost import accuracy, answers, indicators, ladder, machine, measuring, pace
from tests.benchmarks import acceptance, random_scenes

TABLE = Path(qs.__file__).parent / "cost" / "advice.json"
SEED = 20_240_601
BATCHES, CASES = 600, 50
TIMED, FRESH = 220, 15
QUANTILES = {"before": 0.98, "after": 0.995}
"""What is judged before solving is judged again afterwards, so that it may err more often."""
MARGIN = 1.2
EDGES = np.logspace(-6.0, 1.0, 15)
FEWEST = 100
"""Scenes in a half decade for a quantile of one in 200 to mean anything; with fewer it joins its neighbours."""

Columns = dict[str, list[np.ndarray]]


def ratios(count: int = BATCHES) -> dict[str, Columns]:
    """Indicators before and after solving, and errors, of every omission over all scenes."""
    table: dict[str, Columns] = {one.name: defaultdict(list) for one in indicators.OMISSIONS}
    for scene in random_scenes.batches(SEED, count, CASES):
        ways = ladder.ways(scene)
        solutions = [qs.solve(simple) for _, simple in ways]
        read = [answers.read(simple, found) for (_, simple), found in zip(ways, solutions, strict=True)]
        judge = indicators.Judge(scene)
        estimate = indicators.estimated(judge)
        for k in range(len(ways) - 1):
            (one,) = indicators.omissions(ways[k][1], ways[k + 1][1])
            judged = answers.accuracy(answers.errors(read[k], read[k + 1]))
            both = solutions[k].converged & solutions[k + 1].converged
            columns = table[one.name]
            for when, contacts in (("before", estimate), ("after", indicators.found(judge, solutions[k]))):
                columns[when].append(np.broadcast_to(one.indicator(judge, contacts), judged.shape)[both])
                columns[f"{when} touching"].append(np.broadcast_to(contacts.touches, judged.shape)[both])
            columns["error"].append(judged[both])
    return table


def bounds(found: Columns) -> dict[str, Any]:
    """Error over indicator by half decades of the indicator: what nearly all scenes stay below."""
    columns = {name: np.concatenate(parts) for name, parts in found.items()}
    error = columns["error"]
    entry: dict[str, Any] = {"scenes": int(error.size), "indicator": [float(f"{edge:.4g}") for edge in EDGES]}
    for when in ("before", "after"):
        touching = columns[f"{when} touching"]
        entry[when] = {
            "loaded": factors(columns[when][~touching], error[~touching], QUANTILES[when]),
            "touching": factors(columns[when][touching], error[touching], QUANTILES[when]),
        }
    return entry


def factors(indicator: np.ndarray, error: np.ndarray, quantile: float) -> list[float | None]:
    """The factor of each half decade; None where it promises nothing, an error of the whole answer or more."""
    place = np.searchsorted(EDGES, indicator)
    column: list[float | None] = []
    for k, edge in enumerate(EDGES):
        for reach in range(len(EDGES)):
            chosen = (np.abs(place - k) <= reach) & (indicator > 0.0)
            if chosen.sum() >= FEWEST:
                break
        factor = MARGIN * float(np.quantile(error[chosen] / indicator[chosen], quantile, method="higher"))
        column.append(float(f"{factor:.3g}") if factor * edge < 1.0 else None)
    return column


def seconds(count: int = TIMED) -> dict[str, Any]:
    """Time of a ball by kind, in units of the two reference solves made beside it: medians over random scenes."""
    rows: list[tuple[str, float, float, float]] = []
    for scene in random_scenes.batches(SEED + 1, count, 3):
        here = pace.calibration(3)
        for k in range(3):
            for _, simple in ladder.ways(random_scenes.case(scene, k)):
                times = [pace.timed(lambda simple=simple: qs.solve(simple, threads=1)) for _ in range(3)]
                arithmetic = here["combined"] - here["thrust"]
                row = pace.kind(simple), pace.balls(simple), statistics.median(times) / here["thrust"]
                rows.append((*row, here["thrust"] / arithmetic))
    each = {
        kind: statistics.median(max(time - 1.0, 0.0) * unit / balls for name, balls, time, unit in rows if name == kind)
        for kind in sorted({row[0] for row in rows})
    }
    first = [measuring.in_fresh_processes(first_solve, k, each, processes=1)[0] for k in range(FRESH)]
    return {
        "solves": len(rows),
        "first": float(f"{statistics.median(first):.3g}"),
        "ball": {kind: float(f"{value:.3g}") for kind, value in each.items()},
    }


def first_solve(k: int, ball: dict[str, float]) -> float:
    """How much longer than the thrust reference the first solve of another scene takes in a fresh process, beyond what
    its balls take."""
    scene = random_scenes.case(next(random_scenes.batches(SEED + 2 + k, 1, 1)), 0)
    accuracy.table()
    judge = indicators.Judge(scene)
    indicators.estimated(judge)
    here = pace.calibration()
    arithmetic = here["combined"] - here["thrust"]
    taken = pace.timed(lambda: qs.solve(scene))
    return (taken - pace.balls(scene) * ball[pace.kind(scene)] * arithmetic) / here["thrust"]


def make() -> dict[str, Any]:
    """The whole table."""
    found = ratios()
    return {
        "made_by": "python -m tests.benchmarks.advice",
        "machine": machine.machine(),
        "quantiles": QUANTILES,
        "margin": MARGIN,
        "omissions": {name: bounds(values) for name, values in found.items()},
        "seconds": seconds(),
    }


def main() -> None:
    """Make the table and keep it, with what a trial on other scenes says of it."""
    print("random scenes at every fidelity, about half a minute ...", file=sys.stderr, flush=True)
    table = make()
    keep(table)
    keep(table | {"trial": acceptance.summary(acceptance.outcomes())})


def keep(table: dict[str, Any]) -> None:
    """Write the table to its place, for this process too."""
    TABLE.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    accuracy.table.cache_clear()


if __name__ == "__main__":
    main()
