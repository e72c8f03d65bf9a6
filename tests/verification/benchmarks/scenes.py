"""The scenes that are timed."""

from __future__ import annotations

import dataclasses

import numpy as np

import qsbearing as qs

B218 = qs.load_scene("b218").bearing
BOTH = (qs.CentrifugalForce(), qs.GyroscopicMoment())


def at_speed(operation: qs.Operation) -> qs.Scene:
    """B218 with both ball effects under outer control."""
    return qs.Scene(B218, operation, BOTH, qs.RacewayControl.OUTER)


def thrust() -> qs.Scene:
    """One thrust-loaded point."""
    return at_speed(qs.Operation(speed=10_000 * qs.rpm, axial_load=17_800.0))


def combined() -> qs.Scene:
    """One point under axial and radial load, free to tilt."""
    return at_speed(qs.Operation(speed=10_000 * qs.rpm, axial_load=8_000.0, radial_load_y=4_000.0, moment_z=0.0))


def random_points(count: int, seed: int = 0) -> qs.Scene:
    """Random points: 1-20 kN axial, radial up to 0.6 of it, free tilt, 0-14 000 rpm."""
    rng = np.random.default_rng(seed)
    axial = rng.uniform(1e3, 20e3, count)
    radial = axial * rng.uniform(0.0, 0.6, count)
    speed = rng.uniform(0.0, 14_000.0, count) * qs.rpm
    return at_speed(qs.Operation(speed=speed, axial_load=axial, radial_load_y=radial, moment_z=0.0))


def random_general_points(count: int, seed: int = 0) -> qs.Scene:
    """The same with loads in all five channels: radial along z up to 0.3 of the axial load, moments up to 50 N m."""
    planar, rng = random_points(count, seed).operation, np.random.default_rng(seed + 1)
    return at_speed(
        dataclasses.replace(
            planar,
            radial_load_z=planar.axial_load * rng.uniform(-0.3, 0.3, count),
            moment_y=rng.uniform(-50.0, 50.0, count),
            moment_z=rng.uniform(-50.0, 50.0, count),
        )
    )


def levels() -> dict[str, qs.Scene]:
    """B218 under a combined load, with more and more effects; ring expansion with a fit and a warm inner ring."""
    steel = dataclasses.replace(B218.ring_material, thermal_expansion=12e-6)
    bearing = dataclasses.replace(B218, ring_material=steel, ball_material=steel)
    loads = qs.Operation(axial_load=17_800.0, radial_load_y=3_000.0, moment_z=0.0)
    turning = dataclasses.replace(loads, speed=10_000 * qs.rpm)
    rings = qs.RingExpansion(90 * qs.mm, 160 * qs.mm, shaft_interference=15 * qs.um, inner_ring_temperature=340.0)
    grown = qs.Scene(bearing, turning, BOTH, qs.RacewayControl.OUTER, ring_effects=(rings,))
    finest = {"ring_effects": (rings, qs.BallExpansion(340.0)), "hertz_angle": "actual", "orbit_radius": "displaced"}
    return {
        "at rest": qs.Scene(bearing, loads),
        "+ centrifugal force": qs.Scene(bearing, turning, BOTH[:1], qs.RacewayControl.OUTER),
        "+ gyroscopic moment": qs.Scene(bearing, turning, BOTH, qs.RacewayControl.OUTER),
        "+ ring expansion": grown,
        "all": dataclasses.replace(grown, **finest),
    }


def plain_start(scene: qs.Scene) -> qs.Solution:
    """What one starts from without thinking: pure thrust at rest, every ball at its static contact angle."""
    operation = qs.Operation(axial_load=scene.operation.axial_load)
    return qs.solve(dataclasses.replace(scene, operation=operation, ball_effects=(), raceway_control=None))
