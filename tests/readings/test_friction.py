"""Friction integrals against closed forms and brute force; powers of a bearing; catalogue estimates."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe

import qsbearing as qs
from qsbearing.documents.terminal import text_of
from qsbearing.files.scene_file import scene_of
from qsbearing.readings import friction_estimate
from qsbearing.readings.ellipse_sliding import (
    deformed_radius,
    mean_sliding_speed,
    place_of_ellipse,
    sliding_table,
    tabulated_sliding_speed,
)
from qsbearing.results.json_record import record
from qsbearing.results.report import result
from tests.qsbearing.scenes import B218, BOTH, CENTRIFUGAL, DEEP_GROOVE, SPINDLE, resting, solved, turning

ONE, NONE = np.ones(1), np.zeros(1)


def scene_with_friction() -> qs.Scene:
    """A 7210C that asks for all that there is of friction."""
    sizes = {"bore_diameter_mm": 50, "outside_diameter_mm": 90, "static_load_rating_N": 37e3, "lubrication_factor": 2}
    readings = {
        "lubricant": {"iso_viscosity_grade": 32, "oil_temperature_C": 70},
        "friction": {"friction_coefficient": 0.05},
        "friction_estimate": sizes,
    }
    operation = {"speed_rpm": 6000, "axial_load_N": 1500}
    return scene_of({"bearing": {"name": "7210C"}, "operation": operation, "readings": readings}, "test")


@pytest.mark.parametrize("ratio", [1.0, 0.3, 0.1, 0.03])
def test_pure_spin_is_the_closed_form(ratio: float) -> None:
    """M = 3 mu Q a E/8; for the circle 3 pi mu Q a/16."""
    mean, _ = mean_sliding_speed(NONE, ONE, ratio * ONE)
    assert mean[0] == pytest.approx(0.375 * ellipe(1 - ratio**2), rel=1e-4)


def test_the_quadrature_converges_spectrally() -> None:
    """Errors of pure spin on a circle fall faster than any power of the nodes: below 1e-9 with 16."""
    exact = 3 * np.pi / 16
    errors = [abs(mean_sliding_speed(NONE, ONE, ONE, nodes)[0][0] / exact - 1) for nodes in (4, 8, 16)]
    assert errors[0] > 1e-4
    assert errors[1] < 1e-2 * errors[0]
    assert errors[2] < 1e-9


def test_rolling_without_spin_is_heathcote_s() -> None:
    """Pure rolling at 0.347 a, and the mean of |c - X^2| with the pressure."""
    place = brentq(lambda x: x - x**3 / 3 - 1 / 3, 0.0, 1.0)
    assert place == pytest.approx(0.347, abs=5e-4)
    X = np.linspace(-1, 1, 400001)
    exact = np.trapezoid(0.75 * (1 - X**2) * np.abs(place**2 - X**2), X)
    mean, c = mean_sliding_speed(ONE, NONE, 0.1 * ONE)
    assert np.sqrt(c[0]) == pytest.approx(place, rel=0.01)
    assert mean[0] == pytest.approx(exact, rel=1e-4)  # c is halved down to 2e-3; the power is least there


@pytest.mark.parametrize(("spin", "ratio"), [(0.3, 0.12), (1.0, 0.3), (-3.0, 0.12), (0.02, 1.0)])
def test_both_at_once_by_brute_force(spin: float, ratio: float) -> None:
    """A midpoint grid over the ellipse: the same power, no net traction, and no other c takes less power."""
    n = 1500
    X, Y = np.meshgrid(*(2 * [(np.arange(n) + 0.5) / n * 2 - 1]))
    weight = np.sqrt(np.maximum(1 - X**2 - Y**2, 0.0)) * (2 / n) ** 2 * 1.5 / np.pi
    mean, c = mean_sliding_speed(ONE, spin * ONE, ratio * ONE)

    def grid(place: float) -> tuple[float, float]:
        along, across = place - X**2 + spin * X, spin * ratio * Y
        speed = np.hypot(along, across)
        return float((weight * speed).sum()), float((weight * along / speed).sum())

    power, traction = grid(float(c[0]))
    assert mean[0] == pytest.approx(power, rel=1e-4)
    assert abs(traction) < 0.03  # c is found to 2e-3, which is this much traction in the slenderest of these
    assert all(grid(float(c[0]) + step)[0] > power for step in (-0.02, 0.02))


def test_the_table_is_the_integral() -> None:
    """Over all shares of spin and ellipses from the circle to the slenderest, ends included."""
    rng = np.random.default_rng(5)
    share = np.concatenate([[0.0, 1.0, 0.5], rng.uniform(0.0, 1.0, 400)])
    ratio = np.concatenate([[1.0, 1.0, 0.002], np.exp(rng.uniform(np.log(0.002), 0.0, 400))])
    exact, _ = mean_sliding_speed(1.0 - share, share, ratio, 12)
    table = sliding_table()
    found = [
        tabulated_sliding_speed(table, 1.0 - each, each, *place_of_ellipse(axes))
        for each, axes in zip(share, ratio, strict=True)
    ]
    assert found == pytest.approx(exact, rel=6e-5)


def test_a_bearing_s_sliding_is_the_integral() -> None:
    """What the pass makes of the table, against the integral of each contact's own rolling and spin, of either sign."""
    speeds = {"speed": np.array([900.0, -900.0, 0.0]), "outer_speed": np.array([0.0, 300.0, 700.0])}
    five = {"axial_load": 9e3, "radial_load_y": 4e3, "radial_load_z": 1e3, "moment_y": 20.0, "moment_z": -40.0}
    for angle in qs.HertzAngle:
        scene = qs.Scene(B218, qs.Operation(**speeds, **five), BOTH, qs.RacewayControl.OUTER, hertz_angle=angle)  # type: ignore[arg-type]
        solution = solved(scene)
        found, motion = qs.readings.friction(solution, 0.05), qs.readings.kinematics(solution)
        R = deformed_radius(np.array(22.225e-3), np.array(11.6281e-3))
        for raceway, contacts, moving in (
            (found.inner, solution.inner, motion.inner),
            (found.outer, solution.outer, motion.outer),
        ):
            a, b = contacts.semi_major_axis, contacts.semi_minor_axis
            exact, _ = mean_sliding_speed(moving.rolling_speed * a**2 / (2 * R), moving.spin_speed * a, b / a)
            assert raceway.sliding_power == pytest.approx(0.05 * contacts.load * exact, rel=1e-4)


