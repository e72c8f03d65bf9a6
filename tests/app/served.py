"""The page as it is served: a real server on a port of this computer, for as long as a test needs it."""

from __future__ import annotations

import json
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import uvicorn

from qsbearing.app.server import application


@contextmanager
def served(source: str) -> Iterator[str]:
    """Its address."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    server = uvicorn.Server(uvicorn.Config(application(source), host="127.0.0.1", port=port, log_level="warning"))
    thread = threading.Thread(target=server.run)
    thread.start()
    until = time.monotonic() + 60.0
    while not server.started and time.monotonic() < until:
        time.sleep(0.02)
    try:
        yield f"http://127.0.0.1:{port}/"
    finally:
        server.should_exit = True
        thread.join(30.0)


def asked(address: str, question: str, given: Any, headers: dict[str, str] | None = None) -> tuple[int, Any]:
    """The status of an answer, and what it holds.

    Args:
        given: its arguments, or bytes as they are.
    """
    data = given if isinstance(given, bytes) else json.dumps(given).encode()
    request = Request(address + question, data, {"Content-Type": "application/json", **(headers or {})})
    try:
        with urlopen(request, timeout=120.0) as answer:
            return answer.status, json.load(answer)
    except HTTPError as error:
        with error:
            text = error.read().decode()
        return error.code, json.loads(text) if text.startswith("{") else text


def started(address: str) -> dict[str, Any]:
    """The scene that a page begins with, as its questions give it back."""
    with urlopen(address + "start", timeout=120.0) as answer:
        found = json.load(answer)
    return {"document": found["document"], "label": found["label"]}
