"""Page 2: does a real groove press as Hertz says? B218's contacts, half-spaces and true bodies beside his formulas."""

from __future__ import annotations

from fem_check.report.agreement import (
    HEADINGS,
    ContactAgreement,
    contacts_of,
    errs,
    lines,
    made_by,
    solved_right,
)
from fem_check.report.evidence import Evidence, missing
from fem_check.report.figures.ellipses import WIDENED, ellipses
from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Callout, Md, Paragraph, Picture, Section, Table

QUESTION = "Does a real groove press as Hertz says?"
CHECK = "true_geometry"


def section(evidence: Evidence) -> Section:
    """The page."""
    kept = evidence.checks.get(CHECK)
    contacts = contacts_of(kept.data) if kept else []
    if kept is None or not contacts:
        return Section(
            QUESTION, [missing("The agreement of true bodies with Hertz", f"fem-check run {CHECK}")], "agreement"
        )
    blocks: list[Block] = []
    if said := solved_right(contacts):
        blocks.append(Callout(Md(f"**The formulas are solved right.** {said}"), "pass"))
    blocks += [
        Callout(Md(f"**In the real groove Hertz is an approximation.** {errs(contacts)}"), "finding"),
        drawn(contacts),
        Table(HEADINGS, lines(contacts), "llrrrr", f"{contacts[0].bearing}: Hertz and finite elements"),
        Paragraph(made_by(kept.data), is_small=True),
        kept.trace,
    ]
    return Section(QUESTION, blocks, "agreement", is_whole=True)


def drawn(contacts: list[ContactAgreement]) -> Picture:
    """The ellipses."""
    import matplotlib.pyplot as plt

    figure = ellipses(contacts)
    image = picture(figure, alt(contacts), caption(contacts), 1.0)
    plt.close(figure)
    return image


def caption(contacts: list[ContactAgreement]) -> str:
    """What is seen."""
    shown = "pressure of the true bodies" if all(each.pressure for each in contacts) else "ellipses of the true bodies"
    return f"{shown[0].upper()}{shown[1:]}; dashed: Hertz's ellipse. Width × {WIDENED:g}"


def alt(contacts: list[ContactAgreement]) -> str:
    """The picture in words."""
    return (
        f"{len(contacts)} contact ellipses; the true bodies' are shorter and wider than Hertz's, more so at larger "
        "loads. Bars below them show the differences of approach, semi-axes and pressure."
    )
