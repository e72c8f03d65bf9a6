"""The readings that a scene, or a row of a set, asks for."""

from __future__ import annotations

from typing import Any

from qsbearing.documents.from_rich import blocks as from_rich
from qsbearing.documents.model import Block
from qsbearing.io.readings_record import Readings


def warnings_of(readings: Readings) -> list[str]:
    """What there is to beware of in them."""
    return [each for reading in readings.values() for each in getattr(reading, "warnings", ())]


def tables(readings: Readings) -> list[Block]:
    """Their tables, warnings below each."""
    if not readings:
        return []
    from qsbearing.io.readings_report import readings_tables

    found: list[Any] = readings_tables(readings)
    return [block for each in found for block in from_rich(each)]
