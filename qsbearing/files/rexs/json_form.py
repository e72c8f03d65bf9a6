"""A REXS model in JSON, and edits of its text."""

from __future__ import annotations

import json
from json.decoder import JSONArray, JSONDecoder, JSONObject  # type: ignore[attr-defined]
from json.scanner import py_make_scanner  # type: ignore[attr-defined]
from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import refused
from qsbearing.files.json_text import parsed
from qsbearing.files.rexs.model import ListExtent, Span


class _Placed(JSONDecoder):
    """A decoder that knows where each list and table stands."""

    def __init__(self) -> None:
        super().__init__()
        self.spans: dict[int, Span] = {}
        self.parse_object = self._noted(JSONObject)
        self.parse_array = self._noted(JSONArray)
        self.scan_once = py_make_scanner(self)

    def _noted(self, parse: Any) -> Any:
        def noted(text_and_end: tuple[str, int], *others: Any) -> Any:
            value, end = parse(text_and_end, *others)
            self.spans[id(value)] = text_and_end[1] - 1, end
            return value, end

        return noted


def read(data: bytes, path: Path, with_places: bool) -> tuple[dict[str, Any], dict[int, Span]]:
    """The model of a text in UTF-8; and where each part stands, in characters.

    Args:
        with_places: without it the places are not found out, which takes long.

    Raises:
        SceneFileError: it is no JSON, or no REXS.
    """
    document, spans = parsed(data, path), {}  # the first bounds depth and size
    if with_places:
        decoder = _Placed()
        document, spans = decoder.decode(data.decode("utf-8")), decoder.spans
    root = document.get("model") if isinstance(document, dict) else None
    if not isinstance(root, dict):
        raise refused(path, 'is no REXS model: there is no table "model" in it')
    return root, spans


def attribute(name: str, unit: str, value: Any) -> str:
    """An attribute as text."""
    kind = "enum" if isinstance(value, str) else "floating_point_array" if isinstance(value, list) else "floating_point"
    return json.dumps({"id": name, "unit": unit, kind: value}, ensure_ascii=False)


def component(number: int, kind: str, name: str, attributes: list[str], indent: str) -> str:
    """A component as text; its further lines begin with the indent."""
    named = f'"name": {json.dumps(name, ensure_ascii=False)}, ' if name else ""
    inner = ",".join(f"{indent}  {each}" for each in attributes)
    return f'{{"id": {number}, "type": {json.dumps(kind)}, {named}"attributes": [{inner}{indent}]}}'


def relation(number: int, kind: str, parts: list[tuple[str, int, str]], indent: str) -> str:
    """A relation as text, of components in roles, with their types."""
    refs = [{"id": at, "role": role, "hint": hint} for role, at, hint in parts]
    return json.dumps({"id": number, "type": kind, "refs": refs})


def accumulation(components: list[str], indent: str) -> str:
    """What all load cases do together, as text."""
    return f'"accumulation": {{"components": [{",".join(f"{indent}  {each}" for each in components)}{indent}]}}'


def insertion(text: str, place: ListExtent, items: list[str], indent: str) -> tuple[Span, str]:
    """The edit that adds items to a list. Commas begin the new lines, so that the line before stays as it is."""
    if place.last is not None:
        return (place.last[1], place.last[1]), "".join(f"{indent},{each}" for each in items)
    return place.span, "[" + ",".join(indent + each for each in items) + "]"
