"""The evidence that applies to a scene: what was checked, with what result, and whether the scene lies within it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeVar

from qsbearing.documents.model import Badge, Block, Cell, Md, Paragraph, Section, Table
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.wording import numbered
from qsbearing.reports.conditions import Difference, facts_of
from qsbearing.reports.set_statements import OF_SETS
from qsbearing.reports.statements import STATEMENTS
from qsbearing.systems.sets.bearing_set import BearingSet

Said = TypeVar("Said")
COVERED, SIMILAR, NOT_COVERED = Badge("covered", "pass"), Badge("similar", "finding"), Badge("not covered", "missing")
MEANING = (
    "*Covered*: effects, choices and numbers of this {what} lie within what was checked.",
    "*Similar*: the same effects and choices, but another bearing, or numbers beyond those that were checked.",
    "*Not covered*: the {what} has an effect or choice that the check did not have: untested, not wrong.",
)
MOST_TOLD = 2
"""Reasons of one check: rows of a set have many that differ in numbers alone."""
UNMEASURED = "Contact angles, loads and stiffness at speed have not been compared with measurements."
WORDS = (
    f"Nothing here is a measurement unless it says so. {UNMEASURED} The validation report, `fem-check report`, has "
    "all numbers. Commands that begin with `python` or `pytest` run in a checkout of the repository."
)


def statements(solutions: Sequence[Solution], of: BearingSet | None = None) -> list[list[Cell]]:
    """Those that apply: what was checked, its result, whether this scene or set lies within it, and why not.

    Args:
        solutions: of the scene, or of each row of the set.
    """
    facts = {number: facts_of(solution) for number, solution in enumerate(solutions, 1)}
    rows: list[list[Cell]] = []
    for each in STATEMENTS:
        concerned = {number: one for number, one in facts.items() if each.applies(one)}
        if concerned:
            result = each.found(list(concerned.values()))
            differences = {number: each.differences(one) for number, one in concerned.items()}
            reasons = [
                one if which is None else one._replace(reason=f"{which}: {one.reason}")
                for one, which in of_rows(differences)
            ]
            rows.append([Md(f"{each.says} `{each.command}`"), result, *judged(reasons)])
    for of_set in OF_SETS:
        if of is not None and of_set.applies(of):
            said = Md(f"{of_set.says} `{of_set.command}`")
            rows.append([said, of_set.found([of]), *judged(of_set.differences(of))])
    return rows


def in_short(rows: Sequence[Sequence[Cell]]) -> str:
    """How many of the statements that apply cover the case, as Markdown."""
    words = [badge.word for _, _, badge, _ in rows if isinstance(badge, Badge)]
    counts = ", ".join(f"{words.count(each.word)} {each.word}" for each in (COVERED, SIMILAR, NOT_COVERED))
    said = f"of {len(words)} checks that apply to this case: {counts}; [each with its reason](#evidence)."
    return f"**Evidence**, {said} {UNMEASURED}"


def section(rows: Sequence[Sequence[Cell]], what: str) -> Section:
    """All of them.

    Args:
        what: scene or set.
    """
    meaning = " ".join(each.format(what=what) for each in MEANING)
    blocks: list[Block] = [Paragraph(Md(f"{meaning} {WORDS}"), is_small=True)]
    headings = ("check and its command", "result", f"this {what}", "why")
    return Section("Evidence that applies", [*blocks, Table(headings, rows, "llll", stack=True)], "evidence")


def judged(differences: Sequence[Difference]) -> list[Cell]:
    """How far a scene is from what was checked, in a word and in the reasons for it."""
    if not differences:
        return [COVERED, ""]
    badge = NOT_COVERED if any(each.in_kind for each in differences) else SIMILAR
    told = [each.reason for each in sorted(differences, key=lambda each: not each.in_kind)]
    more = f"; {len(told) - MOST_TOLD} more numbers outside" if len(told) > MOST_TOLD + 1 else ""
    return [badge, "; ".join(told[: MOST_TOLD if more else None]) + more]


def of_rows(said: Mapping[int, Sequence[Said]]) -> list[tuple[Said, str | None]]:
    """Each thing once, in its order, with "rows 1 and 3", or None where it is said of every row.

    Args:
        said: of each row, by its number.
    """
    rows: dict[Said, list[int]] = {}
    for number, of_row in said.items():
        for each in of_row:
            rows.setdefault(each, []).append(number)
    return [(each, None if len(numbers) == len(said) else numbered("row", numbers)) for each, numbers in rows.items()]
