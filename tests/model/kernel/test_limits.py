"""Limits and rates: no speed, little speed, no relative speed; prescribed loads and prescribed displacements."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import qsbearing as qs
from qsbearing.model.effects.raceway_control import HYPOTHESES
from tests.qsbearing.scenes import (
    B218,
    BOTH,
    BOTH_HARRIS,
    CENTRIFUGAL,
    DISPLACEMENTS,
    INNER,
    LOADS,
    OUTER,
    PER_BALL,
    UPRIGHT,
    general_scenes,
    held_at,
    lever,
    loaded_as,
    resting,
    solved,
    turning,
    with_operation,
)

SCENES = general_scenes()
FIVE = {"axial_load": 12e3, "radial_load_y": 3e3, "radial_load_z": -1.5e3, "moment_y": 40.0, "moment_z": -60.0}


@cache
def solution_of(name: str) -> qs.Solution:
    return solved(SCENES[name])


# ---------------------------------------------------------------------------------------------------------------- speed


@pytest.mark.parametrize(
    ("effects", "control", "hertz_angle"),
    [(CENTRIFUGAL, OUTER, "free"), (BOTH, INNER, "actual"), (BOTH, PER_BALL, "free"), (BOTH_HARRIS, INNER, "free")],
)
def test_zero_speed_is_static(effects: tuple, control: qs.RacewayControl, hertz_angle: str) -> None:
    """Naming effects changes nothing at rest, bit for bit; the forces they would make are zero."""
    still = solved(resting(hertz_angle=hertz_angle, **FIVE))
    named = solved(turning(0, effects=effects, control=control, hertz_angle=hertz_angle, **FIVE))
    assert np.array_equal(named.displacement, still.displacement)
    assert np.array_equal(qs.stiffness(named.scene, named), qs.stiffness(still.scene, still))
    for race in ("inner", "outer"):
        assert np.array_equal(getattr(named, race).load, getattr(still, race).load)
        assert np.array_equal(getattr(named, race).angle, getattr(still, race).angle, equal_nan=True)
    assert not np.any(named.centrifugal_force)
    assert not np.any(named.orbital_speed)


@pytest.mark.parametrize(("control", "hertz_angle"), [(OUTER, "free"), (INNER, "actual")])
def test_a_crawl_is_nearly_static(control: qs.RacewayControl, hertz_angle: str) -> None:
    """At 0.01 rpm the equations of motion give the static answer: Fc is 1e-12 of its value at 10 000 rpm."""
    loads = {**FIVE, "axial_load": 30e3}  # all balls loaded
    still = solved(resting(hertz_angle=hertz_angle, **loads))
    assert (still.inner.load > 0.0).all()
    crawling = solved(turning(0.01, control=control, hertz_angle=hertz_angle, **loads))
    assert crawling.inner.load == pytest.approx(still.inner.load, rel=1e-10)
    assert crawling.outer.angle == pytest.approx(still.outer.angle, abs=1e-10)
    assert crawling.displacement == pytest.approx(still.displacement, rel=1e-9)


@pytest.mark.parametrize(
    ("effects", "control"),
    [(CENTRIFUGAL, OUTER), *product([(qs.GyroscopicMoment(),), BOTH], [OUTER, INNER])],
    ids=["centrifugal", "gyroscopic, outer", "gyroscopic, inner", "both, outer", "both, inner"],
)
def test_departure_from_rest_grows_as_speed_squared(effects: tuple, control: qs.RacewayControl) -> None:
    """Every inertia load is of second order in speed, and so is all that follows while it is small: slope 2.

    Its own corrections are of the order of (inertia over contact load), 1e-4 at the fastest speed here.
    """
    rpm = np.array([50.0, 70.0, 100.0, 140.0, 200.0])
    loads = {"axial_load": 17.8e3, "radial_load_y": 2e3, "moment_z": 0.0}
    still = solved(resting(**loads))
    moving = solved(turning(rpm, effects=effects, control=control, **loads))
    for departure in (
        moving.outer.angle[:, 0] - still.outer.angle[0],
        moving.inner.load[:, 5] - still.inner.load[5],
        moving.displacement[:, 1] - still.displacement[1],
    ):
        slope = np.polyfit(np.log(rpm), np.log(np.abs(departure)), 1)[0]
        assert slope == pytest.approx(2.0, abs=1e-3)


@pytest.mark.parametrize("control", HYPOTHESES)
@pytest.mark.parametrize("rpm", [3000.0, -9000.0])
def test_both_rings_at_one_speed_turn_as_one(rpm: float, control: qs.RacewayControl) -> None:
    """No relative motion: every ball goes round with the rings and does not turn; only centrifugal force is left."""
    solution = solved(turning(rpm, outer_rpm=rpm, control=control, **FIVE))
    assert solution.orbital_speed == pytest.approx(np.full(16, rpm * qs.rpm), rel=1e-14)
    assert solution.rotation_speed is not None
    assert not solution.rotation_speed.any()
    assert solution.gyroscopic_moment is not None
    assert not solution.gyroscopic_moment.any()
    mass, radius = float(B218.ball_mass), 0.5 * float(np.asarray(B218.pitch_diameter))
    assert solution.centrifugal_force == pytest.approx(np.full(16, mass * radius * (rpm * qs.rpm) ** 2), rel=1e-13)


def test_the_orbit_adds_what_both_rings_share() -> None:
    """The same speed added to both rings adds to the orbit and leaves the balls' own rotation alone, angle by angle."""
    slow = solved(turning(5000, effects=(qs.GyroscopicMoment(),), axial_load=1e6))
    both = solved(turning(5800, outer_rpm=800, effects=(qs.GyroscopicMoment(),), axial_load=1e6))
    # At this load the angles hardly feel the speeds: 1e-5 is their change.
    assert both.orbital_speed - slow.orbital_speed == pytest.approx(np.full(16, 800 * qs.rpm), rel=1e-4)  # type: ignore[operator]
    assert both.rotation_speed == pytest.approx(slow.rotation_speed, rel=1e-4)


