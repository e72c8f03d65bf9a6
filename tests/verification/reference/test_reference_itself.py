"""Checks that the reference is right on its own: against published and twice-computed numbers, against vector
mechanics in three dimensions, against direct integrals of the Hertz pressure, and against itself."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from mpmath import mp

from . import jones_harris as jh
from .generate import load_reference
from .published import CONTACTS, THRUST_TABLE, printed
from .scenes import B218, SCENES, at_rest, hold, load, turning

REFERENCE = {entry["case"]["name"]: entry for entry in load_reference()}
DIGITS = 20  # enough for the live solutions of this file


def angle_deg(ball: dict[str, Any], race: str) -> float:
    return math.degrees(float(ball[race]["angle"]))


def one_ball_of(
    axial_load: float, rpm: str, bearing: dict[str, Any] = B218, hertz_angle: str = "actual"
) -> dict[str, Any]:
    """A bearing under pure thrust, solved as one of its balls with all other channels held."""
    share = str(mp.mpf(axial_load) / bearing["ball_count"])
    channels = hold(load(share), y="0", z="0", tilt_y="0", tilt_z="0")
    single = bearing | {"ball_count": 1}
    if rpm == "0":
        return jh.solve(at_rest("one ball", "", single, channels, hertz_angle), DIGITS)
    return jh.solve(turning("one ball", "", single, channels, rpm, hertz_angle=hertz_angle), DIGITS)


def test_the_stored_cases_are_the_scenes() -> None:
    assert [entry["case"] for entry in load_reference()] == SCENES


# ------------------------------------------------------------------------------------------------ known numbers


@pytest.mark.parametrize(
    "row", [pytest.param(row, id=f"{row[0]} N, {row[1]} rpm", marks=pytest.mark.heavy) for row in THRUST_TABLE]
)
def test_thrust_table(row: tuple) -> None:
    axial_load, rpm, alpha_i, alpha_o, Qi, Qo, displacement, stiffness = row
    result = one_ball_of(axial_load, str(rpm))
    ball = result["balls"][0]
    assert angle_deg(ball, "inner") == printed(alpha_i)
    assert angle_deg(ball, "outer") == printed(alpha_o)
    assert float(ball["inner"]["load"]) == printed(Qi)
    assert float(ball["outer"]["load"]) == printed(Qo)
    assert float(result["displacement"][0]) * 1e6 == printed(displacement)
    if stiffness is not None:
        assert float(result["stiffness"][0][0]) * 16e-6 == printed(stiffness)


def test_thrust_at_the_free_angle() -> None:
    result = REFERENCE["b218_thrust_10000"]["result"]
    ball = result["balls"][5]
    assert angle_deg(ball, "inner") == pytest.approx(49.941413, abs=0.51e-6)
    assert angle_deg(ball, "outer") == pytest.approx(31.336597, abs=0.51e-6)
    assert float(ball["inner"]["load"]) == pytest.approx(1453.513, abs=0.51e-3)
    assert float(ball["outer"]["load"]) == pytest.approx(1921.556, abs=0.51e-3)
    assert float(result["displacement"][0]) * 1e6 == pytest.approx(14.7578, abs=0.51e-4)
    assert float(result["inner_stiffness"]) == pytest.approx(4.1097262e10, abs=0.51e3)
    assert float(result["outer_stiffness"]) == pytest.approx(4.2748637e10, abs=0.51e3)


def test_a_full_bearing_is_its_balls() -> None:
    single = one_ball_of(17800, "10000", hertz_angle="free")
    stored = REFERENCE["b218_thrust_10000"]["result"]
    assert mp.mpf(single["displacement"][0]) == pytest.approx(mp.mpf(stored["displacement"][0]), rel=1e-16)


def test_iso_ts_16281_example_without_clearance() -> None:
    """A commercial program's radial and axial values; the tilt is that of the lever Ri."""
    radial = REFERENCE["deep_groove_radial"]["result"]["displacement"][1]
    thrust = REFERENCE["deep_groove_thrust"]["result"]["displacement"][0]
    tilt = REFERENCE["deep_groove_moment_alone"]["result"]["displacement"][4]
    assert float(radial) * 1e6 == pytest.approx(15.1101, rel=1e-5)
    assert float(thrust) * 1e6 == pytest.approx(133.5381, rel=1e-5)
    assert -float(tilt) * 1e3 == pytest.approx(3.6468, abs=0.51e-4)


