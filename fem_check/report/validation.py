"""The validation report: page 1 decides, page 2 has Hertz beside true bodies, then come scope, cards that answer and
an annex with the reasons; everything in it is on record."""

from __future__ import annotations

from dataclasses import replace

from fem_check.report import page_one, questions
from fem_check.report.evidence import Evidence
from fem_check.report.sections import (
    agreement,
    annex,
    book,
    cards,
    costs,
    errata,
    limits,
    mathematics,
    previous,
    robustness,
    traceability,
)
from qsbearing.documents.model import Callout, Document


def document(evidence: Evidence, before: Evidence | None = None) -> Document:
    """The whole report.

    Args:
        evidence: all that is on record.
        before: of an earlier release, to be compared with.
    """
    answers = questions.all_of(evidence)
    return Document(
        f"qsbearing {traceability.listed(kept.version for kept in evidence.all())}",
        "Validation report",
        [
            traceability.section(evidence, answers),
            limits.section(),
            mathematics.section(evidence),
            *cards.sections(evidence),
            *book.sections(evidence),
            robustness.section(evidence),
            costs.section(evidence),
            errata.section(evidence),
            *([previous.section(evidence, before)] if before else []),
            annex.section(evidence),
            traceability.reproducing(evidence),
            annex.notes(evidence),
        ],
        head=[*page_one.blocks(evidence, answers), agreement.section(evidence), page_one.scope(evidence, before)],
        depth=1,
    )


def for_paper(whole: Document) -> Document:
    """The report without its last section, the checks' notes; pictures are not drawn again."""
    return replace(whole, sections=whole.sections[:-1])


def verdict(evidence: Evidence) -> Callout:
    """Of page 1."""
    return page_one.verdict(evidence, questions.all_of(evidence))