# -------------------------------------------------------------------------------------------------- held and loaded


@pytest.mark.parametrize("name", list(SCENES))
def test_held_where_a_load_put_it_the_bearing_carries_that_load(name: str) -> None:
    """All five channels held at the displacement found return the load, one held at its own changes nothing, and all
    five loaded with what they carry return the displacement: to the imbalance, 1e-12, and its rounding."""
    scene, solution = SCENES[name], solution_of(name)
    unit = np.array([1.0, 1.0, 1.0, lever(scene), lever(scene)])
    largest, furthest = np.nanmax(solution.outer.load), np.abs(solution.displacement * unit).max()
    swapped = [held_at(scene, solution.displacement), loaded_as(scene, solution.load)]
    for channel, (load, displacement) in enumerate(zip(LOADS, DISPLACEMENTS, strict=True)):
        if getattr(scene.operation, displacement) is None:
            changes = {load: None, displacement: float(solution.displacement[channel])}
            swapped.append(with_operation(scene, **changes))
    for other in swapped:
        found = solved(other)
        assert found.load / unit == pytest.approx(solution.load / unit, abs=1e-10 * largest)
        assert found.displacement * unit == pytest.approx(solution.displacement * unit, abs=1e-10 * furthest)
        assert found.inner.load == pytest.approx(solution.inner.load, abs=1e-10 * largest)


def test_a_channel_left_out_is_free_and_unloaded() -> None:
    """Saying nothing about a channel is the same as giving it no load."""
    silent = solved(turning(7000, axial_load=9e3, radial_load_y=1e3, moment_z=0.0))
    spoken = solved(turning(7000, axial_load=9e3, radial_load_y=1e3, radial_load_z=0.0, moment_y=0.0, moment_z=0.0))
    assert np.array_equal(silent.displacement, spoken.displacement)
    assert np.array_equal(silent.outer.load, spoken.outer.load)


# ------------------------------------------------------------------------------------------------------------ monotone

axial = st.floats(500.0, 40e3)
ratio = st.floats(-0.6, 0.6)


