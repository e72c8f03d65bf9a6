"""The names that users rely on stay: those kept are all there, and the page of the guide lists them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from fem_check.release import command
from qsbearing.cli import ended, output
from tests.guide import interface

PAGE = (Path(interface.qs.__file__).parent / "guide" / "interface.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def now() -> dict[str, interface.Names]:
    return interface.found()


def test_no_name_that_stays_is_dropped(now: dict[str, interface.Names]) -> None:
    assert interface.dropped(interface.kept(), now) == []


def test_new_names_are_kept(now: dict[str, interface.Names]) -> None:
    """By `python -m tests.guide.interface`; then `python -m tests.verification.benchmarks.tables` writes the page."""
    assert interface.with_new(interface.kept(), now) == json.loads(interface.KEPT.read_text(encoding="utf-8"))


def test_a_dropped_name_is_named() -> None:
    before = {"json": {"run --json": ["status", "version"], "balls": ["azimuth_deg"]}}
    now = {"json": {"run --json": ["status"]}}
    assert interface.dropped(before, now) == ["json: run --json: version", "json: balls: azimuth_deg"]
    assert interface.with_new(before, now)["json"]["run --json"] == ["status", "version"]


def test_the_exit_codes_of_the_page_are_those_of_the_code() -> None:
    told = {int(code) for line in PAGE.splitlines() if line[2:3].isdigit() for code in line.split("|")[1].split(",")}
    ends = {output.SOLVED, output.UNSOLVED, output.BAD_INPUT, command.FAILED, ended.DEFECT, ended.INTERRUPTED, 128 + 15}
    assert told == ends
