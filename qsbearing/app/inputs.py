"""The fields of the page, made of the tables of a scene file and of the keys that they may have."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from qsbearing.app import channels, effect_forms
from qsbearing.app.scenes import beside_control
from qsbearing.files.file_keys import REQUIRE, find, spelled
from qsbearing.files.keys import EFFECT_SECTIONS, EFFECT_TABLES, NUMBERED, SET_TABLES, Key
from qsbearing.files.paths import key_at
from qsbearing.files.scene_or_set import is_set
from qsbearing.files.table_checks import CHOICES_OF_FILES
from qsbearing.files.template import notes
from qsbearing.model.described import choices_of
from qsbearing.model.material import BY_NAME
from qsbearing.model.operation import TURNING
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.validation import Field, Setting
from qsbearing.remarks.wording import Audience, Words
from qsbearing.studies import keys

FieldOfPage = dict[str, Any]
Path = tuple[str | int, ...]
"""Where a number stands in the tables; those of a list count from 0."""
TYPICAL = {"N": 1000.0, "rpm": 10_000.0, "um": 20.0, "mm": 1.0, "mrad": 1.0, "N m": 20.0, "deg": 15.0, "C": 60.0}
"""How far a slider reaches from zero, by unit; what is allowed, the scene's own checks say."""
NEAR = 0.2
"""Of a bearing's own numbers, and of lengths of a shaft, a slider covers so much to either side: far more describes
none."""
PLACES = ("position", "start")
"""How the names of places along a shaft end."""
ASIDE = 50.0
"""How far a slider moves what stands on a shaft to either side [mm]."""
FARTHEST = 1e30
"""Of a slider."""
DAILY = ("operation", "shaft", "preload")
"""Tables whose fields come first and are always in view; of a shaft what loads it."""
LOADING = ("loads", "gears", "belts")
OF_SET = ("operation", "preload")
"""The tables to which keys can be added that a set has not."""
ALWAYS = ("operation", f"{TURNING[0]}_rpm")
"""What every scene has."""
SELDOM = (("operation", f"{TURNING[-1]}_deg"),)
"""Of these tables, what few people look at."""
_NUMBERED = {table: word for word, table in NUMBERED.items()}


def fields(document: dict[str, Any]) -> list[FieldOfPage]:
    """A field for every number and word of these tables, and for all that their effects may be given; of a number with
    the ends of its slider."""
    inputs = [
        _field(path, value) for path, value in _leaves(document) if path[-2:] != ("bearing", "name") and _is_shown(path)
    ]
    inputs += [_empty(path) for path in effect_forms.not_given(document)]
    for field in inputs:
        field["replaces"] = effect_forms.replaces(field["path"])
        field["brings"] = effect_forms.brings(field["path"], document)
    place = {table: number for number, table in enumerate(DAILY)}
    return sorted(
        inputs, key=lambda field: (place.get(field["path"][0], len(place)), effect_forms.order(field["path"]))
    )


def _is_shown(path: Path) -> bool:
    """Limits of results stand with their answers."""
    return path[0] != REQUIRE


def _is_daily(path: Path) -> bool:
    return path[0] in DAILY and path not in SELDOM and (path[0] != "shaft" or path[1] in LOADING)


def is_of_effect(path: Path) -> bool:
    """Whether it is in the table of an effect, of all rows or of one."""
    return any(step in EFFECT_SECTIONS for step in path[:-1])


def _leaves(table: Any, before: Path = ()) -> Iterator[tuple[Path, Any]]:
    for name, value in enumerate(table) if isinstance(table, list) else table.items():
        is_listed = isinstance(value, list) and all(isinstance(each, dict) for each in value)
        if isinstance(value, dict) or (is_listed and name in _NUMBERED):
            yield from _leaves(value, (*before, name))
        elif isinstance(value, str | int | float) and not isinstance(value, bool):
            yield (*before, name), value


def _key(path: Path) -> str:
    """As errors have it: `operation.speed_rpm`, `shaft.load 1.radial_y_N`."""
    steps: list[str] = []
    for step in path:
        if isinstance(step, int):
            steps[-1] = f"{_NUMBERED.get(steps[-1], steps[-1])} {step + 1}"
        else:
            steps.append(step)
    return ".".join(steps)


