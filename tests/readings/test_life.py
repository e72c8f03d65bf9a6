"""Rating lives from solved ball loads: relations, load spectra, bad input. Published lives: the validation book."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qsbearing as qs
from fem_check.book.published import bearing
from qsbearing.readings.rating_life import LifeArguments
from tests.qsbearing.scenes import B218, DEEP_GROOVE, SPINDLE, UPRIGHT, resting, solved, turning

MREV = 1e6
FEW = settings(max_examples=12)


def test_the_system_lives_shorter_than_its_weaker_raceway() -> None:
    solution = solved(turning([0.0, 4e3, 12e3], axial_load=15e3, radial_load_y=3e3, moment_z=0.0))
    found = qs.readings.life(solution)
    weaker = np.minimum(found.inner_life, found.outer_life)
    assert (found.basic_reference_rating_life < weaker).all()
    assert (found.basic_reference_rating_life > 0.5 * weaker).all()  # 2^-0.9, were both equal


@FEW
@given(st.floats(1.5, 20.0))
def test_life_falls_with_the_cube_of_the_load_at_fixed_angle(factor: float) -> None:
    """A bearing without clearance under radial load: the angle stays zero, the load zone stays half the ring."""
    operation = {"axial_displacement": 0.0, "radial_load_y": np.array([500.0, 500.0 * factor]), **UPRIGHT}
    light, heavy = qs.readings.life(solved(resting(DEEP_GROOVE, **operation))).basic_reference_rating_life
    assert heavy / light == pytest.approx(factor**-3, rel=1e-9)


def test_every_ball_counts_and_unloaded_ones_do_no_harm() -> None:
    """Under thrust the mean is the one ball load; where only some balls carry, the standing ring suffers more."""
    thrust = qs.readings.life(solved(resting(B218, axial_load=10e3)))
    rating = qs.readings.element_load_ratings(B218, thrust.dynamic_load_rating)
    load = solved(resting(B218, axial_load=10e3)).inner.load[0]
    assert thrust.inner_life == pytest.approx(MREV * (rating[0] / load) ** 3, rel=1e-9)
    assert thrust.outer_life == pytest.approx(MREV * (rating[1] / load) ** 3, rel=1e-9)
    partly = {"axial_load": 1e3, "radial_load_y": 4e3, **UPRIGHT}
    inner_turns = qs.readings.life(solved(resting(B218, **partly, speed=10.0)))
    outer_turns = qs.readings.life(solved(resting(B218, **partly, outer_speed=10.0)))
    both_turn = qs.readings.life(solved(resting(B218, **partly, speed=10.0, outer_speed=-5.0)))
    assert inner_turns.inner_life > outer_turns.inner_life
    assert inner_turns.outer_life < outer_turns.outer_life
    assert both_turn.inner_life == inner_turns.inner_life
    assert both_turn.outer_life == outer_turns.outer_life
    assert both_turn.speed == 15.0


def test_both_kinds_of_contact_ratings() -> None:
    """At zero angle they give one life; at B218's 40 degrees, by cos(alpha)^0.9 and by how the load opens the angle."""
    radial = solved(resting(DEEP_GROOVE, axial_displacement=0.0, radial_load_y=1e3, **UPRIGHT))
    thrust = solved(resting(B218, axial_load=2e3))
    for solution, ratio in ((radial, 1.0), (thrust, np.cos(40 * qs.deg) ** -0.9)):
        by_standard, by_contact = (
            qs.readings.life(solution, capacity=kind).basic_reference_rating_life for kind in qs.readings.Capacity
        )
        # 1.04, 1.044, 0.407 and 0.389 are rounded: 0.6 % in the rating, three times that in the life.
        assert by_contact / by_standard == pytest.approx(ratio, rel=0.018)


def test_at_speed_the_outer_raceway_bears_the_centrifugal_force() -> None:
    rest, fast = (qs.readings.life(solved(turning(rpm, axial_load=8e3))) for rpm in (1.0, 14e3))
    assert fast.outer_life < 0.2 * rest.outer_life
    assert fast.basic_rating_life == pytest.approx(rest.basic_rating_life)  # the catalogue's life knows no speed


