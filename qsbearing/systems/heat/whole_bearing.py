"""The same bearing or set with the friction of the whole bearing, where its heat is that of the contacts alone.

Sliding in the contacts is a lower bound of the heat, so that a preload may run away at a lower speed than it shows.
Palmgren's formula contains the oil too: M = f0 (nu n)^(2/3) dM^3 1e-7 + f1 P1 dM (`readings.friction_estimate`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from qsbearing.model.bearing import BallBearing
from qsbearing.model.effects import RingEffect, RingExpansion
from qsbearing.model.validation import ErrorDetail, SceneError
from qsbearing.readings.asked import LUBRICANT
from qsbearing.readings.static_rating import static_load_rating
from qsbearing.systems.heat.network import PALMGREN_NEEDS, READING_OF

PALMGREN = "palmgren"
ESTIMATE = READING_OF[PALMGREN]
OIL_BATH = 2.0
"""f0 where the scene gives none: what Schaeffler prints for an oil bath and for most series."""
GRADE = 32
"""ISO viscosity grade where the scene gives none (chosen: usual for spindles)."""


def with_whole_friction(of: Any) -> tuple[Any, list[str]]:
    """A scene or set with Palmgren's friction; and what is assumed for it, in words.

    Numbers of [readings.friction_estimate] and [readings.lubricant] are used where it has them.

    Raises:
        SceneError: a row without bore and outside diameter; what else the friction lacks is found where it is solved.
    """
    assumed: dict[str, None] = {}
    thermal, rows = of.thermal, getattr(of, "rows", None)
    if rows is None:
        own: dict[str, Any] = {"readings": _readings(of.bearing, of.ring_effects, of.readings, assumed)}
    else:
        requested = [of.readings if row.readings is None else row.readings for row in rows]
        given = [_readings(r.bearing, of.effects_of(r), each, assumed) for r, each in zip(rows, requested, strict=True)]
        own = {"rows": tuple(replace(row, readings=each) for row, each in zip(rows, given, strict=True))}
    if thermal.oil_node is None:
        thermal = replace(thermal, viscosity_at="outer_ring")
        assumed["viscosity at the temperature of the outer ring"] = None
    return replace(of, thermal=replace(thermal, friction=PALMGREN), **own), list(assumed)


def _readings(
    bearing: BallBearing, effects: Iterable[RingEffect], given: Mapping[str, Any], assumed: dict[str, None]
) -> dict[str, Any]:
    """Those of a row, with all that Palmgren's friction takes."""
    own = dict(given.get(ESTIMATE, {}))
    rings = next((each for each in effects if isinstance(each, RingExpansion)), None)
    for name in ("bore_diameter", "outside_diameter"):
        if own.get(name) is None and rings is not None:
            own[name] = getattr(rings, name)
        if own.get(name) is None:
            raise SceneError([ErrorDetail(f"readings.{ESTIMATE}.{name}", "missing", detail=PALMGREN_NEEDS)])
    if own.get("lubrication_factor") is None:
        own["lubrication_factor"] = OIL_BATH
        assumed[f"f0 = {OIL_BATH:g} (oil bath)"] = None
    if own.get("static_load_rating") is None:
        own["static_load_rating"] = float(np.mean(static_load_rating(bearing)))
        assumed[f"C0 = {own['static_load_rating']:.4g} N from the geometry"] = None
    oil = given.get(LUBRICANT)
    if oil is None:
        oil = {"iso_viscosity_grade": GRADE}
        assumed[f"ISO VG {GRADE}"] = None
    return {**given, ESTIMATE: own, LUBRICANT: oil}
