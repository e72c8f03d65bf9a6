"""Balls that friction moves, against another program's numbers, and where their motion is known without any."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects.entry import with_found
from qsbearing.model.effects.traction import Traction
from qsbearing.model.kernel import admissibility, traction_ball
from qsbearing.model.kernel.traction_balance import outside_grooves
from qsbearing.model.solution.friction_motion import FrictionMotion, friction_motion
from qsbearing.model.solution.motion_stiffness import motion_rates, motion_stiffness
from qsbearing.model.validation import SceneError
from tests.qsbearing.scenes import B218, BOTH, OUTER, UPRIGHT

FINE, MIDDLE = {"radii": 64, "angles": 160}, {"radii": 32, "angles": 80}
DIGITS = 2e-6
"""Of numbers printed to six digits, by another rule of quadrature."""
SPEED = 10_000 * qs.rpm


def bearing(balls: int, diameter: float, pitch: float, inner: float, outer: float, angle: float) -> qs.BallBearing:
    return qs.BallBearing(
        ball_count=balls,
        ball_diameter=diameter * qs.mm,
        pitch_diameter=pitch * qs.mm,
        inner_groove_radius=inner * diameter * qs.mm,
        outer_groove_radius=outer * diameter * qs.mm,
        free_contact_angle=angle * qs.deg,
    )


SMALL = bearing(20, 11.1125, 90.0, 0.53, 0.52, 15.0)
TURBINE = bearing(15, 20.64, 154.5, 0.54, 0.52, 24.0)


def scene(of: qs.BallBearing, axial: Any, revolutions: Any, radial: float = 0.0) -> qs.Scene:
    held = {"radial_load_y": radial, **UPRIGHT} if radial else {}
    return qs.Scene(of, qs.Operation(speed=revolutions * qs.rpm, axial_load=axial, **held))


THRUST = scene(B218, 17.8e3, 10_000)


def law(friction: float, slip: float, **more: Any) -> Traction:
    """Of any size."""
    return with_found(Traction(**more), {"friction_coefficient": friction, "slip_speed": slip})


LINEAR = law(0.5, 0.1, law="linear", has_curvature=False)
"""5 s/m."""


def balanced(found: FrictionMotion, speed: float = SPEED) -> FrictionMotion:
    """After a check of the loads, of the moment's work, and that both rings carry the same."""
    assert (found.status == "converged").all()
    assert (found.residual <= 1e-10).all()
    np.testing.assert_allclose(-found.torque * speed, found.heat, rtol=1e-9)
    np.testing.assert_allclose(found.load[..., :3], found.start.load[..., :3], rtol=1e-9, atol=1e-5)
    return found


def outward(found: FrictionMotion) -> NDArray:
    """What the outer ring's contacts give the balls, (axial, y, z), with the balls' weights."""
    psi = 2.0 * np.pi * np.arange(found.weight.size) / found.weight.size
    outer = found.outer
    sine, cosine = np.sin(outer.angle), np.cos(outer.angle)
    axial = -outer.load * sine + outer.traction * cosine
    radial, across = -outer.load * cosine - outer.traction * sine, outer.sideways
    in_y, in_z = radial * np.cos(psi) + across * np.sin(psi), radial * np.sin(psi) - across * np.cos(psi)
    return np.array([(found.weight * each).sum() for each in (axial, in_y, in_z)])


def numbers(found: FrictionMotion, speed: float = SPEED) -> list[float]:
    """As the table has them."""
    first = [each[..., 0] for each in (found.inner.angle, found.outer.angle)]
    forces = found.outer.traction, found.inner.traction, found.outer.sideways, found.gyroscopic_moment
    return [
        float(found.displacement[0] / qs.mm * 1e3),
        *(float(np.degrees(each)) for each in first),
        *(float(each[0]) for each in (found.inner.load, found.outer.load, found.orbital_speed / speed)),
        *(float(each) / speed for each in found.angular_velocity[0]),
        *(float(each[0]) for each in (*forces, found.outer.heat, found.inner.heat)),
    ]


