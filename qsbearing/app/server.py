"""The page and its answers over HTTP. Nothing is read but what is asked, nothing written, nothing kept.

Starlette with uvicorn takes 6 MB of disk; NiceGUI 105, Dash 144, Panel 369, Streamlit 473. What they would add,
sliders, fields, tables and switches, the browser has, for keyboards and telephones too.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from inspect import signature
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.middleware import Middleware
from starlette.middleware.base import BaseHTTPMiddleware, RequestResponseEndpoint
from starlette.middleware.trustedhost import TrustedHostMiddleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from qsbearing.app import answers
from qsbearing.documents.html import TEMPLATES
from qsbearing.files.file_errors import MOST_SHOWN
from qsbearing.files.limits import LARGEST_FILE
from qsbearing.model.compiler.compiled import compile_ahead
from qsbearing.model.validation import SceneError

PAGE = Path(__file__).parent / "page"
LOCAL = ("127.0.0.1", "localhost")
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
    "solve": answers.solved,
    "picture": answers.pictured,
    "rest": answers.detailed,
    "switch": answers.switched,
    "save": answers.saved,
}
ARGUMENTS = {"document": dict, "label": str, "text": str, "name": str, "effect": str, "is_on": bool}


def application(source: str, hosts: tuple[str, ...] = LOCAL) -> Starlette:
    """The page, beginning with a scene.

    Args:
        source: its file or catalogue name, read once, now.
        hosts: names under which a browser may ask for it; "*": any.

    Raises:
        SceneFileError: everything that is wrong with the scene.
    """
    first = answers.start(source)
    warm = {"document": first["document"], "label": first["label"]}
    compile_ahead()
    answers.solved(**warm)  # the drawing is loaded before somebody waits

    async def start(request: Request) -> Response:
        return JSONResponse(first)

    routes = [Route(f"/{name}", _asked(question), methods=["POST"]) for name, question in QUESTIONS.items()]
    guards = [
        Middleware(TrustedHostMiddleware, allowed_hosts=list(hosts)),  # against pages of other names for this address
        Middleware(BaseHTTPMiddleware, dispatch=_with_headers),
    ]
    pages = [Mount("/documents", StaticFiles(directory=TEMPLATES)), Mount("/", StaticFiles(directory=PAGE, html=True))]
    return Starlette(routes=[Route("/start", start), *routes, *pages], middleware=guards)


def serve(source: str, host: str, port: int, ready: Callable[[str], None]) -> None:
    """Serve until interrupted.

    Args:
        ready: called with the page's address before the first question.
    """
    import uvicorn

    app = application(source, LOCAL if host in LOCAL else ("*",))
    ready(f"http://{host}:{port}/")
    uvicorn.run(app, host=host, port=port, log_level="warning", limit_concurrency=200)


async def _with_headers(request: Request, proceed: RequestResponseEndpoint) -> Response:
    answer = await proceed(request)
    answer.headers.update(HEADERS)
    return answer


def _asked(question: Callable[..., answers.Answer]) -> Callable[[Request], Any]:
    async def answer(request: Request) -> Response:
        if request.headers.get("content-type", "").partition(";")[0] != "application/json":
            return _refused("questions are JSON", 415)  # no form of another page can ask
        data = b""
        async for piece in request.stream():
            data += piece
            if len(data) > LARGEST_FILE:
                return _refused(f"is longer than {LARGEST_FILE / 1e6:g} MB: a scene is shorter", 413)
        try:
            given = signature(question).bind(**json.loads(data, parse_constant=_no_number)).arguments
            is_right = all(isinstance(value, ARGUMENTS[name]) for name, value in given.items())
        except (ValueError, RecursionError, TypeError):
            is_right = False
        if not is_right:
            return _refused("is no question of this page", 400)
        try:
            return JSONResponse(await run_in_threadpool(question, **given))
        except SceneError as error:
            errors = [{"key": getattr(each, "key", ""), "text": str(each)} for each in error.errors[:MOST_SHOWN]]
            return JSONResponse({"errors": errors})

    return answer


def _no_number(word: str) -> float:
    raise ValueError(f"{word} is none")


def _refused(text: str, status: int) -> Response:
    return JSONResponse({"errors": [{"key": "", "text": text}]}, status)
