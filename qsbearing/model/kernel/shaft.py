"""The shaft of a set: its unknowns, and how the rows' condensed systems add up to theirs.

A row's displacement is u = G q + offset, its load comes back as G^T F (`qsbearing.systems.sets.rigid_shaft`); what the
rows stand on, where it bends, resists by S q (`qsbearing.systems.sets.elastic_shaft`). The shaft is in SI, each row in
the units of its own case.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np
from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.kernel.assembly import assemble_balls, least_load, least_stiffness
from qsbearing.model.kernel.case import record
from qsbearing.model.kernel.linear import solve_in_place
from qsbearing.model.kernel.newton_step import propose_lines

SHAFT = record(
    ("residual", np.float64),
    ("iterations", np.int32),
    ("solved", np.bool_),
    ("count", np.int64),  # of unknowns solved, not given
    ("is_loose", np.bool_),  # gaps are to be closed
)
"""One case of a set: how its solution stands."""


class Shafts(NamedTuple):
    """What the shafts of a stretch of cases are given, and where they are; arrays lead with the case."""

    load: ndarray
    """On the unknowns; shape (case, unknown)."""
    held: ndarray
    """Which unknowns are given, or vanish by symmetry; likewise."""
    lever: ndarray
    """Lengths that make forces of the unknowns' loads; likewise."""
    elasticity: ndarray
    """Stiffness of what the rows stand on over the unknowns; shape (case, unknown, unknown); no case: all is rigid."""
    rigid: int
    """So many unknowns, the first, are of rigid bodies, which nothing may hold but rows."""
    q: ndarray
    """Begins with the values of what is held, and a start of the others."""
    found: ndarray
    """Records; shape (case,)."""


class ShaftSystem(NamedTuple):
    """Working memory of the shaft."""

    channel: ndarray
    """Which unknowns are solved."""
    matrix: ndarray
    imbalance: ndarray
    right_side: ndarray
    step: ndarray
    start: ndarray
    moved: ndarray
    """A row's stiffness times its matrix; shape (5, unknown)."""


SHAFTS = Shafts._make(
    [
        array_of(float, 2),
        array_of(bool, 2),
        array_of(float, 2),
        array_of(float, 3),
        int,
        array_of(float, 2),
        array_of(SHAFT),
    ]
)
SHAFT_SYSTEM = ShaftSystem._make([array_of(np.int64), array_of(float, 2), *[array_of(float)] * 4, array_of(float, 2)])
"""The kinds of both."""


def shaft_system(unknowns: int) -> ShaftSystem:
    """Working memory for so many unknowns."""
    vectors = [np.zeros(unknowns) for _ in range(4)]
    square = np.zeros((unknowns, unknowns))
    return ShaftSystem._make([np.zeros(unknowns, np.int64), square, *vectors, np.zeros((5, unknowns))])


@kernel
def move_rows(cases: ndarray, works: ndarray, matrices: ndarray, offsets: ndarray, shafts: Shafts, k: int) -> None:
    """Put the rows' rings where the shaft has them."""
    for r in range(cases.shape[0]):
        case, work = cases[r, k], works[r]
        for i in range(5):
            moved = offsets[r, k] if i == 0 else 0.0
            for j in range(shafts.q.shape[1]):
                moved += matrices[r, k, i, j] * shafts.q[k, j]
            work.displacement[i] = moved / case.length if i < 3 else moved


