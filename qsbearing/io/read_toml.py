"""A scene file as TOML tables, or the reason why it cannot be read."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

from qsbearing.io import catalogue
from qsbearing.io.file_errors import FileErrorDetail, SceneFileError

LARGEST_FILE = 1_000_000
"""Bytes; a scene takes about a thousand, and what is far longer is something else."""

DECIMAL_COMMA = re.compile(r"=\s*([+-]?\d+),(\d+)\s*(?:#.*)?$")
"""A value such as 12,7."""


def read_toml(path: Path) -> dict[str, Any]:
    """The tables of a file.

    Raises:
        SceneFileError: it cannot be read, or is not TOML.
    """

    def refused(problem: str, cause: str = "") -> SceneFileError:
        return SceneFileError(str(path), [FileErrorDetail("", problem, cause=cause)])

    try:
        with path.open("rb") as file:
            data = file.read(LARGEST_FILE + 1)
    except FileNotFoundError:
        known = catalogue.find(path.stem) is not None
        cause = f"The catalogue's {path.stem} is run by name, without .toml" if known else ""
        raise refused("no such file", cause) from None
    except IsADirectoryError:
        raise refused("is a folder, not a scene file") from None
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        raise refused(f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if len(data) > LARGEST_FILE:
        raise refused("is longer than a megabyte: this is no scene file")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        cause = "Saved as UTF-16? Save it again as UTF-8" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else ""
        line = data[: error.start].count(b"\n") + 1
        raise refused(f"is not UTF-8 text (byte {error.start + 1}, line {line})", cause) from None
    if not text.strip():
        raise refused("is empty", "`qsbearing init` prints a scene to start from")
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        # Besides wrong syntax, numbers of thousands of digits and endless nesting end here.
        raise refused(f"is not TOML: {str(error) or 'nested too deeply'}", _line_of(text, str(error))) from None


def _line_of(text: str, message: str) -> str:
    """The line that a TOML message points at."""
    number = message.partition("(at line ")[2].partition(",")[0]
    lines = text.split("\n")
    if not number.isdecimal() or int(number) > len(lines):
        return ""
    line = lines[int(number) - 1].strip()
    comma = DECIMAL_COMMA.search(line)
    hint = f". Decimals take a point: {comma[1]}.{comma[2]}" if comma else ""
    return f"line {number}: {line[:80]}{hint}"
