"""Where a contact first yields, below the surface, and where it is dented for good."""

from __future__ import annotations

FIRST_YIELD_SHEAR = 0.31
"""Largest shear stress below a contact over its maximum pressure: 0.30 of a line contact, 0.31 of a circle, up to 0.325
between (`hertz.subsurface_shear`, Poisson's ratio 0.3)."""

STATIC_PRESSURE = 4200e6
"""Permissible contact pressure of ball bearings at rest [Pa]: a permanent dent of about 1e-4 D (ISO 76)."""


def first_yield_pressure(yield_strength: float) -> float:
    """Maximum pressure at which steel first yields, below the surface [Pa]: 2 * 0.31 p0 = sigma_y.

    Tresca's criterion for the largest shear under the centre (Johnson, Contact Mechanics, chapter 6), within 5 % for
    every ellipse. `STATIC_PRESSURE` lies higher: there a permanent dent has grown to a size that is felt.

    Args:
        yield_strength: in simple tension [Pa].
    """
    return yield_strength / (2.0 * FIRST_YIELD_SHEAR)
