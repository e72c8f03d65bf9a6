"""Balls that all move alike: momentum, the tangent against differences, and where nothing changes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.solution import common_motion
from qsbearing.model.solution.common_motion import mean_motion
from qsbearing.model.solution.ring_forces import radial_forces
from qsbearing.model.solution.solved_cases import solved_of
from qsbearing.model.validation import SceneError
from tests.qsbearing.scenes import B218, BOTH, OUTER, UPRIGHT

CONTROLS = ["outer", "inner", "minimum_dissipation"]


def scene(axial: Any = 17.8e3, radial: Any = 3e3, revolutions: Any = 10_000, **more: Any) -> qs.Scene:
    """B218 with balls that move alike."""
    operation = qs.Operation(speed=revolutions * qs.rpm, axial_load=axial, radial_load_y=radial, **UPRIGHT)
    given = {"ball_effects": BOTH, "raceway_control": OUTER, "ball_motion": "common"} | more
    return qs.Scene(B218, operation, **given)


def of_own(of: qs.Scene) -> qs.Solution:
    """The same with each ball's own motion."""
    return qs.solve(replace(of, ball_motion="own"))


def outward(found: qs.Solution, share: float) -> NDArray:
    """What the outer ring's contacts give the balls, (axial, y, z): their loads, and friction by its share of Mg."""
    outer, psi = found.outer, found.azimuth
    assert found.gyroscopic_moment is not None
    friction = share * found.gyroscopic_moment / B218.ball_diameter
    axial = -outer.load * outer.sine + friction * outer.cosine
    radial = -outer.load * outer.cosine - friction * outer.sine
    return np.stack([axial.sum(-1), (radial * np.cos(psi)).sum(-1), (radial * np.sin(psi)).sum(-1)], axis=-1)


@pytest.mark.parametrize(("control", "share"), [("outer", 2.0), ("inner", 0.0)])
@pytest.mark.parametrize(("axial", "radial"), [(17.8e3, 3e3), (17.8e3, 8e3), (8e3, 4e3)])
def test_the_outer_ring_carries_what_loads_the_inner_one(
    control: str, share: float, axial: float, radial: float
) -> None:
    """By the contacts alone; with each ball's own motion it does not, by 9 to 66 % of the radial load."""
    common = qs.solve(scene(axial, radial, raceway_control=control))
    assert common.status == "converged"
    np.testing.assert_allclose(outward(common, share), -common.load[:3], atol=1e-9 * axial)
    gap = radial_forces(common)
    assert gap is not None
    assert gap.momentum_gap[0] == pytest.approx(0.0, abs=1e-12)
    if control == "outer":
        own = of_own(common.scene)
        assert np.abs(outward(own, share) + own.load[:3]).max() > 0.09 * radial


@pytest.mark.parametrize("control", CONTROLS)
def test_the_motion_is_the_mean_of_what_raceway_control_asks(control: str) -> None:
    found = qs.solve(scene(8e3, 4e3, raceway_control=control))
    for name, mean in zip(("orbital_speed", "axial_rotation", "radial_rotation"), mean_motion(found)[0], strict=True):
        of_balls = getattr(found, name)
        assert np.ptp(of_balls) == 0.0
        assert of_balls[0] == pytest.approx(mean, rel=1e-9)
    assert found.centrifugal_force is not None
    assert found.orbital_speed is not None
    expected = B218.ball_mass * 0.5 * B218.pitch_diameter * found.orbital_speed**2
    np.testing.assert_allclose(found.centrifugal_force, expected, rtol=1e-12)
    assert found.gyroscopic_moment is not None
    expected = B218.ball_inertia * found.orbital_speed * found.radial_rotation
    np.testing.assert_allclose(found.gyroscopic_moment, expected, rtol=1e-12)
    turned = found.rotation_speed * np.cos(found.attitude_angle), found.rotation_speed * np.sin(found.attitude_angle)
    np.testing.assert_allclose(turned, (found.axial_rotation, found.radial_rotation), rtol=1e-12)


@pytest.mark.parametrize("control", CONTROLS)
def test_under_thrust_nothing_changes_but_the_stiffness_across(control: str) -> None:
    """A radial displacement then finds balls that do not follow it."""
    common = qs.solve(scene(radial=0.0, raceway_control=control))
    own = of_own(common.scene)
    np.testing.assert_allclose(common.displacement, own.displacement, rtol=1e-10, atol=1e-18)
    np.testing.assert_allclose(common.inner.load, own.inner.load, rtol=1e-10)
    np.testing.assert_allclose(common.orbital_speed, own.orbital_speed, rtol=1e-12)
    assert common.stiffness[0, 0] == pytest.approx(own.stiffness[0, 0], rel=1e-6)
    assert abs(common.stiffness[1, 1] / own.stiffness[1, 1] - 1.0) > 0.005


