"""A name says what a thing is: no variable is called `found`, and a class name stands once in both packages.

A row's key `found`, and the fields of classes that spell such keys, are no variables.
"""

from __future__ import annotations

import ast
from collections import defaultdict
from collections.abc import Iterator

import pytest

from tests.qsbearing.source_text import PACKAGES, ROOT, trees

NAME = "found"


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
