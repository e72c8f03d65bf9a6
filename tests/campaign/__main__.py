"""`python -m tests.campaign`: random scenes over the whole envelope, each solved, classified and checked."""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import click
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from tests.campaign.campaign import run_campaign

RECORDS = Path(__file__).with_name("records")


@click.command(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.option("--count", type=click.IntRange(1), default=10_000, show_default=True, help="Scenes.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of the random numbers.")
@click.option("--out", type=click.Path(path_type=Path), help="Folder for journal, summary and scene files of failures.")
@click.option("--threads", type=click.IntRange(1), default=2, show_default=True, help="Worker processes.")
@click.option("--resume", is_flag=True, help="Go on with the campaign that the folder holds.")
@click.option("--record", is_flag=True, help="Keep the summary under tests/campaign/records.")
@click.option("--scene", "named", metavar="CHUNK/INDEX", help="Only print this scene of the seed as a scene file.")
def main(count: int, seed: int, out: Path | None, threads: int, resume: bool, record: bool, named: str | None) -> None:
    """Solve COUNT random scenes, classify and check every one. Exit codes: 0 no failure, 1 some, 2 bad input."""
    if named is not None:
        print(scene_text(seed, named), end="")
        return
    folder = out or Path(tempfile.gettempdir()) / f"qsbearing-campaign-{seed}"
    columns = (
        BarColumn(bar_width=20),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.description}"),
    )
    with Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task("", total=count)

        def show(scenes: int, classes: dict[str, int]) -> None:
            bar.update(task, completed=scenes, description=f"{classes.get('failed', 0)} failed")

        try:
            summary = run_campaign(count, seed, folder, workers=threads, resume=resume, progress=show)
        except ValueError as error:
            bar.stop()
            click.echo(f"campaign: {error}", err=True)
            sys.exit(2)
    print(in_words(summary, folder))
    if record:
        RECORDS.mkdir(exist_ok=True)
        path = RECORDS / f"seed_{seed}_count_{count}.json"
        path.write_text(json.dumps(summary, indent=1) + "\n", encoding="utf-8")
        print(f"kept in {path}")
    sys.exit(1 if summary["failures_total"] else 0)


def in_words(summary: dict[str, Any], folder: Path) -> str:
    """The summary's main lines."""
    none = summary["no_equilibrium"]
    lines = [
        f"{summary['count']} scenes of seed {summary['seed']} in {summary['seconds']:.0f} s, "
        f"{summary['peak_memory_MB']} MB, digest {summary['digest']}",
        "classes      " + ", ".join(f"{name} {number}" for name, number in summary["classes"].items()),
        "iterations   " + ", ".join(f"{name} {n}" for name, n in summary["iterations_of_converged"].items()),
        f"             most: {summary['most_iterations']}",
        "largest      " + ", ".join(f"{name} {value:.1e}" for name, value in summary["largest"].items()),
        f"certificates {none['proofs']} proofs, {none['evidence']} with evidence, "
        f"{none['certificates'].get('none', 0)} without",
        "noted        " + ", ".join(f"{name} {number}" for name, number in summary["noted"].items()),
        f"failures     {summary['failures_total']}",
        *(f"             {number} {what}" for what, number in summary["failures"].items()),
        f"everything in {folder}",
    ]
    return "\n".join(lines)


def scene_text(seed: int, named: str) -> str:
    """The scene file of CHUNK/INDEX."""
    from tests.campaign.envelope import chunk_groups
    from tests.campaign.sizes import CHUNK, GROUP

    chunk, _, index = named.partition("/")
    if not (chunk.isdecimal() and index.isdecimal() and int(index) < CHUNK):
        raise click.BadParameter("write CHUNK/INDEX, such as 12/345", param_hint="--scene")
    group = chunk_groups(seed, int(chunk))[int(index) // GROUP]
    return group.toml(int(index) % GROUP, f"Campaign scene {seed}/{chunk}/{index}.")


if __name__ == "__main__":
    main()
