"""The catalogue: published bearings, each number with its source, and an example of use.

Worked examples of the literature stand in a TOML file each; standard spindle bearings are rows of one printed table.
"""

from __future__ import annotations

import difflib
import tomllib
from dataclasses import replace
from functools import cache
from importlib.resources import files
from typing import Any

from qsbearing.files.catalogue.entry import Entry
from qsbearing.files.catalogue.spindle_series import spindle_bearings

__all__ = ["Entry", "chosen", "entries", "find", "nearest"]


@cache  # a study and a search look one up for each of their batches
def entries() -> tuple[Entry, ...]:
    """The worked examples, in the order of their names."""
    folder = files("qsbearing.files.catalogue")
    texts = [file.read_text("utf-8") for file in folder.iterdir() if file.name.endswith(".toml")]
    return tuple(sorted((_entry(tomllib.loads(text)) for text in texts), key=lambda entry: entry.name.lower()))


def find(name: str) -> Entry | None:
    """The entry of this name, in capitals or not; None where there is none: `nearest` may know a similar one."""
    return _by_name().get(name.strip().lower())


@cache
def _by_name() -> dict[str, Entry]:
    """Every entry; an example that is a row of the table too keeps its own numbers and takes the row's dimensions."""
    found = dict(spindle_bearings())
    for entry in entries():
        row = found.get(entry.name.lower())
        own = entry.dimensions
        found[entry.name.lower()] = entry if row is None else replace(entry, dimensions=row.dimensions | own)
    return found


def chosen(
    bore: float | None = None, angle: float | None = None, series: str = "", hybrid: bool | None = None
) -> list[Entry]:
    """The spindle bearings of these, smallest first.

    Args:
        bore: [mm].
        angle: free contact angle [deg].
        series: what the name begins with: 719, 72, KH.
        hybrid: True: of ceramic balls, False: of steel.
    """
    kept = [
        entry
        for entry in map(_by_name().__getitem__, spindle_bearings())
        if (bore is None or entry.dimensions["bore_diameter_mm"] == bore)
        and (angle is None or entry.bearing["free_contact_angle_deg"] == angle)
        and entry.name.lower().startswith(series.strip().lower())
        and (hybrid is None or (entry.bearing["ball_material"] != "steel") == hybrid)
    ]
    return sorted(kept, key=lambda entry: (entry.dimensions["bore_diameter_mm"], entry.name))


LONGEST_NAME = 60
"""Letters of a name that is compared with others, which takes the square of its length."""


def nearest(name: str) -> str:
    """A sentence that helps whoever asked for a name that the catalogue does not hold."""
    names = {entry.name.lower(): entry.name for entry in (*entries(), *spindle_bearings().values())}
    wanted = name.strip().lower()[:LONGEST_NAME]
    begun = [full for low, full in names.items() if wanted and low.removeprefix("kh").startswith(wanted)]
    if begun and any(letter.isdigit() for letter in wanted):
        return f"Did you mean {' or '.join(begun[:4])}?"
    alike = {each: difflib.SequenceMatcher(None, wanted, each).ratio() for each in names}
    similar = max(alike, key=lambda each: alike[each])  # of several alike the first, a worked example
    if alike[similar] >= 0.5:
        return f"Did you mean {names[similar]}?"
    examples = ", ".join(entry.name for entry in entries())
    return f"The catalogue holds {examples}, and spindle bearings such as 71914C: `qsbearing catalogue --bore 70`."


def _entry(data: dict[str, Any]) -> Entry:
    # The kind stands beside the name in the data, where a reader looks for it, and in the bearing in a scene file.
    bearing = {"kind": data["kind"].replace(" ", "_"), **data["bearing"]}
    rings = data.get("dimensions", {})
    return Entry(
        data["name"], data["description"], data["source"], bearing, data["provenance"],
        data.get("material_provenance", {}), data["example"],
        {key: value for key, value in rings.items() if key != "source"}, rings.get("source", ""),
    )  # fmt: skip
