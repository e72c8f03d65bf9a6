"""Page 1: may this version be used, how close to its limits, what is not in the model, and who says so."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

from fem_check.checks import ALL
from fem_check.report import random_scenes
from fem_check.report.evidence import Evidence, Kept
from fem_check.report.question import Question
from fem_check.report.questions import span
from fem_check.report.rows import as_read
from fem_check.report.sections import previous, traceability
from fem_check.running import suite
from qsbearing import __version__
from qsbearing.documents.model import Block, Callout, Cell, Facts, Md, Paragraph, Section, Table
from qsbearing.reports.effects import NOT_MODELLED
from qsbearing.results import provenance

BLANK = "\N{NO-BREAK SPACE}" * 34
"""Room to write by hand."""
RANDOM = "Random scenes of each campaign, by how they ended"


def blocks(evidence: Evidence, questions: Sequence[Question]) -> list[Block]:
    """All of it; who releases it is last."""
    return [
        Facts(_facts(evidence)),
        verdict(evidence, questions),
        Table(
            ("question", "answer", "worst found", "limit", "verdict", "see"),
            [_line(q) for q in random_scenes.beside(evidence, questions)],
            "llllll", "What may be relied on", stack=True,
        ),
        *([random_scenes.table(evidence.random_scenes, RANDOM)] if evidence.random_scenes else []),
        *random_scenes.known(evidence),
        Paragraph(Md(f"**Tests.** {_tests(evidence)}")),
        Table(
            ("approval", *(f"{word} by" for word in ("Prepared", "Reviewed", "Released"))),
            [["name, date, signature", *[BLANK] * 3]], "llll",
        ),
    ]  # fmt: skip


def scope(evidence: Evidence, before: Evidence | None) -> Section:
    """What page 1 covers, its words, what changed and which commits the records are of: more than the page has room
    for."""
    blocks: list[Block] = [
        Paragraph(Md(f"**Scope.** {_scope(evidence)}")),
        Paragraph(Md(f"**± means:** {_coverage(evidence)}")),
        *([Paragraph(Md(random_scenes.STRENGTH))] if evidence.random_scenes else []),
        Paragraph(Md(f"**Changes since the last release.** {previous.summary(evidence, before)}")),
        _traceability(evidence),
    ]
    return Section("Scope of page 1, and its words", blocks, "scope")


def _facts(evidence: Evidence) -> list[tuple[str, Cell]]:
    records = list(evidence.all())
    version = traceability.listed(kept.version for kept in records)
    dates = sorted(kept.provenance["date"][:10] for kept in records if kept.provenance)
    commit = provenance.commit()
    changed = " with changes that are not committed" if provenance.is_dirty() else ""
    here = f"{commit[:12]}{changed}" if commit else "an installed package"
    tested = traceability.tested(evidence)[:12]
    return [
        ("Document", f"QSB-VR-{version}"),
        ("Revision", f"records {traceability.digest(records)}"),
        ("Version", version),
        ("Commit tested, of this report", f"{tested or traceability.NOT_RECORDED}, {here}"),
        ("Evidence made", f"{dates[0]} to {dates[-1]}" if dates else traceability.NOT_RECORDED),
        ("Level", level(evidence)),
    ]


def level(evidence: Evidence) -> str:
    """Of the checks; records of several commits are never called a release."""
    levels = traceability.listed(kept.data["level"] for kept in evidence.checks.values())
    return f"{levels} settings, a mixed set of records: not a release" if traceability.is_mixed(evidence) else levels


def verdict(evidence: Evidence, questions: Sequence[Question]) -> Callout:
    """Whether the version may be used, for what, and what is against it."""
    failed, is_release = _failed(evidence), False
    missed = [each for each in questions if each.verdict.kind == "fail"]
    absent = [name for name in ALL if name not in evidence.checks] + ([] if evidence.book else ["the validation book"])
    said = [f"{words} {'; '.join(parts)}." for words, parts in uses(evidence, questions).items()]
    said += [f"Missed: {each.missed}." for each in missed if each.missed]
    if absent:
        said.append(f"Not on record: {', '.join(absent)}.")
    if failed:
        return Callout(Md(f"**Fail: {', '.join(failed)}.** {' '.join(said)}"), "fail")
    if missed:
        head = f"Not releasable as it stands: {len(missed)} of {len(questions)} questions missed"
    elif absent:
        head = "Not complete"
    elif traceability.is_mixed(evidence):
        head = "Usable within its limits, but not a release"
    elif against := traceability.objections(evidence):
        head = f"Usable within its limits, but not a release: {'; '.join(against)}"
    else:
        head, is_release = f"{__version__}, one commit, all records of it. Usable within its limits", True
    if traceability.is_mixed(evidence):
        head += f"; {traceability.origins(evidence)}"
    status = "fail" if missed else "pass" if is_release else "warning"
    return Callout(Md(f"**{head}.** {' '.join(said)}"), status)


def _failed(evidence: Evidence) -> list[str]:
    groups = (*evidence.checks.items(), *evidence.book.items())
    return [name for name, kept in groups if kept.data["verdict"] == "fail"]


def uses(evidence: Evidence, questions: Sequence[Question]) -> dict[str, list[str]]:
    """What the version may be used for, nothing where a check or case fails, and what it is not validated for."""
    may = [] if _failed(evidence) else [each.may for each in questions]
    parts = {"May be used for": may, "Not validated for": [each.not_for for each in questions]}
    return {words: named for words, each in parts.items() if (named := [part for part in each if part])}


def _scope(evidence: Evidence) -> str:
    """What was covered, from the records; what was not, in words."""
    ranges = []
    if kept := evidence.checks.get("conformity"):
        ranges.append(f"groove radii of {span(kept.data['pictures']['conformity']['curves'])} ball diameters")
    if kept := evidence.checks.get("bearing_sector"):
        scene, curves = kept.data["scene"].upper(), kept.data["pictures"]["bearing_sector"].values()
        loads = chain.from_iterable(curve["load_N"] for states in curves for curve in states.values())
        ranges.append(f"{scene} under thrust of {span(loads)} N between elastic rings")
    if evidence.reference:
        ranges.append(f"{len(evidence.reference.data['cases'])} scenes with every effect against fifty digits")
    covered = f"Covered: {'; '.join(ranges)}. " if ranges else ""
    return (
        f"{covered}Not covered: radial load and moments between elastic bodies in three dimensions; measured "
        f"temperatures. Not covered means untested, not wrong. Not in the model: {NOT_MODELLED}; lubricant films and "
        "groove edges in the equilibrium."
    )


def _coverage(evidence: Evidence) -> str:
    kept = evidence.checks.get("convergence_order")
    rows = [] if kept is None else kept.data["rows"]
    share = next((row for row in rows if row["quantity"].startswith("share whose error exceeds")), None)
    said = "an expanded uncertainty of the finite elements: meshes and positions of the contact's edge"
    if share is None:
        return f"{said}."
    covered, least = (100.0 * (1.0 - value) for value in (share["found"], share["tolerance_percent"] / 100.0))
    held = f"It held the true error in {covered:.1f} % of cases (at least {least:g} % needed)"
    return f"{said}. {held}: {as_read(share['case'])}."


def _traceability(evidence: Evidence) -> Paragraph:
    """How many records are of the commit that was tested, by group; of how many others."""
    tested, groups = traceability.tested(evidence), _groups(evidence)
    each = [f"{name} {traceability.tally(records, tested)[0]} of {len(records)}" for name, records in groups]
    _, others, unknown = traceability.tally(evidence.all(), tested)
    rest = f"{others} records are of other commits, {unknown} of none that is known"
    return Paragraph(Md(f"**Traceability.** At the commit tested: {', '.join(each)}. {rest}."))


def _groups(evidence: Evidence) -> list[tuple[str, list[Kept]]]:
    checks, book = list(evidence.checks.values()), list(evidence.book.values())
    others = [kept for kept in evidence.all() if kept not in checks and kept not in book]
    return [("finite elements", checks), ("published cases", book), ("fifty digits, scenes, cost, gate", others)]


def _line(question: Question) -> list[Cell]:
    limit = question.limit or ("none: a finding" if question.answer else "")
    limit += f" ({question.basis})" if question.basis else ""
    more = Md(f"[more](#{question.see})")
    return [question.text, question.answer, question.worst, limit, question.verdict, more]


def _tests(evidence: Evidence) -> str:
    """How many passed, were skipped and why, and failed: of all but the heavy tests, and of these."""
    said = []
    for kept in evidence.tests:
        record = kept.data
        parts = [f"{record['passed']:,} passed"]
        for word, key in (("skipped", "skipped"), ("expected to fail", "expected_to_fail")):
            reasons = record[key]
            if reasons:
                why = "; ".join(f"{number:,}: {reason}" for reason, number in reasons.items())
                parts.append(f"{sum(reasons.values()):,} {word} ({why})")
        parts.append(f"{len(record['failed']):,} failed")
        name = "All but the heavy ones" if record["tests"] == "tests" else "The heavy ones"
        said.append(f"{name}: {', '.join(parts)}, {record['seconds']:,.0f} s.")
    missing = suite.COMMANDS.keys() - {kept.data["tests"] for kept in evidence.tests}
    said += [f"Not on record: {', '.join(sorted(missing))}; the release gate runs them."] if missing else []
    return " ".join(said)
