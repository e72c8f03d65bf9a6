"""What is said of rows of a set: once where it holds for all, else with their numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeVar

Said = TypeVar("Said")


def of_rows(said: Mapping[int, Sequence[Said]]) -> list[tuple[Said, str | None]]:
    """Each thing once, in its order, with "row 1 and 3", or None where it is said of every row.

    Args:
        said: of each row, by its number.
    """
    rows: dict[Said, list[int]] = {}
    for number, found in said.items():
        for each in found:
            rows.setdefault(each, []).append(number)
    return [
        (each, None if len(numbers) == len(said) else f"row {' and '.join(map(str, numbers))}")
        for each, numbers in rows.items()
    ]
