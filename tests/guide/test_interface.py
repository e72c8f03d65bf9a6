"""The names that users rely on stay: those kept are all there, and the page of the guide lists them."""

from __future__ import annotations

import tomllib

import pytest
from packaging.requirements import Requirement

from fem_check.release import command
from qsbearing.cli import ended, output
from tests.guide import interface
from tests.guide.pages import GUIDE, ROOT

PAGE = (GUIDE / "interface.md").read_text(encoding="utf-8")


def _section(heading: str) -> str:
    return PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]


@pytest.fixture(scope="module")
def now() -> dict[str, interface.Names]:
    return interface.found()


def test_no_name_that_stays_is_dropped(now: dict[str, interface.Names]) -> None:
    assert interface.dropped(interface.kept(), now) == []


def test_a_dropped_name_is_named() -> None:
    before = {"json": {"run --json": ["status", "version"], "balls": ["azimuth_deg"]}}
    now = {"json": {"run --json": ["status"]}}
    assert interface.dropped(before, now) == ["json: run --json: version", "json: balls: azimuth_deg"]
    assert interface.with_new(before, now)["json"]["run --json"] == ["status", "version"]


def test_the_exit_codes_of_the_page_are_those_of_the_code() -> None:
    lines = _section("Exit codes").splitlines()
    told = {int(code) for line in lines if line[2:3].isdigit() for code in line.split("|")[1].split(",")}
    ends = {output.SOLVED, output.UNSOLVED, output.BAD_INPUT, output.NOT_MET, command.FAILED}
    ends |= {ended.DEFECT, ended.INTERRUPTED, 128 + 15}
    assert told == ends


def test_the_versions_of_python_are_those_of_the_page() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    versions = [text.rpartition(" ")[2] for text in project["classifiers"] if "Python :: 3." in text]
    assert project["requires-python"] == f">={versions[0]}"
    page = _section("Versions of Python")
    assert f"\n{versions[0]} or newer. All extras install on {versions[0]} to {versions[-1]}." in page
    told = [line.split("|")[1].strip() for line in page.splitlines() if line.startswith("| 3.")]
    assert told[: len(versions)] == versions
    for text in (ROOT / "README.md", ROOT / ".github" / "CONTRIBUTING.md"):
        assert f"Python {versions[0]} to {versions[-1]}" in text.read_text(encoding="utf-8"), text


def test_every_package_of_an_extra_has_its_licence_on_the_page() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lines = [line.split("|")[1:4] for line in PAGE.partition("## Extras")[2].splitlines() if line.startswith("| ")]
    told = {extra.strip(" `"): packages for names, _, packages in lines for extra in names.split(",")}
    for extra, asked in ({"": project["dependencies"]} | project["optional-dependencies"]).items():
        for each in map(Requirement, asked) if extra != "dev" else ():
            names = [f"`{name}`" for name in each.extras] or [each.name]
            assert all(name in told[extra] for name in names), (extra, each.name)
    assert "gmsh (GPL" in told["fem"]
