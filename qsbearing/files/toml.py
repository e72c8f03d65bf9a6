"""A file as TOML tables, or the reason why it cannot be read."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import FileErrorDetail, SceneFileError, refused
from qsbearing.files.limits import DEEPEST_KEY, LARGEST_FILE, MOST_KEYS
from qsbearing.files.raw import read_text
from qsbearing.model.validation import comma_advice, whole_number

_COMMENT = re.compile(r"^[ \t]*#.*$", re.MULTILINE)
_KEY_OR_TABLE = re.compile(r"=|^[ \t]*\[", re.MULTILINE)
_DEEP_KEY = re.compile(
    r"""(?<![\w-])(?:(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+){%d}""" % DEEPEST_KEY  # noqa: UP031 - braces
)

_WITH_COMMA = re.compile(r"=\s*([+-]?[\d.]+,[\d.,]+)\s*(?:#.*)?$")
"""A value such as 12,7."""


def read_toml(path: Path) -> dict[str, Any]:
    """The tables of a file.

    Raises:
        SceneFileError: it cannot be read, or is not TOML.
    """
    return tables_of(read_text(path, LARGEST_FILE), path)


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
        raise refused(path, f"has a key of more than {DEEPEST_KEY} parts with dots between", cause)
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        # Besides wrong syntax, numbers of thousands of digits and endless nesting end here.
        problem = f"is not TOML: {str(error) or 'nested too deeply'}"
        raise refused(path, problem, _line_of(text, str(error))) from None


def read_back(text: str, document: dict[str, Any], path: Path) -> dict[str, Any]:
    """The tables of a text that was written of these.

    Args:
        path: what to call it in errors.

    Raises:
        SceneFileError: it is read as something else, such as a name with a line break in it.
    """
    try:
        tables = tables_of(text, path)
    except SceneFileError as error:
        cause = getattr(error.errors[0], "problem", "")
        raise refused(path, "cannot be written: its text is not read again", cause) from None
    if tables != document:
        other = sorted({name for name in {*tables, *document} if tables.get(name) != document.get(name)})
        raise refused(path, f"cannot be written: its text is read as something else in {', '.join(other)}")
    return tables


def check_tables(document: dict[str, Any], path: Path) -> None:
    """See that tables from elsewhere than a text have what one can have: no more keys, and no null.

    Raises:
        SceneFileError: they have more, are nested deeper, or hold a null.
    """
    count, level, inner = 0, 0, [document]
    while inner:
        count += sum(map(len, inner))
        level += 1
        if count > MOST_KEYS or level > DEEPEST_KEY:
            what = f"{MOST_KEYS:,} keys" if count > MOST_KEYS else f"{DEEPEST_KEY} tables within each other"
            raise refused(path, f"has more than {what}", "Data of another program?")
        values = (each for table in inner for each in table.values())
        lists = (value if isinstance(value, list) else [value] for value in values)
        inner = [each for listed in lists for each in listed if isinstance(each, dict)]
    if empty := list(_nulls(document)):
        cause = "null is no value: write one, or leave the key out"
        raise SceneFileError(str(path), [FileErrorDetail(each, "is null", cause=cause) for each in empty])


def _nulls(value: Any, path: str = "") -> Iterator[str]:
    """The path of every null within tables and lists; what stands in a list counts from 1."""
    if value is None:
        yield path
    steps = value.items() if isinstance(value, dict) else enumerate(value, 1) if isinstance(value, list) else ()
    for step, each in steps:
        yield from _nulls(each, f"{path}.{step}" if path else str(step))


def _line_of(text: str, message: str) -> str:
    """The line that a TOML message points at."""
    number = message.partition("(at line ")[2].partition(",")[0]
    lines = text.split("\n")
    if not 1 <= (at := whole_number(number) or 0) <= len(lines):
        return ""
    line = lines[at - 1].strip()
    comma = _WITH_COMMA.search(line)
    advice = comma_advice(comma[1]) if comma else ""
    hint = f". {advice}" if advice else ""
    if "Cannot declare" in message and line.startswith("["):
        hint = ". This table is in the file already: put all its keys in one place"
    return f"line {number}: {line[:80]}{hint}"
