"""By how much results with the usual points of a contact differ from those with 64 x 160 points.

Measured once (`tests/verification/benchmarks/friction_points.py`): 2,000 random bearings under thrust at speed, whose
friction coefficient is 0.02 to 0.2 and slip speed 0.01 to 1 m/s. Displacements are relative to the largest, at least to
the approach at the most loaded ball; loads to the largest; each stiffness to itself. Where balls creep, slips turn
round within the ellipse, and points matter more.
"""

from __future__ import annotations

from typing import NamedTuple

CREEPING = 2.0
"""Gyroscopic margin below which balls creep or slip."""


class PointError(NamedTuple):
    """Relative, rounded up to two digits."""

    median: float
    in_95_of_100: float
    largest: float


class PointErrors(NamedTuple):
    """Of random thrust cases alike."""

    balls: str
    """What balls do there."""
    cases: int
    errors: dict[str, PointError]
    """By what is read off."""


HELD = PointErrors(
    "are held by friction",
    1752,
    {
        "displacement": PointError(1.6e-9, 2.3e-4, 1.2e-2),
        "contact loads": PointError(2.1e-9, 1.8e-4, 1.6e-3),
        "axial stiffness": PointError(4.7e-9, 4.3e-4, 1.2e-2),
        "radial stiffness": PointError(6.7e-8, 1.1e-2, 1.9e-1),
    },
)
CREEP = PointErrors(
    "creep or slip",
    248,
    {
        "displacement": PointError(5.2e-5, 1.8e-3, 4.9e-3),
        "contact loads": PointError(2.6e-5, 7.7e-4, 2.0e-3),
        "axial stiffness": PointError(8.2e-5, 2.5e-3, 1.4e-2),
        "radial stiffness": PointError(5.5e-4, 3.1e-2, 1.3e-1),
    },
)


def errors_of_points(margin: float) -> PointErrors:
    """Of cases like one with this gyroscopic margin; one without margin counts as creeping."""
    return HELD if margin >= CREEPING else CREEP