def _field(path: Path, value: Any) -> FieldOfPage:
    field = _named(path)
    if isinstance(value, str):
        return field | {"options": _options(field["name"], path)}
    if path[-1] == "ball_count":
        return field | {"low": max(3, value // 2), "high": 2 * value, "step": 1}
    value = min(max(value, -FARTHEST), FARTHEST)
    key = _key_of(path)
    low, high = _span(float(value), key.unit if key else "", path)
    return field | {"low": low, "high": high, "step": float(f"{(high - low) / 400.0:.0e}")}


def _named(path: Path) -> FieldOfPage:
    """What is said of a field, whatever it has in it."""
    own, name = _key(path), str(path[-1])
    key, table = _key_of(path), own.rpartition(".")[0]
    words, unit = label(key.field if key else name), printed_unit(key.unit) if key else ""
    bounds = () if key is None or key.range is None else tuple(key.in_file(end) for end in key.range)
    allowed = f"{bounds[0]:g} to {bounds[1]:g} {unit}" if bounds else ""
    note = ", ".join(filter(None, (notes().get((table.rpartition(".")[2], name), ""), allowed)))
    field: FieldOfPage = {"path": path, "key": own, "name": name, "group": table.replace(".", ", "), "words": words}
    field |= {"unit": unit, "note": note, "channel": channels.channel_of(path), "is_given": True}
    is_needed = (path[0] in ("bearing", "rows", "shaft") and not is_of_effect(path)) or path == ALWAYS
    return field | {"is_needed": is_needed, "is_daily": _is_daily(path)}


def _key_of(path: Path) -> Key | None:
    """Of a number; a point of the shaft has its own name for one."""
    return find(_key(path)) or key_at(tuple(step for step in path if isinstance(step, str)))


def _empty(path: Path) -> FieldOfPage:
    """Of a key that is not given: without a slider, for nothing tells where it would begin."""
    field = _named(path) | {"is_given": False}
    options, key = _options(field["name"], path), find(field["key"])
    if key is None and options:
        return field | {"options": options}
    return field


def _options(name: str, path: Path) -> list[str]:
    if name.endswith("material"):
        return list(BY_NAME)
    if path[0] in SET_TABLES:
        from qsbearing.files.set_keys import RECORDS  # a scene does not load it

        table = next(step for step in reversed(path[:-1]) if isinstance(step, str))
        if table in RECORDS:
            words: Any = choices_of(RECORDS[table])[name]
            return list(map(str, words))
    if is_of_effect(path) and (own := effect_forms.options(path)):
        return list(own)
    return [str(each) for each in CHOICES_OF_FILES.get(name, ())]


def _span(value: float, unit: str, path: Path) -> tuple[float, float]:
    is_place = unit == "mm" and ("points" in path or str(path[-1]).removesuffix("_mm").endswith(PLACES))
    if is_place:
        return value - ASIDE, value + ASIDE
    if value and ("bearing" in path or (unit == "mm" and path[0] in SET_TABLES)):
        return tuple(sorted((value * (1.0 - NEAR), value * (1.0 + NEAR))))  # type: ignore[return-value]
    reach = 2.0 * abs(value) or TYPICAL.get(unit, 1.0)
    return (0.0, reach) if value > 0.0 else (-reach, 0.0 if value < 0.0 else reach)


def label(field: str) -> str:
    """What the page calls a field."""
    return field.rpartition(".")[2].replace("_", " ").replace("hertz", "Hertz")


def _spelled(field: Field, path: str) -> str:
    """A field or setting of a remark as the page has it; what it has no field for, as a file has it."""
    if not isinstance(field, Setting):
        return label(field)
    return spelled(field, path) if isinstance(field.value, type) else f"{label(field.field)}: {field.value}"


ON_PAGE = Words(Audience.PAGE, _spelled)
"""How remarks name fields on the page."""


def addable(document: dict[str, Any]) -> list[FieldOfPage]:
    """The keys that these tables have not, and no control of its own offers, with what each stands in place of."""
    return [
        {"path": key.path, "unit": printed_unit(key.unit), "replaces": keys.replaced(key, document)}
        for key in keys.ALL.values()
        if _is_addable(document, key.path) and _fits(document, key.path) and not _has_control(document, key.path)
    ]


def _is_addable(document: dict[str, Any], path: tuple[str, ...]) -> bool:
    return not is_set(document) or path[0] in OF_SET


def _has_control(document: dict[str, Any], path: tuple[str, ...]) -> bool:
    """Channels and preload have a choice each, an effect its switch, and fields for all that belongs to it; of a law of
    friction there is nothing to add where none is chosen, and of hypotheses nothing beside one."""
    if channels.channel_of(path) or any(step in EFFECT_TABLES for step in path):
        return True
    return path[0] == "effects" and path[1] in beside_control(document)


def _fits(document: dict[str, Any], path: tuple[str, ...]) -> bool:
    table: Any = document
    for name in path[:-1]:
        table = table.get(name, {})
        if not isinstance(table, dict):
            return False
    return path[-1] not in table
