"""The keys of a scene file: an input's name with its unit behind it. What inputs there are, their classes state
(`qsbearing.model.described`); only what a file has beside them is listed here. Those of a set: `set_keys`."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from typing import Any

from qsbearing.inference.data_sheet import DataSheet
from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import Input, choices_of, lists_of, materials_of, number, numbers_of
from qsbearing.model.effects import (
    BallDiameterDeviations,
    BallExpansion,
    ElasticRings,
    GyroscopicMoment,
    RingExpansion,
    types_in,
)
from qsbearing.model.effects.traction import Traction
from qsbearing.model.material import Material
from qsbearing.model.operation import Operation
from qsbearing.model.scene.preload import Preload
from qsbearing.model.validation import Quantity


@dataclass(frozen=True)
class Key:
    """A number of a scene file."""

    name: str
    """As the file spells it, unit included."""
    field: str
    """As Python spells it."""
    unit: str = ""
    size: float = 1.0
    """One of the file's unit in SI."""
    quantity: Quantity | None = None
    """What other units it is given in; None where there are none."""
    zero: float = 0.0
    """The file's zero in SI."""
    range: tuple[float, float] | None = None
    """Which values its table accepts at all, in SI; None where that depends on others."""
    printed: str = ""
    """Which key of [bearing] stands in for it; empty: none does."""
    words: str = ""
    """What it is, where the name does not state it."""

    def si(self, value: Any) -> Any:
        """A value of the file in SI."""
        return value * self.size + self.zero

    def in_file(self, value: float) -> float:
        """An SI value in the file's unit, without the rounding of its way there and back."""
        return float(f"{(value - self.zero) / self.size:.12g}")


_STEMS = {"deviations": "ball_diameter_deviations", "viscosity_at_40": "viscosity_at_40C",
          "viscosity_at_100": "viscosity_at_100C", "conductance": ""}  # fmt: skip
"""Of names that a file spells otherwise."""
_KINDS, _TOLD = {"N/um": "stiffness", "kN m/rad": "stiffness"}, ("pair_rigidity",)
"""What a key says between name and unit, and of which names it need not."""


@cache
def key_of(given: Input) -> Key:
    """The key of an input; in tables within the table, which points part, where it belongs to a part."""
    unit = given.unit
    kind = "" if given.name in _TOLD else _KINDS.get(unit.symbol, "")
    words = filter(None, (_STEMS.get(given.name, given.own_name), kind, unit.ending))
    name = ".".join((*given.part, "_".join(words)))
    printed = given.printed and f"{given.printed}_{unit.ending}"
    return Key(name, given.name, unit.symbol, unit.size, unit.quantity, unit.zero, given.range, printed, given.words)


def keys_of(of: Any) -> tuple[Key, ...]:
    """Those of a class's numbers."""
    return tuple(map(key_of, numbers_of(of)))


def required_of(of: Any) -> tuple[Key, ...]:
    """Those of the numbers without which there is no object of the class."""
    return tuple(key_of(each) for each in numbers_of(of) if each.is_required)


def named(keys: Iterable[Key]) -> tuple[str, ...]:
    """As the file spells them."""
    return tuple(key.name for key in keys)


def _lengths(*names: str) -> tuple[Key, ...]:
    return tuple(key_of(number(name, "mm")) for name in names)


BEARING = keys_of(BallBearing)
FREE_ANGLE, CLEARANCE, PLAY = (
    next(key for key in BEARING if key.field == field)
    for field in ("free_contact_angle", "diametral_clearance", "axial_clearance")
)
"""Of these a bearing has one."""
COEFFICIENTS = {
    **{f"{side}_groove_radius_coefficient": (f"{side}_groove_radius_mm",) for side in ("inner", "outer")},
    "groove_radius_coefficient": ("inner_groove_radius_mm", "outer_groove_radius_mm"),
}
"""f = r/D of a groove, or of both, with the ball diameter of the same bearing; each stands for these radii."""
RACEWAYS = _lengths("inner_raceway_diameter", "outer_raceway_diameter")
"""At the bottom of each groove; both together stand for the pitch diameter and the clearance."""
DIAMETERS = _lengths("bore_diameter", "outside_diameter")
"""Of the bearing as a whole."""
SPAN = _lengths("from", "to", "diameter")
"""Of a section of a shaft: in place of its length, and of its outer diameter."""
SHOULDERS = _lengths("inner_shoulder_diameter", "outer_shoulder_diameter")
RATINGS = tuple(key_of(number(f"{kind}_load_rating", "N")) for kind in ("dynamic", "static"))
PRINTED = (*DIAMETERS, *_lengths("width"), *SHOULDERS, *RATINGS)
"""What a catalogue prints of a bearing besides: what needs one takes it from here, so that a file states it once."""
_ELSEWHERE = {*named((*BEARING, *PRINTED)), *COEFFICIENTS}
DATA_SHEET = (
    *(key for key in keys_of(DataSheet) if key.name not in _ELSEWHERE),
    key_of(number("ball_set", range=(1.0, 30.0))),
)
"""What it may state besides; which of the ball sets that it allows is meant."""
SHEET_CHOICES = ("rating_practice", "size_steps", "pair_rigidity_kind", "clearance_class")
SHEET_WORDS = ("maker", *SHEET_CHOICES)
"""What of a data sheet tells the balls and grooves that it does not print."""
_OF_GROOVES = (
    key_of(number(name, words=f"groove radius coefficient ${symbol}$"))
    for name, symbol in zip(COEFFICIENTS, ("f_i", "f_o", "f"), strict=True)
)
IN_PLACE = (*_OF_GROOVES, *RACEWAYS, *PRINTED, *DATA_SHEET)
"""What a file's [bearing] may hold besides, which is no length of the model."""

