"""A result holds its input: read back it is the same scene, and solved again the same numbers to the last bit."""

from __future__ import annotations

import dataclasses
import json
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result
from hypothesis import assume, given
from hypothesis import strategies as st

import qsbearing as qs
from qsbearing.files import catalogue
from qsbearing.files.scene_file import load_scene, scene_of
from qsbearing.files.scene_or_set import is_set
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from qsbearing.model.scene.scene import Scene
from qsbearing.readings.asked import with_defaults
from tests.cli.command import call
from tests.files.test_fuzzed_files import scene_text
from tests.qsbearing.any_scene import CHOICES, bearings, few, operations

OWN = """
[bearing]
ball_count = 14
ball_diameter_mm = 12.7
pitch_diameter_mm = 70.0
inner_groove_radius_mm = 6.6
outer_groove_radius_mm = 6.7
diametral_clearance_mm = 0.0432
ball_material = "silicon nitride"
ring_material = {elastic_modulus_GPa=205, poisson_ratio = 0.29, density_kg_m3 = 7850, thermal_expansion_per_K = 12e-6}
[operation]
speed_rpm = 12345.678
outer_speed_rpm = -200
radial_load_y_N = 311.7
tilt_z_mrad = 0.13
moment_y_Nm = 1.7
radial_displacement_z_um = 0.9
first_ball_azimuth_deg = 3.3
[preload]
rigid_N = 517.3
[effects]
ball = ["gyroscopic_moment", "centrifugal_force"]
raceway_control = "per_ball"
moment_shares = "harris"
friction_coefficient = 0.0731
hertz_angle = "actual"
orbit_radius = "displaced"
ball_diameter_deviations_um = [0.1, 0.2, -0.3, 0.4, 0.5, 0.1, 0.7, 0.8, 0.9, 0.3, 0.11, 0.12, 0.13, 0.14]
[effects.ring_expansion]
bore_diameter_mm = 50
outside_diameter_mm = 90.0
shaft_interference_um = 7.3
shaft_bore_diameter_mm = 11.0
housing_interference_um = -2.1
housing_outside_diameter_mm = 120.0
inner_ring_temperature_C = 41.7
outer_ring_temperature_C = 33.9
shaft_temperature_C = 40.1
housing_temperature_C = 29.3
shaft_material = "steel"
housing_material = {elastic_modulus_GPa=71, poisson_ratio=0.33, density_kg_m3 = 2700, thermal_expansion_per_K = 2.31e-5}
[effects.ball_expansion]
ball_temperature_C = 55.3
reference_temperature_C = 21.7
[readings.life]
reliability = 0.953
rating_factor = 1.21
capacity = "lundberg_palmgren"
[readings.lubricant]
iso_viscosity_grade = 32
oil_temperature_C = 45.7
[readings.film]
ball_roughness_um = 0.021
raceway_roughness_um = 0.13
[readings.overrun]
inner_shoulder_diameter_mm = 66.7
"""
BY_NAME = """
[bearing]
name = "B218"
[operation]
speed_rpm = 10000
axial_load_N = 3000
radial_load_y_N = 4000
tilt_z_mrad = 0
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"
"""
MODIFIED = BY_NAME.replace('"B218"', '"ISO16281_7ball"\nball_material = "silicon nitride"').replace("4000", "400")
SET = """
[[rows]]
position_mm = 0.0
carries = "-x"
offset_um = 1.7
[rows.bearing]
name = "7210C"
[rows.readings.life]
[[rows]]
position_mm = 31.7
carries = "+x"
[rows.bearing]
name = "7210C"
ball_count = 13
[rows.ring_expansion]
bore_diameter_mm = 50
outside_diameter_mm = 90
inner_ring_temperature_C = 33.3
[shaft]
reference_position_mm = 12.3
[operation]
speed_rpm = 9000
radial_load_y_N = 517.1
moment_z_Nm = 3.1
[preload]
rigid_N = 433.1
[effects]
ball = ["centrifugal_force"]
raceway_control = "outer"
"""
COMMON = (
    SET.replace('[rows.bearing]\nname = "7210C"\nball_count = 13\n', "").replace('[rows.bearing]\nname = "7210C"\n', "")
    + '[bearing]\nname = "7210C"\n'
)
SPECTRUM = (
    BY_NAME.replace("axial_load_N = 3000\n", "")
    + "[readings.life]\n"
    + "[[spectrum]]\nshare = 0.3\naxial_load_N = 2711.3\n"
    + "[[spectrum]]\nshare = 0.7\naxial_load_N = 1000\nspeed_rpm = 7e3\n"
)
AUTO = 'effects = "auto"\ntolerance = 0.02\n' + BY_NAME.partition("[effects]")[0]
FILES = {
    "own": OWN, "by_name": BY_NAME, "modified": MODIFIED, "set": SET, "common": COMMON, "spectrum": SPECTRUM,
    "auto": AUTO,
}  # fmt: skip


