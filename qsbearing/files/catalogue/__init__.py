"""The catalogue: published bearings, each number with its source, and an example of use.

Worked examples of the literature stand in a TOML file each; standard spindle bearings are rows of one printed table.
"""

from __future__ import annotations

import difflib
import tomllib
import warnings
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from qsbearing.files.catalogue.entry import Entry
from qsbearing.files.catalogue.spindle_series import spindle_bearing, spindle_bearings
from qsbearing.files.designations import Designation, read
from qsbearing.model.validation import printable

__all__ = ["Entry", "chosen", "entries", "find", "named", "nearest"]


@cache  # a study and a search look one up for each of their batches
def entries() -> tuple[Entry, ...]:
    """The worked examples, in the order of their names."""
    texts = [file.read_text("utf-8") for file in Path(__file__).parent.glob("*.toml")]
    return tuple(sorted((_entry(tomllib.loads(text)) for text in texts), key=lambda entry: entry.name.lower()))


def find(name: str) -> Entry | None:
    """The entry of this name, in capitals or not, or of a designation that means it, such as GMN S 61914 C TA; None
    where there is none: `nearest` says what is known."""
    entry = _called(name.strip().lower())
    return entry if entry is not None else _designated(name)


def named(name: str) -> Entry | None:
    """Likewise, with a warning where a designation tells more than the entry holds."""
    entry = find(name)
    told = read(name) if entry is not None and name.strip().lower() != entry.name.lower() else None
    if entry is not None and told is not None and told.unused:
        warnings.warn(printable(f"{name}: read as {entry.name}; not used: {told.unused}"), stacklevel=2)
    return entry


def _designated(name: str) -> Entry | None:
    """The spindle bearing that a designation means which tells no other maker than theirs."""
    told = read(name)
    if told is None or not told.is_plain or told.angle is None:
        return None
    same = [entry for entry in _of_size(told) if entry.bearing["free_contact_angle_deg"] == told.angle]
    return next((entry for entry in same if entry.name.startswith("KH") == ("KH" in told.prefix)), None)


def _of_size(told: Designation) -> list[Entry]:
    """The spindle bearings of these boundary dimensions, of steel balls or of ceramic ones."""
    of_bore = chosen(bore=told.bore, hybrid=bool(told.ball_material)) if told.kind == "angular_contact" else []
    return [entry for entry in of_bore if entry.dimensions["outside_diameter_mm"] == told.outside]


@lru_cache(1024)
def _called(name: str) -> Entry | None:
    """The entry of this name in small letters. An example that is a row of the table too keeps its own numbers and
    takes the row's dimensions."""
    row = spindle_bearing(name)
    own = next((entry for entry in entries() if entry.name.lower() == name), None)
    if own is None or row is None:
        return own or row
    return replace(own, dimensions=row.dimensions | own.dimensions)


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
        for entry in map(_called, spindle_bearings())
        if entry is not None
        and (bore is None or entry.dimensions["bore_diameter_mm"] == bore)
        and (angle is None or entry.bearing["free_contact_angle_deg"] == angle)
        and entry.name.lower().startswith(series.strip().lower())
        and (hybrid is None or (entry.bearing["ball_material"] != "steel") == hybrid)
    ]
    return sorted(kept, key=lambda entry: (entry.dimensions["bore_diameter_mm"], entry.name))


LONGEST_NAME = 60
"""Letters of a name that is compared with others, which takes the square of its length."""


def nearest(name: str) -> str:
    """A sentence that helps whoever asked for a name that the catalogue does not hold.

    Where the name is a designation, no other angle, series or kind is suggested.
    """
    told = read(name)
    if told is not None:
        return f"It is {told.what}. {told.instead}." if told.is_refused else _told(told)
    names = {entry.name.lower(): entry.name for entry in (*entries(), *spindle_bearings().values())}
    wanted = name.strip().lower()[:LONGEST_NAME]
    alike = {each: difflib.SequenceMatcher(None, wanted, each).ratio() for each in names}
    similar = max(alike, key=lambda each: alike[each])  # of several alike the first, a worked example
    if alike[similar] >= 0.5:
        return f"Did you mean {names[similar]}?"
    examples = ", ".join(entry.name for entry in entries())
    return f"The catalogue holds {examples}, and spindle bearings such as 71914C: `qsbearing catalogue --bore 70`."


def _told(told: Designation) -> str:
    """What a designation says, and what it needs besides."""
    same = [entry for entry in _of_size(told) if not entry.name.startswith("KH")]
    if told.kind == "angular_contact" and told.angle is None:
        of_angle = {angle: [maker for maker, each in told.angles if each == angle] for _, angle in told.angles}
        means = " or ".join(f"{angle:g} ({', '.join(makers)})" for angle, makers in of_angle.items())
        is_open = not (told.ignored and means) and told.maker in ("", "GMN")
        found = f" Did you mean {' or '.join(entry.name for entry in same)}?" if same and is_open else ""
        suffix = f"suffix {told.ignored.partition(' ')[0]} means" if told.ignored else "no suffix means"
        ask = f"{suffix} {means} deg" if means else "its suffix tells no angle"
        return f"It is {told.size}, but {ask}: put the maker before it, or give free_contact_angle_deg.{found}"
    angle = f" and {told.angle:g} deg" if told.angle else ""
    alike = [entry.name for entry in same if entry.bearing["free_contact_angle_deg"] == told.angle]
    has = f"; GMN's of these dimensions and angle, with balls of its own, is name = {alike[0]!r}" if alike else ""
    needs = (
        "dynamic_load_rating_N and static_load_rating_N of its data sheet, or ball_count and ball_diameter_mm with "
        "pitch_diameter_mm and groove_radius_coefficient"
    )
    return f"It is {told.size}{angle}, whose balls no designation tells: give {needs}{has}."


def _entry(data: dict[str, Any]) -> Entry:
    # The kind stands beside the name in the data, where a reader looks for it, and in the bearing in a scene file.
    bearing = {"kind": data["kind"].replace(" ", "_"), **data["bearing"]}
    rings = data.get("dimensions", {})
    return Entry(
        data["name"], data["description"], data["source"], bearing, data["provenance"],
        data.get("material_provenance", {}), data["example"],
        {key: value for key, value in rings.items() if key != "source"}, rings.get("source", ""),
    )  # fmt: skip
