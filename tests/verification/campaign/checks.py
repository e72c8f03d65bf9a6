"""Whether a solution that calls itself converged is one: recomputed in plain numpy from its public arrays.

Nothing of the kernel is used. From angles, approaches and loads as the user reads them follow

* the motion and the inertia loads of every ball, by the kinematics of Jones and Harris in vectors (cos beta, sin beta);
* that every ball is carried round, and that one which the inner raceway does not press lies on the outer one, at its
  bottom unless its gyroscopic moment holds it up;
* every ball's two equations (19.9), (19.10) and the ring's five channels (19.13)-(19.15), held ones included;
* that the two contacts' lengths close between the groove centres where the ring's displacement puts them;
* Hertz: each ellipse satisfies the ellipticity equation in Carlson's integrals, and each load is K delta^1.5.

Lengths are those in operation: of the bearing that fits, rotation and heat leave, and of each ball's own diameter.
Masses are those of the cold balls.

Arrays have shape (case, ball) unless said otherwise. A ball that is not there, or whose position is
undetermined, has neither load nor part in anything.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import elliprd, elliprf, elliprg

import qsbearing as qs
from qsbearing.model.operation import CHANNELS

MOST_IMBALANCE = 1e-10
"""Largest imbalance over the largest applied or inertial force: what a converged case promises."""

NO_FORCE = 1e-12
"""Of the largest contact load: to what the solver resolves an equilibrium. A contact that carries less may count as
pressed or as lost."""

EPS = float(np.finfo(float).eps)

GAP = 4e-15
"""Of lengths: as much may the solver's lines lack of a closed chain, which is told closed; they turn by it."""

CLOSURE = 64 * EPS
"""Of lengths that must add up, over the largest of them: a few roundings each of a sine, a product and a sum."""

LEAST_WEIGHT, LEAST_ORBIT = 1e-3, 0.02
"""A ball's orbit is a mean of both rings' speeds, and either's weight more than this: below is no rolling. Where the
outer ring stands, the inner one's is the orbit over its speed, and more than that."""

LOSING = 0.02
"""Of the inner line's free length: the gap within which a ball that has lost the inner raceway goes over to the orbit
of equal angles."""

HERTZ = 1e-9
"""Of the ellipticity equation and of loads: K is known to 1e-13, and Newton's stop on k leaves its square."""

ANGLE_ROUNDING = 1e-9
"""Sines this far below zero are rounding, not contact on the open side; cosines likewise, over the shoulder."""


@dataclass(frozen=True)
class Findings:
    """What the checks found of each case; every array has shape (case,)."""

    imbalance: NDArray
    """Largest of all balls and channels over the largest applied or inertial force (contact load, if a channel is
    held)."""
    expressible: NDArray
    """The imbalance that rounding can make, on the same scale: of each load, of the lines along which it acts, and of
    the speeds that follow from these."""
    misplaced: NDArray
    """Whether a held channel is not where it is held."""
    closure: NDArray
    """Largest gap between the two contact lengths and the groove centres, over the largest length."""
    hertz: NDArray
    """Largest relative error of any ellipse's shape and of any load."""
    tension: NDArray
    """Whether some load is negative, or not exactly where the approach is positive."""
    no_orbit: NDArray
    """Whether some ball's orbit, by its angles and the raceway that controls it, is not clearly between the speeds of
    both rings: it stands, or goes backwards."""
    unpressed: NDArray
    """Whether a ball that the inner raceway does not press does not lie at the outer one's bottom with its centrifugal
    force, or is said to be controlled by the inner one, which has no friction on it."""
    held_up: NDArray
    """Whether such a ball lies away from the bottom all the same, for the gyroscopic moment lifts it, beyond the gap in
    which its orbit goes over: where the rings turn against each other, its orbit is slow and its rotation is not. The
    balances show that this is an equilibrium: counted, not a failure."""
    friction_without_load: NDArray
    """Whether a contact without load is asked for friction, and for more than rounding makes."""
    open_side: NDArray
    """Whether an angular-contact bearing carries load at an inner angle below zero."""
    over_shoulder: NDArray
    """Whether some loaded inner contact lies beyond 90 degrees, over the shoulder of any groove."""
    lines_apart: NDArray
    """Whether some pressed inner line lies more than a right angle from the outer one: noted, for the balances show
    whether its motion is counted as it lies; and the reason of a refusal."""
    friction_above_load: NDArray
    """Whether some contact needs more friction than its load: counted, not a failure, for the model takes friction to
    be there and reports what it demands."""
    not_finite: NDArray
    """Whether a number is missing that a solved case has."""
    control: NDArray
    """Whether per-ball control contradicts Jones's criterion."""
    control_unsaid: NDArray
    """Whether it does so without a word."""
    misreported: NDArray
    """Whether the residual that the solution itself reports is above what it may be, or not a number."""

    NOTED = ("friction_above_load", "control", "lines_apart", "held_up")

    def failed(self) -> dict[str, NDArray]:
        """By the name of each promise: which cases break it."""
        with np.errstate(invalid="ignore"):
            return {
                "imbalance": ~(self.imbalance <= np.maximum(MOST_IMBALANCE, self.expressible)),
                "closure": ~(self.closure <= CLOSURE),
                "hertz": ~(self.hertz <= HERTZ),
                **{
                    field.name: getattr(self, field.name)
                    for field in fields(self)
                    if getattr(self, field.name).dtype == bool and field.name not in self.NOTED
                },
            }


