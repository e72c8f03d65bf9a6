"""What must not change, or must change in step: mirrored, rotated, rescaled and reordered scenes."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs

from .scenes import (
    B218,
    BOTH,
    DEEP_GROOVE,
    DISPLACEMENTS,
    LOADS,
    SPINDLE,
    general_scenes,
    loaded_as,
    solved,
    turning,
    with_operation,
)

SCENES = general_scenes()
# Solutions agree to the solver's force imbalance of 1e-12, times what a soft direction makes of it.
SAME = 1e-10


@cache
def solution_of(name: str) -> qs.Solution:
    return solved(SCENES[name])


every_scene = pytest.mark.parametrize("name", list(SCENES))


def channels_times(scene: qs.Scene, signs: tuple[float, ...]) -> qs.Scene:
    """The scene with what is prescribed in each channel multiplied."""
    changes = {}
    for fields in (LOADS, DISPLACEMENTS):
        for field, sign in zip(fields, signs, strict=True):
            value = getattr(scene.operation, field)
            if value is not None:
                changes[field] = sign * value
    return with_operation(scene, **changes)


def turned(vector: NDArray, angle: float) -> NDArray:
    """Five channels turned about the bearing axis."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z, tilt_y, tilt_z = vector
    return np.array([x, c * y - s * z, s * y + c * z, c * tilt_y - s * tilt_z, s * tilt_y + c * tilt_z])


def assert_same(found: NDArray | None, expected: NDArray | None) -> None:
    """Equal to SAME of the largest entry, and without a number in the same places."""
    assert found is not None
    assert expected is not None
    assert np.array_equal(np.isnan(found), np.isnan(expected))
    assert np.nan_to_num(found) == pytest.approx(np.nan_to_num(expected), abs=SAME * np.nanmax(np.abs(expected)))


def assert_same_state(found: qs.Solution, expected: qs.Solution, signs: NDArray, order: NDArray | slice) -> None:
    """The same ring state up to signs, the same balls up to their order."""
    for name in ("displacement", "load"):
        for part in (slice(0, 3), slice(3, 5)):
            assert_same(getattr(found, name)[part], (signs * getattr(expected, name))[part])
    for race in ("inner", "outer"):
        for quantity in ("load", "angle", "approach"):
            assert_same(getattr(getattr(found, race), quantity), getattr(getattr(expected, race), quantity)[order])
    if expected.gyroscopic_moment is not None:
        assert found.gyroscopic_moment is not None
        assert_same(found.gyroscopic_moment, expected.gyroscopic_moment[order])


# -------------------------------------------------------------------------------------------------------------- mirrors


@every_scene
def test_mirrored_at_the_plane_of_y(name: str) -> None:
    """z and the rotation about y change sign (a rotation is an axial vector); ball j and ball -j change places."""
    signs = (1.0, 1.0, -1.0, -1.0, 1.0)
    found = solved(channels_times(SCENES[name], signs))
    count = len(found.azimuth)
    assert_same_state(found, solution_of(name), np.array(signs), -np.arange(count) % count)


@every_scene
def test_mirrored_at_the_plane_of_z(name: str) -> None:
    """y and the rotation about z change sign; ball 0 moves to the other side."""
    signs = (1.0, -1.0, 1.0, 1.0, -1.0)
    scene = with_operation(channels_times(SCENES[name], signs), first_ball_azimuth=np.pi)
    found = solved(scene)
    count = len(found.azimuth)
    assert_same_state(found, solution_of(name), np.array(signs), -np.arange(count) % count)


def test_mirrored_along_the_axis() -> None:
    """A deep-groove bearing does not know its sides: reversed thrust and tilts reverse every contact angle."""
    clearance = qs.BallBearing.from_diametral_clearance(
        diametral_clearance=10 * qs.um,
        ball_count=7,
        ball_diameter=DEEP_GROOVE.ball_diameter,
        pitch_diameter=DEEP_GROOVE.pitch_diameter,
        inner_groove_radius=DEEP_GROOVE.inner_groove_radius,
        outer_groove_radius=DEEP_GROOVE.outer_groove_radius,
        kind=qs.BearingKind.DEEP_GROOVE,
    )
    play = float(clearance.groove_centre_distance * np.sin(clearance.free_contact_angle))
    loads = {"axial_load": 300.0, "radial_load_y": 500.0, "radial_load_z": 100.0, "moment_y": 1.0, "moment_z": -2.0}
    scene = turning(12000, clearance, **loads)
    one, other = solved(scene), solved(channels_times(scene, (-1.0, 1.0, 1.0, -1.0, -1.0)))
    assert (other.displacement[0] + play) == pytest.approx(-(one.displacement[0] + play), rel=SAME)
    assert_same(other.displacement[1:3], one.displacement[1:3])
    assert_same(other.displacement[3:], -one.displacement[3:])
    for race in ("inner", "outer"):
        assert_same(getattr(other, race).angle, -getattr(one, race).angle)
        assert_same(getattr(other, race).load, getattr(one, race).load)


