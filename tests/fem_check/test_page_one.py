"""Page 1 of the validation report: its text is composed from the records, and says what they say."""

from __future__ import annotations

import dataclasses
import json
import re
from pathlib import Path
from typing import Any

import pytest

from fem_check.report import evidence, page_one, questions
from fem_check.report.evidence import Evidence, Kept
from fem_check.report.sections import traceability
from fem_check.running.known import NOT_CONVERGED
from qsbearing.documents.html import html
from qsbearing.documents.model import Document, Remark, Section, Table
from qsbearing.model.version import __version__
from qsbearing.results import provenance
from tests.documents.page import Page

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def shipped() -> Evidence:
    return evidence.read()


def text_of(found: Evidence) -> str:
    """All of page 1; what it links to is empty here."""
    asked = questions.all_of(found)
    places = [Section("Place", [], name) for name in dict.fromkeys(each.see for each in asked)]
    document = Document("Title", "Kind", places, head=page_one.blocks(found, asked, None))
    return re.sub(r"\s+", " ", Page.of(html(document)).text)


def verdict(found: Evidence) -> Remark:
    return page_one.verdict(found, questions.all_of(found))


def altered(kept: Kept, **changes: Any) -> Kept:
    return dataclasses.replace(kept, data=json.loads(json.dumps(kept.data)) | changes)


def at_one_commit(found: Evidence, commit: str) -> Evidence:
    """The same evidence, every record made at one commit."""

    def moved(kept: Kept) -> Kept:
        return altered(
            kept, provenance={**(kept.provenance or {"date": "2026-01-01"}), "commit": commit, "dirty": False}
        )

    changes: dict[str, Any] = {}
    for field in dataclasses.fields(found):
        value = getattr(found, field.name)
        if isinstance(value, Kept):
            changes[field.name] = moved(value)
        elif isinstance(value, dict):
            changes[field.name] = {name: moved(each) for name, each in value.items()}
        elif isinstance(value, list):
            changes[field.name] = list(map(moved, value))
    return dataclasses.replace(found, **changes)


def sector_rows(found: Evidence, end: str, quantity: str) -> list[dict[str, Any]]:
    return [
        row
        for row in found.checks["bearing_sector"].data["rows"]
        if row["verdict"] == "finding" and row["reference"]
        if row["case"].endswith(end) and row["quantity"].endswith(quantity)
    ]


def test_page_one_names_the_document_and_the_commit(shipped: Evidence) -> None:
    text = text_of(shipped)
    assert f"QSB-VR-{__version__}" in text
    assert (provenance.commit() or "an installed package")[:12] in text
    for word in ("Prepared by", "Reviewed by", "Released by", "Scope.", "± means:", "Changes since the last release."):
        assert word in text


def test_page_one_has_eight_questions_with_a_verdict_and_a_place(shipped: Evidence) -> None:
    asked = questions.all_of(shipped)
    assert len(asked) == 8
    assert all(each.worst and each.answer and each.see and each.records for each in asked)
    green = {each.text for each in asked if each.verdict.kind == "pass"}
    assert not green & {each.text for each in asked if each.not_for}, "what is not validated has no green verdict"


def test_page_one_says_the_worst_known_deviations(shipped: Evidence) -> None:
    """Of a free outside diameter and of the model of elastic rings, in µm and degrees where a per cent misleads."""
    text = text_of(shipped)
    moved = [1e6 * (row["found"] - row["reference"]) for row in sector_rows(shipped, "diameter free", "displacement")]
    turned = [row["found"] - row["reference"] for row in sector_rows(shipped, "diameter free", "angle")]
    rings = [
        row["deviation_percent"]
        for row in shipped.checks["elastic_ring"].data["rows"]
        if row["verdict"] == "finding" and row["reference"]
    ]
    assert f"axial displacement {max(moved, key=abs):+.3g} µm" in text
    assert f"angle {max(turned, key=abs):+.2g}°" in text
    assert f"{max(rings, key=abs):+.3g} % of the radial deflection" in text


