"""A solved set as plain data in the field's units, the object that `run --json` prints; and as columns of a table."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.result_keys import Place
from qsbearing.model.solution.rounding import rounding_of
from qsbearing.model.units import mm, um
from qsbearing.remarks.remark import Remark
from qsbearing.results.group_numbers import no_numbers, numbers_or_none
from qsbearing.results.json_record import (
    choice_record,
    choices,
    how_it_ended,
    motion_and_stiffness,
    record,
    thermal,
)
from qsbearing.results.readings_record import Readings, all_columns, number
from qsbearing.results.record_type import Record
from qsbearing.results.remarks import every_remark, remarks_record
from qsbearing.results.shaft_report import shaft_record
from qsbearing.systems.sets.remarks import with_rows
from qsbearing.systems.sets.set_groups import AXIAL_LOAD, OF_SHAFT, PLAY, PRELOAD, SHARE, SYSTEM
from qsbearing.systems.sets.set_solution import SetSolution

OF_THE_SET = ("version", "seconds", "effects", "choices", "preload", "left_out", "accuracy", "thermal")
"""What a row's own record would only repeat."""


def set_record(solution: SetSolution, readings: Sequence[Readings]) -> Record:
    """A single case of a set as the object that `run --json` prints.

    Args:
        readings: what each row was asked to be read off.

    Returns:
        None stands for a number that there is not: not called for, not solved, or not defined.
    """
    of, solved = solution.set, bool(solution.converged)
    scene = solution.rows[0].scene
    of_rows = [every_remark(row, own) for row, own in zip(solution.rows, readings, strict=True)]
    rows = [_row(solution, i, own, of_rows[i]) for i, own in enumerate(readings)]
    return {
        **how_it_ended(solution),
        "set": of.name,
        "arrangement": of.arrangement,
        "reference_position_mm": float(of.reference / mm),
        "axial_datum_row": of.axial_datum + 1 if of.spacers else None,
        "effects": [effect.name for effect in (*scene.ring_effects, *scene.ball_effects)],
        "choices": choices(scene),
        **({} if solution.choice is None else choice_record(solution, ())),
        **remarks_record(with_rows(solution, of_rows)),
        "preload": None if of.preload is None else {"kind": of.preload.kind, **_slide(solution)},
        **motion_and_stiffness(solution, np.full(5, _load_noise(solution, rows))),
        "axial_play": numbers_or_none(PLAY, solution, ()) if any(of.is_two_sided) else None,
        "shaft": shaft_record(solution) if solved else None,
        **(numbers_or_none(SYSTEM, solution, (), 0, readings) if solved else no_numbers(SYSTEM)),
        "thermal": thermal(solution),
        "rows": rows,
    }


def _load_noise(solution: SetSolution, rows: list[Record]) -> float:
    """Beside the largest load of the shaft or of a row."""
    largest = [abs(load) for row in rows for load in list(row["share"].values())[:3] if load is not None]
    largest += list(np.nan_to_num(np.abs(solution.load)))
    return float(rounding_of(max(largest), solution.rounding))


def _slide(solution: SetSolution) -> dict[str, float | None]:
    return {} if solution.slide is None else {"slide_um": number(solution.slide / um)}


def _row(solution: SetSolution, i: int, readings: Readings, said: Sequence[Remark]) -> Record:
    heat = None if solution.thermal is None else solution.thermal.thermal
    row, own = solution.set.rows[i], record(solution.rows[i], readings, (), heat, said)
    state = solution.preload_state

    return {
        "position_mm": float(np.asarray(row.position) / mm),
        "carries": str(row.carries),
        "sprung": row.sprung,
        "offset_um": float(np.asarray(row.offset) / um),
        **numbers_or_none(AXIAL_LOAD, solution, (), i + 1),
        "share": numbers_or_none(SHARE, solution, (), i + 1),
        **numbers_or_none(PRELOAD, solution, (), i + 1),
        "preload_state": None if state is None else str(state[i]) or None,
        **{key: value for key, value in own.items() if key not in OF_THE_SET},
    }


def set_columns(solution: SetSolution, readings: Sequence[Readings]) -> dict[str, NDArray]:
    """One row per ball of every row of every case, rows counting from 1; the shaft's values follow on each.

    Rows that differ in what they have leave cells empty.
    """
    places = [Place(group, each) for group in OF_SHAFT[:-1] for each in group.results]
    shaft = {each.column: each.of(solution) for each in places}
    parts = [_row_columns(solution, i, own, shaft) for i, own in enumerate(readings)]
    names = dict.fromkeys(name for part in parts for name in part)
    empty = [np.full(part["row"].size, np.nan) for part in parts]
    return {
        name: np.concatenate([part.get(name, none).astype(object) for part, none in zip(parts, empty, strict=True)])
        for name in names
    }


def _row_columns(solution: SetSolution, i: int, readings: Readings, shaft: Record) -> dict[str, NDArray]:
    row, own = solution.set.rows[i], all_columns(solution.rows[i], readings)
    of_row = {"row": i + 1, "position_mm": np.asarray(row.position) / mm}
    count = own["ball"].size
    case = tuple(own[f"case_{axis}"] for axis in range(len(solution.shape)))
    first = {name: np.full(count, value) for name, value in of_row.items()}
    last = {name: np.full(count, value[case]) for name, value in shaft.items()}
    first["carries"] = np.array([row.carries] * count, object)
    return first | own | last
