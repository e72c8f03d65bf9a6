"""The page and its answers over HTTP. Nothing is read but what is asked, nothing written, nothing kept.

Starlette with uvicorn takes 6 MB of disk; NiceGUI 105, Dash 144, Panel 369, Streamlit 473. What they would add,
sliders, fields, tables and switches, the browser has, for keyboards and telephones too.
"""

from __future__ import annotations

import asyncio
import secrets
import socket
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager, suppress
from inspect import signature
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.datastructures import Headers, MutableHeaders
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from qsbearing.app import answers, exports, maps, required
from qsbearing.app.work import StoppedError, answered, prepare
from qsbearing.documents.html import TEMPLATES
from qsbearing.files.file_errors import MOST_SHOWN, refused
from qsbearing.files.json_text import parsed
from qsbearing.files.limits import LARGEST_FILE, MOST_KEYS
from qsbearing.model.validation import SceneError

PAGE = Path(__file__).parent / "page"
LOCAL = ("127.0.0.1", "localhost", "::1")
EVERYWHERE = {"0.0.0.0": "127.0.0.1", "::": "::1"}
"""Addresses that stand for all of this computer's, and one of them."""
HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "connect-src 'self'; img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}
QUESTIONS: dict[str, Callable[..., answers.Answer]] = {
    "open": answers.opened,
    "check": answers.checked,
    "show": answers.shown,
    "bearing": answers.of_bearing,
    "solve": answers.solved,
    "picture": answers.pictured,
    "rest": answers.detailed,
    "effects": answers.effects,
    "switch": answers.switched,
    "way": answers.put_way,
    "results": required.names,
    "save": answers.saved,
    "report": exports.report,
    "table": exports.table,
    "map_choices": maps.choices,
    "map_values": maps.values,
}
ARGUMENTS: dict[str, type | tuple[type, ...]] = {
    **dict.fromkeys(("label", "text", "name", "effect", "channel", "way", "result"), str),
    **dict.fromkeys(("x", "y", "xs", "ys"), list),
    **{"document": dict, "is_on": bool, "row": int, "value": (int, float, type(None))},
}


def application(
    source: str, hosts: tuple[str, ...] = LOCAL, token: str = "", settings: Sequence[tuple[str, Any]] = ()
) -> Starlette:
    """The page, beginning with a scene.

    Args:
        source: its file or catalogue name, read once, now.
        hosts: names under which a browser may ask for it; "*": any.
        token: what every question must bring, so that no other user of the computer reads the scene; empty: nothing.
        settings: keys of the scene, and the values that they take instead.

    Raises:
        SceneFileError: everything that is wrong with the scene.
    """
    first = answers.start(source, settings)
    warm = {"document": first["document"], "label": first["label"]}

    @asynccontextmanager
    async def prepared(app: Starlette) -> AsyncIterator[None]:
        preparing = asyncio.ensure_future(prepare(answers.solved, warm))  # the drawing is loaded before somebody waits
        yield
        preparing.cancel()
        await asyncio.wait([preparing])

    async def start(request: Request) -> Response:
        return JSONResponse(first)

    routes = [Route(f"/{name}", _requested(question), methods=["POST"]) for name, question in QUESTIONS.items()]
    pages = [Mount("/documents", StaticFiles(directory=TEMPLATES)), Mount("/", StaticFiles(directory=PAGE, html=True))]
    guard = Middleware(_Guard, hosts=hosts, token=token)
    return Starlette(routes=[Route("/start", start), *routes, *pages], middleware=[guard], lifespan=prepared)


