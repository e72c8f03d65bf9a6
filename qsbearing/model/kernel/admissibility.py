"""Admissibility checks of an equilibrium: grooves, friction, raceway control; and the codes of how a case ended."""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.contact.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.model.effects.gyroscopic_moment import NO_BOUND
from qsbearing.model.effects.raceway_control import INNER, OUTER, outer_controls
from qsbearing.model.kernel.ball_inertia import (
    POSITION_ROUNDING,
    friction_asked,
    is_carried_round,
    is_moving,
    is_rolled,
)
from qsbearing.model.kernel.ball_size import are_uneven
from qsbearing.model.kernel.newton import STALLED
from qsbearing.model.kernel.raceway_stiffness import contact_loads, hertz_cosine, spin_constant

CONVERGED, NO_EQUILIBRIUM, NOT_CONVERGED = 0, 1, 2

# What there is to say about a case; bits.
OPEN_SIDE, NO_CONSISTENT_CONTROL, UNLOADED_RING, FRICTION_WITHOUT_LOAD, UNSUPPORTED, OVER_SHOULDER = 1, 2, 4, 8, 16, 32
NO_ORBIT = 64

# A ball's control may change so often: there and back. What is contradicted then is contradicted both ways.
CONTROL_CHANGES = 2
# Angles this far outside are rounding, not contact on the open side or over the shoulder.
ANGLE_ROUNDING = 1e-9
# Of the largest force: what no equilibrium resolves.
NO_FORCE = 1e-12
# No dry or lubricated contact of bearing materials carries more friction than its load.
LOAD_BOUND = 1.0
# A contact that would have to carry this many times its load has no load but what rounding leaves.
FAR_MORE_THAN_LOAD = 1e6


@kernel
def is_unloaded(case: recarray, work: recarray, balls: ndarray) -> bool:
    """No load and no displacement anywhere, nor rings that wedge the balls, all or some of them."""
    if case.interference > 0.0:
        return False
    for i in range(5):
        if case.prescribed[i] != 0.0 or case.displacement_given[i]:
            return False
    if are_uneven(case):
        for n in range(work.ball_count):
            if balls[n].inner_approach > POSITION_ROUNDING:
                return False
    return True


@kernel
def contradicted_controls(case: recarray, work: recarray, balls: ndarray) -> tuple[int, int]:
    """How many balls' controls contradict Jones's criterion, and how many of them could still be changed, and were."""
    inner_constant = spin_constant(case, 1.0, INNER_SIDE, case.hertz_cosine)
    outer_constant = spin_constant(case, 1.0, OUTER_SIDE, case.hertz_cosine)
    wrong, changed = 0, 0
    for n in range(work.ball_count):
        ball = balls[n]
        si, ci, so, co = ball.inner_sine, ball.inner_cosine, ball.outer_sine, ball.outer_cosine
        if case.actual_angle or case.unequal_balls:
            inner_constant = spin_constant(case, ball.diameter, INNER_SIDE, hertz_cosine(case, ball, INNER_SIDE))
            outer_constant = spin_constant(case, ball.diameter, OUTER_SIDE, hertz_cosine(case, ball, OUTER_SIDE))
        qi, qo = contact_loads(case, ball)
        control = OUTER if outer_controls(qi, qo, inner_constant, outer_constant, ci * co + si * so) else INNER
        if control != ball.control:
            wrong += 1
            if ball.control_changes < CONTROL_CHANGES:
                ball.control = control
                ball.control_changes += 1
                changed += 1
    return wrong, changed


@kernel
def demands_friction(case: recarray, work: recarray, ball: recarray, most: float, least: float) -> bool:
    """Whether a ball demands of a contact more friction than `most` times its load and `least` times the largest force.

    One that no raceway rolls demands none.
    """
    if not is_rolled(ball):
        return False
    inner, outer = contact_loads(case, ball)
    # |T| is 2 |Mg|/D at most, and without a bound the largest force is no less than half of that.
    if work.friction_bound == NO_BOUND and min(inner, outer) * most > 2.0 * work.largest_force:
        return False
    at_inner, at_outer = friction_asked(case, work, ball)
    small = least * work.largest_force
    return (at_inner > most * inner and at_inner > small) or (at_outer > most * outer and at_outer > small)


@kernel
def any_demands_friction(case: recarray, work: recarray, balls: ndarray, most: float, least: float) -> bool:
    """Whether some contact would have to carry more friction than so many times its load."""
    if not case.gyroscopic or not is_moving(case):
        return False
    for n in range(work.ball_count):
        if demands_friction(case, work, balls[n], most, least):
            return True
    return False


@kernel
def contacts_outside_groove(case: recarray, work: recarray, balls: ndarray) -> int:
    """Inner contacts that carry load where no groove is, as bits; 0 where they all lie in their grooves.

    At an angle below zero a contact lies on the open side of an angular-contact bearing; beyond a right angle it lies
    over the shoulder of any groove.
    """
    bits = 0
    for n in range(work.ball_count):
        ball = balls[n]
        if ball.inner_approach > 0.0:
            if case.one_sided and ball.inner_sine < -ANGLE_ROUNDING:
                bits |= OPEN_SIDE
            if ball.inner_cosine < -ANGLE_ROUNDING:
                bits |= OVER_SHOULDER
    return bits


@kernel
def has_angles_apart(case: recarray, work: recarray, balls: ndarray) -> bool:
    """Whether a ball's two loaded contact lines lie more than a right angle apart.

    Within the shoulders their axial forces then point the same way, so that only friction as large as the loads
    balances them. Iterations pass through such states with other speeds than those of rolling
    (`kinematics.inner_line`).
    """
    if not case.gyroscopic or not is_moving(case):
        return False
    for n in range(work.ball_count):
        ball = balls[n]
        along = ball.inner_sine * ball.outer_sine + ball.inner_cosine * ball.outer_cosine
        if ball.inner_approach > POSITION_ROUNDING and along < -ANGLE_ROUNDING:
            return True
    return False


@kernel
def any_stands(case: recarray, work: recarray, balls: ndarray) -> bool:
    """Whether rolling would leave some ball standing, or carry it backwards."""
    if not is_moving(case) or work.speed_factor == 0.0:
        return False
    for n in range(work.ball_count):
        if not is_carried_round(case, work, balls[n]):
            return True
    return False


@kernel
def inadmissibility(case: recarray, work: recarray, balls: ndarray) -> int:
    """What makes an equilibrium inadmissible, as bits; 0 where nothing does.

    Beside a contact outside its groove: contact lines more than a right angle apart, balls that stand, and friction at
    a contact without load, which does not exist. Friction below the solver's accuracy is none. Under a friction bound:
    friction that would have to be above the load. Under the bound of a case that says what friction there is, what is
    asked beyond makes a ball slip, and no equilibrium inadmissible.
    """
    reasons = contacts_outside_groove(case, work, balls)
    if reasons == 0 and has_angles_apart(case, work, balls):
        reasons |= FRICTION_WITHOUT_LOAD
    if reasons == 0 and any_stands(case, work, balls):
        reasons |= NO_ORBIT
    if case.friction_coefficient != NO_BOUND and work.friction_bound != NO_BOUND:
        return reasons
    most, least = FAR_MORE_THAN_LOAD, STALLED
    if work.friction_bound != NO_BOUND:
        most, least = LOAD_BOUND, NO_FORCE
    if any_demands_friction(case, work, balls, most, least):
        reasons |= FRICTION_WITHOUT_LOAD
    return reasons
