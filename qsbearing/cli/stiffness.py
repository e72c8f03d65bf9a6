"""`qsbearing stiffness`: the stiffness of a bearing over speed and load, for programs of rotor dynamics."""

from __future__ import annotations

import sys
from contextlib import ExitStack

import click

from qsbearing.cli.files import claimed, write_files
from qsbearing.cli.output import UNSOLVED, print_text, refuse
from qsbearing.cli.vary import study_of, vary_option


@click.command(short_help="Tabulate stiffness over speed and load, for rotor dynamics.")
@click.argument("scene")
@vary_option
@click.option("--mirrored", is_flag=True, help="The bearing is mounted the other way round on the shaft.")
@click.option("--out", metavar="FILE", help="Write the table to this CSV file instead of printing it.")
def stiffness(scene: str, vary: tuple[str, ...], mirrored: bool, out: str | None) -> None:
    """Tabulate the stiffness of SCENE for rotor dynamics: kxx, kxy, ... in N/m over the speed in rad/s, as CSV.

    The shaft turns about z: x, y, z of the table are y, z, x of the scene. For instance: qsbearing stiffness 7210c
    --vary speed_rpm=0:24000:13 --vary axial_load_N=240,720,1440 --out 7210c.csv

    Exit codes: 0 some point is solved, 1 none is, 2 bad input.
    """
    from qsbearing.files.csv_table import csv_bytes
    from qsbearing.model.validation import SceneError
    from qsbearing.studies.stiffness import stiffness_of

    with ExitStack() as stack:
        writers = claimed(stack, {"--out": out}, [])
        try:
            columns = stiffness_of(study_of(scene, vary, {}), mirrored=mirrored)
        except SceneError as error:
            refuse(str(error))
        text = csv_bytes(columns)
        write_files(writers, {"--out": lambda: text})
        if not writers:
            print_text(text.decode())
    if not (columns["status"] == "converged").any():
        sys.exit(UNSOLVED)
