"""The keys of what a file of a set has in addition to the tables of a scene; loaded for sets and errors only."""

from __future__ import annotations

from typing import Any

from qsbearing.files.keys import DIAMETERS, EFFECT_TABLES, SPAN, key_of, keys_of, named
from qsbearing.model.described import choices_of, lists_of, materials_of, parts_of
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.belts import Belt
from qsbearing.systems.sets.gears import Gear
from qsbearing.systems.sets.row import Row
from qsbearing.systems.sets.shaft import (
    FloatingGroup,
    Housing,
    HousingStiffness,
    Shaft,
    ShaftLoad,
    ShaftMass,
    ShaftSection,
    ShaftSupport,
    Spacer,
)

RECORDS: dict[str, Any] = {
    "rows": Row,
    "shaft": Shaft,
    "housing": Housing,
    "spacers": Spacer,
    "floating": FloatingGroup,
    "sections": ShaftSection,
    "loads": ShaftLoad,
    "supports": ShaftSupport,
    "masses": ShaftMass,
    "gears": Gear,
    "belts": Belt,
    "housing_stiffness": HousingStiffness,
}
"""What each table makes."""
OF_SET = keys_of(BearingSet)
"""Which stand in [shaft]."""
SET_NUMBERS = {name: keys_of(of) for name, of in RECORDS.items()}
SET_NUMBERS["shaft"] = (*OF_SET, *SET_NUMBERS["shaft"])
SET_NUMBERS["housing"] += DIAMETERS[1:]
SET_NUMBERS["sections"] += SPAN
"""Those that hold numbers, by their table; what surrounds a fit counts with [housing] only in a file: `stated`; ends of
sections: `shaft_spans`."""
LISTS = {name: tuple(map(key_of, lists_of(of))) for name, of in RECORDS.items()}
"""Those that hold lists of numbers."""
(GRAVITY,), (MATRIX,) = LISTS["shaft"], LISTS["housing_stiffness"]
OTHERS = {name: (*choices_of(of), *named(LISTS[name]), *parts_of(of)) for name, of in RECORDS.items()}
OTHERS["rows"] += ("bearing", *EFFECT_TABLES, "readings")
OTHERS["shaft"] += ("points",)
"""Those that hold anything else but materials."""


def _section(name: str) -> tuple[str, ...]:
    """Which rows a table is about stands first."""
    others = OTHERS[name]
    first = others[:1] if "rows" in others else ()
    return (*first, *named(SET_NUMBERS[name]), *others[len(first) :], *materials_of(RECORDS[name]))


SET_SECTIONS = {name: _section(name) for name in SET_NUMBERS}
"""Every key, by its table."""
