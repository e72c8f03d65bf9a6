"""The front door: what `import qsbearing as qs` gives."""

from __future__ import annotations

import os
import pickle
import shutil
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import COMPILED
from qsbearing.model.compiler.private_folder import fault_of

compiled_and_owned = pytest.mark.skipif(
    not COMPILED or not hasattr(os, "geteuid"),
    reason="nothing is cached, or files have no owner here (Windows)",
)


def test_every_public_name_is_there() -> None:
    for name in qs.__all__:
        assert getattr(qs, name) is not None
    assert set(qs.__all__) <= set(dir(qs))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        qs.nothing  # noqa: B018


def test_solve_is_the_function_whatever_was_imported_before() -> None:
    code = "import qsbearing.model.solution.solver, qsbearing as qs\nassert callable(qs.solve), qs.solve\n"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_import_itself_loads_nothing_heavy() -> None:
    code = "import sys, qsbearing\nassert not {'numpy', 'numba', 'scipy', 'pydantic', 'rich'} & set(sys.modules)\n"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


SOLVE_ONCE = """
import qsbearing as qs
from qsbearing.model.compiler import numba_kernel
solution = qs.solve(qs.load_scene("b218"))
print(numba_kernel.IS_TRIED, solution.inner.load.tobytes().hex())
"""
OLDER_TRIED = "import numba; tried = numba.version_info; numba.version_info = tried._replace(minor=tried.minor + 100)"


@pytest.mark.skipif(not COMPILED, reason="nothing is compiled")
def test_what_numba_does_not_promise_was_tried_with_its_version() -> None:
    """Of an untried version only what is public is used, in twice the time: try it, and set `TRIED`."""
    from qsbearing.model.compiler import numba_kernel

    assert numba_kernel.IS_TRIED


@pytest.mark.heavy
@pytest.mark.skipif(not COMPILED, reason="nothing is compiled")
def test_numba_s_public_ways_compile_to_the_same_digits(tmp_path: Path) -> None:
    """As they do where the version was never tried; and what they keep is found again, without a word."""
    printed, said = [], []
    for number, first in enumerate(("", OLDER_TRIED, OLDER_TRIED)):
        own = {"NUMBA_CACHE_DIR": str(tmp_path)} if number else {}  # what other tests have compiled serves the first
        environment = os.environ | own | {"QSBEARING_COMPILED": "1"}
        command = [sys.executable, "-c", f"{first}\n{SOLVE_ONCE}"]
        done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
        printed.append(done.stdout.split())
        said.append(done.stderr)
    assert [is_tried for is_tried, _ in printed] == ["True", "False", "False"]
    assert printed[0][1] == printed[1][1] == printed[2][1]
    assert "compiling" in said[1]
    assert said[2] == ""


ENTRY = """
from qsbearing.model.compiler.compiled import entry

@entry
def doubled(x: float) -> float:
    return 2.0 * x
"""


