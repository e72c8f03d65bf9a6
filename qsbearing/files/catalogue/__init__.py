"""The catalogue: published bearings, each number with its source, and an example of use.

Worked examples of the literature stand in a TOML file each; standard spindle bearings are rows of one printed table.
"""

from __future__ import annotations

import tomllib
import warnings
from collections.abc import Set
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from qsbearing.files.catalogue.entry import CatalogueEntry
from qsbearing.files.catalogue.spindle_series import spindle_bearing, spindle_bearings
from qsbearing.files.designations import Designation, angles_of, read
from qsbearing.model.validation import alike, printable, question
from qsbearing.remarks.wording import listed

__all__ = ["CatalogueEntry", "chosen", "entries", "find", "named", "nearest"]


@cache  # a study and a search look one up for each of their batches
def entries() -> tuple[CatalogueEntry, ...]:
    """The worked examples, in the order of their names."""
    texts = [file.read_text("utf-8") for file in Path(__file__).parent.glob("*.toml")]
    return tuple(sorted((_entry(tomllib.loads(text)) for text in texts), key=lambda entry: entry.name.lower()))


def find(name: str) -> CatalogueEntry | None:
    """The entry of this name, in capitals or not, or of a designation that means it, such as GMN S 61914 C TA; None
    where there is none: `nearest` says what is known."""
    entry = _called(name.strip().lower())
    return entry if entry is not None else _designated(name)


def named(name: str) -> CatalogueEntry | None:
    """The entry of a name or designation, with a warning where a designation tells more than the entry holds."""
    entry = find(name)
    told = read(name) if entry is not None and name.strip().lower() != entry.name.lower() else None
    if entry is not None and told is not None and told.unused:
        warnings.warn(printable(f"{name}: read as {entry.name}; not used: {told.unused}"), stacklevel=2)
    return entry


def _designated(name: str) -> CatalogueEntry | None:
    """The spindle bearing that a designation means which tells no other maker than theirs."""
    told = read(name)
    if told is None or not told.is_plain or told.angle is None:
        return None
    same = [entry for entry in _of_size(told) if entry.bearing["free_contact_angle_deg"] == told.angle]
    return next((entry for entry in same if entry.name.startswith("KH") == ("KH" in told.prefix)), None)


def _of_size(told: Designation) -> list[CatalogueEntry]:
    """The spindle bearings of these boundary dimensions, of steel balls or of ceramic ones."""
    of_bore = chosen(bore=told.bore, hybrid=bool(told.ball_material)) if told.kind == "angular_contact" else []
    return [entry for entry in of_bore if entry.dimensions["outside_diameter_mm"] == told.outside]


@lru_cache(1024)
def _called(name: str) -> CatalogueEntry | None:
    """The entry of this name in small letters. An example that is a row of the table too keeps its own numbers and
    takes the row's dimensions."""
    row = spindle_bearing(name)
    own = next((entry for entry in entries() if entry.name.lower() == name), None)
    if own is None or row is None:
        return own or row
    return replace(own, dimensions=row.dimensions | own.dimensions)


def chosen(
    bore: float | None = None, angle: float | None = None, series: str = "", hybrid: bool | None = None
) -> list[CatalogueEntry]:
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


_RADII = ("inner_groove_radius_mm", "outer_groove_radius_mm")
NEEDED = frozenset(("ball_count", "ball_diameter_mm", "pitch_diameter_mm", *_RADII, "free_contact_angle_deg"))
"""What a bearing needs that no designation tells; an angle stands for a clearance too."""


def nearest(name: str, lacking: Set[str] = NEEDED) -> str:
    """A sentence that helps whoever asked for a name that the catalogue does not hold.

    Where the name is a designation, no other angle, series or kind is suggested.

    Args:
        lacking: keys of [bearing] that are not given beside the name; what is given is not asked for.
    """
    told = read(name)
    if told is not None:
        return f"It is {told.what}. {told.instead}." if told.is_refused else _told(told, lacking)
    names = [entry.name for entry in (*entries(), *spindle_bearings().values())]
    if meant := question(alike(name.strip(), names)):
        return meant
    examples = ", ".join(entry.name for entry in entries())
    return f"The catalogue holds {examples}, and spindle bearings such as 71914C: `qsbearing catalogue --bore 70`."


