"""Batches: Newton's method on sixteen cases at once, each in a lane, by the scalar kernel's formulas, start and checks.

Each ball is evaluated, and takes its step, in a loop over lanes which LLVM packs; what is done once for a step of a
ring, or seldom, is done lane by lane. A case that has converged makes room for the next. The digits are those of
`solve_cases`, whatever stands in the other lanes.

Lanes know equal balls with centrifugal force, with or without gyroscopic moment, under any control (of per-ball control
the outer one, which it tries first), on the pitch circle, contacts of constant stiffness, rigid rings and friction
without a bound, at speed under loads that are mainly axial. At one time lanes hold cases with the same effects,
control, balls and channels to solve. Left to `solve_cases` are all others, thrust below the least, and what does not
converge at once to an admissible equilibrium that no ball's control contradicts, so that all that is said of it is said
there.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy import ndarray, recarray
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import entry, inlined, kernel
from qsbearing.model.effects.gyroscopic_moment import NO_BOUND
from qsbearing.model.effects.raceway_control import OUTER, PER_BALL
from qsbearing.model.kernel.admissibility import contradicted_controls, inadmissibility
from qsbearing.model.kernel.assembly import assembled_residual, close_loops, least_load
from qsbearing.model.kernel.ball_inertia import is_moving
from qsbearing.model.kernel.initial_guess import guess_thrust, is_thrust_like
from qsbearing.model.kernel.lane_assembly import evaluate_lanes
from qsbearing.model.kernel.lane_linear import leave_out_others, solve_lanes
from qsbearing.model.kernel.lane_state import LANES, ball_in, case_in, groove_centre_in, kept, lane_memory
from qsbearing.model.kernel.loop_closure import inner_length, inner_span, outer_length, set_inner_line, set_outer_line
from qsbearing.model.kernel.newton import CLOSINGS, NEAR, NEARLY, OPEN_ITERATIONS, SOLVED, UNSOLVED, verdict
from qsbearing.model.kernel.newton_step import (
    FARTHEST,
    LARGEST_TURN,
    growth,
    has_room,
    line_steps,
    settled_line,
    small_growth,
    step_fraction,
    turned_line,
)
from qsbearing.model.kernel.ring import inner_groove_step
from qsbearing.model.kernel.solve_case import (
    SOUND,
    UNFINISHED,
    deliver_solved,
    prepare,
    set_controls,
    solve_cases,
)
from qsbearing.model.kernel.unloaded_ball import place_unloaded
from qsbearing.model.kernel.workspace import FOUND, GIVEN

NONE = -1
"""In place of the number of a lane's case."""
LEFT_OUT = ("displaced_orbit", "common_motion", "actual_angle", "unequal_balls", "elastic_rings", "out_of_round")
"""What of a case lanes do not know."""
WAITING = 4
"""A case's code before it has entered a lane."""
MOST_FEW = 4
"""So often cases may be too few of a kind to fill the lanes; then what is left is done one by one. A choice: with one
lane filled a case takes four times as long."""


@kernel
def propose_lanes(ring: recarray, lane_balls: ndarray, count: int) -> None:
    """`propose_lines` of all lanes."""
    for lane in range(LANES):
        ring.farthest[lane], ring.turn[lane] = 0.0, 0.0
    for n in range(count):
        ball = lane_balls[n]
        cosine, sine = ball.cosine, ball.sine
        for lane in range(LANES):
            case, here = case_in(ring, lane), ball_in(ball, lane, cosine, sine)
            d = ring.step[0, lane], ring.step[1, lane], ring.step[2, lane], ring.step[3, lane], ring.step[4, lane]
            da1, da2 = inner_groove_step(case, d, cosine, sine)
            ring.farthest[lane] = kept(max(ring.farthest[lane], max(abs(da1), abs(da2))))
            outer1, outer2, inner1, inner2, turn = line_steps(False, here, da1, da2)
            ball.outer_step1[lane], ball.outer_step2[lane] = outer1, outer2
            ball.inner_step1[lane], ball.inner_step2[lane] = inner1, inner2
            ball.turn[lane] = turn
            counted = turn if ball.follows_inertia[lane] == 0.0 else 0.0
            ring.turn[lane] = kept(max(ring.turn[lane], counted))
    for lane in range(LANES):
        ring.fraction[lane] = step_fraction(case_in(ring, lane), ring.farthest[lane], ring.turn[lane])
        is_number = ring.farthest[lane] < inf and ring.turn[lane] < inf
        ring.is_unusual[lane] = kept(ring.is_unusual[lane] if is_number else 1.0)


