"""Every way into the program: what it reads when all is well, and how it is asked to read that."""

from __future__ import annotations

import asyncio
import contextlib
import io
import json
import os
import shutil
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple
from unittest import mock

from qsbearing import cli
from qsbearing.cli import ended
from qsbearing.files.catalogue import find
from qsbearing.files.table import read_table
from qsbearing.files.template import set_template
from qsbearing.studies.design.point_table import table_bytes
from tests.files.rexs.models import b218, json_text, xml, zipped

SCENE = '[bearing]\nname = "B218"\n[operation]\nspeed_rpm = 0\naxial_load_N = 1000\n'
STUDY = SCENE + '[vary]\nspeed_rpm = [0, 500]\n[study]\nquantities = ["inner_max_pressure"]\n'
SPECTRUM = (
    '[bearing]\nname = "B218"\n[readings.life]\n'
    "[[spectrum]]\nshare = 0.5\nspeed_rpm = 100\naxial_load_N = 1000\n"
    "[[spectrum]]\nshare = 0.5\nspeed_rpm = 200\naxial_load_N = 2000\n"
)
POINTS = "name,speed_rpm,axial_load_N\nslow,100,1000\nfast,2000.5,2000\n"


class Answer(NamedTuple):
    """How a command ended."""

    code: int
    out: str
    error: str


class Door(NamedTuple):
    """One way in."""

    name: str
    """Of the file, with its ending."""
    arguments: Callable[[Path], list[object]]
    """Of the command that reads it."""
    limit: int
    """Bytes; more are not read."""


DOORS = {
    "scene": Door("scene.toml", lambda path: ["run", path], 1_000_000),
    "set": Door("set.toml", lambda path: ["run", path], 1_000_000),
    "study": Door("study.toml", lambda path: ["sweep", path], 1_000_000),
    "spectrum": Door("spectrum.toml", lambda path: ["run", path], 1_000_000),
    "points csv": Door("points.csv", lambda path: points(path), 100_000_000),
    "points xlsx": Door("points.xlsx", lambda path: points(path), 20_000_000),
    "points parquet": Door("points.parquet", lambda path: points(path), 100_000_000),
    "result json": Door("result.json", lambda path: ["run", path], 50_000_000),
    "result nc": Door("result.nc", lambda path: ["run", path], 0),
    "study nc": Door("result.nc", lambda path: ["sweep", path], 0),
    "rexs xml": Door("model.rexs", lambda path: ["import", path, "--out", path.with_name("made")], 20_000_000),
    "rexs json": Door("model.rexsj", lambda path: ["import", path, "--out", path.with_name("made")], 20_000_000),
    "rexs zip": Door("model.rexsz", lambda path: ["import", path, "--out", path.with_name("made")], 20_000_000),
    "plot nc": Door("result.nc", lambda path: ["plot", path, "--out", path.with_name("out.svg")], 0),
}


def points(path: Path) -> list[object]:
    """The command that solves a scene at each row of a table."""
    return ["run", "b218", "--points", path, "--out", path.with_name("out.csv")]


def answered(arguments: list[object], given: bytes | None = None) -> Answer:
    """A command as the console runs it, in this process; a defect is shown with its traceback.

    Args:
        given: what stands on standard input.
    """
    out, error = io.StringIO(), io.StringIO()
    stdin = io.TextIOWrapper(io.BytesIO(given or b""))
    with (
        mock.patch.object(sys, "argv", ["qsbearing", *map(str, arguments)]),
        mock.patch.object(sys, "stdin", stdin),
        mock.patch.object(signal, "signal"),
        mock.patch.dict(os.environ, {ended.TRACEBACK: "1"}),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(error),
    ):
        try:
            cli.main()
        except SystemExit as stopped:
            return Answer(int(stopped.code or 0), out.getvalue(), error.getvalue())
    raise AssertionError("the command has not ended")


def good_files(folder: Path) -> dict[str, bytes]:
    """What each file of a door holds when all is well, by its name; and what a run that was interrupted left."""
    entry = find("7210C")
    assert entry is not None
    texts = {"scene.toml": SCENE, "set.toml": set_template(entry), "study.toml": STUDY}
    texts |= {"spectrum.toml": SPECTRUM, "points.csv": POINTS}
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    columns: dict[str, list[Any]] = {
        name: cells if name == "name" else [*map(float, cells)]
        for name, cells in read_table(folder / "points.csv").items()
    }
    model = b218(contacts=False)
    for ending, data in {"": xml(model), "j": json_text(model), "z": zipped(xml(model))}.items():
        (folder / f"model.rexs{ending}").write_bytes(data)
    for ending in (".xlsx", ".parquet"):
        (folder / f"points{ending}").write_bytes(table_bytes(columns, ending))
    printed = answered(["run", folder / "scene.toml", "--json"])
    (folder / "result.json").write_text(printed.out)
    json.loads(printed.out)
    swept = answered(["sweep", folder / "study.toml", "--out", folder / "result.nc"])
    assert swept.code == 0, swept.error
    with mock.patch("qsbearing.studies.store.Store.join", side_effect=KeyboardInterrupt):
        answered(["sweep", folder / "study.toml", "--out", folder / "left.nc"])
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


PARTS = "left.nc.parts"
"""What an interrupted sweep leaves in its folder."""


def left(folder: Path) -> dict[str, bytes]:
    """The files there."""
    return {path.name: path.read_bytes() for path in (folder / PARTS).iterdir()}


def resumed(folder: Path, parts: dict[str, bytes]) -> Answer:
    """A sweep that goes on from such files."""
    emptied(folder)
    (folder / "study.toml").write_text(STUDY)
    (folder / PARTS).mkdir()
    for name, data in parts.items():
        (folder / PARTS / name).write_bytes(data)
    return answered(["sweep", folder / "study.toml", "--out", folder / "left.nc", "--resume"])


class Page:
    """The page of an application, asked without a network."""

    def __init__(self, app: Any) -> None:
        self.app = app

    def asked(self, question: str, body: bytes) -> tuple[int, Any]:
        """The status of an answer, and what it holds."""
        sent: list[dict[str, Any]] = []
        received = iter([{"type": "http.request", "body": body, "more_body": False}])

        async def receive() -> dict[str, Any]:
            for message in received:
                return message
            await asyncio.Event().wait()
            raise AssertionError

        async def send(message: dict[str, Any]) -> None:
            sent.append(message)

        headers = [(b"host", b"localhost"), (b"content-type", b"application/json")]
        scope = {"type": "http", "method": "POST", "path": f"/{question}", "headers": headers, "query_string": b""}
        asyncio.run(self.app({**scope, "root_path": "", "scheme": "http"}, receive, send))
        text = b"".join(message.get("body", b"") for message in sent[1:])
        return sent[0]["status"], json.loads(text)


def judged(answer: Answer, what: str) -> None:
    """An answer, or a refusal in sentences: no traceback, nothing on the wrong stream."""
    assert answer.code in (0, 1, 2), f"{what}: {answer.code}\n{answer.error[-3000:]}"
    assert "Traceback" not in answer.error, f"{what}\n{answer.error[-3000:]}"
    if answer.code == 2:
        assert answer.error.startswith("qsbearing: "), f"{what}: {answer.error}"
        assert not answer.out, f"{what}: {answer.out}"


def emptied(folder: Path) -> Path:
    """The folder, empty."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder
