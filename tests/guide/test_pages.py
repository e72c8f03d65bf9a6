"""README and guide: what a page shows, runs."""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from qsbearing.documents import terminal
from qsbearing.documents.model import Table
from tests.documents.names import WIDTHS, broken, shown
from tests.guide.measured import STATED, stated
from tests.guide.mentions import unmentioned
from tests.guide.pages import GUIDE, PAGES, blocks, run_page, sentences
from tests.guide.told_numbers import FROM_ELSEWHERE, told

pytest.importorskip("xarray")
pytest.importorskip("matplotlib")


@pytest.fixture(autouse=True)
def tables_have_whole_names(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every table that a command of the guide prints."""

    def checked(blocks: Any, width: int | None = None) -> str:
        for each in (each for each in blocks if isinstance(each, Table)) if isinstance(blocks, Sequence) else ():
            assert broken(each, *WIDTHS) == set(), each.caption
        return shown(blocks, width)

    monkeypatch.setattr(terminal, "text_of", checked)


ELSEWHERE = {
    "adding_an_effect.md": "tests/model/effects/test_adding_an_effect.py, on a copy of the package",
    "adding_a_reading.md": "tests/readings/test_asked.py, as a module of its own",
    "rotor_dynamics.md": "tests/systems/rotor_dynamics/test_guide_page.py, where ROSS is installed",
}
"""Pages whose blocks another test runs."""
RUN_HERE = [page for page in PAGES if page.name not in ELSEWHERE]


@pytest.mark.parametrize("page", [page for page in RUN_HERE if page.name != "gallery.md"], ids=lambda page: page.stem)
def test_a_page_runs(page: Path, tmp_path: Path) -> None:
    run_page(page, tmp_path, heavy=False)


LONG = [page for page in RUN_HERE if page.name == "gallery.md" or any(block.is_heavy for block in blocks(page))]


@pytest.mark.heavy
@pytest.mark.parametrize("page", LONG, ids=lambda page: page.stem)
def test_a_page_runs_with_its_long_commands(page: Path, tmp_path: Path) -> None:
    run_page(page, tmp_path, heavy=True)


@pytest.mark.parametrize(
    "wrong",
    [
        "```sh\n.venv/bin/qsbearing catalogue no_such_bearing\n```\n",
        "```sh\nqsbearing rum b218\n```\n",
        "```sh\nls\n```\n",
        "Or `qsbearing catalogue no_such_bearing` shows it.\n",
        "```python\nprint(1 + 1)  # -> 3\n```\n",
        "```python\nraise ValueError\n```\n",
        "```sh\nqsbearing catalogue b218\n```\n```text\nball count 15\n```\n",
        "A hypothesis, rings that deflect or expand, and slip:\n```sh\nqsbearing run b218\n```\n"
        "```text\ncontact angles  inner 49.9 deg, outer 31.4 deg\n```\n",
        "Hypotheses, rings that deflect or expand, slip; 1454.7 N on a ball:\n```sh\nqsbearing run b218\n```\n",
        "A bearing:\n```sh\nqsbearing run b218\n```\n",
        "A bearing:\n```python\nimport qsbearing as qs\nqs.solve(qs.load_scene('b218'))._repr_html_()\n```\n",
    ],
    ids=[
        "refused",
        "misspelt",
        "another program",
        "in a sentence",
        "another result",
        "raises",
        "output",
        "last digit of an output",
        "number of a sentence",
        "remarks",
        "shown",
    ],
)
def test_a_page_that_does_not_run_is_found(wrong: str, tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    right = "```sh\nqsbearing catalogue > list.txt\n```\n```python\nprint(1 + 1)  # -> 2\n```\n"
    page.write_text(right, encoding="utf-8")
    run_page(page, tmp_path, heavy=False)
    page.write_text(right + wrong, encoding="utf-8")
    with pytest.raises((AssertionError, ValueError)):
        run_page(page, tmp_path, heavy=False)


@pytest.mark.parametrize("name", FROM_ELSEWHERE)
def test_numbers_from_elsewhere_are_still_told(name: str) -> None:
    told_here = {" ".join(each) for each in told(sentences((GUIDE / name).read_text(encoding="utf-8")))}
    assert set(FROM_ELSEWHERE[name]) - told_here == set()


def test_each_section_of_how_to_runs_on_its_own(tmp_path: Path) -> None:
    """Its imports are in it: it may be the only one that somebody copies."""
    sections = re.split(r"^(?=## )", (GUIDE / "how_to.md").read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
    code = re.compile(r"^```python\n.*?^```\n", flags=re.DOTALL | re.MULTILINE)
    # Others read a file that the page writes before.
    alone = [found for each in sections if (found := "".join(code.findall(each))) and '.toml"' not in found]
    assert len(alone) >= 3
    for number, section in enumerate(alone):
        page = tmp_path / f"{number}.md"
        page.write_text(section, encoding="utf-8")
        run_page(page, tmp_path, heavy=False)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_headings_are_in_order(page: Path) -> None:
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    levels = [len(marks) for marks in re.findall(r"^(#+) ", text, flags=re.MULTILINE)]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(after <= before + 1 for before, after in itertools.pairwise(levels))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_thousands_are_parted_by_commas(page: Path) -> None:
    """In prose: at a space, a line end makes two numbers of one."""
    text = re.sub(r"^```.*?^```$|`[^`]*`", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    assert re.findall(r"\b[0-9]{1,3} [0-9]{3}\b", text) == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_measured_numbers_are_made_from_records_or_stated_with_a_reason(page: Path) -> None:
    """Times, sizes and counts in sentences: what is made from a record stands between its marks."""
    assert stated(page) == set(STATED.get(page.name, {})), "make it from a record, or say in `STATED` why not"


@pytest.mark.parametrize("code", ["preload_lost", "ring_expansion", "centrifugal_force", "friction_beyond"])
def test_a_remark_that_no_text_mentions_is_found(code: str) -> None:
    assert unmentioned("The bearing runs at 10,000 rpm.", {code}) == {code}
    assert unmentioned("Preload is lost; the rings grow; inertia is not included; friction\nbeyond.", {code}) == set()


@pytest.mark.parametrize("page", sorted(GUIDE.glob("*.md")), ids=lambda page: page.stem)
def test_lines_of_code_fit_on_a_page(page: Path) -> None:
    """On a tablet. Commands may be longer: their lines are wrapped."""
    for each in blocks(page):
        if each.language != "sh":
            assert [line for line in each.text.splitlines() if len(line) > 79] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_pictures_have_a_text(page: Path) -> None:
    for text, _ in re.findall(r"!\[(.*?)\]\((.*?)\)", page.read_text(encoding="utf-8"), flags=re.DOTALL):
        assert len(text.split()) >= 3


def test_every_picture_of_the_gallery_is_made_by_a_command_of_its_section() -> None:
    text = (GUIDE / "gallery.md").read_text(encoding="utf-8")
    for section in re.split(r"^(?=## )", text, flags=re.MULTILINE):
        for name in re.findall(r"\]\(gallery/([\w.]+)\)", section):
            assert re.search(rf"--(plot|out) {re.escape(name)}\n", section), name
    shipped = {path.name for path in (GUIDE / "gallery").iterdir()}
    assert shipped == set(re.findall(r"\]\(gallery/([\w.]+)\)", text))


def test_the_index_names_every_page() -> None:
    named = re.findall(r"\]\((\w+)\.md\)", (GUIDE / "index.md").read_text(encoding="utf-8"))
    assert sorted(set(named)) == sorted(page.stem for page in GUIDE.glob("*.md") if page.stem != "index")
