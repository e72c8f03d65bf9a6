"""The motion of balls that friction moves: solved from a scene, in place of a hypothesis of raceway control.

Beside `solve`, which knows hypotheses alone: from its solution under outer control Newton's method goes on to the
balance of friction (`kernel/traction_balance.py`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import prod
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import CentrifugalForce, GyroscopicMoment
from qsbearing.model.effects.hertz_angle import HertzAngle
from qsbearing.model.effects.orbit_radius import OrbitRadius
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.effects.traction import LAW_CODES, Traction, TractionLaw, most_drag
from qsbearing.model.kernel import traction_ball as kernel
from qsbearing.model.kernel.admissibility import CONVERGED
from qsbearing.model.kernel.traction import ANGLES, RADII, contact_points
from qsbearing.model.kernel.traction_balance import MOTION, PLACES, solve_motions
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solver import solve
from qsbearing.model.solution.status import STATUS_OF_CODE, reasons
from qsbearing.model.validation import ErrorDetail, raise_if_any

INNER, OUTER = range(2)

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
    friction_use: NDArray
    """|F|/(mu Q): 1 where all of the contact slides one way, 0 where slips of both ways balance; the linear law has no
    bound, and so no number."""


class Inside(NamedTuple):
    """What a solution was found from and where, in the kernel's units."""

    shape: tuple[int, ...]
    cases: NDArray
    laws: NDArray
    points: NDArray
    is_carried: bool
    results: NDArray
    places: NDArray


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
    """On the inner ring, (*cases, 5): the balls' forces with their weights; moments are not worked out."""
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
    start: Solution
    """The solution under outer control."""
    friction_coefficient: NDArray
    """mu, (*cases); no number under the linear law."""
    inside: Inside

    @property
    def attitude_angle(self) -> NDArray:
        """beta, tan(beta) = wz/(-wx), of each ball's axis in its own plane."""
        w = self.angular_velocity
        return np.arctan2(w[..., 2], -w[..., 0])

    @property
    def yaw_angle(self) -> NDArray:
        """tan = wy/(-wx), of the axis out of that plane."""
        w = self.angular_velocity
        return np.arctan2(w[..., 1], -w[..., 0])

    @property
    def cage_speed(self) -> NDArray:
        """Of balls on their way round: the harmonic mean of their orbits."""
        times = np.nansum(1.0 / self.orbital_speed, axis=-1)
        count = np.isfinite(self.orbital_speed).sum(axis=-1)
        return np.asarray(np.where(count > 0, count, np.nan) / np.where(count > 0, times, np.nan))

    @property
    def skid_margin(self) -> NDArray:
        """`most_drag` of each ball over that which it has; infinite without drag."""
        parallel = np.cos(self.inner.angle - self.outer.angle)
        most = most_drag(self.friction_coefficient[..., None], self.inner.load, parallel)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(most / np.abs(self.drag))

    @property
    def gyroscopic_margin(self) -> NDArray:
        """mu over what outer control asks of each ball's outer contact, 2 |Mg|/(D Qo): above 2 it is nearly right."""
        required = self.start.outer.required_friction
        assert required is not None
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(self.friction_coefficient[..., None] / required)

    @property
    def heat(self) -> NDArray:
        """Of all contacts [W]."""
        of_balls = self.weight * (self.inner.heat + self.outer.heat)
        return np.asarray(np.where(np.isfinite(self.torque), np.nansum(of_balls, axis=-1), np.nan))


def friction_motion(
    scene: Scene, traction: Traction, *, radii: int = RADII, angles: int = ANGLES, carried: bool = True
) -> FrictionMotion:
    """Solve a scene with balls that friction moves.

    Args:
        scene: bearing, operation and constant Hertz stiffness; its ball effects and raceway control do not count, for
            the balance has all of the balls' inertia.
        traction: the law of friction; its arrays broadcast with the scene's to the case axes, so that one scene takes a
            band of friction coefficients.
        radii, angles: points of each contact, see `contact_points`.
        carried: balls are carried round with their inertia under radial load; False: each is balanced at its azimuth
            as if it stayed there.

    Returns:
        FrictionMotion: raises nothing for a physical outcome; `status` says what happened.

    Raises:
        SceneError: what this balance does not know yet.
    """
    raise_if_any(refusals(scene))
    effects = (CentrifugalForce(), GyroscopicMoment())
    start = solve(replace(scene, ball_effects=effects, raceway_control=RacewayControl.OUTER))
    shape, which = spanned(start.maker.shape, traction)
    cases, results = start.maker.make()[which], start.results[which]
    positions = np.ascontiguousarray(start.positions[which][..., :3])
    balls, count = start.maker.ball_axis, cases.size
    places = np.full((count, balls, len(PLACES)), np.nan)
    contacts, torques = np.full((count, balls, 2, kernel.CONTACT_QUANTITIES), np.nan), np.full(count, np.nan)
    size = 4 * balls + 3  # of Newton's step
    arrays = contact_points(radii, angles), np.empty((size, size)), np.empty(size), np.empty(balls)
    laws = laws_of(cases, traction, shape)
    memory = np.zeros(2, kernel.GROOVE), np.zeros(1, MOTION), np.zeros(balls, kernel.MOVED_BALL)
    solve_motions(cases, laws, *memory, arrays, carried, results, positions, places, contacts, torques)
    inside = Inside(shape, cases, laws, arrays[0], carried, results, places)
    bound = np.nan if traction.law is TractionLaw.LINEAR else traction.friction_coefficient
    return _found(start, inside, contacts, torques, np.broadcast_to(np.asarray(bound, float), shape))


