"""Every row of agreement in one table, which readers may sort and filter; and the commands that make them again."""

from __future__ import annotations

from fem_check.report.evidence import Evidence
from fem_check.report.rows import ALIGN, HEADINGS, cells
from qsbearing.documents.model import Block, Cell, Code, Md, Paragraph, Section, Table


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
    levels = dict.fromkeys(kept.data["level"] for kept in evidence.checks.values())
    lines = [*(f"fem-check run --level {level} --out X" for level in levels), "fem-check report --records X --out DIR"]
    return Section(
        "How to make it again",
        [
            Paragraph("The finite elements, and this report from what they leave:"),
            Code("\n".join(lines), "sh"),
            *_others(evidence),
        ],
        "again",
    )


def _others(evidence: Evidence) -> list[Block]:
    """The commands of the other records, by where they run."""
    seen = {kept.command: kept for kept in evidence.all() if not kept.command.startswith("fem-check run ")}
    found: list[Block] = []
    for words, inside in (
        ("The other records, anywhere:", False),
        ("In a checkout of the repository, since these need files that an installed package does not have:", True),
    ):
        lines = [command for command, kept in seen.items() if kept.needs_checkout == inside]
        if lines:
            found += [Paragraph(words), Code("\n".join(lines), "sh")]
    return found
