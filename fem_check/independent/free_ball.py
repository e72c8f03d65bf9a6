"""A ball between its grooves by the laws of Newton and Euler alone, seen from where the outer ring rests.

Given are the drawing, how fast the inner ring turns, and how surfaces press and rub: grooves are tori, a ball
penetrates them along the normal at the nearest point, Hertz's force answers that, and friction the slip. **No
centrifugal force, no gyroscopic moment and no raceway control is put in**: what they describe has to come out.

x is the bearing's axis, e_r points from it to the ball. A vector in a plane is a complex number: across the axis
y + iz, in the plane of axis and ball x + ir. There n points from the ball's centre to the contact, t = -i n is square
to it, and u = e_r x e_x completes t, u, n; within the contact's plane a vector is t + iu. Arrays are (case,), (2, case)
with the inner contacts first, or (2, case, point): cases run side by side.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fem_check.independent import references
from fem_check.independent.contact_problem import Array
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.groove import RACES
from fem_check.independent.slip_friction import Coulomb, EllipsePoints, Linear

X, YZ, ALONG, ACROSS, RING, RING_SPEED = 0, 1, slice(2, 4), slice(4, 6), 6, 7
"""Rows of a state: the ball's place along and across the axis; its velocity and angular velocity along the axis, the
same across it; the inner ring's place and speed along it."""


@dataclass(frozen=True)
class FreeBallCase:
    """One ball of one bearing at one speed and load."""

    drawing: BearingDrawing
    speed: float
    """Of the inner ring [rad/s]."""
    thrust: float | None = None
    """On the inner ring, for each ball [N]; None: the ring is held where it starts."""
    off_centre: complex = 0.0
    """Of the inner ring's axis [m]."""


@dataclass(frozen=True)
class GrooveContacts:
    """The contacts of a state; arrays (2, case)."""

    normal: Array
    """n."""
    outward: Array
    """e_r, across the axis."""
    load: Array
    """Hertz's [N]."""
    pressing: Array
    """With damping [N]."""
    friction: Array
    """On the ball, t + iu [N]."""
    moment: tuple[Array, Array]
    """Of friction on the ball about its centre [N m]: t + iu, and about n."""
    heat: Array
    """[W]."""

    @cached_property
    def on_ball(self) -> tuple[Array, Array]:
        """What each contact does to the ball, along and across the axis; shapes (2, 2, case): forces, then torques."""
        in_contact, about_normal = self.moment
        plane = np.array([-self.pressing - 1j * self.friction.real, about_normal - 1j * in_contact.real]) * self.normal
        across = (plane.imag - 1j * np.array([self.friction.imag, in_contact.imag])) * self.outward
        return plane.real, across

    @property
    def on_rings(self) -> tuple[Array, Array]:
        """Forces on the inner and the outer ring, along the axis and across it; shapes (2, case)."""
        along, across = self.on_ball
        return -along[0], -across[0]


