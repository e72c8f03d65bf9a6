"""What each key of a file means, in the words of the docstring of the field that it fills."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from typing import Any

from qsbearing.files.keys import key_of
from qsbearing.model.described import choices_of, inputs_of, lists_of, materials_of, parts_of


def meanings() -> dict[str, set[str]]:
    """By key: the first paragraphs of the docstrings of all described fields that it fills; read, not run."""
    import griffe

    package = griffe.load("qsbearing", resolve_aliases=False)
    told: dict[str, set[str]] = {}
    for of in _classes(package):
        documented = _documented(of)
        cls = getattr(import_module(of.module.path), of.name)
        if not hasattr(cls, "__dataclass_fields__"):
            continue
        keys = [(each.name, key_of(each).name) for each in (*inputs_of(cls), *lists_of(cls))]
        keys += [(name, name) for name in (*choices_of(cls), *materials_of(cls), *parts_of(cls))]
        for field, key in keys:
            if documented.get(field):
                told.setdefault(key, set()).add(documented[field])
    return told


def _classes(within: Any) -> Iterator[Any]:
    """Every class of a package of which some field says in its metadata how it is given."""
    for each in within.members.values():
        if each.is_alias:
            continue
        if each.is_module:
            yield from _classes(each)
        elif each.is_class and any("metadata" in str(a.value) for a in each.attributes.values()):
            yield each


def _documented(of: Any) -> dict[str, str]:
    """The first paragraph of the docstring of each field."""
    return {
        name: each.docstring.value.partition("\n\n")[0].replace("\n", " ").strip()
        for name, each in of.attributes.items()
        if each.docstring is not None
    }
