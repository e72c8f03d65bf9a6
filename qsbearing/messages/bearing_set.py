"""Messages and warnings of a set's cases: how each ended, which row has no equilibrium, what to beware of."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from qsbearing.messages import bearing
from qsbearing.messages.equal_warnings import together
from qsbearing.messages.missing_effects import incomplete_warnings
from qsbearing.messages.preload import excessive, lost, reduced
from qsbearing.model.kernel.admissibility import CONVERGED, NO_EQUILIBRIUM
from qsbearing.model.operation import CHANNELS
from qsbearing.model.ranked_warning import RankedWarning, capital, check_data, in_order, ranked, said_of, wrong_model
from qsbearing.model.solution import preload_state
from qsbearing.model.solution.case_index import Index
from qsbearing.model.solution.preload_state import PreloadLoads, PreloadState
from qsbearing.model.solution.status import STATUS_OF_CODE
from qsbearing.systems.sets.bearing_set import row_name
from qsbearing.systems.sets.set_solution import SetSolution


def message(solution: SetSolution, index: Index = None) -> str:
    """One sentence or two on how a case ended; of several cases without an index, how many ended how."""
    outcome = solution._outcome
    if index is None and solution.shape:
        codes = outcome.status
        counts = [f"{(codes == code).sum()} {word}" for code, word in STATUS_OF_CODE.items() if (codes == code).any()]
        return f"{codes.size} cases: {', '.join(counts)}."
    k = solution._flat_index(index)
    if solution.thermal is not None and solution.thermal.without_steady_state.flat[k]:
        return solution.thermal.message(index)
    if outcome.status[k] == CONVERGED:
        return (
            f"Shaft and rows are in equilibrium: largest imbalance {outcome.residual[k]:.1e} of the largest force, "
            f"after {outcome.iterations[k]} iterations of the shaft."
        )
    for which, side in solution._sides.items():
        number = int(np.broadcast_to(np.arange(side._outcome.status.size).reshape(side.shape), solution.shape).flat[k])
        if side._outcome.status[number] != CONVERGED:
            place = tuple(map(int, np.unravel_index(number, side.shape))) if side.shape else None
            names = " and ".join(row_name(solution.set.rows[n], n) for n in which)
            return f"At rest and cold, {names} cannot carry the preload. {message(side, place)}"
    return _why(solution, k)


def _why(solution: SetSolution, k: int) -> str:
    outcome = solution._outcome
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
    if outcome.status[k] == NO_EQUILIBRIUM:
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


def warnings(solution: SetSolution, index: Index = None) -> list[RankedWarning]:
    """Sentences on what to beware of in a case, its rows' own among them; of several cases, how many have lost their
    preload or have an excessive one, row by row."""
    if index is None and solution.shape:
        of = solution.preload_loads
        return [] if of is None else _counted(solution, of)
    k = solution._flat_index(index)
    place = tuple(map(int, np.unravel_index(k, solution.shape))) if solution.shape else ()
    if solution._outcome.status[k] != CONVERGED:
        return []
    said = warnings_of_set(solution, place)
    for number, row_solution in enumerate(solution.rows):
        name = capital(row_name(solution.set.rows[number], number))
        said += [said_of(name, each) for each in bearing.warnings(row_solution, place or None)]
    return in_order(said)


def warnings_by_rows(
    solution: SetSolution, place: tuple[int, ...] = (), readings: Sequence[Sequence[str]] = ()
) -> list[RankedWarning]:
    """Those of a case for people: what several rows have is said once, with the range of its numbers.

    Args:
        place: of the case along the case axes; none of a single case.
        readings: what the readings of each row add.
    """
    if solution._outcome.status[solution._flat_index(place or None)] != CONVERGED:
        return []
    numbers = range(len(solution.rows))
    names = {number + 1: row_name(solution.set.rows[number], number) for number in numbers}
    of_rows: dict[int, list[str]] = {number + 1: [] for number in numbers}
    for number, row in enumerate(solution.rows):
        if solution.preload_loads is not None:
            of_rows[number + 1] += _preload(solution, solution.preload_loads, place, number)
        of_rows[number + 1] += [*bearing.warnings(row, place or None), *(readings[number] if readings else ())]
    of_set = [*_without_stiffness(solution, place), *_incomplete(solution, place)]
    return in_order([*of_set, *together("row", of_rows, names)])


def warnings_of_set(solution: SetSolution, place: tuple[int, ...] = ()) -> list[RankedWarning]:
    """Those of a converged case that are not its rows' own: preload lost or excessive, no stiffness."""
    of, said = solution.preload_loads, list[RankedWarning]()
    if of is not None:
        said = [each for number in range(len(solution.rows)) for each in _preload(solution, of, place, number)]
    return said + _without_stiffness(solution, place) + _incomplete(solution, place)


def _without_stiffness(solution: SetSolution, place: tuple[int, ...]) -> list[RankedWarning]:
    if solution.control_is_consistent[place]:
        return []
    what = "No stiffness: in a row, no raceway control is consistent, and several solutions exist."
    return [wrong_model(what, "limits#hypotheses")]


def _incomplete(solution: SetSolution, place: tuple[int, ...]) -> list[RankedWarning]:
    """Effects that the set lacks, solved with all rows together: what one changes of a row moves the shaft."""
    k = solution._flat_index(place or None)
    return [ranked(sentence(0)) for matters, sentence in incomplete_warnings(solution, slice(k, k + 1)) if matters[0]]


def _counted(solution: SetSolution, of: PreloadLoads) -> list[RankedWarning]:
    """In how many cases each row has not kept its preload."""
    kinds = (
        (preload_state.states(of) == PreloadState.LOST, "loses its preload"),
        (preload_state.is_reduced(of), "carries less than half of its preload"),
        (preload_state.states(of) == PreloadState.EXCESSIVE, "has an excessive preload"),
    )
    cases = solution._outcome.status.size
    return [
        check_data(f"{which[..., number].sum()} of {cases} cases: {row_name(row, number)} {word}.", "sets#preload")
        for number, row in enumerate(solution.set.rows)
        for which, word in kinds
        if which[..., number].any()
    ]


def _preload(solution: SetSolution, of: PreloadLoads, place: tuple[int, ...], number: int) -> list[RankedWarning]:
    """What to beware of in the preload of a row of a case."""
    at = (*place, number)
    own = PreloadLoads(*(float(each[at]) for each in of))
    who, word = row_name(solution.set.rows[number], number), preload_state.states(own)
    state = "before fitting" if solution.set.preload is None else solution.set.preload.state
    if word == PreloadState.LOST:
        return [lost(who, own, state)]
    if word == PreloadState.EXCESSIVE:
        before, after = solution.preload_unmounted[at], solution.preload_mounted[at]  # type: ignore[index]
        return [excessive(who, own, before, after)]
    if preload_state.is_reduced(own):
        mounted = np.broadcast_to(solution.mounted.rows[number].stiffness, (*solution.shape, 5, 5))  # type: ignore[union-attr]
        now = solution.rows[number].stiffness
        return [reduced(who, own, state, mounted[(*place, 0, 0)], now[(*place, 0, 0)])]
    return []
