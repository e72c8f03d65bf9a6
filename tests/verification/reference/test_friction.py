"""The balance of friction against fifty digits, with the same points; and the reference against laws that it does not
solve for."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from mpmath import mp

from tests.verification.reference.friction import CASES, Thrust, gauss_of_squares, load_reference, solve
from tests.verification.reference.table import friction_errors
from tests.verification.reference.test_against_reference import TOLERANCE

ENTRIES = load_reference()


@pytest.mark.parametrize("entry", ENTRIES, ids=[each["case"]["name"] for each in ENTRIES])
def test_every_result_to_ten_digits(entry: dict[str, Any]) -> None:
    off = friction_errors(entry)
    print({name: f"{each:.0e}" for name, each in off.items()})
    assert max(off.values()) < TOLERANCE


@pytest.mark.parametrize("entry", ENTRIES, ids=[each["case"]["name"] for each in ENTRIES])
def test_the_reference_turns_work_into_heat(entry: dict[str, Any]) -> None:
    """To its own digits: no equation of its says so."""
    with mp.workdps(40):
        result = {name: mp.mpf(value) for name, value in entry["result"].items()}
        work = -result["torque"] * mp.mpf(entry["case"]["inner_speed_rpm"]) * mp.pi / 30
        assert abs(work / (result["inner_heat"] + result["outer_heat"]) - 1) < mp.mpf(10) ** -22
        assert result["residual"] < mp.mpf(10) ** -40


def test_points_of_the_reference_integrate_what_they_should() -> None:
    """Powers of s up to twice their number, less one."""
    with mp.workdps(50):
        for power in range(12):
            total = sum(w * s**power for s, w in gauss_of_squares(6))
            assert abs(total - mp.mpf(3) / (power + 3)) < mp.mpf(10) ** -45
        total = sum(w * s**12 for s, w in gauss_of_squares(6))
        assert abs(total - mp.mpf(3) / 15) > mp.mpf(10) ** -12


def test_stored_cases_are_those_of_the_module() -> None:
    assert [each["case"] for each in ENTRIES] == CASES
    of = Thrust(CASES[1])
    result = {name: mp.mpf(value) for name, value in ENTRIES[1]["result"].items()}
    stored = [result[name] for name in ("X1", "X2", "wx", "wy", "wz", "wm", "d")]
    assert max(map(abs, of.equations(stored))) < 1e-9 * of.thrust
    assert np.isfinite(float(result["outer_heat"]))


@pytest.mark.heavy
@pytest.mark.parametrize("entry", ENTRIES, ids=[each["case"]["name"] for each in ENTRIES])
def test_the_reference_is_found_again(entry: dict[str, Any]) -> None:
    again = solve(entry["case"], 30)
    for name, value in entry["result"].items():
        if name != "residual":
            assert abs(mp.mpf(again[name]) / mp.mpf(value) - 1) < mp.mpf(10) ** -20