class Contacts:
    """One raceway of a solution with its gaps filled: what is not there carries nothing."""

    def __init__(self, scene: qs.Scene, solution: qs.Solution, race: str) -> None:
        public = getattr(solution, race)
        self.side = -1.0 if race == "inner" else 1.0
        self.load = np.nan_to_num(public.load, nan=0.0)
        self.loaded = self.load > 0.0
        self.placed = np.isfinite(public.angle)
        self.angle = np.nan_to_num(public.angle, nan=0.0)
        self.approach = np.nan_to_num(public.approach, nan=-1.0)
        self.sine, self.cosine = np.sin(self.angle), np.cos(self.angle)
        self.semi_major, self.semi_minor = public.semi_major_axis, public.semi_minor_axis
        self.groove = _column(getattr(scene.operating_bearing, f"{race}_groove_radius"))
        self.length = self.groove - 0.5 * ball_diameters(scene, solution)
        self.share = np.zeros_like(self.load)
        self.friction = np.zeros_like(self.load)
        self.asked = np.zeros_like(self.load)


def _column(value: Any) -> NDArray:
    return np.asarray(value, float)[..., None]


def ball_diameters(scene: qs.Scene, solution: qs.Solution) -> NDArray:
    """Each ball's own in operation: balls that deviate cold do so in proportion when grown."""
    return _column(scene.operating_bearing.ball_diameter) * _relative_diameters(scene, solution)


def _relative_diameters(scene: qs.Scene, solution: qs.Solution) -> NDArray:
    deviation = solution.ball_diameter_deviation
    return np.asarray(1.0 if deviation is None else 1.0 + deviation / _column(scene.bearing.ball_diameter))


def ball_masses(scene: qs.Scene, solution: qs.Solution) -> NDArray:
    """Each ball's own: heat changes no mass."""
    cold = _column(scene.bearing.ball_diameter) * _relative_diameters(scene, solution)
    return np.asarray(_column(scene.bearing.ball_material.density) * np.pi / 6.0 * cold**3)


