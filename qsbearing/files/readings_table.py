"""The table [readings] of a scene file: what is to be read off the solution, each reading a table of its own."""

from __future__ import annotations

from functools import cache
from typing import Any

from qsbearing.files.file_errors import FileErrorDetail, translate
from qsbearing.files.file_keys import reading_keys, reading_tables
from qsbearing.files.stated import NOTHING, Stated
from qsbearing.files.table_checks import Errors, TableModel, as_word, checked, si, table_model
from qsbearing.model.scene.scene import Scene
from qsbearing.model.validation import Field, Sentence, alike, question

OIL_TEMPERATURE = "oil_temperature_C"


@cache  # a search reads a file's tables a thousand times
def _model(name: str) -> TableModel:
    """How a reading's table is built. What its words may be, the reading itself knows."""
    known = reading_tables()[name]
    return table_model(name, reading_keys(name), dict.fromkeys(known.choices, as_word))


def requested_readings(
    document: dict[str, Any], errors: Errors, balance_keys: frozenset[str] = frozenset(), stated: Stated = NOTHING
) -> dict[str, dict[str, Any]]:
    """The readings that a file asks for, by name, with their arguments in SI; `true` asks for one without any.

    Args:
        balance_keys: of temperatures that the heat balance will find.
        stated: what tables take and need not state.
    """
    table = document.get("readings", {})
    if not isinstance(table, dict):
        how = Sentence("Write it as [{table}], one table for each: [{table}.life]", table=Field("readings"))
        errors.append(FileErrorDetail("readings", "is not a table", table, cause=how))
        return {}
    before = len(errors)
    requested: dict[str, dict[str, Any]] = {}
    known = reading_tables() if table else {}
    for name, given in table.items():
        if name not in known:
            cause = question(alike(str(name), known), "[readings.{}]") or f"One of {', '.join(known)}"
            errors.append(FileErrorDetail(f"readings.{name}", "is not a reading", cause=cause))
            continue
        choices, given = known[name].choices, stated.filled(name, given)
        good, _ = checked(_model(name), f"readings.{name}", {} if given is True else given, errors)
        requested[name] = si(reading_keys(name), good) | {choice: good[choice] for choice in choices if choice in good}
    if requested and len(errors) == before:  # what cannot be used would be missing as well
        from qsbearing.readings.asked import requested_errors  # a scene without readings does not load them

        errors += map(translate, requested_errors(requested, oil_is_found=OIL_TEMPERATURE in balance_keys))
    return requested


def errors_in_scene(scene: Scene, balance_keys: frozenset[str] = frozenset()) -> list[FileErrorDetail]:
    """What is wrong with a scene's readings that only the whole scene shows."""
    if not scene.readings:
        return []
    from qsbearing.readings.asked import requested_errors

    return list(map(translate, requested_errors(scene.readings, scene, OIL_TEMPERATURE in balance_keys)))
