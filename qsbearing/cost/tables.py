"""The measured costs as tables: for people, and as rows for CSV."""

from __future__ import annotations

import csv
import math
from io import StringIO
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from rich import box
from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from qsbearing.cost.machine import in_a_line
from qsbearing.cost.tolerance import STARTS, summary

if TYPE_CHECKING:
    from collections.abc import Sequence

COLUMNS = (
    ("axial", ("axial_displacement",)),
    ("radial", ("radial_displacement",)),
    ("tilt", ("tilt",)),
    ("angles", ("inner_angle", "outer_angle")),
    ("loads", ("inner_load", "outer_load", "ring_load")),
    (
        "axes",
        ("inner_semi_major_axis", "inner_semi_minor_axis", "outer_semi_major_axis", "outer_semi_minor_axis"),
    ),
    ("p0", ("inner_max_pressure", "outer_max_pressure")),
    ("stiff.", ("axial_stiffness", "radial_stiffness", "tilt_stiffness")),
)
"""Headings of the table of answers, and the errors of which each shows the worst."""


def report(record: dict[str, Any]) -> Group:
    """Everything in the record, for the terminal."""
    parts: list[RenderableType] = [_heading(record)]
    if "fidelity" in record:
        parts += [_fidelity(record), _when(record), _contact(record["contact"]), *map(_answers, record["fidelity"])]
    if "tolerance" in record:
        parts.append(_tolerance(record))
    if "scaling" in record:
        parts += [_growth(record), _workers(record)]
    parts.append(Text("\n".join(record["notes"]), style="dim"))
    return Group(parts[0], *(Padding(part, (1, 0, 0, 0)) for part in parts[1:]))


def _heading(record: dict[str, Any]) -> Text:
    text = Text()
    text.append(f"{record['bearing'] or 'Bearing'}", style="bold")
    text.append(f"  {record['scene']}\n{in_a_line(record['machine'])}\n")
    text.append(
        f"Medians of {record['settings']['rounds']} rounds in each of {record['settings']['processes']} processes, in "
        "brackets the stretch between their 5 % and 95 % quantiles."
    )
    return text


def _fidelity(record: dict[str, Any]) -> Table:
    """Rungs: time and memory, in the last situation."""
    place = record["fidelity"][-1]
    heading = ["", "one call\nus", "of the top\n", "in a batch\nus a case", "of the top\n", "MB\n"]
    table = _table(f"Fidelity: time and memory, {place['name']}", heading)
    for rung in place["rungs"]:
        table.add_row(
            rung["words"],
            _micro(rung["one_case_s"]),
            _number(rung["one_case_over_top"]),
            _micro(rung["batch_case_s"]),
            _number(rung["batch_case_over_top"]),
            "-" if rung["memory_MB"] is None else f"{rung['memory_MB']['median']:.0f}",
        )
    return table


def _when(record: dict[str, Any]) -> Table:
    """Rungs: the worst error in each situation."""
    places = record["fidelity"]
    heading = ["", *("\n".join([*wrap(place["name"], 11), f"{place['dm_n_mm_rpm']:g}"]) for place in places)]
    table = _table("Fidelity: error of the worst answer by situation and dm n, mm rpm", heading)
    for k, rung in enumerate(places[0]["rungs"]):
        table.add_row(rung["words"], *(_error(place["rungs"][k]["accuracy"]) for place in places))
    return table


def _answers(place: dict[str, Any]) -> Table:
    title = f"Errors against the top rung: {place['name']}, {place['speed_rpm']:g} rpm"
    table = _table(title, ["", *(name for name, _ in COLUMNS)])
    for rung in place["rungs"][:-1]:
        table.add_row(rung["words"], *(_error(_worst(rung["errors"], names)) for _, names in COLUMNS))
    return table


def _worst(errors: dict[str, float | None] | None, names: Sequence[str]) -> float | None:
    known = [] if errors is None else [errors.get(name) for name in names]
    return max((value for value in known if value is not None), default=None)


def _contact(contact: dict[str, Any]) -> Table:
    names = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")
    title = f"One contact: {contact['what']}, {contact['load_N']:.0f} N; errors against 50 digits"
    table = _table(title, ["Hertz by", "us", *("\n".join(wrap(name.replace("_", " "), 10)) for name in names)])
    for form in contact["forms"]:
        table.add_row(
            form["form"].replace("_", " "), _micro(form["seconds"]), *(_error(form["errors"][name]) for name in names)
        )
    return table


def _tolerance(record: dict[str, Any]) -> Table:
    heading = ["residual\ntolerance"]
    for start in STARTS:
        heading += [f"{start.replace('continuation', 'continued')}\nerror", "\nsteps", "\nus"]
    count = len(record["tolerance"])
    title = f"Tolerance: largest error of {count} scenes against 50 digits; us a case in a batch"
    table = _table(title, heading)
    rows = summary(record["tolerance"])
    for tolerance in dict.fromkeys(row["tolerance"] for row in rows):
        cells = []
        for row in (row for row in rows if row["tolerance"] == tolerance):
            cells += [_error(row["error"]), f"{row['iterations']:.1f}", _micro(row["batch_case_s"], spread=False)]
        table.add_row(f"{tolerance:.0e}", *cells)
    return table


