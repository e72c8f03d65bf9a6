"""No operation inside ever overflows, divides by zero or makes what is not a number: plain Python, all traps set."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.compiled import COMPILED
from tests.hard_cases.cases import CASES
from tests.hard_cases.scenes import BY_NAME, scene_of

if not COMPILED:
    pytest.skip("starts plain Python by itself", allow_module_level=True)

LONG = {"sixty_balls", "inner_control_beyond_its_end", "a_millionth_of_a_newton"}
"""Many balls or many iterations: seconds to a minute each in plain Python."""
NAMES = [case["name"] for case in CASES if case["name"] not in LONG]


def run_watched(*shares: list[str], limit: float) -> dict[str, dict[str, Any]]:
    """How these cases end, each share of them in a process of its own, all at the same time."""
    command = [sys.executable, "-W", "error", "-m", "tests.hard_cases.watched"]
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    processes = [
        subprocess.Popen([*command, *names], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
        for names in shares
    ]
    found: dict[str, dict[str, Any]] = {}
    try:
        for process in processes:
            out, err = process.communicate(timeout=limit)
            assert process.returncode == 0, err
            found |= json.loads(out)
    finally:
        for process in processes:
            process.kill()
    return found


def assert_clean(found: dict[str, dict[str, Any]]) -> None:
    """Nothing raised and nothing left behind."""
    for name, ending in found.items():
        assert "raised" not in ending, (name, ending)
        assert ending["seen"] == [], (name, ending["seen"])


def test_the_traps_catch() -> None:
    """Python's silent overflow at a function's return; what numpy divides by zero or cannot do, as it occurs."""
    ending = run_watched(["trap"], limit=60.0)["trap"]
    assert ending["raised"] == ["FloatingPointError"] * 3
    assert any("contact_load" in words and "inf" in words for words in ending["seen"])


def test_hard_cases_under_traps() -> None:
    """All but the longest; and plain Python comes to the same as the compiled kernel."""
    found = run_watched(NAMES[::2], NAMES[1::2], limit=300.0)
    assert list(found) == NAMES[::2] + NAMES[1::2]
    assert_clean(found)
    for name, ending in found.items():
        compiled = qs.solve(scene_of(BY_NAME[name]))
        assert ending["status"] == str(compiled.status), name
        if compiled.converged:
            size = np.abs(compiled.displacement).max()
            # The compiler may fuse a product and a sum into one operation: the last bits differ.
            assert np.abs(np.array(ending["displacement"]) - compiled.displacement).max() <= 1e-9 * size, name


@pytest.mark.heavy
def test_the_longest_under_traps() -> None:
    assert_clean(run_watched(sorted(LONG), limit=900.0))


@pytest.mark.heavy
def test_random_scenes_under_traps() -> None:
    """Four hundred scenes of the campaign."""
    names = [f"1/0/{index}" for index in range(400)]
    assert_clean(run_watched(names[::2], names[1::2], limit=1800.0))


@pytest.mark.heavy
def test_paths_through_turning_points_under_traps() -> None:
    """Scenes of the campaign that only a path brings to an end."""
    found = run_watched(["1/228/183", "1/971/565"], ["1/792/865"], limit=900.0)
    assert_clean(found)
    assert all(ending["status"] in ("converged", "no_equilibrium") for ending in found.values())


@pytest.mark.heavy
def test_light_loads_and_thrown_balls_under_traps() -> None:
    """Scenes of the campaign whose contacts carry next to nothing, and whose balls lie on the inner groove's top."""
    found = run_watched(["1/527/965", "1/703/801", "1/305/42"], ["1/506/485", "1/135/256"], limit=900.0)
    assert_clean(found)
    assert all(ending["status"] in ("converged", "no_equilibrium") for ending in found.values())
