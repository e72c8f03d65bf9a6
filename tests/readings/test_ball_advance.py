"""Balls against their cage: closed forms, properties, a published case, and what is said of too small pockets."""

from __future__ import annotations

import tomllib
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

import qsbearing as qs
from qsbearing import pictures
from qsbearing.files.scene_file import scene_of
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.readings.ball_advance import advance_over_a_turn
from qsbearing.remarks.balls import LARGE_GAP
from tests.guide.pages import GUIDE, blocks
from tests.model.solution.test_friction_motion import bearing
from tests.qsbearing.scenes import B218, BOTH_HARRIS, CENTRIFUGAL, INNER, UPRIGHT, solved, turning

TURN = 2.0 * np.pi * np.arange(360) / 360
POCKET = next(each.text for each in blocks(GUIDE / "cage_and_grease.md") if each.language == "toml")
COMBINED = turning(9e3, axial_load=14e3, radial_load_y=6e3, tilt_z=0.0)


def test_a_speed_with_one_wave_has_keplers_closed_form() -> None:
    """omega = m (1 + e cos psi): mean m sqrt(1 - e^2); the mean anomaly is M = E - k sin E, k = e/... of psi."""
    mean, wave = 700.0, 0.19
    psi = 2.0 * np.pi * np.arange(24) / 24
    found, along, own = advance_over_a_turn(mean * (1.0 + wave * np.cos(psi)), TURN)
    root = np.sqrt(1.0 - wave**2)
    assert found == pytest.approx(mean * root, rel=1e-12)
    # the integral of dpsi/(1 + e cos psi) is 2/root atan(sqrt((1 - e)/(1 + e)) tan(psi/2))
    half = 2.0 * np.arctan2(np.sqrt(1.0 - wave) * np.sin(TURN / 2), np.sqrt(1.0 + wave) * np.cos(TURN / 2))
    ahead = TURN - half
    time_mean = np.average(ahead, weights=1.0 / (1.0 + wave * np.cos(TURN)))
    assert along == pytest.approx(ahead - time_mean, abs=1e-11)
    assert own == pytest.approx(along[::15], abs=1e-12)


def test_it_is_the_motion_of_a_ball_over_time() -> None:
    """dpsi/dt = omega(psi), integrated numerically, against a cage that turns evenly."""
    psi = 2.0 * np.pi * np.arange(40) / 40

    def speed(at: np.ndarray) -> np.ndarray:
        return 500.0 + 60.0 * np.cos(at) - 25.0 * np.sin(2 * at) + 10.0 * np.cos(3 * at + 0.4)

    found, along, _ = advance_over_a_turn(speed(psi), TURN)
    period = quad(lambda at: 1.0 / speed(at), 0.0, 2 * np.pi)[0]
    assert found == pytest.approx(2 * np.pi / period, rel=1e-10)
    times = np.linspace(0.0, period, 400, endpoint=False)
    way = solve_ivp(lambda _, at: speed(at), (0.0, period), [0.0], t_eval=times, rtol=1e-11, atol=1e-11).y[0]
    ahead = way - 2 * np.pi / period * times
    ahead -= ahead.mean()  # over time
    assert along.max() == pytest.approx(ahead.max(), rel=1e-3)
    assert -along.min() == pytest.approx(-ahead.min(), rel=1e-3)
    assert along[0] == pytest.approx(ahead[0], rel=1e-7)


def test_more_balls_tell_the_same_course_better() -> None:
    errors = []
    for count in (6, 8, 12, 16):
        psi = 2.0 * np.pi * np.arange(count) / count
        along = advance_over_a_turn(1.0 + 0.3 * np.cos(psi), TURN)[1]
        exact = advance_over_a_turn(1.0 + 0.3 * np.cos(2.0 * np.pi * np.arange(64) / 64), TURN)[1]
        errors.append(np.abs(along - exact).max())
    assert (np.array(errors[1:]) < 0.5 * np.array(errors[:-1])).all()
    assert errors[-1] < 1e-5


def test_pure_thrust_has_no_advance_and_a_mirrored_load_a_mirrored_one() -> None:
    thrust = qs.readings.ball_advance(solved(turning(9e3, axial_load=14e3)))
    assert thrust.excursion == 0.0
    assert not thrust.advance.any()
    assert thrust.mean_orbital_speed == pytest.approx(qs.solve(turning(9e3, axial_load=14e3)).orbital_speed[0])
    there = qs.readings.ball_advance(solved(COMBINED))
    back = qs.readings.ball_advance(
        qs.solve(replace(COMBINED, operation=replace(COMBINED.operation, radial_load_y=-6e3)))
    )
    assert there.lead > 0.0
    assert back.excursion == pytest.approx(there.excursion, rel=1e-8)
    # of balls +psi and -psi one is as far ahead as the other is behind, but for the mean, which is zero by symmetry
    assert there.lead == pytest.approx(there.lag, rel=1e-9)
    assert there.advance == pytest.approx(-np.roll(there.advance[::-1], 1), abs=1e-12)


