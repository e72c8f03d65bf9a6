"""`solve_set`: all cases of a set of rows on one shaft."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.threads import in_threads, thread_count
from qsbearing.model.effects import as_fitted, as_made
from qsbearing.model.operation import STRAIGHT, Operation
from qsbearing.model.scene.scene import CHOICES_OF_CONTACT, Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solver import TOLERANCE, unfound_errors
from qsbearing.model.validation import raise_if_any
from qsbearing.systems.sets import remarks as _remarks  # noqa: F401 - what there is to say of sets
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.drives import with_torques
from qsbearing.systems.sets.elastic_shaft import axial_deflection
from qsbearing.systems.sets.location import opposes
from qsbearing.systems.sets.one_way import settle
from qsbearing.systems.sets.problem import Problem
from qsbearing.systems.sets.row import OUT_OF_LINE
from qsbearing.systems.sets.set_solution import AtRest, SetSolution

if TYPE_CHECKING:
    from qsbearing.systems.heat.hot import Temperatures

Sides = dict[tuple[int, ...], SetSolution]
"""Rows of one direction and group, pressed alone; by their numbers."""


def solve_set(of: BearingSet, *, threads: int | None = None, tolerance: float = TOLERANCE) -> SetSolution:
    """Solve every case of a set.

    Args:
        of: what to solve; its array fields broadcast to the case axes.
        threads: at most this many; None: the environment variable QSBEARING_THREADS, else all cores.
        tolerance: largest imbalance over the largest force at which a case counts as solved. Where rounding forbids
            it, 1e-10 is accepted and `SetSolution.residual` states it.

    Returns:
        SetSolution: raises nothing for a physical outcome; `status` and `message` say what happened and which row
        has no solution.

    Raises:
        ValueError: array fields that do not broadcast, a tolerance or thread count out of range.
    """
    if not 0.0 < tolerance <= 0.1:
        raise ValueError(f"tolerance = {tolerance}: must lie between 0 and 0.1")
    if of.tolerance is not None:
        raise ValueError("the set leaves its effects to be chosen: solve it by `qsbearing.solve_set`")
    if of.thermal is None:
        return solve_at_given_temperatures(of, threads, tolerance)
    from qsbearing.systems.heat.solve import at_steady_temperatures

    preload = 0.0 if of.preload is None else getattr(of.preload, of.preload.kind)
    offsets = [np.asarray(row.offset) + 0.0 * np.asarray(preload) for row in of.rows]
    shape = Problem(of, offsets, tolerance, 1).shape
    machine = HotSet(of, shape, partial(solve_at_given_temperatures, threads=threads, tolerance=tolerance))
    solution: SetSolution = at_steady_temperatures(machine)
    return solution


def solve_at_given_temperatures(of: BearingSet, threads: int | None, tolerance: float) -> SetSolution:
    """Every case of a set, at the temperatures that its rows state."""
    raise_if_any([each for row in of.rows for each in unfound_errors(of.effects_of(row))][:1])
    began = time.perf_counter()
    workers = thread_count(threads)
    sides = _sides(of, threads, tolerance)
    offsets = _offsets(of, sides)
    problem = Problem(of, offsets, tolerance, workers)
    mounted = [np.broadcast_to(side.converged, problem.shape).reshape(-1) for side in sides.values()]
    carried = np.logical_and.reduce(mounted) if mounted else np.ones(problem.count, bool)

    in_threads(lambda part: settle(problem, part, carried), problem.count, workers)

    unloaded = partial(_unloaded, of, offsets, threads, tolerance)
    seconds = time.perf_counter() - began
    again = partial(solve_at_given_temperatures, threads=threads, tolerance=tolerance)
    return SetSolution(
        of, problem.shape, problem.row_solution, problem.structure, problem.outcome, sides, unloaded, seconds, again
    )


def _unloaded(
    of: BearingSet, offsets: list[NDArray], threads: int | None, tolerance: float, effects_at_rest: AtRest | None
) -> SetSolution:
    """Not a closure: with a result, it is pickled."""
    return solve_at_given_temperatures(without_load(of, offsets, effects_at_rest), threads, tolerance)


def without_load(of: BearingSet, offsets: list[NDArray], effects_at_rest: AtRest | None) -> BearingSet:
    """The set under its preload alone, straight and centred.

    Args:
        effects_at_rest: `as_made` or `as_fitted`, for the set at rest and cold; None: in operation.
    """
    rows = tuple(
        replace(row, offset=np.nan_to_num(offset)[()], readings=None, is_from_contact=not both)
        for row, offset, both in zip(of.rows, offsets, of.is_two_sided, strict=True)
    )
    preload = of.preload if of.preload is not None and of.preload.kind == "spring" else None
    shaft = None if of.shaft is None else replace(of.shaft, loads=(), gears=(), belts=(), gravity=None)
    around: dict[str, Any] = {"shaft": shaft, "floating": tuple(replace(each, preload=None) for each in of.floating)}
    if effects_at_rest is None:
        return replace(of, rows=rows, preload=preload, operation=of.operation.unloaded, readings={}, **around)
    around["shaft"] = None if shaft is None else replace(shaft, temperature=None)
    around["spacers"] = tuple(replace(each, inner_temperature=None, outer_temperature=None) for each in of.spacers)
    cold = tuple(replace(row, ring_effects=effects_at_rest(of.effects_of(row))) for row in rows)
    choices = {name: getattr(of, name) for name in CHOICES_OF_CONTACT}
    return BearingSet(cold, Operation(**STRAIGHT), preload, of.reference_position, **choices, **around)


def _sides(of: BearingSet, threads: int | None, tolerance: float) -> Sides:
    """Under a preload that is held and given as a force: of each group, the rows of either direction alone, at rest and
    cold, without their offsets, which add to what it takes."""
    sides: Sides = {}
    known: dict[tuple[int, ...], SetSolution] = {}
    choices = {name: getattr(of, name) for name in CHOICES_OF_CONTACT}
    for group, preload in of.groups:
        if preload is None or preload.kind not in ("rigid", "mounted") or not opposes(of, group):
            continue
        force = np.asarray(getattr(preload, preload.kind), float)
        effects_at_rest = as_fitted if preload.is_given_mounted else as_made
        for sign in (1.0, -1.0):
            numbers = tuple(n for n in group if of.rows[n].sign == sign and not of.is_two_sided[n])
            alike = (id(preload), *(of.alike[number] for number in numbers))
            if alike in known and np.all(known[alike].converged):
                sides[numbers] = known[alike]
                continue
            bare: dict[str, Any] = {"offset": 0.0, "housing_stiffness": None, "readings": None}
            bare["is_from_contact"] = True
            bare |= {name: None for name, *_ in OUT_OF_LINE}
            rows = tuple(
                replace(row, ring_effects=effects_at_rest(of.effects_of(row)), **bare)
                for row in (of.rows[number] for number in numbers)
            )
            side = BearingSet(rows, Operation(axial_load=(sign * force)[()], **STRAIGHT), **choices)
            sides[numbers] = known[alike] = solve_at_given_temperatures(side, threads, tolerance)
    return sides


def _offsets(of: BearingSet, sides: Sides) -> list[NDArray]:
    """How far each row is pressed together while the shaft is at its zero [m]; NaN where its side is not solved."""
    pressed: list[Any] = [0.0] * len(of.rows)
    for numbers, side in sides.items():
        for number in numbers:
            pressed[number] = side.set.rows[0].sign * side.displacement[..., 0]
    for group, preload in of.groups:
        if preload is not None and preload.kind == "axial_displacement" and opposes(of, group):
            for number in group:
                if not of.is_two_sided[number]:
                    pressed[number] = 0.5 * np.asarray(preload.axial_displacement, float)
    deflections = _deflections(of, sides)
    return [
        np.asarray(row.offset, float) + by + deflection
        for row, by, deflection in zip(of.rows, pressed, deflections, strict=True)
    ]


def _deflections(of: BearingSet, sides: Sides) -> list[Any]:
    """By how much further each row is pressed for what shaft and housings deflect under the preload [m]."""
    if not sides or (of.shaft is None and all(row.housing_stiffness is None for row in of.rows)):
        return [0.0] * len(of.rows)
    effects_at_rest = as_fitted if of.preload is not None and of.preload.is_given_mounted else as_made
    cold = without_load(of, [np.zeros(())] * len(of.rows), effects_at_rest)
    loads: list[Any] = [0.0] * len(of.rows)
    for numbers, side in sides.items():
        for number, load in zip(numbers, np.moveaxis(side.axial_loads, -1, 0), strict=True):
            loads[number] = load
    return axial_deflection(cold, loads)


class HotSet:
    """As `qsbearing.systems.heat.hot.HotSystem` asks it."""

    def __init__(self, of: BearingSet, shape: tuple[int, ...], solve: Callable[[BearingSet], SetSolution]) -> None:
        assert of.thermal is not None
        self.of, self.shape, self._solve = of, shape, solve
        self.thermal, self.operation = of.thermal, of.operation
        self.scenes: Sequence[Scene] = tuple(map(of.turning_scene, range(len(of.rows))))
        self.readings: Sequence[Mapping[str, Any]] = tuple(
            of.readings if row.readings is None else row.readings for row in of.rows
        )

    def alike(self, of: BearingSet) -> HotSet:
        """Another set of the same cases, solved in the same way."""
        return HotSet(of, self.shape, self._solve)

    def solve(self, temperatures: Temperatures, factor: NDArray) -> SetSolution:
        """The set's solution at these temperatures of its nodes."""
        from qsbearing.systems.heat.hot import (  # not above: it loads every reading, and scipy with them
            at_speed,
            hot_row,
        )

        bodies = {name: getattr(self.of, name) for name in ("shaft", "housing")}
        bodies = {
            name: replace(body, temperature=temperatures[name])
            for name, body in bodies.items()
            if body is not None and name in temperatures and getattr(body, "sections", True)  # a rigid shaft has none
        }
        own = {name: value for name, value in temperatures.items() if name not in bodies}  # rows take theirs from these
        rows = []
        for number, row in enumerate(self.of.rows):
            effects = self.of.ring_effects if row.ring_effects is None else row.ring_effects
            given = effects, self.readings[number], self.thermal, own
            effects, readings = hot_row(*given, number, len(self.of.rows))
            rows.append(replace(row, ring_effects=effects, readings=readings))
        operation = at_speed(self.operation, factor)
        bodies["shaft"] = with_torques(bodies.get("shaft", self.of.shaft), self.operation.speed)
        return self._solve(replace(self.of, rows=tuple(rows), operation=operation, thermal=None, **bodies))

    def rows(self, solution: SetSolution) -> Sequence[Solution]:
        """Each row's own."""
        return solution.rows

    def preloads(self, solution: SetSolution) -> NDArray:
        """The axial load of each row; shape (row, *cases)."""
        return np.moveaxis(solution.axial_loads, -1, 0)