@given(first=axial, factor=st.floats(1.01, 3.0), side=ratio)
def test_more_load_more_approach(first: float, factor: float, side: float) -> None:
    """At rest, all loads growing in proportion: the ring moves further along them, the heaviest ball carries more."""
    loads = np.array([1.0, factor]) * first
    solution = solved(resting(axial_load=loads, radial_load_y=side * loads, **UPRIGHT))
    direction = np.array([1.0, side, 0.0, 0.0, 0.0])
    along = solution.displacement @ direction
    assert along[1] > along[0]
    assert solution.inner.load[1].max() > solution.inner.load[0].max()
    assert solution.inner.approach[1].max() > solution.inner.approach[0].max()


@given(one=st.tuples(axial, ratio, ratio, ratio, ratio), other=st.tuples(axial, ratio, ratio, ratio, ratio))
def test_a_bearing_at_rest_resists_every_change(one: tuple[float, ...], other: tuple[float, ...]) -> None:
    """Stored energy is convex: between any two states at rest (F1 - F2).(d1 - d2) >= 0, zero for the same load only."""
    radius = 0.5 * float(np.asarray(B218.pitch_diameter))
    scale = np.array([1.0, 1.0, 1.0, 0.5 * radius, 0.5 * radius])
    loads = np.array([[state[0], *(state[0] * value for value in state[1:])] for state in (one, other)]) * scale
    # Without an open side: thrust may be smaller than what the moments ask for.
    bearing = replace(B218, kind=qs.BearingKind.DEEP_GROOVE)
    solution = solved(loaded_as(resting(bearing), loads))
    change = (loads[0] - loads[1]) @ (solution.displacement[0] - solution.displacement[1])
    size = np.abs((loads[0] - loads[1]) * (solution.displacement[0] - solution.displacement[1])).sum()
    assert change >= -1e-9 * size
    if np.abs(loads[0] - loads[1]).max() > 1.0:
        assert change > 0.0


@given(
    axial_load=axial,
    side=st.tuples(ratio, ratio, ratio, ratio),
    rpm=st.floats(300.0, 12e3),
    outer_rpm=st.floats(-6e3, 200.0),
    control=st.sampled_from([OUTER, PER_BALL]),
    hertz_angle=st.sampled_from(["free", "actual"]),
    first=st.floats(-3.0, 3.0),
)
@example(
    axial_load=500.0,
    side=(0.5, 0.0, 0.0, 2.2e-313),
    rpm=6e3,
    outer_rpm=0.0,
    control=OUTER,
    hertz_angle="free",
    first=0.0,
)  # a load that is no load overflowed a quotient
def test_no_contact_ever_pulls(
    axial_load: float,
    side: tuple[float, ...],
    rpm: float,
    outer_rpm: float,
    control: qs.RacewayControl,
    hertz_angle: str,
    first: float,
) -> None:
    """Whatever the scene: loads are never negative, and a contact carries load exactly where it is compressed."""
    y, z, tilt_y, tilt_z = (axial_load * value for value in side)
    scene = turning(
        rpm,
        replace(B218, kind=qs.BearingKind.DEEP_GROOVE),
        outer_rpm=outer_rpm,
        control=control,
        hertz_angle=hertz_angle,
        axial_load=axial_load,
        radial_load_y=y,
        radial_load_z=z,
        moment_y=0.02 * tilt_y,
        moment_z=0.02 * tilt_z,
        first_ball_azimuth=first,
    )
    solution = qs.solve(scene)
    assert solution.status is qs.Status.CONVERGED, (solution.status, solution.residual)
    assert solution.residual <= 1e-10
    for race in ("inner", "outer"):
        contacts = getattr(solution, race)
        assert (contacts.load >= 0.0).all()
        approach = np.nan_to_num(contacts.approach, nan=-1.0)  # undetermined: it touches nothing
        assert np.array_equal(contacts.load > 0.0, approach > 0.0)
        assert np.array_equal(contacts.max_pressure > 0.0, approach > 0.0)
