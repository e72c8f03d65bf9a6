"""The claims, each with the evidence for it as it is on record, and the levels of evidence."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from fem_check.checks import ALL
from fem_check.report.evidence import Evidence, Kept
from fem_check.report.figures import overview
from fem_check.report.rows import counts, quantity
from fem_check.report.sections.robustness import GOOD
from fem_check.rows import row_text
from fem_check.rows.row_text import number
from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Badge, Cell, Md, Paragraph, Picture, Section, Table

Row = dict[str, Any]
NONE = Badge("not on record", "missing")


def section(evidence: Evidence) -> Section:
    """Claims and levels of evidence."""
    return Section(
        "Claims and evidence",
        [
            Table(
                ("claim", "on record", "verdict", "see"),
                [[each.text, each.found, each.verdict, each.see] for each in _claims(evidence)],
                "llll",
                "Claims",
                stack=True,
            ),
            Paragraph(
                Md(
                    "For limits of the claims, see [known limits](#known-limits). *Verification*: the equations are "
                    "solved correctly; the reference is exact or another method's result for the same problem. "
                    "*Model comparison*: how far the model is from one with fewer simplifications. *Validation*: how "
                    "far it is from measurement. A finding is a difference without a tolerance. A row of agreement is "
                    "one quantity compared with its reference; fifty-digit scenes, relations, hard cases and random "
                    "scenes are judged as a whole and are not counted as rows."
                )
            ),
            _levels_table(_levels(evidence)),
            *scatter(evidence),
        ],
    )


def _levels_table(lines: list[list[Cell]]) -> Table:
    """Without the column of what is missing where nothing is."""
    headings = ("level of evidence", "kind", "rows", "pass", "fail", "findings", "judged as a whole", "not on record")
    count = len(headings) if any(line[-1] for line in lines) else len(headings) - 1
    caption = "Levels of evidence, and the rows of agreement of each"
    return Table(headings[:count], [line[:count] for line in lines], "llrrrrll"[:count], caption, stack=True)


def unmet(evidence: Evidence) -> list[str]:
    """What is on record against a claim, in a sentence each."""
    return [each.against for each in _claims(evidence) if each.verdict.kind == "fail"]


class Claim(NamedTuple):
    """A row of the table of claims."""

    text: str
    found: str
    verdict: Badge
    see: Md
    against: str
    """What the record has against it, where it has."""


def _claims(evidence: Evidence) -> list[Claim]:
    rows: list[Claim] = []

    def claim(text: str, found: str | None, good: bool, link: str, passed: str = "pass", against: str = "") -> None:
        verdict = NONE if found is None else Badge(passed if good else "fail")
        rows.append(Claim(text, found or "", verdict, Md(link), against or f"{text} On record: {found}."))

    found, good = _fifty_digits(evidence.reference)
    claim("The equations are solved to rounding error.", found, good, "[mathematics](#mathematics)")
    found, good = _contacts(evidence)
    claim(
        "Every contact of a solution agrees with Hertz: with closed forms and with finite elements.", found, good,
        "[solution contacts](#check-solution-contacts)" if "solution_contacts" in evidence.checks else "",
    )  # fmt: skip
    found, good = _sector(evidence)
    claim(
        "One ball between elastic rings, bore and outside diameter fixed, differs little from the model.", found, good,
        "[bearing sector](#check-bearing-sector)" if "bearing_sector" in evidence.checks else "", "finding",
    )  # fmt: skip
    found, good = _parts(evidence)
    claim(
        "Batches, motion, stresses, elastic shafts, heat, scene files and the catalogue agree with references of their "
        "own.", found, good, "[solution parts](#check-solution-parts)" if found else "",
    )  # fmt: skip
    found, good = _edge(evidence)
    claim(
        "A contact cut off by its groove's edge is as the reading overrun says.", found, good,
        "[contact at the edge](#check-contact-at-the-edge)" if found else "",
    )  # fmt: skip
    found, good = _book(evidence)
    claim("Published results are reproduced within their tolerances.", found, good, "[the book](#computed-by-others)")
    found, good = _wrong(evidence.campaigns)
    claim(
        "No random scene ends with a wrong result, or is refused without a certificate.",
        found,
        good,
        "[scenes](#robustness)",
    )
    found, good = _unsolved(evidence.campaigns)
    claim(
        "No more random scenes than allowed end without a solution or a refusal.",
        found,
        good,
        "[limits](#robustness)",
        against=_too_many(evidence.campaigns),
    )
    found, good = _hard_cases(evidence.hard_cases)
    claim("Named hard cases end as they should.", found, good, "[hard cases](#robustness)")
    return rows


def _fifty_digits(kept: Kept | None) -> tuple[str | None, bool]:
    if kept is None:
        return None, False
    cases = kept.data["cases"]
    worst = max(max(each[name] for name in ("loads", "angles", "displacements", "stiffness")) for each in cases)
    found = f"{len(cases)} scenes, largest relative error {row_text.scientific(worst, 2)}"
    return found, all(each["verdict"] == "pass" for each in cases)


def _contacts(evidence: Evidence) -> tuple[str | None, bool]:
    kept = evidence.checks.get("solution_contacts")
    if kept is None:
        return None, False
    elements = [row for row in kept.data["rows"] if row["case"].endswith("finite elements")]
    worst = max(elements, key=lambda row: abs(row["deviation_percent"]))
    said = (
        f"largest deviation from the finite elements {number(abs(worst['deviation_percent']), 2)} % "
        f"({row_text.in_words(worst['quantity'])}), {kept.data['level']} level"
    )
    return said, kept.data["verdict"] == "pass"


def _sector(evidence: Evidence) -> tuple[str | None, bool]:
    kept = evidence.checks.get("bearing_sector")
    if kept is None:
        return None, False
    rows = [row for row in kept.data["rows"] if row["verdict"] == "finding" and "diameter rigid" in row["case"]]
    said = []
    for name in SECTOR:
        own = [row for row in rows if name == row["quantity"].removeprefix("inner ").removeprefix("outer ")]
        if not own:
            continue
        unit = "°" if own[0]["unit"] == "deg" else row_text.difference_unit(own[0])
        differences = [
            row["deviation_percent"] if unit == "%" else row_text.in_unit(row)[0] * (row["found"] - row["reference"])
            for row in own
        ]
        said.append(f"{quantity(name)} {number(max(differences, key=abs), 2, signed=True)} {unit}")
    return f"largest differences: {', '.join(said)}", kept.data["verdict"] == "pass"


SECTOR = ("load", "angle", "axial_displacement", "semi_major_axis", "semi_minor_axis", "max_pressure")
"""Of either raceway."""


def _parts(evidence: Evidence) -> tuple[str | None, bool]:
    kept = evidence.checks.get("solution_parts")
    if kept is None:
        return None, False
    found = counts(kept.data["rows"])
    return f"{found['pass']} of {found['pass'] + found['fail']} rows pass", kept.data["verdict"] == "pass"


def _edge(evidence: Evidence) -> tuple[str | None, bool]:
    """Of the sharp edge and of rounded ones, by what is compared: the largest deviations."""
    kept = evidence.checks.get("contact_at_the_edge")
    if kept is None:
        return None, False
    worst: dict[str, float] = {}
    for row in kept.data["rows"]:
        name = row["quantity"].removeprefix("reading overrun: ")
        worst[name] = max(worst.get(name, 0.0), abs(row["deviation_percent"]))
    said = ", ".join(f"{name} {number(value, 2)} %" for name, value in worst.items())
    return f"largest deviations: {said}", kept.data["verdict"] == "pass"


def _book(evidence: Evidence) -> tuple[str | None, bool]:
    if not evidence.book:
        return None, False
    cases = [kept.data for kept in evidence.book.values()]
    expected = [each for each in cases if not each.get("counter_example")]
    counter_examples = len(cases) - len(expected)
    measured = sum(each["kind"] == "M" for each in expected)
    failed = [name for name, kept in evidence.book.items() if kept.data["verdict"] != "pass"]
    said = f"{len(expected) - measured} cases computed by others, {measured} measurements"
    if counter_examples:
        said += f"; {counter_examples} counter-example{'s' * (counter_examples > 1)}, not expected to be met"
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


def _too_many(kept: Sequence[Kept]) -> str:
    """Which campaigns have more scenes without an outcome than they may have."""
    said = [
        f"{found['classes']['not_converged']} of {found['count']:,} {found['envelope']} random scenes did not converge "
        f"({found['bar']['allowed']} allowed)"
        for found in (each.data for each in kept)
        if found["classes"].get("not_converged", 0) > found["bar"]["allowed"]
    ]
    return f"{'; '.join(said)}."


def _hard_cases(kept: Kept | None) -> tuple[str | None, bool]:
    if kept is None:
        return None, False
    cases = kept.data["cases"]
    good = sum(each["verdict"] in GOOD for each in cases)
    return f"{good} of {len(cases)}", good == len(cases)


def _levels(evidence: Evidence) -> list[list[Cell]]:
    groups, absent = by_kind(evidence), {name for name in ALL if name not in evidence.checks}
    wholes = {
        "Mathematics": (
            _passed("fifty-digit scenes", evidence.reference, "cases"),
            _passed("files of relations", evidence.relations, "files"),
        ),
        "Hard cases and random scenes": (
            _passed("hard cases", evidence.hard_cases, "cases", GOOD),
            _met(evidence.campaigns),
        ),
    }
    lines: list[list[Cell]] = []
    for name, (kind, link) in LEVELS.items():
        rows, whole = groups.get(name, []), wholes.get(name, ())
        missing = [each.removesuffix("not on record") for each in whole if each.endswith("not on record")]
        missing += [check for check in sorted(absent) if _level_of(check) == name]
        missing += ["the book"] if kind in ("comparison", "validation") and not evidence.book else []
        judged = [each for each in whole if not each.endswith("not on record")]
        found = [len(rows), *counts(rows).values()]
        lines.append([Md(f"[{name}]({link})"), kind, *map(str, found), ", ".join(judged), ", ".join(missing)])
    every = [row for rows in groups.values() for row in rows]
    return [*lines, ["all", "", str(len(every)), *map(str, counts(every).values()), "", ""]]


LEVELS = {
    "Mathematics": ("verification", "#mathematics"),
    "Standards, catalogues, programs": ("comparison", "#computed-by-others"),
    "Finite elements: half-spaces": ("verification", "#finite-elements"),
    "Finite elements: true bodies": ("model comparison", "#finite-elements"),
    "Measurements": ("validation", "#measurements"),
    "Hard cases and random scenes": ("robustness", "#robustness"),
}


def by_kind(evidence: Evidence) -> dict[str, list[Row]]:
    """Every row of agreement by its level of evidence."""
    found: dict[str, list[Row]] = {}
    for name, kept in evidence.checks.items():
        found.setdefault(_level_of(name, kept.data["kind"]), []).extend(kept.data["rows"])
    for kept in evidence.book.values():
        name = "Measurements" if kept.data["kind"] == "M" else "Standards, catalogues, programs"
        found.setdefault(name, []).extend(kept.data["rows"])
    return found


def _level_of(check: str, kind: str = "") -> str:
    kind = kind or str(ALL[check].kind)
    return "Finite elements: half-spaces" if kind == "verification" else "Finite elements: true bodies"


def _passed(what: str, kept: Kept | None, key: str, good: Sequence[str] = ("pass",)) -> str:
    if kept is None:
        return f"{what} not on record"
    cases = kept.data[key]
    return f"{sum(each['verdict'] in good for each in cases)} of {len(cases)} {what}"


def _met(campaigns: Sequence[Kept]) -> str:
    if not campaigns:
        return "random scenes not on record"
    met = sum(each.data["bar"]["met"] for each in campaigns)
    return f"{met} of {len(campaigns)} campaigns of random scenes"


def scatter(evidence: Evidence) -> list[Picture]:
    """All rows: what was found against the reference, and how much of its tolerance each takes."""
    groups = {name: rows for name, rows in by_kind(evidence).items() if overview.drawable(rows)}
    if not groups:
        return []
    figure = overview.scatter(groups)
    found = picture(
        figure,
        "For each kind of evidence a panel of found against reference values on the line of equality, and a panel of "
        "deviations below the line where they would equal their tolerances.",
        "All rows of agreement by kind of evidence, in SI units. Above: found against reference; the band is the "
        "largest tolerance of that kind. Below: deviation and uncertainty together, against the row's tolerance; "
        "points below the line pass",
    )
    overview.plt.close(figure)
    return [found]
