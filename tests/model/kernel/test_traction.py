"""Friction of a contact and of a ball: what sums must be, derivatives by differences, one motion from any start."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import ellipe

import qsbearing as qs
from qsbearing.model.effects.traction import Traction
from qsbearing.model.kernel import traction_ball
from qsbearing.model.kernel.traction import contact_points, contact_sums
from qsbearing.model.kernel.traction_ball import ORBIT, WX
from tests.model.kernel.moved_balls import Ball, law_record, outer_control
from tests.qsbearing.scenes import B218

FEW = contact_points(4, 12)
STARTS = 6
LAWS = {"coulomb": (0, 0.07, 3e-4), "linear": (1, 0.07, 3e-4)}
LOAD, A, B, CURVATURE = 2e-5, 0.09, 0.012, 1.95
SLIPS = (4e-5, 1.5e-3, -2.9e-3, -1.5e-3)
"""wy, ws, wr, vr, about as in B218 at speed, in the case's units."""


def sums(law: tuple[int, float, float], load: float, slips: Any, points: NDArray = FEW, curvature: float = CURVATURE):
    root = (load / LOAD) ** (1.0 / 3.0)
    return contact_sums(law_record(*law), points, load, A * root, B * root, curvature, tuple(slips))


def differences(of: Callable[[NDArray], Any], at: Any, step: NDArray) -> NDArray:
    """Central ones, (result, variable)."""
    at = np.asarray(at, float)
    columns = []
    for k in range(at.size):
        by = np.zeros(at.size)
        by[k] = step[k]
        columns.append((np.asarray(of(at + by), float) - np.asarray(of(at - by), float)) / (2.0 * step[k]))
    return np.stack(columns, axis=-1)


def test_points_make_the_load_and_its_moments() -> None:
    """A semi-ellipsoid has 1 and <xi^2> = a^2/5, exactly, and <xi^4> = 3 a^4/35."""
    for radii, angles in ((3, 8), (10, 24), (64, 160)):
        xi, eta, part = contact_points(radii, angles).T
        assert 4.0 * part.sum() == pytest.approx(1.0, rel=1e-13)
        for x in (xi, eta):
            assert 4.0 * (part * x**2).sum() == pytest.approx(1.0 / 5.0, rel=1e-13)
            assert 4.0 * (part * x**4).sum() == pytest.approx(3.0 / 35.0, rel=1e-12)


def test_no_points_are_refused() -> None:
    for radii, angles in ((0, 8), (3, 6), (3, 0)):
        with pytest.raises(ValueError, match="multiple of 4"):
            contact_points(radii, angles)


def test_a_spinning_contact_has_the_moment_of_the_textbooks() -> None:
    """M = 3/8 mu Q a E where all slip."""
    found = sums((0, 0.07, 1e-9), LOAD, (0.0, 1.5e-3, 0.0, 0.0), contact_points(64, 160), curvature=0.0)
    assert found.mn == pytest.approx(-0.375 * 0.07 * LOAD * A * ellipe(1.0 - (B / A) ** 2), rel=1e-4)
    assert abs(found.t) + abs(found.y) < 1e-15


def test_the_linear_law_is_that_of_the_hand() -> None:
    """Flat: Mn = -k Q (a^2 + b^2)/5 ws, T = -k Q wy D/2, Y = -k Q (vr - wr D/2); any points will do."""
    wy, ws, wr, vr = SLIPS
    k = 0.07 / 3e-4
    found = sums(LAWS["linear"], LOAD, SLIPS, contact_points(2, 4), curvature=0.0)
    assert found.mn == pytest.approx(-k * LOAD * (A * A + B * B) / 5.0 * ws, rel=1e-12)
    assert found.t == pytest.approx(-k * LOAD * 0.5 * wy, rel=1e-12)
    assert found.y == pytest.approx(-k * LOAD * (vr - 0.5 * wr), rel=1e-12)
    assert found.heat == pytest.approx(2.0 * found.dissipation, rel=1e-12)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("curvature", [CURVATURE, 0.0])
