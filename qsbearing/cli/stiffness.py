"""`qsbearing stiffness`: the stiffness of a bearing over speed and load, for programs of rotor dynamics."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from typing import TYPE_CHECKING

import click

from qsbearing.cli.files import claimed, write_files
from qsbearing.cli.output import UNSOLVED, note, note_remark, print_text, refuse, refuse_all
from qsbearing.cli.settings import set_option, told
from qsbearing.cli.vary import study_of, vary_option

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from qsbearing.documents.model import Callout, Paragraph
    from qsbearing.studies.remarked import Look
    from qsbearing.systems.rotor_dynamics.model_frame import ModelFrame


LAST = "0.5.0"
"""The version with which some formats go."""
INSTEAD = {
    "mat": "json has the same matrices, which jsondecode of MATLAB and Octave reads",
    "abaqus": "calculix has the same springs, on a node that moves and one that turns",
    "ansys": "json has the matrix, of which MATRIX27 takes the symmetric part",
}
"""Formats that will go, and what to use in place of each."""
IN_MODEL = ("json", "calculix", "nastran")
"""Formats that --axis and --origin turn into a model's axes."""
NO_TANGENT = "the raceway control of some ball contradicts itself there: there is no stiffness"

NO_TILTS = "stiffness against tilts has no number where friction moves the balls: --format csv has the rest"


@click.command(short_help="Tabulate stiffness over speed and load, for rotor dynamics.")
@click.argument("scene")
@vary_option
@set_option
@click.option("--mirrored", is_flag=True, help="The bearing is mounted the other way round on the shaft.")
@click.option(
    "--format",
    "form",
    type=click.Choice(["csv", "json", "mat", "ross", "calculix", "nastran", "abaqus", "ansys"]),
    default="csv",
    help="csv: a table over speed and load. Of one operating point: json; ross (Python that makes "
    f"elements of ROSS); springs for CalculiX and Nastran. Until {LAST}: mat (MATLAB), abaqus and ansys.",
)
@click.option(
    "--units",
    type=click.Choice(["N-mm-t", "N-m-kg"]),
    help="Of the other formats; N-mm-t unless given, of ross N-m-kg.",
)
@click.option(
    "--frequency",
    metavar="LIST",
    help='Of loads, in Hz or times the shaft\'s speed, such as 0,1x,50: for raceway_control = "friction" under thrust, '
    "columns of the stiffness against loads that turn or pulsate at these frequencies.",
)
@click.option(
    "--axis",
    metavar="x|y|z|A,B,C",
    help="Of json, calculix and nastran: the direction of the shaft, +x of the scene, in your model.",
)
@click.option(
    "--origin",
    metavar="X,Y,Z",
    help="Likewise: the point of your model from which positions count, in the length of --units.",
)
@click.option("--out", metavar="FILE", help="Write to this file instead of printing.")
def stiffness(
    scene: str,
    vary: tuple[str, ...],
    settings: tuple[str, ...],
    mirrored: bool,
    form: str,
    units: str | None,
    frequency: str | None,
    axis: str | None,
    origin: str | None,
    out: str | None,
) -> None:
    """Tabulate the stiffness of SCENE for rotor dynamics: kxx, kxy, ... in N/m over the speed in rad/s, as CSV.

    The shaft turns about z: x, y, z of the table are y, z, x of the scene. For instance: qsbearing stiffness 7210c
    --vary speed_rpm=0:24000:13 --vary axial_load_N=240,720,1440 --out 7210c.csv

    With another --format, the stiffness of each row about its balls' centres for finite-element programs, x
    along the shaft, or as --axis and --origin say.

    Exit codes: 0 some point is solved, 1 none is, 2 bad input.
    """
    if form != "csv":
        if frequency is not None:
            refuse(f"--frequency: --format {form} has the stiffness against loads that stand still; csv has both")
        if form == "ross" and units == "N-mm-t":
            refuse("--units: elements of ROSS are in N, m and kg")
        units = units or ("N-m-kg" if form == "ross" else "N-mm-t")
        _for_finite_elements(scene, settings, vary, mirrored, form, units, (axis, origin), out)
        return
    problems = [] if units is None else ["--units: a table as CSV is in N, m and rad; other formats have other units"]
    refuse_all([*problems, *_frame_of(axis, origin, form)[1]])
    from qsbearing.files.csv_table import csv_bytes
    from qsbearing.model.validation import SceneError
    from qsbearing.studies.remarked import of_look, together
    from qsbearing.studies.stiffness import stiffness_of
    from qsbearing.systems.rotor_dynamics.over_frequency import frequencies_of

    with ExitStack() as stack:
        writers = claimed(stack, {"--out": out}, [])
        try:
            looks: list[Look] = []
            at = () if frequency is None else frequencies_of(frequency)
            study, changes = study_of(scene, vary, {}, settings)
            columns = stiffness_of(study, mirrored=mirrored, frequencies=at, looks=looks)
        except SceneError as error:
            refuse(str(error))
        text = csv_bytes(columns)
        write_files(writers, {"--out": lambda: text})
        if not writers:
            print_text(text.decode())
    said: list[Callout | Paragraph] = [*told(changes), *of_look(together(looks), len(columns["status"]))]
    for each in said:
        note_remark(each)
    if not (columns["status"] == "converged").any():
        sys.exit(UNSOLVED)


