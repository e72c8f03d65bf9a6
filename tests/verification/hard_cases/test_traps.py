"""No operation inside ever overflows, divides by zero or makes what is not a number: plain Python, all traps set."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.verification.hard_cases.cases import CASES
from tests.verification.hard_cases.scenes import scene_of

if not has_fast_code():
    pytest.skip("starts plain Python by itself", allow_module_level=True)

LONG = {
    "sixty_balls",
    "inner_control_beyond_its_end",
    "a_millionth_of_a_newton",
    "thrust_reversed_at_speed",
    "one_ball_free",
}
"""Many balls or many iterations: seconds to a minute each in plain Python."""
NAMES = [case["name"] for case in CASES if case["name"] not in LONG]


def run_watched(*names: str, limit: float) -> dict[str, dict[str, Any]]:
    """How these cases end in a process without compilation."""
    command = [sys.executable, "-W", "error", "-m", "tests.verification.hard_cases.watched", *names]
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=limit, check=False)
    assert done.returncode == 0, done.stderr
    found: dict[str, dict[str, Any]] = json.loads(done.stdout)
    return found


def assert_clean(found: dict[str, dict[str, Any]]) -> None:
    """Nothing raised and nothing left behind."""
    for name, ending in found.items():
        assert "raised" not in ending, (name, ending)
        assert ending["seen"] == [], (name, ending["seen"])


OTHERS = [name for name in NAMES if name not in NAMES[::3]]


@pytest.mark.parametrize("names", [NAMES[::3], pytest.param(OTHERS, marks=pytest.mark.heavy)], ids=["third", "others"])
def test_hard_cases_under_traps(names: list[str]) -> None:
    """Every third but for the longest, or the others, and the traps themselves; and plain Python comes to the same as
    the compiled kernel."""
    found = run_watched("trap", *names, limit=300.0)
    trap = found.pop("trap")
    assert trap["raised"] == ["FloatingPointError"] * 3
    assert any("squared" in words and "inf" in words for words in trap["seen"])
    assert_clean(found)
    for name in names:
        compiled = qs.solve(scene_of(name))
        assert found[name]["status"] == str(compiled.status), name
        if compiled.converged:
            size = np.abs(compiled.displacement).max()
            # The compiler may fuse a product and a sum into one operation: the last bits differ.
            assert np.abs(np.array(found[name]["displacement"]) - compiled.displacement).max() <= 1e-9 * size, name


@pytest.mark.heavy
def test_the_longest_under_traps() -> None:
    assert_clean(run_watched(*sorted(LONG), limit=900.0))


@pytest.mark.heavy
def test_random_scenes_under_traps() -> None:
    """Light loads, balls with room between wide grooves, all controls; in two processes, for they take long."""
    names = [f"random {seed}" for seed in range(60)]
    with ThreadPoolExecutor(2) as pool:
        for found in pool.map(lambda some: run_watched(*some, limit=1800.0), (names[::2], names[1::2])):
            assert_clean(found)
