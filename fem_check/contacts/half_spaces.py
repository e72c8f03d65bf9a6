"""Chosen contacts as half-spaces, where Hertz is exact: each shape of contact is solved once, for all its loads.

Half-spaces have no length of their own: contacts of one ratio of curvatures and one pair of materials are similar at
every load and size, lengths and stresses as the cube root of the load. Contacts of nearly the same shape, as at the
angles that different loads turn them to, share the condensed bodies of one mesh.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from fem_check import meshing
from fem_check.contacts.chosen import Chosen
from fem_check.cost.measurement import JUDGED
from fem_check.cost.mesh_choice import SEQUENCES
from fem_check.independent import references
from fem_check.independent.contact_problem import QUANTITIES, ContactProblem
from fem_check.independent.references import hertz
from fem_check.mechanics import half_space_contact
from fem_check.mechanics.half_space_contact import MeshStudy
from fem_check.rows.agreement import AgreementRow, Findings, MeshLevel, Progress, collapsed, covered
from fem_check.rows.record import MeshRecord
from fem_check.solids.true_contact import READ

USUAL_ELEMENTS = 8
LEAST_ELEMENTS = 5
"""The sequence of three needs two coarser meshes, and two elements per semi-axis are too few for a contact."""
NEARLY = 0.02
"""Contacts whose a/b differ by less share a mesh: of the stretches that a contact's uncertainty holds, the smallest is
3 %."""


def level_of(elements: int) -> MeshLevel:
    """The level whose tolerances apply to so many elements."""
    return MeshLevel.RELEASE if elements >= half_space_contact.SEQUENCES[MeshLevel.RELEASE][-1] else MeshLevel.QUICK


def sequence_of(elements: int) -> tuple[int, ...]:
    """The meshes solved where only the finest is named.

    Well apart where the cost record's are: errors are irregular in the number of cells, and with 6, 7 and 8 elements
    per semi-axis the estimate fell short of the error of p0 by up to seven times.
    """
    return SEQUENCES.get(elements, (elements - 2, elements - 1, elements))


@dataclass(frozen=True)
class Shape:
    """Similar contacts: one is solved, the others follow from it."""

    study: MeshStudy
    """Of the most heavily loaded."""
    alike: tuple[Chosen, ...]
    """All of them, in the order chosen."""

    @property
    def ellipticity(self) -> float:
        """a/b."""
        return ellipticity(self.study.problem)

    @property
    def name(self) -> str:
        """Of what is the same for all."""
        loads = f"{len(self.alike)} contacts" if len(self.alike) > 1 else f"Q = {self.alike[0].load:g} N"
        return f"{self.study.problem.name}, a/b = {self.ellipticity:.3f}, {loads}, parabolic gap"


def ellipticity(problem: ContactProblem) -> float:
    """a/b of Hertz's ellipse."""
    return 1.0 / references.axis_ratio(problem.curvature_x / problem.curvature_y)


def solve(contacts: Sequence[Chosen], sequence: tuple[int, ...], progress: Progress) -> list[Shape]:
    """Every shape among the contacts, solved on a sequence of meshes.

    Args:
        contacts: what is asked for.
        sequence: elements per semi-axis, coarse to fine.
        progress: progress callback.

    Raises:
        MeshError: a mesh cannot be read or made.
        ContactError: a contact cannot be solved.
    """
    shapes: dict[Any, list[Chosen]] = {}
    for each in contacts:
        problem = each.problem
        similar = float(f"{problem.curvature_x / problem.curvature_y:.9g}"), *problem.bodies
        shapes.setdefault((each.groove.race_name, similar), []).append(each)
    solved = []
    proportions: ContactProblem | None = None
    heaviest = [max(alike, key=lambda each: each.load).problem for alike in shapes.values()]
    for problem, alike in sorted(zip(heaviest, shapes.values(), strict=True), key=lambda each: ellipticity(each[0])):
        if proportions is None or ellipticity(problem) > (1.0 + NEARLY) * ellipticity(proportions):
            proportions = problem
        study = half_space_contact.mesh_study(problem, sequence, progress, proportions)
        solved.append(Shape(study, tuple(alike)))
    order = list(contacts)
    return sorted(solved, key=lambda shape: order.index(shape.alike[0]))


def findings(shapes: Sequence[Shape], elements: int, accuracy: float | None) -> Findings:
    """The contacts against Hertz, those of a shape together, and the self-checks, of several shapes the worst.

    Args:
        shapes: as solved.
        elements: per semi-axis of the finest mesh.
        accuracy: tolerance of the quantities that it applies to; None: the level's own tolerances.
    """
    rows: list[AgreementRow] = []
    checks: list[AgreementRow] = []
    for shape in shapes:
        each = [row for contact in shape.alike for row in agreement(shape, contact, elements, accuracy)]
        judged = covered(shape.name, each)
        if not any(row.tolerance_percent for row in each):
            judged = replace(judged, tolerance_percent=None, why_tolerance=COARSE)
        rows += each
        checks += [judged, *half_space_contact.soundness_rows(shape.name, shape.study.sequence + shape.study.stretched)]
    if len(shapes) > 1:
        checks = collapsed(checks, f"self-checks, worst of {len(shapes)} shapes of contact")
    return Findings([*rows, *checks], mesh_entry(shapes, elements), shapes[0].study.bodies.race.solver)


COARSE = "a finding: too coarse a mesh for a tolerance"


def case_of(contact: Chosen) -> str:
    """Of a contact's rows."""
    return f"{contact.groove.name} {contact.label}, parabolic gap"


def agreement(shape: Shape, contact: Chosen, elements: int, accuracy: float | None) -> list[AgreementRow]:
    """One contact against Hertz: what its shape was found to be over Hertz, times its own."""
    level = level_of(elements)
    tolerances, why = half_space_contact.TOLERANCES[level], half_space_contact.WHY[level]
    if accuracy is not None:
        tolerances, why = dict.fromkeys(JUDGED, 100.0 * accuracy), "the accuracy asked for"
    elif elements < half_space_contact.SEQUENCES[MeshLevel.QUICK][-1]:
        tolerances, why = {}, COARSE
    solved, own = hertz(shape.study.problem), hertz(contact.problem)
    rows = []
    for name, unit in QUANTITIES.items():
        exact, reference = getattr(solved, name), getattr(own, name)
        rows.append(
            AgreementRow(
                case_of(contact),
                name,
                unit,
                reference,
                references.HERTZ_SOURCE,
                reference * shape.study.value(name) / exact,
                100.0 * shape.study.uncertainty(name) / exact,
                tolerances.get(name),
                why
                if name in tolerances or not tolerances
                else "a finding: at the maximum of the shear its depth is ill defined",
            )
        )
    return rows


def on_each_mesh(shape: Shape, contact: Chosen) -> list[dict[str, float]]:
    """The quantities of one contact on each mesh, coarse to fine, by their names; SI units."""
    solved, own = hertz(shape.study.problem), hertz(contact.problem)
    return [
        {name: getattr(own, name) * getattr(each.mean, name) / getattr(solved, name) for name in READ}
        for each in shape.study.sequence
    ]


def mesh_entry(shapes: Iterable[Shape], elements: int) -> MeshRecord:
    """The finest mesh, as the record keeps it: the same block for all, stretched to each shape."""
    recipe = meshing.half_space(elements)
    return {
        "elements_per_semi_axis": elements,
        "dofs": max(shape.study.bodies.race.dofs for shape in shapes),
        "file": recipe.file_name,
        "geometry": "parabolic",
        "origin": meshing.origin(recipe),
    }
