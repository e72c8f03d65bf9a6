"""Expansion of rings and balls: fits by closed forms, geometry by proportion, limits, powers, order, absence."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import qsbearing as qs
from tests.qsbearing.scenes import B218, BOTH, DEEP_GROOVE, OUTER, grown_scenes, resting, solved, turning

BORE, OUTSIDE = 90 * qs.mm, 160 * qs.mm
SEAT = 0.5 * BORE
BOTTOM = float(B218.inner_groove_centre_radius) - 11.6281 * qs.mm
E, NU, RHO = 208e9, 0.3, 7800.0
ROUNDING = 1e-12
"""Of lengths: some hundred operations of 2e-16 each."""


def rings(**parameters: Any) -> qs.RingExpansion:
    """Of B218 on its seats."""
    return qs.RingExpansion(BORE, OUTSIDE, **parameters)


def expanded(*effects: Any, rpm: float = 0.0, bearing: qs.BallBearing = B218, **operation: Any) -> qs.Scene:
    """A scene with ring effects and no ball effects."""
    return qs.Scene(bearing, qs.Operation(speed=rpm * qs.rpm, **operation), ring_effects=effects)


def state(effect: qs.RingExpansion, rpm: float = 0.0) -> qs.RingState:
    """Of the inner ring."""
    return effect.states(B218, qs.Operation(speed=rpm * qs.rpm))[0]


def hot(celsius: float) -> float:
    return celsius + qs.zero_celsius


# Fits -----------------------------------------------------------------------------------------------------------------


def test_a_fit_on_a_solid_shaft_of_the_same_steel() -> None:
    """Lame: p = E (I/2)/R (b^2 - R^2)/(2 b^2); the groove's bottom moves by 2 p R^2 b/(E (b^2 - R^2))."""
    found = state(rings(shaft_interference=20 * qs.um))
    pressure = E * 10e-6 / SEAT * (BOTTOM**2 - SEAT**2) / (2 * BOTTOM**2)
    assert found.seat_pressure == pytest.approx(pressure, rel=ROUNDING)
    grown = 2 * pressure * SEAT**2 * BOTTOM / (E * (BOTTOM**2 - SEAT**2))
    assert found.groove_growth == pytest.approx(grown, rel=ROUNDING)
    assert found.bore_hoop_stress == pytest.approx(
        pressure * (BOTTOM**2 + SEAT**2) / (BOTTOM**2 - SEAT**2), rel=ROUNDING
    )


def test_raceways_move_as_makers_handbooks_have_it() -> None:
    """Rings and seats of one steel: of the interference, k (1 - k0^2)/(1 - k^2 k0^2) reaches the raceway, with
    k = d/Di and k0 the hollow shaft's ratio; likewise outside with h = Do/D and h0 = D/(housing's diameter).

    The form in which bearing makers print Lame's result (NSK, Technical Report CAT. E728, on fits)."""
    hollow, housing = 50 * qs.mm, 240 * qs.mm
    effect = rings(
        shaft_interference=20 * qs.um,
        shaft_bore_diameter=hollow,
        housing_interference=15 * qs.um,
        housing_outside_diameter=housing,
    )
    inner, outer = effect.states(B218, qs.Operation())
    k, k0 = SEAT / BOTTOM, hollow / BORE
    assert inner.groove_growth == pytest.approx(10e-6 * k * (1 - k0**2) / (1 - k**2 * k0**2), rel=ROUNDING)
    top = 2 * (float(B218.outer_groove_centre_radius) + 11.6281 * qs.mm)
    h, h0 = top / OUTSIDE, OUTSIDE / housing
    assert outer.groove_growth == pytest.approx(-7.5e-6 * h * (1 - h0**2) / (1 - h**2 * h0**2), rel=ROUNDING)


