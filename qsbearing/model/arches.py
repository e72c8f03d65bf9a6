"""Arched grooves: what a shim g between the centres of a groove's two arcs makes of a bearing, and what is wrong with
it.

Source        plane geometry of two circles of the groove's radius, derived here
Equation      resting angle sin(gamma) = g/(2 L), L = r - D/2; axial clearance Pa = 2 BD sin(alpha0) - gi - go;
              diametral clearance Pd = 2 (Li cos(gamma_i) + Lo cos(gamma_o) - BD cos(alpha0)), gamma = 0 for one arc
Limits        gamma -> alpha0 in both rings: Pa, Pd -> 0 and Pd/Pa -> tan(alpha0)
Assumes       both arcs of a ring have its groove radius; alpha0 is that of a ball on one arc of each ring, diagonally
When not      a ring has two arcs that its balls' ellipses pass the apex between: there they would count twice
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.units import deg
from qsbearing.model.validation import LENGTH, ErrorDetail, first, numeric, within

SHIMS = (1e-7, 0.5)
"""What a shim may be [m], whatever the ball."""
LARGEST_RESTING_ANGLE = 85.0 * deg
LARGEST_INTERFERENCE = 0.02
"""Of a negative clearance over the ball diameter, as of one arc."""
SIDES = "inner", "outer"


def resting_sine(
    axial_clearance: ArrayLike, groove_centre_distance: NDArray, free_angle: NDArray, ball: NDArray
) -> tuple[list[ErrorDetail], NDArray]:
    """sin(gamma) of two rings whose arcs have one resting angle, by the axial clearance Pa [m]; and its errors."""
    field = "bearing.axial_clearance"
    clearance, errors = numeric(field, axial_clearance, LENGTH)
    if clearance is None:
        return errors, np.asarray(np.nan)
    with np.errstate(divide="ignore", invalid="ignore"):
        sine = np.asarray(np.sin(free_angle) - np.asarray(clearance, float) / (2.0 * groove_centre_distance))
    most = 2.0 * groove_centre_distance * np.sin(free_angle)
    least = np.maximum(-LARGEST_INTERFERENCE * ball, most - 2.0 * groove_centre_distance)
    bad = (groove_centre_distance > 0.0) & ~((clearance > least) & (clearance < most))
    if not bad.any():
        return [], sine
    wrong, low, high = first(bad, clearance, least, most)
    problem = "leaves no room for a shim" if wrong >= high else "is so far below zero that it wedges the balls"
    cause = "A bearing with one arc in each ring is angular_contact or deep_groove" if wrong >= high else ""
    return [ErrorDetail(field, problem, wrong, LENGTH, (low, high), cause, bad)], sine


def shims_given_errors(fields: dict[str, Any]) -> list[ErrorDetail]:
    """Of shims that stand beside the axial clearance from which they follow."""
    return [
        ErrorDetail(f"bearing.{name}", "is given together with axial_clearance", fields[name], LENGTH, cause="Keep one")
        for name in ("inner_shim", "outer_shim")
        if fields.get(name) is not None
    ]


def axial_clearance_given_errors(axial_clearance: Any) -> list[ErrorDetail]:
    """Of an axial clearance of a bearing with one arc in each ring."""
    problem, cause = "is given, but no groove has two arcs", 'Leave it out, or give kind = "four_point"'
    return [ErrorDetail("bearing.axial_clearance", problem, axial_clearance, LENGTH, cause=cause)]


def clearance_given_errors(kind: Any, diametral_clearance: Any) -> list[ErrorDetail]:
    """Of a diametral clearance in place of the free contact angle of a four-point bearing."""
    if kind != "four_point":
        return []
    problem = "is given of a four-point bearing, whose free contact angle does not follow from it"
    cause = "Give the free contact angle, and the shims or the axial clearance"
    return [ErrorDetail("bearing.diametral_clearance", problem, diametral_clearance, LENGTH, cause=cause)]


def wedging(bearing: Any) -> NDArray:
    """Pd of arched rings [m]."""
    room = -bearing.groove_centre_distance * np.cos(np.asarray(bearing.free_contact_angle, float))
    for side in SIDES:
        angle = bearing.resting_angle(side)
        room = room + bearing.arc_length(side) * (1.0 if angle is None else np.cos(angle))
    return np.asarray(2.0 * room)


def arch_errors(bearing: Any, is_good: bool) -> list[ErrorDetail]:
    """Every error of the shims of a bearing.

    Args:
        is_good: whether its other fields are, so that shims can be judged by them.
    """
    given = {f"{side}_shim": getattr(bearing, f"{side}_shim") for side in SIDES}
    given = {name: value for name, value in given.items() if value is not None}
    if bearing.kind != "four_point":
        problem, cause = "is given, but no groove has two arcs", 'Leave it out, or give kind = "four_point"'
        return [ErrorDetail(f"bearing.{name}", problem, given[name], LENGTH, cause=cause) for name in given]
    errors = [each for name in given for each in within(f"bearing.{name}", given[name], LENGTH, *SHIMS)]
    if not given:
        detail = "a four-point bearing has two arcs in the groove of one ring or of both"
        cause = "Give inner_shim or outer_shim, the distance of their centres, or the axial clearance"
        errors.append(ErrorDetail("bearing.inner_shim", "missing", cause=cause, detail=detail))
    if is_good and np.any(np.asarray(bearing.radial_interference) != 0.0):
        problem = "is given of a four-point bearing, whose clearance follows from its shims"
        cause = "Leave it out: shims that leave a negative axial clearance press the balls"
        errors.append(
            ErrorDetail("bearing.radial_interference", problem, bearing.radial_interference, LENGTH, cause=cause)
        )
    if errors or not is_good:
        return errors
    for name in given:
        errors += _resting_errors(bearing, name)
    return errors or _wedge_errors(bearing, next(iter(given)))


def _resting_errors(bearing: Any, name: str) -> list[ErrorDetail]:
    """Of a shim that leaves no place, or hardly one, where a ball rests on both arcs."""
    shim, most = np.broadcast_arrays(
        np.asarray(getattr(bearing, name), float),
        2.0 * bearing.arc_length(name.split("_")[0]) * np.sin(LARGEST_RESTING_ANGLE),
    )
    bad = ~(shim <= most)
    if not bad.any():
        return []
    wrong, high = first(bad, shim, most)
    detail = "the ball would rest on both arcs at more than 85 degrees, or pass between them"
    cause = "Was the width between the ring's halves given? A shim is the distance of the arcs' centres, "
    cause += "g = 2 (r - D/2) sin(resting angle)"
    problem = "is too large for this groove"
    return [ErrorDetail(f"bearing.{name}", problem, wrong, LENGTH, (SHIMS[0], high), cause, bad, detail)]


def _wedge_errors(bearing: Any, name: str) -> list[ErrorDetail]:
    """Of shims that wedge the balls: more than any interference, or while the axial clearance has them loose."""
    diametral, axial, ball = np.broadcast_arrays(
        wedging(bearing), bearing.axial_clearance, np.asarray(bearing.ball_diameter, float)
    )
    rounding = 1e-9 * ball
    bad = (diametral < -LARGEST_INTERFERENCE * ball) | ((diametral < -rounding) & (axial > rounding))
    if not bad.any():
        return []
    low, along, shim = first(bad, diametral, axial, np.asarray(getattr(bearing, name), float))
    detail = f"axial clearance {1e6 * along:.4g} um, but diametral clearance {1e6 * low:.4g} um"
    cause = "A ring whose balls rest on both arcs at more than the free contact angle holds them before the other "
    cause += "does: make this shim smaller, or share it between both rings"
    return [ErrorDetail(f"bearing.{name}", "wedges the balls", shim, LENGTH, cause=cause, where=bad, detail=detail)]