def test_page_one_prints_every_waiver_and_all_that_did_not_converge(shipped: Evidence) -> None:
    text = text_of(shipped)
    lost = {name for kept in shipped.campaigns for name in kept.data["not_converged"]}
    assert lost & set(NOT_CONVERGED)
    for name in lost & set(NOT_CONVERGED):
        assert name in text
        assert NOT_CONVERGED[name] in text
    assert len(shipped.recomputed) == 2
    for kept in shipped.recomputed:
        count = f"{len(kept.data['not_converged'])} of {kept.data['count']:,} {kept.data['campaign'].replace('_', ' ')}"
        assert count in text


def test_page_one_and_the_readme_count_the_same_random_scenes(shipped: Evidence) -> None:
    every = questions.total(shipped.campaigns)
    assert f"not converged: {every.lost} of {every.count:,}" in text_of(shipped)
    assert f"{every.count:,} random scenes {every.lost} did not converge" in (ROOT / "README.md").read_text("utf-8")


def test_page_one_counts_the_origin_of_records(shipped: Evidence) -> None:
    """A set of several commits, or with one that is not known, is never called a release."""
    (table,) = [
        each for each in page_one.blocks(shipped, [], None) if isinstance(each, Table) and "older" in each.headings
    ]
    counted = [sum(int(str(line[column])) for line in table.rows) for column in (1, 2, 3, 4)]  # type: ignore[index]
    assert counted[0] == sum(counted[1:]) == len(list(shipped.all()))
    assert "not a release" in page_one.level(shipped)
    one = at_one_commit(shipped, "a" * 40)
    assert "not a release" not in page_one.level(one)
    assert traceability.tally(one.all())[1:] == (counted[0], 0)
    spoiled = dataclasses.replace(one, reference=altered(one.reference, provenance=None))  # type: ignore[arg-type]
    assert "not a release" in page_one.level(spoiled)
    assert "not a release" in page_one.level(at_one_commit(shipped, "")), "none of them is known"


def test_page_one_verdict_follows_the_records(shipped: Evidence) -> None:
    """May be used where all is met; what fails is said, and then it may not."""
    (missed,) = [each for each in questions.all_of(shipped) if each.verdict.kind == "fail"]
    said = verdict(shipped)
    assert said.status == "fail"
    assert missed.missed in said.text
    assert "May be used for" in said.text
    assert "Not validated for" in said.text
    met = dataclasses.replace(
        shipped, campaigns=[altered(kept, bar=kept.data["bar"] | {"allowed": 99}) for kept in shipped.campaigns]
    )
    assert verdict(met).status == "warning"
    assert verdict(at_one_commit(met, "a" * 40)).status == "pass"
    kept = shipped.checks["patch_test"]
    failing = dataclasses.replace(shipped, checks=shipped.checks | {"patch_test": altered(kept, verdict="fail")})
    assert "Fail: patch_test" in verdict(failing).text
    assert "May be used" not in verdict(failing).text
    assert questions.all_of(failing)[1].verdict.kind == "fail"


def test_page_one_has_no_green_counter_example(shipped: Evidence) -> None:
    measured = next(each for each in questions.all_of(shipped) if each.text == "Measurements?")
    assert any(questions.is_counter_example(kept.data) for kept in measured.records)
    assert measured.verdict.kind == "finding"


def test_page_one_requirements_name_check_record_and_sum(shipped: Evidence) -> None:
    (table,) = [
        each for each in traceability.section(shipped, questions.all_of(shipped)).blocks if isinstance(each, Table)
    ]
    shown = {str(line[1]): str(line[-1]) for line in table.rows if isinstance(line, list)}
    sums = json.loads((ROOT / "fem_check/records/manifest.json").read_text("utf-8"))
    assert all(kept.digest == sums[kept.name] for kept in shipped.all() if kept.name in sums)
    for kept in shipped.all():
        assert kept.digest.startswith(shown[kept.name.removeprefix("fem_check/records/")]), kept.name
