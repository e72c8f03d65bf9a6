"""The keys of what a file of a set has in addition to the tables of a scene; loaded for sets and errors only."""

from __future__ import annotations

from qsbearing.files.keys import DIAMETERS, EFFECT_TABLES, Key, keys_of, named
from qsbearing.systems.sets.bearing_set import BearingSet
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

OF_SET = keys_of(BearingSet)
"""Which stand in [shaft]."""
SET_NUMBERS: dict[str, tuple[Key, ...]] = {
    "rows": keys_of(Row),
    "shaft": (*OF_SET, *keys_of(Shaft)),
    "housing": (*keys_of(Housing), DIAMETERS[1]),
    "spacers": keys_of(Spacer),
    "floating": keys_of(FloatingGroup),
    "sections": keys_of(ShaftSection),
    "loads": keys_of(ShaftLoad),
    "supports": keys_of(ShaftSupport),
    "masses": keys_of(ShaftMass),
    "housing_stiffness": keys_of(HousingStiffness),
}
"""Those that hold numbers, by their table."""
OTHERS = {
    "rows": ("carries", "sprung", "housing_stiffness", "bearing", *EFFECT_TABLES, "readings"),
    "shaft": ("gravity_m_s2", "sections", "loads", "supports", "masses", "points"),
    "housing": ("material",),
    "spacers": ("rows", "inner_material", "outer_material"),
    "floating": ("rows", "preload"),
    "sections": ("material",),
    "housing_stiffness": ("matrix_SI",),
}
"""Those that hold anything else."""


def _section(name: str) -> tuple[str, ...]:
    """Which rows a table is about stands first."""
    others = OTHERS.get(name, ())
    first = others[:1] if "rows" in others else ()
    return (*first, *named(SET_NUMBERS[name]), *others[len(first) :])


SET_SECTIONS = {name: _section(name) for name in SET_NUMBERS}
"""Every key, by its table."""