TABLE = {
    "mu 0.05": (
        *(Traction(0.05), 20.562673, 48.747621, 33.007888, 1443.0330, 1899.3944, 0.44952973),
        *(-2.5934991, 0.0591265, 1.3658573, -92.76984, -41.87262, 2.22626, 1.491156, 65.31260, 100.30495),
    ),
    "mu 0.07": (
        *(Traction(0.07), 19.444919, 48.963953, 32.698952, 1441.8430, 1887.3988, 0.44532375),
        *(-2.4607050, 0.0260416, 1.5192953, -110.37176, -37.96087, 1.66773, 1.643151, 45.90787, 107.26439),
    ),
    "mu 0.10": (
        *(Traction(0.10), 18.156386, 49.240240, 32.316771, 1444.4368, 1891.9427, 0.44626331),
        *(-2.4733105, 0.0126221, 1.5105747, -119.59211, -28.19148, 1.83358, 1.637166, 40.84397, 150.02882),
    ),
    "slip 0.5": (
        *(Traction(0.07, 0.5), 20.947396, 48.630292, 33.156028, 1439.2358, 1885.3669, 0.44538441),
        *(-2.4755563, 0.0495636, 1.4970744, -97.17511, -49.03840, 2.13931, 1.619339, 60.85498, 111.64277),
    ),
    "flat": (
        *(Traction(has_curvature=False), 18.97673, 49.07335, 32.55135, 1443.3265, 1892.8741, 0.4470278),
        *(-2.487305, 0.0231703, 1.485513, -111.5529, -33.5775, 1.57019, 1.612762, 38.7094, 109.7338),
    ),
    "linear": (
        *(LINEAR, 22.938826, 48.072198, 33.875545, 1427.4598, 1850.0414, 0.43541791),
        *(-2.1666333, 0.0009097, 1.8230989, -97.92704, -75.55880, 53.04952, 1.927861, 2719.644, 4033.740),
    ),
}
"""Law; displacement [um], angles [deg], loads [N], orbit and angular velocity over the shaft's speed, T and Y [N], the
moment [N m], heat of the outer and the inner contact of a ball [W]."""


@pytest.mark.parametrize("name", TABLE)
def test_thrust_has_the_numbers_of_another_program(name: str) -> None:
    traction, *expected = TABLE[name]
    found = numbers(balanced(friction_motion(THRUST, traction, **FINE)))
    last = 0.5 * 10.0 ** -np.array([6, 6, 6, 4, 4, 8, 7, 7, 7, 5, 5, 5, 6, 5, 5])
    if name == "flat":
        last = 0.5 * 10.0 ** -np.array([5, 5, 5, 4, 4, 7, 6, 7, 6, 4, 4, 5, 6, 4, 4])
    if name == "linear":
        last[-2:] = 0.5e-3
    assert (np.abs(np.array(found) - expected) <= DIGITS * np.abs(expected) + last).all(), np.array(found) - expected


@pytest.mark.parametrize(
    ("of", "axial", "revolutions", "traction", "expected"),
    [
        (B218, 17.8e3, 3000, Traction(), (35.665845, 42.082457, 40.886806, 1651.2997, 1690.1852, 0.43369058, 42.19661)),
        (
            SMALL,
            600,
            18_000,
            Traction(0.05),
            (1.873787, 21.833863, 5.305971, 79.052929, 257.420544, 0.45141779, 4.78094),
        ),
        (
            *(TURBINE, 13_345, 12_000, Traction(0.05)),
            (54.709942, 30.122934, 18.692737, 1721.19875, 2500.04440, 0.44423757, 18.28823),
        ),
    ],
    ids=["slow", "small", "turbine"],
)
def test_other_bearings_too(of: qs.BallBearing, axial: float, revolutions: float, traction: Any, expected: Any) -> None:
    found = balanced(friction_motion(scene(of, axial, revolutions), traction, **FINE), revolutions * qs.rpm)
    values = [*numbers(found, revolutions * qs.rpm)[:6], np.degrees(found.attitude_angle[0])]
    np.testing.assert_allclose(values, expected, rtol=DIGITS)
    if of is SMALL:
        forces = found.outer.traction[0], found.inner.traction[0]
        np.testing.assert_allclose(forces, (-6.221860, -0.645191), rtol=DIGITS)


def test_default_points_err_by_what_is_stated() -> None:
    coarse = friction_motion(THRUST, Traction())
    assert abs(coarse.displacement[0] - 19.444919e-6) == pytest.approx(0.008e-6, abs=1e-9)
    assert coarse.orbital_speed[0] / SPEED == pytest.approx(0.44532375, rel=1e-4)


def test_without_speed_nothing_parts_the_contacts() -> None:
    slow = balanced(friction_motion(scene(B218, 17.8e3, 1), Traction(slip_speed=1e-3)), qs.rpm)
    static = qs.solve(scene(B218, 17.8e3, 0))
    np.testing.assert_allclose(slow.displacement[0], static.displacement[0], rtol=1e-6)
    np.testing.assert_allclose(slow.inner.load, static.inner.load, rtol=1e-6)
    assert np.abs(slow.outer.traction).max() < 1e-5


