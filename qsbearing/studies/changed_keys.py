"""Keys of a scene or set that are given another value than their file has, as `run --set operation.speed_rpm=12000`."""

from __future__ import annotations

import copy
import tomllib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from qsbearing.files import catalogue, paths
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.file_keys import sections
from qsbearing.files.keys import EFFECT_SECTIONS, SECTIONS
from qsbearing.files.rexs.scene_text import NotedTable, text_of
from qsbearing.files.toml import check_tables
from qsbearing.model.validation import LONGEST_VALUE, shown, whole_number
from qsbearing.studies import keys
from qsbearing.studies.study import Read, ball_count_of

Made = TypeVar("Made")
AS_SET = "as set"
"""What errors say of a value that is not the file's."""


class ChangedKey(NamedTuple):
    """One of them."""

    key: str
    """Its path in a file."""
    value: Any
    before: Any
    """What the file has there; None: nothing."""
    replaces: dict[str, Any]
    """What the file has under keys that say the same in another way, which it stands in place of."""

    def __str__(self) -> str:
        gone = "".join(f"; in place of {path} = {in_words(value)}" for path, value in self.replaces.items())
        before = "not given" if self.before is None else in_words(self.before)
        return f"{self.key} = {in_words(self.value)} (before: {before}{gone})"

    def record(self) -> dict[str, Any]:
        """As JSON has it."""
        return self._asdict()


def in_words(value: Any) -> str:
    """A value as a file has it, no more of it than helps."""
    if isinstance(value, dict):
        text = f"{{{', '.join(f'{name} = {in_words(each)}' for name, each in value.items())}}}"
    elif isinstance(value, list):
        text = f"[{', '.join(map(in_words, value))}]"
    elif isinstance(value, str):
        return f'"{shown(value)[1:-1]}"'
    else:
        return shown(value).lower() if isinstance(value, bool) else shown(value)
    return text if len(text) <= LONGEST_VALUE else f"{text[: LONGEST_VALUE - 3]}..."


def value_of(text: str) -> Any:
    """A value as TOML has it; a text that is none, such as a word without quotation marks, is itself."""
    text = text.strip()
    try:
        tables = tomllib.loads(f"value = {text}")
        if set(tables) == {"value"} and isinstance(tables["value"], str | bool | int | float | list | dict):
            return tables["value"]
    except (ValueError, RecursionError):
        pass
    try:
        number = float(text)  # .5 and 5. are numbers elsewhere
    except ValueError:
        return text
    return number if isfinite(number) else text


def changed(
    read: Read, values: Sequence[tuple[str, Any]], make: Callable[[Read], Made]
) -> tuple[Made, Read, tuple[ChangedKey, ...]]:
    """What is made of tables in which some keys have other values; these tables, and what has changed.

    Args:
        values: keys, by their paths or by names that one table alone has, and the value of each.
        make: from the tables; raises for what is wrong with them.

    Raises:
        SceneFileError: everything that is wrong with keys, values and the rest of the file, at once.
    """
    if not values:
        return make(read), read, ()
    read = read._replace(document=copy.deepcopy(read.document))
    changes: list[ChangedKey] = []
    errors: list[FileErrorDetail] = []
    for name, value in values:
        try:
            change = _put(read.document, name, value)
            if any(each.key == change.key for each in changes):
                raise ValueError("is set twice")
            changes.append(change)
        except ValueError as error:
            errors.append(FileErrorDetail(name, str(error), value, note=AS_SET))
    try:
        check_tables(read.document, Path(read.file))
        made = make(read)
    except SceneFileError as error:
        raise SceneFileError(read.file, [*errors, *_noted(error.errors, changes)]) from None
    if errors:
        raise SceneFileError(read.file, errors)
    return made, read, tuple(changes)


def text_with(document: dict[str, Any], changes: Iterable[ChangedKey]) -> str:
    """Changed tables as the text of a file, with a comment beside each change."""
    tables = _with_notes(document)
    for each in changes:
        *holders, name = each.key.split(".")
        holder: Any = paths.value_at(tables, tuple(holders))
        if isinstance(holder, NotedTable):
            holder.note(name, str(each).partition(" = ")[2].partition(" (")[2].removesuffix(")"))
    return text_of(tables)