def test_the_published_bearing_at_120000_rpm() -> None:
    """52,000 to 76,400 rpm are printed, to three digits; materials are not: within 1.5 %, as far as they move it."""
    solution = qs.solve(scene_of(tomllib.loads(POCKET), "pocket.toml"))
    assert np.sort(solution.orbital_speed / qs.rpm)[[0, -1]] == pytest.approx([52_000, 76_400], rel=0.015)
    found = qs.readings.ball_advance(solution, pocket_clearance=0.4 * qs.mm)
    assert 52_000 < found.mean_orbital_speed / qs.rpm < 76_400
    assert found.excursion == pytest.approx(found.lead + found.lag)
    assert found.pocket_use == pytest.approx(found.excursion / (0.4 * qs.mm))
    (said,) = found.warnings
    assert said.remark.code == "balls_press_cage" and said.remark.of.cases is None
    assert not qs.readings.ball_advance(solution, pocket_clearance=50 * qs.mm).warnings
    with pytest.raises(qs.SceneError, match="pocket_clearance"):
        qs.readings.ball_advance(solution, pocket_clearance=-1.0)


def test_many_cases_are_read_one_by_one_and_what_stands_has_no_number() -> None:
    speeds = np.array([0.0, 4e3, 9e3, -9e3]) * qs.rpm
    found = qs.readings.ball_advance(qs.solve(replace(COMBINED, operation=replace(COMBINED.operation, speed=speeds))))
    assert np.isnan(found.excursion[0])
    alone = qs.readings.ball_advance(solved(COMBINED))
    assert found.excursion[2] == pytest.approx(alone.excursion, rel=1e-8)
    assert found.mean_orbital_speed[3] == pytest.approx(-alone.mean_orbital_speed, rel=1e-8)
    balls = qs.BallDiameterDeviations(np.r_[1e-6, np.zeros(15)])
    uneven = replace(COMBINED, ring_effects=(balls,))
    assert np.isnan(qs.readings.ball_advance(qs.solve(uneven)).excursion)


def test_the_picture_shows_balls_and_pockets() -> None:
    scene = scene_of(tomllib.loads(POCKET), "pocket.toml")
    figure = pictures.ball_advance(qs.solve(scene))
    (axes,) = figure.axes
    curve, dots, *_ = axes.lines
    found = qs.readings.ball_advance(qs.solve(scene))
    assert np.ptp(curve.get_ydata()) == pytest.approx(found.excursion / qs.mm)
    assert np.sort(dots.get_ydata()) == pytest.approx(np.sort(found.advance / qs.mm))
    assert "clearance of the pockets" in axes.get_legend_handles_labels()[1]


# The outer ring's share of the radial load ----------------------------------------------------------------------------

SPINDLES = {angle: bearing(20, 11.1125, 90.0, 0.53, 0.52, angle) for angle in (15.0, 25.0)}


@pytest.mark.parametrize(
    ("of", "speed", "axial", "radial", "expected"),
    [
        (B218, 10e3, 17.8e3, 3e3, 2713),
        (B218, 10e3, 17.8e3, 8e3, 7028),
        (B218, 10e3, 8e3, 4e3, 1353),
        (B218, 6e3, 17.8e3, 8e3, 7920),
        (B218, 3e3, 17.8e3, 8e3, 7996),
        (SPINDLES[25.0], 18e3, 600.0, 300.0, 197),
        (SPINDLES[15.0], 18e3, 600.0, 300.0, 274),
    ],
)
def test_what_the_outer_ring_takes(
    of: qs.BallBearing, speed: float, axial: float, radial: float, expected: float
) -> None:
    """Another program's numbers; a remark without the reading, where the gap is large."""
    solution = qs.solve(turning(speed, of, axial_load=axial, radial_load_y=radial, **UPRIGHT))
    found = qs.readings.ball_advance(solution)
    assert found.outer_radial_load == pytest.approx(expected, abs=1.0)
    assert found.momentum_gap == pytest.approx(1.0 - found.outer_radial_load / radial, rel=1e-9)
    said = [each.remark for each in qs.warnings(solution) if each.remark.code == "momentum_gap"]
    assert len(said) == (found.momentum_gap > LARGE_GAP)
    for each in said:
        instead = {"instead": 'raceway_control = "friction"'}
        assert each.values == {"outer_N": found.outer_radial_load, "inner_N": pytest.approx(radial)} | instead


