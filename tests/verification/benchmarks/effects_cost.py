"""What each effect costs: `python -m tests.verification.benchmarks.effects_cost` measures it, keeps the record, fills
the guide's table; with `--from-record` only the table. Each column adds to the one before; all in turn, processor
time."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import qsbearing as qs
from qsbearing.model.solution.solver import solve
from qsbearing.results import provenance
from qsbearing.studies.chooser.choose import completed
from qsbearing.studies.cost import measuring, speeds
from tests.verification.benchmarks import marked

PAGE = Path(qs.__file__).parent / "guide" / "timing.md"
RECORD = Path(__file__).with_suffix(".json")
BATCH, ROUNDS = 1000, 30


def scenes() -> dict[str, qs.Scene]:
    """B218 under a combined load, with more and more effects; ring expansion with a fit and a warm inner ring."""
    bearing = qs.load_scene("b218").bearing
    steel = replace(bearing.ring_material, thermal_expansion=12e-6)
    bearing = replace(bearing, ring_material=steel, ball_material=steel)
    loads = qs.Operation(axial_load=17_800.0, radial_load_y=3_000.0, moment_z=0.0)
    turning = replace(loads, speed=10_000 * qs.rpm)
    rings = qs.RingExpansion(90 * qs.mm, 160 * qs.mm, shaft_interference=15 * qs.um, inner_ring_temperature=340.0)
    both = (qs.CentrifugalForce(), qs.GyroscopicMoment())
    grown = qs.Scene(bearing, turning, both, qs.RacewayControl.OUTER, ring_effects=(rings,))
    return {
        "at rest": qs.Scene(bearing, loads),
        "+ centrifugal force": qs.Scene(bearing, turning, both[:1], qs.RacewayControl.OUTER),
        "+ gyroscopic moment": qs.Scene(bearing, turning, both, qs.RacewayControl.OUTER),
        "+ ring expansion": grown,
        "all": completed(replace(grown, ring_effects=(rings, qs.BallExpansion(340.0)))),
    }


def measure() -> dict[str, Any]:
    """Medians of the rounds [s], and where."""
    calls: dict[Any, Callable[[], Any]] = {}
    for name, scene in scenes().items():
        for count in (1, BATCH):
            calls[name, count] = partial(solve, speeds.batch(scene, count), threads=1)
    times = measuring.interleaved(calls, ROUNDS)
    rows = {name: {str(n): measuring.spread([t / n for t in times[name, n]]) for n in (1, BATCH)} for name in scenes()}
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


def filled(page: str, found: dict[str, Any]) -> str:
    """The page with its table made from the record."""
    return marked.filled(page, "effects", "effects_cost", table(found))


def load() -> dict[str, Any]:
    """The kept record."""
    return dict(json.loads(RECORD.read_text(encoding="utf-8")))


def main() -> None:
    """Measure, keep, show."""
    if sys.argv[1:] != ["--from-record"]:
        RECORD.write_text(json.dumps(measure(), indent=1) + "\n", encoding="utf-8")
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8"), load()), encoding="utf-8")


if __name__ == "__main__":
    main()
