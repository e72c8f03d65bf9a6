"""What a report opens with: the answer, margins, key results, warnings, whether the model is right, evidence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Callout, Cell, Facts, Md, Paragraph, Picture, Section
from qsbearing.files.file_keys import OTHER_TABLES, REPORT
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.limit import Standing
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import printable
from qsbearing.pictures.margins import Bar
from qsbearing.pictures.margins import margins as draw_margins
from qsbearing.remarks.remark import Remark
from qsbearing.remarks.wording import capital
from qsbearing.reports.verdict import text_of, verdict
from qsbearing.results import provenance
from qsbearing.results.remarks import blocks
from qsbearing.results.requirements import Answered, name_of, unchecked
from qsbearing.results.requirements import blocks as requirement_blocks

if TYPE_CHECKING:
    from qsbearing.systems.sets.set_solution import SetSolution


def head(
    report: Mapping[str, str],
    limits: Answered,
    said: Sequence[Remark],
    results: Sequence[Block],
    rest: Sequence[Block],
    solution: Solution | SetSolution,
) -> list[Block]:
    """Page 1.

    Args:
        report: the file's table [report]: document, customer and author, as far as it has them.
        limits: how the case answers each limit.
        said: all remarks.
        results: the key results.
        rest: whether the model is right, and by what evidence.
        solution: of a single bearing the ball loads stand beside the margins.
    """
    shown = blocks(said) or [Callout("No warnings.")]
    people: list[tuple[str, Cell]] = [(capital(key), report[key]) for key in OTHER_TABLES[REPORT][1:] if key in report]
    opening = verdict(limits.built_in, said, limits.required, getattr(requested(solution), "rows", ()))
    required = requirement_blocks(limits.required, solution)[1:]
    return [
        *([Facts(people)] if people else []),
        opening,
        *required,
        _drawn(limits, solution),
        Paragraph(unchecked(limits)),
        *results,
        *shown,
        *rest,
    ]


OPEN_BARS = ". Orange: open"


def _drawn(limits: Answered, solution: Solution | SetSolution) -> Picture:
    """How much of each limit is used."""
    every = [each for each in (*limits.required, *limits.built_in) if np.isfinite(each.value)]
    bars = [Bar(name_of(each), each.used, text_of(each), each.state is Standing.OPEN) for each in every]
    sources = "; ".join(f"{each.limit.name}: {each.limit.source or 'required'}" for each in every)
    return picture(
        draw_margins(bars, solution if isinstance(solution, Solution) else None),
        "; ".join(f"{each.name} {each.words}" for each in bars),
        f"How much of each limit is used: {sources}{OPEN_BARS * any(each.is_open for each in bars)}",
    )


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
