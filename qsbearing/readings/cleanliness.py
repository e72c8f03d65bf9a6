"""Contamination factor eC of ISO 281:2007, annex A: how far solid particles in the lubricant shorten life.

Read from GOST 18855-2013, its translation, where some exponents are damaged; its constants for grease agree with a
published implementation (github.com/frasere/ISO-281), and all classes share the exponents 0.68 and 0.55.
"""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.units import mm


class _Constants(NamedTuple):
    """eC = a (1 - loss/dm^(1/3)), a = min(gain kappa^0.68 dm^0.55, 1), dm in mm."""

    loss: float
    gain: float


class Cleanliness(StrEnum):
    """How clean the lubricant is: in-line filter by its rating, oil bath or off-line filter by ISO 4406, or grease."""

    FILTER_6 = "filter_6"
    """Circulating oil, beta6(c) = 200; ISO 4406 -/13/10."""
    FILTER_12 = "filter_12"
    """Circulating oil, beta12(c) = 200; -/15/12."""
    FILTER_25 = "filter_25"
    """Circulating oil, beta25(c) >= 75; -/17/14."""
    FILTER_40 = "filter_40"
    """Circulating oil, beta40(c) >= 75; -/19/16."""
    OIL_13_10 = "oil_13_10"
    """Oil bath or off-line filter; ISO 4406 -/13/10."""
    OIL_15_12 = "oil_15_12"
    """Likewise, -/15/12."""
    OIL_17_14 = "oil_17_14"
    """Likewise, -/17/14."""
    OIL_19_16 = "oil_19_16"
    """Likewise, -/19/16."""
    OIL_21_18 = "oil_21_18"
    """Likewise, -/21/18."""
    GREASE_HIGH = "grease_high"
    """Grease, high cleanliness."""
    GREASE_NORMAL = "grease_normal"
    """Grease, normal cleanliness."""
    GREASE_SLIGHT = "grease_slight"
    """Grease, slight to typical contamination."""
    GREASE_SEVERE = "grease_severe"
    """Grease, severe contamination."""
    GREASE_VERY_SEVERE = "grease_very_severe"
    """Grease, very severe contamination."""


_CONSTANTS = {
    Cleanliness.FILTER_6: _Constants(0.5663, 0.0864),
    Cleanliness.FILTER_12: _Constants(0.9987, 0.0432),
    Cleanliness.FILTER_25: _Constants(1.6329, 0.0288),
    Cleanliness.FILTER_40: _Constants(2.3362, 0.0216),
    Cleanliness.OIL_13_10: _Constants(0.6796, 0.0864),
    Cleanliness.OIL_15_12: _Constants(1.141, 0.0288),
    Cleanliness.OIL_17_14: _Constants(1.67, 0.0133),
    Cleanliness.OIL_19_16: _Constants(2.5164, 0.00864),
    Cleanliness.OIL_21_18: _Constants(3.8974, 0.00411),
    Cleanliness.GREASE_HIGH: _Constants(0.6796, 0.0864),
    Cleanliness.GREASE_NORMAL: _Constants(1.141, 0.0432),
    Cleanliness.GREASE_SLIGHT: _Constants(1.887, 0.0177),
    Cleanliness.GREASE_SEVERE: _Constants(2.662, 0.0115),
    Cleanliness.GREASE_VERY_SEVERE: _Constants(4.06, 0.00617),
}
LARGE_SLIGHT = 1.677
"""The loss of slightly contaminated grease from dm = 500 mm on."""


def contamination_factor(cleanliness: Cleanliness, viscosity_ratio: ArrayLike, pitch_diameter: ArrayLike) -> NDArray:
    """eC of a class of cleanliness; never below zero, which small bearings in dirty grease would come to.

    Args:
        viscosity_ratio: kappa.
        pitch_diameter: dm [m].

    Returns:
        eC, between 0 and 1.

    Examples:
        >>> cleanliness = qs.readings.Cleanliness.FILTER_12
        >>> print(f"{qs.readings.contamination_factor(cleanliness, 2.0, 70 * qs.mm):.2f}")
        0.54
    """
    dm = np.asarray(pitch_diameter, float) / mm
    constants = _CONSTANTS[Cleanliness(cleanliness)]
    loss: ArrayLike = constants.loss
    if cleanliness == Cleanliness.GREASE_SLIGHT:
        loss = np.where(dm < 500.0, constants.loss, LARGE_SLIGHT)
    a = np.minimum(constants.gain * np.asarray(viscosity_ratio, float) ** 0.68 * dm**0.55, 1.0)
    return np.asarray(np.maximum(a * (1.0 - np.asarray(loss) / np.cbrt(dm)), 0.0))