@kernel
def assemble_rows(
    cases: ndarray, works: ndarray, balls: ndarray, matrices: ndarray, shafts: Shafts, system: ShaftSystem, k: int
) -> tuple[float, float]:
    """Evaluate all rows where they are and leave the condensed system of the shaft: (residual, that beside own loads).

    The residual is the largest imbalance of a ball or of the shaft over the largest force: applied, inertial or of a
    contact; zero where all of that is what rounding presses; infinite where something is not a number.
    """
    count = shafts.found[k].count
    largest, worst, worst_own, total, softest, least = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for a in range(count):
        load = shafts.load[k, system.channel[a]]
        system.imbalance[a] = system.right_side[a] = -load
        largest = max(largest, abs(load) / shafts.lever[k, system.channel[a]])
        for b in range(count):
            system.matrix[a, b] = 0.0
    if shafts.elasticity.shape[0] > 0:
        add_elasticity(shafts, system, k)
    for r in range(cases.shape[0]):
        case, work = cases[r, k], works[r]
        own_worst, own, own_total, inertial, contact = assemble_balls(case, work, balls[r])
        worst, worst_own, total = max(worst, own_worst * case.force), max(worst_own, own), total + own_total
        largest, least = max(largest, max(inertial, contact) * case.force), max(least, least_load(case) * case.force)
        add_row(case, work, matrices[r, k], system, count)
    largest, is_unloaded = max(largest, least), largest <= least
    for r in range(cases.shape[0]):
        case, work = cases[r, k], works[r]
        work.largest_force = largest / case.force
        work.regularisation = least_stiffness(case, work.largest_force)
        softest = max(softest, work.regularisation * case.force / case.length)
    for a in range(count):
        lever = shafts.lever[k, system.channel[a]]
        if system.channel[a] < shafts.rigid:
            system.matrix[a, a] += softest * lever * lever
        worst = max(worst, abs(system.imbalance[a]) / lever)
        total += system.imbalance[a]
    if not abs(total) < inf:
        return inf, inf
    return 0.0 if is_unloaded and worst <= cases.shape[0] * least else worst / largest, worst_own


@kernel
def add_elasticity(shafts: Shafts, system: ShaftSystem, k: int) -> None:
    """Add what the rows stand on, linear in the unknowns."""
    own = shafts.elasticity[k]
    for a in range(shafts.found[k].count):
        i = system.channel[a]
        force = 0.0
        for j in range(own.shape[0]):
            force += own[i, j] * shafts.q[k, j]
        system.imbalance[a] += force
        system.right_side[a] += force
        for b in range(shafts.found[k].count):
            system.matrix[a, b] += own[i, system.channel[b]]


@kernel
def add_row(case: recarray, work: recarray, matrix: ndarray, system: ShaftSystem, count: int) -> None:
    """Add a row's condensed system to the shaft's equations."""
    # Arrays by names of their own, as in `eliminate_deflections`.
    channel, total, moved_by, own, solved = system.channel, system.matrix, system.moved, work.matrix, work.channel
    for p in range(work.channel_count):
        for b in range(count):
            moved = 0.0
            for q in range(work.channel_count):
                j = solved[q]
                along = matrix[j, channel[b]]
                moved += own[p, q] * (along / case.length if j < 3 else along)
            moved_by[p, b] = moved
    for a in range(count):
        for p in range(work.channel_count):
            i = solved[p]
            back = matrix[i, channel[a]]
            if back == 0.0:
                continue
            back *= case.force if i < 3 else case.force * case.length
            system.imbalance[a] += back * work.imbalance[p]
            system.right_side[a] += back * work.right_side[p]
            for b in range(count):
                total[a, b] += back * moved_by[p, b]


@kernel
def propose_shaft_step(
    cases: ndarray, works: ndarray, balls: ndarray, matrices: ndarray, shafts: Shafts, system: ShaftSystem, k: int
) -> float:
    """Solve the assembled system for the steps of shaft, rows and balls; returns as `propose_step` does."""
    count, unknowns = shafts.found[k].count, shafts.q.shape[1]
    if not solve_in_place(system.matrix, system.right_side, count):
        return -1.0
    for j in range(unknowns):
        system.step[j] = 0.0
    for a in range(count):
        system.step[system.channel[a]] = -system.right_side[a]
    fraction = 1.0
    for r in range(cases.shape[0]):
        case, work = cases[r, k], works[r]
        for i in range(5):
            moved = 0.0
            for j in range(unknowns):
                moved += matrices[r, k, i, j] * system.step[j]
            work.step[i] = moved / case.length if i < 3 else moved
        fraction = min(fraction, propose_lines(case, work, balls[r]))
    return fraction