def radially(solution: qs.Solution, contacts: RacewayContacts, share: float) -> np.ndarray:
    """Sum of a raceway's contact forces (y, z), with its share of the gyroscopic moment as friction along tangents."""
    moment = solution.gyroscopic_moment
    across = 0.0 if moment is None else share * np.abs(moment) / (0.5 * B218.ball_diameter)
    of_ball = contacts.load * contacts.cosine - across * contacts.sine
    return np.array([(of_ball * along(solution.azimuth)).sum() for along in (np.cos, np.sin)])


@pytest.mark.parametrize(
    ("more", "shares"),
    [
        ({"effects": CENTRIFUGAL}, (0.0, 0.0)),
        ({}, (0.0, 1.0)),
        ({"effects": BOTH_HARRIS, "control": INNER}, (0.5, 0.5)),
        ({"effects": CENTRIFUGAL, "outer_rpm": 2e3}, (0.0, 0.0)),
    ],
    ids=["forces alone", "outer control", "shared moment", "both rings turn"],
)
def test_the_outer_contacts_carry_the_load_less_the_gap(more: dict, shares: tuple[float, float]) -> None:
    """Contact by contact, under a load of both directions and a moment."""
    loads = {"axial_load": 17.8e3, "radial_load_y": 5e3, "radial_load_z": -2e3, "moment_z": -60.0, "tilt_y": 0.0}
    solution = qs.solve(turning(7e3, **more, **loads))
    assert solution.converged
    sides = zip((solution.inner, solution.outer), shares, strict=True)
    inner, outer = (radially(solution, *each) for each in sides)
    assert inner == pytest.approx(solution.load[1:3], abs=1e-5)
    found = qs.readings.ball_advance(solution)
    assert found.outer_radial_load == pytest.approx(np.hypot(*outer), rel=1e-9)
    assert found.momentum_gap == pytest.approx(np.hypot(*(inner - outer)) / np.hypot(5e3, 2e3), rel=1e-8)


def gap_of(scene: qs.Scene) -> tuple[float | None, float | None, bool]:
    """The gap, what the outer ring takes, and whether a remark says so."""
    solution = solved(scene)
    found = qs.readings.ball_advance(solution)
    said = any(each.remark.code == "momentum_gap" for each in qs.warnings(solution))
    return found.momentum_gap, found.outer_radial_load, said  # type: ignore[return-value]


def test_where_there_is_no_gap() -> None:
    thrust, outer, said = gap_of(turning(10e3, axial_load=8e3))
    assert np.isnan(thrust) and outer == 0.0 and not said  # type: ignore[arg-type]
    combined = {"axial_load": 8e3, "radial_load_y": 4e3, **UPRIGHT}
    assert gap_of(turning(0.0, **combined)) == (0.0, pytest.approx(4e3), False)
    assert gap_of(turning(10e3, effects=(qs.GyroscopicMoment(),), **combined)) == (None, None, False)
    unlike = replace(turning(10e3, **combined), ring_effects=(qs.BallDiameterDeviations(np.r_[1e-6, np.zeros(15)]),))
    assert gap_of(unlike) == (None, None, False)


def test_a_gap_that_matters_to_nothing_is_not_said() -> None:
    """The share tends to a limit as the radial load goes to zero."""
    little, _, said = gap_of(turning(10e3, axial_load=17.8e3, radial_load_y=1.0, **UPRIGHT))
    more, _, is_said = gap_of(turning(10e3, axial_load=17.8e3, radial_load_y=1e3, **UPRIGHT))
    assert little == pytest.approx(more, rel=0.02)
    assert (said, is_said) == (False, True)


def test_many_cases_have_their_own_gaps() -> None:
    radial = np.array([[0.0, 3e3], [8e3, 0.0]])
    axial = np.array([[17.8e3, 17.8e3], [17.8e3, -1e3]])  # the last has no equilibrium
    solution = qs.solve(turning(10e3, axial_load=axial, radial_load_y=radial, **UPRIGHT))
    found = qs.readings.ball_advance(solution)
    assert found.outer_radial_load == pytest.approx(np.array([[0.0, 2713.2], [7028.1, np.nan]]), abs=0.1, nan_ok=True)
    assert np.isnan(found.momentum_gap).tolist() == [[True, False], [False, True]]  # type: ignore[arg-type]
    (said,) = (each.remark for each in qs.warnings(solution) if each.remark.code == "momentum_gap")
    assert said.of.cases is not None
    assert (said.of.cases.count, said.of.cases.first) == (2, (0, 1))
    assert said.values["inner_N"] == pytest.approx(3e3)
    (of_one,) = (each.remark for each in qs.warnings(solution, (1, 0)) if each.remark.code == "momentum_gap")
    assert of_one.values["outer_N"] == pytest.approx(7028.1, abs=0.1)
