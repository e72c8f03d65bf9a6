"""`qsbearing find`: the numbers of a scene that meet goals and limits."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from typing import Any

import click

from qsbearing.cli.output import UNSOLVED, print_table, print_text, refuse, warnings_as_notes
from qsbearing.cli.picture_file import form_of
from qsbearing.cli.progress import progress_bar
from qsbearing.cli.sweep_problems import picture_problems

MOST_POINTS = 100_000_000


@click.command(short_help="Find the numbers of a scene that meet goals and limits.")
@click.argument("scene")
@click.option(
    "--vary", multiple=True, metavar="KEY=RANGE", help="A numeric key of the scene file and what it may take: "
    "LOW:HIGH, LOW:HIGH:log or A,B,C. Again for each further key, up to six; ball_count takes whole numbers.",
)  # fmt: skip
@click.option("--goal", "goals", multiple=True, metavar="NAME=VALUE", help="A result that shall have this value.")
@click.option(
    "--limit", "limits", multiple=True, metavar="NAME<=VALUE", help="A result's upper limit, or with >= its lower one."
)
@click.option("--minimise", metavar="NAME", help="A result to make as small as the limits allow.")
@click.option("--maximise", metavar="NAME", help="A result to make as large as the limits allow.")
@click.option(
    "--points", type=click.IntRange(1, MOST_POINTS), metavar="N", help="Points of the sample over all ranges."
)
@click.option("--seed", type=click.IntRange(0), default=0, metavar="N", help="Of the sample; 0 if not given.")
@click.option(
    "--json", "as_json", is_flag=True, help="Print one JSON object, from which `qsbearing run` solves the result."
)
@click.option(
    "--plot", "target", metavar="FILE", help="Draw the feasible region over the first two ranges; .png, .svg or .pdf."
)
def find(scene: str, vary: tuple[str, ...], as_json: bool, target: str | None, **asked: Any) -> None:
    """Look for the numbers of SCENE that meet goals and limits, with the least or most of a result.

    Results are those of `qsbearing sweep`, such as effective_stiffness_radial_y, inner.max_pressure_MPa or
    life.basic_duration_h, in their units; of all balls the one that is worst off.

    Exit codes: 0 found, 1 no point meets all (the nearest is shown, and what fails), 2 bad input.
    """
    from qsbearing.design import shown
    from qsbearing.design.find import find as search
    from qsbearing.io.output_file import output_file
    from qsbearing.validation import SceneError

    problems = picture_problems(target)
    varied: dict[str, str] = {}
    for text in vary:
        key, equals, values = text.partition("=")
        if not equals or key.strip() in varied:
            problems.append(f"--vary {text}: " + ("is varied twice" if equals else "write KEY=LOW:HIGH or KEY=A,B,C"))
        varied[key.strip()] = values
    with ExitStack() as stack:
        try:
            write = stack.enter_context(output_file(target)) if target is not None and not problems else None
            with warnings_as_notes(), progress_bar() as progress:
                found = search(scene, varied, progress=progress, **asked)
            if problems:
                refuse("\nqsbearing: ".join(problems))
            if as_json:
                import json

                print_text(json.dumps(shown.record(found), indent=1, allow_nan=False) + "\n")
            else:
                print_table(shown.tables(found))
            if write is not None and target is not None:
                from io import BytesIO

                data = BytesIO()
                shown.picture(found).savefig(data, format=form_of(target)[1:])
                write(data.getvalue())
        except SceneError as error:
            refuse("\nqsbearing: ".join([*problems, str(error)]))
        except OSError as error:
            refuse(f"cannot write: {error.strerror or error}")
    if not found.is_feasible:
        sys.exit(UNSOLVED)
