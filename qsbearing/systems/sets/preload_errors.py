"""What is wrong with the preload of a set, and with the directions in which its rows carry."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from qsbearing.model.scene.preload import NOT_A_PRELOAD, Preload
from qsbearing.model.validation import ErrorDetail, Field, Sentence
from qsbearing.systems.sets.location import LOCATED, carried, is_deep_groove, opposes
from qsbearing.systems.sets.row import ONE_WAY, Direction, Row


def preload_errors(of: Any) -> list[ErrorDetail]:
    """Of a `BearingSet` whose groups name rows that there are."""
    sprung = [row for row in of.rows if row.sprung]
    if of.preload is not None and not isinstance(of.preload, Preload):
        return [ErrorDetail("preload", "is not a preload", of.preload, cause=NOT_A_PRELOAD)]
    kind = None if of.preload is None else of.preload.kind
    errors = list(_direction_errors(of))
    if kind == "spring" and not sprung:
        cause = "Give sprung = true to each row whose outer ring slides and is preloaded"
        errors.append(ErrorDetail("preload.spring", "is given, but no row is sprung", cause=cause))
    if kind != "spring" and sprung:
        cause = Sentence("Give {spring}, or leave sprung out", spring=Field("preload.spring"))
        errors.append(ErrorDetail("preload.spring", "missing", cause=cause, detail="a row is sprung"))
    if len({row.sign for row in sprung}) > 1:
        cause = "Spring only rows that carry in one direction; the other rows react against them"
        errors.append(ErrorDetail("preload.spring", "presses rows that carry in opposite directions", cause=cause))
    one_sided = [row for row, both in zip(of.rows, of.is_two_sided, strict=True) if not both]
    directions = {way for row in (of.rows if kind == "spring" else one_sided) for way in carried(row)}
    if kind not in (None, "spring") and len(directions) == 2 and not any(opposes(of, each) for each, _ in of.groups):
        cause = (
            "No group of rows, in the housing or floating, carries in both directions: give the floating group a force"
        )
        errors.append(ErrorDetail(f"preload.{kind}", "has no row to press against", cause=cause))
    if kind is not None and len(directions) < 2 and all(row.carries in (None, *Direction) for row in of.rows):
        ways = ", ".join("+x" if way > 0.0 else "-x" for way in directions)
        all_in = f"All rows carry in {ways}" if ways else "No row says in which direction it is pressed"
        cause = f"{all_in}: let some carry in the other direction, or give an axial load"
        errors.append(ErrorDetail(f"preload.{kind}", "has no row to press against", cause=cause))
    return errors


def _direction_errors(of: Any) -> Iterator[ErrorDetail]:
    held = {n for group, preload in of.groups if preload is not None and preload.kind != "spring" for n in group}
    for number, row in enumerate(of.rows):
        problem = _direction_problem(row, number in held)
        if problem is not None:
            what, cause = problem
            value = None if row.carries is None else str(row.carries)
            yield ErrorDetail(f"row {number + 1}.carries", what, value, cause=cause)


def _direction_problem(row: Row, is_held: bool) -> tuple[str, str] | None:
    """(what is wrong, what to write) of a row, which a preload that holds rings may press."""
    if not is_deep_groove(row):
        slides = (
            'Write "+x" or "-x", the axial load on the shaft that presses its balls; for one that slides in its '
            "housing, give a floating group of this row"
        )
        return ("is of deep-groove rows only", slides) if row.carries in LOCATED else None
    if row.sprung and row.carries not in ONE_WAY:
        problem = "missing" if row.carries is None else "leaves open what the spring presses"
        return problem, 'Say which way the spring presses this row: "+x" or "-x"'
    if is_held and row.carries is None:
        return "missing, and a preload holds the rings", (
            'Say which way the preload presses this row, "+x" or "-x"; of a row that it does not press, "both" where '
            'its outer ring is held, "none" where it slides'
        )
    return None
