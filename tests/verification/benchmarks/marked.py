"""A page of the guide with a marked table made anew."""

from __future__ import annotations

import re


def filled(page: str, mark: str, script: str, table: str) -> str:
    """The page with this table between its marks, which name the script that makes it.

    Raises:
        ValueError: the page has not one such place.
    """
    pattern = rf"(<!-- {mark}: made by tests/verification/benchmarks/{script}.py -->\n).*?(<!-- end of {mark} -->)"
    page, count = re.subn(pattern, lambda match: f"{match[1]}{table}\n{match[2]}", page, flags=re.DOTALL)
    if count != 1:
        raise ValueError(f"the page has {count} tables marked {mark!r}, not one")
    return page