@pytest.mark.parametrize("radial", [0.0, 3e3])
def test_at_rest_it_is_the_static_solution(radial: float) -> None:
    """So that a sweep may begin there."""
    of = scene(B218, 17.8e3, 0, radial)
    found = friction_motion(of, Traction())
    static = qs.solve(of)
    assert found.status == "converged"
    np.testing.assert_allclose(found.displacement, static.displacement, rtol=1e-10)
    np.testing.assert_allclose(found.inner.load, static.inner.load, rtol=1e-9)
    np.testing.assert_allclose(motion_stiffness(found), static.stiffness[:3, :3], rtol=1e-6, atol=10.0)
    assert found.heat == 0.0
    for each in (found.angular_velocity, found.orbital_speed, found.cage_speed, found.gyroscopic_moment):
        assert np.isnan(each).all()
    sweep = friction_motion(scene(B218, 17.8e3, np.array([0.0, 10_000.0]), radial), Traction())
    assert (sweep.status == "converged").all()
    assert np.isfinite(sweep.orbital_speed[1]).all()


@pytest.mark.parametrize(("friction", "slip", "share"), [(1.0, 0.01, 0.01125), (10.0, 0.001, 0.00112)])
def test_outer_control_is_the_limit_of_great_friction_in_flat_contacts(
    friction: float, slip: float, share: float
) -> None:
    found = balanced(friction_motion(THRUST, law(friction, slip, has_curvature=False), **MIDDLE))
    inner, outer = found.inner.traction[0], found.outer.traction[0]
    assert inner / (inner + outer) == pytest.approx(share, rel=5e-3)
    start = found.start
    assert abs(found.displacement[0] - start.displacement[0]) < 50.0 * share * 1e-6
    assert np.abs(found.outer.spin_speed[0]) < share * np.abs(found.inner.spin_speed[0])


def test_on_curved_contacts_the_inner_raceway_keeps_a_share() -> None:
    """However great friction is: no axis is without slip all over such a contact."""
    for friction in (1.0, 10.0, 100.0):
        found = balanced(friction_motion(THRUST, law(friction, 0.01), **MIDDLE))
        inner, outer = found.inner.traction[0], found.outer.traction[0]
        assert inner / (inner + outer) == pytest.approx(0.068, abs=5e-4)
        assert found.displacement[0] * 1e6 == pytest.approx(15.8, abs=0.05)


def test_pressed_the_other_way_it_is_the_mirror_image() -> None:
    """w is (wx, -wy, -wz) then, and forces across the grooves and along the axis turn round."""
    both_ways = replace(B218, kind="deep_groove")
    right, left = (balanced(friction_motion(scene(both_ways, load, 10_000), Traction())) for load in (17.8e3, -17.8e3))
    np.testing.assert_allclose(left.angular_velocity, right.angular_velocity * (1.0, -1.0, -1.0), rtol=1e-9)
    np.testing.assert_allclose(left.orbital_speed, right.orbital_speed, rtol=1e-10)
    for name in ("inner", "outer"):
        one, other = getattr(left, name), getattr(right, name)
        np.testing.assert_allclose(one.angle, -other.angle, rtol=1e-10)
        np.testing.assert_allclose(one.traction, -other.traction, rtol=1e-9)
        np.testing.assert_allclose(one.sideways, other.sideways, rtol=1e-8)
        np.testing.assert_allclose(one.heat, other.heat, rtol=1e-8)


def test_linear_friction_is_shared_as_the_loads_are() -> None:
    found = friction_motion(THRUST, LINEAR, radii=2, angles=4)
    ratio = found.inner.traction[0] / found.outer.traction[0]
    assert ratio == pytest.approx(found.inner.load[0] / found.outer.load[0], rel=1e-10)
    for side in (found.inner, found.outer):
        squares = side.semi_major_axis[0] ** 2 + side.semi_minor_axis[0] ** 2
        assert side.spin_moment[0] == pytest.approx(-5.0 * side.load[0] * squares / 5.0 * side.spin_speed[0], rel=1e-10)
        assert side.traction[0] == pytest.approx(-5.0 * side.load[0] * side.slip_across[0], rel=1e-10)


