"""The validation report: its numbers are the records', what is missing or fails is said, both forms are sound."""

from __future__ import annotations

import csv
import dataclasses
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from fem_check.cli import cli
from fem_check.release.steps import RECOMPUTED
from fem_check.report import evidence, files, validation
from fem_check.report.evidence import Evidence
from fem_check.report.figures import drawn as figures
from fem_check.report.rows import as_read, quantity, table, worst
from fem_check.report.sections import agreement, previous, tolerances
from fem_check.rows.agreement import AgreementRow, MeshLevel
from fem_check.running import records_store, suite
from qsbearing.documents.html import html
from qsbearing.documents.model import Document, Table
from qsbearing.documents.pdf import pdf
from tests.documents.browser import Browser, installed, layout_faults
from tests.documents.page import Page
from tests.documents.test_pdf import fonts
from tests.drawing import drawing

ROOT = Path(__file__).parents[2]
PAGES = 22
"""At most, on paper."""
SCREENS = 60
"""At most, of 1280 x 900."""
SMALL = ("patch_test", "manufactured_solution", "convergence_order")


@pytest.fixture(scope="module")
def shipped() -> Document:
    return validation.document(evidence.read())


@pytest.fixture(scope="module")
def page(shipped: Document) -> str:
    return html(shipped)


@pytest.fixture(scope="module")
def read(page: str) -> Page:
    return Page.of(page)


@pytest.fixture
def records(tmp_path: Path) -> Path:
    """A folder with a few records."""
    folder = tmp_path / "records"
    (folder / "quick").mkdir(parents=True)
    for name in SMALL:
        shutil.copy(records_store.FOLDER / "quick" / f"{name}.json", folder / "quick")
    return folder


def without_the_rest(whole: Evidence) -> Evidence:
    """Only the checks, to be quick."""
    return dataclasses.replace(whole, book={}, cost=None, model_cost=None, campaigns=[], hard_cases=None)


def change(folder: Path, name: str, spoil: Callable[[dict[str, Any]], object]) -> None:
    path = folder / "quick" / f"{name}.json"
    entry = json.loads(path.read_text())
    spoil(entry)
    path.write_text(json.dumps(entry))


def test_the_page_is_sound(read: Page) -> None:
    assert read.faults == []


@pytest.fixture(scope="module")
def drawn_whole() -> Document:
    """With its pictures, which the release gate draws too, at each level."""
    with drawing():
        return validation.document(evidence.read())


