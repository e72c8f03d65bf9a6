"""A commented scene file to start from, `template.toml` filled in; what it says is a scene that solves."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from string import Template
from typing import Any

from qsbearing.files.catalogue import CatalogueEntry
from qsbearing.files.file_keys import reading_tables
from qsbearing.files.toml import read_back, tables_of


def scene_template(entry: CatalogueEntry, by_name: bool) -> str:
    """The text of a scene file around a catalogue entry.

    A key of the template takes the entry's value; without one it stays if it is a comment there, else it goes.

    Args:
        by_name: name the entry and leave its values as comments; else spell them all out, ready to be changed.
    """
    values = {**({"name": entry.name} if by_name else {}), **entry.bearing}
    values |= entry.example["operation"] | entry.example["effects"]
    template = Template(Path(__file__).with_name("template.toml").read_text("utf-8"))
    text = template.substitute(
        name=entry.name, description=entry.description, file=f"{entry.name.lower()}.toml", readings=_readings()
    )
    lines = []
    for line in text.splitlines():
        key, _, rest = line.removeprefix("# ").partition(" = ")
        if key in values:
            mark = "# " if by_name and key in entry.bearing else ""
            setting, note = f"{mark}{key} = {_toml(values[key])}", rest.partition("  #")[2]
            lines.append(f"{setting:<35}  #{note}" if note else setting)
        elif line.startswith("# ") or not key.isidentifier():
            lines.append(line)
    text = "\n".join(lines) + "\n"
    named = {"bearing": {"name": entry.name}} if by_name else {"bearing": dict(entry.bearing)}
    path, wanted = Path("template.toml"), named | entry.example
    tables = tables_of(text, path)
    read_back(text, tables | {table: tables.get(table, {}) | own for table, own in wanted.items()}, path)
    return text


def _readings() -> str:
    """Every table of a reading, as comments; first those that need no numbers."""
    tables = reading_tables()
    lines = [f"# {name} = true" for name, table in tables.items() if not table.example]
    for name, table in tables.items():
        if table.example:
            heading = f"# [readings.{name}]"
            lines += ["", f"{heading:<37}# {table.note}" if table.note else heading]
            lines += [f"# {line}" for line in table.example.splitlines()]
    return "\n".join(lines)


def set_template(entry: CatalogueEntry) -> str:
    """The text of a file of a set: two rows of a catalogue entry, back to back."""
    template = Template(Path(__file__).with_name("set_template.toml").read_text("utf-8"))
    width = f"{0.2857 * entry.bearing['pitch_diameter_mm']:.0f}"  # of the ISO series 2, about; a place to start from
    text = template.substitute(name=entry.name, description=entry.description, width=width)
    path = Path("set_template.toml")
    read_back(text, tables_of(text, path) | {"bearing": {"name": entry.name}}, path)
    return text


@cache
def notes() -> dict[tuple[str, str], str]:
    """What the templates say beside each key, by its table and name; of a table, name "", beside its heading."""
    by_key: dict[tuple[str, str], str] = {}
    folder, table = Path(__file__).parent, ""
    scene = (folder / "template.toml").read_text("utf-8").replace("$readings", _readings())
    for line in [*scene.splitlines(), *(folder / "set_template.toml").read_text("utf-8").splitlines()]:
        setting, _, note = line.lstrip("# ").partition(" #")
        key, equals, _ = setting.partition(" = ")
        is_heading = setting.startswith("[")
        if is_heading:
            key, table = "", setting.strip("[] ").rpartition(".")[2]
        if note and (is_heading or (equals and key.replace(".", "").isidentifier())):
            by_key.setdefault((table, key), note.strip())
    return by_key


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)
