"""Located and floating deep-groove rows in files and by every door: what is read, refused, shown and written."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.documents.numbers import with_minus
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.schema import scene_schema
from qsbearing.files.stiffness_files import seats_of
from qsbearing.files.toml import tables_of
from tests.systems.sets.arrangements import PAIR_FILE, grooved_both_ways, solved

BEARING = """
[bearing]
kind = "deep_groove"
ball_count = 9
ball_diameter_mm = 11.90625
pitch_diameter_mm = 60
groove_radius_coefficient = 0.52
diametral_clearance_mm = 0.02
ball_material = "steel"
ring_material = "steel"
bore_diameter_mm = 40
outside_diameter_mm = 80
width_mm = 18
static_load_rating_N = 18000
dynamic_load_rating_N = 32000
"""
ROWS = """
[[rows]]
position_mm = 0
[[rows]]
position_mm = 200
carries = "none"
"""
CROSS = """
[[rows]]
position_mm = 0
carries = "-x"
[[rows]]
position_mm = 200
carries = "+x"
"""
OPERATION = """
[operation]
speed_rpm = 3000
axial_load_N = 800
radial_load_y_N = 2500
moment_z_Nm = 30
"""
HEAT = """
[effects.ring_expansion]
[effects.ball_expansion]
[readings.lubricant]
iso_viscosity_grade = 22
[readings.friction_estimate]
series = "62"
[thermal]
friction = "skf"
viscosity_at = "outer_ring"
[thermal.fixed]
ambient_C = 22
"""
HEAT += "".join(
    f'[[thermal.conductances]]\nbetween = ["{one}", "{other}"]\nW_per_K = {value}\n'
    for one, other, value in (
        ("inner_ring", "balls", 1.5),
        ("outer_ring", "balls", 1.5),
        ("inner_ring", "shaft", 6),
        ("outer_ring", "housing", 10),
        ("housing", "ambient", 4),
        ("shaft", "ambient", 1),
    )
)


def read(text: str) -> qs.BearingSet:
    found = scene_or_set_of(tables_of(text, Path("rows.toml")), "rows.toml")
    assert isinstance(found, qs.BearingSet)
    return found


def ran(file: Path, text: str, *arguments: str) -> Any:
    file.write_text(text)
    return CliRunner().invoke(cli, [arguments[0], str(file), *arguments[1:]], catch_exceptions=False)


def test_a_row_that_says_nothing_is_located() -> None:
    of = read(BEARING + ROWS + OPERATION)
    assert [str(row.carries) for row in of.rows] == ["both", "none"]
    assert [str(row.carries) for row in read(BEARING + ROWS.replace('"none"', '"-x"') + OPERATION).rows] == [
        "both",
        "-x",
    ]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (BEARING + ROWS.replace('"none"', '"no"') + OPERATION, 'row 2.carries = \'no\': is none of the choices'),
        (BEARING + ROWS + OPERATION + "[preload]\nrigid_N = 1\n", "row 1.carries: missing, and a preload"),
        (PAIR_FILE.replace('"-x"', '"both"'), "row 2.carries = 'both': is of deep-groove rows only"),
        (PAIR_FILE.replace('carries = "-x"', ""), "row 2.carries: missing"),
        (BEARING.replace("ball_count = 9", "ball_count = -9") + ROWS + OPERATION, "bearing.ball_count = -9"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said(text: str, said: str) -> None:
    with pytest.raises(SceneFileError) as caught:
        read(text)
    assert said in str(caught.value)


def test_a_wrong_bearing_is_the_only_error_of_a_row_that_may_say_nothing() -> None:
    own = BEARING.replace("[bearing]", "[rows.bearing]").replace("ball_count = 9", "ball_count = -9")
    with pytest.raises(SceneFileError) as caught:
        read(f"[[rows]]\nposition_mm = 0\n{own}{OPERATION}")
    assert len(caught.value.errors) == 1


def test_the_schema_takes_all_four_words_and_none() -> None:
    validator = jsonschema.Draft7Validator(scene_schema())
    for word in ("+x", "-x", "both", "none"):
        validator.validate(tables_of(BEARING + ROWS.replace("none", word) + OPERATION, Path("a.toml")))
    assert not validator.is_valid(tables_of(BEARING + ROWS.replace("none", "no") + OPERATION, Path("a.toml")))
    lacking = PAIR_FILE.replace('carries = "-x"', "")
    assert not validator.is_valid(tables_of(lacking, Path("a.toml")))
    assert validator.is_valid(tables_of(lacking.replace("7210C", "SKF 6210"), Path("a.toml")))


@pytest.mark.parametrize("ways", [("both", "none"), ("-x", "+x"), ("none", "both")])
def test_what_is_written_is_read_as_the_same_set(ways: tuple[str, str]) -> None:
    of = read(BEARING + ROWS + OPERATION)
    of = replace(of, rows=tuple(replace(row, carries=way) for row, way in zip(of.rows, ways, strict=True)))  # type: ignore[arg-type]
    again = scene_or_set_of(input_tables(of), "again")
    assert again.rows == of.rows  # type: ignore[union-attr]
    assert [row["carries"] for row in input_tables(of)["rows"]] == list(ways)


def test_run_shows_the_play_and_json_has_it(tmp_path: Path) -> None:
    file, text = tmp_path / "rows.toml", BEARING + ROWS + OPERATION
    shown = ran(file, text, "run").stdout
    found = json.loads(ran(file, text, "run", "--json").stdout)
    solution = solved(read(text))
    low, high = (float(each / qs.um) for each in solution.axial_play)  # type: ignore[union-attr]
    assert found["axial_play"] == pytest.approx({"from_um": low, "to_um": high})
    assert with_minus(f"Axial play: from {low:.6g} to {high:.6g} µm") in shown
    assert "2 rows, locating and floating" in shown and "in +x where that is both or none" in shown
    assert [row["axial_load_N"] for row in found["rows"]] == pytest.approx([800.0, 0.0], abs=1e-6)
    open_end = ran(file, text.replace("position_mm = 0\n", 'position_mm = 0\ncarries = "+x"\n'), "run", "--json").stdout
    assert json.loads(open_end)["axial_play"] == {"from_um": None, "to_um": pytest.approx(high)}
    assert json.loads(ran(file, PAIR_FILE, "run", "--json").stdout)["axial_play"] is None
    answered = ran(file, text + '[require]\naxial_play_to = "<= 50"\n', "run")
    assert answered.exit_code == 3


def test_a_spectrum_changes_which_ring_is_held(tmp_path: Path) -> None:
    """The thrust of each point on the row that is held against it; the life of both."""
    point = "speed_rpm = 3000\nradial_load_y_N = 2500\nmoment_z_Nm = 30"
    parts = ((0.6, 800), (0.4, -300))
    points = "".join(f"[[spectrum]]\nshare = {share}\naxial_load_N = {thrust}\n{point}\n" for share, thrust in parts)
    text = BEARING + CROSS + points + "[readings.life]\n"
    solution = solved(read(text))
    np.testing.assert_allclose(solution.axial_loads, [[0.0, 800.0], [300.0, 0.0]], atol=1e-5)
    assert ran(tmp_path / "spectrum.toml", text, "run").exit_code == 0


def test_a_sweep_knows_both_results(tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    file = tmp_path / "rows.toml"
    file.write_text(BEARING + CROSS + OPERATION)
    names = ["row_1_axial_load", "row_2_axial_load", "axial_play_from"]
    found = qs.sweep(qs.Study.of(file, {"axial_load_N": [-900.0, 900.0]}, quantities=names))
    np.testing.assert_allclose(found["row_1_axial_load"], [900.0, 0.0], atol=1e-5)
    np.testing.assert_allclose(found["row_2_axial_load"], [0.0, 900.0], atol=1e-5)
    assert np.all(found["axial_play_from"] < -90.0)


def test_a_warm_set_settles_with_a_row_that_floats() -> None:
    """SKF's torque of deep-groove bearings is another without thrust: a thrust of rounding must not be one."""
    operation = OPERATION.replace("speed_rpm = 3000", "speed_rpm = 6000").replace("2500", "900")
    solution = solved(read(BEARING + ROWS + operation + HEAT))
    assert solution.thermal is not None
    np.testing.assert_allclose(solution.axial_loads, [800.0, 0.0], atol=1e-5)
    one = solution.rows[1]
    estimates = []
    for thrust in (0.0, 1e-12 * 900.0):
        one.load[0] = thrust
        estimates.append(float(qs.readings.skf_torque(one, bore_diameter=0.04, outside_diameter=0.08,
                         kinematic_viscosity=2e-5, series="62", static_load_rating=18e3).torque))  # fmt: skip
    assert estimates[0] == estimates[1]


