"""Whether a case that is said to have no equilibrium has none: the reason given, checked without the solver's word.

Certificates, tried in this order; what is a proof and what is evidence is counted apart. They know bearings whose rings
have grown, whose balls are unequal and which a preload presses: a contact still presses the ring along its own angle,
growth and deviations only move where contact begins, and a spring is a load. They do not know rings that bend, but for
the first two, which hold whatever gives between the balls.

unsupported direction (proof)
    A direction of the ring in the free channels along which the load works and no ball is ever pressed. Every loaded
    contact of a bearing with one open side presses the ring with Q (sin a, cos a), 0 <= a <= 90 degrees, so the balls'
    forces fill a cone, spanned by each ball's axial and radial force; the friction of the gyroscopic moment must not
    act on the ring (outer control, or no such moment). The load's nearest point in the cone, by non-negative least
    squares, leaves a remainder r: if it is not nothing, r itself is the direction (Farkas), and all that is believed of
    it is checked: r . load > 0 and r . force <= 0 for every force of a ball.
null motion (proof)
    A motion of the ring that moves no groove centre in any ball's plane (one or two balls), along which the load works:
    the energy falls without end.
open side, unique equilibrium (proof)
    The equations as they stand, with shoulders on both sides, have an equilibrium, checked as any other, and in it a
    loaded inner contact has a negative angle. At rest with constant Hertz stiffness the energy is convex, so the loads
    of its least are unique and no other equilibrium keeps to the supported side.
open side, over the shoulder, lines apart, no orbit, friction without load: an equilibrium (evidence)
    The equations as the solver passes through them, which know no open side and no shoulders, see lines at most a right
    angle apart, let balls stand and any contact carry its share of the gyroscopic moment, have an equilibrium, checked
    as any other, that breaks one of these restrictions. That there is no other is not proved.
friction above the load, an equilibrium (evidence)
    With friction that is never more than the contact's load, or than a tenth of it, there is an equilibrium, checked as
    any other, and in it some contact is asked for more than its load: the ball slips. That the equations, which ask
    whatever the load, have no equilibrium elsewhere is not proved.
the same at part of the speed (evidence)
    So it is at a part of the speed, continued from rest: the equilibrium is checked at that part. Beyond it the one
    that comes from rest is none of a bearing.
friction above the thrust (evidence)
    Under inner control with thrust alone: more thrust has equilibria, and as it falls to where the last one is, checked
    as any other, a contact loses its load, so that friction alone carries what is left. The scene has less.
over the shoulder, under more thrust (evidence)
    Likewise, and at the last one a contact is at the end of its groove, 90 degrees: under less it lies beyond.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

import qsbearing as qs
from qsbearing.model.operation import CHANNELS
from tests.verification.campaign.checks import findings, prescribed, tilt_lever
from tests.verification.campaign.group import Group

PROOFS = ("unsupported direction", "null motion", "open side, unique equilibrium")
"""The other kinds are evidence."""
NONE = "none"
NOT_PROVED = "not proved"
"""Of scenes with preload, growth or unequal balls for which none is found: their refusals are counted, and nothing says
more for them than the solver's word."""

ROUNDING = 1e-12
"""Of scalar products of unit vectors."""

FALLING = 1e-5
"""Of the thrust: how far apart that with an equilibrium and that without may lie."""
MOST_THRUST = 9.9e7
"""Of a bearing [N], which is within the bounds of `Operation`: where no thrust up to it has an equilibrium, none is."""
AT_SHOULDER = 1e-3
"""Cosine of a contact angle that is a right angle at the last thrust, which is FALLING from none."""
WITHOUT_LOAD = 1e3
"""Friction over load that says that a contact bears nothing; it grows without bound where the load goes to zero."""

FRICTION_LIMITS = (None, 1.0, 0.1)
"""Of friction over load: none, what no material exceeds, what oiled steel carries."""

LEAST_REMAINDER = 1e-9
"""Of the load: a remainder smaller than this might be rounding of the cone's vectors."""

RESTRICTIONS = {
    "open_side": "open side",
    "over_shoulder": "over the shoulder",
    "lines_apart": "lines apart",
    "no_orbit": "no orbit",
    "friction_without_load": "friction without load",
    "friction_above_load": "friction above the load",
}
"""What the equations as they stand do not know, and a bearing does."""

UNASKED = ("misreported", "control_unsaid")
"""What is not asked of a state on the way: its own residual's word, and whether controls have settled."""


@dataclass(frozen=True)
class Certificate:
    """Why a case has no equilibrium."""

    kind: str
    """One of PROOFS, or evidence by its name, or NONE."""
    direction: NDArray | None = None
    """For the first two: of the ring in the five channels, tilts times the pitch radius."""


