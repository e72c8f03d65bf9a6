"""The front door: what `import qsbearing as qs` gives."""

from __future__ import annotations

import shutil
import subprocess
import sys
import zipfile
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


ROOT = Path(qs.__file__).parents[1]
NOT_COPIED = shutil.ignore_patterns(".git", ".venv*", ".*_cache", "__pycache__", "built", "dist", "own")


@pytest.mark.heavy
def test_the_wheel_is_small(tmp_path: Path) -> None:
    """With the site: 5 MB, of them 1.0 MB of machine code for five platforms, in place of 216 MB of a compiler, and at
    most 1.25 MB of the site."""
    pytest.importorskip("mkdocs")
    copy = shutil.copytree(ROOT, tmp_path / "copy", ignore=NOT_COPIED)
    subprocess.run([sys.executable, "-m", "qsbearing.site"], cwd=copy, check=True)
    subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", copy, "-w", tmp_path], check=True)
    (wheel,) = tmp_path.glob("*.whl")
    assert wheel.stat().st_size <= 5.0e6
    with zipfile.ZipFile(wheel) as packed:
        site = [each for each in packed.infolist() if each.filename.startswith("qsbearing/site/built/")]
    assert "qsbearing/site/built/index.html" in {each.filename for each in site}
    assert sum(each.compress_size for each in site) <= 1.25e6
