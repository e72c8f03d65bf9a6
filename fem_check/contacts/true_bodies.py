"""Chosen contacts as true bodies, ball and ring segment with their real shapes: each meshed and solved for itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from fem_check.checks import true_geometry
from fem_check.checks.true_geometry import TrueContactStudy
from fem_check.contacts.chosen import Chosen
from fem_check.independent.references import ellipse
from fem_check.rows import row_text
from fem_check.rows.agreement import AgreementRow, Findings, Progress
from fem_check.solids.true_contact import READ

LEAST_ELEMENTS = 6
"""Of the finest mesh; those of true bodies lie farther apart than those of half-spaces."""


@dataclass(frozen=True)
class TrueBodies:
    """A contact, solved."""

    chosen: Chosen
    solved: TrueContactStudy
    undecided: tuple[str, ...]
    """Which of its rows the meshes are too coarse to judge."""

    @property
    def case(self) -> str:
        """Of its rows of agreement with Hertz."""
        return f"{self.solved.case}: true contact"


def solve(contacts: Sequence[Chosen], elements: int, progress: Progress) -> tuple[list[TrueBodies], Findings]:
    """Every contact against Hertz, and what its judgement rests on.

    Raises:
        MeshError: gmsh cannot mesh the bodies.
        ContactError: a contact cannot be solved.
    """
    bodies: list[TrueBodies] = []
    rows: list[AgreementRow] = []
    for each in contacts:
        own, undecided, solved = true_geometry.single(
            each.bearing, each.groove.name, each.groove, each.load, elements, progress
        )
        bodies.append(
            TrueBodies(each, solved, tuple(f"{row.case}, {row_text.in_words(row.quantity)}" for row in undecided))
        )
        rows += own
    last = bodies[-1].solved
    mesh = true_geometry.mesh_entry(last, elements)
    mesh |= {"geometry": "true", "origin": "made by gmsh"}
    return bodies, Findings(rows, mesh, last.solver, notes=true_geometry.NOTES)


def on_each_mesh(contact: TrueBodies) -> list[dict[str, float]]:
    """The quantities of one contact on each mesh, coarse to fine, as its rows have them of the finest; SI units."""
    solved, exact = contact.solved, ellipse(contact.chosen.problem)
    over_hertz = {
        name: [each[name] for each in solved.surface]
        if name == "approach"
        else solved.ratios("surface", "parabola", name)
        for name in READ
    }
    return [
        {name: getattr(exact, name) * values[mesh] for name, values in over_hertz.items()}
        for mesh in range(len(solved.surface))
    ]


def mesh_of(contact: TrueBodies) -> dict[str, Any]:
    """Of one contact, as the record keeps it."""
    finest = contact.solved.finest
    assert finest is not None
    return {"dofs": contact.solved.dofs, "files": [finest.contact.mesh_file(body) for body in ("ball", "ring")]}
