"""`qsbearing run`: solve a scene, a set or a load spectrum, and show what came out."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from qsbearing.cli.ball_sets import blocks_of_lists
from qsbearing.cli.files import claimed, csv_problems, picture_problems, write_files
from qsbearing.cli.output import NOT_MET, UNSOLVED, note, print_result, print_table, refuse, refuse_all
from qsbearing.cli.pictured import check_picture, drawn, picture_option
from qsbearing.cli.run_points import run_points
from qsbearing.cli.scene import answers_to_required, is_missed, load_scene_or_set, solve
from qsbearing.cli.settings import set_option, told, with_changes

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from qsbearing.documents.model import Block
    from qsbearing.model.scene.scene import Scene
    from qsbearing.model.solution.limit import Answer
    from qsbearing.model.solution.solution import Solution
    from qsbearing.systems.sets.bearing_set import BearingSet
    from qsbearing.systems.sets.set_solution import SetSolution


@click.command(short_help="Solve a scene; show loads, angles, stiffness.")
@click.argument("scene")
@set_option
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object instead of tables, and nothing else.")
@click.option(
    "--csv",
    "csv_target",
    metavar="FILE",
    help="Also write one row per ball, with units in the headings; every row repeats the ring's values, so that the "
    "files of several runs can be joined into one table.",
)
@click.option(
    "--plot",
    "plot_target",
    metavar="FILE",
    help="Also draw loads, contact angles and contact ellipses; for a set, the loads and angles of each row; .png, "
    ".svg or .pdf.",
)
@picture_option
@click.option(
    "--into",
    metavar="MODEL",
    help="Also write the results into the REXS model that SCENE was made of by `qsbearing import`; no other line of it "
    "changes.",
)
@click.option(
    "--accuracy",
    type=float,
    metavar="ERROR",
    help="Choose the effects automatically, whichever SCENE names: effects are left out as long as all results stay "
    "within this relative error of the full model at the operating point, such as 1e-3.",
)
@click.option(
    "--points",
    metavar="TABLE",
    help="Solve SCENE for each row of a table: .csv, .xlsx or .parquet; the headings "
    "are keys of the scene file, such as speed_rpm. Each row gives one row of results with its status.",
)
@click.option(
    "--out", metavar="TABLE", help="With --points: write the rows and their results here; .csv, .xlsx or .parquet."
)
@click.option(
    "--decimal",
    type=click.Choice([",", "."]),
    help="With --points: what stands before the decimals in a .csv file, where its cells leave a doubt.",
)
def run(
    scene: str,
    settings: tuple[str, ...],
    as_json: bool,
    csv_target: str | None,
    plot_target: str | None,
    picture: str | None,
    into: str | None,
    accuracy: float | None,
    points: str | None,
    out: str | None,
    decimal: str | None,
) -> None:
    """Solve SCENE: a TOML file, or the name of a catalogue bearing, whose example is then solved.

    A file with [[rows]] is a set of rows on one shaft: `qsbearing init --set` prints one. A file with [[spectrum]] has
    operating points with shares of time, which give one life. The result of --json (.json) or of `qsbearing sweep`
    (.nc) is solved again from the input that it holds; for a sweep this is the scene of its first point.

    A file's [require] says what results must keep; the answers stand first. What cannot be judged is open.

    Exit codes: 0 solved, 1 no equilibrium or not converged, 2 bad input, 3 a requirement is not met.
    """
    if points is not None or out is not None or decimal is not None:
        others = {"--json": as_json, "--csv": csv_target, "--plot": plot_target, "--into": into, "--accuracy": accuracy}
        others |= {"--picture": picture}
        clashing = {name: given for name, given in others.items() if given not in (None, False)}
        run_points(scene, settings, points, out, decimal, clashing)
        return
    targets = {"--csv": csv_target, "--plot": plot_target, "--into": into}
    with ExitStack() as stack:
        writers = claimed(stack, targets, csv_problems(csv_target) + picture_problems(plot_target), scene)
        loaded, document, changes = load_scene_or_set(scene, settings, may_infer=True)
        if plot_target is not None and "spectrum" in loaded.readings:
            refuse(NO_PICTURE)
        check_picture(picture, plot_target, loaded)
        model: Any = None if into is None else _model_of(scene, document, into)
        from qsbearing.model.scene.scene import Scene

        if isinstance(loaded, Scene) and loaded.bearing.inferred is not None:
            refuse_all(_not_of_list(loaded, {"--plot": plot_target, "--into": into, "--accuracy": accuracy}))
            outcome = _of_data_sheet(loaded)
        else:
            outcome = _of_scene(loaded, accuracy) if isinstance(loaded, Scene) else _of_set(loaded, accuracy)
            outcome = _with_other_sets(outcome, loaded, document)
        if as_json:
            print_result(outcome.input, with_changes(outcome.record(), changes))
        else:
            from qsbearing.results.report import pulse

            print_table([*told(changes), *outcome.blocks(), *pulse(outcome.solution)])
        if outcome.lacks:
            for option in writers:
                note(f"{targets[option]} is not written: {outcome.lacks}")
            sys.exit(UNSOLVED)
        from qsbearing.files.csv_table import csv_bytes

        spectrum = "spectrum" in loaded.readings
        make = {
            "--csv": lambda: csv_bytes(outcome.columns()),
            "--plot": lambda: drawn(outcome.solution, picture, plot_target or ""),
            "--into": lambda: (
                model.put_life(outcome.readings) if spectrum else model.put(outcome.solution, outcome.readings)
            ),
        }
        write_files(writers, make)
        if model is not None:
            note("\n".join([f"{model.count} attributes written into {into}", *model.notes]))
        if is_missed(outcome.required):
            sys.exit(NOT_MET)


NO_PICTURE = "--plot: a picture shows a single operating point, not a spectrum; --csv writes every ball of every point"


def _model_of(scene: str, document: dict[str, Any], into: str) -> Any:
    """The model that takes the results; ends with what is wrong with it, before anything is solved."""
    from pathlib import Path

    from qsbearing.files.rexs.write_back import WriteBack
    from qsbearing.files.scene_file import STANDARD_INPUT
    from qsbearing.model.validation import SceneError

    if scene in STANDARD_INPUT:
        refuse("--into: takes a scene file, of one point or of a load spectrum")
    try:
        return WriteBack(Path(into), document)
    except SceneError as error:
        refuse(str(error))


class RunOutput(NamedTuple):
    """A result, and how it is shown in every way that may be asked for."""

    solution: Solution | SetSolution
    input: Scene | BearingSet
    """What it is reproduced from."""
    record: Callable[[], dict[str, Any]]
    blocks: Callable[[], list[Block]]
    columns: Callable[[], dict[str, NDArray]]
    readings: Any
    """What the input asks to be read off; of a set a list, by row."""
    required: list[Answer]
    """The answers to what the input requires."""

    @property
    def lacks(self) -> str:
        """What files would lack; empty where all is solved."""
        if self.solution.converged.all():
            return ""
        return "not all points are solved" if self.solution.shape else "there is no solution to write"


def _with_other_sets(outcome: RunOutput, of: Scene | BearingSet, document: dict[str, Any]) -> RunOutput:
    """With the range over the ball sets of a bearing that is a list, of which the best is solved."""
    blocks = blocks_of_lists(document, of)
    if not blocks:
        return outcome

    def record() -> dict[str, Any]:
        from qsbearing.files.ball_lists import listed_in
        from qsbearing.studies.other_sets import other_sets_record

        return outcome.record() | {"other_ball_sets": other_sets_record(of, listed_in(document))}

    return outcome._replace(record=record, blocks=lambda: [*outcome.blocks(), *blocks])


def _of_scene(scene: Scene, accuracy: float | None) -> RunOutput:
    from qsbearing.results.readings_record import Readings, all_columns

    def blocks(solution: Solution, readings: Readings) -> list[Block]:
        from qsbearing.documents.model import Paragraph
        from qsbearing.results.report import result

        if solution.choice is None:
            return result(solution, readings)
        from qsbearing.files.file_keys import IN_FILE
        from qsbearing.remarks.bearing import chosen

        said = enumerate(chosen(solution, scene, IN_FILE))
        return result(solution, readings) + [Paragraph(each, is_apart=number == 0) for number, each in said]

    solution = _solved(scene, accuracy)
    requested = scene if accuracy is None else solution.scene  # a file cannot ask for a choice among what it names
    if "spectrum" in scene.readings:
        from qsbearing.results.spectrum_report import spectrum_result as blocks
    return _output(solution, requested, all_columns, blocks)


def _not_of_list(scene: Scene, options: dict[str, Any]) -> list[str]:
    """What cannot be done with every bearing that a data sheet allows."""
    from qsbearing.files.data_sheet_table import refusal

    return [f"{name}: {refusal(scene.bearing)}" for name, given in options.items() if given is not None]


def _of_data_sheet(scene: Scene) -> RunOutput:
    """Results as ranges; in JSON beside those of the set whose ratings fit best."""
    from qsbearing.results.json_record import record
    from qsbearing.results.readings_record import Readings, all_columns, taken
    from qsbearing.studies import inferred

    solution = _solved(scene, None)

    def with_ranges() -> dict[str, Any]:
        best = _solved(replace(scene, bearing=scene.bearing.inferred.at(0)), None)
        return record(best, taken(best), said=inferred.said(solution)) | inferred.inferred_record(solution)

    def blocks(solution: Solution, _: Readings) -> list[Block]:
        return inferred.inferred_tables(solution)

    return _output(solution, scene, all_columns, blocks, with_ranges)


def _of_set(of: BearingSet, accuracy: float | None) -> RunOutput:
    from qsbearing.documents.model import Paragraph
    from qsbearing.files.file_keys import IN_FILE
    from qsbearing.remarks.bearing import chosen
    from qsbearing.results.readings_record import Readings
    from qsbearing.results.set_record import set_columns

    def blocks(solution: SetSolution, readings: list[Readings]) -> list[Block]:
        from qsbearing.results.set_report import set_result  # not above: --json does without

        said = [Paragraph(each, is_apart=number == 0) for number, each in enumerate(chosen(solution, of, IN_FILE))]
        return set_result(solution, readings) + said

    solution: SetSolution = _solved(of, accuracy)
    requested = of if accuracy is None else solution.set
    if "spectrum" in of.readings:
        from qsbearing.results.set_spectrum_report import set_spectrum_result as blocks
    return _output(solution, requested, set_columns, blocks)


def _output(
    solution: Any,
    requested: Any,
    columns: Callable[..., Any],
    blocks: Callable[..., Any],
    record: Callable[[], dict[str, Any]] | None = None,
) -> RunOutput:
    """What is shown of a solution and its readings, and of the limits of fits that have a name."""
    from qsbearing.results.readings_record import all_taken
    from qsbearing.results.whole import of_fits, whole_record

    readings = all_taken(solution)
    required = answers_to_required(solution, readings)

    def shown() -> list[Block]:
        said = [*blocks(solution, readings), *(of_fits("fits_blocks", solution) or ())]
        if not required:
            return said
        from qsbearing.results.requirements import blocks as answers

        first, *rest = said
        return [*answers(required, solution), replace(first, is_apart=True), *rest]

    whole = record or partial(whole_record, solution, readings)
    return RunOutput(solution, requested, whole, shown, partial(columns, solution, readings), readings, required)


def _solved(scene: Scene | BearingSet, accuracy: float | None) -> Any:
    if accuracy is not None:
        from qsbearing.model.accuracy import ALLOWED, is_allowed

        if not is_allowed(accuracy):
            allowed = f"    allowed: {ALLOWED}, a relative error\n    1e-3 is 0.1 %"
            refuse(f"--accuracy {accuracy:g}: is outside its range\n{allowed}")
        if scene.thermal is not None:
            refuse("--accuracy: a scene with a heat balance has the effects that its file names")
    return solve(scene, accuracy)
