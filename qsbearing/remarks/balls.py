"""Remarks about balls: without load, slipping, asking for more friction than contacts offer, or for other orbits."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.traction import FRICTION_COEFFICIENT
from qsbearing.model.scene.moved_by_friction import friction_instead
from qsbearing.model.solution.ring_forces import radial_forces
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.remark import Found, Remark, remark

FRICTION_IN_DOUBT = 0.06
FRICTION_BEYOND = 0.1
"""Coefficients that lubricated steel contacts typically offer lie between these."""
FRICTION_OF_LOAD = 1.0
"""Above it friction is larger than the load that presses the contact."""
FRICTIONS = {
    "friction_doubtful": (FRICTION_IN_DOUBT, FRICTION_BEYOND),
    "friction_beyond": (FRICTION_BEYOND, FRICTION_OF_LOAD),
    "friction_above_load": (FRICTION_OF_LOAD, inf),
}
"""What is said of coefficients above the first and up to the second."""
NO_FORCE = 1e-12
"""Of a case's largest contact load: less is what rounding leaves, and no load."""
MOMENTUM_GAP = 0.03
"""Of the radial load (chosen: in a trial with inertia along the orbit, radial stiffness was 4 % off in the median where
the gap is below 0.01, and 8 to 15 % above)."""
HALF = 0.5
"""Of the friction that there is: outer control is right to about 1 % in stiffness below it (158 thrust cases); the
transition to skidding takes a factor of 2 in load."""
NOTICEABLE = 1e-3
"""Of the axial load: a gap below it changes no digit that matters, however small the radial load."""


def rows(array: NDArray, part: slice) -> NDArray:
    """A stretch of cases of an array (*cases, ball or channel), with zero for NaN."""
    return np.nan_to_num(array.reshape(-1, array.shape[-1])[part], nan=0.0)


def ball_remarks(solution: Solution, part: slice) -> Iterator[Found]:
    """Raceway control that contradicts itself, balls without load."""
    yield ~np.reshape(solution.control_is_consistent, -1)[part], remark("control_inconsistent")
    exists = np.isfinite(solution.azimuth.reshape(-1, solution.azimuth.shape[-1])[part])
    inner, outer = rows(solution.inner.load, part), rows(solution.outer.load, part)
    least = NO_FORCE * np.maximum(inner, outer).max(axis=-1, keepdims=True)
    off_inner, off_outer = exists & (inner <= least), outer <= least
    unloaded, off = off_inner & off_outer, off_inner & ~off_outer
    yield unloaded.any(axis=-1), lambda i: remark("balls_unloaded", balls=unloaded[i])
    yield off.any(axis=-1), lambda i: remark("balls_off_inner", balls=off[i])


def _slip(solution: Solution, part: slice) -> Iterator[Found]:
    moment = solution.scene.gyroscopic_moment
    if solution.slips is None or moment is None:
        return
    slips = solution.slips.reshape(-1, solution.slips.shape[-1])[part]
    given = np.broadcast_to(np.asarray(moment.friction_coefficient, float), solution.shape).reshape(-1)[part]
    sides = (solution.inner.required_friction, solution.outer.required_friction)
    requested = np.maximum(*(rows(side, part) for side in sides if side is not None))
    instead = instead_of_slip(solution, without_bound=True) if slips.any() else {}
    yield (
        slips.any(axis=-1),
        lambda i: remark("balls_slip", balls=slips[i], required=requested[i].max(), given=given[i], **instead),
    )


def instead_of_slip(solution: Solution, *, without_bound: bool = False) -> dict[str, str]:
    """What to write so that slip is solved for, as a value of a remark; nothing for a row of a set."""
    return {} if solution.solve_alike is None else friction_instead(solution.scene, without_bound=without_bound)


def friction_remarks(solution: Solution, part: slice) -> Iterator[Found]:
    """Friction that the gyroscopic moment asks for, and balls that slip."""
    if solution.scene.raceway_control == "friction":
        yield from _moved(solution, part)
        return
    yield from _slip(solution, part)
    if solution.slips is not None:  # a coefficient is given: no need to guess what contacts offer
        return
    for name, side in (("inner", solution.inner), ("outer", solution.outer)):
        if side.required_friction is None:
            continue
        friction = rows(side.required_friction, part)
        instead = instead_of_slip(solution) if (friction > FRICTION_BEYOND).any() else {}

        for code, (least, most) in FRICTIONS.items():

            def requested(
                i: int, code: str = code, name: str = name, friction: NDArray = friction, instead: Any = instead
            ) -> Remark:
                typical = {"typical_least": FRICTION_IN_DOUBT, "typical_most": FRICTION_BEYOND}
                more = typical | ({} if code == "friction_doubtful" else instead)
                return remark(code, name, friction[i] > FRICTION_IN_DOUBT, required=friction[i].max(), **more)

            largest = friction.max(axis=-1)
            yield (largest > least) & (largest <= most), requested


def _moved(solution: Solution, part: slice) -> Iterator[Found]:
    """Of balls that friction moves: how far from a hypothesis, and from skidding."""
    motion, law = solution.friction, solution.scene.traction
    if motion is None:
        return
    if law is None or law.is_assumed:
        assumed = remark("friction_assumed", assumed=FRICTION_COEFFICIENT)
        yield np.isfinite(motion.displacement[..., 0]).reshape(-1)[part], assumed
    gyroscopic, skid = (
        np.nan_to_num(1.0 / margin.reshape(-1)[part])
        for margin in (motion.least_gyroscopic_margin, motion.least_skid_margin)
    )
    yield gyroscopic > HALF, lambda i: remark("axis_creeps", asked_percent=100.0 * gyroscopic[i])
    yield skid > HALF, lambda i: remark("balls_near_skidding", used_percent=100.0 * skid[i])


def momentum_remarks(solution: Solution, part: slice) -> Iterator[Found]:
    """Rings that do not carry the same, since each azimuth is balanced for itself."""
    forces = radial_forces(solution, part)
    if forces is None:
        return
    axial = np.abs(solution.load.reshape(-1, 5)[part, 0])
    yield (
        (forces.momentum_gap > MOMENTUM_GAP) & (forces.gap > NOTICEABLE * axial),
        lambda i: remark("momentum_gap", outer_N=forces.on_outer[i], inner_N=forces.on_inner[i]),
    )
