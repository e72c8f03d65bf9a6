"""Equivalent dynamic load P of a single row by the factors of ISO 281:2007, tables 3 and 5.

Every bearing catalogue prints these X, Y and e. Compared were: deep groove, 15, 25 and 40 degrees with LYC's tables 2
and 3; 10 degrees with SKF's factors for deep-groove bearings of clearance C3, which are the same. Up to 15 degrees they
follow Fa/(Z D^2), which the standard also writes f0 Fa/C0 times cos(alpha): f0 drops out, whatever the grooves. The
rows of 20, 30, 35 and 45 degrees were not compared with a source.

Thrust bearings, above 45 degrees: P = X Fr + Fa with X = 1.25 tan(alpha) (1 - 2/3 sin(alpha)), for Fa/Fr above e = 1.25
tan(alpha); a single row does not suit lighter thrust. These formulas, too, were not compared with a source.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.units import deg, mm
from qsbearing.readings.bearing_numbers import BearingNumbers

# fmt: off
_LOADS = np.array([0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89])
"""Fa/(Z D^2) [N/mm^2]."""
_LIGHT = {  # angle in degrees: e, Y over the loads, and X
    0.0: ((0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44),
          (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00), 0.56),
    10.0: ((0.29, 0.32, 0.36, 0.38, 0.40, 0.44, 0.49, 0.54, 0.54),
           (1.88, 1.71, 1.52, 1.41, 1.34, 1.23, 1.10, 1.01, 1.00), 0.46),
    15.0: ((0.38, 0.40, 0.43, 0.46, 0.47, 0.50, 0.55, 0.56, 0.56),
           (1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00, 1.00), 0.44),
}
_LIGHT[5.0] = _LIGHT[0.0]  # the standard takes the factors of deep groove for single rows of 5 degrees
_STEEP = {  # angle in degrees: e, Y, X
    20.0: (0.57, 1.00, 0.43), 25.0: (0.68, 0.87, 0.41), 30.0: (0.80, 0.76, 0.39), 35.0: (0.95, 0.66, 0.37),
    40.0: (1.14, 0.57, 0.35), 45.0: (1.34, 0.50, 0.33),
}
# fmt: on
_ANGLES = np.array(sorted([*_LIGHT, *_STEEP]))


def equivalent_load(bearing: BallBearing, radial_load: ArrayLike, axial_load: ArrayLike) -> NDArray:
    """P = X Fr + Y Fa, or Fr where Fa/Fr <= e [N]; of a thrust bearing X Fr + Fa, an axial load.

    Args:
        radial_load, axial_load: Fr and Fa on the ring [N].

    Returns:
        NaN for thrust bearings at Fa/Fr <= e. Linear between the table's angles and loads; beyond its loads its last
        values.

    Examples:
        >>> bearing = qs.load_scene("b218").bearing
        >>> print(f"{qs.readings.equivalent_load(bearing, 1e3, 2e3):.0f} N")
        1490 N
    """
    numbers = BearingNumbers(bearing)
    angle = numbers.nominal_angle
    radial, axial = np.abs(np.asarray(radial_load, float)), np.abs(np.asarray(axial_load, float))
    e, Y, X = factors(angle, axial / (numbers.ball_count * (numbers.ball_diameter / mm) ** 2))
    P = np.where(axial <= e * radial, radial, X * radial + Y * axial)
    if not numbers.is_thrust.any():
        return np.asarray(P)
    steepness = 1.25 * np.tan(angle)
    thrust = steepness * (1.0 - 2.0 / 3.0 * np.sin(angle)) * radial + axial
    return np.asarray(np.where(numbers.is_thrust, np.where(axial > steepness * radial, thrust, np.nan), P))


def factors(angle: NDArray, relative_load: NDArray) -> tuple[NDArray, NDArray, NDArray]:
    """(e, Y, X) of a radial bearing at a nominal contact angle up to 45 degrees [rad] and Fa/(Z D^2) [N/mm^2]."""
    degrees = angle / deg
    interpolated = [np.zeros(np.broadcast_shapes(degrees.shape, relative_load.shape)) for _ in range(3)]
    for i, node in enumerate(_ANGLES):
        part = np.interp(degrees, _ANGLES, np.eye(_ANGLES.size)[i])  # one at its node, zero at all others
        if not part.any():
            continue
        at_node: tuple[ArrayLike, ...] = _STEEP.get(node, ())
        if node in _LIGHT:
            e, Y, X = _LIGHT[node]
            at_node = np.interp(relative_load, _LOADS, e), np.interp(relative_load, _LOADS, Y), X
        interpolated = [total + part * np.asarray(value) for total, value in zip(interpolated, at_node, strict=True)]
    return interpolated[0], interpolated[1], interpolated[2]
