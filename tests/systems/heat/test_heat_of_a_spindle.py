"""Heat on an elastic shaft: temperatures balance, the shaft grows by them, and rows carry what that makes of them.

All is recomputed from the solution: heat by hand, the shaft's line by finite elements of the tests' own, and what the
pair is pressed together by from temperatures and the cold set.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.systems.heat import solve as solving
from tests.systems.heat.spindle import AMBIENT, pair
from tests.verification.campaign.spindles import wrong_of

SHAFT = {
    "start_mm": -80,
    "sections": [
        {"length_mm": 70, "outer_diameter_mm": 45, "inner_diameter_mm": 12},
        {"length_mm": 80, "outer_diameter_mm": 35, "inner_diameter_mm": 12},
    ],
    "loads": [{"position_mm": -75, "radial_y_N": 80, "axial_N": 20}],
    "points": {"tool_mm": -80},
}
BETWEEN = ("inner_ring", "shaft", 5.0), ("outer_ring", "housing", 8.0), ("housing", "ambient", 6.0)
STEEL = 12e-6


def spindle() -> qs.BearingSet:
    return pair(shaft=SHAFT, housing={})


@pytest.fixture(scope="module")
def solution() -> qs.SetSolution:
    """Of one case, along an axis."""
    of = spindle()
    return qs.solve_set(replace(of, operation=replace(of.operation, speed=np.array([5000.0 * qs.rpm]))))


def temperature(solution: qs.SetSolution, node: str) -> float:
    assert solution.thermal is not None
    return float(solution.thermal.temperatures[node][0])


def test_heat_of_every_node_balances(solution: qs.SetSolution) -> None:
    assert solution.converged.all() and solution.thermal is not None
    made = {n: float(solution.thermal.powers[f"friction {n}"][0]) for n in (1, 2)}
    assert min(made.values()) > 1.0
    to_shaft = to_housing = 0.0
    for n, power in made.items():
        inner, outer, balls = (temperature(solution, f"{node} {n}") for node in ("inner_ring", "outer_ring", "balls"))
        along = 5.0 * (inner - temperature(solution, "shaft"))
        outward = 8.0 * (outer - temperature(solution, "housing"))
        assert along + 2.0 * (inner - balls) == pytest.approx(0.25 * power, rel=1e-7)
        to_ambient = 3.0 * (outer - AMBIENT - qs.zero_celsius)
        assert outward + to_ambient + 2.5 * (outer - balls) == pytest.approx(0.25 * power, rel=1e-7)
        to_shaft, to_housing = to_shaft + along, to_housing + outward
    assert to_shaft + 5.0 == pytest.approx(temperature(solution, "shaft") - AMBIENT - qs.zero_celsius, rel=1e-8)
    assert to_housing == pytest.approx(6.0 * (temperature(solution, "housing") - AMBIENT - qs.zero_celsius), rel=1e-8)


def test_the_warm_shaft_is_bent_by_what_rows_and_load_do(solution: qs.SetSolution) -> None:
    shaft = solution.set.shaft
    assert shaft is not None and float(np.ravel(shaft.temperature)[0]) == temperature(solution, "shaft")
    assert not any(bad.any() for bad in wrong_of(solution).values())


def test_growth_presses_the_pair(solution: qs.SetSolution) -> None:
    """How far both rows together are pressed, of their displacements: by preload, stretch of the shaft, and heat."""
    cold = solution.unmounted
    assert cold is not None

    def pressed(of: qs.SetSolution) -> float:
        """Less what the shaft stretches between the rows."""
        first, second = (float(np.ravel(row.displacement[..., 0])[0]) for row in of.rows)
        line = of.deflection([float(np.ravel(row.position)[0]) for row in of.set.rows])
        stretch = np.reshape(line, (-1, 2, 5))[0, :, 0]
        return first + second - float(stretch[0] - stretch[1])

    warm = [STEEL * (temperature(solution, body) - 20.0 - qs.zero_celsius) for body in ("shaft", "housing")]
    apart = -0.05 * (warm[0] - warm[1])  # back to back: a shaft that grows more than its housing relieves the pair
    assert abs(apart) > 0.3e-6
    assert pressed(solution) == pytest.approx(pressed(cold) * (1.0 + warm[0]) + apart, rel=1e-9)


def test_files_run_heat_and_report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One file: text, JSON, speeds, report; its curve over speed is followed once for the last two."""
    from qsbearing.files.scene_tables import input_tables

    follow = solving.follow_speeds
    followed: list[Any] = []

    def once(heated: Any, until: float) -> Any:
        if not followed:
            followed.append(follow(heated, until))
        return followed[0]

    monkeypatch.setattr(solving, "follow_speeds", once)
    of = spindle()
    path = tmp_path / "spindle.json"
    path.write_text(json.dumps({"version": qs.__version__, "input": input_tables(of)}))
    run = CliRunner().invoke(cli, ["run", str(path)])
    assert run.exit_code == 0, run.output
    assert "tool" in run.stdout and "Temperatures" in run.stdout
    found = json.loads(CliRunner().invoke(cli, ["run", str(path), "--json"]).stdout)
    assert found["thermal"]["verdict"] == "stable" and "tool" in str(found["shaft"])
    again = json.loads(CliRunner().invoke(cli, ["heat", str(path), "--json"]).stdout)
    assert again["thermal"]["temperatures_C"]["shaft"] == found["thermal"]["temperatures_C"]["shaft"]
    made = CliRunner().invoke(cli, ["report", str(path), "--out", str(tmp_path)])
    assert made.exit_code == 0, made.output
    page = (tmp_path / "spindle_report.html").read_text(encoding="utf-8")
    table = page[page.index("Shaft section 1") :]
    assert "tool" in page and all(each in table for each in ("Shaft section 2", "Load on the shaft 1", "length_mm"))
