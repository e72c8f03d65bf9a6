"""What the file of a set says: rows and where they stand, shaft, operation, preload, bearings; the file as read."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from qsbearing.documents.model import Block, Cell, Paragraph, Section, Table
from qsbearing.files.keys import OPERATION, PRELOAD, Key, keys_of
from qsbearing.files.row_bearing import whole_bearing
from qsbearing.files.set_keys import OF_SET, SET_NUMBERS
from qsbearing.model.described import materials_of, words_of
from qsbearing.model.units import mm, um
from qsbearing.remarks.wording import capital, numbered
from qsbearing.reports.inputs import (
    Line,
    as_read,
    bearing_lines,
    choice_lines,
    document,
    effect_lines,
    grouped,
    numbers,
    reading_lines,
    thermal_groups,
)
from qsbearing.reports.layout import halves
from qsbearing.systems.heat.network import Thermal
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.row import Row
from qsbearing.systems.sets.shaft import HousingStiffness

_TITLES = {"section": "Shaft section", "support": "Support of the shaft"}


def section(of: BearingSet, source: str, heat: Thermal | None = None) -> Section:
    """All of the input.

    Args:
        source: the text of the file.
        heat: [thermal] as given; the set has the temperatures that were found.
    """
    reference = "midway between the first and the last row" if of.reference_position is None else "as given"
    shaft: list[Line] = [("reference_position_mm", f"{float(of.reference / mm):.9g}", "mm", reference)]
    if of.spacers:
        shaft.append(("axial_datum_row", str(of.axial_datum + 1), "", "spacers move the other rows"))
    # At temperatures that are found, each row has the ring effects below.
    rings = of.ring_effects if heat is None or any(row.ring_effects is None for row in of.rows) else ()
    alike = of.rows[0].bearing if all(row.bearing is of.rows[0].bearing for row in of.rows) else None
    named = [*effect_lines((*rings, *of.ball_effects), bearing=alike), *choice_lines(of)]
    rows = grouped(
        ("Shaft", [*shaft, *_others(OF_SET, of, "reference_position"), *numbers(SET_NUMBERS["shaft"], of.shaft)]),
        *_around(of),
        ("Operation", numbers(OPERATION, of.operation)),
        ("Preload", numbers(PRELOAD, of.preload)),
        ("Effects and choices", named),
        *_alike("Effects", [effect_lines(row.ring_effects or (), heat, row.bearing) for row in of.rows]),
        ("Readings", reading_lines(of.readings, alike)),
        *_alike("Readings", [reading_lines(row.readings or {}, row.bearing) for row in of.rows]),
        *thermal_groups(heat),
        *_bearings(of, source),
    )
    words = (
        "All input data, in the units and by the keys of the file. A channel of the shaft that is not named carries no "
        "load and is free to move."
    )
    blocks: list[Block] = [
        _rows(of),
        Paragraph(words),
        halves(("key of the file", "value", "unit", "from"), rows, "lrll"),
    ]
    return Section("Input", blocks + as_read(source))


def _alike(what: str, of_rows: Sequence[list[Line]]) -> list[tuple[str, list[Line]]]:
    """What rows have of their own, once for those that have the same."""
    return [
        (f"{what} of {numbered('row', which)}{' alone' if len(which) == 1 else ''}", lines)
        for which, lines in _by_rows(of_rows)
    ]


def _by_rows(of_rows: Sequence[list[Line]]) -> list[tuple[list[int], list[Line]]]:
    """Lines once, after the numbers of the rows that have them."""
    groups: list[tuple[list[int], list[Line]]] = []
    for number, lines in enumerate(of_rows, 1):
        same = next((numbers for numbers, known in groups if known == lines), None)
        if same is None:
            groups.append(([number], lines))
        else:
            same.append(number)
    return groups


def _around(of: BearingSet) -> list[tuple[str, list[Line]]]:
    """Sections, loads and supports of the shaft, what outer rings sit in, spacers and floating groups."""
    shaft = of.shaft
    standing = {} if shaft is None else {"section": shaft.sections} | shaft.standing
    parts: list[tuple[str, tuple[Any, ...]]] = [
        *((_TITLES.get(kind, f"{capital(kind)} on the shaft"), all_) for kind, all_ in standing.items()),
        ("Spacer", of.spacers),
        ("Floating group", of.floating),
    ]
    sections = [(f"{title} {n}", _of_part(each)) for title, all_ in parts for n, each in enumerate(all_, 1)]
    housings = [(f"Housing of row {n}", row.housing_stiffness) for n, row in enumerate(of.rows, 1)]
    sections += [(title, _housing(own)) for title, own in housings if own is not None]
    sections += [
        (f"Alignment of row {n}'s housing", _others(keys_of(Row), row, "position", "offset"))
        for n, row in enumerate(of.rows, 1)
    ]
    if shaft is not None:
        points = [(f"{name}_mm", f"{at / mm:.9g}", "mm", "") for name, at in shaft.points.items()]
        sections.append(("Points of the shaft", points))
        if shaft.gravity is not None:
            sections.append(
                ("Gravity", [("gravity_m_s2", ", ".join(f"{each:.9g}" for each in shaft.gravity), "m/s2", "")])
            )
    return [*sections, ("Housing", _of_part(of.housing))]


def _others(keys: tuple[Key, ...], holder: Any, *shown: str) -> list[Line]:
    """What another place does not show."""
    return numbers(tuple(key for key in keys if key.field not in shown), holder)


def _housing(of: HousingStiffness) -> list[Line]:
    """Its springs, or its matrix, a line for each row of it."""
    if of.matrix is None:
        return numbers(keys_of(HousingStiffness), of)
    rows = np.asarray(of.matrix, float)
    return [
        (f"matrix_SI, row {n}", ", ".join(f"{value:.9g}" for value in row), "SI", "") for n, row in enumerate(rows, 1)
    ]


def _of_part(part: Any) -> list[Line]:
    """Its numbers and words, the rows that it names, its materials and its preload."""
    lines = numbers(keys_of(type(part)), part)
    for name in ("rows", *materials_of(type(part))):
        value = getattr(part, name, None)
        if value is not None:
            lines.append((name, getattr(value, "name", None) or ", ".join(map(str, value)), "", ""))
    lines += [(name, str(word).lower(), "", "") for name, word in words_of(part).items()]
    return lines + numbers(PRELOAD, getattr(part, "preload", None))


def _rows(of: BearingSet) -> Table:
    """The rows from the least x to the largest; what none of them has is no column."""
    order = sorted(enumerate(of.rows), key=lambda each: float(np.asarray(each[1].position)))
    places = [float(np.asarray(row.position)) / mm for _, row in order]
    distances = ["", *(f"{after - before:.9g}" for before, after in pairwise(places))]
    columns: list[tuple[str, str, list[Cell]]] = [
        ("row", "l", [str(number + 1) for number, _ in order]),
        ("bearing", "l", [row.bearing.name or "-" for _, row in order]),
        ("carries", "l", [str(row.carries) for _, row in order]),
        ("at x, mm", "r", [f"{place:.9g}" for place in places]),
        ("from the row before, mm", "r", list(distances)),
    ]
    if any(float(np.asarray(row.offset)) != 0.0 for row in of.rows):
        columns.append(("offset, µm", "r", [f"{float(np.asarray(row.offset)) / um:.9g}" for _, row in order]))
    if any(row.sprung for row in of.rows):
        columns.append(("outer ring", "l", ["slides, sprung" if row.sprung else "fixed" for _, row in order]))
    headings, sides, cells = zip(*columns, strict=True)
    return Table(headings, list(zip(*cells, strict=True)), "".join(sides), f"Rows: {of.arrangement}")


def _bearings(of: BearingSet, source: str) -> list[tuple[str, list[Line]]]:
    """Each bearing once, with the rows that have it."""
    tables = document(source)
    own = [whole_bearing(row, tables.get("bearing")) for row in tables.get("rows", [{}] * len(of.rows))]
    groups = _by_rows([bearing_lines(row.bearing, "file", table) for row, table in zip(of.rows, own, strict=True)])
    if len(groups) == 1 and len(of.rows) > 1:
        return [("Bearing of all rows", groups[0][1])]
    return [(f"Bearing of {numbered('row', which)}", lines) for which, lines in groups]
