"""What a state of ring and balls is worth: how a case may end, what forbids a balance, whose control it calls for."""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.ball import friction_shares, groove_stiffness, inertia_of, is_moving, is_rolled, raceway_ellipse
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
# No material carries more friction than load; one asked for far more has no load but what rounding leaves.
MORE_THAN_LOAD, FAR_MORE_THAN_LOAD = 1.0, 1e6


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
def asks_for(case: recarray, ring: recarray, ball: recarray, most: float, least: float) -> bool:
    """Whether a ball asks a contact for more friction than `most` times its load, and `least` times the largest force.

    One that no raceway rolls asks for none.
    """
    if not is_rolled(ball):
        return False
    inner, outer = contact_loads(case, ball)
    share_i, share_o = friction_shares(case, ball.control)
    moment = abs(inertia_of(case, ball)[1])
    at_inner, at_outer = share_i * moment, share_o * moment
    small = least * ring.scale
    return (at_inner > most * inner and at_inner > small) or (at_outer > most * outer and at_outer > small)


@kernel
def is_asked_for(case: recarray, ring: recarray, balls: ndarray, most: float) -> bool:
    """Whether some contact is asked for more friction than so many times its load."""
    if not case.gyroscopic or not is_moving(case):
        return False
    for n in range(ring.balls):
        if asks_for(case, ring, balls[n], most, NO_FORCE):
            return True
    return False


@kernel
def outside_groove(case: recarray, ring: recarray, balls: ndarray) -> int:
    """Where inner contacts carry load and no groove is, as bits; 0 where they all lie in their grooves.

    At an angle below zero a contact lies on the open side of an angular-contact bearing; beyond a right angle it lies
    over the shoulder of any groove.
    """
    found = 0
    for n in range(ring.balls):
        ball = balls[n]
        if ball.inner_approach > 0.0:
            if case.one_sided and ball.inner_sine < -ANGLE_ROUNDING:
                found |= OPEN_SIDE
            if ball.inner_cosine < -ANGLE_ROUNDING:
                found |= OVER_SHOULDER
    return found


@kernel
def objections(case: recarray, ring: recarray, balls: ndarray) -> int:
    """What forbids the balance where ring and balls stand, as bits; 0 where nothing does.

    Beside a contact outside its groove: friction at a contact without load, which does not exist. Friction below the
    solver's accuracy is none.
    """
    found = outside_groove(case, ring, balls)
    for n in range(ring.balls):
        ball = balls[n]
        if case.gyroscopic and is_moving(case) and asks_for(case, ring, ball, FAR_MORE_THAN_LOAD, STALLED):
            found |= FRICTION_WITHOUT_LOAD
    return found
