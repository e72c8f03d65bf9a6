"""Compiled passes over contacts: compiled once, whatever the cases."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from qsbearing.files.scene_file import scene_of
from qsbearing.model.compiler.compiled import CompiledEntry
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solver import solve
from qsbearing.readings.asked import take_asked
from tests.studies.test_sweep import with_readings


def kind_of(argument: Any) -> Any:
    """What tells one compiled form of a function from another."""
    if isinstance(argument, tuple):
        return tuple(map(kind_of, argument))
    if isinstance(argument, np.ndarray):
        return argument.dtype.str, argument.ndim, argument.flags.c_contiguous, argument.flags.writeable
    return type(argument).__name__


def with_many(scene: Scene) -> list[Scene]:
    """One case, and two of which different numbers differ."""
    pair = np.array([1.0, 0.9])
    operation, friction = scene.operation, scene.readings["friction"]
    spinning = replace(scene, operation=replace(operation, speed=operation.speed * pair))
    return [
        scene,
        spinning,
        replace(scene, operation=replace(operation, axial_load=operation.axial_load * pair)),
        replace(scene, bearing=replace(scene.bearing, ball_diameter=scene.bearing.ball_diameter * pair**1e-3)),
        replace(spinning, readings=scene.readings | {"friction": friction | {"friction_coefficient": 0.05 * pair}}),
    ]


def test_a_pass_is_compiled_for_one_kind_of_arrays(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whether numbers come one for all cases or one for each."""
    kinds: dict[str, set[Any]] = defaultdict(set)
    called = CompiledEntry.__call__

    def noted(entry: CompiledEntry, *args: Any) -> Any:
        kinds[entry.name].add(tuple(map(kind_of, args)))
        return called(entry, *args)

    scene = scene_of(with_readings(), "")
    monkeypatch.setattr(CompiledEntry, "__call__", noted)
    for each in with_many(scene):
        take_asked(solve(each))
    passes = {name: found for name, found in kinds.items() if name.startswith("qsbearing.readings.")}
    assert len(passes) >= 6
    assert {name: len(found) for name, found in passes.items() if len(found) > 1} == {}
