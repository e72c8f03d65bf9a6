"""Rings that are held against one side only: in each case at what holds them, or away from it.

Where a row would be pulled away from what holds its ring, the ring goes along and the row carries no axial load. At
rest that is the least of a convex energy over places on one side of a bound, so that one state fits. It is found by
trying (an active set): of the rings that pull, the one that pulls most is let free, and the energy falls; rings that
have passed what holds them are held again. Where that ends without a solution, all states are tried, one after another.
"""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.admissibility import CONVERGED, NOT_CONVERGED
from qsbearing.systems.sets.location import carried as carried_by
from qsbearing.systems.sets.problem import Problem
from qsbearing.systems.sets.rigid_shaft import SLIDE, UNKNOWNS, one_way_rings

MOST_ROUNDS = 20
"""Random sets of up to four such rows end after six."""
MOST_TRIED = 6
"""Rings, of whose states all are tried: 64 at most."""
FREE = 1e-9
"""Of the stiffest row: less stiffness is the rounding of rings that follow the shaft."""
PASSED = 1e-12
"""[m] By so little a ring has not passed what holds it: rounding of positions."""


def settle(problem: Problem, part: slice, carried: NDArray) -> None:
    """Solve a stretch of cases, each with the rings held that are pressed against what holds them."""
    rings = one_way_rings(problem.of)
    if rings:  # without any load a shaft goes where no ring is pressed
        problem.held[part, list(rings)] = (problem.load[part, :SLIDE] != 0.0).any(axis=1)[:, None]
    problem.solve(part, carried)
    if not rings:
        return
    turned = carried[part].copy()
    for _ in range(MOST_ROUNDS):
        turned = _turn(problem, part, turned, rings)
        for run in _runs(np.flatnonzero(turned) + part.start):
            problem.solve(run, carried)
        if not turned.any():
            break
    unsolved = carried[part] & (turned | (problem.outcome.status[part] != CONVERGED))
    for case in np.flatnonzero(unsolved) + part.start:
        _try_all(problem, slice(case, case + 1), carried, rings)
    _put_amid(problem, part, rings)


def _try_all(problem: Problem, case: slice, carried: NDArray, rings: dict[int, int]) -> None:
    """Look for the state of the rings that fits, where some row is held against the thrust; without one, as it was."""
    o, columns, way = problem.outcome, list(rings), np.sign(problem.load[case.start, 0])
    before = problem.held[case.start].copy()
    able = [number for number in range(len(problem.of.rows)) if number not in rings.values()]
    able = [number for number in able if way in carried_by(problem.of.rows[number])]
    states = product((True, False), repeat=len(rings)) if len(rings) <= MOST_TRIED else ()
    for state in states:
        holds = [problem.of.rows[number].sign for number, held in zip(rings.values(), state, strict=True) if held]
        if way != 0.0 and not able and way not in holds:
            continue
        problem.held[case, columns] = state
        problem.solve(case, carried)
        if o.status[case.start] == CONVERGED and not _turn(problem, case, np.ones(1, bool), rings)[0]:
            return
    problem.held[case.start] = before
    problem.solve(case, carried)
    if o.status[case.start] == CONVERGED:
        o.status[case.start] = problem.found.results["status"][:, case.start] = NOT_CONVERGED


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


def _turn(problem: Problem, part: slice, which: NDArray, rings: dict[int, int]) -> NDArray:
    """Free and hold what should be in these cases: in which of them something changed, shape (case,)."""
    o, columns = problem.outcome, list(rings)
    held, along = problem.held[part][:, columns], o.axial[list(rings.values()), part].T
    signs = np.array([problem.of.rows[number].sign for number in rings.values()])
    is_open = which & (o.status[part] == CONVERGED)
    passes = is_open[:, None] & ~held & (signs * o.q[part][:, columns] > PASSED)
    pulled = np.where(held, along, 0.0)
    pulls = is_open & ~passes.any(axis=1) & (pulled.min(axis=1) < -o.noise[part])
    turns = passes | (pulls[:, None] & (np.arange(len(columns)) == pulled.argmin(axis=1)[:, None]))
    problem.held[part, columns] = held ^ turns
    return np.asarray(turns.any(axis=1))


def _put_amid(problem: Problem, part: slice, rings: dict[int, int]) -> None:
    """Where no ring is pressed, shaft and rings go along x together and no row feels it, until a ring comes to what
    holds it: to the middle of that way."""
    o, rigid = problem.outcome, problem.structure.rigid
    motion = np.zeros(rigid)
    motion[0] = motion[UNKNOWNS:] = 1.0
    held = problem.held[part, :rigid].copy()
    for column, number in rings.items():  # at what holds it, and not pressed: it may as well draw back
        held[:, column] &= np.abs(o.axial[number, part]) > o.noise[part]
    stays = (held & (motion != 0.0)).any(axis=1) | (o.status[part] != CONVERGED)
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
    amid = np.where(np.isfinite(amid), amid, 0.0)
    o.q[part, :rigid] += amid[:, None] * motion
    o.held[part, :rigid] = problem.held[part, :rigid] = np.where(amid[:, None] != 0.0, held, problem.held[part, :rigid])


def _runs(numbers: NDArray) -> list[slice]:
    """Neighbours together."""
    parts = np.split(numbers, np.flatnonzero(np.diff(numbers) != 1) + 1)
    return [slice(int(each[0]), int(each[-1]) + 1) for each in parts if each.size]
