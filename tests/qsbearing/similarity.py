"""A bearing that is warm throughout is similar to itself: what it and its scene are when every length has grown."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import qsbearing as qs
from tests.qsbearing.scenes import B218

HOT = 70.0 + qs.zero_celsius
GROWN = 1.0 + 12e-6 * 50.0
"""By which all lengths grow, of steel."""
LENGTHS = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")
FITS = {
    "bore_diameter": 90 * qs.mm,
    "outside_diameter": 160 * qs.mm,
    "shaft_interference": 20 * qs.um,
    "housing_interference": 10 * qs.um,
    "housing_outside_diameter": 220 * qs.mm,
}
"""Of B218."""
THROUGHOUT = dict.fromkeys(("shaft", "inner_ring", "outer_ring", "housing"), HOT)
"""The temperature of every body."""


def grown(bearing: qs.BallBearing = B218) -> qs.BallBearing:
    """The bearing with all its lengths as the heat leaves them, at rest and cold."""
    return replace(bearing, **{name: getattr(bearing, name) * GROWN for name in LENGTHS})


def cold_fits() -> tuple[qs.RingExpansion, ...]:
    """The fits of the grown bearing, likewise."""
    return (qs.RingExpansion(**{name: length * GROWN for name, length in FITS.items()}),)


def warm_fits(**temperatures: Any) -> tuple[Any, ...]:
    """The fits of the bearing in bodies of these temperatures, its balls hot; no temperature: all hot."""
    bodies = {f"{body}_temperature": value for body, value in (temperatures or THROUGHOUT).items()}
    return qs.RingExpansion(**FITS, **bodies), qs.BallExpansion(HOT)
