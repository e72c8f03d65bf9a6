"""One case, the direct way: a start from closed forms or from rest, Newton's method, the verdict.

Each start arrives in cases that the other does not: what the likelier of the two misses is tried from the other. That
is all for nearly every case. What does not end in a balance that stands is left to the detours of hard cases,
which are compiled only when a case first needs them.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.ball import (
    UNLIMITED,
    evaluate,
    inertia,
    is_moving,
    limit_friction,
    set_inner,
    set_outer,
    take_place,
    tell_place,
)
from qsbearing.compiled import entry, kernel
from qsbearing.contact import direction
from qsbearing.keeping import SOLVED, keep, restore
from qsbearing.newton import FLOOR, any_held, applied_load, close_chains, newton, stop
from qsbearing.raceway_control import INNER, OUTER, PER_BALL
from qsbearing.ring import add_force, channel_scale, find_equals, inner_groove_centre, place_balls
from qsbearing.start import moving_thrust, ring_at_rest, seat_balls
from qsbearing.verdict import (
    CONVERGED,
    NO_CONSISTENT_CONTROL,
    UNLOADED_RING,
    contradicted_controls,
    is_unloaded,
    objections,
)

UNFINISHED = 3
"""A case's code while only a detour may still find its balance."""

# Side loads this many times the axial load still leave a ball at speed more like one under thrust than one at rest.
THRUST_REACH = 5.0
# How well the balance at rest must be known for Newton to start from it.
REST_TOLERANCE = 1e-3


@kernel
def is_thrust_like(case: recarray) -> bool:
    """Whether the axial load shapes the balls' balance at speed more than radial loads and moments do."""
    if case.is_held[0] or case.prescribed[0] <= 0.0:
        return False
    side = 0.0
    for i in range(1, 5):
        if not case.is_held[i]:
            value = case.prescribed[i] / channel_scale(case, i)
            side += value * value
    return sqrt(side) < THRUST_REACH * case.prescribed[0]


@kernel
def is_load_ahead(case: recarray) -> bool:
    """Whether loads shape the balls' balance at speed more than inertia does."""
    s, c = case.sin_free, case.cos_free
    fc, _, _, mg, _, _ = inertia(case, INNER if case.control == INNER else OUTER, s, c, s, c)
    return applied_load(case) > case.ball_count * max(fc, abs(mg))


