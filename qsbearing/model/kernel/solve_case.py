"""One case, directly: Newton's method from two starts, and the admissibility of what it finds.

The starts are closed forms and the equilibrium at rest; each converges in cases that the other does not. That is all
for nearly every case. What does not end in an admissible equilibrium is left to the fallback, but for a thrust under
inner raceway control that is too small to have one.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import entry, kernel
from qsbearing.model.effects.gyroscopic_moment import NO_BOUND
from qsbearing.model.effects.raceway_control import INNER, OUTER, PER_BALL
from qsbearing.model.kernel.admissibility import (
    CONVERGED,
    FRICTION_WITHOUT_LOAD,
    NO_CONSISTENT_CONTROL,
    NO_EQUILIBRIUM,
    NO_FORCE,
    NO_ORBIT,
    UNLOADED_RING,
    any_demands_friction,
    contradicted_controls,
    inadmissibility,
    is_unloaded,
)
from qsbearing.model.kernel.assembly import REGULARISATION, any_displacement_given, close_loops
from qsbearing.model.kernel.ball import evaluate_ball
from qsbearing.model.kernel.ball_inertia import control_of, is_carried_round, is_moving
from qsbearing.model.kernel.ball_size import set_sizes
from qsbearing.model.kernel.initial_guess import (
    guess_closed_form,
    guess_from_rest,
    guess_ring_at_rest,
    is_load_dominant,
    is_thrust_like,
    split_contacts,
)
from qsbearing.model.kernel.least_thrust import is_below_least_thrust
from qsbearing.model.kernel.loop_closure import load_position, set_inner_line, set_outer_line, store_position
from qsbearing.model.kernel.newton import newton, newton_at_rest
from qsbearing.model.kernel.newton_step import has_room
from qsbearing.model.kernel.raceway_stiffness import set_spin_constants
from qsbearing.model.kernel.ring import add_force, find_distinct_balls, inner_groove_centre, set_azimuths
from qsbearing.model.kernel.ring_bending import set_compliances
from qsbearing.model.kernel.snapshots import ADMISSIBLE, CONTROLS, INADMISSIBLE, restore_all, save
from qsbearing.model.kernel.unloaded_ball import place_unloaded
from qsbearing.model.kernel.workspace import FOUND, GIVEN

# So often standing balls are put elsewhere, and the equilibrium is sought again.
MOST_REPLACEMENTS = 3

UNFINISHED = 3
"""A case's code until the fallback has solved it."""

# What a search may find: nothing; an equilibrium that is inadmissible; one that is admissible but contradicts Jones's
# criterion; a sound one.
NOTHING, REFUSED, CONTRADICTED, SOUND = 0, 1, 2, 3

BUDGET = 10_000
"""Iterations that a case may spend, all strategies together: a thousand times what a usual case takes."""


@kernel
def set_controls(case: recarray, work: recarray, balls: ndarray, first: int) -> None:
    """Give every ball the raceway control asked for; under per-ball control this one first."""
    for n in range(work.ball_count):
        balls[n].control_changes = 0
        balls[n].control = first if case.control == PER_BALL else case.control


@kernel
def prepare(
    case: recarray,
    work: recarray,
    balls: ndarray,
    own: ndarray,
    is_warm: bool,
    result: recarray,
    position: ndarray,
    control: ndarray,
) -> None:
    """Choose balls and channels to solve, and put ring and balls at the start given, if one is."""
    set_azimuths(case, work, balls)
    find_distinct_balls(case, work, balls)
    set_sizes(case, work.ball_count, balls, own)
    if case.elastic_rings:
        set_compliances(case, work, own)
    work.load_factor, work.speed_factor, work.friction_bound = 1.0, 1.0, NO_BOUND
    work.regularisation = REGULARISATION * case.series_stiffness
    set_spin_constants(case, work.ball_count, balls)
    work.at_rest, work.iterations, work.residual = False, 0, 1.0
    for i in range(5):
        work.displacement[i] = result.displacement[i] * work.in_plane[i] if is_warm else 0.0
        if case.displacement_given[i]:
            work.displacement[i] = case.prescribed[i]
    set_controls(case, work, balls, OUTER)
    for n in range(work.ball_count):
        ball = balls[n]
        set_outer_line(ball, case.sin_free, case.cos_free, 0.0)  # nothing left of another case
        set_inner_line(ball, case.sin_free, case.cos_free, 0.0)
        ball.deflection = 0.0
        if is_warm:
            load_position(case, ball, position[ball.number])
            if case.control == PER_BALL and is_moving(case):
                ball.control = control[ball.number]


@kernel
def replace_standing_balls(case: recarray, work: recarray, balls: ndarray) -> bool:
    """Put balls that rolling does not carry round where inertia presses them, if their grooves leave room; whether
    there are any."""
    is_any = False
    for n in range(work.ball_count):
        ball = balls[n]
        if not is_carried_round(case, work, ball):
            a1, a2 = inner_groove_centre(case, work.displacement, ball)
            if has_room(case, ball, a1, a2):
                place_unloaded(case, work, ball, a1, a2)
                is_any = True
    return is_any


