"""The same answer every time: in another process, on any number of threads, alone and in a batch."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from functools import cache
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.compiled import COMPILED
from tests.hard_cases.cases import CASES
from tests.hard_cases.scenes import BY_NAME, scene_of

COPIES = 2100 if COMPILED else 70
"""More cases than are solved in one stretch on one thread."""

NAMES = [case["name"] for case in CASES if case["name"] not in ("sixty_balls", "inner_control_beyond_its_end")]
FEW = NAMES if COMPILED else NAMES[:1]


def fields(solution: qs.Solution) -> dict[str, Any]:
    """Everything that is read off a solution."""
    found = {"status": solution.status, "iterations": solution.iterations, "residual": solution.residual}
    found |= {"displacement": solution.displacement, "load": solution.load}
    for race in ("inner", "outer"):
        for name in ("load", "angle", "approach", "semi_major_axis", "max_pressure", "required_friction"):
            found[f"{race} {name}"] = getattr(getattr(solution, race), name)
    for name in ("centrifugal_force", "gyroscopic_moment", "orbital_speed", "rotation_speed", "raceway_control"):
        found[name] = getattr(solution, name)
    return {name: np.asarray(value) for name, value in found.items() if value is not None}


def digest() -> str:
    """Of all hard cases, every bit."""
    total = hashlib.sha256()
    for name in FEW:
        for array in fields(qs.solve(scene_of(BY_NAME[name]))).values():
            total.update(array.astype(str).tobytes() if array.dtype.kind == "U" else array.tobytes())
    return total.hexdigest()


@cache
def here() -> str:
    return digest()


def test_twice_in_one_process() -> None:
    assert digest() == here()


@pytest.mark.parametrize("threads", [1, 2])
def test_in_another_process(threads: int) -> None:
    code = "from tests.hard_cases.test_identity import digest; print(digest())"
    environment = {**os.environ, "QSBEARING_THREADS": str(threads)}
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True, env=environment)
    assert done.stdout.split()[-1] == here()


@pytest.mark.parametrize(
    "name", ["mixed_control", "tilted_by_5_mrad", "most_balls_unloaded_at_speed"] if COMPILED else FEW
)
def test_on_any_number_of_threads(name: str) -> None:
    """Thousands of copies on one thread, two and five: each is every other, to the last bit."""
    scene = scene_of(BY_NAME[name], stacked=COPIES)
    expected = fields(qs.solve(scene, threads=1))
    for array in expected.values():
        assert all(np.array_equal(array[k], array[0], equal_nan=array.dtype.kind == "f") for k in (1, COPIES // 2, -1))
    for threads in (2, 5):
        found = fields(qs.solve(scene, threads=threads))
        for key, array in expected.items():
            assert np.array_equal(found[key], array, equal_nan=array.dtype.kind == "f"), key


@pytest.mark.parametrize("name", FEW)
def test_alone_and_in_a_batch(name: str) -> None:
    """A scene of plain numbers and the same among arrays: to 1e-12 of the case's largest.

    Not to the last bit: numpy and Python raise an array and a number to a power by different code.
    """
    alone, batch = qs.solve(scene_of(BY_NAME[name])), qs.solve(scene_of(BY_NAME[name], stacked=3))
    assert list(batch.status) == [alone.status] * 3
    if not alone.converged:
        return
    for key in ("displacement", "load"):
        one, many = getattr(alone, key), getattr(batch, key)
        size = np.array([1.0, 1.0, 1.0, 0.1, 0.1])
        assert np.abs((many - one) * size).max() <= 1e-12 * np.abs(one * size).max(), key
    for race in ("inner", "outer"):
        for key in ("load", "angle", "max_pressure"):
            one, many = getattr(getattr(alone, race), key), getattr(getattr(batch, race), key)
            assert np.array_equal(np.isnan(one), np.isnan(many[0]))
            largest = np.nanmax(np.abs(one), initial=0.0)
            assert np.nanmax(np.abs(many - one), initial=0.0) <= 1e-12 * largest, (race, key)
