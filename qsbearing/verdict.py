"""What a state of ring and balls is worth: how a case may end, what forbids a balance, whose control it calls for."""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.ball import friction_shares, groove_stiffness, inertia_of, is_moving, raceway_ellipse
from qsbearing.compiled import kernel
from qsbearing.contact import contact_load
from qsbearing.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.newton import STALLED
from qsbearing.raceway_control import INNER, OUTER, outer_controls

CONVERGED, NO_EQUILIBRIUM, NOT_CONVERGED = 0, 1, 2

# What a verdict may be about; bits.
OPEN_SIDE, NO_CONSISTENT_CONTROL, UNLOADED_RING, FRICTION_WITHOUT_LOAD, RUNAWAY, OVER_SHOULDER = 1, 2, 4, 8, 16, 32

# A ball's control may change so often: there and back. What is contradicted then is contradicted both ways.
CONTROL_CHANGES = 2
# Angles this far outside are rounding, not contact on the open side or over the shoulder.
ANGLE_ROUNDING = 1e-9
# Of the largest force: what no balance resolves.
NO_FORCE = 1e-12
# A load below this part of the friction asked of it is none: what rounding leaves, since no material carries that much.
NO_LOAD = 1e-6


@kernel
def is_unloaded(case: recarray) -> bool:
    """No load and no displacement anywhere."""
    for i in range(5):
        if case.prescribed[i] != 0.0 or case.is_held[i]:
            return False
    return True


@kernel
def spin_constant(case: recarray, side: float, cosine: float) -> float:
    """a E/Q^(1/3) of a raceway's contact, for Jones's criterion."""
    a, _, _, E = raceway_ellipse(case, side, cosine)
    return a * E


@kernel
def contact_loads(case: recarray, ball: recarray) -> tuple[float, float]:
    """(Qi, Qo) of a ball between its two contacts."""
    ki, _ = groove_stiffness(case, INNER_SIDE, ball.inner_sine, ball.inner_cosine)
    ko, _ = groove_stiffness(case, OUTER_SIDE, ball.outer_sine, ball.outer_cosine)
    return contact_load(ki, ball.inner_approach)[0], contact_load(ko, ball.outer_approach)[0]


@kernel
def contradicted_controls(case: recarray, ring: recarray, balls: ndarray) -> tuple[int, int]:
    """How many balls' controls contradict Jones's criterion, and how many of them could still be changed, and were."""
    inner_constant = spin_constant(case, INNER_SIDE, case.hertz_cosine)
    outer_constant = spin_constant(case, OUTER_SIDE, case.hertz_cosine)
    wrong, changed = 0, 0
    for n in range(ring.balls):
        ball = balls[n]
        si, ci, so, co = ball.inner_sine, ball.inner_cosine, ball.outer_sine, ball.outer_cosine
        if case.actual_angle:
            inner_constant, outer_constant = spin_constant(case, INNER_SIDE, ci), spin_constant(case, OUTER_SIDE, co)
        qi, qo = contact_loads(case, ball)
        control = OUTER if outer_controls(qi, qo, inner_constant, outer_constant, ci * co + si * so) else INNER
        if control != ball.control:
            wrong += 1
            if ball.changes < CONTROL_CHANGES:
                ball.control = control
                ball.changes += 1
                changed += 1
    return wrong, changed


@kernel
def objections(case: recarray, ring: recarray, balls: ndarray, is_lost: bool) -> int:
    """What forbids the balance where ring and balls stand, as bits; 0 where nothing does.

    A loaded inner contact at an angle below zero lies on the open side of an angular-contact bearing; beyond a right
    angle it lies over the shoulder of any groove. Friction at a contact without load does not exist, and no contact
    carries more friction than load: where the balance was lost on the way up in speed (`is_lost`) at such a place, the
    hypothesis that puts friction there has come to its end. Friction below the solver's accuracy is none.
    """
    found = 0
    for n in range(ring.balls):
        ball = balls[n]
        si, ci = ball.inner_sine, ball.inner_cosine
        inner, outer = contact_loads(case, ball)
        if inner > 0.0:
            if case.one_sided and si < -ANGLE_ROUNDING:
                found |= OPEN_SIDE
            if ci < -ANGLE_ROUNDING:
                found |= OVER_SHOULDER
        is_touched = inner > 0.0 or outer > 0.0  # a ball that is not is rolled by neither raceway
        if case.gyroscopic and is_touched and is_moving(case):
            share_i, share_o = friction_shares(case, ball.control)
            moment = abs(inertia_of(case, ball)[1])
            for friction, load in ((share_i * moment, inner), (share_o * moment, outer)):
                is_without = load < NO_LOAD * friction and friction > STALLED * ring.scale
                if is_without or (is_lost and friction > load and friction > NO_FORCE * ring.scale):
                    found |= FRICTION_WITHOUT_LOAD
    return found
