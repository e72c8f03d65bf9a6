"""What is wrong with an example, found without running it."""

from __future__ import annotations

import ast
import inspect
import json
import re
import shlex
import tomllib
from collections.abc import Callable, Collection, Iterator
from types import ModuleType
from typing import Any

import click

import qsbearing as qs
import qsbearing.cli
from fem_check.cli import cli as fem_check
from qsbearing import pictures
from tests.guide.examples import INLINE, Example
from tests.guide.known_names import OF_OTHERS, OWN_WORDS, is_key, is_known, is_result
from tests.guide.pages import ROOT, commands

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROGRAMS: dict[str, click.Group] = {"qsbearing": qsbearing.cli.cli, "fem-check": fem_check}
OTHERS = {"apt-get", "bash", "git", "lint-imports", "mypy", "pre-commit", "ruff", "tombi"}
"""Programs that examples may start beside those of this project and of Python."""
PUBLIC_MODULES = {"qsbearing", "qsbearing.pictures", "qsbearing.readings"}
OPTIONS = {
    name
    for program in PROGRAMS.values()
    for command in program.commands.values()
    for option in command.params
    for name in (*option.opts, *option.secondary_opts)
} | {"--help", "--version", "-m", "-n", "--record-durations"}
_PLACEHOLDER = re.compile(r"\b[A-Z][A-Z_]+\b|\.\.\.")


def wrong(example: Example, beside: Collection[str] = ()) -> list[str]:
    """What a reader who copies it would stumble over.

    Args:
        beside: words of the blocks of its page, which a sentence may name.
    """
    if example.language != INLINE and example.language not in RULES:
        return [f"no rule for examples in {example.language!r}"]
    try:
        if example.language == INLINE:
            is_source = example.where.partition(":")[0].endswith(".py")
            return list(_wrong_inline(example.text, beside, is_source))
        return list(RULES[example.language](example.text))
    except (SyntaxError, ValueError) as error:  # of Python; of TOML, JSON and quotes of a shell
        return [f"cannot be read: {error}"]


# Shell ----------------------------------------------------------------------------------------------------------------


def wrong_commands(text: str) -> Iterator[str]:
    """Programs, commands, options, choices and files of the repository that are not there."""
    for words in commands(text):
        yield from _wrong_command(words[: words.index(">")] if ">" in words else words)


def _wrong_command(words: list[str]) -> Iterator[str]:
    first, *rest = words
    if first in ("python", "python3") and rest[:1] == ["-m"]:
        first, rest = "fem-check" if rest[1] == "fem_check" else rest[1], rest[2:]
        if first in ("venv", "build"):
            return
        if first not in PROGRAMS and first not in ("pip", "pytest"):
            path = ROOT.joinpath(*first.split("."))
            if not path.with_suffix(".py").exists() and not (path / "__main__.py").exists():
                yield f"there is no module {first}"
            return
    if first in PROGRAMS:
        yield from _wrong_arguments(first, rest)
    elif first == "pip":
        yield from (
            f"there is no extra {extra!r}"
            for word in rest
            for extras in re.findall(r"^(?:\.|qsbearing)\[([\w,-]+)\]$", word)
            for extra in extras.split(",")
            if extra not in PROJECT["project"]["optional-dependencies"]
        )
    elif first == "pytest":
        yield from _wrong_tests(rest)
    elif first not in OTHERS:
        yield f"{first} is no program of this project"


def _wrong_tests(words: list[str]) -> Iterator[str]:
    marks = {each.partition(":")[0] for each in PROJECT["tool"]["pytest"]["ini_options"]["markers"]}
    for before, word in zip(["", *words], words, strict=False):
        if before == "-m" and word not in marks:
            yield f"no test is marked {word!r}"
        if "/" in word and not (ROOT / word).exists():
            yield f"there is no {word}"


def _wrong_arguments(program: str, words: list[str]) -> Iterator[str]:
    """As click reads them, but for files, which another line may write."""
    group = PROGRAMS[program]
    if not words or words[0] in ("--version", "--help"):
        return
    if words[0] not in group.commands:
        yield f"{program} has no command {words[0]!r}"
        return
    command = group.commands[words[0]]
    context = click.Context(command, info_name=words[0])
    try:
        given, left, _ = command.make_parser(context).parse_args(list(words[1:]))
    except click.UsageError as error:
        yield f"{shlex.join([program, *words])}: {error.format_message()}"
        return
    if left:
        yield f"{shlex.join([program, *words])}: nothing takes {left}"
    for parameter in command.params:
        values = given.get(parameter.name or "")
        for value in values if isinstance(values, list | tuple) else [values]:
            if isinstance(value, str) and not _PLACEHOLDER.fullmatch(value):
                yield from _wrong_value(parameter, value, context)


