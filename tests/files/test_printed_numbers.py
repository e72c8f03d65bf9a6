"""What a catalogue prints of a bearing besides the model's lengths is used wherever the bearing is named."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files import catalogue
from qsbearing.files.catalogue.spindle_series import spindle_bearings
from qsbearing.files.printed_numbers import is_printed
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from qsbearing.readings.shoulder_overrun import groove_depth
from qsbearing.reports import inputs, set_inputs
from qsbearing.results import report, set_report
from qsbearing.results.readings_record import taken
from tests.documents.tables import rows_of

TABLES: dict[str, Any] = {
    "bearing": {"name": "7210C"},
    "operation": {
        "speed_rpm": 1e4,
        "axial_load_N": 500.0,
        "radial_load_y_N": 500.0,
        "tilt_y_mrad": 0,
        "tilt_z_mrad": 0,
    },
    "effects": {
        "ring_expansion": {"shaft_interference_um": 8.0},
        "elastic_rings": {"outer": {"housing": "free"}, "inner": {"shaft": {"bore_diameter_mm": 20.0}}},
    },
    "readings": {"life": {}, "static_safety": True, "overrun": {}},
}
ROWS = [
    {"position_mm": 0.0, "carries": "+x", "bearing": {"name": "71914C"}},
    {"position_mm": 40.0, "carries": "-x", "bearing": {"name": "7210C_hybrid"}},
]


def scene(bearing: dict[str, Any] | None = None, **readings: Any) -> qs.Scene:
    tables = copy.deepcopy(TABLES)
    tables["bearing"] |= bearing or {}
    tables["readings"] = readings or tables["readings"]
    return scene_of(tables, "")


def a_set(**tables: Any) -> qs.BearingSet:
    common = {key: copy.deepcopy(TABLES[key]) for key in ("operation", "effects", "readings")}
    common["operation"].pop("axial_load_N")
    return set_of(common | {"preload": {"rigid_N": 300.0}, "rows": copy.deepcopy(ROWS)} | tables, "")


def ratings(readings: Any) -> list[float]:
    return [readings["life"]["dynamic_load_rating"], readings["static_safety"]["static_load_rating"]]


def test_each_effect_and_reading_takes_what_is_printed() -> None:
    made = scene()
    assert ratings(made.readings) == [47_500.0, 37_000.0]
    rings, shoulders = made.elastic_rings, made.readings["overrun"]
    assert rings is not None and made.ring_expansion is not None
    found = rings.outside_diameter, rings.bore_diameter, rings.outer_width, rings.inner_width
    assert np.array(found) / qs.mm == pytest.approx([90.0, 50.0, 20.0, 20.0], rel=1e-12)
    for each in (rings.inner_shoulder_diameter, shoulders["inner_shoulder_diameter"]):
        assert each == pytest.approx(62.5 * qs.mm, rel=1e-12)
    for each in (rings.outer_shoulder_diameter, shoulders["outer_shoulder_diameter"]):
        assert each == pytest.approx(76.9 * qs.mm, rel=1e-12)
    numbers = qs.catalogue_numbers(made.bearing)
    assert (numbers["width"], numbers["dynamic_load_rating"]) == (0.02, 47_500.0)
    assert scene_of(input_tables(made), "") == made


def test_what_a_table_states_itself_has_priority() -> None:
    stated = {"life": {"dynamic_load_rating_N": 4e4}, "static_safety": {"static_load_rating_N": 3e4}}
    assert ratings(scene(**stated).readings) == [4e4, 3e4]
    assert scene({"dynamic_load_rating_N": 4.5e4}).readings["life"]["dynamic_load_rating"] == 4.5e4
    for key, value in {"rating": "iso_281", "rating_factor": 1.25}.items():
        assert "dynamic_load_rating" not in scene(life={key: value}).readings["life"], key
    tables = copy.deepcopy(TABLES)
    tables["effects"]["elastic_rings"] = {"inner": {"shaft": {"compliance_um_per_N": [1e-5]}}}
    rings = scene_of(tables, "").elastic_rings
    assert rings is not None and rings.inner_width is None and rings.outer_width is None


@pytest.mark.parametrize(
    ("change", "shoulders", "rating"),
    [
        ({"free_contact_angle_deg": 15.0, "pitch_diameter_mm": 70.0}, True, True),
        ({"ball_material": "silicon nitride"}, True, False),
        ({"ball_count": 14}, False, False),
        ({"groove_radius_coefficient": 0.52}, False, False),
        ({"diametral_clearance_mm": 0.03}, False, False),
    ],
)
def test_a_changed_bearing_has_not_the_ratings_of_the_printed_one(
    change: dict[str, Any], shoulders: bool, rating: bool
) -> None:
    made = scene(change, life=True, static_safety=True)
    assert ("dynamic_load_rating" in made.readings["life"]) is rating
    assert ("static_load_rating" in made.readings["static_safety"]) is rating
    rings = made.elastic_rings
    assert rings is not None and rings.outer_width == 0.02
    assert (rings.outer_shoulder_diameter is not None) is shoulders
    known = qs.catalogue_numbers(made.bearing)
    assert ("static_load_rating" in known, "inner_shoulder_diameter" in known) == (rating, shoulders)


def test_another_bearing_of_this_name_has_none_of_it() -> None:
    own = qs.BallBearing(12, 10 * qs.mm, 60 * qs.mm, 5.2 * qs.mm, 5.2 * qs.mm, 15 * qs.deg, name="7210c")
    assert qs.catalogue_numbers(own) == {}
    assert set(qs.catalogue_numbers(qs.load_scene("b218").bearing)) == {"bore_diameter", "outside_diameter", "width"}
    assert qs.catalogue_numbers(qs.load_scene("iso16281_7ball").bearing) == {}


def test_a_study_that_varies_the_bearing_computes_the_rating() -> None:
    vary = {"ball_count": [14, 15]}
    tables = {"bearing": {"name": "7210C"}, "operation": {"axial_load_N": 500.0}, "readings": {"life": {}}}
    found = qs.sweep(qs.Study.of(tables, vary, quantities=["life_dynamic_load_rating"]))["life_dynamic_load_rating"]
    assert np.asarray(found)[1] == pytest.approx(46_282.0, abs=1.0), "that of the geometry, of the 15 balls as well"


def test_rows_of_a_set_have_the_numbers_of_their_own_bearings() -> None:
    of = a_set()
    first, second = (of.turning_scene(number) for number in range(2))
    assert ratings(first.readings) == [24_400.0, 26_000.0]
    assert ratings(second.readings) == [47_500.0, 26_000.0]
    sizes = [(each.ring_expansion.bore_diameter, each.elastic_rings.outer_width) for each in (first, second)]
    assert np.array(sizes) / qs.mm == pytest.approx(np.array([[70.0, 16.0], [50.0, 20.0]]), rel=1e-12)
    again = set_of(input_tables(of), "")
    assert [again.effects_of(row) for row in again.rows] == [of.effects_of(row) for row in of.rows]
    common = a_set(bearing={"name": "7210C"}, rows=[{**ROWS[0], "bearing": {"name": "7210C"}}, ROWS[1]])
    assert ratings(common.turning_scene(0).readings)[0] == 47_500.0
    shared = a_set(
        bearing={"name": "7210C"}, rows=[{key: each[key] for key in ("position_mm", "carries")} for each in ROWS]
    )
    assert all(row.readings is None and row.ring_effects is None for row in shared.rows)
    assert ratings(shared.readings) == [47_500.0, 37_000.0]


def test_a_row_without_printed_numbers_shares_the_tables_of_all() -> None:
    own = {"ball_count": 15, "ball_diameter_mm": 12.7, "pitch_diameter_mm": 70.0, "groove_radius_coefficient": 0.52,
           "free_contact_angle_deg": 15.0, "ball_material": "steel", "ring_material": "steel"}  # fmt: skip
    of = a_set(rows=[ROWS[0], {**ROWS[1], "bearing": own}], effects={}, readings={"life": {}})
    assert of.rows[0].readings is not None and of.rows[1].readings is None
    assert "dynamic_load_rating" not in of.turning_scene(1).readings["life"]


def test_the_tables_of_a_reading_say_which_rating_was_used() -> None:
    def first_column(scene: qs.Scene) -> list[str]:
        solution = qs.solve(scene)
        blocks = report.result(solution, taken(solution))
        return [row[0] for block in blocks for row in getattr(block, "rows", ()) if isinstance(row, tuple)]

    plain = {"life": {}, "static_safety": {}}
    assert "dynamic load rating (catalogue)" in (found := first_column(scene(**plain)))
    assert "static load rating (catalogue)" in found
    assert "dynamic load rating (given)" in first_column(scene(life={"dynamic_load_rating_N": 4e4}))
    assert "dynamic load rating (from the geometry)" in first_column(scene({"ball_count": 14}, **plain))
    solution = qs.solve_set(a_set(readings=plain))
    blocks = set_report.set_result(solution, [taken(row) for row in solution.rows])
    rows = [row for block in blocks for row in getattr(block, "rows", ()) if isinstance(row, tuple)]
    assert [row[1] for row in rows if row[0] == "dynamic load rating (catalogue)"] == ["24400", "47500"]


def origins(lines: Any) -> dict[str, str]:
    return {line[0]: line[3] for line in lines if isinstance(line, tuple)}


def test_the_report_says_catalogue() -> None:
    made = scene()
    found = origins(rows_of(inputs.section(made, "").blocks))
    for key in (
        "ring_expansion.bore_diameter_mm", "elastic_rings.outer.width_mm", "elastic_rings.inner.shoulder_diameter_mm",
        "life.dynamic_load_rating_N", "static_safety.static_load_rating_N", "overrun.outer_shoulder_diameter_mm",
    ):  # fmt: skip
        assert found[key] == "catalogue", key
    assert found["ring_expansion.shaft_interference_um"] == found["elastic_rings.inner.shaft.bore_diameter_mm"] == ""
    rows = rows_of(set_inputs.section(a_set(), "").blocks)
    assert origins(rows)["life.dynamic_load_rating_N"] == "catalogue"


FILE = """
[bearing]
ball_count = 9
ball_diameter_mm = 12.7
pitch_diameter_mm = 60
{grooves}
{angle}
ball_material = "steel"
ring_material = "steel"
kind = "deep_groove"
[operation]
axial_load_N = 600
"""
BOTH, ONE = "groove_radius_coefficient = 0.52", "inner_groove_radius_coefficient = 0.515"


@pytest.mark.parametrize("angle", ["free_contact_angle_deg = 12", "diametral_clearance_mm = 0.014"])
@pytest.mark.parametrize("grooves", [BOTH, f"{BOTH}\n{ONE}", f"{BOTH}\nouter_groove_radius_mm = 6.73"])
def test_the_report_says_what_was_computed_and_from_what(grooves: str, angle: str, tmp_path: Path) -> None:
    text = FILE.format(grooves=grooves, angle=angle)
    file = tmp_path / "own.toml"
    file.write_text(text)
    made = qs.load_scene(file)
    found = origins(rows_of(inputs.section(made, text).blocks))
    inner = ONE if "inner" in grooves else BOTH
    assert found["inner_groove_radius_mm"] == f"computed from {inner}"
    assert found["outer_groove_radius_mm"] == ("scene" if "outer" in grooves else f"computed from {BOTH}")
    of_angle, of_clearance = "computed from the free contact angle", "computed from the clearance"
    wanted = ("scene", of_angle) if angle.startswith("free") else (of_clearance, "scene")
    assert (found["free_contact_angle_deg"], found["diametral_clearance_mm"]) == wanted
    rows = "".join(f'[[rows]]\nposition_mm = {at}\ncarries = "{way}"\n' for at, way in ((0, "+x"), (40, "-x")))
    text = text.replace("axial_load_N = 600", "[preload]\nrigid_N = 300") + rows
    file.write_text(text)
    found = origins(rows_of(set_inputs.section(qs.load_set(file), text).blocks))
    assert found["inner_groove_radius_mm"] == f"computed from {inner}"
    assert (found["free_contact_angle_deg"], found["diametral_clearance_mm"]) == tuple(
        "file" if each == "scene" else each for each in wanted
    )


def test_a_printed_diameter_is_a_shoulder_only_where_it_is_high_enough() -> None:
    """Some rows print a face of the ring that lies beyond the bottom of the groove."""
    kinds = {"shoulder": 0, "face": 0}
    for name, entry in spindle_bearings().items():
        bearing = qs.load_scene(name).bearing
        for side, sign in (("inner", -1.0), ("outer", 1.0)):
            (kind,) = (each for each in kinds if f"{side}_{each}_diameter_mm" in entry.dimensions)
            kinds[kind] += 1
            diameter = entry.dimensions[f"{side}_{kind}_diameter_mm"] * qs.mm
            height = float(groove_depth(bearing, diameter, sign)) / float(bearing.ball_diameter)
            assert (height >= 0.14) is (kind == "shoulder"), (name, side)
    assert kinds["shoulder"] > 300 and kinds["face"] > 200
    assert "too low for the shoulder" in CliRunner().invoke(cli, ["catalogue", "KH71904C"]).output
    assert "used wherever" in CliRunner().invoke(cli, ["catalogue", "7210C"]).output
    low = {"bearing": {"name": "KH71904C"}, "operation": {"axial_load_N": 50.0}, "readings": {"overrun": True}}
    with pytest.raises(qs.SceneFileError, match="no shoulder is given"):
        scene_of(low, "")
    assert catalogue.find("KH71904C") is not None


def test_an_effect_without_such_numbers_has_none_of_the_catalogue() -> None:
    bearing = qs.load_scene("b218").bearing
    assert not is_printed(bearing, "gyroscopic_moment", "friction_coefficient", 0.07)