def test_forces_are_the_gradient_of_dissipation_and_slopes_their_derivatives(law: str, curvature: float) -> None:
    def dissipation(slips: Any) -> NDArray:
        return np.array([sums(LAWS[law], LOAD, slips, curvature=curvature).dissipation])

    def forces(x: Any) -> NDArray:
        found = sums(LAWS[law], x[4], x[:4], curvature=curvature)
        return np.array([found.t, found.y, found.mn, found.mt, found.my])

    found = sums(LAWS[law], LOAD, SLIPS, curvature=curvature)
    gradient = differences(dissipation, SLIPS, np.full(4, 1e-7))[0]
    np.testing.assert_allclose((-found.my, -found.mn, -found.mt, -found.y), gradient, rtol=1e-6)
    slopes = np.array([found.t_slopes, found.y_slopes, found.mn_slopes, found.mt_slopes, found.my_slopes])
    exact = differences(forces, (*SLIPS, LOAD), np.array([1e-7] * 4 + [1e-9]))
    np.testing.assert_allclose(slopes, exact, rtol=1e-6, atol=1e-9 * np.abs(exact).max())
    hessian = -slopes[[4, 2, 3, 1], :4]
    np.testing.assert_allclose(hessian, hessian.T, atol=1e-14 * np.abs(hessian).max())
    assert found.heat == pytest.approx(np.dot((-found.my, -found.mn, -found.mt, -found.y), SLIPS), rel=1e-12)


def test_dissipation_is_convex_wherever() -> None:
    rng = np.random.default_rng(1)
    for _ in range(200):
        slips = rng.normal(size=4) * 10.0 ** rng.uniform(-6.0, -1.0)
        found = sums(LAWS["coulomb"], LOAD, slips)
        slopes = np.array([found.my_slopes, found.mn_slopes, found.mt_slopes, found.y_slopes])[:, :4]
        least, *_, most = np.linalg.eigvalsh(-slopes)
        assert least > -1e-12 * most


@pytest.mark.parametrize("kind", ["two contacts", "four contacts", "displaced orbit", "no inner contact"])
def test_a_ball_has_exact_derivatives(kind: str) -> None:
    """Of its equations and its force on the ring, by its unknowns, its rates and the ring."""
    ball = Ball(outer_control(B218, 17.8e3, 10_000, displaced=kind == "displaced orbit"), Traction(), FEW)
    ball.law.drag_factor, ball.law.drag_force = 0.3, 2e-7
    if kind == "four contacts":
        ball.add_opposite_grooves(gap=4e-4)
    elif kind == "no inner contact":
        ball.ring = (ball.ring[0] - 4e-3, ball.ring[1])
    at = np.concatenate([ball.start, (1e-5, -2e-5, 3e-5, 1e-5), ball.ring])
    at[WX + 1] = 1e-4  # wy, without which T vanishes

    def equations(x: NDArray) -> NDArray:
        ball.put(x[:6], x[6:10], x[10:])
        return np.concatenate([ball.record.residual, ball.record.ring_force])

    equations(at)
    found = ball.record
    of_ball = np.hstack([found.matrix, found.by_rate[:, 2:], found.by_ring])
    of_ring = np.hstack([found.ring_matrix, np.zeros((4, 4)), found.ring_by_ring])
    slopes = np.vstack([of_ball, of_ring]).copy()
    exact = differences(equations, at, np.array([1e-8] * 2 + [1e-8] * 8 + [1e-8] * 2))
    scale = np.abs(exact).max(axis=0)
    assert (np.abs(slopes - exact) <= 1e-6 * scale + 1e-16).all()
    assert (scale[:6] > 0.0).all()
    assert (np.abs(exact[:, 10:]).max() > 0.0) == (kind != "no inner contact")


