"""A name says what a thing is: no variable is called `found`, and a class name stands once in both packages.

A row's key `found`, and the fields of classes that spell such keys, are no variables.
"""

from __future__ import annotations

import ast
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from itertools import chain
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("qsbearing", "fem_check")
NAME = "found"


@cache
def trees(folder: str) -> list[tuple[str, ast.Module]]:
    """Every file with its syntax tree, by its path in the repository."""
    files = sorted((ROOT / folder).rglob("*.py"))
    return [(each.relative_to(ROOT).as_posix(), ast.parse(each.read_text(encoding="utf-8"))) for each in files]


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


def places_of(*folders: str) -> dict[str, list[str]]:
    """Of each folder where the variable stands: its places."""
    places = defaultdict(list)
    for path, tree in chain.from_iterable(map(trees, folders)):
        lines = [f"{path}:{line}" for name, line in variables(tree) if name == NAME]
        if lines:
            places["/".join(path.split("/")[:2])] += lines
    return dict(places)


def several() -> dict[str, list[str]]:
    """Classes whose names stand more than once, with their files."""
    files = defaultdict(list)
    for path, tree in chain.from_iterable(map(trees, PACKAGES)):
        for each in ast.walk(tree):
            if isinstance(each, ast.ClassDef):
                files[each.name].append(path)
    return {name: paths for name, paths in files.items() if len(paths) > 1}


def test_no_variable_is_named_found() -> None:
    places = places_of(*PACKAGES, "tests/fem_check")
    assert places == {}, "name it by what it is: a record, errors, a table, a step, rows"


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
