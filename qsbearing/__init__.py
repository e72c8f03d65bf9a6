"""qsbearing: the quasi-static (Jones-Harris) model of angular-contact ball bearings.

    import qsbearing as qs
    solution = qs.solve(qs.load_scene("b218"))
    solution.inner.angle / qs.deg

SI units and radians everywhere: `22.225 * qs.mm`, `10_000 * qs.rpm`, `40 * qs.deg`.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from qsbearing.model.version import __version__ as __version__


@cache
def _homes() -> dict[str, str]:
    """The module of each public name, from the stub, their one list."""
    import ast
    from pathlib import Path

    stub = ast.parse(Path(__file__).with_suffix(".pyi").read_text("utf-8"))
    parts = (part for part in stub.body if isinstance(part, ast.ImportFrom))
    return {name.name: part.module or "" for part in parts for name in part.names if name.name != "__version__"}


def __getattr__(name: str) -> Any:
    """A public name, imported when it is first used, so that `qsbearing --help` loads no numerical library."""
    from importlib import import_module

    if name == "__all__":
        return sorted(_homes())
    if name.startswith("_") or name not in _homes():
        raise AttributeError(f"module 'qsbearing' has no attribute {name!r}")
    home = _homes()[name]
    value = import_module(f"qsbearing.{name}") if home == "qsbearing" else getattr(import_module(home), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*sorted(_homes()), "__version__"]
