"""`fem-check release`: the gate on the command line."""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import click

from qsbearing.cli.ended import INTERRUPTED
from qsbearing.cli.output import BAD_INPUT, note

if TYPE_CHECKING:
    from fem_check.release.gate import StepVerdict

FAILED = 1
REASONS = 5
"""Shown of each step in the table; all of them with `--json`."""


@click.command("release")
@click.option(
    "--level",
    type=click.Choice(["quick", "release"]),
    default="release",
    show_default=True,
    help="release has finer meshes and takes much longer.",
)
@click.option(
    "--out",
    default="release_results",
    show_default=True,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder of results.",
)
@click.option(
    "--previous",
    metavar="DIR|TAG",
    help="Records to compare with: a folder or a tag; by default those in the repository.",
)
@click.option(
    "--workers",
    type=click.IntRange(min=1),
    default=2,
    show_default=True,
    help="Processes that share the steps which need one core.",
)
@click.option("--resume", is_flag=True, help="Continue an interrupted run of the same commit and level.")
@click.option("--keep", is_flag=True, help="If all hold, put the new records into the repository.")
@click.option("--json", "as_json", is_flag=True, help="Print the verdicts as JSON, and nothing else.")
def release(level: str, out: Path, previous: str | None, workers: int, resume: bool, keep: bool, as_json: bool) -> None:
    """Run everything that must hold before a release.

    Needs a checkout without uncommitted changes.

    Exit codes: 0 all hold, 1 something fails, 2 it cannot be run.
    """
    try:
        import skfem  # noqa: F401  the checks import it when they solve

        from fem_check.release import gate, steps, tree
        from fem_check.release import previous as previous_records
        from fem_check.rows.agreement import MeshLevel
        from fem_check.running.records_store import RecordError
    except ImportError as problem:
        _refuse(f"{problem}: the gate needs `pip install -e '.[dev]'`")
    try:
        root, listed = tree.root(), steps.all_steps(MeshLevel(level))
        tree.refuse_inside(root, out.resolve())
        with previous_records.opened(root, previous) as before:
            place = steps.GateFolders(root, MeshLevel(level), out.resolve(), tree.head(root), before.folder)
            verdicts = gate.before_all(listed, place, before)
            runs = all(each.passes for each in verdicts)
            if runs:
                journal = gate.resumed(place, listed) if resume else {}
                if not journal:
                    shutil.rmtree(place.gate, ignore_errors=True)
                gate.run(listed, place, journal, lambda said: click.echo(said, err=True), workers)
                verdicts = gate.all_judged(listed, place, journal, before)
        passes = all(each.passes for each in verdicts)
        _show(verdicts, as_json, f"{'pass' if passes else 'FAIL'}{'' if runs else ': nothing was run'}")
        if keep and passes:
            written = gate.keep(listed, place)
            click.echo(f"{len(written)} records are now those of {root}: commit them and nothing else", err=True)
    except (tree.TreeError, RecordError, steps.StepError) as problem:
        _refuse(str(problem))
    except OSError as problem:
        _refuse(f"{out} cannot be written: {problem}")
    except KeyboardInterrupt:
        _refuse(f"interrupted; `fem-check release --level {level} --out {out} --resume` goes on", INTERRUPTED)
    sys.exit(0 if passes else FAILED)


def _show(verdicts: list[StepVerdict], as_json: bool, last: str) -> None:
    """Step, verdict, why, and how to run it again; with `--json` the same as data."""
    if as_json:
        print(json.dumps([each.as_dict() for each in verdicts]))
        return
    for each in verdicts:
        click.echo(f"{'pass' if each.passes else 'FAIL'}  {each.step}: {each.said}  [{each.command}]")
        for reason in each.reasons[:REASONS]:
            click.echo(f"      {reason}")
        if len(each.reasons) > REASONS:
            click.echo(f"      and {len(each.reasons) - REASONS} more")
    click.echo(last)


def _refuse(message: str, code: int = BAD_INPUT) -> NoReturn:
    """Say why nothing is run, on stderr, and stop with the exit code for bad input, or another."""
    note(message, "fem-check")
    sys.exit(code)
