"""Equivalent dynamic load P of a single row by the factors of ISO 281:2007, table 3.

The table of X, Y and e is printed by every bearing catalogue; the values for 15, 25 and 40 degrees and for deep groove
were compared with one (LYC, tables 2 and 3, where Fa/C0 stands for f0 Fa/C0 with f0 = 12.3). Its columns for 5 and 10
degrees are not here.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.readings.bearing_numbers import BearingNumbers
from qsbearing.scene.bearing import BallBearing, BearingKind
from qsbearing.units import deg, mm

# fmt: off
_DEEP_GROOVE = np.array([  # f0 Fa/C0, e, Y; X = 0.56
    (0.172, 0.19, 2.30), (0.345, 0.22, 1.99), (0.689, 0.26, 1.71), (1.03, 0.28, 1.55), (1.38, 0.30, 1.45),
    (2.07, 0.34, 1.31), (3.45, 0.38, 1.15), (5.17, 0.42, 1.04), (6.89, 0.44, 1.00),
])
_FIFTEEN = np.array([  # f0 Fa/C0, e, Y; X = 0.44
    (0.178, 0.38, 1.47), (0.357, 0.40, 1.40), (0.714, 0.43, 1.30), (1.07, 0.46, 1.23), (1.43, 0.47, 1.19),
    (2.14, 0.50, 1.12), (3.57, 0.55, 1.02), (5.35, 0.56, 1.00), (7.14, 0.56, 1.00),
])
_STEEP = np.array([  # angle, e, X, Y
    (20.0, 0.57, 0.43, 1.00), (25.0, 0.68, 0.41, 0.87), (30.0, 0.80, 0.39, 0.76), (35.0, 0.95, 0.37, 0.66),
    (40.0, 1.14, 0.35, 0.57), (45.0, 1.34, 0.33, 0.50),
])
# fmt: on
_X_DEEP_GROOVE, _X_FIFTEEN = 0.56, 0.44

LEAST_ANGLE, GREATEST_ANGLE = 15.0 * deg, 45.0 * deg
"""Angular-contact bearings outside these have no column here: NaN."""


def equivalent_load(bearing: BallBearing, radial_load: ArrayLike, axial_load: ArrayLike) -> NDArray:
    """P = X Fr + Y Fa, or Fr where Fa/Fr <= e [N].

    Args:
        radial_load, axial_load: Fr and Fa on the ring [N]. At 0 and 15 degrees X, Y and e follow f0 Fa/C0, which is
            Fa/(Z D^2 cos(alpha)) in N and mm.

    Returns:
        NaN for angular-contact bearings below 15 or above 45 degrees. Linear between the table's angles and loads;
        beyond its loads its last values.
    """
    numbers = BearingNumbers(bearing)
    radial, axial = np.abs(np.asarray(radial_load, float)), np.abs(np.asarray(axial_load, float))
    # f0/C0 = 1/(Z D^2 cos alpha): by the definition of C0 the factor f0 drops out, whatever the grooves.
    relative = axial / (numbers.ball_count * (numbers.ball_diameter / mm) ** 2 * np.cos(numbers.nominal_angle))
    if bearing.kind is BearingKind.DEEP_GROOVE:
        e, Y = (np.interp(relative, _DEEP_GROOVE[:, 0], _DEEP_GROOVE[:, i]) for i in (1, 2))
        X = np.full(np.shape(relative), _X_DEEP_GROOVE)
    else:
        e, X, Y = _by_angle(numbers.nominal_angle, relative)
    return np.asarray(np.where(axial <= e * radial, radial, X * radial + Y * axial))


def _by_angle(angle: NDArray, relative: NDArray) -> tuple[NDArray, NDArray, NDArray]:
    """(e, X, Y) by the nominal angle; between 15 and 20 degrees both columns count."""
    fifteen = [np.interp(relative, _FIFTEEN[:, 0], _FIFTEEN[:, i]) for i in (1, 2)]
    steep = [np.interp(angle, _STEEP[:, 0] * deg, _STEEP[:, i]) for i in (1, 2, 3)]
    part = np.clip((angle - LEAST_ANGLE) / (_STEEP[0, 0] * deg - LEAST_ANGLE), 0.0, 1.0)
    covered = (angle >= LEAST_ANGLE - 1e-9) & (angle <= GREATEST_ANGLE + 1e-9)
    part = np.where(covered, part, np.nan)
    e, X, Y = (
        (1.0 - part) * low + part * high for low, high in zip((fifteen[0], _X_FIFTEEN, fifteen[1]), steep, strict=True)
    )
    return e, X, Y