@kernel
def take_step_lanes(cases: ndarray, ring: recarray, lane_balls: ndarray, work: recarray, balls: ndarray) -> None:
    """`take_step` of the lanes that step, loops open."""
    for i in range(5):
        for lane in range(LANES):
            moved = ring.displacement[i, lane] + ring.fraction[lane] * ring.step[i, lane]
            ring.displacement[i, lane] = kept(moved if ring.steps[lane] != 0.0 else ring.displacement[i, lane])
            ring.is_unusual[lane] = kept(ring.is_unusual[lane] if abs(moved) < FARTHEST else 1.0)
    for n in range(work.ball_count):
        if step_ball_lanes(ring, lane_balls[n]):
            place_anew(cases, ring, lane_balls[n], work, balls[n])


@kernel
def step_ball_lanes(ring: recarray, ball: recarray) -> bool:
    """The same of one ball; whether some lane's is to be placed anew."""
    cosine, sine = ball.cosine, ball.sine
    others, is_placed = 0, False
    for lane in range(LANES):
        own = ring.fraction[lane]
        outer, inner = promised(ball, lane, own)
        outer, outer_holds = small_growth(ball.outer_approach[lane], outer)
        inner, inner_holds = small_growth(ball.inner_approach[lane], inner)
        is_small = outer_holds and inner_holds and ball.turn[lane] <= LARGEST_TURN
        others += 0 if is_small else 1
        ball.is_large[lane], ball.is_placed[lane] = 0.0 if is_small else 1.0, 0.0
        ball.own[lane], ball.outer_longer[lane], ball.inner_longer[lane] = own, outer, inner
    if others > 0:
        is_placed = grow_others(ring, ball)
    for lane in range(LANES):
        case, here = case_in(ring, lane), ball_in(ball, lane, cosine, sine)
        own, pressed = ball.own[lane], ring.largest_approach[lane]
        a1, a2 = groove_centre_in(ring, lane, here)
        most = here.outer_approach if here.outer_approach > 0.0 else pressed
        so, co, outer = turned_line(
            outer_length(case, here), here.outer_sine, here.outer_cosine, here.outer_inverse, here.outer_approach,
            ball.outer_longer[lane], own * ball.outer_step1[lane], own * ball.outer_step2[lane],
            max(here.inner_approach, pressed),
        )  # fmt: skip
        steps = ring.steps[lane] != 0.0
        ball.outer_sine[lane] = kept(so if steps else here.outer_sine)
        ball.outer_cosine[lane] = kept(co if steps else here.outer_cosine)
        ball.outer_approach[lane] = kept(outer if steps else here.outer_approach)
        length, w1, w2 = inner_span(case, ball_in(ball, lane, cosine, sine), False, a1, a2)
        si, ci, inner = turned_line(
            length, here.inner_sine, here.inner_cosine, here.inner_inverse, here.inner_approach,
            ball.inner_longer[lane], own * ball.inner_step1[lane], own * ball.inner_step2[lane], most,
        )  # fmt: skip
        si, ci, inner = settled_line(case, length, si, ci, inner, w1, w2, most, ring.is_near[lane] != 0.0)
        ball.inner_sine[lane] = kept(si if steps else here.inner_sine)
        ball.inner_cosine[lane] = kept(ci if steps else here.inner_cosine)
        ball.inner_approach[lane] = kept(inner if steps else here.inner_approach)
    return is_placed


@inlined
def promised(ball: recarray, lane: int, own: float) -> tuple[float, float]:
    """What this fraction of its step adds to a ball's outer and inner line, as the tangents say."""
    outer1, outer2 = own * ball.outer_step1[lane], own * ball.outer_step2[lane]
    inner1, inner2 = own * ball.inner_step1[lane], own * ball.inner_step2[lane]
    outer = ball.outer_sine[lane] * outer1 + ball.outer_cosine[lane] * outer2
    return outer, ball.inner_sine[lane] * inner1 + ball.inner_cosine[lane] * inner2


