"""Error, time and memory of one contact, for element families and meshes, and beside them of the closed forms.

Only the shape of a contact enters its error: contacts of one shape are similar at every load. All solve B218's inner
one, whose exact solution is Hertz.
"""

from __future__ import annotations

import statistics
import time
import timeit
from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial

import qsbearing
from fem_check import meshing
from fem_check.cost.record import CostRecord, FormCost, MeshCost, MeshRun, Spread
from fem_check.elements.elastic_body import Progress
from fem_check.elements.element_family import FAMILIES, SERENDIPITY
from fem_check.independent.contact_problem import ContactProblem
from fem_check.independent.references import axis_ratio, hertz
from fem_check.mechanics import half_space_contact
from fem_check.product.scenes import groove_contact
from fem_check.rows.agreement import MeshLevel
from fem_check.running import memory, records_store
from qsbearing.model.contact.hertz import HertzForm, effective_modulus
from qsbearing.results import provenance
from qsbearing.studies.cost.measuring import in_fresh_process

SCENE, RACE, LOAD = "b218", "inner", 1000.0

JUDGED = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure", "max_shear_stress")
"""The *accuracy* of a contact is the worst of these. The depth of the largest shear is left out: at the maximum, 0.05 %
of shear is 2 % of depth."""

MESHES: dict[MeshLevel, dict[str, tuple[int, ...]]] = {
    MeshLevel.QUICK: {SERENDIPITY.name: (3, 4, 5, 6), "hex27": (4,), "hex8": (4, 6), "tet10": (4,), "tet4": (4, 6)},
    MeshLevel.RELEASE: {
        SERENDIPITY.name: (3, 4, 5, 6, 8, 10, 12, 16),
        "hex27": (4, 6, 8, 10),
        "hex8": (4, 6, 8, 12, 16),
        "tet10": (4, 6, 8, 10),
        "tet4": (4, 6, 8, 12, 16),
    },
}
"""Elements per semi-axis for each family. The finest takes 90 000 unknowns and 2.1 GB."""
REPEATS = 3
"""Taken in turn: a shared machine's speed drifts, and compared times must see the same drift."""
WARM_UP = 3
"""Elements per semi-axis of the contact that is solved before any is timed."""

FORMS = {
    HertzForm.BREWE_HAMROCK_1977: "Brewe & Hamrock 1977",
    HertzForm.HAMROCK_BREWE_1983: "Hamrock & Brewe 1983",
    HertzForm.EXACT: "exact Hertz",
}
CALLS = 200
"""Calls of a closed form in one timing."""


@dataclass(frozen=True)
class Configuration:
    """One way to solve the contact."""

    elements: int
    """Per semi-axis."""
    family: str


def problem() -> ContactProblem:
    """The contact that every configuration solves."""
    return groove_contact(SCENE, RACE).problem(LOAD)


def solve(configuration: Configuration) -> MeshRun:
    """Solve one configuration once; meant for a process of its own, whose memory is then its own too.

    Timed: reading the mesh, assembling, far field, factorising, solving for every pressure basis function, the contact
    at all positions of its edge, evaluating the results. Not timed: what a process does once (loading libraries,
    starting threads), for which a small contact is solved first.
    """
    solved = problem()
    half_space_contact.solve_on(solved, half_space_contact.condensed_bodies(solved, WARM_UP))
    half_space_contact.clear_cache()
    memory.restart_peak()
    start = time.perf_counter()
    (family,) = [each for each in FAMILIES if each.name == configuration.family]
    bodies = half_space_contact.condensed_bodies(solved, configuration.elements, family=family)
    _, measured = half_space_contact.solve_on(solved, bodies)
    seconds = time.perf_counter() - start
    exact = hertz(solved)
    error = {name: getattr(measured.mean, name) / getattr(exact, name) - 1.0 for name in JUDGED}
    return {
        "family": family.label,
        "elements_per_semi_axis": configuration.elements,
        "dofs": bodies.race.dofs,
        "element_size": bodies.edge_element,
        "error": error,
        "worst_error": max(map(abs, error.values())),
        "position_uncertainty": {name: measured.position_uncertainty(name) / getattr(exact, name) for name in JUDGED},
        "solver": bodies.race.solver,
        "seconds": seconds,
        "peak_memory_MB": memory.peak_MB(),
    }


def closed_forms(solved: ContactProblem) -> list[FormCost]:
    """Error and time of each closed form, called from Python.

    The errors are against `references`, Hertz in another form; that of the exact form is the rounding of the two.
    """
    exact = hertz(solved)
    modulus = effective_modulus(
        solved.ball.elastic_modulus, solved.ball.poisson_ratio, solved.race.elastic_modulus, solved.race.poisson_ratio
    )
    table: list[FormCost] = []
    for form, label in FORMS.items():
        call = partial(qsbearing.point_contact, solved.load, solved.curvature_x, solved.curvature_y, modulus, form)
        contact = call()
        error = {name: getattr(contact, name) / getattr(exact, name) - 1.0 for name in JUDGED if hasattr(contact, name)}
        seconds = [each / CALLS for each in timeit.repeat(call, number=CALLS, repeat=15)]
        worst = max(map(abs, error.values()))
        table.append({"label": label, "error": error, "worst_error": worst, "seconds": _spread(seconds)})
    return table


def measure(level: MeshLevel, progress: Progress) -> CostRecord:
    """Measure a level: a cost record; nothing is written.

    Raises:
        MeshError: a mesh is missing and cannot be made.
    """
    start = time.perf_counter()
    planned = [Configuration(count, family) for family, counts in MESHES[level].items() for count in counts]
    for count in {each.elements for each in planned}:
        meshing.locate(meshing.half_space(count))  # made here, so that no configuration's time includes it
    machine = provenance.hardware() | records_store.versions()
    runs: dict[Configuration, list[MeshRun]] = {each: [] for each in planned}
    for turn in range(REPEATS):
        for done, each in enumerate(planned):
            stage = f"round {turn + 1}: {each.elements} elements, {each.family}"
            progress(stage, (turn + done / len(planned)) / REPEATS)
            runs[each].append(in_fresh_process(solve, each))
    solved = problem()
    return {
        "level": str(level),
        "made_by": f"fem-check cost --level {level}",
        "machine": machine,
        "contact": f"{solved.name} at {solved.load:g} N",
        "ellipticity": 1.0 / axis_ratio(solved.curvature_x / solved.curvature_y),
        "solver": runs[planned[0]][0]["solver"],
        "meshes": [_entry(each) for each in runs.values()],
        "closed_forms": closed_forms(solved),
        "seconds": round(time.perf_counter() - start, 1),
        "provenance": provenance.of_run(f"fem-check cost --level {level}", str(level), records_store.PACKAGES),
    }


def _entry(runs: list[MeshRun]) -> MeshCost:
    peak = round(statistics.median(run["peak_memory_MB"] for run in runs))
    return {**runs[0], "seconds": _spread(run["seconds"] for run in runs), "peak_memory_MB": peak}


def _spread(seconds: Iterable[float]) -> Spread:
    """Median, smallest and largest, to three digits: more would be noise."""
    values = sorted(seconds)
    median, low, high = (float(f"{each:.3g}") for each in (statistics.median(values), values[0], values[-1]))
    return {"median": median, "low": low, "high": high}
