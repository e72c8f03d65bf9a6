"""The validation book: published cases, measured, catalogued, or computed by others; a page for each."""

from __future__ import annotations

from typing import Any

from fem_check.book import picture
from fem_check.book.not_yet import NOT_YET
from fem_check.report.evidence import Evidence, Kept, missing
from fem_check.report.figures.style import INCHES
from fem_check.report.rows import agreement, as_read, badge
from qsbearing.documents.drawing import width_of
from qsbearing.documents.model import Block, Bullets, Facts, Paragraph, Picture, Remark, Section, Table

COMPUTED = (
    "Results that others have computed and published: standards with their worked examples, catalogues, programs. "
    "These are calculations, not measurements."
)
MEASURED = (
    "Physical measurements. Each case names the data that its publication leaves out, and the numbers that were "
    "fitted, predicted, or chosen after seeing the data."
)


def computed(evidence: Evidence) -> Section:
    """Standards, catalogues, other programs."""
    cases = [_page(name, kept) for name, kept in evidence.book.items() if kept.data["kind"] != "M"]
    blocks: list[Block] = [Paragraph(COMPUTED), *_overview(evidence, measured=False), *cases, *_scipy(evidence.scipy)]
    return Section("Other programs, standards, catalogues", blocks, "computed-by-others")


def measured(evidence: Evidence) -> Section:
    """Measurements."""
    cases = [_page(name, kept) for name, kept in evidence.book.items() if kept.data["kind"] == "M"]
    return Section("Measurements", [Paragraph(MEASURED), *_overview(evidence, measured=True), *cases, _not_yet()])


def _not_yet() -> Section:
    """Published cases whose documents are not at hand."""
    rows = [[each["document"], each["would_show"], each["at_hand"]] for each in NOT_YET]
    return Section(
        "Measurements not at hand",
        [Table(("document", "would show", "at hand"), rows, "lll", "Publications that were not at hand", stack=True)],
    )


def _overview(evidence: Evidence, measured: bool) -> list[Block]:
    if not evidence.book:
        return [missing("The validation book", "fem-check book")]
    rows = [
        [kept.data["title"], as_read(kept.data["summary"]), badge(kept.data["verdict"])]
        for kept in evidence.book.values()
        if (kept.data["kind"] == "M") == measured
    ]
    caption = f"{'Measurements' if measured else 'Calculations of others'}, and the result of each case"
    return [Table(("case", "result", "verdict"), rows, "lll", caption, stack=True)] if rows else [Remark("No case.")]


def _page(name: str, kept: Kept) -> Section:
    entry = kept.data
    blocks: list[Block] = [Remark(as_read(f"{entry['question']} {entry['summary']}"), entry["verdict"])]
    blocks.append(Facts([("Kind", entry["kind_text"]), *(("Source", as_read(source)) for source in entry["sources"])]))
    if entry["inputs"]:
        inputs = [[as_read(str(cell)) for cell in each] for each in entry["inputs"]]
        blocks.append(Table(("input", "value", "from"), inputs, "lll", f"{entry['title']}. Inputs", stack=True))
    blocks += _lists(entry)
    blocks += _picture(kept)
    blocks += agreement(entry["rows"], f"{entry['title']}. Agreement")
    points = entry.get("points")
    if points and len(points["rows"]) <= LONGEST:
        rows = [[_cell(value) for value in row] for row in points["rows"]]
        blocks.append(Table(points["columns"], rows, "l" + "r" * (len(points["columns"]) - 1), points["caption"]))
    elif points:
        blocks.append(Paragraph(f"{points['caption'].rstrip('.')}: {len(points['rows'])} points, in the record."))
    return Section(entry["title"], [*blocks, kept.trace], f"book-{name.replace('_', '-')}")


LONGEST = 12
"""Points that a page shows one by one."""

LISTS = {
    "missing": "Not given by the source",
    "fitted": "Fitted",
    "predicted": "Predicted",
    "chosen_after_seeing": "Chosen after seeing the data",
    "does_not_show": "Not shown by this case",
}


def _lists(entry: dict[str, Any]) -> list[Block]:
    items = [f"{heading}: {as_read('; '.join(entry[key]))}" for key, heading in LISTS.items() if entry.get(key)]
    return [Bullets(items)] if items else []


def _picture(kept: Kept) -> list[Block]:
    told = kept.data.get("picture")
    if not told:
        return []
    drawn = picture.svg(kept.data)
    return [Picture(drawn, told["alt"], told["caption"], "svg", width_of(drawn, INCHES))]


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _scipy(kept: Kept | None) -> list[Block]:
    """The same equations left to a library's root finder."""
    if kept is None or "against_scipy" not in kept.data:
        return []
    found = kept.data["against_scipy"]
    rows = [
        ["scipy.optimize.root, all unknowns at once", str(found["scipy_right"]), f"{found['scipy_ms']['median']:g}"],
        ["qsbearing.solve", str(found["solve_right"]), f"{found['solve_ms']['median']:g}"],
    ]
    words = f"The same equations, {found['points']} random operating points of B218, left to a library's root finder."
    headings = ("solved by", f"right, of {found['points']}", "median time, ms")
    table = Table(headings, rows, caption="A library's root finder and this solver")
    return [Section("A library's root finder", [Paragraph(words), table, kept.trace])]