def findings(
    scene: qs.Scene,
    solution: qs.Solution,
    *,
    reactions: bool = True,
    friction_limit: float | None = None,
    passing: bool = False,
    force: NDArray | float = 0.0,
) -> Findings:
    """Check every case of a scene of one case axis; those that did not converge yield whatever comes out of NaN.

    Args:
        scene: the solution's, or one that differs from it in speed alone.
        reactions: whether the loads of held channels are to be the balls' sums.
        friction_limit: over load: a contact asked for more gives only as much; None for the scene's own coefficient,
            or whatever is asked.
        passing: whether to look at states on the way, where also a pressed inner line more than a right angle from the
            outer one counts as 180 degrees less that angle apart. No equilibrium may: its motion would be no rolling.
        force: the largest of each set of which the cases are rows: what a set promises is measured by it.
    """
    own = None if scene.gyroscopic_moment is None else scene.gyroscopic_moment.friction_coefficient
    friction_limit = own if friction_limit is None else friction_limit
    limit = None if friction_limit is None else _column(friction_limit)
    diameter = ball_diameters(scene, solution)
    inner, outer = (Contacts(scene, solution, race) for race in ("inner", "outer"))
    idle = ~(inner.loaded | outer.loaded)
    for side in (inner, outer):  # at rest the position of a ball that touches neither raceway is undetermined
        side.placed &= ~(idle & is_still(scene))
    there = np.isfinite(solution.azimuth)
    psi = np.where(there, solution.azimuth, 0.0)
    with np.errstate(all="ignore"):
        centrifugal, moment, sensitivity, axis_sine, no_orbit = inertia_loads(scene, solution, inner, outer, passing)
        signed = moment
        # What touches neither raceway does not roll, nor does what only the rounding of its position, a sum of four
        # numbers, presses.
        moment = np.where(np.maximum(inner.approach, outer.approach) > 4.0 * EPS * diameter, moment, 0.0)
        for side in (inner, outer):
            side.friction = side.share * moment / diameter
            side.asked = np.abs(side.friction)
            if limit is not None:
                side.friction = np.sign(side.friction) * np.minimum(side.asked, limit * side.load)
        carried = np.maximum(np.abs(inner.friction), np.abs(outer.friction))
        moment = np.minimum(np.abs(moment), diameter * carried)
        turned = [GAP * _turn(scene, solution, inner, outer, side) for side in (inner, outer)]
        by_rounding = _friction_by_rounding(inner, outer, axis_sine, sensitivity, turned)
        # Centrifugal force goes with the square of a speed.
        inertial = [
            most + 2.0 * centrifugal * sensitivity * turn for most, turn in zip(by_rounding, turned, strict=True)
        ]
        imbalance, expressible = _imbalance(
            scene, solution, inner, outer, centrifugal, moment, psi, reactions, turned, inertial, force
        )
        hertz = np.maximum(hertz_error(scene, inner, diameter), hertz_error(scene, outer, diameter))
        closure = _closure(scene, solution, inner, outer, psi)
        control = _contradicted(scene, solution, inner, outer, there)
        small = MOST_IMBALANCE * _force_scale(scene, inner, outer, centrifugal, moment)[:, None]
        unpressed, held_up = _unpressed(scene, solution, inner, outer, centrifugal, signed, small)
        no_friction = [np.maximum(small, most) for most in by_rounding]
    return Findings(
        imbalance=imbalance,
        expressible=expressible,
        misplaced=_misplaced(scene, solution),
        closure=closure,
        hertz=hertz,
        tension=_tension(solution),
        no_orbit=_any([no_orbit], there),
        unpressed=_any([unpressed], there),
        held_up=_any([held_up], there),
        friction_without_load=_any(
            (
                ~side.loaded & (side.asked > least) & there & (own is None)
                for side, least in zip((inner, outer), no_friction, strict=True)
            ),
            there,
        ),
        open_side=_any([inner.loaded & (inner.sine < -ANGLE_ROUNDING)], there)
        & (scene.bearing.kind is qs.BearingKind.ANGULAR_CONTACT),
        over_shoulder=_any([inner.loaded & (inner.cosine < -ANGLE_ROUNDING)], there),
        lines_apart=_any([is_pressed(inner, outer) & (np.cos(inner.angle - outer.angle) < -ANGLE_ROUNDING)], there),
        friction_above_load=_any((side.asked > np.maximum(side.load, 0.01 * small) for side in (inner, outer)), there),
        not_finite=_not_finite(scene, solution, there),
        control=control,
        control_unsaid=control & solution.control_is_consistent,
        misreported=~(solution.residual <= np.maximum(MOST_IMBALANCE, expressible)),
    )


def prescribed(scene: qs.Scene) -> list[tuple[Any, Any, bool]]:
    """Of each channel: its load, its displacement (None where it is not given so), and whether it is held."""
    found = []
    for c, channel in enumerate(CHANNELS):
        load, displacement = (getattr(scene.operation, name) for name in (channel.load, channel.displacement))
        is_held = displacement is not None
        if c == 0 and scene.preload is not None:
            load, displacement = scene.preload.spring, scene.preload.axial_displacement
            is_held = load is None
        found.append((load, displacement, is_held))
    return found


def heat_strain(scene: qs.Scene, body: str) -> NDArray:
    """alpha dT of a ring, the shaft or the housing; without a temperature of its own a seat is as warm as its ring."""
    rings = scene.ring_expansion
    if rings is None:
        return np.zeros(())
    inside = {"shaft": "inner_ring", "housing": "outer_ring"}.get(body, body)
    given = (getattr(rings, f"{name}_temperature") for name in (body, inside))
    warm = next((np.asarray(each, float) for each in given if each is not None), None)
    material = getattr(rings, f"{body}_material", None) or scene.bearing.ring_material
    if warm is None or material.thermal_expansion is None:
        return np.zeros(())
    return np.asarray(material.thermal_expansion * (warm - np.asarray(rings.reference_temperature, float)))


def moved_by_heat(scene: qs.Scene, race: str) -> NDArray:
    """How far the race's groove centre moves along the axis from the balls' centres: its ring grows all round."""
    bearing = scene.bearing
    past = np.asarray(getattr(bearing, f"{race}_groove_radius"), float) - 0.5 * np.asarray(bearing.ball_diameter, float)
    return np.asarray(heat_strain(scene, f"{race}_ring") * past * np.sin(bearing.free_contact_angle))


def _misplaced(scene: qs.Scene, solution: qs.Solution) -> NDArray:
    found = np.zeros(solution.shape, bool)
    for c, (_, held, _) in enumerate(prescribed(scene)):
        if held is not None:
            if c == 0 and scene.preload is not None:  # a length of the shaft
                held = np.asarray(held, float) * (1.0 + heat_strain(scene, "shaft"))
            # Axially it is shifted to where the grown grooves touch and back, by BD at most.
            shifted = scene.bearing.groove_centre_distance if c == 0 and scene.is_reshaped else 0.0
            found |= ~(np.abs(solution.displacement[:, c] - held) <= 4 * EPS * (np.abs(held) + shifted))
    return found


