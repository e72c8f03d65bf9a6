"""The questions that decide whether a version may be used: each answered from the records, or not on record."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from fem_check.book.case import EvidenceKind
from fem_check.checks.free_ball import HYPOTHESIS, OTHER_FRICTION
from fem_check.report import random_scenes
from fem_check.report.evidence import Evidence, Kept
from fem_check.report.question import Question, judged
from fem_check.report.rows import as_read, difference, is_count, largest, quantity, used
from fem_check.rows import row_text
from fem_check.rows.record import RowRecord, computed_value, deviation_percent
from qsbearing.documents.model import Badge

LIMIT_OF_USE = Badge("limit of use", "finding")
EXPECTED = ("within 1e-9", "explained by its condition", "as expected")
"""Verdicts of a hard case that gives the expected result."""
RINGS = ("contact_at_the_edge", "elastic_ring")
"""Checks of what Hertz and rigid rings leave out."""
MEASURES = ("loads", "angles", "displacements", "stiffness")
"""Of a scene against its solution with fifty digits."""


def all_of(evidence: Evidence) -> list[Question]:
    """In the order of page 1."""
    return [
        _equations(evidence),
        _relations(evidence),
        _elements(evidence),
        _contacts(evidence),
        _motion(evidence),
        _rigid_seat(evidence),
        _free_ring(evidence),
        _elastic_rings(evidence),
        *(_published(evidence, kind) for kind in PUBLISHED),
        _measured(evidence),
        _hard_cases(evidence),
        *random_scenes.questions(evidence),
    ]


def _failing(records: Iterable[Kept]) -> str:
    names = ", ".join(str(kept.data.get("case") or kept.data["check"]) for kept in records if not _passes(kept))
    return f"out of their limits: {names}" if names else ""


def _passes(kept: Kept) -> bool:
    return bool(kept.data["verdict"] == "pass")


def _equations(evidence: Evidence) -> Question:
    records = [evidence.reference] if evidence.reference else []
    question = Question("Equations solved?", "mathematics", records)
    if evidence.reference is None:
        return question
    record = evidence.reference.data
    cases, limit = record["cases"], record["tolerance"]
    worst = max(max(each[name] for name in MEASURES) for each in cases)
    bad = [each["case"] for each in cases if each["verdict"] != "pass"]
    return question._replace(
        answer=f"{len(cases)} scenes against solutions with fifty digits",
        worst=f"{row_text.scientific(worst, 1)}, {of_limit(worst / limit)}", limit=row_text.number(limit),
        basis="set beforehand",
        verdict=judged(not bad), missed=f"equations: {', '.join(bad)}" if bad else "",
    )  # fmt: skip


def _relations(evidence: Evidence) -> Question:
    records = [evidence.relations] if evidence.relations else []
    question = Question("Relations between solutions?", "mathematics", records)
    if evidence.relations is None:
        return question
    files = evidence.relations.data["files"]
    bad = [each["file"] for each in files if each["verdict"] != "pass"]
    return question._replace(
        answer=f"{len(files)} files of tests: mirrored, turned, scaled, differentiated",
        worst=f"{len(bad)} fail", limit="none may fail", basis="each test has its own",
        verdict=judged(not bad), missed=f"relations: {', '.join(bad)}" if bad else "",
    )  # fmt: skip


OF_PRODUCT = ("solution_contacts", "solution_parts")
OF_MOTION = ("free_ball",)
"""Checks of solutions, and of the balls' motion; the others of their kind are of the elements themselves."""


def of_limit(share: float) -> str:
    """How much of a limit deviation and uncertainty take."""
    return f"{100.0 * share:.0f} % of its limit"


SHORT_REASON = 32
"""Letters of a reason that has room beside its limit on page 1."""


def in_short(row: RowRecord) -> str:
    """Why a row has its tolerance, up to the first stop, if that is short; the annex has it in full."""
    text = as_read(row["why_tolerance"] or "")
    words = text[: min((place for stop in ";:," if (place := text.find(stop)) >= 0), default=len(text))]
    return words if len(words) <= SHORT_REASON else ""


