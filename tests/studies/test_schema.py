"""`qsbearing schema`: what the reader accepts is valid by it, and of bad files it sees the stated share."""

from __future__ import annotations

import copy
import json
import re
import tomllib
from collections.abc import Iterator
from math import inf, nan
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from click.testing import CliRunner
from hypothesis import given

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files import catalogue
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.template import scene_template, set_template
from qsbearing.studies.scenes import base_scene
from qsbearing.studies.schema import file_schema
from qsbearing.studies.study import Study
from tests.guide import pages
from tests.qsbearing.any_scene import bearings, few, operations
from tests.systems.sets.arrangements import PAIR_FILE

SCHEMA = file_schema()
VALID = jsonschema.Draft7Validator(SCHEMA)
Tables = dict[str, Any]


def faults(document: Tables) -> list[str]:
    """What the schema says."""
    return [f"{'.'.join(map(str, each.absolute_path))}: {each.message[:200]}" for each in VALID.iter_errors(document)]


def read(document: Tables) -> None:
    """As the product does; SceneError where it refuses."""
    document = copy.deepcopy(document)
    if "vary" in document:
        base_scene(Study.of(document))
    else:
        scene_or_set_of(document, "file", may_infer=True)


def test_it_is_a_schema_and_the_command_prints_it() -> None:
    jsonschema.Draft7Validator.check_schema(SCHEMA)
    printed = CliRunner().invoke(cli, ["schema"])
    assert printed.exit_code == 0
    assert json.loads(printed.output) == SCHEMA


def test_a_key_says_what_it_is() -> None:
    operation = SCHEMA["properties"]["operation"]["properties"]
    assert operation["tilt_z_mrad"] == {
        "description": "Tilt z [mrad]", "type": ["integer", "number"], "minimum": -200.0, "maximum": 200.0,
    }  # fmt: skip
    spring = SCHEMA["definitions"]["preload"]["properties"]["spring_N"]
    assert (spring["description"], spring["minimum"]) == ("Spring [N]: a constant force", 0.0)
    control = SCHEMA["properties"]["effects"]["anyOf"][1]["properties"]["raceway_control"]
    assert control["enum"] == [str(each) for each in qs.RacewayControl]


# What is accepted is valid --------------------------------------------------------------------------------------------


def test_every_file_of_guide_and_repository_is_valid(tmp_path: Path) -> None:
    found: dict[str, list[str]] = {}
    count = 0
    for page in [pages.ROOT / "README.md", *sorted(pages.GUIDE.glob("*.md"))]:
        folder = tmp_path / page.stem
        folder.mkdir()
        for name, document in pages.files_of(page, folder):
            count += 1
            if bool(faults(document)) != (name in pages.REFUSED):
                found[f"{page.name}, {name}"] = faults(document)
    studies = list((pages.ROOT / "qsbearing" / "studies" / "paper").glob("*.toml"))
    for path in [*studies, *(pages.ROOT / "tests" / "verification" / "benchmarks").glob("*.toml")]:
        count += 1
        if wrong := faults(tomllib.loads(path.read_text(encoding="utf-8"))):
            found[path.name] = wrong
    assert not found
    assert count > 45


def uncommented(text: str) -> str:
    """A template with every key that it has as a comment."""
    return "\n".join(re.sub(r"^# (?=\[|[\w.]+ = )", "", line) for line in text.splitlines())


def test_every_template_is_valid() -> None:
    for entry in catalogue.entries()[::40]:
        by_name, spelled = (tomllib.loads(scene_template(entry, each)) for each in (True, False))
        of_set = tomllib.loads(set_template(entry))
        assert [faults(each) for each in (by_name, spelled, of_set)] == [[], [], []]


def test_every_key_of_the_templates_is_known() -> None:
    entry = catalogue.named("B218")
    assert entry is not None
    for text in (scene_template(entry, by_name=False), set_template(entry)):
        document = tomllib.loads(uncommented(text))
        document.get("bearing", {}).pop("diametral_clearance_mm", None)
        unknown = [each for each in faults(document) if "unexpected" in each]
        assert unknown == []


@pytest.mark.parametrize(
    "name",
    ["Si3N4", "SI3N4", "silicon nitride", "Silicon_Nitride", "100Cr6", "STEEL", "AISI 52100", "440c", "Ti-6Al-4V"],
)
def test_names_of_materials_are_known_in_any_letters(name: str) -> None:
    document = changed(SCENE, {"bearing.ball_material": name})
    read(document)
    assert faults(document) == []
    assert faults(changed(SCENE, {"bearing.ball_material": f"{name}x"}))


@few
@given(bearings(), operations())
def test_every_scene_to_the_ends_of_its_ranges_is_valid(bearing: dict[str, Any], operation: dict[str, Any]) -> None:
    try:
        scene = qs.Scene(qs.BallBearing(**bearing), qs.Operation(**operation))
    except qs.SceneError:
        return
    document = json.loads(json.dumps(input_tables(scene)))
    read(document)
    assert faults(document) == []


