"""`fem-check release`: the gate on the command line."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import click

if TYPE_CHECKING:
    from fem_check.release.journal import Journal
    from fem_check.release.previous import Previous
    from fem_check.release.steps import Step

OUT = "release_results"
FAILED, BAD_INPUT = 1, 2


@click.command("release")
@click.option("--level", type=click.Choice(["quick", "release"]), default="release", show_default=True)
@click.option("--out", default=OUT, show_default=True, type=click.Path(path_type=Path, file_okay=False))
@click.option(
    "--previous",
    metavar="DIR|TAG",
    help="Records to compare with: a folder or a tag; those in the repository unless named.",
)
@click.option("--resume", is_flag=True, help="Go on with an interrupted gate of the same commit and level.")
@click.option("--again", "repeated", metavar="STEP", multiple=True, help="As --resume, but run this step again.")
@click.option("--dry-run", is_flag=True, help="Say what would be done and how long it takes, and do nothing.")
@click.option("--keep", is_flag=True, help="After a pass, make its records those in the repository.")
@click.option("--json", "as_json", is_flag=True, help="The verdicts on stdout, and nothing else.")
def release(
    level: str,
    out: Path,
    previous: str | None,
    resume: bool,
    repeated: tuple[str, ...],
    dry_run: bool,
    keep: bool,
    as_json: bool,
) -> None:
    """Run everything that must hold before a release.

    Needs a checkout without uncommitted changes. Exit codes: 0 all hold, 1 something fails, 2 it cannot be run.
    """
    try:
        import skfem  # noqa: F401  the checks import it when they solve

        from fem_check.agreement import Level
        from fem_check.records_store import RecordError
        from fem_check.release import journal, keeping, tree
        from fem_check.release import previous as previous_records
        from fem_check.release.steps import Place, all_steps
    except ImportError as problem:
        _refuse(f"{problem}: the gate needs `pip install -e '.[dev]'`")
    try:
        root = tree.root()
        place = Place(root, Level(level), out.resolve(), tree.head(root))
        keeping.check_out(place)
        steps = all_steps(place.level)
        unknown = set(repeated) - {step.name for step in steps}
        if unknown:
            _refuse(
                f"--again: no step {', '.join(sorted(unknown))}; there are {', '.join(step.name for step in steps)}"
            )
        with previous_records.opened(root, previous) as before:
            place = replace(place, previous=before.folder)
            kept = journal.resumed(place, steps, repeated) if resume or repeated else journal.Journal(place, {})
            passes = session(steps, kept, before, dry_run=dry_run, keep=keep, as_json=as_json)
    except (tree.TreeError, RecordError) as problem:
        _refuse(str(problem))
    except OSError as problem:
        _refuse(f"{out} cannot be written: {problem}")
    except KeyboardInterrupt:
        _refuse(f"interrupted; `fem-check release --level {level} --out {out} --resume` goes on")
    sys.exit(0 if passes else FAILED)


def session(
    steps: list[Step],
    kept: Journal,
    before: Previous,
    *,
    dry_run: bool = False,
    keep: bool = False,
    as_json: bool = False,
) -> bool:
    """Show the plan, run, judge, show; whether everything holds.

    Nothing is run where the tree is dirty or the previous records are not as they were kept: it would be for nothing.
    """
    from fem_check.release import display, gate, keeping

    console = display.console(as_json)
    place = kept.place
    seconds = {step.name: gate.expected(step, place, before) for step in steps}
    console.print(display.plan(steps, seconds, set(kept.steps), before.label))
    found = [gate.clean_tree(place), gate.previous_release(steps, place, before)]
    runs = not dry_run and all(each.passes for each in found)
    if runs:
        if not kept.steps:
            keeping.clear(place)
        with display.progress(steps, seconds, as_json) as (begin, end):
            for step, error in gate.run(steps, kept, begin):
                end(step, error)
        found = gate.verdicts(steps, kept, before)
        as_text = json.dumps([each.as_dict() for each in found], indent=1) + "\n"
        (place.gate / "verdicts.json").write_text(as_text, encoding="utf-8")
    passes = all(each.passes for each in found)
    if as_json:
        print(json.dumps([each.as_dict() for each in found]))
    else:
        console.print(display.final(found))
        console.print(f"{'pass' if passes else 'FAIL'}{'' if runs else ': nothing was run'}", soft_wrap=True)
    if keep and runs and passes:
        written = keeping.keep(kept)
        console.print(f"{len(written)} records are now those in {written[-1].parent}; commit them", soft_wrap=True)
    return passes


def _refuse(message: str) -> NoReturn:
    """Say why nothing is run, on stderr, and stop with the exit code for bad input."""
    click.echo(f"fem-check: {message}", err=True)
    sys.exit(BAD_INPUT)
