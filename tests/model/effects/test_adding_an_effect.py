"""The guide's walk-through, done on a copy of the package: a new effect is one file and one line."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import qsbearing as qs

PACKAGE = Path(qs.__file__).parent
PAGE = (PACKAGE / "guide" / "adding_an_effect.md").read_text(encoding="utf-8")

SCENE = """[bearing]
name = "B218"
ball_count = 5
[operation]
axial_load_N = 5000
[effects.groove_wear]
depth_um = 5
"""

TRIAL = """
import json
import qsbearing as qs
from qsbearing.studies.chooser import explain

scene = qs.load_scene("worn.toml")
found = {}
for name, one in (("worn", scene), ("new", qs.Scene(scene.bearing, scene.operation))):
    (row,) = (row for row in explain.explain(one, 0.01)[1] if row.effect == "groove_wear")
    found[name] = vars(row)
chosen = qs.solve(scene, effects="auto", accuracy=0.9)
found["left_out"] = [each.effect for each in chosen.choice.left_out]
print(json.dumps(found))
"""


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)


def test_one_file_and_one_line_make_an_effect(tmp_path: Path) -> None:
    """Explained, verified, chosen and read from a file, without any other change."""
    copy = tmp_path / "qsbearing"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__", "records"))
    (code,) = blocks("python")
    (copy / "model" / "effects" / "groove_wear.py").write_text(code, encoding="utf-8")
    (line,) = blocks("text")
    file, mark = copy / "model" / "effects" / "__init__.py", '    "centrifugal_force",\n'
    text = file.read_text(encoding="utf-8")
    assert text.count(mark) == 1
    file.write_text(text.replace(mark, line + mark), encoding="utf-8")
    (tmp_path / "worn.toml").write_text(SCENE, encoding="utf-8")
    # Plain Python, as compiling the copy would take longer than all of this.
    environment = {**os.environ, "PYTHONPATH": str(tmp_path), "NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-c", TRIAL]
    done = subprocess.run(command, env=environment, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    worn, new = found["worn"], found["new"]
    assert worn["in_scene"]
    assert worn["verdict"] == "needed"
    for name in ("contact_angle", "load", "displacement", "stiffness"):
        assert 0.5 < worn["predicted"][name] / worn["actual"][name] < 2.0, name
    assert (new["in_scene"], new["verdict"]) == (False, "not assessed")
    assert "depth of wear" in new["why"]
    assert "groove_wear" in found["left_out"]