def _any(which: Any, there: NDArray) -> NDArray:
    found = np.zeros(there.shape, bool)
    for one in which:
        found |= one
    return (found & there).any(axis=-1)


# Motion ---------------------------------------------------------------------------------------------------------------


def speeds(scene: qs.Scene) -> tuple[NDArray, NDArray]:
    """Of the inner and of the outer ring."""
    outer = scene.operation.outer_speed
    return _column(scene.operation.speed), _column(0.0 if outer is None else outer)


def is_still(scene: qs.Scene) -> NDArray:
    """Whether neither ring turns."""
    inner, outer = speeds(scene)
    return (inner == 0.0) & (outer == 0.0)


def standing_balls(scene: qs.Scene, solution: qs.Solution) -> dict[str, NDArray]:
    """`no_orbit` and `unpressed` of a solution whose equilibrium is checked elsewhere; shape (case,)."""
    inner, outer = (Contacts(scene, solution, race) for race in ("inner", "outer"))
    there = np.isfinite(solution.azimuth)
    with np.errstate(all="ignore"):
        centrifugal, moment, _, _, no_orbit = inertia_loads(scene, solution, inner, outer, False)
        small = MOST_IMBALANCE * _force_scale(scene, inner, outer, centrifugal, moment)[:, None]
        unpressed, _ = _unpressed(scene, solution, inner, outer, centrifugal, moment, small)
    return {"no_orbit": _any([no_orbit], there), "unpressed": _any([unpressed], there)}


def _unpressed(
    scene: qs.Scene,
    solution: qs.Solution,
    inner: Contacts,
    outer: Contacts,
    centrifugal: NDArray,
    moment: NDArray,
    small: NDArray,
) -> tuple[NDArray, NDArray]:
    """Balls (case, ball) that the inner raceway does not press: those that are not where they then must be, and those
    that are held up where their orbit has gone over.

    Qo (sin ao, cos ao) = (0, Fc), to what an equilibrium resolves. Where the outer ring turns the faster, Mg has the
    sign that lifts a ball, and a slow one may be held up by it: within the gap in which its orbit still goes over, and
    beyond it where the rings turn against each other.
    """
    away = np.maximum(np.abs(outer.load * outer.sine), np.abs(outer.load * outer.cosine - centrifugal)) > small
    is_lifted = moment * outer.sine > 0.0
    goes_over = inner.approach > -LOSING * inner.length
    of_inner, of_outer = speeds(scene)
    misplaced = (centrifugal > small) & away & ~(is_lifted & (goes_over | (of_inner * of_outer < 0.0)))
    held_up = ~inner.loaded & away & is_lifted & ~goes_over
    if solution.gyroscopic_moment is not None:
        misplaced |= solution.raceway_control == "inner"
    return ~inner.loaded & misplaced, held_up


