"""The design report: its parts in their order."""

from __future__ import annotations

from typing import Any

from qsbearing import messages, provenance
from qsbearing.design_report import curves, effects, evidence, inputs
from qsbearing.design_report.key_results import key_results
from qsbearing.documents.drawing import picture
from qsbearing.documents.from_rich import blocks as from_rich
from qsbearing.documents.model import Block, Cell, Document, Facts, Md, Remark, Section
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
            evidence.section(solution),
        ],
        "Loads, angles, contacts and stiffness of one operating point by the quasi-static model of Jones and Harris.",
        [
            Remark(messages.message(solution), "pass"),
            key_results(solution, readings),
            *_warnings(warnings),
            Facts(_facts(command)),
        ],
    )


def _warnings(warnings: list[str]) -> list[Block]:
    """In full, where nobody misses them."""
    return [Remark(f"Warning: {each}", "warning") for each in warnings] or [Remark("No warnings.")]


def _facts(command: str) -> list[tuple[str, Cell]]:
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
    ]


def _results(solution: Solution) -> Section:
    tables = from_rich(report.tables(solution))
    drawn = [
        picture(
            load_distribution(solution),
            "Polar picture of the contact loads of all balls around the bearing.",
            "Contact loads by the azimuth of each ball, 0 deg on the y axis",
            0.45,
        ),
        picture(
            contact_angles(solution),
            "Both contact angles of every ball by its azimuth.",
            "Contact angles by azimuth; the dotted line is the free contact angle",
            0.66,
        ),
        picture(
            contact_ellipses(solution),
            "Outlines of the contact ellipses to one scale, with their maximum pressures.",
            "Contact ellipses of each ball, with their maximum pressures",
        ),
    ]
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
