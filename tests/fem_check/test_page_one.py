"""Page 1 of the validation report: its text is composed from the records, and says what they say."""

from __future__ import annotations

import dataclasses
import json
import re
from pathlib import Path
from typing import Any

import pytest

from fem_check.checks.free_ball import HYPOTHESIS
from fem_check.report import evidence, page_one, questions, random_scenes
from fem_check.report.evidence import Evidence, Kept
from fem_check.report.rows import quantity
from fem_check.report.sections import robustness, traceability
from fem_check.running import kept_files
from fem_check.running.known import NO_LIMIT, NOT_CONVERGED
from qsbearing.documents.html import html
from qsbearing.documents.model import Badge, Callout, Document, Section, Table
from qsbearing.model.version import __version__
from qsbearing.results import provenance
from tests.documents.page import Page

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def shipped() -> Evidence:
    return evidence.read()


def text_of(records: Evidence) -> str:
    """All of page 1, and its scope; what it links to is empty here."""
    asked = questions.all_of(records)
    places = [Section("Place", [], name) for name in dict.fromkeys(each.see for each in asked)]
    head = [*page_one.blocks(records, asked), page_one.scope(records, None)]
    document = Document("Title", "Kind", places, head=head)
    return re.sub(r"\s+", " ", Page.of(html(document)).text)


def verdict(records: Evidence) -> Callout:
    return page_one.verdict(records, questions.all_of(records))


def altered(kept: Kept, **changes: Any) -> Kept:
    return dataclasses.replace(kept, data=json.loads(json.dumps(kept.data)) | changes)


def at_one_commit(records: Evidence, commit: str) -> Evidence:
    """The same evidence, every record made at one commit by this version."""
    made = {"commit": commit, "dirty": False, "qsbearing": __version__}

    def moved(kept: Kept) -> Kept:
        return altered(kept, provenance={**(kept.provenance or {"date": "2026-01-01"}), **made})

    changes: dict[str, Any] = {}
    for field in dataclasses.fields(records):
        value = getattr(records, field.name)
        if isinstance(value, Kept):
            changes[field.name] = moved(value)
        elif isinstance(value, dict):
            changes[field.name] = {name: moved(each) for name, each in value.items()}
        elif isinstance(value, list):
            changes[field.name] = list(map(moved, value))
    return dataclasses.replace(records, **changes)


def sector_rows(records: Evidence, end: str, quantity: str) -> list[dict[str, Any]]:
    return [
        row
        for row in records.checks["bearing_sector"].data["rows"]
        if row["verdict"] == "finding" and row["reference"]
        if row["case"].endswith(end) and row["quantity"].endswith(quantity)
    ]


def test_page_one_names_the_document_and_the_commit(shipped: Evidence) -> None:
    text = text_of(shipped)
    assert f"QSB-VR-{traceability.listed(kept.version for kept in shipped.all())}" in text
    assert (provenance.commit() or "an installed package")[:12] in text
    assert "Not in the model: vibration, cage forces" in text
    for word in ("Prepared by", "Reviewed by", "Released by", "Scope.", "± means:", "Changes since the last release."):
        assert word in text


def test_page_one_has_questions_with_a_verdict_and_a_place(shipped: Evidence) -> None:
    asked = questions.all_of(shipped)
    assert len(asked) == 12 + len(shipped.random_scenes)
    assert all(each.worst and each.answer and each.see and each.records for each in asked)
    green = {each.text for each in asked if each.verdict.kind == "pass"}
    assert not green & {each.text for each in asked if each.not_for}, "what is not validated has no green verdict"


def test_no_question_adds_populations(shipped: Evidence) -> None:
    """Each campaign is a question of its own, catalogues and other programs are two, and what judges elements is not
    what judges solutions."""
    asked = questions.all_of(shipped)
    records = [kept.name for each in asked for kept in each.records]
    shared = {name for name in records if records.count(name) > 1}
    assert shared == {shipped.checks["bearing_sector"].name}, "its rigid and its free seats are two questions"
    for kept in shipped.random_scenes:
        assert [each.records for each in asked if kept in each.records] == [[kept]]
    for kind in ("C", "B"):
        assert [{kept.data.get("kind") for kept in each.records} for each in asked].count({kind}) == 1


