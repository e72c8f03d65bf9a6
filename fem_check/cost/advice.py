"""The cheapest mesh for an accuracy: chosen by the cost record, its time scaled to this machine.

The record holds, for each mesh and shape of contact, the worst error over all ways to space 2, 4 or 8 positions of the
contact's edge evenly in an element. Load and materials do not enter it: contacts of one shape are similar at every
load, and Poisson's ratios from 0.2 to 0.45 move the error by less than two per cent of itself. Two coarser meshes are
solved besides, for the uncertainty of the result; their time counts too.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np

from fem_check import half_space_contact, meshing
from fem_check.contact_problem import ContactProblem
from fem_check.cost import record
from fem_check.cost.configurations import JUDGED
from fem_check.elastic_body import Progress
from fem_check.references import axis_ratio

MARGIN = 1.1
"""On the errors of the record: between its shapes they change smoothly, with the materials by two per cent."""
MEMORY_MARGIN = 1.35
"""The meshes solved before the finest leave some memory in use."""
POSITION_COUNTS = (2, 4, 8)
"""One position of the edge gives no estimate of its scatter, so it is not offered."""
SEQUENCES = {5: (3, 4, 5), 6: (4, 5, 6), 8: (4, 6, 8), 10: (6, 8, 10), 12: (6, 8, 12), 16: (8, 12, 16)}
"""Meshes solved for a result and its uncertainty, by elements per semi-axis of the finest."""


class AdviceError(Exception):
    """No measured mesh meets the accuracy here; the message states the best attainable."""


@dataclass(frozen=True)
class MeshChoice:
    """A mesh and number of edge positions, with error, time and memory from the record."""

    elements: int
    positions: int
    sequence: tuple[int, ...]
    """Meshes to solve, coarse to fine, the last of `elements`."""
    error: float
    """Worst relative error to expect of approach, semi-axes, pressure and shear."""
    seconds: float
    """On the machine of the record, all meshes."""
    coarsest_seconds: float
    """The part of it that the coarsest mesh takes."""
    memory_MB: float


@dataclass(frozen=True)
class Expected:
    """What the run will take on this machine."""

    seconds: float
    memory_MB: float
    machine_factor: float
    """Time on this machine over that on the record's machine, for the coarsest mesh."""


def table() -> dict[str, Any]:
    """The cost record in use."""
    found = record.read()
    if found is None:
        raise AdviceError(f"there is no cost record in {record.FOLDER}: run `fem-check cost` first")
    return found


def choose(
    problem: ContactProblem, accuracy: float, table: dict[str, Any], solver: str, free_MB: float | None
) -> MeshChoice:
    """The choice expected to be quickest among those that are accurate enough and available here.

    Args:
        accuracy: largest relative error wanted.
        table: a cost record.
        solver: key of the linear solver that will be used.
        free_MB: available memory; None: unknown, taken as enough.

    Raises:
        AdviceError: none is; the message states the best attainable.
    """
    every = choices(problem, table, solver)
    obstacles = {choice.elements: _obstacle(choice, free_MB) for choice in every}
    here = [choice for choice in every if obstacles[choice.elements] is None]
    good = [choice for choice in here if choice.error <= accuracy]
    if good:
        return min(good, key=lambda choice: (choice.seconds, choice.error))
    best = min(here, key=lambda choice: choice.error, default=None)
    could = [choice for choice in every if choice.error <= accuracy]
    if could:
        first = min(could, key=lambda choice: choice.seconds)
        reason = f"takes {first.elements} elements per semi-axis, and {obstacles[first.elements]}"
    else:
        finest = min(every, key=lambda choice: choice.error)
        reason = f"is beyond the finest mesh measured, {finest.elements} elements per semi-axis"
    attainable = (
        f"the best attainable here is {best.error:.1e}, with {best.elements} elements per semi-axis"
        if best
        else "no measured mesh is available here"
    )
    raise AdviceError(f"an accuracy of {accuracy:.3g} {reason}; {attainable}")


