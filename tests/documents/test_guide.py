"""The guide: every page printed, all pages in one file, links that lead somewhere."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from qsbearing import __version__
from qsbearing.cli import cli
from qsbearing.documents.guide import FOLDER, HOME, documents, file_of, topics
from qsbearing.documents.markdown import sections
from qsbearing.documents.model import Bullets, Code, Document, Md, Paragraph, Picture, Section, Table
from qsbearing.documents.pdf import pdf
from tests.documents.page import Page


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


def test_each_topic_is_a_sound_page(tmp_path: Path) -> None:
    """And all lead home, to their neighbours and through the search."""
    into = tmp_path / "new" / "folder"
    assert call("--html", str(into)).exit_code == 0
    names = [file_of(topic) for topic in topics()]
    assert names[0] == HOME
    assert {path.name for path in into.iterdir()} == {*names, "search.js"}
    for number, name in enumerate(names):
        text = (into / name).read_text(encoding="utf-8")
        assert Page.of(text, [*names, "search.js"]).faults == []
        assert (f'href="{HOME}">Guide' in text) == (name != HOME)
        assert [other for other in names if f'href="{other}" rel="' in text] == [
            *names[max(number - 1, 0) : number],
            *names[number + 1 : number + 2],
        ]


def test_each_page_can_be_a_pdf() -> None:
    """With the letters and formulas of all: one document, whose links do not matter here."""
    found = documents(__version__).values()
    whole = Document("Guide", "", [Section(each.title, [*each.head, *each.sections]) for each in found])
    assert pdf(whole, strict=True).startswith(b"%PDF")


def test_a_folder_that_cannot_be_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    result = call("--html", str(tmp_path / "file"))
    assert result.exit_code == 2
    assert "cannot be a folder" in result.stderr


PAGE = """<!-- a comment -->
# A page

Words with `code`, [another page](b.md), [its part](b.md#part), [a file](../x.py) and [a site](https://example.org).

- one
- two

1. first

| name | value | words |
|---|---|---|
| a | 1.5 | x |

```sh
run this
```

    x = 1

![what it shows](p.svg)

## Part

> A remark.
"""


def test_a_page_becomes_pieces(tmp_path: Path) -> None:
    (tmp_path / "p.svg").write_text("<svg/>")
    leads = {"b.md": "#b", "b.md#part": "#b-part", "https://example.org": "https://example.org"}
    (page,) = sections(PAGE, tmp_path, leads.get, "a")
    assert (page.name, page.title) == ("a", "A page")
    words, bullets, numbered, table, typed, indented, picture, part = page.blocks
    assert isinstance(words, Paragraph)
    assert words.text == (
        "Words with `code`, [another page](#b), [its part](#b-part), a file and [a site](https://example.org)."
    )
    assert isinstance(words.text, Md)
    assert bullets == Bullets(["one", "two"])
    assert numbered == Bullets(["first"], numbered=True)
    assert isinstance(table, Table)
    assert (table.align, table.rows) == ("lrl", [["a", "1.5", "x"]])
    assert (typed, indented) == (Code("run this", "sh"), Code("x = 1"))
    assert isinstance(picture, Picture)
    assert (picture.alt, picture.form) == ("what it shows", "svg")
    assert isinstance(part, Section)
    assert part.name == "a-part"


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
    assert list(documents("0", tmp_path)) == [file_of(topic) for topic in ("index", "z", "b", "a")]