@pytest.mark.parametrize(("friction", "slip"), [(0.07, 0.1), (0.03, 0.01)])
def test_motion_under_given_loads_is_one_from_any_start(friction: float, slip: float) -> None:
    """Newton's method on the dissipation less the work of the gyroscopic moment, with Armijo's rule."""
    ball = Ball(outer_control(B218, 17.8e3, 10_000), Traction(friction, slip), FEW)
    speed, most = ball.case.inner_speed, friction * 2e-5
    moment = most * np.array([0.0, 0.3, -0.01, 0.0])  # of what friction can carry

    def potential(x: NDArray) -> tuple[float, NDArray, NDArray]:
        dissipation, gradient, hessian = ball.friction(x)
        return dissipation - moment @ x, gradient - moment, hessian

    found = []
    rng = np.random.default_rng(3)
    for _ in range(STARTS):
        x = ball.start[WX:] + speed * rng.normal(size=4) * np.array([1.0, 1.0, 1.0, 0.3])
        value, gradient, hessian = potential(x)
        for _ in range(100):
            step = -np.linalg.solve(hessian, gradient)
            part, descent, value = 1.0, 1e-4 * gradient @ step, value * (1.0 + 1e-15)
            while part > 1e-12 and potential(x + part * step)[0] > value + part * descent:
                part *= 0.5
            x = x + part * step
            value, gradient, hessian = potential(x)
            if np.abs(gradient).max() < 1e-9 * most:
                break
        assert np.abs(gradient).max() < 1e-8 * most
        found.append(x)
    np.testing.assert_allclose(found, np.broadcast_to(found[0], (STARTS, 4)), atol=1e-6 * speed)


def test_turned_round_and_mirrored_balls_have_mirrored_equations() -> None:
    ball = Ball(outer_control(B218, 17.8e3, 10_000), Traction(), FEW)
    at = ball.start + np.array([0.0, 0.0, 1e-4, 1e-4, -2e-4, 1e-5])
    rates = np.array([1e-5, 2e-5, -3e-5, 4e-5])
    ball.put(at, rates, ball.ring)
    forces = np.array(ball.record.residual)
    backwards = Ball(outer_control(B218, 17.8e3, -10_000), Traction(), FEW)
    turn = np.array([1.0, 1.0, -1.0, 1.0, -1.0, -1.0])
    backwards.put(at * turn, rates * turn[2:] * -1.0, ball.ring)  # along the other way
    np.testing.assert_allclose(np.array(backwards.record.residual), forces * (1, 1, -1, -1, 1, -1), atol=1e-19)
    mirrored = Ball(outer_control(B218, 17.8e3, 10_000), Traction(), FEW)
    mirrored.grooves["sine"] *= -1.0
    mirror = np.array([-1.0, 1.0, 1.0, -1.0, -1.0, 1.0])
    mirrored.put(at * mirror, rates * mirror[2:], (-ball.ring[0], ball.ring[1]))
    np.testing.assert_allclose(np.array(mirrored.record.residual), forces * (-1, 1, 1, 1, -1, -1), atol=1e-19)


def test_four_points_at_speed_fall_out_of_the_same_balance() -> None:
    """A split inner ring on B218's balls, 35 degrees, axial clearance 120 um, 5 kN, 10,000 rpm, mu 0.06."""
    diameter = 22.225 * qs.mm
    bearing = qs.BallBearing(
        ball_count=16,
        ball_diameter=diameter,
        pitch_diameter=125.26 * qs.mm,
        inner_groove_radius=0.52 * diameter,
        outer_groove_radius=0.52 * diameter,
        free_contact_angle=35 * qs.deg,
    )
    ball = Ball(outer_control(bearing, 30e3, 10_000), Traction(0.06), FEW)
    shim = 0.04 * np.sin(35 * qs.deg) - 0.06 * qs.mm / diameter  # of each ring
    ball.add_opposite_grooves(gap=2.0 * 0.02 * np.sin(35 * qs.deg) - shim)
    for load in (30e3, 25e3, 20e3, 16e3, 13e3, 10e3, 8e3, 6.5e3, 5e3):
        ball.case.prescribed[0] = load / ball.case.force
        assert ball.balance()
    ball.points = contact_points(32, 80)
    assert ball.balance()
    found = ball.read()
    loads = found[:, traction_ball.LOAD] * ball.case.force
    np.testing.assert_allclose(loads, (473.831, 882.707, 0.0, 281.368), rtol=1e-5)
    angles = np.degrees(np.arctan2(found[:, traction_ball.SINE], found[:, traction_ball.COSINE]))
    np.testing.assert_allclose(angles[[0, 1, 3]], (41.09669 - 180.0, 30.43248, -29.57697), rtol=3e-6)
    assert ball.record.unknown[ORBIT] / ball.case.inner_speed == pytest.approx(0.458947, rel=3e-6)
    power = ball.case.force * ball.case.length * ball.case.speed
    assert 16.0 * found[:, traction_ball.HEAT].sum() * power == pytest.approx(1734.36, rel=1e-5)
