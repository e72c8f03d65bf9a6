"""The measurement as a whole: from nothing to a cost record."""

from __future__ import annotations

import time
from typing import Any

from fem_check import linear_solver
from fem_check.agreement import Level
from fem_check.cost import closed_forms, configurations, fresh_process, holdout, machine, record, shapes, timing
from fem_check.cost.configurations import Configuration
from fem_check.elastic_body import Progress
from fem_check.references import axis_ratio


def measure(level: Level, progress: Progress) -> dict[str, Any]:
    """Measure a level; nothing is written."""
    start = time.perf_counter()
    usable, main = linear_solver.available(), linear_solver.chosen()
    found = machine.machine()
    problem = configurations.problem()
    progress("closed forms", 0.0)
    forms = closed_forms.measure(problem)
    wanted = shapes.wanted(level, main)
    shaped = []
    for done, shape in enumerate(wanted):
        progress(f"{shape.elements} elements, a/b = {shape.ellipticity:g}", 0.2 * done / len(wanted))
        shaped.append(fresh_process.call(shapes.solve, shape))
    planned = configurations.planned(level, main, [name for name in usable if name != main])
    results = timing.interleaved(
        configurations.solve, planned, level, lambda stage, part: progress(stage, 0.2 + 0.7 * part), _label
    )
    series = [[] if isinstance(runs, str) else [run["seconds"] for run in runs] for runs in results]
    over = timing.ratios(series, planned.index(Configuration(record.REFERENCE, main)))
    entries = [_entry(*each) for each in zip(planned, results, over, strict=True)]
    measured = {
        "kind": "fem_cost",
        "made_by": f"fem-check cost --level {level}",
        "level": str(level),
        "machine": found,
        "contact": {
            "name": problem.name,
            "load_N": problem.load,
            "ellipticity": 1.0 / axis_ratio(problem.curvature_x / problem.curvature_y),
        },
        "main_solver": main,
        "solvers": {
            name: {"label": record.SOLVERS[name], "status": record.MEASURED if name in usable else record.NOT_INSTALLED}
            for name in linear_solver.known()
        },
        "families": {family.name: family.label for family in configurations.FAMILIES},
        "configurations": entries,
        "shapes": shaped,
        "closed_forms": forms,
        "orders": record.orders(shaped, entries),
        "scaling": record.scaling(entries),
    }
    tested = holdout.measure(measured, level, lambda stage, part: progress(stage, 0.9 + 0.1 * part))
    return {**measured, "holdout_contacts": tested, "seconds": round(time.perf_counter() - start, 1)}


def _label(configuration: Configuration) -> str:
    return (
        f"{configuration.elements} elements, {configuration.family}, {configuration.far_field}, {configuration.solver}"
    )


def _entry(
    configuration: Configuration, runs: list[dict[str, Any]] | str, over: dict[str, Any] | None
) -> dict[str, Any]:
    """A configuration as the record keeps it; what was not measured is None, and `status` says why."""
    named = configuration.describe()
    if isinstance(runs, str):
        return {**named, "status": runs, **dict.fromkeys(record.GIVEN)}
    first = runs[0]
    kept = {name: value for name, value in first.items() if name not in record.TIMED}
    spreads = {name: timing.spread([run[name] for run in runs]) for name in record.TIMED}
    return {**named, "status": record.MEASURED, **_shortened(kept), **spreads, "seconds_over_reference": over}


def _shortened(value: Any) -> Any:
    """Floats to four digits: more would be noise in a file that people compare."""
    if isinstance(value, dict):
        return {name: _shortened(part) for name, part in value.items()}
    return float(f"{value:.4g}") if isinstance(value, float) else value
