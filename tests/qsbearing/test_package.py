"""The front door: what `import qsbearing as qs` gives."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import qsbearing as qs


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


@pytest.mark.heavy
def test_the_wheel_is_small(tmp_path: Path) -> None:
    """2.9 MB, and 1.0 MB of machine code for five platforms, in place of 216 MB of a compiler. A third of that is the
    balance of balls that friction moves, between grooves of one arc and of two. With the site, if it has been made, it
    is 1.4 MB more."""
    root = Path(qs.__file__).parents[1]
    subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", root, "-w", tmp_path], check=True)
    (wheel,) = tmp_path.glob("*.whl")
    assert wheel.stat().st_size <= 4.1e6
