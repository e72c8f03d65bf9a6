"""The cheapest mesh for an accuracy: proposed by the cost record, accepted by what it reaches on the contact itself.

An accuracy is reached when deviation and uncertainty together are within it. On the record's contact both are known;
on another of another shape they differ somewhat, so a proposal that falls short there is followed by the next.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from fem_check.cost.measurement import JUDGED
from fem_check.cost.record import CostRecord
from fem_check.elements.element_family import SERENDIPITY
from fem_check.mechanics.half_space_contact import ORDERS
from fem_check.rows import convergence
from fem_check.rows.agreement import AgreementRow
from qsbearing.documents.numbers import duration

SEQUENCES = {6: (3, 4, 6), 8: (4, 6, 8), 10: (6, 8, 10), 12: (6, 8, 12), 16: (8, 12, 16)}
"""Meshes solved for a result and its uncertainty, by elements per semi-axis of the finest. Well apart: errors are
irregular in the number of cells, and close meshes may agree by chance."""


class AccuracyError(Exception):
    """No measured mesh meets the accuracy; the message states the best attainable."""


@dataclass(frozen=True)
class MeshChoice:
    """Meshes to solve, with what they take and reach on the record's contact."""

    sequence: tuple[int, ...]
    """Elements per semi-axis, coarse to fine; the last gives the result, all of them its uncertainty."""
    accuracy: float
    """Largest relative deviation from Hertz plus uncertainty."""
    seconds: float
    """For all meshes, on the record's machine."""
    peak_memory_MB: float

    @property
    def message(self) -> str:
        """What will be solved, and what to expect of it."""
        return (
            f"Solving with {', '.join(map(str, self.sequence))} elements per semi-axis: "
            f"{duration(self.seconds)} and {self.peak_memory_MB:.0f} MB where it was measured."
        )


def choices(record: CostRecord) -> list[MeshChoice]:
    """All that a cost record has measured, the cheapest first, but those less accurate than a cheaper one."""
    entries = {e["elements_per_semi_axis"]: e for e in record["meshes"] if e["family"] == SERENDIPITY.label}
    candidates: list[MeshChoice] = []
    for sequence in SEQUENCES.values():
        if not set(sequence) <= set(entries):
            continue
        chosen = [entries[count] for count in sequence]
        sizes = [entry["element_size"] for entry in chosen]
        accuracies = []
        for name in JUDGED:
            errors = [entry["error"][name] for entry in chosen]
            uncertainty = convergence.uncertainty_at_order(sizes, errors, ORDERS[name])
            uncertainty += chosen[-1]["position_uncertainty"][name]
            accuracies.append(abs(errors[-1]) + uncertainty)
        seconds = sum(entry["seconds"]["median"] for entry in chosen)
        candidates.append(MeshChoice(sequence, max(accuracies), seconds, chosen[-1]["peak_memory_MB"]))
    candidates.sort(key=lambda choice: choice.seconds)
    return [
        choice
        for i, choice in enumerate(candidates)
        if all(choice.accuracy < other.accuracy for other in candidates[:i])
    ]


def proposals(accuracy: float, record: CostRecord | None) -> list[MeshChoice]:
    """The choices that reach an accuracy on the record's contact, the cheapest first.

    Raises:
        AccuracyError: none does, or there is no record.
    """
    if record is None:
        raise AccuracyError("there is no cost record to choose a mesh by: name a mesh with --elements")
    every = choices(record)
    good = [choice for choice in every if choice.accuracy <= accuracy]
    if not good:
        best = min(every, key=lambda choice: choice.accuracy)
        raise AccuracyError(
            f"an accuracy of {accuracy:.3g} is beyond the meshes measured: the best attainable is {best.accuracy:.1e}, "
            f"with {best.sequence[-1]} elements per semi-axis"
        )
    return good


def reached(rows: Iterable[AgreementRow]) -> tuple[float, str]:
    """Accuracy reached, and the quantity that it is that of.

    Deviation and uncertainty together; the uncertainty alone of a finding, whose reference is not its exact value.
    """
    accuracies = []
    for row in rows:
        if row.quantity in JUDGED and row.uncertainty_percent is not None:
            deviation = 0.0 if row.tolerance_percent is None else abs(row.deviation_percent)
            accuracies.append((0.01 * (deviation + row.uncertainty_percent), row.quantity))
    return max(accuracies)
