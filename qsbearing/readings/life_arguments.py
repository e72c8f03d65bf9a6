"""What may be asked of a rating life, checked before anything is solved."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from qsbearing.readings.ball_motion import ring_speeds
from qsbearing.readings.cleanliness import Cleanliness, contamination_factor
from qsbearing.readings.dynamic_rating import RATING_FACTOR, Capacity, Rating
from qsbearing.readings.entry import both_or_neither
from qsbearing.readings.life_factors import viscosity_ratio
from qsbearing.readings.lubricant import OilState
from qsbearing.readings.static_rating import FatigueLimit
from qsbearing.scene.bearing import BallBearing
from qsbearing.solution.solution import Solution
from qsbearing.validation import FORCE, RATIO, ErrorDetail, choose, within


def _reliability_errors(reliability: ArrayLike) -> list[ErrorDetail]:
    errors = within("reliability", reliability, RATIO, 0.9, 0.9995, "is outside the standard's table")
    for error in errors:
        if isinstance(error.value, float | int) and 90.0 <= error.value <= 99.95:
            cause = f"Given in per cent? {error.value:g} % is {error.value / 100.0:g}"
            return [replace(error, cause=cause)]
    return errors


@dataclass(frozen=True, kw_only=True)
class LifeArguments:
    """What `life` takes."""

    dynamic_load_rating: ArrayLike | None = None
    rating: Rating = Rating.LUNDBERG_PALMGREN
    rating_factor: float = RATING_FACTOR
    capacity: Capacity = Capacity.ISO_16281
    reliability: ArrayLike = 0.9
    viscosity_ratio: ArrayLike | None = None
    contamination_factor: ArrayLike | None = None
    fatigue_load_limit: ArrayLike | None = None
    fatigue_limit_by: FatigueLimit = FatigueLimit.HERTZ
    cleanliness: Cleanliness | None = None
    oil: OilState | None = None

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """Everything out of range, and what the modified life lacks."""
        errors = [] if self.cleanliness is None else choose("cleanliness", self.cleanliness, Cleanliness)[1]
        if self.cleanliness is not None and self.contamination_factor is not None:
            cause = "Keep one: the class gives the factor"
            errors.append(ErrorDetail("cleanliness", "is given beside contamination_factor", cause=cause))
        for name, choices in (("rating", Rating), ("capacity", Capacity), ("fatigue_limit_by", FatigueLimit)):
            errors += choose(name, getattr(self, name), choices)[1]
        errors += within("rating_factor", self.rating_factor, RATIO, 0.5, 2.0)
        errors += _reliability_errors(self.reliability)
        for name in ("dynamic_load_rating", "fatigue_load_limit"):
            if getattr(self, name) is not None:
                errors += within(name, getattr(self, name), FORCE, 1e-3, 1e9)
        ratio, contamination = self.viscosity_ratio, self.contamination_factor  # 1: stands for what then follows
        if self.is_modified:
            contamination = 1.0 if contamination is None else contamination
            ratio = 1.0 if ratio is None and self._viscosity is not None else ratio
        return errors + both_or_neither(
            {
                "viscosity_ratio": (ratio, RATIO, 0.0, 1e4),
                "contamination_factor": (contamination, RATIO, 0.0, 1.0),
            },
            "The modified life needs both; leave both out for the basic one",
        )

    @property
    def is_modified(self) -> bool:
        """Whether contamination is told, by its factor or class: kappa may then follow from the oil."""
        return self.cleanliness is not None or self.contamination_factor is not None

    @property
    def _viscosity(self) -> ArrayLike | None:
        return None if self.oil is None else self.oil.kinematic_viscosity

    def lubrication(self, solution: Solution) -> tuple[ArrayLike | None, ArrayLike | None]:
        """kappa and eC, given or found; None where they are not."""
        pitch = np.asarray(solution.scene.bearing.pitch_diameter, float)
        kappa, factor = self.viscosity_ratio, self.contamination_factor
        if kappa is None and self.is_modified and self._viscosity is not None:
            inner, outer = ring_speeds(solution)
            kappa = viscosity_ratio(self._viscosity, (inner - outer)[..., 0], pitch)
        if self.cleanliness is not None and kappa is not None:
            factor = contamination_factor(self.cleanliness, kappa, pitch)
        return kappa, factor