def _elements(evidence: Evidence) -> Question:
    names = [name for name, kept in _verifying(evidence) if name not in OF_PRODUCT + OF_MOTION]
    return _compared(evidence, "Finite elements against Hertz?", names, "half_space_contacts")


def _contacts(evidence: Evidence) -> Question:
    names = [name for name, kept in _verifying(evidence) if name in OF_PRODUCT]
    return _compared(evidence, "Contacts of solutions?", names, "solution_contacts")


def _motion(evidence: Evidence) -> Question:
    """What nobody has measured is assumed or comes from friction: neither may be said to be more than that."""
    records = [evidence.checks[name] for name in OF_MOTION if name in evidence.checks]
    missed = _failing(records)
    question = Question("What do axes of balls rest on?", "check-free-ball", records)
    all_rows = _rows(evidence.checks, *OF_MOTION)
    rows = [row for row in all_rows if row["tolerance_percent"] and row["reference"]]
    if not rows:
        return question._replace(see="hertz")
    worst, cases = max(rows, key=used), len({row["case"] for row in rows})
    leads = " and friction's motion" if any(OTHER_FRICTION in row["case"] for row in all_rows) else ""
    referee = f"{cases} free balls prove the moment{leads}, no control"
    return question._replace(
        answer="; ".join((*_assumed(evidence), referee, *_unmeasured(evidence), GUIDE)),
        worst="; ".join((f"{difference(worst)}, {of_limit(used(worst))}", *_by_assumption(all_rows))),
        limit=row_text.of_row(worst).tolerance, basis=in_short(worst),
        verdict=judged(False) if missed else LIMIT_OF_USE, missed=missed,
    )  # fmt: skip


GUIDE = "page ball_axis"


def _assumed(evidence: Evidence) -> list[str]:
    """What holds the balls' axes, and how many scenes of each are solved with fifty digits."""
    if evidence.reference is None:
        return []
    cases = [each for each in evidence.reference.data["cases"] if each.get("raceway_control")]
    controls = {each["raceway_control"] for each in cases}
    balances = evidence.reference.data.get("friction_cases", [])
    return [f"{len(controls)} hypotheses ({len(cases)} scenes with fifty digits) or friction ({len(balances)})"]


def _unmeasured(evidence: Evidence) -> list[str]:
    measured = [row for kept in _published_as(evidence, EvidenceKind.MEASUREMENT) for row in kept.data["rows"]]
    angles = sum(row["unit"] == "deg" for row in measured)
    return [f"measured: {angles} of {len(measured)} numbers are angles"] if measured else []


def _by_assumption(rows: Sequence[RowRecord]) -> list[str]:
    """What becomes of a result of the free balls where their axes are assumed, or their friction is another."""
    of_hypotheses, of_friction = (
        [row for row in rows if begins in row["case"]] for begins in (HYPOTHESIS, OTHER_FRICTION)
    )
    said = []
    if of_hypotheses:
        free, (size, _) = of_hypotheses[0], row_text.in_unit(of_hypotheses[0])
        said.append(f"{quantity(free['quantity'])} by the free ball {size * free['reference']:.3g}")
        said.append(f"by hypotheses {_results(of_hypotheses)}")
    if of_friction:
        coefficients = span(row["case"].rpartition(OTHER_FRICTION)[2] for row in of_friction)
        said.append(f"by friction of {coefficients}: {_results(of_friction)}")
    return said


def _results(rows: Sequence[RowRecord]) -> str:
    """From the smallest to the largest result, with the unit that readers see."""
    size, unit = row_text.in_unit(rows[0])
    return f"{span(f'{size * computed_value(row):.3g}' for row in rows)} {unit}"


def _verifying(evidence: Evidence) -> list[tuple[str, Kept]]:
    return [(n, k) for n, k in evidence.checks.items() if k.data["kind"] == "verification" and n not in RINGS]


