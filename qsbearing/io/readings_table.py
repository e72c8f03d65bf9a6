"""The table [readings] of a scene file: what is to be read off the solution, each reading a table of its own."""

from __future__ import annotations

from functools import cache
from typing import Any

from pydantic import BaseModel

from qsbearing.io.file_errors import FileErrorDetail, translate
from qsbearing.io.table_checks import Errors, checked, si, table_model
from qsbearing.io.unknown_key import near
from qsbearing.scene.keys import READING_CHOICES, READING_TABLES
from qsbearing.scene.scene import Scene


@cache  # to make one takes milliseconds, and a search reads a file's tables a thousand times
def _model(name: str) -> type[BaseModel]:
    """How a reading's table is built. What its words may be, the reading itself knows."""
    return table_model(name, READING_TABLES[name], dict.fromkeys(READING_CHOICES.get(name, ()), (str | None, None)))


def asked_readings(document: dict[str, Any], errors: Errors) -> dict[str, dict[str, Any]]:
    """The readings that a file asks for, by name, with their arguments in SI; `true` asks for one without any."""
    table = document.get("readings", {})
    if not isinstance(table, dict):
        cause = "Write it as [readings], one table for each: [readings.life]"
        errors.append(FileErrorDetail("readings", "is not a table", table, cause=cause))
        return {}
    before = len(errors)
    asked: dict[str, dict[str, Any]] = {}
    for name, given in table.items():
        if name not in READING_TABLES:
            meant = near(str(name).lower(), READING_TABLES, 0.5)
            cause = f"Did you mean [readings.{meant}]?" if meant else f"One of {', '.join(READING_TABLES)}"
            errors.append(FileErrorDetail(f"readings.{name}", "is no reading", cause=cause))
            continue
        good, _ = checked(_model(name), f"readings.{name}", {} if given is True else given, errors)
        chosen = {choice: good[choice] for choice in READING_CHOICES.get(name, ()) if choice in good}
        asked[name] = si(READING_TABLES[name], good) | chosen
    if asked and len(errors) == before:  # what cannot be used would be missing as well
        from qsbearing.readings.asked import asked_errors  # a scene without readings does not load them

        errors += map(translate, asked_errors(asked))
    return asked


def errors_in_scene(scene: Scene) -> list[FileErrorDetail]:
    """What is wrong with a scene's readings that only the whole scene shows."""
    if not scene.readings:
        return []
    from qsbearing.readings.asked import asked_errors

    return list(map(translate, asked_errors(scene.readings, scene)))