def by_strength(kinds: Mapping[str, int]) -> dict[str, Any]:
    """Of refused cases by their certificates: how many are proved, have evidence, or neither; for the record."""
    proofs, without, not_proved = (
        sum(kinds.get(kind, 0) for kind in which) for which in (PROOFS, (NONE,), (NOT_PROVED,))
    )
    return {
        "certificates": dict(kinds),
        "proofs": proofs,
        "evidence": sum(kinds.values()) - proofs - without - not_proved,
        "not_proved": not_proved,
        "without": without,
    }


# One case -------------------------------------------------------------------------------------------------------------


def forces_of_balls(scene: qs.Scene, first: float) -> NDArray:
    """(5, 2 Z): what a unit of axial and of radial force of each ball does in the five channels, moments over dm/2."""
    count = int(np.asarray(scene.bearing.ball_count))
    psi = first + 2.0 * np.pi * np.arange(count) / count
    zero, one = np.zeros(count), np.ones(count)
    arm = float(tilt_lever(scene)) / (0.5 * float(np.asarray(scene.bearing.pitch_diameter)))
    axial = np.array([one, zero, zero, arm * np.sin(psi), -arm * np.cos(psi)])
    radial = np.array([zero, np.cos(psi), np.sin(psi), zero, zero])
    return np.concatenate([axial, radial], axis=1)


def free_load(scene: qs.Scene) -> tuple[list[int], NDArray]:
    """The free channels, and their loads with moments over dm/2."""
    arm = 0.5 * float(np.asarray(scene.bearing.pitch_diameter))
    given = [(c, load) for c, (load, _, is_held) in enumerate(prescribed(scene)) if not is_held]
    load = [float(np.asarray(value or 0.0)) / (arm if CHANNELS[c].is_rotation else 1.0) for c, value in given]
    return [c for c, _ in given], np.array(load)


def friction_acts_on_ring(scene: qs.Scene) -> bool:
    """Whether some share of the gyroscopic moment may fall to the inner raceway while the bearing turns."""
    if scene.gyroscopic_moment is None or scene.raceway_control is qs.RacewayControl.OUTER:
        return False
    speeds = (scene.operation.speed, scene.operation.outer_speed)
    return any(float(np.asarray(speed or 0.0)) != 0.0 for speed in speeds)


def unsupported_direction(scene: qs.Scene) -> NDArray | None:
    """A direction (5,) along which the load works and no ball is pressed; None if there is none, or none provable."""
    if scene.bearing.kind is not qs.BearingKind.ANGULAR_CONTACT or friction_acts_on_ring(scene):
        return None
    free, load = free_load(scene)
    size = np.abs(load).max(initial=0.0)
    if size == 0.0:
        return None
    cone = forces_of_balls(scene, float(np.asarray(scene.operation.first_ball_azimuth)))[free]
    direction = remainder(cone, load / size)
    if direction is None:
        return None
    full = np.zeros(5)
    full[free] = direction
    return full if supports_nothing(scene, full) else None


def remainder(cone: NDArray, wanted: NDArray) -> NDArray | None:
    """Direction from the nearest point of a cone of generators (channel, generator) to a load; None for one inside."""
    apart = wanted - cone @ nnls(cone, wanted, maxiter=100 * cone.shape[1])[0]
    length = np.linalg.norm(apart)
    return None if length < LEAST_REMAINDER else np.asarray(apart / length)


def supports_nothing(scene: qs.Scene, direction: NDArray) -> bool:
    """Whether along this direction the load works and no ball is pressed."""
    free, load = free_load(scene)
    cone = forces_of_balls(scene, float(np.asarray(scene.operation.first_ball_azimuth)))
    held = np.ones(5, bool)
    held[free] = False
    works = direction[free] @ load / np.abs(load).max() > ROUNDING
    presses = (direction @ cone > ROUNDING * np.linalg.norm(cone, axis=0)).any()
    return bool(works and not presses and not direction[held].any())


def null_motion(scene: qs.Scene) -> NDArray | None:
    """A direction (5,) that moves no groove centre and along which the load works."""
    free, load = free_load(scene)
    if not free or friction_acts_on_ring(scene) or not load.any():
        return None
    moves = forces_of_balls(scene, float(np.asarray(scene.operation.first_ball_azimuth)))[free].T
    _, sizes, directions = np.linalg.svd(moves, full_matrices=True)
    rank = int((sizes > ROUNDING * sizes[0]).sum())
    null = directions[rank:]
    along = null.T @ (null @ load)
    length = np.linalg.norm(along)
    if length <= LEAST_REMAINDER * np.linalg.norm(load):
        return None
    full = np.zeros(5)
    full[free] = along / length
    return full


# Many cases -----------------------------------------------------------------------------------------------------------


