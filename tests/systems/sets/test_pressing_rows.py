"""Deep-groove rows that press each other through their clearances: said wherever they do, and nowhere else."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.results.set_record import set_record
from tests.systems.sets.arrangements import ROWS, S6210C, grooved_both_ways, rows, solved

FILE = """
rows = [{position_mm = -100, carries = "+x"}, {position_mm = 100, carries = "-x"}]
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
"""


def said_of(solution: qs.SetSolution) -> list[tuple[tuple[int, ...], float]]:
    """(rows, force) of each such remark."""
    remarks = set_record(solution, [{}] * len(solution.rows))["remarks"]
    return [(each["of"]["rows"], each["values"]["pressed_N"]) for each in remarks if each["code"] == "rows_press"]


RADIAL = qs.Operation(radial_load_y=1000.0, moment_z=0.0)


@pytest.mark.parametrize("arrangement", sorted(ROWS))
@pytest.mark.parametrize("clearances", [(10.0, 40.0), (10.0, 10.0), (60.0, 25.0)])
def test_what_rows_press_each_other_with_is_said(arrangement: str, clearances: tuple[float, ...]) -> None:
    """Of any number of rows: what those pushed in +x carry is what those pushed in -x do, since nothing else acts."""
    bearings = [grooved_both_ways(each * qs.um) for each in clearances]
    found = solved(qs.BearingSet(rows(arrangement, *bearings, distance=0.1), RADIAL))
    along = found.axial_loads * [row.sign for row in found.set.rows]
    force = np.maximum(along, 0.0).sum()
    assert force == pytest.approx(np.maximum(-along, 0.0).sum(), rel=1e-6)
    if force < 1.0:
        assert said_of(found) == []
    else:
        ((which, pressed),) = said_of(found)
        assert pressed == pytest.approx(force, rel=1e-9)
        assert set(which) == {n for n, load in enumerate(along, 1) if abs(load) > 1e-3 * 1000.0}


def test_nothing_is_said_where_nothing_presses_or_it_is_meant() -> None:
    """A row that slides; thrust, which both carry; angular contact; and a pressure that offsets or a preload state."""
    pressed = qs.BearingSet(rows("DB", grooved_both_ways(10 * qs.um), distance=0.2), RADIAL)
    assert len(said_of(solved(pressed))) == 1
    first, second = pressed.rows
    for other in (
        replace(pressed, floating=(qs.FloatingGroup((2,)),)),
        replace(pressed, operation=qs.Operation(axial_load=500.0)),
        replace(pressed, rows=rows("DB", S6210C)),
        replace(pressed, preload=qs.Preload(rigid=100.0)),
        replace(pressed, rows=(replace(first, offset=2 * qs.um), second)),
    ):
        assert said_of(solved(other)) == []


def test_of_several_cases_each_has_its_own() -> None:
    of = qs.BearingSet(rows("DB", grooved_both_ways(10 * qs.um), distance=0.2), RADIAL)
    many = solved(replace(of, operation=replace(RADIAL, radial_load_y=np.array([1000.0, 10.0, 3000.0]))))
    forces = [next(each.remark.values["pressed_N"] for each in qs.warnings(many, k) if "press" in each) for k in (0, 2)]
    np.testing.assert_allclose(forces, many.axial_loads[[0, 2], 0], rtol=1e-12)


def test_run_and_json_say_it_with_a_line_that_lets_a_row_slide(tmp_path: Path) -> None:
    file = tmp_path / "pair.toml"
    file.write_text(FILE)
    shown = " ".join(CliRunner().invoke(cli, ["run", str(file)]).stdout.split())
    (said,) = (each for each in json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).stdout)["warnings"]
               if "press each other" in each)  # fmt: skip
    assert "Rows 1 and 2: The rows press each other axially with 87.25 N" in said
    assert said.rstrip(".") in shown
    line = said.partition("slide: ")[2].rstrip(".")
    file.write_text(f"{line}\n{FILE}")
    assert "press each other" not in CliRunner().invoke(cli, ["run", str(file)]).stdout
