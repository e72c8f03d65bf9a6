"""How hypothesis runs here: the same examples every time, no deadline, few enough for a suite of a minute."""

from __future__ import annotations

from hypothesis import settings

from qsbearing.compiled import COMPILED

settings.register_profile(
    "qsbearing", derandomize=True, deadline=None, database=None, max_examples=60 if COMPILED else 4
)
settings.load_profile("qsbearing")
