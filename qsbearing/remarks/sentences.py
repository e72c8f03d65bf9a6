"""Sentences of remarks that a format string cannot make: those of several effects, of ranges, of contacts cut."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from string import Formatter
from typing import Any

import numpy as np

from qsbearing.documents.numbers import plain
from qsbearing.model.effects import EFFECTS, Entry
from qsbearing.model.solution.judgement import ANOTHER_RESULT, WORDS, changed, estimated, shifted, unit_of
from qsbearing.model.validation import Setting
from qsbearing.remarks.wording import Audience, Words, listed, spanned


class _InWords(Formatter):
    """Of numbers without powers of ten."""

    def format_field(self, value: Any, spec: str) -> str:
        return plain(value, spec) if isinstance(value, float | int) and spec else format(value, spec)


IN_WORDS = _InWords()


def to_add(settings: Sequence[Setting], words: Words) -> str:
    """What to do for effects that could be named as it is."""
    return _ADD[words.reader].format(", ".join(words.spell(each, "") for each in settings))


def missing(fields: Mapping[str, Any], words: Words) -> str:
    """Effects that could be named as it is, and what each would change."""
    moved = iter(fields.get("displacements_um", ()))
    said = [
        f"{EFFECT[name].what} ({_of_quantity(quantity, _changes(fields, quantity, change, moved))})"
        for name, quantity, change in zip(fields["effects"], fields["quantities"], fields["changes"], strict=True)
    ]
    are = "is" if len(said) == 1 else "are"
    return f"{listed(said)} {are} not included. {to_add(fields['add'], words)}"


def needed(entry: Entry, has_size: bool, words: Words) -> str:
    """What to give for an effect that needs numbers of the scene: in a file not what its bearing has."""
    beside = entry.needs_beside_size if has_size and words.reader is not Audience.PYTHON else ""
    return words.of(beside or entry.needs)


def lacking(fields: Mapping[str, Any], words: Words) -> str:
    """An effect that needs numbers of the scene: what it would change, and what to give."""
    needs = needed(EFFECT[fields["effect"]], bool(fields.get("has_size")), words)
    return f"{_would_change(fields)}. To include it, {_ADVICE[words.reader]} {needs}"


def unknown_to_friction(fields: Mapping[str, Any], words: Words) -> str:
    """An effect that cannot be asked for where friction moves the balls, and what it would change elsewhere."""
    return f"{_would_change(fields)} under outer control. Balls that friction moves do not know it yet"


def _would_change(fields: Mapping[str, Any]) -> str:
    entry, quantity = EFFECT[fields["effect"]], fields["quantity"]
    changes = _changes(fields, quantity, fields["changes"], iter(fields.get("displacements_um", ())), MORE)
    by = [f"{change}{f' ({under})' * bool(under)}" for change, under in zip(changes, fields["under"], strict=True)]
    begun = entry.without_it or f"{entry.what} is not included; it"
    return f"{begun} would change the {_of_quantity(quantity, by if len(set(changes)) > 1 else changes[:1], BY)}"


def differing(fields: Mapping[str, Any], words: Words) -> str:
    """What displacement and stiffness are by all hypotheses, and how to see each."""
    said = [
        f"{fields[name]} is {fields[f'{name}_least']:.4g} to {fields[f'{name}_most']:.4g} {fields[f'{name}_unit']} "
        f"(here {fields[f'{name}_here']:.4g})"
        for name in ("displacement", "stiffness")
        if name in fields and _largest(fields[f"{name}_most"]) > _largest(fields[f"{name}_least"])
    ]
    return f"{DIFFERING} {' and the '.join(said)}. {_LIST[words.reader]}"


def pressing(fields: Mapping[str, Any], words: Words) -> str:
    """Rows that press each other, and what to write so that one of them slides."""
    said = PRESSING.format_map(fields)
    row = f"{fields['slides']:.0f}"
    written = {
        Audience.PYTHON: f": floating=(qs.FloatingGroup(({row},)),)",
        Audience.FILE: f": floating = [{{rows = [{row}]}}]",
    }
    return f"{said}{written.get(words.reader, '')}."


def cut(fields: Mapping[str, Any], words: Words) -> str:
    """A contact cut by the edge, with as many of its numbers as there are."""
    said = f"the ellipse of {fields['raceways']:an} contact runs over the groove's edge"
    if "beyond_percent" not in fields:
        return f"{said}: pressure there exceeds Hertz's"
    written = lambda name: IN_WORDS.format_field(fields[name], ".2g")  # noqa: E731
    said += f", with {written('beyond_percent')} % of its major axis: "
    is_small = "turn_deg" not in fields
    if _largest(fields["beyond_percent"]) >= 10.0:
        said += "it is no longer Hertz's contact; " + "most of it is beyond the edge" * is_small
    elif is_small:
        return f"{said}load and angle hold, and the pressure rises at the edge"
    if not is_small:
        said += (
            f"at the same approach it carries {written('load_loss_percent')} % less load, which acts "
            f"{written('turn_deg')} deg farther from the edge; "
        )
        if "edge_pressure_MPa" not in fields:
            return f"{said}at a sharp edge the pressure has no limit"
        pressure = fields["edge_pressure_MPa"]
        above = "above " if _largest(pressure) >= fields["limit_MPa"] else ""
        said += f"the pressure at the edge is {above}{pressure:.0f} MPa"
    return said


def _largest(number: Any) -> float:
    return float(np.max(number))


MORE, BY = "more than 100", " by "
"""`ANOTHER_RESULT` in a sentence, and what then stands between a quantity and its change."""


def _changes(
    fields: Mapping[str, Any], quantity: str, changes: Sequence[Any], moved: Iterator[Any], more: str = ANOTHER_RESULT
) -> list[str]:
    """Changes of a quantity, each of which may be a `Span`: in its own unit where solved, else relative ones."""
    if quantity == "displacement" and not fields["is_estimated"]:
        return [f"{spanned(shifted, next(moved))} {unit_of(quantity)}" for _ in changes]
    number = estimated if fields["is_estimated"] else changed
    return [f"{spanned(lambda each: more if each > 1.0 else number(each, ''), change)} %" for change in changes]


def _of_quantity(quantity: str, by: Sequence[str], link: str = " ") -> str:
    """What changes most, and by how much."""
    if not quantity:
        return "result: no solution is found with it"
    said = " to ".join(by)
    is_about = link == BY and not said.startswith(("≈", MORE, "0 "))
    return f"{WORDS[quantity]}{link}{'about ' * is_about}{said}"


EFFECT = {entry.name: entry for entry in EFFECTS}
_ADD = {
    Audience.PYTHON: "Set {}",
    Audience.FILE: "Add under [effects]: {}",
    Audience.PAGE: "Tick what is missing in the table of effects",
}
_ADVICE = {Audience.PYTHON: "give", Audience.FILE: "give", Audience.PAGE: "open a scene file that gives"}
DIFFERING = "Raceway control is a hypothesis. By all hypotheses that have a solution, the"
_LIST = {
    Audience.PYTHON: "To see each: qsbearing explain FILE",
    Audience.FILE: "To see each: qsbearing explain FILE",
    Audience.PAGE: "The table of effects has the range",
}
PRESSING = (
    "The rows press each other axially with {pressed_N:.4g} N, which no load and no preload asks for: each is held "
    "where its balls touch in the direction that it carries. State a preload, or let row {slides} slide"
)