def choices(problem: ContactProblem, table: dict[str, Any], solver: str) -> list[MeshChoice]:
    """All that the record has measured, for a contact of this shape.

    Raises:
        AdviceError: the shape is outside the record.
    """
    ellipticity = 1.0 / axis_ratio(problem.curvature_x / problem.curvature_y)
    longest = max(entry["ellipticity"] for entry in table["shapes"])
    if ellipticity > longest * (1.0 + 1e-9):
        raise AdviceError(
            f"{problem.name}: a/b = {ellipticity:.1f}, and errors were measured up to {longest:g}; name a mesh with "
            "--elements instead"
        )
    counts = {entry["elements_per_semi_axis"] for entry in table["shapes"]}
    unlike = len({body.poisson_ratio for body in problem.bodies})
    found = []
    for finest, sequence in SEQUENCES.items():
        if finest not in counts:
            continue
        for positions in POSITION_COUNTS:
            seconds = [_seconds(table, count, solver, unlike, positions) for count in sequence]
            memory = _interpolated(table, finest, solver, "peak_memory_MB")
            error = MARGIN * _error(table, finest, positions, ellipticity)
            found.append(MeshChoice(finest, positions, sequence, error, sum(seconds), seconds[0], memory))
    return found


def _obstacle(choice: MeshChoice, free_MB: float | None) -> str | None:
    """Why a mesh is not available here; None if it is."""
    if free_MB is not None and MEMORY_MARGIN * choice.memory_MB > free_MB:
        return f"about {MEMORY_MARGIN * choice.memory_MB:.0f} MB, of which {free_MB:.0f} MB are free"
    for count in choice.sequence:
        if not meshing.is_at_hand(meshing.half_space(count)):
            return f"that mesh has to be made, but {meshing.gmsh_problem()}"
    return None


def _error(table: dict[str, Any], elements: int, positions: int, ellipticity: float) -> float:
    """Worst error of the two shapes measured on either side."""
    entries = sorted(
        (entry for entry in table["shapes"] if entry["elements_per_semi_axis"] == elements),
        key=lambda entry: entry["ellipticity"],
    )
    shapes = [entry["ellipticity"] for entry in entries]
    above = min(int(np.searchsorted(shapes, ellipticity)), len(shapes) - 1)
    around = entries[max(above - 1, 0) : above + 1]
    return max(entry["worst_error"][str(positions)][name] for entry in around for name in JUDGED)


def _seconds(table: dict[str, Any], elements: int, solver: str, unlike: int, positions: int) -> float:
    """One mesh: condensing each of the unlike bodies, then the contact at every position of its edge."""
    total = _interpolated(table, elements, solver, "seconds")
    contact = _interpolated(table, elements, table["main_solver"], "contact_seconds")
    return unlike * max(total - contact, 0.0) + contact * positions / max(POSITION_COUNTS)


def _interpolated(table: dict[str, Any], elements: int, solver: str, name: str) -> float:
    """A median of a mesh with a solver: as measured, else on the power law through the two meshes measured nearest.

    A solver that the record's machine did not have is taken to be as quick as its main one.
    """
    main = record.mesh_refinement(table["configurations"], table["main_solver"])
    own = record.mesh_refinement(table["configurations"], solver) or main
    measured = {entry["elements_per_semi_axis"]: entry[name]["median"] for entry in own}
    if elements in measured or len(own) < 2:
        return float(measured.get(elements, own[-1][name]["median"]))
    dofs = next(entry["dofs"] for entry in main if entry["elements_per_semi_axis"] == elements)
    x, y = (np.log(values) for values in _dofs_and_medians(own, name))
    above = int(np.clip(np.searchsorted(x, np.log(dofs)), 1, len(x) - 1))
    slope = (y[above] - y[above - 1]) / (x[above] - x[above - 1])
    return float(np.exp(y[above] + slope * (np.log(dofs) - x[above])))


