"""Life against the operating clearance, through zero."""

from __future__ import annotations

import numpy as np
import pytest

import qsbearing as qs

DEEP_GROOVE = {
    "kind": "deep_groove", "ball_count": 9, "ball_diameter_mm": 7.94, "pitch_diameter_mm": 39.04,
    "groove_radius_coefficient": 0.52, "diametral_clearance_mm": 0.01, "ball_material": "steel",
    "ring_material": "steel",
}  # fmt: skip


def test_life_over_the_clearance_has_its_maximum_below_zero() -> None:
    """The usual curve (Harris & Kotzalas on clearance and life): a slight preload carries the load on more balls."""
    document = {
        "bearing": DEEP_GROOVE,
        "operation": {"speed_rpm": 0.0, "radial_load_y_N": 2000.0, "tilt_z_mrad": 0.0},
        "readings": {"life": True},
    }
    clearance = [-0.04, -0.02, -0.01, -1e-9, 0.0, 1e-9, 0.01, 0.02]
    found = qs.sweep(qs.Study.of(document, {"diametral_clearance_mm": clearance}))
    life = found["life_basic_reference_rating_life"].values
    assert np.isfinite(life).all()
    assert 0 < int(np.argmax(life)) < 3
    assert (np.diff(life[3:]) <= 0.0).all() and life[3] == pytest.approx(life[5], rel=1e-6)


def test_wedged_balls_press_each_other_and_growing_rings_say_so() -> None:
    bearing = qs.BallBearing.from_diametral_clearance(
        diametral_clearance=-20 * qs.um, ball_count=9, ball_diameter=7.94 * qs.mm, pitch_diameter=39.04 * qs.mm,
        inner_groove_radius=0.52 * 7.94 * qs.mm, outer_groove_radius=0.52 * 7.94 * qs.mm, kind="deep_groove",
    )  # fmt: skip
    scene = qs.Scene(bearing, qs.Operation(axial_load=0.0))
    assert (qs.solve(scene).inner.load > 100.0).all()
    grown = qs.Scene(bearing, scene.operation, ring_effects=(qs.RingExpansion(25 * qs.mm, 52 * qs.mm),))
    said = "".join(qs.warnings(qs.solve(grown)))
    assert "The clearance is negative by 20 µm: the balls are wedged between the rings" in said