@kernel
def grow_others(ring: recarray, ball: recarray) -> bool:
    """Where steps are large, powers and branches: not packed. Returns whether some lane's ball is to be placed anew."""
    cosine, sine, is_any_placed = ball.cosine, ball.sine, False
    for lane in range(LANES):
        if ball.is_large[lane] == 0.0 or ring.steps[lane] == 0.0:
            continue
        own = ring.fraction[lane]
        if ball.follows_inertia[lane] != 0.0 and ball.turn[lane] > LARGEST_TURN:
            case, here = case_in(ring, lane), ball_in(ball, lane, cosine, sine)
            a1, a2 = groove_centre_in(ring, lane, here)
            if has_room(case, here, a1, a2):
                ball.is_placed[lane], is_any_placed = 1.0, True
            own = min(own, LARGEST_TURN / ball.turn[lane])
        ball.own[lane] = own
        outer, inner = promised(ball, lane, own)
        pressed, approach = ring.largest_approach[lane], ball.outer_approach[lane]
        ball.outer_longer[lane] = growth(approach, outer, max(ball.inner_approach[lane], pressed))
        ball.inner_longer[lane] = growth(ball.inner_approach[lane], inner, approach if approach > 0.0 else pressed)
    return is_any_placed


@kernel
def place_anew(cases: ndarray, ring: recarray, lane_ball: recarray, work: recarray, ball: recarray) -> None:
    """Put a ball that its grooves leave room where an unloaded one lies."""
    for lane in range(LANES):
        if lane_ball.is_placed[lane] != 0.0:
            a1, a2 = groove_centre_in(ring, lane, ball)
            place_unloaded(cases[ring.case[lane]], work, ball, a1, a2)
            copy_ball(lane_ball, lane, ball)


@kernel
def copy_ball(lane_ball: recarray, lane: int, ball: recarray) -> None:
    """Put a ball's contact lines into a lane."""
    lane_ball.outer_sine[lane], lane_ball.outer_cosine[lane] = ball.outer_sine, ball.outer_cosine
    lane_ball.inner_sine[lane], lane_ball.inner_cosine[lane] = ball.inner_sine, ball.inner_cosine
    lane_ball.outer_approach[lane], lane_ball.inner_approach[lane] = ball.outer_approach, ball.inner_approach


def lanes_know(cases: NDArray) -> NDArray:
    """Of each case, whether lanes know all that it names: balls may be equal in some cases only."""
    named = [~cases[name] for name in LEFT_OUT]
    known = cases["centrifugal"] & (cases["friction_coefficient"] == NO_BOUND)
    known &= cases["displacement_given"][:, 0] == 0
    return np.logical_and.reduce([known, *named])


@kernel
def first_control(case: recarray) -> int:
    """The raceway control that is tried first."""
    return int(OUTER if case.control == PER_BALL else case.control)


@kernel
def is_alike(case: recarray, like: recarray) -> bool:
    """Whether a case has the effects, balls and channels to solve of another."""
    for i in range(5):
        if (case.prescribed[i] == 0.0) != (like.prescribed[i] == 0.0):
            return False
        if case.displacement_given[i] != like.displacement_given[i]:
            return False
    is_same = case.ball_count == like.ball_count and case.first_azimuth == like.first_azimuth
    is_same = is_same and first_control(case) == first_control(like) and case.shares == like.shares
    return bool(is_same and case.gyroscopic == like.gyroscopic)


@kernel
def is_sound(case: recarray, work: recarray, balls: ndarray) -> bool:
    """Whether an equilibrium is admissible and no ball's control contradicts it."""
    if inadmissibility(case, work, balls) != 0:
        return False
    if case.control != PER_BALL:
        return True
    wrong, _ = contradicted_controls(case, work, balls)
    set_controls(case, work, balls, OUTER)  # what the criterion has changed; balls of other lanes are placed with these
    return bool(wrong == 0)


