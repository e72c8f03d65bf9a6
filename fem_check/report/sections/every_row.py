"""Every row of agreement in one table, which readers may sort and filter; and the commands that make them again."""

from __future__ import annotations

from fem_check.report.evidence import Evidence
from fem_check.report.rows import ALIGN, HEADINGS, cells
from qsbearing.documents.model import Cell, Code, Md, Paragraph, Section, Table


def section(evidence: Evidence) -> Section:
    """The table."""
    rows: list[list[Cell]] = []
    for prefix, group in (("check", evidence.checks), ("book", evidence.book)):
        for name, kept in group.items():
            link = Md(f"[{name}](#{prefix}-{name.replace('_', '-')})")
            rows += [[link, row["case"], *cells(row)] for row in kept.data["rows"]]
    words = Md(
        "Each row leads to its section, which names the record and what it was made with. To run one again: "
        "`fem-check run CHECK --level LEVEL`, or `fem-check book CASE`."
    )
    table = Table(("check", "case", *HEADINGS), rows, f"ll{ALIGN}", "All rows of agreement", tools=True)
    return Section("Every row of agreement", [Paragraph(words), table], "every-row")


def commands(evidence: Evidence) -> Section:
    """How to make everything anew."""
    seen = dict.fromkeys(kept.command for kept in evidence.all() if not kept.command.startswith("fem-check run "))
    levels = dict.fromkeys(kept.data["level"] for kept in evidence.checks.values())
    lines = [*(f"fem-check run --level {level} --out X" for level in levels), "fem-check report --records X --out DIR"]
    return Section(
        "How to make it again",
        [
            Paragraph("The finite elements, and this report from what they leave:"),
            Code("\n".join(lines), "sh"),
            Paragraph("The other records, each in its place in the repository:"),
            Code("\n".join(seen), "sh"),
        ],
        "again",
    )
