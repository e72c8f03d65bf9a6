"""What ring and ball expansion refuse, all at once, and how their results are written."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.reports.inputs import effect_lines
from tests.qsbearing.scenes import B218
from tests.systems.sets.arrangements import PAIR_FILE

HEAD = """
[bearing]
name = "B218"
[operation]
speed_rpm = 9000
axial_load_N = 6000
"""
GOOD = """
[effects.ring_expansion]
bore_diameter_mm = 90
outside_diameter_mm = 160
shaft_interference_um = 25
inner_ring_temperature_C = 70
[effects.ball_expansion]
ball_temperature_C = 60
"""


def refused(tmp_path: Path, text: str) -> dict[str, str]:
    """The errors of a file, by key."""
    file = tmp_path / "scene.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(qs.SceneFileError) as caught:
        qs.load_scene(file)
    assert CliRunner().invoke(cli, ["run", str(file)]).exit_code == 2
    return {error.key.removeprefix("effects.ring_expansion."): str(error) for error in caught.value.errors}


def test_all_that_is_wrong_is_told_at_once(tmp_path: Path) -> None:
    found = refused(
        tmp_path,
        HEAD.replace("6000", "1e12")
        + """
        [effects.ring_expansion]
        bore_diameter_mm = 90
        shaft_interference_um = 2000
        housing_temperature_C = 30
        shaft_material = "stel"
        inner_ring_temperature_C = -300
        yield_strength_MPa = 1
        [effects.ball_expansion]
        """,
    )
    words = {
        "operation.axial_load_N": "too large",
        "shaft_interference_um": "allowed: -900 to 900 µm",
        "housing_temperature_C": "housing_interference_um (0 for a fit line to line)",
        "shaft_material": "Did you mean steel?",
        "inner_ring_temperature_C": "-300 °C: is below absolute zero",
        "yield_strength_MPa": "too small",
        "effects.ball_expansion.ball_temperature_C": "missing",
    }
    assert words.keys() <= found.keys()
    for key, word in words.items():
        assert word in found[key], key


def test_rings_must_be_around_the_grooves(tmp_path: Path) -> None:
    found = refused(
        tmp_path,
        HEAD
        + """
        [effects.ring_expansion]
        bore_diameter_mm = 104
        outside_diameter_mm = 146
        shaft_interference_um = 0
        shaft_bore_diameter_mm = 120
        housing_interference_um = 0
        housing_outside_diameter_mm = 130
        """,
    )
    assert "is not within the bottom of the inner groove, 102.79" in found["bore_diameter_mm"]
    assert "is not around the bottom of the outer groove, 147.72" in found["outside_diameter_mm"]
    assert "is not within the shaft's seat, 104 mm" in found["shaft_bore_diameter_mm"]
    assert "is not around the housing's seat, 146 mm" in found["housing_outside_diameter_mm"]


def test_a_fit_beyond_yield_is_refused_and_its_pressure_told(tmp_path: Path) -> None:
    """By Tresca at the bore: 2 p b^2/(b^2 - R^2) = E (I/2)/R for a solid shaft of the same steel."""
    text = HEAD + GOOD.replace("= 25", "= 850\nyield_strength_MPa = 1500")
    found = refused(tmp_path, text)["shaft_interference_um"]
    assert "makes the inner ring yield: a seat pressure of" in found
    assert f"stresses its bore by {208e3 * 0.425 / 45:.5g} MPa" in found
    assert f"allowed: -{1500 / 208e3 * 90e3:.6g} to {1500 / 208e3 * 90e3:.6g} µm" in found


def test_a_coefficient_that_nothing_uses_is_read_and_one_that_is_missing_named(tmp_path: Path) -> None:
    material = "{elastic_modulus_GPa = 208, poisson_ratio = 0.3, density_kg_m3 = 7800%s}"
    with_it, without = material % ", thermal_expansion_per_K = 12e-6", material % ""
    unused = HEAD.replace('"B218"', f'"B218"\nball_material = {with_it}\nring_material = {with_it}')
    file = tmp_path / "good.toml"
    file.write_text(unused)
    scene = qs.load_scene(file)
    assert scene.bearing.ball_material.thermal_expansion == 12e-6
    assert scene_of(input_tables(scene), "") == scene
    bare = HEAD.replace('"B218"', f'"B218"\nball_material = {without}\nring_material = {without}')
    assert set(refused(tmp_path, bare + GOOD)) == {
        "bearing.ball_material.thermal_expansion_per_K",
        "bearing.ring_material.thermal_expansion_per_K",
    }
    file.write_text(unused + GOOD)
    assert qs.solve(qs.load_scene(file)).converged


def test_a_seat_that_is_as_warm_as_its_ring_needs_a_coefficient(tmp_path: Path) -> None:
    seat = "shaft_material = {elastic_modulus_GPa = 208, poisson_ratio = 0.3, density_kg_m3 = 7800}"
    text = HEAD + GOOD.replace("[effects.ball", f"{seat}\n[effects.ball")
    assert set(refused(tmp_path, text)) == {"shaft_material.thermal_expansion_per_K"}


def test_results_say_which_temperatures_were_taken(tmp_path: Path) -> None:
    """A seat's that is left out is its ring's, in tables, JSON and the report's input."""
    file = tmp_path / "scene.toml"
    file.write_text(HEAD + GOOD, encoding="utf-8")
    found = json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).stdout)["temperatures"]
    assert found == {
        "shaft": {"temperature_C": 70.0, "from": "as the inner ring", "assumed": True},
        "inner_ring": {"temperature_C": 70.0, "from": "given", "assumed": False},
        "outer_ring": {"temperature_C": 20.0, "from": "reference temperature", "assumed": True},
        "housing": {"temperature_C": 20.0, "from": "as the outer ring", "assumed": True},
        "balls": {"temperature_C": 60.0, "from": "given", "assumed": False},
    }
    shown = [line.split() for line in CliRunner().invoke(cli, ["run", str(file)]).stdout.splitlines()]
    assert ["shaft", "70", "assumed:", "as", "the", "inner", "ring"] in shown
    lines = effect_lines(qs.load_scene(file).ring_effects)
    assert ("ring_expansion.shaft_temperature_C", "70", "°C", "assumed: as the inner ring") in lines
    assert json.loads(CliRunner().invoke(cli, ["run", "b218", "--json"]).stdout)["temperatures"] is None
    of_set = tmp_path / "set.toml"
    ring = GOOD.partition("[effects.ball")[0].replace("90", "50").replace("160", "90")
    of_set.write_text(PAIR_FILE.partition("[effects]")[0] + ring, encoding="utf-8")
    record = json.loads(CliRunner().invoke(cli, ["run", str(of_set), "--json"]).stdout)
    assert [row["temperatures"]["shaft"] for row in record["rows"]] == [found["shaft"]] * 2
    shown = [line.split() for line in CliRunner().invoke(cli, ["run", str(of_set)]).stdout.splitlines()]
    assert shown.count(["shaft", "70", "assumed:", "as", "the", "inner", "ring"]) == 1, "once for rows alike"


