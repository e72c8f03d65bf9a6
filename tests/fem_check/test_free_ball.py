"""A ball that only Newton's and Euler's laws move: against raceway control's balance, and one of friction.

The numbers of the latter (another code, 32 x 80 points an ellipse) have the ball on the bearing's pitch circle. Here it
goes where it is pressed, 40 um farther out; so the drawing gets the pitch circle that puts the ball's orbit there.
"""

from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest

from fem_check.independent import references
from fem_check.independent.ball_runs import (
    LAST,
    LAST_STEP,
    BallRun,
    UnsettledError,
    at_azimuths,
    mean_of_round,
    motion,
    run,
    settled,
)
from fem_check.independent.ball_starts import begun, controlled
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.free_ball import RING, YZ, FreeBallCase, FreeBalls
from fem_check.independent.slip_friction import Coulomb, Linear, at_centre, over_ellipse

STEEL = ElasticConstants(208e9, 0.3)
RPM = pi / 30.0
UM = 1e-6


def drawing(name, ball, pitch, inner, outer, angle):
    ball, pitch = ball * 1e-3, pitch * 1e-3
    return BearingDrawing(name, ball, pitch, inner * ball, outer * ball, radians(angle), STEEL, STEEL, 7800.0)


B218 = drawing("B218", 22.225, 125.26, 11.6281 / 22.225, 11.6281 / 22.225, 40.0)
SPINDLE = drawing("15 deg", 11.1125, 90.0, 0.53, 0.52, 15.0)
TURBINE = drawing("120 mm", 20.64, 154.5, 0.54, 0.52, 24.0)


def on_pitch_circle(of, outer_angle, outer_load):
    """With the pitch circle on which a ball with this outer contact goes round on the drawing's."""
    approach = references.ellipse(of.groove("outer").problem(outer_load)).approach
    reach = of.outer_groove_radius - 0.5 * of.ball_diameter + approach
    orbit = of.outer_groove_centre_radius + reach * np.cos(np.radians(outer_angle))
    return replace(of, pitch_diameter=2.0 * (of.pitch_diameter - orbit))


def rubbing(*coefficients, slip_speed=0.1):
    """The same inside and outside."""
    return Coulomb(np.array([coefficients, coefficients]), slip_speed)


# The gyroscopic moment, in three cases where inertia turns the contact lines apart by 19 to 51 degrees. The inner
# raceway has no friction, so that the outer one has to give all of the moment, as under outer control, and contacts are
# points, which leave the ball's axis alone.
GYROSCOPIC = [
    FreeBallCase(B218, 10_000 * RPM, 17_800 / 16),
    FreeBallCase(B218, 15_000 * RPM, 500.0),
    FreeBallCase(TURBINE, 12_000 * RPM, 2224 / 15),
]


ANGLE = 5e-3
"""Degrees. Without the moment contact lines would be off by 30 times as much at least, with the other sign by 60."""


def found_moment():
    """Largest deviations from outer control's balance: angles [deg], loads, orbit and moment (over themselves).

    Nothing drives these balls: the creep of friction below vc slows them in proportion to vc. Two vc side by side,
    extrapolated to none, leave its square.
    """
    balances = [controlled(each, "outer") for each in GYROSCOPIC]
    count = len(GYROSCOPIC)
    law = Coulomb(np.array([[0.0], [0.3]]), np.repeat([0.05, 0.1], count))
    balls = FreeBalls(GYROSCOPIC * 2, law, at_centre(), damping=1000.0)
    end = motion(balls, run(balls, begun(balls, balances * 2), 2e-3, step=1e-6, samples=2).states[-1])

    def still(values):
        return 2.0 * values[..., :count] - values[..., count:]

    states = [each.states[0] for each in balances]
    normals = np.array([[side[0] for side in (each.inner, each.outer)] for each in states])
    angles = np.degrees(np.arctan2(*normals.T))
    loads = np.array([[each.q_i[0] for each in states], [each.q_o[0] for each in states]])
    return (
        np.abs(np.degrees(still(end.angle)) - angles).max(),
        np.abs(still(end.load) / loads - 1.0).max(),
        np.abs(still(end.orbit) / [each.orbit[0] for each in states] - 1.0).max(),
        np.abs(still(end.moment) / [-each.moment[0] for each in states] - 1.0).max(),
    )


