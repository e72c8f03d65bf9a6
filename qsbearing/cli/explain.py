"""`qsbearing explain`: which effects and choices a scene or set calls for, and why."""

from __future__ import annotations

import importlib
import json
import sys
from typing import TYPE_CHECKING

import click

from qsbearing.cli.ball_sets import blocks_of_lists
from qsbearing.cli.output import UNSOLVED, note, print_table, print_text, refuse
from qsbearing.cli.scene import load_one, solving
from qsbearing.cli.settings import set_option, told, with_changes
from qsbearing.model.accuracy import ALLOWED, DEFAULT_ACCURACY, is_allowed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from qsbearing.documents.model import Block
    from qsbearing.studies.chooser.explain import Assessment
    from qsbearing.studies.chooser.explained import Explained

HEADINGS = ("angles\n%", "loads\n%", "press.\n%", "displ.\nµm", "stiffn.\n%")
"""Of `QUANTITIES`, in their order."""


@click.command(short_help="Show which effects a scene needs, and how much each matters.")
@click.argument("scene")
@set_option
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object instead of a table, and nothing else.")
@click.option("--verify", is_flag=True, hidden=True, help="Solve with and without each; this is always done.")
@click.option(
    "--tolerance",
    type=float,
    default=DEFAULT_ACCURACY,
    show_default=True,
    help="Relative change below which an effect is not needed.",
)
def explain(scene: str, settings: tuple[str, ...], as_json: bool, verify: bool, tolerance: float) -> None:
    """Show for every effect and choice, named by SCENE or not, how much it matters at this operating point.

    The scene is solved with and without each of them. The table shows the change of contact angles, loads, pressures,
    displacement and stiffness, where the solver runs compiled the solve time with the effect over that without it, and
    a verdict: needed; not needed; likely needed, but input data are missing (the changes are then those with usual
    parameters, after ≈); or not assessed, with the reason. The indicator is a dimensionless number that governs the
    influence of the effect.

    For a set of rows, sentences before the table say how speed and loads change its preload.

    Exit codes: 0 explained, 1 the scene has no solution, 2 bad input.
    """
    from qsbearing.remarks.of_solution import message
    from qsbearing.studies.chooser.explained import explained

    if not is_allowed(tolerance):
        refuse(f"--tolerance {tolerance:g}: a relative change, {ALLOWED} (0.01 is one per cent)")
    loaded, document, changes = load_one(scene, settings)
    # Its readings need it, and one of before 2024 loads scipy.linalg, which `solving` puts out of reach.
    importlib.import_module("scipy.special")
    with solving():
        explanation = explained(loaded, tolerance)
    if as_json:
        print_text(json.dumps(with_changes(explanation.record, changes), indent=1, allow_nan=False) + "\n")
    else:
        print_table([*told(changes), *_shown(explanation, tolerance), *blocks_of_lists(document, loaded)])
    if not explanation.solution.converged:
        note(message(explanation.solution))
        sys.exit(UNSOLVED)


def _shown(explanation: Explained, tolerance: float) -> list[Block]:
    from qsbearing.documents.model import Paragraph
    from qsbearing.model.solution.solution import Solution
    from qsbearing.results.remarks import blocks
    from qsbearing.results.set_record import set_record
    from qsbearing.results.set_report import heading, rows_tables

    solution = explanation.solution
    after = [*_effects(explanation.rows, tolerance), *blocks(explanation.remarks, is_apart=True)]
    if isinstance(solution, Solution):
        return after
    of_set = set_record(solution, [{}] * len(solution.rows))
    if not solution.converged:
        return heading(solution, of_set)
    told = [Paragraph(each, is_apart=number == 0) for number, each in enumerate(explanation.record["preload"])]
    return [*heading(solution, of_set), *rows_tables(of_set), *told, *after]


def _effects(rows: Sequence[Assessment], tolerance: float) -> list[Block]:
    """What leaving each out changes, found by solving; with usual parameters, after ≈, where its own are not known.
    Below: why a verdict cannot be given, and how to include what is needed."""
    from qsbearing.documents.model import Paragraph, Table
    from qsbearing.model.effects import QUANTITIES
    from qsbearing.studies.chooser.explain import two_digits

    title = f"Effects and choices: change if left out (≈ usual parameters); needed if more than {100 * tolerance:g} %"
    has_indicator = any(row.indicator is not None for row in rows)  # those of a set have none
    is_timed = any(row.time_with_over_without is not None for row in rows)
    more = [*(["indicator"] if has_indicator else []), *(["time"] if is_timed else [])]
    headings = ("", "in\nscene", *HEADINGS, "verdict", *more)
    cells, said = [], []
    for row in rows:
        ratio = two_digits(row.time_with_over_without)
        own = [two_digits(row.indicator)] if has_indicator else []
        own += ["-" if ratio == "-" else f"x{ratio}"] if is_timed else []
        changes, verdict = map(row.change, QUANTITIES), row.verdict.replace(", ", ",\n")
        cells.append((row.effect, "yes" if row.in_scene else "no", *changes, verdict, *own))
        if row.why or (row.add and row.verdict == "needed"):
            is_lacking = row.add and row.verdict == "needed"
            lines = f"to include it, under [effects]: {', '.join(row.add)}" if is_lacking else ""
            said.append(f"{row.effect}: {'; '.join(each for each in (row.why, lines) if each)}")
    spare = range(len(headings) - 1, len(headings) - len(more) - 1, -1)
    table = Table(headings, cells, f"ll{'r' * len(HEADINGS)}l{'r' * len(more)}", title, spare=spare)
    return [table, *(Paragraph(each, is_apart=number == 0) for number, each in enumerate(said))]