def inertia_loads(
    scene: qs.Scene, solution: qs.Solution, inner: Contacts, outer: Contacts, passing: bool
) -> tuple[NDArray, NDArray, NDArray, NDArray, NDArray]:
    """(Fc, Mg, sensitivity, p, whether rolling carries it not round) of balls, of the effects that the scene names;
    fills in shares of the moment.

    The gyroscopic moment is proportional to p, the radial part of the ball's axis: the sine of the controlling line, or
    under minimum dissipation the weighted sum of both.

    The sensitivity is how much more than itself the rounding of lines changes a speed: without bound where the orbit
    comes to rest, the rings turning against each other, and where the lines stand at right angles.
    """
    zero = np.zeros_like(inner.load)
    if solution.raceway_control is None:
        return zero, zero, zero, zero, zero.astype(bool)
    pitch, diameter = _column(scene.operating_bearing.pitch_diameter), ball_diameters(scene, solution)
    radius = 0.5 * pitch
    if scene.orbit_radius is qs.OrbitRadius.DISPLACED:  # by as much as the ball's centre from where it would just touch
        free = np.cos(_column(scene.operating_bearing.free_contact_angle))
        nominal = outer.groove - 0.5 * _column(scene.operating_bearing.ball_diameter)
        radius = radius + (outer.length + outer.approach) * outer.cosine - nominal * free
    g = 0.5 * diameter / radius
    # A pressed contact's line is its own. A ball that has lost the inner raceway goes over to the orbit of equal angles
    # within 2 % of the inner line's free length; there lines count as a right angle apart at most.
    lost = np.clip(-inner.approach / (LOSING * inner.length), 0.0, 1.0)
    weight = 1.0 - lost**2 * (3.0 - 2.0 * lost)
    seen = outer.angle + weight * _mirrored(inner.angle - outer.angle)
    rolled = np.where(is_pressed(inner, outer) & (not passing), inner.angle, seen)
    inner_sine, inner_cosine = np.sin(rolled), np.cos(rolled)
    by_inner = np.where(solution.raceway_control == "inner", 1.0, 0.0)
    if scene.raceway_control is qs.RacewayControl.MINIMUM_DISSIPATION:  # friction moments c w of both in balance
        c_inner, c_outer = spin_constants(scene, solution, inner, outer)
        at_inner, at_outer = c_inner * (1.0 + g * outer.cosine), c_outer * (1.0 - g * inner_cosine)
        by_inner = np.where(inner.loaded, at_inner / (at_inner + at_outer), 0.0)
    # The ball's axis (cos beta, sin beta): p along the radius, q along the bearing axis, in proportion.
    p = by_inner * inner_sine + (1.0 - by_inner) * outer.sine
    q = by_inner * (inner_cosine - g) + (1.0 - by_inner) * (outer.cosine + g)
    length = np.hypot(p, q)
    sin_beta, cos_beta = p / length, q / length
    u = (outer.cosine * cos_beta + outer.sine * sin_beta) / (1.0 + g * outer.cosine)
    v = (inner_cosine * cos_beta + inner_sine * sin_beta) / (1.0 - g * inner_cosine)
    wi, wo = speeds(scene)
    orbit = (u * wi + v * wo) / (u + v)
    rotation = -(wi - wo) / (g * (u + v))
    sensitivity = (np.abs(wi) + np.abs(wo)) / np.abs(u * wi + v * wo) + 2.0 / np.abs(u + v)
    centrifugal, moment = zero, zero
    if scene.centrifugal_force is not None:
        centrifugal = ball_masses(scene, solution) * radius * orbit**2
    if scene.gyroscopic_moment is not None:
        moment = 0.1 * ball_masses(scene, solution) * diameter**2 * rotation * orbit * sin_beta
        own = 1.0 if scene.gyroscopic_moment.moment_shares is qs.MomentShares.HARRIS else 2.0
        inner.share = own * by_inner
        outer.share = 2.0 - inner.share
    turns = inner.placed & outer.placed & ~is_still(scene)
    # An orbit wholly at rest has no moment that could be rounding's.
    sensitivity = np.nan_to_num(sensitivity, nan=0.0, posinf=0.0)
    # Without centrifugal force a ball that touches neither raceway lies anywhere.
    rolls = turns & (inner.loaded | outer.loaded | (scene.centrifugal_force is not None))
    # Under outer control u does not vanish, and v does where the ball goes round with the inner ring: it does go round.
    rolled_by_outer = (by_inner == 0.0) & (scene.raceway_control is not qs.RacewayControl.MINIMUM_DISSIPATION)
    most = np.where(rolled_by_outer, 0.0, LEAST_WEIGHT)
    least = np.where(wo == 0.0, LEAST_ORBIT, LEAST_WEIGHT)
    no_orbit = rolls & ~((u > least * (u + v)) & (v > most * (u + v)))
    return np.where(turns, centrifugal, 0.0), np.where(turns, moment, 0.0), sensitivity, p, no_orbit


def is_pressed(inner: Contacts, outer: Contacts) -> NDArray:
    """Whether each inner contact carries a load that an equilibrium resolves."""
    return np.asarray(inner.load > NO_FORCE * np.maximum(inner.load, outer.load).max(axis=-1, keepdims=True))


def _mirrored(angle: NDArray) -> NDArray:
    """The angle of the same sine at most a right angle from zero, with all digits also near one, unlike an arcsine."""
    near = np.remainder(angle + np.pi, 2.0 * np.pi) - np.pi
    return np.where(np.abs(near) <= 0.5 * np.pi, near, np.copysign(np.pi, near) - near)


# Equilibrium --------------------------------------------------------------------------------------------------------


def tilt_lever(scene: qs.Scene) -> NDArray:
    """The radius at which axial forces make moments."""
    if scene.tilt_lever is qs.TiltLever.PITCH_CIRCLE:
        return 0.5 * np.asarray(scene.operating_bearing.pitch_diameter, float)
    return np.asarray(scene.operating_bearing.inner_groove_centre_radius, float)