def test_the_worst_row_is_that_nearest_to_its_limit(shipped: Evidence) -> None:
    """Deviation and uncertainty over the tolerance: a small deviation may be nearer than a large one. What counts balls
    is not among them."""
    for name, place in (("half_space_contacts", 2), ("solution_contacts", 3)):
        judged = [row for row in shipped.checks[name].data["rows"] if questions._is_of_elements(row)]  # type: ignore[arg-type]
        shares = [
            (abs(row["deviation_percent"]) + row["uncertainty_percent"]) / row["tolerance_percent"] for row in judged
        ]
        assert f"{100 * max(shares):.0f} % of its limit" in questions.all_of(shipped)[place].worst
    kept = shipped.book["half_loaded_ring"]
    counts = [row for row in kept.data["rows"] if row["unit"] == "balls"]
    assert counts and all(row["deviation_percent"] == row["tolerance_percent"] for row in counts)
    (printed,) = [each for each in questions.all_of(shipped) if kept in each.records]
    assert kept.data["title"] not in printed.answer
    as_shares = altered(kept, rows=[row | {"unit": "1"} for row in kept.data["rows"]])
    spoilt = dataclasses.replace(shipped, book=shipped.book | {"half_loaded_ring": as_shares})
    (printed,) = [each for each in questions.all_of(spoilt) if as_shares in each.records]
    assert kept.data["title"] in printed.answer


def test_page_one_says_how_often_an_uncertainty_held_the_error(shipped: Evidence) -> None:
    """What is left of all cases beside those whose error exceeds it, of which the check allows some."""
    rows = shipped.checks["convergence_order"].data["rows"]
    (row,) = (row for row in rows if row["quantity"].startswith("share whose error exceeds"))
    held, least = map(float, re.findall(r"([\d.]+) %", text_of(shipped).partition("It held the true error")[2])[:2])
    assert held == pytest.approx(100.0 - 100.0 * row["found"], abs=0.05)
    assert least == pytest.approx(100.0 - row["tolerance_percent"])


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


def test_page_one_names_every_known_scene_and_counts_all_that_did_not_converge(shipped: Evidence) -> None:
    text = text_of(shipped)
    lost = {name for kept in shipped.campaigns for name in kept.data["not_converged"]}
    assert lost & set(NOT_CONVERGED)
    for name in lost & set(NOT_CONVERGED):
        assert name in text
        assert NOT_CONVERGED[name] in text
    for one in map(random_scenes.scenes, shipped.random_scenes):
        assert one.not_converged in text
    assert "waive" not in text.lower()


def test_page_one_and_the_readme_count_the_same_random_scenes(shipped: Evidence) -> None:
    """Of single bearings, each envelope by itself."""
    readme = " ".join((ROOT / "README.md").read_text("utf-8").split())
    for one in map(random_scenes.scenes, shipped.campaigns):
        assert f"{one.not_converged.partition(' ')[0]} of {one.count:,} {one.name}" in readme
    assert f"wrong in {len(shipped.random_scenes)} campaigns: 0" in readme
    assert not any(random_scenes.scenes(kept).wrong for kept in shipped.random_scenes)


def test_page_one_counts_how_every_random_scene_ended(shipped: Evidence) -> None:
    """Solved, refused by strength, not converged: none is left out, and none counts as proved that is not."""
    for kept in shipped.random_scenes:
        one = random_scenes.scenes(kept)
        refused = one.proved + one.evidence + one.unproved
        assert one.solved + refused + one.explained + one.named + one.lost == one.count
        assert sum(random_scenes.reasons(kept).values()) == refused
    table = random_scenes.table(shipped.random_scenes, "")
    assert [row[0] for row in table.rows] == [random_scenes.scenes(kept).name for kept in shipped.random_scenes]  # type: ignore[index]


def test_one_row_says_what_the_motion_of_balls_rests_on(shipped: Evidence) -> None:
    """Its counts and deviations follow the records: hypotheses, friction, referee, what is not measured."""

    def row(records: Evidence) -> questions.Question:
        (asked,) = [each for each in questions.all_of(records) if each.text == "What do axes of balls rest on?"]
        return asked

    assert shipped.reference
    cases = shipped.reference.data["cases"]
    turning = [each for each in cases if each["raceway_control"]]
    assert 0 < len(turning) < len(cases)
    controls = len({each["raceway_control"] for each in turning})
    assert f"{controls} hypotheses ({len(turning)} scenes with fifty digits)" in row(shipped).answer
    balances = shipped.reference.data["friction_cases"]
    assert f"or friction ({len(balances)})" in row(shipped).answer
    outer = altered(shipped.reference, cases=[each for each in cases if each["raceway_control"] == "outer"])
    assert "1 hypotheses" in row(dataclasses.replace(shipped, reference=outer)).answer

    free = shipped.checks["free_ball"]
    assumed = [1e6 * each["found"] for each in free.data["rows"] if HYPOTHESIS in each["case"]]
    assert len(assumed) == 4
    (moves,) = {quantity(each["quantity"]) for each in free.data["rows"] if HYPOTHESIS in each["case"]}
    assert f"{moves} by the free ball " in row(shipped).worst, "of what the numbers are"
    assert f"by hypotheses {min(assumed):.3g} to {max(assumed):.3g} µm" in row(shipped).worst
    assert "by friction of 0.03 to 0.1: " in row(shipped).worst
    fails = dataclasses.replace(shipped, checks=shipped.checks | {"free_ball": altered(free, verdict="fail")})
    assert (row(shipped).verdict.kind, row(fails).verdict.kind) == ("finding", "fail")

    measured = [each for kept in shipped.book.values() if kept.data["kind"] == "M" for each in kept.data["rows"]]
    assert f"measured: 0 of {len(measured)} numbers are angles" in row(shipped).answer
    name, kept = next((name, kept) for name, kept in shipped.book.items() if kept.data["kind"] == "M")
    more = altered(kept, rows=[*kept.data["rows"], kept.data["rows"][0] | {"unit": "deg"}])
    now = row(dataclasses.replace(shipped, book=shipped.book | {name: more})).answer
    assert f"measured: 1 of {len(measured) + 1} numbers are angles" in now