def test_equivalent_load_by_angle() -> None:
    forty, twenty_five, fifteen = (bearing(15, 10, 80, angle) for angle in (40.0, 25.0, 15.0))
    P = qs.readings.equivalent_load
    assert P(forty, 1000, 2000) == pytest.approx(0.35 * 1000 + 0.57 * 2000)
    assert P(forty, 1000, 1000) == 1000.0
    assert P(twenty_five, 1000, 1000) == pytest.approx(0.41 * 1000 + 0.87 * 1000)
    light = 0.178 * 15 * 100 * np.cos(15 * qs.deg)  # 0.178 is the standard's f0 Fa/C0, with three digits
    assert P(fifteen, 100.0, light) == pytest.approx(0.44 * 100 + 1.47 * light, rel=1e-3)
    ten, five, twelve = (bearing(15, 10, 80, angle) for angle in (10.0, 5.0, 12.5))
    assert P(ten, 100.0, 1.03 * 1500) == pytest.approx(0.46 * 100 + 1.41 * 1545)
    assert P(five, 100.0, 1.03 * 1500) == pytest.approx(0.56 * 100 + 1.55 * 1545)
    assert P(twelve, 100.0, 1.03 * 1500) == pytest.approx(0.45 * 100 + 1.32 * 1545)
    angles = np.linspace(0.0, 45.0, 91)
    thrust = P(bearing(15, 10, 80, angles), 0.0, 2000.0)
    assert (np.diff(thrust) <= 1e-9).all()  # the steeper the contact, the lighter a thrust


def test_equivalent_load_of_thrust_bearings() -> None:
    """X and e of ISO 281, table 5, to its two digits; less thrust than e Fr does not suit a single row."""
    P = qs.readings.equivalent_load
    for angle, e, X in ((50, 1.49, 0.73), (60, 2.17, 0.92), (70, 3.43, 1.28), (80, 7.09, 2.43)):
        steep = bearing(15, 10, 80, float(angle))
        assert P(steep, 100.0, 1000.0) == pytest.approx(X * 100 + 1000, abs=0.51)
        assert P(steep, 1000.0, (e + 0.006) * 1000) > 0.0
        assert np.isnan(P(steep, 1000.0, (e - 0.006) * 1000))
    both = P(bearing(15, 10, 80, np.array([40.0, 60.0])), 0.0, 1000.0)
    assert both == pytest.approx([570.0, 1000.0])
    loaded = {"axial_load": 1e3, "radial_load_y": 900.0, **UPRIGHT}
    warned = qs.readings.life(solved(resting(bearing(15, 10, 80, 50.0), **loaded)))
    assert any("no L10" in sentence for sentence in warned.warnings)
    assert warned.basic_reference_rating_life > 0.0


@pytest.mark.parametrize("angle", [46.0, 60.0, 80.0])
def test_a_thrust_bearing_lives_as_its_rating_says(angle: float) -> None:
    """Where no load opens the angle, the reference life is (Ca/Fa)^3, whatever the raceways' shares."""
    thrust = bearing(20, 10, 80, angle, 0.53, 0.54)
    found = qs.readings.life(solved(resting(thrust, axial_load=1e-3)))
    by_rating = MREV * (found.dynamic_load_rating / 1e-3) ** 3
    assert found.basic_reference_rating_life == pytest.approx(by_rating, rel=1e-4)  # the angle opens by 1e-5
    assert found.basic_rating_life == pytest.approx(by_rating)
    assert found.equivalent_load == 1e-3
    by_contact = qs.readings.life(solved(resting(thrust, axial_load=1e-3)), capacity="lundberg_palmgren")  # type: ignore[arg-type]
    # 1.72 in the rating's formula stands for 1.39 + 1/3 of the raceways' own.
    assert by_contact.basic_reference_rating_life == pytest.approx(by_rating, rel=1e-3)


def test_modified_life_of_thrust_bearings() -> None:
    """aISO is taken at a third of eC Cu/P."""
    flat, steep = (solved(resting(bearing(20, 10, 80, angle), axial_load=5e3)) for angle in (44.0, 46.0))
    for solution, share in ((flat, 1.0), (steep, 3.0)):
        found = qs.readings.life(solution, viscosity_ratio=1.5, contamination_factor=0.4, fatigue_load_limit=500.0)
        P = share * found.reference_load
        assert found.life_modification_factor == qs.readings.life_modification_factor(1.5, 0.4, 500.0, P)