def _wrong_value(parameter: click.Parameter, value: str, context: click.Context) -> Iterator[str]:
    option = parameter.opts[0]
    if option in ("--set", "--vary", "--over"):
        path = re.sub(r"^\d+:", "", value.partition("=")[0])
        if not _PLACEHOLDER.search(path) and not is_key(path):
            yield f"{option} {value}: {path} is no key of a file"
    elif option in ("--goal", "--limit", "--minimise", "--maximise", "--quantity"):
        name = re.split("[<>=]", value)[0]
        if not _PLACEHOLDER.search(name) and not is_result(name):
            yield f"{option} {value}: {name} is no result"
    elif not isinstance(parameter.type, click.Path | click.File):
        try:
            parameter.type.convert(value, parameter, context)
        except click.UsageError as error:
            yield f"{option} {value}: {error.format_message()}"


# TOML -----------------------------------------------------------------------------------------------------------------

UNITS = {
    "mm": "mm", "um": "µm", "N": "N", "Nm": "N m", "MPa": "MPa", "GPa": "GPa", "deg": "°", "mrad": "mrad", "rpm": "rpm",
    "C": "°C", "W": "W", "kW": "kW", "kg": "kg", "Hz": "Hz", "h": "h",
}  # fmt: skip
"""By the end of a key."""
_COMMENT_UNIT = re.compile(
    r"(?:^ | in |\d |\[)(kN|N m|Nm|N/µm|N|mm|µm|um|m|inch(?:es)?|MPa|GPa|degrees|deg|°C|°|mrad|rad|rpm|rad/s|"
    r"1/min|kW|W|K|kg|Hz|h|s)(?![\w/])"
)
_SAME = {"Nm": "N m", "um": "µm", "deg": "°", "degrees": "°", "1/min": "rpm"}


def wrong_tables(text: str) -> Iterator[str]:
    """Keys that no file has, and comments in another unit than the key's."""
    yield from _wrong_keys(tomllib.loads(text))
    for line in text.splitlines():
        key = re.match(r"\s*([\w.]+)\s*=[^#]*#\s*(.*)", line)
        if key:
            yield from _wrong_unit(UNITS.get(key[1].rpartition("_")[2]), key[1], key[2])


def _wrong_keys(table: dict[str, Any], path: str = "") -> Iterator[str]:
    for key, value in table.items():
        if not is_key(key) and key not in OF_OTHERS and not (path == "" and is_result(key)):
            yield f"{key} is no key of a file"
        for each in value if isinstance(value, list) else [value]:
            if isinstance(each, dict) and f"{path}{key}" not in OWN_WORDS:
                yield from _wrong_keys(each, f"{path}{key}.")


def _wrong_unit(unit: str | None, of: str, comment: str) -> Iterator[str]:
    told = {_SAME.get(each, each) for each in _COMMENT_UNIT.findall(f" {comment}")}
    if unit and told and unit not in told:
        yield f"{of} is in {unit}, and the comment beside it in {', '.join(sorted(told))}"


# Python ---------------------------------------------------------------------------------------------------------------


def wrong_program(text: str) -> Iterator[str]:
    """Imports and names that are not public; comments in another unit than the argument's beside them. Whether a
    function takes its arguments shows where the program runs."""
    comments = {number: line.partition("  # ")[2] for number, line in enumerate(text.splitlines(), 1)}
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (f"{each.name} is not public" for each in node.names if _is_private(each.name))
        elif isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] in ("qsbearing", "fem_check"):
            module = node.module or ""
            public = getattr(__import__(module, fromlist=["*"]), "__all__", ())
            names = [each.name for each in node.names]
            yield from (
                f"{module}.{name} is not public"
                for name in names
                if module not in PUBLIC_MODULES or (name not in public and f"{module}.{name}" not in PUBLIC_MODULES)
            )
        elif isinstance(node, ast.Attribute):
            yield from _wrong_name(node)
        elif isinstance(node, ast.keyword):
            comment = comments.get(node.value.end_lineno or 0, "")
            yield from _wrong_unit(_unit_of(node.value), f"{node.arg}=...", comment)


