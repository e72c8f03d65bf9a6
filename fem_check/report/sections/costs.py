"""The cost of accuracy: levels of the model, and elements of a contact."""

from __future__ import annotations

from fem_check.cost import picture as cost_picture
from fem_check.cost import table as cost_table
from fem_check.report.evidence import Evidence, Kept, missing
from fem_check.rows import row_text
from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Paragraph, Section


def section(evidence: Evidence) -> Section:
    """Time and memory against accuracy."""
    return Section(
        "Cost of accuracy",
        [
            Section("Levels of the model", _levels(evidence.model_cost, evidence.auto_accuracy)),
            Section("Elements of one contact", _elements(evidence.cost)),
        ],
    )


def _levels(kept: Kept | None, auto: Kept | None) -> list[Block]:
    if kept is None:
        return [missing("The cost of the model's levels", "qsbearing cost SCENE --out DIR")]
    from qsbearing.studies.cost import figures, tables

    speeds = picture(
        figures.speeds(kept.data),
        "Errors of angles, loads, pressures, displacement and stiffness against the speed, a line for every level.",
        "Errors of every level against the finest, over the speed. A peak at a single speed: there two levels choose "
        "another controlling raceway for one of the balls",
        1.0,
    )
    blocks = [*tables.report(kept.data), speeds, kept.trace]
    if auto is not None:
        found = auto.data
        worst = found["worst"][0]
        words = (
            f"Effects chosen by a tolerance of {found['tolerance']:g}: of {found['scenes']} random operating points "
            f"{found['within_tolerance']} stayed within it and {found['something_left_out']} left something out; the "
            f"worst is off by {worst['error']:.3g} ({row_text.in_words(worst['quantity'])}). On average it took "
            f"{found['solves_mean']:g} solves."
        )
        blocks += [Paragraph(words), auto.trace]
    return blocks


def _elements(kept: Kept | None) -> list[Block]:
    if kept is None:
        return [missing("The cost of the elements", "fem-check cost --level release")]
    found = kept.data
    figure = cost_picture.draw(found)
    drawn = picture(
        figure, "Worst error against time in double logarithms, a line for every family of elements.",
        "Error of one contact against its time, a line for each family of elements", 0.65,
    )  # fmt: skip
    cost_picture.plt.close(figure)
    remark = cost_table.remark(found).replace("`", "")
    return [Paragraph(remark), drawn, cost_table.mesh_choices(found), kept.trace]
