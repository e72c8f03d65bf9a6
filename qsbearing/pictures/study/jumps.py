"""Jumps of results between neighbouring points along an axis, and their causes.

A raceway-control switch and the end of a branch are seen in the results themselves. Any other jump is a step of the
loaded contacts' angles that stands out from the steps before and after it by more than a curve with a bend does.
"""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from xarray import DataArray, Dataset

STANDS_OUT = 3.0
"""Times the larger of the two steps beside it."""
SMALLEST = 0.25
"""Degrees; a smaller step is not marked.

Both by measurement (`tests/verification/benchmarks/jump_calibration.py`): of 250 known jumps, switches of control, the
steps alone tell 177 by these, and 2 bends among 16,863 points are taken for jumps; by 8 and 0.5 degrees they told 81,
and 2.
"""
IMPOSSIBLE = 3
"""Status of a point that describes no bearing."""


class Cause(IntEnum):
    """Of a jump, or of what looks like one."""

    NONE = 0
    CONTROL_SWITCHES = 1
    """The raceway that controls some ball changes."""
    CONTACT_IS_LOST = 2
    """A ball leaves the inner raceway, or returns to it."""
    BRANCH_ENDS = 3
    """One of the two has no solution, although it is possible."""
    UNKNOWN = 4
    """Nothing in the results explains it."""


WORDS = {
    Cause.CONTROL_SWITCHES: "raceway control switches",
    Cause.CONTACT_IS_LOST: "a contact is lost",
    Cause.BRANCH_ENDS: "the solution branch ends",
    Cause.UNKNOWN: "jump without visible cause",
}


def jumps(results: Dataset, along: str) -> DataArray:
    """For each point but the last along an axis, the cause of a jump from it to the next; `Cause.NONE`: none.

    Args:
        results: of a sweep, with every ball's results where there are several; without `inner_angle` and `outer_angle`
            only ends of branches are found.
    """
    before, after = _pair(results["status"], along)
    ends = ((before == 0) != (after == 0)) & (before != IMPOSSIBLE) & (after != IMPOSSIBLE)
    cause = ends.astype(np.int8) * int(Cause.BRANCH_ENDS)
    both = (before == 0) & (after == 0)
    stands_out = both & False
    for name in ("inner_angle", "outer_angle"):
        if name in results:
            angle, load = results[name], results.get(name.replace("angle", "load"))
            angle = angle if load is None or load.dims != angle.dims else angle.where(load > 0.0)
            step = abs(angle.diff(along, label="lower"))
            far = (step > STANDS_OUT * _larger_neighbour(step, along)) & (step > SMALLEST)
            stands_out = stands_out | (far.any("ball") if "ball" in far.dims else far)
    cause = cause.where(~(both & stands_out), int(Cause.UNKNOWN))
    if "balls_off_inner" in results:
        one, other = _pair(results["balls_off_inner"], along)
        cause = cause.where(~(both & stands_out & (one != other)), int(Cause.CONTACT_IS_LOST))
    if "inner_raceway_controls" in results:
        one, other = _pair(results["inner_raceway_controls"], along)
        differs = (one != other) & np.isfinite(one) & np.isfinite(other)
        cause = cause.where(~(both & differs.any("ball")), int(Cause.CONTROL_SWITCHES))
    return cause.astype(np.int8).rename(f"jump_along_{along}")


def _pair(values: DataArray, along: str) -> tuple[DataArray, DataArray]:
    """Each point's value and its successor's, both at the point."""
    before = values.isel({along: slice(None, -1)})
    return before, values.isel({along: slice(1, None)}).assign_coords({along: before[along]})


def _larger_neighbour(step: DataArray, along: str) -> DataArray:
    """The larger of the steps before and after each step; infinite at both ends of the axis, where a step has one
    neighbour only and cannot be told from a bend."""
    axis = step.get_axis_num(along)
    values = np.moveaxis(step.values, axis, 0)
    padded: NDArray = np.concatenate([np.full_like(values[:1], np.inf), values, np.full_like(values[:1], np.inf)])
    return step.copy(data=np.moveaxis(np.fmax(padded[:-2], padded[2:]), 0, axis))