@pytest.mark.parametrize("hollow", [0.0, 60 * qs.mm])
def test_ring_and_shaft_of_one_steel_turn_as_one_disk(hollow: float) -> None:
    """Timoshenko's annulus in one piece pulls at the seat's radius by sigma_r: the pressure of the fit falls by it."""
    effect = rings(shaft_interference=40 * qs.um, shaft_bore_diameter=hollow)
    speed = 8000 * qs.rpm
    a, r, b = 0.5 * hollow, SEAT, BOTTOM
    pull = (3 + NU) / 8 * RHO * speed**2 * (a**2 + b**2 - (a * b / r) ** 2 - r**2)
    rest, turning_ring = state(effect), state(effect, 8000)
    assert rest.seat_pressure is not None
    assert turning_ring.seat_pressure == pytest.approx(rest.seat_pressure - pull, rel=ROUNDING)


def test_a_fit_is_lost_where_the_pull_reaches_the_pressure_and_the_ring_is_then_free() -> None:
    effect = rings(shaft_interference=10 * qs.um)
    pressure = state(effect).seat_pressure
    lost_at = float(np.sqrt(8 * pressure / ((3 + NU) * RHO * (BOTTOM**2 - SEAT**2)))) / qs.rpm
    before, after = state(effect, 0.999 * lost_at), state(effect, 1.001 * lost_at)
    assert before.seat_pressure > 0.0
    assert before.seat_gap == 0.0
    assert after.seat_pressure == 0.0
    assert after.seat_gap > 0.0
    free = state(rings(), 1.001 * lost_at)
    assert after.groove_growth == free.groove_growth
    said = qs.warnings(solved(expanded(effect, rpm=1.001 * lost_at, axial_load=5e3)))
    assert any("fit of the inner ring is lost" in sentence for sentence in said)
    assert not any("lost" in one for one in qs.warnings(solved(expanded(effect, rpm=0.999 * lost_at, axial_load=5e3))))


def test_heat_at_the_seats_is_an_interference() -> None:
    """A shaft warmer by dT adds alpha dT d to the interference; a housing that cools loses as much."""
    warm = rings(shaft_interference=10 * qs.um, shaft_temperature=hot(50))
    tight = rings(shaft_interference=10 * qs.um + 12e-6 * 30 * BORE)
    assert state(warm).seat_pressure == pytest.approx(state(tight).seat_pressure, rel=ROUNDING)
    at = qs.Operation()
    housing = {"housing_interference": -5 * qs.um, "housing_outside_diameter": 220 * qs.mm}
    cold = rings(**housing, housing_temperature=hot(-20)).states(B218, at)[1]
    given = rings(**housing | {"housing_interference": -5 * qs.um + 12e-6 * 40 * OUTSIDE}).states(B218, at)[1]
    assert cold.seat_pressure > 0.0
    assert cold.seat_pressure == pytest.approx(given.seat_pressure, rel=ROUNDING)
    assert cold.groove_growth < 0.0
    loose = rings(**housing).states(B218, at)[1]
    assert (loose.seat_pressure, loose.groove_growth) == (0.0, 0.0)
    assert loose.seat_gap == pytest.approx(5 * qs.um, rel=ROUNDING)


def test_a_seat_without_a_temperature_of_its_own_is_as_warm_as_its_ring() -> None:
    """Ring and seat of one steel, equally warm: the pressure of the cold fit, whatever the temperature."""
    fits = {
        **{"shaft_interference": 15 * qs.um, "housing_interference": 8 * qs.um},
        **{"housing_outside_diameter": 220 * qs.mm},
    }
    cold = rings(**fits).states(B218, qs.Operation())
    left_out = rings(**fits, inner_ring_temperature=hot(70), outer_ring_temperature=hot(60))
    given = replace(left_out, shaft_temperature=hot(70), housing_temperature=hot(60))
    for before, one, other in zip(cold, *(e.states(B218, qs.Operation()) for e in (left_out, given)), strict=True):
        assert one == other
        assert one.seat_pressure == pytest.approx(before.seat_pressure, rel=1e-9)
        assert one.seat_gap == 0.0
    own = replace(left_out, shaft_temperature=hot(20)).states(B218, qs.Operation())[0]
    assert own.seat_gap > 0.0
    taken = {body: each.taken_from for body, each in left_out.temperatures.items()}
    assert taken == {
        **{"shaft": "as the inner ring", "inner_ring": "given"},
        **{"outer_ring": "given", "housing": "as the outer ring"},
    }
    assert rings().temperatures["inner_ring"] == (hot(20), "reference temperature")


