"""What may be asked of a rating life, checked before anything is solved."""

from __future__ import annotations

from dataclasses import replace

from numpy.typing import ArrayLike

from qsbearing.readings.dynamic_rating import RATING_FACTOR, Capacity, Rating
from qsbearing.readings.static_rating import FatigueLimit
from qsbearing.validation import FORCE, RATIO, ErrorDetail, choose, within


def _reliability_errors(reliability: ArrayLike) -> list[ErrorDetail]:
    errors = within("reliability", reliability, RATIO, 0.9, 0.9995, "is outside the standard's table")
    for error in errors:
        if isinstance(error.value, float | int) and 90.0 <= error.value <= 99.95:
            cause = f"Given in per cent? {error.value:g} % is {error.value / 100.0:g}"
            return [replace(error, cause=cause)]
    return errors


def life_errors(
    *,
    dynamic_load_rating: ArrayLike | None = None,
    rating: Rating = Rating.LUNDBERG_PALMGREN,
    rating_factor: float = RATING_FACTOR,
    capacity: Capacity = Capacity.ISO_16281,
    reliability: ArrayLike = 0.9,
    viscosity_ratio: ArrayLike | None = None,
    contamination_factor: ArrayLike | None = None,
    fatigue_load_limit: ArrayLike | None = None,
    fatigue_limit_by: FatigueLimit = FatigueLimit.HERTZ,
) -> list[ErrorDetail]:
    """Every error of the arguments of `life`."""
    errors = choose("rating", rating, Rating)[1] + choose("capacity", capacity, Capacity)[1]
    errors += choose("fatigue_limit_by", fatigue_limit_by, FatigueLimit)[1]
    errors += within("rating_factor", rating_factor, RATIO, 0.5, 2.0)
    errors += _reliability_errors(reliability)
    for name, value in (("dynamic_load_rating", dynamic_load_rating), ("fatigue_load_limit", fatigue_load_limit)):
        if value is not None:
            errors += within(name, value, FORCE, 1e-3, 1e9)
    both = {"viscosity_ratio": viscosity_ratio, "contamination_factor": contamination_factor}
    for name, value in both.items():
        if value is not None:
            errors += within(name, value, RATIO, 0.0, 1.0 if name == "contamination_factor" else 1e4)
        elif any(other is not None for other in both.values()):
            cause = "The modified life needs both; leave both out for the basic one"
            errors.append(ErrorDetail(name, "missing", cause=cause))
    return errors