def recomputed(**changes: Any) -> Kept:
    record = {
        "campaign": "sets", "count": 100, "wrong": [], "not_converged": ["0/1"],
        "ended": {"converged": 90, "no_equilibrium: open_side": 6, "not_converged": 1, "not_converged: skids": 3},
        "no_equilibrium": {"proofs": 1, "evidence": 2, "not_proved": 3, "without": 0},
        "bar": {"not_converged": 1, "allowed": 1, "basis": "2026-11-28: mounted"},
    }  # fmt: skip
    return Kept("sets", record | changes, "")


def test_a_campaign_counts_by_strength() -> None:
    one = random_scenes.scenes(recomputed())
    assert (one.proved, one.evidence, one.unproved) == (1, 2, 3)
    assert (one.explained, one.lost, one.allowed, one.is_met) == (3, 1, 1, True)
    assert random_scenes.scenes(recomputed(no_equilibrium={})).unproved == 6, "what has no certificate is not proved"
    assert random_scenes.scenes(recomputed(not_converged=["0/1", "0/2"])).is_met is False
    assert random_scenes.scenes(recomputed(wrong=["0/3: closure"])).is_met is False


def test_a_campaign_without_a_limit_on_record_meets_none() -> None:
    """As those of 0.2.0: neither met nor missed, and page 1 and its section say so."""
    kept = recomputed()
    del kept.data["bar"]
    assert random_scenes.scenes(kept).is_met is None
    (row,) = random_scenes.table([kept], "").rows
    assert row[-3:] == ["not recorded", "not recorded", Badge(NO_LIMIT, "missing")]
    said = robustness._campaigns([kept])[0]
    assert isinstance(said, Callout) and said.text.endswith("No limit is recorded of: sets.")


def test_only_named_realistic_scenes_may_not_converge(shipped: Evidence) -> None:
    (kept,) = [kept for kept in shipped.campaigns if kept.data["envelope"] == "realistic"]
    assert random_scenes.scenes(kept).is_met
    more = [*kept.data["not_converged"], "realistic/1/0/1"]
    counted = kept.data["classes"] | {"not_converged": len(more)}
    assert random_scenes.scenes(altered(kept, not_converged=more, classes=counted)).is_met is False


def counts(name: str, **changes: Any) -> Kept:
    record = {
        "tests": name, "command": "python -m pytest", "passed": 9000, "skipped": {"needs ROSS": 4},
        "expected_to_fail": {}, "failed": {}, "seconds": 61.2,
    }  # fmt: skip
    return Kept(f"gate/release/{name}.json", record | changes, "")


def test_page_one_counts_the_tests(shipped: Evidence) -> None:
    assert "Not on record: heavy tests, tests" in text_of(dataclasses.replace(shipped, tests=[]))
    both = [counts("tests"), counts("heavy tests", passed=70, skipped={}, failed={"a": "b"})]
    text = text_of(dataclasses.replace(shipped, tests=both))
    assert "All but the heavy ones: 9,000 passed, 4 skipped (4: needs ROSS), 0 failed, 61 s" in text
    assert "The heavy ones: 70 passed, 1 failed, 61 s" in text


def test_page_one_counts_the_origin_of_records(shipped: Evidence) -> None:
    """A set of several commits, or with one that is not known, is never called a release."""
    text, count = text_of(shipped), len(list(shipped.all()))
    here = [tuple(map(int, pair)) for pair in re.findall(r"(\d+) of (\d+)", text.partition("At the commit tested:")[2])]
    others, unknown = map(int, re.findall(r"(\d+) records are of other commits, (\d+) of none", text)[0])
    assert sum(total for _, total in here[:3]) == count == sum(n for n, _ in here[:3]) + others + unknown
    one = at_one_commit(shipped, "a" * 40)
    of_two = dataclasses.replace(one, reference=at_one_commit(shipped, "b" * 40).reference)
    assert "not a release" in page_one.level(of_two)
    assert "not a release" not in page_one.level(one)
    assert traceability.tally(one.all(), traceability.tested(one)) == (count, 0, 0)
    spoiled = dataclasses.replace(one, reference=altered(one.reference, provenance=None))  # type: ignore[arg-type]
    assert "not a release" in page_one.level(spoiled)
    assert "not a release" in page_one.level(at_one_commit(shipped, "")), "none of them is known"