def test_the_gyroscopic_moment_comes_out():
    angle, load, orbit, moment = found_moment()
    # What is left is the square of the creep, and a swing of 1e-3 deg that damping has not ended after 2 ms.
    assert angle < ANGLE
    assert load < 3e-4
    assert orbit < 1e-6
    assert moment < 1e-3


def test_without_the_moment_the_balance_is_another():
    for case in GYROSCOPIC:
        own, without = (controlled(case, "outer", gyroscopic=each).states[0] for each in (True, False))
        apart = [np.degrees(np.arctan2(*each[0])) for each in (own.inner, without.inner)]
        assert apart[0] - apart[1] > 30.0 * ANGLE


def test_points_divide_the_moment_as_their_loads():
    """And leave the axis where it is: so this holds for outer control's, and for a while."""
    case = FreeBallCase(B218, 10_000 * RPM, 17_800 / 16)
    balls = FreeBalls([case] * 2, Coulomb(np.array([[0.2], [0.2]]), np.array([0.1, 0.2])), at_centre())
    start = begun(balls, [controlled(case, "outer")] * 2)
    end = motion(balls, run(balls, start, 8e-3, step=2e-6, samples=2).states[-1])
    assert (2.0 * end.displacement[0] - end.displacement[1]) / UM == pytest.approx(22.40, abs=0.01)
    np.testing.assert_allclose(end.inner_share, end.load[0] / end.load.sum(axis=0), rtol=3e-4)
    assert end.inner_share[0] == pytest.approx(0.4310, abs=5e-4)


# B218 at 3000 rpm, from the axes of outer and of inner control, 15 degrees apart.
POINTS = over_ellipse(10, 24)
SLOW = FreeBallCase(on_pitch_circle(B218, 40.886806, 1690.1852), 3000 * RPM, 17_800 / 16)


@pytest.fixture(scope="module")
def slow_run():
    balls = FreeBalls([SLOW] * 2, rubbing(0.07), POINTS)
    return run(
        balls, begun(balls, [controlled(SLOW, each) for each in ("outer", "inner")]), 0.056, step=1e-5, samples=56
    )


def test_the_axis_is_found_from_either_side(slow_run):
    start, end = motion(slow_run.balls, slow_run.states[0]), settled(slow_run)
    assert np.ptp(np.degrees(start.attitude)) > 14.0
    # What is left of the way decays by 280 1/s: 15 degrees are 2e-6 after 56 ms.
    assert np.ptp(np.degrees(end.attitude)) < 1e-5
    assert np.ptp(end.orbit) < 1e-7 * SLOW.speed
    assert np.ptp(end.displacement) < 1e-5 * UM


def test_the_friction_balance_at_3000_rpm(slow_run):
    end = settled(slow_run)
    # 10 x 24 points, and steps that leave loads a part of 1e-5.
    assert end.displacement[0] / UM == pytest.approx(35.665845, abs=2e-5)
    np.testing.assert_allclose(np.degrees(end.angle[:, 0]), [42.082457, 40.886806], rtol=0.0, atol=2e-6)
    assert end.load[1, 0] == pytest.approx(1690.1852, abs=0.02)
    assert end.orbit[0] / SLOW.speed == pytest.approx(0.43369058, abs=1e-7)
    assert np.degrees(end.attitude[0]) == pytest.approx(42.19661, abs=2e-4)
    thrust = end.load[0] * np.sin(end.angle[0]) - end.tangential[0] * np.cos(end.angle[0])
    np.testing.assert_allclose(thrust, SLOW.thrust, rtol=1e-5)


