"""What of a model nobody has read: every attribute that states something, by the kind of its components.

Results that this program writes itself are none; nor is what is only said of a file or a drawing.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from qsbearing.files.rexs.model import Attribute, Component, Model
from qsbearing.files.rexs.names import spellings
from qsbearing.files.rexs.results import WRITTEN
from qsbearing.model.validation import printable
from qsbearing.remarks.wording import listed

_ABOUT = {
    *("customer", "data_source", "display_color", "model_name", "modification_date", "part_number", "revision_number"),
    *("sequence_number", "version", "referenced_component_id", "name"),
}
"""Attributes that change no result."""
_NOTHING = {"", "0", "false", "none", "null"}


def unread(model: Model, others: set[int]) -> list[str]:
    """A line for each kind of component.

    Args:
        others: components that are named as a whole, since they are not modelled.
    """
    known = {spelling for name in WRITTEN for spelling in spellings(name, model.version)} | _ABOUT
    by_kind: dict[str, dict[str, set[int]]] = {}
    for number, kind, attribute in _attributes(model):
        name = attribute.name
        if number in others or name in known or name.startswith("custom") or (number, name) in model.read:
            continue
        if _states_something(attribute.value):
            by_kind.setdefault(kind, {}).setdefault(name, set()).add(number)
    return [f"of {printable(kind)}: {listed(_named(names))}" for kind, names in sorted(by_kind.items())]


def _attributes(model: Model) -> Iterator[tuple[int, str, Attribute]]:
    """Of all components, and what load cases change."""
    for component in model.components.values():
        yield from _own(component, component.kind)
    for case in model.load_cases:
        for component in case.components.values():
            yield from _own(component, model.components[component.number].kind)


def _own(component: Component, kind: str) -> Iterator[tuple[int, str, Attribute]]:
    yield from ((component.number, kind, each) for each in component.attributes.values())


def _named(names: dict[str, set[int]]) -> list[str]:
    return [
        printable(name) + (f" ({len(numbers)} components)" if len(numbers) > 1 else f" ({min(numbers)})")
        for name, numbers in sorted(names.items())
    ]


def _states_something(value: Any) -> bool:
    """Whether it is anything but 0, false, or a word for nothing."""
    if isinstance(value, list):
        return any(map(_states_something, value))
    if isinstance(value, dict):
        return bool(value.get("value"))
    text = str(value).strip().lower() if value is not None else ""
    try:
        return float(text) != 0.0
    except ValueError:
        return text not in _NOTHING
