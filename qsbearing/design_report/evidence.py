"""The evidence that applies to a scene: what was checked, with what result, and whether the scene lies within it."""

from __future__ import annotations

from qsbearing.design_report.conditions import Difference, facts_of
from qsbearing.design_report.statements import STATEMENTS
from qsbearing.documents.model import Badge, Block, Bullets, Cell, Md, Paragraph, Section, Table
from qsbearing.solution import Solution

COVERED, SIMILAR, NOT_COVERED = Badge("covered", "pass"), Badge("similar", "finding"), Badge("not covered", "missing")
MEANING = (
    "*Covered*: effects, choices and numbers of this scene lie within what was checked.",
    "*Similar*: the same effects and choices, but another bearing, or numbers beyond those that were checked.",
    "*Not covered*: the scene has an effect or choice that the check did not have. That does not make it wrong.",
)
WORDS = (
    "Nothing here is a measurement unless it says so: contact angles, loads and stiffness at speed have not been "
    "compared with any. The validation report, `fem-check report`, has all numbers. Commands that begin with `python` "
    "or `pytest` run in a checkout of the repository."
)
HEADINGS = ("what was checked, and how to do it again", "result", "this scene", "why")


def section(solution: Solution) -> Section:
    """The statements that apply, with whether this scene lies within what was checked."""
    facts = facts_of(solution)
    rows: list[list[Cell]] = [
        [Md(f"{each.says} `{each.command}`"), each.found(facts), *judged(each.differences(facts))]
        for each in STATEMENTS
        if each.applies(facts)
    ]
    blocks: list[Block] = [Bullets([Md(each) for each in MEANING]), Paragraph(Md(WORDS))]
    return Section("Evidence that applies", [*blocks, Table(HEADINGS, rows, "llll", stack=True)], "evidence")


def judged(differences: list[Difference]) -> list[Cell]:
    """How far a scene is from what was checked, in a word and in the reasons for it."""
    if not differences:
        return [COVERED, ""]
    badge = NOT_COVERED if any(each.in_kind for each in differences) else SIMILAR
    return [badge, "; ".join(each.reason for each in differences)]
