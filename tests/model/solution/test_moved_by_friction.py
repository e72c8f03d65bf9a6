"""raceway_control = "friction": a `Solution` as under any hypothesis, from the balance of friction."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qsbearing as qs
from qsbearing.model.effects.traction import FRICTION_COEFFICIENT
from qsbearing.model.solution.friction_band import COUNT, friction_band
from qsbearing.model.solution.friction_motion import friction_motion
from qsbearing.model.solution.ring_forces import radial_forces
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import SceneError
from qsbearing.studies.results import known_results
from tests.qsbearing.scenes import B218, UPRIGHT

BOTH = qs.CentrifugalForce(), qs.GyroscopicMoment()
THRUST = {"speed": 10_000 * qs.rpm, "axial_load": 17.8e3}
RADIAL = THRUST | {"radial_load_y": 3e3} | UPRIGHT


def moved(law: qs.Traction | None = None, of: dict[str, Any] = THRUST, **more: Any) -> qs.Scene:
    return qs.Scene(B218, qs.Operation(**of), BOTH, "friction", traction=law, **more)


def friction_of(solution: Solution) -> Any:
    assert solution.friction is not None
    return solution.friction


@pytest.mark.parametrize("of", [THRUST, RADIAL])
def test_everything_is_that_of_the_balance(of: dict[str, Any]) -> None:
    law = qs.Traction(0.05, 0.2)
    solution, motion = qs.solve(moved(law, of)), friction_motion(moved(law, of), law)
    assert solution.converged and set(solution.raceway_control) == {"friction"}
    np.testing.assert_array_equal(solution.displacement, motion.displacement)
    np.testing.assert_array_equal(solution.load[:3], motion.load[:3])
    for side in ("inner", "outer"):
        contacts, own = getattr(solution, side), getattr(motion, side)
        for name in ("angle", "load", "approach", "semi_major_axis", "semi_minor_axis"):
            np.testing.assert_array_equal(getattr(contacts, name), getattr(own, name))
        area = np.pi * contacts.semi_major_axis * contacts.semi_minor_axis
        np.testing.assert_allclose(contacts.max_pressure, 1.5 * contacts.load / area)
        np.testing.assert_allclose(contacts.required_friction * contacts.load, np.abs(own.traction))
        np.testing.assert_allclose(np.hypot(contacts.sine, contacts.cosine), 1.0)
    np.testing.assert_array_equal(solution.orbital_speed, motion.orbital_speed)
    wx, wy, wz = np.moveaxis(motion.angular_velocity, -1, 0)
    np.testing.assert_array_equal(solution.axial_rotation, wx)
    np.testing.assert_array_equal(solution.radial_rotation, -wz)
    np.testing.assert_allclose(np.tan(solution.attitude_angle), -wz / wx)
    np.testing.assert_allclose(np.tan(motion.yaw_angle), -wy / wx)
    along = np.stack([np.ones_like(wx), -np.tan(motion.yaw_angle), -np.tan(solution.attitude_angle)], axis=-1)
    np.testing.assert_allclose(np.cross(along, motion.angular_velocity), 0.0, atol=1e-9 * np.abs(wx).max())
    names = known_results(solution)
    for name, values in (("attitude_angle", solution.attitude_angle), ("yaw_angle", motion.yaw_angle)):
        np.testing.assert_allclose(names[f"traction_{name}"].of(solution), np.degrees(values))
    # As Jones has it: omega_R and Mg negative under a turning inner ring.
    assert (solution.rotation_speed < 0.0).all() and (solution.gyroscopic_moment < 0.0).all()
    hypothesis = qs.solve(replace(moved(None, of), raceway_control="outer"))
    np.testing.assert_allclose(solution.gyroscopic_moment, hypothesis.gyroscopic_moment, rtol=0.3)
    np.testing.assert_allclose(solution.attitude_angle, hypothesis.attitude_angle, rtol=0.3)


def test_reversed_speed_turns_axes_back_and_keeps_their_attitude() -> None:
    forth, back = (qs.solve(moved(None, THRUST | {"speed": sign * THRUST["speed"]})) for sign in (1.0, -1.0))
    np.testing.assert_allclose(back.attitude_angle, forth.attitude_angle, rtol=1e-9)
    np.testing.assert_allclose(back.rotation_speed, -forth.rotation_speed, rtol=1e-9)
    np.testing.assert_allclose(back.gyroscopic_moment, forth.gyroscopic_moment, rtol=1e-9)
    np.testing.assert_allclose(friction_of(back).yaw_angle, -friction_of(forth).yaw_angle, rtol=1e-9)


def test_at_rest_it_is_the_static_solution_and_a_sweep_from_rest_runs() -> None:
    speeds = np.array([0.0, 3000.0, 10_000.0]) * qs.rpm
    sweep = qs.solve(moved(None, RADIAL | {"speed": speeds}))
    still = qs.solve(moved(None, RADIAL | {"speed": 0.0}))
    static = qs.solve(qs.Scene(B218, qs.Operation(**RADIAL | {"speed": 0.0})))
    assert still.friction is None and sweep.converged.all()
    for one, other in ((still, static), (qs.solve(moved(None, RADIAL | {"speed": speeds[:1]})), static)):
        np.testing.assert_array_equal(np.reshape(one.displacement, 5), other.displacement)
        np.testing.assert_array_equal(np.reshape(one.stiffness, (5, 5)), other.stiffness)
        np.testing.assert_array_equal(np.ravel(one.inner.load), other.inner.load)
        np.testing.assert_array_equal(np.reshape(one.load, 5), other.load)
    np.testing.assert_array_equal(sweep.displacement[0], static.displacement)
    np.testing.assert_array_equal(sweep.compliance[0], static.compliance)
    np.testing.assert_array_equal(sweep.outer.load[0], static.outer.load)
    assert (sweep.orbital_speed[0] == 0.0).all() and np.isnan(friction_of(sweep).attitude_angle[0]).all()
    one = qs.solve(moved(None, RADIAL))
    np.testing.assert_array_equal(sweep.displacement[2], one.displacement)
    np.testing.assert_array_equal(sweep.stiffness[2], one.stiffness)


@pytest.mark.parametrize("of", [THRUST, RADIAL])
def test_stiffness_is_the_slope_of_the_load(of: dict[str, Any]) -> None:
    """Of a ring that is held at three places; tilts have no number."""
    solution = qs.solve(moved(None, of))
    held = UPRIGHT | {"speed": of["speed"]}
    names = "axial_displacement", "radial_displacement_y", "radial_displacement_z"
    step = 1e-9

    def load(change: Any) -> Any:
        places = dict(zip(names, solution.displacement[:3] + change, strict=True))
        return qs.solve(moved(None, held | places)).load[:3]

    slopes = [(load(way) - load(-way)) / (2.0 * step) for way in step * np.eye(3)]
    size = np.abs(solution.stiffness[:3, :3]).max()
    np.testing.assert_allclose(solution.stiffness[:3, :3], np.transpose(slopes), atol=2e-5 * size)
    assert np.isnan(solution.stiffness[3:]).all() and np.isnan(solution.stiffness[:, 3:]).all()
    free = solution.free_channels[solution.free_channels < 3]
    if of is RADIAL:
        inverse = np.linalg.inv(solution.stiffness[:3, :3])
        np.testing.assert_allclose(solution.compliance[:3, :3], inverse)
    else:  # free to tilt, but for the axial channel, which thrust leaves alone
        assert solution.effective_stiffness[0] == pytest.approx(solution.locked_stiffness[0])
        assert np.isnan(solution.effective_stiffness[1:]).all()
    assert free.size == 3


def test_both_rings_carry_the_same() -> None:
    forces = radial_forces(qs.solve(moved(None, RADIAL)))
    of_hypothesis = radial_forces(qs.solve(replace(moved(None, RADIAL), raceway_control="outer")))
    assert forces is not None and of_hypothesis is not None
    np.testing.assert_allclose(forces.on_outer, forces.on_inner, rtol=1e-9)
    assert of_hypothesis.momentum_gap > 0.05, "or the test tells nothing"


def test_a_balance_is_read_off_only_where_somebody_asks() -> None:
    """Which takes longer than the balance of one ball; displacement and status need none of it."""
    solution = qs.solve(moved())
    assert solution._moved is not None and solution.converged and np.isfinite(solution.displacement).all()
    assert "motion" not in vars(solution._moved)
    assert solution.inner.load[0] == friction_of(solution).inner.load[0]
    assert "motion" in vars(solution._moved)


def test_arrays_of_the_law_are_cases() -> None:
    many = qs.solve(
        moved(qs.Traction(np.array([0.03, 0.07, 0.1])), THRUST | {"axial_load": np.array([[17.8e3], [9e3]])})
    )
    assert many.shape == (2, 3) and many.converged.all()
    one = qs.solve(moved(qs.Traction(0.1), THRUST | {"axial_load": 9e3}))
    np.testing.assert_array_equal(many.displacement[1, 2], one.displacement)
    np.testing.assert_array_equal(friction_of(many).gyroscopic_margin[1, 2], friction_of(one).gyroscopic_margin)
    again = qs.solve(many.scene, start=many)
    np.testing.assert_allclose(again.displacement, many.displacement, rtol=1e-9)


def test_the_coefficient_is_assumed_where_it_is_not_given() -> None:
    assumed, given = qs.solve(moved()), qs.solve(moved(qs.Traction(FRICTION_COEFFICIENT)))
    np.testing.assert_array_equal(assumed.displacement, given.displacement)
    said = [[each.remark.code for each in qs.warnings(one)] for one in (assumed, given)]
    assert ["friction_assumed" in codes for codes in said] == [True, False]


def test_a_band_spans_what_lies_in_it() -> None:
    solution = qs.solve(moved(qs.Traction(friction_range=(0.03, 0.1))))
    band = friction_band(solution)
    assert band is not None and band.solves == COUNT
    many = qs.solve(moved(qs.Traction(np.geomspace(0.03, 0.1, 33))))
    for (least, most), values in ((band.displacement, many.displacement), (band.stiffness, many.locked_stiffness)):
        reach = values[:, 0].max() - values[:, 0].min()
        assert least[0] == pytest.approx(values[:, 0].min(), abs=0.01 * reach)
        assert most[0] == pytest.approx(values[:, 0].max(), abs=0.01 * reach)
    ends = [solution.locked_stiffness[0], *many.locked_stiffness[[0, -1], 0]]
    assert band.stiffness[1][0] > max(ends), "the stiffest lies between: the ends of the range are not enough"
    assert friction_band(qs.solve(moved())) is None


def test_skidding_is_told_and_no_solution() -> None:
    light = THRUST | {"speed": 6000 * qs.rpm, "axial_load": 2e3}
    margin = friction_of(qs.solve(moved(qs.Traction(cage_drag=1.0), light))).least_skid_margin
    near = qs.solve(moved(qs.Traction(cage_drag=0.8 * margin), light))
    codes = {each.remark.code for each in qs.warnings(near)}
    assert {"friction_assumed", "axis_creeps", "balls_near_skidding"} <= codes
    beyond = qs.solve(moved(qs.Traction(cage_drag=1.1 * margin), light))
    assert beyond.status == "not_converged" and "balls skid" in qs.message(beyond)
    assert np.isnan(beyond.displacement).all() and friction_of(beyond).skids and not friction_of(near).skids


@pytest.mark.parametrize(
    ("changed", "field"),
    [
        ({"ball_effects": (qs.CentrifugalForce(),)}, "ball_effects"),
        ({"ball_effects": ()}, "raceway_control"),
        (
            {"ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=0.07))},
            "friction_coefficient",
        ),
        ({"ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment("harris"))}, "moment_shares"),
        ({"raceway_control": "outer", "traction": qs.Traction()}, "traction"),
        ({"traction": 0.07}, "traction"),
        ({"readings": {"friction": {"friction_coefficient": 0.05}}}, "readings.friction.friction_coefficient"),
        ({"hertz_angle": "actual"}, "hertz_angle"),
        ({"operation": qs.Operation(**THRUST, radial_load_y=1e3, moment_z=0.0, tilt_y=0.0)}, "operation.tilt_z"),
        ({"operation": qs.Operation(**THRUST, moment_y=1.0)}, "operation.tilt_y"),
        ({"ring_effects": (qs.BallDiameterDeviations(np.full(16, 1e-6)),)}, "unequal_balls"),
        ({"ring_effects": (qs.SeatsOutOfRound(outer_two_lobe_amplitude=1e-6),)}, "seats_out_of_round"),
        (
            {"ring_effects": (qs.ElasticRings(outside_diameter=0.16, outer_width=0.03, housing="free"),)},
            "elastic_rings",
        ),
    ],
)
def test_what_it_does_not_know_is_refused_by_name(changed: dict[str, Any], field: str) -> None:
    with pytest.raises(SceneError) as caught:
        replace(moved(), **changed)
    assert [each.field for each in caught.value.errors][:1] == [field]


def test_sets_are_refused() -> None:
    rows = tuple(qs.Row(B218, x * qs.mm, carries) for x, carries in ((0.0, "+x"), (60.0, "-x")))
    with pytest.raises(SceneError) as caught:
        qs.BearingSet(rows, qs.Operation(speed=100.0, axial_load=1e3), ball_effects=BOTH, raceway_control="friction")
    assert [each.field for each in caught.value.errors] == ["raceway_control"]


def test_heat_is_that_of_the_balance() -> None:
    asked = {"friction": {"friction_coefficient": 0.07, "hysteresis_loss": 0.0}}
    solution = qs.solve(moved(qs.Traction(0.07), RADIAL, readings=asked))
    taken, motion = qs.readings.friction(solution, 0.07), friction_of(solution)
    np.testing.assert_array_equal(taken.inner.power, motion.inner.heat)
    assert taken.power == pytest.approx(motion.heat, rel=1e-12)
    # What drives the shaft is what heats: power = torque x speed, to rounding.
    assert taken.torque == pytest.approx(-motion.torque, rel=1e-9)
    linear = qs.solve(moved(qs.Traction(0.07, law="linear")))
    assert friction_of(linear).told_heat is None and np.isnan(qs.readings.friction(linear, 0.07).power)


def test_effects_chosen_automatically_keep_what_is_asked_for_and_never_add_it() -> None:
    chosen = qs.solve(moved(qs.Traction(0.07)), effects="auto", accuracy=0.01)
    assert chosen.choice is not None and chosen.friction is not None
    assert abs(chosen.displacement[0] / qs.solve(moved(qs.Traction(0.07))).displacement[0] - 1.0) < 0.01
    other = qs.solve(replace(moved(), raceway_control="outer"), effects="auto", accuracy=1e-4)
    assert other.scene.raceway_control == "outer" and other.friction is None
    slow = qs.solve(moved(qs.Traction(0.07), THRUST | {"speed": 10 * qs.rpm}), effects="auto")
    assert slow.friction is None and slow.scene.ball_effects == (), "at low speed nothing of it matters"


def test_hypotheses_know_nothing_of_it() -> None:
    solution = qs.solve(replace(moved(), raceway_control="outer"))
    assert solution.friction is None and solution.balance is None


def test_rings_that_wedge_the_balls_are_those_of_a_hypothesis_at_low_speed() -> None:
    """At 100 rpm the balls' inertia is 1e-7 of the load: what is left is the geometry."""
    bearing = qs.BallBearing.from_diametral_clearance(
        ball_count=9, ball_diameter=7.94e-3, pitch_diameter=39.04e-3, inner_groove_radius=4.1288e-3,
        outer_groove_radius=4.1288e-3, diametral_clearance=-20e-6, kind="deep_groove",
    )  # fmt: skip
    scene = moved(None, {"axial_load": 400.0, "speed": 100 * qs.rpm})
    scene = replace(scene, bearing=bearing)
    solution, outer = qs.solve(scene), qs.solve(replace(scene, raceway_control="outer"))
    assert solution.displacement[0] == pytest.approx(outer.displacement[0], rel=1e-6)
    np.testing.assert_allclose(solution.inner.load, outer.inner.load, rtol=1e-6)


