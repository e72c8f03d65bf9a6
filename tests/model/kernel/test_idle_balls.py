"""Balls that have lost the inner raceway: they go round at the orbit of equal contact angles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.compiler.compiled import entry
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.kernel.kinematics import LOSING, inner_line
from tests.qsbearing.scenes import B218, INNER, OUTER, PER_BALL, UPRIGHT, solved, turning

G = float(B218.ball_diameter) / float(B218.pitch_diameter)
SPEED = 8000 * qs.rpm
FREE_LENGTH = float(B218.inner_groove_radius) - 0.5 * float(B218.ball_diameter)


def idle_and_loaded(solution: qs.Solution) -> tuple[NDArray, NDArray]:
    """Which balls are off the inner raceway by more than LOSING, and which are pressed to it."""
    return solution.inner.approach < -LOSING * FREE_LENGTH, solution.inner.load > 0.0


@pytest.mark.parametrize("control", [OUTER, INNER, PER_BALL])
@pytest.mark.parametrize("outer_rpm", [0.0, -3000.0, 12_000.0])
def test_idle_balls_share_one_orbit(control: qs.RacewayControl, outer_rpm: float) -> None:
    """[w_i (1 - g cos a) + w_o (1 + g cos a)]/2 at a = 0, whichever raceway controls; they press the outer raceway by
    their centrifugal force alone."""
    effects = (qs.CentrifugalForce(),)
    scene = turning(
        8000, outer_rpm=outer_rpm, effects=effects, control=control, axial_load=2e3, radial_load_y=4e3, **UPRIGHT
    )
    solution = solved(scene)
    idle, loaded = idle_and_loaded(solution)
    assert idle.sum() >= 3 and loaded.sum() >= 3
    orbit = 0.5 * (SPEED * (1.0 - G) + outer_rpm * qs.rpm * (1.0 + G))
    assert solution.orbital_speed[idle] == pytest.approx(orbit, rel=1e-12)
    force = 0.5 * float(B218.ball_mass) * float(B218.pitch_diameter) * orbit**2
    assert solution.outer.load[idle] == pytest.approx(force, rel=1e-9)
    assert solution.outer.angle[idle] == pytest.approx(0.0, abs=1e-9)


def test_idle_balls_orbit_near_the_loaded_ones() -> None:
    """B218, 8000 rpm, 2 kN axial, 4 kN radial, upright: taken from contact lines that do not exist, idle balls' orbits
    were 4573 to 6643 rpm, and their outer loads 644 to 1359 N. Loaded balls and ring have kept these digits."""
    solution = solved(turning(8000, axial_load=2e3, radial_load_y=4e3, **UPRIGHT))
    idle, loaded = idle_and_loaded(solution)
    assert idle.sum() == 9 and loaded.sum() == 7
    assert solution.outer.load[idle] == pytest.approx(333.367, rel=1e-6)
    rpm = solution.orbital_speed[loaded] / qs.rpm
    assert (rpm.min(), rpm.max()) == pytest.approx((3351.97074929, 4220.58181885), rel=1e-10)
    assert solution.displacement[:2] / qs.um == pytest.approx([-277.96, 198.62], abs=0.005)


def test_under_inner_control_an_idle_ball_asks_no_friction_of_the_raceway_it_has_lost() -> None:
    """At a contact angle of zero it has no gyroscopic moment: such scenes were refused."""
    aside = {"radial_displacement_y": np.array([320e-6, 350e-6]), "radial_displacement_z": 0.0}
    four = replace(B218, ball_count=4)
    solution = solved(turning(2000, four, control=INNER, axial_load=8e3, **aside, **UPRIGHT))
    idle, loaded = idle_and_loaded(solution)
    assert idle.any() and loaded.any()
    largest = np.abs(solution.gyroscopic_moment).max()
    assert solution.gyroscopic_moment[idle] == pytest.approx(0.0, abs=1e-12 * largest)


def test_losing_the_inner_raceway_makes_no_jump() -> None:
    """Under a radial load that grows until balls leave: no orbit or outer load changes by more than its share of a
    fine sweep, and a ball that has just left is between its own orbit and the others'."""
    loads = np.linspace(4e3, 8e3, 400)
    solution = solved(turning(8000, axial_load=5e3, radial_load_y=loads, **UPRIGHT))
    gap = -solution.inner.approach / (LOSING * FREE_LENGTH)
    assert ((gap > 0.0) & (gap < 1.0)).any()
    assert (gap.max(axis=0) > 1.0).sum() >= 3
    for quantity in (solution.orbital_speed, solution.outer.load):
        # 400 steps over a range that balls cross in about forty: a jump would be the whole of it.
        assert np.abs(np.diff(quantity, axis=0)).max() < 0.15 * np.ptp(quantity)


@entry(float, float, float, array_of(float))
def fill_inner_line(inner_angle: float, outer_angle: float, approach: float, out: NDArray) -> None:
    """The inner line as rolling sees it, and its angle's derivatives by both angles and the approach."""
    si, ci, so, co = np.sin(inner_angle), np.cos(inner_angle), np.sin(outer_angle), np.cos(outer_angle)
    out[0], out[1], out[2], out[3], out[4] = inner_line(si, ci, so, co, approach, 0.5)


def seen(place: NDArray) -> tuple[float, NDArray]:
    """Its angle and that angle's derivatives."""
    out = np.empty(5)
    fill_inner_line(*place, out)
    assert np.hypot(out[0], out[1]) == pytest.approx(1.0, rel=1e-14)
    return float(np.arctan2(out[0], out[1])), out[2:]


@pytest.mark.parametrize("approach", [1e-3, 0.0, -0.002, -0.008, -0.0099, -0.02])
@pytest.mark.parametrize("inner_degrees", [40.0, 120.0, 179.0, -150.0])
def test_the_line_that_rolling_sees_turns_as_differences_say(inner_degrees: float, approach: float) -> None:
    """From whatever side the ball sees the inner groove, pressed, just lost, or gone; the lines never look more than a
    right angle apart, at which speeds are bounded."""
    place = np.array([np.radians(inner_degrees), np.radians(20.0), approach])
    angle, slopes = seen(place)
    assert abs(np.sin(0.5 * (angle - place[1]))) <= np.sin(np.pi / 4) + 1e-12
    for k, change in enumerate(1e-6 * np.eye(3)):
        turn = seen(place + change)[0] - seen(place - change)[0]
        # Where contact is just lost the second derivative jumps by 6/(LOSING 0.5)^2 = 6e4: half a step of it is 0.03.
        assert slopes[k] == pytest.approx(
            np.arctan2(np.sin(turn), np.cos(turn)) / 2e-6, abs=0.1 if approach == 0.0 and k == 2 else 1e-5
        )


def test_a_pressed_contact_is_seen_where_it_is_and_a_lost_one_on_the_outer_line() -> None:
    """Bit for bit, whatever its load: equilibria of loaded balls do not hang on the width of the transition."""
    for approach, expected in ((1e-9, 0.7), (0.0, 0.7), (-0.5 * LOSING, 0.3), (-0.4, 0.3)):
        out = np.empty(5)
        fill_inner_line(0.7, 0.3, approach, out)
        assert (out[0], out[1]) == (np.sin(expected), np.cos(expected))
