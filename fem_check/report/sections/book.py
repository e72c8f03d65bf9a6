"""The validation book: published cases, measured, catalogued, or computed by others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

from fem_check.book import picture
from fem_check.book.not_yet import NOT_YET
from fem_check.book.records import BookRecord
from fem_check.report.evidence import Evidence, Kept, missing
from fem_check.report.figures.style import INCHES
from fem_check.report.questions import is_counter_example
from fem_check.report.rows import badge, reasons, table, used, worst
from qsbearing.documents.drawing import width_of
from qsbearing.documents.model import Block, Bullets, Callout, Cell, Facts, Md, Paragraph, Picture, Section, Table

COMPUTED = (
    "Results that others have computed and published: standards with their worked examples, catalogues, programs. "
    "These are calculations, not measurements."
)
MEASURED = (
    "Physical measurements. Each case names the data that its publication leaves out, and the numbers that were "
    "fitted, predicted, or chosen after seeing the data."
)
LISTS = {
    "missing": "Not given by the source",
    "fitted": "Fitted",
    "predicted": "Predicted",
    "chosen_after_seeing": "Chosen after seeing the data",
    "does_not_show": "Not shown by this case",
}
LONGEST = 12
"""Points that a page shows one by one."""


def sections(evidence: Evidence, whole: bool = False) -> list[Section]:
    """What others computed, in a table but for counter-examples, and what was measured, a card each.

    Args:
        whole: a page of each case instead, with inputs, sources, every row, and the reasons of limits.
    """
    records = evidence.book.values()
    measured = [kept for kept in records if kept.data["kind"] == "M"]
    computed = [kept for kept in records if kept.data["kind"] != "M"]
    if whole:
        first: list[Block] = list(map(_page, computed))
        last: list[Block] = [*map(_page, measured), _not_yet()]
    else:
        first = [*_overview(computed), *(_card(kept) for kept in computed if is_counter_example(kept.data))]
        last = list(map(_card, measured))
    first = [Paragraph(COMPUTED), *first] if computed else [missing("The validation book", "fem-check book")]
    parts = [Section("Other programs, standards, catalogues", [*first, *_scipy(evidence.scipy)], "published")]
    return [*parts, Section("Measurements", [Paragraph(MEASURED), *last], "measurements")] if measured else parts


def _overview(records: Sequence[Kept]) -> list[Block]:
    """A line for each case: its result, and the row nearest to its limit."""
    expected = [kept for kept in records if not is_counter_example(kept.data)]
    lines: list[list[Cell]] = []
    for kept in expected:
        row = max(kept.data["rows"], key=used)
        near = table([(1, row)]).rows[0]
        what, limit = (str(near[column]) for column in (2, 3))  # type: ignore[index]
        name = f"{row['quantity']}: {what} of {limit}" if limit else ""
        lines.append([kept.data["title"], kept.data["summary"], name, badge(kept.data["verdict"])])
    good = sum(kept.data["verdict"] == "pass" for kept in expected)
    words = Md(
        f"**{good} of {len(expected)} published cases are met within their limits.** `fem-check book` writes a page "
        "with each case whole: inputs, sources, picture, every row."
    )
    headings = ("case", "result", "nearest to its limit", "verdict")
    shown = Table(headings, lines, "llll", "Calculations of others", stack=True)
    return [Callout(words, "pass" if good == len(expected) else "fail"), shown]


def _card(kept: Kept) -> Section:
    entry = cast(BookRecord, kept.data)
    shown = [_answer(entry), *_picture(entry, 0.5), table(worst(entry["rows"]))]
    return Section(entry["title"], [*shown, *_lists(entry), kept.trace], _anchor(entry))


def _anchor(entry: BookRecord) -> str:
    return f"book-{entry['case'].replace('_', '-')}"


def _answer(entry: BookRecord) -> Callout:
    """The result; of a counter-example that it is one: to meet it would be no success."""
    summary = entry["summary"]
    if is_counter_example(entry):
        return Callout(Md(f"**Counter-example: agreement is not expected.** {summary}"), "finding")
    return Callout(Md(f"**{summary}**"), entry["verdict"])


def _page(kept: Kept) -> Section:
    entry = cast(BookRecord, kept.data)
    blocks: list[Block] = [
        _answer(entry),
        Paragraph(entry["question"]),
        Facts([("Kind", entry["kind_text"]), *(("Source", source) for source in entry["sources"])]),
    ]
    if entry["inputs"]:
        inputs = [[str(cell) for cell in each] for each in entry["inputs"]]
        blocks.append(Table(("input", "value", "from"), inputs, "lll", "Inputs", stack=True))
    blocks += [*_lists(entry), *_picture(entry, 1.0), table([(1, row) for row in entry["rows"]], "Agreement", True)]
    blocks.append(Table(("quantity", "limit", "reason"), reasons(entry["rows"]), "lll", "Limits", stack=True))
    points = entry.get("points")
    if points and len(points["rows"]) <= LONGEST:
        rows = [[_cell(value) for value in row] for row in points["rows"]]
        blocks.append(Table(points["columns"], rows, "l" + "r" * (len(points["columns"]) - 1), points["caption"]))
    elif points:
        blocks.append(Paragraph(f"{points['caption'].rstrip('.')}: {len(points['rows'])} points, in the record."))
    return Section(entry["title"], [*blocks, kept.trace], _anchor(entry))


def _not_yet() -> Section:
    """Published cases whose documents are not at hand."""
    rows = [[each["document"], each["would_show"], each["at_hand"]] for each in NOT_YET]
    return Section(
        "Measurements not at hand",
        [Table(("document", "would show", "at hand"), rows, "lll", "Publications that were not at hand", stack=True)],
    )


def _lists(entry: Mapping[str, Any]) -> list[Block]:
    items = [f"{heading}: {'; '.join(entry[key])}" for key, heading in LISTS.items() if entry.get(key)]
    return [Bullets(items)] if items else []


def _picture(entry: BookRecord, most: float) -> list[Block]:
    told = entry.get("picture")
    if not told:
        return []
    drawn = picture.svg(entry)
    return [Picture(drawn, told["alt"], told["caption"], "svg", min(most, width_of(drawn, INCHES)))]


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _scipy(kept: Kept | None) -> list[Block]:
    """The same equations by a library's root finder."""
    if kept is None or "against_scipy" not in kept.data:
        return []
    counts = kept.data["against_scipy"]
    rows = [
        [name, f"{counts[f'{key}_right']} of {counts['points']}", f"{counts[f'{key}_ms']['median']:g}"]
        for name, key in (("scipy.optimize.root, all unknowns at once", "scipy"), ("qsbearing.solve", "solve"))
    ]
    words = f"{counts['points']} random operating points of B218, compared with scipy.optimize.root."
    table = Table(("solved by", "right", "median time, ms"), rows)
    return [Section("scipy.optimize.root", [Paragraph(words), table, kept.trace], is_whole=True)]
