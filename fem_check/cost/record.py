"""The cost record on disk: written whole or not at all, one file for each level."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from fem_check.rows.agreement import MeshLevel
from fem_check.running import records_store

FIELDS = ("level", "made_by", "machine", "contact", "ellipticity", "solver", "meshes", "closed_forms", "seconds")


def path_of(level: str, records: Path) -> Path:
    """Where a level's cost record is kept in a folder of records."""
    return records / "cost" / f"{level}.json"


def read(records: Path = records_store.FOLDER) -> dict[str, Any] | None:
    """The release level's record where there is one, else the quick level's; None for neither.

    Raises:
        RecordError: a file that is no cost record.
    """
    for level in (MeshLevel.RELEASE, MeshLevel.QUICK):
        path = path_of(level, records)
        if path.is_file():
            return records_store.read(path, FIELDS, "no cost record", "run `fem-check cost` again")
    return None