def test_what_is_not_regarded_is_none() -> None:
    solution = solved(expanded(rings(), axial_load=5e3))
    assert solution.inner_ring.seat_pressure is None
    assert solution.outer_ring.seat_gap is None
    assert solved(resting(axial_load=5e3)).inner_ring is None


# Geometry -------------------------------------------------------------------------------------------------------------


def test_a_bearing_that_is_warm_throughout_grows_in_proportion() -> None:
    """All lengths by 1 + alpha dT, and no angle changes."""
    warm = {f"{part}_temperature": hot(120) for part in ("inner_ring", "outer_ring")}
    found = expanded(rings(**warm), qs.BallExpansion(hot(120))).operating_bearing
    for name in ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"):
        assert getattr(found, name) == pytest.approx(getattr(B218, name) * (1 + 12e-6 * 100), rel=ROUNDING), name
    assert found.free_contact_angle == pytest.approx(B218.free_contact_angle, rel=1e-10)


def test_growth_takes_the_clearance_that_it_takes() -> None:
    """Pd falls by twice what the inner groove grows beyond the outer one, and by what ball and grooves take of it."""
    effect = rings(shaft_interference=20 * qs.um, inner_ring_temperature=hot(70))
    scene = expanded(effect, qs.BallExpansion(hot(50)), rpm=9000)
    grown = scene.operating_bearing
    inner, outer = effect.states(B218, scene.operation)
    assert outer.groove_growth == 0.0
    bd = grown.groove_centre_distance - B218.groove_centre_distance
    expected = B218.diametral_clearance + 2 * bd - 2 * inner.groove_growth
    assert grown.diametral_clearance == pytest.approx(expected, rel=ROUNDING)
    assert grown.inner_groove_centre_radius - B218.inner_groove_centre_radius == pytest.approx(
        inner.groove_growth, rel=1e-9
    )
    assert grown.outer_groove_centre_radius == pytest.approx(B218.outer_groove_centre_radius, rel=ROUNDING)


def test_displacements_count_from_rest_and_cold() -> None:
    """With the ring held in its place, groove centres stand apart axially by what the cold bearing says and the heat of
    the inner ring adds, and radially as in the grown one: hypot(A1, A2) is the contact line's length."""
    place = 25 * qs.um
    effect = rings(inner_ring_temperature=hot(60), shaft_interference=30 * qs.um)
    solution = solved(expanded(effect, qs.BallExpansion(hot(40)), axial_displacement=place))
    grown = solution.scene.operating_bearing
    a1 = B218.groove_centre_distance * np.sin(B218.free_contact_angle) + place
    a1 += 12e-6 * 40 * (B218.inner_groove_radius - 0.5 * B218.ball_diameter) * np.sin(B218.free_contact_angle)
    a2 = grown.inner_groove_centre_radius - grown.outer_groove_centre_radius
    line = solution.inner.approach + solution.outer.approach + grown.groove_centre_distance
    np.testing.assert_allclose(line, np.hypot(a1, a2), rtol=ROUNDING)
    np.testing.assert_allclose(np.tan(solution.inner.angle), a1 / a2, rtol=ROUNDING)
    assert solution.displacement[0] == pytest.approx(place, rel=1e-9)
    cold = solved(resting(axial_displacement=place))
    assert solution.load[0] > cold.load[0], "a growing ring presses harder"


def test_a_loaded_ring_moves_back_as_it_grows() -> None:
    """Under a thrust the inner ring comes back towards the outer one by what its growth takes of BD sin alpha0."""
    found = [solved(expanded(rings(inner_ring_temperature=hot(t)), axial_load=5e3)).displacement[0] for t in (20, 40)]
    assert found[1] < found[0] - 5 * qs.um


