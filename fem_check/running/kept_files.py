"""Files of the repository that a release makes anew: records, and what is written from them.

A commit of these alone may follow the commit that was tested: the evidence is then that of the code which is there.
"""

from __future__ import annotations

import re
import subprocess
from fnmatch import fnmatch
from pathlib import Path

from qsbearing.results import provenance

MANIFEST = "fem_check/records/manifest.json"
RECORDS = (
    "fem_check/records/**/*.json",
    "qsbearing/studies/cost/records/*.json",
    "tests/verification/benchmarks/*.json",
    "tests/verification/hard_cases/*.json",
    "tests/verification/reference/*.json",
    "tests/verification/*.json",
    "tests/relations.json",
)
WRITTEN = (
    "qsbearing/reports/evidence.json",
    "qsbearing/studies/cost/records/pictures/*.png",
    "tests/verification/hard_cases/TABLE.md",
)
"""From records, as a whole."""
OF_REPOSITORY = "repository"
"""Folder, among those that the gate makes, of records that are kept outside the folder of records."""
_FILLED = re.compile(r"(<!-- ([^>]+?): made by [^>]*-->).*?(<!-- end of \2 -->)", re.DOTALL)
"""A part of a page that is written from records."""


def place_of(name: str, repository: Path, records: Path) -> Path:
    """Where a record that the gate made is kept.

    Args:
        name: its path below the gate's folder.
        repository: the checkout.
        records: the folder of records in it.
    """
    inside = name.removeprefix(f"{OF_REPOSITORY}/")
    return (records if inside == name else repository) / inside


def others(tested: str, root: Path | None = None) -> list[str]:
    """Files that differ from this commit and follow from no record; a page counts by what is no table of records.

    Raises:
        OSError, subprocess.SubprocessError: git does not know the commit, or there is none.
    """
    folder = root or provenance.FOLDER
    listed = provenance.git("diff", "--name-only", "--no-renames", "-z", tested, "HEAD", folder=folder).split("\0")
    patterns = (MANIFEST, *RECORDS, *WRITTEN)
    changed = [name for name in listed if name and not any(_fits(name, each) for each in patterns)]
    return [name for name in changed if not (name.endswith(".md") and _is_only_filled(name, tested, folder))]


def _fits(name: str, pattern: str) -> bool:
    """As a shell has it: a star stands for no folder but the double one."""
    if "**/" in pattern:
        start, _, end = pattern.partition("**/")
        return name.startswith(start) and fnmatch(name.rpartition("/")[2], end)
    return name.count("/") == pattern.count("/") and fnmatch(name, pattern)


def _is_only_filled(name: str, tested: str, folder: Path) -> bool:
    """Whether a page is the same beside its tables of records."""
    try:
        both = {_FILLED.sub(r"\1\3", provenance.git("show", f"{at}:{name}", folder=folder)) for at in (tested, "HEAD")}
    except subprocess.SubprocessError:  # a page that is new or gone
        return False
    return len(both) == 1
