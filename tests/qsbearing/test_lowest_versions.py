"""The lowest versions that pyproject.toml allows, installed in an environment of their own, run what users run."""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.version import Version

from qsbearing.model.compiler.compiled import has_fast_code

PROJECT = Path(__file__).parents[2]
EVERYTHING = ("plot", "frame", "studies", "cluster", "report", "app")
"""What a user of qsbearing alone may choose; ross and fem pin versions that are tried where they are used."""

COMMANDS = {
    (): ["run b218", "explain b218", "guide sets", "init", "run b218 --json", "catalogue"],
    EVERYTHING: [
        "run b218 --plot run.png",
        "explain b218",
        "sweep b218 --vary speed_rpm=0:9000:4 --out sweep.nc",
        "plot sweep.nc --out sweep.png",
        "report b218 --out report",
        "run sweep.nc",
        "figures --out figures",
    ],
}


def lowest(extras: tuple[str, ...]) -> dict[str, Version]:
    """The lowest version of each direct dependency that the bounds of all these extras allow."""
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    found: dict[str, Version] = {}
    for line in sum((project["optional-dependencies"][extra] for extra in extras), project["dependencies"]):
        asked = Requirement(line)
        if asked.name == "qsbearing":
            continue
        [bound] = [Version(each.version) for each in asked.specifier if each.operator == ">="]
        found[asked.name] = max(bound, found.get(asked.name, bound))
    return found


@pytest.mark.heavy
@pytest.mark.skipif(sys.version_info >= (3, 13), reason="the lowest versions have no wheels for newer ones than 3.12")
@pytest.mark.skipif(not has_fast_code(), reason="asked for plain Python")
@pytest.mark.parametrize("extras", COMMANDS, ids=["core", "everything"])
def test_the_lowest_versions_run(tmp_path: Path, extras: tuple[str, ...]) -> None:
    pinned = lowest(extras)
    (tmp_path / "lowest.txt").write_text("".join(f"{name}=={version}\n" for name, version in pinned.items()))
    folder = tmp_path / "environment"
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    programs = folder / ("Scripts" if os.name == "nt" else "bin")
    what = f"{PROJECT}[{','.join(extras)}]" if extras else str(PROJECT)
    install = [programs / "python", "-m", "pip", "install", "-q", "-c", tmp_path / "lowest.txt", what]
    subprocess.run(install, check=True)
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    environment |= {"NUMBA_CACHE_DIR": str(tmp_path / "cache"), "MPLBACKEND": "Agg"}
    failed = {}
    for command in COMMANDS[extras]:
        done = subprocess.run(
            [programs / "qsbearing", *command.split()], capture_output=True, text=True, env=environment, cwd=tmp_path
        )
        if done.returncode != 0 or "Traceback" in done.stderr or "Warning" in done.stderr:
            failed[command] = f"exit {done.returncode}: {done.stderr[-500:]}"
    assert failed == {}
    if "app" in extras:
        served = "from tests.app.served import served, started\nwith served('b218') as address: started(address)"
        subprocess.run([programs / "python", "-c", served], check=True, env=environment, cwd=PROJECT)
    for name in (command.rpartition("--out ")[2] for command in COMMANDS[extras] if "--out" in command):
        assert (tmp_path / name).exists(), name