@dataclass(frozen=True)
class FreeBalls:
    """Cases that run side by side, under one law of friction."""

    cases: Sequence[FreeBallCase]
    law: Coulomb | Linear
    points: EllipsePoints
    damping: float = 200.0
    """Of a contact along its normal [N s/m]. It and the ring's mass shape the way to a steady motion, no more."""
    ring_mass: float = 0.2
    """Of the inner ring, for each ball [kg]."""

    @property
    def drawings(self) -> list[BearingDrawing]:
        """Of the cases."""
        return [case.drawing for case in self.cases]

    @cached_property
    def speeds(self) -> Array:
        """Of both rings [rad/s]; shape (2, case)."""
        inner = np.array([case.speed for case in self.cases])
        return np.stack([inner, np.zeros_like(inner)])

    @cached_property
    def _inertia(self) -> Array:
        """Mass and moment of inertia; shape (2, case)."""
        return np.array([[each.ball_mass for each in self.drawings], [each.ball_inertia for each in self.drawings]])

    @cached_property
    def _ball_radius(self) -> Array:
        return np.array([0.5 * each.ball_diameter for each in self.drawings])

    @cached_property
    def _ring(self) -> tuple[Array, Array]:
        """What pushes the inner ring, and over what it weighs; nothing moves one that is held."""
        held = np.array([case.thrust is None for case in self.cases])
        return np.array([case.thrust or 0.0 for case in self.cases]), np.where(held, 0.0, 1.0 / self.ring_mass)

    @cached_property
    def _centres(self) -> tuple[Array, Array]:
        """Of both rings, along the axis and across; the inner one's place comes on top."""
        offset = np.array([each.touching_offset for each in self.drawings])
        off_centre = np.array([case.off_centre for case in self.cases], dtype=complex)
        return np.stack([offset, 0.0 * offset]), np.stack([off_centre, 0.0 * off_centre])

    @cached_property
    def _grooves(self) -> tuple[Array, Array]:
        """Radius of the circle of groove centres, and length of a contact line that just touches."""
        of = self.drawings
        circle = np.array(
            [[each.inner_groove_centre_radius for each in of], [each.outer_groove_centre_radius for each in of]]
        )
        radius = np.array([[each.inner_groove_radius for each in of], [each.outer_groove_radius for each in of]])
        return circle, radius - self._ball_radius

    @cached_property
    def _hertz(self) -> tuple[Array, Array, Array]:
        """Q/delta^1.5, a/Q^(1/3) and b/Q^(1/3), at the free contact angle."""
        ellipses = [[references.ellipse(each.groove(race).problem(1.0)) for each in self.drawings] for race in RACES]
        sizes = np.array([[(c.approach**-1.5, c.semi_major_axis, c.semi_minor_axis) for c in row] for row in ellipses])
        return sizes[..., 0], sizes[..., 1], sizes[..., 2]

    @cached_property
    def _shared_radius(self) -> Array:
        """Of the surface that ball and groove share, across the groove [m]: each gives way by its compliance."""
        share = np.array([of.ball.compliance / (of.ball.compliance + of.ring.compliance) for of in self.drawings])
        groove = self._grooves[1] + self._ball_radius
        return np.asarray(1.0 / ((1.0 - share) / self._ball_radius + share / groove))

    @cached_property
    def _places(self) -> Array:
        """Of the points, over Q^(1/3): a X + i b Y."""
        _, a, b = self._hertz
        return np.asarray(a[..., None] * self.points.along + 1j * b[..., None] * self.points.across)

    def contacts(self, state: Array) -> GrooveContacts:
        """Of a state."""
        (centre_x, centre_yz), (circle, touching), ring_speed = self._centres, self._grooves, self.speeds
        # Where: the nearest points on the circles of groove centres, and the normals through them.
        out = state[YZ] - centre_yz
        reach = np.abs(out)
        outward = out / reach
        line = state[X].real - centre_x + 1j * (reach - circle)
        line[0] -= state[RING].real
        length = np.abs(line)
        normal = line / length
        pressed = np.maximum(length - touching, 0.0)
        load = self._hertz[0] * pressed * np.sqrt(pressed)
        # How the ball's centre moves, and how the ball turns, against each ring.
        across = state[ACROSS, None] * outward.conj()
        plane = state[ALONG, None].real + 1j * across.real
        plane[0, 0] -= state[RING_SPEED].real
        plane[1] -= ring_speed
        plane *= normal.conj()
        centre, turning = -plane.imag - 1j * across.imag
        friction, moment, heat = self._rubbing(load, centre + 1j * ring_speed * reach, turning, plane[1].real)
        pressing = np.where(load > 0.0, np.maximum(load + self.damping * plane[0].real, 0.0), 0.0)
        return GrooveContacts(normal, outward, load, pressing, friction, moment, heat)

    def _rubbing(
        self, load: Array, centre: Array, turning: Array, spin: Array
    ) -> tuple[Array, tuple[Array, Array], Array]:
        """Friction's force, moments and heat, as the ball's centre moves (t + iu), it turns (t + iu) and spins."""
        size = np.cbrt(load)
        height = self._height(size)
        places = size[..., None] * self._places
        slip = centre[..., None] + 1j * (spin[..., None] * places - turning[..., None] * height)
        square = slip.real**2 + slip.imag**2
        each = -self.law.over_speed(square) * (load[..., None] * self.points.weight)
        force = each * slip
        about_normal = np.einsum("...p,...p->...", places.conj(), force).imag
        moment = 1j * np.einsum("...p,...p->...", height, force), about_normal
        return force.sum(axis=-1), moment, -np.einsum("...p,...p->...", each, square)

    def _height(self, size: Array) -> Array:
        """Of the surface that ball and groove share, over the ball's centre; it meets the ball at their ends."""
        radius, ball = self._shared_radius, self._ball_radius
        if not self.points.curved:
            return np.broadcast_to(ball[:, None], self._places.shape)
        end = (self._hertz[1] * size) ** 2
        rise = np.sqrt(ball * ball - end) - np.sqrt(radius * radius - end)
        return np.asarray(
            np.sqrt((radius * radius)[..., None] - (size[..., None] * self._places.real) ** 2) + rise[..., None]
        )

    def rates(self, state: Array) -> Array:
        """Of a state. A sphere's angular momentum lies along its angular velocity, however it is turned."""
        contacts = self.contacts(state)
        (along, across), (push, lightness) = contacts.on_ball, self._ring
        change = np.empty_like(state)
        change[X], change[YZ], change[RING] = state[2], state[4], state[RING_SPEED]
        change[ALONG], change[ACROSS] = along.sum(axis=1) / self._inertia, across.sum(axis=1) / self._inertia
        change[RING_SPEED] = (push + contacts.on_rings[0][0]) * lightness
        return change

    def start(self, place: Array, orbit: Array, rotation: Array, ring: Array) -> Array:
        """A state of balls that go round, in the plane of x and y, and rings that do not move along their axis; shape
        (8, case).

        Args:
            place: of the ball's centre, x + ir [m].
            orbit: its speed round the axis [rad/s].
            rotation: the ball's angular velocity as seen from there, x + ir [rad/s].
            ring: the inner ring's displacement [m].
        """
        still = 0.0 * place
        going, turning = 1j * orbit * place.imag, rotation.real + orbit
        return np.array([place.real, place.imag, still, turning, going, rotation.imag, ring, still])