def spanned(shape: tuple[int, ...], traction: Traction) -> tuple[tuple[int, ...], NDArray]:
    """(case axes of a scene and a law together, which of the scene's cases each is).

    Raises:
        ValueError: they do not broadcast.
    """
    both = np.broadcast_shapes(shape, np.shape(traction.friction_coefficient), np.shape(traction.slip_speed))
    of_scene = np.arange(prod(shape)).reshape(shape)
    return both, np.broadcast_to(of_scene, both).reshape(-1)


def refusals(scene: Scene) -> list[ErrorDetail]:
    """What the balance of friction does not know, by the scene's fields."""
    operation, errors = scene.operation, []
    inner, outer = (
        np.asarray(operation.speed),
        np.asarray(0.0 if operation.outer_speed is None else operation.outer_speed),
    )
    if np.any((inner == outer) & (inner != 0.0)):
        errors.append(ErrorDetail("operation.speed", "is the outer ring's too, so that nothing rolls", operation.speed))
    for effect in (scene.elastic_rings, scene.ball_diameter_deviations):
        if scene.ring_effects and effect is not None:
            errors.append(ErrorDetail(effect.name, "is not known to balls that friction moves"))
    if scene.hertz_angle is HertzAngle.ACTUAL:
        errors.append(ErrorDetail("hertz_angle", "must be constant where friction moves the balls", "actual"))
    is_radial = any(
        value is not None and np.any(np.asarray(value) != 0.0)
        for name in ("radial_load_y", "radial_load_z", "radial_displacement_y", "radial_displacement_z")
        for value in [getattr(operation, name)]
    )
    if is_radial and scene.orbit_radius is OrbitRadius.DISPLACED:  # whose change would accelerate balls
        problem = "must be pitch_circle where friction moves balls under radial load"
        errors.append(ErrorDetail("orbit_radius", problem, str(scene.orbit_radius)))
    for axis in "yz":
        moment, tilt = getattr(operation, f"moment_{axis}"), getattr(operation, f"tilt_{axis}")
        is_free = tilt is None and (is_radial or np.any(np.asarray(0.0 if moment is None else moment) != 0.0))
        if is_free or (tilt is not None and np.any(np.asarray(tilt) != 0.0)):
            problem = "must be held at 0 where friction moves the balls"
            errors.append(ErrorDetail(f"operation.tilt_{axis}", problem, tilt))
    return errors


def laws_of(cases: NDArray, traction: Traction, shape: tuple[int, ...] = ()) -> NDArray:
    """Records of the law, in the units of each of the cases, which have these axes."""
    laws = np.zeros(cases.size, kernel.LAW)
    laws["law"] = LAW_CODES[traction.law]
    friction, slip = (
        np.broadcast_to(np.asarray(each, float), shape).reshape(-1)
        for each in (traction.friction_coefficient, traction.slip_speed)
    )
    laws["friction_coefficient"] = friction
    laws["slip_speed"] = slip / (cases["speed"] * cases["length"])
    laws["has_curvature"] = traction.has_curvature
    laws["drag_force"] = traction.cage_drag / cases["force"]
    if traction.drag_coefficient is not None and traction.fluid_density is not None:
        disc = traction.drag_coefficient * traction.fluid_density * np.pi / 8.0  # over D^2, a length of the case
        laws["drag_factor"] = disc * (cases["length"] ** 2 * cases["speed"]) ** 2 / cases["force"]
    return laws


def _found(start: Solution, inside: Inside, contacts: NDArray, torques: NDArray, bound: NDArray) -> FrictionMotion:
    shape, cases, results, places = inside.shape, inside.cases, inside.results, inside.places
    unknown = results["status"] != CONVERGED
    for array in (places, contacts, torques):
        array[unknown] = np.nan
    force, length, speed = (cases[name][:, None] for name in ("force", "length", "speed"))
    moments = force * length
    turning = np.where((cases["inner_speed"] != 0.0) | (cases["outer_speed"] != 0.0), 1.0, np.nan)[:, None]
    w, orbit = places[..., 2:5] * (speed * turning)[..., None], places[..., 5] * (speed * turning)
    bearing = start.scene.operating_bearing
    inertia, mass = (np.asarray(each)[..., None] for each in (bearing.ball_inertia, bearing.ball_mass))
    radius = 0.5 * cases["pitch_diameter"][:, None] + cases["displaced_orbit"][:, None] * places[..., 1]
    units = {"force": force, "length": length, "moment": moments, "speed": speed}
    units |= {"velocity": speed * length, "power": moments * speed}

    def shaped(array: NDArray) -> NDArray:
        return array.reshape((*shape, *array.shape[1:]))

    def side(which: int) -> ContactFriction:
        sign = -1.0 if which == INNER else 1.0
        of_side = contacts[:, :, which]
        values = {name: shaped(of_side[..., what] * units[unit]) for name, (what, unit) in _OF_CONTACT.items()}
        values["angle"] = shaped(np.arctan2(sign * of_side[..., kernel.SINE], sign * of_side[..., kernel.COSINE]))
        with np.errstate(divide="ignore", invalid="ignore"):
            use = np.hypot(values["traction"], values["sideways"]) / (bound[..., None] * values["load"])
        return ContactFriction(**values, friction_use=use)

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
    )