def test_turned_backwards_it_is_the_same() -> None:
    forth, back = (balanced(friction_motion(scene(B218, 17.8e3, n), Traction()), n * qs.rpm) for n in (1e4, -1e4))
    np.testing.assert_allclose(back.displacement, forth.displacement, rtol=1e-10)
    np.testing.assert_allclose(back.angular_velocity, forth.angular_velocity * (-1.0, 1.0, -1.0), rtol=1e-8)
    np.testing.assert_allclose(back.outer.sideways, -forth.outer.sideways, rtol=1e-8)


@pytest.mark.parametrize("carried", [True, False])
def test_radial_contact_rolls_in_its_plane(carried: bool) -> None:
    """No contact angle, so nothing turns the axis: wy = wz = T = X1 = 0."""
    of = replace(B218, free_contact_angle=0.0, kind="deep_groove", radial_interference=30 * 1e-6)
    held = qs.Operation(speed=SPEED, axial_displacement=0.0, radial_displacement_y=10e-6, **UPRIGHT)
    found = friction_motion(qs.Scene(of, held), Traction(), carried=carried)
    assert found.status == "converged"
    assert found.inner.load.min() > 100.0
    assert np.ptp(found.inner.load) > 100.0
    for each in (found.angular_velocity[..., 1:], found.outer.traction, found.outer.angle, found.inner.traction):
        assert np.abs(each).max() < 1e-9


def test_balls_balanced_at_their_azimuths_have_the_numbers_of_another_program() -> None:
    found = friction_motion(scene(B218, 8e3, 10_000, 4e3), Traction(), **MIDDLE, carried=False)
    np.testing.assert_allclose(found.displacement[:3] * 1e6, (-90.4821, 95.2756, -0.0361), atol=6e-5)
    np.testing.assert_allclose(found.inner.load[[0, 4, 8]], (1863.538, 423.222, 306.423), rtol=DIGITS)
    np.testing.assert_allclose(found.orbital_speed[[0, 4, 8]] / SPEED, (0.430012, 0.523140, 0.636233), rtol=DIGITS)
    np.testing.assert_allclose(np.degrees(found.attitude_angle[[0, 4, 8]]), (27.681, 11.272, 7.206), atol=6e-4)
    assert outward(found)[1] == pytest.approx(-1353, abs=150)  # what inertia does not allow


def test_drag_is_carried_by_friction_until_the_ball_skids() -> None:
    """The moment's work is heat and what drag takes; near the closed form's limit the orbit falls behind."""
    light, limit = scene(B218, 2e3, 10_000), 16.1824
    free = friction_motion(light, Traction())
    assert np.isinf(free.skid_margin).all()
    orbits = []
    for part in (0.0, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95):
        found = friction_motion(light, Traction(cage_drag=part * limit))
        assert found.status == "converged"
        lost = (found.drag * 0.5 * B218.pitch_diameter * found.orbital_speed).sum()
        assert -found.torque * SPEED == pytest.approx(found.heat + lost, rel=1e-9)
        np.testing.assert_allclose(found.inner.sideways + found.outer.sideways, -part * limit, rtol=1e-9, atol=1e-9)
        orbits.append(found.orbital_speed[0] / free.orbital_speed[0])
    assert (np.diff(orbits) < 0.0).all()
    assert found.inner.friction_use[0] == pytest.approx(0.9988, abs=1e-3)
    assert 1.0 < found.skid_margin[0] < 1.1
    assert friction_motion(light, Traction(cage_drag=1.05 * limit)).status == "not_converged"


def test_drag_of_the_oil_is_that_of_a_disc() -> None:
    """cd rho (pi D^2/8) v^2, as the reading of friction has it."""
    found = friction_motion(THRUST, Traction(drag_coefficient=0.4, fluid_density=90.0))
    speed = 0.5 * B218.pitch_diameter * found.orbital_speed
    np.testing.assert_allclose(found.drag, 0.4 * 90.0 * np.pi / 8.0 * B218.ball_diameter**2 * speed**2, rtol=1e-12)
    back = friction_motion(scene(B218, 17.8e3, -10_000), Traction(drag_coefficient=0.4, fluid_density=90.0))
    np.testing.assert_allclose(back.drag, -found.drag, rtol=1e-9)


def test_margins_say_how_far_it_is_from_outer_control() -> None:
    fast, slow = (friction_motion(scene(B218, 17.8e3, n), Traction()) for n in (10_000, 3000))
    assert fast.gyroscopic_margin[0] == pytest.approx(0.07 / 0.0690, rel=2e-3)
    assert slow.gyroscopic_margin[0] > 8.0
    apart = [abs(each.displacement[0] / each.start.displacement[0] - 1.0) for each in (fast, slow)]
    assert apart[0] > 0.3
    assert apart[1] < 0.01
    assert np.isnan(friction_motion(THRUST, LINEAR, radii=2, angles=4).inner.friction_use).all()


