"""The tests as steps of a release: counted with what failed and why some are skipped, run before all records."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from fem_check.release import gate, steps
from fem_check.release.steps import GateFolders, Step
from fem_check.rows.agreement import MeshLevel
from fem_check.running import suite

TESTS = """
import pytest

def test_good():
    pass

@pytest.mark.parametrize("n", [1, 2])
def test_skipped(n):
    pytest.skip("needs a thing")

@pytest.mark.xfail(reason="not yet")
def test_expected():
    assert False

def test_bad():
    assert 1 == 2, "one is not two"

@pytest.fixture
def broken():
    raise ValueError("no fixture")

def test_error(broken):
    pass

@pytest.mark.heavy
def test_heavy():
    pass
"""
LEFT_OUT = 'import pytest\npytest.skip("needs another thing", allow_module_level=True)\n'
SETTINGS = """[pytest]
markers = heavy: long
addopts = -m "not heavy"
"""


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with tests that end in every way."""
    for name, text in (("test_a.py", TESTS), ("test_b.py", LEFT_OUT), ("pytest.ini", SETTINGS)):
        (tmp_path / name).write_text(text)
    monkeypatch.setattr(suite, "COMMANDS", {"tests": (), "heavy tests": ("-m", "heavy")})
    return tmp_path


def test_tests_are_counted_with_what_failed_and_why_some_are_skipped(project: Path) -> None:
    suite.run("tests", project, project / "out" / "tests.json", project / "logs" / "tests.log")
    record = json.loads((project / "out" / "tests.json").read_text())
    assert record["passed"] == 1
    assert record["skipped"] == {"needs a thing": 2, "needs another thing": 1}
    assert record["expected_to_fail"] == {"not yet": 1}
    assert record["failed"].keys() == {"test_a.test_bad", "test_a.test_error"}
    assert "one is not two" in record["failed"]["test_a.test_bad"]
    assert record["command"] == "python -m pytest" and record["seconds"] > 0.0
    assert record["provenance"]["command"] == record["command"]
    faults = suite.wrong(record)
    assert len(faults) == 2 and faults[0].startswith("test_a.test_bad failed: AssertionError: one is not two")
    assert suite.wrong(record | {"failed": {}}) == []
    assert suite.wrong(record | {"failed": {}, "passed": 0}) == ["no test passed"]


def test_heavy_tests_are_those_that_the_others_leave_out(project: Path) -> None:
    suite.run("heavy tests", project, project / "heavy.json", project / "heavy.log")
    assert json.loads((project / "heavy.json").read_text())["passed"] == 1


def test_tests_that_were_not_run_are_no_record(project: Path) -> None:
    with pytest.raises(suite.SuiteError, match="exit code 4"):
        suite.run("tests", project, project / "tests.json", project / "tests.log", ("--no-such-option",))
    assert not (project / "tests.json").exists()


def test_a_release_runs_all_tests_once_before_its_records() -> None:
    """Whole, which leaves the heavy ones out, and the heavy ones; the quick level leaves them to the run of the tests
    that precedes it."""
    first = [step for step in steps.all_steps(MeshLevel.RELEASE) if step.is_first]
    assert [step.command for step in first] == [
        "python -m pytest -n auto",
        "python -m pytest -m heavy -n auto --dist loadfile",
    ]
    assert not any(step.is_first for step in steps.all_steps(MeshLevel.QUICK))


def test_steps_that_are_first_come_before_those_that_share_cores(tmp_path: Path) -> None:
    order = []

    def noted(name: str, *, is_first: bool, is_alone: bool) -> Step:
        return Step(name, "", lambda place: (tmp_path / name).touch(), is_alone=is_alone, is_first=is_first)

    listed = [noted("shared", is_first=False, is_alone=False), noted("tests", is_first=True, is_alone=True)]
    place = GateFolders(tmp_path, MeshLevel.QUICK, tmp_path / "out", "")
    gate.run(listed, place, {}, order.append, workers=2)
    assert order == ["tests: done", "shared: done"]


def test_a_release_makes_the_quick_records_too() -> None:
    """Else those in the repository, with which the quick level is compared, would be of older commits."""
    quick = {record for step in steps.all_steps(MeshLevel.QUICK) for record in step.records}
    release = {record for step in steps.all_steps(MeshLevel.RELEASE) for record in step.records}
    assert quick <= release


def test_quick_steps_of_a_release_run_at_the_quick_level(tmp_path: Path) -> None:
    levels = []
    step = steps._quick_too(Step("check a", "", lambda place: levels.append(place.level)))
    step.run(GateFolders(tmp_path, MeshLevel.RELEASE, tmp_path, ""))
    assert (step.name, levels) == ("check a, quick level", [MeshLevel.QUICK])
