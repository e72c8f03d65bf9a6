"""`qsbearing import`: a REXS model of a gearbox or spindle as scene files."""

from __future__ import annotations

import sys

import click

from qsbearing.cli.files import fill, folder
from qsbearing.cli.output import UNSOLVED, print_text, print_wrote, refuse


@click.command("import", short_help="Make scene files of a REXS model.")
@click.argument("model")
@click.option("--shaft", metavar="NAME", help="Only this shaft and its bearings, by its name or id.")
@click.option("--out", required=True, metavar="DIR", help="Write the scene files into this folder.")
def import_model(model: str, shaft: str | None, out: str) -> None:
    """Make scene files of MODEL, a gearbox or spindle in REXS 1.0 to 2.0.0: .rexs (XML), .rexsj (JSON), .rexsz (ZIP).

    One file for each ball bearing, one for each shaft on such bearings, and one of each for every load case. What is
    assumed stands as a comment beside it. What is not modelled (rollers, gears, springs) is listed, and so is what a
    file lacks before it can be solved. `qsbearing run FILE --into MODEL` writes results back.

    Exit codes: 0 some file can be solved as it is, 1 none can, 2 bad input.
    """
    from pathlib import Path

    from qsbearing.files.rexs.importing import import_model as imported
    from qsbearing.model.validation import SceneError, printable

    try:
        converted = imported(Path(model), shaft)
    except SceneError as error:
        refuse(str(error))
    into = folder(out)
    makers = {into / each.name: lambda texts, name=each.name: texts[name].encode() for each in converted.files}
    fill(makers, lambda: {each.name: each.text for each in converted.files})
    alike: dict[tuple[str, ...], list[str]] = {}
    for file in converted.files:
        alike.setdefault(tuple(file.lacks), []).append(file.name)
    lines = []
    for lacks, names in alike.items():
        if lacks:
            lines += [f"{', '.join(names)}: missing", *(f"    {each}" for each in lacks)]
    if converted.not_ours:
        lines += ["not modelled:", *(f"    {each}" for each in converted.not_ours)]
    if converted.unread:
        lines += ["not read:", *(f"    {each}" for each in converted.unread)]
    if not converted.files:
        lines.append("no ball bearing that is modelled")
    print_wrote(makers)
    print_text("".join(f"{printable(line)}\n" for line in [*lines, *converted.remarks]))
    if all(file.lacks for file in converted.files):
        sys.exit(UNSOLVED)
