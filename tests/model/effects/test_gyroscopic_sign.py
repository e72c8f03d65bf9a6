"""The sign and the size of the gyroscopic moment, proved from rigid-body mechanics and from no formula for it.

A solved ball is taken as a rigid sphere. Its spin is what it must be to roll on both rings without slip at the two
contact points and without spin at the controlling one: velocities by cross products, nothing else. Its angular momentum
is carried round with the orbit; the moment that this takes must be the moment of the contact forces, friction included,
about the ball's centre. The friction is read off the ball's own equilibrium of forces across the contacts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from tests.qsbearing.mechanics import AXIS, vectors
from tests.qsbearing.scenes import BOTH_HARRIS, INNER, PER_BALL, SPINDLE, solved, turning

FIVE = {"axial_load": 14e3, "radial_load_y": 2.5e3, "radial_load_z": 1e3, "moment_y": 25.0, "moment_z": -80.0}
SMALL = {"axial_load": 1.5e3, "radial_load_y": 200.0, "radial_load_z": 150.0, "moment_y": 2.0, "moment_z": -3.0}
SCENES = {
    "the classic case": turning(10000, axial_load=17.8e3),
    "all channels": turning(8000, **FIVE),
    "backwards": turning(-8000, **FIVE),
    "inner control": turning(5000, control=INNER, **FIVE),
    "inner control, halved share": turning(5000, control=INNER, effects=BOTH_HARRIS, **FIVE),
    "mixed control": turning(2300, control=PER_BALL, **FIVE),
    "outer ring turning": turning(0, outer_rpm=6000, **FIVE),
    "counter-rotation": turning(7000, outer_rpm=-4000, **FIVE),
    "hybrid spindle": turning(24000, SPINDLE, **SMALL),
    "gyroscopic moment alone": turning(9000, effects=(qs.GyroscopicMoment(),), **FIVE),
}
every_scene = pytest.mark.parametrize("name", list(SCENES))


@dataclass(frozen=True)
class Ball:
    """One ball as a rigid body; vectors in space."""

    orbit: float
    """Angular speed of its centre about the bearing axis."""
    rotation: NDArray
    """Its angular velocity."""
    radius: float
    mass: float
    radial: NDArray
    inner_point: NDArray
    """Of contact, from the ball's centre."""
    outer_point: NDArray

    @property
    def angular_momentum(self) -> NDArray:
        """About its centre: of a solid sphere, 2/5 m r^2 in any direction."""
        return 0.4 * self.mass * self.radius**2 * self.rotation


def rolling_ball(scene: qs.Scene, radial: NDArray, normals: dict[str, NDArray], control: str) -> Ball:
    """Orbit and angular velocity from the conditions of rolling, as linear equations in four unknowns."""
    bearing, operation = scene.bearing, scene.operation
    radius = 0.5 * float(np.asarray(bearing.ball_diameter))
    centre = 0.5 * float(np.asarray(bearing.pitch_diameter)) * radial
    mass = float(np.asarray(bearing.ball_material.density)) * 4.0 / 3.0 * np.pi * radius**3
    speeds = {"inner": float(np.asarray(operation.speed)), "outer": float(np.asarray(operation.outer_speed))}
    points = {"inner": -radius * normals["inner"], "outer": radius * normals["outer"]}
    # Unknowns: orbit, and the components of the angular velocity along the axis, the radius and the tangent.
    basis = (AXIS, radial, np.cross(AXIS, radial))
    rows, sides = [], []
    for race, point in points.items():
        # velocity of the ball's surface: orbit of its centre, and its rotation about it
        columns = [np.cross(AXIS, centre), *(np.cross(direction, point) for direction in basis)]
        rows += list(np.stack(columns, axis=-1))
        sides += list(np.cross(speeds[race] * AXIS, centre + point))
    normal = normals[control]
    rows.append(np.array([0.0, *(direction @ normal for direction in basis)]))  # no spin at the controlling contact
    sides.append(speeds[control] * (AXIS @ normal))
    answer, _, rank, _ = np.linalg.lstsq(np.array(rows), np.array(sides), rcond=None)
    assert rank == 4
    assert np.array(rows) @ answer == pytest.approx(np.array(sides), abs=1e-9 * np.abs(sides).max())
    return Ball(
        orbit=float(answer[0]),
        rotation=np.asarray(answer[1:] @ np.array(basis)),
        radius=radius,
        mass=mass,
        radial=radial,
        inner_point=points["inner"],
        outer_point=points["outer"],
    )


