"""Reads the committed reference values of the boundary-element half-space."""

from __future__ import annotations

import json
from functools import lru_cache
from math import isclose
from pathlib import Path
from typing import Any

from fem_check.groove import BallInGroove

FILE = Path(__file__).parent / "values.json"


@lru_cache(maxsize=1)
def load() -> dict[str, Any]:
    """The file."""
    return dict(json.loads(FILE.read_text()))


def source() -> str:
    """Where the values come from."""
    entry = load()
    return f"{entry['library']}, {entry['points']} x {entry['points']} points, exact gap"


def over_hertz(groove: BallInGroove, load_N: float) -> dict[str, float] | None:
    """Each quantity with the exact gap over Hertz's; None where this contact is not in the file."""
    entry = load()
    same = all(
        isclose(getattr(groove, name), entry["bearing"][name], rel_tol=1e-9)
        for name in ("ball_diameter", "pitch_diameter", "contact_angle")
    )
    if not same:
        return None
    coefficient = groove.groove_radius / groove.ball_diameter
    for case in entry["cases"]:
        if (
            case["race"] == groove.race_name
            and isclose(case["load_N"], load_N)
            and isclose(case["groove_radius_coefficient"], coefficient, rel_tol=1e-9)
        ):
            return dict(case["over_hertz"])
    return None
