"""Elastic rings: by how much the grooves of each ball move apart, eliminated into the ring's system.

The radial loads of the balls on a groove move it, as a series of harmonics of the azimuth (`effects.ring_compliance`):

    w_j = sum over k and balls i of (co_k g_i + ci_k h2_i) cos k(psi_j - psi_i),      A2 = (19.4) - w,

with g = Qo cos ao + To sin ao the radial load on the outer ring, h2 that on the inner one (`kernel.ball`). Balls stand
at equal distances, so that harmonics n and k act alike on them where n +- k is a multiple of Z: co_k and ci_k hold the
sums of such. With phi_m = cos k psi or sin k psi, w_j = sum of phi_mj z_m, the amplitudes z are the ring's unknowns:

    z_m = sum over balls of phi_m (co g + ci h2).

At rest they add a positive quadratic form to the convex energy (`kernel.continuation`). In Newton's step z is
eliminated once the balls' sums are complete, as the balls were before, which leaves the ring's own system. A case
without elastic rings has none of this.
"""

from __future__ import annotations

from math import inf

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.kernel.linear import eliminate
from qsbearing.model.kernel.workspace import MOST_WAVES


@kernel
def set_compliances(case: recarray, work: recarray, own: ndarray) -> None:
    """Take the case's compliances, and the modes that its symmetry leaves (`ring.find_distinct_balls`)."""
    for k in range(min(MOST_WAVES, case.ball_count // 2) + 1):
        work.outer_compliance[k], work.inner_compliance[k] = own[k].outer_compliance, own[k].inner_compliance
    choose_modes(case, work, work.in_plane[1] != 0.0, work.in_plane[2] != 0.0)


@kernel
def choose_modes(case: recarray, work: recarray, in_y: bool, in_z: bool) -> None:
    """The modes that balls may excite whose radial loads have a resultant along y, along z, along both or neither."""
    count = 0
    for k in range(min(MOST_WAVES, case.ball_count // 2) + 1):
        if work.outer_compliance[k] == 0.0 and work.inner_compliance[k] == 0.0:
            continue
        for sine in range(2):
            is_even_in_y = sine == 0  # mirrored at the x-y plane
            is_even_in_z = sine == k % 2  # at the x-z plane
            is_excited = (in_y or is_even_in_z) and (in_z or is_even_in_y) and (in_y or in_z or k == 0)
            if is_excited and not (k == 0 and sine == 1):
                work.wave[count], work.is_sine[count] = k, sine
                count += 1
    work.mode_count = count


@kernel
def values_at(work: recarray, ball: recarray) -> None:
    """The modes' values at a ball, left in the workspace."""
    wave, is_sine, value = work.wave, work.is_sine, work.value
    cosine, sine = ball.cosine, ball.sine
    c, s, k = 1.0, 0.0, 0
    for m in range(work.mode_count):
        while k < wave[m]:
            c, s = c * cosine - s * sine, s * cosine + c * sine
            k += 1
        value[m] = s if is_sine[m] else c


@kernel
def reset_deflections(work: recarray, balls: ndarray) -> None:
    """Let no ring be deflected yet."""
    for n in range(work.ball_count):
        balls[n].deflection = 0.0


@kernel
def eliminate_deflections(case: recarray, work: recarray, balls: ndarray) -> tuple[float, float]:
    """Condense the amplitudes into the ring's system, which the pass over the balls has left in the workspace.

    Returns:
        (largest force that the error of a deflection hides, sum of them).
    """
    # Arrays by names of their own: in plain Python a look at a record takes longer than a product.
    system, value, wave, row = work.modes, work.value, work.wave, work.row
    by_mode, right_side, matrix = work.by_mode, work.right_side, work.matrix
    outer_compliance, inner_compliance = work.outer_compliance, work.inner_compliance
    columns = work.channel_count
    modes = work.mode_count
    free, loaded = modes + columns, modes + columns + 1  # z without a step of the ring; z of the loads as they are
    for m in range(modes):
        for column in range(loaded + 1):
            system[m, column] = 0.0
        system[m, m] = 1.0
        for p in range(columns):
            by_mode[p, m] = 0.0
    for n in range(work.ball_count):
        ball = balls[n]
        values_at(work, ball)
        stiffness, lever, factor, deflection = ball.stiffness, ball.lever, ball.factor, ball.deflection
        axial, radial, outer_1, outer_2 = (
            stiffness[1, 0],
            stiffness[1, 1],
            ball.outer_stiffness_1,
            ball.outer_stiffness_2,
        )
        h, g = ball.condensed[1] + radial * deflection, ball.outer_condensed + outer_2 * deflection
        inner_force, outer_force, weight = ball.force[1], ball.outer_force, ball.weight
        for m in range(modes):
            k = wave[m]
            outer = weight * value[m] * outer_compliance[k]
            inner = weight * value[m] * inner_compliance[k]
            across = outer * outer_2 + inner * radial
            along = outer * outer_1 + inner * axial
            for other in range(modes):
                system[m, other] += across * value[other]
            for p in range(columns):
                system[m, modes + p] += lever[p] * (across if row[p] == 1 else along)
            system[m, free] += outer * g + inner * h
            system[m, loaded] += outer * outer_force + inner * inner_force
        for p in range(columns):
            by_deflection = factor[p] * stiffness[row[p], 1]
            right_side[p] += by_deflection * deflection
            for m in range(modes):
                by_mode[p, m] += by_deflection * value[m]
    worst, total = 0.0, 0.0
    for n in range(work.ball_count):
        ball = balls[n]
        values_at(work, ball)
        error = ball.deflection
        for m in range(modes):
            error -= value[m] * system[m, loaded]
        force = abs(error) * max(abs(ball.stiffness[0, 1]), abs(ball.stiffness[1, 1]))
        worst, total = max(worst, force), total + force
    if not eliminate(system, modes, free + 1):
        return inf, inf
    for p in range(columns):
        for m in range(modes):
            right_side[p] -= by_mode[p, m] * system[m, free]
            for q in range(columns):
                matrix[p, q] -= by_mode[p, m] * system[m, modes + q]
    return worst, total


@kernel
def propose_deflections(work: recarray, balls: ndarray) -> None:
    """The steps of all deflections with the ring's; from the sums that `eliminate_deflections` left."""
    system, modes, columns = work.modes, work.mode_count, work.channel_count
    for m in range(modes):
        value = system[m, modes + columns]
        for p in range(columns):
            value += system[m, modes + p] * work.step[work.channel[p]]
        work.amplitude[m] = value
    for n in range(work.ball_count):
        ball = balls[n]
        values_at(work, ball)
        ball.deflection_step = -ball.deflection
        for m in range(modes):
            ball.deflection_step += work.value[m] * work.amplitude[m]
