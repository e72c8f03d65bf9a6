"""The motion of balls that friction moves: the balance (`kernel/traction_balance.py`) of the cases of a scene, from its
solution under outer control, and everything that it says of balls and contacts.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.compiler.threads import in_threads
from qsbearing.model.effects.traction import LAW_CODES, Traction, TractionLaw, most_drag
from qsbearing.model.kernel import traction_ball as kernel
from qsbearing.model.kernel.admissibility import CONVERGED, NOT_CONVERGED
from qsbearing.model.kernel.arched_balance import solve_arched
from qsbearing.model.kernel.case import RESULT
from qsbearing.model.kernel.traction import contact_points
from qsbearing.model.kernel.traction_balance import MOTION, PLACES, solve_motions
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.ring_moments import ring_moments
from qsbearing.model.solution.solved_cases import solved_of
from qsbearing.model.solution.status import STATUS_OF_CODE, reasons

INNER, OUTER = range(2)
NO_FORCE = 1e-12
"""Of a case's largest contact load: less is what rounding leaves."""
TILTS = slice(3, 5)
"""Of the ring's five channels."""

_OF_CONTACT = {
    "load": (kernel.LOAD, "force"),
    "approach": (kernel.APPROACH, "length"),
    "semi_major_axis": (kernel.SEMI_MAJOR, "length"),
    "semi_minor_axis": (kernel.SEMI_MINOR, "length"),
    "traction": (kernel.TRACTION, "force"),
    "sideways": (kernel.SIDEWAYS, "force"),
    "spin_moment": (kernel.SPIN_MOMENT, "moment"),
    "roll_moment": (kernel.ROLL_MOMENT, "moment"),
    "turn_moment": (kernel.TURN_MOMENT, "moment"),
    "heat": (kernel.HEAT, "power"),
    "spin_speed": (kernel.SPIN, "speed"),
    "slip_across": (kernel.SLIP_ACROSS, "velocity"),
    "slip_along": (kernel.SLIP_ALONG, "velocity"),
}
"""What the kernel writes of a contact, and its unit."""


@dataclass(frozen=True)
class ContactFriction:
    """Of the contacts at one ring, (*cases, ball); SI. Directions: t across the groove, y against the orbit."""

    angle: NDArray
    load: NDArray
    approach: NDArray
    semi_major_axis: NDArray
    semi_minor_axis: NDArray
    traction: NDArray
    """T, the friction on the ball across the groove, with the signs of (19.9), (19.10) [N]."""
    sideways: NDArray
    """Y, that against the orbit [N]."""
    spin_moment: NDArray
    """Mn, about the contact's normal [N m]."""
    roll_moment: NDArray
    """Mt, about t [N m]."""
    turn_moment: NDArray
    """My, about y [N m]."""
    heat: NDArray
    """Of friction [W]."""
    spin_speed: NDArray
    """ws, the ball's less the ring's about the normal [rad/s]."""
    slip_across: NDArray
    """Of the ball's surface at the centre of a flat contact, along t [m/s]."""
    slip_along: NDArray
    """The same along y."""
    told_heat: NDArray | None
    """The same; None under the linear law, of which it means nothing."""
    friction_use: NDArray
    """|F|/(mu Q): 1 where all of the contact slides one way, 0 where slips of both ways balance; the linear law has no
    bound, and so no number."""


class Opposite(NamedTuple):
    """Of arched rings, the contacts of the arcs that carry angles below zero; None of a ring with one arc."""

    inner: ContactFriction | None
    outer: ContactFriction | None


class Inside(NamedTuple):
    """What a solution was found from and where, in the kernel's units."""

    shape: tuple[int, ...]
    cases: NDArray
    laws: NDArray
    points: NDArray
    is_carried: bool
    results: NDArray
    places: NDArray
    shims: NDArray
    """Of arched rings (case, 2); (case, 0) without."""