def test_contacts_without_load_have_no_number() -> None:
    mean, c = mean_sliding_speed(np.array([1.0, np.nan]), np.ones(2), np.full(2, 0.1))
    assert np.isnan(mean).tolist() == np.isnan(c).tolist() == [False, True]


# -------------------------------------------------------------------------------------------------------------- bearing


def test_power_of_a_thrust_bearing() -> None:
    """Under outer control the inner contact spins: its power lies a little above mu Q 3 a E/8 times the spin."""
    solution = solved(turning(10e3, axial_load=17.8e3))
    found = qs.readings.friction(solution, 0.06)
    motion = qs.readings.kinematics(solution)
    assert motion.inner.spin_speed is not None
    alone = found.inner.spin_moment * np.abs(motion.inner.spin_speed)
    assert (found.inner.sliding_power > alone).all()
    assert (found.inner.sliding_power < 1.1 * alone).all()
    k2 = (solution.inner.semi_minor_axis / solution.inner.semi_major_axis) ** 2
    by_hand = 0.375 * 0.06 * solution.inner.load * solution.inner.semi_major_axis * ellipe(1 - k2)
    assert found.inner.spin_moment == pytest.approx(by_hand)
    assert (found.outer.sliding_power < 0.2 * found.inner.sliding_power).all()
    assert found.power == pytest.approx(16 * (found.inner.power[0] + found.outer.power[0]))
    assert found.torque == pytest.approx(found.power / (10e3 * qs.rpm))
    assert any("gyroscopic" in sentence for sentence in found.warnings)


