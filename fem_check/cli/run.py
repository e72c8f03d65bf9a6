"""`fem-check run`: checks, their tables and records."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import click

from fem_check.cli.agreement_table import agreement_table
from fem_check.cli.contact_table import contact_tables
from fem_check.cli.output import FEM, LEVELS, OUT_OF_TOLERANCE, RESULTS, progress_bar, refuse, require
from fem_check.cli.ring_options import ring_options, set_ring_options
from qsbearing.cli.ended import INTERRUPTED
from qsbearing.cli.output import print_table, print_text
from qsbearing.model.validation import printable


@click.command("run", short_help="Run checks on B218, or on the bearing of --scene.")
@click.argument("names", nargs=-1, metavar="[CHECK ...]")
@click.option("--level", type=click.Choice(["quick", "release"]), default="quick", show_default=True, help=LEVELS)
@click.option("--scene", default=None, help="Your bearing: a scene file (TOML) or a name of the catalogue.")
@ring_options
@click.option(
    "--out",
    default=RESULTS,
    show_default=True,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for the records.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record per line, and nothing else.")
def run_checks(
    names: tuple[str, ...], level: str, scene: str | None, out: Path, as_json: bool, **rings: float | None
) -> None:
    """Run the named checks on B218, or all checks of the level if none is named. With --scene, check the most heavily
    loaded contacts of that bearing, or run the named checks on it.

    Prints each comparison with its reference and keeps the records in a folder.

    Exit codes: 0 all within tolerance, 1 a row is out of tolerance, 2 bad input or a missing dependency.
    """
    require(*FEM)
    from fem_check.checks import OF_BEARING
    from fem_check.rows.agreement import EXAMPLE, MeshLevel
    from fem_check.running import runner

    if scene is None and any(value is not None for value in rings.values()):
        refuse("options for dimensions of the rings need --scene: they belong to that bearing")
    set_ring_options(rings)

    finished: list[str] = []
    failed = False
    try:
        chosen = runner.selected(names, scene is not None, MeshLevel(level))
        with progress_bar(as_json) as reporter:
            for entry in runner.run(
                chosen, MeshLevel(level), out, lambda check: reporter(check.name), scene or EXAMPLE
            ):
                failed |= entry["verdict"] != "pass"
                finished.append(entry["check"])
                if as_json:
                    print(json.dumps(entry), flush=True)
                else:
                    print_table((contact_tables if entry["check"] in OF_BEARING else agreement_table)(entry))
    except runner.BadInputError as problem:
        refuse(str(problem) + _kept(finished, out))
    except KeyboardInterrupt:
        refuse("interrupted" + _kept(finished, out), INTERRUPTED)
    except OSError as problem:
        refuse(f"--out {out}: the records cannot be written: {problem.strerror or problem}")
    if not as_json:
        print_text(f"records: {printable(str(out / level))}\n")
    sys.exit(OUT_OF_TOLERANCE if failed else 0)


def _kept(finished: list[str], out: Path) -> str:
    return f"\nrecords of {', '.join(finished)} are kept in {out}" if finished else ""
