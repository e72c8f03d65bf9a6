"""Docstrings that stand elsewhere than below their attribute, so that nothing is said twice.

Of arrays that a solution reads off when they are asked for: `angle = Lazy[NDArray]("From the ...")`. Of attributes
without words of their own: those of the class that they come from, of what their kind of class has in common, or of
their type.
"""

from __future__ import annotations

import ast
import re
from typing import Any

import griffe

IN_COMMON = {
    "model.effects": {
        "name": "What files, records and studies call it.",
        "of_each_ball": "Its fields with a number for each ball, along their last axis.",
    }
}
"""Of the classes of a folder: what all have in the same sense."""


class LazyDocs(griffe.Extension):
    """The text given to `Lazy` is the attribute's docstring; its type is the one in brackets."""

    def on_attribute_instance(self, *, node: Any, attr: griffe.Attribute, **more: Any) -> None:
        value = node.value if isinstance(node, ast.Assign) else None
        is_lazy = isinstance(value, ast.Call) and ast.unparse(value.func).startswith("Lazy[")
        if is_lazy and isinstance(value, ast.Call) and isinstance(value.args[0], ast.Constant):
            attr.docstring = griffe.Docstring(str(value.args[0].value), lineno=node.lineno, parent=attr)
            attr.annotation = ast.unparse(value.func.slice) if isinstance(value.func, ast.Subscript) else None
            attr.value = None

    def on_package(self, *, pkg: griffe.Module, loader: griffe.GriffeLoader, **more: Any) -> None:
        for of in _classes(pkg):
            for attr in of.members.values():
                if not attr.is_alias and attr.is_attribute and not attr.docstring and not attr.name.startswith("_"):
                    words = _words_for(attr, of, pkg)
                    attr.docstring = griffe.Docstring(words, parent=attr) if words else None


def _classes(within: Any) -> Any:
    for each in within.members.values():
        if not each.is_alias and (each.is_class or each.is_module):
            yield from [each] if each.is_class else _classes(each)


def _words_for(attr: Any, of: Any, package: Any) -> str:
    for base in filter(None, (_class_named(str(each), of, package) for each in of.bases)):
        if attr.name in base.members and base.members[attr.name].docstring:
            return str(base.members[attr.name].docstring.value)
    for folder, told in IN_COMMON.items():
        if of.path.startswith(f"{package.path}.{folder}.") and attr.name in told:
            return told[attr.name]
    kind = _class_named(re.sub(r"^tuple\[(\w+), \.\.\.\]$|^(\w+) \| None$", r"\1\2", str(attr.annotation)), of, package)
    return str(kind.docstring.value).partition("\n\n")[0] if kind is not None and kind.docstring else ""


def _class_named(name: str, of: Any, package: Any) -> Any:
    """A class of the package, by what it is called where another class stands; None for anything else."""
    if not re.fullmatch(r"[A-Za-z]\w*", name):
        return None
    try:
        path = of.module.resolve(name)
        named = package[path.removeprefix(f"{package.path}.")]
    except (griffe.NameResolutionError, KeyError):
        return None
    named = named.final_target if named.is_alias else named
    return named if named.is_class else None
