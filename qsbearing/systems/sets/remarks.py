"""Messages and remarks of a set's cases: how each ended, which row has no equilibrium, what to beware of.

They are registered with those of bearings when a set is first solved (`qsbearing.remarks.of_solution`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.numbers import plain
from qsbearing.model.bearing import BearingKind
from qsbearing.model.material import Material
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.case_index import Index
from qsbearing.model.solution.preload_state import PreloadLoads
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.status import Status
from qsbearing.model.units import um
from qsbearing.remarks.case_range import CaseRange, Subject, in_case
from qsbearing.remarks.expansion import far_from_room_temperature
from qsbearing.remarks.hypotheses import hypotheses
from qsbearing.remarks.kinds import CHECK, NOTE, SEE_HYPOTHESES, WRONG, Kind
from qsbearing.remarks.missing_effects import missing_effects
from qsbearing.remarks.of_solution import ended, every_remark, holding
from qsbearing.remarks.preload import not_grown, of_loads
from qsbearing.remarks.remark import Holding, Remark, in_order, of_row, remark, row_name
from qsbearing.remarks.wording import Audience, Words, capital
from qsbearing.systems.sets.axial_growth import SIDES
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.drives import torque_scale
from qsbearing.systems.sets.location import carried, sliding
from qsbearing.systems.sets.set_solution import SetSolution, ends_of

NOTICEABLE = 1e-3
"""Of the largest force on a row, or torque on the shaft: what rows press each other with below it, or torques leave,
changes no digit that matters."""


@ended.register
def _(solution: SetSolution, index: Index = None) -> str:
    """In a sentence or two."""
    outcome, sides = ends_of(solution)
    if index is None and solution.shape:
        how = np.ravel(solution.status)
        counts = [f"{(how == status).sum()} {status}" for status in Status if (how == status).any()]
        return f"{how.size} cases: {', '.join(counts)}."
    k = solution.flat_index(index)
    if np.ravel(solution.converged)[k]:
        return (
            f"Shaft and rows are in equilibrium: largest imbalance {outcome.residual[k]:.1e} of the largest force, "
            f"after {outcome.iterations[k]} iterations of the shaft."
        )
    for which, side in sides.items():
        number = int(np.broadcast_to(np.arange(side.codes.size).reshape(side.shape), solution.shape).flat[k])
        if not np.ravel(side.converged)[number]:
            place = tuple(map(int, np.unravel_index(number, side.shape))) if side.shape else None
            names = " and ".join(row_name(solution.set.rows[n], n) for n in which)
            return f"At rest and cold, {names} cannot carry the preload. {ended(side, place)}"
    return _why(solution, k)


def _why(solution: SetSolution, k: int) -> str:
    outcome, _ = ends_of(solution)
    names = [*(channel.label for channel in CHANNELS), "axial of the sprung rings"]
    names += [f"axial of floating group {n}" for n in range(1, len(solution.set.floating) + 1)]
    names += [f"axial of the outer ring of row {number + 1}" for number in sliding(solution.set)]
    where = ""
    if 0.0 < outcome.reached[k] < 1.0:
        reached = f"{plain(100.0 * outcome.reached[k], '.3g')} %"
        where = f" Followed from rest, the equilibrium exists up to {reached} of the loads and speeds."
    if outcome.fault[k] >= 0:
        number = int(outcome.fault[k])
        row = solution.rows[number]
        why = ended(row, tuple(map(int, np.unravel_index(k, row.shape))) if row.shape else None)
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
    ways = {n: carried(row) for n, row in enumerate(solution.set.rows)}
    if value != 0.0 and not any(np.sign(value) in each for each in ways.values()):
        return f" The axial load acts in {direction}, which no row carries."
    against = [row for row in solution.set.rows if row.sprung and row.sign * value > 0.0]
    if against and preload is not None and preload.spring is not None and abs(value) > of_case(preload.spring):
        return f" The axial load in {direction} is more than the spring's {of_case(preload.spring):.4g} N."
    floating = {number - 1 for group in solution.set.floating for number in group.rows}
    if value != 0.0 and floating.issuperset(n for n, each in ways.items() if np.sign(value) in each):
        return f" All rows that carry in {direction} float, and their springs give no more than their own force."
    return ""


@every_remark.register
def _(solution: SetSolution, readings: Sequence, index: Index = None) -> list[Remark]:
    rows = [every_remark(row, own, index) for row, own in zip(solution.rows, readings, strict=True)]
    return with_rows(solution, rows, index)


@holding.register
def _(solution: SetSolution, readings: Sequence, part: slice, may_solve: bool) -> Iterator[Holding]:
    yield from SUBJECTS(CaseRange(solution, part, may_solve))
    for number, (row, own) in enumerate(zip(solution.rows, readings, strict=True)):
        for where, make in holding(row, own, part, may_solve):
            yield where, partial(of_the_row, solution, number, make)


def with_rows(solution: SetSolution, of_rows: Sequence[Sequence[Remark]], index: Index = None) -> list[Remark]:
    """What there is to say of a set and of each row; nothing of a case that is not solved."""
    said = in_case(solution, SUBJECTS, index)
    if not np.any(solution.converged if index is None else np.ravel(solution.converged)[solution.flat_index(index)]):
        return []
    return in_order(said + [of_the_row(solution, n, each) for n, of_row in enumerate(of_rows) for each in of_row])


def of_the_row(solution: SetSolution, number: int, make: Remark | Callable[[int], Remark], i: int = 0) -> Remark:
    """What a row's own solution or reading says, of the i-th case, with its row."""
    said = make if isinstance(make, Remark) else make(i)
    row = of_row(solution.set.rows[number], number)
    return replace(said, of=replace(said.of, rows=row.rows, bearing=row.bearing, carries=row.carries))


