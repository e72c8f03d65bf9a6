"""The pages of the reference: names in Python, keys of files, commands, results."""

from __future__ import annotations

import inspect
import json
import re
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from typing import Any

import click

from qsbearing.model.solution.result_keys import ROW, Group, Place, printed_unit
from qsbearing.site.meanings import meanings

GROUPS: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "scene": (
        "A bearing and its operation",
        "What is solved: a bearing, how it is operated, and which effects count.",
        ("load_scene", "Scene", "BallBearing", "BearingKind", "Operation", "Preload", "Material", "STEEL",
         "SILICON_NITRIDE", "catalogue_numbers"),
    ),
    "effects": (
        "Effects and hypotheses",
        "What a scene may ask for; what it does not name is not computed.",
        ("CentrifugalForce", "GyroscopicMoment", "RacewayControl", "MomentShares", "MotionOfBalls", "Traction",
         "TractionLaw", "OrbitRadius", "HertzAngle", "HertzForm", "TiltLever", "RingExpansion", "RingState",
         "BallExpansion", "BallDiameterDeviations", "SeatsOutOfRound", "ElasticRings"),
    ),
    "solution": (
        "Solving, and what is found",
        "One call solves all cases of a scene.",
        ("solve", "stiffness", "Solution", "RacewayContacts", "Status", "Reason", "message", "warnings", "requirements",
         "plot", "html_of"),
    ),
    "sets": (
        "Rows on one shaft",
        "Pairs, spindles and gear shafts.",
        ("load_set", "solve_set", "BearingSet", "Row", "Shaft", "ShaftSection", "ShaftLoad", "ShaftMass",
         "ShaftSupport", "Gear", "Belt", "Housing", "HousingStiffness", "Spacer", "FloatingGroup", "SetSolution",
         "preload_loads", "preload_speeds", "system_life"),
    ),
    "studies": (
        "Many cases",
        "Ranges, distributions, searches and comparisons.",
        ("Study", "sweep", "open_results", "sobol_indices", "find", "compare"),
    ),
    "data_sheets": (
        "Bearings from a data sheet",
        "Ball sets and grooves that a catalogue's numbers allow.",
        ("DataSheet", "infer_bearing", "InferredBearing", "RatingPractice"),
    ),
    "heat_and_rotors": (
        "Heat and rotor dynamics",
        "Steady temperatures; stiffness for other programs.",
        ("Thermal", "Conductance", "OilFlow", "stiffness_table", "stiffness_over_frequency", "force_table",
         "to_ross", "ross_element"),
    ),
    "contact": (
        "One contact",
        "Hertz's contact of two bodies.",
        ("point_contact", "PointContact", "subsurface_shear"),
    ),
    "errors": (
        "Errors",
        "Wrong inputs are told all at once.",
        ("SceneError", "ErrorDetail", "SceneFileError", "FileErrorDetail"),
    ),
    "units": (
        "Units",
        "`10_000 * qs.rpm` is a speed in rad/s, `angle / qs.deg` an angle in degrees.",
        ("GPa", "MPa", "N", "Nm", "Nmm", "Pa", "deg", "kg", "kg_m3", "kN", "m", "mm", "mrad", "rad", "rpm", "um",
         "zero_celsius"),
    ),
}  # fmt: skip
"""Of each page: its title, what it is about, and the public names on it, each on one page."""


Pages = dict[str, tuple[str, str]]
"""By file: the title in the list of pages, and the text."""


def python_pages() -> Pages:
    """A page for each group of public names, and one for each reading."""
    import qsbearing as qs

    pages = {}
    for name, (title, about, names) in GROUPS.items():
        if name == "units":
            rows = "".join(f"| `qs.{each}` | {getattr(qs, each):.12g} |\n" for each in names)
            body = f"| name | in SI |\n|---|---|\n{rows}"
        else:
            body = "\n".join(f"::: qsbearing.{each}\n" for each in names)
        pages[f"python/{name}.md"] = (title, f"# {title}\n\n{about}\n\n{body}")
    pages["python/readings.md"] = ("Readings", _readings())
    return pages