def numbers_of(table: Any, path: str = "") -> Iterator[tuple[str, float]]:
    """Every number within tables, with its path."""
    for name, value in table.items() if isinstance(table, dict) else enumerate(table):
        if isinstance(value, dict | list):
            yield from numbers_of(value, f"{path}{name}.")
        elif not isinstance(value, str):
            yield f"{path}{name}", value


def test_what_is_accepted_of_changed_files_is_valid() -> None:
    """Each number of two files removed, and scaled; the reader is the judge."""
    accepted = 0
    for text in (SCENE, SET):
        for path, value in numbers_of(tomllib.loads(text)):
            for new in (GONE, 0, -value, 1e-3 * value, 0.9 * value, 10.0 * value, 1e3 * value):
                document = changed(text, {path: new})
                try:
                    read(document)
                except qs.SceneError:
                    continue
                accepted += 1
                assert faults(document) == [], (path, new)
    assert accepted > 50


# What is refused ------------------------------------------------------------------------------------------------------

SCENE = """
[bearing]
ball_count = 16
ball_diameter_mm = 22.225
pitch_diameter_mm = 125.26
inner_groove_radius_mm = 11.6281
outer_groove_radius_mm = 11.6281
free_contact_angle_deg = 40
ball_material = "steel"
ring_material = "steel"
[operation]
speed_rpm = 10000
axial_load_N = 17800
radial_load_y_N = 1000
moment_z_Nm = 0
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"
[effects.ring_expansion]
bore_diameter_mm = 90
outside_diameter_mm = 160
shaft_interference_um = 10
[readings.life]
[readings.lubricant]
iso_viscosity_grade = 68
oil_temperature_C = 70
"""
SET = PAIR_FILE.partition("[effects]")[0]
STUDY = SCENE + '[vary]\nspeed_rpm = [1000, 2000]\n[study]\nsamples = 8\nsampling = "sobol"\n'
GONE = object()
Change = tuple[str, dict[str, Any]]


def changed(text: str, changes: dict[str, Any]) -> Tables:
    """The tables with other values at these paths."""
    document = tomllib.loads(text)
    for path, value in changes.items():
        *tables, last = path.split(".")
        at: Any = document
        for name in tables:
            at = at[int(name)] if isinstance(at, list) else at.setdefault(name, {})
        if value is GONE:
            del at[last]
        else:
            at[last] = value
    return document


def each(text: str, *changes: dict[str, Any]) -> list[Change]:
    return [(text, change) for change in changes]


