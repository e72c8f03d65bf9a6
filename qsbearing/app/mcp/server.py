"""The tools over the Model Context Protocol, by its official SDK: on standard input and output, files below a folder.

Answers are bounded: in time, as those of the page are; in length; in points and tables, before anything is solved.
"""

from __future__ import annotations

import asyncio
import functools
import json
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from mcp.server.mcpserver import MCPServer
from mcp.server.mcpserver.tools import Tool
from mcp.types import CallToolResult, TextContent, ToolAnnotations
from pydantic import ValidationError

from qsbearing.app.mcp.folder import Folder
from qsbearing.app.mcp.tools import Tools
from qsbearing.app.work import StoppedError, answered
from qsbearing.files.file_errors import MOST_SHOWN, FileErrorDetail, translate
from qsbearing.files.table_checks import did_you_mean
from qsbearing.model.validation import SceneError, printable
from qsbearing.model.version import __version__

LONGEST_TEXT = 2000
"""Characters of one text of an error; the longest of ours, a list of all keys of a table, has 900."""
LONGEST_ANSWER = 200_000
"""Characters; a bearing with all its balls takes 20,000."""
WRITES = ("sweep", "report")
INSTRUCTIONS = """\
qsbearing computes ball bearings by the quasi-static (Jones-Harris) model. Units stand at the end of keys (speed_rpm,
axial_load_N). Say with every number what its remarks say: severity wrong_model means that the numbers do not hold,
incomplete_model that an effect that is left out would change them, check_data that the input is unusual. A status other
than converged is a result: there is no equilibrium, or none was found; give no numbers of it. Errors tell the key, its
value, unit and allowed range, and the likely cause: correct the scene and ask again. Begin with describe; its topic
"skill" tells how to work with all of it.
"""


def server(folder: Path) -> MCPServer:
    """The server, before it runs.

    Raises:
        OSError: there is no such folder.
    """
    of = Tools(Folder(folder))
    tools = [_tool(each) for each in (of.describe, of.solve, of.explain, of.find, of.sweep, of.report)]
    return MCPServer("qsbearing", instructions=INSTRUCTIONS, version=__version__, log_level="ERROR", tools=tools)


def serve(folder: Path) -> None:
    """Serve until standard input ends.

    Raises:
        OSError: there is no such folder.
    """
    of, first = server(folder), Tools(Folder(folder)).describe

    async def run() -> None:
        loading = asyncio.ensure_future(answered(first, {}))  # a process has loaded the tools before somebody waits
        await of.run_stdio_async()
        loading.cancel()

    asyncio.run(run())


def _tool(question: Callable[..., dict[str, Any]]) -> Tool:
    """A question as a tool: its answer, or every error with its fields. Arguments that it does not have are refused."""

    @functools.wraps(question)
    async def answer(**given: Any) -> CallToolResult:
        try:
            record = await answered(question, given)
        except SceneError as error:
            details = [each if isinstance(each, FileErrorDetail) else translate(each) for each in error.errors]
            return _refusal(details, getattr(error, "file", ""))
        except (StoppedError, OSError) as error:
            return _refusal([FileErrorDetail("", str(error))])
        return _result(record)

    hints = ToolAnnotations(read_only_hint=question.__name__ not in WRITES, destructive_hint=False)
    tool = _Tool.from_function(answer, annotations=hints, structured_output=False)
    arguments = tool.fn_metadata.arg_model
    arguments.model_config["extra"] = "forbid"
    arguments.model_rebuild(force=True)
    return tool.model_copy(update={"parameters": tool.parameters | {"additionalProperties": False}})


class _Tool(Tool):
    """One whose wrong arguments are refused as wrong keys of a scene are, not in the words of pydantic."""

    async def run(self, arguments: dict[str, Any], context: Any, convert_result: bool = False) -> Any:
        """The answer, or what is wrong with the arguments."""
        try:
            self.fn_metadata.validate_arguments(arguments)
        except ValidationError as error:
            known = list(self.fn_metadata.arg_model.model_fields)
            refusal = _refusal(list({each.key: each for each in map(partial(_wrong, known), error.errors())}.values()))
            return self.fn_metadata.convert_result(refusal) if convert_result else refusal
        return await super().run(arguments, context, convert_result)


def _wrong(known: list[str], error: Any) -> FileErrorDetail:
    """An argument that pydantic refuses."""
    name = str(error["loc"][0])
    if error["type"] == "extra_forbidden":
        cause = did_you_mean(name, known) or f"It takes {', '.join(known)}"
        return FileErrorDetail(name, "is no argument of this tool", cause=cause)
    if error["type"] == "missing":
        return FileErrorDetail(name, "missing")
    return FileErrorDetail(name, "is not what this tool takes", error["input"], cause=error["msg"])


def _refusal(details: list[FileErrorDetail], file: str = "") -> CallToolResult:
    """Errors as data; what repeats the question is cut where it is long."""
    errors = [
        {name: shorten(each) if isinstance(each, str) else each for name, each in detail.record().items()}
        for detail in details[:MOST_SHOWN]
    ]
    return _result({"file": shorten(printable(file))} | {"errors": errors, "count": len(details)}, True)


def shorten(text: str) -> str:
    """The beginning of a text, as far as it helps."""
    return text if len(text) <= LONGEST_TEXT else f"{text[: LONGEST_TEXT - 3]}..."


def _result(record: dict[str, Any], is_error: bool = False) -> CallToolResult:
    text = json.dumps(record, ensure_ascii=False, allow_nan=False)
    if len(text) > LONGEST_ANSWER:
        problem = f"has {len(text):,} characters; at most {LONGEST_ANSWER:,} are sent: ask for less, or for a file"
        return _result({"errors": [{"key": "answer", "problem": problem}], "count": 1}, True)
    return CallToolResult(
        content=[TextContent(type="text", text=text)], structured_content=json.loads(text), is_error=is_error
    )