def _readings() -> str:
    from qsbearing import readings

    public = [name for name in readings.__all__ if not name.startswith("_")]
    listed = "\n".join(f"::: qsbearing.readings.{name}\n" for name in public)
    return f"# Readings\n\nWhat follows from a solution: life, films, friction, frequencies, edges.\n\n{listed}"


# Keys of files --------------------------------------------------------------------------------------------------------


def key_pages() -> Pages:
    """A page for each table of a scene, set or study file."""
    from qsbearing.studies.schema import file_schema

    schema, told = file_schema(), meanings()
    pages = {}
    for table, given in schema["properties"].items():
        rows = list(_rows(given, schema, told, ()))
        if not rows:
            continue
        listed = "".join(f"| `{key}` | {meaning} | {values} |\n" for key, meaning, values in rows)
        head = f"# [{table}]\n\n{_told(given)}\n\n" if _told(given) else f"# [{table}]\n\n"
        pages[f"files/{table}.md"] = (f"[{table}]", f"{head}| key | meaning | values |\n|---|---|---|\n{listed}")
    return pages


def _told(schema: Mapping[str, Any]) -> str:
    return str(schema.get("description", ""))


def _rows(
    schema: Mapping[str, Any], whole: Mapping[str, Any], told: Mapping[str, set[str]], path: tuple[str, ...]
) -> Iterator[tuple[str, str, str]]:
    """Of every key below: its path, its meaning, the values it takes."""
    for each in _branches(schema, whole):
        for key, given in each.get("properties", {}).items():
            below = list(_rows(given, whole, told, (*path, key))) if len(path) < 4 else []
            if not below:
                yield ".".join((*path, key)), _meaning((*path, key), given, whole, told), _values(given, whole)
            yield from below


