"""A published case: what its page says, and the function that computes its numbers."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from enum import StrEnum
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BaseModel

from fem_check.rows.agreement import AgreementRow


class EvidenceKind(StrEnum):
    """What a published number is; kinds are never mixed in one case."""

    MEASUREMENT = "M"
    CATALOGUE = "C"
    OTHER_CODE = "B"


EVIDENCE = {
    EvidenceKind.MEASUREMENT: "physical measurement",
    EvidenceKind.CATALOGUE: "calculation in a catalogue, standard or textbook",
    EvidenceKind.OTHER_CODE: "result of another program",
}


@dataclass(frozen=True)
class ValueTable:
    """Every single value of a case."""

    caption: str
    columns: Sequence[str]
    rows: Sequence[Sequence[Any]]


@dataclass(frozen=True)
class Curve:
    """One curve or cloud of a panel; style: line, dashed, dots, circles, crosses, squares, band (low to high), bars."""

    label: str
    style: str
    x: ArrayLike
    y: ArrayLike = ()
    low: ArrayLike = ()
    high: ArrayLike = ()


@dataclass(frozen=True)
class Diagram:
    """One diagram: its axes and its series; `levels` are thin horizontal lines."""

    x_label: str
    y_label: str
    series: Sequence[Curve]
    title: str = ""
    x_scale: str = "linear"
    y_scale: str = "linear"
    levels: Sequence[float] = ()
    x_names: Sequence[str] = ()
    """Names of x = 0, 1, 2 ..., in place of numbers."""


@dataclass(frozen=True)
class CaseResult:
    """What a run of a case found."""

    summary: str
    """One sentence; every number in it is computed."""
    rows: list[AgreementRow]
    panels: list[Diagram]
    """The picture as numbers, from which alone it is drawn."""
    points: ValueTable | None = None

    @property
    def verdict(self) -> str:
        """fail if any row fails."""
        return "fail" if any(row.verdict == "fail" for row in self.rows) else "pass"


class Texts(BaseModel, extra="forbid", frozen=True):
    """What the page of a case says, from its TOML file."""

    title: str
    evidence: EvidenceKind
    question: str
    """What the case asks of the model."""
    sources: list[str]
    caption: str
    alternative: str
    """What the picture shows, for those who cannot see it."""
    inputs: list[tuple[str, str, str]]
    """Each input, its value, and where it comes from."""
    missing: list[str]
    """What the source does not say and the case would need."""
    fitted: list[str]
    predicted: list[str]
    chosen_after_seeing: list[str]
    """Choices made with the published numbers in view."""
    does_not_show: list[str]
    counter_example: bool = False
    """The model is not expected to meet what is published: the case shows how far it is off where it does not apply."""


@dataclass(frozen=True)
class Case:
    """One page of the book: NAME.toml, its texts, and NAME.py, which computes its numbers."""

    name: str
    run: Callable[[], CaseResult]
    needs: tuple[str, ...] = ()
    """Packages of the extra `fem` that it solves with."""

    @property
    def texts(self) -> Texts:
        """What its page says."""
        file = files("fem_check.book.cases") / f"{self.name}.toml"
        return Texts.model_validate(tomllib.loads(file.read_text("utf-8")))


def compared(
    case: str,
    quantity: str,
    unit: str,
    printed: float,
    computed: ArrayLike,
    source: str,
    within: float | None,
    why: str,
    worst_at: str | None = None,
) -> AgreementRow:
    """A row whose tolerance is absolute, in the unit of the quantity; None: a finding without a tolerance."""
    tolerance = None if within is None else 100.0 * within / (abs(printed) or 1.0)
    return AgreementRow(
        case, quantity, unit, printed, source, float(np.asarray(computed)), None, tolerance, why, worst_at
    )


def plain(value: Any) -> Any:
    """Dataclasses, arrays and numpy's numbers as JSON holds them; ten digits, which is what a machine's order of
    summation leaves alone."""
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if isinstance(value, bool | np.bool_):
        return bool(value)
    if isinstance(value, int | np.integer):
        return int(value)
    if isinstance(value, float | np.floating):
        return float(f"{value:.10g}") if np.isfinite(value) else None
    if hasattr(value, "__dataclass_fields__"):
        return plain(asdict(value))
    return value
