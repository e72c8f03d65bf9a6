"""Do approach and semi-axes grow like the powers 2/3 and 1/3 of the load, over one or two decades on one mesh?

Coarser meshes of the same kind give the uncertainty. The depth of the largest shear is left to `half_space_contacts`:
at a flat maximum it moves by 0.3 % with the layers that a contact happens to meet, which no other mesh shows.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fem_check import meshing
from fem_check.elements import elastic_body
from fem_check.elements.elastic_body import Support
from fem_check.independent import references
from fem_check.independent.contact_problem import QUANTITIES, ContactProblem
from fem_check.independent.references import hertz
from fem_check.mechanics import contact, measuring
from fem_check.mechanics.half_space_contact import ORDERS, soundness_rows, stretched
from fem_check.mechanics.measuring import Measured
from fem_check.product.scenes import groove_contact, operating_loads
from fem_check.rows import convergence
from fem_check.rows.agreement import (
    EXAMPLE,
    AgreementRow,
    Check,
    CheckKind,
    Findings,
    MeshLevel,
    Progress,
    collapsed,
    covered,
)
from fem_check.rows.record import MeshRecord
from fem_check.rows.row_text import span

DECADES = {MeshLevel.QUICK: 1, MeshLevel.RELEASE: 2}
"""Of load. Two take 2.2 GB on six elements per semi-axis, and fewer elements are too coarse for an uncertainty that
covers: on 3, 4 and 5 the peak pressure is 1.1 times its own off."""
STEPS = {MeshLevel.QUICK: 3, MeshLevel.RELEASE: 7}
"""Loads in even steps, the heaviest being the bearing's own."""
SMALLEST = 1.3
"""Semi-axis of the smallest contact in the mesh, of which the evenly divided part is 1: there its elements are those of
all others, and the same share of it."""
ELEMENTS = {MeshLevel.QUICK: (3, 4, 6), MeshLevel.RELEASE: (4, 5, 7)}
"""The last mesh gives the result, all of them its uncertainty."""
TOLERANCE = 0.2
EXPONENT_TOLERANCES = {
    "approach": 0.002,
    "semi_major_axis": 0.02,
    "semi_minor_axis": 0.02,
    "max_pressure": None,
    "max_shear_stress": 0.02,
}
"""[%] The approach's errors are a tenth of the others'. The pressure, read at a point, is shown only: there the coarse
ends of a mesh for two decades tell most; it is judged in `half_space_contacts`."""
WHY = "twice the uncertainty of these meshes; the pressure, read at a point, is shown only"
EXPONENTS = {
    "approach": 2.0 / 3.0,
    "semi_major_axis": 1.0 / 3.0,
    "semi_minor_axis": 1.0 / 3.0,
    "max_pressure": 1.0 / 3.0,
    "max_shear_stress": 1.0 / 3.0,
}


def recipes(level: MeshLevel) -> list[meshing.Recipe]:
    """The meshes, coarse to fine."""
    span = 10.0 ** (DECADES[level] / 3.0)  # largest over smallest contact
    return [meshing.load_series(elements, round(SMALLEST * span, 2)) for elements in ELEMENTS[level]]


@dataclass(frozen=True)
class _Series:
    """All loads on one mesh."""

    recipe: meshing.Recipe
    dofs: int
    solver: str
    measured: list[Measured]


def position_scatter(measured: list[Measured], quantity: str) -> float:
    """How far the mean over the positions of the contact's edge may be off, over the value: the largest of all loads.

    A quantity swings as the edge passes through an element, and a mean over evenly spread positions keeps some of the
    swing. Half of the positions show that part at one phase only, where it may vanish by chance: at 975.5 N on the
    finest mesh a tenth of the largest was seen, and the semi-major axis was off by 1.4 times its uncertainty. All loads
    are the same contact, each elsewhere in the mesh, so each shows another phase and the largest is the amplitude. With
    32 positions in place of 8 the errors of the semi-major axis at the five heaviest loads agree within 0.002 %, with
    8 within 0.014 % (4 and 5 elements per semi-axis): it is the positions that the meshes alone do not tell.
    """
    return max(each.position_uncertainty(quantity) / getattr(each.mean, quantity) for each in measured)


