"""Where something was measured: processor, cores, load, versions."""

from __future__ import annotations

from typing import Any

from qsbearing import __version__
from qsbearing.provenance import PACKAGES, hardware, versions


def machine() -> dict[str, Any]:
    """The machine and the packages that the solver rests on."""
    return {**hardware(), **versions(PACKAGES), "qsbearing": __version__}


def in_a_line(found: dict[str, Any]) -> str:
    """The machine for the foot of a figure."""
    versions = ", ".join(f"{name} {found[name]}" for name in ("qsbearing", "python", *PACKAGES))
    return f"{found['processor']}, {found['cores']} cores, load average {found['load_average']}; {versions}"
