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
    code = "import qsbearing.solution.solver, qsbearing as qs\nassert callable(qs.solve), qs.solve\n"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_import_itself_loads_nothing_heavy() -> None:
    code = "import sys, qsbearing\nassert not {'numpy', 'numba', 'scipy', 'pydantic', 'rich'} & set(sys.modules)\n"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


SOLVE_ONCE = """
import qsbearing as qs
from qsbearing import compiled
solution = qs.solve(qs.load_scene("b218"))
print(compiled._BUILDS_PARTS, solution.inner.load.tobytes().hex())
"""


@pytest.mark.heavy
@pytest.mark.skipif(not COMPILED, reason="nothing is compiled")
def test_numba_s_own_pipeline_compiles_to_the_same_digits(tmp_path: Path) -> None:
    """The kernel's parts may be left to numba's ordinary compiler, as they are for versions that were never tried."""
    printed = []
    for plain in ("0", "1"):
        environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / plain), "QSBEARING_PLAIN_NUMBA": plain}
        done = subprocess.run(
            [sys.executable, "-c", SOLVE_ONCE], capture_output=True, text=True, check=True, env=environment
        )
        printed.append(done.stdout.split())
    assert [builds for builds, _ in printed] == ["True", "False"]
    assert printed[0][1] == printed[1][1]


ENTRY = """
from qsbearing.compiled import entry

@entry
def doubled(x: float) -> float:
    return 2.0 * x
"""


@pytest.mark.skipif(not COMPILED, reason="nothing is compiled")
@pytest.mark.parametrize("kind", ["nbi", "nbc"])
def test_a_damaged_file_of_the_cache_is_compiled_anew(tmp_path: Path, kind: str) -> None:
    """Index or machine code cut short: said once, and the next start finds a sound copy."""
    (tmp_path / "probe.py").write_text(ENTRY, encoding="utf-8")
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    command = [sys.executable, "-c", "import probe; print(probe.doubled(3.0))"]

    def run() -> subprocess.CompletedProcess[str]:
        return subprocess.run(command, capture_output=True, text=True, check=True, env=environment, cwd=tmp_path)

    assert run().stdout == "6.0\n"
    kept = list((tmp_path / "cache").rglob(f"*.{kind}"))
    assert len(kept) == 1
    kept[0].write_bytes(kept[0].read_bytes()[:100])
    damaged, again = run(), run()
    assert damaged.stdout == again.stdout == "6.0\n"
    assert "damaged" in damaged.stderr
    assert "Traceback" not in damaged.stderr
    assert again.stderr == ""
