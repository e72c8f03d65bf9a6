"""Deep-groove rows that press each other through their clearances: said wherever they do, and nowhere else."""

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
from qsbearing.results.set_record import set_record
from qsbearing.systems.sets.set_solution import ends_of
from tests.systems.sets.arrangements import ROWS, S6210C, grooved_both_ways, rows, solved

FILE = """
rows = [{position_mm = -100}, {position_mm = 100}]
operation = {radial_load_y_N = 1000, moment_z_Nm = 0}
[bearing]
kind = "deep_groove"
ball_count = 9
ball_diameter_mm = 11.90625
pitch_diameter_mm = 60
groove_radius_coefficient = 0.52
diametral_clearance_mm = 0.01
ball_material = "steel"
ring_material = "steel"
[shaft]
start_mm = -150
temperature_C = 100
sections = [{length_mm = 300, outer_diameter_mm = 40}]
"""
RADIAL = qs.Operation(radial_load_y=1000.0, moment_z=0.0)


def said_of(solution: qs.SetSolution) -> list[tuple[tuple[int, ...], float]]:
    """(rows, force) of each such remark."""
    remarks = set_record(solution, [{}] * len(solution.rows))["remarks"]
    return [(each["of"]["rows"], each["values"]["pressed_N"]) for each in remarks if each["code"] == "rows_press"]


def warm(placed: tuple[qs.Row, ...], by: float = 80.0, **around: Any) -> qs.BearingSet:
    """On a shaft warmer than its housing."""
    shaft = qs.Shaft((qs.ShaftSection(1.0, 0.04),), -0.5, temperature=293.15 + by)
    return qs.BearingSet(placed, around.pop("operation", RADIAL), shaft=shaft, **around)


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize("clearances", [(10.0, 40.0), (10.0, 10.0), (60.0, 25.0)])
def test_what_rows_press_each_other_with_is_said(count: int, clearances: tuple[float, ...]) -> None:
    """Of any number of rows: what those pushed in +x carry is what those pushed in -x do, since nothing else acts."""
    bearings = [grooved_both_ways(each * qs.um) for each in clearances]
    placed = tuple(qs.Row(bearings[n % 2], 0.35 * (n - 0.5 * (count - 1))) for n in range(count))
    found = solved(warm(placed))
    along = found.axial_loads
    force = np.maximum(along, 0.0).sum()
    assert force > 1.0 and force == pytest.approx(np.maximum(-along, 0.0).sum(), rel=1e-6)
    ((which, pressed),) = said_of(found)
    assert pressed == pytest.approx(force, rel=1e-9)
    assert set(which) == {n for n, load in enumerate(along, 1) if abs(load) > 1e-3 * ends_of(found)[0].largest[0]}


@pytest.mark.parametrize("arrangement", sorted(ROWS))
def test_rows_at_their_places_do_not_press_each_other(arrangement: str) -> None:
    """Whatever their clearances, a radial load alone presses no row along the shaft."""
    for clearances in ((10.0, 40.0), (60.0, 25.0)):
        bearings = [grooved_both_ways(each * qs.um) for each in clearances]
        assert said_of(solved(qs.BearingSet(rows(arrangement, *bearings, distance=0.1), RADIAL))) == []


def test_nothing_is_said_where_nothing_presses_or_it_is_meant() -> None:
    """A row that slides; thrust, which both carry; angular contact; and a pressure that offsets or a preload state."""
    deep = grooved_both_ways(10 * qs.um)
    pressed = warm((qs.Row(deep, -0.1), qs.Row(deep, 0.1)))
    assert len(said_of(solved(pressed))) == 1
    first, second = pressed.rows
    for other in (
        replace(pressed, floating=(qs.FloatingGroup((2,)),)),
        replace(pressed, rows=(first, replace(second, carries="none"))),  # type: ignore[arg-type]
        qs.BearingSet((first, second), qs.Operation(axial_load=500.0)),
        warm(rows("DB", S6210C), 20.0),
        qs.BearingSet(rows("DB", deep), RADIAL, qs.Preload(rigid=100.0)),
        replace(pressed, rows=(replace(first, offset=2 * qs.um), second)),
    ):
        assert said_of(solved(other)) == []


def test_of_several_cases_each_has_its_own() -> None:
    deep = grooved_both_ways(10 * qs.um)
    of = warm((qs.Row(deep, -0.1), qs.Row(deep, 0.1)))
    shaft = replace(of.shaft, temperature=293.15 + np.array([80.0, -80.0, 90.0]))  # type: ignore[type-var]
    held = (replace(row, carries=way) for row, way in zip(of.rows, ("-x", "+x"), strict=True))  # type: ignore[arg-type]
    many = solved(replace(of, shaft=shaft, rows=tuple(held)))
    forces = [next(each.remark.values["pressed_N"] for each in qs.warnings(many, k) if "press" in each) for k in (0, 2)]
    np.testing.assert_allclose(forces, many.axial_loads[[0, 2], 1], rtol=1e-12)
    assert not any("press each other" in each for each in qs.warnings(many, 1))  # both rings have drawn away


def test_run_and_json_say_it_with_a_line_that_lets_a_row_slide(tmp_path: Path) -> None:
    file = tmp_path / "pair.toml"
    file.write_text(FILE)
    shown = " ".join(CliRunner().invoke(cli, ["run", str(file)]).stdout.split())
    found = json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).stdout)
    (said,) = (each for each in found["warnings"] if "press each other" in each)
    pressed = found["rows"][1]["axial_load_N"]
    assert f"Rows 1 and 2: The rows press each other axially with {pressed:.4g} N" in said
    assert said.rstrip(".") in shown
    line = said.partition("slide: ")[2].rstrip(".")
    file.write_text(FILE.replace("{position_mm = 100}", f"{{position_mm = 100, {line}}}"))
    assert "press each other" not in CliRunner().invoke(cli, ["run", str(file)]).stdout