def _with_notes(value: Any) -> Any:
    if isinstance(value, dict):
        return NotedTable({name: _with_notes(each) for name, each in value.items()})
    return [_with_notes(each) for each in value] if isinstance(value, list) else value


def _put(document: dict[str, Any], name: str, value: Any) -> ChangedKey:
    """Give a key of these tables, which change, a value.

    Raises:
        ValueError: it has no place in them.
    """
    key, path = keys.find(name), path_of(name, document)
    if key is not None and key.ball is not None:
        path = (*path, str(key.ball + 1))
        _with_deviations(document)
    _check_place(document, path)
    before = _before(document, path)
    gone = {} if key is None else {other: paths.value_at(document, other) for other in keys.replaced(key, document)}
    _put_at(document, path, value)
    for other in gone:
        paths.take_out(document, other)
    replaces = {".".join(other): each for other, each in gone.items() if each is not None}
    return ChangedKey(".".join(path), value, before, replaces)


def _before(document: dict[str, Any], path: tuple[str, ...]) -> Any:
    """What is given there, if not by the file then by what it names: a catalogue entry, a material, the set's own
    table."""
    tables = copy.deepcopy(document)
    if path[1:] and not isinstance(paths.value_at(document, path[:-1]), list):
        paths.put(tables, (*path[:-1], ""), None)  # makes the tables that the file leaves out
    holder = paths.value_at(tables, path[:-1])
    if path[-2:-1] != ("bearing",) or path[-1] in holder:
        return paths.value_at(tables, path)
    entry = catalogue.find(holder["name"]) if isinstance(holder.get("name"), str) else None
    return entry.bearing.get(path[-1]) if entry else None


def path_of(name: str, document: dict[str, Any]) -> tuple[str, ...]:
    """Of a key in a file; what no table has stands as it is, for its reader to refuse."""
    if (key := keys.find(name)) is not None:
        return key.path
    path = tuple(name.split("."))
    if len(path) > 1 or name in document:
        return path
    within = {table: ("effects", table) for table in EFFECT_SECTIONS}
    tables = [table for table, names in sections().items() if name in names and table in (*SECTIONS, *within)]
    return (*within.get(tables[0], (tables[0],)), name) if len(tables) == 1 else path


def _with_deviations(document: dict[str, Any]) -> None:
    """Make the list that the deviation of a single ball stands in, where there is none."""
    _, name = keys.known(keys.EACH_BALL).path
    effects = document.setdefault("effects", {})
    if isinstance(effects, dict) and name not in effects and (count := ball_count_of(document)):
        effects[name] = [0.0] * count


def _check_place(document: dict[str, Any], path: tuple[str, ...]) -> None:
    holder = paths.value_at(document, path[:-1])
    if isinstance(holder, list):
        if not 1 <= (whole_number(path[-1]) or 0) <= len(holder):
            raise ValueError(f"is not in the file: it has {len(holder)} {'.'.join(path[:-1])}, counted from 1")
    elif lacks := paths.missing_table(document, path):
        raise ValueError(f"is not in the file: {lacks}")
    for count in range(1, len(path)):
        inner = paths.value_at(document, path[:count])
        is_name = path[count - 1].endswith("material") and isinstance(inner, str)
        if inner is not None and not is_name and not isinstance(inner, bool | dict | list):
            raise ValueError(f"has no place: {'.'.join(path[:count])} is {in_words(inner)}, which is no table")


def _put_at(document: dict[str, Any], path: tuple[str, ...], value: Any) -> None:
    holder = paths.value_at(document, path[:-1])
    if isinstance(holder, list):
        holder[int(path[-1]) - 1] = value
    else:
        paths.put(document, path, value)


def _noted(errors: Iterable[Any], changes: Sequence[ChangedKey]) -> Iterator[FileErrorDetail]:
    """Errors of a file, those of the changes marked as such."""
    spelled = [each.key.replace("rows.", "row ", 1) for each in changes] + [each.key for each in changes]
    for each in errors:
        is_own = each.key in spelled or any(each.key.startswith(f"{key}.") for key in spelled)
        yield replace(each, note=AS_SET) if is_own and not each.note else each
