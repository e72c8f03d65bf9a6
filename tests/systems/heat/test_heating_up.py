"""Heating up in time, and the command that shows it: it tends to the steady state, overshoots, or runs to the limit."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from scipy.integrate import solve_ivp

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.systems.heat.state import _digits
from tests.systems.heat.spindle import AMBIENT, BETWEEN, paths, scene, tables
from tests.systems.heat.test_heat import cold, nodes, state_of, surplus

CAPACITIES = {"inner_ring_J_per_K": 60.0, "outer_ring_J_per_K": 90.0}


def heated(**changed: Any) -> dict[str, Any]:
    thermal = tables()["thermal"] | {"heat_capacities": CAPACITIES} | changed.pop("thermal", {})
    return tables(thermal=thermal, **changed)


def run(tmp_path: Path, document: dict[str, Any], *arguments: object) -> Result:
    file = tmp_path / "result.json"
    file.write_text(json.dumps({"version": qs.__version__, "input": document}))
    result = CliRunner().invoke(cli, ["heat", str(file), *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_the_course_meets_another_method_and_tends_to_the_steady_state() -> None:
    """Radau on equations written by hand, and a volume of balls likewise."""
    of = scene(thermal=heated()["thermal"])
    solution = qs.solve(of)
    course = state_of(solution).heat_up(3600.0)
    balls = 16 * np.pi / 6.0 * (7.14e-3) ** 3 * float(qs.STEEL.density) * 460.0  # type: ignore[arg-type]
    capacity = np.array([60.0, balls, 90.0])
    instant = int(np.searchsorted(course.time, 40.0))
    span, tight = (0.0, course.time[instant]), {"rtol": 1e-7, "atol": 1e-5}
    by_hand = solve_ivp(lambda _, T: surplus(T, of) / capacity, span, cold(), method="Radau", **tight)
    found = np.array([course.temperatures[name] for name in ("inner_ring", "balls", "outer_ring")])
    assert np.abs(found[:, instant] - by_hand.y[:, -1]).max() < 1e-3  # the integration's absolute tolerance [K]
    assert found[0, instant] - cold()[0] > 1.5
    assert np.abs(found[:, -1] - nodes(solution)).max() < 1e-3
    assert course.preloads[-1, 0] == pytest.approx(float(solution.load[0]), rel=1e-4)
    assert course.end == "time" and "never exceeds" in course.message()


def test_a_cold_heavy_housing_makes_the_preload_overshoot() -> None:
    """While the housing is cold, the outer ring is too; the inner ring, cooled on its own, is soon as warm as ever."""
    between = BETWEEN | {("inner_ring", "ambient"): 2.0, ("outer_ring", "housing"): 5.0, ("housing", "ambient"): 0.4}
    del between["outer_ring", "ambient"]
    capacities = CAPACITIES | {"housing_J_per_K": 4000.0}
    thermal = {"conductances": paths(between), "heat_capacities": capacities}
    solution = qs.solve(scene(**heated(thermal=thermal, operation={"speed_rpm": 11_000})))
    course = state_of(solution).heat_up(200_000.0)
    peak = course.preloads[:, 0].max() / course.preloads[-1, 0]
    assert peak > 1.02
    assert f"overshoots to {course.preloads[:, 0].max():.4g} N" in course.message()
    assert course.preloads[-1, 0] == pytest.approx(float(solution.load[0]), rel=1e-4)


def test_above_the_fold_it_heats_up_to_the_limit(tmp_path: Path) -> None:
    result = run(tmp_path, heated(operation={"speed_rpm": 14_000}), "--transient", 3600, "--json")
    assert result.exit_code == 1
    found = json.loads(result.stdout)
    assert found["thermal"]["verdict"] == "runaway" and found["speeds"] is None
    assert found["transient"]["end"] == "limit"
    assert found["transient"]["temperatures_C"]["inner_ring"][-1] == pytest.approx(200.0, abs=0.01)
    assert np.all(np.diff(found["transient"]["temperatures_C"]["inner_ring"]) >= 0.0)


def test_the_command_shows_the_fold_and_draws_it(tmp_path: Path, drawn: None) -> None:
    picture = tmp_path / "heat.png"
    result = run(tmp_path, heated(), "--plot", picture)
    assert result.exit_code == 0, result.output
    assert "Thermal runaway of the preload begins at" in result.stdout and "the curve turns back" in result.stdout
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_what_is_missing_is_said(tmp_path: Path) -> None:
    result = run(tmp_path, tables(), "--transient", 100)
    assert result.exit_code == 2
    assert "thermal.heat_capacities.inner_ring_J_per_K: missing" in result.stderr
    assert (
        "--start -400: is outside -123.15 to 526.85 °C"
        in run(tmp_path, heated(), "--transient", 9, "--start", -400).stderr
    )
    assert "--transient 0: must be above 0 s" in run(tmp_path, heated(), "--transient", 0).stderr
    result = run(tmp_path, tables(thermal=None, effects=None), "--json")
    assert result.exit_code == 2 and "no table [thermal]" in result.stderr
    assert run(tmp_path, tables(), "--start", AMBIENT).exit_code == 2


def test_large_loads_are_written_without_a_power_of_ten() -> None:
    assert [_digits(load) for load in (11_333.3, 859.03, 0.5)] == ["11330", "859", "0.5"]
