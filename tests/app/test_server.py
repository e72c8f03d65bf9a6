"""The server of the page: whom it answers, for how long, and how it begins and ends."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import pytest
from click.testing import CliRunner

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

import uvicorn
from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.routing import Route

from qsbearing.app import server, work
from qsbearing.cli import cli
from qsbearing.files.file_errors import SceneFileError, refused
from tests.app.served import asked


@contextmanager
def running(app: Any, host: str = "127.0.0.1") -> Iterator[str]:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.create_server((host, 0), family=family) as place:
        process = uvicorn.Server(uvicorn.Config(app, log_level="warning"))
        thread = threading.Thread(target=process.run, kwargs={"sockets": [place]})
        thread.start()
        try:
            yield f"http://{f'[{host}]' if ':' in host else host}:{place.getsockname()[1]}/"
        finally:
            process.should_exit = True
            thread.join(30.0)


def echo(document: dict[str, Any], label: str) -> dict[str, Any]:
    return {"document": document, "label": label}


def guarded(question: Any, hosts: tuple[str, ...] = server.LOCAL, token: str = "") -> Starlette:
    guard = Middleware(server._Guard, hosts=hosts, token=token)
    return Starlette(routes=[Route("/solve", server._requested(question), methods=["POST"])], middleware=[guard])


QUESTION = {"document": {"a": 1}, "label": ""}


def test_a_question_needs_the_token() -> None:
    with running(guarded(echo, token="secret")) as address:
        for headers in ({}, {"X-Token": "another"}, {"X-Token": "é"}):
            status, told = asked(address, "solve", QUESTION, headers)
            assert status == 403 and "token" in told["errors"][0]["text"]
        assert asked(address, "solve", QUESTION, {"X-Token": "secret"}) == (200, QUESTION)


@pytest.mark.skipif(not socket.has_ipv6, reason="there is no IPv6")
def test_names_of_elsewhere_are_refused_at_every_local_address() -> None:
    for host in ("127.0.0.1", "::1"):
        try:
            with running(guarded(echo), host) as address:
                assert asked(address, "solve", QUESTION)[0] == 200
                port = address.rpartition(":")[2]
                for name in ("elsewhere.example", "[::2]", "", "::1", "[::1].example", "localhost.example"):
                    assert asked(address, "solve", QUESTION, {"Host": f"{name}:{port}"})[0] == 400, name
                for name in ("localhost", "[::1]", "127.0.0.1"):
                    assert asked(address, "solve", QUESTION, {"Host": name})[0] == 200, name
        except OSError:
            pytest.skip(f"{host} is none of this computer's")


@pytest.mark.parametrize(
    "text",
    [
        f'{{"document": {{"operation": {{"speed_rpm": {"9" * 5000}}}}}, "label": ""}}',
        '{"document": {"operation": {"speed_rpm": 1e400}}, "label": ""}',
        '{"document": {"\\ud800": 1}, "label": ""}',
        '{"document": {}, "label": "\\udfff"}',
        '{"document": {}, "label": "", "label": "twice"}',
        json.dumps({"document": {f"key_{i}": 1 for i in range(60_000)}, "label": ""}),
    ],
    ids=["digits", "1e400", "half a key", "half a label", "twice", "60,000 keys"],
)  # fmt: skip
def test_what_no_scene_holds_is_a_bad_question(text: str) -> None:
    with running(guarded(echo)) as address:
        status, told = asked(address, "solve", text.encode())
        assert status == 400 and told["errors"][0]["text"]


def endless(document: dict[str, Any], label: str) -> dict[str, Any]:
    """A question that is answered never; the file that the label names grows while it is worked on. Without a label it
    is answered at once: a process is there."""
    while label:
        with Path(label).open("a", encoding="utf-8") as file:
            file.write(".")
        time.sleep(0.01)
    return {}


def is_going_on(beats: Path, within: float = 0.0) -> bool:
    """Whether the file grows, if need be after some time."""
    until = time.monotonic() + within
    while True:
        before = beats.stat().st_size if beats.exists() else 0
        time.sleep(0.5)
        if (beats.stat().st_size if beats.exists() else 0) > before:
            return True
        if time.monotonic() > until:
            return False


def has_ended(beats: Path) -> bool:
    until = time.monotonic() + 20.0
    while is_going_on(beats) and time.monotonic() < until:
        pass
    return not is_going_on(beats)


def test_work_ends_when_nobody_waits_for_it(tmp_path: Path) -> None:
    beats = tmp_path / "beats"
    with running(guarded(endless)) as address:
        host, port = address.removeprefix("http://").rstrip("/").split(":")
        body = json.dumps({"document": {}, "label": str(beats)})
        with socket.create_connection((host, int(port))) as client:
            head = f"POST /solve HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\n"
            client.sendall(f"{head}Content-Length: {len(body)}\r\n\r\n{body}".encode())
            assert is_going_on(beats, 30.0)
        assert has_ended(beats)


def test_work_ends_after_its_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    beats = tmp_path / "beats"
    with running(guarded(endless)) as address:
        assert asked(address, "solve", {"document": {}, "label": ""})[0] == 200
        monkeypatch.setattr(work, "LONGEST", 3.0)
        status, told = asked(address, "solve", {"document": {}, "label": str(beats)})
        assert status == 503 and "longer than 3 s" in told["errors"][0]["text"]
        assert beats.exists() and has_ended(beats)


def whose(document: dict[str, Any], label: str) -> dict[str, Any]:
    time.sleep(document["s"])
    return {"process": os.getpid()}


def test_what_is_soon_done_does_not_cost_the_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """As an answer is that the next edit makes needless: another process would take longer to start."""
    monkeypatch.setattr(work, "SPARED", 20.0)

    async def ask() -> list[int]:
        first = (await work.answered(whose, {"document": {"s": 0.0}, "label": ""}))["process"]
        with pytest.raises(TimeoutError):
            await asyncio.wait_for(work.answered(whose, {"document": {"s": 0.5}, "label": ""}), 0.1)
        await asyncio.sleep(2.0)
        return [first, (await work.answered(whose, {"document": {"s": 0.0}, "label": ""}))["process"]]

    first, again = asyncio.run(ask())
    assert first == again != os.getpid()


def test_processes_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work, "AT_ONCE", 2)

    async def ask() -> set[int]:
        asked = (work.answered(whose, {"document": {"s": 0.1}, "label": ""}) for _ in range(5))
        return {each["process"] for each in await asyncio.gather(*asked)}

    assert len(asyncio.run(ask())) == 2


def refusing(document: dict[str, Any], label: str) -> dict[str, Any]:
    raise refused("a file", "is wrong", "a cause")


def test_errors_come_back_whole() -> None:
    with pytest.raises(SceneFileError) as raised:
        asyncio.run(work.answered(refusing, QUESTION))
    expected = refused("a file", "is wrong", "a cause")
    assert (raised.value.file, raised.value.errors, str(raised.value)) == ("a file", expected.errors, str(expected))


@pytest.mark.parametrize("host", ["127.0.0.1", "no.such.host.invalid", "203.0.113.1", "a" * 300])
def test_where_it_cannot_serve_it_says_so_and_opens_nothing(host: str, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        ran = CliRunner().invoke(cli, ["app", "b218", "--host", host, "--port", str(port), "--open"])
    assert (ran.exit_code, ran.stdout, opened) == (2, "", [])
    assert "cannot serve there" in ran.stderr and "shows" not in ran.stderr
    assert ("the port is in use" in ran.stderr) == (host == "127.0.0.1")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")
def test_the_address_that_is_printed_is_answered_until_ctrl_c() -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "qsbearing", "app", "b218", "--port", str(port)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as started, ExitStack() as stack:
        stack.callback(started.kill)
        assert started.stderr is not None
        line = next(line for line in started.stderr if "shows" in line)
        address = line.split()[1]
        base, _, token = address.partition("?token=")
        with pytest.raises(HTTPError) as forbidden:
            urlopen(base + "start", timeout=60.0)
        forbidden.value.close()
        with urlopen(Request(base + "start", headers={"X-Token": token}), timeout=60.0) as answer:
            assert json.load(answer)["label"] == ""
        with urlopen(address, timeout=60.0) as page:
            assert token not in page.read().decode()
        started.send_signal(signal.SIGINT)
        assert started.wait(30.0) == 0
        assert "Traceback" not in started.stderr.read()