def test_what_drives_the_ring_becomes_heat(slow_run):
    balls = slow_run.balls
    end = run(balls, slow_run.states[-1], LAST, LAST_STEP, 1).states[-1]
    contacts = balls.contacts(end)
    (_, torque), (force, _) = contacts.on_ball
    about_axis = torque + (end[YZ].conj() * force).imag
    # The steps leave 1e-4 of it between the two rings' torques, whose mean is right.
    np.testing.assert_allclose(0.5 * (about_axis[0] - about_axis[1]) * SLOW.speed, contacts.heat.sum(axis=0), rtol=1e-6)


def test_a_run_is_not_called_settled_too_early(slow_run):
    early = BallRun(slow_run.balls, slow_run.times[:31], slow_run.states[:31])
    with pytest.raises(UnsettledError, match="still changes by"):
        settled(early)
    with pytest.raises(UnsettledError, match="shorter than a turn"):
        settled(BallRun(slow_run.balls, slow_run.times[:6], slow_run.states[:6]))


def changed(slow_run, **different):
    """By how much the motion changes in 2 ms under a changed law, over the speed, and the displacement [um]."""
    balls = replace(slow_run.balls, **different)
    before, after = (
        motion(balls, each) for each in (slow_run.states[-1], run(balls, slow_run.states[-1], 2e-3, 1e-5, 1).states[-1])
    )
    return np.abs(after.rotation - before.rotation).max() / SLOW.speed, np.abs(
        after.displacement - before.displacement
    ).max() / UM


def test_broken_laws_are_seen(slow_run, monkeypatch):
    same = changed(slow_run)
    assert same[0] < 1e-5
    assert same[1] < 1e-4
    assert changed(slow_run, law=rubbing(-0.07))[0] > 1.0
    hertz = references.ellipse
    monkeypatch.setattr(
        references, "ellipse", lambda problem: replace(hertz(problem), approach=1.001 * hertz(problem).approach)
    )
    assert changed(slow_run)[1] > 0.01


# Quadrature, and what integrals over the ellipse are known in closed form.
def pressed(balls, spin):
    """At the outer raceway, at rest but for the spin about the normal [rad/s]."""
    state = begun(balls, [controlled(SLOW, "outer")])
    normal = balls.contacts(state).normal[1]
    return balls.start(state[0].real + 1j * np.abs(state[1]), 0.0 * normal.real, spin * normal, state[6].real)


def ellipse(balls, state):
    load = balls.contacts(state).load[1, 0]
    of = references.ellipse(SLOW.drawing.groove("outer").problem(load))
    problem = SLOW.drawing.groove("outer").problem(1.0)
    return (
        load,
        of.semi_major_axis,
        of.semi_minor_axis,
        references.second_kind(problem.curvature_x / problem.curvature_y),
    )


def test_spin_meets_three_eighths_of_mu_Q_a_E():
    balls = FreeBalls([SLOW], rubbing(0.07, slip_speed=1e-9), over_ellipse(12, 200))
    state = pressed(balls, 100.0)
    load, a, _, second = ellipse(balls, state)
    moment = balls.contacts(state).moment[1][1, 0]
    # Slip turns round at the middle of the ellipse, where the sum converges like the square of the rings.
    assert moment == pytest.approx(-0.375 * 0.07 * load * a * second, rel=2e-3)


def test_linear_friction_is_summed_exactly():
    balls = FreeBalls([SLOW], Linear(0.5), over_ellipse(3, 6))
    state = pressed(balls, 100.0)
    load, a, b, _ = ellipse(balls, state)
    contacts = balls.contacts(state)
    assert contacts.moment[1][1, 0] == pytest.approx(-0.5 * load * (a * a + b * b) / 5.0 * 100.0, rel=1e-12)
    assert contacts.heat[1, 0] == pytest.approx(0.5 * load * (a * a + b * b) / 5.0 * 1e4, rel=1e-12)
    assert abs(contacts.friction[1, 0]) < 1e-12 * load


