"""`qsbearing find`: the numbers of a scene that meet goals and limits."""

from __future__ import annotations

import json
import sys
from contextlib import ExitStack
from typing import Any

import click

from qsbearing.cli.ball_sets import blocks_of_lists, note_of_lists
from qsbearing.cli.files import claimed, picture_bytes, picture_problems, write_files
from qsbearing.cli.output import UNSOLVED, print_table, print_text, progress_bar, refuse, warnings_as_notes
from qsbearing.cli.settings import changed_read, set_option, told, with_changes
from qsbearing.cli.vary import pairs_of

MOST_POINTS = 100_000_000


@click.command(short_help="Find values of a scene's keys that meet goals and limits.")
@click.argument("scene")
@click.option(
    "--vary", multiple=True, metavar="KEY=RANGE", help="A numeric key of the scene file and its range: "
    "LOW:HIGH, LOW:HIGH:log or A,B,C. Repeat it for each further key, up to six; ball_count takes whole numbers.",
)  # fmt: skip
@set_option
@click.option("--goal", "goals", multiple=True, metavar="NAME=VALUE", help="A result that must have this value.")
@click.option(
    "--limit",
    "limits",
    multiple=True,
    metavar="NAME<=VALUE",
    help="Upper limit of a result, or with >= its lower limit.",
)
@click.option("--minimise", metavar="NAME", help="A result to make as small as the limits allow.")
@click.option("--maximise", metavar="NAME", help="A result to make as large as the limits allow.")
@click.option(
    "--points",
    type=click.IntRange(1, MOST_POINTS),
    metavar="N",
    help="Number of points over all ranges that the "
    "search begins with; it then solves some thousand more near the best of them.",
)
@click.option("--seed", type=click.IntRange(0), default=0, metavar="N", help="Seed of the sample; 0 if not given.")
@click.option(
    "--json",
    "as_json",
    is_flag=True,
    help="Print one JSON object, and nothing else; `qsbearing run` solves the point found in it.",
)
@click.option(
    "--plot",
    "target",
    metavar="FILE",
    help="Also draw the feasible region over the first two ranges; .png, .svg or .pdf.",
)
def find(
    scene: str, vary: tuple[str, ...], settings: tuple[str, ...], as_json: bool, target: str | None, **requested: Any
) -> None:
    """Find values of keys of SCENE that meet goals and limits, and that make a result as small or as large as possible.

    Results are those of `qsbearing sweep`, such as effective_stiffness_radial_y, inner.max_pressure_MPa or
    life.basic_duration_h, in their units; of a result of each ball, the worst ball counts.

    Exit codes: 0 found, 1 no point meets all (the nearest point is shown, and what it does not meet), 2 bad input.
    """
    from qsbearing.model.validation import SceneError
    from qsbearing.studies.design import shown
    from qsbearing.studies.design.find import prepared, searched

    problems = picture_problems(target)
    varied = pairs_of(vary, "write KEY=LOW:HIGH or KEY=A,B,C", problems)
    how = {name: requested.pop(name) for name in ("points", "seed")}
    with ExitStack() as stack:
        try:
            with warnings_as_notes():
                search, _, changes = changed_read(scene, settings, lambda read: prepared(read, varied, **requested))
        except SceneError as error:
            problems.append(str(error))
        writers = claimed(stack, {"--plot": target}, problems)
        try:
            with progress_bar() as progress:
                outcome = searched(search, **how, progress=progress)
        except SceneError as error:
            refuse(str(error))
        document = search.study.document
        if as_json:
            note_of_lists(document)
            print_text(json.dumps(with_changes(shown.record(outcome), changes), indent=1, allow_nan=False) + "\n")
        else:
            print_table([*told(changes), *shown.tables(outcome), *blocks_of_lists(document, outcome.scene)])
        write_files(writers, {"--plot": lambda: picture_bytes(shown.picture(outcome), target or "")})
    if not outcome.is_feasible:
        sys.exit(UNSOLVED)
