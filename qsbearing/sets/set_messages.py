"""What there is to say about a set's cases, in sentences: how each ended, which row gives way, what to beware of."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from qsbearing import messages
from qsbearing.case_index import Index
from qsbearing.kernel.admissibility import CONVERGED, NO_EQUILIBRIUM
from qsbearing.ranked_warning import RankedWarning, check_data, in_order, said_of
from qsbearing.scene.operation import CHANNELS
from qsbearing.sets.bearing_set import Row
from qsbearing.status import STATUS_OF_CODE

if TYPE_CHECKING:
    from qsbearing.sets.set_solution import SetSolution

PRELOAD = "sets#preload"

LOST = 0.01
"""A row that carries less than this part of its preload has lost it (chosen: in practice nothing)."""
EXCESSIVE = 3.0
"""A preload is excessive when it is this many times that at rest (chosen: makers' light, medium and heavy preloads are
1 : 3 : 6, as GMN's are: a light one has become a medium one, unasked)."""


class PreloadState(StrEnum):
    """What has become of a row's preload."""

    MAINTAINED = "maintained"
    LOST = "lost"
    """In operation, external loads included, the row carries next to nothing."""
    EXCESSIVE = "excessive"
    """Without external loads the row carries at speed a multiple of what it did at rest."""


def row_name(row: Row, number: int) -> str:
    """A row as sentences name it; rows count from 1."""
    name = f"{row.bearing.name}, " if row.bearing.name else ""
    return f"row {number + 1} ({name}carries {row.carries})"


def message(solution: SetSolution, index: Index = None) -> str:
    """One sentence or two on how a case ended; of several cases without an index, how many ended how."""
    outcome = solution._outcome
    if index is None and solution.shape:
        codes = outcome.status
        counts = [f"{(codes == code).sum()} {word}" for code, word in STATUS_OF_CODE.items() if (codes == code).any()]
        return f"{codes.size} cases: {', '.join(counts)}."
    k = solution._flat_index(index)
    if outcome.status[k] == CONVERGED:
        return (
            f"Shaft and rows are in equilibrium: largest imbalance {outcome.residual[k]:.1e} of the largest force, "
            f"after {outcome.iterations[k]} iterations of the shaft."
        )
    for sign, side in solution._sides.items():
        number = int(np.broadcast_to(np.arange(side._outcome.status.size).reshape(side.shape), solution.shape).flat[k])
        if side._outcome.status[number] != CONVERGED:
            place = tuple(map(int, np.unravel_index(number, side.shape))) if side.shape else None
            which = [n for n, row in enumerate(solution.set.rows) if row.sign == sign]
            names = " and ".join(row_name(solution.set.rows[n], n) for n in which)
            return f"At rest and cold, under the preload alone, {names} cannot carry it. {message(side, place)}"
    return _why(solution, k)


def _why(solution: SetSolution, k: int) -> str:
    outcome = solution._outcome
    names = [*(channel.label for channel in CHANNELS), "axial, of the sprung rings"]
    where = ""
    if 0.0 < outcome.reached[k] < 1.0:
        where = f" Followed from rest, the equilibrium ends at {100.0 * outcome.reached[k]:.3g} % of loads and speeds."
    if outcome.fault[k] >= 0:
        number = int(outcome.fault[k])
        row = solution.rows[number]
        why = messages.message(row, tuple(map(int, np.unravel_index(k, row.shape))) if row.shape else None)
        name = capital(row_name(solution.set.rows[number], number))
        return f"{name} gives way. {why}{_overloaded(solution, k)}{where}"
    if outcome.unsupported[k].any():
        channels = " and ".join(names[i] for i in np.flatnonzero(outcome.unsupported[k]))
        return f"No equilibrium: nothing supports the load in channel {channels}.{_overloaded(solution, k)}{where}"
    kind = "No equilibrium." if outcome.status[k] == NO_EQUILIBRIUM else "Not converged"
    return (
        f"{kind}: the last imbalance was {outcome.residual[k]:.1e} of the largest force after {outcome.iterations[k]} "
        f"iterations. That does not prove that there is no equilibrium.{where}"
    )


def _overloaded(solution: SetSolution, k: int) -> str:
    """What is plainly wrong with the axial load: no row carries in its direction, or it is more than the spring's."""
    load, preload = solution.set.operation.axial_load, solution.set.preload

    def of_case(value: object) -> float:
        return float(np.broadcast_to(np.asarray(value, float), solution.shape).reshape(-1)[k])

    value = 0.0 if load is None else of_case(load)
    direction = "+x" if value > 0.0 else "-x"
    if value != 0.0 and np.sign(value) not in {row.sign for row in solution.set.rows}:
        return f" The axial load acts in {direction}, in which no row carries."
    against = [row for row in solution.set.rows if row.sprung and row.sign * value > 0.0]
    if against and preload is not None and preload.spring is not None and abs(value) > of_case(preload.spring):
        return f" The axial load in {direction} is more than the spring's {of_case(preload.spring):.4g} N."
    return ""


def capital(text: str) -> str:
    """The text as the beginning of a sentence."""
    return text[:1].upper() + text[1:]


def states(solution: SetSolution) -> NDArray | None:
    """`PreloadState` of each row by its word; shape (*cases, row); None without a preload; empty where not solved."""
    at_rest, alone = solution.preload_at_rest, solution.preload_in_operation
    if at_rest is None or alone is None:
        return None
    out = np.full(at_rest.shape, str(PreloadState.MAINTAINED), dtype=f"<U{max(map(len, PreloadState))}")
    with np.errstate(invalid="ignore"):
        pressed = at_rest > 0.0
        out[pressed & (alone > EXCESSIVE * at_rest)] = PreloadState.EXCESSIVE
        out[pressed & (solution.axial_loads < LOST * at_rest)] = PreloadState.LOST
    out[np.isnan(solution.axial_loads) | np.isnan(at_rest)] = ""
    return out


def warnings(solution: SetSolution, index: Index = None) -> list[RankedWarning]:
    """Sentences on what to beware of in a case, its rows' own among them; of several cases, how many have lost their
    preload or have an excessive one, row by row."""
    found = states(solution)
    rows = solution.set.rows
    said: list[RankedWarning] = []
    if index is None and solution.shape:
        for number, row in enumerate(rows) if found is not None else ():
            for state, word in (
                (PreloadState.LOST, "loses its preload"),
                (PreloadState.EXCESSIVE, "has an excessive preload"),
            ):
                count = int((found[..., number] == state).sum())  # type: ignore[index]
                if count:
                    cases = f"{count} of {solution._outcome.status.size} cases"
                    said.append(check_data(f"{cases}: {row_name(row, number)} {word}.", PRELOAD))
        return said
    k = solution._flat_index(index)
    place = tuple(map(int, np.unravel_index(k, solution.shape))) if solution.shape else ()
    if solution._outcome.status[k] != CONVERGED:
        return said
    for number, row in enumerate(rows) if found is not None else ():
        at_rest, alone = solution.preload_at_rest[place][number], solution.preload_in_operation[place][number]  # type: ignore[index]
        if found[place][number] == PreloadState.LOST:  # type: ignore[index]
            left = max(float(solution.axial_loads[place][number]), 0.0)
            lost = f"Preload lost: {row_name(row, number)} carries {left:.4g} N of the {at_rest:.4g} N at rest."
            said.append(check_data(lost, PRELOAD))
        elif found[place][number] == PreloadState.EXCESSIVE:  # type: ignore[index]
            grown = (
                f"Preload excessive: {row_name(row, number)} is pressed by {at_rest:.4g} N at rest and, without "
                f"external loads, by {alone:.4g} N at speed."
            )
            said.append(check_data(grown, PRELOAD))
    for number, row_solution in enumerate(solution.rows):
        name = capital(row_name(rows[number], number))
        said += [said_of(name, each) for each in messages.warnings(row_solution, place or None)]
    return in_order(said)
