"""`fem-check run`: checks, their tables and records."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import click
from rich.console import Console

from fem_check.cli.agreement_table import agreement_table
from fem_check.cli.output import FEM, OUT_OF_TOLERANCE, RESULTS, progress_bar, refuse, require


@click.command("run")
@click.argument("names", nargs=-1, metavar="[CHECK ...]")
@click.option("--level", type=click.Choice(["quick", "release"]), default="quick", show_default=True)
@click.option("--scene", default=None, help="Your bearing: a scene file (TOML) or a name of the catalogue.")
@click.option("--out", default=RESULTS, show_default=True, type=click.Path(path_type=Path, file_okay=False))
@click.option("--json", "as_json", is_flag=True, help="One record per line on stdout, and nothing else.")
def run_checks(names: tuple[str, ...], level: str, scene: str | None, out: Path, as_json: bool) -> None:
    """Run checks, all by default, on B218 or on a bearing of yours.

    Prints each comparison with its reference and keeps the records in a folder.
    """
    require(*FEM)
    from fem_check import runner
    from fem_check.agreement import EXAMPLE, Level

    finished: list[str] = []
    failed = False
    console = Console()
    try:
        chosen = runner.selected(names)
        with progress_bar(as_json) as reporter:
            for entry in runner.run(chosen, Level(level), out, lambda check: reporter(check.name), scene or EXAMPLE):
                failed |= entry["verdict"] != "pass"
                finished.append(entry["check"])
                if as_json:
                    print(json.dumps(entry), flush=True)
                else:
                    console.print(agreement_table(entry))
    except runner.BadInputError as problem:
        refuse(str(problem) + _kept(finished, out))
    except KeyboardInterrupt:
        refuse("interrupted" + _kept(finished, out))
    except OSError as problem:
        refuse(f"the records in {out} cannot be written: {problem}")
    if not as_json:
        console.print(f"records: {out / level}", soft_wrap=True, highlight=False)
    sys.exit(OUT_OF_TOLERANCE if failed else 0)


def _kept(finished: list[str], out: Path) -> str:
    return f"\nrecords of {', '.join(finished)} are kept in {out}" if finished else ""
