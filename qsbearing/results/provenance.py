"""Where a record comes from: version, commit, date, machine, packages, command.

Every record that is kept states it under the key "provenance". A record without the key was kept before there was one;
it reads as "not recorded", and nothing is guessed.
"""

from __future__ import annotations

import os
import platform
import subprocess
from collections.abc import Iterable
from datetime import UTC, datetime
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from qsbearing.model.version import __version__

FOLDER = Path(__file__).parents[2]
"""The source tree, where this is one."""

PACKAGES = ("numpy", "numba", "scipy")
"""On which every number rests."""


def of_run(command: str, level: str | None = None, packages: Iterable[str] = ()) -> dict[str, Any]:
    """What a record states of the run that made it.

    Args:
        command: that makes the record anew.
        level: of the run, where it has one.
        packages: beyond `PACKAGES`; those that are not installed are left out.
    """
    return {
        "qsbearing": __version__,
        "commit": commit(),
        "dirty": is_dirty(),
        "date": now(),
        "machine": hardware(),
        "packages": versions((*PACKAGES, *packages)),
        "command": command,
        "level": level,
    }


def now() -> str:
    """Date and time, UTC, to the second."""
    return datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def commit() -> str | None:
    """Of the source tree that runs; None where it is none, as in an installed package."""
    return _source()[0]


def is_dirty() -> bool | None:
    """Whether the source tree differs from its commit; None where there is none."""
    return _source()[1]


@cache
def _source() -> tuple[str | None, bool | None]:
    """Commit and changes as first asked for: what a process writes into its tree later did not make its numbers."""
    if not (FOLDER / ".git").exists():
        return None, None
    try:
        return git("rev-parse", "HEAD").strip(), bool(git("status", "--porcelain").strip())
    except (OSError, subprocess.SubprocessError):
        return None, None


def git(*arguments: str, folder: Path | None = None) -> str:
    """What git prints, of the source tree or of another folder.

    Raises:
        OSError, subprocess.SubprocessError: there is no git, or it fails.
    """
    command = ["git", "-C", str(folder or FOLDER), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout


def hardware() -> dict[str, Any]:
    """The machine, what else ran on it, its system and Python."""
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else None
    return {
        "processor": processor(),
        "cores": os.cpu_count(),
        "memory_GB": memory_GB(),
        "load_average": None if load is None else round(load, 1),
        "system": f"{platform.system()} {platform.release().partition('-')[0]}".strip(),
        "python": platform.python_version(),
    }


def processor() -> str:
    """The processor's name."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def memory_GB() -> float | None:
    """Of the machine (10⁹ bytes), to three digits; None where the system does not say."""
    try:
        return float(f"{os.sysconf('SC_PAGE_SIZE') * os.sysconf('SC_PHYS_PAGES') / 1e9:.3g}")
    except (AttributeError, ValueError, OSError):
        return None


def versions(packages: Iterable[str]) -> dict[str, str]:
    """Of the packages that are installed."""
    installed = {}
    for name in packages:
        try:
            installed[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return installed