def test_the_wrong_sign_reverses_the_gyroscopic_effect(monkeypatch: pytest.MonkeyPatch) -> None:
    right = jh.gyroscopic_moment
    without = REFERENCE["b218_thrust_centrifugal_only"]["result"]["balls"][0]
    assert angle_deg(without, "inner") == pytest.approx(47.76, abs=0.0051)
    assert angle_deg(without, "outer") == pytest.approx(34.42, abs=0.0051)
    monkeypatch.setattr(jh, "gyroscopic_moment", lambda *arguments: -right(*arguments))
    wrong = one_ball_of(17800, "10000")["balls"][0]
    assert angle_deg(wrong, "inner") == pytest.approx(45.39, abs=0.0051)
    assert angle_deg(wrong, "outer") == pytest.approx(37.41, abs=0.0051)


# ------------------------------------------------------------------------------------------------ the Hertz contact


@pytest.mark.parametrize("row", CONTACTS)
def test_contact_table(row: tuple) -> None:
    side, Rx, Ry, k, Q, a, b, p0, approach = row
    scene = jh.read_case(SCENES[0])
    contact = (jh.inner_contact if side < 0 else jh.outer_contact)(scene, scene.cos0)
    assert float(contact.curvature_sum) == pytest.approx(1e3 / float(Rx) + 1e3 / float(Ry), rel=1e-7)
    assert float(contact.ellipticity) == printed(k)
    assert float(contact.semi_major_axis(Q)) * 1e3 == printed(a)
    assert float(contact.semi_minor_axis(Q)) * 1e3 == printed(b)
    assert float(contact.max_pressure(Q)) * 1e-6 == printed(p0)
    assert float((Q / contact.stiffness) ** (mp.mpf(2) / 3)) * 1e6 == printed(approach)


@pytest.mark.parametrize("ratio", ["1", "26.1", "1e3"])
def test_hertz_by_direct_integration_of_the_pressure(ratio: str) -> None:
    """The half-ellipsoid of pressure presses two half-spaces into the approach and the two relative curvatures.

    Chords through a point of the ellipse integrate p = p0 sqrt(1 - x^2/a^2 - y^2/b^2) in closed form, which leaves one
    integral over their direction; no elliptic integral enters.
    """
    with mp.workdps(30):
        Rx, Ry, Q, modulus = mp.mpf("0.01"), mp.mpf("0.01") * mp.mpf(ratio), mp.mpf(1000), mp.mpf("2e11")
        k, first, second = jh.solve_ellipticity(Ry / Rx)
        contact = jh.HertzContact(k, first, second, 1 / Rx + 1 / Ry, modulus)
        a, b, p0 = contact.semi_major_axis(Q), contact.semi_minor_axis(Q), contact.max_pressure(Q)

        def integral(of: Any) -> Any:
            """Over a half-turn of directions; A is the inverse square of the ellipse's radius in the direction."""
            return 2 * mp.quad(
                lambda t: of(mp.cos(t), mp.sin(t), (mp.cos(t) / a) ** 2 + (mp.sin(t) / b) ** 2),
                [0, b / a / 4, b / a, mp.sqrt(b / a) / 2 + b / a / 2, 1 + b / a / 5, mp.pi / 2],
            )

        approach = p0 / modulus * integral(lambda c, s, A: 1 / mp.sqrt(A))
        curvature_x = 2 * p0 / modulus / (a * b) ** 2 * integral(lambda c, s, A: c**2 / A**1.5)  # across b
        curvature_y = 2 * p0 / modulus / (a * b) ** 2 * integral(lambda c, s, A: s**2 / A**1.5)  # along a
        assert mp.almosteq(approach, (Q / contact.stiffness) ** (mp.mpf(2) / 3), rel_eps=1e-12)
        assert mp.almosteq(curvature_x, 1 / Rx, rel_eps=1e-12)
        assert mp.almosteq(curvature_y, 1 / Ry, rel_eps=1e-12)


@pytest.mark.parametrize("ratio", ["1.01", "26.1"])
def test_the_printed_ellipticity_equation(ratio: str) -> None:
    with mp.workdps(50):
        ratio_ = mp.mpf(ratio)
        k, first, second = jh.solve_ellipticity(ratio_)
        left = ((k**2 + 1) * second - 2 * first) / ((k**2 - 1) * second)
        assert mp.almosteq(left, (ratio_ - 1) / (ratio_ + 1), rel_eps=mp.mpf("1e-42"))


# ------------------------------------------------------------------------------------------------ vector mechanics


