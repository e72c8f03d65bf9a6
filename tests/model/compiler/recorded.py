"""Calls of every entry, as real solves make them."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.model.compiler.compiled import CompiledEntry
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution import solver
from qsbearing.model.solution.friction_motion import friction_motion
from qsbearing.model.solution.motion_stiffness import motion_stiffness
from qsbearing.readings import stress
from qsbearing.readings.asked import take_asked
from tests.qsbearing import scenes
from tests.studies.test_sweep import with_readings
from tests.systems.sets.arrangements import pair
from tests.verification.benchmarks import scenes as random_scenes
from tests.verification.hard_cases.scenes import scene_of as scene_of_hard

CALLS = 6
"""Of one entry, the first are kept."""
FEW, QUICK = 20, 100
TABLE = Path(scenes.__file__).parents[1] / "verification" / "hard_cases" / "table.json"


def copied(args: tuple[Any, ...]) -> tuple[Any, ...]:
    """With arrays of their own."""
    parts = [
        each.copy() if isinstance(each, np.ndarray) else copied(each) if isinstance(each, tuple) else each
        for each in args
    ]
    return args._make(parts) if hasattr(args, "_make") else tuple(parts)


def solve_many_kinds() -> None:
    """A batch in lanes; hard cases that are quick, some refused, some left to the fallback; unequal balls; a set; every
    reading; balls moved by friction."""
    assert np.isfinite(qs.solve(random_scenes.random_points(FEW)).stiffness).all()
    table = json.loads(TABLE.read_text(encoding="utf-8"))["cases"]
    quick = [case["case"] for case in table if case["iterations"] < QUICK]
    found = [qs.solve(scene_of_hard(name)) for name in quick]
    assert {str(each.status) for each in found} >= {"converged", "no_equilibrium"}
    qs.solve(next(iter(scenes.unequal_scenes().values())))
    qs.solve_set(pair(axial_load=np.array([0.0, 2e3, 9e4]), radial_load_y=1e3, moment_z=0.0, speed=5e3 * qs.rpm))
    solution = qs.solve(scene_of(with_readings(), ""))
    take_asked(solution)
    stress(solution)
    of = qs.Operation(speed=9e3 * qs.rpm, axial_load=np.array([-1e3, 8e3]), radial_load_y=2e3, tilt_y=0.0, tilt_z=0.0)
    motion_stiffness(friction_motion(qs.Scene(scenes.B218, of), Traction(), radii=2, angles=4))
    across = replace(of, axial_load=5e3, radial_load_y=0.0)
    moved = qs.Scene(
        scenes.QJ, across, ball_effects=(qs.CentrifugalForce(), qs.GyroscopicMoment()), raceway_control="friction"
    )
    motion_stiffness(friction_motion(moved, Traction(), radii=2, angles=4))


def recorded() -> dict[str, list[tuple[Any, ...]]]:
    """Copies of what entries are given, by their names."""
    found: dict[str, list[tuple[Any, ...]]] = {}
    called = CompiledEntry.__call__

    def noted(entry: CompiledEntry, *args: Any) -> Any:
        calls = found.setdefault(entry.name, [])
        if len(calls) < CALLS:
            calls.append(copied(args))
        return called(entry, *args)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(CompiledEntry, "__call__", noted)
        patch.setattr(solver, "LEAST_BATCH", FEW)
        solve_many_kinds()
    return found


def arrays(args: tuple[Any, ...]) -> Iterator[np.ndarray]:
    """All arrays among arguments."""
    for each in args:
        if isinstance(each, np.ndarray):
            yield each
        elif isinstance(each, tuple):
            yield from arrays(each)