def _branches(schema: Mapping[str, Any], whole: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """What a schema may be: itself, what it refers to, its alternatives, its items."""
    schema = _resolved(schema, whole)
    yield schema
    for each in schema.get("anyOf", ()):
        yield from _branches(each, whole)
    if isinstance(schema.get("items"), Mapping):
        yield from _branches(schema["items"], whole)


def _resolved(schema: Mapping[str, Any], whole: Mapping[str, Any]) -> Mapping[str, Any]:
    name = schema.get("$ref", "").rpartition("/")[2]
    return _resolved(whole["definitions"][name], whole) if name else schema


def _meaning(
    path: tuple[str, ...], given: Mapping[str, Any], whole: Mapping[str, Any], told: Mapping[str, set[str]]
) -> str:
    """What the schema says, and where that is but a name and a unit, what the docstring of the field says, if one
    field alone has the key."""
    said = _told(given) or _told(_resolved(given, whole)) or path[-1].replace("_", " ").capitalize()
    own = told.get(".".join(path[-2:])) or told.get(path[-1]) or set()
    is_bare = ":" not in said and len(said.split()) < 6
    in_si = [re.sub(r"\s*\[[^\]]*\]", "", each).strip(" ;.") for each in own]
    return _cell(f"{said}: {in_si[0][:1].lower()}{in_si[0][1:]}" if is_bare and len(in_si) == 1 and in_si[0] else said)


def _values(given: Mapping[str, Any], whole: Mapping[str, Any]) -> str:
    """A range, words, or the kind of value."""
    values = []
    for each in _branches(given, whole):
        if "enum" in each:
            values.append(_words(each["enum"]))
        elif "const" in each:
            values.append(f"`{_toml(each['const'])}`")
        elif "minimum" in each or "maximum" in each:
            values.append(f"{each.get('minimum', -float('inf')):.6g} to {each.get('maximum', float('inf')):.6g}")
        elif "type" in each:
            kinds = each["type"] if isinstance(each["type"], list) else [each["type"]]
            values.append(KINDS.get(kinds[0], "a number"))
    return _cell("; or ".join(dict.fromkeys(values)))


KINDS = {"string": "a word", "array": "a list", "object": "a table", "boolean": "`true`, `false`"}
MOST_WORDS = 12


def _words(of: list[Any]) -> str:
    more = ", …" if len(of) > MOST_WORDS else ""
    return ", ".join(f"`{_toml(each)}`" for each in of[:MOST_WORDS]) + more


def _toml(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


# Commands -------------------------------------------------------------------------------------------------------------

PROGRAMS = {"qsbearing": "qsbearing.cli", "fem-check": "fem_check.cli"}
"""Both programs, and where their commands are; loaded by name, as no module of qsbearing imports its check."""


def command_pages() -> Pages:
    """A page for each program, with its commands from click."""
    pages = {}
    for program, module in PROGRAMS.items():
        group = import_module(module).cli
        listed = "\n".join(_command(f"{program} {name}", command) for name, command in sorted(group.commands.items()))
        pages[f"commands/{program}.md"] = (program, f"# Commands of {program}\n\n{_help(group)}\n\n{listed}")
    return pages


def _command(title: str, command: click.Command) -> str:
    context = click.Context(command, info_name=title)
    usage = " ".join((title, *command.collect_usage_pieces(context)))
    options = [each.get_help_record(context) for each in command.params if isinstance(each, click.Option)]
    rows = "".join(f"| `{_cell(record[0])}` | {_cell(record[1])} |\n" for record in filter(None, options))
    table = f"\n| option | meaning |\n|---|---|\n{rows}" if rows else ""
    return f"## {title}\n\n```text\n{usage}\n```\n\n{_help(command)}\n{table}"


def _help(of: click.Command) -> str:
    """Its paragraphs; those that click does not wrap, which begin with a mark of their own, as they are."""
    paragraphs = inspect.cleandoc(of.help or "").split("\n\n")
    return "\n\n".join(
        f"```text\n{each.removeprefix(UNWRAPPED)}\n```" if each.startswith(UNWRAPPED) else each for each in paragraphs
    )


UNWRAPPED = "\b\n"


# Results --------------------------------------------------------------------------------------------------------------


def result_pages() -> Pages:
    """Every result by its name, with unit, meaning and source."""
    from qsbearing.model.solution.groups import GROUPS as OF_BEARINGS
    from qsbearing.readings.asked import READINGS
    from qsbearing.systems.sets.set_groups import OF_ROWS, OF_SHAFT, PLAY, SLIDE, SYSTEM, TORQUES

    of_readings = [group for each in READINGS.values() for group in each.groups]
    return {
        "results/bearing.md": ("Of a bearing", _results("Results of a bearing", OF_BEARINGS)),
        "results/readings.md": ("Of readings", _results("Results of readings", of_readings)),
        "results/row.md": ("Of a row", _results("Results of a row of a set", OF_ROWS, f"{ROW}_1_")),
        "results/set.md": ("Of a set", _results("Results of a set", (*OF_SHAFT, SLIDE, PLAY, TORQUES, SYSTEM))),
    }


ROW_TOLD = "A row has these and all of a bearing, with its number before the name."


def _results(title: str, groups: Iterable[Group], row: str = "") -> str:
    """A table of them under the names that studies and limits take."""
    rows = []
    for group in groups:
        for each in group.results:
            symbol = f"${each.symbol}$" if each.symbol else ""
            unit, source = printed_unit(each.unit) or "none", each.source or group.source
            name = f"`{row}{Place(group, each).column}`"
            rows.append(f"| {' | '.join(map(_cell, (name, each.plain_name, unit, symbol, source)))} |\n")
    head = "| name | meaning | unit | symbol | source |\n|---|---|---|---|---|\n"
    said = "Under these names results are asked for in `[require]`, limits and studies, and stand in tables."
    return f"# {title}\n\n{said}{f' {ROW_TOLD}' if row else ''}\n\n{head}{''.join(rows)}"