@kernel
def enter(
    ring: recarray, lane_balls: ndarray, lane: int, case: recarray, work: recarray, balls: ndarray, k: int
) -> None:
    """Put a case, prepared, into a lane, at its start."""
    guess_thrust(case, work, balls)
    ring.pitch_diameter[lane], ring.tilt_lever[lane] = case.pitch_diameter, case.tilt_lever
    ring.inner_coefficient[lane], ring.outer_coefficient[lane] = case.inner_coefficient, case.outer_coefficient
    ring.sin_free[lane], ring.cos_free[lane] = case.sin_free, case.cos_free
    ring.interference[lane], ring.series_stiffness[lane] = case.interference, case.series_stiffness
    ring.inner_stiffness[lane], ring.outer_stiffness[lane] = case.inner_stiffness, case.outer_stiffness
    ring.inner_speed[lane], ring.outer_speed[lane] = case.inner_speed, case.outer_speed
    ring.inner_spin[lane], ring.outer_spin[lane] = balls[0].inner_spin, balls[0].outer_spin
    ring.regularisation[lane], ring.least[lane] = work.regularisation, least_load(case)
    for i in range(5):
        ring.load[i, lane], ring.displacement[i, lane] = case.prescribed[i], work.displacement[i]
        ring.step[i, lane] = 0.0
    for n in range(work.ball_count):
        ball, there = balls[n], lane_balls[n]
        there.cosine, there.sine, there.weight = ball.cosine, ball.sine, ball.weight
        there.inner_length[lane] = inner_length(case, ball)
        copy_ball(there, lane, ball)
    ring.case[lane], ring.iterations[lane], ring.closings[lane] = k, 0, 0
    ring.before[lane], ring.is_last[lane], ring.is_closed[lane] = -1.0, 0, 0


@kernel
def leave(ring: recarray, lane_balls: ndarray, lane: int, work: recarray, balls: ndarray) -> None:
    """Put a lane's ring and balls into the workspace."""
    for i in range(5):
        work.displacement[i] = ring.displacement[i, lane]
    for n in range(work.ball_count):
        ball, there = balls[n], lane_balls[n]
        ball.inner_spin, ball.outer_spin = ring.inner_spin[lane], ring.outer_spin[lane]
        set_outer_line(ball, there.outer_sine[lane], there.outer_cosine[lane], there.outer_approach[lane])
        set_inner_line(ball, there.inner_sine[lane], there.inner_cosine[lane], there.inner_approach[lane])


@kernel
def judge(
    ring: recarray, lane_balls: ndarray, lane: int, case: recarray, work: recarray, balls: ndarray, tolerance: float
) -> bool:
    """What `newton` does between assembly and step, for a lane; whether it is solved, and stands in the workspace."""
    for p in range(work.channel_count):
        i = work.channel[p]
        work.imbalance[p], work.matrix[p, p] = ring.imbalance[i, lane], ring.matrix[i, i, lane]
    work.regularisation = ring.regularisation[lane]
    residual, own_residual = assembled_residual(
        case, work, ring.worst[lane], ring.worst_own[lane], ring.total[lane], ring.inertial[lane], ring.contact[lane]
    )
    ring.regularisation[lane] = work.regularisation
    convergence = verdict(residual, own_residual, ring.before[lane], ring.is_last[lane] != 0, tolerance)
    if convergence != UNSOLVED and ring.is_closed[lane] == 0 and ring.is_open[lane] != 0.0:
        leave(ring, lane_balls, lane, work, balls)
        close_loops(case, work, balls)
        for n in range(work.ball_count):
            copy_ball(lane_balls[n], lane, balls[n])
        ring.closings[lane] += 1
        ring.before[lane], ring.is_closed[lane] = -1.0, 1
        ring.is_last[lane] = 1 if ring.closings[lane] > CLOSINGS else 0
        return False
    if convergence == SOLVED:
        leave(ring, lane_balls, lane, work, balls)
        work.residual, work.iterations = residual, ring.iterations[lane]
        return True
    if ring.iterations[lane] >= OPEN_ITERATIONS or ring.largest_approach[lane] <= 0.0:
        ring.case[lane] = NONE
        return False
    for p in range(work.channel_count):
        ring.matrix[work.channel[p], work.channel[p], lane] = work.matrix[p, p]
    ring.before[lane], ring.is_closed[lane], ring.is_last[lane] = residual, 0, 1 if convergence == NEARLY else 0
    ring.steps[lane], ring.is_near[lane] = 1.0, 1.0 if residual < NEAR else 0.0
    ring.iterations[lane] += 1
    return False


