"""Quick tests are quick and see every area; processes that share the tests leave none out."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests import durations

FILES = sorted(Path(__file__).parent.rglob("test_*.py"))
AREAS = sorted({file.relative_to(durations.ROOT).parts[1] for file in FILES if file.parent != Path(__file__).parent})


def test_quick_tests_take_half_a_minute_without_imports() -> None:
    """With them less than a minute."""
    quick = [file for file in FILES if durations.has_quick(file)]
    assert sum(durations.of_file(file)[""] for file in quick) <= 30.0


@pytest.mark.parametrize("area", AREAS)
def test_every_area_has_quick_tests(area: str) -> None:
    """The folders of the tests have the names of those of the package, and `fem_check`."""
    assert any(durations.has_quick(file) for file in FILES if file.is_relative_to(Path(__file__).parent / area))


def test_every_folder_of_the_package_is_an_area() -> None:
    folders = {path.parent.name for path in (durations.ROOT / "qsbearing").glob("*/__init__.py")}
    assert folders | {"fem_check"} <= set(AREAS)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_parts_are_all_files_once_and_of_like_cost(count: int) -> None:
    parts = durations.shared(FILES, count)
    assert [file for part in parts for file in part] == FILES
    costs = [sum(sum(durations.of_file(file).values()) for file in part) for part in parts]
    largest = max(sum(durations.of_file(file).values()) for file in FILES)
    assert max(costs) <= sum(costs) / count + largest + 0.1 * len(FILES)


def run_in_two(folder: Path, *asked: str) -> subprocess.CompletedProcess[str]:
    """Three files of tests, of which two processes run what is asked for."""
    (folder / "folder").mkdir()
    for name in ("test_a", "folder/test_b", "folder/test_c"):
        (folder / f"{name}.py").write_text("def test_one():\n    pass\n\ndef test_two():\n    pass\n", encoding="utf-8")
    conftest = "from tests.conftest import *\n\nblank_pictures = None  # nothing is drawn\n"
    (folder / "conftest.py").write_text(conftest, encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-v", "-n", "2", "--dist", "each", "--rootdir", "."]
    environment = os.environ | {"PYTHONPATH": str(durations.ROOT)}
    return subprocess.run([*command, *asked], cwd=folder, env=environment, capture_output=True, text=True, check=False)


def test_two_processes_run_what_one_runs(tmp_path: Path) -> None:
    """Files of two folders, one of them twice asked for; a test by its name; each test once."""
    done = run_in_two(tmp_path, "test_a.py::test_one", "folder", "folder/test_c.py")
    assert done.returncode == 0, done.stdout + done.stderr
    ran = sorted(line.split()[-1] for line in done.stdout.splitlines() if "PASSED" in line)
    assert ran == [
        "folder/test_b.py::test_one", "folder/test_b.py::test_two", "folder/test_c.py::test_one",
        "folder/test_c.py::test_two", "test_a.py::test_one",
    ]  # fmt: skip
    assert len({line.split()[0] for line in done.stdout.splitlines() if "PASSED" in line}) == 2


def test_a_process_without_tests_is_no_error(tmp_path: Path) -> None:
    done = run_in_two(tmp_path, "test_a.py::test_one")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "[100%]" in done.stdout