def _told(told: Designation, lacking: Set[str]) -> str:
    """What a designation says, and what it needs besides."""
    same = [entry for entry in _of_size(told) if not entry.name.startswith("KH")]
    angle = f" and {told.angle:g} deg" if told.angle else ""
    light = " of a series of light balls" if told.is_light else ""
    begun = f"It is {told.size}{angle}{light}"
    unknown = (
        "" if told.is_prefix_known else f" Its prefix {told.prefix} is not known of such bearings, and is not used."
    )
    has_angle = told.angle is not None or "free_contact_angle_deg" not in lacking
    if told.kind == "angular_contact" and not has_angle:
        is_open = told.maker in ("", "GMN") and not told.suffix and told.is_prefix_known
        is_open &= not (told.ignored and told.angles)
        suggestion = f" Did you mean {' or '.join(entry.name for entry in same)}?" if same and is_open else ""
        needs = _needs(lacking, [])
        also = f" No designation tells the balls: give {needs}." if needs else ""
        return f"{begun}.{unknown} {_angle_missing(told)}.{also}{suggestion}"
    play = [] if has_angle else ["diametral_clearance_mm = 0.01 or what it is when mounted"]
    alike = [entry.name for entry in same if entry.bearing["free_contact_angle_deg"] == told.angle]
    has = f"; GMN's of these dimensions and angle, with balls of its own, is name = {alike[0]!r}" if alike else ""
    rest = "" if lacking <= {"free_contact_angle_deg"} else ", whose balls no designation tells"
    return f"{begun}{rest}: give {_needs(lacking, play)}{has}.{unknown}"


def _needs(lacking: Set[str], others: list[str]) -> str:
    """What to give of a ball set, and what else, a part of a sentence; empty where nothing is lacking."""
    radii = [key for key in _RADII if key in lacking]
    balls = [key for key in ("ball_count", "ball_diameter_mm", "pitch_diameter_mm") if key in lacking]
    is_sheet = bool({*balls, *radii} - {"pitch_diameter_mm"})
    balls += ["groove_radius_coefficient"] if len(radii) == len(_RADII) else radii
    if not is_sheet:
        return listed([*balls, *others]) if balls or others else ""
    ratings = "dynamic_load_rating_N and static_load_rating_N of its data sheet, or "
    return f"{ratings}{listed(balls)}{f'; and {listed(others)}' if others else ''}"


def _angle_missing(told: Designation) -> str:
    """What its letters mean for the angle, and how to say it, a sentence without its end."""
    advice = "give free_contact_angle_deg"
    if told.angles:
        means = dict.fromkeys(angle for _, angle in told.angles)
        makers = {angle: listed(maker for maker, each in told.angles if each == angle) for angle in means}
        said = ", ".join(f"{angle:g}° at {makers[angle]}" for angle in means)
        begun = f"Suffix {told.suffix} means" if told.suffix else "Without a suffix the angle is"
        return f"{begun} {said}; write the maker first ({told.angles[0][0]} {told.text.strip()}) or {advice}"
    if told.maker and not angles_of(told.maker):
        return f"What {told.maker.capitalize()} writes for the angle is not known here: {advice}"
    if told.maker:
        codes = listed(f"{code} ({angle:g}°)" for code, angle in angles_of(told.maker).items())
        whose = f"Prefix {told.prefix} is of {told.maker}, whose" if told.prefix else f"{told.maker}'s"
        return f"{whose} suffixes for the angle are {codes}: add one, or {advice}"
    return f"Its suffix tells no angle: {advice}, or write the maker first"


def _entry(data: dict[str, Any]) -> CatalogueEntry:
    # The kind stands beside the name in the data, where a reader looks for it, and in the bearing in a scene file.
    bearing = {"kind": data["kind"].replace(" ", "_"), **data["bearing"]}
    rings = data.get("dimensions", {})
    return CatalogueEntry(
        data["name"], data["description"], data["source"], bearing, data["provenance"],
        data.get("material_provenance", {}), data["example"],
        {key: value for key, value in rings.items() if key != "source"}, rings.get("source", ""),
    )  # fmt: skip
