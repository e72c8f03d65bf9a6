"""The cost record on disk: written whole or not at all, one file for each level."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypedDict, cast

from fem_check.rows.agreement import MeshLevel
from fem_check.rows.record import entries_of
from fem_check.running import records_store


class Spread(TypedDict):
    """Seconds of several runs, to three digits."""

    median: float
    low: float
    high: float


class OnMesh(TypedDict):
    """What one mesh makes of the contact."""

    family: str
    elements_per_semi_axis: int
    dofs: int
    element_size: float
    error: dict[str, float]
    """Of each quantity against Hertz, over it."""
    worst_error: float
    position_uncertainty: dict[str, float]
    solver: str


class MeshRun(OnMesh):
    """One run, in a process of its own."""

    seconds: float
    peak_memory_MB: float


class MeshCost(OnMesh):
    """All runs: their times, and the median of their memory."""

    seconds: Spread
    peak_memory_MB: int


class FormCost(TypedDict):
    """One closed form."""

    label: str
    error: dict[str, float]
    worst_error: float
    seconds: Spread


class CostRecord(TypedDict):
    """What `fem-check cost` measures."""

    level: str
    made_by: str
    machine: dict[str, Any]
    contact: str
    ellipticity: float
    solver: str
    meshes: list[MeshCost]
    closed_forms: list[FormCost]
    seconds: float
    provenance: dict[str, Any]


FIELDS = entries_of(CostRecord)


def path_of(level: str, records: Path) -> Path:
    """Where a level's cost record is kept in a folder of records."""
    return records / "cost" / f"{level}.json"


def read(records: Path = records_store.FOLDER) -> CostRecord | None:
    """The release level's record where there is one, else the quick level's; None for neither.

    Raises:
        RecordError: a file that is no cost record.
    """
    for level in (MeshLevel.RELEASE, MeshLevel.QUICK):
        path = path_of(level, records)
        if path.is_file():
            entry = records_store.read(path, FIELDS, "no cost record", "run `fem-check cost` again")
            return cast(CostRecord, entry)
    return None
