"""Lanes: cases side by side, one number of each in each array, so that one instruction works on several.

A loop over lanes calls the scalar kernel's own functions, which are given, in place of records, tuples with fields of
the same names. What lanes do not know stands there as a constant, and costs nothing.
"""

from __future__ import annotations

from collections import namedtuple
from typing import Any

import numpy as np
from numpy import recarray

from qsbearing.model.compiler.compiled import inlined
from qsbearing.model.effects.gyroscopic_moment import NO_BOUND
from qsbearing.model.effects.raceway_control import OUTER
from qsbearing.model.kernel.case import record
from qsbearing.model.kernel.ring import inner_groove_centre
from qsbearing.model.kernel.workspace import Memory

LANES = 16
"""Fewer, and LLVM leaves the loops scalar: for shorter ones it checks no overlap of arrays."""

_OF_CASE = (
    "pitch_diameter", "inner_coefficient", "outer_coefficient", "sin_free", "cos_free", "interference", "tilt_lever",
    "inner_stiffness", "outer_stiffness", "series_stiffness", "inner_speed", "outer_speed",
)  # fmt: skip
_LINES = ("outer_sine", "outer_cosine", "outer_approach", "inner_sine", "inner_cosine", "inner_approach")
_OF_BALL = (
    *_LINES, "outer_inverse", "inner_inverse", "closure1", "closure2", "y1", "y2", "y11", "y12", "y21", "y22",
)  # fmt: skip


def _arrays(*names: str) -> list[tuple[Any, ...]]:
    return [(name, np.float64, (LANES,)) for name in names]


def _tuple_of(name: str, *fields: str) -> Any:
    return namedtuple(name, fields)


RING_LANES = record(
    *_arrays(*_OF_CASE),
    *((name, np.float64, (5, LANES)) for name in ("load", "displacement", "step", "imbalance", "right_side")),
    ("matrix", np.float64, (5, 5, LANES)),
    *_arrays("worst", "worst_own", "total", "inertial", "contact", "least"),  # of `assemble_balls`
    *_arrays("regularisation", "largest_approach", "farthest", "turn", "fraction", "before"),  # of Newton's method
    *_arrays("pivot"),  # of `solve_lanes`
    *_arrays("inner_spin", "outer_spin"),  # of equal balls, for minimum dissipation
    *_arrays("steps", "is_near", "is_open", "is_unusual"),  # 0 or 1, as packed loops like it
    *((name, np.int64, (LANES,)) for name in ("case", "iterations", "closings", "is_last", "is_closed")),
)
"""The rings, with all five channels, and where Newton's method stands; case: the number of a lane's case, or NONE."""

BALL_LANES = record(
    *((name, np.float64) for name in ("cosine", "sine", "weight")),
    *_arrays(*_OF_BALL, "inner_length", "follows_inertia", "turn", "own"),
    *_arrays("seen_sine", "seen_cosine", "seen_by_inner", "seen_by_outer", "seen_by_approach"),  # of `rolling_line`
    *_arrays("outer_step1", "outer_step2", "inner_step1", "inner_step2", "outer_longer", "inner_longer"),
    *_arrays("is_large", "is_placed"),
)
"""One ball of each case."""

_CHOICES = (
    "centrifugal", "gyroscopic", "shares", "form", "actual_angle", "displaced_orbit", "unequal_balls", "elastic_rings",
    "out_of_round", "common_motion", "common_orbit", "common_radial_rotation",
)  # fmt: skip
_Case = _tuple_of("_Case", *_OF_CASE, *_CHOICES)
_Work = _tuple_of("_Work", "speed_factor", "friction_bound", "regularisation")
_EQUAL = ("diameter", "control", "cosine", "sine", "inner_spin", "outer_spin", "inner_stiffness", "outer_stiffness")
_Ball = _tuple_of("_Ball", *_EQUAL, "deflection", "lobe", *_OF_BALL)


@inlined
def case_in(ring: recarray, lane: int, gyroscopic: bool = True, shares: int = 0) -> Any:
    """A lane's case; whether it has a gyroscopic moment matters to `evaluated` alone, which a constant tells, and so do
    the moment's shares."""
    return _Case(
        ring.pitch_diameter[lane], ring.inner_coefficient[lane], ring.outer_coefficient[lane], ring.sin_free[lane],
        ring.cos_free[lane], ring.interference[lane], ring.tilt_lever[lane], ring.inner_stiffness[lane],
        ring.outer_stiffness[lane], ring.series_stiffness[lane], ring.inner_speed[lane], ring.outer_speed[lane],
        True, gyroscopic, shares, 0, False, False, False, False, False, False, 0.0, 0.0,
    )  # fmt: skip


@inlined
def work_in(ring: recarray, lane: int) -> Any:
    """A lane's workspace."""
    return _Work(1.0, NO_BOUND, ring.regularisation[lane])


@inlined
def ball_in(
    ball: recarray, lane: int, cosine: float, sine: float, control: int = OUTER, inner_spin: float = 0.0,
    outer_spin: float = 0.0,
) -> Any:  # fmt: skip
    """A lane's ball, at this azimuth (which, read from the record in a loop over lanes, would forbid to pack it); its
    control and spin constants matter to `evaluated` alone."""
    return _Ball(
        1.0, control, cosine, sine, inner_spin, outer_spin, 0.0, 0.0, 0.0, 0.0,
        ball.outer_sine[lane], ball.outer_cosine[lane], ball.outer_approach[lane],
        ball.inner_sine[lane], ball.inner_cosine[lane], ball.inner_approach[lane],
        ball.outer_inverse[lane], ball.inner_inverse[lane], ball.closure1[lane], ball.closure2[lane],
        ball.y1[lane], ball.y2[lane], ball.y11[lane], ball.y12[lane], ball.y21[lane], ball.y22[lane],
    )  # fmt: skip


@inlined
def groove_centre_in(ring: recarray, lane: int, ball: Any) -> tuple[float, float]:
    """`inner_groove_centre` of a lane's ball."""
    d = ring.displacement
    where = d[0, lane], d[1, lane], d[2, lane], d[3, lane], d[4, lane]
    return inner_groove_centre(case_in(ring, lane), where, ball)


@inlined
def kept(value: float) -> float:
    """A value to be stored where another stands that it may equal.

    An addition that LLVM may not leave out: else it stores under a mask, which takes ten times as long.
    """
    return value + 0.0


lane_memory = Memory(RING_LANES, BALL_LANES)
"""(rings, balls), as `working_memory`."""
