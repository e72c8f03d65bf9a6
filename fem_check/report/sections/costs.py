"""The cost of accuracy: levels of the model, and elements of a contact."""

from __future__ import annotations

from typing import cast

from fem_check.cost import picture as cost_picture
from fem_check.cost import table as cost_table
from fem_check.cost.record import CostRecord
from fem_check.report.evidence import Evidence, Kept, missing
from fem_check.rows import row_text
from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Callout, Md, Paragraph, Section


def section(evidence: Evidence) -> Section:
    """Time and memory against accuracy."""
    return Section(
        "Cost of accuracy",
        [
            Section("Levels of the model", _levels(evidence.model_cost, evidence.auto_accuracy)),
            Section("Elements of one contact", _elements(evidence.cost)),
        ],
        "cost",
    )


def _levels(kept: Kept | None, auto: Kept | None) -> list[Block]:
    blocks: list[Block] = []
    if auto is not None:
        record, worst = auto.data, auto.data["worst"][0]
        points = f"{record['within_tolerance']} of {record['scenes']} random operating points"
        off = f"{worst['error']:.2g} ({row_text.in_words(worst['quantity'])})"
        words = (
            f"**Effects chosen by a tolerance of {record['tolerance']:g}: {points} stayed within it.** In "
            f"{record['something_left_out']} an effect was left out; the worst is off by {off}."
        )
        blocks += [Callout(Md(words), "finding"), auto.trace]
    if kept is None:
        return [*blocks, missing("The cost of the model's levels", "model_cost")]
    from qsbearing.studies.cost import tables

    levels, *_ = (block for block in tables.report(kept.data) if not isinstance(block, Paragraph))
    return [*blocks, levels, kept.trace]


def _elements(kept: Kept | None) -> list[Block]:
    if kept is None:
        return [missing("The cost of the elements", "fem-check cost --level release")]
    record = cast(CostRecord, kept.data)
    figure = cost_picture.draw(record)
    drawn = picture(
        figure, "Worst error against time in double logarithms, a line for every family of elements.",
        "Error of one contact against its time, a line for each family of elements", 0.6,
    )  # fmt: skip
    cost_picture.plt.close(figure)
    return [Paragraph(cost_table.remark(record).replace("`", "")), drawn, kept.trace]
