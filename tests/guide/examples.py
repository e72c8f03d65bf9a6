"""Examples wherever users meet them: pages, notebook, docstrings, help, messages, templates of issues."""

from __future__ import annotations

import ast
import doctest
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from markdown_it import MarkdownIt

from tests.guide.pages import GUIDE, ROOT

INLINE = "inline"
"""The language of what stands in back quotes within a sentence: a command, a line of a file, a name."""
_MARKDOWN = MarkdownIt("commonmark").enable("table")
_QUOTED = re.compile(r"(?<!`)`([^`\n]+(?:\n[^`\n]+)?)`(?!`)")

_FOR_INSTANCE = re.compile(r"For instance: ((?:qsbearing|fem-check) .*?)\n\s*\n", re.DOTALL)


@dataclass(frozen=True)
class Example:
    """A piece of text that a reader may copy."""

    where: str
    """File and line."""
    language: str
    text: str


def of_markdown(text: str, name: str, first_line: int = 1) -> Iterator[Example]:
    """Fenced blocks, and what sentences have in back quotes."""
    for token in _MARKDOWN.parse(text):
        where = f"{name}:{(token.map or [0])[0] + first_line}"
        if token.type == "fence":
            yield Example(where, token.info.strip(), token.content)
        for child in token.children or ():
            if child.type == "code_inline":
                yield Example(where, INLINE, child.content)


def of_notebook(path: Path) -> Iterator[Example]:
    """Code cells, and the text between them."""
    for number, cell in enumerate(json.loads(path.read_text(encoding="utf-8"))["cells"], 1):
        name = f"{path.name}, cell {number}"
        if cell["cell_type"] == "code":
            lines = [line for line in cell["source"] if not line.startswith("%")]
            yield Example(name, "python", "".join(lines))
        else:
            yield from of_markdown("".join(cell["source"]), name)


def of_source(text: str, name: str) -> Iterator[Example]:
    """Of a module: the examples of its docstrings, and what any of its strings has in back quotes. A part of a sentence
    that is filled in later reads as a placeholder."""
    inner: set[int] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.JoinedStr):
            inner |= {id(each) for each in node.values}
            said = "".join(str(each.value) if isinstance(each, ast.Constant) else "NAME" for each in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in inner:
            said = node.value
        else:
            continue
        where = f"{name}:{node.lineno}"
        if ">>> " in said:
            yield Example(where, "python", "".join(each.source for each in doctest.DocTestParser().get_examples(said)))
        yield from (Example(where, INLINE, " ".join(each.split())) for each in _QUOTED.findall(said))
        yield from (Example(where, INLINE, " ".join(each.split())) for each in _FOR_INSTANCE.findall(said))


def every_page() -> list[Path]:
    """Pages for readers, those of contributors among them."""
    return [ROOT / "README.md", *sorted((ROOT / ".github").rglob("*.md")), *sorted(GUIDE.rglob("*.md"))]


def named(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def everywhere() -> dict[str, list[Example]]:
    """All examples by the file that has them."""
    found = {named(path): list(of_markdown(path.read_text(encoding="utf-8"), named(path))) for path in every_page()}
    for path in sorted((ROOT / ".github").rglob("*.yml")):
        quoted = _QUOTED.findall(path.read_text(encoding="utf-8"))
        found[named(path)] = [Example(named(path), INLINE, each) for each in quoted]
    for path in sorted(GUIDE.glob("*.ipynb")):
        found[named(path)] = list(of_notebook(path))
    for package in ("qsbearing", "fem_check"):
        for path in sorted((ROOT / package).rglob("*.py")):
            found[named(path)] = list(of_source(path.read_text(encoding="utf-8"), named(path)))
    return {name: examples for name, examples in found.items() if examples}
