"""What a designer reads off a finished solution: plain functions of it, one subject per file, SI units throughout.

Nothing here is evaluated unless it is called. Each reading says in its `warnings` where it was taken outside the range
that its source states; what was not asked for is None, and what has no number in some case is NaN there.
"""

from __future__ import annotations

from qsbearing.readings.asked import reading_columns, take_asked
from qsbearing.readings.ball_advance import BallAdvance, ball_advance
from qsbearing.readings.ball_motion import BallMotion, RacewayMotion, kinematics
from qsbearing.readings.ball_slip import BallSlip, RacewaySlip, ball_slip
from qsbearing.readings.cleanliness import Cleanliness, contamination_factor
from qsbearing.readings.contact_friction import Friction, RacewayFriction, friction
from qsbearing.readings.dynamic_rating import (
    Capacity,
    Rating,
    axial_load_rating,
    dynamic_load_rating,
    element_load_ratings,
)
from qsbearing.readings.equivalent_load import equivalent_load
from qsbearing.readings.film_thickness import Film, RacewayFilm, film
from qsbearing.readings.friction_estimate import (
    FrictionEstimate,
    FrictionEstimates,
    Series,
    friction_estimates,
    palmgren_torque,
    skf_torque,
)
from qsbearing.readings.friction_models import FrictionModel
from qsbearing.readings.life_factors import life_modification_factor, reliability_factor, viscosity_ratio
from qsbearing.readings.load_spectrum import SpectrumLife, spectrum_life
from qsbearing.readings.lubricant import Lubricant, OilState
from qsbearing.readings.pass_frequencies import Frequencies, FrequencySet, frequencies
from qsbearing.readings.pivot_points import PivotPoints, RacewayPivots, pivot_points
from qsbearing.readings.rating_life import Life, life
from qsbearing.readings.shoulder_overrun import Overrun, RacewayOverrun, overrun
from qsbearing.readings.static_rating import (
    FatigueLimit,
    StaticSafety,
    axial_static_load_rating,
    fatigue_load_limit,
    static_load_rating,
    static_safety,
)
from qsbearing.readings.subsurface_stress import RacewayStress, Stress, stress

# fmt: off
__all__ = [
    "BallAdvance", "BallMotion", "BallSlip", "Capacity", "Cleanliness", "FatigueLimit", "Film", "Frequencies",
    "FrequencySet", "Friction", "FrictionEstimate", "FrictionEstimates", "FrictionModel", "Life", "Lubricant",
    "OilState", "Overrun", "PivotPoints", "RacewayFilm", "RacewayFriction", "RacewayMotion", "RacewayOverrun",
    "RacewayPivots", "RacewaySlip", "RacewayStress", "Rating", "Series", "SpectrumLife", "StaticSafety", "Stress",
    "axial_load_rating", "axial_static_load_rating", "ball_advance", "ball_slip", "contamination_factor",
    "dynamic_load_rating", "element_load_ratings", "equivalent_load", "fatigue_load_limit", "film", "frequencies",
    "friction", "friction_estimates", "kinematics", "life", "life_modification_factor", "overrun", "palmgren_torque",
    "pivot_points", "reading_columns", "reliability_factor", "skf_torque", "spectrum_life", "static_load_rating",
    "static_safety", "stress", "take_asked", "viscosity_ratio",
]
# fmt: on
