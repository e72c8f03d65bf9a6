"""Systems solved in lanes: the digits of the scalar kernel, whatever stands in the other lanes."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from qsbearing.model.kernel.lane_linear import leave_out_others, solve_lanes
from qsbearing.model.kernel.lane_state import LANES, lane_memory
from qsbearing.model.kernel.linear import solve_in_place
from qsbearing.model.kernel.workspace import working_memory


def solved_in_lanes(matrix: NDArray, right_side: NDArray, channels: list[int]) -> tuple[NDArray, NDArray]:
    """(solution of these channels, least size of a pivot), each with a lane as its last axis."""
    (ring, _), (work, _) = lane_memory(1), working_memory(1)
    ring["matrix"][0], ring["right_side"][0] = matrix, right_side
    work["channel_count"], work["channel"][0, : len(channels)] = len(channels), channels
    leave_out_others(ring.view(np.recarray)[0], work.view(np.recarray)[0])
    solve_lanes(ring.view(np.recarray)[0])
    return ring["right_side"][0, channels].copy(), ring["pivot"][0].copy()


@pytest.mark.parametrize("channels", [[0], [0, 1], [0, 1, 4], [0, 3, 4], [1, 2, 3, 4], [0, 1, 2, 3, 4]])
def test_digits_are_those_of_one_system_alone(channels: list[int]) -> None:
    """With rows that change places, and with the larger of two equal ones first."""
    rng = np.random.default_rng(0)
    matrix, right_side = rng.normal(size=(5, 5, LANES)), rng.normal(size=(5, LANES))
    matrix[channels[-1], channels[0], ::3] = -matrix[channels[0], channels[0], ::3]
    matrix[channels[-1], channels[0], 1::3] *= 100.0
    found, least = solved_in_lanes(matrix, right_side, channels)
    assert (least > 0.0).all()
    for lane in range(LANES):
        alone, expected = matrix[np.ix_(channels, channels)][..., lane].copy(), right_side[channels, lane].copy()
        assert solve_in_place(alone, expected, len(channels))
        assert np.array_equal(found[:, lane], expected)


def test_a_pivot_that_vanishes_is_seen_and_spoils_its_own_lane_alone() -> None:
    rng = np.random.default_rng(1)
    matrix, right_side = rng.normal(size=(5, 5, LANES)), rng.normal(size=(5, LANES))
    whole, _ = solved_in_lanes(matrix, right_side, [0, 1, 4])
    matrix[:, 1, 5] = 0.0
    with np.errstate(all="ignore"):
        found, least = solved_in_lanes(matrix, right_side, [0, 1, 4])
    assert [lane for lane in range(LANES) if not least[lane] > 0.0] == [5]
    assert np.array_equal(np.delete(found, 5, axis=1), np.delete(whole, 5, axis=1))
