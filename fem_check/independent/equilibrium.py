"""The balance of balls and inner ring, from the drawing alone: geometry, rolling, inertia, friction.

Vectors, not the model's scalar equations. A ball's plane has the unit vectors e_x along the bearing axis and e_r from
it to the ball; e_t = e_x cross e_r is the ball's way round. Both normals (sin alpha, cos alpha) in (e_x, e_r) point
outward: from the inner contact to the ball's centre, and from there to the outer contact. Arrays have the shape
(ball, ...).

What no mechanics settles follows the model's documented hypotheses: raceway control, shares of the gyroscopic moment,
and how a ball goes round that has lost its inner raceway.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fem_check.independent import references
from fem_check.independent.contact_problem import Array
from fem_check.independent.drawing import BearingDrawing

AXIS = np.array([1.0, 0.0, 0.0])
LOSING = 1.0 / 50.0
"""Part of the inner line's free length within which a ball that loses that raceway goes over to rolling as with equal
contact angles: a convention of the model."""
SHAPES = 25
"""Angles at which contacts are evaluated where each has its own; between them Chebyshev's polynomials, whose error
falls like 5^-n at the most (the next pole lies where the raceway's radius would vanish)."""


@dataclass(frozen=True)
class BalanceTerms:
    """What is asked for: the terms of the balance, and the hypotheses and forms in them."""

    centrifugal: bool = False
    gyroscopic: bool = False
    control: str | None = None
    """outer, inner, per_ball or minimum_dissipation; None without inertia."""
    harris_shares: bool = False
    friction_coefficient: float | None = None
    displaced_orbit: bool = False
    hertz_angle: str = "free"
    hertz_form: str = "exact"
    pitch_circle_lever: bool = False


def own_angle(hertz_angle: str, angle: float) -> float | None:
    """The contact angle at which a contact's curvatures are taken; None: the free one."""
    return {"free": None, "zero": 0.0, "actual": angle}[hertz_angle]


@dataclass(frozen=True)
class BallRow:
    """One row of balls between its rings, and how they turn."""

    drawing: BearingDrawing
    """In operation, before loads act."""
    model: BalanceTerms
    azimuth: Array
    inner_speed: float = 0.0
    outer_speed: float = 0.0
    touching_offset: float = 0.0
    """Axially between the groove centres at the zero of the displacement [m]."""
    diameters: Array | None = None
    """Of unequal balls [m]."""
    lobes: Array | None = None
    """By how much farther out the inner groove stands at each ball than the outer one, of grooves out of round [m]."""
    over_hertz: tuple[float, float] = (1.0, 1.0)
    """Of the inner and the outer contacts' approaches: 1 for half-spaces."""

    @cached_property
    def balls(self) -> list[BearingDrawing]:
        """The drawing as each ball has it."""
        if self.diameters is None:
            return [self.drawing] * len(self.azimuth)
        return [self.drawing.with_ball(float(each)) for each in self.diameters]

    @cached_property
    def radial(self) -> Array:
        """e_r; shape (ball, 3)."""
        return np.stack([np.zeros_like(self.azimuth), np.cos(self.azimuth), np.sin(self.azimuth)], axis=1)

    @property
    def turns(self) -> bool:
        """Whether any ring does."""
        return self.inner_speed != 0.0 or self.outer_speed != 0.0

    @property
    def lever(self) -> float:
        """Radius at which a tilt moves the groove's centre, and at which the normal force acts [m]."""
        of = self.drawing
        return 0.5 * of.pitch_diameter if self.model.pitch_circle_lever else of.inner_groove_centre_radius

    @cached_property
    def by_ring(self) -> Array:
        """By how much the ring's five channels move each groove centre in (e_x, e_r); shape (ball, 2, 5)."""
        moves = []
        for channel in np.eye(5):
            # A small rotation moves the groove's centre, at lever * e_r from the ring's, by rotation cross position.
            shift = channel[:3] + np.cross(np.array([0.0, *channel[3:]]), self.lever * self.radial)
            moves.append(np.stack([shift[:, 0], np.sum(shift * self.radial, axis=1)], axis=1))
        return np.stack(moves, axis=2)

    def groove_centres(self, moved: Array) -> Array:
        """From the outer to the inner groove's centre in each ball's plane [m]; shape (ball, 2)."""
        apart = self.drawing.inner_groove_centre_radius - self.drawing.outer_groove_centre_radius
        round_ones = np.array([self.touching_offset, apart]) + self.by_ring @ moved
        return np.asarray(round_ones if self.lobes is None else round_ones + np.outer(self.lobes, [0.0, 1.0]))

    def repeated(self, times: int) -> BallRow:
        """As many copies of the row, one after the other, to evaluate at several places at once."""
        own, lobes = (None if each is None else np.tile(each, times) for each in (self.diameters, self.lobes))
        return replace(self, azimuth=np.tile(self.azimuth, times), diameters=own, lobes=lobes)

    @cached_property
    def ball_radius(self) -> Array:
        """Of each ball [m]."""
        return np.array([0.5 * ball.ball_diameter for ball in self.balls])

    @cached_property
    def masses(self) -> tuple[Array, Array]:
        """Mass [kg] and moment of inertia [kg m^2] of each ball."""
        return np.array([ball.ball_mass for ball in self.balls]), np.array([ball.ball_inertia for ball in self.balls])

    @cached_property
    def lengths(self) -> tuple[Array, Array]:
        """Of the inner and the outer contact line of balls that just touch [m]."""
        return self.drawing.inner_groove_radius - self.ball_radius, self.drawing.outer_groove_radius - self.ball_radius

    @cached_property
    def _laws(self) -> dict[str, Array]:
        """ln(Q/delta^1.5) and ln(a E/Q^(1/3)) of each race over cos(alpha), in Chebyshev's polynomials; shape
        (2, ball, term)."""
        model, known = self.model, {}
        nodes = np.polynomial.chebyshev.chebpts1(SHAPES) if model.hertz_angle == "actual" else np.ones(1)
        laws: dict[str, Array] = {}
        for race, over_hertz in zip(("inner", "outer"), self.over_hertz, strict=True):
            for ball in self.balls:
                if (race, ball.ball_diameter) not in known:
                    values = []
                    for node in nodes:
                        problem = ball.groove(race, own_angle(model.hertz_angle, float(np.arccos(node)))).problem(1.0)
                        hertz = references.ellipse(problem, model.hertz_form)
                        second = references.second_kind(problem.curvature_x / problem.curvature_y, model.hertz_form)
                        values.append([(over_hertz * hertz.approach) ** -1.5, hertz.semi_major_axis * second])
                    logs = np.log(values)
                    series = np.polynomial.chebyshev.chebfit(nodes, logs, len(nodes) - 1)
                    known[race, ball.ball_diameter] = series.T
            laws[race] = np.stack([known[race, ball.ball_diameter] for ball in self.balls], axis=1)
        return laws

    def law(self, race: str, normal: Array) -> tuple[Array, Array]:
        """Q/delta^1.5 and a E/Q^(1/3) of each ball's contact along a normal."""
        series = self._laws[race]
        if series.shape[2] == 1:  # of one angle
            return self._at_one_angle[race]
        terms = np.polynomial.chebyshev.chebvander(normal[:, 1], series.shape[2] - 1)
        stiffness, spin = np.exp(np.sum(series * terms, axis=2))
        return stiffness, spin

    @cached_property
    def _at_one_angle(self) -> dict[str, tuple[Array, Array]]:
        return {race: tuple(np.exp(series[:, :, 0])) for race, series in self._laws.items()}

    def state(self, centres: Array, positions: Array, control: Array | None, speed: float = 1.0) -> BallStates:
        """Everything of the balls at these positions from the outer groove's centre; shapes (ball, 2) [m].

        Args:
            control: outer, inner or minimum_dissipation, of each ball.
            speed: part of the speed at which the rings turn.
        """
        inner_length, outer_length = self.lengths
        lines = centres - positions, positions
        distance = [np.hypot(*line.T) for line in lines]
        inner, outer = (line / np.maximum(length, 1e-30)[:, None] for line, length in zip(lines, distance, strict=True))
        approaches = distance[0] - inner_length, distance[1] - outer_length
        (k_i, _), (k_o, _) = self.law("inner", inner), self.law("outer", outer)
        q_i, q_o = (k * np.maximum(each, 0.0) ** 1.5 for k, each in zip((k_i, k_o), approaches, strict=True))
        state = BallStates(inner, outer, q_i, q_o, *approaches)
        if control is not None:
            seen = rolling_line(inner, outer, approaches[0] / inner_length)
            radius = np.full_like(inner_length, 0.5 * self.drawing.pitch_diameter)
            if self.model.displaced_orbit:
                radius = self.drawing.outer_groove_centre_radius + positions[:, 1]
            at_inner, at_outer = self._spin_weights(control, q_i, q_o)
            state.orbit, state.rotation = rolling(
                self.ball_radius, radius, seen, outer, speed * self.inner_speed, speed * self.outer_speed, at_inner,
                at_outer,
            )  # fmt: skip
            if self.model.centrifugal:
                state.centrifugal = self.masses[0] * radius * state.orbit**2
            if self.model.gyroscopic:
                # What turns the angular momentum J W round with the orbit: e_x orbit cross J W, about e_t.
                state.moment = self.masses[1] * state.orbit * state.rotation[:, 1]
                state.inner_share = self._inner_share(
                    control, at_inner, at_outer, seen, outer, self.ball_radius / radius
                )
                for race, load, normal, share, arm in (
                    ("inner", q_i, inner, state.inner_share, -self.ball_radius),
                    ("outer", q_o, outer, 1.0 - state.inner_share, self.ball_radius),
                ):
                    required = share * state.moment / arm
                    state.required[race] = np.abs(required)
                    if self.model.friction_coefficient is not None:
                        most = self.model.friction_coefficient * load
                        required = np.clip(required, -most, most)
                    # At arm * (sin, cos), a force f (-cos, sin) has the moment arm * f about e_t.
                    along = np.stack([-normal[:, 1], normal[:, 0]], axis=1)
                    state.friction[race] = required[:, None] * along * ((q_i > 0.0) | (q_o > 0.0))[:, None]
        return state

    def _spin_weights(self, control: Array, q_i: Array, q_o: Array) -> tuple[Array, Array]:
        """How much each raceway's spin counts: all of one that controls, else Q a E (M = 3/8 mu Q a E)."""
        least = control == "minimum_dissipation"
        flat = self._at_free_angle
        friction = [load ** (4.0 / 3.0) * spin for load, spin in zip((q_i, q_o), flat, strict=True)]
        lost = q_i <= 0.0
        at_inner = np.where(least, np.where(lost, 0.0, friction[0]), control == "inner")
        at_outer = np.where(least, np.where(lost, 1.0, friction[1]), control == "outer")
        return at_inner, at_outer

    @cached_property
    def _at_free_angle(self) -> tuple[Array, Array]:
        """a E/Q^(1/3) where minimum dissipation takes it: at the free angle, unless all contacts are taken at zero."""
        cosine = 1.0 if self.model.hertz_angle == "zero" else np.cos(self.drawing.free_contact_angle)
        normal = np.broadcast_to([0.0, cosine], (len(self.azimuth), 2))
        return self.law("inner", normal)[1], self.law("outer", normal)[1]

    def _inner_share(
        self, control: Array, at_inner: Array, at_outer: Array, inner: Array, outer: Array, g: Array
    ) -> Array:
        """Of the moment that the inner raceway's friction gives."""
        along_i, along_o = at_inner * (1.0 + g * outer[:, 1]), at_outer * (1.0 - g * inner[:, 1])
        weight = along_i / (along_i + along_o)
        return np.asarray((0.5 if self.model.harris_shares else 1.0) * weight)

    def jones_control(self, state: BallStates) -> Array:
        """Which raceway controls each ball by Jones's criterion, Qo ao Eo cos(ai - ao) > Qi ai Ei."""
        (_, s_i), (_, s_o) = (
            (0.0, each) if self.model.hertz_angle != "actual" else self.law(race, normal)
            for race, each, normal in zip(
                ("inner", "outer"), self._at_free_angle, (state.inner, state.outer), strict=True
            )
        )
        cosine = np.sum(state.inner * state.outer, axis=1)
        at_outer, at_inner = state.q_o ** (4.0 / 3.0) * s_o * cosine, state.q_i ** (4.0 / 3.0) * s_i
        return np.where((at_outer > at_inner) | (state.q_i <= 0.0), "outer", "inner")

    def on_ring(self, state: BallStates) -> Array:
        """What holds the inner ring against each ball: x, y, z [N], moments about y and z [N m]; shape (ball, 5).

        Each force acts at its contact, a groove radius from the groove's centre, which is `lever` from the axis.
        """
        forces, normal = (
            plane[:, :1] * AXIS + plane[:, 1:] * self.radial
            for plane in (state.q_i[:, None] * state.inner + state.friction["inner"], state.inner)
        )
        points = self.lever * self.radial - self.drawing.inner_groove_radius * normal
        (x, y, z), (f_x, f_y, f_z) = points.T, forces.T
        return np.stack([f_x, f_y, f_z, z * f_x - x * f_z, x * f_y - y * f_x], axis=1)


class BallStates:
    """The balls of a row at one place; arrays (ball, ...)."""

    def __init__(self, inner: Array, outer: Array, q_i: Array, q_o: Array, delta_i: Array, delta_o: Array) -> None:
        self.inner, self.outer = inner, outer
        """Normals in (e_x, e_r)."""
        self.q_i, self.q_o, self.delta_i, self.delta_o = q_i, q_o, delta_i, delta_o
        none, plane = np.zeros_like(q_i), np.zeros((len(q_i), 2))
        self.orbit, self.rotation = none, plane
        self.centrifugal, self.moment, self.inner_share = none, none, none
        """Outward [N]; about e_t [N m]; of it, by the inner raceway."""
        self.required = {"inner": none, "outer": none}
        """Friction that the shares ask for, whatever the contact can carry [N]."""
        self.friction = {"inner": plane, "outer": plane}
        """On the ball, in (e_x, e_r) [N]."""

    @property
    def left(self) -> Array:
        """Sum of the forces on each ball in (e_x, e_r) [N]; zero in equilibrium."""
        total = self.q_i[:, None] * self.inner - self.q_o[:, None] * self.outer
        total = total + self.friction["inner"] + self.friction["outer"]
        total[:, 1] += self.centrifugal
        return np.asarray(total)


def rolling_line(inner: Array, outer: Array, approach: Array) -> Array:
    """The inner contact's normal as rolling has it: turned towards the outer one where that raceway is being lost.

    Args:
        approach: over the free length of the inner line; negative: a gap.
    """
    lost = np.clip(-approach / LOSING, 0.0, 1.0)
    weight = (1.0 - lost) ** 2 * (1.0 + 2.0 * lost)
    apart = np.arctan2(inner[:, 0] * outer[:, 1] - inner[:, 1] * outer[:, 0], np.sum(inner * outer, axis=1))
    angle = np.arctan2(*outer.T) + weight * apart
    turned = np.stack([np.sin(angle), np.cos(angle)], axis=1)
    return np.where((lost > 0.0)[:, None], turned, inner)


def rolling(
    ball_radius: Array,
    orbit_radius: Array,
    inner: Array,
    outer: Array,
    inner_speed: float,
    outer_speed: float,
    at_inner: Array,
    at_outer: Array,
) -> tuple[Array, Array]:
    """Orbital speed (ball,) and the balls' rotation about e_x and e_r (ball, 2), seen from the orbit [rad/s].

    Three conditions: no slip at the centre of either contact, and no spin at the raceway in control. Without one in
    control the spins balance by their weights: the sum of c w^2 over both raceways is least where the sum of c w is
    zero, as no slip leaves their difference w_i - w_o fixed but for factors that do not change with the ball's axis.
    """
    conditions = []
    for normal, side, ring in ((outer, 1.0, outer_speed), (inner, -1.0, inner_speed)):
        # Surface speeds along e_t agree: (orbit - ring) (R + side r cos) + side r (W_x cos - W_r sin) = 0.
        reach, arm = orbit_radius + side * ball_radius * normal[:, 1], side * ball_radius
        conditions.append([reach, arm * normal[:, 1], -arm * normal[:, 0], ring * reach])
    (i_x, i_r), (o_x, o_r) = inner.T, outer.T
    along = at_inner * i_x + at_outer * o_x
    conditions.append(
        [along, along, at_inner * i_r + at_outer * o_r, at_inner * inner_speed * i_x + at_outer * outer_speed * o_x]
    )
    table = np.array(conditions).transpose(2, 0, 1)
    size = np.abs(table[:, :, :3]).max(axis=2, keepdims=True)
    speed = np.linalg.solve(table[:, :, :3] / size, table[:, :, 3:] / size)[:, :, 0]
    return speed[:, 0], speed[:, 1:]
