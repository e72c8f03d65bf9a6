"""`qsbearing figures`: the figures of the source paper and the maps beyond them."""

from __future__ import annotations

from pathlib import Path

import click

from qsbearing.cli.files import check_installed
from qsbearing.cli.output import print_table, print_text, refuse


@click.command(short_help="Make the figures of the source paper and check its statements.")
@click.option("--out", default="figures", show_default=True, metavar="DIR", help="Folder for pictures and results.")
def figures(out: str) -> None:
    """Reproduce Figs 19.4 to 19.7 of the source paper for B218, and maps beyond them.

    Each figure is made from a study file, which is written beside it; you can start your own studies from it. Each
    statement of the paper about a figure is checked: it holds, holds in a range, or does not hold.

    Exit codes: 0 made, 2 bad input.
    """
    check_installed("figures need", ("xarray", "h5netcdf", "matplotlib"), "studies")
    folder = Path(out)
    try:
        folder.mkdir(exist_ok=True)
        _make(folder)
    except OSError as error:
        refuse(f"--out {out}: {error.strerror or error}")


def _make(folder: Path) -> None:
    from importlib.resources import files

    from qsbearing.documents.model import Table
    from qsbearing.model.validation import printable
    from qsbearing.studies.paper.figures import FIGURES, made

    rows = []
    for figure in FIGURES:
        results, picture, judged = made(figure)
        picture.savefig(folder / f"{figure.name}.png")
        results.to_netcdf(folder / f"{figure.name}.nc", engine="h5netcdf")
        study = (files("qsbearing.studies.paper") / f"{figure.name}.toml").read_bytes()
        (folder / f"{figure.name}.toml").write_bytes(study)
        print_text(f"{printable(str(folder / figure.name))}.png  {figure.title}\n")
        for number, each in enumerate(judged):
            where = f": {_in_short(each.where)}" if each.where else ""
            name = figure.name if number == 0 else ""
            rows.append((name, each.statement.sentence, each.statement.source, f"{each.verdict}{where}"))
    print_text("\n")
    print_table([Table(("figure", "statement", "by", "verdict"), rows, "llll")])


LONGEST = 200
"""Characters of ranges that are shown whole; maps have one for each of their rows, of which three are shown."""


def _in_short(where: tuple[str, ...]) -> str:
    whole = "; ".join(where)
    return whole if len(whole) <= LONGEST else "; ... ".join(where[place] for place in (0, len(where) // 2, -1))
