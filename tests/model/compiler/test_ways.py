"""Which way the kernel runs: machine code that came with the package, numba, plain Python; and what a process loads.

Each test runs processes of its own, as users do, with an empty cache of their own where nothing else is said.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from qsbearing.model.compiler import library
from qsbearing.model.compiler.compiled import HAS_NUMBA

with_library = pytest.mark.skipif(library.found() is None, reason="there is no machine code for this platform")
with_numba = pytest.mark.skipif(not HAS_NUMBA, reason="numba is not installed, or switched off")

PROBE = """
import numpy as np
from qsbearing.model.compiler.compiled import entry, kernel
from qsbearing.model.compiler.kinds import array_of

@kernel
def twice(x):
    return 2.0 * x

@entry(array_of(float), float)
def doubled(cases, x):
    for k in range(cases.size):
        cases[k] = twice(x)

def fill(count, x=3.0):
    cases = np.empty(count)
    doubled(cases, x)
    return doubled.plain_cases, doubled.is_compiled, bool((cases == 6.0).all())
"""
"""A module with a kernel of two functions, for which no machine code was made."""

NO_NUMBA = "import sys; sys.modules['numba'] = None; import importlib.util as u; f = u.find_spec\n"
NO_NUMBA += "u.find_spec = lambda name, *a: None if name == 'numba' else f(name, *a)\n"
"""Where it is not installed, as far as a process that has it can show; `test_alone_in_an_environment` has none."""


def run(code: str, folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """Python code in a process that has compiled nothing."""
    environment = {key: value for key, value in os.environ.items() if key != "QSBEARING_COMPILED"}
    environment |= {"NUMBA_CACHE_DIR": str(folder / "cache"), "PYTHONPATH": str(folder)} | variables
    return subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, env=environment, timeout=600
    )


def printed(code: str, folder: Path, **variables: str) -> str:
    done = run(code, folder, **variables)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture
def probe(tmp_path: Path) -> Path:
    (tmp_path / "probe_module.py").write_text(PROBE, encoding="utf-8")
    return tmp_path


def command(arguments: str) -> str:
    return f"import sys\nfrom qsbearing.cli import cli\ncli({arguments.split()!r}, standalone_mode=False)\n"


HEAVY = "{'numba', 'llvmlite', 'platformdirs', 'pydantic', 'scipy'}"
LOADED = f"print(*sorted({HEAVY} & set(sys.modules)), 'loaded')"


@with_library
def test_a_bearing_and_a_set_need_no_compiler(tmp_path: Path) -> None:
    """Nor a cache."""
    (tmp_path / "pair.toml").write_text(printed(command("init --set"), tmp_path), encoding="utf-8")
    for what in ("b218", tmp_path / "pair.toml"):
        assert printed(command(f"run {what}") + LOADED, tmp_path).endswith("\nloaded\n")
    assert not (tmp_path / "cache").exists()


def test_with_neither_cases_and_sets_are_solved(tmp_path: Path) -> None:
    """Many cases too, and it says once what would make them faster."""
    assert "14.7578" in printed(NO_NUMBA + command("run b218"), tmp_path, QSBEARING_LIBRARY="0")
    (tmp_path / "probe_module.py").write_text(PROBE, encoding="utf-8")
    done = run(
        f"{NO_NUMBA}import probe_module as p\nprint(p.fill(999), p.fill(1000), p.fill(1000))",
        tmp_path,
        QSBEARING_LIBRARY="0",
    )
    assert done.stdout == "(999, False, True) (1999, False, True) (2999, False, True)\n"
    assert "the extra `compile`" in done.stderr
    assert "is left alone" in done.stderr
    assert done.stderr.count("\n") == 1


@with_numba
def test_numba_that_cannot_be_loaded_is_said_in_a_sentence(probe: Path) -> None:
    """As on a machine with too little memory for it: the answer comes all the same."""
    (probe / "numba").mkdir()
    (probe / "numba" / "__init__.py").write_text("raise OSError('libllvmlite.so:\\nfailed to map')", encoding="utf-8")
    done = run("import probe_module as p; print(p.fill(2000))", probe)
    assert done.stdout == "(2000, False, True)\n"
    assert done.stderr.count("\n") == 1
    assert "numba cannot be loaded (libllvmlite.so: failed to map)" in done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="limits the memory of a process by its addresses")
def test_a_set_needs_no_more_than_300_megabytes(tmp_path: Path) -> None:
    """Not even of addresses: numpy's BLAS would set aside some for threads that no matrix here needs.

    In plain Python: to look for numba, as a slow machine does, takes more.
    """
    import resource

    environment = {key: value for key, value in os.environ.items() if not key.endswith("_NUM_THREADS")}
    program = [sys.executable, "-m", "qsbearing"]
    (tmp_path / "pair.toml").write_bytes(subprocess.run([*program, "init", "--set"], capture_output=True).stdout)
    done = subprocess.run(
        [*program, "run", "pair.toml"], capture_output=True, text=True, cwd=tmp_path,
        env=environment | {"PYTHONPATH": os.getcwd(), "NUMBA_DISABLE_JIT": "1"},  # noqa: PTH109
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (300_000_000, 300_000_000)),
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert "Incomplete model" in done.stdout


@with_numba
def test_what_has_no_machine_code_is_compiled_for_many_cases(probe: Path) -> None:
    """In one call, or in all so far; each entry counts its own. Another process finds it in the cache."""
    code = "import probe_module as p; print(p.fill(10), p.fill(989), p.fill(1), p.fill(1)); print(p.fill(10**6))"
    first, again = (run(code, probe) for _ in range(2))
    assert (
        first.stdout == "(10, False, True) (999, False, True) (999, True, True) (999, True, True)\n(999, True, True)\n"
    )
    assert again.stdout == first.stdout
    assert first.stderr == "qsbearing: compiling probe_module.doubled by numba, a minute\n"
    assert again.stderr == ""
    assert [path.suffix for path in (probe / "cache").rglob("*.nbc")] == [".nbc"]


@with_numba
def test_whoever_measures_compiles_at_once(probe: Path) -> None:
    assert printed("import probe_module as p; print(p.fill(1))", probe, QSBEARING_COMPILED="1") == "(0, True, True)\n"


FORKED = """
import multiprocessing as m, qsbearing as qs
from qsbearing.model.compiler import compiled
scene = qs.load_scene("b218")
load = float(qs.solve(scene).inner.load[0])
compiled._process.lock.acquire()  # as another thread may, when the process is forked
def solved(k):
    return float(qs.solve(scene).inner.load[0])
if __name__ == "__main__":
    print(m.get_context({kind!r}).Pool(2).map(solved, range(4)) == [load] * 4)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
@pytest.mark.filterwarnings("ignore")
def test_a_forked_process_solves(probe: Path) -> None:
    assert printed(FORKED.format(kind="fork"), probe) == "True\n"