SUBJECTS = Subject()
"""What is not its rows' own: preloads, no stiffness, effects that the set lacks and hypotheses, solved with all rows
together: what one changes of a row moves the shaft."""


@SUBJECTS.tells
def _preloads(of: CaseRange) -> Iterator[Holding]:
    solution = of.solution
    if not solution.set.is_opposed:
        return
    at_rest = not_grown(solution.preload_given, solution.axial_loads, solution.rounding[..., None])
    loads = solution.preload_loads if of.may_solve else at_rest
    for number in range(len(solution.rows) if loads is not None else 0):
        for where, make in _preload(of, loads, number):
            yield where, partial(of_the_row, solution, number, make)


def _bodies(of: BearingSet) -> Iterator[tuple[str, Any, Material]]:
    """What grows beside the rows themselves: shaft, housing and spacers with temperatures of their own."""
    if of.shaft is not None and of.shaft.temperature is not None:
        yield from (("shaft", of.shaft.temperature, each.material) for each in of.shaft.sections)
    if of.housing is not None and of.housing.temperature is not None:
        yield "housing", of.housing.temperature, of.housing.material
    for number, spacer in enumerate(of.spacers, 1):
        for side in SIDES:
            warm = getattr(spacer, f"{side}_temperature")
            if warm is not None:
                yield f"{side} sleeve of spacer {number}", warm, getattr(spacer, f"{side}_material")


def _pressing(fields: Mapping[str, Any], words: Words) -> str:
    """Rows that press each other, and what to write so that one of them slides."""
    written = {Audience.PYTHON: ': carries="none"', Audience.FILE: ': carries = "none"'}
    return f"{ROWS_PRESS.sentence.format_map(fields)}{written.get(words.reader, '')}."


ROWS_PRESS = Kind(
    "rows_press", CHECK, "locating",
    "The rows press each other axially with {pressed_N:.4g} N, which no load and no preload asks for: the outer "
    "ring of each is held on the side to which it is pushed. Let row {slides} slide",
    say=_pressing,
    setting="rows.{slides:.0f}.carries=none",
)  # fmt: skip


