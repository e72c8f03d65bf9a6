"""A spindle in a file: read, written, refused with every reason, shown and varied."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing import pictures
from qsbearing.cli import cli
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from qsbearing.reports import set_inputs
from qsbearing.results import shaft_report

SPINDLE = """\
[bearing]
name = "7210C"
bore_diameter_mm = 50
outside_diameter_mm = 90

[[rows]]
position_mm = 0
carries = "+x"
[rows.housing_stiffness]
radial_stiffness_N_per_um = 800
axial_stiffness_N_per_um = 500
[[rows]]
position_mm = 20
carries = "-x"
[[rows]]
position_mm = 150
carries = "+x"
[[rows]]
position_mm = 170
carries = "-x"

[shaft]
start_mm = -80
reference_position_mm = 10
temperature_C = 40
[[shaft.sections]]
length_mm = 80
outer_diameter_mm = 60
inner_diameter_mm = 20
[[shaft.sections]]
length_mm = 200
outer_diameter_mm = 50
inner_diameter_mm = 20
material = "100Cr6"
[[shaft.loads]]
position_mm = -70
axial_N = -200
radial_y_N = 500
[[shaft.supports]]
position_mm = 110
radial_y_stiffness_N_per_um = 5
[shaft.points]
tool_mm = -75

[housing]
temperature_C = 30
outside_diameter_mm = 140
[[spacers]]
rows = [1, 2]
inner_length_mm = 4
outer_length_mm = 4.002
[[floating]]
rows = [3, 4]
spring_N = 50
preload = { rigid_N = 300 }

