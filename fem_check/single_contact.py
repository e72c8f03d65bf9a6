"""One contact of a scene, as `fem-check contact` runs it."""

from __future__ import annotations

from fem_check import contact, convergence, half_space_contact, measuring, meshing, references
from fem_check.agreement import Findings, Level, Row
from fem_check.checks import true_geometry
from fem_check.contact_problem import QUANTITIES
from fem_check.cost.measurement import JUDGED
from fem_check.cost.mesh_choice import SEQUENCES
from fem_check.elastic_body import Progress
from fem_check.groove import BallInGroove
from fem_check.references import hertz

USUAL_ELEMENTS = 8
LEAST_ELEMENTS = 5
"""The sequence of three needs two coarser meshes, and two elements per semi-axis are too few for a contact."""
LEAST_TRUE_ELEMENTS = 6
"""Of true bodies, whose meshes lie farther apart."""


def level_of(elements: int) -> Level:
    """The level whose tolerances apply to so many elements."""
    return Level.RELEASE if elements >= half_space_contact.SEQUENCES[Level.RELEASE][-1] else Level.QUICK


def sequence_of(elements: int) -> tuple[int, ...]:
    """The meshes solved where only the finest is named.

    Well apart where the cost record's are: errors are irregular in the number of cells, and with 6, 7 and 8 elements
    per semi-axis the estimate fell short of the error of p0 by up to seven times.
    """
    return SEQUENCES.get(elements, (elements - 2, elements - 1, elements))


def run(
    scene: str,
    groove: BallInGroove,
    load: float,
    sequence: tuple[int, ...],
    geometry: str,
    progress: Progress,
    accuracy: float | None = None,
) -> Findings:
    """Solve one contact on a sequence of meshes.

    Args:
        scene: the bearing, of which true bodies need more than the contact.
        groove: ball and raceway.
        load: normal load [N].
        sequence: elements per semi-axis, coarse to fine; the last gives the result, all of them its uncertainty.
        geometry: "parabolic", half-spaces where Hertz is exact, or "true": ball and ring segment at the loaded contact
            angle.
        progress: progress callback.
        accuracy: tolerance of the quantities that it applies to; None: the level's own tolerances.
    """
    if geometry == "true":
        return true_geometry.single(scene, groove.race_name, load, sequence[-1], progress)
    problem = groove.problem(load)
    exact = hertz(problem)
    elements = sequence[-1]
    sizes, measured = [], []
    for count in sequence:
        bodies = half_space_contact.condensed_bodies(problem, count, progress=progress)
        unit = contact.edge_positions(exact.semi_minor_axis, bodies.edge_element)
        flexibility = contact.total_flexibility(problem, bodies.ball, bodies.race)
        solution = contact.solve(problem, bodies.basis, flexibility, unit)
        measured.append(measuring.measure(solution, bodies.ball, bodies.race))
        sizes.append(bodies.edge_element)
    case = f"{problem.name}, Q = {load:g} N, parabolic gap"
    level = level_of(elements)
    tolerances, why = half_space_contact.TOLERANCES[level], half_space_contact.WHY[level]
    if accuracy is None and elements < half_space_contact.SEQUENCES[Level.QUICK][-1]:
        tolerances, why = {}, "a finding: too coarse a mesh for a tolerance"
    elif accuracy is not None:
        tolerances, why = dict.fromkeys(JUDGED, 100.0 * accuracy), "the accuracy asked for"
    rows = []
    for name, unit_name in QUANTITIES.items():
        reference = getattr(exact, name)
        value = float(getattr(measured[-1].mean, name))
        values = [float(getattr(each.mean, name)) for each in measured]
        mesh_uncertainty = convergence.uncertainty_at_order(sizes, values, half_space_contact.ORDERS[name])
        rows.append(
            Row(
                case,
                name,
                unit_name,
                reference,
                references.HERTZ_SOURCE,
                value,
                100.0 * (mesh_uncertainty + measured[-1].position_uncertainty(name)) / abs(reference),
                tolerances.get(name),
                why
                if name in tolerances or not tolerances
                else "a finding: at the maximum of the shear its depth is ill defined",
            )
        )
    rows += half_space_contact.soundness_rows(case, measured)
    recipe = meshing.half_space(elements)
    mesh = {
        "elements_per_semi_axis": elements,
        "dofs": bodies.race.dofs,
        "file": recipe.file_name,
        "geometry": geometry,
    }
    return Findings(rows, mesh, bodies.race.solver)
