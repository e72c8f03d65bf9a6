"""What a solved bearing must satisfy, from its drawing alone: geometry, rolling, equilibrium of balls and inner ring.

Vectors, not the model's scalar equations. A ball's plane has the unit vectors e_x along the bearing axis and e_r from
it to the ball; e_t = e_x cross e_r is the ball's way round. Both normals (sin alpha, cos alpha) in (e_x, e_r) point
outward: from the inner contact to the ball's centre, and from there to the outer contact. Arrays have the shape
(ball, ...).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fem_check.contact_problem import Array
from fem_check.drawing import Drawing

AXIS = np.array([1.0, 0.0, 0.0])


@dataclass(frozen=True)
class Contacts:
    """The contacts of all balls with one raceway, as a solution reports them; shape (ball,)."""

    load: Array
    """[N]"""
    angle: Array
    """[rad]"""
    approach: Array
    """[m]"""

    @property
    def normal(self) -> Array:
        """In (e_x, e_r); shape (ball, 2)."""
        return np.stack([np.sin(self.angle), np.cos(self.angle)], axis=1)


def closure(drawing: Drawing, inner: Contacts, outer: Contacts, azimuth: Array, moved: Array, lever: float) -> Array:
    """How far both contact lines miss the inner groove's centre [m]; shape (ball, 2).

    Args:
        moved: displacement of the inner ring, x, y, z [m], tilts about y and z [rad].
        lever: radius at which a tilt moves the groove's centre [m].
    """
    free = np.array([np.sin(drawing.free_contact_angle), np.cos(drawing.free_contact_angle)])
    radii = (drawing.inner_groove_radius, drawing.outer_groove_radius)
    lengths = [radius - 0.5 * drawing.ball_diameter for radius in radii]
    radial = np.stack([np.zeros_like(azimuth), np.cos(azimuth), np.sin(azimuth)], axis=1)
    # A small rotation moves the groove's centre, at lever * e_r from the ring's, by rotation cross position.
    shift = moved[:3] + np.cross(np.array([0.0, *moved[3:]]), lever * radial)
    centre = sum(lengths) * free + np.stack([shift[:, 0], np.sum(shift * radial, axis=1)], axis=1)
    lines = [
        (length + contacts.approach)[:, None] * contacts.normal
        for length, contacts in zip(lengths, (inner, outer), strict=True)
    ]
    return np.asarray(sum(lines) - centre)


def rolling(
    drawing: Drawing, inner: Contacts, outer: Contacts, inner_speed: float, outer_speed: float, control: Array
) -> tuple[Array, Array]:
    """Orbital speed (ball,) and the balls' rotation about e_x and e_r (ball, 2), seen from the orbit [rad/s].

    Three conditions: no slip at the centre of either contact, and no spin about the normal of the raceway in control.
    """
    radius, pitch = 0.5 * drawing.ball_diameter, 0.5 * drawing.pitch_diameter
    speed = np.empty((len(control), 3))
    for ball, (i, o) in enumerate(zip(inner.normal, outer.normal, strict=True)):
        # Unknowns: orbit, rotation about e_x, rotation about e_r. The surfaces' speeds along e_t agree.
        rows = [
            [pitch + radius * o[1], radius * o[1], -radius * o[0]],
            [pitch - radius * i[1], -radius * i[1], radius * i[0]],
        ]
        right = [outer_speed * rows[0][0], inner_speed * rows[1][0]]
        normal, ring = (o, outer_speed) if control[ball] == "outer" else (i, inner_speed)
        rows.append([normal[0], normal[0], normal[1]])
        right.append(ring * normal[0])
        speed[ball] = np.linalg.solve(np.array(rows), np.array(right))
    return speed[:, 0], speed[:, 1:]


def centrifugal_force(drawing: Drawing, orbit: Array) -> Array:
    """Outward at the pitch circle [N]."""
    return np.asarray(drawing.ball_mass * 0.5 * drawing.pitch_diameter * orbit**2)


def gyroscopic_moment(drawing: Drawing, orbit: Array, rotation: Array) -> Array:
    """What turns the ball's angular momentum round with the orbit, about e_t [N m]: e_x orbit cross J rotation."""
    return np.asarray(drawing.ball_inertia * orbit * rotation[:, 1])


def friction(contacts: Contacts, moment: Array, share: Array, drawing: Drawing, outward: bool) -> Array:
    """Friction on the ball that gives its share of a moment about e_t, in (e_x, e_r) [N]; shape (ball, 2).

    Args:
        moment: about e_t, from both contacts together.
        share: of this contact, 1 being all of it.
        outward: whether the contact lies at the end of its normal (outer) or at its beginning (inner).
    """
    sine, cosine = contacts.normal.T
    arm = 0.5 * drawing.ball_diameter * (1.0 if outward else -1.0)
    # At arm * (sin, cos), a force f (-cos, sin) has the moment arm * f about e_t.
    return np.asarray((share * moment / arm)[:, None] * np.stack([-cosine, sine], axis=1))


def on_ball(inner: Contacts, outer: Contacts, friction_forces: Array, centrifugal: Array) -> Array:
    """Sum of the forces on each ball in (e_x, e_r) [N]; zero in equilibrium."""
    total = inner.load[:, None] * inner.normal - outer.load[:, None] * outer.normal + friction_forces
    total[:, 1] += centrifugal
    return np.asarray(total)


def on_ring(drawing: Drawing, inner: Contacts, friction_on_ball: Array, azimuth: Array, lever: float) -> Array:
    """The load that holds the inner ring against its balls: x, y, z [N], moments about y and z [N m].

    Each force acts at its contact, a groove radius from the groove's centre, which is `lever` from the axis.
    """
    radial = np.stack([np.zeros_like(azimuth), np.cos(azimuth), np.sin(azimuth)], axis=1)

    def in_space(plane: Array) -> Array:
        return np.asarray(plane[:, :1] * AXIS + plane[:, 1:] * radial)

    forces = in_space(inner.load[:, None] * inner.normal + friction_on_ball)
    points = lever * radial - drawing.inner_groove_radius * in_space(inner.normal)
    moments = np.cross(points, forces).sum(axis=0)
    return np.array([*forces.sum(axis=0), moments[1], moments[2]])
