"""What judges shares no code with what it judges."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "fem_check" / "independent"
MODULES = sorted(FOLDER.glob("*.py"))
OWN = "fem_check.independent"
OUTSIDE = {"__future__", "collections", "csv", "dataclasses", "enum", "functools", "importlib", "itertools", "math"}
OUTSIDE |= {"meshio", "numpy", "pathlib", "scipy", "skfem", "typing"}


def imported(path: Path) -> set[str]:
    """Full names of the modules that a file imports, wherever in it."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            names |= {each.name for each in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0
            names.add(node.module or "")
    return names


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.stem)
def test_a_reference_imports_other_references_and_general_libraries_alone(path: Path) -> None:
    for name in imported(path):
        assert name.startswith(OWN) or name.partition(".")[0] in OUTSIDE, f"{path.name} imports {name}"


def test_all_references_are_loaded_without_the_package_that_they_judge() -> None:
    names = [f"{OWN}.{path.stem}" for path in MODULES if path.stem != "__init__"]
    loads = f"import {', '.join(names)}, sys; print(*(name for name in sys.modules if name.startswith('qsbearing')))"
    done = subprocess.run(
        [sys.executable, "-c", loads], capture_output=True, text=True, check=True, cwd=FOLDER.parents[1]
    )
    assert done.stdout.split() == []
