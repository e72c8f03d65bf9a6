"""The guide: every page printed, all pages in one file, links that lead somewhere."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from qsbearing.cli import cli
from qsbearing.documents.guide import FOLDER, topics


def call(*arguments: str) -> Result:
    return CliRunner().invoke(cli, ["guide", *arguments])


def test_topics_are_the_pages() -> None:
    said = call().output
    for path in FOLDER.glob("*.md"):
        assert path.stem in said
        title = re.search("^# (.*)", path.read_text(encoding="utf-8"), re.MULTILINE)
        assert title is not None
        assert title.group(1).replace("`", "") in said.replace("`", "")


@pytest.mark.parametrize("topic", list(topics()))
def test_every_page_is_printed(topic: str) -> None:
    result = call(topic)
    assert result.exit_code == 0
    words = re.findall(r"[a-z]{5,}", topics()[topic].plain())
    assert words[-1] in result.output
    assert "<!--" not in result.output


def test_an_unknown_topic_names_the_nearest() -> None:
    result = call("hard_case")
    assert result.exit_code == 2
    assert "no topic hard_case in the guide. Did you mean hard_cases?" in result.stderr
    assert "Traceback" not in result.output


def test_a_section_is_printed_alone_and_a_wrong_one_refused() -> None:
    """As warnings name it."""
    alone, whole = call("limits#hypotheses"), call("limits").output
    assert alone.exit_code == 0
    assert "Raceway control" in alone.output and "Where solutions end" not in alone.output
    assert len(alone.output) < len(whole)
    wrong = call("limits#hypothesis")
    assert (wrong.exit_code, wrong.stdout) == (2, "")
    assert "no section hypothesis in the topic limits" in wrong.stderr


def test_a_folder_that_cannot_be_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    result = call("--html", str(tmp_path / "file"))
    assert result.exit_code == 2
    assert "cannot be a folder" in result.stderr


@pytest.mark.parametrize(
    ("word", "said"),
    [
        ("tutorial", "Begin with ten_minutes"),
        ("getting_started", "Begin with ten_minutes"),
        ("how-to", "Did you mean how_to?"),
        ("preload", "See how_to#preload-of-one-bearing"),
        ("films", "See ten_minutes#5-life-films-and-friction, readings"),
        ("xyzzy", ""),
    ],
)
def test_a_word_that_is_no_topic(word: str, said: str) -> None:
    result = call(word)
    assert result.exit_code == 2
    first = result.stderr.splitlines()[0].removeprefix(f"qsbearing: no topic {word} in the guide")
    assert first.startswith(f". {said}") if said else first == ""
    for place in re.findall(r"[\w#-]+", said.partition("See ")[2]):
        assert call(place).exit_code == 0


def test_pages_come_in_the_order_of_the_first(tmp_path: Path) -> None:
    for name, text in {"index": "[z](z.md) [b](b.md)", "a": "", "b": "", "z": ""}.items():
        (tmp_path / f"{name}.md").write_text(f"# {name}\n\n{text}\n")
    assert list(topics(tmp_path)) == ["index", "z", "b", "a"]
