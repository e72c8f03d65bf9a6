"""A deep-groove bearing's axial displacement counts from first contact of one side; beside it stands the middle's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.results import report
from qsbearing.results.json_record import record
from qsbearing.results.key_results import ring_lines

SMALL = qs.BallBearing.from_diametral_clearance(
    ball_count=9, ball_diameter=7.94 * qs.mm, pitch_diameter=39 * qs.mm, inner_groove_radius=0.52 * 7.94 * qs.mm,
    outer_groove_radius=0.52 * 7.94 * qs.mm, diametral_clearance=0.03 * qs.mm, kind="deep_groove",
)  # fmt: skip
RADIAL = qs.Scene(SMALL, qs.Operation(radial_load_y=1000.0, tilt_y=0.0, tilt_z=0.0))


def test_a_radial_load_alone_leaves_the_rings_in_the_middle() -> None:
    solution = qs.solve(RADIAL)
    assert solution.displacement[0] == pytest.approx(-SMALL.touching_offset, rel=1e-6)
    assert abs(solution.axial_from_middle) < 1e-9 * SMALL.touching_offset
    found = record(solution, {})
    assert found["axial_from_middle_um"] == pytest.approx(0.0, abs=1e-6)
    assert found["displacement"]["axial_um"] == pytest.approx(-1e6 * SMALL.touching_offset, rel=1e-6), "as it was"


def test_a_thrust_to_either_side_is_as_far_from_the_middle() -> None:
    loads = np.array([-500.0, 500.0])
    for effects in ((), (qs.RingExpansion(bore_diameter=0.025, outside_diameter=0.052, shaft_interference=4e-6),)):
        solution = qs.solve(qs.Scene(SMALL, qs.Operation(axial_load=loads), ring_effects=effects))
        left, right = solution.axial_from_middle
        assert left == pytest.approx(-right, rel=1e-9) and right > 0.9 * SMALL.touching_offset * (not effects)


def test_held_at_zero_it_stands_at_one_side_and_the_table_says_so() -> None:
    held = replace(RADIAL, operation=replace(RADIAL.operation, axial_displacement=0.0))
    solution = qs.solve(held)
    assert solution.axial_from_middle == pytest.approx(SMALL.touching_offset)
    table, *_ = report.tables(solution)
    rows = {row[0]: row[1] for row in table.rows}
    assert rows["axial"] == "0" and float(rows["axial from middle"]) == pytest.approx(1e6 * SMALL.touching_offset, 1e-5)
    said = " ".join(" ".join(note) for note in table.notes)
    assert "just touch one side" in said and "in one plane" in said
    assert "axial displacement from the middle" in [each.name for each in ring_lines(solution, "ring")]


def test_an_angular_contact_bearing_has_no_middle() -> None:
    solution = qs.solve(qs.load_scene("b218"))
    assert solution.axial_from_middle is None and record(solution, {})["axial_from_middle_um"] is None
    table, *_ = report.tables(solution)
    assert len(table.rows) == 5 and not table.notes
