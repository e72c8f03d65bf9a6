"""A page with a marked table, or part of a line, made anew."""

from __future__ import annotations

import re


def filled(page: str, mark: str, table: str) -> str:
    """The page with this between its marks, which say what makes it; a table has lines of its own.

    Raises:
        ValueError: the page has not one such place.
    """
    pattern = rf"(<!-- {mark}: made by [^>]*-->)(\n?).*?(<!-- end of {mark} -->)"
    page, count = re.subn(
        pattern, lambda match: f"{match[1]}{match[2]}{table}{match[2]}{match[3]}", page, flags=re.DOTALL
    )
    if count != 1:
        raise ValueError(f"the page has {count} places marked {mark!r}, not one")
    return page