def test_orbits_may_be_of_the_balls_own_radii() -> None:
    """The radial balance of a ball is that of the radius at which it runs."""
    displaced = replace(THRUST, ball_effects=BOTH, raceway_control=OUTER, orbit_radius="displaced")
    found = balanced(friction_motion(displaced, Traction()))
    outer, inner = found.outer, found.inner
    inward = outer.load * np.cos(outer.angle) + outer.traction * np.sin(outer.angle)
    outward_force = inner.load * np.cos(inner.angle) + inner.traction * np.sin(inner.angle)
    np.testing.assert_allclose(inward - outward_force, found.centrifugal_force, rtol=1e-9)
    assert abs(found.displacement[0] / friction_motion(THRUST, Traction()).displacement[0] - 1.0) > 1e-4


def test_random_bearings_are_solved() -> None:
    """6 to 25 mm, 15 to 40 degrees, dn 0.3 to 2 million, 0.1 to 4 N/mm^2: as the dimensions of catalogues go."""
    rng = np.random.default_rng(2)
    for _ in range(25):
        diameter, angle = rng.uniform(6.0, 25.0), rng.uniform(15.0, 40.0)
        pitch = diameter * rng.uniform(4.5, 9.0)
        balls = int(np.pi * pitch / diameter / 1.2)
        of = bearing(balls, diameter, pitch, *rng.uniform(0.515, 0.54, 2), angle)
        load = balls * 10.0 ** rng.uniform(-1.0, 0.6) * diameter**2 * np.sin(np.radians(angle))
        revolutions = rng.uniform(0.3e6, 2e6) / pitch
        traction = Traction(rng.uniform(0.03, 0.1), 10.0 ** rng.uniform(-2.0, -0.3))
        balanced(friction_motion(scene(of, load, revolutions), traction), revolutions * qs.rpm)


def test_cases_are_solved_one_by_one() -> None:
    loads = np.array([[5e3, 17.8e3, 40e3]])
    many = friction_motion(scene(B218, loads, 10_000), Traction())
    assert many.status.shape == (1, 3)
    assert many.angular_velocity.shape == (1, 3, 16, 3)
    one = friction_motion(THRUST, Traction())
    np.testing.assert_array_equal(many.angular_velocity[0, 1], one.angular_velocity)
    np.testing.assert_array_equal(many.torque[0, 1], one.torque)


def test_one_scene_takes_a_band_of_friction() -> None:
    band = friction_motion(THRUST, Traction(np.array([0.03, 0.07, 0.1])))
    assert band.displacement.shape == (3, 5)
    assert band.start.displacement.shape == (5,)
    one = friction_motion(THRUST, Traction(0.1))
    np.testing.assert_array_equal(band.outer.heat[2], one.outer.heat)
    np.testing.assert_array_equal(band.outer.friction_use[2], one.outer.friction_use)
    np.testing.assert_array_equal(band.gyroscopic_margin[2], one.gyroscopic_margin)
    np.testing.assert_array_equal(motion_stiffness(band)[2], motion_stiffness(one))
    both = friction_motion(scene(B218, np.array([[9e3], [17.8e3]]), 10_000), Traction(np.array([0.03, 0.07, 0.1])))
    np.testing.assert_array_equal(both.displacement[1], band.displacement)
    with pytest.raises(ValueError, match="broadcast"):
        friction_motion(scene(B218, np.array([9e3, 17.8e3]), 10_000), Traction(np.array([0.03, 0.07, 0.1])))


def test_cases_may_have_different_numbers_of_balls() -> None:
    some = friction_motion(scene(replace(B218, ball_count=np.array([12, 16])), 8e3, 10_000, 2e3), Traction())
    few = friction_motion(scene(replace(B218, ball_count=12), 8e3, 10_000, 2e3), Traction())
    np.testing.assert_array_equal(some.orbital_speed[0, :12], few.orbital_speed)
    assert np.isnan(some.orbital_speed[0, 12:]).all()
    assert some.heat[0] == pytest.approx(float(few.heat), rel=1e-14)
    assert some.cage_speed[0] == pytest.approx(float(few.cage_speed), rel=1e-14)
    np.testing.assert_array_equal(motion_stiffness(some)[0], motion_stiffness(few))
    np.testing.assert_array_equal(motion_rates(some)[0, :12], motion_rates(few))


