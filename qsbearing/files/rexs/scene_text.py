"""Tables of a scene file with what there is to say of them, and their text in TOML."""

from __future__ import annotations

import json
from typing import Any

from qsbearing.files.keys import Key
from qsbearing.model.validation import printable


class NotedTable(dict[str, Any]):
    """A table of a scene file, with a note on some of its keys, and on itself under the key ""."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.notes: dict[str, str] = {}

    def put(self, key: Key, value: float | None, note: str = "") -> None:
        """An SI value under its key and in its unit; nothing where there is none."""
        if value is not None:
            self.set(key.name, key.in_file(value), note)

    def set(self, name: str, value: Any, note: str = "") -> None:
        """A value as the file has it."""
        self[name] = value
        if note:
            self.note(name, note)

    def note(self, name: str, said: str) -> None:
        """Say something of a key, whether or not it is there."""
        self.notes[name] = "; ".join(filter(None, (self.notes.get(name), said)))


def text_of(table: NotedTable, path: str = "") -> str:
    """The text of tables, their notes as comments.

    A `NotedTable` within stands under a heading of its own, any other dict on the line of its key.
    """
    lines: list[str] = []
    for name in (*table, *(name for name in table.notes if name not in table)):
        value, note = table.get(name), table.notes.get(name)
        if name not in table:
            lines += [f"# {printable(note or '')}"] if name else []
        elif not _tables(value):
            setting = f"{json.dumps(name) if '.' in name else name} = {_value(value)}"
            lines.append(f"{setting:<39} # {printable(note)}" if note else setting)
    for name, value in table.items():
        inner = f"{path}.{name}" if path else name
        for each in _tables(value):
            heading = f"[[{inner}]]" if isinstance(value, list) else f"[{inner}]"
            own = each.notes.get("")
            is_needed = isinstance(value, list) or own or not each or any(not _tables(one) for one in each.values())
            heading = f"{heading:<39} # {printable(own)}" if own else heading
            inside = text_of(each, inner).rstrip("\n")
            lines += ["", *([heading] if is_needed else []), *([inside] if inside else [])]
    return "\n".join(line for number, line in enumerate(lines) if line or number) + "\n"


def _tables(value: Any) -> list[NotedTable]:
    values = value if isinstance(value, list) else [value]
    return [each for each in values if isinstance(each, NotedTable)]


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_value(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, str):
        return json.dumps(printable(value), ensure_ascii=False)  # whose escapes are TOML's as well
    return repr(value)
