"""Dead forces: on balls and ring, the same wherever these go. Balance under them alone is unique.

They stand in for inertia and friction while a balance is sought: all of them at first, then ever less, or ever nearer
to what inertia and friction are.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.ball import carried_friction, friction_shares, inertia_of, is_rolled
from qsbearing.compiled import kernel
from qsbearing.verdict import contact_loads


@kernel
def channel_force(ring: recarray, ball: recarray, p: int, axial: float, radial: float, moment: float) -> float:
    """What a solved channel feels of a force in a ball's plane and a moment about the groove centres' circle."""
    row = ring.row[p]
    return ball.factor[p] * (axial if row == 0 else radial if row == 1 else moment)


@kernel
def set_loads(case: recarray, ring: recarray, factor: float) -> None:
    """Load the ring with this many times its loads."""
    for i in range(5):
        if not case.is_held[i]:
            case.prescribed[i] = factor * ring.load[i]


@kernel
def inertia_and_friction(case: recarray, ball: recarray, grip: float) -> tuple[float, float, float, float, float]:
    """What these do, where a ball is: (axial, radial) to it; (axial, radial, moment) of friction to the ring."""
    si, ci, so, co = ball.inner_sine, ball.inner_cosine, ball.outer_sine, ball.outer_cosine
    qi, qo = contact_loads(case, ball)
    fc, mg = inertia_of(case, ball)
    share_i, share_o = friction_shares(case, ball.control)
    if not is_rolled(ball):
        share_i, share_o = 0.0, 0.0
    ti, _, _ = carried_friction(share_i, mg, qi, grip)
    to, _, _ = carried_friction(share_o, mg, qo, grip)
    h1, h2 = -ti * ci, ti * si
    return h1 + to * co, h2 - to * so + fc, h1, h2, case.tilt_lever * h1 + case.inner_coefficient * ti


@kernel
def push(ring: recarray, balls: ndarray, factor: float) -> float:
    """Let so many times the dead forces act on the balls; returns the largest component that does."""
    largest = 0.0
    for n in range(ring.balls):
        ball = balls[n]
        ball.push[0], ball.push[1] = factor * ball.dead[0], factor * ball.dead[1]
        largest = max(largest, abs(ball.push[0]), abs(ball.push[1]))
    return largest


@kernel
def hold(case: recarray, ring: recarray, balls: ndarray) -> float:
    """Choose the dead forces that balance the contacts where ring and balls are, without inertia.

    Returns the largest load.
    """
    ring.inertia_grows = True
    largest = 0.0
    for i in range(5):
        ring.dead[i] = 0.0
    for n in range(ring.balls):
        ball = balls[n]
        si, ci, so, co = ball.inner_sine, ball.inner_cosine, ball.outer_sine, ball.outer_cosine
        qi, qo = contact_loads(case, ball)
        ball.dead[0], ball.dead[1] = qo * so - qi * si, qo * co - qi * ci
        largest = max(largest, qi, qo)
        for p in range(ring.channels):
            ring.dead[ring.channel[p]] += channel_force(ring, ball, p, qi * si, qi * ci, qi * si * case.tilt_lever)
    return largest


@kernel
def hold_loads(case: recarray, ring: recarray, balls: ndarray) -> None:
    """Let the loads that act now be the dead ones, and inertia act in full."""
    ring.inertia_grows = False
    for i in range(5):
        ring.dead[i] = case.prescribed[i]
    for n in range(ring.balls):
        balls[n].dead[0], balls[n].dead[1] = 0.0, 0.0


@kernel
def freeze(case: recarray, ring: recarray, balls: ndarray, part: float) -> float:
    """Bring the dead forces nearer, by this part, to the loads and to inertia and friction where ring and balls are.

    Returns what they lacked on the ball that lacked most.
    """
    left, lack = 1.0 - part, 0.0
    for i in range(5):
        ring.dead[i] = part * case.prescribed[i] + left * ring.dead[i]
    for n in range(ring.balls):
        ball = balls[n]
        f1, f2, h1, h2, h3 = inertia_and_friction(case, ball, ring.grip)
        lack = max(lack, abs(f1 - ball.dead[0]), abs(f2 - ball.dead[1]))
        ball.dead[0], ball.dead[1] = part * f1 + left * ball.dead[0], part * f2 + left * ball.dead[1]
        for p in range(ring.channels):
            ring.dead[ring.channel[p]] -= part * channel_force(ring, ball, p, h1, h2, h3)
    return lack


@kernel
def let_act(case: recarray, ring: recarray, balls: ndarray, factor: float) -> None:
    """Let so many times the dead forces act on balls and ring, in the place of loads."""
    for i in range(5):
        if not case.is_held[i]:
            case.prescribed[i] = factor * ring.dead[i]
    ring.frozen = push(ring, balls, factor)


@kernel
def release(case: recarray, ring: recarray, balls: ndarray) -> None:
    """Let no dead forces act, and the loads that are the case's own."""
    set_loads(case, ring, 1.0)
    ring.frozen = push(ring, balls, 0.0)
