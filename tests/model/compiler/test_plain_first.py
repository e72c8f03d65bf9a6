"""When the kernel runs plain, when it is loaded or compiled, and what a process loads for that.

Each test runs processes of its own, as users do, with an empty cache of their own where nothing else is said.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from qsbearing.model.compiler.compiled import COMPILED

pytestmark = pytest.mark.skipif(not COMPILED, reason="nothing is compiled")

PROBE = """
from qsbearing.model.compiler.compiled import entry, kernel

@kernel
def twice(x):
    return 2.0 * x

@entry
def doubled(x, steps):
    for _ in range(steps):
        x = twice(x) - x
    return twice(x)
"""
"""A module with a kernel of two functions."""

NO_NUMBA = "import sys; sys.modules['numba'] = None; import importlib.util as u; f = u.find_spec\n"
NO_NUMBA += "u.find_spec = lambda name, *a: None if name == 'numba' else f(name, *a)\n"


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


HEAVY = "{'numba', 'llvmlite', 'platformdirs', 'pydantic', 'scipy', 'qsbearing.model.compiler.background_compiler'}"
LOADED = f"print(*sorted({HEAVY} & set(sys.modules)), 'loaded')"


def test_a_bearing_and_a_set_need_no_compiler(tmp_path: Path) -> None:
    """Nor a cache, nor a process beside its own; on a machine however slow."""
    slow = "from qsbearing.model.compiler import compiled; compiled.LOADING = 60.0\n"
    (tmp_path / "pair.toml").write_text(printed(command("init --set"), tmp_path), encoding="utf-8")
    for what in ("b218", tmp_path / "pair.toml"):
        assert printed(slow + command(f"run {what}") + LOADED, tmp_path).endswith("\nloaded\n")
    assert not (tmp_path / "cache").exists()


def test_without_numba_cases_and_sets_are_solved(tmp_path: Path) -> None:
    """A batch too, and it says what would make it faster."""
    assert "14.7578" in printed(NO_NUMBA + command("run b218"), tmp_path)
    code = (
        "import numpy as np; from qsbearing.model.compiler import threads; from qsbearing.model.contact import hertz\n"
    )
    code += "work = lambda part: hertz._ellipse(0, 1.0, 2.0, 1.0)\nthreads.in_threads(work, 2000, 1)\nprint('done')"
    done = run(NO_NUMBA + code, tmp_path)
    assert done.stdout == "done\n"
    assert "pip install numba" in done.stderr
    assert done.stderr.count("\n") == 1


def test_numba_that_cannot_be_loaded_is_said_in_a_sentence(probe: Path) -> None:
    """As on a machine with too little memory for it: the answer comes all the same."""
    (probe / "numba").mkdir()
    (probe / "numba" / "__init__.py").write_text("raise OSError('libllvmlite.so:\\nfailed to map')", encoding="utf-8")
    done = run("import probe_module as p; print(p.doubled(3.0, 9))", probe, QSBEARING_COMPILED="1")
    assert done.stdout == "6.0\n"
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


SPEND = """
import sys, probe_module as p
from qsbearing.model.compiler import compiled
compiled.LOADING, compiled.LOADING_MORE, compiled.COMPILING = {prices}
while not p.doubled.is_compiled and compiled._process.plain < {most}:
    p.doubled(3.0, 1000)
print(p.doubled.is_compiled, compiled._process.plain >= {least}, 'numba' in sys.modules, p.doubled(3.0, 9))
"""


def test_it_is_compiled_when_plain_python_has_taken_as_long_as_that_may_take(probe: Path) -> None:
    """And loaded, in another process, when it has taken as long as loading."""
    first = SPEND.format(prices=(0.02, 0.02, 0.2), most=2.0, least=0.2)
    assert printed(first, probe) == "True True True 6.0\n"
    second = SPEND.format(prices=(0.02, 0.02, 10.0), most=0.5, least=0.02)
    assert printed(second, probe) == "True True True 6.0\n"
    never = SPEND.format(prices=(10.0, 10.0, 10.0), most=0.1, least=0.1)
    assert printed(never, probe) == "False True False 6.0\n"


def test_what_is_known_to_come_counts_as_taken(probe: Path) -> None:
    """Of many cases the first alone runs plain where the others would take too long, and none of very many."""
    code = """
