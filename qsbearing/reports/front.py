"""What a report opens with: the answer, margins, key results, warnings, whether the model is right, evidence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Callout, Cell, Facts, Md, Paragraph, Section
from qsbearing.files.file_keys import OTHER_TABLES, REPORT
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import printable
from qsbearing.pictures.margins import margins as draw_margins
from qsbearing.remarks.remark import Remark
from qsbearing.remarks.wording import capital
from qsbearing.reports.margins import Margin, answer
from qsbearing.results import provenance
from qsbearing.results.remarks import blocks


def head(
    report: Mapping[str, str],
    limits: Sequence[Margin],
    said: Sequence[Remark],
    results: Sequence[Block],
    rest: Sequence[Block],
    solution: Solution | None = None,
) -> list[Block]:
    """Page 1.

    Args:
        report: the file's table [report]: document, customer and author, as far as it has them.
        limits: how close the case is to each limit.
        said: all remarks.
        results: the key results.
        rest: whether the model is right, and by what evidence.
        solution: of a single bearing, whose ball loads stand beside the margins.
    """
    bars = [(each.what, each.used, each.text) for each in limits]
    drawn = picture(
        draw_margins(bars, solution),
        "; ".join(f"{each.what} {each.text}" for each in limits),
        "How much of each limit is used: " + "; ".join(f"{each.what}: {each.source}" for each in limits),
    )
    shown = blocks(said) or [Callout("No warnings.")]
    people: list[tuple[str, Cell]] = [(capital(key), report[key]) for key in OTHER_TABLES[REPORT][1:] if key in report]
    return [*([Facts(people)] if people else []), answer(limits, said), drawn, *results, *shown, *rest]


def made_with(message: str, command: str) -> Section:
    """How the case ended, and what made the report.

    Args:
        message: how the case ended.
        command: that makes the report.
    """
    return Section("Made with", [Paragraph(message), Facts(_facts(command))])


def _facts(command: str) -> list[tuple[str, Cell]]:
    made = provenance.of_run(command)
    machine = made["machine"]
    commit = made["commit"] or "none: an installed package"
    return [
        ("Date", made["date"]),
        ("qsbearing", made["qsbearing"]),
        ("Commit", commit + (", with changes that are not committed" if made["dirty"] else "")),
        ("Machine", f"{machine['processor']}, {machine['system']}, Python {machine['python']}"),
        ("Packages", ", ".join(f"{package} {version}" for package, version in made["packages"].items())),
        ("Command", Md(f"`{printable(command)}`")),
    ]
