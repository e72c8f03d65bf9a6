"""What a file states once, in [bearing] and in [housing], for every table of an effect or a reading that takes it and
does not state it itself.

Of [bearing] it is what a catalogue prints besides the model's lengths: diameters, width, shoulders and ratings, given
there or known of the bearing that the file names. Where a file changes a number of this bearing, the ratings are no
longer its own, nor, where it changes a length, are the shoulders. Of [housing], a ring expansion with a fit in it and
an elastic outer ring take what it is made of; a set hands on material and temperature itself (`BearingSet.effects_of`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from types import MappingProxyType
from typing import Any, NamedTuple

from qsbearing.files import catalogue
from qsbearing.files.bearing_table import changed_keys, designated, kept
from qsbearing.files.designations import read
from qsbearing.files.file_keys import reading_keys, reading_tables, set_numbers
from qsbearing.files.fits import CLASS
from qsbearing.files.keys import BALL_DEVIATIONS, DIAMETERS, EFFECT_TABLES, MATERIAL, PRINTED, RATINGS, SEAT_FITS
from qsbearing.files.sheet_by_name import sheets_by_name
from qsbearing.files.table_checks import Errors, as_it_is, checked, flattened, material, table_model
from qsbearing.inference.practice import RatingPractice
from qsbearing.model.effects import ElasticRings, RingExpansion
from qsbearing.model.material import STEEL

_BY_GEOMETRY = {"dynamic_load_rating_N": {"rating", "rating_factor"}}
"""Keys beside which a rating is asked for by the geometry, so that it is none of a catalogue."""
_RATINGS = {key.name for key in RATINGS}
_RATED = RATINGS[0].name
_GUESSED = (
    "Its balls are guessed by proportions, from which lives are up to 8 times off: give dynamic_load_rating_N and "
    "static_load_rating_N in [bearing], as printed"
)
_DIFFER = "Makers rate it differently: write whose it is before the number"
_FITTED = {"housing_interference_um", "housing_fit"}
_ELASTIC = tuple(key for key in MATERIAL if key.field in ("elastic_modulus", "poisson_ratio"))
"""What an elastic housing takes of its material."""
_NONE: Mapping[str, Any] = MappingProxyType({})


class Stated(NamedTuple):
    """By the keys of a file, in its units."""

    printed: Mapping[str, Any] = _NONE
    """Of a bearing."""
    fitted: Mapping[str, Any] = _NONE
    """Of the housing, for a ring expansion."""
    elastic: Mapping[str, Any] = _NONE
    """Of the housing, for an elastic outer ring."""
    unrated: str = ""
    """Why nothing tells C and C0 of the bearing, a sentence without its end; empty: they are given, or follow from the
    balls."""

    def of_bearing(self, bearing: Any) -> Stated:
        """With the numbers of this table [bearing]."""
        sheets = sheets_by_name(bearing) if isinstance(bearing, dict) else []
        is_guess = isinstance(bearing, dict) and bearing.get("rating_practice") == RatingPractice.PROPORTIONS
        is_guess |= any(_RATED not in each for each in sheets)
        unrated = _DIFFER if len(sheets) > 1 else _GUESSED if is_guess else ""
        rated = {key: each for key, each in sheets[0].items() if key in _RATINGS} if len(sheets) == 1 else {}
        return self._replace(printed=_printed(bearing) | rated, unrated=unrated)

    def lacks_rating(self, name: str, table: Mapping[str, Any]) -> bool:
        """Whether a reading takes C or C0 that nothing tells."""
        takes = {key for key, printed in printed_keys(name).items() if printed in _RATINGS}
        return bool(self.unrated and takes and not takes & {*table})

    def filled(self, name: str, table: Any) -> Any:
        """The table of an effect or a reading with what it takes of all this."""
        if given := _taken(name, table, self.printed):
            table = {**given, **({} if table is True else table)}
        if not isinstance(table, dict):
            return table
        if name == RingExpansion.name and _FITTED & set(table):
            return {**self.fitted, **table}
        if name == ElasticRings.name and isinstance(outer := table.get("outer"), dict) and self.elastic:
            return {**table, "outer": {"housing": self.elastic, **outer}}
        return table


NOTHING = Stated()


def stated_in(document: dict[str, Any], errors: Errors) -> Stated:
    """What the tables of a file state.

    Args:
        errors: gets what is wrong with the housing of a single bearing; that of a set is judged with the set.
    """
    table = document.get("housing")
    of_housing = NOTHING if table is None else _of_housing(table, "rows" in document, errors)
    return of_housing.of_bearing(document.get("bearing"))


def with_own_tables(document: dict[str, Any]) -> dict[str, Any]:
    """The tables of a set, in which a row with a bearing of its own has effects and readings of its own where those of
    all rows take numbers of the bearing; where every row has its own, those of all rows are left out."""
    if not isinstance(document.get("rows"), list):
        return document
    rows = [_row(row, document) if isinstance(row, dict) else row for row in document["rows"]]
    document = {**document, "rows": rows}
    for place in _PLACES:
        all_have = all(isinstance(row, dict) and _has(row, place) for row in rows)
        if all_have and "bearing" not in document and isinstance(document.get(place), dict):
            document[place] = {key: each for key, each in document[place].items() if key not in _names(place)}
    return document


@cache  # a search asks a thousand times
def printed_keys(name: str) -> dict[str, str]:
    """The keys of an effect's or a reading's table in which a printed number stands in, and which."""
    keys = EFFECT_TABLES.get(name) or reading_keys(name)
    return {key.name: key.printed for key in keys if key.printed}


def _of_housing(table: Any, is_of_set: bool, errors: Errors) -> Stated:
    wrong: Errors = [] if is_of_set else errors
    good, _ = checked(table_model("housing", set_numbers()["housing"], {"material": as_it_is}), "housing", table, wrong)
    before = len(wrong)
    body = good.get("material", STEEL.name if is_of_set else None)  # of a set, `Housing` has it
    body = None if body is None else material("housing.material", body, wrong)
    diameter = good.get(DIAMETERS[1].name)
    fitted = {"housing_outside_diameter_mm": diameter}
    if not is_of_set:
        fitted |= {"housing_temperature_C": good.get("temperature_C"), "housing_material": good.get("material")}
        fitted |= {"reference_temperature_C": good.get("reference_temperature_C")}
    elastic = {} if diameter is None or len(wrong) > before else {DIAMETERS[1].name: diameter}
    if elastic and body is not None:
        elastic |= {key.name: key.in_file(getattr(body, key.field)) for key in _ELASTIC}
    return Stated({}, {name: value for name, value in fitted.items() if value is not None}, elastic)


def _printed(bearing: Any) -> dict[str, Any]:
    """What a file's [bearing] gives of such numbers, and what the catalogue prints of the one that it names."""
    if not isinstance(bearing, dict):
        return {}
    bearing = designated(bearing)
    own = {key.name: bearing[key.name] for key in PRINTED if key.name in bearing}
    name = bearing["name"] if isinstance(bearing.get("name"), str) else ""
    told, entry = read(name), catalogue.find(name)
    by_name = {CLASS: told.tolerance_class} if told is not None and told.tolerance_class else {}
    if entry is None:
        return by_name | own
    changed = changed_keys(entry, {key: each for key, each in bearing.items() if key not in own})
    return kept(entry, changed) | by_name | own


