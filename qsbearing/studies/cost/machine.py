"""Where something was measured: processor, cores, load, versions."""

from __future__ import annotations

import os
import platform
from importlib import metadata
from pathlib import Path
from typing import Any

from qsbearing import __version__

PACKAGES = ("numpy", "numba", "scipy")


def hardware() -> dict[str, Any]:
    """The machine, what else ran on it, its system and Python."""
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else None
    return {
        "processor": processor(),
        "cores": os.cpu_count(),
        "load_average": None if load is None else round(load, 1),
        "system": platform.system(),
        "python": platform.python_version(),
    }


def machine() -> dict[str, Any]:
    """The machine and the packages that the solver rests on."""
    return {**hardware(), **{name: metadata.version(name) for name in PACKAGES}, "qsbearing": __version__}


def in_a_line(found: dict[str, Any]) -> str:
    """The machine for the foot of a figure."""
    versions = ", ".join(f"{name} {found[name]}" for name in ("qsbearing", "python", *PACKAGES))
    return f"{found['processor']}, {found['cores']} cores, load average {found['load_average']}; {versions}"


def processor() -> str:
    """The processor's name."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