def _growth(record: dict[str, Any]) -> Table:
    table = _table("Scaling, one thread", ["", "", "us a case", "of the first", "MB"])
    for what in ("cases", "balls"):
        for k, row in enumerate(record["scaling"][what]):
            table.add_row(
                ("cases in one call" if what == "cases" else "balls in the bearing") if k == 0 else "",
                f"{row[what]:,}",
                _micro(row["case_s"]),
                _number(row["over_first"]),
                f"{row['memory_MB']['median']:.0f}",
            )
    return table


def _workers(record: dict[str, Any]) -> Table:
    rows = record["scaling"]["workers"]
    table = _table(f"{rows[0]['cases']:,} cases shared out", ["", "", "us a case", "speed-up", "MB"])
    for row in rows:
        memory = "-" if row["memory_MB"] is None else f"{row['memory_MB']['median']:.0f}"
        table.add_row(row["kind"], str(row["count"]), _micro(row["case_s"]), _number(row["speed_up"]), memory)
    return table


def _table(title: str, heading: Sequence[str]) -> Table:
    table = Table(title=title, box=box.SIMPLE_HEAD, show_edge=False, title_justify="left", title_style="bold")
    table.pad_edge, table.padding = False, (0, 1, 0, 0)
    for position, words in enumerate(heading):
        # A number that does not fit goes on below: cut off, it would be another number.
        table.add_column(words, justify="right" if position else "left", overflow="fold")
    return table


def _micro(time: dict[str, float] | None, spread: bool = True) -> str:
    """Microseconds, with their spread."""
    if time is None:
        return "-"
    median = f"{time['median'] * 1e6:.3g}"
    return f"{median}\n({time['low'] * 1e6:.3g}-{time['high'] * 1e6:.3g})" if spread else median


def _number(ratio: dict[str, float] | None) -> str:
    return "-" if ratio is None else f"{ratio['median']:.2g}\n({ratio['low']:.2g}-{ratio['high']:.2g})"


def _error(value: float | None) -> str:
    """An error in as few characters as it takes."""
    if value is None:
        return "-"
    if value == 0.0:
        return "0"
    power = math.floor(math.log10(value))
    if power >= -1:
        return f"{value:.2g}"
    mantissa = f"{value / 10.0**power:.1f}"
    if mantissa == "10.0":
        mantissa, power = "1.0", power + 1
    return f"{mantissa}e{power}"


# CSV ----------------------------------------------------------------------------------------------------------------


def csv_text(record: dict[str, Any], part: str) -> str:
    """One part of the record as rows; units in the headings, an empty cell for what there is not."""
    rows = {"fidelity": _fidelity_rows, "tolerance": _tolerance_rows, "scaling": _scaling_rows}[part](record)
    heading = list(dict.fromkeys(name for row in rows for name in row))
    text = StringIO(newline="")
    writer = csv.DictWriter(text, heading, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _fidelity_rows(record: dict[str, Any]) -> list[dict[str, Any]]:
    rows = []
    for place in record["fidelity"]:
        for rung in place["rungs"]:
            row = {"situation": place["name"], "speed_rpm": place["speed_rpm"], "dm_n_mm_rpm": place["dm_n_mm_rpm"]}
            row["rung"] = rung["rung"]
            for key in ("one_case_s", "one_case_over_top", "batch_case_s", "batch_case_over_top", "memory_MB"):
                row |= _spread(key, rung[key])
            row["accuracy"] = rung["accuracy"]
            errors = rung["errors"] or {}
            row |= {f"error_{name}": errors.get(name) for name in record["answers"]}
            rows.append(row)
    return rows


def _tolerance_rows(record: dict[str, Any]) -> list[dict[str, Any]]:
    rows = []
    for scene in record["tolerance"]:
        for start in scene["starts"]:
            for step in start["steps"]:
                row = {"scene": scene["name"], "start": start["start"]}
                for key, value in step.items():
                    row |= _spread(key, value) if isinstance(value, dict) else {key: value}
                rows.append(row)
    return rows


def _scaling_rows(record: dict[str, Any]) -> list[dict[str, Any]]:
    rows = []
    for what, entries in record["scaling"].items():
        for entry in entries:
            row = {"by": entry.get("kind", what), "count": entry.get(what, entry.get("count"))}
            row |= _spread("case_s", entry["case_s"])
            row |= _spread("ratio", entry.get("over_first", entry.get("speed_up")))
            row |= _spread("memory_MB", entry["memory_MB"])
            rows.append(row)
    return rows


def _spread(name: str, value: dict[str, float] | None) -> dict[str, float | None]:
    value = value or {}
    return {name: value.get("median"), f"{name}_low": value.get("low"), f"{name}_high": value.get("high")}
