"""A path to a balance at speed from one that cannot fail to exist, followed through its turning points.

Dead forces on balls and ring, the same wherever these go, hold any place whose contacts press. Balance under them is
the minimum of a convex energy, so there is one only. From there the path is, for a part p that grows from 0 to 1,

    contacts(d, X) + p inertia(d, X) + r dead - (p load + r dead load) = 0,      r = 1 - p,

with p times the limit of friction, where it has one. It cannot come back to p = 0, and all of that is continuous, so it
cannot end: it turns back in p where a balance does, as often as it must, and arrives at p = 1 unless it leaves for
infinity (Allgower and Georg, Introduction to Numerical Continuation Methods). In double precision it may still be lost:
where loads vanish below the resolution of places, or among more corners than are worth their time. Friction whatever
the load is not continuous, where a ball leaves both raceways: there the path may end.

Under loads beside which inertia hardly counts there is one balance only, too. A path from there needs no dead forces on
the balls: inertia acts in full all the way, and r = (1 - p)^4 makes loads ever lighter.

So the path is followed by its own length, not by p: a step along its tangent, then Newton's method across that. The
sign of the determinant of the derivatives says which way p goes on, with no memory of the way come.

A corner is where friction comes to its limit or a contact out of touch. A step that fails is tried once more as one
round a corner: past it, then on along the tangent found there.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.ball import inertia, set_outer, set_speed
from qsbearing.compiled import kernel
from qsbearing.dead_forces import channel_force, hold, hold_loads, inertia_and_friction, push
from qsbearing.keeping import PATH, keep, restore
from qsbearing.newton import (
    NEAR,
    applied_load,
    ball_steps,
    close_chains,
    has_gone_far,
    is_open,
    move,
    newton,
    pass_over_balls,
    ring_step,
    stop,
)
from qsbearing.relaxation import relax_to_rest
from qsbearing.ring import inner_groove_centre
from qsbearing.start import resting_thrust, seat_balls

# Where p starts: nothing, but for a force to be measured by.
START = 1e-15
# Lengths of steps, in units of p and of the inner link: the first, the longest, and what is too short to go on.
FIRST, LONGEST, SHORTEST = 0.05, 0.5, 1e-11
# A step that fails is made so much shorter; one that does not, so that the next would stray by this part of its length.
SHORTER, STRAYING = 0.1, 0.2
LONGER, SLOWER = 2.0, 0.5
# Newton's steps across the path: so many at most, none longer than the step along it, or than this. A contact that just
# comes into touch takes many: each takes two thirds off its approach (that root of load is not simple).
CORRECTIONS, NEARBY = 16, 1e-4
# How well balance is known on the path, by the largest force and by each ball's or channel's own. An imbalance of a few
# roundings of the largest force is none, however light the load of the ball or channel that feels it.
BALANCED, OWN_BALANCED, ROUNDED = 1e-10, 1e-4, 1e-15
CLOSINGS = 2
# No line turns further at a step (radians), no groove centre moves further (ball diameters).
LARGEST_TURN, LARGEST_MOVE = 0.5, 1.0
# Where a path starts balls are pressed by this many times the largest force that acts on one, or by this part of their
# stiffness where none does.
PRESSED, LEAST_PRESSED = 3.0, 1e-10
# The outer contact's part of the approach at the start, and up to how much more: dead forces then press balls outward,
# each by its own measure, so that none is ever without force, and equal ones do not turn back at once.
OUTER_PART, OUTER_PARTS = 0.55, 0.2
# Balls that only inertia presses start turned by up to this angle, to either side.
UNEQUAL = 0.025
# Its multiples leave evenly spread rests.
GOLDEN = 0.6180339887498949
# An imbalance from which there is no way.
NO_PLACE = 1e30


@kernel
def own_measure(ball: recarray) -> float:
    """A number from 0 to 1 for this ball, evenly spread and unlike any other's."""
    return ((ball.number + 1.0) * 3.0 * GOLDEN) % 1.0


