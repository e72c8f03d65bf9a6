"""The ball set that the ball passing frequencies of a data sheet tell: how often, in one revolution of the inner ring,
a ball passes a point of the outer and of the inner ring.

Computed of 245 ball sets that catalogues print and rounded to three decimals, they tell count and diameter of all.
Kinematics of rolling balls: Harris & Kotzalas, Essential Concepts of Bearing Technology,
5th ed., chapter 10.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos

import numpy as np

from qsbearing.inference.ball_sets import sizes_of
from qsbearing.inference.data_sheet import DataSheet
from qsbearing.model.units import mm
from qsbearing.model.validation import ErrorDetail, SceneError
from qsbearing.remarks.kinds import NOTE, Kind
from qsbearing.remarks.remark import Warned, remark

WHOLE = 0.005
"""How far the sum of both may be from a whole number."""
NEAREST = 0.03
"""Part of a diameter within which a usual size is looked for: the pitch diameter is halfway within 1.5 %."""
SPIN_AGREEMENT = 0.005
"""Part by which a printed ball spin may differ."""
PITCH_AGREEMENT = 0.01
"""Likewise a given pitch diameter, where the ball diameter is given too."""

SHEET_SPIN_TWICE = Kind(
    "sheet_spin_twice", NOTE, "data_sheet",
    "ball_spin = {printed:g} is read as twice how often a ball turns about itself, {spin:.4g}",
)  # fmt: skip


def with_ball_set(sheet: DataSheet, remarks: list[Warned]) -> DataSheet:
    """The sheet with ball count, ball diameter and pitch diameter that its frequencies tell; itself without any.

    Args:
        remarks: gets what is to be said.

    Raises:
        SceneError: they are of no bearing, or not of this one.
    """
    outer, inner = sheet.outer_ball_pass, sheet.inner_ball_pass
    if outer is None or inner is None:
        return sheet
    count = round(outer + inner)
    if abs(outer + inner - count) > WHOLE:
        problem = f"makes {outer + inner:.6g} balls with inner_ball_pass, not a whole number"
        cause = "Per revolution of the inner ring, as printed: both add up to the ball count"
        raise SceneError([ErrorDetail("bearing.outer_ball_pass", problem, outer, cause=cause)])
    if outer >= inner:
        problem = "is not less than inner_ball_pass"
        cause = "The balls pass a point of the inner ring more often: are both exchanged?"
        raise SceneError([ErrorDetail("bearing.outer_ball_pass", problem, outer, cause=cause)])
    if sheet.ball_count not in (None, count):
        problem = f"does not agree with ball passes of {count} balls"
        raise SceneError([ErrorDetail("bearing.ball_count", problem, float(sheet.ball_count or 0))])
    ratio = 1.0 - 2.0 * outer / count
    _check_spin(sheet, ratio, remarks)
    along = cos(sheet.free_contact_angle or 0.0)
    diameter = sheet.ball_diameter or _usual_size(sheet, ratio * sheet.pitch / along)
    pitch = diameter * along / ratio
    if sheet.pitch_diameter is not None and abs(pitch / sheet.pitch_diameter - 1.0) > PITCH_AGREEMENT:
        problem = f"does not agree with balls of {diameter / mm:.6g} mm and the ball passes: {pitch / mm:.6g} mm"
        raise SceneError([ErrorDetail("bearing.pitch_diameter", problem, sheet.pitch_diameter)])
    pitch = pitch if sheet.pitch_diameter is None else sheet.pitch_diameter
    return replace(sheet, ball_count=count, ball_diameter=diameter, pitch_diameter=pitch)


def _usual_size(sheet: DataSheet, about: float) -> float:
    """The usual ball diameter [m] nearest to this one."""
    sizes = sizes_of(sheet)
    nearest = float(sizes[np.argmin(np.abs(sizes / about - 1.0))])
    if abs(nearest / about - 1.0) > NEAREST:
        problem = f"makes balls of {about / mm:.4g} mm with inner_ball_pass, which is no usual size"
        cause = f"The nearest is {nearest / mm:.6g} mm. Of this bearing, at its contact angle? Else give ball_diameter"
        raise SceneError([ErrorDetail("bearing.outer_ball_pass", problem, sheet.outer_ball_pass, cause=cause)])
    return nearest


def _check_spin(sheet: DataSheet, ratio: float, remarks: list[Warned]) -> None:
    """How often a ball turns about itself, or, as makers print as often, twice that."""
    if sheet.ball_spin is None:
        return
    spin = 0.5 * (1.0 - ratio**2) / ratio
    for times in (1, 2):
        if abs(sheet.ball_spin / (times * spin) - 1.0) <= SPIN_AGREEMENT:
            if times == 2:
                remarks.append(remark(SHEET_SPIN_TWICE, printed=sheet.ball_spin, spin=spin).said())
            return
    problem = f"does not agree with the ball passes, which make {spin:.4g}, or twice that"
    raise SceneError([ErrorDetail("bearing.ball_spin", problem, sheet.ball_spin)])
