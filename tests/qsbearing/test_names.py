"""A name says what a thing is: no variable is called `found`, a class name stands once in both packages, and no regular
expression reads out of our own names and sentences what data says before.

A row's key `found`, and the fields of classes that spell such keys, are no variables.
"""

from __future__ import annotations

import ast
from collections import defaultdict
from collections.abc import Iterator

import pytest

from tests.qsbearing.source_text import PACKAGES, ROOT, trees

NAME = "found"

READ = {
    "qsbearing/app/mcp/folder.py": "names of files that somebody asks for",
    "qsbearing/cli/report.py": "the mark in a page, so that no other page is overwritten",
    "qsbearing/documents": "text as such: markdown, LaTeX, SVG, and where lines may break",
    "qsbearing/files": "files, names of bearings, fits and words that others write",
    "qsbearing/model/scene/requirement.py": "what people write",
    "qsbearing/model/validation.py": "what people write",
    "qsbearing/site/": "Markdown and the help of commands",
    "qsbearing/studies/design/problem.py": "what people write",
    "qsbearing/studies/variables.py": "what people write",
    "fem_check/report/rows.py": "records as shipped, which are compared by their words with former ones",
    "fem_check/rows/row_text.py": "numbers as Python writes them",
    "fem_check/running/kept_files.py": "marks in pages between which a table stands",
}
"""Where regular expressions are used, and what they read."""


def variables(tree: ast.Module) -> Iterator[tuple[str, int]]:
    """What is bound in a file, but for fields of classes: name and line."""
    bodies = (each.body for each in ast.walk(tree) if isinstance(each, ast.ClassDef))
    fields = {id(each.target) for body in bodies for each in body if isinstance(each, ast.AnnAssign)}
    for each in ast.walk(tree):
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Store) and id(each) not in fields:
            yield each.id, each.lineno
        elif isinstance(each, ast.arg):
            yield each.arg, each.lineno
        elif isinstance(each, ast.ExceptHandler | ast.MatchAs | ast.MatchStar) and each.name:
            yield each.name, each.lineno


def several() -> dict[str, list[str]]:
    """Classes whose names stand more than once, with their files."""
    files = defaultdict(list)
    for path, tree in trees(r"\bclass ", *PACKAGES):
        for each in ast.walk(tree):
            if isinstance(each, ast.ClassDef):
                files[each.name].append(path.relative_to(ROOT).as_posix())
    return {name: paths for name, paths in files.items() if len(paths) > 1}


def test_no_variable_is_named_found() -> None:
    places = [
        f"{path.relative_to(ROOT)}:{line}"
        for path, tree in trees(rf"\b{NAME}\b", *PACKAGES, ROOT / "tests" / "fem_check")
        for name, line in variables(tree)
        if name == NAME
    ]
    assert places == [], "name it by what it is: a record, errors, a table, a step, rows"


def test_a_class_name_stands_once() -> None:
    assert several() == {}


@pytest.mark.parametrize(
    "line", ["found = 1", "def f(found): ...", "[found for found in ()]", "(found := 1)", "for a, found in (): ...",
             "with f() as found: ...", "lambda *found: 0", "match a:\n case [found]: ..."],
)  # fmt: skip
def test_every_way_to_bind_it_is_seen(line: str) -> None:
    assert NAME in dict(variables(ast.parse(line)))


def test_fields_and_keys_are_none() -> None:
    text = 'class Row:\n    found: float\n\nrow["found"] = row.found'
    assert NAME not in dict(variables(ast.parse(text)))


def test_regular_expressions_read_what_others_write() -> None:
    places = set()
    for path, tree in trees(r"\bimport re\b|\bfrom re\b", *PACKAGES):
        imported = [each for each in ast.walk(tree) if isinstance(each, ast.Import | ast.ImportFrom)]
        if any("re" in (getattr(each, "module", ""), *(name.name for name in each.names)) for each in imported):
            place = path.relative_to(ROOT).as_posix()
            places.add(next((known for known in READ if place.startswith(known)), place))
    assert places == READ.keys(), "our own names and sentences are data before they are text"
