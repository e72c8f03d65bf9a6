"""The shear stress parallel to the surface below Hertz's pressure, by integration of Boussinesq's point loads.

In the plane across the middle of the ellipse, rolling along y,

    tau_yz(y, z) = integral of 3 p (y - y') z^2/(2 pi r^5)
"""

from __future__ import annotations

from math import pi

import numpy as np
from scipy.optimize import minimize

from fem_check.independent.contact_problem import Array

ALONG, ACROSS = 600, 120
"""Points along the ellipse's axes."""


def amplitude(ellipticity: float) -> tuple[float, float]:
    """Largest over y and z, over p0, and its depth over b."""
    (angle_x, weight_x), (angle_y, weight_y) = (
        0.5 * pi * np.array(np.polynomial.legendre.leggauss(count)) for count in (ALONG, ACROSS)
    )
    # y' = b sin, x' = a cos sin: the pressure is cos cos, and what its root does at the edge is gone.
    y = np.sin(angle_y)[:, None] * np.ones(ALONG)
    x = ellipticity * np.cos(angle_y)[:, None] * np.sin(angle_x)
    load = ellipticity * np.outer(np.cos(angle_y) ** 3 * weight_y, np.cos(angle_x) ** 2 * weight_x)

    def negative(place: Array) -> float:
        across, depth = place
        r2 = x**2 + (across - y) ** 2 + depth**2
        return -float(abs(np.sum(1.5 / pi * load * (across - y) * depth**2 / r2**2.5)))

    minimum = minimize(negative, np.array([0.85, 0.45]), method="Nelder-Mead", options={"xatol": 1e-8, "fatol": 1e-14})
    return -float(minimum.fun), float(minimum.x[1])
