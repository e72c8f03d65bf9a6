"""`fem-check cost`: what accuracy costs."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import click

from fem_check.cli.output import FEM, LEVELS, progress_bar, refuse, require
from qsbearing.cli.output import print_table, print_text, print_wrote


@click.command("cost")
@click.option("--level", type=click.Choice(["quick", "release"]), default="quick", show_default=True, help=LEVELS)
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    default="fem_check_results",
    show_default=True,
    help="Folder of results; the record and its picture are written into its folder `cost`.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the record as JSON, and nothing else.")
def cost(level: str, out: Path, as_json: bool) -> None:
    """Measure error, time and memory for element families and meshes.

    Exit codes: 0 measured, 2 bad input or a missing dependency.
    """
    require(*FEM)
    from concurrent.futures.process import BrokenProcessPool

    from fem_check import meshing
    from fem_check.cost import measurement, picture, record, table
    from fem_check.rows.agreement import MeshLevel
    from fem_check.running import records_store, runner

    path = record.path_of(level, out)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=path.parent).close()  # before the work, not after it
        finest = max(max(counts) for counts in measurement.MESHES[MeshLevel(level)].values())
        runner.refuse_too_large(meshing.half_space(finest).dofs, f"cost at level {level}")
        with progress_bar(as_json) as reporter:
            measured = measurement.measure(MeshLevel(level), reporter("cost"))
        records_store.replace(path, records_store.text(measured))
        records_store.replace(path.with_suffix(".png"), picture.png(measured))
    except BrokenProcessPool:
        refuse("the system ended a process that solved a contact; a likely cause is that the memory ran out")
    except (meshing.MeshError, runner.BadInputError, ValueError) as problem:
        refuse(str(problem))
    except OSError as problem:
        refuse(f"--out {out}: {path.parent} cannot be written: {problem.strerror or problem}")
    if as_json:
        print(json.dumps(measured))
        return
    for each in (table.measured(measured), table.mesh_choices(measured)):
        print_table([each])
    print_text(f"{table.remark(measured)}\n")
    print_wrote([path])
