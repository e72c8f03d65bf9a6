"""The catalogue: published bearings, each number with its source, and an example of use; data in catalogue/*.toml."""

from __future__ import annotations

import difflib
import tomllib
from dataclasses import dataclass
from importlib.resources import files
from typing import Any


@dataclass(frozen=True)
class Entry:
    """One published bearing, in the words and units of a scene file."""

    name: str
    description: str
    source: str
    bearing: dict[str, Any]
    """The [bearing] table of a scene file, complete."""
    provenance: dict[str, str]
    """For each key of `bearing`, where its value comes from, or that it is assumed."""
    material_provenance: dict[str, str]
    """Likewise of single numbers of a material, as `ball_material.density_kg_m3`, where they are not of one source."""
    example: dict[str, dict[str, Any]]
    """The [operation] and [effects] tables of a scene that uses it."""
    dimensions: dict[str, float]
    """Of its cross-section, by keys with units, as far as a source prints them."""

    @property
    def assumed(self) -> tuple[str, ...]:
        """Keys whose values the source does not print."""
        return tuple(key for key, origin in self.provenance.items() if origin.startswith("assumed"))


def entries() -> list[Entry]:
    """All entries, in the order of their names."""
    folder = files("qsbearing.io.catalogue")
    texts = [file.read_text("utf-8") for file in folder.iterdir() if file.name.endswith(".toml")]
    return sorted((_entry(tomllib.loads(text)) for text in texts), key=lambda entry: entry.name.lower())


def find(name: str) -> Entry | None:
    """The entry of this name, in capitals or not; None where there is none: `nearest` may know a similar one."""
    return next((entry for entry in entries() if entry.name.lower() == name.strip().lower()), None)


def nearest(name: str) -> str:
    """A sentence that helps whoever asked for a name that the catalogue does not hold."""
    names = {entry.name.lower(): entry.name for entry in entries()}
    similar = difflib.get_close_matches(name.strip().lower(), names, n=1, cutoff=0.5)
    if similar:
        return f"Did you mean {names[similar[0]]}?"
    return f"The catalogue holds {', '.join(names.values())}."


def _entry(data: dict[str, Any]) -> Entry:
    # The kind stands beside the name in the data, where a reader looks for it, and in the bearing in a scene file.
    bearing = {"kind": data["kind"].replace(" ", "_"), **data["bearing"]}
    return Entry(
        data["name"], data["description"], data["source"], bearing, data["provenance"],
        data.get("material_provenance", {}), data["example"],
        {key: value for key, value in data.get("dimensions", {}).items() if key != "source"},
    )  # fmt: skip