[operation]
speed_rpm = 10000
moment_z_Nm = 0
[preload]
rigid_N = 720
[effects]
ball = ["centrifugal_force"]
raceway_control = "outer"
[effects.ring_expansion]
shaft_interference_um = 3
housing_interference_um = 0
"""


def read(text: str) -> qs.BearingSet:
    """The set of this file."""
    return set_of(tomllib.loads(text), "spindle.toml", "spindle")


def test_a_file_says_what_python_says() -> None:
    of = read(SPINDLE)
    mm, um = qs.mm, qs.um
    assert of.reference_position == 10 * mm
    assert of.shaft is not None
    assert of.shaft.start == -80 * mm
    assert of.shaft.temperature == 40.0 + qs.zero_celsius
    assert [each.length for each in of.shaft.sections] == [80 * mm, 200 * mm]
    assert [each.material.name for each in of.shaft.sections] == ["steel", "100Cr6"]
    assert of.shaft.loads == (qs.ShaftLoad(-70 * mm, axial=-200.0, radial_y=500.0),)
    assert of.shaft.supports == (qs.ShaftSupport(110 * mm, radial_y=5 / um),)
    assert of.shaft.points == {"tool": pytest.approx(-75 * mm)}
    assert of.housing == qs.Housing(30.0 + qs.zero_celsius)
    assert of.spacers == (qs.Spacer((1, 2), 4 * mm, 4.002 * mm),)
    assert of.floating == (qs.FloatingGroup((3, 4), 50.0, qs.Preload(rigid=300.0)),)
    assert of.rows[0].housing_stiffness == qs.HousingStiffness(axial=500 / um, radial=800 / um)
    assert of.rows[1].housing_stiffness is None
    (rings,) = of.effects_of(of.rows[0])
    assert rings.shaft_bore_diameter == 20 * mm
    assert rings.housing_outside_diameter == pytest.approx(140 * mm)


def test_what_is_written_is_what_was_read() -> None:
    of = read(SPINDLE)
    again = set_of(input_tables(of), "again", of.name)
    assert again == of
    matrix = np.diag([1e8, 2e8, 3e8, 1e5, 1e5]).tolist()
    other = read(
        SPINDLE.replace("radial_stiffness_N_per_um = 800\naxial_stiffness_N_per_um = 500", f"matrix_SI = {matrix}")
    )
    assert input_tables(other)["rows"][0]["housing_stiffness"]["matrix_SI"] == matrix


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("outer_diameter_mm = 50", "", "shaft.section 2.outer_diameter_mm: missing"),
        ("outer_diameter_mm = 50", "outer_diameter_mm = 5", "shaft.section 2.inner_diameter_mm = 20 mm: is not within"),
        ("outer_diameter_mm = 50", "outer_diameter = 50", "Did you mean outer_diameter_mm"),
        ("radial_y_N = 500", "radial_y_kN = 0.5", "Did you mean radial_y_N = 500? (0.5 kN)"),
        ("position_mm = -70", "position_mm = -700", "shaft.load 1.position_mm = -700 mm: is beyond the sections"),
        ("start_mm = -80", "start_mm = 80", "is beyond the sections"),
        ("tool_mm = -75", "tool = -75", "shaft.points.tool = -75 mm: is not a position"),
        ("rows = [1, 2]", "rows = [1, 7]", "spacer 1.rows = [1, 7]: are not valid numbers of rows"),
        ("rows = [3, 4]", 'rows = "3"', "floating 1.rows = '3': are no numbers"),
        ("axial_stiffness_N_per_um = 500", "axial_stiffness_N_per_um = -5", "row 1.housing_stiffness.axial_stiffness"),
        ("material = \"100Cr6\"", "material = \"100Cr\"", "Did you mean 100cr6"),
        ("[housing]", "[housing]\ntemperature_K = 3", "unknown key"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_by_the_files_own_keys(old: str, new: str, said: str) -> None:
    assert old in SPINDLE
    with pytest.raises(qs.SceneFileError) as caught:
        read(SPINDLE.replace(old, new, 1))
    assert said in str(caught.value)


def test_a_shaft_without_sections_is_rigid_or_refused() -> None:
    pair = SPINDLE[: SPINDLE.index("[shaft]")] + "[operation]\naxial_load_N = 10\n"
    assert read(pair + "[shaft]\nreference_position_mm = 3\n").shaft is None
    with pytest.raises(qs.SceneFileError, match="sections"):
        read(pair + "[shaft]\nstart_mm = 3\n")
    with pytest.raises(qs.SceneFileError, match=r"shaft\.points.* is not a table"):
        read(pair + "[shaft]\npoints = 3\n")
    loaded = read(pair + "[[shaft.loads]]\nposition_mm = 3\nradial_y_N = 4\n").shaft
    assert loaded == qs.Shaft(loads=(qs.ShaftLoad(3 * qs.mm, radial_y=4.0),))


MACHINE = """\
gravity_m_s2 = [0, -9.81, 0]
[[shaft.masses]]
position_mm = -60
mass_kg = 4
polar_inertia_kg_m2 = 0.01
[[shaft.sections]]
length_mm = 30
outer_diameter_mm = 50
inner_diameter_mm = 20
end_outer_diameter_mm = 40
end_inner_diameter_mm = 15
"""
"""What a shaft may have besides."""
HEAVY = (
    SPINDLE.replace("[shaft]", "[shaft]\n" + MACHINE.partition("\n")[0])
    .replace("[shaft.points]", MACHINE.partition("\n")[2] + "[shaft.points]")
    .replace("position_mm = 150", "position_mm = 150\nhousing_tilt_z_mrad = 0.2\nhousing_radial_y_um = 5")
)


def test_weight_cones_and_alignment_are_read_written_and_shown() -> None:
    of = read(HEAVY)
    assert of.shaft is not None
    assert of.shaft.gravity == (0.0, -9.81, 0.0)
    assert of.shaft.masses == (qs.ShaftMass(-60 * qs.mm, 4.0, polar_inertia=0.01),)
    assert of.shaft.sections[-1].outer_diameters == (50 * qs.mm, 40 * qs.mm)
    assert (of.rows[2].housing_tilt_z, of.rows[2].housing_radial_y) == (0.2 * qs.mrad, 5 * qs.um)
    assert of.rows[2].housing_tilt_y is None and not of.rows[0].is_out_of_line
    assert set_of(input_tables(of), "again", of.name) == of
    page = str(set_inputs.section(of, ""))
    for shown in ("gravity_m_s2", "mass_kg", "housing_tilt_z_mrad", "end_outer_diameter_mm"):
        assert shown in page
    line = shaft_report.shaft_record(qs.solve_set(of))
    assert line is not None
    assert "mass 1" in [each["at"] for each in line["line"]]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[0, -9.81, 0]", "-9.81", "shaft.gravity_m_s2: is not an acceleration"),
        ("mass_kg = 4", "mass_kg = -4", "shaft.mass 1.mass_kg = -4 kg: is negative"),
        ("mass_kg = 4", "", "shaft.mass 1.mass_kg: missing"),
        ("tilt_z_mrad = 0.2", "tilt_z_deg = 2", "Did you mean housing_tilt_z_mrad = 34.90658504"),
        ("end_outer_diameter_mm = 40", "end_outer_diameter_mm = 4", "section 3.end_inner_diameter_mm = 15 mm"),
    ],
)
def test_what_is_wrong_with_them_is_said_by_their_keys(old: str, new: str, said: str) -> None:
    assert old in HEAVY
    with pytest.raises(qs.SceneFileError) as caught:
        read(HEAVY.replace(old, new, 1))
    assert said in str(caught.value)


def test_run_shows_the_shaft(tmp_path: Path) -> None:
    (tmp_path / "spindle.toml").write_text(SPINDLE)
    done = CliRunner().invoke(cli, ["run", str(tmp_path / "spindle.toml"), "--json"])
    assert done.exit_code == 0, done.output
    found: dict[str, Any] = json.loads(done.stdout)["shaft"]
    tool = qs.solve_set(read(SPINDLE)).points["tool"]
    shown = found["points"]["tool"]
    assert shown["displacement"]["radial_y_um"] == pytest.approx(tool.displacement[1] / qs.um)
    assert shown["effective_stiffness"]["radial_y_N_per_um"] == pytest.approx(tool.effective_stiffness[1] * qs.um)
    assert sum(part["radial_y"] for part in shown["shares"].values()) == pytest.approx(1.0)
    assert [each["at"] for each in found["line"]][:4] == ["begin", "tool", "load 1", "row 1"]
    table = CliRunner().invoke(cli, ["run", str(tmp_path / "spindle.toml")]).stdout
    assert "Point tool, at −75 mm" in table
    assert "housing 1" in table


def test_points_are_results_of_a_sweep(tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    (tmp_path / "spindle.toml").write_text(SPINDLE)
    vary = {"speed_rpm": [0, 10000], "radial_load_y_N": [0, 100]}
    found = qs.sweep(qs.Study.of(tmp_path / "spindle.toml", vary))
    tool = qs.solve_set(read(SPINDLE)).points["tool"]
    assert found["tool_displacement_radial_y"][1, 0] == pytest.approx(tool.displacement[1] / qs.um)
    assert found["tool_effective_stiffness_radial_y"][1, 0] == pytest.approx(tool.effective_stiffness[1] * qs.um)
    assert found["tool_displacement_radial_y"][1, 1] > found["tool_displacement_radial_y"][1, 0]


def test_the_picture_states_its_scale() -> None:
    figure = pictures.deformed_shaft(qs.solve_set(read(SPINDLE)))
    (axes,) = figure.axes
    assert axes.get_title() == "Shaft in the plane xy: deflection × 2000"
    assert any("tool: 5.35 µm" in text.get_text() for text in axes.texts)
    (legend,) = figure.legends
    assert {"deformed shaft", "centre line"} <= {text.get_text() for text in legend.get_texts()}
    rigid = SPINDLE[: SPINDLE.index("[shaft]")] + "[operation]\naxial_load_N = 9\n"
    with pytest.raises(ValueError, match="rigid"):
        pictures.deformed_shaft(qs.solve_set(read(rigid)))
