"""The claims, each with the evidence for it as it is on record, and the ladder that they stand on."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from fem_check.checks import ALL
from fem_check.report.evidence import Evidence, Kept
from fem_check.report.rows import counts, number
from fem_check.report.sections.mathematics import CHECKS as OF_FORMULAS
from fem_check.report.sections.robustness import GOOD
from qsbearing.documents.model import Badge, Cell, Md, Paragraph, Section, Table

Row = dict[str, Any]
NONE = Badge("not on record", "missing")


def section(evidence: Evidence) -> Section:
    """Claims and ladder."""
    return Section(
        "Claims and evidence",
        [
            Table(("claim", "on record", "verdict", "see"), _claims(evidence), "llll", "What is claimed", stack=True),
            Paragraph(
                Md(
                    "What is not claimed stands under [known limits](#known-limits). *Verification*: the equations are "
                    "solved right; the reference is exact or another method's result for the same problem. "
                    "*Validation*: how far the model is from the thing. A finding is a difference without a tolerance."
                )
            ),
            Table(
                ("rung", "kind", "pass", "fail", "findings", "not on record"),
                _ladder(evidence),
                "llrrrr",
                "The ladder of evidence",
            ),
        ],
    )


def unmet(evidence: Evidence) -> list[str]:
    """The claims that what is on record contradicts."""
    return [str(row[0]) for row in _claims(evidence) if isinstance(row[2], Badge) and row[2].kind == "fail"]


def _claims(evidence: Evidence) -> list[list[Cell]]:
    rows: list[list[Cell]] = []

    def claim(text: str, found: str | None, good: bool, link: str) -> None:
        verdict = NONE if found is None else Badge("pass" if good else "fail")
        rows.append([text, found or "", verdict, Md(link)])

    found, good = _fifty_digits(evidence.reference)
    claim("The equations are solved to their last digits.", found, good, "[mathematics](#mathematics)")
    found, good = _contacts(evidence)
    claim(
        "Every contact that a solution reports is Hertz's, as closed forms and finite elements have it.", found, good,
        "[solution contacts](#check-solution-contacts)" if "solution_contacts" in evidence.checks else "",
    )  # fmt: skip
    found, good = _sector(evidence)
    claim(
        "One ball between elastic rings, stiffly held, has the loads and the contact angles of the model.", found, good,
        "[bearing sector](#check-bearing-sector)" if "bearing_sector" in evidence.checks else "",
    )  # fmt: skip
    found, good = _book(evidence)
    claim("Published points are met within stated tolerances.", found, good, "[the book](#computed-by-others)")
    found, good = _wrong(evidence.campaigns)
    claim("No random scene ends wrongly, or is refused without a certificate.", found, good, "[scenes](#robustness)")
    found, good = _unsolved(evidence.campaigns)
    claim(
        "Random scenes are solved or refused, but for as many as their bars allow.", found, good, "[bars](#robustness)"
    )
    found, good = _hard_cases(evidence.hard_cases)
    claim("Named hard cases end as they should.", found, good, "[hard cases](#robustness)")
    return rows


def _fifty_digits(kept: Kept | None) -> tuple[str | None, bool]:
    if kept is None:
        return None, False
    cases = kept.data["cases"]
    worst = max(max(each[name] for name in ("loads", "angles", "displacements", "stiffness")) for each in cases)
    return f"{len(cases)} scenes, largest relative error {worst:.1e}", all(each["verdict"] == "pass" for each in cases)


def _contacts(evidence: Evidence) -> tuple[str | None, bool]:
    kept = evidence.checks.get("solution_contacts")
    if kept is None:
        return None, False
    elements = [row for row in kept.data["rows"] if row["case"].endswith("finite elements")]
    worst = max(elements, key=lambda row: abs(row["deviation_percent"]))
    said = (
        f"largest deviation from the finite elements {number(abs(worst['deviation_percent']), 2)} % "
        f"({worst['quantity'].replace('_', ' ')}), {kept.data['level']} level"
    )
    return said, kept.data["verdict"] == "pass"


def _sector(evidence: Evidence) -> tuple[str | None, bool]:
    kept = evidence.checks.get("bearing_sector")
    if kept is None:
        return None, False
    rows = [row for row in kept.data["rows"] if row["verdict"] == "finding" and "diameter rigid" in row["case"]]
    said = []
    for name in ("inner load", "inner angle"):
        worst = max((row for row in rows if row["quantity"] == name), key=lambda row: abs(row["deviation_percent"]))
        said.append(f"{name} within {number(abs(worst['deviation_percent']), 2)} % ({worst['case'].split(',')[0]})")
    return f"{'; '.join(said)}; a finding", kept.data["verdict"] == "pass"


def _book(evidence: Evidence) -> tuple[str | None, bool]:
    if not evidence.book:
        return None, False
    cases = [kept.data for kept in evidence.book.values()]
    counter_examples = sum(bool(each.get("counter_example")) for each in cases)
    measured = sum(each["kind"] == "M" and not each.get("counter_example") for each in cases)
    failed = [name for name, kept in evidence.book.items() if kept.data["verdict"] != "pass"]
    computed = sum(each["kind"] != "M" for each in cases)
    said = f"{computed} cases computed by others, {measured} measurements"
    if counter_examples:
        said += f"; {counter_examples} counter-example, not expected to be met"
    return said + (f"; not passed: {', '.join(failed)}" if failed else ""), not failed


def _wrong(kept: Sequence[Kept]) -> tuple[str | None, bool]:
    if not kept:
        return None, False
    wrong = {each.data["envelope"]: sum(each.data["failures"].values()) for each in kept}
    said = [f"{each.data['envelope']}: {wrong[each.data['envelope']]} of {each.data['count']:,}" for each in kept]
    return "; ".join(said), not any(wrong.values())


def _unsolved(kept: Sequence[Kept]) -> tuple[str | None, bool]:
    if not kept:
        return None, False
    said = [
        f"{each.data['envelope']}: {each.data['classes'].get('not_converged', 0)} of {each.data['count']:,} not "
        f"converged, {each.data['bar']['allowed']} allowed"
        for each in kept
    ]
    good = all(each.data["classes"].get("not_converged", 0) <= each.data["bar"]["allowed"] for each in kept)
    return "; ".join(said), good


def _hard_cases(kept: Kept | None) -> tuple[str | None, bool]:
    if kept is None:
        return None, False
    cases = kept.data["cases"]
    good = sum(each["verdict"] in GOOD for each in cases)
    return f"{good} of {len(cases)}", good == len(cases)


def _ladder(evidence: Evidence) -> list[list[Cell]]:
    def line(text: str, kind: str, rows: Sequence[Row], absent: Sequence[str]) -> list[Cell]:
        return [Md(text), kind, *map(str, counts(rows).values()), ", ".join(absent)]

    def of_checks(names: Sequence[str]) -> tuple[list[Row], list[str]]:
        there = [evidence.checks[name] for name in names if name in evidence.checks]
        return [row for kept in there for row in kept.data["rows"]], [n for n in names if n not in evidence.checks]

    def of_book(measured: bool) -> list[Row]:
        chosen = [kept for kept in evidence.book.values() if (kept.data["kind"] == "M") == measured]
        return [row for kept in chosen for row in kept.data["rows"]]

    exact = [{"verdict": each["verdict"]} for each in (evidence.reference.data["cases"] if evidence.reference else ())]
    relations = [
        {"verdict": each["verdict"]} for each in (evidence.relations.data["files"] if evidence.relations else ())
    ]
    hard = [
        {"verdict": "pass" if each["verdict"] in GOOD else "fail"}
        for each in (evidence.hard_cases.data["cases"] if evidence.hard_cases else ())
    ]
    bars = [{"verdict": "pass" if each.data["bar"]["met"] else "fail"} for each in evidence.campaigns]
    formulas, no_formulas = of_checks(OF_FORMULAS)
    kinds = {
        kind: of_checks([name for name, check in ALL.items() if str(check.kind) == kind and name not in OF_FORMULAS])
        for kind in ("verification", "validation")
    }
    no_book = () if evidence.book else ("the book",)
    absent = [
        name
        for name, there in (("fifty-digit solutions", exact), ("relations", relations))
        if not there
    ]  # fmt: skip
    return [
        line("[Mathematics](#mathematics)", "verification", exact + relations + formulas, absent + no_formulas),
        line("[Other programs, standards, catalogues](#computed-by-others)", "comparison", of_book(False), no_book),
        line("[Finite elements: half-spaces](#finite-elements)", "verification", *kinds["verification"]),
        line("[Finite elements: true bodies](#finite-elements)", "validation of Hertz", *kinds["validation"]),
        line("[Measurements](#measurements)", "validation", of_book(True), no_book),
        line(
            "[Hard cases and random scenes](#robustness)", "robustness", hard + bars,
            [name for name, there in (("hard cases", hard), ("campaigns", bars)) if not there],
        ),
    ]  # fmt: skip