@kernel
def solve_with_controls(case: recarray, work: recarray, balls: ndarray, tolerance: float) -> int:
    """Newton's method from where ring and balls are: what it finds.

    Where an equilibrium leaves balls standing, they are put elsewhere; with per-ball control, controls that Jones's
    criterion contradicts are changed; and the equilibrium is sought again from where it was. Where that leads to no
    admissible one, the last admissible one stands, and contradicts its controls; else the last inadmissible one.
    """
    outcome, replacements = NOTHING, 0
    while newton(case, work, balls, tolerance):
        is_admissible = inadmissibility(case, work, balls) == 0
        if is_admissible and case.control != PER_BALL:
            return SOUND
        if is_admissible or outcome != CONTRADICTED:
            save(work, balls, CONTROLS)
            outcome = CONTRADICTED if is_admissible else REFUSED
        if not is_admissible and replacements < MOST_REPLACEMENTS and replace_standing_balls(case, work, balls):
            replacements += 1
            continue
        if case.control != PER_BALL:
            return REFUSED
        wrong, changed = contradicted_controls(case, work, balls)
        if wrong == 0 and is_admissible:
            return SOUND
        if changed == 0:
            break
    if outcome != NOTHING:
        restore_all(work, balls, CONTROLS)
    return outcome


@kernel
def solve_at_rest(case: recarray, work: recarray, balls: ndarray, tolerance: float, is_warm: bool) -> int:
    """Newton's method without inertia, from the start given or from closed forms: what it finds."""
    if not is_warm:
        guess_ring_at_rest(case, work)
    converged = newton_at_rest(case, work, balls, tolerance)
    split_contacts(case, work, balls)
    if not converged:
        return NOTHING
    return SOUND if inadmissibility(case, work, balls) == 0 else REFUSED


@kernel
def solve_at_speed(case: recarray, work: recarray, balls: ndarray, tolerance: float, is_warm: bool) -> int:
    """Newton's method from the starts, and with the case's own friction coefficient where balls slip: what is found.

    A case in which no ball need slip has its balance without a bound on friction, which is found first. Where some
    contact is asked for more than it can carry, that is the start; where it leads nowhere, or nothing was found, so are
    the others.
    """
    outcome = search_at_speed(case, work, balls, tolerance, is_warm)
    if case.friction_coefficient == NO_BOUND:
        return outcome
    if outcome >= CONTRADICTED:
        outcome = bound_friction(case, work, balls, tolerance, outcome)
        if outcome >= CONTRADICTED:
            return outcome
    work.friction_bound = case.friction_coefficient
    return search_at_speed(case, work, balls, tolerance, False)


@kernel
def bound_friction(case: recarray, work: recarray, balls: ndarray, tolerance: float, outcome: int) -> int:
    """From an equilibrium, under the case's own friction coefficient to one under it: what is found."""
    bound = case.friction_coefficient
    is_slipping = any_demands_friction(case, work, balls, bound, NO_FORCE)
    work.friction_bound = bound
    if not is_slipping:
        return outcome
    for n in range(work.ball_count):
        balls[n].control_changes = 0
    return solve_with_controls(case, work, balls, tolerance)


@kernel
def search_at_speed(case: recarray, work: recarray, balls: ndarray, tolerance: float, is_warm: bool) -> int:
    """From the start given, then from closed forms and from rest, the likelier first: what is found.

    Under per-ball control from the outer control of all balls, then from the inner. An equilibrium that contradicts its
    controls stands if none of these starts leads to one that does not.
    """
    if is_warm:
        close_loops(case, work, balls)
        outcome = solve_with_controls(case, work, balls, tolerance)
        if outcome >= CONTRADICTED:
            return outcome
    is_contradicted, is_refused = False, False
    is_rest_first = not is_thrust_like(case) and is_load_dominant(case, work)
    for control in range(OUTER, INNER + 1 if case.control == PER_BALL else OUTER + 1):
        for start in range(2):
            set_controls(case, work, balls, control)
            if (start == 0) == is_rest_first:
                guess_from_rest(case, work, balls)
            else:
                guess_closed_form(case, work, balls)
            outcome = solve_with_controls(case, work, balls, tolerance)
            if outcome == SOUND:
                return SOUND
            if outcome == CONTRADICTED and not is_contradicted:
                save(work, balls, ADMISSIBLE)
                is_contradicted = True
            if outcome == REFUSED and not is_refused:
                save(work, balls, INADMISSIBLE)
                is_refused = True
    if is_contradicted:
        restore_all(work, balls, ADMISSIBLE)
        return CONTRADICTED
    if is_refused:
        restore_all(work, balls, INADMISSIBLE)
        return REFUSED
    return NOTHING


