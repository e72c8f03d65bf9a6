"""Where a contact first yields: below the surface, long before a dent is seen."""

from __future__ import annotations

FIRST_YIELD_SHEAR = 0.31
"""Largest shear stress below a contact over its maximum pressure: 0.30 of a line contact, 0.31 of a circle, up to 0.325
between (`hertz.subsurface_shear`, Poisson's ratio 0.3)."""


def first_yield_pressure(yield_strength: float) -> float:
    """Maximum pressure at which steel first yields, below the surface [Pa]: 2 * 0.31 p0 = sigma_y.

    Tresca's criterion for the largest shear under the centre (Johnson, Contact Mechanics, chapter 6), within 5 % for
    every ellipse. ISO 76's limit of 4200 MPa lies higher: there a permanent dent has grown to about 1e-4 of the ball's
    diameter.

    Args:
        yield_strength: in simple tension [Pa].
    """
    return yield_strength / (2.0 * FIRST_YIELD_SHEAR)
