"""The report as files: one HTML page and one PDF, both or none."""

from __future__ import annotations

from pathlib import Path

from fem_check import records_store
from fem_check.report import validation
from fem_check.report.evidence import Evidence
from qsbearing.documents.html import html
from qsbearing.documents.pdf import pdf

NAME = "validation_report"


def write(evidence: Evidence, before: Evidence | None, out: Path) -> list[Path]:
    """Write both forms into a folder; returns their paths.

    Raises:
        OSError: the folder cannot be written.
    """
    out.mkdir(parents=True, exist_ok=True)
    document = validation.document(evidence, before)
    forms = {out / f"{NAME}.html": html(document).encode(), out / f"{NAME}.pdf": pdf(document)}
    for path, content in forms.items():
        records_store.replace(path, content)
    return list(forms)
