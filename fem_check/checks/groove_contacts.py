"""What the two groove checks share: a bearing's contact, at the loads that the quasi-static model gives it."""

from __future__ import annotations

from fem_check import meshing
from fem_check.independent import references
from fem_check.independent.contact_problem import ContactProblem
from fem_check.mechanics import half_space_contact
from fem_check.mechanics.half_space_contact import MeshStudy
from fem_check.mechanics.pictures import contact_pictures
from fem_check.product.scenes import SceneProblemError, groove_contact, operating_loads
from fem_check.rows.agreement import EXAMPLE, Findings, Level, Progress, Row


def run(race: str, level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """One contact stands for all operating points: contacts of one shape are similar at every load."""
    loads = operating_loads(scene, race)
    if not loads:
        raise SceneProblemError(f"scene {scene}: no contact of the {race} raceway carries load")
    groove = groove_contact(scene, race)
    rows, found = single(
        f"{groove.name} {race}: {span(loads)}", groove.problem(loads[-1]), level, progress, references.HERTZ_SOURCE
    )
    pictures = contact_pictures(found.solution, found.bodies, "the heaviest load")
    return Findings(rows, mesh_entry(found), found.bodies.race.solver, pictures)


def span(loads: tuple[float, ...]) -> str:
    """Which loads a row stands for."""
    if len(loads) == 1:
        return f"Q = {loads[0]:.4g} N"
    return f"{len(loads)} loads, Q = {loads[0]:.4g} to {loads[-1]:.4g} N"


def mesh_entry(found: MeshStudy) -> dict[str, object]:
    """The finest mesh, as the record keeps it."""
    return {
        "elements_per_semi_axis": found.bodies.recipe.elements_per_semi_axis,
        "dofs": found.bodies.race.dofs,
        "file": found.bodies.recipe.file_name,
    }


def largest_dofs(level: Level) -> int:
    """Unknowns of the finest mesh of a level."""
    return meshing.half_space(half_space_contact.SEQUENCES[level][-1]).dofs


def single(
    case: str, problem: ContactProblem, level: Level, progress: Progress, source: str
) -> tuple[list[Row], MeshStudy]:
    """One contact: its rows and the mesh study."""
    found = half_space_contact.mesh_study(problem, half_space_contact.SEQUENCES[level], progress)
    return half_space_contact.rows(case, found, level, source), found