@kernel
def set_steps(ring: recarray, work: recarray) -> None:
    """The rings' steps, from what `solve_lanes` left."""
    for lane in range(LANES):
        ring.is_unusual[lane] = 0.0 if ring.pivot[lane] > 0.0 else 1.0
    for p in range(work.channel_count):
        i = work.channel[p]
        for lane in range(LANES):
            ring.step[i, lane] = kept(-ring.right_side[i, lane] if ring.steps[lane] != 0.0 else ring.step[i, lane])


@kernel
def solve_alike(
    cases: ndarray, work: recarray, balls: ndarray, own: ndarray, ring: recarray, lane_balls: ndarray,
    tolerance: float, results: ndarray, positions: ndarray, controls: ndarray, like: int,
) -> int:  # fmt: skip
    """Solve the waiting cases that are like this one; how many there were."""
    following, entered = like, 0
    while True:
        running = 0
        for lane in range(LANES):
            while ring.case[lane] == NONE and following < cases.size:
                k, case = following, cases[following]
                following += 1
                if results[k].status == WAITING and is_alike(case, cases[like]):
                    results[k].status = UNFINISHED
                    prepare(case, work, balls, own[k], False, results[k], positions[k], controls[k])
                    entered += 1
                    enter(ring, lane_balls, lane, case, work, balls, k)
            running += 1 if ring.case[lane] != NONE else 0
        if running == 0:
            return entered
        evaluate_lanes(ring, lane_balls, work.ball_count, cases[like], first_control(cases[like]))
        for lane in range(LANES):
            ring.steps[lane], k = 0.0, ring.case[lane]
            if k != NONE and judge(ring, lane_balls, lane, cases[k], work, balls, tolerance):
                ring.case[lane] = NONE
                if is_sound(cases[k], work, balls):
                    deliver_solved(cases[k], work, balls, SOUND, results[k], positions[k], controls[k])
        leave_out_others(ring, work)
        solve_lanes(ring)
        set_steps(ring, work)
        propose_lanes(ring, lane_balls, work.ball_count)
        take_step_lanes(cases, ring, lane_balls, work, balls)
        for lane in range(LANES):
            if ring.is_unusual[lane] != 0.0 and ring.steps[lane] != 0.0:
                ring.case[lane] = NONE


@entry(*GIVEN, *lane_memory.kinds, float, *FOUND)
def solve_in_lanes(
    cases: ndarray, workspaces: ndarray, balls: ndarray, own: ndarray, rings: ndarray, lane_balls: ndarray,
    tolerance: float, results: ndarray, positions: ndarray, controls: ndarray,
) -> None:  # fmt: skip
    """Solve what lanes can of the WAITING cases; the rest is left UNFINISHED. Arguments as for `solve_cases`, and the
    lanes' memory."""
    for lane in range(LANES):
        rings[0].case[lane] = NONE
    for k in range(cases.size):
        if results[k].status == WAITING and not (is_moving(cases[k]) and is_thrust_like(cases[k])):
            results[k].status = UNFINISHED
    few = 0
    for k in range(cases.size):
        if results[k].status == WAITING and few < MOST_FEW:
            entered = solve_alike(
                cases, workspaces[0], balls, own, rings[0], lane_balls, tolerance, results, positions, controls, k
            )
            few += 1 if entered < LANES else 0
        elif results[k].status == WAITING:
            results[k].status = UNFINISHED


def solve_batch(
    cases: NDArray, workspaces: NDArray, balls: NDArray, own: NDArray, tolerance: float, budget: int,
    is_warm: bool, results: NDArray, positions: NDArray, controls: NDArray,
) -> int:  # fmt: skip
    """As `solve_cases`, from no start; in lanes what they can."""
    known = lanes_know(cases)
    if not known.any():
        return int(solve_cases(cases, workspaces, balls, own, tolerance, budget, is_warm, results, positions, controls))
    memory = lane_memory(balls.size)
    results["status"] = np.where(known, WAITING, UNFINISHED)
    solve_in_lanes(cases, workspaces, balls, own, *memory, tolerance, results, positions, controls)
    left = np.flatnonzero(results["status"] == UNFINISHED)
    if left.size == 0:
        return 0
    remaining = results[left], positions[left], controls[left]
    unfinished = solve_cases(cases[left], workspaces, balls, own[left], tolerance, budget, is_warm, *remaining)
    results[left], positions[left], controls[left] = remaining
    return int(unfinished)
