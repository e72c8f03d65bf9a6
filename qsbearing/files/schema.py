"""A JSON Schema (draft-07) of scene and set files, from the keys that reading, template and guide share; for editors.

It never refuses what the reader accepts, so a rule that [vary] or [[spectrum]] can lift holds only without them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from enum import StrEnum
from math import copysign, floor, inf, log10, nextafter
from typing import Any

from qsbearing.files import catalogue, thermal_keys
from qsbearing.files.effects_table import AUTO, BALL_EFFECTS
from qsbearing.files.file_keys import BALL_TABLES, ORIGIN, OTHER_TABLES, REPORT, REQUIRE, reading_keys, reading_tables
from qsbearing.files.fits import CLASS, FITTED, classes, names
from qsbearing.files.keys import (
    BALL_DEVIATIONS,
    BEARING,
    DIAMETERS,
    EFFECT_SECTIONS,
    EFFECT_TABLES,
    EFFECTS,
    FRICTION_RANGE,
    IN_PLACE,
    MAKES_SET,
    MATERIAL,
    MATERIALS,
    OF_OPERATION,
    OPERATION,
    PRELOAD,
    RATINGS,
    RING_EFFECTS,
    SEATS,
    SHEET_CHOICES,
    SPECTRUM,
    TRACTION,
    Key,
    key_of,
    named,
    required_of,
)
from qsbearing.files.preload_class import CLASSES
from qsbearing.files.set_keys import GRAVITY, MATRIX, RECORDS, SET_NUMBERS
from qsbearing.files.table_checks import CHOICES_OF_FILES
from qsbearing.files.template import notes
from qsbearing.model.accuracy import COARSEST, FINEST
from qsbearing.model.bearing import BearingKind
from qsbearing.model.described import choices_of, lists_of, materials_of, parts_of
from qsbearing.model.effects import ElasticRings
from qsbearing.model.effects.traction import Traction
from qsbearing.model.material import BY_NAME, Material
from qsbearing.model.operation import CHANNELS, TILT_OF
from qsbearing.model.scene.requirement import ENDS, SENSES, SOURCE
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.readings.asked import READINGS
from qsbearing.systems.sets.row import Row
from qsbearing.systems.sets.shaft import Shaft

Schema = dict[str, Any]
DRAFT = "http://json-schema.org/draft-07/schema#"
STUDY_LIFTS = {"anyOf": [{"required": ["vary"]}, {"required": ["spectrum"]}]}
"""Tables that may give, or take away, what another table lacks or has."""
_WORD: Schema = {"type": "string"}
_NUMBER: Schema = {"type": ["integer", "number"]}
"""Both are said although each integer is a number: tombi shows nothing of a key with 1000 as a "number"."""


def _ref(name: str) -> Schema:
    return {"$ref": f"#/definitions/{name}"}


_MATERIAL = _ref("material")
_SLACK = 1e-12
"""Between a bound in SI and its decimal number in a file's unit (a float's rounding is 1e-16)."""


def scene_schema() -> Schema:
    """Of a file of one bearing or of a set; a study's tables are added in `qsbearing.studies.schema`."""
    definitions = {
        "material": _material(),
        "bearing": _bearing(),
        "preload": closed(_numbers(PRELOAD, "preload")),
        "readings": closed({name: _reading(name) for name in reading_tables()}),
        **{name: _effect_table(name) for name in EFFECT_TABLES},
    }
    tables = {
        "bearing": _ref("bearing"),
        "operation": closed(_numbers(OPERATION, "operation")),
        "preload": {"anyOf": [_ref("preload"), {"enum": list(CLASSES)}]},
        "effects": {"anyOf": [{"const": AUTO}, _effects()]},
        "tolerance": _NUMBER | {"minimum": FINEST, "maximum": COARSEST},
        "readings": _ref("readings"),
        "thermal": _thermal(),
        REQUIRE: _required(),
        REPORT: closed(dict.fromkeys(OTHER_TABLES[REPORT], _WORD) | {BALL_TABLES: _choice(BALL_TABLES, REPORT)}),
        ORIGIN: closed({key: {"not": {"type": "null"}} for key in OTHER_TABLES[ORIGIN]}),
        **_of_set(),
        "spectrum": {"anyOf": [_list(_point(), 1), closed({"file": _WORD}) | {"required": ["file"]}]},
    }
    head = {"$schema": DRAFT, "title": "qsbearing: a scene, a set or a study", "definitions": definitions}
    return {**head, **closed(tables), "allOf": _rules()}


