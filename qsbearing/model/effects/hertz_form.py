"""How the shape of Hertz's ellipse is found from the curvatures: exactly, or by a published fit.

Source        `qsbearing.model.contact.hertz`; Brewe & Hamrock 1977, Hamrock & Brewe 1983
Equation      k, K and E from the ratio of the curvatures
Assumes       nothing more than Hertz; the fits are for comparison with published calculations
When not      the fits save no time worth having
Parameters    none
Indicator     the largest relative error of Q/delta^1.5 of both raceways at the free contact angle, by the fit of 1977
Example       Scene(bearing, operation, hertz_form=HertzForm.HAMROCK_BREWE_1983)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.contact.hertz import FORM_CODES, INNER_SIDE, OUTER_SIDE, HertzForm, stiffness_at_angle
from qsbearing.model.effects.entry import Entry, Errors, choice
from qsbearing.model.effects.operating_point import OperatingPoint

_FITS = (HertzForm.BREWE_HAMROCK_1977, HertzForm.HAMROCK_BREWE_1983)


def _indicator(point: OperatingPoint) -> NDArray:
    bearing = point.bearing
    form = point.scene.hertz_form if point.scene.hertz_form in _FITS else _FITS[0]
    lengths = (bearing.pitch_diameter, bearing.inner_groove_radius, bearing.outer_groove_radius)
    sizes = np.broadcast_arrays(*(np.asarray(one / np.asarray(bearing.ball_diameter, float)) for one in lengths))
    largest = []
    for pitch, *grooves in zip(*(each.ravel() for each in sizes), strict=True):
        errors = [_error(form, pitch, f, side) for f, side in zip(grooves, (INNER_SIDE, OUTER_SIDE), strict=True)]
        largest.append(max(errors))
    return np.broadcast_to(np.reshape(largest, sizes[0].shape), point.solution.shape)


def _error(form: HertzForm, pitch: float, groove: float, side: float) -> float:
    """At the free angle, or any: the curvature in the rolling direction hardly changes the error of a fit."""
    fit, exact = (
        stiffness_at_angle(FORM_CODES[one], 1.0, pitch, groove, 1.0, 0.0, 1.0, side)[0]
        for one in (form, HertzForm.EXACT)
    )
    return abs(float(fit / exact) - 1.0)


def _errors(point: OperatingPoint) -> Errors:
    """Pressure goes with the root of the stiffness error, approach with its two thirds, which partly make up for it."""
    x = _indicator(point)
    return {
        "contact_angle": 0.02 * x,
        "load": 0.02 * x,
        "pressure": 0.5 * x,
        "displacement": 0.5 * x,
        "stiffness": 0.5 * x,
    }


ENTRY = Entry(
    "hertz_form",
    "the exact ellipse of Hertz (a published fit instead)",
    choice("hertz_form", _FITS[0], HertzForm.EXACT),
    indicator=_indicator,
    errors=_errors,
    saves_time=False,
)
