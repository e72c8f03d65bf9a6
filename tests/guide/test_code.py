"""The page on the code: the way of a scene to its table is the one that a run takes."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import qsbearing

ROOT = Path(qsbearing.__file__).parent
PAGE = (ROOT / "guide" / "code.md").read_text(encoding="utf-8")
STEPS = re.findall(r"^\d+\. `([\w/]+\.py)` `(\w+)`", PAGE, re.MULTILINE)

FOLLOWED = """
import sys
steps, root = {steps!r}, {root!r}
seen = []
def look(frame, event, argument):
    code = frame.f_code
    if event == "call" and code.co_filename.startswith(root):
        step = code.co_filename[len(root) + 1:].replace("\\\\", "/"), code.co_name
        if step in steps and step not in seen:
            seen.append(step)
from qsbearing.cli import cli
sys.setprofile(look)
cli(["run", "b218"], standalone_mode=False)
sys.setprofile(None)
print([steps.index(step) for step in seen], file=sys.stderr)
"""


def test_a_run_goes_the_way_that_the_page_tells() -> None:
    assert 10 < len(STEPS) <= 14
    code = FOLLOWED.format(steps=STEPS, root=str(ROOT))
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=False)
    assert done.stderr.strip() == str(list(range(len(STEPS)))), done.stderr
