"""Campaigns of random scenes, each a population and a question of its own: how its scenes ended, by strength, and its
limit."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from fem_check.report.evidence import Evidence, Kept
from fem_check.report.question import Question, judged
from fem_check.running.known import NO_LIMIT, NOT_CONVERGED, REFUSED, of_status
from qsbearing.documents.model import Badge, Block, Cell, Md, Paragraph, Table

NOT_RECORDED = "not recorded"


@dataclass(frozen=True)
class Scenes:
    """Random scenes of one campaign, by how they ended; nothing is counted twice."""

    name: str
    count: int
    solved: int
    wrong: int
    """Of them."""
    proved: int
    """Refused, and a proof says that there is no equilibrium."""
    evidence: int
    """Refused, and an equilibrium is known that breaks a restriction; that there is no other is not proved."""
    unproved: int
    """Refused, and nothing but the solver says so."""
    explained: int
    """Not converged for a reason that the campaign counts apart, see `STRENGTH`."""
    named: int
    """Not converged, and named in `running/known.py`."""
    lost: int
    """Not converged, and neither of these."""
    allowed: int | None
    """Of those; None: the record has no limit."""
    basis: str
    """When the limit was set, and from what."""

    @property
    def is_met(self) -> bool | None:
        """Whether it keeps its limit; None where nothing is wrong and there is none."""
        if self.wrong or (self.allowed is not None and self.lost > self.allowed):
            return False
        return None if self.allowed is None else True

    @property
    def not_converged(self) -> str:
        """How many, and how many of them are explained or named."""
        more = [f"{n:,} {what}" for n, what in ((self.named, "named"), (self.explained, "explained")) if n]
        return f"{self.lost + self.named + self.explained:,}" + (f" ({', '.join(more)})" if more else "")


def scenes(kept: Kept) -> Scenes:
    """The counts of a campaign, whichever made it."""
    return _recomputed(kept.data) if "campaign" in kept.data else _classified(kept.data)


def _recomputed(record: dict[str, Any]) -> Scenes:
    ended, certified, bar = record["ended"], record.get(REFUSED, {}), record.get("bar", {})
    refused, unsolved = (of_status(ended, status) for status in (REFUSED, "not_converged"))
    proved, evidence = certified.get("proofs", 0), certified.get("evidence", 0)
    lost = len(record["not_converged"])
    return Scenes(
        record["campaign"].replace("_", " "), record["count"], ended.get("converged", 0), len(record["wrong"]),
        proved, evidence, refused - proved - evidence, unsolved - lost, 0, lost, bar.get("allowed"),
        bar.get("basis", ""),
    )  # fmt: skip


def _classified(record: dict[str, Any]) -> Scenes:
    classes, refused, bar = record["classes"], record[REFUSED], record["bar"]
    proved, evidence = refused["proofs"], refused["evidence"]
    named = sum(name in NOT_CONVERGED for name in record["not_converged"])
    return Scenes(
        record["envelope"], record["count"], classes.get("converged", 0), sum(record["failures"].values()),
        proved, evidence, classes.get(REFUSED, 0) - proved - evidence, 0, named,
        classes.get("not_converged", 0) - named, bar["allowed"], bar.get("basis", ""),
    )  # fmt: skip


def reasons(kept: Kept) -> dict[str, int]:
    """Scenes of a campaign without an equilibrium by their reason, the most frequent first."""
    by_reason: Counter[str] = Counter()
    for how, number in kept.data.get("ended", {}).items():
        if how.startswith(REFUSED):
            by_reason[how.partition(": ")[2].replace("_", " ")] += number
    for why, certificates in kept.data.get(REFUSED, {}).get("reasons_and_certificates", {}).items():
        by_reason[why.replace("_", " ")] += sum(certificates.values())
    return dict(by_reason.most_common())


def questions(evidence: Evidence) -> list[Question]:
    """One for each campaign on record; one that is not on record where there is none."""
    if not evidence.random_scenes:
        return [Question("Random scenes?", "robustness", [])]
    return [_question(kept) for kept in evidence.random_scenes]


def beside(evidence: Evidence, asked: Sequence[Question]) -> list[Question]:
    """Those that are not of a campaign on record, which has a row of its own table."""
    return [each for each in asked if not any(kept in evidence.random_scenes for kept in each.records)]


def _question(kept: Kept) -> Question:
    one = scenes(kept)
    missed = []
    if one.wrong:
        missed.append(f"{one.wrong} of {one.count:,} {one.name} scenes are wrong")
    if one.allowed is not None and one.lost > one.allowed:
        beside = " beside those named" if one.named else ""
        missed.append(
            f"{one.lost} of {one.count:,} {one.name} random scenes did not converge{beside} ({one.allowed} allowed)"
        )
    badge = Badge(NO_LIMIT, "missing") if one.is_met is None else judged(one.is_met)
    return Question(
        f"Random scenes: {one.name}", "robustness", [kept], answer=f"{one.solved:,} of {one.count:,} solved",
        worst=f"not converged: {one.not_converged}", limit=NO_LIMIT if one.allowed is None else str(one.allowed),
        basis=one.basis, verdict=badge, missed="; ".join(missed),
    )  # fmt: skip


HEADINGS = (
    "scenes of", "count", "solved", "wrong", "refused: proved", "evidence", "not proved", "not converged", "allowed",
    "limit set, from", "verdict",
)  # fmt: skip


def table(campaigns: Sequence[Kept], caption: str) -> Table:
    """A row for each campaign: no count adds two of them."""
    rows: list[list[Cell]] = []
    for kept in campaigns:
        one = scenes(kept)
        numbers = (one.count, one.solved, one.wrong, one.proved, one.evidence, one.unproved)
        limit = NOT_RECORDED if one.allowed is None else f"{one.allowed:,}"
        told = [one.not_converged, limit, one.basis or NOT_RECORDED]
        rows.append([one.name, *(f"{each:,}" for each in numbers), *told, _question(kept).verdict])
    return Table(HEADINGS, rows, "lrrrrrrrrll", caption, stack=True)


STRENGTH = (
    "**Refused** scenes are *proved* to have no equilibrium by a direction in which the load works and nothing is "
    "pressed, or by a unique equilibrium that is not admissible; *evidence* is an equilibrium that is not admissible, "
    "where others are not excluded; *not proved* means that the solver alone says so. Scenes that did not converge are "
    "*named*, in a list of known ones, or *explained*: balls that skid, that nothing holds against drag, or that lose "
    "their load; `allowed` counts the others."
)
"""What the columns of the table mean."""


def known(evidence: Evidence) -> list[Block]:
    """Scenes on record that do not converge and are named, by their reason."""
    lost = [name for kept in evidence.campaigns for name in kept.data["not_converged"] if name in NOT_CONVERGED]
    if not lost:
        return []
    why: dict[str, list[str]] = {}
    for name in lost:
        why.setdefault(NOT_CONVERGED[name], []).append(name)
    each = "; ".join(f"{', '.join(names)} ({reason})" for reason, names in why.items())
    which = "scene does not converge and is" if len(lost) == 1 else "scenes do not converge and are"
    return [Paragraph(Md(f"**Known not to converge.** {len(lost)} {which} named, to be signed for below: {each}."))]
