"""What the reference holds, and how the command shows the site; without making it."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli


def test_every_public_name_stands_on_one_page() -> None:
    from qsbearing.site.reference import GROUPS

    named = [name for _, _, names in GROUPS.values() for name in names]
    modules = {"readings", "__version__"}
    assert sorted(named) == sorted(set(qs.__all__) - modules)


def test_results_stand_under_the_names_that_stay() -> None:
    """Those that studies and limits take; of points, places and supports of a shaft the names are the user's."""
    from qsbearing.site.reference import result_pages
    from tests.guide.interface import kept

    told = {name: set(re.findall(r"^\| `(\w+)`", text, re.MULTILINE)) for name, (_, text) in result_pages().items()}
    told["results/row.md"] = {each.removeprefix("row_1_") for each in told["results/row.md"]}
    pages = {
        "of a bearing": told["results/bearing.md"] | told["results/readings.md"],
        "of a row": told["results/row.md"],
        "of a set": told["results/set.md"],
    }
    for group, names in kept()["results"].items():
        without_unit = {
            name for name in names if not any(each == name or each.startswith(f"{name}_") for each in pages[group])
        }
        assert without_unit == set(), group


def test_the_help_of_commands_is_in_paragraphs() -> None:
    """An indent would make code of them; arguments, of which click says nothing, stand in the line of use alone."""
    from qsbearing.site.reference import command_pages

    for _, text in command_pages().values():
        outside = re.sub(r"^```text\n.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
        assert re.findall(r"^[ \t]+\S.*", outside, re.MULTILINE) == []
        assert re.findall(r"^\| `\[.*|.*\|  \|$", outside, re.MULTILINE) == []
        assert len(re.findall(r"\n\nExit codes: ", outside)) >= 5


def test_the_command_writes_it_and_opens_a_section(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As a wheel carries it: copied, and opened where it is."""
    carried = tmp_path / "carried"
    carried.mkdir()
    (carried / "index.html").write_text('<img src="../../guide/section.svg">', encoding="utf-8")
    monkeypatch.setattr(sys.modules["qsbearing.cli.guide"], "_carried", lambda: carried)
    opened: list[str] = []
    monkeypatch.setattr("click.launch", opened.append)
    assert CliRunner().invoke(cli, ["guide", "--html", str(tmp_path / "new")]).exit_code == 0
    assert (tmp_path / "new" / "index.html").read_text(encoding="utf-8") == '<img src="section.svg">'
    assert (tmp_path / "new" / "section.svg").is_file() and (tmp_path / "new" / "gallery" / "speed.svg").is_file()
    assert CliRunner().invoke(cli, ["guide", "limits#hypotheses", "--open"]).exit_code == 0
    assert opened == [(carried / "limits.html").as_uri() + "#hypotheses"]


def test_without_its_engine_the_command_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    import importlib.util

    monkeypatch.setattr(sys.modules["qsbearing.cli.guide"], "_carried", lambda: None)
    seek = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *more: None if name == "mkdocs" else seek(name, *more)
    )
    said = CliRunner().invoke(cli, ["guide", "--open"])
    assert said.exit_code == 2
    assert "mkdocs" in said.stderr and "docs" in said.stderr
