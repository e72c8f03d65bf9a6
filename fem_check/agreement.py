"""A row of agreement, and the record of a check: data, from which alone the report is built."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from typing import Any


class Level(StrEnum):
    """How fine the meshes are, and so how expensive the run."""

    QUICK = "quick"
    RELEASE = "release"


class Kind(StrEnum):
    """What a check can show."""

    VERIFICATION = "verification"
    """The equations are solved right: the reference is exact for the same idealised problem."""
    VALIDATION = "validation"
    """How far the idealisation is from the thing: the difference is the finding."""


@dataclass(frozen=True)
class Row:
    """One quantity compared with its reference."""

    case: str
    quantity: str
    unit: str
    reference: float
    reference_source: str
    found: float
    uncertainty_percent: float | None
    """Discretisation uncertainty of the value found, in per cent of the reference (absolute where that is 0)."""
    tolerance_percent: float | None
    """None: reported as a finding, without pass or fail."""
    why_tolerance: str

    @property
    def deviation_percent(self) -> float:
        """(found - reference)/reference in per cent; 100 (found - reference) where the reference is zero."""
        scale = abs(self.reference) or 1.0
        return 100.0 * (self.found - self.reference) / scale

    @property
    def verdict(self) -> str:
        """pass, fail, or finding."""
        if self.tolerance_percent is None:
            return "finding" if math.isfinite(self.found) else "fail"
        deviation = self.deviation_percent
        return "pass" if abs(deviation) <= self.tolerance_percent else "fail"  # NaN fails too

    def as_dict(self) -> dict[str, Any]:
        """As the record keeps it."""
        ordered = asdict(self)
        entries = {
            name: ordered[name] for name in ("case", "quantity", "unit", "reference", "reference_source", "found")
        }
        entries["deviation_percent"] = self.deviation_percent
        entries |= {name: ordered[name] for name in ("uncertainty_percent", "tolerance_percent", "why_tolerance")}
        entries["verdict"] = self.verdict
        return entries


@dataclass
class Findings:
    """Result of a check."""

    rows: list[Row]
    mesh: dict[str, Any] = field(default_factory=dict)
    """elements_per_semi_axis, dofs, file of the finest mesh."""
    solver: str = ""
    pictures: dict[str, Any] = field(default_factory=dict)
    """Series of numbers from which the report draws."""
    notes: list[str] = field(default_factory=list)
    """Conventions and findings that the report prints as they stand; every number in them is computed."""

    @property
    def verdict(self) -> str:
        """fail if any row fails."""
        return "fail" if any(row.verdict == "fail" for row in self.rows) else "pass"


Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class Check:
    """One check: a question, its reference, its tolerance, and the function that runs it."""

    name: str
    question: str
    kind: Kind
    reference: str
    tolerance: str
    run: Callable[[Level, Progress], Findings]
    largest_dofs: Callable[[Level], int]
    """Unknowns of the largest linear system at a level, for the estimate of memory."""