def random_motion(rng: np.random.Generator) -> tuple:
    """Angles, speeds, and a control: what the kinematics need, as floats."""
    alpha_i, alpha_o = rng.uniform(-0.6, 1.2, 2)
    wi, wo = rng.uniform(-1000, 1000, 2)
    return alpha_i, alpha_o, wi, wo, rng.uniform(0.05, 0.25), rng.choice(["outer", "inner"])


@pytest.mark.parametrize("seed", range(10))
def test_kinematics_against_cross_products(seed: int) -> None:
    """Velocities of both surfaces at both contact points, and the spin at the controlling one, in three dimensions."""
    alpha_i, alpha_o, wi, wo, g, control = random_motion(np.random.default_rng(seed))
    D, dm = g, 1.0
    inner, outer = (math.sin(alpha_i), math.cos(alpha_i)), (math.sin(alpha_o), math.cos(alpha_o))
    tan_beta = jh.attitude_tangent(control, inner, outer, g)
    wm, wR = jh.ball_speeds(wi, wo, inner, outer, tan_beta, g)

    psi = 0.7
    e_x, e_r = np.array([1.0, 0, 0]), np.array([0, math.cos(psi), math.sin(psi)])
    t = np.cross(e_x, e_r)
    beta = math.atan(tan_beta)
    centre = dm / 2 * e_r
    ball_rate = wm * e_x + wR * (math.cos(beta) * e_x - math.sin(beta) * e_r)  # absolute angular velocity
    n_o = outer[0] * e_x + outer[1] * e_r
    n_i = inner[0] * e_x + inner[1] * e_r
    for point, ring in ((centre + D / 2 * n_o, wo), (centre - D / 2 * n_i, wi)):
        ball_velocity = np.cross(wm * e_x, centre) + np.cross(ball_rate, point - centre)
        ring_velocity = np.cross(ring * e_x, point)
        assert ball_velocity == pytest.approx(ring_velocity, abs=1e-10 * (abs(wi) + abs(wo)))
    normal, ring = (n_o, wo) if control == "outer" else (n_i, wi)
    assert (ball_rate - ring * e_x) @ normal == pytest.approx(0, abs=1e-10 * (abs(wi) + abs(wo)))

    # the rate of change of angular momentum, from the spin's own change of direction, is -Mg t with J = 1
    change = np.cross(wm * e_x, ball_rate)
    assert change == pytest.approx(-wR * wm * math.sin(beta) * t, abs=1e-9 * (abs(wi) + abs(wo)) ** 2)


@pytest.mark.parametrize("seed", range(5))
def test_kinematics_reduce_to_the_printed_ones(seed: int) -> None:
    alpha_i, alpha_o, w, _, g, control = random_motion(np.random.default_rng(seed))
    inner, outer = (math.sin(alpha_i), math.cos(alpha_i)), (math.sin(alpha_o), math.cos(alpha_o))
    tan_beta = jh.attitude_tangent(control, inner, outer, g)
    wm, wR = jh.ball_speeds(w, 0.0, inner, outer, tan_beta, g)
    across_i, across_o = inner[1] + tan_beta * inner[0], outer[1] + tan_beta * outer[0]
    gi, go = 1 - g * inner[1], 1 + g * outer[1]
    assert wm / w == pytest.approx(1 / (1 + go * across_i / (gi * across_o)), rel=1e-12)
    cos_beta = math.cos(math.atan(tan_beta))
    assert wR / w == pytest.approx(-1 / ((across_o / go + across_i / gi) * g * cos_beta), rel=1e-12)
    between = math.cos(alpha_i - alpha_o)
    closed = (1 - g * inner[1]) if control == "outer" else (between - g * outer[1])
    assert wm / w == pytest.approx(closed / (1 + between), rel=1e-12)
    # both rings turned together by 100 rad/s: everything goes round, nothing rolls differently
    assert jh.ball_speeds(w + 100.0, 100.0, inner, outer, tan_beta, g) == pytest.approx((wm + 100, wR), rel=1e-9)


