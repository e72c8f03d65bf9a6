"""What the catalogue prints of a bearing besides the model's lengths; what a file's tables take of it: `stated`."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from qsbearing.files.bearing_table import MODIFIED, bearing_of, entry_of, kept
from qsbearing.files.keys import (
    BEARING,
    MATERIALS,
    PRINTED,
)
from qsbearing.files.stated import keys_within
from qsbearing.model.bearing import BallBearing


def catalogue_numbers(bearing: BallBearing) -> dict[str, float]:
    """What the catalogue prints of the bearing that this one is by its name and its numbers, as drawn; in SI.

    Of `bore_diameter`, `outside_diameter`, `width`, `inner_shoulder_diameter`, `outer_shoulder_diameter`,
    `dynamic_load_rating` and `static_load_rating` those that are known: none of a bearing of no catalogue; of one with
    changed numbers (", modified" behind its name) what a file with this name and number would hand on to its tables.

    The rings of the bearing of a scene, free, where all of these are known:

        p = catalogue_numbers(scene.bearing)
        ElasticRings(
            outside_diameter=p["outside_diameter"], outer_width=p["width"], housing="free",
            outer_shoulder_diameter=p.get("outer_shoulder_diameter"),
            bore_diameter=p["bore_diameter"], inner_width=p["width"], shaft="free",
            inner_shoulder_diameter=p.get("inner_shoulder_diameter"),
        )

    Returns:
        The numbers that are printed of it, by their names, in SI; empty where none is known.

    Examples:
        >>> numbers = qs.catalogue_numbers(qs.load_scene("7210C").bearing)
        >>> print(sorted(numbers)[:3])
        ['bore_diameter', 'dynamic_load_rating', 'inner_shoulder_diameter']
    """
    printed = _printed(bearing)
    return {key.field: key.si(printed[key.name]) for key in PRINTED if key.name in printed}


def is_printed(bearing: BallBearing, table: str, key: str, value: float) -> bool:
    """Whether a number of an effect's or a reading's table is the one that the catalogue prints of the bearing.

    Args:
        table: the effect's or the reading's name; key and value: in the words and the unit of a file.
    """
    printed = next((each.printed for each in keys_within(table) if each.name == key), "")
    return bool(printed) and _printed(bearing).get(printed) == value


def _printed(bearing: BallBearing) -> dict[str, float]:
    """In the units of a file."""
    entry = entry_of(bearing)
    drawn = None if entry is None else _drawn(entry.name)
    if entry is None or drawn is None:
        return {}
    numbers, words = [key.field for key in BEARING], ["kind", *MATERIALS]
    changed = {each for each in numbers if _differ(getattr(bearing, each), getattr(drawn, each))}
    changed |= {each for each in words if getattr(bearing, each) != getattr(drawn, each)}
    if changed and not bearing.name.endswith(MODIFIED):
        return {}  # another bearing of this name, such as that of a file called so
    return kept(entry, changed)


def _differ(one: Any, other: Any) -> bool:
    """Whether two numbers do, of which neither may be given."""
    if one is None or other is None:
        return one is not other
    return not np.allclose(one, other, rtol=1e-9)


@cache
def _drawn(name: str) -> BallBearing | None:
    return bearing_of({"bearing": {"name": name}}, "", [])