@dataclass(frozen=True)
class FrictionMotion:
    """Balls and ring in the balance of friction, (*cases, ...); SI. Nothing is a number where a case has none; at rest
    nothing of the balls' motion is."""

    status: NDArray
    """Words of `Status`."""
    reason: NDArray
    """Words of `Reason` where there is no equilibrium; empty elsewhere."""
    displacement: NDArray
    load: NDArray
    """On the inner ring, (*cases, 5): against the balls' forces and moments, with their weights."""
    residual: NDArray
    iterations: NDArray
    angular_velocity: NDArray
    """(*cases, ball, 3), in the frame that goes round with the ball: x, against the orbit, radially outward."""
    orbital_speed: NDArray
    """omega_m of each ball."""
    weight: NDArray
    """Part of the time at each azimuth, times the number of balls: 1 where all are alike."""
    drag: NDArray
    """On each ball, along y [N]."""
    centrifugal_force: NDArray
    gyroscopic_moment: NDArray
    """J omega_m wz of each ball, the moment about the tangent that friction carries [N m]."""
    inner: ContactFriction
    outer: ContactFriction
    torque: NDArray
    """Of the balls on the inner ring, (*cases)."""
    start: Any
    """The `Solution` under outer control; None between arched rings, of which it knows nothing."""
    friction_coefficient: NDArray
    """mu, (*cases); no number under the linear law."""
    inside: Inside
    opposite: Opposite | None = None
    """Of arched rings alone; `inner` and `outer` are then the arcs for angles above zero, or a ring's one arc."""

    @property
    def attitude_angle(self) -> NDArray:
        """beta, tan(beta) = wz/(-wx), of each ball's axis in its own plane: the same for either sense of turning."""
        w, sense = self.angular_velocity, self.sense[..., None]
        return np.arctan2(-sense * w[..., 2], sense * w[..., 0])

    @property
    def sense(self) -> NDArray:
        """-1 where the inner ring is faster than the outer one, so that balls turn backwards; else 1; (*cases)."""
        cases = self.inside.cases
        return np.where(cases["outer_speed"] < cases["inner_speed"], -1.0, 1.0).reshape(self.inside.shape)

    @property
    def yaw_angle(self) -> NDArray:
        """beta', tan(beta') = wy/(-wx), of the axis out of that plane."""
        w, sense = self.angular_velocity, self.sense[..., None]
        return np.arctan2(-sense * w[..., 1], sense * w[..., 0])

    @property
    def cage_speed(self) -> NDArray:
        """Of balls on their way round: the harmonic mean of their orbits."""
        times = np.nansum(1.0 / self.orbital_speed, axis=-1)
        count = np.isfinite(self.orbital_speed).sum(axis=-1)
        return np.asarray(np.where(count > 0, count, np.nan) / np.where(count > 0, times, np.nan))

    @property
    def sides(self) -> tuple[ContactFriction, ...]:
        """Of all arcs."""
        return (self.inner, self.outer, *filter(None, self.opposite or ()))

    @property
    def on_outer(self) -> tuple[ContactFriction, ...]:
        """Of the outer ring's arcs."""
        other = None if self.opposite is None else self.opposite.outer
        return (self.outer,) if other is None else (self.outer, other)

    @property
    def skid_margin(self) -> NDArray | None:
        """`most_drag` of each ball over that which it has; infinite without drag; None between arched rings."""
        if self.opposite is not None:
            return None
        parallel = np.cos(self.inner.angle - self.outer.angle)
        most = most_drag(self.friction_coefficient[..., None], self.inner.load, parallel)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(most / np.abs(self.drag))

    @property
    def gyroscopic_margin(self) -> NDArray | None:
        """mu over what outer control asks of each ball's outer contact, 2 |Mg|/(D Qo): above 2 it is nearly right;
        None between arched rings."""
        if self.opposite is not None:
            return None
        required = self.start.outer.required_friction
        assert required is not None
        which = spanned(self.start.shape, self.inside.shape)
        required = required.reshape(-1, required.shape[-1])[which].reshape(self.orbital_speed.shape)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(self.friction_coefficient[..., None] / required)

    @property
    def skids(self) -> NDArray:
        """Whether a case has no solution and, with outer control's loads and motion, drag is larger than what drives
        the balls; (*cases). Between arched rings this is not known, and False."""
        if self.opposite is not None:
            return np.zeros(self.inside.shape, bool)
        start, shape, cases, laws = self.start, self.inside.shape, self.inside.cases, self.inside.laws
        which = spanned(start.shape, shape)
        load, parallel, orbit = (
            each.reshape(-1, each.shape[-1])[which]
            for each in (start.inner.load, np.cos(start.inner.angle - start.outer.angle), start.orbital_speed)
        )
        speed = orbit / cases["speed"][:, None] * 0.5 * cases["pitch_diameter"][:, None]
        drag = (laws["drag_force"][:, None] + laws["drag_factor"][:, None] * speed**2) * cases["force"][:, None]
        most = most_drag(laws["friction_coefficient"][:, None], load, parallel)
        is_solved = self.inside.results["status"] == CONVERGED
        return np.asarray(~is_solved & (np.nansum(drag - most, axis=-1) > 0.0)).reshape(shape)

    @property
    def least_skid_margin(self) -> NDArray | None:
        """Of all balls, (*cases)."""
        return _least(self.skid_margin)

    @property
    def least_gyroscopic_margin(self) -> NDArray | None:
        """Of all balls, (*cases)."""
        return _least(self.gyroscopic_margin)

    @property
    def told_heat(self) -> NDArray | None:
        """`heat`; None under the linear law, of which it means nothing."""
        return None if self.inner.told_heat is None else self.heat

    @property
    def heat(self) -> NDArray:
        """Of all contacts [W]."""
        of_balls = self.weight * sum(np.nan_to_num(each.heat) for each in self.sides[2:])
        of_balls = of_balls + self.weight * (self.inner.heat + self.outer.heat)
        return np.asarray(np.where(np.isfinite(self.torque), np.nansum(of_balls, axis=-1), np.nan))


