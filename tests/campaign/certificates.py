"""Whether a case that is said to have no equilibrium has none: the reason given, checked without the solver's word.

Certificates, tried in this order; what is a proof and what is evidence is counted apart.

unsupported direction (proof)
    A direction of the ring in the free channels along which the load works and no ball is ever pressed. Every loaded
    contact of a bearing with one open side pushes the ring with Q (sin a, cos a), 0 <= a <= 90 degrees, so the balls'
    forces fill a cone, spanned by each ball's axial and radial push; the friction of the gyroscopic moment must not
    act on the ring (outer control, or no such moment). The load's nearest point in the cone, by non-negative least
    squares, leaves a remainder r: if it is not nothing, r itself is the direction (Farkas), and all that is believed of
    it is checked: r . load > 0 and r . push <= 0 for every push.
null motion (proof)
    A motion of the ring that moves no groove centre in any ball's plane (one or two balls), along which the load works:
    the energy falls without end.
open side, unique balance (proof)
    The equations as they stand, with shoulders on both sides, have a balance, checked as any other, and in it a loaded
    inner contact has a negative angle. At rest with constant Hertz stiffness the energy is convex, so the loads of its
    least are unique and no other balance keeps to the supported side.
open side, a balance (evidence)
    The same at speed, or with stiffness that turns with the angle. That there is no other balance is not proved.
friction without load, a balance (evidence)
    The equations as they stand, which let any contact carry its share of the gyroscopic moment, have a balance, checked
    as any other, and in it a contact without load carries some.
friction above the load (evidence)
    The scene is followed up in speed, both rings in proportion: where the last balance is found, some contact needs
    more friction than its load. That the branch ends there is seen; that there is no other is not proved.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

import qsbearing as qs
from qsbearing import outcome
from qsbearing.operation import CHANNELS
from tests.campaign.checks import findings, tilt_lever
from tests.campaign.envelope import Group

PROOFS = ("unsupported direction", "null motion", "open side, unique balance")
EVIDENCE = ("open side, a balance", "friction without load, a balance", "friction above the load")
NONE = "none"

ROUNDING = 1e-12
"""Of scalar products of unit vectors."""

LEAST_REMAINDER = 1e-9
"""Of the load: a remainder smaller than this might be rounding of the cone's vectors."""

STATES, ROUNDS = 12, 2
"""Speeds at which a scene is followed up in one go, and how often the last gap is divided so."""

RESTRICTIONS = ("open_side", "friction_without_load")
"""What the equations as they stand do not know, and a bearing does."""


@dataclass(frozen=True)
class Certificate:
    """Why a case has no equilibrium."""

    kind: str
    """One of PROOFS or EVIDENCE, or NONE."""
    direction: NDArray | None = None
    """For the first two: of the ring in the five channels, tilts times the pitch radius."""

    @property
    def is_proof(self) -> bool:
        return self.kind in PROOFS


def stated_reason(solution: qs.Solution, index: int) -> str:
    """The solver's own word."""
    notes = int(solution._notes[index])
    names = {
        "runaway": outcome.RUNAWAY,
        "open side": outcome.OPEN_SIDE,
        "friction without load": outcome.FRICTION_WITHOUT_LOAD,
    }
    return " and ".join(name for name, bit in names.items() if notes & bit) or "unsaid"


# One case -------------------------------------------------------------------------------------------------------------


def pushes(scene: qs.Scene, first: float) -> NDArray:
    """(5, 2 Z): what a unit of axial and of radial push of each ball does in the five channels, moments over dm/2."""
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
    free = [c for c, channel in enumerate(CHANNELS) if getattr(scene.operation, channel.displacement) is None]
    load = [float(np.asarray(getattr(scene.operation, CHANNELS[c].load) or 0.0)) for c in free]
    return free, np.array(
        [value / (arm if CHANNELS[c].is_rotation else 1.0) for c, value in zip(free, load, strict=True)]
    )


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
    cone = pushes(scene, float(np.asarray(scene.operation.first_ball_azimuth)))[free]
    wanted = load / size
    direction = wanted - cone @ nnls(cone, wanted, maxiter=100 * cone.shape[1])[0]
    length = np.linalg.norm(direction)
    if length < LEAST_REMAINDER:
        return None
    direction /= length
    full = np.zeros(5)
    full[free] = direction
    return full if supports_nothing(scene, full) else None


