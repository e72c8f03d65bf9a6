"""Elastic rings together with fits, rotation and heat: one description of each seat.

While an interference lasts, ring and seat act as one body and their deflection adds to the growth by fit, rotation
and heat (both are linear). Where a clearance remains, the ring is free until the mean growth by its balls has closed
it; then ring and seat are one body again, whose seat pressure the clearance lessens by what it takes to close (the
same sum, with a fit's pressure below zero). Which of the two holds, the solver finds (`solution.closing_seats`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.effects import ElasticRings, RingExpansion
from qsbearing.model.operation import Operation
from qsbearing.model.units import GPa, mm, um
from qsbearing.model.validation import LENGTH, MODULUS, RATIO, ErrorDetail, Field, Sentence, first

_SEATS = (
    ("shaft", "bore_diameter", "shaft_bore_diameter", 0),
    ("housing", "outside_diameter", "housing_outside_diameter", 1),
)
"""Of each seat: the ring's diameter and its own, and which of a bearing's rings it holds."""


def seat_errors(rings: ElasticRings, expansion: RingExpansion, bearing: BallBearing) -> list[ErrorDetail]:
    """What the two say differently of a ring or its seat."""
    errors: list[ErrorDetail] = []
    for seat, ring, own, _ in _SEATS:
        word, has_body = getattr(rings, seat), getattr(rings, own) is not None or getattr(rings, seat) == "solid"
        errors += _differing(rings, expansion, ring)
        interference = getattr(expansion, f"{seat}_interference")
        if interference is None or word == "rigid":
            continue
        if word == "free":
            fit = Field(f"{expansion.name}.{seat}_interference")
            cause = Sentence("Describe the {seat} here too, or leave out {fit}", seat=seat, fit=fit)
            field = f"{rings.name}.{seat}"
            errors.append(ErrorDetail(field, f"is free, but ring_expansion fits it to a {seat}", "free", cause=cause))
        elif has_body:
            errors += _differing(rings, expansion, own) + _material_errors(rings, expansion, bearing, seat)
    return errors


def clearances(
    rings: ElasticRings | None, expansion: RingExpansion | None, bearing: BallBearing, operation: Operation
) -> dict[str, NDArray]:
    """By how much elastic rings stand off what holds them before loads act, by seats that do so anywhere [m]."""
    if rings is None or expansion is None:
        return {}
    gaps = {}
    for seat, _, own, which in _SEATS:
        if getattr(rings, own) is None and getattr(rings, seat) != "solid":
            continue
        gap = expansion.states(bearing, operation)[which].seat_gap
        if gap is not None and (np.asarray(gap) > 0.0).any():
            gaps[seat] = np.asarray(gap)
    return gaps


def clearance_errors(
    rings: ElasticRings | None, expansion: RingExpansion | None, bearing: BallBearing, operation: Operation
) -> list[ErrorDetail]:
    """Such seats, where the balls cannot close them: in a set, whose rows are solved together."""
    errors = []
    for seat, gap in clearances(rings, expansion, bearing, operation).items():
        (clearance,) = first(gap > 0.0, gap)
        problem = f"is elastic, but has {clearance / um:.4g} um (diametral) of clearance to its ring in operation"
        cause = f'A clearance closes in a bearing alone: a tighter fit, or {seat} = "free" while it stays open'
        errors.append(ErrorDetail(f"elastic_rings.{seat}", problem, cause=cause, where=gap > 0.0))
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
    value, other = first(bad, here, there)
    there = Field(f"{expansion.name}.{name}")
    problem = Sentence("is another than {there}, {other:.8g} mm", there=there, other=other / mm)
    return [ErrorDetail(f"{rings.name}.{name}", problem, value, LENGTH, cause="One body has one diameter", where=bad)]


def _material_errors(
    rings: ElasticRings, expansion: RingExpansion, bearing: BallBearing, seat: str
) -> list[ErrorDetail]:
    """A seat of two materials; left out, it is of the rings' in either description."""
    errors, material = [], getattr(expansion, f"{seat}_material") or bearing.ring_material
    for name, quantity, unit in (("elastic_modulus", MODULUS, GPa), ("poisson_ratio", RATIO, 1.0)):
        own = getattr(rings, f"{seat}_{name}")
        of_rings = getattr(bearing.ring_material, name)
        numbers = (np.asarray(each, float) for each in (of_rings if own is None else own, getattr(material, name)))
        here, there = np.broadcast_arrays(*numbers)
        bad = np.abs(here - there) > 1e-9 * np.abs(there)
        if bad.any():
            value, other = first(bad, here, there)
            told = "that of the rings, for it is left out" if own is None else "given here"
            problem = f"is {told}, but the {seat} of ring_expansion has {other / unit:.6g}{' GPa' * (unit == GPa)}"
            cause = f"One body has one material: state {seat}_material there and its constants here alike"
            errors.append(ErrorDetail(f"{rings.name}.{seat}_{name}", problem, value, quantity, cause=cause, where=bad))
    return errors