def _required() -> Schema:
    """Limits under the names of results; points in a name that is not quoted make tables within tables."""
    ends = _told(closed({**dict.fromkeys(ENDS, _NUMBER), SOURCE: _WORD}), "At least, at most, and whose limit it is")
    bound = {"type": "string", "pattern": rf"^\s*({'|'.join(SENSES)})"}
    each = {"anyOf": [_told(bound, 'As ">= 45" or "<= 2000"'), ends, {"type": "object"}]}
    return {"type": "object", "description": "What results must keep", "additionalProperties": each}


_SHEETS = (
    [RATINGS[0].name],
    ["outer_ball_pass"],
    ["ball_count", "ball_diameter_mm", *named(DIAMETERS)],
    ["rating_practice"],
)
"""Keys by which a table is a data sheet."""


def _bearing() -> Schema:
    name = {"anyOf": [{"enum": [entry.name for entry in catalogue.entries()]}, _WORD]}
    own = {"name": name, "maker": _WORD, "kind": _choice("kind", "bearing")}
    own |= {word: _choice(word, "bearing") for word in SHEET_CHOICES} | {"preload": {"enum": list(CLASSES)}}
    return closed(own | _numbers((*BEARING, *IN_PLACE), "bearing") | dict.fromkeys(MATERIALS, _MATERIAL))


def _effects() -> Schema:
    elsewhere = ("kind", *SHEET_CHOICES, "law", BALL_TABLES)
    choices = {name: _choice(name, "effects") for name in CHOICES_OF_FILES if name not in elsewhere}
    choices[Traction.name] = _traction()
    own = {"ball": _list({"enum": list(BALL_EFFECTS)}), **choices, **_numbers(EFFECTS, "effects")}
    own[BALL_DEVIATIONS.name] = _told(_list(_NUMBER), f"Of each ball [{BALL_DEVIATIONS.unit}]")
    return closed(own | {name: _ref(name) for name in EFFECT_TABLES})


def _traction() -> Schema:
    pair = _list(_NUMBER, 2) | {"maxItems": 2}
    own = {"law": _choice("law", Traction.name), **_numbers(TRACTION, Traction.name)}
    own[FRICTION_RANGE.name] = _told(pair, notes().get((Traction.name, FRICTION_RANGE.name), ""))
    return _told(closed(own), notes().get((Traction.name, ""), ""))


def _effect_table(name: str) -> Schema:
    own = _numbers(EFFECT_TABLES[name], name)
    of = RING_EFFECTS[name]
    own |= dict.fromkeys(materials_of(of), _MATERIAL)
    own |= {word: _one_of(kind, name, word) for word, kind in choices_of(of).items()}
    if CLASS in EFFECT_SECTIONS[name]:
        own |= {f"{seat}_fit": {"enum": list(names(seat))} for seat in FITTED} | {CLASS: {"enum": list(classes())}}
    if name == ElasticRings.name:
        own |= dict.fromkeys(SEATS, _WORD)
    own |= dict.fromkeys(named(map(key_of, lists_of(of))), _list(_NUMBER))
    return _told(_nested(own) if name == ElasticRings.name else closed(own), notes().get((name, ""), ""))


def _reading(name: str) -> Schema:
    own = reading_tables()[name]
    words = {word: _told(_WORD, notes().get((name, word), "")) for word in own.choices}
    gives = READINGS[name].gives if name in READINGS else own.note
    return _told({"anyOf": [{"const": True}, closed(_numbers(reading_keys(name), name) | words)]}, gives)


def _thermal() -> Schema:
    tables = {
        name: closed(_numbers(keys, name)) for name, keys in thermal_keys.THERMAL_NUMBERS.items() if name != "thermal"
    }
    conductance = _numbers(thermal_keys.CONDUCTANCE, thermal_keys.CONDUCTANCES)
    conductance |= {"between": _list(_WORD), "row": {"type": "integer"}}
    tables[thermal_keys.CONDUCTANCES] = _list(closed(conductance), 1)
    own = _numbers(thermal_keys.THERMAL, "thermal") | dict.fromkeys(thermal_keys.WORDS, _WORD)
    return closed(own | tables)