def test_friction_is_in_proportion_to_its_coefficients() -> None:
    solution = solved(turning(8e3, SPINDLE, axial_load=800.0, radial_load_y=100.0, moment_z=0.0))
    one = qs.readings.friction(solution, 0.05)
    two = qs.readings.friction(solution, 0.1, hysteresis_loss=0.02, drag_coefficient=0.5, fluid_density=20.0)
    assert two.inner.sliding_power == pytest.approx(2 * one.inner.sliding_power)
    assert one.inner.hysteresis_power is None
    assert one.drag_power is None
    empty = qs.readings.friction(solution, 0.05, drag_coefficient=0.5, fluid_density=0.0)
    assert empty.power == pytest.approx(one.power, rel=1e-12)
    assert two.inner.hysteresis_power is not None
    assert two.outer.hysteresis_power is not None
    assert two.drag_power is not None
    roll = qs.readings.kinematics(solution).inner.rolling_speed
    assert roll is not None
    work = solution.inner.load * solution.inner.semi_minor_axis * np.abs(roll)
    assert two.inner.hysteresis_power == pytest.approx(0.02 * 3 / 16 * work)
    parts = 2 * one.power + (two.inner.hysteresis_power + two.outer.hysteresis_power + two.drag_power).sum()
    assert two.power == pytest.approx(parts)
    speed = qs.readings.kinematics(solution).orbital_speed * 89.5e-3 / 2
    assert two.drag_power == pytest.approx(0.5 * 0.5 * 20.0 * np.pi * 12.7e-3**2 / 4 * speed**3)


def test_differential_sliding_of_a_radial_bearing() -> None:
    """At zero contact angle nothing spins: t = roll a^2/(2 R) of the pressed curvature, times Heathcote's mean."""
    scene = turning(
        1000, DEEP_GROOVE, effects=CENTRIFUGAL, axial_displacement=0.0, radial_load_y=2e3, tilt_y=0.0, tilt_z=0.0
    )
    solution = solved(scene)
    found, motion = qs.readings.friction(solution, 0.1), qs.readings.kinematics(solution)
    R = deformed_radius(np.array(11.5e-3), np.array(0.52 * 11.5e-3))
    assert pytest.approx(2 / (2 / 11.5e-3 + 1 / (0.52 * 11.5e-3))) == R
    assert motion.inner.rolling_speed is not None
    t = abs(motion.inner.rolling_speed[0]) * solution.inner.semi_major_axis[0] ** 2 / (2 * R)
    assert found.inner.sliding_power[0] == pytest.approx(0.1 * solution.inner.load[0] * t * 0.161142, rel=1e-4)
    assert found.inner.sliding_power[3] == 0.0  # a ball that the load has left


def test_bad_input_of_friction() -> None:
    with pytest.raises(qs.SceneError) as caught:
        qs.readings.friction(solved(resting(B218, axial_load=1e3)), 2.0, fluid_density=20.0)
    assert {error.field for error in caught.value.errors} == {"friction_coefficient", "drag_coefficient"}


def test_friction_without_raceway_control_says_what_it_assumes() -> None:
    """The same as outer control where nothing throws the balls outward."""
    scene = resting(SPINDLE, axial_load=800.0, speed=1.0)
    assumed = qs.readings.friction(solved(scene), 0.05)
    named = replace(scene, ball_effects=CENTRIFUGAL, raceway_control=qs.RacewayControl.OUTER)
    assert assumed.power == pytest.approx(qs.readings.friction(solved(named), 0.05).power, rel=1e-5)
    assert any("raceway control" in sentence for sentence in assumed.warnings)


def test_at_rest_and_unsolved() -> None:
    found = qs.readings.friction(qs.solve(turning(np.array([0.0, 3e3]), axial_load=np.array([5e3, -5e3]))), 0.05)
    assert found.power[0] == 0.0
    assert np.isnan(found.torque).all()
    assert np.isnan(found.power[1])