def read(tables: dict[str, Any], label: str = "file") -> Any:
    return (set_of if is_set(tables) else scene_of)(tables, "test", label)


def parts(of: Any) -> Any:
    """All that it holds, as plain data that compares to the last bit; of readings also what counts if not given."""
    if dataclasses.is_dataclass(of):
        held = {each.name: getattr(of, each.name) for each in dataclasses.fields(of)}
        if held.get("readings"):
            held["readings"] = {name: with_defaults(name, asked) for name, asked in held["readings"].items()}
        return {name: parts(each) for name, each in held.items()}
    if isinstance(of, Mapping):
        return {name: parts(each) for name, each in of.items()}
    if isinstance(of, tuple | list):
        return [parts(each) for each in of]
    return of.tolist() if isinstance(of, np.ndarray) else of


def assert_comes_back(of: Any) -> None:
    label = of.bearing.name if isinstance(of, Scene) else of.name
    tables = json.loads(json.dumps(input_tables(of), allow_nan=False))
    assert parts(read(tables, label)) == parts(of)


def moved(value: Any, factors: list[float]) -> Any:
    """A document with its numbers moved a little, to ones with all their digits."""
    if isinstance(value, dict):
        return {key: each if key in ("ball_count", "share") else moved(each, factors) for key, each in value.items()}
    if isinstance(value, list):
        return [moved(each, factors) for each in value]
    if isinstance(value, bool | str):
        return value
    factors.append(factors.pop(0))
    return value * factors[0]


def test_the_input_says_what_counts_for_what_was_left_out_of_readings() -> None:
    """Each as if it were given: numbers that another version may choose otherwise."""
    oil = "[readings.lubricant]\niso_viscosity_grade = 68\noil_temperature_C = 70\n"
    bare = f"\n[readings.life]\n{oil}[readings.frequencies]\n"
    said = {
        "life": {
            "rating": "lundberg_palmgren", "rating_factor": 1.3, "capacity": "iso_16281", "reliability": 0.9,
            "fatigue_limit_by": "hertz",
        },
        "lubricant": {
            "iso_viscosity_grade": 68.0, "viscosity_index": 95.0, "oil_temperature_C": 70.0, "oil_density_kg_m3": 870.0
        },
        "frequencies": {},
    }  # fmt: skip
    assert input_tables(read(tomllib.loads(BY_NAME + bare)))["readings"] == said
    given = bare.replace("life]", "life]\nreliability = 0.95").replace("= 68", "= 68\noil_density_kg_m3 = 900")
    said["life"]["reliability"], said["lubricant"]["oil_density_kg_m3"] = 0.95, 900.0
    assert input_tables(read(tomllib.loads(BY_NAME + given)))["readings"] == said


@few
@given(st.sampled_from(list(FILES)), st.lists(st.floats(0.9999, 1.0001), min_size=7, max_size=7))
def test_a_file_of_any_numbers_comes_back(name: str, factors: list[float]) -> None:
    try:
        of = read(moved(tomllib.loads(FILES[name]), factors))
    except qs.SceneError:
        assume(False)
    assert_comes_back(of)


@few
@given(bearings(), operations(), CHOICES, st.booleans())
def test_any_scene_comes_back(
    bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any], by_clearance: bool
) -> None:
    """Out to the ends of every range, as a file gives it: no number of few digits among them."""
    document = tomllib.loads(scene_text(bearing, operation, choices))
    if by_clearance:
        angle = document["bearing"].pop("free_contact_angle_deg")
        document["bearing"]["diametral_clearance_mm"] = 0.05 * angle / 85.0
    try:
        of = read(document)
    except qs.SceneError:
        assume(False)
    assert_comes_back(of)


def test_every_entry_of_the_catalogue_comes_back_by_its_name() -> None:
    for entry in catalogue.entries():
        scene = load_scene(entry.name)
        assert input_tables(scene)["bearing"]["name"] == entry.name
        assert_comes_back(scene)