def _force_scale(scene: qs.Scene, inner: Contacts, outer: Contacts, centrifugal: NDArray, moment: NDArray) -> NDArray:
    """The largest applied or inertial force of each case; with a held channel contact loads too, being the reaction.

    Never less than the least load.
    """
    cases = inner.load.shape[0]
    half_pitch = 0.5 * np.asarray(scene.operating_bearing.pitch_diameter, float)
    scale = np.maximum(centrifugal, np.abs(moment) / _column(scene.operating_bearing.ball_diameter)).max(axis=-1)
    is_any_held = False
    for channel, (load, _, is_held) in zip(CHANNELS, prescribed(scene), strict=True):
        if is_held:
            is_any_held = True
        elif load is not None:
            force = np.abs(load) / (half_pitch if channel.is_rotation else 1.0)
            scale = np.maximum(scale, np.broadcast_to(force, cases))
    if is_any_held:
        scale = np.maximum(scale, np.maximum(inner.load, outer.load).max(axis=-1))
    return np.maximum(scale, _least_load(scene, inner, outer))


def _least_load(scene: qs.Scene, inner: Contacts, outer: Contacts) -> NDArray:
    """What a contact would carry if it were pressed by the rounding of a ball diameter; less is no load.

    By the stiffness of the contacts that are pressed, and that of a ball on a plane.
    """
    diameter = np.asarray(scene.operating_bearing.ball_diameter, float)
    stiffness = np.asarray(scene.bearing.effective_modulus * np.sqrt(diameter), float)
    for side in (inner, outer):
        pressed = side.loaded & (side.approach > LEAST_PRESSED)
        own = side.load / np.where(pressed, side.approach, 1.0) ** 1.5
        stiffness = np.maximum(stiffness, np.where(pressed, own, 0.0).max(axis=-1))
    return np.asarray(stiffness * (EPS * diameter) ** 1.5)


def _imbalance(
    scene: qs.Scene,
    solution: qs.Solution,
    inner: Contacts,
    outer: Contacts,
    centrifugal: NDArray,
    moment: NDArray,
    psi: NDArray,
    reactions: bool,
    turned: list[NDArray],
    inertial: list[NDArray],
    force: NDArray | float,
) -> tuple[NDArray, NDArray]:
    i, o = inner, outer
    axial = i.load * i.sine - o.load * o.sine - i.friction * i.cosine + o.friction * o.cosine
    radial = i.load * i.cosine - o.load * o.cosine + i.friction * i.sine - o.friction * o.sine + centrifugal
    worst = np.maximum(np.abs(axial), np.abs(radial)).max(axis=-1)
    axial_force, radial_force = i.load * i.sine - i.friction * i.cosine, i.load * i.cosine + i.friction * i.sine
    lever = tilt_lever(scene)[..., None]
    tilting = lever * axial_force + i.groove * i.friction
    cosine, sine = np.cos(psi), np.sin(psi)
    sums = [axial_force, radial_force * cosine, radial_force * sine, tilting * sine, -tilting * cosine]
    half_pitch = 0.5 * np.asarray(scene.operating_bearing.pitch_diameter, float)
    for c, (given, _, is_held) in enumerate(prescribed(scene)):
        arm = half_pitch if CHANNELS[c].is_rotation else 1.0
        carried = solution.load[:, c]
        if is_held:
            if not reactions:
                continue
        else:
            wanted = np.asarray(0.0 if given is None else given, float)
            carried = np.where(np.abs(carried - wanted) <= 4 * EPS * np.abs(wanted), wanted, np.nan)
        worst = np.maximum(worst, np.abs(sums[c].sum(axis=-1) - carried) / arm)
    scale = np.maximum(_force_scale(scene, inner, outer, centrifugal, moment), force)
    rounding = np.zeros(scale.shape)
    for side, turn_by_rounding, of_inertia in zip((i, o), turned, inertial, strict=True):
        rounding += (side.load * (4 * EPS + turn_by_rounding) + of_inertia).sum(axis=-1)
    return np.where(worst <= _least_load(scene, i, o), 0.0, worst / scale), rounding / scale


def _turn(scene: qs.Scene, solution: qs.Solution, i: Contacts, o: Contacts, side: Contacts) -> NDArray:
    """How far a contact line turns when positions move by the rounding of what they are made of, over that rounding."""
    moved = np.abs(solution.displacement[:, :3]).sum(axis=-1, keepdims=True)
    tilted = np.abs(solution.displacement[:, 3:]).sum(axis=-1, keepdims=True)
    return (moved + tilt_lever(scene)[..., None] * tilted + i.length + o.length) / side.length


def _friction_by_rounding(
    i: Contacts, o: Contacts, axis_sine: NDArray, sensitivity: NDArray, turned: list[NDArray]
) -> list[NDArray]:
    """(case, ball), of each contact: the friction that rounding of positions makes or takes.

    It follows the speeds and the radial part p of the axis, T = c p: a line that turns by e changes it by c e = T e/p
    at most. Lines may be known to all digits and p to none: near a line at zero, and under minimum dissipation wherever
    w sin(ai) and (1 - w) sin(ao) all but cancel, which is where balls go that have little else to carry a large moment.
    What rounding makes of the weight w is of that size too.
    """
    most = np.maximum(np.abs(i.friction), np.abs(o.friction))
    slope = most / np.maximum(np.abs(axis_sine), np.finfo(float).tiny)
    return [(slope + most * sensitivity) * turn for turn in turned]