# ------------------------------------------------------------------------------------------------------------ estimates


def test_factors_of_skf_s_worked_example() -> None:
    """22208 E, 40 x 80 mm, 3500 rpm, 68 mm^2/s, KZ 5.5: phi_rs 0.7988; Mrr of Grr 0.26 is 437 N mm."""
    starved = friction_estimate.replenishment_factor(np.array(68.0), np.array(3500.0), 40.0, 80.0, 5.5, 3e-8)
    assert starved == pytest.approx(0.7988, abs=5e-5)
    assert pytest.approx(437, abs=1.0) == 0.26 * (68.0 * 3500.0) ** 0.6


def test_estimates_of_a_7210() -> None:
    """By hand, from the formulas as printed, in N, mm, rpm, mm^2/s."""
    b = qs.load_scene("7210c").bearing
    solution = solved(turning(6000, b, axial_load=1500.0, radial_load_y=500.0, moment_z=0.0))
    size = {"bore_diameter": 50e-3, "outside_diameter": 90e-3, "kinematic_viscosity": 20e-6}
    skf = qs.readings.skf_torque(solution, **size)
    dm, n, nu = 70.0, 6000.0, 20.0
    Grr = 5.03e-7 * dm**1.97 * (500 + 1.90e-12 * dm**4 * n**2 + 1.97 * 1500) ** 0.54
    Gsl = 1.30e-2 * dm**0.26 * ((500 + 1.91e-12 * dm**4 * n**2) ** (4 / 3) + 0.68 * 1500 ** (4 / 3))
    ish = 1 / (1 + 1.84e-9 * (n * dm) ** 1.28 * nu**0.64)
    rs = np.exp(-3e-8 * nu * n * 140 * np.sqrt(4.4 / 80))
    bl = np.exp(-2.6e-8 * (n * nu) ** 1.4 * dm)
    M = ish * rs * Grr * (nu * n) ** 0.6 + (bl * 0.15 + (1 - bl) * 0.05) * Gsl
    assert skf.torque * 1e3 == pytest.approx(M, rel=1e-6)
    assert skf.power == pytest.approx(1.05e-4 * M * n, rel=3e-3)  # as the catalogue writes it
    palmgren = qs.readings.palmgren_torque(solution, **size, static_load_rating=37e3, lubrication_factor=2.0)
    P0 = max(0.5 * 500 + 0.46 * 1500, 500)
    M = 2.0 * (nu * n) ** (2 / 3) * dm**3 * 1e-7 + 0.001 * (P0 / 37e3) ** 0.33 * (1500 - 50) * dm
    assert palmgren.torque * 1e3 == pytest.approx(M, rel=1e-6)
    assert palmgren.power == pytest.approx(M * n / 9550, rel=1e-3)


def test_palmgren_s_estimate_of_slow_bearings() -> None:
    """By hand below nu n = 2000: 160e-7 f0 dM^3, whatever the speed. Palmgren's two formulas meet there to the rounding
    of his 160, which stands for 2000^(2/3) = 158.74: 0.8 % of that part."""
    b, size = qs.load_scene("7210c").bearing, {"bore_diameter": 50e-3, "outside_diameter": 90e-3}
    solution = solved(turning(np.array([0.0, 1.0, 99.999, 100.001]), b, axial_load=1500.0))
    of = {"kinematic_viscosity": 20e-6, "static_load_rating": 37e3}
    one, two = (qs.readings.palmgren_torque(solution, **size, **of, lubrication_factor=f0) for f0 in (1.0, 2.0))
    speed_part = (two.torque - one.torque) * 1e3
    assert speed_part[:3] == pytest.approx(160e-7 * 70.0**3, rel=1e-9)
    assert speed_part[3] == pytest.approx(speed_part[2], rel=1 - 2000 ** (2 / 3) / 160 + 1e-5)
    assert two.torque[0] > 0.0
    assert two.power[0] == 0.0


