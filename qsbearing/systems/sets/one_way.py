"""Rings that are held against one side only: in each case at what holds them, or away from it.

Where a row would be pulled away from what holds its ring, the ring goes along and the row carries no axial load. At
rest that is the least of a convex energy over places on one side of a bound, so that one state fits. It is found by
trying: rings that pull are let free, rings that have passed what holds them are held again (an active set).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.admissibility import CONVERGED, NOT_CONVERGED
from qsbearing.model.solution.rounding import NOISE
from qsbearing.systems.sets.problem import Problem
from qsbearing.systems.sets.rigid_shaft import UNKNOWNS, one_way_rings

AT_ONCE, ONE_BY_ONE = 6, 20
"""Rounds in which all rings change that should, and after them only the first: what goes round in circles by the one
rule ends by the other. Random sets of up to four such rows end after four."""
FREE = 1e-9
"""Of the stiffest row: less stiffness is the rounding of rings that follow the shaft."""
PASSED = 1e-12
"""[m] By so little a ring has not passed what holds it: rounding of positions."""


def settle(problem: Problem, part: slice, carried: NDArray) -> None:
    """Solve a stretch of cases, each with the rings held that are pressed against what holds them."""
    problem.solve(part, carried)
    rings = one_way_rings(problem.of)
    if not rings:
        return
    turned = carried[part].copy()
    for tried in range(AT_ONCE + ONE_BY_ONE):
        turned &= _turn(problem, part, turned, rings, tried >= AT_ONCE)
        for run in _runs(np.flatnonzero(turned) + part.start):
            problem.solve(run, carried)
        if not turned.any():
            break
    problem.outcome.status[part][turned] = NOT_CONVERGED
    problem.found.results["status"][:, part][:, turned] = NOT_CONVERGED
    _put_amid(problem, part, rings)


def without_idle_rings(of: Any, tangent: NDArray, at_rest: NDArray) -> NDArray:
    """A set's tangent over its unknowns in which a ring at what holds it moves nothing, nor one that nothing moves.

    Args:
        tangent: shape (case, unknown, unknown); changed in place.
        at_rest: which unknowns are given; shape (case, unknown).
    """
    rings = one_way_rings(of)
    for column, sleeve in enumerate(of.sleeves, UNKNOWNS):
        if all(of.is_two_sided[number] for number in sleeve):
            idle = tangent[:, column, column] == 0.0
            idle |= at_rest[:, column] if column in rings else False
            tangent[idle, column, :] = tangent[idle, :, column] = 0.0
            tangent[idle, column, column] = 1.0
    return tangent


def nothing_holds(shaft: NDArray, of_rows: list[NDArray]) -> NDArray:
    """Whether a shaft of this stiffness on rows of these goes along x freely; shape (*cases)."""
    stiffest = np.max([np.abs(own[..., 0, 0]) for own in of_rows], axis=0)
    return np.asarray(np.abs(shaft[..., 0, 0]) <= FREE * stiffest)


def _turn(problem: Problem, part: slice, which: NDArray, rings: dict[int, int], is_single: bool) -> NDArray:
    """Free and hold what should be in these cases: in which of them something changed, shape (case,)."""
    o, held = problem.outcome, problem.held[part]
    is_open = which & (o.status[part] == CONVERGED)
    changed = np.zeros(len(which), bool)
    for column, number in rings.items():
        pulls = held[:, column] & (o.axial[number, part] < -NOISE * o.largest[part])
        passes = ~held[:, column] & (problem.of.rows[number].sign * o.q[part, column] > PASSED)
        turns = is_open & (pulls | passes) & ~(changed & is_single)
        held[turns, column] ^= True
        changed |= turns
    return changed


def _put_amid(problem: Problem, part: slice, rings: dict[int, int]) -> None:
    """Where every ring is free, shaft and rings go along x together and no row feels it, until a ring comes to what
    holds it: to the middle of that way."""
    o, rigid = problem.outcome, problem.structure.rigid
    motion = np.zeros(rigid)
    motion[0] = motion[UNKNOWNS:] = 1.0
    stays = (problem.held[part, :rigid] & (motion != 0.0)).any(axis=1) | (o.status[part] != CONVERGED)
    stays |= (problem.matrices[:, part, 0, :rigid] @ motion != 0.0).any(axis=0)
    if problem.structure.elasticity.size:  # supports
        own = problem.structure.elasticity[part, :rigid, :rigid]
        stays |= np.einsum("i,kij,j->k", motion, own, motion) > 0.0
    low, high = np.full(len(stays), -np.inf), np.full(len(stays), np.inf)
    for column, number in rings.items():
        way = -o.q[part, column]
        if problem.of.rows[number].sign > 0.0:
            high = np.minimum(high, way)
        else:
            low = np.maximum(low, way)
    amid = np.where(stays | ~np.isfinite(low) | ~np.isfinite(high), 0.0, 0.5 * (low + high))
    o.q[part, :rigid] += np.where(np.isfinite(amid), amid, 0.0)[:, None] * motion


def _runs(numbers: NDArray) -> list[slice]:
    """Neighbours together."""
    parts = np.split(numbers, np.flatnonzero(np.diff(numbers) != 1) + 1)
    return [slice(int(each[0]), int(each[-1]) + 1) for each in parts if each.size]