def test_a_table_in_the_wrong_place(tmp_path: Path) -> None:
    found = refused(tmp_path, HEAD + "[ring_expansion]\nbore_diameter_mm = 90\n")
    assert "Did you mean [effects.ring_expansion]?" in found["[ring_expansion]"]
    found = refused(tmp_path, HEAD + '[effects]\nball = ["ring_expansion"]\nshaft_interference_um = 9\n')
    assert "under [effects.ring_expansion]" in found["effects.shaft_interference_um"]


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"shaft_bore_diameter": 0.03}, "without shaft_interference the shaft has no effect"),
        ({"housing_interference": 0.0}, "housing_outside_diameter: missing"),
        ({"reference_temperature": 300.0}, "no other temperature is"),
        ({"reference_temperature": [300.0, [310.0]]}, "reference_temperature = .* is not a number"),
        ({"inner_ring_temperature": -5.0}, "below absolute zero"),
        ({"inner_ring_temperature": np.array([300.0, np.nan])}, "not a finite number"),
        ({"shaft_interference": 0.01}, "1% of the seat's diameter"),
        ({"shaft_interference": 0.0, "shaft_material": "steel"}, "is not a material"),
        ({"yield_strength": 1700.0}, "megapascals"),
    ],
)
def test_python_is_refused_alike(fields: dict[str, object], words: str) -> None:
    with pytest.raises(qs.SceneError, match=words):
        qs.RingExpansion(0.09, 0.16, **fields)


def test_scenes_refuse_what_is_no_ring_effect() -> None:
    operation, effect = qs.Operation(axial_load=1e3), qs.BallExpansion(300.0)
    two, three = qs.RingExpansion(0.09, 0.16, shaft_interference=np.zeros(2)), qs.BallExpansion(np.full(3, 300.0))
    for effects, words in (
        (effect, "a tuple of effects"),
        ((qs.CentrifugalForce(),), "a tuple of effects"),
        ((effect, effect), "names an effect twice"),
        ((two, three), "do not broadcast"),
        ((qs.RingExpansion(0.2, 0.3),), "ring_expansion.bore_diameter"),
    ):
        with pytest.raises(qs.SceneError, match=words):
            qs.Scene(B218, operation, ring_effects=effects)


def test_results_say_geometry_and_rings(tmp_path: Path) -> None:
    file, target = tmp_path / "scene.toml", tmp_path / "out.csv"
    file.write_text(HEAD + GOOD, encoding="utf-8")
    solution = qs.solve(qs.load_scene(file))
    found = json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).stdout)
    bearing = solution.scene.operating_bearing
    assert found["effects"] == ["ring_expansion", "ball_expansion"]
    geometry = found["operating_geometry"]
    assert geometry["free_contact_angle_deg"] == pytest.approx(bearing.free_contact_angle / qs.deg, rel=1e-12)
    assert geometry["diametral_clearance_um"] == pytest.approx(bearing.diametral_clearance / qs.um, rel=1e-12)
    inner = found["rings"]["inner"]
    assert inner["seat_pressure_MPa"] == pytest.approx(solution.inner_ring.seat_pressure / qs.MPa, rel=1e-12)
    assert found["rings"]["outer"]["seat_pressure_MPa"] is None
    shown = CliRunner().invoke(cli, ["run", str(file), "--csv", str(target)], env={"COLUMNS": "80"}).stdout
    assert "Ring expansion and ball expansion" in shown
    assert f"{inner['seat_pressure_MPa']:.6g}" in shown
    assert f"{geometry['free_contact_angle_deg']:.6g}" in shown
    unbroken = [line for line in shown.splitlines() if not line.startswith("    --set ")]  # one line, to be pasted
    assert max(map(len, unbroken)) <= 80
    with target.open(newline="") as written:
        row = next(csv.DictReader(written))
    assert float(row["operating_pitch_diameter_mm"]) == pytest.approx(geometry["pitch_diameter_mm"], rel=1e-12)
    assert float(row["inner_ring_seat_pressure_MPa"]) == pytest.approx(inner["seat_pressure_MPa"], rel=1e-12)
    assert float(row["ring_expansion_inner_ring_temperature_C"]) == 70.0
    assert "outer_ring_seat_pressure_MPa" not in row
    plain = json.loads(CliRunner().invoke(cli, ["run", "b218", "--json"]).stdout)
    assert plain["operating_geometry"] is plain["rings"] is None