def _taken(name: str, table: Any, known: Mapping[str, Any]) -> dict[str, Any]:
    """What of the known numbers a table takes and does not state."""
    if not known or (not isinstance(table, dict) and table is not True):
        return {}
    own = set() if table is True else set(flattened(table))
    numbers = {
        key: known[printed]
        for key, printed in printed_keys(name).items()
        if printed in known and key not in own and not own & _BY_GEOMETRY.get(key, set()) and _has_section(key, own)
    }
    if name == RingExpansion.name and CLASS in known and own & set(SEAT_FITS) and CLASS not in own:
        numbers[CLASS] = known[CLASS]  # a designation's, as P4
    return numbers


def _has_section(key: str, own: set[str]) -> bool:
    """Whether a ring of elastic rings, which the key begins with, is described, and not by its compliances."""
    side = key.rpartition(".")[0]
    of_ring = {each for each in own if each.startswith(f"{side}.")}
    return not side or (bool(of_ring) and not any(each.endswith(".compliance_um_per_N") for each in of_ring))


_PLACES = ("effects", "readings")


def _names(place: str) -> Iterable[str]:
    """Of the tables within [effects] or [readings]; readings are loaded only for a file that has some."""
    return EFFECT_TABLES if place == "effects" else reading_tables()


def _has(row: dict[str, Any], place: str) -> bool:
    """Whether a row has effects or readings of its own."""
    return place in row if place == "readings" else any(name in row for name in EFFECT_TABLES)


def _row(row: dict[str, Any], document: dict[str, Any]) -> dict[str, Any]:
    """With the tables of all rows that take numbers of its own bearing."""
    if "bearing" not in row:
        return row
    known = _printed(row["bearing"])
    for place in _PLACES:
        of_all = document.get(place)
        if _has(row, place) or not isinstance(of_all, dict) or BALL_DEVIATIONS.name in of_all:
            continue
        inherited = {name: of_all[name] for name in _names(place) if name in of_all}
        if any(_taken(name, table, known) for name, table in inherited.items()):
            row = {**row, **(inherited if place == "effects" else {place: inherited})}
    return row
