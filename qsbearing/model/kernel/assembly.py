"""The equations of ring and balls, evaluated: residual, and the condensed system for the ring's step."""

from __future__ import annotations

from math import inf, sqrt

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.kernel.ball import moving_ball, resting_ball
from qsbearing.model.kernel.ball_size import are_uneven
from qsbearing.model.kernel.loop_closure import close_loop
from qsbearing.model.kernel.ring import add_ball, channel_lever, inner_groove_centre, start_sums
from qsbearing.model.kernel.ring_bending import eliminate_deflections

# The least stiffness of anything, over that of a contact under the largest force: little more than the rounding of such
# stiffnesses. It keeps a ball out of contact, or a channel that nothing resists, solvable, and hardly counts beside
# what resists the turning of a contact line, Q/l.
REGULARISATION = 1e-14
# Of a double.
EPSILON = 2.0**-52
# Over the stiffness of both contacts: the load of an approach of one rounding of a ball diameter.
LEAST_LOAD = EPSILON * sqrt(EPSILON)


@kernel
def applied_load(case: recarray, work: recarray) -> float:
    """The largest load that acts in any channel, moments over the pitch radius."""
    largest = 0.0
    for i in range(5):
        if not case.displacement_given[i]:
            largest = max(largest, abs(case.prescribed[i]) / channel_lever(case, i))
    return work.load_factor * largest


@kernel
def any_displacement_given(case: recarray) -> bool:
    """Whether some channel's displacement is prescribed."""
    for i in range(5):
        if case.displacement_given[i]:
            return True
    return False


@kernel
def assemble_balls(case: recarray, work: recarray, balls: ndarray) -> tuple[float, float, float, float, float]:
    """Evaluate all balls where they are, and leave their sum in the workspace: the ring's condensed system.

    Returns:
        (largest imbalance of a ball, the largest beside the ball's own load, sum of all, largest inertial force,
        largest contact load).
    """
    start_sums(case, work)
    work.largest_approach = 0.0
    least = least_load(case)
    worst, worst_own, total = 0.0, 0.0, 0.0
    inertial, contact = 0.0, 0.0
    for n in range(work.ball_count):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, work.displacement, ball)
        fc, friction = 0.0, 0.0
        if work.at_rest:
            imbalance, load = resting_ball(case, ball, a1, a2)
            lighter = load
        else:
            imbalance, load, lighter, fc, friction = moving_ball(case, work, ball, a1, a2)
        work.largest_approach = max(work.largest_approach, ball.inner_approach)
        worst = max(worst, imbalance)
        if imbalance > worst_own * max(lighter, least):
            worst_own = imbalance / max(lighter, least)
        total += imbalance
        inertial = max(inertial, max(fc, friction))
        contact = max(contact, load)
        add_ball(work, ball)
    if case.elastic_rings:
        hidden, sum_of_hidden = eliminate_deflections(case, work, balls)
        worst, total = max(worst, hidden), total + sum_of_hidden
    return worst, worst_own, total, inertial, contact


@kernel
def least_load(case: recarray) -> float:
    """What a contact that only the rounding of an approach presses carries, about: what is below is no load."""
    return LEAST_LOAD * case.series_stiffness


@kernel
def least_stiffness(case: recarray, largest_force: float) -> float:
    """The regularisation under this largest force."""
    relative = largest_force / case.series_stiffness
    return REGULARISATION * case.series_stiffness * relative ** (1.0 / 3.0)


@kernel
def assemble(case: recarray, work: recarray, balls: ndarray) -> tuple[float, float]:
    """Evaluate all balls where they are, and leave the condensed system in the workspace.

    Returns:
        (residual, the largest of each ball or channel beside its own load). The residual is the largest imbalance over
        the largest force: applied, inertial, or of a contact where a displacement is prescribed or balls are wedged
        or unequal, or grooves out of round, since then contacts make the reaction. It is infinite where something is
        not a number, and where no force at all acts at speed: a root of the equations where no ball orbits.
    """
    worst, worst_own, total, inertial, contact = assemble_balls(case, work, balls)
    return assembled_residual(case, work, worst, worst_own, total, inertial, contact)


@kernel
def assembled_residual(
    case: recarray, work: recarray, worst: float, worst_own: float, total: float, inertial: float, contact: float
) -> tuple[float, float]:
    """What `assemble` returns, from what `assemble_balls` does; completes the ring's system in the workspace."""
    least = least_load(case)
    for p in range(work.channel_count):
        lever = channel_lever(case, work.channel[p])
        work.matrix[p, p] += work.regularisation * lever * lever  # a channel that nothing resists keeps a step
        worst = max(worst, abs(work.imbalance[p]) / lever)
        own = abs(work.load_factor * case.prescribed[work.channel[p]])
        if own > least and abs(work.imbalance[p]) > worst_own * own:
            worst_own = abs(work.imbalance[p]) / own
        total += work.imbalance[p]
    largest_force = max(applied_load(case, work), inertial)
    if largest_force == 0.0 and case.centrifugal and not work.at_rest:
        return inf, inf
    if largest_force <= least:
        largest_force = least
        if worst <= least:
            worst = 0.0
    if any_displacement_given(case) or case.interference > 0.0 or are_uneven(case):
        largest_force = max(largest_force, contact)
    work.largest_force = largest_force
    work.regularisation = least_stiffness(case, largest_force)
    if not abs(total) < inf:  # a maximum passes over what is not a number; a sum does not
        return inf, inf
    return worst / largest_force, worst_own


@kernel
def close_loops(case: recarray, work: recarray, balls: ndarray) -> None:
    """Close every ball's loop by its inner contact line."""
    for n in range(work.ball_count):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, work.displacement, ball)
        close_loop(case, ball, work.at_rest, a1, a2)


@kernel
def has_closure_residual(work: recarray, balls: ndarray) -> bool:
    """Whether the last assembly found some loop open."""
    for n in range(work.ball_count):
        if balls[n].closure1 != 0.0 or balls[n].closure2 != 0.0:
            return True
    return False


@kernel
def set_at_rest(case: recarray, work: recarray, balls: ndarray) -> None:
    """Let no inertia act: each ball is one contact line, from groove centre to groove centre."""
    work.at_rest = True
    close_loops(case, work, balls)
