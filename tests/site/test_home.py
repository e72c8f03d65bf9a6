"""The first page of the site: its result is that of a run, its verdicts are those of the records."""

from __future__ import annotations

import dataclasses
import re
from pathlib import Path

import pytest

import qsbearing as qs
from fem_check.report import evidence, questions
from qsbearing.site.home import home, run, trust
from tests.cli.command import call
from tests.drawing import drawing

pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """Its Markdown, and the folder of its picture."""
    folder = tmp_path_factory.mktemp("home")
    with drawing():
        return home(folder), folder


def test_its_result_is_that_of_a_run(page: tuple[str, Path]) -> None:
    text, folder = page
    solution = qs.solve(qs.load_scene("b218"))
    inner, outer = (contacts.angle[0] / qs.deg for contacts in (solution.inner, solution.outer))
    assert f"| displacement of the inner ring | axial {solution.displacement[0] / qs.um:.2f} µm |" in text
    assert f"| contact angles | inner {inner:.1f} deg, outer {outer:.1f} deg |" in text
    drawn = (folder / "home.svg").read_text(encoding="utf-8")  # letters as outlines, with their text as a comment
    assert f"= {inner:.1f}°" in drawn and f"= {outer:.1f}°" in drawn
    assert "<!--" not in text
    rows = re.findall(r"^\| (.+?) \| (.+?) \|$", text.partition("| quantity | result |")[2].partition("\n\n")[0], re.M)
    printed = " ".join(call("run", "b218").stdout.split())
    assert len(rows) >= 4 and all(f"{name} {values}" in printed for name, values in rows)


def test_its_picture_is_the_same_bytes_every_time(page: tuple[str, Path], drawn: None, tmp_path: Path) -> None:
    """So that the site of one version is."""
    _, folder = page
    run(tmp_path)
    assert (tmp_path / "home.svg").read_bytes() == (folder / "home.svg").read_bytes()


def test_every_question_of_the_records_has_its_verdict(page: tuple[str, Path]) -> None:
    """None is left out, least of all one that is not met."""
    text, _ = page
    records = evidence.read()
    asked = [each for each in questions.all_of(records) if not each.text.startswith("Random scenes")]
    rows = re.findall(r"^\| \*\*(.*?)\*\*.*>(.*?)</span> \|$", text, re.MULTILINE)
    assert rows == [(each.text, each.verdict.word) for each in asked]
    assert len(rows) >= 12
    for kept in records.random_scenes:
        assert f"of {kept.data['count']:,} " in text


def test_what_it_names_as_limits_is_there(page: tuple[str, Path]) -> None:
    text, _ = page
    for words in ("May be used for", "Not validated for", "Random scenes", "Not modelled"):
        assert f"**{words}" in text


def test_nothing_may_be_used_where_a_check_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    """As on page 1 of the validation report."""
    records = evidence.read()
    name, kept = next(iter(records.checks.items()))
    failing = dataclasses.replace(kept, data=kept.data | {"verdict": "fail"})
    spoilt = dataclasses.replace(records, checks=records.checks | {name: failing})
    monkeypatch.setattr(evidence, "read", lambda: spoilt)
    assert "May be used for" not in trust()
