"""Motion of balls and frequencies: rigid-body mechanics in three dimensions, the textbook's limits, measured motors."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from tests.qsbearing.scenes import B218, CENTRIFUGAL, INNER, SPINDLE, general_scenes, resting, solved, turning

SCENES = {name: scene for name, scene in general_scenes().items() if scene.raceway_control is not None}
SCENES["rings that grow"] = replace(
    turning(9e3, axial_load=14e3, radial_load_y=3e3, moment_z=0.0),
    ring_effects=(qs.RingExpansion(90e-3, 160e-3, inner_ring_temperature=360.0, outer_ring_temperature=340.0),),
)
SCENES["balls on orbits of their own"] = replace(
    turning(12e3, axial_load=6e3, radial_load_y=3e3, moment_z=0.0), orbit_radius=qs.OrbitRadius.DISPLACED
)
SCENES["minimum dissipation"] = turning(
    9e3, axial_load=14e3, radial_load_y=3e3, moment_z=0.0, control=qs.RacewayControl.MINIMUM_DISSIPATION
)


@pytest.mark.parametrize("name", SCENES)
def test_motion_is_that_of_rigid_bodies(name: str) -> None:
    """Ball and rings as vectors of rotation: no slip at either contact's centre; spin and rolling are their parts.

    Axes: along the bearing, radial, and tangential, which is their cross product.
    """
    solution = solved(SCENES[name])
    motion = qs.readings.kinematics(solution)
    operation, bearing = solution.scene.operation, solution.scene.operating_bearing
    beta, rotation = solution.attitude_angle, solution.rotation_speed
    assert beta is not None
    assert rotation is not None
    zero = np.zeros_like(beta)
    ball = np.stack([rotation * np.cos(beta), -rotation * np.sin(beta), zero], axis=-1)
    for side, contacts, moving, speed in (
        (-1.0, solution.inner, motion.inner, operation.speed),
        (1.0, solution.outer, motion.outer, operation.outer_speed or 0.0),
    ):
        on = contacts.load > 0.0
        normal = np.stack([np.sin(contacts.angle), np.cos(contacts.angle), zero], axis=-1)
        tangent = np.stack([np.cos(contacts.angle), -np.sin(contacts.angle), zero], axis=-1)
        arm = side * 0.5 * float(bearing.ball_diameter) * normal  # type: ignore[arg-type]
        centre = np.stack([zero, zero + orbit_radius(solution), zero], axis=-1)
        ring = np.stack([float(speed) - motion.orbital_speed, zero, zero], axis=-1)  # type: ignore[arg-type]
        of_ball, of_ring = np.cross(ball, arm), np.cross(ring, centre + arm)
        scale = np.abs(of_ring[on]).max()
        assert np.abs(of_ball - of_ring)[on].max() < 1e-12 * scale
        assert moving.entrainment_speed[on] == pytest.approx(np.linalg.norm(of_ring, axis=-1)[on], rel=1e-12)
        assert moving.spin_speed is not None
        assert moving.rolling_speed is not None
        turning_rate = np.abs(rotation).max()
        assert np.abs(moving.spin_speed - ((ball - ring) * normal).sum(-1))[on].max() < 1e-12 * turning_rate
        assert np.abs(moving.rolling_speed - ((ball - ring) * tangent).sum(-1))[on].max() < 1e-12 * turning_rate
        assert np.isnan(moving.entrainment_speed[~on]).all()


def orbit_radius(solution: qs.Solution) -> Any:
    """dm/2, or where the ball's centre is by the drawing: at the end of its outer contact line."""
    bearing = solution.scene.operating_bearing
    pitch = 0.5 * float(bearing.pitch_diameter)  # type: ignore[arg-type]
    if solution.scene.orbit_radius is qs.OrbitRadius.PITCH_CIRCLE:
        return pitch
    free = float(bearing.outer_groove_radius) - 0.5 * float(bearing.ball_diameter)  # type: ignore[arg-type]
    line = (free + solution.outer.approach) * np.cos(solution.outer.angle)
    return pitch + line - free * np.cos(float(bearing.free_contact_angle))  # type: ignore[arg-type]


@pytest.mark.parametrize("control", list(qs.RacewayControl)[:2])
def test_the_controlling_raceway_has_no_spin(control: qs.RacewayControl) -> None:
    solution = solved(turning(9e3, control=control, axial_load=14e3))
    motion = qs.readings.kinematics(solution)
    free, held = (motion.outer, motion.inner) if control is INNER else (motion.inner, motion.outer)
    assert free.spin_to_roll is not None
    assert held.spin_to_roll is not None
    assert (held.spin_to_roll < 1e-12).all()
    assert (free.spin_to_roll > 0.1).all()