# Minutes long from here on.
FAST = 10_000 * RPM, 17_800 / 16


def fast(outer_angle, outer_load):
    """B218 at 10,000 rpm, whose balls run on the bearing's pitch circle with this outer contact."""
    return FreeBallCase(on_pitch_circle(B218, outer_angle, outer_load), *FAST)


@pytest.mark.heavy
def test_linear_friction_at_10000_rpm():
    """Of any points the same, on a flat contact: with the other code to its printed digits."""
    case = fast(33.875545, 1850.0414)
    balls = FreeBalls([case], Linear(5.0), over_ellipse(3, 6, curved=False))
    end = settled(run(balls, begun(balls, [controlled(case, "outer")]), 0.04, step=2e-6, samples=40))
    assert end.displacement[0] / UM == pytest.approx(22.938826, abs=2e-4)
    np.testing.assert_allclose(np.degrees(end.angle[:, 0]), [48.072198, 33.875545], rtol=0.0, atol=5e-5)
    assert end.orbit[0] / FAST[0] == pytest.approx(0.43541791, abs=1e-6)
    np.testing.assert_allclose(end.tangential[:, 0], [-75.55880, -97.92704], rtol=1e-4)
    # Of little slip, which lags behind the ball's way round by a part of a step.
    np.testing.assert_allclose(end.sideways[:, 0], [-53.04952, 53.04952], rtol=5e-4)
    np.testing.assert_allclose(end.heat[:, 0], [4033.740, 2719.644], rtol=1e-4)
    assert end.inner_share[0] == pytest.approx(end.load[0, 0] / end.load[:, 0].sum(), rel=1e-5)


