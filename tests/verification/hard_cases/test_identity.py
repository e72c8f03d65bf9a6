"""The same answer every time: in another process, on any number of threads."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler import threads
from qsbearing.model.compiler.compiled import has_fast_code
from tests.qsbearing.scenes import PER_BALL, turning
from tests.verification.hard_cases.cases import CASES
from tests.verification.hard_cases.scenes import scene_of

NAMES = [case["name"] for case in CASES if case["name"] != "sixty_balls"]
FEW = NAMES if has_fast_code() else NAMES[:1]


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
        for array in fields(qs.solve(scene_of(name))).values():
            total.update(array.astype(str).tobytes() if array.dtype.kind == "U" else array.tobytes())
    return total.hexdigest()


def test_twice_here_and_once_in_another_process() -> None:
    code = "from tests.verification.hard_cases.test_identity import digest; print(digest())"
    environment = {**os.environ, "QSBEARING_THREADS": "1"}
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True, env=environment)
    assert [digest(), digest()] == [done.stdout.split()[-1]] * 2


@pytest.mark.skipif(not has_fast_code(), reason="thousands of cases")
def test_on_any_number_of_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    """Easy cases, hard ones, cases with either control and cases without an equilibrium, all in one call, more than
    one thread solves in one stretch: on one thread, two and five each is the same to the last bit."""
    monkeypatch.setattr(threads, "CHUNK", 40)
    rpm = np.linspace(1500.0, 9000.0, 10)[:, None]
    loads = {"axial_load": np.linspace(-500.0, 20e3, 20), "radial_load_y": 6e3, "moment_y": 0.0, "moment_z": -100.0}
    scene = turning(rpm, control=PER_BALL, **loads)
    expected = fields(qs.solve(scene, threads=1))
    assert set(expected["status"].ravel()) >= {"converged", "no_equilibrium"}
    assert set(expected["raceway_control"].ravel()) >= {"inner", "outer"}
    for count in (2, 5):
        found = fields(qs.solve(scene, threads=count))
        for key, array in expected.items():
            assert np.array_equal(found[key], array, equal_nan=array.dtype.kind == "f"), (key, count)
