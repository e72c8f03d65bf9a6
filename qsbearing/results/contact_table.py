"""Results of contacts and balls as a table: the smallest and the largest of each. It loads no reading."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Table
from qsbearing.model.solution.result_keys import Place, Result, printed_unit
from qsbearing.results.tables import digits_of

NOISE = 1e-12
"""Below this part of the largest of its kind a number is rounding, and shown as zero."""


def per_contact(title: str, placed: Iterable[tuple[Place, NDArray | None]]) -> Table | None:
    """Of results of contacts or balls the smallest and the largest; None where there are none."""
    cells: dict[Result, dict[str, NDArray]] = {}
    for place, values in placed:
        if place.is_per_ball and values is not None and np.isfinite(values).any():
            cells.setdefault(place.result, {})[place.group.raceway or "ball"] = values
    if not cells:
        return None
    sides = [side for side in ("inner", "outer", "ball") if any(side in row for row in cells.values())]
    heading = [cell for side in sides for cell in (f"{side}\nsmallest", f"{side}\nlargest")]
    rows = []
    for result, row in cells.items():
        name = result.plain_name
        if result.is_signed and not _are_alike(row.values()) and any((values < 0.0).any() for values in row.values()):
            name, row = f"{name}, size", {side: np.abs(values) for side, values in row.items()}
        largest = max(float(np.nanmax(np.abs(values))) for values in row.values())
        spans = [_span(row[side], NOISE * largest) if side in row else ("", "") for side in sides]
        rows.append((name, spans, printed_unit(result.unit)))
    if not any(high for _, spans, _ in rows for _, high in spans):  # all balls are alike
        cells_of = [(name, *(low for low, _ in spans), unit) for name, spans, unit in rows]
        return Table(("quantity", *sides, "unit"), cells_of, f"l{'r' * len(sides)}l", title)
    cells_of = [(name, *(cell for span in spans for cell in span), unit) for name, spans, unit in rows]
    return Table(("quantity", *heading, "unit"), cells_of, f"l{'r' * len(heading)}l", title)


def _are_alike(row: Iterable[NDArray]) -> bool:
    """Whether each side's balls have one number, to the digits shown."""
    return all(digits_of(np.nanmin(values)) == digits_of(np.nanmax(values)) for values in row)


def _span(values: NDArray, noise: float) -> tuple[str, str]:
    """The smallest and the largest; one where they are the same to the digits shown."""
    values = np.where(np.abs(values) < noise, 0.0, values)
    low, high = digits_of(np.nanmin(values)), digits_of(np.nanmax(values))
    return (low, "") if low == high else (low, high)
