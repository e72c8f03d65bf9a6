"""The shaft of a set: its unknowns, and how the rows' condensed systems add up to theirs.

A row's displacement is u = G q + offset, its load comes back as G^T F (`qsbearing.sets.rigid_shaft`). The shaft is in
SI, each row in the units of its own case.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy import ndarray, recarray

from qsbearing.compiled import kernel
from qsbearing.kernel.assembly import assemble_balls, least_load, least_stiffness
from qsbearing.kernel.case import record
from qsbearing.kernel.linear import solve_in_place
from qsbearing.kernel.newton_step import propose_lines

SHAFT = record(
    ("load", np.float64, (6,)),  # on the five channels, and the spring's
    ("held", np.uint8, (6,)),  # which unknowns are given, or vanish by symmetry
    ("place", np.float64, (6,)),  # the values of those
    ("lever", np.float64),  # makes forces of moments
    ("q", np.float64, (6,)),
    ("residual", np.float64),
    ("iterations", np.int32),
    ("solved", np.bool_),
)
"""One case of a set: what its shaft is given, and what is found."""

SHAFT_SYSTEM = record(
    ("count", np.int64),  # of unknowns solved
    ("channel", np.int64, (6,)),  # which
    ("matrix", np.float64, (6, 6)),
    ("imbalance", np.float64, (6,)),
    ("right_side", np.float64, (6,)),
    ("step", np.float64, (6,)),
)
"""Working memory of the shaft."""


@kernel
def move_rows(cases: ndarray, works: ndarray, matrices: ndarray, offsets: ndarray, shaft: recarray, k: int) -> None:
    """Put the rows' rings where the shaft has them."""
    for r in range(cases.shape[0]):
        case, work = cases[r, k], works[r]
        for i in range(5):
            moved = offsets[r, k] if i == 0 else 0.0
            for j in range(6):
                moved += matrices[r, k, i, j] * shaft.q[j]
            work.displacement[i] = moved / case.length if i < 3 else moved


@kernel
def unknown_lever(shaft: recarray, unknown: int) -> float:
    """A length that makes a force of the unknown's equation: 1 for forces."""
    return shaft.lever if unknown == 3 or unknown == 4 else 1.0


@kernel
def assemble_rows(
    cases: ndarray, works: ndarray, balls: ndarray, matrices: ndarray, shaft: recarray, system: recarray, k: int
) -> tuple[float, float]:
    """Evaluate all rows where they are and leave the condensed system of the shaft: (residual, that beside own loads).

    The residual is the largest imbalance of a ball or of the shaft over the largest force: applied, inertial or of a
    contact; zero where all of that is what rounding presses; infinite where something is not a number.
    """
    count = system.count
    largest, worst, worst_own, total, softest, least = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for a in range(count):
        load = shaft.load[system.channel[a]]
        system.imbalance[a] = system.right_side[a] = -load
        largest = max(largest, abs(load) / unknown_lever(shaft, system.channel[a]))
        for b in range(count):
            system.matrix[a, b] = 0.0
    for r in range(cases.shape[0]):
        case, work = cases[r, k], works[r]
        own_worst, own, own_total, inertial, contact = assemble_balls(case, work, balls[r])
        worst, worst_own, total = max(worst, own_worst * case.force), max(worst_own, own), total + own_total
        largest, least = max(largest, max(inertial, contact) * case.force), max(least, least_load(case) * case.force)
        for a in range(count):
            add_row(case, work, matrices[r, k], system, a)
    largest, is_unloaded = max(largest, least), largest <= least
    for r in range(cases.shape[0]):
        case, work = cases[r, k], works[r]
        work.largest_force = largest / case.force
        work.regularisation = least_stiffness(case, work.largest_force)
        softest = max(softest, work.regularisation * case.force / case.length)
    for a in range(count):
        lever = unknown_lever(shaft, system.channel[a])
        system.matrix[a, a] += softest * lever * lever
        worst = max(worst, abs(system.imbalance[a]) / lever)
        total += system.imbalance[a]
    if not abs(total) < inf:
        return inf, inf
    return 0.0 if is_unloaded and worst <= cases.shape[0] * least else worst / largest, worst_own


@kernel
def add_row(case: recarray, work: recarray, matrix: ndarray, system: recarray, a: int) -> None:
    """Add a row's condensed system to the shaft's equation number a."""
    for p in range(work.channel_count):
        i = work.channel[p]
        back = matrix[i, system.channel[a]]
        if back == 0.0:
            continue
        back *= case.force if i < 3 else case.force * case.length
        system.imbalance[a] += back * work.imbalance[p]
        system.right_side[a] += back * work.right_side[p]
        for q in range(work.channel_count):
            j = work.channel[q]
            stiffness = back * work.matrix[p, q]
            if j < 3:
                stiffness /= case.length
            for b in range(system.count):
                system.matrix[a, b] += stiffness * matrix[j, system.channel[b]]


@kernel
def propose_shaft_step(
    cases: ndarray, works: ndarray, balls: ndarray, matrices: ndarray, system: recarray, k: int
) -> float:
    """Solve the assembled system for the steps of shaft, rows and balls; returns as `propose_step` does."""
    if not solve_in_place(system.matrix, system.right_side, system.count):
        return -1.0
    for j in range(6):
        system.step[j] = 0.0
    for a in range(system.count):
        system.step[system.channel[a]] = -system.right_side[a]
    fraction = 1.0
    for r in range(cases.shape[0]):
        case, work = cases[r, k], works[r]
        for i in range(5):
            moved = 0.0
            for j in range(6):
                moved += matrices[r, k, i, j] * system.step[j]
            work.step[i] = moved / case.length if i < 3 else moved
        fraction = min(fraction, propose_lines(case, work, balls[r]))
    return fraction