@kernel
def press(case: recarray, ring: recarray, balls: ndarray) -> None:
    """Put ring and balls where contacts press every ball, as far as the ring is free to do so."""
    s, c = case.sin_free, case.cos_free
    fc, _, _, mg, _, _ = inertia(case, balls[0].control, s, c, s, c)
    force = PRESSED * max(applied_load(case), fc, abs(mg), LEAST_PRESSED * case.series_stiffness)
    for i in range(5):
        ring.displacement[i] = case.prescribed[i] if case.is_held[i] else 0.0
    if not case.is_held[0]:
        ring.displacement[0] = resting_thrust(case, case.ball_count * force)
    stop(case, ring, balls)
    seat_balls(case, ring, balls)
    for n in range(ring.balls):
        ball = balls[n]
        if ball.inner_sine != ball.outer_sine or ball.inner_cosine != ball.outer_cosine:  # thrown
            turn = UNEQUAL * (2.0 * own_measure(ball) - 1.0)
            so, co = ball.outer_sine + turn * ball.outer_cosine, ball.outer_cosine - turn * ball.outer_sine
            size = 1.0 / sqrt(so * so + co * co)
            set_outer(ball, so * size, co * size, ball.outer_approach)
        else:
            part = OUTER_PART + OUTER_PARTS * own_measure(ball)
            ball.outer_approach = part * (ball.outer_approach + ball.inner_approach)


@kernel
def dead_part(ring: recarray, part: float) -> tuple[float, float]:
    """The part of the dead forces that still acts, and how fast it falls.

    Were it 1 - p for heavy loads, lighter ones by a billion would count in the last billionth of the way only.
    """
    rest = 1.0 - part
    if ring.inertia_grows:
        return rest, 1.0
    cube = rest * rest * rest
    return rest * cube, 4.0 * cube


@kernel
def set_part(case: recarray, ring: recarray, balls: ndarray, part: float, inner: float, outer: float) -> None:
    """Let this part of loads and inertia act, and dead forces for the rest. Inertia grows as the square of speed."""
    rest, _ = dead_part(ring, part)
    grown = part if ring.inertia_grows else 1.0
    set_speed(case, sqrt(grown), inner, outer)
    ring.grip = grown * ring.limit
    for i in range(5):
        if not case.is_held[i]:
            case.prescribed[i] = part * ring.load[i] + rest * ring.dead[i]
    push(ring, balls, rest)


@kernel
def rate_of_balance(case: recarray, ring: recarray, balls: ndarray, part: float, inner: float, outer: float) -> None:
    """Put in the place of imbalances what one more of the part would add to them."""
    set_speed(case, 1.0, inner, outer)
    _, slope = dead_part(ring, part)
    for p in range(ring.channels):
        i = ring.channel[p]
        ring.right[p] = slope * ring.dead[i] - ring.load[i]
    for n in range(ring.balls):
        ball = balls[n]
        if not ring.inertia_grows:  # nothing that acts on it changes
            ball.y1, ball.y2 = 0.0, 0.0
            continue
        r1, r2, h1, h2, h3 = inertia_and_friction(case, ball, ring.limit)
        r1, r2 = r1 - slope * ball.dead[0], r2 - slope * ball.dead[1]
        y1 = (ball.own22 * r1 - ball.own12 * r2) * ball.inverse
        y2 = (ball.own11 * r2 - ball.own21 * r1) * ball.inverse
        ball.y1, ball.y2 = y1, y2
        c1 = h1 - ball.by_own[0, 0] * y1 - ball.by_own[0, 1] * y2
        c2 = h2 - ball.by_own[1, 0] * y1 - ball.by_own[1, 1] * y2
        c3 = h3 - ball.by_own[2, 0] * y1 - ball.by_own[2, 1] * y2
        for p in range(ring.channels):
            ring.right[p] += channel_force(ring, ball, p, c1, c2, c3)


@kernel
def two_steps(
    case: recarray, ring: recarray, balls: ndarray, part: float, inner: float, outer: float, force: float
) -> tuple[float, float, float]:
    """Newton's step at this part, left in `first`, and what one more of the part would move, in `step`, `du1`, `du2`.

    Returns:
        (imbalance over the largest force, the same of the ball or channel worst off beside its own load, the sign of
        the derivatives' determinant: 0 where there is no way on).
    """
    set_part(case, ring, balls, part, inner, outer)
    residual, own = pass_over_balls(case, ring, balls)
    for p in range(ring.channels):
        for q in range(ring.channels):
            ring.kept_matrix[p, q] = ring.matrix[p, q]
    if not residual < NO_PLACE or ring_step(case, ring, balls) < 0.0:
        return NO_PLACE, NO_PLACE, 0.0
    residual *= ring.scale / max(ring.scale, force)
    ball_steps(case, ring, balls)
    sign = ring.orientation
    for i in range(5):
        ring.first[i] = ring.step[i]
    for n in range(ring.balls):
        ball = balls[n]
        ball.first[0], ball.first[1] = ball.du1, ball.du2
        if ball.inverse < 0.0:
            sign = -sign
    rate_of_balance(case, ring, balls, part, inner, outer)
    for p in range(ring.channels):
        for q in range(ring.channels):
            ring.matrix[p, q] = ring.kept_matrix[p, q]
    ring_step(case, ring, balls)
    ball_steps(case, ring, balls)
    return residual, own, sign