def _for_finite_elements(
    scene: str,
    settings: Sequence[str],
    vary: Sequence[str],
    mirrored: bool,
    form: str,
    units: str,
    turned: tuple[str | None, str | None],
    out: str | None,
) -> None:
    import numpy as np

    from qsbearing.cli.scene import load_one, solve
    from qsbearing.files import stiffness_files as files
    from qsbearing.results.remarks import blocks, every_remark

    of, _, changes = load_one(scene, settings)
    problems = [f"--vary: --format {form} is of one operating point"] if vary else []
    frame, wrong = _frame_of(*turned, form)
    problems += wrong
    if form == "mat" and out is None:
        problems.append("--format mat: is no text; give --out FILE.mat")
    if mirrored and hasattr(of, "rows"):
        problems.append("--mirrored: the rows of a set say themselves in which direction they carry")
    with ExitStack() as stack:
        writers = claimed(stack, {"--out": out}, problems, scene)
        solution = solve(of)
        if not solution.converged or not np.isfinite(solution.stiffness).all():
            is_moved = getattr(solution, "friction", None) is not None
            note(solution.message() if not solution.converged else NO_TILTS if is_moved else NO_TANGENT)
            sys.exit(UNSOLVED)
        seats = files.seats_of(solution, units, mirrored=mirrored)
        if form == "ross":
            made: str | bytes = files.ross_module(seats)
        elif form == "mat":
            made = files.mat_bytes(seats, units)
        elif form in IN_MODEL:
            write = files.json_text if form == "json" else getattr(files, f"{form}_deck")
            made = write(seats, units, frame)
        else:
            made = getattr(files, f"{form}_deck")(seats, units)
        write_files(writers, {"--out": lambda: made.encode() if isinstance(made, str) else made})
        if isinstance(made, str) and not writers:
            print_text(made)
    for each in told(changes):
        note(each.text)
    for remark in blocks(every_remark(solution)):
        note_remark(remark)
    if form in INSTEAD:
        note(f"--format {form} goes with version {LAST}; {INSTEAD[form]}")


def _frame_of(axis: str | None, origin: str | None, form: str) -> tuple[ModelFrame, list[str]]:
    """Where the shaft lies in a model, and what is wrong with how that is said."""
    import numpy as np

    from qsbearing.systems.rotor_dynamics.model_frame import OWN, ModelFrame, directions_of

    given = {"--axis": axis, "--origin": origin}
    said = {option: text for option, text in given.items() if text is not None}
    if said and form not in IN_MODEL:
        return OWN, [f"{option}: of --format {', '.join(IN_MODEL)} only" for option in said]
    names = {name: np.eye(3)[number] for number, name in enumerate("xyz")}
    along = names.get((axis or "x").strip().lower(), _three(axis))
    start = np.zeros(3) if origin is None else _three(origin)
    problems = []
    if along is None or not along.any():
        problems.append(f"--axis {axis}: write x, y, z, or three numbers that are not all 0, such as 0,0.6,0.8")
    if start is None:
        problems.append(f"--origin {origin}: write three lengths, such as 0,-120.5,40")
    if along is None or start is None or problems:
        return OWN, problems
    return ModelFrame(start, directions_of(along)), []


def _three(given: str | None) -> NDArray | None:
    """Three finite numbers between commas; None where it is something else."""
    import numpy as np

    try:
        numbers = np.array([float(each) for each in (given or "").split(",")])
    except ValueError:
        return None
    return numbers if numbers.shape == (3,) and np.isfinite(numbers).all() else None
