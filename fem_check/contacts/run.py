"""Chosen contacts solved by one of the two models, and what files of them are made from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, cast

from fem_check.checks import true_geometry
from fem_check.contacts import files, half_spaces, record, true_bodies
from fem_check.contacts.chosen import Chosen
from fem_check.elements.fields import NodalFields
from fem_check.rows.agreement import Findings, Progress
from fem_check.rows.record import MeshRecord


@dataclass(frozen=True)
class SolvedContacts:
    """Contacts, solved."""

    findings: Findings
    known: record.Known
    """Entries of the record beside the findings: bearing, elements, contacts."""
    maps: Callable[[], list[dict[str, Any]]]
    """Makes the numbers of the pressure maps."""
    fields: Callable[[], Iterable[tuple[str, NodalFields]]]
    """Makes the fields, each with the name of its file."""


def of_half_spaces(
    contacts: Sequence[Chosen], sequence: tuple[int, ...], accuracy: float | None, progress: Progress
) -> SolvedContacts:
    """Half-spaces on a sequence of meshes.

    Args:
        contacts: what is solved.
        sequence: elements per semi-axis, coarse to fine; the last gives the result, all of them its uncertainty.
        accuracy: tolerance of the quantities that it applies to; None: the level's own tolerances.
        progress: progress callback.

    Raises:
        MeshError: a mesh cannot be read or made.
        ContactError: a contact cannot be solved.
    """
    shapes = half_spaces.solve(contacts, sequence, progress)
    return SolvedContacts(
        half_spaces.findings(shapes, sequence[-1], accuracy),
        record.of_half_spaces(contacts, shapes, sequence),
        lambda: record.pressures_of_half_spaces(shapes),
        lambda: files.fields_of_half_spaces(contacts, shapes),
    )


def of_both(contacts: Sequence[Chosen], sequence: tuple[int, ...], elements: int, progress: Progress) -> SolvedContacts:
    """Half-spaces and true bodies; arguments and errors as theirs."""
    half, true = of_half_spaces(contacts, sequence, None, progress), of_true_bodies(contacts, elements, progress)
    mesh = {**half.findings.mesh, "geometry": "both", "true_dofs": true.findings.mesh["dofs"]}
    findings = Findings(
        [*half.findings.rows, *true.findings.rows], cast(MeshRecord, mesh), half.findings.solver,
        notes=true.findings.notes,
    )  # fmt: skip
    return SolvedContacts(
        findings,
        record.of_both(half.known, true.known),
        lambda: [*_named("half-spaces", half.maps()), *_named("true bodies", true.maps())],
        lambda: [*half.fields(), *true.fields()],
    )


def _named(what: str, maps: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Maps that say what they are of."""
    return [{**each, "contact": {**each["contact"], "name": f"{each['contact']['name']}, {what}"}} for each in maps]


def of_true_bodies(contacts: Sequence[Chosen], elements: int, progress: Progress) -> SolvedContacts:
    """True bodies, with so many elements per semi-axis of the finest mesh.

    Raises:
        MeshError: gmsh cannot mesh the bodies.
        ContactError: a contact cannot be solved.
    """
    solved, findings = true_bodies.solve(contacts, elements, progress)
    return SolvedContacts(
        findings,
        record.of_true_bodies(solved, true_geometry.sequence(elements)),
        lambda: record.pressures_of_true_bodies(solved),
        lambda: files.fields_of_true_bodies(solved),
    )
