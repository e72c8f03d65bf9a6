"""Where something was measured: processor, cores, load, versions."""

from __future__ import annotations

import os
import platform
from pathlib import Path
from typing import Any

from fem_check import records_store


def machine() -> dict[str, Any]:
    """The machine, and the versions that the numbers rest on."""
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else None
    return {
        "processor": processor(),
        "cores": os.cpu_count(),
        "load_average": None if load is None else round(load, 1),
        "system": platform.system(),
        "python": platform.python_version(),
        **records_store.versions(),
    }


def in_a_line(found: dict[str, Any], solver: str) -> str:
    """The machine for the foot of a figure."""
    packages = ("qsbearing", "python", "numpy", "scipy", "scikit-fem", "rslab", "pypardiso", "scikit-sparse")
    versions = ", ".join(f"{name} {found[name]}" for name in packages if name in found)
    return f"{found['processor']}, {found['cores']} cores; {solver}; {versions}"


def processor() -> str:
    """The processor's name."""
    info = Path("/proc/cpuinfo")
    if info.exists():
        for line in info.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()