def _least(of_balls: NDArray | None) -> NDArray | None:
    return None if of_balls is None else np.asarray(np.fmin.reduce(of_balls, axis=-1))


class Unread(NamedTuple):
    """A balance as the kernel leaves it: reading it takes longer than a ball does."""

    start: Any
    bearing: BallBearing
    """In operation."""
    inside: Inside
    results: NDArray
    """Of the balance alone."""
    contacts: NDArray
    torques: NDArray
    bound: NDArray
    """mu, by case."""


def balanced(
    start: Any,
    maker: CaseMaker,
    traction: Traction,
    radii: int,
    angles: int,
    *,
    carried: bool = True,
    threads: int = 1,
) -> Unread:
    """The balance of friction.

    Args:
        start: the `Solution` under outer control; None between arched rings, where the balance begins with nothing.
        maker: of the case records, whose axes are those of the scene and the law together.
        radii, angles: points of each contact, see `contact_points`.
        carried: balls are carried round with their inertia under radial load; False: each is balanced at its azimuth
            as if it stayed there.
        threads: at most so many.
    """
    shape, cases = maker.shape, maker.make()
    balls, count, shims = maker.ball_axis, cases.size, maker.shims()
    if start is None:
        results, arcs = np.zeros(count, RESULT), 4
        results["status"] = NOT_CONVERGED
    else:
        before, which, arcs = solved_of(start), spanned(start.shape, shape), 2
        results, positions = before.results[which], np.ascontiguousarray(before.positions[which][..., :3])
    laws, points = laws_of(cases, traction, shape), contact_points(radii, angles)
    places = np.full((count, balls, len(PLACES)), np.nan)
    contacts, torques = np.full((count, balls, arcs, kernel.CONTACT_QUANTITIES), np.nan), np.full(count, np.nan)

    def solve_stretch(part: slice) -> None:
        size = 4 * balls + 3  # of Newton's step
        arrays = points, np.empty((size, size)), np.empty(size), np.empty(balls)
        memory = np.zeros(arcs, kernel.GROOVE), np.zeros(1, MOTION), np.zeros(balls, kernel.MOVED_BALL)
        given = cases[part], laws[part], *memory, arrays, carried
        made = places[part], contacts[part], torques[part]
        if start is None:
            solve_arched(*given, shims[part], results[part], *made)
        else:
            solve_motions(*given, results[part], positions[part], *made)

    in_threads(solve_stretch, count, threads)
    are_held = cases["displacement_given"][:, TILTS] != 0
    if start is not None and are_held.any():  # of four arcs, moments are not worked out
        moments = -ring_moments(cases, contacts[:, :, INNER], places)
        results["load"][:, TILTS] = np.where(are_held, moments, results["load"][:, TILTS])
    inside = Inside(shape, cases, laws, points, carried, results, places, shims)
    bound = np.nan if traction.law is TractionLaw.LINEAR else traction.coefficient
    of_cases = np.broadcast_to(np.asarray(bound, float), shape)
    return Unread(start, maker.scene.operating_bearing, inside, results.copy(), contacts, torques, of_cases)


def spanned(shape: tuple[int, ...], both: tuple[int, ...]) -> NDArray:
    """Which of a scene's cases each is of a scene and a law together, which have these axes."""
    cases = np.arange(prod(shape))
    return cases if shape == both else np.broadcast_to(cases.reshape(shape), both).reshape(-1)


def laws_of(cases: NDArray, traction: Traction, shape: tuple[int, ...] = ()) -> NDArray:
    """Records of the law, in the units of each of the cases, which have these axes."""
    laws = np.zeros(cases.size, kernel.LAW)
    laws["law"] = LAW_CODES[traction.law]
    friction, slip = (
        each if np.ndim(each) == 0 else np.broadcast_to(np.asarray(each, float), shape).reshape(-1)
        for each in (traction.coefficient, traction.slip_speed)
    )
    laws["friction_coefficient"] = friction
    laws["slip_speed"] = slip / (cases["speed"] * cases["length"])
    laws["has_curvature"] = traction.has_curvature
    laws["drag_force"] = traction.cage_drag / cases["force"]
    if traction.drag_coefficient is not None and traction.fluid_density is not None:
        disc = traction.drag_coefficient * traction.fluid_density * np.pi / 8.0  # over D^2, a length of the case
        laws["drag_factor"] = disc * (cases["length"] ** 2 * cases["speed"]) ** 2 / cases["force"]
    return laws


