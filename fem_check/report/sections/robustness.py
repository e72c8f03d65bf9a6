"""Robustness: named hard cases and random scenes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from fem_check.report.evidence import Evidence, Kept, missing
from fem_check.report.questions import EXPECTED
from fem_check.report.random_scenes import reasons, scenes, table
from fem_check.report.rows import as_read
from fem_check.rows.row_text import scientific
from qsbearing.documents.model import Badge, Block, Callout, Cell, Md, Paragraph, Section, Table

MOST = 5


def section(evidence: Evidence) -> Section:
    """Whether a scene is solved, and if not, whether it is said rightly."""
    words = (
        "A solution is checked from its public numbers alone: forces, moments, closure, Hertz. A refusal of a wild or "
        "realistic scene needs a certificate from another method: a proof, or an inadmissible equilibrium as evidence; "
        "of the others it is sought, and where none is found the refusal counts as not proved."
    )
    blocks: list[Block] = [
        Paragraph(words),
        Section("Random scenes", _campaigns(evidence.random_scenes)),
        Section("Named hard cases", _hard_cases(evidence.hard_cases)),
        Section("Small errors in the code", _mutations(evidence.mutations)),
    ]
    return Section("Hard cases and random scenes", blocks, "robustness")


def _campaigns(campaigns: Sequence[Kept]) -> list[Block]:
    if not campaigns:
        return [missing("A campaign of random scenes", "fem-check release --level release")]
    each = list(map(scenes, campaigns))
    missed, wrong = [one.name for one in each if one.is_met is False], sum(one.wrong for one in each)
    said = "**No random scene is wrong.**" if wrong == 0 else "**Some random scenes are wrong.**"
    said += f" Limits are missed by: {', '.join(missed)}." if missed else " No limit is missed."
    free = [one.name for one in each if one.allowed is None]
    said += f" No limit is recorded of: {', '.join(free)}." if free else ""
    return [
        Callout(Md(said), "fail" if missed else "pass"),
        table(campaigns, "Campaigns of random scenes"),
        Paragraph(
            f"Reasons of refusals, of each campaign by itself: {'; '.join(filter(None, map(_reasons, campaigns)))}."
        ),
        Paragraph(f"Records: {', '.join(kept.name for kept in campaigns)}."),
    ]


def _reasons(kept: Kept) -> str:
    """Of one campaign."""
    each = ", ".join(f"{why} {number:,}" for why, number in reasons(kept).items())
    return f"{scenes(kept).name}: {each}" if each else ""


def _mutations(kept: Kept | None) -> list[Block]:
    """How many of the errors planted at random are seen, and which are not."""
    if kept is None:
        return [missing("The survey of mutations", "mutations")]
    edits, survivors = kept.data["found"], kept.data["survivors"]
    seen = sum(bool(each["seen_by"]) for each in edits)
    by_check = sum(each["seen_by"].startswith(("check", "book")) for each in edits)
    unseen = [each for each in edits if not each["seen_by"]]
    told = [survivors.get(f"{each['path']}:{each['line']}", {}) for each in unseen]
    same = sum(each.get("is_equivalent", False) for each in told)
    few = "" if len(edits) == kept.data["count"] else ", too few for a share"
    words = (
        f"Of {kept.data['count']} changes of one operator or digit, drawn from the code of both packages, {len(edits)} "
        f"were made{few}. The tests of the module, then "
        f"quick checks, each at most {kept.data['seconds']} s, saw {seen} of them, {by_check} by a check alone. Of the "
        f"unseen ones {same} of {len(unseen)} make no difference to any result."
    )
    rows: list[list[Cell]] = [
        [f"{each['path']}:{each['line']}", each["text"], f"{each['old']} to {each['new']}", known.get("why", "")]
        for each, known in zip(unseen, told, strict=True)
    ]
    headings = ("place", "line", "change", "what was found of it")
    table = [Table(headings, rows, "llll", "Changes that nothing saw", stack=True)] if rows else []
    return [Paragraph(words), *table, kept.trace]


def _hard_cases(kept: Kept | None) -> list[Block]:
    if kept is None:
        return [missing("The table of hard cases", "hard_cases")]
    cases = sorted(kept.data["cases"], key=lambda each: (each["verdict"] in EXPECTED, -each["iterations"]))
    rows: list[list[Cell]] = []
    for each in cases[:MOST]:
        badge = Badge(each["verdict"], "pass" if each["verdict"] in EXPECTED else "fail")
        status = each["status"].replace("_", " ")
        error = scientific(max(each.get(key, 0.0) for key in ("loads", "angles", "displacements")), 1)
        rows.append([each["case"], as_read(each["what"]), status, str(each["iterations"]), error, badge])
    good = sum(each["verdict"] in EXPECTED for each in cases)
    tally = ", ".join(f"{n} {verdict}" for verdict, n in Counter(each["verdict"] for each in cases).items())
    head = f"All {len(cases)} hard cases give" if good == len(cases) else f"{good} of {len(cases)} hard cases give"
    headings = ("case", "difficulty", "outcome", "iterations", "largest error", "verdict")
    caption = f"The {len(rows)} cases with the most iterations; errors are relative"
    return [
        Callout(Md(f"**{head} the expected result**: {tally}."), "pass" if good == len(cases) else "fail"),
        Table(headings, rows, "lllrrl", caption, stack=True),
        kept.trace,
    ]
