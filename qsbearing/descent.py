"""The bearing under forces that stay: descent on a convex energy, which cannot fail to reach its minimum.

With dead forces f on the balls and F on the ring (inertia and friction among them, held as they are) equilibrium is the
stationarity of

    Pi(d, X) = sum over balls 2/5 (Ki <|A(d) - X| - Li>^(5/2) + Ko <|X| - Lo>^(5/2) - f.X) - F.d,      <x> = max(x, 0)

A(d) is affine, a norm is convex, <x>^(5/2) is convex and grows: Pi is convex in the displacements of ring and balls
together, and lost contacts are ordinary points of it. At rest, f = 0, both contacts of a ball are springs in series and
its place follows in closed form. Along any line the slope of Pi only rises, so a line search by slopes, free of the
cancellation that differences of energies suffer, always finds its step.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.ball import set_outer
from qsbearing.compiled import kernel
from qsbearing.contact import direction, link
from qsbearing.keeping import LINE, keep
from qsbearing.newton import STALLED, ball_steps, close_chains, has_gone_far, pass_over_balls, ring_step

# Far from balance, where loads are 1e-8 of frozen inertia, it takes some hundred steps, seldom more.
MOST = 1000


@kernel
def pass_closed(case: recarray, ring: recarray, balls: ndarray) -> float:
    """Evaluate ring and balls with all chains closed, the tangent left in the ring: the relative residual."""
    close_chains(case, ring, balls)
    residual, _ = pass_over_balls(case, ring, balls)
    return residual


@kernel
def move_along(case: recarray, ring: recarray, balls: ndarray, fraction: float) -> None:
    """Put ring and balls at the fraction of their step from where they were kept."""
    for i in range(5):
        ring.displacement[i] = ring.saved[LINE, i] + fraction * ring.step[i]
    if ring.at_rest:
        return
    length, s, c = case.outer_coefficient - 0.5, case.sin_free, case.cos_free
    for n in range(ring.balls):
        ball = balls[n]
        links = ball.saved[LINE]
        u1, u2 = link(length, s, c, links[0], links[1], links[2])
        approach, n1, n2, _ = direction(length, s, c, u1 + fraction * ball.du1, u2 + fraction * ball.du2)
        set_outer(ball, n1, n2, approach)


@kernel
def slope_along_step(ring: recarray, balls: ndarray) -> float:
    """dPi/dt of the last pass's point along the step."""
    slope = 0.0
    for p in range(ring.channels):
        slope += ring.imbalance[p] * ring.step[ring.channel[p]]
    if ring.at_rest:
        return slope
    for n in range(ring.balls):
        ball = balls[n]
        r1, r2 = ball.own11 * ball.y1 + ball.own12 * ball.y2, ball.own21 * ball.y1 + ball.own22 * ball.y2
        slope -= ball.weight * (r1 * ball.du1 + r2 * ball.du2)
    return slope


@kernel
def search_line(case: recarray, ring: recarray, balls: ndarray, tolerance: float, fraction: float) -> float:
    """Go along the step until its slope is at most half the first, by secants on the rising slope.

    Returns the relative imbalance where it stops.
    """
    first = slope_along_step(ring, balls)
    keep(ring, balls, LINE)
    low, slope_low, high, slope_high = 0.0, first, -1.0, 0.0
    residual = 1.0
    for _ in range(60):
        move_along(case, ring, balls, fraction)
        residual = pass_closed(case, ring, balls)
        slope = slope_along_step(ring, balls)
        if abs(slope) <= 0.5 * abs(first) or residual <= tolerance:
            break
        if slope < 0.0:
            low, slope_low = fraction, slope
            if high < 0.0:
                fraction *= 3.0
                continue
        else:
            high, slope_high = fraction, slope
        guess = low + (high - low) * slope_low / (slope_low - slope_high)
        margin = 0.1 * (high - low)
        fraction = min(max(guess, low + margin), high - margin)
    return residual


@kernel
def descend(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Minimise Pi in place from where ring and balls are: (converged, iterations, relative residual)."""
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    residual = pass_closed(case, ring, balls)
    for iteration in range(MOST):
        largest = ring_step(case, ring, balls) if residual > tolerance else -1.0
        if largest < 0.0:
            return residual <= tolerance, iteration, residual
        if not ring.at_rest:
            ball_steps(case, ring, balls)
        before = residual
        residual = search_line(case, ring, balls, tolerance, 1.0 if largest <= length else length / largest)
        if residual >= before and before <= STALLED:  # the limit of rounding: the step is taken back
            move_along(case, ring, balls, 0.0)
            return True, iteration, before
        if has_gone_far(ring):
            return False, iteration, residual
    return residual <= STALLED, MOST, residual
