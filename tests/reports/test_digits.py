"""What is found has six digits at most in a report, what is given its own; and where numbers are from."""

from __future__ import annotations

import re

import qsbearing as qs
from qsbearing.model.operation import STRAIGHT
from qsbearing.reports.inputs import bearing_lines
from qsbearing.results import report
from qsbearing.results.thermal_report import _course_table
from qsbearing.systems.heat.state import NetworkPart
from tests.systems.heat.spindle import scene

GIVEN = {
    "ball_count": 16, "ball_diameter": 7.14 * qs.mm, "pitch_diameter": 46.5 * qs.mm,
    "inner_groove_radius": 3.82 * qs.mm, "outer_groove_radius": 3.82 * qs.mm,
}  # fmt: skip


WARM = qs.RingExpansion(bore_diameter=0.09, outside_diameter=0.16, inner_ring_temperature=60 + qs.zero_celsius)


def warm() -> qs.Solution:
    thrust = qs.Operation(speed=9000 * qs.rpm, axial_load=5000.0, **STRAIGHT)
    return qs.solve(qs.Scene(qs.load_scene("b218").bearing, thrust, ring_effects=(WARM,)))


def test_temperatures_that_a_set_has_found_are_not_given() -> None:
    for heat, origin in ((None, "given"), (scene().thermal, "heat balance")):
        (table,) = (each for each in report.tables_of_balls(warm(), heat) if each.caption.startswith("Temperatures"))
        assert {row[0]: row[2] for row in table.rows}["inner ring"] == origin


def test_the_geometry_in_operation_has_six_digits() -> None:
    (table,) = (each for each in report.tables(warm()) if each.caption == "Geometry before loading")
    shown = [cell for row in table.rows for cell in row[1:3]]
    assert len(shown) == 12 and any(len(re.sub(r"^0|\D", "", cell)) == 6 for cell in shown)
    assert all(len(re.sub(r"^0|\D", "", cell)) <= 6 for cell in shown)


def test_what_follows_from_the_given_one_is_not_from_the_scene() -> None:
    given = qs.BallBearing(**GIVEN, free_contact_angle=24 * qs.deg)
    found = {line[0]: line for line in bearing_lines(given, "scene")}
    assert found["free_contact_angle_deg"][1::2] == ("24", "scene")
    assert found["diametral_clearance_mm"][3] == "computed from the free contact angle"
    assert len(found["diametral_clearance_mm"][1].lstrip("0.")) <= 6
    typed = qs.BallBearing.from_diametral_clearance(**GIVEN, diametral_clearance=0.08 * qs.mm)
    found = {line[0]: line for line in bearing_lines(typed, "scene")}
    assert found["diametral_clearance_mm"][1::2] == ("0.08", "scene")
    assert found["free_contact_angle_deg"][3] == "computed from the clearance"


def test_a_column_of_remarks_is_there_only_with_remarks() -> None:
    state = {"temperatures_C": {NetworkPart("balls"): 60.0}, "power_W": 3.0, "axial_load_N": [500.0]}
    assert _course_table("", "rpm", [("1", state, ""), ("2", state, "")]).headings[-1] == "axial load\nN"
    noted = _course_table("", "rpm", [("1", state, ""), ("2", state, "turns")])
    assert [row[-1] for row in noted.rows] == ["", "turns"] and len(noted.headings) == len(noted.align) == 5
