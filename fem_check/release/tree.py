"""The source tree under test: where it is, its commit, what in it is not committed."""

from __future__ import annotations

import subprocess
from pathlib import Path

from qsbearing import provenance

NEEDED = ("tests/campaign/__main__.py", "tests/hard_cases/table.py", "tests/benchmarks/ratios.py")
"""What the gate runs beside the package; only a checkout has it."""


class TreeError(Exception):
    """There is no source tree to test; the message says why."""


def root() -> Path:
    """The checkout that this package is part of.

    Raises:
        TreeError: it is installed without one, or git cannot read it.
    """
    folder = Path(__file__).parents[2]
    missing = [name for name in NEEDED if not (folder / name).is_file()]
    if missing:
        raise TreeError(
            f"{folder} is no checkout of the source ({', '.join(missing)} missing): clone the repository, "
            "`pip install -e '.[dev]'`, and run the gate there"
        )
    head(folder)
    return folder


def head(folder: Path) -> str:
    """The commit that is checked out.

    Raises:
        TreeError: git does not say.
    """
    try:
        return provenance.git("rev-parse", "HEAD", folder=folder).strip()
    except (OSError, subprocess.SubprocessError) as problem:
        said = getattr(problem, "stderr", None) or str(problem)
        raise TreeError(f"git does not say which commit of {folder} is checked out: {said.strip()}") from problem


def changes(folder: Path) -> list[str]:
    """Files that differ from the commit or are not in it, without those that .gitignore names."""
    found = provenance.git("status", "--porcelain", "-z", folder=folder).split("\0")
    return sorted(entry[3:] for entry in found if entry[2:3] == " ")
