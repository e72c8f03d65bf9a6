"""Messages and remarks of a set's cases: how each ended, which row has no equilibrium, what to beware of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.case_index import Index
from qsbearing.model.solution.preload_state import PreloadLoads
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.status import Status
from qsbearing.remarks import bearing
from qsbearing.remarks.missing_effects import missing_effects
from qsbearing.remarks.preload import not_grown, of_loads
from qsbearing.remarks.remark import Found, Remark, in_case, in_order, of_row, remark, row_name
from qsbearing.remarks.wording import capital
from qsbearing.systems.sets.set_solution import SetSolution


def message(solution: SetSolution, index: Index = None) -> str:
    """One sentence or two on how a case ended; of several cases without an index, how many ended how."""
    outcome = solution.outcome
    if index is None and solution.shape:
        found = np.ravel(solution.status)
        counts = [f"{(found == status).sum()} {status}" for status in Status if (found == status).any()]
        return f"{found.size} cases: {', '.join(counts)}."
    k = solution.flat_index(index)
    if solution.thermal is not None and solution.thermal.without_steady_state.flat[k]:
        return solution.thermal.message(index)
    if np.ravel(solution.converged)[k]:
        return (
            f"Shaft and rows are in equilibrium: largest imbalance {outcome.residual[k]:.1e} of the largest force, "
            f"after {outcome.iterations[k]} iterations of the shaft."
        )
    for which, side in solution.sides.items():
        number = int(np.broadcast_to(np.arange(side.outcome.status.size).reshape(side.shape), solution.shape).flat[k])
        if not np.ravel(side.converged)[number]:
            place = tuple(map(int, np.unravel_index(number, side.shape))) if side.shape else None
            names = " and ".join(row_name(solution.set.rows[n], n) for n in which)
            return f"At rest and cold, {names} cannot carry the preload. {message(side, place)}"
    return _why(solution, k)


def _why(solution: SetSolution, k: int) -> str:
    outcome = solution.outcome
    names = [*(channel.label for channel in CHANNELS), "axial of the sprung rings"]
    names += [f"axial of floating group {n}" for n in range(1, len(solution.set.floating) + 1)]
    where = ""
    if 0.0 < outcome.reached[k] < 1.0:
        reached = f"{100.0 * outcome.reached[k]:.3g} %"
        where = f" Followed from rest, the equilibrium exists up to {reached} of the loads and speeds."
    if outcome.fault[k] >= 0:
        number = int(outcome.fault[k])
        row = solution.rows[number]
        why = bearing.message(row, tuple(map(int, np.unravel_index(k, row.shape))) if row.shape else None)
        name = capital(row_name(solution.set.rows[number], number))
        return f"{name} has no solution. {why}{_overloaded(solution, k)}{where}"
    if outcome.unsupported[k][: len(names)].any():
        channels = " and ".join(names[i] for i in np.flatnonzero(outcome.unsupported[k][: len(names)]))
        return f"No equilibrium: nothing supports the load in channel {channels}.{_overloaded(solution, k)}{where}"
    last = f"the last imbalance was {outcome.residual[k]:.1e} of the largest force"
    after = f"{last} after {outcome.iterations[k]} iterations."
    if np.ravel(solution.status)[k] == Status.NO_EQUILIBRIUM:
        return f"No equilibrium: {after}{where}"
    return f"Not converged: {after} This does not prove that there is no equilibrium.{where}"


def _overloaded(solution: SetSolution, k: int) -> str:
    """What is plainly wrong with the axial load: no row carries in its direction, or those that do are on springs."""
    load, preload = solution.set.operation.axial_load, solution.set.preload

    def of_case(value: object) -> float:
        return float(np.broadcast_to(np.asarray(value, float), solution.shape).reshape(-1)[k])

    value = 0.0 if load is None else of_case(load)
    direction = "+x" if value > 0.0 else "-x"
    if value != 0.0 and np.sign(value) not in {row.sign for row in solution.set.rows}:
        return f" The axial load acts in {direction}, which no row carries."
    against = [row for row in solution.set.rows if row.sprung and row.sign * value > 0.0]
    if against and preload is not None and preload.spring is not None and abs(value) > of_case(preload.spring):
        return f" The axial load in {direction} is more than the spring's {of_case(preload.spring):.4g} N."
    floating = {number - 1 for group in solution.set.floating for number in group.rows}
    if value != 0.0 and floating.issuperset(n for n, row in enumerate(solution.set.rows) if row.sign * value > 0.0):
        return f" All rows that carry in {direction} float, and their springs give no more than their own force."
    return ""


def with_rows(solution: SetSolution, of_rows: Sequence[Sequence[Remark]], index: Index = None) -> list[Remark]:
    """What there is to say of a set and of each row; nothing of a case that is not solved."""
    said = in_case(solution, of_set, index)
    if not np.any(solution.converged if index is None else np.ravel(solution.converged)[solution.flat_index(index)]):
        return []
    return in_order(said + [of_the_row(solution, n, each) for n, of_row in enumerate(of_rows) for each in of_row])


def of_the_row(solution: SetSolution, number: int, said: Remark) -> Remark:
    """What a row's own solution or reading says, with its row."""
    row = of_row(solution.set.rows[number], number)
    return replace(said, of=replace(said.of, rows=row.rows, bearing=row.bearing, carries=row.carries))


def of_set(solution: SetSolution, part: slice, may_solve: bool = True) -> Iterator[Found]:
    """What is not its rows' own, of a stretch of cases: preloads, no stiffness, effects that the set lacks, solved with
    all rows together: what one changes of a row moves the shaft.

    Args:
        may_solve: whether cases may be solved again, differently, to tell; else what takes that is left out.
    """
    loads = None
    if solution.set.is_opposed:
        given = solution.preload_given
        loads = solution.preload_loads if may_solve else not_grown(given, solution.axial_loads)
    for number in range(len(solution.rows) if loads is not None else 0):
        for where, make in _preload(solution, loads, number, part):
            yield where, partial(_of_preload, solution, number, make)
    yield ~np.reshape(solution.control_is_consistent, -1)[part], remark("stiffness_undetermined")
    yield from missing_effects(solution, part, may_solve)


def _of_preload(solution: SetSolution, number: int, make: Any, i: int) -> Remark:
    return of_the_row(solution, number, make(i))


def _preload(solution: SetSolution, of: Any, number: int, part: slice) -> Iterator[Found]:
    """What to beware of in the preload of a row."""

    def cases(values: Any) -> NDArray:
        return np.asarray(values)[..., number].reshape(-1)[part]

    def axial(row: Solution) -> NDArray:
        return np.broadcast_to(row.stiffness[..., 0, 0], solution.shape).reshape(-1)[part]

    state = "before fitting" if solution.set.preload is None else solution.set.preload.state
    yield from of_loads(
        PreloadLoads(*map(cases, of)),
        state,
        lambda: (axial(solution.mounted.rows[number]), axial(solution.rows[number])),  # type: ignore[union-attr]
        lambda: (cases(solution.preload_unmounted), cases(solution.preload_mounted)),
    )
