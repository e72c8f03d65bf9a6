"""Elastic rings beside fits, rotation and heat: one description of each seat.

While an interference lasts, ring and seat act as one body and their give adds to the growth by fit, rotation and heat
(both are linear). Where a clearance remains, the ring must first grow through it, and rests on one side of its seat
under a radial load: that is not modelled, and refused.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from qsbearing.effects import ElasticRings, RingExpansion
from qsbearing.scene.bearing import BallBearing
from qsbearing.scene.operation import Operation
from qsbearing.units import um
from qsbearing.validation import LENGTH, ErrorDetail, first

_SEATS = (
    ("shaft", "bore_diameter", "shaft_bore_diameter", 0),
    ("housing", "outside_diameter", "housing_outside_diameter", 1),
)
"""Of each seat: the ring's diameter and its own, and which of a bearing's rings it holds."""


def seat_errors(
    rings: ElasticRings, expansion: RingExpansion, bearing: BallBearing, operation: Operation
) -> list[ErrorDetail]:
    """What the two say differently of a ring or its seat, and seats with clearance in operation."""
    errors: list[ErrorDetail] = []
    states = expansion.states(bearing, operation)
    for seat, ring, own, which in _SEATS:
        word, has_body = getattr(rings, seat), getattr(rings, own) is not None or getattr(rings, seat) == "solid"
        errors += _differing(rings, expansion, ring)
        interference = getattr(expansion, f"{seat}_interference")
        if interference is None or word == "rigid":
            continue
        field, gap = f"{rings.name}.{seat}", states[which].seat_gap
        if word == "free":
            cause = f"Describe the {seat} here too, or leave out {seat}_interference there"
            errors.append(ErrorDetail(field, f"is free, but ring_expansion fits it to a {seat}", "free", cause=cause))
        elif has_body:
            errors += _differing(rings, expansion, own)
            apart = np.asarray(gap) > 0.0
            if gap is not None and apart.any():
                (found,) = first(apart, np.asarray(gap))
                problem = f"gives way, but stands {found / um:.4g} um (diametral) off its ring in operation"
                cause = (
                    f'A clearance closes first, which is not modelled: a tighter fit, or {seat} = "free" while it lasts'
                )
                errors.append(ErrorDetail(field, problem, cause=cause, where=apart))
    return errors


def _differing(rings: ElasticRings, expansion: RingExpansion, name: str) -> list[ErrorDetail]:
    here: Any = getattr(rings, name)
    there: Any = getattr(expansion, name)
    if here is None or there is None:
        return []
    here, there = np.broadcast_arrays(np.asarray(here, float), np.asarray(there, float))
    bad = np.abs(here - there) > 1e-9 * np.abs(there)
    if not bad.any():
        return []
    found, other = first(bad, here, there)
    problem = f"is another than ring_expansion.{name}, {other / 1e-3:.8g} mm"
    return [ErrorDetail(f"{rings.name}.{name}", problem, found, LENGTH, cause="One body has one diameter", where=bad)]
