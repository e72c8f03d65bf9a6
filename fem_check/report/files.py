"""The report as files, all or none: an HTML page, a PDF, and every row as CSV and JSON."""

from __future__ import annotations

import csv
import json
from io import StringIO
from pathlib import Path
from typing import Any

from fem_check.book.records import folder_of
from fem_check.report import validation
from fem_check.report.evidence import Evidence, published
from fem_check.report.sections import book
from fem_check.running import records_store
from qsbearing.documents.html import html
from qsbearing.documents.model import Document
from qsbearing.documents.pdf import pdf

NAME = "validation_report"


def write(evidence: Evidence, before: Evidence | None, out: Path) -> list[Path]:
    """Write all forms into a folder; returns their paths.

    Raises:
        OSError: the folder cannot be written.
    """
    out.mkdir(parents=True, exist_ok=True)
    whole = validation.document(evidence, before)
    data = as_data(evidence)
    forms = {
        "html": html(whole).encode(),
        "pdf": pdf(validation.for_paper(whole)),
        "csv": csv_of(data["rows"]),
        "json": (json.dumps(data, indent=1, ensure_ascii=False) + "\n").encode(),
    }
    paths = {out / f"{NAME}.{form}": content for form, content in forms.items()}
    for path, content in paths.items():
        records_store.replace(path, content)
    return list(paths)


def write_book(records: Path) -> Path:
    """The published cases of a folder of records as one HTML page, in its folder `book`.

    Raises:
        OSError: the folder cannot be written.
    """
    path = folder_of(records) / "book.html"
    evidence = Evidence(records, {}, book=published(records))
    sections = book.sections(evidence, whole=True)
    said = "Published cases: standards, catalogues, other programs, and measurements."
    records_store.replace(path, html(Document("The validation book", "qsbearing", sections, said)).encode())
    return path


def as_data(evidence: Evidence) -> dict[str, Any]:
    """The verdict, every row of agreement as its record has it, and the records, for other programs."""
    groups = {**evidence.checks, **evidence.book}
    return {
        "verdict": validation.verdict(evidence).status,
        "rows": [{"check": name, **row} for name, kept in groups.items() for row in kept.data["rows"]],
        "records": [
            {"name": kept.name, "command": kept.command, "version": kept.version, "provenance": kept.provenance}
            for kept in evidence.all()
        ],
    }


def csv_of(rows: list[dict[str, Any]]) -> bytes:
    """Rows of agreement as a table."""
    text = StringIO()
    writer = csv.DictWriter(text, list(dict.fromkeys(key for row in rows for key in row)), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue().encode()
