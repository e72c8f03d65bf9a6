"""The equations of balls and ring assembled in lanes: `moving_ball` and `assemble_balls` of sixteen cases at once."""

from __future__ import annotations

from typing import Any

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.effects.raceway_control import INNER, MINIMUM_DISSIPATION, OUTER
from qsbearing.model.kernel.ball import evaluated
from qsbearing.model.kernel.kinematics import inner_line, is_seen_itself
from qsbearing.model.kernel.lane_state import LANES, ball_in, case_in, groove_centre_in, kept, work_in


@kernel
def evaluate_lanes(ring: recarray, lane_balls: ndarray, count: int, case: recarray, control: int) -> None:
    """`assemble_balls` of all lanes, in all five channels; their cases have the effects of this one."""
    for lane in range(LANES):
        ring.worst[lane], ring.worst_own[lane], ring.total[lane] = 0.0, 0.0, 0.0
        ring.is_open[lane] = 0.0
        ring.inertial[lane], ring.contact[lane], ring.largest_approach[lane] = 0.0, 0.0, 0.0
        for p in range(5):
            ring.imbalance[p, lane] = -ring.load[p, lane]
            ring.right_side[p, lane] = -ring.load[p, lane]
            for q in range(5):
                ring.matrix[p, q, lane] = 0.0
    for n in range(count):
        see_lines(lane_balls[n])
        evaluate_ball_lanes(ring, lane_balls[n], case.gyroscopic, control, case.shares)


@kernel
def see_lines(ball: recarray) -> None:
    """`rolling_line` of all lanes: nearly always the contact line itself."""
    others = 0
    for lane in range(LANES):
        si, ci, approach = ball.inner_sine[lane], ball.inner_cosine[lane], ball.inner_approach[lane]
        others += 0 if is_seen_itself(si, ci, ball.outer_sine[lane], ball.outer_cosine[lane], approach) else 1
        ball.seen_sine[lane], ball.seen_cosine[lane] = si, ci
        ball.seen_by_inner[lane], ball.seen_by_outer[lane], ball.seen_by_approach[lane] = 1.0, 0.0, 0.0
    if others == 0:
        return
    for lane in range(LANES):
        si, ci, so, co = ball.inner_sine[lane], ball.inner_cosine[lane], ball.outer_sine[lane], ball.outer_cosine[lane]
        seen = inner_line(si, ci, so, co, ball.inner_approach[lane], ball.inner_length[lane])
        ball.seen_sine[lane], ball.seen_cosine[lane] = seen[0], seen[1]
        ball.seen_by_inner[lane], ball.seen_by_outer[lane], ball.seen_by_approach[lane] = seen[2], seen[3], seen[4]


@kernel
def evaluate_ball_lanes(ring: recarray, ball: recarray, gyroscopic: bool, control: int, shares: int) -> None:
    """`moving_ball` and `add_ball` of all lanes.

    A loop for each kind: a branch within one would forbid to pack it.
    """
    if control == OUTER:
        if gyroscopic:
            evaluate_kind(ring, ball, True, OUTER, 0)
        else:
            evaluate_kind(ring, ball, False, OUTER, 0)
    elif control == INNER:
        if gyroscopic:
            evaluate_kind(ring, ball, True, INNER, shares)
        else:
            evaluate_kind(ring, ball, False, INNER, 0)
    elif gyroscopic:
        evaluate_kind(ring, ball, True, MINIMUM_DISSIPATION, shares)
    else:
        evaluate_kind(ring, ball, False, MINIMUM_DISSIPATION, 0)


@inlined
def evaluate_kind(ring: recarray, ball: recarray, gyroscopic: bool, control: int, shares: int) -> None:
    """The same of one kind, told by constants."""
    cosine, sine, weight = ball.cosine, ball.sine, ball.weight
    for lane in range(LANES):
        case = case_in(ring, lane, gyroscopic, shares)
        here = ball_in(ball, lane, cosine, sine, control, ring.inner_spin[lane], ring.outer_spin[lane])
        evaluate_in_lane(ring, ball, lane, case, here, cosine, sine, weight)


@inlined
def evaluate_in_lane(
    ring: recarray, ball: recarray, lane: int, case: Any, here: Any, cosine: float, sine: float, weight: float
) -> None:
    """The same of one lane."""
    work = work_in(ring, lane)
    seen = (
        ball.seen_sine[lane], ball.seen_cosine[lane], ball.seen_by_inner[lane], ball.seen_by_outer[lane],
        ball.seen_by_approach[lane],
    )  # fmt: skip
    a1, a2 = groove_centre_in(ring, lane, here)
    terms = evaluated(case, work, here, seen, a1, a2)
    least = max(terms.lighter, ring.least[lane])
    ring.worst[lane] = kept(max(ring.worst[lane], terms.imbalance))
    own = ring.worst_own[lane]
    ring.worst_own[lane] = kept(terms.imbalance / least if terms.imbalance > own * least else own)
    ring.total[lane] += terms.imbalance
    ring.inertial[lane] = kept(max(ring.inertial[lane], max(terms.fc, terms.friction)))
    ring.contact[lane] = kept(max(ring.contact[lane], terms.load))
    ring.largest_approach[lane] = kept(max(ring.largest_approach[lane], here.inner_approach))
    ball.y1[lane], ball.y2[lane], ball.y11[lane], ball.y12[lane] = terms.y1, terms.y2, terms.y11, terms.y12
    ball.y21[lane], ball.y22[lane] = terms.y21, terms.y22
    ball.follows_inertia[lane] = 1.0 if terms.follows_inertia else 0.0
    ball.outer_inverse[lane], ball.inner_inverse[lane] = terms.outer_inverse, terms.inner_inverse
    ball.closure1[lane], ball.closure2[lane] = terms.closure1, terms.closure2
    is_closed = terms.closure1 == 0.0 and terms.closure2 == 0.0
    ring.is_open[lane] = kept(ring.is_open[lane] if is_closed else 1.0)
    levers = cosine, sine, case.tilt_lever * sine, case.tilt_lever * -cosine
    add_row(ring, 0, lane, weight, terms.h1, terms.c1, terms.k11, terms.k12, levers)
    add_row(ring, 1, lane, weight * cosine, terms.h2, terms.c2, terms.k21, terms.k22, levers)
    add_row(ring, 2, lane, weight * sine, terms.h2, terms.c2, terms.k21, terms.k22, levers)
    add_row(ring, 3, lane, weight * sine, terms.h3, terms.c3, terms.k31, terms.k32, levers)
    add_row(ring, 4, lane, weight * -cosine, terms.h3, terms.c3, terms.k31, terms.k32, levers)


@inlined
def add_row(
    ring: recarray, row: int, lane: int, factor: float, force: float, condensed: float, by_a1: float, by_a2: float,
    levers: tuple[float, float, float, float],
) -> None:  # fmt: skip
    """A channel's row of `add_ball`."""
    ring.imbalance[row, lane] += factor * force
    ring.right_side[row, lane] += factor * condensed
    by_a1, by_a2 = factor * by_a1, factor * by_a2
    ring.matrix[row, 0, lane] += by_a1
    ring.matrix[row, 1, lane] += levers[0] * by_a2
    ring.matrix[row, 2, lane] += levers[1] * by_a2
    ring.matrix[row, 3, lane] += levers[2] * by_a1
    ring.matrix[row, 4, lane] += levers[3] * by_a1
