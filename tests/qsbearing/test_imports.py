"""Imports go one way: no file needs one that needs it, those for type checking and inside functions counted."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import qsbearing
from tests.qsbearing.source_text import PACKAGES, trees

ROOT = Path(qsbearing.__file__).parent


def name_of(path: Path) -> str:
    parts = [ROOT.name, *path.relative_to(ROOT).with_suffix("").parts]
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


FILES = {name_of(path): path for path in ROOT.rglob("*.py")}


def imported(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            full = [f"{node.module}.{each.name}" for each in node.names]
            yield from (each if each in FILES else node.module for each in full)


def test_no_circle_of_files() -> None:
    """The package itself loads its public names when they are asked for."""
    needs = {name: set(imported(path)) & set(FILES) - {name, "qsbearing"} for name, path in FILES.items()}
    assert sum(map(len, needs.values())) > 1000
    needs["qsbearing"] = set()
    reach = {name: set(found) for name, found in needs.items()}
    for middle in FILES:
        for found in reach.values():
            if middle in found:
                found |= reach[middle]
    assert {name for name, found in reach.items() if name in found} == set()


# Private names --------------------------------------------------------------------------------------------------------

OF_NAMED_TUPLES = {"_asdict", "_replace", "_make", "_fields"}


def private_reads(tree: ast.Module) -> Iterator[str]:
    """Private attributes of objects that another file makes."""
    own = {each.name for each in ast.walk(tree) if isinstance(each, ast.FunctionDef | ast.ClassDef)}
    reads = [each for each in ast.walk(tree) if isinstance(each, ast.Attribute)]
    of_self = [each for each in reads if isinstance(each.value, ast.Name) and each.value.id in ("self", "cls")]
    own |= {each.attr for each in of_self} | OF_NAMED_TUPLES
    for each in reads:
        if each.attr.startswith("_") and not each.attr.endswith("_") and each.attr not in own:
            yield ast.unparse(each)


def test_no_file_reads_what_is_private_to_another() -> None:
    found = {
        file.relative_to(ROOT.parent).as_posix(): list(private_reads(tree)) for file, tree in trees(r"\._", *PACKAGES)
    }
    assert [name for name, reads in found.items() if reads] == []
    assert list(private_reads(ast.parse("solution._maker.count")))
