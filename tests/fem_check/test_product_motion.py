"""The product's balance of friction against a ball that only Newton's and Euler's laws move.

The product's answer is put into the laws of motion as it is: what forces and moments do to ball and ring there must be
what turning round the axis asks for. Both sum friction over the same points; nothing else is shared. The product's
balls go round where they are pressed, as free balls do.
"""

from dataclasses import dataclass

import numpy as np
import pytest

import qsbearing as qs
from fem_check.independent.ball_runs import motion, run
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.free_ball import ACROSS, ALONG, RING_SPEED, FreeBallCase, FreeBalls
from fem_check.independent.slip_friction import Coulomb, EllipsePoints, Linear, over_ellipse
from qsbearing.model.effects.traction import Traction, TractionLaw
from qsbearing.model.kernel.traction import contact_points
from qsbearing.model.solution.friction_motion import friction_motion

BOTH = (qs.CentrifugalForce(), qs.GyroscopicMoment())
STEEL = ElasticConstants(208e9, 0.3)


@dataclass(frozen=True)
class Drawn:
    """Random bearings, 6 to 25 mm balls, 15 to 40 degrees, dn 0.3 to 2 million."""

    count: int
    seed: int

    def bearings(self):
        """Numbers of the bearings and of their operation, a row each."""
        rng, rows = np.random.default_rng(self.seed), []
        for _ in range(self.count):
            diameter, angle = rng.uniform(6.0, 25.0), np.radians(rng.uniform(15.0, 40.0))
            pitch = diameter * rng.uniform(4.5, 9.0)
            balls = int(np.pi * pitch / diameter / 1.2)
            inner, outer = rng.uniform(0.515, 0.54, 2)
            load = balls * 10.0 ** rng.uniform(0.0, 1.3) * diameter**2 * np.sin(angle)
            rpm, mu, vc = rng.uniform(0.3e6, 2e6) / pitch, rng.uniform(0.03, 0.1), 10.0 ** rng.uniform(-1.5, -0.3)
            rows.append((balls, diameter * 1e-3, pitch * 1e-3, inner, outer, angle, load, rpm * qs.rpm, mu, vc))
        return np.array(rows).T


def solved(drawn, law=TractionLaw.COULOMB, points=None, is_curved=True):
    """The product's answer."""
    balls, diameter, pitch, inner, outer, angle, load, speed, mu, vc = drawn
    bearing = qs.BallBearing(balls, diameter, pitch, inner * diameter, outer * diameter, angle)
    operation = qs.Operation(speed=speed, axial_load=load)
    scene = qs.Scene(bearing, operation, BOTH, "outer", orbit_radius="displaced")
    traction = Traction(mu, vc, law, is_curved)
    return friction_motion(scene, traction, **(points or {}))


def same_points(radii=10, angles=24, is_curved=True):
    """Of the product, on all four quarters."""
    x, y, part = contact_points(radii, angles).T
    signs = [(i, j) for i in (1, -1) for j in (1, -1)]
    along, across = (np.concatenate([s[k] * each for s in signs]) for k, each in enumerate((x, y)))
    return EllipsePoints(along, across, np.tile(part, 4), is_curved)


def drawing(diameter, pitch, inner, outer, angle):
    return BearingDrawing("", diameter, pitch, inner * diameter, outer * diameter, angle, STEEL, STEEL, 7800.0)


def free(drawn, points, law=TractionLaw.COULOMB):
    """Free balls of the same bearings under the same law."""
    cases = [FreeBallCase(drawing(*each[1:6]), each[7], each[6] / each[0]) for each in drawn.T]
    mu, vc = drawn[8:]
    friction = Coulomb(np.array([mu, mu]), vc) if law is TractionLaw.COULOMB else Linear(float(mu[0] / vc[0]))
    return FreeBalls(cases, friction, points)


def placed(balls, drawn, product):
    """The state that the product says, the first ball of each bearing in the plane of x and y."""
    diameter, outer = drawn[1], drawn[4] * drawn[1]
    line = outer - 0.5 * diameter + product.outer.approach[:, 0]
    angle = product.outer.angle[:, 0]
    centre = np.array([of.outer_groove_centre_radius for of in balls.drawings])
    w = product.angular_velocity[:, 0]
    place = line * np.sin(angle) + 1j * (centre + line * np.cos(angle))
    state = balls.start(place, product.orbital_speed[:, 0], w[:, 0] + 1j * w[:, 2], product.displacement[:, 0])
    state[ACROSS.start + 1] -= 1j * w[:, 1]  # e_r x e_x
    return state


