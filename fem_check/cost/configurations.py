"""The configurations that are measured, and the solution of one. A later one joins by a line in `planned`.

All solve the same contact, B218's inner one, so that errors and times can be compared. Only the shape of a contact
enters its error: contacts of one shape are similar at every load (`shapes` takes other shapes).
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from typing import Any

import numpy as np

from fem_check import contact, elastic_body, half_space_contact, linear_solver, measuring, memory, meshing
from fem_check.agreement import Level
from fem_check.contact_problem import QUANTITIES, ContactProblem
from fem_check.elastic_body import Support
from fem_check.element_family import FAMILIES, SERENDIPITY, ElementFamily
from fem_check.half_space_contact import Bodies
from fem_check.measuring import Measured
from fem_check.references import axis_ratio, hertz
from fem_check.scenes import groove_contact

SCENE, RACE, LOAD = "b218", "inner", 1000.0

JUDGED = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure", "max_shear_stress")
"""The *accuracy* of a contact is the worst relative error of these. The depth of the largest shear is left out: at the
maximum, 0.05 % of shear is 2 % of depth."""

MESHES = {Level.QUICK: (3, 4, 5, 6), Level.RELEASE: (3, 4, 5, 6, 8, 10, 12, 16)}
"""Elements per semi-axis. The finest takes 90 000 unknowns and 2.5 GB."""
FAMILY_MESHES: dict[Level, dict[str, tuple[int, ...]]] = {
    Level.QUICK: {family.name: (4, 6) for family in FAMILIES},
    Level.RELEASE: {
        "hex20_full": (4, 6, 8, 10),
        "hex27": (4, 6, 8, 10),
        "hex8": (4, 6, 8, 12, 16),
        "tet10": (4, 6, 8, 10),
        "tet4": (4, 6, 8, 12, 16),
    },
}
SOLVER_MESHES = {Level.QUICK: (4, 6), Level.RELEASE: (4, 6, 8, 12)}
SLOWEST_SOLVER_MESHES = {Level.QUICK: (4, 6), Level.RELEASE: (4, 6, 8, 10)}
WARM_UP = 3
"""Elements per semi-axis of the contact that is solved before any is timed."""
BOX_SIZES = (8.0, 16.0, 32.0)
BOX_MESHES = {Level.QUICK: (4,), Level.RELEASE: (4, 5)}
CLAMPED_BLOCK_MESHES = {Level.QUICK: (4, 6), Level.RELEASE: (4, 6, 8)}


@dataclass(frozen=True)
class Configuration:
    """One way to solve the contact: mesh, element family, far field, linear solver."""

    elements: int
    """Per semi-axis."""
    solver: str
    """Its key in `linear_solver`."""
    family: str = SERENDIPITY.name
    is_clamped: bool = False
    """The far faces are fixed instead of moving as a half-space does."""
    box_size: float = 0.0
    """Half-width and depth of the body in semi-major axes; 0: the block, cut at `meshing.CUT` of each semi-axis."""

    @property
    def far_field(self) -> str:
        """As a label."""
        if not self.is_clamped:
            return "exact"
        return f"clamped at {self.box_size:g} a" if self.box_size else f"clamped at {meshing.CUT:g} semi-axes"

    def describe(self) -> dict[str, Any]:
        """As the record names it."""
        return {
            "elements_per_semi_axis": self.elements,
            "family": self.family,
            "far_field": self.far_field,
            "solver": self.solver,
        }


def problem() -> ContactProblem:
    """The contact that every configuration solves."""
    return groove_contact(SCENE, RACE).problem(LOAD)


def planned(level: Level, main: str, others: list[str]) -> list[Configuration]:
    """All configurations of a level: meshes with the main solver, then families, far fields, and the other solvers."""
    found = [Configuration(count, main) for count in MESHES[level]]
    for family, counts in FAMILY_MESHES[level].items():
        found += [Configuration(count, main, family) for count in counts]
    found += [Configuration(count, main, is_clamped=True) for count in CLAMPED_BLOCK_MESHES[level]]
    found += [
        Configuration(count, main, is_clamped=True, box_size=size) for count in BOX_MESHES[level] for size in BOX_SIZES
    ]
    for solver in others:
        counts = (SLOWEST_SOLVER_MESHES if solver == "scipy" else SOLVER_MESHES)[level]
        found += [Configuration(count, solver) for count in counts]
    return list(dict.fromkeys(found))


def family_named(name: str) -> ElementFamily:
    """An element family by its key."""
    return next(family for family in FAMILIES if family.name == name)


def _bodies(configuration: Configuration, problem: ContactProblem) -> Bodies:
    support = Support.CLAMPED if configuration.is_clamped else Support.HALF_SPACE
    family = family_named(configuration.family)
    if not configuration.box_size:
        return half_space_contact.condensed_bodies(problem, configuration.elements, support=support, family=family)
    ellipticity = _box_ellipticity(problem)
    recipe = meshing.clamped_box(configuration.elements, configuration.box_size, ellipticity)
    mesh = half_space_contact.stretched(meshing.load(recipe), ellipticity, 1.0, 1.0)
    basis = elastic_body.pressure_basis_of(mesh)
    body = elastic_body.condense(mesh, basis, problem.race.poisson_ratio, support, family=family)
    return Bodies(body, body, basis, recipe)


def make_meshes(level: Level) -> None:
    """Make every mesh of a level that is not here yet, so that no configuration's time includes it.

    Raises:
        MeshError: one is missing and cannot be made.
    """
    counts = {*MESHES[level], *(count for some in FAMILY_MESHES[level].values() for count in some)}
    ellipticity = _box_ellipticity(problem())
    recipes = [meshing.half_space(count) for count in sorted(counts)]
    recipes += [meshing.clamped_box(count, size, ellipticity) for count in BOX_MESHES[level] for size in BOX_SIZES]
    for recipe in recipes:
        meshing.locate(recipe)


def _box_ellipticity(problem: ContactProblem) -> float:
    """The proportions of the boxes kept in the repository."""
    return round(1.0 / axis_ratio(problem.curvature_x / problem.curvature_y), 1)


def errors(problem: ContactProblem, measured: Measured) -> dict[str, Any]:
    """Relative errors against Hertz: of the mean over the positions, and of single ones."""
    exact = hertz(problem)
    mean, worst, spread = {}, {}, {}
    for name in QUANTITIES:
        each = measured.each[name] / getattr(exact, name) - 1.0
        mean[name] = float(each.mean())
        worst[name] = float(np.abs(each).max())
        spread[name] = float(each.std())
    return {
        "error": mean,
        "worst_error": max(abs(mean[name]) for name in JUDGED),
        "single_position": {"worst": worst, "standard_deviation": spread},
        "worst_single_position": max(worst[name] for name in JUDGED),
    }


def solve(configuration: Configuration) -> dict[str, Any]:
    """Solve one configuration once; meant for a process of its own.

    Timed: reading the mesh, assembling, far field, factorising, solving for every pressure basis function, the contact
    at all positions of its edge, evaluating the results. Not timed: what a process does once (loading libraries,
    starting threads), for which a small contact is solved first, and making the mesh.
    """
    os.environ[linear_solver.ENVIRONMENT] = configuration.solver
    contact_solved = problem()
    memory.restart_peak()
    base = memory.peak_MB()
    half_space_contact.solve_on(contact_solved, half_space_contact.condensed_bodies(contact_solved, WARM_UP))
    half_space_contact.clear_cache()
    memory.restart_peak()
    start, cpu = time.perf_counter(), time.process_time()
    bodies = _bodies(configuration, contact_solved)
    condensed = time.perf_counter()
    unit_lengths = contact.edge_positions(hertz(contact_solved).semi_minor_axis, bodies.edge_element)
    flexibility = contact.total_flexibility(contact_solved, bodies.ball, bodies.race)
    solution = contact.solve(contact_solved, bodies.basis, flexibility, unit_lengths)
    measured = measuring.measure(solution, bodies.ball, bodies.race)
    end = time.perf_counter()
    return {
        "seconds": end - start,
        "contact_seconds": end - condensed,
        "cpu_seconds": time.process_time() - cpu,
        "peak_memory_MB": memory.peak_MB(),
        "base_memory_MB": base,
        "dofs": bodies.race.dofs,
        "pressure_unknowns": len(bodies.basis.forces),
        "element_size": bodies.edge_element,
        "solver_name": bodies.race.solver,
        "sound": all(
            getattr(measured.soundness, name) <= getattr(measuring.LIMITS, name)
            for name in ("force_imbalance", "penetration", "load_error")
        ),
        **errors(contact_solved, measured),
    }
