"""The front door: what `import qsbearing as qs` gives."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import qsbearing as qs
from qsbearing.compiled import COMPILED


def test_every_public_name_is_there() -> None:
    for name in qs.__all__:
        assert getattr(qs, name) is not None
    assert set(qs.__all__) <= set(dir(qs))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        qs.nothing  # noqa: B018


def test_solve_is_the_function_whatever_was_imported_before() -> None:
    code = "import qsbearing.solving, qsbearing as qs\nassert callable(qs.solve), qs.solve\n"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_import_itself_loads_nothing_heavy() -> None:
    code = "import sys, qsbearing\nassert not {'numpy', 'numba', 'scipy', 'pydantic', 'rich'} & set(sys.modules)\n"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


SOLVE_ONCE = """
import numba
numba.version_info = {version}
import qsbearing as qs
from qsbearing import compiled
solution = qs.solve(qs.load_scene("b218"))
print(compiled._PARTS_ARE_KNOWN, solution.inner.load.tobytes().hex())
"""


@pytest.mark.heavy
@pytest.mark.skipif(not COMPILED, reason="nothing is compiled")
def test_a_numba_never_tried_compiles_to_the_same_digits(tmp_path: Path) -> None:
    """Its inner life may be another, so the kernel's parts are left to its ordinary compiler."""
    told = []
    for version in ("numba.version_info", "(99, 0)"):
        done = subprocess.run(
            [sys.executable, "-c", SOLVE_ONCE.format(version=version)],
            capture_output=True,
            text=True,
            check=True,
            env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / version)},
        )
        told.append(done.stdout.split())
    assert [known for known, _ in told] == ["True", "False"]
    assert told[0][1] == told[1][1]