def _is_private(module: str) -> bool:
    return module.partition(".")[0] in ("qsbearing", "fem_check") and module not in PUBLIC_MODULES


def _chain(node: ast.expr) -> list[str]:
    """`qs.readings.life` as its three names; nothing where it does not begin with qs or a public module."""
    names: list[str] = []
    while isinstance(node, ast.Attribute):
        names.insert(0, node.attr)
        node = node.value
    return [node.id, *names] if isinstance(node, ast.Name) and node.id in ("qs", "qsbearing", "pictures") else []


def public(names: list[str]) -> Any:
    """What a chain of names is; AttributeError where one of them is not there or not public."""
    value: Any = pictures if names[0] == "pictures" else qs
    for name in names[1:]:
        shown = getattr(value, "__all__", None) if isinstance(value, ModuleType) else None
        if (shown is not None and name not in shown and name != "pictures") or name.startswith("_"):
            raise AttributeError(name)
        if inspect.isclass(value) and name in getattr(value, "__dataclass_fields__", ()):
            return None
        value = getattr(value, name)
    return value


def _wrong_name(node: ast.Attribute) -> Iterator[str]:
    if names := _chain(node):
        try:
            public(names)
        except AttributeError:
            yield f"{'.'.join(names)} is no public name"


def _unit_of(value: ast.expr) -> str | None:
    """The unit that a value is multiplied by, as comments spell it."""
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Mult) and (names := _chain(value.right)):
        return UNITS.get(names[-1], names[-1])
    return None


# Others ---------------------------------------------------------------------------------------------------------------


def wrong_json(text: str) -> Iterator[str]:
    """A program to start, with its arguments, that is not there."""
    found = [json.loads(text)]
    for each in found:
        if isinstance(each, dict):
            found += each.values()
            if isinstance(each.get("command"), str):
                yield from _wrong_command([each["command"].rpartition("/")[2], *map(str, each.get("args", ()))])


def _nothing(_: str) -> Iterator[str]:
    yield from ()


RULES: dict[str, Callable[[str], Iterator[str]]] = {
    "sh": wrong_commands,
    "toml": wrong_tables,
    "python": wrong_program,
    "json": wrong_json,
    "xml": _nothing,
    "text": _nothing,
    "matlab": _nothing,
}
"""By the language of a block."""


# Within sentences -----------------------------------------------------------------------------------------------------


def _wrong_inline(text: str, beside: Collection[str], is_source: bool) -> Iterator[str]:
    """A command, an option, lines of a file, a name of Python, of a key or a result. Of strings of the code only
    commands, options and public Python are looked at."""
    if re.match(r"(?:\.venv/bin/)?(?:qsbearing|fem-check) [a-z]|(?:pip install|pytest|python -m) ", text):
        *begin, last = text.split()
        is_named = last.startswith("-") and last in OPTIONS  # an option of it, without a value
        yield from wrong_commands(" ".join(begin) if is_named else text)
    elif re.match(r"--[a-z]", text):
        option = re.split("[ =]", text)[0]
        if option not in OPTIONS:
            yield f"no command has {option}"
    elif re.match(r"qs\.[a-zA-Z][\w.]*(?:\(|$)", text) and not _PLACEHOLDER.search(text):
        names = re.split(r"[^\w.]", text)[0].split(".")
        try:
            public(names)
        except AttributeError:
            yield f"{text} is no public name"
    elif is_source:
        return
    elif re.fullmatch(r"\[\[?[a-z][\w.]*\]\]?", text):
        if not is_key(text.strip("[]")):
            yield f"{text} is no table of a file"
    elif re.match(r"[a-z][\w.]* = \S", text) and not _PLACEHOLDER.search(text):
        yield from wrong_tables(text)
    elif re.fullmatch(r"[a-z]\w*(?:\.\w+)*", text) and not re.search(r"_$|\.(?:toml|json|ipynb)$", text):
        names = [each for each in text.split(".") if "_" in each and not re.fullmatch(r"rows?_\d+", each)]
        if not is_known(text):
            yield from (f"nothing is called {each}" for each in names if each not in beside and not is_known(each))
