"""Every error of a bearing: single fields first, then what the fields say together.

Also the shapes of array fields, which must broadcast to common case axes.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations
from math import pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.material import Material, material_errors
from qsbearing.model.units import mm
from qsbearing.model.validation import (
    ANGLE,
    COUNT,
    LENGTH,
    ErrorDetail,
    Field,
    Sentence,
    first,
    numeric,
    unit_mistake,
    within,
)

# Wide enough for a watch and a slewing ring; narrow enough to catch a length in the wrong unit.
BALL_COUNT_RANGE = (1, 1000)
LENGTH_RANGES = {
    "ball_diameter": (5e-5, 1.0),
    "pitch_diameter": (1e-4, 20.0),
    "inner_groove_radius": (2.5e-5, 1.0),
    "outer_groove_radius": (2.5e-5, 1.0),
}
GROOVE_COEFFICIENT_MAX = 1.0
LARGEST_USUAL_F = 0.6
FREE_ANGLE_MAX = 85.0 * pi / 180.0
FREE_ANGLES = (0.0, FREE_ANGLE_MAX)


LARGEST_INTERFERENCE = 0.02
"""Of a negative clearance over the ball diameter: contacts of steel would then carry some 7 GPa."""


def clearance_errors(
    diametral_clearance: ArrayLike, groove_centre_distance: NDArray, ball: NDArray
) -> list[ErrorDetail]:
    """Errors of a clearance: below zero it wedges the balls, above it must leave a possible free contact angle."""
    field = "bearing.diametral_clearance"
    clearance, errors = numeric(field, diametral_clearance, LENGTH)
    if clearance is None:
        return errors
    least = -LARGEST_INTERFERENCE * ball
    most = 4.0 * groove_centre_distance * np.sin(0.5 * FREE_ANGLE_MAX) ** 2
    bad = (groove_centre_distance > 0.0) & ((clearance < least) | (clearance > most))
    if not bad.any():
        return []
    wrong, low, high = first(bad, clearance, least, most)
    problem, detail = "is larger than these grooves allow", ""
    if wrong < 0.0:
        problem = (
            f"is so far below zero that it wedges the balls by more than {LARGEST_INTERFERENCE:.0%} of their diameter"
        )
    else:
        detail = f"the free contact angle would pass {np.degrees(FREE_ANGLE_MAX):.0f} degrees"
    advice = unit_mistake(wrong, LENGTH, low, high)
    return [ErrorDetail(field, problem, wrong, LENGTH, (low, high), advice, bad, detail)]


def bearing_errors(bearing: Any) -> list[ErrorDetail]:
    """Every error of a `BallBearing`: single fields first, then what the fields say together."""
    clashes = clash_errors(shapes_of([("bearing", bearing)]))
    if clashes:
        return clashes
    errors = within("bearing.ball_count", bearing.ball_count, COUNT, *BALL_COUNT_RANGE)
    count = np.ones(()) if errors else np.asarray(bearing.ball_count, float)
    broken = count != np.rint(count)
    if broken.any():
        (number,) = first(broken, count)
        problem = "is not a whole number"
        errors.append(ErrorDetail("bearing.ball_count", problem, number, COUNT, BALL_COUNT_RANGE, where=broken))
    lengths: dict[str, NDArray] = {}  # those that are good by themselves
    for name, (low, high) in LENGTH_RANGES.items():
        wrong = within(f"bearing.{name}", getattr(bearing, name), LENGTH, low, high)
        errors += wrong
        if not wrong:
            lengths[name] = np.asarray(getattr(bearing, name), float)
    angle = bearing.free_contact_angle
    errors += within("bearing.free_contact_angle", angle, ANGLE, *FREE_ANGLES, "is outside its range")
    errors += material_errors("bearing.ball_material", bearing.ball_material)
    errors += material_errors("bearing.ring_material", bearing.ring_material)
    errors += _interference_errors(bearing, errors)
    diameter = lengths.pop("ball_diameter", None)
    if diameter is not None:
        for name, length in lengths.items():
            if name == "pitch_diameter":
                errors += _pitch_errors(length, diameter, count)
            else:
                errors += _groove_errors(f"bearing.{name}", length, diameter)
    return errors


def _interference_errors(bearing: Any, errors: list[ErrorDetail]) -> list[ErrorDetail]:
    field = "bearing.radial_interference"
    wrong = within(field, bearing.radial_interference, LENGTH, 0.0, 1e-2)
    if wrong or errors:
        return wrong
    interference, angle = np.broadcast_arrays(
        np.asarray(bearing.radial_interference, float), np.asarray(bearing.free_contact_angle, float)
    )
    bad = (interference > 0.0) & (angle > 0.0)
    if not bad.any():
        return []
    problem = "is given together with a free contact angle, but wedged balls have none"
    cause = Sentence("Let {angle} be 0 where there is an interference", angle=Field("free_contact_angle"))
    return [ErrorDetail(field, problem, first(bad, interference)[0], LENGTH, cause=cause, where=bad)]


def _groove_errors(field: str, radius: NDArray, diameter: NDArray) -> list[ErrorDetail]:
    coefficient = radius / diameter
    bad = (coefficient <= 0.5) | (coefficient > GROOVE_COEFFICIENT_MAX)
    if not bad.any():
        return []
    f, r, d = first(bad, coefficient, radius, diameter)
    as_f = next((number for number in (r / mm, r) if 0.5 < number <= LARGEST_USUAL_F), 0.0)
    given_as_f = f"Given as f = r/D? f D = {as_f:.6g} x {d / mm:.6g} mm = {as_f * d / mm:.6g} mm"
    if f <= 0.5:
        problem, detail = "the groove is smaller than the ball", f"f = r/D = {f:.4g} must be above 0.5"
        cause = "A groove tighter than its ball touches at two edges, not at a point; 0.515 to 0.54 is usual"
        if 0.5 < 1e3 * f <= GROOVE_COEFFICIENT_MAX:
            cause = "Given in another unit than the ball diameter?"
        elif 0.5 < 2.0 * f < 0.6:
            cause = "Was the ball's radius given as its diameter, or the reverse?"
        elif as_f:
            cause = given_as_f
    else:
        problem, detail = "the groove is far larger than the ball", f"f = r/D = {f:.4g} must be at most 1"
        cause = "Was the groove's diameter given, not its radius? 0.515 to 0.54 is usual for f"
        if not 0.5 < f / 2.0 <= 0.6:
            cause = given_as_f if as_f else "Given in another unit than the ball diameter?"
    return [ErrorDetail(field, problem, r, LENGTH, (0.5 * d, GROOVE_COEFFICIENT_MAX * d), cause, bad, detail)]


def _pitch_errors(pitch: NDArray, diameter: NDArray, count: NDArray) -> list[ErrorDetail]:
    # Neighbours' centres stand 2 (dm/2) sin(pi/Z) apart; one ball needs only to miss the axis.
    room = np.where(count >= 2, diameter / np.sin(pi / np.maximum(count, 2)), diameter)
    tight = pitch <= room
    if not tight.any():
        return []
    dm, d, least, balls = first(tight, pitch, diameter, room, count)
    problem, detail = "is not larger than the ball", ""
    cause = "Use fewer or smaller balls, or a larger pitch circle"
    if balls >= 2:
        problem = "the balls do not fit on the pitch circle"
        detail = f"{balls:.0f} balls need a circle of more than {least / d:.4g} ball diameters"
    if least < 1e3 * dm < 50.0 * least:
        cause = "Given in another unit than the ball diameter?"
    return [ErrorDetail("bearing.pitch_diameter", problem, dm, LENGTH, (least, 20.0), cause, tight, detail)]


Shapes = dict[str, tuple[int, ...]]


def shapes_of(named: Iterable[tuple[str, Any]]) -> Shapes:
    """The shapes of the array fields of these objects, materials within them included, by path."""
    shapes: Shapes = {}
    for path, holder in named:
        for name, value in getattr(holder, "__dict__", {}).items():
            if value is None or isinstance(value, float | int | str | tuple):
                continue  # at once, for most values are plain numbers
            if isinstance(value, Material):
                shapes |= shapes_of([(f"{path}.{name}", value)])
            elif shape := _shape(value):
                # the last axis of deviations is the balls'
                shapes[f"{path}.{name}"] = shape[:-1] if name in getattr(holder, "of_each_ball", ()) else shape
    return shapes


def _shape(value: Any) -> tuple[int, ...]:
    """None of rows of unlike lengths, which are refused as no numbers."""
    try:
        return np.shape(value)
    except ValueError:
        return ()


def clash_errors(shapes: Shapes) -> list[ErrorDetail]:
    """The error that names the fields whose shapes do not broadcast; empty where all do."""
    clashing: Shapes = {}
    for (one, its), (other, others) in combinations(shapes.items(), 2):
        try:
            np.broadcast_shapes(its, others)
        except ValueError:
            clashing |= {one: its, other: others}
    if not clashing:
        return []
    first = next(iter(clashing))
    named = ", ".join(f"{path} {shape}" for path, shape in clashing.items())
    cause = f"To combine each with each, give one of them an axis of its own: {first.rpartition('.')[2]}[:, None]"
    return [ErrorDetail(first, f"arrays do not broadcast to common case axes: {named}", cause=cause)]
