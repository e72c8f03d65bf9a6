"""The eight questions that decide whether a version may be used: each answered from the records, or not on record."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from fem_check.report.evidence import Evidence, Kept
from fem_check.report.rows import as_read, difference, largest, quantity, used
from fem_check.rows import row_text
from fem_check.rows.record import RowRecord, deviation_percent
from fem_check.running.known import NOT_CONVERGED
from qsbearing.documents.model import Badge

LIMIT_OF_USE = Badge("limit of use", "finding")
EXPECTED = ("within 1e-9", "explained by its condition", "as expected")
"""Verdicts of a hard case that gives the expected result."""
RINGS = ("contact_at_the_edge", "elastic_ring")
"""Checks of what Hertz and rigid rings leave out."""


REFUSED = "no_equilibrium"
MEASURES = ("loads", "angles", "displacements", "stiffness")
"""Of a scene against its solution with fifty digits."""


class Question(NamedTuple):
    """A row of page 1, and a requirement that records answer."""

    text: str
    see: str
    """The section that has more."""
    records: Sequence[Kept]
    answer: str = ""
    worst: str = ""
    limit: str = "no limit"
    verdict: Badge = Badge("not on record", "missing")
    may: str = ""
    """What the version may be used for, where this holds."""
    not_for: str = ""
    """What it is not validated for."""
    missed: str = ""
    """What is on record against it."""


def all_of(evidence: Evidence) -> list[Question]:
    """In the order of page 1."""
    return [
        _equations(evidence),
        _hertz(evidence),
        _rigid_seat(evidence),
        _free_ring(evidence),
        _elastic_rings(evidence),
        _published(evidence),
        _measured(evidence),
        _robust(evidence),
    ]


def _judged(is_good: bool, word: str = "pass") -> Badge:
    return Badge(word, "pass") if is_good else Badge("missed", "fail")


def _failing(records: Iterable[Kept]) -> str:
    names = ", ".join(str(kept.data.get("case") or kept.data["check"]) for kept in records if not _passes(kept))
    return f"out of their limits: {names}" if names else ""


def _passes(kept: Kept) -> bool:
    return bool(kept.data["verdict"] == "pass")


def _equations(evidence: Evidence) -> Question:
    records = [kept for kept in (evidence.reference, evidence.relations) if kept]
    question = Question("Are the equations solved?", "mathematics", records)
    if evidence.reference is None:
        return question
    record = evidence.reference.data
    worst = max(
        max(each[name] for name in ("loads", "angles", "displacements", "stiffness")) for each in record["cases"]
    )
    bad = [each["case"] for each in record["cases"] if each["verdict"] != "pass"]
    files = evidence.relations.data["files"] if evidence.relations else []
    bad += [each["file"] for each in files if each["verdict"] != "pass"]
    return question._replace(
        answer=f"{len(record['cases'])} scenes against solutions with fifty digits, {len(files)} files of relations",
        worst=row_text.scientific(worst, 1), limit=row_text.number(record["tolerance"]), verdict=_judged(not bad),
        missed=f"equations: {', '.join(bad)}" if bad else "",
    )  # fmt: skip


def _hertz(evidence: Evidence) -> Question:
    records = [k for name, k in evidence.checks.items() if k.data["kind"] == "verification" and name not in RINGS]
    question = Question("Is each contact Hertz's?", "hertz", records)
    solved = [row for row in _rows(evidence.checks, "half_space_contacts", "solution_contacts") if _is_of_elements(row)]
    if not solved:
        return question._replace(verdict=_judged(False), missed=_failing(records)) if _failing(records) else question
    worst = max(solved, key=lambda row: abs(deviation_percent(row)))
    missed = _failing(records)
    return question._replace(
        answer=f"{len(solved)} comparisons with finite elements; worst: {row_text.in_words(worst['quantity'])}",
        worst=difference(worst), limit=row_text.of_row(worst).tolerance, verdict=_judged(not missed),
        missed=missed,
    )  # fmt: skip


def _is_of_elements(row: RowRecord) -> bool:
    return bool(row["uncertainty_percent"] and row["tolerance_percent"] and row["reference"] and row["unit"] != "1")


def _rows(checks: dict[str, Kept], *names: str) -> list[RowRecord]:
    return [row for name in names if name in checks for row in checks[name].data["rows"]]


SECTOR = ("axial_displacement", "load", "angle", "max_pressure", "semi_major_axis", "semi_minor_axis")
"""Of either raceway, the most asked first."""


def sector(checks: dict[str, Kept], outside: str, names: Sequence[str] = SECTOR) -> str:
    """Largest differences of one ball between elastic rings from the model; empty where there is no record.

    Args:
        outside: how the outside diameter is held, as its cases end.
    """
    findings = [row for row in _rows(checks, "bearing_sector") if row["verdict"] == "finding" and row["reference"]]
    own = [
        row for row in findings if row["case"].partition("outside diameter ")[2] in (outside, f"{outside}{GYROSCOPIC}")
    ]
    each = {name: [row for row in own if row["quantity"].split(" ")[-1] == name] for name in names}
    return ", ".join(f"{quantity(name)} {largest(rows)}" for name, rows in each.items() if rows)


GYROSCOPIC = ", gyroscopic moment"
MOST_ASKED = SECTOR[:3]
WITH_RINGS = "free, elastic rings in the model"


def span(values: Iterable[float | str]) -> str:
    """From the smallest to the largest; one number where all are the same."""
    numbers = sorted(map(float, values))
    return " to ".join(dict.fromkeys(f"{each:,g}" for each in (numbers[0], numbers[-1])))


def _rigid_seat(evidence: Evidence) -> Question:
    records = [k for k in evidence.checks.values() if k.data["kind"] == "model comparison"]
    question = Question("Rigid seat: how far from elastic bodies?", "check-bearing-sector", records)
    worst = sector(evidence.checks, "rigid", MOST_ASKED)
    if not worst:
        return question._replace(see="hertz")
    curves = evidence.checks["bearing_sector"].data["pictures"]["bearing_sector"]["rigid"].values()
    loads = [load for curve in curves for load in curve["load_N"]]
    missed = _failing(records)
    return question._replace(
        answer=f"axial load {span(loads)} N, at rest and at speed",
        worst=worst, verdict=_judged(False) if missed else LIMIT_OF_USE, missed=missed,
        may="contact loads, contact angles and displacements in rigid seats",
    )  # fmt: skip


def _free_ring(evidence: Evidence) -> Question:
    records = [evidence.checks[name] for name in ("bearing_sector",) if name in evidence.checks]
    question = Question("Free or thin outer ring?", "check-bearing-sector" if records else "hertz", records)
    worst, mended = (sector(evidence.checks, each, MOST_ASKED) for each in ("free", WITH_RINGS))
    if not worst:
        return question
    return question._replace(
        answer=f"use elastic_rings, then: {mended}", worst=worst, verdict=LIMIT_OF_USE,
        may="rings in seats that are not stiff with elastic_rings" if mended else "",
        not_for=f"a free outside diameter without elastic_rings (off by {worst})",
    )  # fmt: skip


def _elastic_rings(evidence: Evidence) -> Question:
    records = [evidence.checks[name] for name in RINGS if name in evidence.checks]
    is_there = "elastic_ring" in evidence.checks
    question = Question("Elastic rings themselves?", "check-elastic-ring" if is_there else "hertz", records)
    findings = [
        row for row in _rows(evidence.checks, "elastic_ring") if row["verdict"] == "finding" and row["reference"]
    ]
    if not findings:
        return question
    worst, missed = max(findings, key=lambda row: abs(deviation_percent(row))), _failing(records)
    off = f"{largest(findings)} of the {as_read(worst['quantity'])}"
    return question._replace(
        answer=f"one pitch in three dimensions; worst: {as_read(worst['case'])}",
        worst=off, verdict=_judged(False) if missed else LIMIT_OF_USE, missed=missed,
        not_for=f"deflections of elastic rings near 0° with many balls (up to {off})",
    )  # fmt: skip


def _published(evidence: Evidence) -> Question:
    records = [kept for kept in evidence.book.values() if kept.data["kind"] != "M"]
    question = Question("Published results?", "published", records)
    if not records:
        return question
    expected = [kept for kept in records if not is_counter_example(kept.data)]
    good, missed = sum(map(_passes, expected)), _failing(records)
    rows = [(row, kept) for kept in expected for row in kept.data["rows"] if row["tolerance_percent"]]
    near, case = max(rows, key=lambda each: used(each[0]))
    told, more = row_text.of_row(near), _and_more(records, expected)
    return question._replace(
        answer=f"{len(expected)} cases computed by others{more}; nearest to its limit: {case.data['title']}",
        worst=(told.deviation and difference(near)) or told.found, limit=told.tolerance,
        verdict=_judged(not missed, f"{good} of {len(expected)}"), missed=missed,
        may="" if missed else "ratings, rating life and film thickness by published formulas",
    )  # fmt: skip


def _measured(evidence: Evidence) -> Question:
    records = [kept for kept in evidence.book.values() if kept.data["kind"] == "M"]
    question = Question("Measurements?", "measurements" if records else "published", records)
    if not records:
        return question
    expected = [kept for kept in records if not is_counter_example(kept.data)]
    rows = [row for kept in expected for row in kept.data["rows"] if row["reference"] and row["verdict"] == "finding"]
    worst = max(rows, key=lambda row: abs(deviation_percent(row)), default=None)
    missed, more = _failing(records), _and_more(records, expected)
    return question._replace(
        answer=f"{sum(map(_passes, expected))} of {len(expected)} within their limits{more}; worst single finding: "
        + ("none" if worst is None else f"{as_read(worst['quantity'])}, {as_read(worst['case'])}"),
        worst="" if worst is None else largest([worst]),
        verdict=_judged(False) if missed else Badge("not validated", "finding"), missed=missed,
        not_for="contact angles, loads and stiffness at speed (no such measurement was found)",
    )  # fmt: skip


def _and_more(records: Sequence[Kept], expected: Sequence[Kept]) -> str:
    more = len(records) - len(expected)
    return f", {more} counter-example{'s' if more > 1 else ''}, not expected to agree" if more else ""


def is_counter_example(entry: Mapping[str, Any]) -> bool:
    """Whether a published case is one that the model is not expected to meet."""
    return bool(entry.get("counter_example"))


@dataclass(frozen=True)
class Scenes:
    """Random scenes of one campaign."""

    name: str
    count: int
    lost: int
    """Not converged."""
    solved: int
    wrong: int
    allowed: int | None
    """Of them that may not converge; None: no limit was set."""


def scenes(kept: Kept) -> Scenes:
    """The counts of a campaign, whichever made it."""
    record = kept.data
    if "campaign" in record:
        lost, wrong = len(record["not_converged"]), len(record["wrong"])
        solved = record["ended"].get("converged", 0)
        return Scenes(record["campaign"].replace("_", " "), record["count"], lost, solved, wrong, None)
    lost, wrong = record["classes"].get("not_converged", 0), sum(record["failures"].values())
    solved = record["classes"].get("converged", 0)
    return Scenes(record["envelope"], record["count"], lost, solved, wrong, record["bar"]["allowed"])


def refusals(kept: Iterable[Kept]) -> dict[str, int]:
    """Scenes of campaigns without an equilibrium by their reason, the most frequent first."""
    by_reason: Counter[str] = Counter()
    for one in kept:
        ended = one.data.get("ended", {}).items()
        by_reason.update({how.partition(": ")[2]: number for how, number in ended if how.startswith(REFUSED)})
        reasons = one.data.get("no_equilibrium", {}).get("reasons_and_certificates", {})
        by_reason.update({why: sum(certificates.values()) for why, certificates in reasons.items()})
    merged: Counter[str] = Counter()
    for why, number in by_reason.items():
        merged[why.replace("_", " ")] += number
    return dict(merged.most_common())


def waived(kept: Kept) -> int:
    """Scenes of a campaign that did not converge and are excused by name."""
    return sum(name in NOT_CONVERGED for name in kept.data["not_converged"])


def total(kept: Iterable[Kept]) -> Scenes:
    """Of campaigns together."""
    each = [scenes(one) for one in kept]
    count, lost, solved, wrong = (
        sum(getattr(one, name) for one in each) for name in ("count", "lost", "solved", "wrong")
    )
    return Scenes("random", count, lost, solved, wrong, None)


def _robust(evidence: Evidence) -> Question:
    records = [*evidence.campaigns, *evidence.recomputed, *([evidence.hard_cases] if evidence.hard_cases else [])]
    question = Question("Hard and random scenes?", "robustness", records)
    if not records:
        return question
    limited, others = [list(map(scenes, each)) for each in (evidence.campaigns, evidence.recomputed)]
    cases = evidence.hard_cases.data["cases"] if evidence.hard_cases else []
    hard = [each["case"] for each in cases if each["verdict"] not in EXPECTED]
    excused = {kept.data["envelope"]: waived(kept) for kept in evidence.campaigns}
    missed = [
        f"{each.lost} of {each.count:,} {each.name} random scenes did not converge ({each.allowed} allowed)"
        for each in limited
        if each.lost - excused[each.name] > (each.allowed or 0)
    ]
    missed += [
        f"{each.wrong} of {each.count:,} {each.name} scenes are wrong" for each in limited + others if each.wrong
    ]
    missed += [f"hard cases without the expected result: {', '.join(hard)}"] if hard else []
    every, good = total(evidence.random_scenes), len(cases) - len(hard)
    return question._replace(
        answer=f"{good} of {len(cases)} hard cases give the expected result; {every.wrong} of {every.count:,} random "
        "scenes wrong",
        worst=f"not converged: {every.lost} of {every.count:,}",
        limit=", ".join(f"{each.name} {each.allowed}" for each in limited),
        verdict=Badge("waived", "finding") if any(excused.values()) and not missed else _judged(not missed),
        missed="; ".join(missed),
    )  # fmt: skip