import probe_module as p
from qsbearing.model.compiler import compiled, threads
compiled.LOADING = compiled.LOADING_MORE = compiled.COMPILING = {price}
done = []
def work(part):
    p.doubled(3.0, 1000 * (part.stop - part.start))
    done.append((part.stop - part.start, p.doubled.is_compiled))
threads.in_threads(work, {count}, 1)
print(done)
"""
    assert printed(code.format(count=900, price=0.02), probe) == "[(1, False), (1, True), (898, True)]\n"
    assert printed(code.format(count=1000, price=9.0), probe) == "[(1000, True)]\n"
    few = eval(printed(code.format(count=9, price=9.0), probe))
    assert few == [(1, False), (1, False), (2, False), (4, False), (1, False)]


BACKGROUND = """
import time, probe_module as p
from qsbearing.model.compiler import compiled, background_compiler
compiled.LOADING = 0.0
compiled.compile_in_background()
assert p.doubled(3.0, 9) == 6.0
{then}
began = time.monotonic()
while not p.doubled.is_compiled and time.monotonic() < began + {most}:
    time.sleep(0.05)
    p.doubled(3.0, 9)
print(p.doubled.is_compiled, background_compiler._Compiler.process.wait(60))
"""


def test_a_second_process_compiles_what_is_then_used(probe: Path) -> None:
    assert printed(BACKGROUND.format(then="", most=300), probe) == "True 0\n"
    assert [path.suffix for path in (probe / "cache").rglob("*.kernel")] == [".kernel"]


def test_a_compiler_that_is_killed_leaves_plain_python(probe: Path) -> None:
    """No half file is taken for a whole one, and nothing is said."""
    killed = "time.sleep(0.3); background_compiler._Compiler.process.kill()"
    done = run(BACKGROUND.format(then=killed, most=1.0), probe)
    assert done.stdout == f"False {-signal.SIGKILL}\n"
    assert done.stderr == ""
    assert list((probe / "cache").rglob("*.kernel")) == []


def test_no_process_is_started_where_that_is_forbidden(probe: Path) -> None:
    code = BACKGROUND.format(then="", most=0.2).rpartition("print")[0] + "print(background_compiler._Compiler.process)"
    assert printed(code, probe, QSBEARING_BACKGROUND_COMPILER="0") == "None\n"


@pytest.mark.parametrize("begin", ["repr", "app"])
def test_notebooks_and_the_app_compile_in_the_background(tmp_path: Path, begin: str) -> None:
    """Whoever else imports the package does not."""
    code = "import qsbearing as qs; from qsbearing.model.compiler.compiled import _process as p\n"
    code += "b = p.compiles_in_background\n"
    shown = "qs.load_scene('b218')._repr_html_()"
    code += shown if begin == "repr" else "from qsbearing.app.server import application; application('b218')"
    assert printed(f"{code}\nprint(b, p.compiles_in_background)", tmp_path) == "False True\n"


FORKED = """
import os, multiprocessing as m, probe_module as p
from qsbearing.model.compiler import compiled
compiled.COMPILING = 0.0
compiled.LOADING = 0.0
p.doubled(3.0, 99999)
compiled._process.lock.acquire()  # as another thread may, when the process is forked
if __name__ == "__main__":
    found = m.get_context({kind!r}).Pool(2).map(p.twice, range(4))
    assert found == [0.0, 2.0, 4.0, 6.0]
    worker = m.get_context({kind!r}).Process(target=p.doubled, args=(3.0, 99999))
    worker.start()
    worker.join(60)
    print(worker.exitcode)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
@pytest.mark.filterwarnings("ignore")
def test_a_forked_process_solves(probe: Path) -> None:
    assert printed(FORKED.format(kind="fork"), probe) == "0\n"