def test_spin_to_roll_as_the_textbook_writes_it() -> None:
    """Harris & Kotzalas: (1 - g cos ai) tan(ai - beta) + g sin ai at the inner raceway."""
    solution = solved(turning(9e3, axial_load=14e3))
    assert solution.attitude_angle is not None
    ai, beta, g = solution.inner.angle, solution.attitude_angle, 22.225 / 125.26
    textbook = (1 - g * np.cos(ai)) * np.tan(ai - beta) + g * np.sin(ai)
    inner = qs.readings.kinematics(solution).inner
    assert inner.spin_to_roll == pytest.approx(textbook, rel=1e-12)
    assert inner.spin_sliding_speed == pytest.approx(np.abs(inner.spin_speed) * solution.inner.semi_major_axis)
    x = np.linspace(0.0, 1.0, 20001)
    product = solution.inner.max_pressure[0] * np.sqrt(1 - x**2) * x * inner.spin_sliding_speed[0]
    assert inner.spin_pressure_speed[0] == pytest.approx(product.max(), rel=1e-6)


def test_without_ball_effects_outer_control_is_assumed_and_said() -> None:
    """At so low a speed that nothing is thrown outward, outer control asked for and assumed are one and the same."""
    scene = resting(SPINDLE, axial_load=1e3, radial_load_y=200.0, moment_z=0.0, speed=10.0, outer_speed=-3.0)
    assumed = qs.readings.kinematics(solved(scene))
    named = replace(scene, ball_effects=CENTRIFUGAL, raceway_control=qs.RacewayControl.OUTER)
    slow = qs.readings.kinematics(solved(named))
    assert slow.warnings == ()
    assert any("inner raceway" in sentence for sentence in assumed.warnings)
    assert assumed.orbital_speed == pytest.approx(slow.orbital_speed, rel=1e-5)
    for one, other in ((assumed.inner, slow.inner), (assumed.outer, slow.outer)):
        assert one.entrainment_speed == pytest.approx(other.entrainment_speed, rel=1e-5)
        assert one.rolling_speed == pytest.approx(other.rolling_speed, rel=1e-5)
        assert one.spin_speed == pytest.approx(other.spin_speed, rel=1e-4, abs=1e-9)


# --------------------------------------------------------------------------------------------------------- frequencies


def test_frequencies_reduce_to_the_textbook_s_at_the_nominal_angle() -> None:
    """A load too light to change the angle, at rest or so slow that nothing throws the balls outward."""
    g, n = 22.225 / 125.26 * np.cos(40 * qs.deg), 50.0
    for scene in (resting(axial_load=1e-3, speed=n * 2 * np.pi), turning(1e-3, axial_load=1e-2)):
        found = qs.readings.frequencies(solved(scene))
        per_turn = 1.0 / n if scene.raceway_control is None else 60.0 / 1e-3
        for each, tolerance in ((found.nominal, 1e-12), (found.solved, 1e-5)):  # the angle opens by 1e-5 under 1e-2 N
            assert each.cage * per_turn == pytest.approx(0.5 * (1 - g), rel=tolerance)
            assert each.ball_pass_outer * per_turn == pytest.approx(8 * (1 - g), rel=tolerance)
            assert each.ball_pass_inner * per_turn == pytest.approx(8 * (1 + g), rel=tolerance)
            assert each.ball_spin * per_turn == pytest.approx(0.5 * 125.26 / 22.225 * (1 - g**2), rel=tolerance)


def test_balls_pass_both_rings_as_often_as_the_shaft_turns_past_them_all() -> None:
    """BPFI + BPFO = Z times the relative speed, whichever ring turns; a turning outer ring speeds the cage up."""
    speeds = {"speed": np.array([900.0, 0.0, 900.0]), "outer_speed": np.array([0.0, 900.0, -300.0])}
    scene = qs.Scene(B218, qs.Operation(axial_load=9e3, **speeds), (qs.CentrifugalForce(),), qs.RacewayControl.OUTER)
    found = qs.readings.frequencies(solved(scene))
    for each in (found.solved, found.nominal):
        total = each.ball_pass_inner + each.ball_pass_outer
        assert total == pytest.approx(16 * np.array([900.0, 900.0, 1200.0]) / (2 * np.pi), rel=1e-12)
        assert each.cage[1] > each.cage[0] > abs(each.cage[2])


def test_speed_and_load_move_the_frequencies() -> None:
    """Under outer control omega_m/omega = (1 - g cos ai)/(1 + cos(ai - ao)); uneven balls want different orbits."""
    solution = solved(turning([100.0, 12e3], axial_load=8e3))
    found = qs.readings.frequencies(solution)
    ai, ao, g = solution.inner.angle[:, 0], solution.outer.angle[:, 0], 22.225 / 125.26
    ratio = found.solved.cage * 60.0 / np.array([100.0, 12e3])
    assert ratio == pytest.approx((1 - g * np.cos(ai)) / (1 + np.cos(ai - ao)), rel=1e-12)
    assert (found.solved.cage / found.nominal.cage)[1] > 1.2
    assert np.abs(found.orbit_spread).max() < 1e-9
    uneven = qs.readings.frequencies(solved(turning(8e3, axial_load=8e3, radial_load_y=4e3, moment_z=0.0)))
    assert uneven.orbit_spread > 0.01


def test_an_unsolved_case_has_no_frequency() -> None:
    found = qs.readings.frequencies(qs.solve(resting(axial_load=np.array([5e3, -5e3]), speed=100.0)))
    assert np.isnan(found.solved.cage).tolist() == [False, True]
    assert np.isfinite(found.nominal.cage).all()
