"""A row of agreement, and the record of a check: data, from which alone the report is built."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, field, replace
from enum import StrEnum
from typing import Any, Protocol, cast

from fem_check.rows.record import NO_MESH, MeshRecord, RowRecord

EXAMPLE = "b218"
"""The scene that the checks run on unless another is named."""


class MeshLevel(StrEnum):
    """How fine the meshes are, and so how expensive the run."""

    QUICK = "quick"
    RELEASE = "release"


class CheckKind(StrEnum):
    """What a check can show."""

    VERIFICATION = "verification"
    """The equations are solved right: the reference is exact for the same idealised problem."""
    MODEL_COMPARISON = "model comparison"
    """How far the idealisation is from a model with fewer simplifications: the difference is the finding. Validation
    is agreement with measurement, which no check can show."""


@dataclass(frozen=True)
class AgreementRow:
    """One quantity compared with its reference."""

    case: str
    quantity: str
    unit: str
    reference: float
    reference_source: str
    found: float | None
    """None: refused, for the reason in `why_tolerance`; NaN: there was nothing to read, which fails."""
    uncertainty_percent: float | None
    """Discretisation uncertainty of the comparison, in per cent of the reference (absolute where that is 0); None where
    nothing is discretised."""
    tolerance_percent: float | None
    """None: reported as a finding, without pass or fail."""
    why_tolerance: str
    worst_at: str | None = None
    """Where one row stands for several: which of them it is."""

    @property
    def deviation_percent(self) -> float:
        """(found - reference)/reference in per cent; 100 (found - reference) where the reference is zero; NaN where
        nothing was found."""
        if self.found is None:
            return math.nan
        scale = abs(self.reference) or 1.0
        return 100.0 * (self.found - self.reference) / scale

    @property
    def reach_percent(self) -> float:
        """How far the truth may be from the reference: |deviation| + uncertainty."""
        return abs(self.deviation_percent) + (self.uncertainty_percent or 0.0)

    @property
    def verdict(self) -> str:
        """pass where deviation and uncertainty together stay within the tolerance, else fail; finding; refused."""
        if self.found is None:
            return "refused"
        if self.tolerance_percent is None:
            return "finding" if math.isfinite(self.found) else "fail"
        return "pass" if self.reach_percent <= self.tolerance_percent else "fail"  # NaN fails too

    def as_dict(self) -> RowRecord:
        """As the record keeps it; what is no number is None."""
        ordered = asdict(self) | {"deviation_percent": self.deviation_percent, "verdict": self.verdict}
        values = {name: ordered[name] for name in RowRecord.__annotations__}
        kept = {
            name: None if isinstance(each, float) and not math.isfinite(each) else each for name, each in values.items()
        }
        return cast(RowRecord, kept)


@dataclass
class Findings:
    """Result of a check."""

    rows: list[AgreementRow]
    mesh: MeshRecord = field(default_factory=NO_MESH.copy)
    solver: str = ""
    pictures: dict[str, Any] = field(default_factory=dict)
    """Series of numbers from which the report draws."""
    notes: list[str] = field(default_factory=list)
    """Conventions and findings that the report prints as they stand; every number in them is computed."""

    @property
    def verdict(self) -> str:
        """fail if any row fails."""
        return "fail" if any(row.verdict == "fail" for row in self.rows) else "pass"


def collapsed(rows: Iterable[AgreementRow], case: str) -> list[AgreementRow]:
    """One row per quantity in place of many similar ones: the worst, under a case that names what it stands for."""
    worst: dict[str, AgreementRow] = {}
    for row in rows:
        known = worst.get(row.quantity)
        # A reach that is no number counts as the worst.
        if known is None or row.reach_percent > known.reach_percent or math.isnan(row.reach_percent):
            worst[row.quantity] = row
    return [replace(row, case=case, worst_at=row.case) for row in worst.values()]


def covered(case: str, rows: Iterable[AgreementRow]) -> AgreementRow:
    """The verdict on the uncertainties themselves: no deviation from an exact reference may exceed the one beside it.

    Args:
        case: of the row.
        rows: whose references are exact, or as good as that.
    """
    over = {
        f"{row.quantity}: {row.case}": abs(row.deviation_percent) / max(row.uncertainty_percent, 1e-12)
        for row in rows
        if row.uncertainty_percent is not None
    }
    worst = max(over, key=lambda name: math.inf if math.isnan(over[name]) else over[name])
    source = "exact: the uncertainty covers the deviation from an exact reference"
    why = "an uncertainty that its own deviation exceeds is too small"
    return AgreementRow(
        case, "largest deviation over uncertainty", "1", 0.0, source, over[worst], None, 100.0, why, worst
    )


Progress = Callable[[str, float], None]


class Run(Protocol):
    """The function that runs a check."""

    def __call__(self, level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
        """Run it on a scene: a file, or a name of the catalogue; checks that concern no bearing ignore it."""


@dataclass(frozen=True)
class Check:
    """One check: a question, its reference, its tolerance, and the function that runs it."""

    name: str
    question: str
    kind: CheckKind
    reference: str
    tolerance: str
    run: Run
    largest_dofs: Callable[[MeshLevel], int]
    """Unknowns of the largest linear system at a level, for the estimate of memory."""
    at_quick: bool = True
    """Whether a run of all has it at the quick level; by its name it runs at both."""