@pytest.mark.skipif(not COMPILED, reason="nothing is compiled")
@pytest.mark.parametrize("damage", ["cut", "page", "bit"])
def test_a_damaged_file_of_the_cache_is_compiled_anew(probe: Path, tmp_path: Path, damage: str) -> None:
    """Cut short, a page of zeros, one bit: said once, nothing of it is loaded, and the next start is silent."""
    [kept] = cache_of(probe, tmp_path / "cache").rglob("*.kernel")
    content = bytearray(kept.read_bytes())
    if damage == "cut":
        del content[100:]
    elif damage == "page":
        content[4096:8192] = bytes(4096)
    else:
        content[len(content) // 2] ^= 1
    kept.write_bytes(content)
    damaged, again = (doubled_once(probe, tmp_path / "cache") for _ in range(2))
    assert "damaged" in damaged.stderr
    assert "Traceback" not in damaged.stderr
    assert again.stderr == ""


@pytest.mark.skipif(not COMPILED, reason="nothing is compiled")
def test_copies_of_a_source_share_what_is_compiled(probe: Path, tmp_path: Path) -> None:
    """As an installation and the folder that it was installed from; a changed file is compiled."""
    cache_of(probe, tmp_path / "cache")
    copy = tmp_path / "copy"
    copy.mkdir()
    shutil.copy(probe / "qsbearing_probe.py", copy)
    assert doubled_once(copy, tmp_path / "cache").stderr == ""
    with (copy / "qsbearing_probe.py").open("a", encoding="utf-8") as file:
        file.write("\n")
    assert "compiling" in doubled_once(copy, tmp_path / "cache").stderr


COMMAND = [sys.executable, "-c", "import qsbearing_probe; print(qsbearing_probe.doubled(3.0))"]


class Crafted:
    """Unpickled, it makes a file."""

    def __init__(self, made: Path) -> None:
        self.made = made

    def __reduce__(self) -> tuple[Callable[[str, str], object], tuple[str, str]]:
        return open, (str(self.made), "w")


@pytest.fixture(scope="module")
def probe(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a module whose function is compiled, and its cache."""
    folder = tmp_path_factory.mktemp("probe")
    (folder / "qsbearing_probe.py").write_text(ENTRY, encoding="utf-8")
    doubled_once(folder, folder / "cache")
    return folder


def doubled_once(folder: Path, cache: Path) -> subprocess.CompletedProcess[str]:
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache), "QSBEARING_COMPILED": "1"}
    done = subprocess.run(COMMAND, capture_output=True, text=True, check=True, env=environment, cwd=folder)
    assert done.stdout == "6.0\n"
    return done


def cache_of(probe: Path, cache: Path) -> Path:
    """A copy of the probe's cache, which a process uses."""
    cache.parent.mkdir(exist_ok=True)
    return shutil.copytree(probe / "cache", cache)


@compiled_and_owned
@pytest.mark.parametrize(
    ("opened", "mode"),
    [("above", 0o002), ("root", 0o020), ("kernel", 0o002), ("file", 0o020), ("file", 0o002)],
)
def test_a_folder_that_others_may_write_to_is_told(probe: Path, tmp_path: Path, opened: str, mode: int) -> None:
    cache = cache_of(probe, tmp_path / "above" / "cache")
    [file] = cache.rglob("*.kernel")
    places = {"file": file, "kernel": file.parent, "root": cache, "above": cache.parent}
    kernel = places["kernel"]
    assert [stat.S_IMODE(path.stat().st_mode) for path in (cache, kernel)] == [0o700] * 2
    assert fault_of(kernel) is None
    place = places[opened]
    place.chmod(stat.S_IMODE(place.stat().st_mode) | mode)
    assert fault_of(kernel) == f"{place} is writable by others"


@compiled_and_owned
@pytest.mark.parametrize(("opened", "mode"), [("above", 0o002), ("file", 0o020)])
def test_nothing_that_others_may_have_written_is_run(probe: Path, tmp_path: Path, opened: str, mode: int) -> None:
    """A crafted pickle in place of a cached index, where others may write: not unpickled, and said in a sentence."""
    cache = cache_of(probe, tmp_path / "above" / "cache")
    [file] = cache.rglob("*.kernel")
    file.write_bytes(pickle.dumps(Crafted(tmp_path / "made")))
    place = {"file": file, "above": cache.parent}[opened]
    place.chmod(stat.S_IMODE(place.stat().st_mode) | mode)
    done = doubled_once(probe, cache)
    assert not (tmp_path / "made").exists()
    assert f"{place} is writable by others: remove it" in done.stderr
    assert done.stderr.count("\n") == 1


@compiled_and_owned
def test_a_cache_in_a_folder_for_all_is_the_user_s_where_only_owners_move_what_is_theirs(
    probe: Path, tmp_path: Path
) -> None:
    """As /tmp is."""
    everyone = tmp_path / "everyone"
    everyone.mkdir()
    everyone.chmod(0o1777)
    doubled_once(probe, everyone)
    assert doubled_once(probe, everyone).stderr == ""


@compiled_and_owned
def test_whatever_mode_new_files_have_the_cache_is_its_user_s(probe: Path, tmp_path: Path) -> None:
    before = os.umask(0o002)
    try:
        doubled_once(probe, tmp_path / "cache")
        assert doubled_once(probe, tmp_path / "cache").stderr == ""
    finally:
        os.umask(before)


@compiled_and_owned
@pytest.mark.skipif(getattr(os, "geteuid", int)() != 0, reason="only root may give files away")
def test_another_user_s_cache_is_not_read(probe: Path, tmp_path: Path) -> None:
    for level in range(3):
        cache = cache_of(probe, tmp_path / str(level) / "cache")
        [file] = cache.rglob("*.kernel")
        owned = [file, *file.parents][level]
        os.chown(owned, 65534, 65534)
        assert fault_of(file.parent) == f"{owned} is another user's"
    file.write_bytes(pickle.dumps(Crafted(tmp_path / "made")))
    done = doubled_once(probe, cache)
    assert not (tmp_path / "made").exists()
    assert f"{owned} is another user's: remove it" in done.stderr


@pytest.mark.heavy
def test_the_wheel_is_small(tmp_path: Path) -> None:
    root = Path(qs.__file__).parents[1]
    subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", root, "-w", tmp_path], check=True)
    (wheel,) = tmp_path.glob("*.whl")
    assert wheel.stat().st_size <= 2.5e6
