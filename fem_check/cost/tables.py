"""The cost record as tables: for the terminal, for Markdown, as CSV. They format; nothing is computed."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from rich.box import SIMPLE
from rich.table import Table as RichTable

from fem_check.cost.advice import SEQUENCES
from fem_check.cost.configurations import JUDGED
from fem_check.cost.record import MEASURED, NOT_INSTALLED, REFERENCE, envelope, mesh_refinement, selected
from fem_check.cost.shapes import COUNTS
from fem_check.cost.timing import CONFIDENCE

Record = dict[str, Any]
SHORT_NAMES = {
    "approach": "δ",
    "semi_major_axis": "a",
    "semi_minor_axis": "b",
    "max_pressure": "p0",
    "max_shear_stress": "τmax",
}


@dataclass(frozen=True)
class Table:
    """A title, headings, and rows of text; the first column is a name, the others are numbers."""

    title: str
    headings: tuple[str, ...]
    rows: list[tuple[str, ...]]


def percent(value: float | None, signed: bool = False) -> str:
    """A relative error in per cent, two digits."""
    if value is None:
        return ""
    return f"{100.0 * value:{'+' if signed else ''}.2g}"


UNITS = (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9))


def _unit(seconds: float) -> tuple[str, float]:
    return next((unit for unit in UNITS if seconds >= unit[1]), UNITS[-1])


def duration(seconds: float) -> str:
    """Three digits in a unit that suits them."""
    unit, factor = _unit(seconds)
    return f"{seconds / factor:.3g} {unit}"


def span(spread: dict[str, Any] | None) -> str:
    """Median, smallest and largest of times, in one unit."""
    if spread is None:
        return ""
    unit, factor = _unit(spread["median"])
    median, low, high = (_three(spread[name] / factor) for name in ("median", "low", "high"))
    return f"{median} ({low} to {high}) {unit}"


def _three(value: float) -> str:
    """Three digits, never as a power of ten."""
    return f"{value:.3g}" if value < 999.5 else f"{value:.0f}"


def ratio(spread: dict[str, Any] | None) -> str:
    """A ratio, and its interval."""
    if spread is None:
        return ""
    return f"{spread['median']:.3g} ({spread['low']:.2g} to {spread['high']:.2g})"


def megabytes(spread: dict[str, Any] | None) -> str:
    """Median memory."""
    return "" if spread is None else f"{spread['median']:.0f}"


def with_interval(fit: dict[str, Any]) -> str:
    """An exponent with its interval."""
    if fit["exponent"] is None:
        return ""
    return f"{fit['exponent']:.2f}" + ("" if fit["uncertainty"] is None else f" ± {fit['uncertainty']:.2f}")


def _cost_of(entry: dict[str, Any]) -> tuple[str, ...]:
    """Unknowns, errors, time and memory of a configuration; the reason alone where it was not measured."""
    if entry["status"] != MEASURED:
        return ("", entry["status"], *[""] * (len(JUDGED) + 3))
    return (
        str(entry["dofs"]),
        *(percent(entry["error"][name], signed=True) for name in JUDGED),
        percent(entry["worst_single_position"]),
        span(entry["seconds"]),
        ratio(entry["seconds_over_reference"]),
        megabytes(entry["peak_memory_MB"]),
    )


ERRORS = tuple(f"{short} %" for short in SHORT_NAMES.values())
COST = ("unknowns", *ERRORS, "one position %", "time", f"over {REFERENCE} elements", "MB")


def meshes(record: Record) -> Table:
    """The mesh refinement."""
    refinement = mesh_refinement(record["configurations"], record["main_solver"])
    seconds = {entry["elements_per_semi_axis"]: entry["seconds"]["median"] for entry in refinement}
    rows = []
    for entry in refinement:
        count = entry["elements_per_semi_axis"]
        sequence = SEQUENCES.get(count)
        total = duration(sum(seconds[each] for each in sequence)) if sequence else ""
        rows.append((str(count), *_cost_of(entry), total))
    return Table(
        "20-node hexahedra, exact far field, mean of 8 positions of the edge; last: with two coarser meshes for the "
        "uncertainty",
        ("elements per semi-axis", *COST, "with uncertainty"),
        rows,
    )


def families(record: Record) -> Table:
    """Element families."""
    rows = []
    for name, label in record["families"].items():
        chosen = selected(record["configurations"], family=name, far_field="exact", solver=record["main_solver"])
        rows += [(f"{label}: {entry['elements_per_semi_axis']}", *_cost_of(entry)) for entry in chosen]
    return Table("Element families (elements per semi-axis)", ("elements", *COST), rows)


def far_fields(record: Record) -> Table:
    """Far field exact against clamped."""
    entries = [e for e in selected(record["configurations"], solver=record["main_solver"]) if e["far_field"] != "exact"]
    alike = {entry["elements_per_semi_axis"] for entry in entries}
    exact = [
        e
        for e in mesh_refinement(record["configurations"], record["main_solver"])
        if e["elements_per_semi_axis"] in alike
    ]
    rows = [(f"{e['far_field']}: {e['elements_per_semi_axis']}", *_cost_of(e)) for e in [*exact, *entries]]
    return Table("Far field (elements per semi-axis)", ("far field", *COST), rows)


def solvers(record: Record) -> Table:
    """Linear solvers on the same meshes."""
    counts = sorted(
        {
            e["elements_per_semi_axis"]
            for name in record["solvers"]
            for e in mesh_refinement(record["configurations"], name)
        }
    )
    rows = []
    for name, about in record["solvers"].items():
        if about["status"] == NOT_INSTALLED:
            rows.append((about["label"], NOT_INSTALLED, *[""] * (len(counts) + 1)))
            continue
        refinement = {e["elements_per_semi_axis"]: e for e in mesh_refinement(record["configurations"], name)}
        fit = record["scaling"][name]
        times = (
            f"{duration(refinement[c]['seconds']['median'])}, {megabytes(refinement[c]['peak_memory_MB'])} MB"
            if c in refinement
            else ""
            for c in counts
        )
        rows.append((about["label"], *times, with_interval(fit["time"]), with_interval(fit["memory"])))
    headings = ("solver", *(f"{count} elements" for count in counts), "time ~ unknowns^", "memory ~ unknowns^")
    return Table("Linear solvers, the same contact and mesh: median time, peak memory", headings, rows)


def positions(record: Record) -> Table:
    """Worst errors over all shapes, by number of edge positions."""
    counts = sorted({entry["elements_per_semi_axis"] for entry in record["shapes"]})
    rows = [
        (
            str(count),
            *(percent(envelope(record["shapes"], count, str(count_of_positions))) for count_of_positions in COUNTS),
        )
        for count in counts
    ]
    shapes = ", ".join(f"{k:g}" for k in sorted({entry["ellipticity"] for entry in record["shapes"]}))
    title = f"Worst error in % of δ, a, b, p0, τmax over a/b = {shapes}, worst spacing of the positions"
    return Table(title, ("elements per semi-axis", *(f"{n} position{'s' * (n > 1)}" for n in COUNTS)), rows)


def orders(record: Record) -> Table:
    """Observed orders of convergence beside theory."""
    found = record["orders"]
    rows = [
        (name.replace("_", " "), *(with_interval(found[key][name]) for key in ("one_position", "mean_of_positions")))
        for name in JUDGED
    ]
    rows.append(("theory", *(f"{found['theory'][key]:g}" for key in ("one_position", "mean_of_positions"))))
    return Table("Order of convergence, with 95 % interval", ("quantity", "one position", "mean of 8"), rows)


def closed_forms(record: Record) -> Table:
    """Closed forms."""
    rows = [
        (
            form["label"],
            *(f"{100.0 * form['error'][name]:+.2g}" for name in JUDGED if name in form["error"]),
            span(form["compiled_seconds"]) or "not compiled here",
            span(form["python_seconds"]),
        )
        for form in record["closed_forms"]
    ]
    return Table(
        "Closed forms, time per contact", ("form", *ERRORS[:4], "compiled, in a batch", "one call from Python"), rows
    )


def holdout_contacts(record: Record) -> Table:
    """Hold-out test of the mesh choice."""
    headings = (
        "contact",
        "asked",
        "elements, positions",
        "error",
        "expected",
        "took",
        "ratio",
        "MB expected, taken",
    )
    rows: list[tuple[str, ...]] = []
    for each in record["holdout_contacts"]:
        if each["status"] != MEASURED:
            rows.append((each["contact"], f"{each['asked']:g}", each["status"], *[""] * (len(headings) - 3)))
            continue
        rows.append(
            (
                f"{each['contact']}, a/b = {each['ellipticity']:.1f}",
                f"{each['asked']:g}",
                f"{each['elements_per_semi_axis']}, {each['positions']}",
                f"{each['deviation']:.2g}",
                duration(each["expected_seconds"]),
                duration(each["seconds"]),
                f"{each['seconds_over_expected']:.2f}",
                f"{each['expected_memory_MB']:.0f}, {each['peak_memory_MB']:.0f}",
            )
        )
    return Table("Hold-out test: the mesh choice for contacts that its table was not made from", headings, rows)


TABLES = (closed_forms, meshes, positions, orders, families, far_fields, solvers, holdout_contacts)
"""Every table, in the order of the report."""


WIDTH = 150
"""Characters that the widest table takes, for a file or a pipe; a terminal has its own."""


def rich_table(table: Table) -> RichTable:
    """For the terminal."""
    made = RichTable(title=table.title, title_justify="left", box=SIMPLE, padding=(0, 1), pad_edge=False)
    for index, heading in enumerate(table.headings):
        made.add_column(heading, justify="right" if index else "left", overflow="fold")
    for row in table.rows:
        made.add_row(*row)
    return made


def markdown(table: Table) -> str:
    """For the report."""
    lines = [f"{table.title}:", "", "| " + " | ".join(table.headings) + " |", "|---" * len(table.headings) + "|"]
    lines += ["| " + " | ".join(row) + " |" for row in table.rows]
    return "\n".join(lines)


def text_csv(rows: list[dict[str, Any]]) -> str:
    """Rows of plain values as CSV; nested values are spread over columns joined by dots, None is empty."""
    flattened = [_flattened(row) for row in rows]
    columns = list(dict.fromkeys(name for row in flattened for name in row))
    file = io.StringIO()
    writer = csv.DictWriter(file, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows(flattened)
    return file.getvalue()


def _flattened(row: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, dict):
            found |= _flattened(value, f"{prefix}{name}.")
        else:
            found[prefix + name] = value
    return found


def summary(record: Record) -> str:
    """From closed forms to the finest mesh, for the guide."""
    rows = []
    for form in record["closed_forms"]:
        ellipse = max(abs(form["error"][name]) for name in ("semi_major_axis", "semi_minor_axis"))
        for key, called in (("compiled_seconds", "compiled, in a batch"), ("python_seconds", "one call from Python")):
            if form[key] is not None:
                errors = percent(abs(form["error"]["approach"])), percent(ellipse)
                rows.append((f"{form['label']}, {called}", *errors, span(form[key]), ""))
    for entry in mesh_refinement(record["configurations"], record["main_solver"]):
        ellipse = max(abs(entry["error"][name]) for name in ("semi_major_axis", "semi_minor_axis"))
        rows.append(
            (
                f"finite elements, {entry['elements_per_semi_axis']} per semi-axis, {entry['dofs']:,} unknowns",
                percent(abs(entry["error"]["approach"])),
                percent(ellipse),
                span(entry["seconds"]),
                megabytes(entry["peak_memory_MB"]),
            )
        )
    contact, machine = record["contact"], record["machine"]
    solver, fit = record["solvers"][record["main_solver"]]["label"], record["scaling"][record["main_solver"]]
    lines = [
        "| one contact | error of approach % | of the ellipse % | median time (smallest to largest) | MB |",
        "|---|---|---|---|---|",
        *("| " + " | ".join(row) + " |" for row in rows),
        "",
        f"{contact['name']} at {contact['load_N']:g} N, a/b = {contact['ellipticity']:.2f}, on {machine['cores']} "
        f"cores ({machine['processor']}), linear solver {solver}. Time grows as "
        f"unknowns^({with_interval(fit['time'])}), memory as unknowns^({with_interval(fit['memory'])}), with 95 % "
        "intervals.",
    ]
    return "\n".join(lines)


CSV_PARTS = ("configurations", "shapes", "closed_forms", "holdout_contacts")
"""Parts of the record that are lists of like rows."""


def remarks(record: Record) -> list[str]:
    """Remarks on the tables and figures; every number is the record's."""
    refinement = mesh_refinement(record["configurations"], record["main_solver"])
    machine = record["machine"]
    found = [
        f"Measured on {machine['processor']}, {machine['cores']} cores, load average {machine['load_average']} at the "
        f"start, by `{record['made_by']}`, which took {record['seconds'] / 60.0:.0f} minutes. Times are medians of "
        "repeats taken in turn, each in a process of its own, with the smallest and the largest beside; memory is that "
        "process's peak.",
        "A mesh's error is that of the mean over 8 positions of the contact's edge in an element; the worst of the "
        f"single positions stands beside it. Beside each time stands its ratio to that of {REFERENCE} elements per "
        "semi-axis, taken round by round, with the interval in which a repetition is expected "
        f"({100.0 * CONFIDENCE:g} % each).",
        "The block is divided in depth as 20-node hexahedra need it. Elements of first order need more layers, and "
        "level off without them.",
    ]
    for coarse, fine in pairwise(refinement):
        if fine["worst_error"] > coarse["worst_error"]:
            found.append(
                f"From {coarse['elements_per_semi_axis']} to {fine['elements_per_semi_axis']} elements per semi-axis "
                f"the worst error does not fall ({percent(coarse['worst_error'])} and "
                f"{percent(fine['worst_error'])} %): the error that remains in the mean over the positions depends on "
                "how the ellipse's outline cuts the cells of the surface, which is irregular in their number. More "
                "elements in depth do not change it."
            )
    crossing = [name for name in JUDGED if len({entry["error"][name] > 0.0 for entry in refinement}) > 1]
    if crossing:
        found.append(
            f"The error of {' and '.join(name.replace('_', ' ') for name in crossing)} changes its sign along the "
            "refinement: on a single mesh it may be small by chance. The mesh choice rests on the worst error over all "
            "shapes and spacings of the positions."
        )
    missing = [about["label"] for about in record["solvers"].values() if about["status"] == NOT_INSTALLED]
    if missing:
        found.append(f"Not installed where this was measured: {', '.join(missing)}.")
    failed = [entry for entry in record["configurations"] if entry["status"] != MEASURED]
    for entry in failed:
        found.append(
            f"Not measured: {entry['elements_per_semi_axis']} elements per semi-axis, {entry['family']}, far field "
            f"{entry['far_field']}, {entry['solver']}: {entry['status']}."
        )
    return found
