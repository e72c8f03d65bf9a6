"""How the tests run: the same examples of hypothesis every time, and one thread for small matrices."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

# Before numpy is loaded: with matrices of some hundred rows the other threads only wait, which costs processor time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Tables are as wide as in a file, whatever the terminal; pytest-xdist sets it in its processes.
os.environ.pop("COLUMNS", None)
# Hundreds of processes are started; each would compile the sources anew.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

import pytest
from hypothesis import find, settings
from hypothesis import strategies as st

from qsbearing.model.compiler import compiled, library
from qsbearing.model.compiler.compiled import has_fast_code
from tests import durations
from tests.drawing import blank, drawing

settings.register_profile(
    "qsbearing", derandomize=True, deadline=None, database=None, max_examples=30 if has_fast_code() else 4
)
settings.load_profile("qsbearing")


def _make_machine_code(config: pytest.Config) -> None:
    """Whoever works on the kernel leaves its machine code behind: for this platform it is made anew, some minutes, once
    for all of pytest's processes."""
    is_to_be = compiled.HAS_NUMBA and (library.ROOT / ".git").exists() and "QSBEARING_LIBRARY" not in os.environ
    if is_to_be and library.found() is None and not hasattr(config, "workerinput"):
        root = Path(__file__).parents[1]
        subprocess.run([sys.executable, "-m", "tests.verification.kernel_library"], cwd=root, check=True)
        library.forget()


_approx = pytest.approx


def _relative_alone(expected: Any, rel: Any = None, abs: Any = None, nan_ok: bool = False) -> Any:
    """`pytest.approx` without its own absolute 1e-12 beside a given `rel`: a compliance in m/N is no larger than that,
    and any would pass."""
    return _approx(expected, rel, 0.0 if rel is not None and abs is None else abs, nan_ok)


pytest.approx = _relative_alone


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--record-durations", action="store_true", help="write tests/durations.json")


def pytest_configure(config: pytest.Config) -> None:
    sys.dont_write_bytecode = False
    # A shell leaves it ignored in the background, and so would each program that a test starts and interrupts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    _make_machine_code(config)
    if config.option.record_durations:
        config.pluginmanager.register(durations.Recorder())
    given = getattr(config, "workerinput", None)
    if given is None and config.getoption("dist", "") == "each":
        config.pluginmanager.register(durations.AllFiles())
    elif given is not None and given["dist"] == "each":
        config.pluginmanager.register(durations.OwnFiles(config, given))


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node: Any) -> None:
    """A process of `-n` is not told by itself."""
    node.workerinput["dist"] = node.config.option.dist


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """`-m quick` does not import files of which it would leave out all."""
    is_test = collection_path.name.startswith("test_") and collection_path.is_file()
    return True if is_test and config.option.markexpr == "quick" and not durations.has_quick(collection_path) else None


def pytest_itemcollected(item: pytest.Item) -> None:
    if durations.is_quick(item):
        item.add_marker("quick")


def pytest_collection_finish() -> None:
    """What is loaded by now stays: Python need not look through it for garbage, which took a twentieth of the time."""
    # hypothesis asks what refers to its random numbers, and is not shown what is frozen: from Python 3.14 on it warns.
    find(st.none(), lambda _: True)
    gc.collect()
    gc.freeze()
    gc.set_threshold(10_000, 20, 20)


@pytest.fixture(scope="session", autouse=True)
def blank_pictures() -> Iterator[None]:
    """Figures are saved as an empty picture, unless a test or fixture draws them."""
    with blank():
        yield


@pytest.fixture
def drawn() -> Iterator[None]:
    """For tests of pictures."""
    with drawing():
        yield