def test_modified_life_is_asked_for_or_absent() -> None:
    solution = solved(turning(10e3, axial_load=17.8e3))
    plain = qs.readings.life(solution)
    assert plain.life_modification_factor is None
    assert plain.modified_reference_rating_life is None
    asked = qs.readings.life(solution, viscosity_ratio=1.5, contamination_factor=0.4, reliability=0.99)
    assert asked.modified_reference_rating_life == pytest.approx(
        asked.reliability_factor * asked.life_modification_factor * plain.basic_reference_rating_life
    )
    assert asked.reliability_factor == pytest.approx(0.248, abs=1e-3)
    cleaner = qs.readings.life(solution, viscosity_ratio=1.5, contamination_factor=0.8)
    assert cleaner.life_modification_factor > asked.life_modification_factor


def test_a_modification_factor_at_its_limit_is_said() -> None:
    """A light load and clean oil: the cap of 50, which then makes the whole difference."""
    solution = solved(turning(np.array([3e3, 3e3]), axial_load=np.array([2e3, 40e3])))
    found = qs.readings.life(solution, viscosity_ratio=3.0, contamination_factor=0.9)
    assert found.life_modification_factor[0] == 50.0
    assert found.is_at_limit.tolist() == [True, False]
    (said,) = (sentence for sentence in found.warnings if "upper limit" in sentence)
    assert said.startswith("1 of 2 cases, the first 0: aISO is at the upper limit of ISO 281, 50")
    assert found.duration[0] == pytest.approx(50.0 * found.basic_duration[0])
    plain = qs.readings.life(solution)
    assert plain.is_at_limit is None
    assert plain.duration == pytest.approx(plain.basic_duration)
    assert plain.basic_duration == pytest.approx(plain.basic_reference_rating_life / 50.0)


def test_a_life_that_nobody_should_count_on_is_said() -> None:
    """From an aISO of 5 on, and from 200,000 h; a life at rest is infinite and no such life."""
    of = solved(turning(np.full(3, 300.0), axial_load=np.array([5e3, 15e3, 60e3])))
    slow = qs.readings.life(of, viscosity_ratio=2.0, contamination_factor=0.35)
    factor, hours = slow.life_modification_factor, slow.duration / 3600.0
    assert ((factor > 5.0) & (factor < 50.0)).any() and not (factor > 5.0).all()
    assert (hours > 200_000.0).any() and not (hours > 200_000.0).all()
    said = [each for each in slow.warnings if "limit of practice" in each]
    for count, begin in (
        (np.sum((factor > 5.0) & (factor < 50.0)), "aISO is beyond 5,"),
        (np.sum(hours > 200_000.0), "h is beyond 200,000 h,"),
    ):
        assert sum(begin in each and each.startswith(f"{count} of 3 cases") for each in said) == 1, said
    resting_life = qs.readings.life(solved(resting(B218, axial_load=9e3)))
    assert not any("practice" in each for each in resting_life.warnings)


def test_arrays_and_unsolved_cases() -> None:
    """Cases in a batch live as alone; one without equilibrium has no life."""
    loads = np.array([5e3, -5e3, 20e3])
    solution = qs.solve(resting(B218, axial_load=loads))
    found = qs.readings.life(solution).basic_reference_rating_life
    assert np.isnan(found).tolist() == [False, True, False]
    alone = qs.readings.life(solved(resting(B218, axial_load=20e3))).basic_reference_rating_life
    assert found[2] == pytest.approx(alone, rel=1e-12)


def test_ball_counts_that_vary() -> None:
    counts = np.array([8, 16])
    both = solved(resting(bearing(counts, 10, 80, 25), axial_load=2e3))
    one = solved(resting(bearing(8, 10, 80, 25), axial_load=2e3))
    assert qs.readings.life(both).basic_reference_rating_life[0] == pytest.approx(
        qs.readings.life(one).basic_reference_rating_life, rel=1e-12
    )


def test_no_load_no_damage() -> None:
    idle = qs.readings.life(solved(resting(B218, axial_load=0.0)))
    assert idle.basic_reference_rating_life == np.inf
    assert idle.reference_load == 0.0


# ------------------------------------------------------------------------------------------------------------- spectrum


def test_a_spectrum_of_equal_points_is_the_point() -> None:
    solution = solved(resting(B218, axial_load=np.full(3, 9e3), speed=3000 * qs.rpm))
    each = qs.readings.life(solution)
    mixed = qs.readings.spectrum_life(each, [0.2, 0.3, 0.5])
    assert mixed.duration == pytest.approx(each.duration[0])
    assert mixed.life == pytest.approx(each.basic_reference_rating_life[0])
    assert mixed.damage_share == pytest.approx([0.2, 0.3, 0.5])


