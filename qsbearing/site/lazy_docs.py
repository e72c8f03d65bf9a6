"""Docstrings of arrays that a solution reads off when they are asked for: `angle = Lazy[NDArray]("From the ...")`."""

from __future__ import annotations

import ast
from typing import Any

import griffe


class LazyDocs(griffe.Extension):
    """The text given to `Lazy` is the attribute's docstring; its type is the one in brackets."""

    def on_attribute_instance(self, *, node: Any, attr: griffe.Attribute, **more: Any) -> None:
        value = node.value if isinstance(node, ast.Assign) else None
        is_lazy = isinstance(value, ast.Call) and ast.unparse(value.func).startswith("Lazy[")
        if is_lazy and isinstance(value, ast.Call) and isinstance(value.args[0], ast.Constant):
            attr.docstring = griffe.Docstring(str(value.args[0].value), lineno=node.lineno, parent=attr)
            attr.annotation = ast.unparse(value.func.slice) if isinstance(value.func, ast.Subscript) else None
            attr.value = None
