"""The bearing at rest: descent on a convex energy, which cannot fail to reach its minimum.

At rest both contacts of a ball are springs in series, its place follows in closed form, and equilibrium of the ring is
the stationarity of

    Pi(d) = sum over balls 2/5 K <|A(d)| - L>^(5/2) - F.d,      L = BD, <x> = max(x, 0)

A(d) is affine, a norm is convex, <x>^(5/2) is convex and grows: Pi is convex in the ring's displacement, and lost
contacts are ordinary points of it. Along any line its slope only rises, so a line search by slopes, free of the
cancellation that differences of energies suffer, always finds its step.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.compiled import kernel
from qsbearing.newton import STALLED, close_chains, pass_over_balls, ring_step, stop

MOST = 200


@kernel
def pass_at_rest(case: recarray, ring: recarray, balls: ndarray) -> float:
    """Evaluate the bearing at rest, its chains closed, its tangent left in the ring: the relative residual."""
    close_chains(case, ring, balls)
    residual, _ = pass_over_balls(case, ring, balls)
    return residual


@kernel
def move_along(ring: recarray, fraction: float) -> None:
    """Put the ring at the fraction of its step."""
    for i in range(5):
        ring.displacement[i] = ring.before[i] + fraction * ring.step[i]


@kernel
def slope_along_step(ring: recarray) -> float:
    """dPi/dt of the last pass's point along the step."""
    slope = 0.0
    for p in range(ring.channels):
        slope += ring.imbalance[p] * ring.step[ring.channel[p]]
    return slope


@kernel
def search_line(case: recarray, ring: recarray, balls: ndarray, tolerance: float, fraction: float) -> float:
    """Go along the step until its slope is at most half the first, by secants on the rising slope.

    Returns the relative imbalance where it stops.
    """
    first = slope_along_step(ring)
    for i in range(5):
        ring.before[i] = ring.displacement[i]
    low, slope_low, high, slope_high = 0.0, first, -1.0, 0.0
    residual = 1.0
    for _ in range(60):
        move_along(ring, fraction)
        residual = pass_at_rest(case, ring, balls)
        slope = slope_along_step(ring)
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
    """Minimise Pi in place from where the ring is: (converged, iterations, relative residual)."""
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    stop(case, ring, balls)
    residual = pass_at_rest(case, ring, balls)
    for iteration in range(MOST):
        largest = ring_step(case, ring, balls) if residual > tolerance else -1.0
        if largest < 0.0:
            return residual <= tolerance, iteration, residual
        before = residual
        residual = search_line(case, ring, balls, tolerance, 1.0 if largest <= length else length / largest)
        if residual >= before and before <= STALLED:  # the limit of rounding: the step is taken back
            move_along(ring, 0.0)
            return True, iteration, before
    return residual <= STALLED, MOST, residual