@pytest.mark.parametrize("interference", [1e-7, 5e-6, 20e-6])
def test_balls_wedged_between_the_rings(interference: float) -> None:
    """Without a load each carries K e^1.5; under a radial load the ring is where the loads at angle zero balance it."""
    cold = replace(DEEP_GROOVE, free_contact_angle=0.0)
    bearing = cold.with_changed_lengths(inner_groove_centre=interference)
    assert bearing.radial_interference == pytest.approx(interference, rel=1e-9)
    assert bearing.diametral_clearance == pytest.approx(-2 * interference, rel=1e-9)
    alone = solved(resting(bearing, axial_load=0.0))
    stiffness = (alone.inner.load / interference**1.5)[0]
    np.testing.assert_allclose(alone.inner.load, stiffness * interference**1.5, rtol=1e-9)
    thrust = solved(resting(cold, axial_displacement=0.0, radial_displacement_y=interference, tilt_z=0.0, tilt_y=0.0))
    assert thrust.inner.load[0] == pytest.approx(alone.inner.load[0], rel=1e-3)  # of the curvature: pitch moves by e

    def excess(y: float) -> float:
        load = stiffness * np.maximum(interference + y * np.cos(alone.azimuth), 0.0) ** 1.5
        return float(load @ np.cos(alone.azimuth)) - 800.0

    held = solved(resting(bearing, axial_displacement=0.0, radial_load_y=800.0, tilt_z=0.0, tilt_y=0.0))
    assert held.displacement[1] == pytest.approx(brentq(excess, 0.0, 1e-4, xtol=1e-18), rel=1e-9)


@pytest.mark.parametrize("name", list(grown_scenes()))
def test_wedged_balls_are_said(name: str) -> None:
    solution = solved(grown_scenes()[name])
    is_wedged = bool(solution.scene.operating_bearing.radial_interference > 0.0)
    assert is_wedged == name.startswith("wedged")
    assert any("the balls are wedged between the rings" in sentence for sentence in qs.warnings(solution)) == is_wedged


@pytest.mark.parametrize("name", ["grown rings and balls", "wedged"])
def test_balls_on_their_own_orbits_are_where_grown_grooves_put_them(name: str) -> None:
    """Fc = m R omega_m^2, R from the axis by the outer groove's centre and the contact line there; m as cold."""
    solution = solved(replace(grown_scenes()[name], orbit_radius="displaced"))
    grown = solution.scene.operating_bearing
    line = grown.outer_groove_radius - 0.5 * grown.ball_diameter + solution.outer.approach
    radius = grown.outer_groove_centre_radius + line * np.cos(solution.outer.angle)
    mass = float(solution.scene.bearing.ball_mass)
    np.testing.assert_allclose(solution.centrifugal_force, mass * radius * solution.orbital_speed**2, rtol=1e-12)


def test_wedged_balls_are_continuous_with_free_ones() -> None:
    """Through a clearance of nothing; at speed too."""
    loads = {"axial_load": 200.0, "radial_load_y": 500.0, "moment_z": 0.0}
    found = []
    for clearance in (-2e-9, 2e-9):
        bearing = replace(DEEP_GROOVE, free_contact_angle=0.0).with_changed_lengths(inner_groove_centre=-clearance)
        assert (bearing.radial_interference > 0.0) == (clearance < 0.0)
        found.append(solved(turning(8000, bearing, **loads)))
    np.testing.assert_allclose(found[0].outer.load, found[1].outer.load, rtol=2e-3)
    offset = found[1].scene.bearing.touching_offset
    assert found[0].displacement[0] == pytest.approx(found[1].displacement[0] + offset, rel=2e-3)


# Limits, powers, order ------------------------------------------------------------------------------------------------


def test_nothing_to_expand_by_is_absence() -> None:
    """At rest, isothermal, fitted line to line: the same bearing to rounding, and the same solution."""
    effect = rings(
        shaft_interference=0.0,
        housing_interference=0.0,
        housing_outside_diameter=220 * qs.mm,
        shaft_temperature=hot(20),
    )
    for bearing in (B218, replace(DEEP_GROOVE, ring_material=qs.STEEL, ball_material=qs.STEEL)):
        one = replace(effect, bore_diameter=25 * qs.mm, outside_diameter=170 * qs.mm)
        found = expanded(one, qs.BallExpansion(hot(20)), bearing=bearing).operating_bearing
        for name in ("ball_diameter", "pitch_diameter", "inner_groove_radius", "free_contact_angle"):
            assert getattr(found, name) == pytest.approx(getattr(bearing, name), rel=ROUNDING), name
        assert found.radial_interference == 0.0
    loads = {"axial_load": 8e3, "radial_load_y": 2e3, "moment_z": 0.0}
    with_it, without = solved(expanded(effect, **loads)), solved(resting(**loads))
    np.testing.assert_allclose(with_it.inner.load, without.inner.load, rtol=1e-10)
    np.testing.assert_allclose(with_it.displacement, without.displacement, rtol=1e-9, atol=1e-15)