LEAST_PRESSED = 1e-200
"""Metres: the load of a smaller approach, its power 1.5, is below any number."""


def _tension(solution: qs.Solution) -> NDArray:
    found = np.zeros(solution.shape, bool)
    for contacts in (solution.inner, solution.outer):
        with np.errstate(invalid="ignore"):
            pressed, is_felt = contacts.approach > 0.0, contacts.approach > LEAST_PRESSED
            wrong = (contacts.load < 0.0) | ((contacts.load > 0.0) & ~pressed) | (~(contacts.load > 0.0) & is_felt)
            found |= wrong.any(axis=-1)
    return found


# Geometry and Hertz ---------------------------------------------------------------------------------------------------


def _closure(scene: qs.Scene, solution: qs.Solution, inner: Contacts, outer: Contacts, psi: NDArray) -> NDArray:
    d = [solution.displacement[:, c, None] for c in range(5)]
    cosine, sine = np.cos(psi), np.sin(psi)
    lever = tilt_lever(scene)[..., None]
    tilt = lever * (d[3] * sine - d[4] * cosine)
    # Axially heat alone moves the groove centres in their rings; radially they stand apart as they have grown.
    cold, grown = scene.bearing, scene.operating_bearing
    touching = cold.groove_centre_distance * np.sin(cold.free_contact_angle)
    a1 = _column(touching + moved_by_heat(scene, "inner") + moved_by_heat(scene, "outer")) + d[0] + tilt
    apart = grown.groove_centre_distance * np.cos(grown.free_contact_angle) + grown.radial_interference
    a2 = _column(apart) + d[1] * cosine + d[2] * sine
    li, lo = inner.length + inner.approach, outer.length + outer.approach
    gap = np.maximum(np.abs(li * inner.sine + lo * outer.sine - a1), np.abs(li * inner.cosine + lo * outer.cosine - a2))
    # The groove radii themselves are rounded: their small difference from the ball's carries that along.
    parts = (d[0], d[1], d[2], lever * d[3], lever * d[4])
    size = np.maximum(inner.groove + outer.groove, np.max(np.abs(np.broadcast_arrays(*parts)), axis=0))
    placed = inner.placed & outer.placed
    return np.where(placed, gap / size, 0.0).max(axis=-1)


def _curvatures(
    scene: qs.Scene, contacts: Contacts, diameter: NDArray, angle: qs.HertzAngle
) -> tuple[NDArray, NDArray]:
    """In the rolling direction and across [1/m]."""
    bearing = scene.operating_bearing
    gamma = diameter / _column(bearing.pitch_diameter)
    cosine: Any = contacts.cosine
    if angle is qs.HertzAngle.FREE:
        cosine = np.cos(_column(bearing.free_contact_angle))
    elif angle is qs.HertzAngle.ZERO:
        cosine = 1.0
    rolling = 2.0 / (diameter * (1.0 + contacts.side * gamma * cosine))
    return rolling, 2.0 / diameter - 1.0 / contacts.groove


def _ratio_of_curvatures(k: NDArray) -> NDArray:
    """Larger over smaller of the exact ellipse a = k b: int sin^2/Delta and int cos^2/Delta, k^2 B/D."""
    return np.asarray(k**2 * (elliprd(0.0, k**2, 1.0) * k) / elliprd(0.0, 1.0 / k**2, 1.0))


def _shape(form: qs.HertzForm, ratio: NDArray, k: NDArray | None = None) -> tuple[NDArray, NDArray, NDArray]:
    """(k, K, E) of an ellipse by the ratio of its curvatures; of the exact one k is sought if it is not known."""
    if form is qs.HertzForm.BREWE_HAMROCK_1977:
        return 1.0339 * ratio**0.636, 1.5277 + 0.6023 * np.log(ratio), 1.0003 + 0.5968 / ratio
    if form is qs.HertzForm.HAMROCK_BREWE_1983:
        return ratio ** (2.0 / np.pi), np.pi / 2 + (np.pi / 2 - 1) * np.log(ratio), 1.0 + (np.pi / 2 - 1) / ratio
    if k is None:
        k = ratio**0.636
        for _ in range(60):  # ln(ratio) over ln(k) runs from 4/3 at a circle to 2 and more: damped, sure, to all digits
            k = np.maximum(k * (ratio / _ratio_of_curvatures(k)) ** 0.6, 1.0)
    kc2 = 1.0 / k**2
    return k, elliprf(0.0, kc2, 1.0), 2.0 * elliprg(0.0, kc2, 1.0)