def supports_nothing(scene: qs.Scene, direction: NDArray) -> bool:
    """Whether along this direction the load works and no ball is pressed."""
    free, load = free_load(scene)
    cone = pushes(scene, float(np.asarray(scene.operation.first_ball_azimuth)))
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
    moves = pushes(scene, float(np.asarray(scene.operation.first_ball_azimuth)))[free].T
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
    for place, k in enumerate(index):
        if certificates[place].kind != NONE:
            continue
        if broken["open_side"][k]:
            is_unique = group.hertz_angle is not qs.HertzAngle.ACTUAL and is_at_rest(group, int(k))
            certificates[place] = Certificate("open side, unique balance" if is_unique else "open side, a balance")
        elif broken["friction_without_load"][k]:
            certificates[place] = Certificate("friction without load, a balance")
    left = [place for place, found in enumerate(certificates) if found.kind == NONE]
    if left and "gyroscopic_moment" in group.effects:
        outgrown = friction_outgrows_load(group.part(index[left]))
        for place, found in zip(left, outgrown, strict=True):
            if found:
                certificates[place] = Certificate("friction above the load")
    return certificates


def directional(scene: qs.Scene) -> Certificate:
    """The certificate of a single scene that needs no balance at all."""
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
    for name in [name for name in vars(left) if not name.startswith("_") and name not in ("scene", "shape", "seconds")]:
        del left.__dict__[name]  # what was read off the cases before
    left._codes = np.zeros_like(solution._codes)
    left.inner = type(solution.inner)(left, solution.inner._side)
    left.outer = type(solution.outer)(left, solution.outer._side)
    return left


def restrictions_broken(group: Group, solution: qs.Solution) -> dict[str, NDArray]:
    """By restriction: whether each case was left in a sound balance of the equations as they stand that breaks it."""
    found = findings(group.scene(), as_left(solution))
    failed = found.failed()
    sound = ~np.any([bad for name, bad in failed.items() if name not in RESTRICTIONS], axis=0)
    return {name: sound & getattr(found, name) for name in RESTRICTIONS}


def friction_outgrows_load(group: Group) -> NDArray:
    """Whether, followed up in speed, each scene's last balance asks some contact for more friction than its load."""
    low, high = np.zeros(group.size), np.ones(group.size)
    most = np.zeros(group.size)
    for _ in range(ROUNDS):
        states = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, STATES + 1)[1:]
        worst = np.array([_friction_along(group.part(k), states[k]) for k in range(group.size)])
        for k in range(group.size):
            good = np.flatnonzero(np.isfinite(worst[k]))
            # The first state without a balance bounds the branch that comes from rest.
            first_bad = int(np.flatnonzero(~np.isfinite(worst[k]))[0]) if good.size < STATES else STATES
            if first_bad > 0:
                low[k], most[k] = states[k, first_bad - 1], max(most[k], worst[k, first_bad - 1])
            if first_bad < STATES:
                high[k] = states[k, first_bad]
    return most > 1.0


def _friction_along(one: Group, factors: NDArray) -> NDArray:
    """The largest friction required at any contact at so many fractions of a scene's speed; NaN: no balance."""
    scene = replace_speeds(replace(one, kind=qs.BearingKind.DEEP_GROOVE), factors)
    solution = qs.solve(scene, threads=1)
    demands = [side.required_friction for side in (solution.inner, solution.outer)]
    most = np.maximum.reduce([np.nan_to_num(demand, nan=0.0) for demand in demands if demand is not None])
    return np.where(solution.converged, most.max(axis=-1), np.nan)


def replace_speeds(one: Group, factors: NDArray) -> qs.Scene:
    """One scene at several fractions of its speeds."""
    scene = one.scene()
    speeds: dict[str, Any] = {
        name: factors * float(np.asarray(getattr(scene.operation, name) or 0.0)) for name in ("speed", "outer_speed")
    }
    return replace(scene, operation=replace(scene.operation, **speeds))
