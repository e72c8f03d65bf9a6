"""Balls between arched rings, each of which two arcs of a groove make: up to four contacts a ball, moved by friction.

The balance is that of `traction_balance.py`, for any number of arcs. It starts from the loads that a frozen centrifugal
force makes, directly, else through slip speeds from friction that hardly saturates; at rest that is the solution.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import entry, kernel
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.kernel.admissibility import (
    ANGLE_ROUNDING,
    CONVERGED,
    NO_EQUILIBRIUM,
    NOT_CONVERGED,
    OVER_SHOULDER,
    UNLOADED_RING,
)
from qsbearing.model.kernel.arched_start import set_frozen_orbits, set_rolling, settle
from qsbearing.model.kernel.case import CASE, RESULT
from qsbearing.model.kernel.ring import inner_groove_centre
from qsbearing.model.kernel.traction_balance import (
    balance,
    balance_through_slips,
    deliver,
    put_at_azimuth,
    set_derivative,
    set_grooves,
    set_ring,
    stop,
)
from qsbearing.model.kernel.traction_ball import COSINE, GROOVE, LAW, LOAD, MOVED_BALL, X1, X2, moved_ball
from qsbearing.model.kernel.traction_ring import MOTION

HIGHEST_LOAD = 4.0
"""Of that of the case, from which it is approached where nothing else leads there."""
FIRST_STEP, LEAST_STEP = 0.2, 1e-4
"""Of load, over the load."""


@kernel
def place_between(case: recarray, shims: ndarray, motion: recarray, balls: ndarray) -> None:
    """Put the ring where its load presses it, or in the middle, and balls halfway between both rings."""
    if not case.displacement_given[0]:
        middle = 0.0
        lengths = case.inner_coefficient - 0.5, case.outer_coefficient - 0.5
        for i in range(2):
            middle += (shims[i] if shims[i] > 0.0 else 0.0) - 2.0 * lengths[i] * case.sin_free
        load = case.prescribed[0]
        motion.displacement[0] = middle if load < 0.0 else 0.0 if load > 0.0 else 0.5 * middle
    for j in range(motion.ball_count):
        ball: recarray = balls[j]
        put_at_azimuth(case, ball, j)
        a1, a2 = inner_groove_centre(case, motion.displacement, ball)
        ball.unknown[X1], ball.unknown[X2] = 0.5 * a1, 0.5 * a2


@entry(
    *(array_of(CASE), array_of(LAW), array_of(GROOVE), array_of(MOTION), array_of(MOVED_BALL)),
    (array_of(float, 2), array_of(float, 2), array_of(float), array_of(float)),
    *(bool, array_of(float, 2), array_of(RESULT), array_of(float, 3), array_of(float, 4), array_of(float)),
)
def solve_arched(
    cases: ndarray,
    laws: ndarray,
    grooves: ndarray,
    motions: ndarray,
    balls: ndarray,
    arrays: tuple[ndarray, ...],
    is_carried: bool,
    shims: ndarray,
    results: ndarray,
    places: ndarray,
    contacts: ndarray,
    torques: ndarray,
) -> None:
    """Solve cases of arched rings from nothing, those at rest by statics.

    Args:
        laws, grooves, motions, balls, arrays: as in `solve_motions`, of four grooves.
        is_carried: whether balls are carried round under radial load.
        shims: of the inner and the outer ring (case, 2), in ball diameters; below zero for a ring of one arc.
        results: where displacements stand that are given; all else is written there.
        places, contacts, torques: as in `solve_motions`; contacts of the arcs for positive angles first.
    """
    points, _, _, derivative = arrays
    for k in range(cases.size):
        case, law, motion, result = cases[k], laws[k], motions[0], results[k]
        set_grooves(case, law, shims[k], grooves)
        for i in range(5):
            result.displacement[i] = case.prescribed[i] if case.displacement_given[i] else 0.0
        set_ring(case, motion, result, is_carried)
        set_derivative(derivative, motion.ball_count)
        is_carried_round = motion.is_carried
        motion.is_carried = False
        place_between(case, shims[k], motion, balls)
        set_frozen_orbits(case, motion, balls)
        is_balanced = settle(case, grooves, arrays, motion, balls)
        if motion.speed == 0.0:
            rest(case, law, grooves, points, motion, balls)
        elif is_balanced:
            motion.is_carried = is_carried_round
            is_balanced = run(case, law, grooves, arrays, motion, balls)
        result.residual, result.iterations = motion.residual, motion.iterations
        torques[k] = deliver(case, law, grooves, points, motion, balls, result, places[k], contacts[k])
        result.reached = 1.0
        result.notes = over_shoulders(case, contacts[k]) if is_balanced else 0
        result.status = NO_EQUILIBRIUM if result.notes != 0 else CONVERGED if is_balanced else NOT_CONVERGED
        if is_balanced and is_free(case, motion, contacts[k]):
            result.notes = result.notes | UNLOADED_RING


@kernel
def rest(case: recarray, law: recarray, grooves: ndarray, points: ndarray, motion: recarray, balls: ndarray) -> None:
    """Let nothing turn, and fill the balls' forces on the ring."""
    stop(motion, balls)
    for j in range(motion.ball_count):
        a1, a2 = inner_groove_centre(case, motion.displacement, balls[j])
        moved_ball(case, law, grooves, points, balls[j], a1, a2)


