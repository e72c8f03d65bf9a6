"""`qsbearing heat`: how hot a bearing or set runs, at which speed its preload runs away, and how it heats up."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from math import inf
from typing import TYPE_CHECKING, Any

import click

from qsbearing.cli.files import claimed, picture_bytes, picture_problems, write_files
from qsbearing.cli.output import UNSOLVED, print_result, print_table, progress_bar, refuse
from qsbearing.cli.scene import in_keys, load_one, solve, solving
from qsbearing.cli.settings import set_option, told, with_changes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from qsbearing.documents.model import Block
    from qsbearing.systems.heat.state import ThermalState


@click.command(short_help="Find temperatures over speed and time, and thermal runaway.")
@click.argument("scene")
@set_option
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object instead of tables, and nothing else.")
@click.option(
    "--transient",
    type=float,
    metavar="SECONDS",
    help="Show temperatures and preload over this time of heating up, at full speed from the start.",
)
@click.option(
    "--start", type=float, metavar="CELSIUS", help="With --transient: temperature of all parts at the start [°C]."
)
@click.option(
    "--plot",
    metavar="FILE",
    help="Also draw them over the speed, or with --transient over the time; .png, .svg or .pdf.",
)
def heat(
    scene: str,
    settings: tuple[str, ...],
    as_json: bool,
    transient: float | None,
    start: float | None,
    plot: str | None,
) -> None:
    """Find the steady temperatures of SCENE, a bearing or a set of rows with a table [thermal].

    Steady states are followed from standstill with rising speed, up to the speed at which their curve turns back
    (thermal runaway of the preload) or reaches the temperature limit. Where the friction is that of the contacts alone,
    a lower bound, this is also shown with Palmgren's friction of the whole bearing.

    Exit codes: 0 a steady state is found, 1 there is none or no equilibrium, 2 bad input.
    """
    from qsbearing.model.validation import SceneError

    if start is not None and transient is None:
        refuse("--start: give --transient too")
    _check(transient, start)
    with ExitStack() as stack:
        writers = claimed(stack, {"--plot": plot}, picture_problems(plot), scene)
        loaded, _, changes = load_one(scene, settings)
        if loaded.thermal is None:
            refuse(f"{scene}: has no table [thermal]; `qsbearing guide heat` shows one")
        solution = solve(loaded)
        state: ThermalState = solution.thermal
        from qsbearing.results.json_record import how_it_ended, thermal
        from qsbearing.results.remarks import blocks, every_remark, remarks_record
        from qsbearing.results.thermal_report import course_record, speeds_record, whole_bearing_record

        record = how_it_ended(solution) | {"thermal": thermal(solution), "speeds": None, "whole_bearing": None}
        record |= remarks_record(said := every_remark(solution))
        record["transient"] = None
        if transient is None:
            with solving():
                record["speeds"] = speeds_record(state)
            record["whole_bearing"] = whole_bearing_record(state)
        else:
            try:
                record["transient"] = course_record(_course(state, transient, start))
            except SceneError as error:
                refuse(in_keys(error))
        if as_json:
            print_result(loaded, with_changes(record, changes))
        else:
            _show(record, told(changes), blocks(said, is_apart=True))
        if plot is not None:
            from qsbearing.pictures.style import name_of

            write_files(writers, {"--plot": lambda: _picture(record, state, name_of(loaded), plot)})
    if not solution.converged:
        sys.exit(UNSOLVED)


def _check(duration: float | None, start: float | None) -> None:
    from qsbearing.model.units import zero_celsius
    from qsbearing.systems.heat.network import COLDEST, HOTTEST

    low, high = COLDEST - zero_celsius, HOTTEST - zero_celsius
    if start is not None and not low <= start <= high:
        refuse(f"--start {start:g}: is outside {low:g} to {high:g} °C")
    if duration is not None and not 0.0 < duration < inf:
        refuse(f"--transient {duration:g}: must be above 0 s and finite")


def _course(state: ThermalState, duration: float, start: float | None) -> Any:
    from qsbearing.model.units import zero_celsius

    with progress_bar("s") as update:
        return state.heat_up(
            duration,
            start=None if start is None else start + zero_celsius,
            progress=lambda part: update(int(part * duration), int(duration)),
        )


def _show(record: dict[str, Any], changes: Sequence[Block] = (), remarks: Sequence[Block] = ()) -> None:
    from qsbearing.documents.model import Paragraph
    from qsbearing.results.thermal_report import course_table, speeds_table, thermal_tables, whole_bearing_table

    parts: list[Block] = (
        thermal_tables(record["thermal"]) if record["status"] == "converged" else [Paragraph(record["message"])]
    )
    for name, table in (("speeds", speeds_table), ("whole_bearing", whole_bearing_table), ("transient", course_table)):
        if record[name] is not None:
            parts += [table(record[name]), Paragraph(record[name]["message"], is_apart=True)]
    print_table([*changes, *parts, *remarks])


def _picture(record: dict[str, Any], state: ThermalState, title: str, target: str) -> bytes:
    from qsbearing.model.units import rpm
    from qsbearing.pictures.heat import over_speed, over_time

    if record["transient"] is not None:
        return picture_bytes(over_time(record["transient"], title), target)
    return picture_bytes(over_speed(record["speeds"], float(state.speed) / rpm, title, record["whole_bearing"]), target)
