"""The machine code that comes with the package: a shared library for each platform, made from the kernel's own source.

A library is loaded only if it was made from the source that stands here, and is whole: `manifest.json` beside it names
the files that it was made from, with their digest, and states the library's own. In a checkout, a library that was made
there, for this platform alone, stands in `own/`, and comes first. What made them, and how, is in `guide/code.md`.
"""

from __future__ import annotations

import ctypes
import hashlib
import json
import os
import platform
import sys
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from qsbearing.model.compiler.machine_code import called, reads_arrays

ROOT = Path(__file__).parents[3]
FOLDER = Path(__file__).parent / "libraries"
OWN = FOLDER / "own"
MANIFEST = "manifest.json"
SUFFIXES = {"linux": "so", "macos": "dylib", "windows": "dll"}
MACHINES = {"amd64": "x86_64", "arm64": "aarch64"}


class Library(NamedTuple):
    """Machine code that may be used."""

    code: ctypes.CDLL
    entries: dict[str, dict[str, Any]]
    """By the entries' names, what the manifest states of them."""


def platform_name() -> str:
    """This platform, as the libraries are named."""
    system = {"darwin": "macos", "win32": "windows"}.get(sys.platform, sys.platform)
    machine = platform.machine().lower()
    return f"{system}-{MACHINES.get(machine, machine)}"


def file_of(name: str) -> str:
    """The library of a platform."""
    return f"kernel-{name}.{SUFFIXES[name.partition('-')[0]]}"


def digest(files: Iterable[str]) -> str:
    """Of these files of the packages, whatever their line ends."""
    sha256 = hashlib.sha256()
    for name in files:
        sha256.update(f"{name}\n".encode() + (ROOT / name).read_bytes().replace(b"\r\n", b"\n"))
    return sha256.hexdigest()


def found() -> Library | None:
    """The library for this platform and source; None where there is none (`why_none`)."""
    return _found()[0]


def why_none() -> str:
    """Why there is no library, in a few words."""
    return _found()[1]


def forget() -> None:
    """Look for it again at the next question: for those who make one."""
    _found.cache_clear()


def machine_code(name: str, kinds: tuple[Any, ...]) -> Callable[..., Any] | None:
    """Of the entry with this name, if it was made for arguments of these kinds."""
    library = found()
    stated = None if library is None else library.entries.get(name)
    if library is None or stated is None or stated["kinds"] != [str(kind) for kind in kinds]:
        return None
    return called(name, getattr(library.code, stated["symbol"]), kinds, stated["returns"])


@cache
def _found() -> tuple[Library | None, str]:
    if os.environ.get("QSBEARING_LIBRARY", "1") == "0":
        return None, "the machine code that comes with it is left alone"
    fault = f"there is no machine code for {platform_name()}"
    for folder in (OWN, FOLDER):
        library, why = _loaded(folder)
        if library is not None:
            return library, ""
        fault = why or fault
    if (ROOT / ".git").exists():  # whoever changes the source is told; others have the library of their source
        print(f"qsbearing: {fault}", file=sys.stderr, flush=True)
    return None, fault


def _loaded(folder: Path) -> tuple[Library | None, str]:
    """(a folder's library, "") or (None, why not; empty where there is none)."""
    name = platform_name()
    try:
        manifest = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
        stated = manifest["libraries"].get(name)
        if stated is None:
            return None, ""
        path = folder / file_of(name)
        if digest(manifest["sources"]) != manifest["digest"]:
            return None, f"{path.name} was made from another state of the source"
        if hashlib.sha256(path.read_bytes()).hexdigest() != stated["sha256"]:
            return None, f"{path.name} is damaged"
        code = ctypes.CDLL(str(path))
    except FileNotFoundError as error:
        return None, "" if error.filename in (None, str(folder / MANIFEST)) else f"{error.filename} is missing"
    except (OSError, ValueError, KeyError) as error:
        return None, f"the machine code cannot be loaded ({error})"
    if not reads_arrays():
        return None, "machine code does not know the arrays of this Python"
    if not code.qsk_runs_here():
        return None, "this processor is older than what the machine code is made for (x86-64-v3: AVX2, FMA, BMI2)"
    return Library(code, manifest["entries"]), ""