@pytest.mark.heavy
def test_the_friction_balance_at_10000_rpm():
    """Both axes to begin with, then other coefficients and another slip speed; 6 x 16 points, with which the other code
    gave 19.40712 um, 0.4452578 and a share of 0.25374 (0.07, 0.1 m/s)."""
    outer = [(32.698952, 1887.3988)] * 2 + [(33.007888, 1899.3944), (32.316771, 1891.9427), (33.156028, 1885.3669)]
    cases = [fast(*each) for each in outer]
    mu, slip_speed = np.array([0.07, 0.07, 0.05, 0.10, 0.07]), np.array([0.1, 0.1, 0.1, 0.1, 0.5])
    balls = FreeBalls(cases, Coulomb(np.array([mu, mu]), slip_speed), over_ellipse(6, 16))
    controls = ["outer", "inner", "outer", "outer", "outer"]
    start = begun(balls, [controlled(case, control) for case, control in zip(cases, controls, strict=True)])
    end = settled(run(balls, start, 0.15, samples=150))
    # Of the way from inner control's axis, 20 degrees, 2e-5 are left: the slowest decay is that by 90 1/s.
    np.testing.assert_allclose(end.displacement[:2] / UM, 19.40712, rtol=0.0, atol=2e-4)
    np.testing.assert_allclose(end.orbit[:2] / FAST[0], 0.4452578, rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(end.inner_share[:2], 0.25374, rtol=0.0, atol=2e-5)
    # The limit of many points: these few miss it by 0.035 um and 2e-4 (known of the balance at 0.07).
    limits = np.array([19.444919, 19.444919, 20.562673, 18.156386, 20.947396])
    np.testing.assert_allclose(end.displacement / UM, limits, rtol=0.0, atol=0.05)
    orbits = np.array([0.44532375, 0.44532375, 0.44952973, 0.44626331, 0.44538441])
    np.testing.assert_allclose(end.orbit / FAST[0], orbits, rtol=0.0, atol=2e-4)


# Radial loads: rings held at the displacement (um) of a periodic balance of all balls (32 x 80 points), a ball carried
# round. Outer contacts for the pitch circle are those of thrust alone.
CARRIED = [
    (on_pitch_circle(B218, 32.7, 1887.0), *FAST, (17.6892, 13.5025, 0.2461), 16),
    (on_pitch_circle(B218, 20.0, 1200.0), FAST[0], 500.0, (-78.582, 85.605, 4.113), 16),
    (on_pitch_circle(SPINDLE, 5.3, 257.0), 18_000 * RPM, 30.0, (1.0050, 3.0268, -0.0447), 20),
]


@pytest.mark.heavy
def test_a_ball_carried_round_under_radial_load():
    displacements = UM * np.array([each[3] for each in CARRIED])
    cases = [
        FreeBallCase(of, speed, None, complex(*at[1:]))
        for (of, speed, *_), at in zip(CARRIED, displacements, strict=True)
    ]
    balls = FreeBalls(cases, rubbing(0.07, 0.07, 0.07), over_ellipse(10, 24))
    start = begun(balls, [controlled(case, "outer", each[2]) for case, each in zip(cases, CARRIED, strict=True)])
    start[RING] = displacements[:, 0]
    round_time = 2.0 * pi / (0.44 * FAST[0])
    there = run(balls, start, 9.0 * round_time, samples=9)
    last = run(balls, there.states[-1], 1.03 * round_time, step=1e-6, samples=2000)
    motions = [motion(balls, each) for each in last.states]
    quarters = np.radians([0.0, 90.0, 180.0, 270.0])
    loads = at_azimuths(last, np.array([each.load[0] for each in motions]), quarters)
    orbits = at_azimuths(last, np.array([each.orbit for each in motions]) / balls.speeds[0], quarters)
    attitudes = at_azimuths(last, np.degrees([each.attitude for each in motions]), quarters)
    forces = [balls.contacts(each).on_rings for each in last.states]
    count = np.array([each[4] for each in CARRIED])
    axial = [count * mean_of_round(last, np.array([along[ring] for along, _ in forces])) for ring in (0, 1)]
    radial = [count * mean_of_round(last, np.array([across[ring] for _, across in forces])) for ring in (0, 1)]
    # A ball comes back to where it was: what one ring gives it, the other takes.
    for each in (axial, radial):
        np.testing.assert_allclose(each[0], -each[1], rtol=0.0, atol=0.02)
    # That balance leaves out the slip of balls on their way in and out and of a ring off its centre. It moves the ring
    # by 0.1 and 1 um across the load, by 0.01 and 0.3 um along it; that balance's stiffness (N/um) makes loads of it.
    loads_of_rings = np.array([3000.0, 4000.0, 300.0])
    off = -radial[0] - loads_of_rings
    assert (np.abs(off.real) < np.array([233.0, 143.0, 105.0]) * [0.02, 0.3, 0.02]).all()
    assert (np.abs(off.imag) < np.array([222.0, 47.0, 99.0]) * [0.15, 1.2, 0.1]).all()
    np.testing.assert_allclose(-axial[0], [17_800.0, 8000.0, 600.0], rtol=4e-3)
    known_loads = [[1974.96, 1385.49, 1026.73, 1397.21], [1721.1, 437.96, 257.66, 455.59]]
    np.testing.assert_allclose(loads[:, :2].T, known_loads, rtol=0.0, atol=5.0)
    known_orbits = np.array(
        [
            [0.441464, 0.444415, 0.450439, 0.448085],
            [0.459509, 0.485689, 0.509677, 0.524514],
            [0.449272, 0.450196, 0.452523, 0.451976],
        ]
    )
    assert (np.abs(orbits.T - known_orbits).max(axis=1) < [1.5e-4, 2.5e-3, 1e-4]).all()
    np.testing.assert_allclose(attitudes[:, 0], [31.265, 31.990, 31.464, 30.524], rtol=0.0, atol=0.02)
    np.testing.assert_allclose(attitudes[:, 2], [5.072, 5.407, 5.114, 4.767], rtol=0.0, atol=0.01)
