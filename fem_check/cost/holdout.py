"""Hold-out test of the mesh choice: contacts that its table was not made from, solved to an accuracy as a user would.

Every other bearing of the catalogue, both raceways: other shapes, sizes, and ceramic balls.
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from itertools import product
from typing import Any

from fem_check import half_space_contact, linear_solver, memory
from fem_check.agreement import Level
from fem_check.cost import advice, fresh_process
from fem_check.cost.configurations import JUDGED
from fem_check.cost.record import MEASURED
from fem_check.elastic_body import Progress, silent
from fem_check.groove import RACES
from fem_check.references import axis_ratio, hertz
from fem_check.scenes import groove_contact

SCENES = ("7210c", "7210c_hybrid", "iso16281_7ball", "turbopump25", "turbopump25_hybrid")
LOAD = 150.0
ACCURACIES = {Level.QUICK: (1e-2, 3e-3, 1e-3), Level.RELEASE: (1e-3, 3e-3, 2e-4, 1e-2, 5e-4)}
"""Asked for in turn."""
COUNT = {Level.QUICK: 3, Level.RELEASE: 10}


@dataclass(frozen=True)
class HoldoutContact:
    """A contact and the accuracy asked for."""

    scene: str
    race: str
    accuracy: float
    solver: str
    table: dict[str, Any]


def wanted(level: Level, table: dict[str, Any]) -> list[HoldoutContact]:
    """The contacts of a level."""
    asked = ACCURACIES[level]
    contacts = list(product(SCENES, RACES))[:: len(SCENES) * len(RACES) // COUNT[level]][: COUNT[level]]
    return [
        HoldoutContact(scene, race, asked[index % len(asked)], table["main_solver"], table)
        for index, (scene, race) in enumerate(contacts)
    ]


def measure(table: dict[str, Any], level: Level, progress: Progress) -> list[dict[str, Any]]:
    """Solve every contact in a process of its own, by a record's own table."""
    cases = wanted(level, table)
    found = []
    for done, each in enumerate(cases):
        progress(f"hold-out contact {each.scene}, {each.race}", done / len(cases))
        about = {"contact": f"{each.scene} {each.race}", "asked": each.accuracy}
        try:
            found.append({**about, "status": MEASURED, **fresh_process.call(solve, each)})
        except fresh_process.ProcessError as problem:
            found.append({**about, "status": str(problem)})
    return found


def solve(case: HoldoutContact) -> dict[str, Any]:
    """Choose a mesh, predict error and time, solve; predicted and measured values."""
    os.environ[linear_solver.ENVIRONMENT] = case.solver
    problem = groove_contact(case.scene, case.race).problem(LOAD)
    choice = advice.choose(problem, case.accuracy, case.table, case.solver, memory.available_MB())
    exact = hertz(problem)
    memory.restart_peak()
    start = time.perf_counter()
    expected = advice.expected(choice, problem, silent)
    for count in choice.sequence:
        bodies = half_space_contact.condensed_bodies(problem, count)
        _, measured = half_space_contact.solve_on(problem, bodies, choice.positions)
    taken = time.perf_counter() - start
    found = {
        "ellipticity": 1.0 / axis_ratio(problem.curvature_x / problem.curvature_y),
        "bodies": len({body.poisson_ratio for body in problem.bodies}),
        "elements_per_semi_axis": choice.elements,
        "positions": choice.positions,
        "expected_error": choice.error,
        "deviation": max(abs(float(getattr(measured.mean, name)) / getattr(exact, name) - 1.0) for name in JUDGED),
        "expected_seconds": expected.seconds,
        "seconds": taken,
        "seconds_over_expected": taken / expected.seconds,
        "expected_memory_MB": choice.memory_MB,
        "peak_memory_MB": memory.peak_MB(),
    }
    return {name: float(f"{value:.3g}") if isinstance(value, float) else value for name, value in found.items()}
