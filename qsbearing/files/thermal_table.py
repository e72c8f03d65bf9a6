"""The table [thermal] of a file: nodes, conductances, oil, and the model of friction that heats them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.readings_table import OIL_TEMPERATURE
from qsbearing.files.table_checks import (
    Errors,
    add_missing,
    as_whole_number,
    as_word,
    checked,
    list_of,
    made,
    read_fields,
    si,
    table_model,
)
from qsbearing.files.thermal_keys import BY_NODE, CONDUCTANCE, CONDUCTANCES, OIL, THERMAL, WORDS
from qsbearing.systems.heat.network import Conductance, OilFlow, Thermal

_BY_NODE = {name: table_model(name, keys) for name, keys in BY_NODE.items()}
_OF_CONDUCTANCE = {"between": list_of(as_word), "row": as_whole_number}
NODE_KEYS = {
    "ring_expansion": {f"{node}_temperature_C": node for node in ("inner_ring", "outer_ring", "shaft", "housing")},
    "ball_expansion": {"ball_temperature_C": "balls"},
}
"""The keys of effects whose temperatures are those of nodes."""
FOUND = "is found by the heat balance: leave it out"


def thermal_of(document: dict[str, Any], errors: Errors) -> Thermal | None:
    """What a file asks of its heat, where it does."""
    table = document.get("thermal")
    if table is None:
        return None
    within = (CONDUCTANCES, "oil", *BY_NODE)
    plain = {key: value for key, value in table.items() if key not in within} if isinstance(table, dict) else table
    before = len(errors)
    fields = read_fields(Thermal, "thermal", "thermal", plain, errors, dict.fromkeys(WORDS, as_word))
    if not isinstance(table, dict):
        return None
    for name, keys in BY_NODE.items():
        numbers, _ = checked(_BY_NODE[name], f"thermal.{name}", table.get(name, {}), errors)
        fields[name] = si(keys, numbers)
    if "oil" in table:
        fields["oil"] = _oil(table["oil"], errors)
    fields["conductances"] = _conductances(table.get(CONDUCTANCES), errors)
    return made(lambda: Thermal(**fields), errors) if len(errors) == before else None


def found_temperatures(document: dict[str, Any], errors: Errors) -> frozenset[str]:
    """The keys of temperatures that the heat balance will find; errors where the file gives them as well."""
    table = document.get("thermal")
    if not isinstance(table, dict):
        return frozenset()
    nodes, rows = _nodes(table), document.get("rows")
    balance_keys = {key for keys in NODE_KEYS.values() for key, node in keys.items() if node in nodes}
    errors += _given(document.get("effects"), balance_keys, "effects")
    for number, row in enumerate(rows if isinstance(rows, list) else (), 1):
        errors += _given(row, balance_keys, f"row {number}")
    for body in ("shaft", "housing"):
        own = document.get(body)
        if body in nodes and isinstance(own, dict) and "temperature_C" in own:
            errors.append(FileErrorDetail(f"{body}.temperature_C", FOUND, own["temperature_C"], "C"))
    if "oil" in nodes or "viscosity_at" in table:
        balance_keys.add(OIL_TEMPERATURE)
        readings = document.get("readings")
        oil = readings.get("lubricant") if isinstance(readings, dict) else None
        if isinstance(oil, dict) and OIL_TEMPERATURE in oil:
            errors.append(FileErrorDetail(f"readings.lubricant.{OIL_TEMPERATURE}", FOUND, oil[OIL_TEMPERATURE], "C"))
    return frozenset(balance_keys)


def _given(table: Any, balance_keys: set[str], path: str) -> Errors:
    """Errors of the tables of ring expansion and ball expansion within this one."""
    errors: Errors = []
    for name, keys in NODE_KEYS.items():
        effect = table.get(name) if isinstance(table, dict) else None
        if isinstance(effect, dict):
            given = [key for key in keys if key in balance_keys and key in effect]
            errors += [FileErrorDetail(f"{path}.{name}.{key}", FOUND, effect[key], "C") for key in given]
    return errors


def _nodes(table: dict[str, Any]) -> set[str]:
    """Those that a table names, however wrong it may be otherwise."""
    nodes = {"oil"} if "oil" in table else set()
    conductances = table.get(CONDUCTANCES)
    for each in conductances if isinstance(conductances, list) else ():
        between = each.get("between") if isinstance(each, dict) else None
        nodes |= {str(node) for node in between} if isinstance(between, list) else set()
    return nodes


def _oil(table: Any, errors: Errors) -> OilFlow | None:
    before, fields = len(errors), read_fields(OilFlow, "oil", "thermal.oil", table, errors)
    add_missing(OilFlow, "thermal.oil", fields, errors, "a flow of oil needs it")
    return OilFlow(**fields) if len(errors) == before else None


def _conductances(tables: Any, errors: Errors) -> tuple[Conductance, ...]:
    if not isinstance(tables, list) or not tables:
        cause = 'Write [[thermal.conductances]] for each, with between = ["inner_ring", "balls"] and W_per_K = 50'
        problem = "missing" if tables is None else "is not a list of tables"
        errors.append(FileErrorDetail("[[thermal.conductances]]", problem, cause=cause))
        return ()
    conductances = []
    for number, table in enumerate(tables, 1):
        path, before = f"thermal.{CONDUCTANCES} {number}", len(errors)
        fields = read_fields(Conductance, CONDUCTANCES, path, table, errors, _OF_CONDUCTANCE)
        if "between" not in fields:
            errors.append(FileErrorDetail(f"{path}.between", "missing"))
        add_missing(Conductance, path, fields, errors)
        if len(errors) == before:
            conductances.append(Conductance(**fields | {"between": tuple(fields["between"])}))
    return tuple(conductances)


def thermal_tables(
    tables: dict[str, Any], thermal: Thermal, numbers: Callable[..., dict[str, float]]
) -> dict[str, Any]:
    """The tables of a file with [thermal], and without the temperatures that its heat balance finds.

    Args:
        numbers: the numbers that an object or a mapping holds, under these keys.
    """
    own: dict[str, Any] = {word: getattr(thermal, word) for word in WORDS if getattr(thermal, word) is not None}
    own |= numbers(THERMAL, thermal)
    own |= {name: numbers(keys, getattr(thermal, name)) for name, keys in BY_NODE.items() if getattr(thermal, name)}
    if thermal.oil is not None:
        own["oil"] = numbers(OIL, thermal.oil)
    own[CONDUCTANCES] = [
        {"between": list(each.between), **numbers(CONDUCTANCE, each), **({} if each.row is None else {"row": each.row})}
        for each in thermal.conductances
    ]
    left_out = {(name, key) for name, keys in NODE_KEYS.items() for key, node in keys.items() if node in thermal.nodes}
    left_out |= set() if thermal.oil_node is None else {("lubricant", OIL_TEMPERATURE)}
    return {**_without(left_out, tables), "thermal": own}


def _without(left_out: set[tuple[str, str]], tables: Any, table: str = "") -> Any:
    """These tables, and those within them, without some keys of some tables."""
    if isinstance(tables, list):
        return [_without(left_out, each) for each in tables]
    if not isinstance(tables, dict):
        return tables
    return {key: _without(left_out, value, key) for key, value in tables.items() if (table, key) not in left_out}
