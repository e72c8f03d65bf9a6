"""What is drawn of a set: each number that a drag changes has a field of the page, and wrong ones are drawn around."""

from __future__ import annotations

import copy
from typing import Any

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")
from qsbearing.app import answers
from qsbearing.app.shaft_drawing import drawing
from tests.app.test_sets import SPINDLE

MORE = """
[[shaft.gears]]
position_mm = 30
azimuth_deg = 0
pitch_diameter_mm = 80
torque_Nm = 20
drives = true
[[shaft.masses]]
position_mm = 40
mass_kg = 2
[[shaft.supports]]
position_mm = 45
radial_y_stiffness_N_per_um = 0.5
[[shaft.sections]]
length_mm = 20
outer_diameter_mm = 50
end_outer_diameter_mm = 40
inner_diameter_mm = 10
"""
"""With one of everything, a cone among the sections."""


@pytest.fixture(scope="module")
def first() -> dict[str, Any]:
    text = SPINDLE.replace("start_mm = -40", "start_mm = -40\nreference_position_mm = 10")
    return answers.opened(text.replace("[shaft.points]", f"{MORE}\n[shaft.points]"), "spindle")


def parts(document: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """By the name of the thing, and by what moves."""
    return {each["name"]: {part["moves"]: part for part in each["parts"]} for each in drawing(document)}


def test_every_part_of_the_drawing_is_a_field(first: dict[str, Any]) -> None:
    fields = {tuple(field["path"]): field for field in first["fields"]}
    found = parts(first["document"])
    for own in found.values():
        for part in own.values():
            field = fields[part["path"]]
            assert set(part["words"]) <= set(field.get("options", ())), field["key"]
    assert {name: set(own) for name, own in found.items()} == {
        "shaft": {"along"},
        "section 1": {"length", "outer begins", "inner begins"},
        "section 2": {"length", "outer begins", "inner begins", "outer ends"},
        "row 1": {"along", "turns"},
        "row 2": {"along", "turns"},
        "load 1": {"along", "x", "y", "z", "turn"},
        "gear 1": {"along", "across", ""},
        "mass 1": {"along", ""},
        "support 1": {"along", ""},
        "tool": {"along"},
        "operation": {"along", "x"},
    }
    assert found["row 2"]["turns"]["words"] == ("+x", "-x")
    assert fields["shaft", "points", "tool_mm"]["unit"] == "mm" and fields["rows", 1, "carries"]["options"]


def test_rows_are_drawn_to_scale(first: dict[str, Any]) -> None:
    (size, _) = (each["size"] for each in first["drawing"] if each["kind"] == "row")
    bearing = first["document"]["bearing"]
    assert size["ball"] == pytest.approx(bearing["ball_diameter_mm"])
    assert size["pitch"] == pytest.approx(bearing["pitch_diameter_mm"])
    assert size["angle"] == pytest.approx(bearing["free_contact_angle_deg"])
    own = copy.deepcopy(first["document"])
    own["rows"][1]["bearing"] = {"ball_diameter_mm": 10.0}
    sizes = [each["size"]["ball"] for each in drawing(own) if each["kind"] == "row"]
    assert sizes == pytest.approx([bearing["ball_diameter_mm"], 10.0])


def test_deep_groove_rows_are_also_held_both_ways_or_none() -> None:
    bearing = 'kind = "deep_groove"\nball_count = 9\nball_diameter_mm = 11.9\npitch_diameter_mm = 60\n'
    bearing += 'groove_radius_coefficient = 0.52\ndiametral_clearance_mm = 0.01\nball_material = "steel"\n'
    loads = "speed_rpm = 1000\nradial_load_y_N = 500\nmoment_z_Nm = 0\n"
    text = f'[bearing]\n{bearing}ring_material = "steel"\n[operation]\n{loads}'
    for place, carries in ((0, "both"), (100, "none")):
        text += f'[[rows]]\nposition_mm = {place}\ncarries = "{carries}"\n'
    found = parts(answers.opened(text, "located")["document"])
    assert found["row 1"]["turns"]["words"] == ("+x", "-x", "both", "none")


def test_wrong_numbers_are_drawn_around(first: dict[str, Any]) -> None:
    names = {each["name"] for each in first["drawing"]}
    wrong = copy.deepcopy(first["document"])
    wrong["bearing"]["ball_diameter_mm"] = -3.0
    wrong["rows"][0]["position_mm"] = "far"
    wrong["shaft"]["sections"][0]["length_mm"] = ""
    assert {each["name"] for each in drawing(wrong)} == names
    assert [each["size"] for each in drawing(wrong) if each["kind"] == "row"] == [None, None]
    for tables in ({"rows": 3, "shaft": []}, {"rows": [1, {}], "bearing": 2, "shaft": {"sections": {}, "points": 1}}):
        assert all(each["kind"] == "row" for each in drawing(tables))
    assert drawing({"bearing": {"name": "7210C"}}) == []
