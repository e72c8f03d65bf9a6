"""`qsbearing compare`: several bearings at the same job."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from typing import TYPE_CHECKING

import click

from qsbearing.cli.files import claimed, csv_problems, picture_bytes, picture_problems, write_files
from qsbearing.cli.output import UNSOLVED, print_table, warnings_as_notes
from qsbearing.cli.scene import solving
from qsbearing.cli.settings import settings_of

if TYPE_CHECKING:
    from qsbearing.documents.model import Block, Cell
    from qsbearing.studies.design.compare import Compared, Comparison, OtherValue

PICTURED = (
    "inner_max_pressure_max", "outer_max_pressure_max", "ring_effective_stiffness_axial",
    "ring_effective_stiffness_radial_y", "shaft_effective_stiffness_axial", "shaft_effective_stiffness_radial_y",
    "life_duration", "outer_required_friction_max", "friction_power", "ring_displacement_axial",
    "ring_displacement_radial_y", "inner_load_max",
)  # fmt: skip
PANELS = 6
BESIDE = 2
"""Bearings beside the first in one table, so that no number is cut off."""


@click.command(short_help="Compare several bearings under the same loads.")
@click.argument("scenes", nargs=-1, required=True)
@click.option(
    "--at",
    metavar="SCENE",
    help="A scene whose operation, preload, effects, readings and requirements are used for all bearings.",
)
@click.option(
    "--set",
    "settings",
    multiple=True,
    metavar="[N:]KEY=VALUE",
    help="Another value for a key: operation.speed_rpm=12000 of the job that all share, bearing.ball_count=15 of every "
    "scene, 2:bearing.ball_count=15 of the second scene alone. Repeat it for each further key.",
)
@click.option("--csv", "csv_target", metavar="FILE", help="Also write the table.")
@click.option("--plot", "plot_target", metavar="FILE", help="Also draw the main results; .png, .svg or .pdf.")
def compare(
    scenes: tuple[str, ...],
    at: str | None,
    settings: tuple[str, ...],
    csv_target: str | None,
    plot_target: str | None,
) -> None:
    """Solve the bearings of SCENES, files or names of the catalogue, under the same loads: those of --at, or those of
    the first scene.

    Differences of more than 1 % from the first bearing are shown beside the numbers.

    Exit codes: 0 all are solved, 1 some are not, 2 bad input.
    """
    from qsbearing.documents.model import Paragraph
    from qsbearing.files.csv_table import csv_bytes
    from qsbearing.model.validation import SceneError
    from qsbearing.studies.design.compare import job_of, solved

    problems = csv_problems(csv_target) + picture_problems(plot_target)
    with ExitStack() as stack:
        try:
            with warnings_as_notes():
                job = job_of(scenes, at, _settings(settings))
        except SceneError as error:
            problems.append(str(error))
        writers = claimed(stack, {"--csv": csv_target, "--plot": plot_target}, problems)
        with solving():
            comparison = solved(job)
        lines = [Paragraph(f"Set: {file}: {each}", "Set:") for file, each in job.changes]
        print_table([*lines, *_tables(comparison)])
        make = {
            "--csv": lambda: csv_bytes(_columns(comparison)),
            "--plot": lambda: _picture(comparison, plot_target or ""),
        }
        write_files(writers, make)
    if not comparison.all_solved:
        sys.exit(UNSOLVED)


def _settings(texts: tuple[str, ...]) -> list[OtherValue]:
    """Keys, their values, and the scene that each is meant for."""
    if not texts:
        return []
    from qsbearing.model.validation import whole_number
    from qsbearing.studies.design.compare import OtherValue

    numbers, pairs = [], []
    for text in texts:
        head, colon, rest = text.partition(":")
        number = whole_number(head) if colon else None
        numbers.append(number)
        pairs.append(text if number is None else rest)
    return [OtherValue(number, *pair) for number, pair in zip(numbers, settings_of(pairs), strict=True)]


def _tables(comparison: Comparison) -> list[Block]:
    from qsbearing.documents.model import Paragraph, Table
    from qsbearing.model.solution.result_keys import printed_unit
    from qsbearing.results import remarks

    given = [(name, f"{value:.7g}", printed_unit(unit)) for name, value, unit in comparison.conditions]
    parts: list[Block] = [Table(("key", "value", "unit"), given, "lrl", f"Operating point of {comparison.job}")]
    parts = [*_requirements(comparison), *parts]
    others = range(1, len(comparison.labels))
    blocks = [[0, *others[start : start + BESIDE]] for start in range(0, len(others), BESIDE)]
    at = f"Results at the operating point of {comparison.job}"
    for title, lines in (("Bearings", comparison.inputs), (at, comparison.results)):
        for block in blocks:
            heading = ("", *(comparison.labels[i] for i in block), "unit")
            rows = [("status", *(comparison.statuses[i] for i in block), "")] if lines is comparison.results else []
            for line in lines:
                rows.append((line.name, *(_cell(line, i) for i in block), printed_unit(line.unit)))
            parts.append(Table(heading, rows, f"l{'r' * len(block)}l", title))
    note = "In brackets: the difference from the first bearing, where it is more than 1 % and both have one sign."
    return [*parts, Paragraph(note, is_apart=True), *remarks.blocks(comparison.remarks, is_apart=True)]


def _requirements(comparison: Comparison) -> list[Block]:
    """Who meets what; nothing where the job requires nothing."""
    from qsbearing.documents.model import Table
    from qsbearing.model.solution.result_keys import printed_unit
    from qsbearing.results.requirements import as_badge, name_of, requested_for

    if not comparison.required:
        return []
    rows: list[tuple[Cell, ...]] = [
        (
            name_of(each[0]),
            f"{requested_for(each[0].limit)} {printed_unit(each[0].limit.unit)}".rstrip(),
            *map(as_badge, each),
        )
        for each in comparison.required
    ]
    return [
        Table(
            ("required", "asked", *comparison.labels),
            rows,
            caption="Requirements",
            align="ll" + "l" * len(comparison.labels),
        )
    ]


def _cell(line: Compared, number: int) -> str:
    from qsbearing.pictures.side_by_side import MARKED

    value, difference = line.values[number], line.difference(number)
    text = "" if value != value else f"{value:.5g}"
    return f"{text} ({100.0 * difference:+.0f} %)" if abs(difference) > MARKED else text


def _columns(comparison: Comparison) -> dict[str, list[object]]:
    from qsbearing.results.requirements import requested_for

    lines = (*comparison.inputs, *comparison.results)
    columns: dict[str, list[object]] = {
        "quantity": ["status", *(line.name for line in lines)],
        "unit": ["", *(line.unit for line in lines)],
    }
    columns["quantity"] += [f"{each[0].limit.name} {requested_for(each[0].limit)}" for each in comparison.required]
    columns["unit"] += [each[0].limit.unit for each in comparison.required]
    for i, label in enumerate(comparison.labels):
        own = [str(each[i].state) for each in comparison.required]
        columns[label] = [comparison.statuses[i], *(line.values[i] for line in lines), *own]
    return columns


def _picture(comparison: Comparison, target: str) -> bytes:
    from qsbearing.pictures.side_by_side import side_by_side

    lines = {line.name: line for line in comparison.results}
    chosen = [lines[name] for name in PICTURED if name in lines][:PANELS] or list(comparison.results)[:PANELS]
    panels = [(line.name, line.unit, line.values) for line in chosen]
    return picture_bytes(
        side_by_side(comparison.labels, panels, f"All at the operating point of {comparison.job}"), target
    )
