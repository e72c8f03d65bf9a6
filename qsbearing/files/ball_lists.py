"""The bearings of a file that are lists of ball sets, since their data sheet or their number alone is given."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from qsbearing.files.bearing_table import bearing_of
from qsbearing.files.data_sheet_table import is_data_sheet
from qsbearing.files.row_bearing import whole_bearing
from qsbearing.files.sheet_by_name import sheets_by_name
from qsbearing.inference.practice import RatingPractice
from qsbearing.model.bearing import BallBearing
from qsbearing.model.scene.scene import Scene
from qsbearing.remarks.wording import listed


class Listed(NamedTuple):
    """A bearing of which the best of several ball sets is solved."""

    bearing: BallBearing
    """All of them, as arrays."""
    rows: tuple[int, ...] = ()
    """Of a set; from 0."""

    @property
    def sets(self) -> int:
        """How many."""
        return int(self.bearing.inferred.set_number[-1]) + 1

    def in_place_of_one(self, of: Any) -> Any:
        """A scene or set with all of them."""
        if isinstance(of, Scene):
            return replace(of, bearing=self.bearing)
        rows = [replace(row, bearing=self.bearing) if k in self.rows else row for k, row in enumerate(of.rows)]
        return replace(of, rows=tuple(rows))

    def __str__(self) -> str:
        name, numbers = self.bearing.name or "Bearing", [str(row + 1) for row in self.rows]
        where = f" ({'rows' if len(numbers) > 1 else 'row'} {listed(numbers)})" if numbers else ""
        is_guess = self.bearing.inferred.sheet.rating_practice == RatingPractice.PROPORTIONS
        guess = "; its balls are guessed" if is_guess else ""
        return f"{name}{where}: ball set 1 of {self.sets}, the best fit{guess}"


def listed_in(document: Mapping[str, Any]) -> list[Listed]:
    """Those of a file's tables, alike ones of several rows together."""
    rows = document.get("rows")
    of_rows = [each for each in rows if isinstance(each, dict)] if isinstance(rows, list) else []
    tables = [whole_bearing(row, document.get("bearing")) for row in of_rows]
    every = tables if tables else [document.get("bearing")]
    lists = []
    for number, table in enumerate(every):
        if not isinstance(table, dict) or not _may_be_list(table) or "ball_set" in table or table in every[:number]:
            continue
        plain = {key: each for key, each in table.items() if key != "preload"}
        bearing = bearing_of({"bearing": plain}, "", [], may_infer=True)
        if bearing is not None and bearing.inferred is not None:
            alike = tuple(k for k, each in enumerate(every) if each == table) if tables else ()
            lists.append(Listed(bearing, alike))
    return lists


def said_of(lists: list[Listed]) -> list[str]:
    """What is solved in place of a list, a sentence for each."""
    return [f"{each}. ball_set in its [bearing] chooses another" for each in lists]


def _may_be_list(table: Mapping[str, Any]) -> bool:
    """Whether it is a data sheet or a number; others need not load what infers."""
    return is_data_sheet({*table}) or bool(sheets_by_name(table))