def _of_set() -> dict[str, Schema]:
    """The tables around the rows of a set."""
    own = {name: _numbers(keys, name) for name, keys in SET_NUMBERS.items()}
    stiffness = closed(own["housing_stiffness"] | {MATRIX.name: _list(_list(_NUMBER))})
    own["rows"] |= {name: _one_of(kind, "rows", name) for name, kind in choices_of(Row).items()}
    own["rows"] |= {"housing_stiffness": stiffness}
    own["rows"] |= {name: _ref(name) for name in ("bearing", "readings", *EFFECT_TABLES)}
    for name in ("housing", "sections"):
        own[name] |= dict.fromkeys(materials_of(RECORDS[name]), _MATERIAL)
    for name in parts_of(Shaft):
        own[name] |= {each: _one_of(kind, name, each) for each, kind in choices_of(RECORDS[name]).items()}
    points = {"type": "object", "patternProperties": {"_mm$": _NUMBER}, "additionalProperties": False}
    own["shaft"] |= {name: _list(closed(own[name])) for name in parts_of(Shaft)}
    own["shaft"] |= {GRAVITY.name: _list(_NUMBER, 3) | {"maxItems": 3}, "points": points}
    of_rows = {"rows": _list({"type": "integer"})}
    own["spacers"] |= of_rows | dict.fromkeys(materials_of(RECORDS["spacers"]), _MATERIAL)
    own["floating"] |= of_rows | {"preload": _ref("preload")}
    lists = {name: _list(closed(own[name])) for name in ("rows", "spacers", "floating")}
    return lists | {name: closed(own[name]) for name in ("shaft", "housing")}


def _one_of(kind: type[StrEnum] | type[bool], table: str, name: str) -> Schema:
    """Of a choice: one of its words, or true or false."""
    words: Schema = {"type": "boolean"} if kind is bool else {"enum": [str(each) for each in kind]}
    return _told(words, notes().get((table, name), ""))


def _point() -> Schema:
    """Of a spectrum: what the operation may have, its time, and any number of the file by its path."""
    by_path = {"patternProperties": {r"\.": _NUMBER}, "additionalProperties": {"type": "object"}}
    return closed(_numbers(SPECTRUM, "operation")) | by_path


_DEEP_GROOVE: Schema = {
    "required": ["bearing"],
    "properties": {
        "bearing": {
            "anyOf": [
                {"required": ["kind"], "properties": {"kind": {"const": str(BearingKind.DEEP_GROOVE)}}},
                {"required": ["name"], "properties": {"name": {"pattern": r"(^|\D)1?6\d"}}},
            ]
        }
    },
}
"""Whose rows may leave out `carries`: by kind, or by a number that begins as theirs."""


def _rules() -> list[Schema]:
    """What relates two keys or tables."""
    in_file = {field: key.name for field, key in OF_OPERATION.items()}
    both = [{"required": [in_file[each.load], in_file[each.displacement]]} for each in CHANNELS]
    axial = [{"required": [in_file[name]]} for name in (CHANNELS[0].load, CHANNELS[0].displacement)]
    tilts = []
    for name, channel in TILT_OF.items():
        acts = {"required": [in_file[name]], "properties": {in_file[name]: {"not": {"const": 0}}}}
        either = [{"required": [in_file[each]]} for each in (CHANNELS[channel].load, CHANNELS[channel].displacement)]
        tilts.append({"if": acts, "then": {"anyOf": either}})
    needed = [key.name for key in BEARING if key.field in ("ball_count", "ball_diameter")]
    own = {"anyOf": [{"required": each} for each in (["name"], *_SHEETS, [*needed, *MATERIALS])]}
    one_of = {"anyOf": [_WORD, {"minProperties": 1, "maxProperties": 1}]}
    given = {
        "properties": {
            "bearing": own,
            "operation": {"not": {"anyOf": both}, "allOf": tilts},
            "preload": one_of,
            "thermal": {"required": [thermal_keys.CONDUCTANCES]},
            "rows": {"items": {"required": ["position_mm"]}},
        },
        "allOf": [
            # Beside a bearing of all rows, a row's own may be single keys.
            {
                "if": {"not": {"required": ["bearing"]}},
                "then": {"properties": {"rows": {"items": {"properties": {"bearing": own}}}}},
            },
            {
                "if": _DEEP_GROOVE,
                "else": {"properties": {"rows": {"items": {"anyOf": [{"required": ["carries"]}, _DEEP_GROOVE]}}}},
            },
        ],
    }
    alone = {
        "required": ["bearing", "operation"],
        "if": {"required": ["preload"]},
        "then": {"properties": {"operation": {"not": {"anyOf": axial}}}},
    }
    of_set = {"anyOf": [{"required": [name]} for name in MAKES_SET]}
    return [
        {"if": of_set, "then": {"required": ["rows"]}},
        {"not": {"required": ["vary", "spectrum"]}},
        {"properties": {"spectrum": {"items": {"not": {"anyOf": both}}}}},
        {"if": STUDY_LIFTS, "else": given},
        {"if": {"anyOf": [STUDY_LIFTS, of_set]}, "else": alone},
    ]


