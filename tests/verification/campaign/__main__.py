"""`python -m tests.verification.campaign`: random scenes of an envelope, each solved, classified and checked."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import Any

import click
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from tests.verification.campaign.campaign import run_campaign
from tests.verification.campaign.envelope import CHUNK, ENVELOPES, scene_file


@click.command(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.option("--envelope", type=click.Choice(list(ENVELOPES)), default="wild", show_default=True, help="Of scenes.")
@click.option("--count", type=click.IntRange(1), default=10_000, show_default=True, help="Scenes.")
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of the random numbers.")
@click.option("--out", type=click.Path(path_type=Path), help="Folder for journal, summary and scene files of failures.")
@click.option("--threads", type=click.IntRange(1), default=2, show_default=True, help="Worker processes.")
@click.option("--resume", is_flag=True, help="Go on with the campaign that the folder holds.")
@click.option("--scene", "named", metavar="CHUNK/INDEX", help="Only print this scene of the seed as a scene file.")
def main(envelope: str, count: int, seed: int, out: Path | None, threads: int, resume: bool, named: str | None) -> None:
    """Solve COUNT random scenes, classify and check every one. Exit codes: 0 bar met, 1 not met, 2 bad input."""
    if named is not None:
        print(scene_file(envelope, seed, scene_number(named)), end="")
        return
    folder = out or Path(tempfile.gettempdir()) / f"qsbearing-campaign-{envelope}-{seed}"
    columns = (
        BarColumn(bar_width=20),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.description}"),
    )
    with Progress(*columns, console=Console(stderr=True)) as progress:
        task = progress.add_task("", total=count)

        def show(scenes: int, listed: int) -> None:
            progress.update(task, completed=scenes, description=f"{listed} failed or not converged")

        try:
            summary = run_campaign(envelope, count, seed, folder, workers=threads, resume=resume, progress=show)
        except ValueError as error:
            progress.stop()
            click.echo(f"campaign: {error}", err=True)
            sys.exit(2)
    print(in_words(summary, folder))
    sys.exit(0 if summary["bar"]["met"] else 1)


def in_words(summary: dict[str, Any], folder: Path) -> str:
    """The summary's main lines."""
    refused, bar = summary["no_equilibrium"], summary["bar"]

    def listing(name: str, form: str = "") -> str:
        return ", ".join(f"{key} {value:{form}}" for key, value in summary[name].items())

    lines = [
        f"{summary['count']} {summary['envelope']} scenes of seed {summary['seed']} in {summary['seconds']:.0f} s, "
        f"digest {summary['digest']}",
        f"classes      {listing('classes')}",
        f"iterations   {listing('iterations_of_converged')}",
        f"             most: {summary['most_iterations']}",
        f"largest      {listing('largest', '.1e')}",
        f"certificates {refused['proofs']} proofs, {refused['evidence']} with evidence, {refused['without']} without",
        f"noted        {listing('noted')}",
        f"failures     {bar['failures']}",
        *(f"             {number} {what}" for what, number in summary["failures"].items()),
        f"bar          {'met' if bar['met'] else 'NOT MET'}: {bar['asked']}",
        f"everything in {folder}",
    ]
    return "\n".join(lines)


def scene_number(named: str) -> int:
    """The number of CHUNK/INDEX."""
    chunk, _, index = named.partition("/")
    if not (chunk.isdecimal() and index.isdecimal() and int(index) < CHUNK):
        raise click.BadParameter("write CHUNK/INDEX, such as 12/345", param_hint="--scene")
    return CHUNK * int(chunk) + int(index)


if __name__ == "__main__":
    main()
