"""Readings asked for in a scene file: the same numbers in JSON, tables and columns; every fault at once."""

from __future__ import annotations

import json
import re
import tomllib
from collections import Counter
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.documents.html import html
from qsbearing.documents.terminal import text_of
from qsbearing.files.file_keys import IN_FILE
from qsbearing.files.scene_file import scene_of
from qsbearing.readings import asked
from qsbearing.reports.document import document as design_report
from qsbearing.results.json_record import record
from qsbearing.results.readings_record import taken
from qsbearing.results.report import result
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep
from tests.guide.pages import GUIDE, blocks

BASE: dict[str, Any] = {
    "bearing": {"name": "B218"},
    "operation": {"speed_rpm": 8000, "axial_load_N": 12000, "radial_load_y_N": 3000, "tilt_z_mrad": 0},
    "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"},
}
ALL: dict[str, Any] = {
    "life": {"cleanliness": "oil_15_12", "reliability": 0.95, "rating": "iso_281"},
    "static_safety": True,
    "kinematics": {},
    "frequencies": True,
    "lubricant": {"iso_viscosity_grade": 68, "oil_temperature_C": 70},
    "film": {"ball_roughness_um": 0.05, "raceway_roughness_um": 0.2},
    "friction": {"friction_coefficient": 0.05, "drag_coefficient": 0.5, "fluid_density_kg_m3": 20},
    "ball_slip": {
        "friction_coefficient": 0.05,
        "drag_coefficient": 0.5,
        "least_oil_share": 0.02,
        "most_oil_share": 0.2,
        "minimum_load_factor_N": 30,
    },
    "pivot_points": True,
    "ball_advance": {"pocket_clearance_mm": 0.2},
    "friction_estimate": {
        "bore_diameter_mm": 90,
        "outside_diameter_mm": 160,
        "static_load_rating_N": 85e3,
        "lubrication_factor": 2.0,
    },
    "overrun": {"outer_shoulder_diameter_mm": 139},
    "stress": True,
}


OF_ONE_POINT = set(asked.READINGS) - {"spectrum"}
"""The shares of a spectrum need several operating points."""


def scene(**readings: Any) -> qs.Scene:
    return scene_of(BASE | {"readings": readings}, "test")


def file_of(document: dict[str, Any]) -> str:
    """As TOML; what is no table of its own is written inline."""

    def value(of: Any) -> str:
        if isinstance(of, dict):
            return "{" + ", ".join(f"{key} = {value(each)}" for key, each in of.items()) + "}"
        return json.dumps(of)

    tables = (
        f"[{name}]\n" + "".join(f"{key} = {value(each)}\n" for key, each in table.items())
        for name, table in document.items()
    )
    return "\n".join(tables)


