"""What the kernel's machine code is made from: files of the package, and the tool itself."""

from __future__ import annotations

import ast
import dis
import re
import sys
import tomllib
from functools import cache
from importlib import import_module
from pathlib import Path
from types import CodeType
from typing import Any

from qsbearing.model.compiler import compiled
from qsbearing.model.compiler.library import ROOT, digest

PACKAGE = "qsbearing"
ENTRY = re.compile(r"^@entry\b", re.MULTILINE)
EXTRA = "kernel"
"""Of pyproject.toml: the versions with which libraries are made."""


def entries() -> list[compiled.CompiledEntry]:
    """Of the package, in the order in which they are compiled, which is part of what the bytes rest on."""
    for path in sorted((ROOT / PACKAGE).rglob("*.py")):
        if ENTRY.search(path.read_text(encoding="utf-8")):
            import_module(module_of(path))
    return sorted((each for each in compiled.entries if each.name.startswith(PACKAGE)), key=lambda each: each.name)


def module_of(path: Path) -> str:
    """The dotted name of a file."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts)


def sources() -> list[str]:
    """The files of marked functions, and those from which they take numbers and records: names from `ROOT`, sorted."""
    made_of = [*(each.function for each in entries()), *compiled.functions]
    codes = {each.__code__ for each in made_of if each.__module__.startswith(PACKAGE)}
    waiting = [(Path(code.co_filename), name) for code in codes for name in _globals(code)]
    found = {Path(code.co_filename) for code in codes}
    waiting += [(path, name) for path in found for name in _kinds_in(path)]
    seen = set(waiting)
    while waiting:
        path, name = waiting.pop()
        origin, names = _made_of(path, name)
        found |= {origin} if names is not None else set()
        for each in ((origin, other) for other in names or ()):
            if each not in seen:
                seen.add(each)
                waiting.append(each)
    return sorted(path.relative_to(ROOT).as_posix() for path in found)


def _globals(code: CodeType) -> set[str]:
    return {each.argval for each in dis.get_instructions(code) if each.opname == "LOAD_GLOBAL"}


@cache
def _body(path: Path) -> list[ast.stmt]:
    return ast.parse(path.read_text(encoding="utf-8")).body


def _names(node: ast.AST) -> set[str]:
    return {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}


def _kinds_in(path: Path) -> set[str]:
    """The names of which the kinds are made that entries of a file take."""
    marks = [mark for each in _body(path) if isinstance(each, ast.FunctionDef) for mark in each.decorator_list]
    return set().union(*(_names(mark) for mark in marks if isinstance(mark, ast.Call)))


def _made_of(path: Path, name: str) -> tuple[Path, set[str] | None]:
    """(the file that defines a number, record or class which another knows by this name, the names that it is made of
    there; None for functions and what is not the package's)."""
    for node in _body(path):
        if isinstance(node, ast.ClassDef) and node.name == name:
            return path, set().union(*map(_names, node.bases))
        if isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            if node.value is not None and any(name in _names(target) for target in targets):
                return path, _names(node.value)
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(PACKAGE):
            origins = {each.asname or each.name: each.name for each in node.names}
            file = ROOT.joinpath(*str(node.module).split(".")).with_suffix(".py")
            if name in origins and file.exists():
                return _made_of(file, origins[name])
    return path, None


def pinned() -> dict[str, str]:
    """The versions of numba, llvmlite and ziglang that make the libraries which come with the package."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return dict(line.split("==") for line in project["optional-dependencies"][EXTRA])


def tool() -> str:
    """Digest of the tool's own files and of what turns kinds into numba's types."""
    compiler = ROOT / PACKAGE / "model" / "compiler"
    own = [Path(__file__).with_name(f"{name}.py") for name in ("inputs", "compile_all", "entry_points", "targets")]
    files = [*own, *(compiler / f"{name}.py" for name in ("kinds", "machine_code", "numba_kernel"))]
    return digest(path.relative_to(ROOT).as_posix() for path in files)


def made_by() -> dict[str, Any]:
    """What the bytes rest on beside the sources, as it is now: tool, versions asked for, Python, flags and targets."""
    from tests.verification.kernel_library.targets import TARGETS

    python = ".".join(map(str, sys.version_info[:2]))
    return {"tool": tool(), "versions": pinned(), "python": python, "targets": {k: list(v) for k, v in TARGETS.items()}}