def _solved(recipe: meshing.Recipe, problems: list[ContactProblem], progress: Progress) -> _Series:
    smallest = hertz(problems[0])
    ellipticity = round(smallest.semi_major_axis / smallest.semi_minor_axis, 3)
    mesh = stretched(meshing.load(recipe), ellipticity, 1.0, 1.0)
    basis = elastic_body.pressure_basis_of(mesh)
    body = elastic_body.condense(mesh, basis, problems[0].race.poisson_ratio, Support.HALF_SPACE, progress=progress)
    # Elements grow by this from one to the next, so the mesh's pattern repeats: the edge passes through one element.
    steps = (np.arange(contact.POSITIONS) + 0.5) / contact.POSITIONS - 0.5
    lengths = smallest.semi_minor_axis / SMALLEST * recipe.x[1].growth ** (-steps)
    solutions = [
        contact.solve(problem, basis, contact.total_flexibility(problem, body, body), lengths) for problem in problems
    ]
    return _Series(recipe, body.dofs, body.solver, [measuring.measure(solution, body, body) for solution in solutions])


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """The inner groove: one factorisation for all loads, each contact at its own size in the mesh."""
    groove = groove_contact(scene, "inner")
    groove = replace(groove, ball=groove.race)  # one body serves for both
    heaviest = operating_loads(scene, "inner")[-1]
    loads = [float(f"{load:.4g}") for load in np.geomspace(0.1 ** DECADES[level] * heaviest, heaviest, STEPS[level])]
    case = f"{groove.name} inner: {span(tuple(loads))}, one mesh"
    problems = [groove.problem(load) for load in loads]
    meshes = [_solved(recipe, problems, progress) for recipe in recipes(level)]
    sizes = [1.0 / each.recipe.elements_per_semi_axis for each in meshes]
    fine = meshes[-1]
    each_load, sound = [], []
    scatter = {name: position_scatter(fine.measured, name) for name in EXPONENTS}
    means = [measured.mean for measured in fine.measured]
    for load, problem, *measured in zip(loads, problems, *(each.measured for each in meshes), strict=True):
        exact = hertz(problem)
        for name in EXPONENTS:
            values = [getattr(each.mean, name) for each in measured]
            uncertainty = convergence.uncertainty_at_order(sizes, values, ORDERS[name])
            uncertainty += scatter[name] * values[-1]
            row = AgreementRow(
                f"Q = {load:g} N",
                name,
                QUANTITIES[name],
                getattr(exact, name),
                references.HERTZ_SOURCE,
                values[-1],
                100.0 * uncertainty / getattr(exact, name),
                None if EXPONENT_TOLERANCES[name] is None else TOLERANCE,
                WHY,
            )
            each_load.append(row)
        sound += soundness_rows(f"Q = {load:g} N", measured)
    rows = [*collapsed(each_load, case), covered(case, each_load), *collapsed(sound, case)]
    for name, expected in EXPONENTS.items():
        values = [getattr(each, name) for each in means]
        slope = float(np.polyfit(np.log(loads), np.log(values), 1)[0])
        rows.append(
            AgreementRow(
                case,
                f"exponent of {name}",
                "1",
                expected,
                "Hertz: contacts of one shape are similar",
                slope,
                None,
                EXPONENT_TOLERANCES[name],
                "on one mesh all loads have nearly the same error: four times what is left, 0.005 % (approach 0.0005)",
            )
        )
    entry: MeshRecord = {
        "elements_per_semi_axis": fine.recipe.elements_per_semi_axis,
        "dofs": fine.dofs,
        "file": fine.recipe.file_name,
    }
    series = {
        "load_series": {
            "load_N": loads,
            **{name: [getattr(each, name) for each in means] for name in EXPONENTS},
            **{f"hertz_{name}": [getattr(hertz(problem), name) for problem in problems] for name in EXPONENTS},
        }
    }
    return Findings(rows, entry, fine.solver, series)


CHECK = Check(
    name="load_power_law",
    question="Over one decade of load on one mesh (two at the release level): do approach and semi-axes follow Hertz's "
    "powers of the load?",
    kind=CheckKind.VERIFICATION,
    reference="Hertz: delta ~ Q^(2/3); a, b, p0, tau ~ Q^(1/3)",
    tolerance=f"{TOLERANCE:g} % at every load, 0.02 % on each exponent, 0.002 of the approach",
    run=run,
    largest_dofs=lambda level: recipes(level)[-1].dofs,
    at_quick=False,
)