def test_growth_follows_its_powers() -> None:
    """Speed squared; interference and temperature to the first; exact but for rounding, since the ring is linear."""
    assert state(rings(), 12000).groove_growth == pytest.approx(4 * state(rings(), 6000).groove_growth, rel=ROUNDING)
    tight, tighter = (state(rings(shaft_interference=size)) for size in (10 * qs.um, 30 * qs.um))
    assert tighter.groove_growth == pytest.approx(3 * tight.groove_growth, rel=ROUNDING)
    warm, warmer = (state(rings(inner_ring_temperature=hot(t))) for t in (30, 60))
    assert warmer.groove_growth == pytest.approx(4 * warm.groove_growth, rel=ROUNDING)


def test_the_order_of_ring_effects_is_irrelevant() -> None:
    """Also where one of them alone would wedge the balls and the other leaves them room."""
    cold_balls = qs.BallExpansion(hot(-40))
    for bearing, effect in (
        (B218, rings(shaft_interference=30 * qs.um, outer_ring_temperature=hot(60))),
        (
            replace(DEEP_GROOVE, ring_material=qs.STEEL, ball_material=qs.STEEL),
            qs.RingExpansion(25 * qs.mm, 62 * qs.mm, inner_ring_temperature=hot(30)),
        ),
    ):
        one, other = (
            expanded(*order, rpm=8000, bearing=bearing, axial_load=500.0).operating_bearing
            for order in ((effect, cold_balls), (cold_balls, effect))
        )
        for name in ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"):
            assert getattr(one, name) == pytest.approx(getattr(other, name), rel=ROUNDING), name
        assert one.diametral_clearance == pytest.approx(other.diametral_clearance, rel=1e-9)


def test_arrays_span_cases_as_each_alone() -> None:
    effect = rings(
        shaft_interference=np.array([5e-6, 20e-6, 40e-6]), inner_ring_temperature=hot(np.array([[20.0], [90.0]]))
    )
    many = solved(
        qs.Scene(B218, qs.Operation(speed=7000 * qs.rpm, axial_load=6e3), BOTH, OUTER, ring_effects=(effect,))
    )
    assert many.shape == (2, 3)
    assert many.inner_ring.seat_pressure.shape == (2, 3)
    alone = rings(shaft_interference=20e-6, inner_ring_temperature=hot(90.0))
    one = solved(qs.Scene(B218, many.scene.operation, BOTH, OUTER, ring_effects=(alone,)))
    np.testing.assert_allclose(many.inner.load[1, 1], one.inner.load, rtol=1e-9)
    assert many.displacement[1, 1, 0] == pytest.approx(one.displacement[0], rel=1e-9)
    assert many.inner_ring.seat_pressure[1, 1] == pytest.approx(one.inner_ring.seat_pressure, rel=ROUNDING)


def test_an_absent_effect_is_never_evaluated() -> None:
    """Functions entered by making and solving a scene and reading it off, by file; warnings estimate what is absent."""

    def entered(*effects: Any) -> set[str]:
        files: set[str] = set()

        def hook(frame: FrameType, event: str, argument: Any) -> None:
            if event == "call":
                files.add(Path(frame.f_code.co_filename).name)

        sys.setprofile(hook)
        try:
            solution = qs.solve(expanded(*effects, rpm=5000, axial_load=5e3))
            str(solution.inner_ring), str(solution.displacement)
        finally:
            sys.setprofile(None)
        return files & {"annulus.py", "ring_expansion.py", "ball_expansion.py"}

    assert entered() == set()
    assert "annulus.py" not in entered(qs.BallExpansion(hot(50)))
    assert entered(rings()) == {"annulus.py", "ring_expansion.py"}
