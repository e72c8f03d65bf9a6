"""The five channels, each with a load, at a place or free, and the preload: their choices, and the tables after one.

A tilt that a load beside it calls for is stated with it, as free: the page shows every channel, so that nothing is left
unsaid.
"""

from __future__ import annotations

import copy
from typing import Any, NamedTuple

from qsbearing.files.keys import OF_OPERATION, PRELOAD, Key
from qsbearing.files.scene_or_set import is_set
from qsbearing.model.operation import CHANNELS, TILT_OF, Channel
from qsbearing.model.scene.preload import FORCES
from qsbearing.model.solution.result_keys import printed_unit

Tables = dict[str, Any]
LOAD, PLACE, FREE = "load", "place", "free"
NONE = "none"
"""Of the preload's ways."""
KEYS = {
    channel.label: {LOAD: OF_OPERATION[channel.load], PLACE: OF_OPERATION[channel.displacement]} for channel in CHANNELS
}
"""The keys of each channel's ways; free has none."""
PRELOADED = "preload"
WAYS = {key.name: key for key in PRELOAD}
"""Of the preload."""
FIRST = 100.0
"""A preload to begin with where the ring carries no axial load [N] (chosen: less than any bearing's light class)."""
DIGITS = 4
"""Of a number that is taken over from the results."""
AXIAL = CHANNELS[0].label


class Channels(NamedTuple):
    """What a choice is among, and what is chosen."""

    name: str
    way: str
    held_by: str
    """What sets the channel in its place; empty where nothing does."""
    ways: list[dict[str, str]]


def channels(document: Tables) -> list[dict[str, Any]]:
    """Every channel, and last the preload."""
    return [_channel(each, document)._asdict() for each in CHANNELS] + [_preload(document)._asdict()]


def channel_of(path: tuple[str | int, ...]) -> str:
    """The channel, or the preload, that the number at this path is of; empty where it is of none."""
    if path[0] == PRELOADED:
        return PRELOADED
    if path[0] != "operation":
        return ""
    return next((name for name, keys in KEYS.items() if path[-1] in [key.name for key in keys.values()]), "")


def _channel(channel: Channel, document: Tables) -> Channels:
    table, name = document.get("operation"), channel.label
    table = table if isinstance(table, dict) else {}
    given = {way: table[key.name] for way, key in KEYS[name].items() if key.name in table}
    way = next((way for way, value in given.items() if way == PLACE or value != 0.0), FREE)
    held_by = PRELOADED if name == AXIAL and _holds_axially(document) else ""
    ways = [{"way": way, "path": f"operation.{key.name}", **_said(way, key)} for way, key in KEYS[name].items()]
    return Channels(name, way, held_by, [*ways, {"way": FREE, "words": FREE, "takes": ""}])


def _said(way: str, key: Key) -> dict[str, str]:
    return {"words": printed_unit(key.unit), "takes": way, "says": f"{way} in {printed_unit(key.unit)}"}


def _preload(document: Tables) -> Channels:
    table = document.get(PRELOADED, {})
    way = next((name for name in WAYS if name in table), NONE) if isinstance(table, dict) else NONE
    ways = [{"way": NONE, "words": NONE, "takes": LOAD}]
    for name, key in WAYS.items():
        words = f"{(key.words or key.field.replace('_', ' ')).removesuffix(' preload')}, {printed_unit(key.unit)}"
        takes = LOAD if key.field in FORCES else PLACE
        ways.append({"way": name, "path": f"{PRELOADED}.{name}", "words": words, "takes": takes})
    return Channels(PRELOADED, way, "", ways)


def _holds_axially(document: Tables) -> bool:
    """A set's preload acts between its rows, and leaves the shaft its axial channel."""
    return bool(document.get(PRELOADED)) and not is_set(document)


def with_way(document: Tables, channel: str, way: str, value: float | None) -> Tables:
    """The tables with another way for a channel, or for the preload.

    Args:
        value: to begin with, in the unit of the way's key; None: nothing is known.

    Raises:
        KeyError: there is no such channel, or it has no such way.
    """
    tables = copy.deepcopy(document)
    operation = tables.setdefault("operation", {})
    if channel == PRELOADED:
        _with_preload(tables, operation, way, value)
    else:
        for key in KEYS[channel].values():
            operation.pop(key.name, None)
        if channel == AXIAL and _holds_axially(tables):
            del tables[PRELOADED]
        if way != FREE:
            operation[KEYS[channel][way].name] = _rounded(value or 0.0)
    _state(tables, operation)
    return tables


def _with_preload(tables: Tables, operation: Tables, way: str, value: float | None) -> None:
    before = tables.pop(PRELOADED, {})
    for key in () if is_set(tables) else KEYS[AXIAL].values():
        operation.pop(key.name, None)
    if way == NONE:
        if value and not is_set(tables):
            operation[KEYS[AXIAL][LOAD].name] = _rounded(value)
        return
    is_force = WAYS[way].field in FORCES
    forces = [before[name] for name, key in WAYS.items() if name in before and key.field in FORCES]
    usual = value if value is not None and (value > 0.0 or not is_force) else FIRST if is_force else 0.0
    tables[PRELOADED] = {way: forces[0] if is_force and forces else _rounded(usual)}


def _state(tables: Tables, operation: Tables) -> None:
    """State what the file would ask for: the tilt beside a radial load or displacement, and that nothing acts."""
    for field, number in TILT_OF.items():
        tilt = KEYS[CHANNELS[number].label]
        if OF_OPERATION[field].name in operation and not any(key.name in operation for key in tilt.values()):
            operation[tilt[LOAD].name] = 0.0
    every = [key.name for keys in KEYS.values() for key in keys.values()]
    if PRELOADED not in tables and not any(name in operation for name in every):
        operation[KEYS[AXIAL][LOAD].name] = 0.0


def found(displacement: Any, load: Any) -> dict[str, dict[str, float]]:
    """Where each channel stands and what it carries, in the units of the file's keys; the preload acts axially.

    Args:
        displacement, load: of the five channels, in SI.
    """
    of_channels = {
        name: {
            LOAD: _rounded(keys[LOAD].in_file(float(load[number]))),
            PLACE: _rounded(keys[PLACE].in_file(float(displacement[number]))),
        }
        for number, (name, keys) in enumerate(KEYS.items())
    }
    return of_channels | {PRELOADED: of_channels[AXIAL]}


LEAST = 1e-6
"""Of a number that is taken over: less is rounding."""


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}") if abs(value) > LEAST else 0.0
