"""JSON as its standard has it, and no more of it than memory holds."""

from __future__ import annotations

import json
import re
from collections import Counter
from math import isinf
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from qsbearing.files.file_errors import SceneFileError, refused
from qsbearing.files.limits import DEEPEST_JSON, MOST_VALUES
from qsbearing.files.raw import decoded

_NO_BRACKETS = bytes(set(range(256)) - set(b"[]{}"))
_TEXT = re.compile(rb'"(?:[^"\\]|\\.)*+"?', re.DOTALL)
"""A text; one without an end too, or each of its quotation marks would be tried as a beginning."""


def parsed(data: bytes, path: Path, most: int = MOST_VALUES) -> Any:
    """What a text holds.

    Args:
        path: what to call it in errors.
        most: values that it may have.

    Raises:
        SceneFileError: it is not JSON, names a key twice, holds NaN or half a character, or has too many values.
    """
    if sum(map(data.count, (b",", b"[", b"{"))) > most and _count(data) > most:
        raise refused(path, f"has more than {most:,} values")
    if _depth(data) > DEEPEST_JSON and _depth(_TEXT.sub(b"", data)) > DEEPEST_JSON:
        raise refused(path, f"is nested deeper than {DEEPEST_JSON} lists and tables")
    try:
        value = json.loads(decoded(data, path), parse_float=_finite, parse_constant=_no_number, object_pairs_hook=_once)
        if b"\\ud" in data or b"\\uD" in data:
            json.dumps(value, ensure_ascii=False).encode()  # fails for half a character
    except (ValueError, RecursionError) as error:
        if isinstance(error, SceneFileError):
            raise
        half = isinstance(error, UnicodeEncodeError)
        raise refused(path, f"is not JSON: {'half a character' if half else error or 'nested too deeply'}") from None
    return value


def _count(data: bytes) -> int:
    bare = _TEXT.sub(b"", data)
    return sum(map(bare.count, (b",", b"[", b"{")))


def _depth(data: bytes) -> int:
    """Of brackets within each other; brackets in texts are counted too."""
    brackets = np.frombuffer(data.translate(None, _NO_BRACKETS), np.uint8)
    opens = (brackets == ord("[")) | (brackets == ord("{"))
    return int(np.max(np.cumsum(np.where(opens, 1, -1)), initial=0))


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) < len(pairs):
        twice = Counter(name for name, _ in pairs).most_common(1)[0][0]
        raise ValueError(f"the key {json.dumps(twice)} stands twice in one table")
    return table


def _finite(text: str) -> float:
    number = float(text)
    if isinf(number):
        raise ValueError(f"{text[:20]} is beyond any number")
    return number


def _no_number(word: str) -> NoReturn:
    raise ValueError(f"{word} is no number of JSON")
