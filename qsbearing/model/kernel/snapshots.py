"""Snapshots of ring and balls to return to, by name."""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel

# The last equilibrium of a continuation; the last for the balls' own controls; the first that contradicts its controls
# but is admissible; the first that is not; the one from which the friction bound is released.
CONTINUATION, CONTROLS, ADMISSIBLE, INADMISSIBLE, BOUNDED = 0, 1, 2, 3, 4
SNAPSHOTS = 5


@kernel
def save(work: recarray, balls: ndarray, name: int) -> None:
    """Note ring, balls, and what their equilibrium is for: the friction bound, the speed factor, the residual."""
    for i in range(5):
        work.snapshot[name, i] = work.displacement[i]
    work.snapshot_force[name] = work.largest_force
    work.snapshot_residual[name] = work.residual
    work.snapshot_bound[name] = work.friction_bound
    work.snapshot_speed[name] = work.speed_factor
    for n in range(work.ball_count):
        ball = balls[n]
        lines = ball.snapshot
        lines[name, 0], lines[name, 1], lines[name, 2] = ball.outer_sine, ball.outer_cosine, ball.outer_approach
        lines[name, 3], lines[name, 4], lines[name, 5] = ball.inner_sine, ball.inner_cosine, ball.inner_approach
        ball.deflection_snapshot[name] = ball.deflection
        ball.snapshot_control[name] = ball.control


@kernel
def restore(work: recarray, balls: ndarray, name: int) -> None:
    """Return to the positions and controls of a snapshot; bound and speed factor stay as they are."""
    for i in range(5):
        work.displacement[i] = work.snapshot[name, i]
    work.largest_force = work.snapshot_force[name]
    for n in range(work.ball_count):
        ball = balls[n]
        lines = ball.snapshot
        ball.outer_sine, ball.outer_cosine, ball.outer_approach = lines[name, 0], lines[name, 1], lines[name, 2]
        ball.inner_sine, ball.inner_cosine, ball.inner_approach = lines[name, 3], lines[name, 4], lines[name, 5]
        ball.deflection = ball.deflection_snapshot[name]
        ball.control = ball.snapshot_control[name]


@kernel
def restore_all(work: recarray, balls: ndarray, name: int) -> None:
    """Return to a snapshot, the bound, speed factor and residual of its equilibrium included."""
    restore(work, balls, name)
    work.friction_bound, work.speed_factor = work.snapshot_bound[name], work.snapshot_speed[name]
    work.residual = work.snapshot_residual[name]
