"""A check on a card: its answer with its number, one picture, its worst rows, and where they come from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from fem_check.checks import ALL, OPTIONAL
from fem_check.report.evidence import Evidence, Kept, missing
from fem_check.report.figures import drawn
from fem_check.report.questions import WITH_RINGS, sector
from fem_check.report.rows import as_read, difference, largest, quantity, table, used, worst
from fem_check.rows import row_text
from fem_check.rows.record import RowRecord, deviation_percent
from qsbearing.documents.model import Block, Callout, Md, Paragraph, Section, Trace
from qsbearing.documents.numbers import duration, plain

VERIFICATION = (
    "Half-spaces and a parabolic gap, where Hertz is exact: every deviation is an error. A row passes if deviation and "
    "uncertainty together stay within its limit. Each table has the worst rows, one of a quantity; every row is in the "
    "CSV and JSON files beside this report."
)
COMPARISON = (
    "True grooves, elastic rings, the ball's own position: here the deviation is the result. A finding is a difference "
    "with no pass limit; limits apply to the agreement of two methods and to the uncertainty. It compares two models, "
    "and is no measurement."
)
ANSWERS = {
    "patch_test": "Constant strain and rigid motion are represented exactly.",
    "manufactured_solution": "Elasticity is solved at the order of theory.",
    "half_space_contacts": "Finite elements of half-spaces give Hertz's contact for every shape.",
    "load_power_law": "Approach and semi-axes follow Hertz's powers of the load.",
    "body_size": "The approach in growing boxes tends to that of the exact far field.",
    "convergence_order": "Errors fall with the element size as the uncertainties assume.",
    "solution_contacts": "Contacts, motion, equilibrium and stiffness are right with every effect and in sets.",
    "solution_parts": "Batches, motion, stresses, elastic shafts, scene files and the catalogue are right.",
    "contact_at_the_edge": "A contact that the groove's edge cuts off is read as boundary elements find it.",
    "elastic_ring": "Elastic rings deflect as a ring of finite elements does, and share the load in the same way.",
    "true_geometry": "Two methods agree on the true gap.",
    "conformity": "Two methods agree on the gap of every groove radius.",
    "bearing_sector": "Forces balance, and half-spaces in the bodies' place give the model.",
}
"""What is answered where every judged row is within its limit."""


def sections(evidence: Evidence) -> list[Section]:
    """The cards, by what the checks are; a check without a record is said."""
    kinds: dict[str, list[Block]] = {
        "verification": [Paragraph(VERIFICATION)],
        "model comparison": [Paragraph(COMPARISON)],
    }
    for name, check in (ALL | OPTIONAL).items():
        kept = evidence.checks.get(name)
        if kept is not None:
            kinds[kept.data["kind"]].append(card(name, kept))
        elif name in ALL:
            kinds[str(check.kind)].append(missing(f"Check {name}", f"fem-check run {name}"))
    verification, comparison = kinds.values()
    return [
        Section("Finite elements: verification", verification, "hertz"),
        Section("Limits of Hertz and of rigid rings, by finite elements", comparison, "fe-limits"),
    ]


def card(name: str, kept: Kept) -> Section:
    """Of a check."""
    entry, rows = kept.data, kept.data["rows"]
    status = "fail" if entry["verdict"] == "fail" else "finding" if name in _OF else "pass"
    made = f"{kept.made_with}; {_size_of(entry)}{len(rows)} rows"
    blocks: list[Block] = [
        Callout(Md(answer(name, kept)), status),
        *drawn.one(entry),
        table(worst(rows)),
        Trace(kept.name, kept.command, made),
    ]
    return Section(name.replace("_", " ").capitalize(), blocks, f"check-{name.replace('_', '-')}", is_whole=True)


def _size_of(entry: dict[str, Any]) -> str:
    unknowns = entry["mesh"].get("dofs")
    took = duration(entry["seconds"])
    return f"{f'{unknowns:,} unknowns, ' if unknowns else ''}{took}, {entry['peak_memory_MB'] / 1e3:.1f} GB, "


def answer(name: str, kept: Kept) -> str:
    """One sentence with its number; the question, where no answer is known."""
    rows = kept.data["rows"]
    bad = [row for row in rows if row["verdict"] in ("fail", "refused")]
    if bad:
        return f"**{len(bad)} of {len(rows)} rows are out of their limits.** {as_read(kept.data['question'])} No."
    findings = [row for row in rows if row["verdict"] == "finding" and row["reference"]]
    sentence = _OF[name](kept, findings) if name in _OF else ""
    return " ".join(filter(None, (sentence and f"**{sentence}**", _judged(name, kept, bold=not sentence))))


def _judged(name: str, kept: Kept, bold: bool) -> str:
    judged = [row for row in kept.data["rows"] if row["tolerance_percent"] is not None]
    rows = [row for row in judged if row["reference"]] or judged
    said = ANSWERS.get(name) or f"{as_read(kept.data['question'])} Yes."
    said = f"**{said}**" if bold else said
    if not rows:
        return said
    near = max(rows, key=used)
    told = row_text.of_row(near)
    what = quantity(as_read(near["quantity"]))
    return f"{said} Nearest to its limit: {what}, {difference(near)} (limit {told.tolerance})."


def _sector(kept: Kept, _: Sequence[RowRecord]) -> str:
    rigid, free, mended = (sector({kept.data["check"]: kept}, each) for each in ("rigid", "free", WITH_RINGS))
    return " ".join(
        f"{outside}: {said}."
        for outside, said in (
            ("Rigid seat", rigid), ("Free outside diameter", free), ("Free, with elastic_rings in the model", mended),
        )
        if said
    )  # fmt: skip


def _true_geometry(_: Kept, findings: Sequence[RowRecord]) -> str:
    each: dict[str, list[RowRecord]] = {row["quantity"]: [] for row in findings if row["unit"] in ("m", "Pa")}
    for row in findings:
        each.get(row["quantity"], []).append(row)
    said = ", ".join(f"{largest(rows)} ({quantity(name)})" for name, rows in each.items())
    return f"Hertz is off by up to {said}." if said else ""


def _conformity(kept: Kept, _: Sequence[RowRecord]) -> str:
    told = kept.data["pictures"]["conformity"]
    ends = {f: max(abs(values[-1]) for values in told["curves"][f].values()) for f in told["curves"]}
    said = " and ".join(f"{plain(ends[f], '.2g')} % with f = {f}" for f in (min(ends, key=float), max(ends, key=float)))
    return f"At {told['load_N'][-1]:,.0f} N Hertz is off by up to {said}."


def _elastic_ring(_: Kept, findings: Sequence[RowRecord]) -> str:
    at = max(findings, key=lambda row: abs(deviation_percent(row)), default=None)
    if at is None:
        return ""
    where = f"{as_read(at['quantity'])}; {as_read(at['case'])}"
    return f"The model of elastic rings is off by up to {largest(findings)} ({where})."


_OF = {
    "bearing_sector": _sector,
    "true_geometry": _true_geometry,
    "conformity": _conformity,
    "elastic_ring": _elastic_ring,
}
"""Checks whose findings are the answer."""