def spin_constants(scene: qs.Scene, solution: qs.Solution, inner: Contacts, outer: Contacts) -> tuple[NDArray, NDArray]:
    """Q a E of both raceways, ellipses at the angle of constant stiffness."""
    angle = qs.HertzAngle.ZERO if scene.hertz_angle is qs.HertzAngle.ZERO else qs.HertzAngle.FREE
    found = []
    for side in (inner, outer):
        rolling, across = _curvatures(scene, side, ball_diameters(scene, solution), angle)
        k, _, second = _shape(scene.hertz_form, np.maximum(rolling, across) / np.minimum(rolling, across))
        found.append(np.cbrt(k**2 * second / (rolling + across)) * second * side.load ** (4.0 / 3.0))
    return found[0], found[1]


def hertz_error(scene: qs.Scene, contacts: Contacts, diameter: NDArray) -> NDArray:
    """Largest relative error of any ellipse's shape and of any load of a raceway's loaded contacts; shape (case,)."""
    where = contacts.loaded
    if not where.any():
        return np.zeros(where.shape[0])
    curvatures = _curvatures(scene, contacts, diameter, scene.hertz_angle)
    rolling, across = (np.broadcast_to(array, where.shape)[where] for array in curvatures)
    load, approach = contacts.load[where], contacts.approach[where]
    k = contacts.semi_major[where] / contacts.semi_minor[where]
    ratio, total = np.maximum(rolling, across) / np.minimum(rolling, across), rolling + across
    shape, first, second = _shape(scene.hertz_form, ratio, k)
    error = np.abs(k / shape - 1.0)
    if scene.hertz_form is qs.HertzForm.EXACT:
        error = np.abs(_ratio_of_curvatures(k) / ratio - 1.0)
    modulus = np.broadcast_to(_column(scene.bearing.effective_modulus), where.shape)[where]
    stiffness = np.pi * k * modulus * np.sqrt(second / (4.5 * total * first**3))
    axis = np.cbrt(6.0 * k**2 * second * load / (np.pi * total * modulus))
    error = np.maximum(error, np.abs(load / (stiffness * approach**1.5) - 1.0))
    error = np.maximum(error, np.abs(contacts.semi_major[where] / axis - 1.0))
    worst = np.zeros(where.shape)
    worst[where] = error
    return worst.max(axis=-1)


def _contradicted(scene: qs.Scene, solution: qs.Solution, inner: Contacts, outer: Contacts, there: NDArray) -> NDArray:
    """Jones: the outer raceway controls where Qo ao Eo cos(ai - ao) > Qi ai Ei; near equality either will do."""
    if scene.raceway_control is not qs.RacewayControl.PER_BALL:
        return np.zeros(there.shape[0], bool)
    spin = []
    for side in (inner, outer):
        with np.errstate(invalid="ignore", divide="ignore"):
            kc2 = np.where(side.loaded, (side.semi_minor / side.semi_major) ** 2, 1.0)
        spin.append(side.load * np.nan_to_num(side.semi_major) * 2.0 * elliprg(0.0, kc2, 1.0))
    held_back = spin[1] * np.cos(inner.angle - outer.angle)
    # Closed forms have their own E, within a hundredth of the exact one of their ellipses.
    margin = 1e-9 if scene.hertz_form is qs.HertzForm.EXACT else 1e-2
    decided = np.abs(held_back - spin[0]) > margin * np.maximum(spin[0], spin[1])
    outer_speed = 0.0 if scene.operation.outer_speed is None else scene.operation.outer_speed
    is_moving = (np.asarray(scene.operation.speed) != 0.0) | (np.asarray(outer_speed) != 0.0)
    # The outer raceway controls a ball that has left the inner one, from whatever side that is seen.
    wanted_outer = np.where(inner.loaded, held_back > spin[0], True)
    wrong = (decided | ~inner.loaded) & (wanted_outer != (solution.raceway_control == "outer")) & there
    return wrong.any(axis=-1) & is_moving


def _not_finite(scene: qs.Scene, solution: qs.Solution, there: NDArray) -> NDArray:
    bad = ~np.isfinite(solution.displacement).all(axis=-1) | ~np.isfinite(solution.load).all(axis=-1)
    arrays = [getattr(side, name) for side in (solution.inner, solution.outer) for name in (
        "load", "semi_major_axis", "semi_minor_axis", "max_pressure"
    )]  # fmt: skip
    named = (solution.centrifugal_force, solution.gyroscopic_moment, solution.orbital_speed, solution.rotation_speed)
    arrays += [array for array in named if array is not None]
    for array in arrays:
        bad |= (~np.isfinite(array) & there).any(axis=-1)
    return bad