def test_a_spectrum_adds_damage() -> None:
    """Palmgren-Miner by hand, points along the first of two axes; standing still does no harm."""
    load = np.array([4e3, 16e3, 10e3])[:, None] * np.array([1.0, 1.5])
    speed = np.array([3000.0, 1500.0, 0.0])[:, None] * qs.rpm
    each = qs.readings.life(solved(resting(B218, axial_load=load, speed=speed)))
    mixed = qs.readings.spectrum_life(each, [0.6, 0.3, 0.1], axis=0)
    rate = (0.6 * 50.0, 0.3 * 25.0)
    L = each.basic_reference_rating_life
    by_hand = 1.0 / (rate[0] / L[0] + rate[1] / L[1])
    assert mixed.duration == pytest.approx(by_hand)
    assert mixed.life == pytest.approx(by_hand * sum(rate))
    assert mixed.damage_share[2] == pytest.approx([0.0, 0.0])


def test_bad_shares() -> None:
    each = qs.readings.life(solved(resting(B218, axial_load=np.array([4e3, 8e3]), speed=10.0)))
    with pytest.raises(qs.SceneError, match=r"adds up to 0\.9"):
        qs.readings.spectrum_life(each, [0.5, 0.4])
    with pytest.raises(qs.SceneError, match="3 values for 2 operating points"):
        qs.readings.spectrum_life(each, [0.5, 0.4, 0.1])
    with pytest.raises(qs.SceneError, match="negative"):
        qs.readings.spectrum_life(each, [0.5, -0.5])


# ------------------------------------------------------------------------------------------------ remarks and bad input


def test_all_wrong_arguments_at_once() -> None:
    solution = solved(resting(B218, axial_load=4e3))
    with pytest.raises(qs.SceneError) as caught:
        qs.readings.life(solution, rating="iso", reliability=0.5, viscosity_ratio=1.0, dynamic_load_rating=-1.0)  # type: ignore[arg-type]
    fields = {error.field for error in caught.value.errors}
    assert fields == {"rating", "reliability", "contamination_factor", "dynamic_load_rating"}


def test_what_the_sources_do_not_cover_is_said() -> None:
    hybrid = qs.readings.life(solved(turning(20e3, SPINDLE, axial_load=1e3)))
    assert any("ceramic" in sentence for sentence in hybrid.warnings)
    wide = qs.readings.life(solved(resting(B218, axial_load=4e3)), rating="iso_281")  # type: ignore[arg-type]
    assert any("0.52" in sentence for sentence in wide.warnings)
    crushed = qs.readings.life(solved(resting(B218, axial_load=np.array([4e3, 9e5]))))
    assert any(
        sentence.startswith("1 of 2 cases, the first 1: the pressure of a contact") for sentence in crushed.warnings
    )
    assert qs.readings.life(solved(resting(B218, axial_load=4e3))).warnings == ()


def test_static_safety_two_ways() -> None:
    """Under thrust both safeties see the same ball load: C0/P0 by Y0 = 0.26, the contact by its own pressure."""
    solution = solved(resting(B218, axial_load=20e3))
    found = qs.readings.static_safety(solution)
    assert found.static_equivalent_load == pytest.approx(0.26 * 20e3)
    assert found.static_safety == pytest.approx(found.static_load_rating / 5200.0)
    p = max(solution.inner.max_pressure[0], solution.outer.max_pressure[0])
    assert found.contact_safety == pytest.approx((4200e6 / p) ** 3)
    assert found.warnings == ()
    tilted = qs.readings.static_safety(solved(resting(B218, axial_load=20e3, moment_y=100.0)))
    assert any("moment" in sentence for sentence in tilted.warnings)
    crushed = qs.readings.static_safety(solved(resting(B218, axial_load=9e5)))
    assert crushed.contact_safety < 1.0
    assert any("permanent dents" in sentence for sentence in crushed.warnings)


@pytest.mark.parametrize(("given", "hint"), [(95, "95 % is 0.95"), (99.95, "99.95 % is 0.9995"), (50.0, ""), (1.0, "")])
def test_a_reliability_in_per_cent_is_named(given: float, hint: str) -> None:
    (error,) = LifeArguments(reliability=given).errors(None)
    assert error.cause == (hint and f"Given in per cent? {hint}")