@pytest.mark.parametrize("name", [name for name, scene in SCENES.items() if scene.ball_effects])
def test_either_sense_of_rotation(name: str) -> None:
    """Both speeds reversed: orbit and rotation reverse, forces do not."""
    scene, expected = SCENES[name], solution_of(name)
    speed, outer = scene.operation.speed, scene.operation.outer_speed
    found = solved(with_operation(scene, speed=-speed, outer_speed=-outer))  # type: ignore[operator]
    assert_same_state(found, expected, np.ones(5), slice(None))
    assert_same(found.orbital_speed, -expected.orbital_speed)  # type: ignore[operator]
    assert_same(found.rotation_speed, -expected.rotation_speed)  # type: ignore[operator]


# ------------------------------------------------------------------------------------------------------------ rotations

LOADED = [name for name, scene in SCENES.items() if scene.operation.axial_displacement is None]


@pytest.mark.parametrize("name", LOADED)
def test_loads_turned_by_one_ball_pitch(name: str) -> None:
    """Turning the loads by 360/Z degrees turns the answer, and each ball takes over from the one before."""
    scene, expected = SCENES[name], solution_of(name)
    pitch = 2.0 * np.pi / len(expected.azimuth)
    found = solved(loaded_as(scene, turned(expected.load, pitch)))
    for quantity in ("displacement", "load"):
        for part in (slice(0, 3), slice(3, 5)):
            assert_same(getattr(found, quantity)[part], turned(getattr(expected, quantity), pitch)[part])
    for race in ("inner", "outer"):
        assert_same(getattr(found, race).load, np.roll(getattr(expected, race).load, 1))
        assert_same(getattr(found, race).angle, np.roll(getattr(expected, race).angle, 1))


@pytest.mark.parametrize("angle", [0.1234, -2.5])
@pytest.mark.parametrize("name", LOADED)
def test_loads_and_balls_turned_together(name: str, angle: float) -> None:
    """Turning loads and balls by any angle turns the ring's answer and leaves every ball as it was."""
    scene, expected = SCENES[name], solution_of(name)
    found = solved(with_operation(loaded_as(scene, turned(expected.load, angle)), first_ball_azimuth=angle))
    for quantity in ("displacement", "load"):
        for part in (slice(0, 3), slice(3, 5)):
            assert_same(getattr(found, quantity)[part], turned(getattr(expected, quantity), angle)[part])
    for race in ("inner", "outer"):
        for quantity in ("load", "angle", "approach", "max_pressure"):
            assert_same(getattr(getattr(found, race), quantity), getattr(getattr(expected, race), quantity))
    stiffness = qs.stiffness(found.scene, found)
    turn = np.column_stack([turned(unit, angle) for unit in np.eye(5)])
    turned_back = turn.T @ stiffness @ turn
    original = qs.stiffness(scene, expected)
    diagonal = np.sqrt(np.diag(original))
    assert turned_back / np.outer(diagonal, diagonal) == pytest.approx(
        original / np.outer(diagonal, diagonal), abs=1e-9
    )


# -------------------------------------------------------------------------------------------------------------- scaling

# Inside, the kernel computes with numbers free of dimension: what is left is the rounding of the way in and out, which
# Newton's last step may pass on.
ROUNDING = 1e-12


