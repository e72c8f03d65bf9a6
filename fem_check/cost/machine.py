"""Where something was measured: processor, cores, load, versions."""

from __future__ import annotations

from typing import Any

from fem_check import records_store
from qsbearing.studies.cost.machine import hardware


def machine() -> dict[str, Any]:
    """The machine, and the versions that the numbers rest on."""
    return {**hardware(), **records_store.versions()}


def in_a_line(found: dict[str, Any], solver: str) -> str:
    """The machine for the foot of a figure."""
    packages = ("qsbearing", "python", "numpy", "scipy", "scikit-fem", "rslab", "pypardiso", "scikit-sparse")
    versions = ", ".join(f"{name} {found[name]}" for name in packages if name in found)
    return f"{found['processor']}, {found['cores']} cores; {solver}; {versions}"
