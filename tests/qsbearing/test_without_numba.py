"""Installed from the wheel in an environment of its own, where numba is not installed: everything that users run works,
with the digits of here; nothing is compiled, and nothing kept."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from qsbearing.cli import cli
from qsbearing.model.compiler import library

pytestmark = [
    pytest.mark.heavy,
    pytest.mark.skipif(library.found() is None, reason="there is no machine code for this platform"),
]

PROJECT = Path(__file__).parents[2]
GUIDE = PROJECT / "qsbearing" / "guide"
EXTRAS = "studies,report,mcp"
SCENES = {"spindle.toml": "spindle.md", "tight.toml": "heat.md"}
COMMANDS = [
    "run b218 --json",
    "run spindle.toml --json",
    "heat tight.toml --json",
    "explain b218",
    "sweep b218 --vary speed_rpm=100:9000:500 --vary axial_load_N=1000:20000:200 --out sweep.nc",
    "sweep b218 --samples 10000 --vary axial_load_N=normal(17800,500) -y inner_load_max --out samples.nc",
    "find b218 --vary axial_load_N=1000:40000 --limit outer_max_pressure_MPa<=1500"
    " --maximise effective_stiffness_axial --json",
    "report b218 --out report",
]
ASK = """
import asyncio, sys
from mcp import Client
from mcp.client.stdio import StdioServerParameters

async def ask():
    program = StdioServerParameters(command=sys.executable, args=["-m", "qsbearing", "mcp", "--folder", "."])
    async with Client(program) as client:
        return await client.call_tool("solve", {"scene": "b218"})

print(asyncio.run(ask()).structured_content["iterations"])
"""
LOOKED_AT = """
import atexit, sys
atexit.register(lambda: print("NUMBA", "numba" in sys.modules, file=sys.stderr))
"""
"""In every process of the environment: what it has loaded when it ends."""


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The commands of such an environment."""
    folder = tmp_path_factory.mktemp("environment")
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    found = folder / ("Scripts" if os.name == "nt" else "bin")
    subprocess.run([found / "python", "-m", "pip", "install", "-q", f"{PROJECT}[{EXTRAS}]"], check=True)
    [packages] = folder.glob("**/site-packages")
    assert not list(packages.glob("numba*")) + list(packages.glob("llvmlite*"))
    (packages / "looked_at.py").write_text(LOOKED_AT, encoding="utf-8")
    (packages / "looked_at.pth").write_text("import looked_at\n", encoding="utf-8")
    return found


@pytest.fixture(scope="module")
def work(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the scenes of the guide."""
    folder = tmp_path_factory.mktemp("work")
    for name, page in SCENES.items():
        text = (GUIDE / page).read_text(encoding="utf-8")
        scene = re.findall(rf"^```toml\n# {name}\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)[0]
        (folder / name).write_text(scene, encoding="utf-8")
    return folder


def ended(programs: Path, work: Path, command: list[str | Path]) -> str:
    """What a process prints that knows nothing of this one; its home is empty but for what others keep."""
    home = work / "home"
    home.mkdir(exist_ok=True)
    environment = {"PATH": f"{programs}{os.pathsep}/usr/bin", "HOME": str(home), "MPLBACKEND": "Agg"}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, cwd=work)
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    assert "NUMBA False" in done.stderr
    assert "NUMBA True" not in done.stderr
    assert "compil" not in done.stderr
    assert [path for path in home.rglob("*") if "qsbearing" in path.name or "numba" in path.name] == []
    return done.stdout


def without_times(printed: str) -> Any:
    """The numbers of an answer."""

    def cleaned(found: Any) -> Any:
        if isinstance(found, dict):
            return {key: cleaned(value) for key, value in found.items() if key not in ("seconds", "provenance")}
        return [cleaned(each) for each in found] if isinstance(found, list) else found

    return cleaned(json.loads(printed))


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: " ".join(command.split()[:2]))
def test_commands(programs: Path, work: Path, monkeypatch: pytest.MonkeyPatch, command: str) -> None:
    printed = ended(programs, work, [programs / "qsbearing", *command.split()])
    if "--json" in command:
        monkeypatch.chdir(work)
        here = CliRunner().invoke(cli, command.split())
        assert here.exit_code == 0, here.output
        assert without_times(printed) == without_times(here.stdout)


def test_tools_of_language_models(programs: Path, work: Path) -> None:
    assert ended(programs, work, [programs / "python", "-c", ASK]).strip().isdigit()


def test_pydantic_is_not_part_of_the_core(tmp_path: Path) -> None:
    """Nor anything else than is named in the guide."""
    import tomllib

    project = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    core = {re.split(r"[>=<!]", line)[0] for line in project["dependencies"]}
    assert core == {"numpy", "scipy", "click", "rich", "latex2mathml", "platformdirs"}
