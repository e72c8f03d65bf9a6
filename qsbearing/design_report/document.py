"""The design report: its parts in their order."""

from __future__ import annotations

from typing import Any

from qsbearing import messages, provenance
from qsbearing.design_report import curves, effects, evidence, inputs
from qsbearing.documents.drawing import picture
from qsbearing.documents.from_rich import blocks as from_rich
from qsbearing.documents.model import Block, Cell, Document, Facts, Md, Paragraph, Remark, Section
from qsbearing.io import report
from qsbearing.pictures import contact_angles, contact_ellipses, load_distribution
from qsbearing.scene.scene import Scene
from qsbearing.solution import Solution

DEFAULT_TOLERANCE = 0.01


def document(solution: Solution, asked: Scene, source: str, command: str) -> Document:
    """The whole report of one solved case.

    Args:
        solution: of a single case, converged.
        asked: the scene as it was given.
        source: the text of its file; empty for an example of the catalogue.
        command: that makes this report.
    """
    scene = solution.scene
    name = scene.bearing.name or "Ball bearing"
    tolerance = asked.tolerance or DEFAULT_TOLERANCE
    readings = _taken(solution)
    warnings = [*messages.warnings(solution), *(each for one in readings.values() for each in _warnings_of(one))]
    return Document(
        name,
        "Design report",
        [
            inputs.section(scene, source),
            effects.section(solution, asked, tolerance),
            _results(solution),
            *_readings(readings),
            curves.section(solution),
            _warnings(warnings),
            evidence.section(solution),
        ],
        "Loads, angles, contacts and stiffness of one operating point by the quasi-static model of Jones and Harris.",
        [Remark(messages.message(solution), "pass"), *_count(warnings), Facts(_facts(command, solution))],
    )


def _count(warnings: list[str]) -> list[Block]:
    if not warnings:
        return []
    what = "One warning" if len(warnings) == 1 else f"{len(warnings)} warnings"
    return [Remark(Md(f"{what}, see [below](#warnings)."), "warning")]


def _facts(command: str, solution: Solution) -> list[tuple[str, Cell]]:
    made = provenance.of_run(command)
    machine = made["machine"]
    commit = made["commit"] or "none: an installed package"
    return [
        ("Date", made["date"]),
        ("qsbearing", made["qsbearing"]),
        ("Commit", commit + (", with changes that are not committed" if made["dirty"] else "")),
        ("Machine", f"{machine['processor']}, {machine['system']}, Python {machine['python']}"),
        ("Packages", ", ".join(f"{package} {version}" for package, version in made["packages"].items())),
        ("Command", Md(f"`{command}`")),
        ("Largest imbalance", f"{float(solution.residual):.1e} of the largest force"),
    ]


def _results(solution: Solution) -> Section:
    tables = from_rich(report.tables(solution))
    drawn = [
        picture(
            load_distribution(solution), "Polar picture of the contact loads of all balls around the bearing.",
            "Contact loads", 0.62,
        ),
        picture(contact_angles(solution), "Both contact angles of every ball by its azimuth.", "Contact angles", 0.8),
        picture(
            contact_ellipses(solution), "Outlines of the contact ellipses to one scale, with their greatest pressures.",
            "Contact ellipses",
        ),
    ]  # fmt: skip
    return Section("Results", [*tables, Section("Pictures", drawn)])


def _taken(solution: Solution) -> dict[str, Any]:
    """The readings that the scene asks for."""
    if not solution.scene.readings:
        return {}
    from qsbearing.readings.asked import take_asked

    return dict(take_asked(solution))


def _warnings_of(reading: Any) -> list[str]:
    return list(getattr(reading, "warnings", ()))


def _readings(readings: dict[str, Any]) -> list[Section]:
    if not readings:
        return []
    from qsbearing.io.readings_report import readings_tables

    found: list[Any] = readings_tables(readings)
    return [Section("Readings", [block for each in found for block in from_rich(each)])]


def _warnings(warnings: list[str]) -> Section:
    blocks: list[Block] = [Remark(each, "warning") for each in warnings]
    return Section("Warnings", blocks or [Paragraph("None.")])
