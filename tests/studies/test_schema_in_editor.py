"""An editor with the schema, as tombi's language server answers it: keys, words, and what a key means."""

from __future__ import annotations

import json
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from qsbearing.files.keys import OPERATION
from qsbearing.studies.schema import file_schema

pytestmark = [
    pytest.mark.heavy,
    pytest.mark.skipif(shutil.which("tombi") is None, reason="tombi is not installed: pip install tombi"),
]
TEXT = """#:schema ./qsbearing.schema.json
[bearing]
name = "b218"
[operation]
speed_rpm = 1000

[effects]
raceway_control = ""
"""


class Editor:
    """One that has a file open."""

    def __init__(self, server: subprocess.Popen[bytes], file: Path) -> None:
        self.server, self.uri, self.count = server, file.as_uri(), 0
        self.ask("initialize", {"processId": None, "rootUri": file.parent.as_uri(), "capabilities": {}})
        self.say("initialized", {})
        opened = {"uri": self.uri, "languageId": "toml", "version": 1, "text": file.read_text(encoding="utf-8")}
        self.say("textDocument/didOpen", {"textDocument": opened})

    def say(self, method: str, given: Any, **more: Any) -> None:
        data = json.dumps({"jsonrpc": "2.0", "method": method, "params": given, **more}).encode()
        assert self.server.stdin is not None
        self.server.stdin.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)
        self.server.stdin.flush()

    def ask(self, method: str, given: Any) -> Any:
        self.count += 1
        self.say(method, given, id=self.count)
        while True:
            told = self._read()
            if told.get("id") == self.count and "method" not in told:
                return told.get("result")
            if "id" in told and "method" in told:
                self.say("", None, id=told["id"], result=None)

    def _read(self) -> dict[str, Any]:
        assert self.server.stdout is not None
        length = 0
        while line := self.server.stdout.readline().strip():
            if line.lower().startswith(b"content-length"):
                length = int(line.partition(b":")[2])
        assert length, "the server has ended"
        found: dict[str, Any] = json.loads(self.server.stdout.read(length))
        return found

    def at(self, what: str, line: str, after: str) -> Any:
        """Asked until the file is read, at the end of some letters of a line."""
        number = TEXT.splitlines().index(line)
        place = {"line": number, "character": line.index(after) + len(after)}
        until = time.monotonic() + 60.0
        while not (found := self.ask(what, {"textDocument": {"uri": self.uri}, "position": place})):
            assert time.monotonic() < until
            time.sleep(0.1)
        return found


@contextmanager
def editor(folder: Path) -> Iterator[Editor]:
    (folder / "qsbearing.schema.json").write_text(json.dumps(file_schema()), encoding="utf-8")
    (folder / "my.toml").write_text(TEXT, encoding="utf-8")
    command, pipe = ["tombi", "lsp", "--offline"], subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL) as server:
        try:
            yield Editor(server, folder / "my.toml")
        finally:
            server.kill()


def labels(found: Any) -> list[str]:
    return [each["label"] for each in (found["items"] if isinstance(found, dict) else found)]


def test_keys_and_words_are_completed_and_a_key_tells_its_unit(tmp_path: Path) -> None:
    with editor(tmp_path) as asked:
        shown = asked.at("textDocument/hover", "speed_rpm = 1000", "speed")["contents"]["value"]
        words = labels(asked.at("textDocument/completion", 'raceway_control = ""', '"'))
        keys = labels(asked.at("textDocument/completion", "", ""))
    assert "Speed [rpm]" in shown
    assert "Maximum" in shown
    assert words == ['"outer"', '"inner"', '"per_ball"', '"minimum_dissipation"']
    assert set(keys) >= {key.name for key in OPERATION} - {"speed_rpm"}
