"""Power laws through measured points, with how sure their exponents are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.stats import t as student

CONFIDENCE = 0.95
"""Of the interval stated beside an exponent, from the scatter of the points about the line (Student's t)."""


def power_law(x: Sequence[float], y: Sequence[float]) -> dict[str, Any]:
    """Exponent p and factor c of y = c x^p by least squares of the logarithms, p with its 95 % interval.

    Two points give an exponent without an interval (None); fewer give nothing.
    """
    if len(x) < 2:
        return {"exponent": None, "uncertainty": None, "factor": None, "points": len(x)}
    log_x, log_y = np.log(np.asarray(x)), np.log(np.abs(np.asarray(y)))
    away = log_x - log_x.mean()
    exponent = float(away @ log_y / (away @ away))
    factor = float(np.exp(log_y.mean() - exponent * log_x.mean()))
    uncertainty = None
    freedom = len(log_x) - 2
    if freedom > 0:
        left = log_y - log_y.mean() - exponent * away
        deviation = float(np.sqrt(left @ left / freedom / (away @ away)))
        uncertainty = deviation * float(student.ppf(0.5 + 0.5 * CONFIDENCE, freedom))
    return {"exponent": exponent, "uncertainty": uncertainty, "factor": factor, "points": len(log_x)}