def rescaled(scene: qs.Scene, length: float, modulus: float) -> qs.Scene:
    """Lengths times `length`, moduli times `modulus`: forces times modulus length^2, speeds sqrt(modulus)/length."""
    bearing = scene.bearing
    lengths = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")
    bigger = replace(
        bearing,
        **{name: length * getattr(bearing, name) for name in lengths},
        ball_material=replace(bearing.ball_material, elastic_modulus=modulus * bearing.ball_material.elastic_modulus),
        ring_material=replace(bearing.ring_material, elastic_modulus=modulus * bearing.ring_material.elastic_modulus),
    )
    force = modulus * length**2
    changed = channels_times(scene, (1.0,) * 5)
    for field, factor in zip(LOADS, (force, force, force, force * length, force * length), strict=True):
        if getattr(scene.operation, field) is not None:
            changed = with_operation(changed, **{field: factor * getattr(scene.operation, field)})
    for field in DISPLACEMENTS[:3]:
        if getattr(scene.operation, field) is not None:
            changed = with_operation(changed, **{field: length * getattr(scene.operation, field)})
    speeds = {name: getattr(scene.operation, name) for name in ("speed", "outer_speed")}
    speeds = {name: value * modulus**0.5 / length for name, value in speeds.items() if value is not None}
    return replace(with_operation(changed, **speeds), bearing=bigger)


@pytest.mark.parametrize(("length", "modulus"), [(0.37, 1.0), (3.7, 1.0), (1.0, 0.61), (2.9, 1.7)])
@every_scene
def test_size_and_stiffness_scale_out(name: str, length: float, modulus: float) -> None:
    """A bearing s times as large with loads s^2 times as large and speeds 1/s has the same angles and tilts.

    Likewise for moduli c times as large: loads times c, speeds times sqrt(c).
    """
    expected, found = solution_of(name), solved(rescaled(SCENES[name], length, modulus))
    force = modulus * length**2
    for race in ("inner", "outer"):
        one, other = getattr(expected, race), getattr(found, race)
        largest = one.load.max()
        assert other.load / force / largest == pytest.approx(one.load / largest, abs=ROUNDING)
        assert other.angle == pytest.approx(one.angle, abs=ROUNDING, nan_ok=True)
        assert other.max_pressure / modulus == pytest.approx(one.max_pressure, rel=10 * ROUNDING)
    largest_shift = np.abs(expected.displacement[:3]).max()
    assert found.displacement[:3] / length == pytest.approx(
        expected.displacement[:3], abs=10 * ROUNDING * largest_shift
    )
    assert found.displacement[3:] == pytest.approx(expected.displacement[3:], abs=10 * ROUNDING)


@every_scene
def test_doubling_is_exact(name: str) -> None:
    """By a power of two nothing is rounded differently: the same bits."""
    expected, found = solution_of(name), solved(rescaled(SCENES[name], 2.0, 1.0))
    for race in ("inner", "outer"):
        assert np.array_equal(getattr(found, race).angle, getattr(expected, race).angle, equal_nan=True)
        assert np.array_equal(getattr(found, race).load, 4.0 * getattr(expected, race).load)
    assert found.iterations == expected.iterations


@pytest.mark.parametrize("bearing", [B218, SPINDLE], ids=["B218", "spindle"])
def test_density_acts_through_speed_alone(bearing: qs.BallBearing) -> None:
    """Balls a quarter as heavy at twice the speeds are thrown and turned by the same forces."""
    light = replace(bearing, ball_material=replace(bearing.ball_material, density=0.25 * bearing.ball_material.density))
    loads = {"axial_load": 5e3, "radial_load_y": 1e3, "radial_load_z": 200.0, "moment_y": 5.0, "moment_z": -9.0}
    one, other = solved(turning(4000, bearing, **loads)), solved(turning(8000, light, **loads))
    assert_same_state(other, one, np.ones(5), slice(None))


def test_units_of_rings_and_balls_do_not_mix() -> None:
    """Rings as stiff as the balls, or the reverse: E' knows only the pair."""
    soft, stiff = qs.Material(150e9, 0.28, 7800.0), qs.Material(300e9, 0.28, 7800.0)
    loads = {"axial_load": 9e3, "radial_load_y": 2e3, "moment_z": 0.0}
    one = solved(turning(6000, replace(B218, ball_material=soft, ring_material=stiff), **loads))
    other = solved(turning(6000, replace(B218, ball_material=stiff, ring_material=soft), **loads))
    assert_same_state(other, one, np.ones(5), slice(None))


@every_scene
def test_the_order_of_the_effects_is_irrelevant(name: str) -> None:
    """The same bits whichever effect is named first."""
    scene, expected = SCENES[name], solution_of(name)
    found = solved(replace(scene, ball_effects=tuple(reversed(scene.ball_effects))))
    assert np.array_equal(found.displacement, expected.displacement)
    assert np.array_equal(found.outer.load, expected.outer.load)


def test_the_scenes_name_both_effects() -> None:
    """So that reversing them says something."""
    assert sum(scene.ball_effects == BOTH for scene in SCENES.values()) >= 5
