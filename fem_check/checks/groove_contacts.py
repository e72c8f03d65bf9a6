"""What the two groove checks share: B218's contact, at the loads that the quasi-static model gives it."""

from __future__ import annotations

from fem_check import half_space_contact, meshing, references
from fem_check.agreement import EXAMPLE, Findings, Level, Progress, Row
from fem_check.contact_problem import ContactProblem
from fem_check.half_space_contact import MeshStudy
from fem_check.pictures import contact_pictures
from fem_check.scenes import groove_contact, operating_loads


def run(race: str, level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Every operating point: one set of meshes, since contacts of one shape are similar at every load."""
    contact = groove_contact(scene, race)
    rows = []
    loads = operating_loads(scene, race)
    found: MeshStudy | None = None
    for label, load in loads:
        found = half_space_contact.mesh_study(contact.problem(load), level, progress)
        rows += half_space_contact.rows(f"{label}: Q = {load:.1f} N", found, level, references.HERTZ_SOURCE)
    assert found is not None
    return Findings(
        rows, mesh_entry(found), found.bodies.race.solver, contact_pictures(found.solution, found.bodies, loads[-1][0])
    )


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
    found = half_space_contact.mesh_study(problem, level, progress)
    return half_space_contact.rows(case, found, level, source), found