@settings(max_examples=25, deadline=None)
@given(
    axial=st.floats(1.0, 30.0),
    share=st.floats(0.0, 0.5),
    speed=st.floats(500.0, 15_000.0),
    mu=st.floats(0.03, 0.15),
    slip=st.floats(0.02, 0.5),
)
def test_forces_moments_and_energy_balance(axial: float, share: float, speed: float, mu: float, slip: float) -> None:
    load = {"axial_load": axial * 1e3, "radial_load_y": share * axial * 1e3, "speed": speed * qs.rpm} | UPRIGHT
    solution = qs.solve(moved(qs.Traction(mu, slip), load))
    if not solution.converged:
        return
    motion, forces = friction_of(solution), radial_forces(solution)
    assert forces is not None
    np.testing.assert_allclose(forces.on_outer, forces.on_inner, atol=1e-9 * axial * 1e3)
    np.testing.assert_allclose(
        solution.load[:3], [load["axial_load"], load["radial_load_y"], 0.0], atol=1e-8 * axial * 1e3
    )
    np.testing.assert_allclose(-motion.torque * load["speed"], motion.heat, rtol=1e-8)
    assert (motion.inner.friction_use <= 1.0).all() and (motion.outer.friction_use <= 1.0).all()
    assert (motion.heat > 0.0).all() and (np.abs(solution.orbital_speed) < load["speed"]).all()
