"""A record as tables."""

from __future__ import annotations

from fem_check.rows import row_text
from fem_check.rows.record import CheckRecord, RowRecord
from qsbearing.documents.model import Badge, Block, Callout, Paragraph, Table
from qsbearing.documents.terminal import STYLES


def agreement_table(entry: CheckRecord) -> list[Block]:
    """A record as tables, one per case."""
    verdict = entry["verdict"]
    lead = f"{entry['check']} ({entry['level']}): {verdict}"
    took = f"{entry['seconds']:.1f} s, {entry['peak_memory_MB']} MB"
    size = f", {entry['mesh']['dofs']} unknowns, {entry['solver']}" if entry["mesh"].get("dofs") else ""
    parts: list[Block] = [Callout(f"{lead}   {took}{size}", verdict, lead, STYLES[verdict])]
    for case in dict.fromkeys(row["case"] for row in entry["rows"]):
        rows = [row for row in entry["rows"] if row["case"] == case]
        cells = []
        for row in rows:
            told, unit = row_text.of_row(row), row_text.in_unit(row)[1]
            name = row_text.in_words(row["quantity"]) + (f", {unit}" if unit else "")
            numbers = (told.reference, told.found, row_text.deviation(row), told.tolerance)
            cells.append((name, *numbers, Badge(row["verdict"])))
        parts.append(Table(("", "reference", "found", "deviation %", "tolerance", ""), cells, "lrrrrl", case))
        parts += [_worst(row) for row in rows if row["worst_at"]]
    return parts


def _worst(row: RowRecord) -> Paragraph:
    return Paragraph(f"{row_text.in_words(row['quantity'])}: worst at {row['worst_at']}")