MATERIAL, OPERATION, PRELOAD = keys_of(Material), keys_of(Operation), keys_of(Preload)
OF_OPERATION = {key.field: key for key in OPERATION}
SHARES = (0.0, 1.0)
SPECTRUM = (key_of(number("share", range=SHARES)), key_of(number("hours", "h")), *OPERATION)
"""Of an operating point of a load spectrum: its share of the time, and how it is operated."""

RING_EFFECTS: dict[str, Any] = types_in("ring_effects")
EFFECT_TABLES = {name: keys for name, of in RING_EFFECTS.items() if (keys := keys_of(of))}
"""Effects that have a table of their own within [effects], which names them and holds their numbers."""
RING_EXPANSION, BALL_EXPANSION = (EFFECT_TABLES[each.name] for each in (RingExpansion, BallExpansion))
SEATS = {"outer.housing": "housing", "inner.shaft": "shaft"}
"""What holds a ring of elastic rings, as a word; points part the tables within the effect's own."""
RING_COMPLIANCES = tuple(map(key_of, lists_of(ElasticRings)))
"""Lists by harmonic, in place of all else about a ring."""
EFFECTS = keys_of(GyroscopicMoment)
(BALL_DEVIATIONS,) = map(key_of, lists_of(BallDiameterDeviations))
"""A list, of as many numbers as there are balls, which names its effect."""
TRACTION, (FRICTION_RANGE,) = keys_of(Traction), tuple(map(key_of, lists_of(Traction)))
"""Of the law of friction, a table within [effects]; and the least and the largest coefficient."""

MATERIALS, SEAT_MATERIALS = materials_of(BallBearing), materials_of(RingExpansion)
SEAT_FITS = ("shaft_fit", "housing_fit", "tolerance_class")
"""Words: of each seat in place of its interference, and of the bearing."""
NUMBERS = {
    "bearing": BEARING,
    "operation": OPERATION,
    "preload": PRELOAD,
    "effects": EFFECTS,
    "unequal_balls": (BALL_DEVIATIONS,),
    "material": MATERIAL,
    **EFFECT_TABLES,
    Traction.name: TRACTION,
}
"""The keys that hold numbers, by their table; a material is a table within others."""

SECTIONS: dict[str, tuple[str, ...]] = {
    "bearing": ("name", "kind", *named((*BEARING, *IN_PLACE)), *SHEET_WORDS, *MATERIALS),
    "operation": named(OPERATION),
    "preload": named(PRELOAD),
    "effects": (
        *("ball", "raceway_control", "moment_shares", *named(EFFECTS)),
        *("orbit_radius", "ball_motion", "hertz_angle", "hertz_form", "tilt_lever"),
        *(BALL_DEVIATIONS.name, *EFFECT_TABLES, Traction.name),
    ),
    "readings": (),
    "thermal": (),
}
"""Every key a file may hold, by its table; those of readings and of heat stand with each of them."""
_WORDS: dict[str, Iterable[str]] = {RingExpansion.name: SEAT_FITS, ElasticRings.name: SEATS}
EFFECT_SECTIONS: dict[str, tuple[str, ...]] = {
    name: (*named(keys), *materials_of(of), *choices_of(of), *_WORDS.get(name, ()), *named(map(key_of, lists_of(of))))
    for name, keys in EFFECT_TABLES.items() if (of := RING_EFFECTS[name])
} | {Traction.name: ("law", *named((*TRACTION, FRICTION_RANGE)))}  # fmt: skip
"""Every key that the tables within [effects] may hold, by table."""

SET_TABLES = ("rows", "shaft", "housing", "spacers", "floating")
"""The tables that the file of a set has in addition; their keys: `set_keys`."""
ON_SHAFT = ("sections", "loads", "gears", "belts", "supports", "masses")
WITHIN_SET_TABLES = (*ON_SHAFT, "housing_stiffness")
"""Those within [shaft] and [[rows]]."""
MAKES_SET = tuple(name for name in SET_TABLES if name != "housing")
"""Those that make a file one of a set; a single bearing may be in a housing as well."""
NUMBERED = {
    "row": "rows", "spacer": "spacers", "floating": "floating",
    "section": "sections", "load": "loads", "gear": "gears", "belt": "belts", "support": "supports", "mass": "masses",
}  # fmt: skip
"""What one of several tables is called in errors, its number following; and its table."""
SPECTRUM_POINT = "spectrum point"
"""What a point of a spectrum is called in errors, its number following."""