def test_a_scene_of_python_comes_back_or_says_what_no_file_has() -> None:
    bearing = qs.BallBearing(15, 9 * qs.mm, 60 * qs.mm, 4.7 * qs.mm, 4.7 * qs.mm, 25 * qs.deg)
    scene = qs.Scene(bearing, qs.Operation(3000 * qs.rpm))
    again = read(input_tables(scene), "")
    assert parts(again.bearing) == parts(bearing)
    assert qs.solve(again).displacement.tolist() == qs.solve(scene).displacement.tolist()
    turned = dataclasses.replace(bearing, free_contact_angle=np.array([0.3, 0.4]))
    wedged = dataclasses.replace(bearing, free_contact_angle=0.0, radial_interference=1e-6)
    assert parts(read(input_tables(dataclasses.replace(scene, bearing=wedged)), "").bearing) == parts(wedged)
    for field, wrong in (
        ("axial_load", dataclasses.replace(scene, operation=qs.Operation(axial_load=np.array([1.0, 2.0])))),
        ("free_contact_angle", dataclasses.replace(scene, bearing=turned)),
        ("tolerance", dataclasses.replace(scene, tolerance=0.01, hertz_form="hamrock_brewe_1983")),
    ):
        with pytest.raises(qs.SceneError, match=f"{field}.*has no form in a file"):
            input_tables(wrong)


# Through the command line -------------------------------------------------------------------------------------------


def found(result: Result) -> dict[str, Any]:
    """What was printed, but for the time that it took."""

    def timeless(value: dict[str, Any]) -> dict[str, Any]:
        return {key: each for key, each in value.items() if key != "seconds"}

    assert result.exit_code in (0, 1), result.output
    return dict(json.loads(result.stdout, object_hook=timeless))


@pytest.mark.parametrize("name", FILES)
def test_run_reproduces_a_result_from_itself(name: str, tmp_path: Path) -> None:
    file, kept = tmp_path / f"{name}.toml", tmp_path / "elsewhere.json"
    file.write_text(FILES[name], encoding="utf-8")
    first = call("run", file, "--json")
    kept.write_text(first.stdout, encoding="utf-8")
    file.unlink()
    again = call("run", kept, "--json")
    assert again.stderr == ""
    assert found(again) == found(first)


def test_with_accuracy_the_input_names_the_effects_that_were_chosen(tmp_path: Path) -> None:
    kept = tmp_path / "kept.json"
    first = call("run", "b218", "--json", "--accuracy", "1e-3")
    kept.write_text(first.stdout)
    one, other = found(first), found(call("run", kept, "--json"))
    assert one["input"]["effects"]["ball"]
    for key in ("input", "balls", "displacement", "stiffness_SI"):
        assert other[key] == one[key]


def test_the_input_is_whole() -> None:
    """The catalogue's numbers and the defaults of every choice stand in it."""
    given = found(call("run", "b218", "--json"))["input"]
    assert given["bearing"]["pitch_diameter_mm"] == 125.26
    assert given["effects"]["hertz_form"] == "exact"
    assert given["operation"]["first_ball_azimuth_deg"] == 0.0


def test_another_version_is_said(tmp_path: Path) -> None:
    kept = tmp_path / "kept.json"
    first = call("run", "b218", "--json")
    kept.write_text(first.stdout.replace(f'"version": "{qs.__version__}"', '"version": "0.0.7"'))
    again = call("run", kept, "--json")
    assert again.stderr == (
        f"qsbearing: {kept}: made by qsbearing 0.0.7; this is {qs.__version__}, whose numbers may differ\n"
    )
    assert found(again) == found(first)
    with pytest.warns(UserWarning, match="made by qsbearing 0.0.7"):
        qs.load_scene(kept)


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.json", "{", "is not JSON"),
        ("a.json", "[" * 100_000, "is nested deeper"),
        ("a.json", "[1]", "holds no input"),
        ("a.json", '{"version": "0.1.0", "input": {"bearing": 3}}', "bearing = 3"),
        ("a.json", '{"version": "0.1.0", "input": {"bearing": {"ball_count": NaN}}}', "NaN is no number of JSON"),
        ("a.json", '{"version": 1, "version": 2}', '"version" stands twice'),
        ("a.json", '{"version": "\\ud800"}', "half a character"),
        ("a.nc", "not netCDF", "is not a netCDF file"),
        ("none.json", None, "no such file"),
        ("none.nc", None, "no such file"),
    ],
)  # fmt: skip
def test_what_is_no_result_is_refused(name: str, content: str | None, said: str, tmp_path: Path) -> None:
    if content is not None:
        (tmp_path / name).write_text(content)
    for command in (["run"], ["explain"], ["sweep", "--vary", "speed_rpm=1,2"]):
        result = call(*command, tmp_path / name)
        assert result.exit_code == 2
        assert said in result.stderr
