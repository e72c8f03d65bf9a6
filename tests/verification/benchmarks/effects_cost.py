"""What each effect costs: `python -m tests.verification.benchmarks.effects_cost [FILE]` measures it and keeps it.
Each column of the guide's table adds to the one before; all in turn, processor time."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from qsbearing.model.solution.solver import solve
from qsbearing.results import provenance
from qsbearing.studies.cost import measuring, speeds
from tests.verification.benchmarks.scenes import levels

RECORD = Path(__file__).with_suffix(".json")
BATCH, ROUNDS = 1000, 30


def measure() -> dict[str, Any]:
    """Medians of the rounds [s], and where."""
    calls: dict[Any, Callable[[], Any]] = {}
    for name, scene in levels().items():
        for count in (1, BATCH):
            calls[name, count] = partial(solve, speeds.batch(scene, count), threads=1)
    times = measuring.interleaved(calls, ROUNDS)
    rows = {name: {str(n): measuring.spread([t / n for t in times[name, n]]) for n in (1, BATCH)} for name in levels()}
    command = "python -m tests.verification.benchmarks.effects_cost"
    return {
        "made_by": command,
        "provenance": provenance.of_run(command),
        "machine": measuring.machine(),
        "seconds": rows,
    }


def table(found: dict[str, Any]) -> str:
    """The page's table."""
    rows = found["seconds"]
    lines = [f"| µs | {' | '.join(rows)} |", "|" + "---|" * (len(rows) + 1)]
    for count, name in (("1", "one call"), (str(BATCH), f"a point of {BATCH}, one core")):
        cells = [f"{1e6 * row[count]['median']:.3g}" for row in rows.values()]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def load() -> dict[str, Any]:
    """The kept record."""
    return dict(json.loads(RECORD.read_text(encoding="utf-8")))


def main() -> None:
    """Measure, keep."""
    target = Path(sys.argv[1]) if sys.argv[1:] else RECORD
    target.write_text(json.dumps(measure(), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
