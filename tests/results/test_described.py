"""A result is described once: every number of `run --json` has a name for searches, which one function writes and one
reads; and one line makes a new result appear everywhere."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing
from qsbearing.files.result_names import find
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.model.solution.result_keys import UNITS, Place, place_of, spelled
from qsbearing.model.solution.solution import Solution
from qsbearing.readings.asked import every_group
from qsbearing.results.readings_record import all_taken
from qsbearing.results.whole import whole_record
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.studies.results import known_results, read
from qsbearing.systems.sets.set_groups import OF_SHAFT, SYSTEM, groups_of_row
from tests.guide.pages import GUIDE

EXEMPT = {
    "version iterations residual seconds": "how the solve went",
    "solves": "how the solve went",
    "stiffness_SI compliance_SI": "matrices in SI; their channels have names, and --csv has a column for each number",
    "amplitudes_um": "a list by harmonic; the bending is their size",
    "position_mm reference_position_mm offset_um axial_datum_row at limit_C assumed": "of the input",
    "warnings remarks choices left_out accuracy channels models fits": "said of results",
    "requirements not_checked": "compares results with limits",
    "kind state status": "words",
    "friction_coefficient": "of the input",
    "contact_points": "how the friction of contacts was summed",
    "band": "displacement and stiffness, which have names, of further solutions over a range of the input",
}
"""What has no name, and why."""
BALLS = {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "per_ball"}
LOADED = {"axial_load_N": 500, "radial_load_y_N": 300, "tilt_y_mrad": 0, "tilt_z_mrad": 0, "speed_rpm": 6000}
OIL = {"iso_viscosity_grade": 32, "oil_temperature_C": 60}
READINGS: dict[str, Any] = {
    "life": {}, "static_safety": {}, "kinematics": {}, "frequencies": {}, "stress": {}, "pivot_points": {},
    "friction": {"friction_coefficient": 0.06}, "lubricant": OIL, "ball_advance": {},
    "film": {"ball_roughness_um": 0.02, "raceway_roughness_um": 0.05},
}  # fmt: skip
ROW = {"bearing": {"name": "7210C"}, "position_mm": 0, "carries": "+x"}
SCENES: dict[str, dict[str, Any]] = {
    "readings": {"bearing": {"name": "7210C"}, "operation": LOADED, "effects": BALLS, "readings": READINGS},
    "preload": {"bearing": {"name": "7210C"}, "operation": {"speed_rpm": 5000}, "preload": {"rigid_N": 300}},
    "rings": {
        "bearing": {"name": "7210C"},
        "operation": LOADED,
        "effects": {
            "ring_expansion": {
                "bore_diameter_mm": 50, "outside_diameter_mm": 90, "shaft_interference_um": 5,
                "inner_ring_temperature_C": 50, "outer_ring_temperature_C": 40,
            },
            "elastic_rings": {"outer": {"width_mm": 20, "housing": "free"}},
        },
    },
    "deep groove": {
        "bearing": {
            "kind": "deep_groove", "ball_material": "steel", "ring_material": "steel", "ball_count": 9,
            "ball_diameter_mm": 7.94, "pitch_diameter_mm": 39.04, "groove_radius_coefficient": 0.52,
            "diametral_clearance_mm": 0.02,
        },
        "operation": {"axial_load_N": 400},
    },
    "spindle": {
        "operation": LOADED | {"axial_load_N": 100},
        "effects": BALLS,
        "readings": {"life": {}, "kinematics": {}},
        "preload": {"rigid_N": 300},
        "rows": [ROW, ROW | {"position_mm": 60, "carries": "-x"}],
        "shaft": {
            "sections": [{"length_mm": 140, "outer_diameter_mm": 45}],
            "start_mm": -40,
            "points": {"tool_mm": -40},
            "supports": [{"position_mm": 100, "radial_y_stiffness_N_per_um": 50}],
            "gears": [
                {"position_mm": 30, "azimuth_deg": 20, "pitch_diameter_mm": 70, "torque_Nm": 9, "drives": True}
            ],
            "belts": [
                {"position_mm": 90, "azimuth_deg": 20, "pitch_diameter_mm": 70, "torque_Nm": 9, "drives": False,
                 "tension_ratio": 3},
            ],
        },
    },
}  # fmt: skip


def of_guide() -> dict[str, dict[str, Any]]:
    """The scenes and sets that the guide shows, without studies and spectra of them."""
    scenes: dict[str, dict[str, Any]] = {}
    for page in sorted(GUIDE.glob("*.md")):
        files: dict[str, str] = {}
        for number, block in enumerate(re.findall(r"```toml\n(.*?)```", page.read_text("utf-8"), re.DOTALL)):
            named = re.match(r"# ([\w.]+\.toml)(, continued)?\n", block)
            name = named[1] if named else str(number)
            files[name] = (files.get(name, "") if named and named[2] else "") + block
        for name, text in files.items():
            tables = {key: table for key, table in tomllib.loads(text).items() if key not in NO_SCENE}
            with suppress(qsbearing.SceneError):
                scene_or_set_of(json.loads(json.dumps(tables)), "", "")
                scenes[f"{page.stem} {name}"] = tables
    return scenes


NO_SCENE = ("vary", "study", "spectrum", "report")
SCENES |= of_guide()


def test_the_guide_shows_scenes() -> None:
    assert len(SCENES) > 30


@cache
def solved(name: str) -> tuple[Any, Any, dict[str, Any], dict[str, Place]]:
    """Solution, readings, record and the results by their names."""
    solution = solve_any(scene_or_set_of(json.loads(json.dumps(SCENES[name])), "", ""))
    assert solution.converged
    taken = all_taken(solution)
    return solution, taken, json.loads(json.dumps(whole_record(solution, taken))), known_results(solution)


def numbers(value: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], float]]:
    """Every number of a record that is not exempt, with where it stands; places in lists by their numbers, places along
    the shaft by their names."""
    if isinstance(value, dict):
        for key, each in value.items():
            if not any(key in names.split() for names in EXEMPT):
                yield from numbers(each, (*path, key))
    elif isinstance(value, list):
        for i, each in enumerate(value):
            named = each.get("at", str(i)) if isinstance(each, dict) else str(i)
            if isinstance(each, dict) and "heat_W" in each:
                yield (*path, f"{each['from']}>{each['to']}"), each["heat_W"]
            else:
                yield from numbers(each, (*path, named))
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path, float(value)


def in_record(place: Place, ball: int | None) -> tuple[str, ...]:
    """Where a record has a place; of a result that each ball has, that of one ball."""
    group, result = place.group, place.result
    table = () if group.table is None else group.table
    if place.row and table[:1] == ("rows",):
        table = ("rows", str(place.row - 1), *table[1:])
    elif place.row:
        table = ("rows", str(place.row - 1), *table)
    if ball is not None:
        at = table.index("balls") + 1
        table = (*table[:at], str(ball), *table[at:])
    return *table, result.entry or result.key


@pytest.mark.parametrize("name", SCENES)
def test_every_number_of_a_record_is_a_result_under_its_name(name: str) -> None:
    solution, taken, record, known = solved(name)
    named: dict[tuple[str, ...], float] = {}
    for each in known.values():
        if each.group.table is None:
            continue
        per_ball = each.group.axis == "ball"
        whole = each._replace(over="")
        values = np.asarray(whole.of(solution, taken) if per_ball else read(solution, [each], taken)[each.name])
        for ball in range(values.shape[-1]) if per_ball else (None,):
            named[in_record(each, ball)] = float(values if ball is None else values[ball])
        assert find(each.name, known) == each and find(each.column, known) == each
        assert each.unit in UNITS
    there = dict(numbers(record))
    assert len(there) > 50
    assert [".".join(path) for path in there if path not in named] == []
    largest = max(abs(value) for value in there.values())
    for path, value in there.items():  # a record has what is rounding as zero
        assert named[path] == pytest.approx(value, rel=1e-9, abs=1e-9 if value else 1e-12 * largest + 1e-6), path


def test_the_list_of_what_has_no_name_holds_nothing_else() -> None:
    keys = {part for _, _, record, _ in map(solved, SCENES) for part in parts_of(record)}
    exempt = {name for names in EXEMPT for name in names.split()}
    assert exempt - keys <= {"fits", "solves", "limit_C", "models"}, "in no scene here"


def parts_of(value: Any) -> Iterator[str]:
    if isinstance(value, dict):
        yield from value
    for each in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
        yield from parts_of(each)


def test_a_name_is_read_as_it_is_spelled_and_no_two_are_alike() -> None:
    of_bearing, of_set = every_group(), [*OF_SHAFT, SYSTEM]
    kinds = ((of_bearing, 0), (of_set, 0), (groups_of_row(of_bearing), 12))
    every: list[Place] = []
    for groups, row in kinds:
        whole = [Place(group, each, row) for group in groups for each in group.results]
        every += [one for each in whole for one in (each, *each.overs)]
    for each in every:
        groups = of_set if each.group in of_set else of_bearing
        for name in (spelled(each), spelled(each, with_unit=True)):
            assert place_of(name, groups, groups_of_row(of_bearing)) == each, name
    names = [spelled(each) for each in every]
    assert len(set(names)) == len(names) > 500


def test_other_names_that_stay_are_read_too() -> None:
    *_, known = solved("spindle")
    for other, name in (
        ("system_life_h", "system_life_duration"), ("system_basic_life_h", "system_life_basic_duration"),
        ("system_life", "system_life_duration"), ("life.duration_h", "system_life_duration"),
        ("effective_stiffness.axial_N_per_um", "shaft_effective_stiffness_axial"),
        ("row_2.inner.max_pressure_max", "row_2_inner_max_pressure_max"),
    ):  # fmt: skip
        assert find(other, known) == known[name], other
    assert find("row_3_axial_load", known) is None and find("inner_load", known) is None


def test_results_that_are_not_usual_are_kept_only_where_they_are_asked_for() -> None:
    solution, *_, known = solved("spindle")
    assert not isinstance(solution, Solution)
    usual = [name for name, each in known.items() if each.is_usual]
    assert len(usual) < 100 < len(known)
    assert "row_1_inner_approach_max" in known and "row_1_inner_approach_max" not in usual
    results = qsbearing.sweep(qsbearing.Study.of(SCENES["spindle"], {"speed_rpm": [5000, 6000]}))
    assert {*usual} == {*results.data_vars} - {"status", "reason", "iterations", "residual"}


# --------------------------------------------------------------------------------------------------------- a new result

NEW = """    Result("mean_pressure", "MPa", "mean pressure", "p_m", HERTZ, path="max_pressure", size=1.5e6),
"""
GROUPS = "qsbearing/model/solution/groups.py"
SCENE = """[bearing]
name = "7210C"
[operation]
speed_rpm = 6000
axial_load_N = 500
"""
PAIR = """[preload]
rigid_N = 300
[[rows]]
position_mm = 0
carries = "+x"
[[rows]]
position_mm = 20
carries = "-x"
"""
PROGRAM = """
import json, sys
from click.testing import CliRunner
from qsbearing.cli import cli
done = [CliRunner().invoke(cli, words) for words in json.loads(sys.argv[1])]
print(json.dumps([each.output if each.exit_code == 0 else repr(each.exception or each.output) for each in done]))
"""


def test_a_new_result_appears_everywhere_with_one_file_edited(tmp_path: Path) -> None:
    package = Path(qsbearing.__file__).parent
    shutil.copytree(package, tmp_path / "qsbearing", ignore=shutil.ignore_patterns("__pycache__"))
    file = tmp_path / GROUPS
    text = file.read_text(encoding="utf-8")
    assert text.count("    FRICTION,\n)") == 1
    file.write_text(text.replace("    FRICTION,\n)", f"    FRICTION,\n{NEW})"), encoding="utf-8")
    (tmp_path / "my.toml").write_text(SCENE, encoding="utf-8")
    (tmp_path / "pair.toml").write_text(f"{SCENE}{PAIR}", encoding="utf-8")
    commands = [
        ["run", "my.toml", "--json"],
        ["run", "my.toml", "--csv", "my.csv"],
        ["sweep", "my.toml", "--vary", "axial_load_N=400,500", "--out", "all.nc"],
        ["sweep", "my.toml", "--vary", "axial_load_N=400,500", "-y", "inner.mean_pressure_max_MPa", "--out", "one.nc"],
        ["find", "my.toml", "--vary", "axial_load_N=100:2000", "--limit", "outer_mean_pressure<=600",
         "--maximise", "effective_stiffness_axial", "--points", "32", "--json"],
        ["guide", "symbols"],
        ["sweep", "pair.toml", "--vary", "axial_load_N=400,500", "-y", "row_2_inner_mean_pressure_max", "--out",
         "pair.nc", "--plot", "my.svg"],
    ]  # fmt: skip
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps(commands)], cwd=tmp_path, env=environment, capture_output=True,
        text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    record, table, _, _, search, symbols, pair = json.loads(done.stdout)
    contact = json.loads(record[record.index("{") :])["balls"][0]["inner"]
    assert contact["mean_pressure_MPa"] == pytest.approx(contact["max_pressure_MPa"] / 1.5)
    assert "pm i" in table and "pm o" in table
    heading, first = (tmp_path / "my.csv").read_text(encoding="utf-8").splitlines()[:2]
    column = dict(zip(heading.split(","), first.split(","), strict=True))
    assert float(column["inner_mean_pressure_MPa"]) == pytest.approx(contact["mean_pressure_MPa"])
    import xarray

    with xarray.open_dataset(tmp_path / "all.nc") as every, xarray.open_dataset(tmp_path / "one.nc") as one:
        assert every["outer_mean_pressure"].attrs["symbol"] == "p_m"
        assert float(one["inner_mean_pressure_max"][1]) == pytest.approx(contact["mean_pressure_MPa"])
    found = json.loads(search)["results"]["outer_mean_pressure_max"]
    assert found == pytest.approx(600.0, rel=1e-3)
    assert "mean pressure" in symbols
    with xarray.open_dataset(tmp_path / "pair.nc") as of_set:
        assert float(of_set["row_2_inner_mean_pressure_max"][0]) > 100.0, pair