@SUBJECTS.tells
def _pressing_rows(cases: CaseRange) -> Iterator[Holding]:
    """Deep-groove rows that others of their housing or sleeve press without having been told to; all are held there."""
    solution, part, of = cases.solution, cases.part, cases.solution.set
    signs = np.array([row.sign for row in of.rows])
    along = (solution.axial_loads.reshape(-1, len(of.rows))[part] * signs).T
    least = np.maximum(NOTICEABLE * ends_of(solution)[0].largest, np.reshape(solution.rounding, -1))[part]
    deep = np.array([row.bearing.kind is BearingKind.DEEP_GROOVE for row in of.rows])
    for group, preload in of.groups:
        meant = [of.rows[n].sprung or np.any(of.rows[n].offset) for n in group]
        if preload is not None or of.spacers or any(meant) or not deep[list(group)].any():
            continue
        own = np.isin(np.arange(len(of.rows)), group)[:, None]
        for way in (1.0, -1.0):
            pushed, against = (np.where(own, np.maximum(each * along, 0.0), 0.0) for each in (way, -way))
            pushed = np.where(deep[:, None], pushed, 0.0)
            pressed = np.minimum(pushed.sum(axis=0), against.sum(axis=0))
            # Where deep-groove rows are on both sides, once.
            once = way > 0.0 or (pressed > np.where(deep[:, None], against, 0.0).sum(axis=0))

            def make(i: int, both: NDArray = pushed + against, pressed: NDArray = pressed) -> Remark:
                rows = np.flatnonzero(both[:, i] > least[i])
                said = remark(ROWS_PRESS, pressed_N=pressed[i], slides=int(rows[deep[rows]][-1]) + 1)
                return replace(said, of=replace(said.of, rows=tuple(int(n) + 1 for n in rows)))

            yield once & (pressed > least), make


AXIALLY_FREE = Kind(
    "axially_free", CHECK, "locating",
    "Nothing holds the shaft along x where it is.",
    " It lies amid its play of {play_um:.4g} µm.",
)  # fmt: skip


@SUBJECTS.tells
def _free_shaft(of: CaseRange) -> Iterator[Holding]:
    """A shaft that nothing holds along x where it is."""
    play = of.solution.axial_play
    if play is None:
        return
    width = of.cases(np.diff(play, axis=-1)[..., 0] / um)

    def make(i: int) -> Remark:
        return remark(AXIALLY_FREE, play_um=float(width[i])) if np.isfinite(width[i]) else remark(AXIALLY_FREE)

    yield of.cases(of.solution.is_axially_free, bool), make


TORQUES_DIFFER = Kind(
    "torques_differ", NOTE, "gears",
    "The torques of gears and belts do not cancel: {sum_Nm:.4g} N m about +x are left for a motor or a coupling, "
    "which is taken to load no bearing.",
)  # fmt: skip


@SUBJECTS.tells
def _torques(of: CaseRange) -> Iterator[Holding]:
    """Gears and belts whose torques leave a rest, more than rounding of what a file states (chosen: 0.1 %)."""
    solution, shaft = of.solution, of.solution.set.shaft
    if solution.torque_sum is None or shaft is None:
        return
    left = of.cases(solution.torque_sum)
    largest = of.cases(torque_scale(shaft, solution.set.operation.speed))
    yield np.abs(left) > NOTICEABLE * largest, lambda i: remark(TORQUES_DIFFER, sum_Nm=left[i])


STIFFNESS_UNDETERMINED = Kind(
    "stiffness_undetermined", WRONG, SEE_HYPOTHESES,
    "No stiffness: in a row, no raceway control is consistent, and several solutions exist.",
)  # fmt: skip


@SUBJECTS.tells
def _of_model(of: CaseRange) -> Iterator[Holding]:
    yield ~of.cases(of.solution.control_is_consistent, bool), remark(STIFFNESS_UNDETERMINED)
    yield from missing_effects(of)
    yield from far_from_room_temperature(of, _bodies(of.solution.set))
    yield from hypotheses(of)


def _preload(of: CaseRange, loads: Any, number: int) -> Iterator[Holding]:
    """What to beware of in the preload of a row."""
    solution = of.solution

    def of_row(values: Any) -> NDArray:
        return of.cases(np.asarray(values)[..., number])

    def axial(row: Solution) -> NDArray:
        return of.cases(row.stiffness[..., 0, 0])

    yield from of_loads(
        PreloadLoads(*map(of_row, loads)),
        "before fitting" if solution.set.preload is None else solution.set.preload.state,
        lambda: (axial(solution.mounted.rows[number]), axial(solution.rows[number])),
        lambda: (of_row(solution.preload_unmounted), of_row(solution.preload_mounted)),
    )
