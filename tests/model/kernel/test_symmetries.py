"""What must not change, or must change in step: mirrored, rotated, rescaled and reordered scenes."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from tests.qsbearing.scenes import (
    B218,
    DEEP_GROOVE,
    DISPLACEMENTS,
    LOADS,
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


@pytest.mark.parametrize(
    ("signs", "first_ball"), [((1.0, 1.0, -1.0, -1.0, 1.0), 0.0), ((1.0, -1.0, 1.0, 1.0, -1.0), np.pi)], ids=["z", "y"]
)
@every_scene
def test_mirrored(name: str, signs: tuple[float, ...], first_ball: float) -> None:
    """z and the rotation about y change sign (a rotation is an axial vector), or y and the rotation about z; ball j
    and ball -j change places."""
    scene = with_operation(channels_times(SCENES[name], signs), first_ball_azimuth=first_ball)
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


@pytest.mark.parametrize("name", LOADED)
def test_loads_and_balls_turned_together(name: str) -> None:
    """Turning loads and balls by any angle turns the ring's answer and leaves every ball as it was."""
    scene, expected, angle = SCENES[name], solution_of(name), -2.5
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


# ----------------------------------------------------------------------------------------------------- what is the same


def test_units_of_rings_and_balls_do_not_mix() -> None:
    """Rings as stiff as the balls, or the reverse: E' knows only the pair."""
    soft, stiff = qs.Material(150e9, 0.28, 7800.0), qs.Material(300e9, 0.28, 7800.0)
    loads = {"axial_load": 9e3, "radial_load_y": 2e3, "moment_z": 0.0}
    one = solved(turning(6000, replace(B218, ball_material=soft, ring_material=stiff), **loads))
    other = solved(turning(6000, replace(B218, ball_material=stiff, ring_material=soft), **loads))
    assert_same_state(other, one, np.ones(5), slice(None))


@pytest.mark.parametrize("name", [name for name, scene in SCENES.items() if len(scene.ball_effects) == 2])
def test_the_order_of_the_effects_is_irrelevant(name: str) -> None:
    """The same bits whichever effect is named first."""
    scene, expected = SCENES[name], solution_of(name)
    found = solved(replace(scene, ball_effects=tuple(reversed(scene.ball_effects))))
    assert np.array_equal(found.displacement, expected.displacement)
    assert np.array_equal(found.outer.load, expected.outer.load)
