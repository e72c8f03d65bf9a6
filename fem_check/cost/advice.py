"""The cheapest mesh that will do: chosen by the cost record, its time scaled to this machine.

The record holds, for each mesh and shape of contact, the worst error over the ways to lay 2, 4 or 8 places of the
contact's edge in an element. Load and materials do not enter it: contacts of one shape are similar at every load, and
Poisson's ratios from 0.2 to 0.45 move the error by less than two per cent of itself. What is solved, besides, are two
coarser meshes, for the uncertainty of the answer; their time is part of the price.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np

from fem_check import half_space_contact, meshing
from fem_check.contact_problem import ContactProblem
from fem_check.cost import record
from fem_check.cost.rungs import JUDGED
from fem_check.elastic_body import Progress
from fem_check.references import axis_ratio

MARGIN = 1.1
"""On the errors of the record: between its shapes they change smoothly, with the materials by two per cent."""
MEMORY_MARGIN = 1.35
"""The meshes solved before the finest leave something behind."""
PLACES = (2, 4, 8)
"""One place of the edge tells nothing of its own scatter, so it is not on offer."""
SEQUENCES = {5: (3, 4, 5), 6: (4, 5, 6), 8: (4, 6, 8), 10: (6, 8, 10), 12: (6, 8, 12), 16: (8, 12, 16)}
"""Meshes solved for an answer and its uncertainty, by elements per semi-axis of the finest."""


class AdviceError(Exception):
    """Nothing measured will do here; the message says what the best would be."""


@dataclass(frozen=True)
class Way:
    """A mesh and number of places, with what the record says of them."""

    elements: int
    places: int
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
    """This machine's time over that of the record's, on the coarsest mesh."""


def table() -> dict[str, Any]:
    """The cost record in use."""
    found = record.read()
    if found is None:
        raise AdviceError(f"there is no cost record in {record.FOLDER}: run `fem-check cost` first")
    return found


def choose(problem: ContactProblem, accuracy: float, table: dict[str, Any], solver: str, free_MB: float | None) -> Way:
    """The way that is expected to be quickest among those that are accurate enough and can be had here.

    Args:
        accuracy: largest relative error wanted.
        table: a cost record.
        solver: key of the linear solver that will be used.
        free_MB: memory to be had; None: unknown, taken as enough.

    Raises:
        AdviceError: none is; the message states the best attainable.
    """
    every = ways(problem, table, solver)
    obstacles = {way.elements: _obstacle(way, free_MB) for way in every}
    here = [way for way in every if obstacles[way.elements] is None]
    good = [way for way in here if way.error <= accuracy]
    if good:
        return min(good, key=lambda way: (way.seconds, way.error))
    best = min(here, key=lambda way: way.error, default=None)
    could = [way for way in every if way.error <= accuracy]
    if could:
        first = min(could, key=lambda way: way.seconds)
        reason = f"takes {first.elements} elements per semi-axis, and {obstacles[first.elements]}"
    else:
        finest = min(every, key=lambda way: way.error)
        reason = f"is beyond the finest mesh measured, {finest.elements} elements per semi-axis"
    attainable = (
        f"the best attainable here is {best.error:.1e}, with {best.elements} elements per semi-axis"
        if best
        else "no mesh measured can be had here"
    )
    raise AdviceError(f"an accuracy of {accuracy:.3g} {reason}; {attainable}")


def ways(problem: ContactProblem, table: dict[str, Any], solver: str) -> list[Way]:
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
    bodies = len({body.poisson_ratio for body in problem.bodies})
    found = []
    for finest, sequence in SEQUENCES.items():
        if finest not in counts:
            continue
        for places in PLACES:
            seconds = [_seconds(table, count, solver, bodies, places) for count in sequence]
            memory = _interpolated(table, finest, solver, "peak_memory_MB")
            error = MARGIN * _error(table, finest, places, ellipticity)
            found.append(Way(finest, places, sequence, error, sum(seconds), seconds[0], memory))
    return found


def _obstacle(way: Way, free_MB: float | None) -> str | None:
    """Why a mesh cannot be had here; None if it can."""
    if free_MB is not None and MEMORY_MARGIN * way.memory_MB > free_MB:
        return f"about {MEMORY_MARGIN * way.memory_MB:.0f} MB, of which {free_MB:.0f} MB are free"
    for count in way.sequence:
        if not meshing.is_at_hand(meshing.half_space(count)):
            return f"that mesh has to be made, but {meshing.gmsh_problem()}"
    return None


def _error(table: dict[str, Any], elements: int, places: int, ellipticity: float) -> float:
    """Worst error of the two shapes measured on either side."""
    entries = sorted(
        (entry for entry in table["shapes"] if entry["elements_per_semi_axis"] == elements),
        key=lambda entry: entry["ellipticity"],
    )
    shapes = [entry["ellipticity"] for entry in entries]
    above = min(int(np.searchsorted(shapes, ellipticity)), len(shapes) - 1)
    around = entries[max(above - 1, 0) : above + 1]
    return max(entry["worst_error"][str(places)][name] for entry in around for name in JUDGED)


def _seconds(table: dict[str, Any], elements: int, solver: str, bodies: int, places: int) -> float:
    """One mesh: condensing each of the unlike bodies, then the contact at every place of its edge."""
    whole = _interpolated(table, elements, solver, "seconds")
    contact = _interpolated(table, elements, table["main_solver"], "contact_seconds")
    return bodies * max(whole - contact, 0.0) + contact * places / max(PLACES)


def _interpolated(table: dict[str, Any], elements: int, solver: str, name: str) -> float:
    """A median of a mesh with a solver: as measured, else on the power law through the two meshes measured nearest.

    A solver that the record's machine did not have is taken to be as quick as its main one.
    """
    main = record.mesh_ladder(table["rungs"], table["main_solver"])
    own = record.mesh_ladder(table["rungs"], solver) or main
    measured = {entry["elements_per_semi_axis"]: entry[name]["median"] for entry in own}
    if elements in measured or len(own) < 2:
        return float(measured.get(elements, own[-1][name]["median"]))
    dofs = next(entry["dofs"] for entry in main if entry["elements_per_semi_axis"] == elements)
    x, y = (np.log(values) for values in _pairs(own, name))
    above = int(np.clip(np.searchsorted(x, np.log(dofs)), 1, len(x) - 1))
    slope = (y[above] - y[above - 1]) / (x[above] - x[above - 1])
    return float(np.exp(y[above] + slope * (np.log(dofs) - x[above])))


def _pairs(ladder: list[dict[str, Any]], name: str) -> tuple[list[float], list[float]]:
    return [entry["dofs"] for entry in ladder], [entry[name]["median"] for entry in ladder]


def expected(way: Way, problem: ContactProblem, progress: Progress) -> Expected:
    """Predict the whole run from the coarsest mesh of a way, solved twice.

    The first time it meets all that a process does only once; the second is comparable with the record. What it leaves
    is kept, and serves the run.
    """
    start = time.perf_counter()
    half_space_contact.solve_on(problem, half_space_contact.bodies(problem, way.sequence[0], progress=progress))
    half_space_contact.forget()
    again = time.perf_counter()
    pair = half_space_contact.bodies(problem, way.sequence[0], progress=progress)
    half_space_contact.solve_on(problem, pair, way.places)
    end = time.perf_counter()
    factor = (end - again) / way.coarsest_seconds
    return Expected(end - start + factor * (way.seconds - way.coarsest_seconds), way.memory_MB, factor)


def announcement(way: Way, expected: Expected) -> str:
    """What will be done, before it is done."""
    coarser = " and ".join(str(count) for count in way.sequence[:-1])
    return (
        f"Chosen: {way.elements} elements per semi-axis, {way.places} places of the contact's edge, with {coarser} "
        f"elements for the uncertainty; error {way.error:.1e} or less. Expected: {expected.seconds:.1f} s in all, "
        f"{way.memory_MB:.0f} MB (the coarsest mesh took {expected.machine_factor:.2f} times as long here as where the "
        "table was measured)."
    )


def outcome(asked: float, way: Way, expected: Expected, entry: dict[str, Any]) -> dict[str, Any]:
    """What was expected and what was reached, for the record of the contact.

    `deviation` is None with the true gap, where Hertz is no measure of the mesh.
    """
    rows = [row for row in entry["rows"] if row["quantity"] in JUDGED]
    far = max(rows, key=lambda row: abs(row["deviation_percent"]))
    unsure = max(rows, key=lambda row: row["uncertainty_percent"])
    is_parabolic = entry["mesh"]["geometry"] == "parabolic"
    return {
        "asked": asked,
        "elements_per_semi_axis": way.elements,
        "places": way.places,
        "sequence": list(way.sequence),
        "expected_error": way.error,
        "expected_seconds": expected.seconds,
        "expected_memory_MB": way.memory_MB,
        "machine_factor": expected.machine_factor,
        "seconds": entry["seconds"],
        "peak_memory_MB": entry["peak_memory_MB"],
        "deviation": 0.01 * abs(far["deviation_percent"]) if is_parabolic else None,
        "deviation_of": far["quantity"] if is_parabolic else None,
        "uncertainty": 0.01 * unsure["uncertainty_percent"],
        "uncertainty_of": unsure["quantity"],
    }


def conclusion(found: dict[str, Any]) -> str:
    """What was reached, after it was done."""
    reached = (
        "Hertz is no measure of the mesh with the true gap"
        if found["deviation"] is None
        else f"{found['deviation']:.1e} off Hertz at most ({found['deviation_of'].replace('_', ' ')})"
    )
    return (
        f"Asked: {found['asked']:.3g}. Reached: {reached}; estimated uncertainty {found['uncertainty']:.1e} "
        f"({found['uncertainty_of'].replace('_', ' ')}). Took {found['seconds']:.1f} s, expected "
        f"{found['expected_seconds']:.1f} s; {found['peak_memory_MB']} MB, expected "
        f"{found['expected_memory_MB']:.0f} MB."
    )
