"""One contact of a scene, as `fem-check contact` runs it."""

from __future__ import annotations

from fem_check import contact, convergence, half_space_contact, measuring, meshing, references
from fem_check.agreement import Findings, Level, Row
from fem_check.contact_problem import QUANTITIES
from fem_check.elastic_body import Progress
from fem_check.groove import BallInGroove
from fem_check.references import hertz

LEAST_ELEMENTS = 5
"""The sequence of three needs two coarser meshes, and two elements per semi-axis hold no contact."""


def level_of(elements: int) -> Level:
    """The level whose gate so many elements are held to."""
    return Level.RELEASE if elements >= half_space_contact.SEQUENCES[Level.RELEASE][-1] else Level.QUICK


def run(groove: BallInGroove, load: float, elements: int, geometry: str, progress: Progress) -> Findings:
    """Solve one contact on `elements` per semi-axis and two coarser meshes."""
    problem = groove.problem(load)
    exact = hertz(problem)
    gap = groove.gap if geometry == "true" else None
    sizes, sequence = [], []
    for count in (elements - 2, elements - 1, elements):
        pair = half_space_contact.bodies(problem, count, progress=progress)
        unit = contact.edge_positions(exact.semi_minor_axis, pair.edge_element)
        flexibility = contact.total_flexibility(problem, pair.ball, pair.race)
        field = contact.solve(problem, pair.hats, flexibility, unit, gap)
        sequence.append(measuring.measure(field, pair.ball, pair.race))
        sizes.append(pair.edge_element)
    case = f"{problem.name}, Q = {load:g} N, {geometry} gap"
    level = level_of(elements)
    gated = geometry == "parabolic" and elements >= half_space_contact.SEQUENCES[Level.QUICK][-1]
    why = half_space_contact.WHY[level] if gated else "a finding: the true gap, or too coarse a mesh to gate"
    rows = []
    for name, unit_name in QUANTITIES.items():
        reference = getattr(exact, name)
        value = float(getattr(sequence[-1].mean, name))
        estimate = convergence.estimate(sizes, [float(getattr(each.mean, name)) for each in sequence])
        rows.append(
            Row(
                case,
                name,
                unit_name,
                reference,
                references.HERTZ_SOURCE,
                value,
                100.0 * (estimate.uncertainty + sequence[-1].position_uncertainty(name)) / abs(reference),
                half_space_contact.TOLERANCES[level][name] if gated else None,
                why,
            )
        )
    rows += half_space_contact.soundness_rows(case, sequence)
    recipe = meshing.half_space(elements)
    mesh = {"elements_per_semi_axis": elements, "dofs": pair.race.dofs, "file": recipe.file_name, "geometry": geometry}
    return Findings(rows, mesh, pair.race.solver)
