"""What a process meets while it compiles or loads: signals, damaged files, other processes, a disk that is full."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from qsbearing.model.compiler.compiled import COMPILED

pytestmark = [pytest.mark.heavy, pytest.mark.skipif(not COMPILED, reason="nothing is compiled")]

RUN = [sys.executable, "-m", "qsbearing", "run", "b218", "--json"]


def environment(cache: Path) -> dict[str, str]:
    return os.environ | {"NUMBA_CACHE_DIR": str(cache), "QSBEARING_COMPILED": "1"}


def answer(printed: str) -> dict[str, Any]:
    """All that was found, but for the time that it took."""
    return json.loads(printed) | {"seconds": None}


def run(cache: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(RUN, capture_output=True, text=True, check=False, env=environment(cache), timeout=600)


def started(cache: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(RUN, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment(cache))


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """A cache that holds what a run loads, and what the run prints."""
    cache = tmp_path_factory.mktemp("whole")
    run(cache)
    done = run(cache)
    assert done.stderr == ""
    return cache, answer(done.stdout)


@pytest.mark.skipif(os.name == "nt", reason="there are no such signals")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
@pytest.mark.parametrize("is_kept", [False, True], ids=["compiling", "loading"])
def test_signals_end_the_command(
    whole: tuple[Path, dict[str, Any]], tmp_path: Path, number: signal.Signals, is_kept: bool
) -> None:
    """At random moments of importing, compiling, loading: none is lost, and nothing is shown but a sentence."""
    rng = random.Random(int(number))
    cache = whole[0] if is_kept else tmp_path
    for _ in range(15):
        process = subprocess.Popen(
            RUN, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment(cache)
        )
        time.sleep(rng.uniform(0.2, 2.0 if is_kept else 8.0))
        process.send_signal(number)
        _, said = process.communicate(timeout=300)
        # 0: it was done before. Negative: Python was not yet ready to do more than end.
        assert process.returncode in (128 + number, -number) or (is_kept and process.returncode == 0), said
        assert "Traceback" not in said or process.returncode == -number, said


@pytest.mark.parametrize("damage", ["page", "bit"])
def test_damage_anywhere_is_noticed(whole: tuple[Path, dict[str, Any]], tmp_path: Path, damage: str) -> None:
    """A hundred random pages zeroed, or bits flipped: the same digits, each time after a sentence. Nothing is loaded
    that is damaged, which shows without compiling: the files are read as a process reads them."""
    from qsbearing.model.compiler import compiled_files

    rng = random.Random(1)
    files = sorted(whole[0].rglob("*.kernel"))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(compiled_files, "usable_folder", lambda: (tmp_path, ""))
        patch.setattr(compiled_files, "_path", lambda folder, name, key: tmp_path / name)
        for _ in range(100):
            content = bytearray(rng.choice(files).read_bytes())
            place = rng.randrange(len(content))
            if damage == "page":
                start = place - place % 4096
                page = content[start : start + 4096]
                if not any(page):
                    continue
                content[start : start + 4096] = bytes(len(page))
            else:
                content[place] ^= 1 << rng.randrange(8)
            (tmp_path / "one").write_bytes(content)
            assert compiled_files.read("one", b"") is None
            assert not (tmp_path / "one").exists()


def test_two_processes_compile_once(whole: tuple[Path, dict[str, Any]], tmp_path: Path) -> None:
    """The second waits for the first, says so, and loads what it has kept."""
    both = [started(tmp_path) for _ in range(2)]
    ended = [process.communicate(timeout=600) for process in both]
    assert [process.returncode for process in both] == [0, 0]
    assert [answer(printed) for printed, _ in ended] == [whole[1]] * 2
    assert "waiting for another process" in "".join(said for _, said in ended)
    assert len(list(tmp_path.rglob("*.kernel"))) == len(list(whole[0].rglob("*.kernel")))
    assert list(tmp_path.rglob("half-*")) == []


def test_a_cache_that_cannot_be_written_is_said_once(whole: tuple[Path, dict[str, Any]], tmp_path: Path) -> None:
    """A file where its folder should be; and a limit on the size of files, as a full disk has."""
    (tmp_path / "file").write_text("")
    done = run(tmp_path / "file")
    assert (done.returncode, answer(done.stdout)) == (0, whole[1])
    assert done.stderr.count("\n") == 1
    assert "not cached" in done.stderr


@pytest.mark.skipif(os.name == "nt", reason="files have no limit there")
def test_a_full_disk_leaves_no_half_file(whole: tuple[Path, dict[str, Any]], tmp_path: Path) -> None:
    limited = ["bash", "-c", f"ulimit -f 40; exec {' '.join(RUN)}"]
    shutil.copytree(whole[0], tmp_path / "cache")
    for path in (tmp_path / "cache").rglob("*solve_cases*.kernel"):
        path.unlink()
    done = subprocess.run(
        limited, capture_output=True, text=True, check=False, env=environment(tmp_path / "cache"), timeout=600
    )
    assert (done.returncode, answer(done.stdout)) == (0, whole[1])
    assert "is not kept: File too large" in done.stderr
    assert list((tmp_path / "cache").rglob("*solve_cases*")) == []
    assert list((tmp_path / "cache").rglob("half-*")) == []
