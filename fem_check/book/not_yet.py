"""Published cases that wait for a document: which, what it would show, and what of it is at hand."""

from __future__ import annotations

import tomllib
from importlib.resources import files

NOT_YET: list[dict[str, str]] = tomllib.loads((files("fem_check.book") / "not_yet.toml").read_text("utf-8"))["wanted"]
"""Each with `document`, `would_show` and `at_hand`."""
