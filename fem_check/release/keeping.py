"""The folder that the gate fills: where it may be, emptying it, and making its records those of the repository."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from fem_check import records_store
from fem_check.release import manifest
from fem_check.release.journal import Journal, path_of
from fem_check.release.previous import RECORDS
from fem_check.release.steps import Place
from fem_check.release.tree import TreeError


def check_out(place: Place) -> None:
    """Refuse a folder whose files would be changes of the tree.

    Raises:
        TreeError: it is one.
    """
    if not place.out.is_relative_to(place.root):
        return
    asked = ["git", "-C", str(place.root), "check-ignore", "-q", str(place.out / manifest.NAME)]
    if subprocess.run(asked, check=False).returncode:
        raise TreeError(f"--out {place.out}: what the gate makes there would be changes of the tree; name another")


def clear(place: Place) -> None:
    """Remove what an earlier gate made there, and nothing else."""
    kept = place.out / manifest.NAME
    for name in manifest.read(kept) or {}:
        (place.out / name).unlink(missing_ok=True)
    for path in (kept, path_of(place.out, place.level)):
        path.unlink(missing_ok=True)
    shutil.rmtree(place.gate, ignore_errors=True)


def keep(journal: Journal) -> list[Path]:
    """Make a gate's records those of the repository, with their manifest; returns what was written, to be committed."""
    place = journal.place
    folder = place.root / RECORDS
    names = [name for done in journal.steps.values() for name in done.records]
    written = []
    for name in [*names, path_of(Path(), place.level).as_posix()]:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        records_store.replace(path, (place.out / name).read_bytes())
        written.append(path)
    path = manifest.of_repository(place.root)
    manifest.write(path, manifest.sums(place.root, manifest.SHIPPED))
    return [*written, path]