def _compared(evidence: Evidence, text: str, names: Sequence[str], shown: str) -> Question:
    """Of some checks; one of them has the comparisons with finite elements that are counted."""
    records = [evidence.checks[name] for name in names]
    question, missed = Question(text, "hertz", records), _failing(records)
    solved = [row for row in _rows(evidence.checks, shown) if _is_of_elements(row)]
    if not solved:
        return question._replace(verdict=judged(False), missed=missed) if missed else question
    worst = max(solved, key=used)
    return question._replace(
        answer=f"{len(solved)} comparisons with finite elements; nearest to its limit: "
        f"{row_text.in_words(worst['quantity'])}",
        worst=f"{difference(worst)}, {of_limit(used(worst))}", limit=row_text.of_row(worst).tolerance,
        basis=in_short(worst), verdict=judged(not missed), missed=missed,
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
        worst=worst, verdict=judged(False) if missed else LIMIT_OF_USE, missed=missed,
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
        worst=off, verdict=judged(False) if missed else LIMIT_OF_USE, missed=missed,
        not_for=f"deflections of elastic rings near 0° with many balls (up to {off})",
    )  # fmt: skip


PUBLISHED = {
    EvidenceKind.CATALOGUE: ("Catalogues and standards?", "ratings, rating life and film "
                             "thickness by published formulas"),
    EvidenceKind.OTHER_CODE: ("Other programs?", ""),
}  # fmt: skip
"""By what a published number is: the question, and what may be used where it is met."""


def _published_as(evidence: Evidence, kind: EvidenceKind) -> list[Kept]:
    return [kept for kept in evidence.book.values() if kept.data["kind"] == kind]


def _published(evidence: Evidence, kind: EvidenceKind) -> Question:
    text, may = PUBLISHED[kind]
    records = _published_as(evidence, kind)
    question = Question(text, "published", records)
    if not records:
        return question
    expected = [kept for kept in records if not is_counter_example(kept.data)]
    good, missed = sum(map(_passes, expected)), _failing(records)
    rows = [(row, kept) for kept in expected for row in kept.data["rows"] if row["tolerance_percent"]]
    near, case = max((each for each in rows if not is_count(each[0])), key=lambda each: used(each[0]))
    told, more = row_text.of_row(near), _and_more(records, expected)
    off = difference(near) if told.deviation or not near["reference"] else told.found
    return question._replace(
        answer=f"{len(expected)} cases{more}; nearest to its limit: {case.data['title']}",
        worst=f"{off}, {of_limit(used(near))}",
        limit=told.tolerance, basis=in_short(near),
        verdict=judged(not missed, f"{good} of {len(expected)}"), missed=missed, may="" if missed else may,
    )  # fmt: skip


def _measured(evidence: Evidence) -> Question:
    records = _published_as(evidence, EvidenceKind.MEASUREMENT)
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
        worst="" if worst is None else largest([worst]), limit="each case has its own; none of single findings",
        verdict=judged(False) if missed else Badge("none at speed", "finding"), missed=missed,
        not_for="contact angles, loads and stiffness at speed (no such measurement was found)",
    )  # fmt: skip


def _and_more(records: Sequence[Kept], expected: Sequence[Kept]) -> str:
    more = len(records) - len(expected)
    return f", {more} counter-example{'s' if more > 1 else ''}" if more else ""


def is_counter_example(entry: Mapping[str, Any]) -> bool:
    """Whether a published case is one that the model is not expected to meet."""
    return bool(entry.get("counter_example"))


def _hard_cases(evidence: Evidence) -> Question:
    question = Question("Hard cases?", "robustness", [evidence.hard_cases] if evidence.hard_cases else [])
    if evidence.hard_cases is None:
        return question
    cases = evidence.hard_cases.data["cases"]
    bad = [each["case"] for each in cases if each["verdict"] not in EXPECTED]
    by_condition = sum(each["verdict"] == EXPECTED[1] for each in cases)
    more = f", {by_condition} of them by their condition number" if by_condition else ""
    return question._replace(
        answer=f"{len(cases) - len(bad)} of {len(cases)} as expected, by solutions with fifty digits{more}",
        worst=f"{len(bad)} unexpected", limit="1e−9",
        basis="set beforehand", verdict=judged(not bad),
        missed=f"hard cases without the expected result: {', '.join(bad)}" if bad else "",
    )  # fmt: skip