@kernel
def remarks(case: recarray, work: recarray, balls: ndarray, outcome: int) -> int:
    """What is to be said of a case that converged, as bits."""
    bits = UNLOADED_RING if is_unloaded(case, work, balls) else 0
    return bits | NO_CONSISTENT_CONTROL if outcome == CONTRADICTED else bits


@kernel
def ring_load(case: recarray, work: recarray, balls: ndarray, load: ndarray) -> None:
    """The ring's load in all channels: what was prescribed, or the reaction to a prescribed displacement."""
    reaction = work.reaction
    for i in range(5):
        reaction[i] = 0.0
    if any_displacement_given(case):
        for j in range(case.ball_count):
            ball = balls[balls[j].index]
            a1, a2 = inner_groove_centre(case, work.displacement, ball)
            evaluate_ball(case, work, ball, a1, a2)
            add_force(ball, balls[j].azimuth_cosine, balls[j].azimuth_sine, reaction)
    for i in range(5):
        # what equal balls cancel is zero, not the rounding of their sum
        load[i] = reaction[i] * work.in_plane[i] if case.displacement_given[i] else case.prescribed[i]


@kernel
def deliver(
    case: recarray, work: recarray, balls: ndarray, result: recarray, position: ndarray, control: ndarray
) -> None:
    """Write the positions of ring and balls, in the case's units; zero for balls that the case does not have."""
    deliver_positions(case, work, balls, result, position, control)
    ring_load(case, work, balls, result.load)


@kernel
def deliver_positions(
    case: recarray, work: recarray, balls: ndarray, result: recarray, position: ndarray, control: ndarray
) -> None:
    """Likewise, without the ring's load."""
    for i in range(5):
        result.displacement[i] = work.displacement[i]
    for j in range(position.shape[0]):
        ball = balls[balls[j].index]
        is_there = j < case.ball_count
        is_image = is_there and ball.number < j
        for i in range(position.shape[1]):
            position[j, i] = position[ball.number, i] if is_image else 0.0
        if is_there and not is_image:
            store_position(case, ball, position[j])
        control[j] = control_of(case, ball) if is_there else OUTER


@kernel
def deliver_solved(
    case: recarray, work: recarray, balls: ndarray, outcome: int, result: recarray, position: ndarray, control: ndarray
) -> None:
    """Write the equilibrium found, and what there is to say of it."""
    result.iterations, result.residual, result.reached = work.iterations, work.residual, 1.0
    result.notes, result.status = remarks(case, work, balls, outcome), CONVERGED
    deliver(case, work, balls, result, position, control)


@kernel
def deliver_refused(
    case: recarray, work: recarray, balls: ndarray, result: recarray, position: ndarray, control: ndarray
) -> None:
    """Write that friction alone would carry more than the thrust; ring and balls are where the search left them."""
    result.iterations, result.residual, result.reached = work.iterations, work.residual, 1.0
    result.notes, result.status = FRICTION_WITHOUT_LOAD, NO_EQUILIBRIUM
    deliver(case, work, balls, result, position, control)


@entry(*GIVEN, float, int, bool, *FOUND)
def solve_cases(
    cases: ndarray,
    workspaces: ndarray,
    balls: ndarray,
    own: ndarray,
    tolerance: float,
    budget: int,
    is_warm: bool,
    results: ndarray,
    positions: ndarray,
    controls: ndarray,
) -> int:
    """Solve cases one by one, each on its own: no case sees another's state, so any split over threads agrees.

    results (case), positions (case, ball, 3) and controls (case, ball) hold the start if is_warm, and the result in the
    case's units. workspaces (1) and balls are working memory; own (case, ball) tells unequal balls and lobes, and
    is empty where there are none. A case that has taken `budget` iterations is not taken further. An unfinished
    case keeps its start or, noted as NO_ORBIT, holds an equilibrium in which balls stand. Returns how many are
    unfinished.
    """
    work = workspaces[0]
    work.budget = budget
    unfinished = 0
    for k in range(cases.size):
        case, result = cases[k], results[k]
        prepare(case, work, balls, own[k], is_warm, result, positions[k], controls[k])
        if is_moving(case):
            outcome = solve_at_speed(case, work, balls, tolerance, is_warm)
        else:
            outcome = solve_at_rest(case, work, balls, tolerance, is_warm)
        if outcome >= CONTRADICTED:
            deliver_solved(case, work, balls, outcome, result, positions[k], controls[k])
        elif outcome == NOTHING and is_below_least_thrust(case, work, balls[0]):
            deliver_refused(case, work, balls, result, positions[k], controls[k])
        else:
            unfinished += 1
            result.notes = inadmissibility(case, work, balls) & NO_ORBIT if outcome == REFUSED else 0
            if result.notes != 0:
                deliver(case, work, balls, result, positions[k], controls[k])
            result.status, result.iterations, result.residual = UNFINISHED, work.iterations, work.residual
    return unfinished
