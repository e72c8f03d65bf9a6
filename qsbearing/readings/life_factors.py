"""What multiplies the basic rating life: reliability, lubrication and contamination; ISO 281:2007, clause 9.

Read from GOST 18855-2013, its translation. The exponents of the life modification factor are misprinted in circulating
copies (0.19097 for 0.19087, 0.053481 for 0.054381): only the ones below make it continuous at kappa = 0.4.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.units import mm, rpm

LARGEST = 50.0
"""aISO is not taken larger."""

LEAST_RATIO, GREATEST_RATIO = 0.1, 4.0
"""kappa: below the first the standard says nothing, above the second it takes the second."""


def reliability_factor(reliability: ArrayLike) -> NDArray:
    """a1 = 0.95 (ln(1/S)/ln(1/0.9))^(2/3) + 0.05 for a survival probability S.

    The three-parameter Weibull distribution of ISO/TR 1281-2, which rounds to ISO 281's table from 90 to 99.95 %.

    Returns:
        a1.

    Examples:
        >>> print(f"{qs.readings.reliability_factor(0.99):.2f}")
        0.25
    """
    S = np.asarray(reliability, float)
    return np.asarray(0.95 * (np.log(S) / np.log(0.9)) ** (2.0 / 3.0) + 0.05)


def reference_viscosity(speed: ArrayLike, pitch_diameter: ArrayLike) -> NDArray:
    """nu1, the kinematic viscosity that a full film needs [m^2/s].

    45 000 n^-0.83 dm^-0.5 below 1000 rpm, 4500 n^-0.5 dm^-0.5 from there; mm^2/s, rpm, mm. The two meet to 1 % there.
    """
    n = np.abs(np.asarray(speed, float)) / rpm
    dm = np.asarray(pitch_diameter, float) / mm
    with np.errstate(divide="ignore"):
        in_mm2 = np.where(n < 1000.0, 45000.0 * n**-0.83, 4500.0 * n**-0.5) * dm**-0.5
    return np.asarray(in_mm2 * mm**2)


def viscosity_ratio(kinematic_viscosity: ArrayLike, speed: ArrayLike, pitch_diameter: ArrayLike) -> NDArray:
    """kappa = nu/nu1: operating viscosity over the one that a full film needs.

    Args:
        kinematic_viscosity: nu at the operating temperature [m^2/s].
        speed: of one ring against the other [rad/s].
        pitch_diameter: dm [m].

    A maker's diagram of nu1 may differ from the formula by a fifth.

    Returns:
        kappa.

    Examples:
        >>> print(f"{qs.readings.viscosity_ratio(20e-6, 1000.0, 70 * qs.mm):.2f}")
        3.63
    """
    return np.asarray(np.asarray(kinematic_viscosity, float) / reference_viscosity(speed, pitch_diameter))


def lubrication_term(viscosity_ratio: ArrayLike) -> NDArray:
    """2.5671 - c/kappa^e of the life modification factor; NaN below kappa = 0.1, constant from 4 on."""
    k = np.minimum(np.asarray(viscosity_ratio, float), GREATEST_RATIO)
    k = np.where(k < LEAST_RATIO, np.nan, k)
    c = np.where(k < 0.4, 2.2649, 1.9987)
    e = np.select([k < 0.4, k < 1.0], [0.054381, 0.19087], 0.071739)
    return np.asarray(2.5671 - c * k**-e)


def life_modification_factor(
    viscosity_ratio: ArrayLike,
    contamination_factor: ArrayLike,
    fatigue_load_limit: ArrayLike,
    equivalent_load: ArrayLike,
) -> NDArray:
    """aISO of radial ball bearings; ISO 281:2007, formulas (31) to (33).

        aISO = 0.1 [1 - (2.5671 - c/kappa^e)^0.83 (eC Cu/P)^(1/3)]^-9.3
        c, e = 2.2649, 0.054381 (0.1 <= kappa < 0.4);  1.9987, 0.19087 (0.4 <= kappa < 1);  1.9987, 0.071739 (to 4)

    Args:
        viscosity_ratio: kappa; above 4 taken as 4, NaN below 0.1.
        contamination_factor: eC, 0 to 1.
        fatigue_load_limit: Cu [N].
        equivalent_load: P [N]; of thrust bearings 3 P, as the standard puts a third in their formula.

    Returns:
        At most 50, which is also the value where the bracket is no longer positive (a load below the fatigue limit).

    Examples:
        >>> print(f"{qs.readings.life_modification_factor(2.0, 0.5, 2e3, 10e3):.2f}")
        4.20
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = np.asarray(contamination_factor, float) * np.asarray(fatigue_load_limit, float)
        relative = relative / np.asarray(equivalent_load, float)
        bracket = 1.0 - lubrication_term(viscosity_ratio) ** 0.83 * np.cbrt(relative)
        factor = np.where(bracket > 0.0, 0.1 * np.abs(bracket) ** -9.3, LARGEST)
    return np.asarray(np.where(np.isnan(bracket), np.nan, np.minimum(factor, LARGEST)))
