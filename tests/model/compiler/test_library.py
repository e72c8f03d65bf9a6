"""The machine code that comes with the package: loaded only if it is whole and made from the source beside it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.model.compiler import compiled, library, plain_records
from qsbearing.model.compiler.kinds import flat
from qsbearing.readings import stress
from qsbearing.readings.asked import take_asked
from tests.studies.test_sweep import with_readings
from tests.systems.sets.arrangements import pair
from tests.verification.benchmarks import scenes as random_scenes
from tests.verification.kernel_library import build, inputs

pytestmark = pytest.mark.skipif(library.found() is None, reason="there is no machine code for this platform")

SOLVE = """
import qsbearing as qs
from qsbearing.model.compiler import library
found = qs.solve(qs.load_scene("b218"))
print(library.found() is not None, found.inner.load.tobytes().hex(), int(found.iterations))
"""


def used_library() -> Path:
    """The folder of that which is loaded here."""
    return library.OWN if build.is_current(library.OWN) else library.FOLDER


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The package elsewhere, with the library of this platform."""
    root = tmp_path_factory.mktemp("copy")
    package = Path(qs.__file__).parent
    shutil.copytree(package, root / "qsbearing", ignore=shutil.ignore_patterns("__pycache__", "libraries", "records"))
    return root


@pytest.fixture
def folder(copy: Path) -> Path:
    """Of its libraries, made anew."""
    made = copy / library.FOLDER.relative_to(library.ROOT)
    shutil.rmtree(made, ignore_errors=True)
    shutil.copytree(used_library(), made, ignore=shutil.ignore_patterns("own"))
    return made


def solved(root: Path, **variables: str) -> tuple[list[str], str]:
    """(what is printed, what is said) by a process that has this package and no numba."""
    environment = os.environ | {"PYTHONPATH": str(root), "NUMBA_DISABLE_JIT": "0"} | variables
    code = f"import sys; sys.modules['numba'] = None\n{SOLVE}"
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, cwd=root)
    assert done.returncode == 0, done.stderr
    return done.stdout.split(), done.stderr


def damage(folder: Path) -> None:
    path = folder / library.file_of(library.platform_name())
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)


def cut(folder: Path) -> None:
    path = folder / library.file_of(library.platform_name())
    path.write_bytes(path.read_bytes()[:1000])


def not_a_library(folder: Path) -> None:
    """Whose checksum is right."""
    name = library.platform_name()
    (folder / library.file_of(name)).write_bytes(b"")
    manifest = json.loads((folder / library.MANIFEST).read_text())
    manifest["libraries"][name]["sha256"] = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"
    (folder / library.MANIFEST).write_text(json.dumps(manifest))


FAULTS: dict[str, tuple[Callable[[Path], object], str]] = {
    "a bit": (damage, "is damaged"),
    "cut": (cut, "is damaged"),
    "no library": (not_a_library, "cannot be loaded"),
    "missing": (lambda folder: (folder / library.file_of(library.platform_name())).unlink(), "is missing"),
    "manifest": (lambda folder: (folder / library.MANIFEST).write_text("{"), "cannot be loaded"),
    "no manifest": (lambda folder: shutil.rmtree(folder), "there is no machine code"),
}


@pytest.fixture(scope="module")
def digits() -> list[str]:
    """What every process prints that solves it, in whichever way."""
    found = qs.solve(qs.load_scene("b218"))
    return [found.inner.load.tobytes().hex(), str(int(found.iterations))]


def test_an_undamaged_copy_is_used(copy: Path, folder: Path, digits: list[str]) -> None:
    assert solved(copy) == (["True", *digits], "")


@pytest.fixture
def checkout(copy: Path) -> Iterator[Path]:
    """The copy, as if git knew it."""
    (copy / ".git").mkdir()
    yield copy
    (copy / ".git").rmdir()


@pytest.mark.parametrize("fault", FAULTS)
def test_a_damaged_library_is_not_loaded(checkout: Path, folder: Path, digits: list[str], fault: str) -> None:
    """The digits are right, and who has a checkout is told."""
    spoil, why = FAULTS[fault]
    spoil(folder)
    printed, said = solved(checkout)
    assert printed == ["False", *digits]
    assert said.startswith("qsbearing: ")
    assert why in said
    assert said.count("\n") == 1


def test_who_only_uses_the_package_is_not_told(copy: Path, folder: Path, digits: list[str]) -> None:
    """Of what a single case does not need, and nobody but its makers can mend."""
    damage(folder)
    assert solved(copy) == (["False", *digits], "")


@pytest.mark.parametrize("name", inputs.sources())
def test_a_library_of_another_source_is_not_used(copy: Path, folder: Path, name: str) -> None:
    """Whichever of its files changes, by as much as a line's end."""
    path = copy / name
    before = path.read_bytes()
    with pytest.MonkeyPatch.context() as patch:
        for module_name, value in (("ROOT", copy), ("FOLDER", folder), ("OWN", folder / "own")):
            patch.setattr(library, module_name, value)
        library.forget()
        assert library.found() is not None
        try:
            path.write_bytes(before.rstrip(b"\n"))
            library.forget()
            assert library.found() is None
            assert "another state of the source" in library.why_none()
            path.write_bytes(before.replace(b"\n", b"\r\n"))  # as git may write it on Windows
            library.forget()
            assert library.found() is not None
        finally:
            path.write_bytes(before)
            library.forget()
    library.forget()


def test_what_it_was_made_for_is_what_entries_take() -> None:
    """Layouts of records and all; every entry is in it, and nothing else."""
    stated = json.loads((used_library() / library.MANIFEST).read_text(encoding="utf-8"))["entries"]
    assert {name: each["kinds"] for name, each in stated.items()} == {
        entry.name: [str(kind) for kind in flat(entry.kinds)] for entry in inputs.entries()
    }


def test_no_batch_runs_plain(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever is solved or read of a thousand cases, no entry takes them in plain Python."""
    plain: list[str] = []
    monkeypatch.setattr(plain_records, "call", lambda function, args: plain.append(function.__qualname__))
    calls: set[str] = set()
    called = compiled.CompiledEntry.__call__

    def noted(entry: compiled.CompiledEntry, *args: object) -> object:
        calls.add(entry.name)
        return called(entry, *args)

    monkeypatch.setattr(compiled.CompiledEntry, "__call__", noted)
    batch = qs.solve(random_scenes.random_points(1000))
    assert np.isfinite(batch.stiffness).all()
    asked = scene_of(with_readings(), "")
    many = qs.solve(replace(asked, operation=replace(asked.operation, speed=np.linspace(1e3, 9e3, 1000) * qs.rpm)))
    take_asked(many)
    stress(many)
    qs.solve_set(pair(axial_load=np.linspace(1e3, 3e3, 1100), radial_load_y=1e3, moment_z=0.0, speed=5e3 * qs.rpm))
    assert plain == []
    of_kernel = {
        "lanes.solve_in_lanes",
        "results.read_cases",
        "results.stiffness_of_cases",
        "solve_sets.solve_set_cases",
    }
    assert {f"qsbearing.model.kernel.{name}" for name in of_kernel} <= calls
    assert sum(".readings." in name for name in calls) >= 6