def serve(
    source: str, host: str, port: int, ready: Callable[[str], None], settings: Sequence[tuple[str, Any]] = ()
) -> None:
    """Serve until interrupted.

    Args:
        ready: called with the page's address, which only this server answers, before the first question.
        settings: as for `application`.

    Raises:
        SceneFileError: the address cannot be served on, or what is wrong with the scene.
    """
    import uvicorn

    token = secrets.token_urlsafe(16)
    with _listening(host, port) as place:
        app = application(source, LOCAL if host in LOCAL else ("*",), token, settings)
        name = EVERYWHERE.get(host, host)
        shown = f"[{name}]" if ":" in name else name
        ready(f"http://{shown}:{place.getsockname()[1]}/?token={token}")
        config = uvicorn.Config(app, log_level="warning", limit_concurrency=200, timeout_graceful_shutdown=2)
        with suppress(KeyboardInterrupt):
            uvicorn.Server(config).run(sockets=[place])


def _listening(host: str, port: int) -> socket.socket:
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        return socket.create_server((host, port), family=family)
    except (OSError, UnicodeError, OverflowError) as error:
        cause = "Choose another --port, or end the program that uses this one" if _is_taken(error) else ""
        problem = "the port is in use" if cause else getattr(error, "strerror", None) or str(error)
        raise refused(f"--host {host} --port {port}", f"cannot serve there: {problem}", cause) from None


def _is_taken(error: Exception) -> bool:
    import errno

    return isinstance(error, OSError) and error.errno == errno.EADDRINUSE


class _Guard:
    """Refuses pages of other names for this address, and questions without the token; adds the headers of `HEADERS`."""

    def __init__(self, app: ASGIApp, hosts: tuple[str, ...], token: str) -> None:
        self.app, self.hosts, self.token = app, hosts, token.encode()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(HEADERS)
            await send(message)

        refusal = self._refusal(scope["path"].strip("/"), Headers(scope=scope))
        await (refusal or self.app)(scope, receive, with_headers)

    def _refusal(self, path: str, headers: Headers) -> Response | None:
        if "*" not in self.hosts and _name_in(headers.get("host", "")) not in self.hosts:
            return _refused("this name is not one of the page's", 400)
        given = headers.get("x-token", "").encode()
        if path in ("start", *QUESTIONS) and self.token and not secrets.compare_digest(given, self.token):
            return _refused("The address lacks its token: open the whole address that `qsbearing app` printed", 403)
        return None


def _name_in(host: str) -> str:
    """Of a Host header, without the port and the brackets of an IPv6 address."""
    if host.startswith("["):
        name, _, rest = host[1:].partition("]")
        return "" if rest.lstrip(":0123456789") else name
    return host.partition(":")[0].lower()


def _requested(question: Callable[..., answers.Answer]) -> Callable[[Request], Any]:
    async def answer(request: Request) -> Response:
        if request.headers.get("content-type", "").partition(";")[0] != "application/json":
            return _refused("questions are JSON", 415)  # no form of another page can ask
        data = b""
        async for piece in request.stream():
            data += piece
            if len(data) > LARGEST_FILE:
                return _refused(f"is longer than {LARGEST_FILE / 1e6:g} MB: a scene is shorter", 413)
        try:
            given = _arguments(question, data)
        except SceneError as error:
            return _refused(str(error), 400)
        try:
            return JSONResponse(await answered(question, given, _left(request)))
        except StoppedError as stopped:
            return _refused(str(stopped), 503)
        except SceneError as error:
            errors = [{"key": getattr(each, "key", ""), "text": str(each)} for each in error.errors[:MOST_SHOWN]]
            return JSONResponse({"errors": errors})

    return answer


async def _left(request: Request) -> None:
    """Returns when the client has gone."""
    while (await request.receive())["type"] != "http.disconnect":
        pass


def _arguments(question: Callable[..., answers.Answer], data: bytes) -> dict[str, Any]:
    """Those that a question is asked with.

    Raises:
        SceneFileError: it is none of this page.
    """
    requested = Path("question")
    body = parsed(data, requested, MOST_KEYS)
    with suppress(TypeError):
        given: dict[str, Any] = signature(question).bind(**body).arguments
        if all(isinstance(value, ARGUMENTS[name]) for name, value in given.items()):
            return given
    raise refused(requested, "is no question of this page")


def _refused(text: str, status: int) -> Response:
    return JSONResponse({"errors": [{"key": "", "text": text}]}, status)
