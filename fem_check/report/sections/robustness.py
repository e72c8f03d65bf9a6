"""Robustness: named hard cases and random scenes."""

from __future__ import annotations

from collections import Counter

from fem_check.report.evidence import Evidence, Kept, missing
from fem_check.report.rows import as_read
from fem_check.rows.row_text import scientific
from qsbearing.documents.model import Badge, Block, Bullets, Cell, Paragraph, Section, Table

GOOD = ("within 1e-9", "explained by its condition", "as expected")


def section(evidence: Evidence) -> Section:
    """Whether a scene is solved, and if not, whether it is said rightly."""
    words = (
        "Does every scene end, and does its status tell the truth? A solution is checked from its public numbers "
        "alone: forces, moments, closure, Hertz. A refusal needs a certificate from another method: a proof, or an "
        "inadmissible equilibrium as evidence."
    )
    blocks: list[Block] = [
        Paragraph(words),
        Section("Random scenes", _campaigns(evidence.campaigns)),
        Section("Named hard cases", _hard_cases(evidence.hard_cases)),
        Section("Small errors in the code", _mutations(evidence.mutations)),
    ]
    return Section("Hard cases and random scenes", blocks, "robustness")


def _campaigns(kept: list[Kept]) -> list[Block]:
    if not kept:
        return [
            missing("A campaign of random scenes", "python -m tests.verification.campaign --envelope wild --record")
        ]
    rows: list[list[Cell]] = []
    for each in kept:
        found = each.data
        classes, met = found["classes"], found["bar"]["met"]
        rows.append([
            found["envelope"], f"{found['count']:,}",
            *(f"{classes.get(name, 0):,}" for name in ("converged", "no_equilibrium", "not_converged")),
            str(sum(found["failures"].values())), str(found["iterations_of_converged"]["median"]),
            scientific(found["largest"]["imbalance"], 1),
            Badge("met" if met else "not met", "pass" if met else "fail"),
        ])  # fmt: skip
    headings = (
        "envelope", "scenes", "converged", "no equilibrium", "not converged", "wrong",
        "iterations, median", "largest imbalance", "limit",
    )  # fmt: skip
    bars = [as_read(f"{each.data['envelope']}: {each.data['bar']['asked']}") for each in kept]
    table = Table(headings, rows, "l" + "r" * 7 + "l", "Campaigns of random scenes", stack=True)
    proofs = ", ".join(
        f"{each.data['no_equilibrium']['proofs']:,} of {each.data['classes'].get('no_equilibrium', 0):,} "
        f"({each.data['envelope']})"
        for each in kept
        if "not asked" not in each.data["no_equilibrium"]["certificates"]
    )
    words = (
        f"Refusals with a proof: {proofs}; the others with an inadmissible equilibrium as evidence. "
        "The records name each scene that did not converge."
    )
    return [table, Paragraph(words), Paragraph("Acceptance limits:"), Bullets(bars), *(each.trace for each in kept)]


def _mutations(kept: Kept | None) -> list[Block]:
    """How many of the errors planted at random are seen, and which are not."""
    if kept is None:
        return [missing("The survey of mutations", "python -m tests.verification.mutations")]
    found, survivors = kept.data["found"], kept.data["survivors"]
    seen = sum(bool(each["seen_by"]) for each in found)
    by_check = sum(each["seen_by"].startswith(("check", "book")) for each in found)
    unseen = [each for each in found if not each["seen_by"]]
    told = [survivors.get(f"{each['path']}:{each['line']}", {}) for each in unseen]
    same = sum(each.get("is_equivalent", False) for each in told)
    words = (
        f"Of {kept.data['count']} changes of one operator or digit, drawn from the code of both packages, {len(found)} "
        f"were made. The tests of the module, then quick checks, each at most {kept.data['seconds']} s, saw {seen} of "
        f"them ({100.0 * seen / len(found):.0f} %), {by_check} of these by a check alone. Of the other {len(unseen)}, "
        f"{same} make no difference to any result."
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
        return [missing("The table of hard cases", "python -m tests.verification.hard_cases.table")]
    rows: list[list[Cell]] = []
    for each in kept.data["cases"]:
        errors = [scientific(each[key], 1) if key in each else "" for key in ("loads", "angles", "displacements")]
        verdict = each["verdict"]
        rows.append([
            each["case"], as_read(each["what"]), each["status"].replace("_", " "), str(each["iterations"]), *errors,
            scientific(each["unavoidable"], 1) if "unavoidable" in each else "",
            Badge(verdict, "pass" if verdict in GOOD else "fail"),
        ])  # fmt: skip
    tally = Counter(each["verdict"] for each in kept.data["cases"])
    words = (
        f"{len(rows)} scenes against their own fifty-digit solutions: "
        f"{', '.join(f'{count} {verdict}' for verdict, count in tally.items())}. Errors are relative; unavoidable is "
        "the error that the rounding of the input causes, by the condition number."
    )
    headings = (
        "case",
        "difficulty",
        "outcome",
        "iterations",
        "loads",
        "angles",
        "displacements",
        "unavoidable",
        "verdict",
    )
    return [Paragraph(words), Table(headings, rows, "lllrrrrrl", "Hard cases", stack=True), kept.trace]
