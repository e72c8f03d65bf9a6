"""Every row of agreement in one table, which readers of the HTML page may sort and filter."""

from __future__ import annotations

from fem_check.report.evidence import Evidence
from fem_check.report.rows import ALIGN, HEADINGS, as_read, cells
from qsbearing.documents.model import Cell, Md, Paragraph, Section, Table


def section(evidence: Evidence) -> Section:
    """The table."""
    rows: list[list[Cell]] = []
    for prefix, group in (("check", evidence.checks), ("book", evidence.book)):
        for name, kept in group.items():
            link = Md(f"[{name}](#{prefix}-{name.replace('_', '-')})")
            rows += [[link, as_read(row["case"]), *cells(row)] for row in kept.data["rows"]]
    words = Md(
        "Each row leads to its section, which names the record and what it was made with. To run one again: "
        "`fem-check run CHECK --level LEVEL`, or `fem-check book CASE`."
    )
    table = Table(("check", "case", *HEADINGS), rows, f"ll{ALIGN}", "All rows of agreement", tools=True)
    return Section("Every row of agreement", [Paragraph(words), table], "every-row")
