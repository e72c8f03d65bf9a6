"""The 209 bearing of Hamrock's textbook by the textbook's own steps: a reference, with nothing of `qsbearing`.

Load distribution under clearance and the films of the heaviest ball; contacts exact in Carlson's integrals, or by the
textbook's simple forms (Hamrock & Brewe, J. Lubrication Technology 105, 1983). Film: Hamrock & Dowson 1977.
"""

from __future__ import annotations

from math import cos, exp, log, pi, sqrt
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq
from scipy.special import elliprf

from fem_check.independent import references

Z, D, DM, R, CLEARANCE = 9, 12.7e-3, 64.9985e-3, 6.604e-3, 15e-6
LOAD, SPEED = 8900.0, 400.0
MODULUS, POISSON = 200e9, 0.3
VISCOSITY, PRESSURE_VISCOSITY = 0.04, 2.3e-8
BALL_ROUGHNESS, RACEWAY_ROUGHNESS = 0.0625e-6, 0.0175e-6


class EllipticalContact(NamedTuple):
    """One raceway by the second evaluation: its shape, not its load."""

    Rx: float
    k: float
    stiffness: float
    """Q/approach^1.5 [N/m^1.5]."""


def contact(side: float, is_exact: bool) -> EllipticalContact:
    """Rx, k and stiffness: exact in Carlson's integrals, or by the textbook's simple forms (Hamrock & Brewe 1983)."""
    effective = MODULUS / (1.0 - POISSON**2)
    Rx, Ry = 0.5 * D * (1.0 + side * D / DM), R * D / (2.0 * R - D)
    if is_exact:
        ratio = references.axis_ratio(Rx / Ry)
        k = 1.0 / ratio
        first, second = float(elliprf(0.0, ratio**2, 1.0)), second_kind(ratio)
    else:
        k = (Ry / Rx) ** (2.0 / pi)
        first, second = 0.5 * pi + (0.5 * pi - 1.0) * log(Ry / Rx), 1.0 + (0.5 * pi - 1.0) * Rx / Ry
    radius = 1.0 / (1.0 / Rx + 1.0 / Ry)
    return EllipticalContact(Rx, k, pi * k * effective * sqrt(radius * second / (4.5 * first**3)))


def second_kind(ratio: float) -> float:
    """E(m) with 1 - m = (b/a)^2, by the trapezoidal rule, which converges faster than any power on a period."""
    angle = (np.arange(4000) + 0.5) * pi / 4000
    return float(0.5 * pi * np.sqrt(np.cos(angle) ** 2 + ratio**2 * np.sin(angle) ** 2).mean())


def largest_load(inner: EllipticalContact, outer: EllipticalContact) -> float:
    """Load of the ball under the load line: equilibrium of the ring, balls at multiples of 40 degrees [N]."""
    series = (inner.stiffness ** (-2.0 / 3.0) + outer.stiffness ** (-2.0 / 3.0)) ** -1.5
    angles = [2.0 * pi * j / Z for j in range(Z)]

    def carried(displacement: float) -> float:
        approach = [max(displacement * cos(angle) - 0.5 * CLEARANCE, 0.0) for angle in angles]
        return sum(series * each**1.5 * cos(angle) for each, angle in zip(approach, angles, strict=True)) - LOAD

    displacement = brentq(carried, 0.0, 1e-3, xtol=1e-15)
    return float(series * (displacement - 0.5 * CLEARANCE) ** 1.5)


def film(place: EllipticalContact, load: float) -> tuple[float, float]:
    """Hamrock and Dowson's minimum and central film [m], at the entrainment speed of pure rolling."""
    effective = MODULUS / (1.0 - POISSON**2)
    U, G = VISCOSITY * entrainment_speed() / (effective * place.Rx), PRESSURE_VISCOSITY * effective
    W = load / (effective * place.Rx**2)
    least = 3.63 * U**0.68 * G**0.49 * W**-0.073 * (1.0 - exp(-0.68 * place.k))
    central = 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * exp(-0.73 * place.k))
    return place.Rx * least, place.Rx * central


def entrainment_speed() -> float:
    """Mean speed of both surfaces at either contact in pure rolling at angle zero [m/s]."""
    return SPEED * (DM**2 - D**2) / (4.0 * DM)
