"""Arrays compared in one row."""

from __future__ import annotations

from typing import Any

import numpy as np

from fem_check.rows.agreement import AgreementRow

TOLERANCE = 1e-9
"""Relative, of two evaluations at full precision."""
WHY = "two evaluations at full precision"


def compared(
    case: str, quantity: str, unit: str, computed: Any, expected: Any, source: str, tolerance: float = TOLERANCE
) -> AgreementRow:
    """An array in one row: the largest of the reference, and that off by the worst deviation."""
    computed, expected = np.asarray(computed, float), np.asarray(expected, float)
    size = float(np.abs(expected).max())
    worst = float(np.abs(computed - expected).max()) if computed.shape == expected.shape else np.nan
    return AgreementRow(case, quantity, unit, size, source, size + worst, None, 100.0 * tolerance, WHY)
