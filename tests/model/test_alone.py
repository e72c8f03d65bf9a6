"""The model alone: copied to an empty folder it solves, and needs nothing but numpy and scipy."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import qsbearing as qs
from qsbearing.files.file_keys import numbers, set_numbers, thermal_numbers

CODE = """
import sys
before = set(sys.modules)  # what an environment loads at its start
from qsbearing.model.effects import CentrifugalForce, GyroscopicMoment
from qsbearing.model.material import STEEL
from qsbearing.model.bearing import BallBearing
from qsbearing.model.operation import Operation
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solver import solve
from qsbearing.model.units import deg, mm, rpm

bearing = BallBearing(16, 22.225 * mm, 125.26 * mm, 11.6281 * mm, 11.6281 * mm, 40 * deg, STEEL, STEEL)
effects = (CentrifugalForce(), GyroscopicMoment())
operation = Operation(speed=10_000 * rpm, axial_load=17_800.0)
scene = Scene(bearing, operation, ball_effects=effects, raceway_control="outer")
solution = solve(scene)
print(repr(float(solution.inner.load[0])), repr(float(solution.outer.angle[0])), solution._repr_html_())
new = [name for name in set(sys.modules) - before if getattr(sys.modules[name], "__file__", None)]
packages = {name.partition(".")[0] for name in new}
print(*sorted(packages - sys.stdlib_module_names))
try:
    solution.to_ross(1)
except AttributeError as error:
    print(error)
"""


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """What a process says that knows the model only."""
    folder = tmp_path_factory.mktemp("alone")
    package = folder / "qsbearing"
    shutil.copytree(Path(qs.__file__).parent / "model", package / "model", ignore=shutil.ignore_patterns("__pycache__"))
    (package / "__init__.py").touch()
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    environment.pop("QSBEARING_COMPILED", None)
    command = [sys.executable, "-c", CODE]
    done = subprocess.run(command, env=environment, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_it_solves_b218_to_the_digit(printed: list[str]) -> None:
    whole = qs.solve(qs.load_scene("b218"))
    assert printed[0] == f"{float(whole.inner.load[0])!r} {float(whole.outer.angle[0])!r} None"


def test_it_imports_numpy_and_scipy_only(printed: list[str]) -> None:
    assert set(printed[1].split()) <= {"numpy", "scipy", "qsbearing"}


def test_what_is_done_above_is_not_there(printed: list[str]) -> None:
    assert printed[2] == "module 'qsbearing' has no attribute 'ross_element'"


NAMES_OF_RESULTS = "result_keys.py"
"""Some lengths of the bearing are results as well, and spelled as such."""
COLUMNS = {"azimuth_deg"}
"""Of balls in tables; that of a gear's mesh has the same name."""


def test_it_holds_no_key_of_a_file() -> None:
    """Names and units stand at the fields; only `files/` puts them together."""
    tables = [*numbers().values(), *set_numbers().values(), *thermal_numbers().values()]
    keys = {key.name for table in tables for key in table if key.field in key.name and key.field != key.name}
    assert len(keys) > 100
    files = [each for each in (Path(qs.__file__).parent / "model").rglob("*.py") if each.name != NAMES_OF_RESULTS]
    spelled = {
        each.name: (keys - COLUMNS) & {*re.findall(r"[\w.]+", each.read_text(encoding="utf-8"))} for each in files
    }
    assert not {name: words for name, words in spelled.items() if words}