@kernel
def rest(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Newton's method on the bearing at rest, from where the ring is: (converged, iterations, residual).

    The balls are left as one link each, to be seated.
    """
    stop(case, ring, balls)
    return newton(case, ring, balls, tolerance)


@kernel
def seat_at_rest(case: recarray, ring: recarray, balls: ndarray) -> int:
    """Put balls at speed where they lie at rest under the loads that act; returns the iterations taken."""
    ring_at_rest(case, ring.displacement)
    _, iterations, _ = rest(case, ring, balls, REST_TOLERANCE)
    seat_balls(case, ring, balls)
    return iterations


@kernel
def first_guess(case: recarray, ring: recarray, balls: ndarray) -> None:
    """Place ring and balls for Newton's first iteration, by closed forms alone.

    Under thrust every ball starts in the balance of thrust at speed, whatever else moves its inner groove: Newton
    closes the chain. Otherwise balls start as they would sit at rest.
    """
    if not is_thrust_like(case):
        ring_at_rest(case, ring.displacement)
        stop(case, ring, balls)
        seat_balls(case, ring, balls)
        return
    x, u1, u2 = moving_thrust(case, balls[0].control, case.prescribed[0])
    s, c = case.sin_free, case.cos_free
    outer_approach, so, co, _ = direction(case.outer_coefficient - 0.5, s, c, u1, u2)
    inner_approach, si, ci, _ = direction(case.inner_coefficient - 0.5, s, c, x - u1, -u2)
    for i in range(5):
        ring.displacement[i] = case.prescribed[i] if case.is_held[i] else 0.0
    ring.displacement[0] = x
    for n in range(ring.balls):
        set_outer(balls[n], so, co, outer_approach)
        set_inner(balls[n], si, ci, inner_approach)


@kernel
def choose_controls(case: recarray, ring: recarray, balls: ndarray, first: int) -> None:
    """Give every ball the raceway control asked for; where each has its own, this one until its balance says."""
    for n in range(ring.balls):
        balls[n].changes = 0
        balls[n].control = first if case.control == PER_BALL else case.control


@kernel
def prepare(
    case: recarray,
    ring: recarray,
    balls: ndarray,
    is_warm: bool,
    displacement: ndarray,
    position: ndarray,
    control: ndarray,
) -> None:
    """Choose balls and channels to solve, and put ring and balls at the start given, if one is."""
    place_balls(case, ring, balls)
    find_equals(case, ring, balls)
    ring.floor = FLOOR * case.series_stiffness
    ring.ran_away, ring.at_rest = False, False
    ring.reached = 1.0
    limit_friction(ring, UNLIMITED)
    for i in range(5):
        ring.load[i] = 0.0 if case.is_held[i] else case.prescribed[i]
        ring.displacement[i] = displacement[i] * ring.in_plane[i] if is_warm else 0.0
        if case.is_held[i]:
            ring.displacement[i] = case.prescribed[i]
    choose_controls(case, ring, balls, OUTER)
    for n in range(ring.balls):
        ball = balls[n]
        set_outer(ball, case.sin_free, case.cos_free, 0.0)  # nothing left of another case
        set_inner(ball, case.sin_free, case.cos_free, 0.0)
        if is_warm:
            take_place(case, ball, position[ball.number])
            if case.control == PER_BALL and is_moving(case):
                ball.control = control[ball.number]


@kernel
def settle_controls(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, int, float]:
    """From where ring and balls are: (whether a balance stands, notes, iterations, relative residual).

    With per-ball control a balance may change the controls that Jones's criterion contradicts, and is sought again from
    where it stands.
    """
    total, notes = 0, 0
    while True:
        converged, iterations, residual = newton(case, ring, balls, tolerance)
        total += iterations
        if not converged or case.control != PER_BALL:
            break
        wrong, changed = contradicted_controls(case, ring, balls)
        if changed == 0:
            notes = NO_CONSISTENT_CONTROL if wrong > 0 else 0
            break
    return converged and objections(case, ring, balls) == 0, notes, total, residual


@kernel
def solve_directly(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[bool, int, int, float]:
    """Solve one case from the start given, then its own: (whether a balance stands, notes, iterations, residual).

    At speed its own are closed forms and the balance at rest, the likelier first; with per-ball control from the outer
    control of all balls, then from the inner. A balance that contradicts its controls stands if none of these leads to
    another.
    """
    unloaded = UNLOADED_RING if is_unloaded(case) else 0
    if not is_moving(case):
        if not is_warm:
            ring_at_rest(case, ring.displacement)
        converged, total, residual = rest(case, ring, balls, tolerance)
        seat_balls(case, ring, balls)
        return converged and objections(case, ring, balls) == 0, unloaded, total, residual
    total, contradicted = 0, -1.0
    if is_warm:
        close_chains(case, ring, balls)
        stands, notes, total, residual = settle_controls(case, ring, balls, tolerance)
        if stands:
            return True, unloaded | notes, total, residual
    is_rest_first = not is_thrust_like(case) and is_load_ahead(case)
    for control in range(OUTER, INNER + 1 if case.control == PER_BALL else OUTER + 1):
        for start in range(2):
            choose_controls(case, ring, balls, control)
            if (start == 0) == is_rest_first:
                total += seat_at_rest(case, ring, balls)
            else:
                first_guess(case, ring, balls)
            stands, notes, iterations, residual = settle_controls(case, ring, balls, tolerance)
            total += iterations
            if stands and notes == 0:
                return True, unloaded, total, residual
            if stands and contradicted < 0.0:
                keep(ring, balls, SOLVED)
                contradicted = residual
    if contradicted >= 0.0:
        restore(ring, balls, SOLVED)
        return True, unloaded | NO_CONSISTENT_CONTROL, total, contradicted
    return False, unloaded, total, 1.0


@kernel
def ring_load(case: recarray, ring: recarray, balls: ndarray, load: ndarray) -> None:
    """The ring's load in all channels: what was prescribed, and of held channels the reaction, the balls' sum."""
    reaction = ring.before
    for i in range(5):
        reaction[i] = 0.0
    if any_held(case):
        for j in range(case.ball_count):
            ball = balls[balls[j].place]
            a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
            evaluate(case, ball, a1, a2, ring.floor, ring.grip)
            add_force(ball, balls[j].azimuth_cosine, balls[j].azimuth_sine, reaction)
    for i in range(5):
        # what equal balls cancel is zero, not the rounding of their sum
        load[i] = reaction[i] * ring.in_plane[i] if case.is_held[i] else case.prescribed[i]


@kernel
def deliver(
    case: recarray,
    ring: recarray,
    balls: ndarray,
    displacement: ndarray,
    position: ndarray,
    control: ndarray,
    load: ndarray,
) -> None:
    """Write where ring and balls stand, in the case's units; zero for balls that the case does not have."""
    for i in range(5):
        displacement[i] = ring.displacement[i]
    for j in range(position.shape[0]):
        ball = balls[balls[j].place]
        is_there = j < case.ball_count
        for i in range(3):
            position[j, i] = 0.0
        if is_there:
            tell_place(case, ball, position[j])
        control[j] = ball.control if is_there else 0
    ring_load(case, ring, balls, load)


@entry
def solve_cases(
    cases: ndarray,
    rings: ndarray,
    balls: ndarray,
    tolerance: float,
    is_warm: bool,
    displacement: ndarray,
    position: ndarray,
    control: ndarray,
    load: ndarray,
    status: ndarray,
    notes: ndarray,
    iterations: ndarray,
    residual: ndarray,
    reached: ndarray,
) -> None:
    """Solve cases one by one, each on its own: no case sees another's state, so any split over threads agrees.

    displacement (case, 5) and position (case, ball, 3) hold the start if is_warm, and the result in the case's units;
    load (case, 5) the ring's loads, reactions of held channels included; reached the part of the speed that all this is
    for. rings (1) and balls are working memory. An unfinished case keeps its start.
    """
    ring = rings[0]
    for k in range(cases.size):
        case = cases[k]
        prepare(case, ring, balls, is_warm, displacement[k], position[k], control[k])
        stands, notes[k], iterations[k], residual[k] = solve_directly(case, ring, balls, tolerance, is_warm)
        reached[k] = 1.0
        status[k] = CONVERGED if stands else UNFINISHED
        if stands:
            deliver(case, ring, balls, displacement[k], position[k], control[k], load[k])
