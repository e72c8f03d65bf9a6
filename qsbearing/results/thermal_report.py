"""Temperatures and heat of a solution as plain data, the object under "thermal" of `run --json`, and as tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.units import rpm, zero_celsius
from qsbearing.remarks.wording import not_capital
from qsbearing.results.group_numbers import tables_of
from qsbearing.results.record_type import Record
from qsbearing.results.tables import digits_of
from qsbearing.systems.heat.heat_groups import recorded_groups
from qsbearing.systems.heat.state import Course, State, ThermalState, along_curve, hottest, instant


def thermal_record(solution: Any, index: CasePlace = ()) -> Record:
    """One case of a bearing or set; None stands for a number that there is not."""
    state: ThermalState = solution.thermal
    numbers = tables_of(recorded_groups(state), solution, index)["thermal"]
    paths = zip(state.flows, numbers["flows_W"].values(), strict=True)
    numbers["flows_W"] = [{"from": one, "to": other, "heat_W": heat} for (one, other), heat in paths]
    return {
        "verdict": str(state.verdict[index]),
        "message": state.message(index),
        "friction": state.thermal.friction,
        **numbers,
        "limit_C": state.thermal.limit_temperature - zero_celsius,
        "solves": state.solves,
    }


def course_record(course: Course) -> Record:
    """Heating up in time."""
    return {
        "message": course.message(),
        "end": course.end,
        "time_s": course.time.tolist(),
        "temperatures_C": {name: (value - zero_celsius).tolist() for name, value in course.temperatures.items()},
        "power_W": course.powers.sum(axis=1).tolist(),
        "axial_load_N": course.preloads.T.tolist(),
    }


def speeds_record(state: ThermalState) -> Record:
    """Steady states over speed, and where they end."""
    curve = state.speeds
    return {
        "message": state.onset(),
        "fold": None if curve.fold is None else _at_speed(state, curve.fold),
        "at_limit": None if curve.at_limit is None else _at_speed(state, curve.at_limit),
        "states": [_at_speed(state, each) for each in curve.states],
    }


OF_WHOLE_BEARING = "With Palmgren's friction of the whole bearing"


def whole_bearing_record(state: ThermalState) -> Record | None:
    """Steady states over speed with Palmgren's friction in place of that of the contacts; without states where it lacks
    numbers, which its message then names; None where the friction model leaves nothing out."""
    from qsbearing.files.file_errors import translate

    whole = state.whole_bearing
    if whole is None:
        return None
    if whole.state is None:
        reasons = " ".join(f"{translate(each)}." for each in whole.errors)
        return {"message": f"{OF_WHOLE_BEARING}: not computed. {reasons}", "assumed": [], "states": [], "fold": None}
    record, assumed = speeds_record(whole.state), whole.assumed
    basis = f"{OF_WHOLE_BEARING} (assumed: {', '.join(assumed)})" if assumed else OF_WHOLE_BEARING
    return {**record, "message": f"{basis}: {not_capital(record['message'])}", "assumed": assumed}


def whole_bearing_table(record: Record) -> Table:
    """Of this record."""
    return replace(speeds_table(record), caption="Likewise, with Palmgren's friction of the whole bearing")


def _at_speed(state: ThermalState, each: State) -> Record:
    return {
        "speed_rpm": each.factor * float(state.speed) / rpm,
        "temperatures_C": dict(zip(state.free, (each.temperatures - zero_celsius).tolist(), strict=True)),
        "power_W": float(each.powers.sum()),
        "axial_load_N": each.preloads.tolist(),
    }


SHOWN = 12
"""Rows of a table of a course, about."""


def speeds_table(record: Record) -> Table:
    """Of the record of steady states over speed."""
    states, fold = along_curve({**record, "states": _thinned(record["states"])})
    rows = [
        (f"{each['speed_rpm']:.5g}", each, "the curve turns back" if number == fold else "")
        for number, each in enumerate(states)
    ]
    return _course_table("Steady states, followed from standstill with rising speed", "rpm", rows)


def course_table(record: Record) -> Table:
    """Of the record of heating up."""
    times = record["time_s"]
    rows = [(f"{times[number]:.4g}", instant(record, number), "") for number in _thinned(range(len(times)))]
    return _course_table("Heating up", "s", rows)


def _thinned(every: Sequence[Any]) -> list[Any]:
    numbers = np.linspace(0, len(every) - 1, min(SHOWN, len(every))).round().astype(int)
    return [every[number] for number in numbers]


def _course_table(title: str, along: str, rows: list[tuple[str, Record, str]]) -> Table:
    """Of several rows the hottest nodes and the largest load."""
    nodes = hottest(rows[0][1]["temperatures_C"]) if rows else {}
    heads = (*(f"{node}\n°C" for node in nodes), "friction\nW", "axial load\nN")
    is_noted = any(note for *_, note in rows)
    cells: list[tuple[str, ...]] = []
    for at, each, note in rows:
        numbers = (*hottest(each["temperatures_C"]).values(), each["power_W"])
        own = (at, *(f"{value:.1f}" for value in numbers), f"{max(each['axial_load_N']):.5g}")
        cells.append((*own, note) if is_noted else own)
    sides = "r" * (len(heads) + 1)
    return Table((along, *heads, *([""] if is_noted else [])), cells, sides + "l" * is_noted, title)


def thermal_tables(record: Record) -> list[Block]:
    """What a record says of a steady state: nodes, paths, and the verdict."""
    nodes = [(name.in_words, digits_of(value)) for name, value in record["temperatures_C"].items()]
    by = "" if record["friction"] == "contacts" else f" ({record['friction']})"
    heat = [(f"{name.in_words}{by}", "", digits_of(value)) for name, value in record["powers_W"].items()]
    for path in record["flows_W"]:
        ends, flow = (path["from"].in_words, path["to"].in_words), path["heat_W"]
        heat.append(
            (*(ends if flow is None or flow >= 0.0 else ends[::-1]), digits_of(np.nan if flow is None else abs(flow)))
        )
    return [
        Table(("node", "temperature °C"), nodes, caption="Steady state"),
        Table(("made by, or flowing from", "to", "W"), heat, "llr", "Heat"),
        Paragraph(record["message"], is_apart=True),
    ]
