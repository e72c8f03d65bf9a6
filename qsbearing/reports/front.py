"""Page 1 of a report: what is required and how it is met, the case at a glance, what gives way, what is left out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Callout, Cell, Columns, Facts, Md, Paragraph, Section
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import printable
from qsbearing.pictures import under_load
from qsbearing.pictures.style import carry_alike
from qsbearing.remarks.kinds import Severity
from qsbearing.remarks.remark import Remark
from qsbearing.remarks.wording import capital
from qsbearing.reports import over_speed
from qsbearing.reports.answers_table import answers_table
from qsbearing.reports.verdict import verdict
from qsbearing.results import provenance
from qsbearing.results.remarks import blocks, together
from qsbearing.results.requirements import Answered
from qsbearing.systems.sets.set_solution import SetSolution

REMARKS = "remarks"
"""Name of their section."""
PEOPLE = ("customer", "author", "document")
"""Keys of a file's [report] that page 1 repeats."""


class OfAllPoints(NamedTuple):
    """Of a load spectrum: what its points say together, before what one of them says."""

    answers: Sequence[Block]
    """To what is required of all points; nothing where nothing is."""
    lives: Sequence[Block]
    """Under all points, and the share of each."""
    warned: Sequence[Callout]
    """Remarks on all points, in place of those of one."""


def front(
    report: Mapping[str, str],
    limits: Answered,
    said: Sequence[Remark],
    at_a_glance: Section,
    side_by_side: Sequence[Section | None],
    swept: over_speed.Swept | None,
    facts: Facts,
    evidence: str,
    solution: Solution | SetSolution,
    of_all: OfAllPoints | None,
) -> list[Block]:
    """Page 1.

    Args:
        report: the file's table [report]: document, customer and author, as far as it has them.
        limits: how the case answers each limit.
        said: all remarks.
        at_a_glance: its picture.
        side_by_side: what gives way, and what the model leaves out.
        swept: the case at other speeds.
        facts: its numbers.
        evidence: in short.
        solution: of a single case.
        of_all: where it is one point of several.
    """
    people: list[tuple[str, Cell]] = [(capital(key), report[key]) for key in PEOPLE if key in report]
    wrong = [each for each in said if each.kind.severity is Severity.WRONG_MODEL]
    others = [each for each in said if each.kind.severity is not Severity.WRONG_MODEL]
    curves = over_speed.section(swept, limits.required)
    parts = [each for each in side_by_side if each is not None]
    numbers = Section("In numbers", [facts], "in-numbers")
    return [
        *([Facts(people)] if people else []),
        *([] if of_all is None else [*of_all.answers, *of_all.lives]),
        verdict(limits.built_in, said, limits.required, getattr(requested(solution), "rows", ())),
        *blocks(wrong),
        *answers_table(limits, solution),
        at_a_glance,
        Columns([parts, [numbers]]),
        *([] if curves is None else [curves]),
        _last(others, evidence),
    ]


def _last(said: Sequence[Remark], evidence: str) -> Paragraph:
    """How many remarks of each kind there are besides, and where; the evidence in short."""
    count = Counter(each.kind.severity.words for each in together(said))
    kinds = "; ".join(f"{words.lower()}: {number}" for words, number in count.items())
    counted = f"[Remarks](#{REMARKS}): {kinds}. " if kinds else ""
    return Paragraph(Md(counted + evidence), is_small=True)


def remarks(said: Sequence[Remark], of_all: OfAllPoints | None) -> Section:
    """All of them, what matters most first; of a load spectrum those of all points."""
    shown = blocks(said) if of_all is None else of_all.warned
    more = Paragraph(Md("[What each effect changes, and what to do](#effects)."), is_small=True)
    return Section("Remarks", [*shown, more] if shown else [Callout("No warnings.")], REMARKS)


def glance(solution: Solution | SetSolution) -> Section:
    """The picture of a case under its load."""
    title, name = "How it stands under load", "under-load"
    if isinstance(solution, SetSolution):
        alt = (
            "The shaft as it bends, far enlarged, with its bearings and loads; below it polar pictures of the contact "
            "loads of each row's balls, all to one scale."
        )
        drawn = picture(under_load(solution), alt)
        return Section(title, [drawn], name)
    beside = "the contact ellipses" if carry_alike(solution, ()) else "the contact loads of all balls"
    if solution.scene.elastic_rings is not None and not carry_alike(solution, ()):
        beside = "the grooves of the elastic rings, their movement far enlarged"
    alt = f"Section through the ball that carries most, with the lines of action of its contacts; beside it {beside}."
    return Section(title, [picture(under_load(solution), alt)], name)


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
