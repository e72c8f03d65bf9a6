"""A scene file as TOML tables, or the reason why it cannot be read."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

from qsbearing.io import catalogue
from qsbearing.io.file_errors import refused

LARGEST_FILE = 1_000_000
"""Bytes; a scene takes about a thousand, and what is far longer is something else."""

MOST_KEYS = 10_000
"""Keys and tables; the largest load spectra have some thousands."""

DEEPEST = 16
"""Parts of a dotted key; a scene has six at most. The parser's time and memory grow with the square of them."""

_COMMENT = re.compile(r"^[ \t]*#.*$", re.MULTILINE)
_KEY_OR_TABLE = re.compile(r"=|^[ \t]*\[", re.MULTILINE)
_DEEP_KEY = re.compile(
    r"""(?<![\w-])(?:(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+){%d}""" % DEEPEST  # noqa: UP031 - braces
)

DECIMAL_COMMA = re.compile(r"=\s*([+-]?\d+),(\d+)\s*(?:#.*)?$")
"""A value such as 12,7."""


def read_toml(path: Path) -> dict[str, Any]:
    """The tables of a file.

    Raises:
        SceneFileError: it cannot be read, or is not TOML.
    """
    return tables_of(read_text(path), path)


def tables_of(text: str, path: Path) -> dict[str, Any]:
    """The tables of a text.

    Args:
        path: what to call it in errors.

    Raises:
        SceneFileError: it is not TOML, or has too many keys.
    """
    if not text.strip():
        raise refused(path, "is empty", "`qsbearing init` prints a scene to start from")
    written = _COMMENT.sub("", text)
    count, deep = len(_KEY_OR_TABLE.findall(written)), _DEEP_KEY.search(written)
    if count > MOST_KEYS:
        cause = "Data of another program? A scene has some tens of keys, a row or an operating point about ten more"
        raise refused(path, f"has {count:,} keys; at most {MOST_KEYS:,} are read", cause)
    if deep:
        cause = f"{deep.group()[:40]}... A scene's longest key has six parts, such as vary.bearing.ball_diameter_mm"
        raise refused(path, f"has a key of more than {DEEPEST} parts with dots between", cause)
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        # Besides wrong syntax, numbers of thousands of digits and endless nesting end here.
        problem = f"is not TOML: {str(error) or 'nested too deeply'}"
        raise refused(path, problem, _line_of(text, str(error))) from None


def read_text(path: Path, most: int = LARGEST_FILE) -> str:
    """The text of a file.

    Args:
        most: bytes that it may have.

    Raises:
        SceneFileError: it cannot be read, is longer, or is not UTF-8.
    """
    try:
        with path.open("rb") as file:
            data = file.read(most + 1)
    except FileNotFoundError:
        known = catalogue.find(path.stem) is not None
        cause = f"The catalogue's {path.stem} is run by name, without {path.suffix}" if known else ""
        raise refused(path, "no such file", cause) from None
    except IsADirectoryError:
        raise refused(path, "is a folder, not a scene file") from None
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        raise refused(path, f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if len(data) > most:
        raise refused(path, f"is longer than {most / 1e6:g} MB: a scene file is shorter")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        coding = "UTF-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "Latin-1 (ANSI)"
        cause = f"Saved as {coding}? Save it again as UTF-8"
        line = data[: error.start].count(b"\n") + 1
        raise refused(path, f"is not UTF-8 text (byte {error.start + 1}, line {line})", cause) from None


def _line_of(text: str, message: str) -> str:
    """The line that a TOML message points at."""
    number = message.partition("(at line ")[2].partition(",")[0]
    lines = text.split("\n")
    if not number.isdecimal() or int(number) > len(lines):
        return ""
    line = lines[int(number) - 1].strip()
    comma = DECIMAL_COMMA.search(line)
    hint = f". Decimals take a point: {comma[1]}.{comma[2]}" if comma else ""
    if "Cannot declare" in message and line.startswith("["):
        hint = ". This table is in the file already: put all its keys in one place"
    return f"line {number}: {line[:80]}{hint}"