def test_the_tangent_is_that_of_neighbouring_solutions() -> None:
    of = scene(8e3, 4e3)
    step = 2.0
    near = [qs.solve(scene(8e3 + a, 4e3 + r)) for a, r in ((step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step))]
    by_load = np.column_stack([(near[k].displacement - near[k + 1].displacement)[:3] / (2.0 * step) for k in (0, 2)])
    found = qs.solve(of)
    np.testing.assert_allclose((found.stiffness[:3, :3] @ by_load)[:2], np.eye(2), atol=2e-5)
    np.testing.assert_allclose(found.compliance[:2, :2], by_load[:2], rtol=2e-5)
    following = solved_of(found).following
    assert following is not None
    assert np.abs(following()).max() > 0.01 * found.stiffness[1, 1]


def test_a_few_rounds_are_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    """Broyden's method needs 6, with half its steps 7 to 9, plain iteration 8 to 9."""
    rounds = []
    monkeypatch.setattr(common_motion, "mean_motion", lambda of: rounds.append(of) or mean_motion(of))
    for axial, radial in ((17.8e3, 3e3), (17.8e3, 8e3), (8e3, 4e3)):
        rounds.clear()
        assert qs.solve(scene(axial, radial)).status == "converged"
        print(len(rounds) - 1)
        assert len(rounds) - 1 <= 6  # without the start's


def test_a_motion_that_is_not_found_is_not_converged(monkeypatch: pytest.MonkeyPatch) -> None:
    """The case that turns needs more than one round; the one at rest needs none."""
    monkeypatch.setattr(common_motion, "MOST_ROUNDS", 1)
    found = qs.solve(scene(17.8e3, 8e3, np.array([0.0, 10_000.0])))
    assert list(found.status) == ["converged", "not_converged"]
    assert np.isfinite(found.displacement).all(axis=-1).tolist() == [True, False]


def test_slow_balls_have_time_for_their_own_motion() -> None:
    common = qs.solve(scene(17.8e3, 8e3, np.array([0.0, 100.0, 10_000.0])))
    own = of_own(common.scene)
    assert (common.status == "converged").all()
    np.testing.assert_array_equal(common.displacement[0], own.displacement[0])
    apart = np.abs(common.displacement - own.displacement)[:, 1]
    assert apart[1] < 1e-11
    assert apart[2] > 1e-6


def test_cases_are_solved_one_by_one() -> None:
    loads, speeds = np.array([2e3, 5e3]), np.array([[6_000.0], [10_000.0]])
    many = qs.solve(scene(17.8e3, loads, speeds))
    one = qs.solve(scene(17.8e3, 5e3, 6_000.0))
    assert many.displacement.shape == (2, 2, 5)
    np.testing.assert_allclose(many.displacement[0, 1], one.displacement, rtol=1e-9, atol=1e-16)
    np.testing.assert_allclose(many.stiffness[0, 1][:3, :3], one.stiffness[:3, :3], rtol=1e-5, atol=1e3)


def test_bearings_of_several_sizes_and_tilts() -> None:
    """Arrays of bearings with unlike numbers of balls, free to tilt, under a moment."""
    of = replace(B218, ball_count=np.array([12, 16]))
    operation = qs.Operation(speed=8_000 * qs.rpm, axial_load=12e3, radial_load_z=2e3, moment_y=0.0, moment_z=50.0)
    found = qs.solve(qs.Scene(of, operation, BOTH, OUTER, ball_motion="common"))
    assert (found.status == "converged").all()
    assert np.isnan(found.orbital_speed[0, 12:]).all()
    for k, balls in enumerate((12, 16)):
        assert np.ptp(found.orbital_speed[k, :balls]) == 0.0
    assert np.isfinite(found.stiffness).all()


def test_what_has_no_equilibrium_says_so() -> None:
    found = qs.solve(scene(np.array([-5e3, 17.8e3]), 0.0))
    assert list(found.status) == ["no_equilibrium", "converged"]
    assert np.isnan(found.stiffness[0]).all()
    assert np.isfinite(found.stiffness[1]).all()


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"raceway_control": "per_ball"}, "raceway_control = 'per_ball'"),
        ({"orbit_radius": "displaced"}, "orbit_radius = 'displaced'"),
        ({"ring_effects": (qs.BallDiameterDeviations(np.full(16, 1e-6)),)}, "unequal diameters"),
        ({"ball_effects": (), "raceway_control": None}, "no ball effect"),
    ],
)
def test_what_cannot_move_alike_is_refused(changed: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words) as caught:
        scene(**changed)
    assert [each.field for each in caught.value.errors] == ["ball_motion"]


def test_sets_refuse_it() -> None:
    """Their balance has no common motion."""
    rows = qs.Row(B218, 0.0, "+x"), qs.Row(B218, 0.1, "-x")
    operation = qs.Operation(speed=1e3, axial_load=1e3)
    with pytest.raises(SceneError, match="single bearings alone") as caught:
        qs.BearingSet(rows, operation, ball_effects=BOTH, raceway_control=OUTER, ball_motion="common")
    assert [each.field for each in caught.value.errors] == ["ball_motion"]