def test_what_each_friction_model_contains_is_said_alike_everywhere() -> None:
    """Python, JSON and text: the words of one place; range and use, and whether the range holds."""
    solution = solved(scene_with_friction())
    found = qs.readings.take_asked(solution)
    shown = " ".join(text_of(result(solution, found)).split())
    names = {"friction": ["Contacts"], "friction_estimate": ["SKF", "Palmgren"]}
    for reading, models in names.items():
        assert [model.name for model in found[reading].models] == models
        assert record(solution, found)["readings"][reading]["models"] == [
            model._asdict() for model in found[reading].models
        ]
        for model in found[reading].models:
            for words in model:
                assert " ".join(words.split()) in shown
    estimates = found["friction_estimate"]
    assert "no range of n dm is published" in estimates.skf.model.range
    assert "no range of n dm is published" in estimates.palmgren.model.range
    assert "lower bound" in found["friction"].models[0].heat
    assert estimates.speed_factor / (qs.mm * qs.rpm) == pytest.approx(70.0 * 6000.0)


def test_skf_s_estimate_is_warned_of_above_the_speed_rating() -> None:
    """Or where that is not known."""
    size = {"bore_diameter": 50e-3, "outside_diameter": 90e-3, "kinematic_viscosity": 20e-6}
    b = qs.load_scene("7210c").bearing
    solution = solved(turning(np.array([6e3, 24e3]), b, axial_load=1500.0))
    assert "not given" in qs.readings.skf_torque(solution, **size).warnings[0]
    (above,) = qs.readings.skf_torque(solution, **size, speed_rating=19e3 * qs.rpm).warnings
    assert above.startswith("1 of 2 cases, the first 1: ")
    both = qs.readings.friction_estimates(solution, **size, speed_rating=19e3 * qs.rpm)
    assert both.warnings == (above,)
    assert both.speed_over_rating == pytest.approx([6 / 19, 24 / 19])
    assert qs.readings.skf_torque(solution, **size, speed_rating=25e3 * qs.rpm).warnings == ()
    with pytest.raises(qs.SceneError) as caught:
        qs.readings.skf_torque(solution, **size, speed_rating=-1.0)
    assert [error.field for error in caught.value.errors] == ["speed_rating"]


def test_palmgren_s_estimate_of_a_thrust_bearing() -> None:
    """By hand: f1 = 0.0012 (Fa/C0)^0.33, P1 = Fa."""
    steep = replace(B218, free_contact_angle=60 * qs.deg)
    size = {"bore_diameter": 90e-3, "outside_diameter": 160e-3, "kinematic_viscosity": 20e-6}
    solution = solved(resting(steep, axial_load=9e3, speed=3000 * qs.rpm))
    found = qs.readings.palmgren_torque(solution, **size, static_load_rating=400e3, lubrication_factor=2.0)
    M = 2.0 * (20.0 * 3000) ** (2 / 3) * 125.0**3 * 1e-7 + 0.0012 * (9e3 / 400e3) ** 0.33 * 9e3 * 125.0
    assert found.torque * 1e3 == pytest.approx(M, rel=1e-9)


def test_estimate_of_a_deep_groove_bearing() -> None:
    """Thrust adds to the torque. At the least thrust SKF's own exponents change, and the torque by 14 %."""
    size = {"bore_diameter": 25e-3, "outside_diameter": 62e-3, "kinematic_viscosity": 20e-6}
    load = np.array([0.0, 1.0, 500.0])
    scene = resting(DEEP_GROOVE, axial_load=load, radial_load_y=1e3, speed=314.0, tilt_y=0.0, tilt_z=0.0)
    found = qs.readings.skf_torque(solved(scene), **size, series="63", static_load_rating=11.6e3)  # type: ignore[arg-type]
    assert found.torque[2] > found.torque[1] > 0.0
    assert found.torque[1] == pytest.approx(1.14 * found.torque[0], rel=0.01)
    with pytest.raises(qs.SceneError) as caught:
        qs.readings.skf_torque(solved(scene), **size)
    assert {error.field for error in caught.value.errors} == {"series", "static_load_rating"}