NUMBERS = (
    "bearing.ball_diameter_mm", "bearing.pitch_diameter_mm", "bearing.free_contact_angle_deg", "operation.speed_rpm",
    "operation.axial_load_N", "operation.moment_z_Nm", "effects.ring_expansion.bore_diameter_mm",
    "effects.ring_expansion.shaft_interference_um", "readings.lubricant.oil_temperature_C",
    "readings.lubricant.iso_viscosity_grade",
)  # fmt: skip
BAD: dict[str, list[Change]] = {
    "misspelt": each(
        SCENE, {"operation.axial_lod_N": 1}, {"operation.speed": 1}, {"bearing.ball_cuont": 1},
        {"bearing.inner_groove_radious_mm": 1}, {"effects.balls": ["centrifugal_force"]},
        {"effects.ring_expansion.bore_mm": 1}, {"readings.life.reliabilty": 0.9}, {"readings.lubrication": {}},
    ) + each(SET, {"rows.0.pos_mm": 1}) + each(STUDY, {"vary.speed_rmp": [1, 2]}),
    "wrong type": each(SCENE, *({path: "12"} for path in NUMBERS)),
    "true": each(SCENE, *({path: True} for path in NUMBERS)),
    "choice": each(
        SCENE, {"bearing.kind": "roller"}, {"bearing.ball_material": "wood"}, {"bearing.ring_material": "stel"},
        {"effects.raceway_control": "outr"}, {"effects.hertz_form": "brewe"}, {"effects.ball": ["gyroscopic"]},
        {"effects.moment_shares": "equal"}, {"effects.ring_expansion.tolerance_class": "P7"},
    ) + each(SET, {"rows.1.carries": "-y"}) + each(STUDY, {"study.sampling": "grid"}),
    "unknown table": each(
        SCENE, *({name: {}} for name in ("load", "Bearing", "operations", "life", "ring_expansion", "material")),
        {"effects.fits": {}}, {"readings.heat": {}},
    ) + each(SET, {"row": [{}]}, {"shafts": {}}),
    "range": each(
        SCENE, {"bearing.ball_count": 0}, {"bearing.ball_diameter_mm": -1}, {"bearing.pitch_diameter_mm": 1e6},
        {"bearing.free_contact_angle_deg": 95}, {"operation.axial_load_N": 1e9}, {"operation.speed_rpm": 1e9},
        {"bearing.inner_groove_radius_mm": 10}, {"effects.ring_expansion.bore_diameter_mm": -90},
        {"readings.life.reliability": 1.5}, {"readings.lubricant.oil_temperature_C": 900},
    ),
    "unit slip": each(
        SCENE, {"bearing.ball_diameter_mm": 0.022225}, {"bearing.pitch_diameter_mm": 0.12526},
        {"bearing.free_contact_angle_deg": 0.698}, {"bearing.inner_groove_radius_mm": 0.0116},
        {"effects.ring_expansion.bore_diameter_mm": 0.09}, {"effects.ring_expansion.shaft_interference_um": 1e4},
        {"bearing.ball_diameter_mm": 22225}, {"bearing.pitch_diameter_mm": 125260},
        {"readings.lubricant.oil_temperature_C": 343.15}, {"bearing.outer_groove_radius_mm": 11628.1},
    ),
    "missing table": each(SCENE, {"bearing": GONE}, {"operation": GONE}, {"bearing": GONE, "operation": GONE})
    + each(SET, {"bearing": GONE}, {"rows": GONE, "shaft": {}}, {"rows": []})
    + each(STUDY, {"bearing": GONE}, {"operation": GONE, "vary.speed_rpm": GONE, "vary.ball_count": [9, 12]})
    + each(SCENE, {"readings.lubricant": GONE, "readings.film": {}}, {"thermal": {}}),
    "missing key": each(
        SCENE, *({f"bearing.{key}": GONE} for key in ("ball_count", "ball_diameter_mm", "ball_material")),
        {"bearing.pitch_diameter_mm": GONE}, {"bearing.free_contact_angle_deg": GONE},
        {"effects.ring_expansion.bore_diameter_mm": GONE}, {"readings.lubricant.oil_temperature_C": GONE},
        {"bearing.ball_material": {"density_kg_m3": 7800}},
    ) + each(SET, {"rows.0.position_mm": GONE}, {"rows.1.carries": GONE}),
    "load and displacement": each(
        SCENE, {"operation.axial_displacement_um": 5}, {"operation.radial_displacement_y_um": 5},
        {"operation.tilt_z_mrad": 0}, {"operation.moment_y_Nm": 0, "operation.tilt_y_mrad": 0},
        {"operation.radial_load_z_N": 0, "operation.radial_displacement_z_um": 0}, {"preload": {"spring_N": 500}},
        {"preload": {"spring_N": 500, "rigid_N": 500}, "operation.axial_load_N": GONE}, {"preload": {}},
    ) + each(SET, {"operation.axial_displacement_um": 5}, {"preload.mounted_N": 700}),
    "no tilt": each(
        SCENE, {"operation.moment_z_Nm": GONE}, {"operation.radial_load_z_N": 5}, {"operation.radial_load_z_N": -5.5},
        {"operation.radial_displacement_z_um": 3}, {"operation.radial_load_z_N": 1e4},
    ) + each(
        SET, {"operation.radial_load_y_N": 5}, {"operation.radial_load_z_N": 5},
        {"operation.radial_displacement_y_um": 5}, {"operation.radial_load_y_N": 5, "operation.moment_y_Nm": 0},
        {"operation.radial_load_z_N": 5, "operation.moment_z_Nm": 0},
    ),
    "unused": each(
        SCENE, {"tolerance": 0.01}, {"effects.ring_expansion.tolerance_class": "P5"},
        {"effects.ball": ["centrifugal_force"], "effects.moment_shares": "harris"},
        {"effects.ball": ["centrifugal_force"], "effects.friction_coefficient": 0.1}, {"bearing.f0": 14},
        {"bearing.pair_preload_N": 300}, {"effects.ball": []}, {"bearing.groove_radius_coefficient": 0.52},
        {"effects.ring_expansion.housing_temperature_C": 30},
        {"effects.ring_expansion.housing_outside_diameter_mm": 200},
    ),
    "no finite number": each(SCENE, *({path: nan} for path in NUMBERS[:7]), *({path: inf} for path in NUMBERS[4:7])),
}  # fmt: skip
ALL = ("misspelt", "wrong type", "true", "choice", "unknown table", "load and displacement", "no tilt")
SEEN = dict.fromkeys(ALL, 10) | {
    "range": 8,
    "unit slip": 6,
    "missing table": 5,
    "missing key": 6,
    "no finite number": 3,
}
"""Of the ten of each kind; the guide has the sum."""


def test_what_it_sees_of_bad_files_is_what_the_guide_says() -> None:
    seen = dict.fromkeys(BAD, 0)
    for kind, changes in BAD.items():
        assert len(changes) == 10, kind
        for text, change in changes:
            document = changed(text, change)
            with pytest.raises(qs.SceneError):
                read(document)
                pytest.fail(f"{kind}: {change} is accepted")
            seen[kind] += bool(faults(document))
    assert {kind: count for kind, count in seen.items() if count} == SEEN
    guide = (pages.GUIDE / "how_to.md").read_text(encoding="utf-8")
    assert f"{sum(seen.values())} of {10 * len(BAD)} bad files" in guide


def test_the_files_that_are_changed_are_good() -> None:
    for text in (SCENE, SET, STUDY):
        read(tomllib.loads(text))
        assert faults(tomllib.loads(text)) == []