@pytest.mark.parametrize("name", [name for name, entry in REFERENCE.items() if entry["case"]["gyroscopic_moment"]])
def test_forces_at_the_contact_points_balance_in_three_dimensions(name: str) -> None:
    """All contact forces as vectors at the points where they act: each ball's motion and the ring's five loads."""
    case, result = REFERENCE[name]["case"], REFERENCE[name]["result"]
    nominal, dm, ri = (float(case[key]) for key in ("ball_diameter", "pitch_diameter", "inner_groove_radius"))
    free = math.radians(float(case["free_contact_angle_deg"]))
    deviations = map(float, case.get("ball_diameter_deviations", [0.0] * len(result["balls"])))
    force, moment = np.zeros(3), np.zeros(3)
    size = max(float(ball["outer"]["load"]) for ball in result["balls"])
    for ball, deviation in zip(result["balls"], deviations, strict=True):
        D = nominal + deviation
        mass = float(case["ball_material"]["density"]) * math.pi * D**3 / 6
        psi, Mg = float(ball["azimuth"]), float(ball["gyroscopic_moment"])
        wm, wR = float(ball["orbital_speed"]), float(ball["rotation_speed"])
        e_x, e_r = np.array([1.0, 0, 0]), np.array([0, math.cos(psi), math.sin(psi)])
        t = np.cross(e_x, e_r)
        if ball["control"] == "minimum_dissipation":  # each contact's share, from the coefficient that it asks for
            share_i = float(ball["inner"]["required_friction"] or 0) * float(ball["inner"]["load"]) * D / abs(Mg or 1)
        else:
            share_i = {"outer": 0, "inner": 2 if case["shares"] == "controlling" else 1}[ball["control"]]
        orbit = dm / 2
        if case.get("orbit_radius") == "displaced":
            orbit += float(ball["position"][1]) - (float(case["outer_groove_radius"]) - nominal / 2) * math.cos(free)
        pulls, sticks = {}, True
        for race, sense, share in (("inner", 1, share_i), ("outer", -1, 2 - share_i)):
            alpha = float(ball[race]["angle"])
            normal = math.sin(alpha) * e_x + math.cos(alpha) * e_r
            friction = math.cos(alpha) * e_x - math.sin(alpha) * e_r
            load, carried = float(ball[race]["load"]), share * Mg / D
            if abs(carried) > float(case.get("friction_coefficient", math.inf)) * load:
                carried, sticks = math.copysign(float(case["friction_coefficient"]) * load, Mg), False
            pulls[race] = (sense * (load * normal - carried * friction), normal)
        (pull_i, n_i), (pull_o, n_o) = pulls["inner"], pulls["outer"]
        assert pull_i + pull_o == pytest.approx(-mass * orbit * wm**2 * e_r, abs=1e-12 * size)
        sin_beta = Mg / (mass * D**2 / 10 * wR * wm)
        momentum_rate = np.cross(wm * e_x, mass * D**2 / 10 * wR * (math.sqrt(1 - sin_beta**2) * e_x - sin_beta * e_r))
        torque = np.cross(-D / 2 * n_i, pull_i) + np.cross(D / 2 * n_o, pull_o)
        if sticks:
            assert torque == pytest.approx(momentum_rate, abs=1e-12 * size * D)
        else:
            assert 0 < torque @ momentum_rate < momentum_rate @ momentum_rate
        force += pull_i
        groove_centre = (dm / 2 + (ri - nominal / 2) * math.cos(free)) * e_r  # in the ring's mid-plane
        moment += np.cross(groove_centre - ri * n_i, pull_i)
        assert t @ pull_i == pytest.approx(0, abs=1e-12 * size)
    found = [*force, moment[1], moment[2]]
    assert found == pytest.approx([float(value) for value in result["load"]], abs=1e-11 * size)


# ------------------------------------------------------------------------------------------------ the stored results


@pytest.mark.parametrize("name", REFERENCE)
def test_stored_results_satisfy_the_equations(name: str) -> None:
    case, result = REFERENCE[name]["case"], REFERENCE[name]["result"]
    assert mp.mpf(result["residual"]) < mp.mpf("1e-40")
    with mp.workdps(40):
        scene = jh.read_case(case | {"ball_control": [ball["control"] for ball in result["balls"]]})
        d = [mp.mpf(value) for value in result["displacement"]]
        balls = {}
        for j, ball in enumerate(result["balls"]):
            if ball["position"] is None:
                assert not scene.turns
                assert mp.hypot(*jh.groove_centre(scene, j, d)) <= scene.Li + scene.Lo
            else:
                x = [*ball["position"], ball["inner"]["approach"], ball["outer"]["approach"]]
                balls[j] = [mp.mpf(value) for value in x]
        assert jh.relative_residual(scene, balls, d) < mp.mpf("1e-20")
        for c, (kind, value) in enumerate(case["channels"][channel] for channel in jh.CHANNELS):
            prescribed = result["load" if kind == "load" else "displacement"][c]
            assert abs(mp.mpf(prescribed) - mp.mpf(value)) <= mp.mpf("1e-22") * abs(mp.mpf(value))