def rigid_balls(solution: qs.Solution) -> list[Ball]:
    """Every ball of a single case."""
    v = vectors(solution)
    assert solution.raceway_control is not None
    return [
        rolling_ball(
            solution.scene, v.radial[j], {"inner": v.inner_normal[j], "outer": v.outer_normal[j]}, str(control)
        )
        for j, control in enumerate(solution.raceway_control)
    ]


def rate_of_angular_momentum(ball: Ball) -> NDArray:
    """By differences: the angular momentum a moment later and a moment before, carried round with the orbit."""
    step = 1e-4

    def carried(angle: float) -> NDArray:
        c, s = np.cos(angle), np.sin(angle)
        return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]) @ ball.angular_momentum

    return ball.orbit * (carried(step) - carried(-step)) / (2.0 * step)


@every_scene
def test_the_contacts_supply_the_change_of_angular_momentum(name: str) -> None:
    """dH/dt = sum of (point - centre) x force over both contacts, for every ball, as vectors.

    Once with the friction of the moment reported; once with the friction that each ball's equilibrium of forces alone
    demands: what loads along the normals and the centrifugal force leave over.
    """
    solution = solved(SCENES[name])
    v = vectors(solution)
    pitch = 0.5 * float(np.asarray(solution.scene.bearing.pitch_diameter))
    for j, ball in enumerate(rigid_balls(solution)):
        moment = np.cross(ball.inner_point, v.inner_pull[j]) + np.cross(ball.outer_point, v.outer_pull[j])
        rate = rate_of_angular_momentum(ball)
        size = np.linalg.norm(rate)
        assert size > 1e-4  # N m: there is something to carry
        # Differences over 1e-4 rad are right to 2e-9; the normals' forces pass through the centre.
        assert moment == pytest.approx(rate, abs=1e-7 * size)

        n_i, n_o = v.inner_normal[j], v.outer_normal[j]
        if np.linalg.norm(np.cross(n_i, n_o)) < 0.05:
            continue  # nearly in line: the two directions tell nothing apart
        left = solution.inner.load[j] * n_i - solution.outer.load[j] * n_o
        if solution.scene.centrifugal_force is not None:
            left = left + ball.mass * pitch * ball.orbit**2 * ball.radial
        # Two friction forces, across either contact in the ball's plane, cancel what is left.
        across_i, across_o = np.cross(v.tangent[j], n_i), np.cross(v.tangent[j], n_o)
        (push_i, push_o), *_ = np.linalg.lstsq(np.stack([across_i, across_o], axis=-1), -left, rcond=None)
        moment = np.cross(ball.inner_point, push_i * across_i) + np.cross(ball.outer_point, push_o * across_o)
        # The friction is a few per cent of loads known to 1e-12 of the largest: 1e-6 leaves room.
        assert moment @ v.tangent[j] == pytest.approx(rate @ v.tangent[j], rel=1e-6)


@every_scene
def test_orbit_and_rotation_are_those_of_rolling(name: str) -> None:
    """Reported speeds against the rolling sphere: the orbit, and the rotation in the frame that goes round with it."""
    solution = solved(SCENES[name])
    balls = rigid_balls(solution)
    fastest = max(abs(ball.orbit) for ball in balls)
    assert solution.orbital_speed == pytest.approx(np.array([ball.orbit for ball in balls]), abs=1e-11 * fastest)
    relative = np.array([np.linalg.norm(ball.rotation - ball.orbit * AXIS) for ball in balls])
    assert solution.rotation_speed is not None
    assert np.abs(solution.rotation_speed) == pytest.approx(relative, rel=1e-10)


def test_a_ball_under_a_turning_inner_ring_rolls_backwards() -> None:
    """Its rotation against the orbit, omega_R and Mg negative; forwards and positive under a turning outer ring."""
    for scene, sign in ((SCENES["the classic case"], -1.0), (SCENES["outer ring turning"], 1.0)):
        solution = solved(scene)
        for j, ball in enumerate(rigid_balls(solution)):
            assert np.sign((ball.rotation - ball.orbit * AXIS) @ AXIS) == sign * np.sign(ball.orbit)
            assert solution.rotation_speed is not None
            assert np.sign(solution.rotation_speed[j]) == sign
            assert solution.gyroscopic_moment is not None
            assert np.sign(solution.gyroscopic_moment[j]) == sign