@kernel
def weight_of(case: recarray, channel: int) -> float:
    """What a ring's displacement counts beside p, squared: lengths by the inner link's, tilts at their lever."""
    size = (case.tilt_lever if channel >= 3 else 1.0) / (case.inner_coefficient - 0.5)
    return size * size


@kernel
def tangent(case: recarray, ring: recarray, balls: ndarray, sign: float) -> float:
    """Make the path's tangent, of unit length, of the last rate; returns its share of p, 0 where there is none."""
    weight = weight_of(case, 0)
    total = 1.0
    for i in range(5):
        total += weight_of(case, i) * ring.step[i] * ring.step[i]
    for n in range(ring.balls):
        ball = balls[n]
        total += weight * (ball.du1 * ball.du1 + ball.du2 * ball.du2)
    if not total < NO_PLACE * NO_PLACE:
        return 0.0
    share = sign / sqrt(total)
    for i in range(5):
        ring.tangent[i] = share * ring.step[i]
    for n in range(ring.balls):
        ball = balls[n]
        ball.tangent[0], ball.tangent[1] = share * ball.du1, share * ball.du2
    return share


@kernel
def advance(case: recarray, ring: recarray, balls: ndarray, is_near: bool) -> bool:
    """Take the steps in `step`, `du1`, `du2`; False, and none taken, where that is too far."""
    for n in range(ring.balls):
        ball = balls[n]
        da1, da2 = inner_groove_centre(case, ring.step, ball.cosine, ball.sine)
        ball.dv1, ball.dv2 = ball.gap1 + da1 - ball.du1, ball.gap2 + da2 - ball.du2
        outer = abs(ball.outer_cosine * ball.du1 - ball.outer_sine * ball.du2) * ball.outer_inverse
        inner = abs(ball.inner_cosine * ball.dv1 - ball.inner_sine * ball.dv2) * ball.inner_inverse
        ball.turn = max(outer, inner)
        if not (ball.turn < LARGEST_TURN and max(abs(da1), abs(da2)) < LARGEST_MOVE):
            return False
    move(case, ring, balls, 1.0, True, is_near)
    return not has_gone_far(ring)


@kernel
def go_along(case: recarray, ring: recarray, balls: ndarray, length: float) -> bool:
    """Go this far along the tangent."""
    for i in range(5):
        ring.step[i] = length * ring.tangent[i]
    for n in range(ring.balls):
        ball = balls[n]
        ball.du1, ball.du2 = length * ball.tangent[0], length * ball.tangent[1]
    return advance(case, ring, balls, False)


@kernel
def come_back(
    case: recarray,
    ring: recarray,
    balls: ndarray,
    part: float,
    share: float,
    stride: float,
    inner: float,
    outer: float,
    force: float,
) -> tuple[float, int, float, float]:
    """Newton's method across the tangent.

    Returns:
        (the sign that turns the rate left in `step`, `du1`, `du2` to where the path leads on, 0 where it is not found
        or leads back; evaluations; part; the first step's length).
    """
    weight = weight_of(case, 0)
    farthest = max(stride, NEARBY)
    closings, strayed, before = 0, 0.0, 0.0
    for evaluations in range(1, CORRECTIONS + 2):
        residual, own, sign = two_steps(case, ring, balls, part, inner, outer, force)
        along, rate = 0.0, share  # of Newton's step and of a whole of the part, along the tangent
        for i in range(5):
            product = weight_of(case, i) * ring.tangent[i]
            along += product * ring.first[i]
            rate += product * ring.step[i]
        for n in range(ring.balls):
            ball = balls[n]
            along += weight * (ball.tangent[0] * ball.first[0] + ball.tangent[1] * ball.first[1])
            rate += weight * (ball.tangent[0] * ball.du1 + ball.tangent[1] * ball.du2)
        if residual <= ROUNDED or (residual <= BALANCED and own <= OWN_BALANCED):
            if closings == CLOSINGS or not is_open(ring, balls):
                return (sign if sign * rate > 0.0 else 0.0), evaluations, part, strayed
            close_chains(case, ring, balls)
            closings += 1
            continue
        if sign == 0.0 or rate == 0.0 or evaluations > CORRECTIONS:
            return 0.0, evaluations, part, strayed
        change = -along / rate
        size = change * change
        for i in range(5):
            ring.step[i] = ring.first[i] + change * ring.step[i]
            size += weight_of(case, i) * ring.step[i] * ring.step[i]
        for n in range(ring.balls):
            ball = balls[n]
            ball.du1, ball.du2 = ball.first[0] + change * ball.du1, ball.first[1] + change * ball.du2
            size += weight * (ball.du1 * ball.du1 + ball.du2 * ball.du2)
        size = sqrt(size)
        part += change
        is_lost = not (size <= farthest and part > 0.0) or (evaluations > 2 and size > before)
        if is_lost or not advance(case, ring, balls, residual < NEAR):
            return 0.0, evaluations, part, strayed
        if evaluations == 1:
            strayed = size
        before = size
    return 0.0, CORRECTIONS + 1, part, strayed


