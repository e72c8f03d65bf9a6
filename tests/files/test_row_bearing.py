"""[rows.bearing] changes single keys of [bearing], or is a bearing by itself."""

from __future__ import annotations

import copy
import tomllib
from typing import Any

import pytest

import qsbearing as qs
from qsbearing.files.row_bearing import whole_bearing
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from tests.studies.test_schema import faults

PAIR = """
[bearing]
ball_count = 16
ball_diameter_mm = 22.225
pitch_diameter_mm = 125.26
groove_radius_coefficient = 0.52
free_contact_angle_deg = 40
ball_material = "steel"
ring_material = "steel"
[[rows]]
position_mm = 0
carries = "+x"
[[rows]]
position_mm = 100
carries = "-x"
[rows.bearing]
{}
[operation]
axial_load_N = 500
"""
NAMED = PAIR.replace(PAIR[PAIR.index("ball_count") : PAIR.index("[[rows]]")], 'name = "7210C"\n', 1)


def bearings(text: str) -> tuple[qs.BallBearing, qs.BallBearing]:
    one, other = set_of(tomllib.loads(text), "pair", "pair").rows
    return one.bearing, other.bearing


@pytest.mark.parametrize(
    ("given", "field", "value"),
    [
        ("ball_count = 15", "ball_count", 15),
        ("free_contact_angle_deg = 25", "free_contact_angle", 25 * qs.deg),
        ("diametral_clearance_mm = 0.1", "diametral_clearance", 0.1 * qs.mm),
        ("groove_radius_coefficient = 0.53", "inner_groove_radius", 0.53 * 22.225 * qs.mm),
        ("inner_groove_radius_mm = 11.8", "inner_groove_radius", 11.8 * qs.mm),
        ('ball_material = "Si3N4"', "ball_material", qs.SILICON_NITRIDE),
        ("inner_raceway_diameter_mm = 103.0\nouter_raceway_diameter_mm = 147.7", "pitch_diameter", None),
    ],
)
def test_one_key_changes_one_number(given: str, field: str, value: Any) -> None:
    common, own = bearings(PAIR.format(given))
    if value is not None:
        assert getattr(own, field) == (pytest.approx(value, rel=1e-12) if isinstance(value, float) else value)
    assert getattr(own, field) != getattr(common, field)
    same = {"ball_diameter", "ring_material", "outer_groove_radius"} - (
        {"outer_groove_radius"} if "0.53" in given else set()
    )
    assert all(getattr(own, each) == getattr(common, each) for each in same)
    again = set_of(input_tables(set_of(tomllib.loads(PAIR.format(given)), "pair", "pair")), "again", "pair")
    assert again.rows[1].bearing == own


def test_one_key_of_a_catalogue_s_bearing() -> None:
    common, own = bearings(NAMED.format('ball_material = "Si3N4"'))
    assert own.ball_material == qs.SILICON_NITRIDE and own.name == f"{common.name}, modified"
    assert own.pitch_diameter == common.pitch_diameter
    _, free = bearings(NAMED.format("free_contact_angle_deg = 20"))
    assert free.free_contact_angle == pytest.approx(20 * qs.deg)


def test_a_bearing_with_a_name_or_balls_of_its_own_takes_nothing() -> None:
    _, own = bearings(PAIR.format('name = "7210C"'))
    assert own == bearings(NAMED.format("ball_count = 15"))[0]
    table = tomllib.loads(PAIR.format(""))["bearing"]
    whole = {key: each for key, each in table.items() if key != "free_contact_angle_deg"}
    assert whole_bearing({"bearing": whole}, table) == whole
    with pytest.raises(qs.SceneFileError, match=r"row 2\.bearing\.free_contact_angle_deg: missing"):
        set_of(
            {**tomllib.loads(PAIR.format("")), "rows": [{"position_mm": 0, "carries": "+x"}, _row(whole)]},
            "pair",
            "pair",
        )


def _row(bearing: dict[str, Any]) -> dict[str, Any]:
    return {"position_mm": 50, "carries": "-x", "bearing": bearing}


COMMON = {"inner_groove_radius_mm": 11.6, "outer_groove_radius_coefficient": 0.52, "free_contact_angle_deg": 40,
          "ball_count": 16}  # fmt: skip


@pytest.mark.parametrize(
    ("own", "gone"),
    [
        ({"groove_radius_coefficient": 0.53}, {"inner_groove_radius_mm", "outer_groove_radius_coefficient"}),
        ({"inner_groove_radius_coefficient": 0.53}, {"inner_groove_radius_mm"}),
        ({"outer_groove_radius_mm": 11.8}, {"outer_groove_radius_coefficient"}),
        ({"diametral_clearance_mm": 0.01}, {"free_contact_angle_deg"}),
        ({"clearance_class": "C3"}, {"free_contact_angle_deg"}),
        ({"ball_count": 15}, set()),
    ],
)
def test_what_says_the_same_goes_out(own: dict[str, Any], gone: set[str]) -> None:
    found = whole_bearing({"bearing": own}, COMMON)
    assert found.keys() == (COMMON.keys() - gone) | own.keys()


def test_a_wrong_key_is_told_of_its_row() -> None:
    with pytest.raises(qs.SceneFileError) as caught:
        bearings(PAIR.format("ball_cuont = 15"))
    assert "row 2.bearing.ball_cuont: unknown key" in str(caught.value) and len(caught.value.errors) == 1


def test_the_schema_takes_single_keys_only_beside_a_common_bearing() -> None:
    document = tomllib.loads(PAIR.format("ball_count = 15"))
    assert faults(document) == []
    alone = copy.deepcopy(document)
    del alone["bearing"]
    assert faults(alone) != []


def test_a_table_is_not_changed_by_being_read() -> None:
    document = tomllib.loads(PAIR.format("ball_count = 15"))
    before = copy.deepcopy(document)
    set_of(document, "pair", "pair")
    assert document == before


def test_a_preload_class_of_all_rows_is_no_key_of_a_row() -> None:
    text = NAMED.replace('name = "7210C"', 'name = "7210C"\npreload = "light"')
    with pytest.raises(qs.SceneFileError, match="the rows' bearings differ"):
        bearings(text.format("ball_count = 14"))