def test_a_report_and_the_page_take_it(tmp_path: Path) -> None:
    pytest.importorskip("starlette")
    from qsbearing.app import answers

    text = BEARING + ROWS + OPERATION
    answer = answers.opened(text, "rows")
    shown = answers.solved(answer["document"], "rows")
    assert [row["name"] for row in shown["rows"]] == ["Row 1 (carries both ways)", "Row 2 (floats)"]
    done = ran(tmp_path / "rows.toml", text, "report", "--out", str(tmp_path))
    assert done.exit_code == 0
    page = (tmp_path / "rows_report.html").read_text(encoding="utf-8")
    assert "locating and floating" in page and "Axial play: from" in page and "No preload presses the rows" in page


def test_springs_of_a_located_row_stand_in_its_middle_plane() -> None:
    """A tilt about the middle of one bearing on an unloaded shaft moves its grooves along x alone: no force across."""
    row = qs.Row(grooved_both_ways(20 * qs.um), 0.0)
    pressed = solved(qs.BearingSet((row,), qs.Operation(axial_load=500.0, tilt_y=0.0, tilt_z=0.0, radial_load_y=0.0)))
    (seat,) = seats_of(pressed, "N-m-kg")
    np.testing.assert_allclose(
        seat.stiffness, pressed.stiffness, rtol=1e-9, atol=1e-6 * np.abs(pressed.stiffness).max()
    )
