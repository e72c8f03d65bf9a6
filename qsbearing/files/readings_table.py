"""The table [readings] of a scene file: what is to be read off the solution, each reading a table of its own."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from math import nan
from typing import Any, NamedTuple

from qsbearing.files.file_errors import FileErrorDetail, translate
from qsbearing.files.file_keys import reading_keys, reading_tables
from qsbearing.files.stated import Given, Stated
from qsbearing.files.table_checks import Errors, TableModel, as_word, checked, judged, si, table_model
from qsbearing.model.scene.scene import Scene
from qsbearing.model.validation import Field, Sentence, alike, question

LUBRICANT = "lubricant"
OIL_TEMPERATURE = "oil_temperature_C"


@cache  # a search reads a file's tables a thousand times
def _model(name: str) -> TableModel:
    """How a reading's table is built. What its words may be, the reading itself knows."""
    known = reading_tables()[name]
    return table_model(name, reading_keys(name), dict.fromkeys(known.choices, as_word))


class ReadReadings(NamedTuple):
    """The table [readings] as it was read."""

    tables: dict[str, Given]
    """By the reading's name, and that of the oil."""
    is_usable: bool = True
    """Whether nothing is wrong with it; else what cannot be used would be missing as well."""
    required: tuple[str, ...] = ()
    """Readings of which the file requires a number."""

    def implying(self, required: tuple[str, ...]) -> ReadReadings:
        """With these, even where nothing else asks for them; one that lacks arguments is then left out."""
        more = {name: Given(name, is_implied=True) for name in required if name not in self.tables}
        return self._replace(tables=self.tables | more, required=required)

    def made(self, errors: Errors, balance_keys: frozenset[str], stated: Stated) -> dict[str, dict[str, Any]]:
        """The readings that are asked for, by name, with their arguments in SI.

        Args:
            balance_keys: of temperatures that the heat balance will find.
            stated: what tables take and need not state.
        """
        requested: dict[str, dict[str, Any]] = {}
        before, is_oil_found = len(errors), OIL_TEMPERATURE in balance_keys
        for name, given in self.tables.items():
            if given.is_implied and self._lacks(given, is_oil_found, stated):
                continue
            if stated.lacks_rating(given):
                cause = stated.bearing.unrated
                errors.append(FileErrorDetail(f"readings.{name}", "needs load ratings", cause=cause))
            requested[name] = {**stated.filled(given).fields}
        if requested and self.is_usable and len(errors) == before:
            errors += _errors(requested, is_oil_found)
        return requested

    def _lacks(self, given: Given, is_oil_found: bool, stated: Stated) -> bool:
        """Whether a reading needs more than the file gives."""
        oil = [self.tables[LUBRICANT]] if LUBRICANT in self.tables else []
        alone = {each.name: stated.filled(each).fields for each in (*oil, given)}
        return stated.lacks_rating(given) or bool(_errors(alone, is_oil_found))


def _errors(requested: Mapping[str, Mapping[str, Any]], is_oil_found: bool, scene: Scene | None = None) -> Errors:
    from qsbearing.readings.asked import requested_errors  # a scene without readings does not load them

    return list(map(translate, judged(requested_errors(requested, scene, is_oil_found))))


def read_readings(document: dict[str, Any], errors: Errors) -> ReadReadings:
    """What a file asks for in [readings]; `true` asks for a reading without arguments."""
    table, before = document.get("readings", {}), len(errors)
    if not isinstance(table, dict):
        how = Sentence("Write it as [{table}], one table for each: [{table}.life]", table=Field("readings"))
        errors.append(FileErrorDetail("readings", "is not a table", table, cause=how))
        return ReadReadings({}, False)
    read: dict[str, Given] = {}
    known = reading_tables() if table else {}
    for name, given in table.items():
        if name not in known:
            cause = question(alike(str(name), known), "[readings.{}]") or f"One of {', '.join(known)}"
            errors.append(FileErrorDetail(f"readings.{name}", "is not a reading", cause=cause))
            continue
        good, unusable = checked(_model(name), f"readings.{name}", {} if given is True else given, errors)
        good = dict.fromkeys(unusable, nan) | good
        choices = {choice: good[choice] for choice in known[name].choices if choice in good}
        read[name] = Given(name, si(reading_keys(name), good) | choices)
    return ReadReadings(read, len(errors) == before)


def errors_in_scene(scene: Scene, balance_keys: frozenset[str] = frozenset()) -> list[FileErrorDetail]:
    """What is wrong with a scene's readings that only the whole scene shows."""
    return _errors(scene.readings, OIL_TEMPERATURE in balance_keys, scene) if scene.readings else []
