"""Rows and records of checks as they are kept and printed: plain data with fixed keys, from which reports are built."""

from __future__ import annotations

from typing import Any, NotRequired, TypedDict, get_origin, get_type_hints

Record = dict[str, Any]
"""A record of any kind, as read: of a check, a case of the book, a campaign, a benchmark."""


class MeshRecord(TypedDict):
    """The finest mesh; None without one."""

    elements_per_semi_axis: int | None
    dofs: int | None
    file: str | None
    geometry: NotRequired[str]
    """Of chosen contacts: parabolic, true or both."""
    true_dofs: NotRequired[int]
    """Of chosen contacts solved both ways: unknowns of the true bodies."""
    origin: NotRequired[str]
    """Of chosen contacts: where the mesh comes from."""


class RowRecord(TypedDict):
    """An `AgreementRow` and what follows from it; what is no number is None."""

    case: str
    quantity: str
    unit: str
    reference: float
    reference_source: str
    found: float | None
    deviation_percent: float | None
    uncertainty_percent: float | None
    tolerance_percent: float | None
    why_tolerance: str
    verdict: str
    worst_at: str | None


NO_MESH = MeshRecord(elements_per_semi_axis=None, dofs=None, file=None)


class CheckRecord(TypedDict):
    """Findings of a check, or of chosen contacts, which have no question."""

    check: str
    level: str
    scene: str
    verdict: str
    seconds: float
    cpu_seconds: float
    peak_memory_MB: int
    mesh: MeshRecord
    solver: str
    versions: dict[str, str]
    rows: list[RowRecord]
    question: NotRequired[str]
    kind: NotRequired[str]
    reference: NotRequired[str]
    tolerance: NotRequired[str]
    provenance: NotRequired[dict[str, Any]]
    notes: list[str]
    pictures: dict[str, Any]


def entries_of(record: Any) -> tuple[str, ...]:
    """What every record of this TypedDict has, in its order."""
    named = get_type_hints(record, include_extras=True)
    return tuple(name for name, kind in named.items() if get_origin(kind) is not NotRequired)


def computed_value(row: RowRecord) -> float:
    """The number that is compared with the reference, of a row that has one; SI units."""
    assert row["found"] is not None
    return row["found"]


def reach_percent(row: RowRecord) -> float:
    """|deviation| + uncertainty, of a row that has a deviation [%]."""
    return abs(deviation_percent(row)) + (row["uncertainty_percent"] or 0.0)


def deviation_percent(row: RowRecord) -> float:
    """(computed - reference)/reference of a row that has one, or the difference from 0 [%]."""
    assert row["deviation_percent"] is not None
    return row["deviation_percent"]


def tolerance_percent(row: RowRecord) -> float:
    """The tolerance of a row that has one [%]."""
    assert row["tolerance_percent"] is not None
    return row["tolerance_percent"]
