"""How commands end: codes tell bad input, signals, a full disk and our own defects apart, without a traceback."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
import pytest

from fem_check import cli as fem_cli
from qsbearing import cli
from qsbearing.cli import ended
from qsbearing.cli.output import BAD_INPUT, NOT_MET, SOLVED, UNSOLVED
from qsbearing.files import catalogue
from qsbearing.files.file_errors import refused
from tests.guide.pages import GUIDE

Ended = tuple[int, str, str]


@pytest.fixture
def end(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Callable[..., Ended]:
    """Run a command as the console does; exit code, standard output and error."""
    monkeypatch.setattr(signal, "signal", lambda *_: None)  # the tests' own stay
    monkeypatch.delenv(ended.TRACEBACK, raising=False)

    def run(*arguments: object, main: Callable[[], Any] = cli.main) -> Ended:
        monkeypatch.setattr(sys, "argv", ["command", *map(str, arguments)])
        with pytest.raises(SystemExit) as stopped:
            main()
        shown = capsys.readouterr()
        assert isinstance(stopped.value.code, int)
        return stopped.value.code, shown.out, shown.err

    return run


def raising(error: BaseException) -> Callable[..., Any]:
    def raise_it(*_: Any, **__: Any) -> Any:
        raise error

    return raise_it


COMMANDS = {
    "run": ["run", "b218"],
    "points": ["run", "b218", "--points", "points.csv", "--out", "out.csv"],
    "explain": ["explain", "b218"],
    "find": ["find", "b218", "--vary", "axial_load_N=1:9", "--minimise", "inner.max_pressure_MPa"],
    "compare": ["compare", "b218", "7210C"],
    "heat": ["heat", "b218"],
    "sweep": ["sweep", "b218", "--vary", "axial_load_N=1,2"],
    "stiffness": ["stiffness", "b218"],
    "table": ["table", "b218"],
    "report": ["report", "b218", "--out", "folder"],
    "init": ["init", "b218"],
    "catalogue": ["catalogue", "b218"],
}


@pytest.mark.parametrize("command", COMMANDS)
def test_an_interrupted_command_ends_with_130(
    command: str, end: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("points.csv").write_text("axial_load_N\n100\n")
    monkeypatch.setattr(catalogue, "find", raising(KeyboardInterrupt()))
    code, _, said = end(*COMMANDS[command])
    assert code == 130
    assert said == "qsbearing: interrupted\n"
    assert [path.name for path in tmp_path.iterdir()] == ["points.csv"]


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        (ZeroDivisionError("by \x1b[31m\nzero"), 70, r"(ZeroDivisionError: by \x1b[31m, test_ends.py line"),
        (RecursionError(), 70, "(RecursionError, "),
        (FileNotFoundError(2, "No such file", "part of the package"), 70, "a defect of this program"),
        (OSError(28, "No space left on device", "cache"), 2, "qsbearing: cache: No space left on device\n"),
        (MemoryError(), 2, "not enough memory"),
        (refused("my.toml", "is wrong"), 2, "is wrong"),
        (click.FileError("my.toml", "is gone"), 2, "is gone"),
        (click.Abort(), 130, "interrupted"),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, Exception) else "",
)
@pytest.mark.parametrize("name", ["qsbearing", "fem-check"])
def test_what_no_command_expects_has_its_own_code_and_a_sentence(
    name: str, error: Exception, code: int, words: str, end: Callable[..., Ended], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ended, "OWN", (str(Path(__file__).parent),))
    group, main = (cli.cli, cli.main) if name == "qsbearing" else (fem_cli.cli, fem_cli.main)
    monkeypatch.setitem(group.commands, "fails", click.Command("fails", callback=raising(error)))
    found, out, said = end("fails", main=main)
    assert (found, out) == (code, "")
    assert words.replace("qsbearing", name) in said
    assert "Traceback" not in said and "\x1b" not in said
    if code == 70:
        assert "report it" in said and f"{ended.TRACEBACK}=1" in said
        monkeypatch.setenv(ended.TRACEBACK, "1")
        assert "Traceback" in end("fails", main=main)[2]


def test_the_guide_has_every_code() -> None:
    section = (GUIDE / "how_to.md").read_text(encoding="utf-8").partition("## Exit codes\n")[2].partition("\n## ")[0]
    told = [int(code) for code in re.findall(r"\d+", " ".join(re.findall(r"^\| ([\d, ]+) \|", section, re.MULTILINE)))]
    assert told == [SOLVED, UNSOLVED, BAD_INPUT, NOT_MET, ended.DEFECT, 128 + signal.SIGINT, 128 + signal.SIGTERM]
    assert ended.TRACEBACK in section


def test_no_argument_shows_the_help_as_it_is(end: Callable[..., Ended]) -> None:
    code, out, said = end()
    assert "\n  run " in out + said and "\\n" not in out + said
    assert code in (0, 2)  # by version of click


WAITS = """
import sys, time
from qsbearing.cli.output import BAD_INPUT, SOLVED, UNSOLVED
from qsbearing.files import catalogue
catalogue.find = lambda name: (print("at work", flush=True), time.sleep(60))
sys.argv = ["qsbearing", "init", "b218"]
from qsbearing.cli import main
main()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_has_its_code(number: int, code: int) -> None:
    started = subprocess.Popen([sys.executable, "-c", WAITS], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert started.stdout is not None and started.stdout.readline() == "at work\n"
    started.send_signal(number)
    _, said = started.communicate(timeout=120)
    assert started.returncode == code
    assert "Traceback" not in said


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
@pytest.mark.parametrize(
    ("arguments", "output", "code", "words"),
    [
        ("qsbearing guide", ">/dev/full", 2, "qsbearing: standard output: No space left on device"),
        ("qsbearing --help", ">/dev/full", 2, "qsbearing: standard output: No space left on device"),
        ("qsbearing init", ">&-", 2, "qsbearing: standard output is closed: results cannot be shown"),
        ("qsbearing init none", "2>/dev/full", 2, ""),
        ("qsbearing init none", "2>&-", 2, ""),
        ("qsbearing --help", "| true; exit ${PIPESTATUS[0]}", 0, ""),
        ("fem_check --help", ">/dev/full", 2, "fem-check: standard output: No space left on device"),
        ("fem_check run none", "2>/dev/full", 2, ""),
    ],
)
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_an_output_that_takes_nothing_is_told_in_a_sentence(
    arguments: str, output: str, code: int, words: str, unbuffered: str
) -> None:
    command = f"'{sys.executable}' -m {arguments} {output}"
    environment = os.environ | {"PYTHONUNBUFFERED": unbuffered}  # Python takes "" as not set
    ran = subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=120, env=environment)
    assert (ran.returncode, ran.stderr.strip()) == (code, words)