@kernel
def run(
    case: recarray, law: recarray, grooves: ndarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray
) -> bool:
    """Solve the balance of friction from where ring and balls lie; whether it converged."""
    is_carried = motion.is_carried
    if set_rolling(case, grooves, arrays, motion, balls) and balance(case, law, grooves, arrays, motion, balls):
        return True
    if start_again(case, grooves, arrays, motion, balls, is_carried) and balance_through_slips(
        case, law, grooves, arrays, motion, balls
    ):
        return True
    return balance_through_loads(case, law, grooves, arrays, motion, balls, is_carried)


@kernel
def start_again(
    case: recarray, grooves: ndarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray, is_carried: bool
) -> bool:
    """Put ring and balls where they lie and roll by themselves; whether there is such a place."""
    motion.is_carried = False
    set_frozen_orbits(case, motion, balls)
    is_found = settle(case, grooves, arrays, motion, balls) and set_rolling(case, grooves, arrays, motion, balls)
    motion.is_carried = is_carried
    return is_found


@kernel
def balance_through_loads(
    case: recarray,
    law: recarray,
    grooves: ndarray,
    arrays: tuple[ndarray, ...],
    motion: recarray,
    balls: ndarray,
    is_carried: bool,
) -> bool:
    """The balance from one under higher loads, where fewer arcs touch, down to those of the case; whether it converged.

    A contact that opens or closes leaves Newton's method no slope to go by: there steps in load become small.
    """
    factor, step = HIGHEST_LOAD, FIRST_STEP
    scale_loads(case, factor)
    is_balanced = start_again(case, grooves, arrays, motion, balls, is_carried) and balance(
        case, law, grooves, arrays, motion, balls
    )
    scale_loads(case, 1.0 / factor)
    while is_balanced and factor > 1.0 and step > LEAST_STEP:
        lower = max(1.0, factor * (1.0 - step))
        keep_solved(motion, balls)
        scale_loads(case, lower)
        has_gone = balance(case, law, grooves, arrays, motion, balls)
        scale_loads(case, 1.0 / lower)
        if has_gone:
            factor, step = lower, min(FIRST_STEP, 1.5 * step)
        else:
            restore(motion, balls)
            step *= 0.4
    return is_balanced and factor == 1.0


@kernel
def scale_loads(case: recarray, factor: float) -> None:
    """Of channels whose load is given."""
    for i in range(3):
        if not case.displacement_given[i]:
            case.prescribed[i] *= factor


@kernel
def keep_solved(motion: recarray, balls: ndarray) -> None:
    """Put aside ring and balls as they are, where the ring's tilts and a ball's blocks are not needed."""
    for i in range(3):
        motion.kept[i] = motion.displacement[i]
    for j in range(motion.ball_count):
        for k in range(6):
            balls[j].kept[k] = balls[j].unknown[k]


@kernel
def restore(motion: recarray, balls: ndarray) -> None:
    """Put them back."""
    for i in range(3):
        motion.displacement[i] = motion.kept[i]
    for j in range(motion.ball_count):
        for k in range(6):
            balls[j].unknown[k] = balls[j].kept[k]


@kernel
def over_shoulders(case: recarray, contacts: ndarray) -> int:
    """Inner contacts that carry load where no groove is, as bits of `admissibility`."""
    for j in range(case.ball_count):
        for k in range(0, contacts.shape[1], 2):
            if contacts[j, k, LOAD] > 0.0 and contacts[j, k, COSINE] > ANGLE_ROUNDING:
                return OVER_SHOULDER
    return 0


@kernel
def is_free(case: recarray, motion: recarray, contacts: ndarray) -> bool:
    """Whether nothing loads the inner ring and nothing holds it."""
    if motion.channel_count == 0:
        return False
    for j in range(case.ball_count):
        for k in range(0, contacts.shape[1], 2):
            if contacts[j, k, LOAD] > 0.0:
                return False
    return True