def count_takes(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often each reading is taken, from now on."""
    counts: Counter[str] = Counter()

    def counted(name: str, take: Any) -> Any:
        def counting(*arguments: Any) -> Any:
            counts[name] += 1
            return take(*arguments)

        return counting

    for name, each in asked.READINGS.items():
        monkeypatch.setitem(asked.READINGS, name, replace(each, take=counted(name, each.take)))
    return counts


def faults(document: dict[str, Any]) -> dict[str, str]:
    """Key and text of every fault of a file."""
    with pytest.raises(qs.SceneError) as caught:
        scene_of(document, "test")
    return {error.key: str(error) for error in caught.value.errors}  # type: ignore[attr-defined]


def test_each_reading_of_a_file_is_the_function_s() -> None:
    solution = qs.solve(scene(**ALL))
    once = taken(solution)
    found = json.loads(json.dumps(record(solution, once)["readings"], allow_nan=False))
    assert set(found) == set(ALL) - {"lubricant"}
    oil = qs.readings.Lubricant.from_grade(68).at(70 + 273.15)
    kappa = qs.readings.viscosity_ratio(oil.kinematic_viscosity, 8000 * qs.rpm, 125.26e-3)  # type: ignore[arg-type]
    clean = qs.readings.contamination_factor(qs.readings.Cleanliness.OIL_15_12, kappa, 125.26e-3)
    life = qs.readings.life(
        solution, rating=qs.readings.Rating.ISO_281, reliability=0.95, viscosity_ratio=kappa, contamination_factor=clean
    )
    assert found["life"]["modified_reference_rating_life_Mrev"] == life.modified_reference_rating_life / 1e6
    assert found["life"]["duration_h"] == pytest.approx(float(life.duration) / 3600)
    assert found["life"]["warnings"] == [each.remark.written(IN_FILE) for each in life.warnings]
    film = qs.readings.film(solution, oil, ball_roughness=0.05e-6, raceway_roughness=0.2e-6)
    assert found["film"]["balls"][3]["inner"]["minimum_thickness_um"] == pytest.approx(
        film.inner.minimum_thickness[3] * 1e6
    )
    # The film parameter can be worked out again from what is shown beside it, in text too.
    inner = found["film"]["balls"][3]["inner"]
    parameter = inner["reduced_minimum_thickness_um"] / found["film"]["combined_roughness_um"]
    assert inner["film_parameter"] == pytest.approx(parameter)
    text = " ".join(text_of(result(solution, once)).split())
    for words in ("minimum reduced by inlet heating", "combined roughness", "inlet heating differ by about 12 %"):
        assert words in text
    friction = qs.readings.friction(solution, 0.05, drag_coefficient=0.5, fluid_density=20.0)
    assert found["friction"]["power_W"] == pytest.approx(float(friction.power))
    assert friction.drag_power is not None
    assert found["friction"]["balls"][0]["drag_power_W"] == pytest.approx(friction.drag_power[0])
    assert found["friction"]["balls"][0]["inner"]["hysteresis_power_W"] is None
    frequencies = qs.readings.frequencies(solution)
    assert found["frequencies"]["ball_pass_outer_Hz"] == pytest.approx(float(frequencies.solved.ball_pass_outer))
    assert found["frequencies"]["nominal_cage_Hz"] == pytest.approx(float(frequencies.nominal.cage))
    size = {"bore_diameter": 90e-3, "outside_diameter": 160e-3, "kinematic_viscosity": oil.kinematic_viscosity}
    skf = qs.readings.skf_torque(solution, **size)  # type: ignore[arg-type]
    palmgren = qs.readings.palmgren_torque(solution, **size, static_load_rating=85e3, lubrication_factor=2.0)  # type: ignore[arg-type]
    assert found["friction_estimate"]["skf_torque_Nmm"] == pytest.approx(float(skf.torque) * 1e3)
    assert found["friction_estimate"]["palmgren_power_W"] == pytest.approx(float(palmgren.power))
    assert found["overrun"]["inner_edge_angle_deg"] is None
    assert found["stress"]["balls"][0]["outer"]["max_shear_MPa"] > 100
    assert found["kinematics"]["balls"][0]["inner"]["spin_to_roll"] > 0.1
    assert found["static_safety"]["static_safety"] > 1


def test_a_scene_that_asks_for_nothing_pays_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*arguments: Any) -> Any:
        raise AssertionError(arguments)

    monkeypatch.setattr(asked, "take_asked", never)
    solution = qs.solve(scene_of(BASE, "test"))
    assert taken(solution) == {}
    assert record(solution, {})["readings"] is None
    text_of(result(solution, {}))
    with pytest.raises(AssertionError):
        taken(qs.solve(scene(stress=True)))


@pytest.mark.parametrize("options", [["--json", "--csv", "my.csv", "--plot", "my.png"], ["--csv", "my.csv"], []])
def test_each_reading_is_taken_once(options: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """However many ways show it; and one that rests on another one is given it."""
    counts = count_takes(monkeypatch)
    monkeypatch.setattr(import_module("qsbearing.readings.pivot_points"), "kinematics", None)
    monkeypatch.chdir(tmp_path)
    Path("my.toml").write_text(file_of(BASE | {"readings": ALL}), encoding="utf-8")
    done = CliRunner().invoke(cli, ["run", "my.toml", *options])
    assert done.exit_code == 0, done.output
    assert counts == dict.fromkeys(OF_ONE_POINT, 1)


def test_tables_and_columns(tmp_path: Path) -> None:
    lines = ["[bearing]", 'name = "B218"', "[operation]", "speed_rpm = 8000", "axial_load_N = 12000", "[effects]"]
    lines += ['ball = ["centrifugal_force"]', 'raceway_control = "outer"', "[readings]", "stress = true"]
    lines += ["[readings.life]", "[readings.friction]", "friction_coefficient = 0.06"]
    (tmp_path / "my.toml").write_text("\n".join(lines), encoding="utf-8")
    done = CliRunner().invoke(cli, ["run", str(tmp_path / "my.toml"), "--csv", str(tmp_path / "my.csv")])
    assert done.exit_code == 0, done.output
    for words in ("basic reference rating life", "million rev", "sliding power", "orthogonal shear", "MPa"):
        assert words in done.output, words
    for words in ("quantity ", "life in hours", "largest shear stress", "It does not contain viscous, cage and seal"):
        assert words in done.output, f"{words}: a name alone does not state it"
    heading, first = (tmp_path / "my.csv").read_text(encoding="utf-8").splitlines()[:2]
    row = dict(zip(heading.split(","), first.split(","), strict=True))
    solution = qs.solve(qs.load_scene(tmp_path / "my.toml"))
    columns = qs.readings.reading_columns(solution, qs.readings.take_asked(solution))
    for name, values in columns.items():
        assert float(row[name]) == pytest.approx(values[0]), name
    frame = solution.to_dataframe(columns)
    assert frame["inner_friction_sliding_power_W"][0] == pytest.approx(columns["inner_friction_sliding_power_W"][0])
    assert "inner_friction_hysteresis_power_W" not in columns


def test_the_scene_file_of_the_guide() -> None:
    page = (Path(qs.__file__).parent / "guide" / "readings.md").read_text(encoding="utf-8")
    block = re.findall(r"```toml\n(.*?)```", page, flags=re.DOTALL)[0]
    solution = qs.solve(scene_of(tomllib.loads(block), "the guide"))
    assert set(qs.readings.take_asked(solution)) == OF_ONE_POINT


def test_columns_of_many_cases() -> None:
    operation = qs.Operation(speed=800.0, axial_load=np.array([5e3, 9e3]), radial_load_y=2e3, tilt_z=0.0)
    many = qs.solve(
        qs.Scene(qs.load_scene("b218").bearing, operation, (qs.CentrifugalForce(),), qs.RacewayControl.OUTER)
    )
    found = {"life": qs.readings.life(many), "kinematics": qs.readings.kinematics(many)}
    columns = qs.readings.reading_columns(many, found)
    assert len(columns["life_inner_life_Mrev"]) == len(many.to_dataframe()) == 32
    assert columns["life_inner_life_Mrev"][20] == pytest.approx(found["life"].inner_life[1] / 1e6)  # type: ignore[attr-defined]
    assert columns["outer_kinematics_spin_to_roll"].shape == (32,)


def test_an_unsolved_case_has_no_readings() -> None:
    apart = BASE | {"operation": {"axial_load_N": -100}, "effects": {}, "readings": {"life": True}}
    solution = qs.solve(scene_of(apart, "test"))
    assert taken(solution) == {}
    assert record(solution, {})["readings"] is None


# ------------------------------------------------------------------------------------------------------------ bad input


def test_every_fault_at_once() -> None:
    """In the file's keys and units, with ranges."""
    found = faults(
        BASE
        | {
            "readings": {
                "live": {},
                "life": {"reliability": 0.5, "dynamic_load_rating_kN": 90, "capacity": "harris"},
                "friction": {"friction_coefficient": "low"},
                "stress": 3,
            }
        }
    )
    assert set(found) == {
        "readings.live", "readings.life.dynamic_load_rating_kN", "readings.friction.friction_coefficient",
        "readings.stress",
    }  # fmt: skip
    assert "Did you mean [readings.life]?" in found["readings.live"]
    assert "dynamic_load_rating_N = 90000" in found["readings.life.dynamic_load_rating_kN"]
    later = faults(
        BASE
        | {
            "readings": {
                "life": {"reliability": 0.5, "capacity": "harris", "contamination_factor": 0.5},
                "film": {"ball_roughness_um": 0.1},
                "friction": {},
                "lubricant": {"iso_viscosity_grade": 68, "oil_temperature_C": 700},
            }
        }
    )
    assert set(later) == {
        "readings.life.reliability", "readings.life.capacity", "readings.film.raceway_roughness_um",
        "readings.friction.friction_coefficient", "readings.lubricant.oil_temperature_C",
    }  # fmt: skip
    assert "-73.15 to 326.85 °C" in later["readings.lubricant.oil_temperature_C"]


def test_what_a_reading_lacks_is_said() -> None:
    lacking = {"film": {}, "life": {"contamination_factor": 0.5}, "overrun": {}}
    found = faults(BASE | {"readings": lacking})
    assert set(found) == {
        "readings.film",
        "readings.life.viscosity_ratio",
        "readings.overrun.inner_shoulder_diameter_mm",
    }
    assert "[readings.lubricant]" in found["readings.film"]
    oils = (
        {"oil_temperature_C": 70},
        {"oil_temperature_C": 70, "iso_viscosity_grade": 68, "viscosity_at_40C_mm2_s": 60},
    )
    for oil in oils:
        assert "readings.lubricant.iso_viscosity_grade" in faults(BASE | {"readings": {"film": {}, "lubricant": oil}})
    mixed = {"viscosity_at_40C_mm2_s": 8, "viscosity_at_100C_mm2_s": 60, "oil_temperature_C": 70}
    assert "readings.lubricant.viscosity_at_100C_mm2_s" in faults(BASE | {"readings": {"film": {}, "lubricant": mixed}})


def test_estimates_need_the_whole_bearing() -> None:
    oil = {"iso_viscosity_grade": 68, "oil_temperature_C": 70}
    found = faults(BASE | {"readings": {"friction_estimate": {"bore_diameter_mm": 90, "outside_diameter_mm": 80}}})
    assert set(found) == {"readings.friction_estimate", "readings.friction_estimate.outside_diameter_mm"}
    assert "[readings.lubricant]" in found["readings.friction_estimate"]
    groove = {"name": "ISO16281_7ball"}
    upright = {
        "speed_rpm": 3000,
        "radial_load_y_N": 1000,
        "axial_displacement_um": 0,
        "tilt_y_mrad": 0,
        "tilt_z_mrad": 0,
    }
    sized = {"lubricant": oil, "friction_estimate": {"bore_diameter_mm": 25, "outside_diameter_mm": 62}}
    deep = {"bearing": groove, "operation": upright, "readings": sized}
    wrong = faults(deep)
    assert set(wrong) == {"readings.friction_estimate.series", "readings.friction_estimate.static_load_rating_N"}
    sized["friction_estimate"] |= {"series": "63", "static_load_rating_N": 11600}  # type: ignore[operator]
    solution = qs.solve(scene_of(deep, "test"))
    estimate = qs.readings.take_asked(solution)["friction_estimate"]
    assert estimate.palmgren is None
    assert 1e-3 < estimate.skf.torque < 1.0


def test_what_only_the_scene_shows() -> None:
    """A shoulder has to suit the bearing."""
    found = faults(BASE | {"readings": {"overrun": {"inner_shoulder_diameter_mm": 90}}})
    assert "102.794" in found["readings.overrun.inner_shoulder_diameter_mm"]


def test_readings_of_chosen_effects() -> None:
    """effects = "auto" may leave all of them out: every reading is there all the same."""
    for speed in (10, 10_000):
        scene = scene_of(
            {"effects": "auto", "bearing": {"name": "B218"}, "operation": {"speed_rpm": speed, "axial_load_N": 17800}}
            | {"readings": ALL},
            "test",
        )
        solution = qs.solve(scene)
        assert set(qs.readings.take_asked(solution)) == OF_ONE_POINT


def test_the_table_in_the_wrong_place() -> None:
    found = faults(BASE | {"life": {"reliability": 0.95}})
    assert "Did you mean [readings.life]?" in found["[life]"]
    assert "readings" in faults(BASE | {"readings": 5})


def test_an_oil_by_two_viscosities() -> None:
    oil = {
        "viscosity_at_40C_mm2_s": 68,
        "viscosity_at_100C_mm2_s": 8.5,
        "oil_temperature_C": 40,
        "oil_density_kg_m3": 900,
    }
    solution = qs.solve(scene(lubricant=oil, film={}))
    found = qs.readings.take_asked(solution)["film"]
    direct = qs.readings.film(solution, qs.readings.Lubricant((313.15, 373.15), (68e-6, 8.5e-6), 900.0).at(313.15))
    assert found.inner.central_thickness == pytest.approx(direct.inner.central_thickness)


# -------------------------------------------------------------------------------------------------------- a new reading

PAGE = GUIDE / "adding_a_reading.md"
NEW = next(block.text for block in blocks(PAGE) if block.language == "python")


def test_a_new_reading_is_shown_everywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its file alone, listed: in files and their errors, text, JSON, CSV, report, studies, `init` and the guide."""
    (tmp_path / "contact_stiffness.py").write_text(NEW, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    entry = import_module("contact_stiffness").ENTRY
    assert "contact_stiffness" in faults(BASE | {"readings": {"contact_stiffness": {}}})["readings.contact_stiffness"]
    monkeypatch.setitem(asked.READINGS, entry.name, entry)
    wrong = faults(BASE | {"readings": {"contact_stiffness": {"exponent": 3}}})["readings.contact_stiffness.exponent"]
    assert "allowed: 1 to 2" in wrong
    monkeypatch.chdir(tmp_path)
    document = BASE | {"readings": {"contact_stiffness": {"exponent": 1.6}}}
    Path("my.toml").write_text(file_of(document), encoding="utf-8")
    solution = qs.solve(qs.load_scene("my.toml"))
    first = 1.6 * solution.inner.load[0] / solution.inner.approach[0] / 1e6

    def said(*arguments: str) -> str:
        done = CliRunner().invoke(cli, list(arguments))
        assert done.exit_code == 0, done.output
        return " ".join(done.output.split())

    assert "stiffness of a contact" in said("run", "my.toml", "--csv", "my.csv")
    heading, row = Path("my.csv").read_text(encoding="utf-8").splitlines()[:2]
    assert (
        float(dict(zip(heading.split(","), row.split(","), strict=True))["inner_contact_stiffness_stiffness_N"])
        == first
    )
    found = json.loads(said("run", "my.toml", "--json"))
    assert found["readings"]["contact_stiffness"]["balls"][0]["inner"]["stiffness_N"] == first
    assert found["input"]["readings"] == {"contact_stiffness": {"exponent": 1.6}}
    page = html(design_report(solution, solution.scene, "", ""))
    assert "stiffness of a contact" in page
    assert "contact_stiffness.exponent" in page
    results = sweep(Study.of(document, {"speed_rpm": [7000, 8000]}))
    assert results["inner_contact_stiffness_stiffness"][1, 0] == pytest.approx(first)
    assert results["contact_stiffness_loaded"].dims == ("speed_rpm",)
    assert "# [readings.contact_stiffness]" in said("init")
    assert "stiffness of every contact" in said("guide", "readings")