def certify(group: Group, solution: qs.Solution, index: NDArray) -> list[Certificate]:
    """A certificate for each of these scenes of a group, all of which the solution says to have no equilibrium."""
    certificates = [directional(group.part(int(k)).scene()) for k in index]
    broken = restrictions_broken(group, solution)
    for position, k in enumerate(index):
        if certificates[position].kind != NONE:
            continue
        is_still = is_at_rest(group, int(k))
        is_whole = is_still or float(solution.speed_reached[k]) == 1.0
        # Where a rigid preload holds the ring, the solver alone says where.
        is_placed = "rigid_N" not in group.more.get("preload", {})
        is_unique = group.hertz_angle is not qs.HertzAngle.ACTUAL and is_still and is_placed
        for name, words in RESTRICTIONS.items():
            if not broken[name][k]:
                continue
            where = "an equilibrium" if is_whole else "at part of the speed"
            if name == "open_side" and is_unique:
                where = "unique equilibrium"
            certificates[position] = Certificate(f"{words}, {where}")
            break
        else:
            certificates[position] = Certificate(end_under_thrust(group.part([int(k)]).scene()))
    return certificates


def end_under_thrust(scene: qs.Scene) -> str:
    """What ends the equilibria of one case under inner control as its thrust falls to the scene's; NONE for nothing."""
    loads = [getattr(scene.operation, channel.load) for channel in CHANNELS]
    others = [load for load in loads[1:] if load is not None]
    if scene.raceway_control is not qs.RacewayControl.INNER or loads[0] is None or np.any(others):
        return NONE

    def under(factor: float) -> qs.Solution:
        load = factor * np.asarray(loads[0], float)
        return qs.solve(replace(scene, operation=replace(scene.operation, axial_load=load)))

    low, high = 1.0, 2.0
    while not (last := under(high)).converged.all():
        low, high = high, 2.0 * high
        if high * np.abs(np.asarray(loads[0], float)).max() > MOST_THRUST:
            return NONE
    while high > (1.0 + FALLING) * low:
        middle = 0.5 * (low + high)
        tried = under(middle)
        if tried.converged.all():
            high, last = middle, tried
        else:
            low = middle
    if any(bad.any() for bad in findings(last.scene, last).failed().values()):
        return NONE
    sides = last.inner, last.outer
    if max(np.nanmax(np.asarray(side.required_friction)) for side in sides) > WITHOUT_LOAD:
        return "friction above the thrust"
    is_at_end = min(np.nanmin(np.cos(np.asarray(side.angle))) for side in sides) < AT_SHOULDER
    return "over the shoulder, under more thrust" if is_at_end else NONE


def directional(scene: qs.Scene) -> Certificate:
    """The certificate of a single scene that needs no equilibrium at all."""
    for kind, seek in (("unsupported direction", unsupported_direction), ("null motion", null_motion)):
        direction = seek(scene)
        if direction is not None:
            return Certificate(kind, direction)
    return Certificate(NONE)


def is_at_rest(group: Group, index: int) -> bool:
    """Whether no inertia acts: no effect, or no speed."""
    return not group.effects or not (group.operation["speed_rpm"][index] or group.operation["outer_speed_rpm"][index])


def as_left(solution: qs.Solution) -> qs.Solution:
    """The solution with every case counting as converged: its arrays then show where the solver left off."""
    left = copy.copy(solution)
    for name in [name for name in vars(left) if isinstance(getattr(type(left), name, None), cached_property)]:
        del left.__dict__[name]  # what was read off the cases before
    left._solved = copy.copy(solution._solved)
    left._solved.results, left._solved._known = left._solved.results.copy(), {}
    left.codes[:] = 0
    return left


def restrictions_broken(
    group: Group, solution: qs.Solution, limits: tuple[float | None, ...] = FRICTION_LIMITS
) -> dict[str, NDArray]:
    """By restriction: whether each case was left in a sound equilibrium that breaks it.

    An equilibrium of the equations as they stand, or with limited friction; sound at the part of the speed at which it
    was left. What a solution says of reactions is not asked of such a state.
    """
    scene = group.scene()
    part = np.asarray(solution.speed_reached, float)
    operation = scene.operation
    speeds = {name: part * np.asarray(getattr(operation, name), float) for name in ("speed", "outer_speed")}
    scene = replace(scene, operation=replace(operation, **speeds))
    broken = {name: np.zeros(solution.shape, bool) for name in RESTRICTIONS}
    for limit in limits:
        found = findings(scene, as_left(solution), reactions=False, friction_limit=limit, passing=True)
        failed = found.failed()
        sound = ~np.any([bad for name, bad in failed.items() if name not in (*RESTRICTIONS, *UNASKED)], axis=0)
        for name in RESTRICTIONS:
            # more friction than load is nothing that the equations as they stand forbid
            if limit is not None or name != "friction_above_load":
                broken[name] |= sound & getattr(found, name)
    return broken
