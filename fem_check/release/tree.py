"""The source tree under test: where it is, its commit, what in it is not committed."""

from __future__ import annotations

import subprocess
from pathlib import Path

from qsbearing.results import provenance


class TreeError(Exception):
    """There is no source tree to test, or it may not be written to; the message says why."""


def root() -> Path:
    """The checkout that this package is part of.

    Raises:
        TreeError: it is installed without one: without the tests that the gate runs.
    """
    folder = Path(__file__).parents[2]
    if not (folder / "tests" / "verification" / "campaign" / "__main__.py").is_file():
        raise TreeError(
            f"{folder} is not a checkout of the source: clone the repository, run `pip install -e '.[dev]'` in it, and "
            "run the gate there"
        )
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
    statuses = provenance.git("status", "--porcelain", "-z", folder=folder).split("\0")
    return sorted(entry[3:] for entry in statuses if entry[2:3] == " ")


def refuse_inside(folder: Path, out: Path) -> None:
    """Refuse an output folder whose files would be changes of the tree.

    Raises:
        TreeError: it is one.
    """
    command = ["git", "-C", str(folder), "check-ignore", "-q", str(out / "records")]
    if out.is_relative_to(folder) and subprocess.run(command, check=False).returncode:
        raise TreeError(f"--out {out}: what the gate makes there would be changes of the tree; name another")
