"""What a file states once, in [bearing] and in [housing], for every effect and reading that takes it and does not state
it itself.

Of [bearing] it is what a catalogue prints besides the model's lengths: diameters, width, shoulders and ratings, given
there or known of the bearing that the file names. Where a file changes a number of this bearing, the ratings are no
longer its own, nor, where it changes a length, are the shoulders. Of [housing], a ring expansion with a fit in it and
an elastic outer ring take what it is made of; a set hands on material and temperature itself (`BearingSet.effects_of`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import nan
from types import MappingProxyType
from typing import Any, NamedTuple

from qsbearing.files.bearing_table import NO_BEARING, ReadBearing
from qsbearing.files.file_keys import reading_keys
from qsbearing.files.fits import CLASS
from qsbearing.files.keys import DIAMETERS, EFFECT_TABLES, RATINGS, SEAT_FITS, SEATS, Key
from qsbearing.files.table_checks import Errors, as_number, read_fields
from qsbearing.model.described import inputs_of
from qsbearing.model.effects import ElasticRings, RingExpansion
from qsbearing.model.material import STEEL

_BY_GEOMETRY = {"dynamic_load_rating": {"rating", "rating_factor"}}
"""Fields beside which a rating is requested by the geometry, so that it is none of a catalogue."""
_RATINGS = {key.name for key in RATINGS}
_OUTSIDE = DIAMETERS[1]
_FITTED = {"housing_interference", "housing_fit"}
_NONE: Mapping[str, Any] = MappingProxyType({})
_OF_SIDE = {each.name: each.part[0] for each in inputs_of(ElasticRings)} | {
    field: name.partition(".")[0] for name, field in SEATS.items()
}
"""Which ring a field of elastic rings is about."""
_OF_HOUSING = {each.name for each in inputs_of(ElasticRings) if each.part[1:] == ("housing",)} | {"housing"}
_COMPLIANCES = {each.name for each in inputs_of(ElasticRings) if each.is_list}


class Given(NamedTuple):
    """The table of an effect or a reading as it was read."""

    name: str
    fields: Mapping[str, Any] = _NONE
    """What it states, in SI, by the names that Python has: NaN where it tries to, and what it does not is not there."""
    is_sound: bool = True
    """Whether nothing is wrong with it so far."""
    is_implied: bool = False
    """Whether nothing but a requirement asks for it: it is left out where anything is missing."""


class Stated(NamedTuple):
    """What effects and readings may take."""

    bearing: ReadBearing = NO_BEARING
    fitted: Mapping[str, Any] = _NONE
    """Of the housing, the fields of a ring expansion."""
    elastic: Mapping[str, Any] = _NONE
    """Of the housing, the fields of elastic rings."""

    def lacks_rating(self, given: Given) -> bool:
        """Whether a reading takes C or C0 that nothing tells."""
        takes = {key.field for key in keys_within(given.name) if key.printed in _RATINGS}
        return bool(self.bearing.unrated and takes and not takes & self.filled(given).fields.keys())

    def of_bearing(self, given: Given) -> dict[str, Any]:
        """What of the bearing's numbers a table takes and does not state; NaN for what the file has no usable number
        of."""
        own, known = given.fields.keys(), dict.fromkeys(self.bearing.unusable, nan) | {**self.bearing.printed}
        taken = {
            key.field: key.si(known[key.printed])
            for key in keys_within(given.name)
            if key.printed in known and key.field not in own and not own & _BY_GEOMETRY.get(key.field, set())
        }
        if given.name == ElasticRings.name:
            taken = {field: each for field, each in taken.items() if _has_section(_OF_SIDE[field], own)}
        tolerance = self.bearing.tolerance_class
        if given.name == RingExpansion.name and tolerance and own & {*SEAT_FITS} and CLASS not in own:
            taken[CLASS] = tolerance  # a designation's, as P4
        return taken

    def takes(self, tables: Iterable[Given]) -> bool:
        """Whether any of these takes a number of the bearing."""
        return any(map(self.of_bearing, tables))

    def filled(self, given: Given) -> Given:
        """An effect or a reading with what it takes of all this."""
        own, of_housing = given.fields.keys(), _NONE
        if given.name == RingExpansion.name and own & _FITTED:
            of_housing = {field: each for field, each in self.fitted.items() if field not in own}
        if given.name == ElasticRings.name and "outer" in map(_OF_SIDE.get, own) and not own & _OF_HOUSING:
            of_housing = self.elastic
        fields = {**self.of_bearing(given), **of_housing, **given.fields}
        in_order = {key.field: fields[key.field] for key in keys_within(given.name) if key.field in fields}
        return given._replace(fields=in_order | fields)


def stated_in(document: dict[str, Any], bearing: ReadBearing, errors: Errors) -> Stated:
    """What a file with this bearing states.

    Args:
        errors: gets what is wrong with the housing of a single bearing; that of a set is judged with the set.
    """
    table = document.get("housing")
    return Stated(bearing) if table is None else _of_housing(table, bearing, "rows" in document, errors)


def keys_within(name: str) -> tuple[Key, ...]:
    """Those of the numbers of an effect's or a reading's table."""
    return EFFECT_TABLES.get(name) or reading_keys(name)


def _of_housing(table: Any, bearing: ReadBearing, is_of_set: bool, errors: Errors) -> Stated:
    wrong: Errors = [] if is_of_set else errors
    from qsbearing.systems.sets.shaft import Housing  # loaded only where there is one

    given: dict[str, Any] = {"material": STEEL} if is_of_set else {}  # of a set, `Housing` has it
    given |= read_fields(Housing, "housing", "housing", table, wrong, {_OUTSIDE.name: as_number})
    outside = {f"housing_{_OUTSIDE.field}": _OUTSIDE.si(given[_OUTSIDE.name])} if _OUTSIDE.name in given else {}
    of_body = ("elastic_modulus", "poisson_ratio") if outside and "material" in given else ()
    elastic = outside | {f"housing_{name}": getattr(given["material"], name) for name in of_body}
    names = {} if is_of_set else {"temperature": "housing_temperature", "material": "housing_material"}
    names |= {} if is_of_set else {"reference_temperature": "reference_temperature"}
    return Stated(bearing, outside | {names[name]: each for name, each in given.items() if name in names}, elastic)


def _has_section(side: str, own: Iterable[str]) -> bool:
    """Whether a ring of elastic rings is described, and not by its compliances."""
    of_ring = {field for field in own if _OF_SIDE.get(field) == side}
    return bool(of_ring) and not of_ring & _COMPLIANCES