@pytest.mark.heavy
@pytest.mark.skipif(installed() is None, reason="no Chromium is installed")
def test_the_page_with_its_pictures_is_sound_and_short(drawn_whole: Document, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    path.write_text(html(drawn_whole), encoding="utf-8")
    assert Page.of(path.read_text(encoding="utf-8")).faults == []
    with Browser() as browser:
        browser.open(path, width=1280)
        assert browser.value("document.documentElement.scrollHeight") <= SCREENS * 900
        assert layout_faults(browser, path) == []


def test_every_record_is_named_with_its_command(read: Page) -> None:
    for kept in evidence.read().all():
        assert kept.name.removeprefix("fem_check/records/") in read.text
        assert re.sub("^(fem-check book) .*", r"\1", kept.command) in read.text


@pytest.mark.heavy
def test_the_report_is_not_long_on_paper(drawn_whole: Document) -> None:
    pypdf = pytest.importorskip("pypdf")
    assert len(pypdf.PdfReader(BytesIO(pdf(validation.for_paper(drawn_whole), strict=True))).pages) <= PAGES


def test_the_pdf_holds_its_fonts_and_says_the_verdict(shipped: Document) -> None:
    pypdf = pytest.importorskip("pypdf")
    reader = pypdf.PdfReader(BytesIO(pdf(validation.for_paper(shipped), strict=True)))
    held = fonts(reader)
    assert held
    assert all(held.values())
    first = re.sub(r"\s", "", reader.pages[0].extract_text())
    assert "Validationreport" in first or "VALIDATIONREPORT" in first
    assert "Releasedby" in first, "page 1 ends with who releases it"
    assert re.search(r"Equationssolved.*p\.\d+", first), "a question names its page"
    second = reader.pages[1].extract_text()
    assert agreement.QUESTION in second and "5,000 N at 42.97°" in second, "page 2 is the agreement, all of it"
    assert "Contents" in reader.pages[2].extract_text()


def test_page_one_of_a_release_fits_on_paper() -> None:
    """With all campaigns, and the tests counted with why some are skipped."""
    pypdf = pytest.importorskip("pypdf")
    whole = evidence.read()
    (one,) = (kept for kept in whole.recomputed if kept.data["campaign"] == "sets")
    all_of = [dataclasses.replace(one, data=one.data | {"campaign": name}) for name in RECOMPUTED[MeshLevel.RELEASE]]
    counted = {"passed": 8600, "expected_to_fail": {}, "failed": {}, "seconds": 600.0}
    counted |= {"skipped": {"needs ROSS: pip install 'qsbearing[ross]'": 12, "no Chromium is installed": 1}}
    tests = [
        evidence.Kept(name, counted | {"tests": name, "command": f"python -m pytest -n auto -m {name}"}, "")
        for name in suite.COMMANDS
    ]
    document = validation.document(dataclasses.replace(whole, recomputed=all_of, tests=tests))
    reader = pypdf.PdfReader(BytesIO(pdf(validation.for_paper(document), strict=True)))
    assert "Releasedby" in re.sub(r"\s", "", reader.pages[0].extract_text())


def test_rows_for_other_programs_are_those_of_the_records(tmp_path: Path) -> None:
    """As JSON and as CSV, with reason and source; one count of them."""
    whole = evidence.read()
    told = files.as_data(whole)
    kept = [row for each in (whole.checks, whole.book) for k in each.values() for row in k.data["rows"]]
    assert [{key: value for key, value in row.items() if key != "check"} for row in told["rows"]] == kept
    table = list(csv.DictReader(StringIO(files.csv_of(told["rows"]).decode())))
    assert [row["why_tolerance"] for row in table] == [row["why_tolerance"] for row in kept]
    assert float(table[0]["found"]) == kept[0]["found"]


def row(name: str, value: float, tolerance: float | None, case: str = "case", **others: Any) -> dict[str, Any]:
    return AgreementRow(case, name, "1", 1.0, "a reference", value, 0.01, tolerance, "a reason", **others).as_dict()


def by_heading(of: Table) -> list[dict[str, Any]]:
    lines: Any = of.rows
    return [dict(zip(of.headings, line, strict=True)) for line in lines]


def test_a_card_has_the_worst_row_of_each_quantity_failures_first() -> None:
    rows = [row(name, 1.0 + 1e-4 * n, 5.0, f"case {n}") for name in "abcdef" for n in range(3)]
    rows += [row("g", 1.01, 0.5), row("h", 1.2, None), row("h", 0.7, None)]
    counted = worst(rows)
    assert [(count, each["quantity"]) for count, each in counted[:2]] == [(1, "g"), (2, "h")]
    assert counted[1][1]["found"] == 0.7
    assert len(counted) == 5
    assert {each["case"] for _, each in counted[2:]} == {"case 2"}
    shown = table(counted).rows[0]
    assert shown[:4] == ["g", "1", "+1.000 ± 0.010 %", "0.5 %"]
    whole, worst_rows = by_heading(table(counted, is_whole=True)), by_heading(table(counted))
    for each in worst_rows:
        del each["worst of"]
    assert whole == worst_rows, "of all rows none is the worst of several"


def test_a_refused_row_is_compared_with_the_earlier_release() -> None:
    """It has no number: nothing moved where it was refused before too, else everything."""
    refused = row("a", 1.0, None) | {"found": None, "deviation_percent": None, "verdict": "refused"}
    assert previous._change(refused, refused) == 0.0
    assert previous._change(row("a", 1.0, None), refused) == float("inf")
    assert previous._change(refused, row("a", 1.0, None)) == float("inf")


def test_an_angle_is_no_per_cent() -> None:
    """Its deviation and its limit are degrees, and it is rounded to its uncertainty."""
    angle = row("inner angle", 40.4321, 0.25) | {"unit": "deg", "reference": 40.0, "deviation_percent": 1.08025}
    assert table([(1, angle)]).rows[0][2:4] == ["+0.4321 ± 0.0040°", "0.1°"]


def test_a_name_keeps_the_indices_of_its_symbols() -> None:
    assert quantity("inner max_shear_depth") == "inner depth of τmax"
    assert quantity("F_a/(F_r tan α), poisson_ratio") == "F_a/(F_r tan α), poisson ratio"


def test_thousands_are_read_in_one_style() -> None:
    assert as_read("Fa = 44500 N, 17 800 N, 500000 scenes, 2000 N") == "Fa = 44,500 N, 17,800 N, 500,000 scenes, 2000 N"
    assert as_read("catalogue 4000 0813 EN, 0.12345 N") == "catalogue 4000 0813 EN, 0.12345 N"


@pytest.mark.parametrize("level", ["release", "book"])
def test_records_write_as_they_are_read(level: str) -> None:
    """Units and powers by their signs, no marks of code: the report takes no text apart for them."""
    said = [
        text for file in (records_store.FOLDER / level).glob("*.json") for text in texts(json.loads(file.read_text()))
    ]
    assert len(said) > 100
    for text in said:
        assert re.search(r"\d (um|deg)\b|`|material\.[a-z]|\^[23]|\de[+-]?0\d", text) is None, text


def texts(record: Any) -> Iterator[str]:
    """Of a record's rows, its question and its notes."""
    names = ("case", "quantity", "worst_at", "why_tolerance", "question", "reference", "tolerance", "notes")
    for of in (record, *record["rows"]):
        for each in (of.get(name) for name in names):
            yield from [each] if isinstance(each, str) else each if isinstance(each, list) else ()


def test_the_same_records_are_the_same_report(drawn: None) -> None:
    """Pictures too, but for those of the book and of costs."""
    few = without_the_rest(evidence.read())
    few = dataclasses.replace(few, checks={name: few.checks[name] for name in SMALL})
    first, second = (html(validation.document(few)) for _ in range(2))
    assert first == second


@pytest.mark.parametrize("path", sorted((records_store.FOLDER / "quick").glob("*.json")), ids=lambda path: path.stem)
def test_pictures_of_the_quick_level_draw(path: Path, drawn: None) -> None:
    """Whose records hold less, as a single load."""
    assert all(b"<svg" in each.data for each in figures.one(json.loads(path.read_text(encoding="utf-8"))))


def test_what_is_missing_is_said(records: Path) -> None:
    (records / "quick" / "patch_test.json").unlink()
    change(records, "convergence_order", lambda entry: entry.pop("provenance"))
    text = Page.of(html(validation.document(without_the_rest(evidence.read(records))))).text
    assert "Check patch_test is not on record here" in text
    assert "Not on record: patch_test, half_space_contacts, load_power_law" in text
    assert "the validation book" in text
    assert "commit, date and machine not recorded" in text


def test_a_tolerance_that_little_could_miss_is_counted() -> None:
    row = {"tolerance_percent": 1.0, "deviation_percent": 0.5, "uncertainty_percent": None}
    wide, finding = row | {"deviation_percent": -0.05}, row | {"tolerance_percent": None}
    exact = row | {"tolerance_percent": 1e-7, "deviation_percent": 1e-12}
    told = tolerances._line("patch_test", [row, wide, exact])[1:]
    assert told == ["3", "1", "2", "11", "11", "2", "1"]
    assert tolerances._judged([row, finding]) == [row]


def test_rows_with_wide_tolerances_are_listed_with_their_reasons() -> None:
    """All of them that compare no two evaluations at full precision, and no more."""
    _, of_checks, wide = tolerances.section(evidence.read()).blocks
    assert sum(int(line[1]) for line in wide.rows) == sum(int(line[-1]) for line in of_checks.rows) > 0
    assert all(float(line[3]) >= tolerances.WIDE and line[4] for line in wide.rows)


def test_a_failing_row_is_the_verdict(records: Path) -> None:
    def spoil(entry: dict[str, Any]) -> None:
        entry["verdict"] = entry["rows"][0]["verdict"] = "fail"

    change(records, "patch_test", spoil)
    document = validation.document(without_the_rest(evidence.read(records)))
    assert "Fail: patch_test" in Page.of(html(document)).text
    assert "May be used" not in Page.of(html(document)).text


def test_a_claim_that_the_records_contradict_is_the_verdict(records: Path) -> None:
    whole = evidence.read(records)
    missed = json.loads(json.dumps(whole.campaigns[0].data))
    missed |= {"bar": missed["bar"] | {"allowed": missed["classes"]["not_converged"] - 1}, "not_converged": []}
    campaigns = [dataclasses.replace(whole.campaigns[0], data=missed)]
    text = Page.of(html(validation.document(dataclasses.replace(without_the_rest(whole), campaigns=campaigns)))).text
    lost = missed["classes"]["not_converged"]
    assert f"Missed: {lost} of {missed['count']:,} {missed['envelope']} random scenes did not converge" in text


def test_changes_since_other_records_are_told(records: Path, tmp_path: Path) -> None:
    before = tmp_path / "before"
    shutil.copytree(records, before)
    (before / "quick" / "convergence_order.json").unlink()

    def digit(entry: dict[str, Any]) -> None:
        entry["rows"][0]["found"] *= 1.001

    now = without_the_rest(evidence.read(records))
    same = validation.document(now, without_the_rest(evidence.read(before)))
    assert "0 of them found otherwise" in Page.of(html(same)).text
    change(records, "manufactured_solution", digit)
    text = Page.of(
        html(validation.document(without_the_rest(evidence.read(records)), evidence.read(before, alone=True)))
    ).text
    assert "1 of them found otherwise" in text
    assert re.search(r"New:\s+convergence_order, quick: 6 rows", text)
    assert evidence.read(before).book
    assert not evidence.read(before, alone=True).book


def test_commits_that_differ_are_said(records: Path) -> None:
    at = {"commit": "a" * 40, "dirty": False, "date": "2026-01-01T00:00:00Z", "qsbearing": "0.1.0", "packages": {}}
    at["machine"] = {"processor": "x", "cores": 2, "memory_GB": 8.0, "system": "Linux 6", "python": "3.11.7"}
    for name, commit in zip(SMALL, ("a", "b", "a"), strict=True):
        change(records, name, lambda entry, commit=commit: entry.update(provenance=at | {"commit": commit * 40}))
    few = without_the_rest(evidence.read(records))
    few = dataclasses.replace(
        few,
        reference=None,
        relations=None,
        errata=None,
        auto_accuracy=None,
        scipy=None,
        mutations=None,
        recomputed=[],
    )
    text = Page.of(html(validation.document(few))).text
    assert "the records come from 2 commits" in text
    assert "a" * 12 in text
    assert "b" * 12 in text


WITHOUT = ("skfem", "meshio", "gmsh", "rslab", "pandas", "xarray", "h5py", "h5netcdf", "distributed")
"""What `pip install qsbearing[report]` does not bring."""
COMMANDS = f"""
import json, sys
sys.modules |= dict.fromkeys({WITHOUT})
from click.testing import CliRunner
from fem_check.cli import cli
from tests.drawing import blank
with blank():
    found = [CliRunner().invoke(cli, each.split()) for each in sys.argv[1:]]
print(json.dumps([(each.exit_code, each.stdout, each.stderr) for each in found]))
"""


def test_two_commands_make_it_the_second_from_records_alone(tmp_path: Path) -> None:
    """The report is made without the packages that make records; a check is refused, and says what it needs."""
    level = "quick"
    shipped = {path: path.stat().st_mtime_ns for path in records_store.FOLDER.rglob("*")}
    run = CliRunner().invoke(cli, ["run", "patch_test", "--level", level, "--out", str(tmp_path / "x")])
    assert run.exit_code == 0
    refused = "run", "contact --scene b218 --race inner --load-N 1000", "cost", "release", "book"
    asked = "report --records x --out report", "list", *refused
    done = subprocess.run(
        [sys.executable, "-c", COMMANDS, *asked],
        capture_output=True,
        text=True,
        check=True,
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
    )
    (code, _, said), listed, *others = json.loads(done.stdout)
    assert code == 0, said
    assert "patch_test" in listed[1]
    assert len(others) == len(refused)
    for code, _, said in others:
        assert code == 2
        assert "skfem" in said
        assert "pip install" in said
        assert "Traceback" not in said
    names = sorted(path.name for path in (tmp_path / "report").iterdir())
    assert names == [f"validation_report.{form}" for form in ("csv", "html", "json", "pdf")]
    text = Page.of((tmp_path / "report" / names[1]).read_text(encoding="utf-8")).text
    assert f"fem-check run patch_test --level {level}" in text
    assert {path: path.stat().st_mtime_ns for path in records_store.FOLDER.rglob("*")} == shipped


def test_the_records_that_the_wheel_leaves_out_are_none_of_the_report(tmp_path: Path) -> None:
    """As an installed package has them: without the quick level's."""
    shutil.copytree(records_store.FOLDER, tmp_path / "records", ignore=shutil.ignore_patterns("quick"))
    carried, whole = evidence.read(tmp_path / "records"), evidence.read()
    for shipped, expected in ((carried.checks, whole.checks), (carried.book, whole.book)):
        assert {name: kept.data for name, kept in shipped.items()} == {
            name: kept.data for name, kept in expected.items()
        }


def test_a_folder_without_records_is_refused(tmp_path: Path) -> None:
    done = CliRunner().invoke(cli, ["report", "--records", str(tmp_path), "--out", str(tmp_path / "report")])
    assert done.exit_code == 2
    assert "no records in" in done.stderr
    assert not (tmp_path / "report").exists()


@pytest.mark.skipif(installed() is None, reason="no Chromium is installed")
def test_no_verdict_is_cut_off_on_a_wide_screen(page: str, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    path.write_text(page, encoding="utf-8")
    cut = (
        "[...document.querySelectorAll('.table')].filter(t => [...t.querySelectorAll('.badge')].some("
        "b => b.getBoundingClientRect().right > t.getBoundingClientRect().right + 1)).map(t => t.ariaLabel)"
    )
    with Browser() as browser:
        browser.open(path, width=1280)
        assert browser.value("document.querySelectorAll('.table .badge').length") > 100
        assert browser.value(cut) == []
        wider = (
            "[...document.querySelectorAll('.table')].filter(t => t.scrollWidth > t.clientWidth).map(t => t.ariaLabel)"
        )
        assert browser.value(wider) == []
        browser.open(path, width=768)
        assert browser.value(f"{wider}.filter(name => name.startsWith('What may'))") == []


def test_a_release_run_is_shown_and_its_records_count(records: Path) -> None:
    """The layout that the release gate leaves: its own records go before those of the repository."""
    gate, beside = records / "gate" / "quick", records / "repository" / "tests" / "verification" / "hard_cases"
    (gate / "campaign" / "wild").mkdir(parents=True)
    beside.mkdir(parents=True)
    kept = evidence.read(records)
    (wild,) = [each.data for each in kept.campaigns if each.data["envelope"] == "wild"]
    campaign = wild | {"count": 4321}
    (gate / "campaign" / "wild" / "summary.json").write_text(json.dumps(campaign))
    assert kept.hard_cases is not None
    (beside / "table.json").write_text(json.dumps(kept.hard_cases.data | {"made": "here"}))
    steps = {"check patch_test": {"seconds": 1.5, "error": None}, "benchmarks": {"seconds": 2.0, "error": "no time"}}
    (gate / "steps.json").write_text(json.dumps({"commit": "c" * 40, "level": "quick", "steps": steps}))
    of_gate = dataclasses.replace(evidence.read(records), book={}, cost=None, model_cost=None)
    page = Page.of(html(validation.document(of_gate)))
    assert page.faults == []
    assert "4,321" in page.text
    assert of_gate.hard_cases is not None
    assert of_gate.hard_cases.data["made"] == "here"
    assert "benchmarks: no time" in page.text
    assert "1 of 2 steps made their records" in page.text


def test_records_without_a_commit_are_named(records: Path) -> None:
    """Beside others that state theirs."""
    change(records, "patch_test", lambda entry: entry.pop("provenance", None))
    text = Page.of(html(validation.document(without_the_rest(evidence.read(records))))).text
    assert re.search(r"and \d+ of \d+ do not name theirs", text)
    assert "quick/patch_test.json" in text.split("do not name their commit")[1][:600]


def test_what_is_no_measurement_is_not_called_validation(read: Page) -> None:
    assert "Validation of Hertz" not in read.text
    assert "Limits of Hertz and of rigid rings, by finite elements" in read.text
    assert "Counter-example: agreement is not expected." in read.text


def test_commands_that_need_a_checkout_are_said_so(read: Page) -> None:
    text = read.text[read.text.index("nothing is recomputed") : read.text.index("Last release run")]
    before, _, after = text.partition("In a checkout of the repository")
    assert "python -m tests.verification.reference.table" in after
    assert "fem-check book" in before
    assert "fem-check book" not in after
    assert text.count("fem-check book") == 1, "one command makes all published cases"