def _lose_free_balls(cases: NDArray, contacts: NDArray) -> None:
    """Balls at rest that carry no load but what rounding leaves: they have no place, and no contacts."""
    load = np.nan_to_num(contacts[..., kernel.LOAD])
    still = cases["inner_speed"] == cases["outer_speed"]
    is_free = still[:, None] & (load.max(axis=2) <= NO_FORCE * load.max(axis=(1, 2))[:, None])
    is_free &= np.isfinite(contacts[:, :, INNER, kernel.LOAD])
    own = np.zeros((int(is_free.sum()), *contacts.shape[2:]))
    own[..., [kernel.SINE, kernel.COSINE, kernel.APPROACH]] = np.nan
    contacts[is_free] = own


def read(balance: Unread) -> FrictionMotion:
    """All that a balance says of ring, balls and contacts."""
    start, bearing, inside, results, contacts, torques, bound = balance
    shape, cases, places = inside.shape, inside.cases, inside.places
    unknown = results["status"] != CONVERGED
    for array in (places, contacts, torques):
        array[unknown] = np.nan
    if inside.shims.size:
        _lose_free_balls(cases, contacts)
    force, length, speed = (cases[name][:, None] for name in ("force", "length", "speed"))
    moments = force * length
    turning = np.where((cases["inner_speed"] != 0.0) | (cases["outer_speed"] != 0.0), 1.0, np.nan)[:, None]
    w, orbit = places[..., 2:5] * (speed * turning)[..., None], places[..., 5] * (speed * turning)
    inertia, mass = (np.asarray(each)[..., None] for each in (bearing.ball_inertia, bearing.ball_mass))
    radius = 0.5 * cases["pitch_diameter"][:, None] + cases["displaced_orbit"][:, None] * places[..., 1]
    units = {"force": force, "length": length, "moment": moments, "speed": speed}
    units |= {"velocity": speed * length, "power": moments * speed}

    def shaped(array: NDArray) -> NDArray:
        return array.reshape((*shape, *array.shape[1:]))

    def side(which: int) -> ContactFriction:
        sign = -1.0 if which % 2 == INNER else 1.0
        of_side = contacts[:, :, which]
        values = {name: shaped(of_side[..., what] * units[unit]) for name, (what, unit) in _OF_CONTACT.items()}
        values["angle"] = shaped(np.arctan2(sign * of_side[..., kernel.SINE], sign * of_side[..., kernel.COSINE]))
        with np.errstate(divide="ignore", invalid="ignore"):
            use = np.hypot(values["traction"], values["sideways"]) / (bound[..., None] * values["load"])
        told = None if np.isnan(bound).all() else values["heat"]
        return ContactFriction(**values, told_heat=told, friction_use=use)

    def opposite() -> Opposite:
        has_arc = inside.shims >= 0.0
        contacts[:, :, 2:][~np.broadcast_to(has_arc[:, None, :, None], contacts[:, :, 2:].shape)] = np.nan
        return Opposite(*(side(2 + ring) if has_arc[:, ring].any() else None for ring in (INNER, OUTER)))

    scale = np.where(np.arange(5) < 3, length, 1.0), np.where(np.arange(5) < 3, force, moments)
    orbits = shaped(orbit)
    return FrictionMotion(
        status=shaped(np.vectorize(STATUS_OF_CODE.__getitem__, otypes=["<U16"])(results["status"])),
        reason=shaped(reasons(results)),
        displacement=shaped(np.where(unknown[:, None], np.nan, results["displacement"]) * scale[0]),
        load=shaped(np.where(unknown[:, None], np.nan, results["load"]) * scale[1]),
        residual=shaped(results["residual"]),
        iterations=shaped(results["iterations"]),
        angular_velocity=shaped(w),
        orbital_speed=orbits,
        weight=shaped(places[..., 6]),
        drag=shaped(places[..., 7] * force),
        centrifugal_force=mass * orbits**2 * shaped(radius * length),
        gyroscopic_moment=inertia * orbits * shaped(w[..., 2]),
        inner=side(INNER),
        outer=side(OUTER),
        torque=shaped(torques * moments[:, 0]),
        start=start,
        friction_coefficient=bound,
        inside=inside,
        opposite=opposite() if inside.shims.size else None,
    )