def test_what_has_no_equilibrium_has_no_motion() -> None:
    found = friction_motion(scene(B218, np.array([-5e3, 17.8e3]), 10_000), Traction())
    assert list(found.status) == ["no_equilibrium", "converged"]
    assert found.reason[0] == found.start.reason[0] != ""
    assert found.reason[1] == ""
    assert np.isnan(found.angular_velocity[0]).all()
    assert np.isnan(found.heat[0])
    assert np.isfinite(found.heat[1])


def test_contacts_outside_their_grooves_are_no_equilibrium() -> None:
    """On the open side of an angular-contact bearing, over the shoulder of any."""
    case = friction_motion(THRUST, Traction()).inside.cases[0]
    contacts = np.zeros((16, 2, traction_ball.CONTACT_QUANTITIES))
    contacts[:, 0, traction_ball.LOAD] = 1e-6
    angles = {0.7: 0, -0.1: admissibility.OPEN_SIDE, 1.7: admissibility.OVER_SHOULDER}
    for angle, expected in angles.items():
        contacts[:, 0, traction_ball.SINE], contacts[:, 0, traction_ball.COSINE] = -np.sin(0.7), -np.cos(0.7)
        contacts[3, 0, traction_ball.SINE], contacts[3, 0, traction_ball.COSINE] = -np.sin(angle), -np.cos(angle)
        assert outside_grooves(case, contacts) == expected
        contacts[3, 0, traction_ball.LOAD] = 0.0
        assert outside_grooves(case, contacts) == 0
        contacts[3, 0, traction_ball.LOAD] = 1e-6
    deep = friction_motion(scene(replace(B218, kind="deep_groove"), 17.8e3, 10_000), Traction()).inside.cases[0]
    contacts[3, 0, traction_ball.SINE], contacts[3, 0, traction_ball.COSINE] = np.sin(0.1), -np.cos(0.1)
    assert outside_grooves(deep, contacts) == 0


@pytest.mark.parametrize(
    ("changed", "field"),
    [
        ({"operation": qs.Operation(axial_load=1e3, speed=SPEED, outer_speed=SPEED)}, "operation.speed"),
        ({"hertz_angle": "actual"}, "hertz_angle"),
        ({"operation": qs.Operation(speed=SPEED, radial_load_y=1.0, moment_z=0.0, tilt_y=0.0)}, "operation.tilt_z"),
        ({"operation": qs.Operation(speed=SPEED, axial_load=1e3, tilt_y=1e-3, tilt_z=0.0)}, "operation.tilt_y"),
        (
            {
                "operation": qs.Operation(speed=SPEED, axial_load=1e4, radial_load_y=1e3, **UPRIGHT),
                **{"ball_effects": BOTH, "raceway_control": OUTER, "orbit_radius": "displaced"},
            },
            "orbit_radius",
        ),
        ({"ring_effects": (qs.BallDiameterDeviations(np.full(16, 1e-6)),)}, "unequal_balls"),
        ({"ring_effects": (qs.SeatsOutOfRound(outer_two_lobe_amplitude=1e-6),)}, "seats_out_of_round"),
    ],
)
def test_what_is_not_known_is_refused_by_name(changed: dict[str, Any], field: str) -> None:
    with pytest.raises(SceneError) as caught:
        friction_motion(replace(THRUST, **changed), Traction())
    assert [each.field for each in caught.value.errors] == [field]


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({"friction_coefficient": 0.31}, "friction_coefficient"),
        ({"slip_speed": 0.0}, "slip_speed"),
        ({"law": "eyring"}, "law"),
        ({"cage_drag": -1.0}, "cage_drag"),
        ({"drag_coefficient": 0.4}, "fluid_density"),
        ({"drag_coefficient": 0.4, "fluid_density": 1e4}, "fluid_density"),
    ],
)
def test_laws_out_of_range_are_refused(given: dict[str, Any], field: str) -> None:
    with pytest.raises(SceneError) as caught:
        Traction(**given)
    assert [each.field for each in caught.value.errors] == [f"traction.{field}"]


def test_it_is_no_part_of_other_solutions() -> None:
    """Effects of the scene are not changed by it, and its start is what `solve` gives."""
    asked = replace(THRUST, ball_effects=BOTH, raceway_control=OUTER)
    np.testing.assert_array_equal(friction_motion(asked, Traction()).start.displacement, qs.solve(asked).displacement)
