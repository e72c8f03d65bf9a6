"""Places of ring and balls to come back to, by slot."""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.compiled import kernel

# The last balance on the way to the one sought; the last found for all balls' controls; the last point of a path,
# or way to lighter loads; the last balance that needs no limit of friction; the last with a contact where no groove is;
# the same under one law of friction while another is tried; where forces were last frozen; where a search along a line
# begins.
ON_THE_WAY, SOLVED, PATH, STANDING, OBJECTED, REFUSED, FROZEN, LINE = 0, 1, 2, 3, 4, 5, 6, 7
SLOTS = 8


@kernel
def keep(ring: recarray, balls: ndarray, slot: int) -> None:
    """Note where ring and balls are, and the largest force there."""
    for i in range(5):
        ring.saved[slot, i] = ring.displacement[i]
    ring.saved_scale[slot] = ring.scale
    for n in range(ring.balls):
        ball = balls[n]
        links = ball.saved[slot]
        links[0], links[1], links[2] = ball.outer_sine, ball.outer_cosine, ball.outer_approach
        links[3], links[4], links[5] = ball.inner_sine, ball.inner_cosine, ball.inner_approach
        ball.saved_control[slot] = ball.control


@kernel
def restore(ring: recarray, balls: ndarray, slot: int) -> None:
    """Bring ring and balls back to where they were kept."""
    for i in range(5):
        ring.displacement[i] = ring.saved[slot, i]
    ring.scale = ring.saved_scale[slot]
    for n in range(ring.balls):
        ball = balls[n]
        links = ball.saved[slot]
        ball.outer_sine, ball.outer_cosine, ball.outer_approach = links[0], links[1], links[2]
        ball.inner_sine, ball.inner_cosine, ball.inner_approach = links[3], links[4], links[5]
        ball.control = ball.saved_control[slot]