def _number(key: Key, note: str = "") -> Schema:
    """Of a key: a number in its range, and what it is."""
    schema = dict(_NUMBER)
    if key.range is not None:
        low, high = (_bound(key, value, way) for value, way in zip(key.range, (-inf, inf), strict=True))
        schema |= {"minimum": low, "maximum": high}
    unit = printed_unit(key.unit)
    words = key.field.replace("_", " ").capitalize() + (f" [{unit}]" if unit else "")
    return _told(schema, f"{words}: {note}" if note else words)


def closed(properties: Mapping[str, Schema]) -> Schema:
    """A table of these keys and no others."""
    return {"type": "object", "properties": dict(properties), "additionalProperties": False}


def _list(items: Schema, least: int = 0) -> Schema:
    return {"type": "array", "items": items} | ({"minItems": least} if least else {})


def _numbers(keys: Iterable[Key], table: str) -> dict[str, Schema]:
    return {key.name: _number(key, notes().get((table, key.name), "")) for key in keys}


def _choice(name: str, table: str) -> Schema:
    return _told({"enum": [str(word) for word in CHOICES_OF_FILES[name]]}, notes().get((table, name), ""))


def _nested(flat: Mapping[str, Schema]) -> Schema:
    """A table of keys with points, which TOML reads as tables within it; a word may stand for one of these."""
    words = {name: each for name, each in flat.items() if "." not in name}
    tables: dict[str, dict[str, Schema]] = {}
    for name, each in flat.items():
        head, _, rest = name.partition(".")
        if rest:
            tables.setdefault(head, {})[rest] = each
    within = {name: _nested(own) for name, own in tables.items()}
    both = {name: {"anyOf": [words[name], within[name]]} if name in words else within[name] for name in within}
    return closed({**words, **both}) | {"patternProperties": {r"\.": {}}}  # a key with points in quotation marks


def _material() -> Schema:
    """A name, in small letters or capitals, or a table."""
    spellings = dict.fromkeys(each for name, own in BY_NAME.items() for each in (own.name, name))
    any_case = ["".join(map(_either, name)) for name in BY_NAME]
    return {
        "description": "A material by its name, or a table of its numbers",
        "anyOf": [
            {"enum": list(spellings)},
            {"type": "string", "pattern": f"^({'|'.join(any_case)})$"},
            closed(_numbers(MATERIAL, "material")) | {"required": list(named(required_of(Material)))},
        ],
    }


def _either(letter: str) -> str:
    """A letter in both sizes, as a pattern; a space may be an underscore."""
    if letter == " ":
        return "[ _]"
    return f"[{letter.lower()}{letter.upper()}]" if letter.isalpha() else f"\\{letter}" if letter in ".+" else letter


def _told(schema: Schema, description: str) -> Schema:
    return {"description": description, **schema} if description else dict(schema)


def _bound(key: Key, value: float, way: float) -> float:
    """The end of a range in the file's unit: of few digits, and not within any float that is read as inside."""
    bound = (value - key.zero) / key.size
    if not bound:
        return 0.0
    near = float(f"{bound:.6g}")
    step = 10.0 ** (floor(log10(abs(bound))) - 5)
    if (near - bound) * way < 0.0 and abs(near - bound) > _SLACK * abs(bound):
        near = float(f"{bound + copysign(step, way):.6g}")
    while (value - key.si(further := nextafter(near, way))) * copysign(1.0, way) >= 0.0:
        near = further
    return near