@pytest.mark.parametrize("name", [name for name, entry in REFERENCE.items() if entry["case"]["control"] == "per_ball"])
def test_stored_choices_are_jones_s(name: str) -> None:
    balls = REFERENCE[name]["result"]["balls"]
    for ball in balls:
        assert ball["control"] == ("outer" if mp.mpf(ball["control_ratio"]) > 1 else "inner")
        assert abs(mp.mpf(ball["control_ratio"]) - 1) > mp.mpf("5e-4")  # far enough from the fence to be reproduced
    if "mixed" in name:
        assert {ball["control"] for ball in balls} == {"outer", "inner"}


@pytest.mark.parametrize("name", ["b218_unloading_at_rest", "deep_groove_moment_alone", "b218_thrust_at_rest"])
def test_stiffness_at_rest_is_symmetric(name: str) -> None:
    with mp.workdps(40):
        stiffness = [[mp.mpf(value) for value in row] for row in REFERENCE[name]["result"]["stiffness"]]
        for i in range(5):
            for j in range(i):
                size = mp.sqrt(stiffness[i][i] * stiffness[j][j])
                assert abs(stiffness[i][j] - stiffness[j][i]) <= mp.mpf("1e-22") * size


def test_stiffness_is_the_change_of_load() -> None:
    """All displacements held and moved a little along a slanted line: the loads change by the stiffness times it."""
    entry = REFERENCE["b218_all_held"]
    with mp.workdps(30):
        direction = [mp.mpf(value) for value in ("1e-14", "-2e-14", "1e-14", "1e-13", "3e-13")]
        d = [mp.mpf(value) for value in entry["result"]["displacement"]]
        moved = {name: ["displacement", str(d[c] + direction[c])] for c, name in enumerate(jh.CHANNELS)}
        there = jh.solve(entry["case"] | {"channels": moved}, 30)["load"]
        for c, row in enumerate(entry["result"]["stiffness"]):
            change = mp.mpf(there[c]) - mp.mpf(entry["result"]["load"][c])
            expected = mp.fdot([mp.mpf(value) for value in row], direction)
            assert abs(change - expected) < mp.mpf("1e-6") * abs(expected)


@pytest.mark.parametrize(
    "name", ["b218_five_channels", *(pytest.param(name, marks=pytest.mark.heavy) for name in REFERENCE)]
)
def test_a_live_solution_is_the_stored_one(name: str) -> None:
    entry = REFERENCE[name]
    live = jh.solve(entry["case"], 30)
    with mp.workdps(40):
        for found, stored in zip(live["displacement"], entry["result"]["displacement"], strict=True):
            assert abs(mp.mpf(found) - mp.mpf(stored)) <= mp.mpf("1e-22") * abs(mp.mpf(stored))


def test_the_choice_of_control_may_be_given_but_must_be_jones_s() -> None:
    entry = REFERENCE["b218_per_ball_control_mixed_harris"]
    scene = jh.read_case(entry["case"])
    assert set(scene.control) == {"outer"}  # the first guess, not the answer
    with pytest.raises(ArithmeticError, match="Jones"):
        jh.solve(entry["case"] | {"ball_control": ["inner"] * 16}, DIGITS)


def test_a_speed_at_which_no_choice_is_jones_s() -> None:
    """B218 under 17.8 kN at 2084 rpm: outer control calls for inner and inner for outer."""
    channels = hold(load("1112.5"), y="0", z="0", tilt_y="0", tilt_z="0")
    case = turning("between", "", B218 | {"ball_count": 1}, channels, "2084", control="per_ball")
    with pytest.raises(ArithmeticError, match="no choice"):
        jh.solve(case, DIGITS)


def test_inner_control_with_its_own_share_has_no_equilibrium_at_light_load() -> None:
    """B218 under 2 kN: near 9340 rpm the inner race, which must carry all the friction, loses its load."""
    channels = hold(load("125"), y="0", z="0", tilt_y="0", tilt_z="0")
    case = turning("light", "", B218 | {"ball_count": 1}, channels, "9200", control="inner")
    ball = jh.solve(case, DIGITS)["balls"][0]
    assert float(ball["inner"]["load"]) == pytest.approx(4.479, abs=0.51e-3)
    assert float(ball["inner"]["required_friction"]) > 40
    with pytest.raises(ArithmeticError):
        jh.solve(case | {"inner_speed_rpm": "10000"}, DIGITS)