def test_page_one_verdict_follows_the_records(shipped: Evidence) -> None:
    """May be used where all is met; what fails is said, and then it may not."""
    said = verdict(shipped)
    assert (said.status == "pass") == ("not a release" not in said.text) and said.status != "fail"
    assert "May be used for" in said.text
    assert "Not validated for" in said.text
    lost = [altered(kept, not_converged=[]) for kept in shipped.campaigns]  # none of them is named
    of_lost = dataclasses.replace(shipped, campaigns=lost)
    (missed,) = [each for each in questions.all_of(of_lost) if each.verdict.kind == "fail"]
    assert verdict(of_lost).status == "fail"
    assert missed.missed in verdict(of_lost).text
    kept = shipped.checks["patch_test"]
    failing = dataclasses.replace(shipped, checks=shipped.checks | {"patch_test": altered(kept, verdict="fail")})
    assert "Fail: patch_test" in verdict(failing).text
    assert "May be used" not in verdict(failing).text
    assert questions.all_of(failing)[2].verdict.kind == "fail"


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


COMMIT = "a" * 40


@pytest.fixture
def whole(shipped: Evidence, monkeypatch: pytest.MonkeyPatch) -> Evidence:
    """Every record of one commit, which differs from that checked out by records alone, after a gate that passed."""
    monkeypatch.setattr(kept_files, "others", lambda tested: [])
    monkeypatch.setattr(provenance, "is_dirty", lambda: False)
    records = at_one_commit(shipped, COMMIT)
    assert records.gate is not None
    tests = list(map(altered, (counts("tests"), counts("heavy tests"))))
    gate = altered(records.gate, verdicts={"clean tree": [], "benchmarks": []})
    return at_one_commit(dataclasses.replace(records, gate=gate, tests=tests), COMMIT)


def test_page_one_calls_records_of_one_commit_a_release(whole: Evidence) -> None:
    said = verdict(whole)
    assert said.text.startswith(f"**{__version__}, one commit, all records of it. Usable within its limits.**")
    assert said.status == "pass"
    assert f"of this report{COMMIT[:12]}, " in text_of(whole)


@pytest.mark.parametrize(
    ("spoilt", "said"),
    [
        ("code", "the code is not that of the records: a.py changed since aaaaaaaaaaaa"),
        ("dirty", "the source has changes that are not committed"),
        ("version", "the records are of version 0.0.1"),
        ("gate", "the release run failed at: benchmarks"),
        ("running", "no release run that ended is on record"),
        ("tests", "not all tests were run by the release run"),
        ("one record", "not of aaaaaaaaaaaa: tests/relations.json"),
    ],
)
def test_page_one_names_what_makes_it_no_release(whole: Evidence, spoilt: str, said: str, monkeypatch: Any) -> None:
    assert whole.gate is not None
    assert whole.relations is not None
    records = whole
    if spoilt == "code":
        monkeypatch.setattr(kept_files, "others", lambda tested: ["a.py"])
    elif spoilt == "dirty":
        monkeypatch.setattr(provenance, "is_dirty", lambda: True)
    elif spoilt == "version":
        made = whole.relations.provenance | {"qsbearing": "0.0.1"}
        records = dataclasses.replace(whole, relations=altered(whole.relations, provenance=made))
    elif spoilt == "gate":
        failed = altered(whole.gate, verdicts={"clean tree": [], "benchmarks": ["slow"]})
        records = dataclasses.replace(whole, gate=failed)
    elif spoilt == "tests":
        records = dataclasses.replace(whole, tests=whole.tests[:1])
    elif spoilt == "running":
        kept = {key: value for key, value in whole.gate.data.items() if key != "verdicts"}
        records = dataclasses.replace(whole, gate=dataclasses.replace(whole.gate, data=kept))
    else:
        made = whole.relations.provenance | {"commit": "b" * 40}
        records = dataclasses.replace(whole, relations=altered(whole.relations, provenance=made))
    text = verdict(records).text
    assert said in text
    assert "not a release" in text
    assert verdict(records).status == "warning"


def test_a_span_of_one_number_is_that_number() -> None:
    assert questions.span([17800.0, 17800]) == "17,800"
    assert questions.span([0.56, 0.51]) == "0.51 to 0.56"