def left_over(balls, state, product):
    """Forces over the load and moments over load and diameter that turning round does not ask for: (what, case)."""
    rates, orbit, load = balls.rates(state), product.orbital_speed[:, 0], product.outer.load[:, 0]
    mass, inertia = (np.array([getattr(of, name) for of in balls.drawings]) for name in ("ball_mass", "ball_inertia"))
    lever = np.array([of.ball_diameter for of in balls.drawings]) * load
    round_it = 1j * orbit * state[ACROSS]
    force = np.abs(rates[ALONG][0]), np.abs(rates[ACROSS][0] - round_it[0])
    turning = np.abs(rates[ALONG][1]), np.abs(rates[ACROSS][1] - round_it[1])
    ring = np.abs(rates[RING_SPEED]) * balls.ring_mass
    return np.array(
        [*(mass * each / load for each in force), *(inertia * each / lever for each in turning), ring / load]
    )


@pytest.mark.parametrize("is_curved", [True, False])
def test_what_the_product_says_of_twenty_bearings_is_a_steady_motion(is_curved):
    drawn = Drawn(20, 5).bearings()
    product = solved(drawn, is_curved=is_curved)
    assert (product.status == "converged").all()
    balls = free(drawn, same_points(is_curved=is_curved))
    state = placed(balls, drawn, product)
    assert left_over(balls, state, product).max() < 1e-9
    seen = motion(balls, state)
    np.testing.assert_allclose(seen.angle, [product.inner.angle[:, 0], product.outer.angle[:, 0]], rtol=1e-12)
    np.testing.assert_allclose(seen.load, [product.inner.load[:, 0], product.outer.load[:, 0]], rtol=1e-10)
    np.testing.assert_allclose(seen.tangential, [product.inner.traction[:, 0], product.outer.traction[:, 0]], rtol=1e-7)
    np.testing.assert_allclose(seen.moment, -product.gyroscopic_moment[:, 0], rtol=1e-8)
    np.testing.assert_allclose(seen.heat, [product.inner.heat[:, 0], product.outer.heat[:, 0]], rtol=1e-7)


@pytest.mark.parametrize("is_curved", [True, False])
def test_so_it_is_under_linear_friction(is_curved):
    """Flat contacts have the sums of any points."""
    drawn = Drawn(4, 6).bearings()
    drawn[8], drawn[9] = 0.1, 0.05
    product = solved(drawn, TractionLaw.LINEAR, is_curved=is_curved)
    points = same_points() if is_curved else over_ellipse(3, 6, curved=False)
    balls = free(drawn, points, TractionLaw.LINEAR)
    assert left_over(balls, placed(balls, drawn, product), product).max() < 1e-8


@pytest.mark.parametrize("changed", ["wx", "wy", "wz", "orbit", "mu"])
def test_another_motion_is_none(changed):
    drawn = Drawn(3, 5).bearings()
    product = solved(drawn)
    if changed == "mu":
        drawn[8] *= 1.0 + 1e-6
    balls = free(drawn, same_points())
    state = placed(balls, drawn, product)
    if changed == "orbit":
        state[ACROSS.start] *= 1.0 + 1e-6
    elif changed == "wx":
        state[ALONG.start + 1] *= 1.0 + 1e-5
    elif changed != "mu":
        state[ACROSS.start + 1] += 1e-5 * drawn[7] * (1.0 if changed == "wz" else 1j)
    assert (left_over(balls, state, product).max(axis=0) > 1e-9).all()


MESHES = {(4, 12): (0.25, 1.0), (6, 16): (0.12, 0.7), (10, 24): (0.05, 0.4), (32, 80): (1e-3, 0.02)}
"""By points of a contact: largest error of the displacement of twenty bearings [um], of those whose friction is above
0.7 of what outer control asks, and of the others, whose balls slip across."""


def test_points_converge():
    """The referee's own rule of many points has the answer of the product with many; fewer err by what is told."""
    drawn = Drawn(20, 5).bearings()
    fine = solved(drawn, points={"radii": 64, "angles": 160})
    balls = free(drawn, over_ellipse(64, 160))
    assert left_over(balls, placed(balls, drawn, fine), fine).max() < 1e-8
    is_held = fine.gyroscopic_margin[:, 0] > 0.7
    assert is_held.sum() == 18
    for (radii, angles), (most, slipping) in MESHES.items():
        coarse = solved(drawn, points={"radii": radii, "angles": angles})
        error = np.abs(coarse.displacement - fine.displacement)[:, 0] * 1e6
        print(f"{radii} x {angles}: {np.median(error):.1e} (median), {error[is_held].max():.1e}, {error.max():.1e} um")
        assert error[is_held].max() < most
        assert error.max() < slipping