@kernel
def step_on(
    case: recarray,
    ring: recarray,
    balls: ndarray,
    part: float,
    share: float,
    stride: float,
    legs: int,
    inner: float,
    outer: float,
    force: float,
) -> tuple[float, int, float, float]:
    """From a point of the path, where the tangent is known, to the next; returns as coming back to the path does.

    With two legs past a corner: the second, twice as long, along the tangent found at the end of the first.
    """
    evaluations = 0
    for leg in range(legs):
        if leg > 0:
            _, _, sign = two_steps(case, ring, balls, part, inner, outer, force)
            share = tangent(case, ring, balls, sign)
            evaluations += 1
        length = (leg + 1.0) * stride
        part += length * share
        if share == 0.0 or part <= 0.0 or not go_along(case, ring, balls, length):
            return 0.0, evaluations, part, 0.0
    sign, more, part, strayed = come_back(case, ring, balls, part, share, stride, inner, outer, force)
    return sign, evaluations + more, part, strayed


@kernel
def rest_nearby(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """From where a path was lost to a balance under the full loads, if one is near: as Newton's method returns."""
    restore(ring, balls, PATH)
    converged, total, residual = newton(case, ring, balls, tolerance)
    if not converged:
        restore(ring, balls, PATH)
        converged, iterations, residual = relax_to_rest(case, ring, balls, tolerance)
        total += iterations
    return converged, total, residual


@kernel
def follow(
    case: recarray,
    ring: recarray,
    balls: ndarray,
    inner: float,
    outer: float,
    tolerance: float,
    is_pressed: bool,
    worth: int,
) -> tuple[bool, int, float]:
    """Follow the path that starts where ring and balls are: (converged at the speeds given, iterations, residual).

    It starts in any place that presses balls, with dead forces on these, or else in a balance at speed under the loads
    that are prescribed now. Loads, speeds and the limit of friction, if there is one, are the case's own again at the
    end, found or not.
    """
    close_chains(case, ring, balls)
    force = 0.0
    if is_pressed:
        force = hold(case, ring, balls)
    else:
        hold_loads(case, ring, balls)
    part, stride, total = START, FIRST, 1
    _, _, sign = two_steps(case, ring, balls, part, inner, outer, force)
    share = tangent(case, ring, balls, sign)
    keep(ring, balls, PATH)
    while total < worth and stride > SHORTEST:
        sign = 0.0
        for legs in range(1, 3):
            restore(ring, balls, PATH)
            sign, evaluations, next_part, strayed = step_on(
                case, ring, balls, part, share, stride, legs, inner, outer, force
            )
            total += evaluations
            if sign != 0.0:
                break
        if sign != 0.0 and next_part < 1.0:
            share = tangent(case, ring, balls, sign)
            keep(ring, balls, PATH)
            part = next_part
            longer = sqrt(STRAYING * stride / strayed) if strayed > 0.0 else LONGER
            stride = min(stride * min(max(longer, SLOWER), LONGER), LONGEST)
            continue
        if sign != 0.0:
            set_part(case, ring, balls, 1.0, inner, outer)
            converged, iterations, residual = newton(case, ring, balls, tolerance)
            total += iterations
            if converged:
                return True, total, residual
        stride *= SHORTER
        restore(ring, balls, PATH)
        _, _, sign = two_steps(case, ring, balls, part, inner, outer, force)
        share = tangent(case, ring, balls, sign)
        total += 1
    set_part(case, ring, balls, 1.0, inner, outer)
    converged, iterations, residual = rest_nearby(case, ring, balls, tolerance)
    return converged, total + iterations, residual
