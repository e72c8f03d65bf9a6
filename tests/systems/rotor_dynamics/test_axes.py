"""The stiffness in a rotor's axes: places and signs, the mirrored bearing, tilts held and free, load centres."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.systems.rotor_dynamics import Tilt, in_rotor_axes, load_centres
from qsbearing.systems.rotor_dynamics.axes import translations
from tests.qsbearing.scenes import SPINDLE
from tests.systems.rotor_dynamics.scenes import deep_groove_bearing, solved, spindle_bearing


def test_every_coordinate_finds_its_place() -> None:
    """A force in the bearing's axes, turned as vectors and rotations turn, is the turned stiffness times the turn."""
    stiffness = spindle_bearing(12_000 * qs.rpm).stiffness
    rng = np.random.default_rng(1)
    moved, tilted = rng.normal(size=3), np.array([0.0, *rng.normal(size=2)])
    load = stiffness @ np.array([*moved, *tilted[1:]])
    turn = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])  # rotor's x, y, z from the bearing's
    assert np.linalg.det(turn) == 1.0  # right-handed into right-handed
    found = in_rotor_axes(stiffness) @ np.array([*turn @ moved, *(turn @ tilted)[:2]])
    expected = [*turn @ load[:3], *(turn @ np.array([0.0, *load[3:]]))[:2]]
    assert found == pytest.approx(expected, rel=1e-13)


def test_a_mirrored_bearing_is_the_one_that_carries_the_opposite_thrust() -> None:
    """A deep-groove bearing under the mirror image of its loads, solved as such, against the mirrored stiffness.

    The tolerance is the solver's residual of 1e-12; rounding leaves 3e-16.
    """
    there, back = (in_rotor_axes(deep_groove_bearing(sense).stiffness) for sense in (1.0, -1.0))
    mirrored = in_rotor_axes(deep_groove_bearing(1.0).stiffness, mirrored=True)
    length = np.array([1.0, 1.0, 1.0, 0.02, 0.02])
    scale = np.abs(there).max() * length[:, None] * length
    assert (np.abs(mirrored - back) < 1e-12 * scale).all()
    assert (np.abs(there - back) > 0.1 * scale).any()


def test_free_tilts_carry_no_moment() -> None:
    """The condensed stiffness is the inverse of the compliance's block of translations."""
    stiffness = in_rotor_axes(spindle_bearing(np.array([0.0, 12_000.0]) * qs.rpm).stiffness)
    compliance = np.linalg.inv(stiffness)
    found = translations(stiffness, Tilt.FREE)
    assert found == pytest.approx(np.linalg.inv(compliance[..., :3, :3]), rel=1e-8)
    assert (translations(stiffness, Tilt.HELD) == stiffness[..., :3, :3]).all()


@pytest.mark.parametrize("speed", [0.0, 15_000 * qs.rpm])
@pytest.mark.parametrize(("radial", "axis"), [("y", 0), ("z", 1)])
def test_a_small_load_at_the_load_centre_tilts_nothing(speed: float, radial: str, axis: int) -> None:
    """Two solves, one with the load in the middle of the bearing, one with it at the load centre."""
    at_rest = solved(scene(speed, qs.Operation(speed=speed, axial_load=800.0)))
    centre = load_centres(in_rotor_axes(at_rest.stiffness))[axis]
    if speed == 0.0:  # where the contact lines meet the axis, but for the contacts' own load, some thousandths
        assert centre == pytest.approx(-0.5 * 89.5e-3 * np.tan(at_rest.inner.angle[0]), rel=0.01)
    load = 0.01
    moment = {"y": {"moment_z": centre * load}, "z": {"moment_y": -centre * load}}[radial]
    tilts = []
    for applied in ({"moment_z": 0.0, "moment_y": 0.0}, {"moment_z": 0.0, "moment_y": 0.0} | moment):
        operation = qs.Operation(speed=speed, axial_load=800.0, **{f"radial_load_{radial}": load}, **applied)
        tilts.append(solved(scene(speed, operation)).displacement[3:])
    middle, at_centre = np.abs(tilts).max(axis=1)
    assert at_centre < 1e-5 * middle  # what is not linear in a load of 1e-5 of the thrust


def scene(speed: float, operation: qs.Operation) -> qs.Scene:
    """A spindle bearing, with what its speed calls for."""
    plain = qs.Scene(SPINDLE, operation)
    if speed == 0.0:
        return plain
    return dataclasses.replace(plain, ball_effects=(qs.CentrifugalForce(),), raceway_control=qs.RacewayControl.OUTER)
