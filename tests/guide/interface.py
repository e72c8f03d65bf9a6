"""What files and programs of users may rely on, from the tables of the code: `python -m tests.guide.interface` adds new
names to those that stay (interface.json), of which none is dropped or renamed; the guide's page lists them.
"""

from __future__ import annotations

import ast
import inspect
import json
from collections.abc import Iterable, Iterator
from enum import Enum
from inspect import isclass
from pathlib import Path
from textwrap import dedent
from typing import Any

import click
from click.testing import CliRunner

import qsbearing as qs
from fem_check.checks import ALL, OPTIONAL
from fem_check.cli import cli as fem_check
from qsbearing.cli import cli as qsbearing
from qsbearing.model.solution.result_keys import Place, spelled
from qsbearing.readings.asked import every_group
from qsbearing.studies.schema import file_schema
from qsbearing.systems.sets.set_groups import OF_ROWS, OF_SHAFT, SYSTEM

KEPT = Path(__file__).with_name("interface.json")
PAIR = '{start}\n[[rows]]\nposition_mm = 0\ncarries = "+x"\n[[rows]]\nposition_mm = 20\ncarries = "-x"\n'
LOADED = '[bearing]\nname = "7210C"\n[operation]\nspeed_rpm = 1000\naxial_load_N = 100\n'

HOLDERS = {"qs": qs, "qs.readings": qs.readings}
"""Of public names."""

Names = dict[str, list[str]]


def found() -> dict[str, Names]:
    """Names by kind and group, each group in order."""
    kinds = {"files": files(), "python": python(), "commands": commands(), "json": output()}
    return kinds | {"results": results()}


def files() -> Names:
    """Keys of scene, set and study files by table."""
    schema = file_schema()
    tables: dict[str, set[str]] = {}
    _walk(schema, schema, "", tables, 0)
    return {name or "(outside tables)": sorted(keys) for name, keys in sorted(tables.items())}


def _walk(node: Any, schema: dict[str, Any], path: str, tables: dict[str, set[str]], depth: int) -> None:
    if "$ref" in node:
        node = schema["definitions"][node["$ref"].rpartition("/")[2]]
    for each in (*node.get("anyOf", []), *node.get("oneOf", []), *([node["items"]] if "items" in node else [])):
        _walk(each, schema, path, tables, depth)
    for key, value in node.get("properties", {}).items() if depth < DEEPEST else ():
        before: set[str] = set()
        inner: dict[str, set[str]] = {}
        _walk(value, schema, f"{path}.{key}".strip("."), inner, depth + 1)
        tables.setdefault(path, before).add(key)
        for name, keys in inner.items():
            tables.setdefault(name, set()).update(keys)


DEEPEST = 4
"""Tables within tables."""


def python() -> Names:
    """Names of `qs` and `qs.readings`, and of every class there."""
    of = {name: sorted(holder.__all__) for name, holder in HOLDERS.items()}
    return of | {name: _public(each) for name, each in classes().items()}


def classes() -> dict[str, type]:
    """The public ones, by their names."""
    values = {f"{at}.{name}": getattr(of, name) for at, of in HOLDERS.items() for name in of.__all__}
    return {name: value for name, value in values.items() if isclass(value)}


def _public(of: type) -> list[str]:
    """Words of a choice; of other classes what they have without an underscore, and what their methods set."""
    if issubclass(of, Enum):
        return [str(each.value) for each in of]
    own = [each for each in of.__mro__ if each.__module__.partition(".")[0] == "qsbearing"]
    named = {name for each in own for name in {*vars(each), *inspect.get_annotations(each), *_set_by(each)}}
    return sorted(name for name in named if not name.startswith("_"))


def words_of(of: type, shown: Iterable[str]) -> set[str]:
    """What names of the reference are among those that stay: of a choice its members' words."""
    return {str(of[name].value) for name in shown} if issubclass(of, Enum) else set(shown)


def _set_by(of: type) -> Iterator[str]:
    for node in ast.walk(ast.parse(dedent(inspect.getsource(of)))):
        if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield from [node.attr] if isinstance(node.value, ast.Name) and node.value.id == "self" else []


def commands() -> Names:
    """Options of each command, with the names of checks."""
    groups = (("qsbearing", qsbearing), ("fem-check", fem_check))
    options = {f"{name} {each}": _options(one) for name, group in groups for each, one in group.commands.items()}
    return dict(sorted(options.items())) | {"fem-check run CHECK": sorted({*ALL, *OPTIONAL})}


def _options(command: click.Command) -> list[str]:
    return sorted(option for each in command.params for option in each.opts if option.startswith("--"))


def output() -> Names:
    """Keys of `run --json` for a bearing and for a pair, and within its tables."""
    keys: dict[str, set[str]] = {}
    runner = CliRunner()
    for text in (LOADED, PAIR.format(start=LOADED)):
        done = runner.invoke(qsbearing, ["run", "-", "--json"], input=text)
        _keys(json.loads(done.stdout), "", keys)
    return {name or "run --json": sorted(each) for name, each in sorted(keys.items())}


def results() -> Names:
    """Names of results for studies and limits, without the row of a set and without what says over which balls."""
    every = every_group()
    groups = {"of a bearing": every, "of a row": OF_ROWS, "of a set": [*OF_SHAFT, SYSTEM]}
    return {
        name: sorted({spelled(Place(group, each)) for group in of for each in group.results})
        for name, of in groups.items()
    }


def _keys(value: Any, path: str, keys: dict[str, set[str]]) -> None:
    if isinstance(value, list):
        for each in value:
            _keys(each, path, keys)
    elif isinstance(value, dict) and not path.startswith(("input", "rows.", "provenance", "remarks.")):
        keys.setdefault(path, set()).update(value)
        for key, each in value.items():
            _keys(each, f"{path}.{key}".strip("."), keys)


def kept() -> dict[str, Names]:
    """The names that stay."""
    return dict(json.loads(KEPT.read_text(encoding="utf-8"))) if KEPT.is_file() else {}


def dropped(before: dict[str, Names], now: dict[str, Names]) -> list[str]:
    """Names that stay and are not there any more."""
    return [
        f"{kind}: {group}: {name}"
        for kind, groups in before.items()
        for group, names in groups.items()
        for name in sorted({*names} - {*now.get(kind, {}).get(group, [])})
    ]


def with_new(before: dict[str, Names], now: dict[str, Names]) -> dict[str, Names]:
    """Both, each name once."""
    kinds = {kind: {**before.get(kind, {}), **groups} for kind, groups in now.items()}
    return {
        kind: {group: sorted({*before.get(kind, {}).get(group, []), *names}) for group, names in sorted(groups.items())}
        for kind, groups in kinds.items()
    }


def table(kind: str, heading: str) -> str:
    """A group a row; of a row of a set and of materials what is as elsewhere is left out."""
    names = kept()[kind]
    lines, told = [f"| {heading} | names |", "|---|---|"], set[tuple[str, ...]]()
    for group, each in names.items():
        again = ("material" if group.endswith("material") else group.rpartition(".")[2], *each)
        if each and again not in told and group != "vary":
            lines.append(f"| `{group}` | {_listed(each)} |")
        told.add(again)
    return "\n".join(lines)


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def main() -> None:
    """Keep what is new."""
    KEPT.write_text(json.dumps(with_new(kept(), found()), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