B218 = (22.225e-3, 125.26e-3, 11.6281 / 22.225, 11.6281 / 22.225, np.radians(40.0))


def carried_left_over(product, ball, is_centred):
    """What a ball of B218 lacks that goes round as the product says, the rates of its motion included.

    Args:
        is_centred: whether the inner ring turns about the outer one's axis, as the product takes it, with a groove that
            is wider there by its displacement; else about its own.
    """
    count = product.weight.size
    wave = 1j * np.fft.fftfreq(count, 1 / count)
    wave[count // 2] = 0.0
    moving = np.vstack([product.angular_velocity.T, product.orbital_speed])
    (wx, wy, wz, orbit), rates = moving[:, ball], np.fft.ifft(wave * np.fft.fft(moving)).real[:, ball]
    of, angle, load = drawing(*B218), product.outer.angle[ball], product.outer.load[ball]
    line = of.outer_groove_radius - 0.5 * of.ball_diameter + product.outer.approach[ball]
    moved = (product.displacement[1] + 1j * product.displacement[2]) * np.exp(-2j * np.pi * ball / count)
    case = FreeBallCase(of, 10_000 * qs.rpm, None, 0.0 if is_centred else moved)
    balls = FreeBalls([case], Coulomb(np.full((2, 1), 0.07), 0.1), same_points())
    # The product's balls turn on the pitch circle: grooves are put where they then are.
    place = line * np.sin(angle) + 0.5j * of.pitch_diameter
    circles = balls._grooves[0]
    circles -= of.outer_groove_centre_radius + line * np.cos(angle) - place.imag
    circles[0] += moved.real * is_centred
    given = place, orbit, wx + 1j * wz, product.displacement[0]
    state = balls.start(*(np.array([each]) for each in given))
    state[ACROSS.start + 1] -= 1j * wy  # e_r x e_x
    change, (by_wx, by_wy, by_wz, by_orbit) = balls.rates(state)[:, 0], rates * orbit
    force = change[ACROSS][0] - 1j * orbit * state[ACROSS][0, 0] - 1j * by_orbit * place.imag
    turning = change[ACROSS][1] - 1j * orbit * state[ACROSS][1, 0] - (by_wz - 1j * by_wy)
    about_axis = change[ALONG][1] - by_wx - by_orbit
    forces = of.ball_mass * np.abs([change[ALONG][0], force]) / load
    return max(*forces, *(of.ball_inertia * np.abs([about_axis, turning]) / (load * of.ball_diameter)))


def test_balls_carried_round_are_so_too():
    """B218 under combined load: the rates that the product takes along the orbit are those of free balls. It leaves out
    that the inner ring turns about its own axis, 43 um off the outer one's: 3e-3 of the loads at most."""
    bearing = qs.BallBearing(16, *B218[:2], B218[2] * B218[0], B218[3] * B218[0], B218[4])
    held = {"radial_load_y": 8e3, "tilt_y": 0.0, "tilt_z": 0.0}
    operation = qs.Operation(speed=10_000 * qs.rpm, axial_load=17.8e3, **held)
    product = friction_motion(qs.Scene(bearing, operation), Traction())
    assert product.status == "converged"
    assert max(carried_left_over(product, ball, True) for ball in range(0, 16, 2)) < 1e-9
    assert 1e-3 < max(carried_left_over(product, ball, False) for ball in range(0, 16, 2)) < 3e-3


@pytest.mark.heavy
def test_balls_run_towards_what_the_product_says():
    """Four bearings, begun off their axes by up to 4 degrees: after 30 ms none is farther off than a fifth of that."""
    drawn, points = Drawn(4, 7).bearings(), {"radii": 6, "angles": 16}
    product = solved(drawn, points=points)
    balls = free(drawn, same_points(**points))
    state = placed(balls, drawn, product)
    state[ACROSS.start + 1] *= 0.9
    begun, end = (motion(balls, each) for each in (state, run(balls, state, 0.03, step=4e-6, samples=10).states[-1]))
    off = [np.abs(each.attitude - product.attitude_angle[:, 0]) for each in (begun, end)]
    print(np.degrees(off))
    assert np.degrees(off[0]).max() > 1.0
    assert (off[1] < 0.2 * off[0].max()).all()
    assert (off[1] < 0.6 * off[0]).all()
    np.testing.assert_allclose(end.load[1], product.outer.load[:, 0], rtol=0.02)