def _dofs_and_medians(refinement: list[dict[str, Any]], name: str) -> tuple[list[float], list[float]]:
    return [entry["dofs"] for entry in refinement], [entry[name]["median"] for entry in refinement]


def expected(choice: MeshChoice, problem: ContactProblem, progress: Progress) -> Expected:
    """Predict the whole run from the coarsest mesh of a choice, solved twice.

    The first solve includes what a process does only once; the second is comparable with the record. Its
    condensed body stays cached for the run.
    """
    start = time.perf_counter()
    half_space_contact.solve_on(
        problem, half_space_contact.condensed_bodies(problem, choice.sequence[0], progress=progress)
    )
    half_space_contact.clear_cache()
    again = time.perf_counter()
    bodies = half_space_contact.condensed_bodies(problem, choice.sequence[0], progress=progress)
    half_space_contact.solve_on(problem, bodies, choice.positions)
    end = time.perf_counter()
    factor = (end - again) / choice.coarsest_seconds
    return Expected(end - start + factor * (choice.seconds - choice.coarsest_seconds), choice.memory_MB, factor)


def choice_message(choice: MeshChoice, expected: Expected) -> str:
    """The choice and the expected time and memory, as a sentence."""
    coarser = " and ".join(str(count) for count in choice.sequence[:-1])
    return (
        f"Chosen: {choice.elements} elements per semi-axis, {choice.positions} positions of the contact's edge, with "
        f"{coarser} elements for the uncertainty; error {choice.error:.1e} or less. Expected: "
        f"{expected.seconds:.1f} s in all, {choice.memory_MB:.0f} MB (the coarsest mesh took "
        f"{expected.machine_factor:.2f} times as long here as where the table was measured)."
    )


def accuracy_record(asked: float, choice: MeshChoice, expected: Expected, entry: dict[str, Any]) -> dict[str, Any]:
    """Expected and reached accuracy, time and memory, for the record of the contact.

    `deviation` is None with the true gap, where Hertz is not the exact solution.
    """
    rows = [row for row in entry["rows"] if row["quantity"] in JUDGED]
    far = max(rows, key=lambda row: abs(row["deviation_percent"]))
    unsure = max(rows, key=lambda row: row["uncertainty_percent"])
    is_parabolic = entry["mesh"]["geometry"] == "parabolic"
    return {
        "asked": asked,
        "elements_per_semi_axis": choice.elements,
        "positions": choice.positions,
        "sequence": list(choice.sequence),
        "expected_error": choice.error,
        "expected_seconds": expected.seconds,
        "expected_memory_MB": choice.memory_MB,
        "machine_factor": expected.machine_factor,
        "seconds": entry["seconds"],
        "peak_memory_MB": entry["peak_memory_MB"],
        "deviation": 0.01 * abs(far["deviation_percent"]) if is_parabolic else None,
        "deviation_of": far["quantity"] if is_parabolic else None,
        "uncertainty": 0.01 * unsure["uncertainty_percent"],
        "uncertainty_of": unsure["quantity"],
    }


def result_message(found: dict[str, Any]) -> str:
    """Accuracy, time and memory reached, as a sentence."""
    reached = (
        "not known with the true gap, where Hertz is not the exact solution"
        if found["deviation"] is None
        else f"{found['deviation']:.1e} off Hertz at most ({found['deviation_of'].replace('_', ' ')})"
    )
    return (
        f"Asked: {found['asked']:.3g}. Reached: {reached}; estimated uncertainty {found['uncertainty']:.1e} "
        f"({found['uncertainty_of'].replace('_', ' ')}). Took {found['seconds']:.1f} s, expected "
        f"{found['expected_seconds']:.1f} s; {found['peak_memory_MB']} MB, expected "
        f"{found['expected_memory_MB']:.0f} MB."
    )
