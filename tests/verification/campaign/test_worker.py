"""Workers that do not come back are ended, and the scene that they hang on is found; all else is done."""

from __future__ import annotations

import multiprocessing
import time
from typing import Any

import pytest

from tests.verification.campaign.worker import solve_ranges

HANGS_AT = 13


def solve(first: int, stop: int) -> tuple[int, int]:
    """Stands in for the solver: quick everywhere, endless at one scene."""
    if first <= HANGS_AT < stop:
        time.sleep(3600)
    return first, stop


def fails(first: int, stop: int) -> None:
    raise KeyError("a slip")


def test_a_scene_that_never_ends_is_found() -> None:
    """Its range is tried in halves; nothing else is lost, whatever shared a worker or a range with it."""
    found: dict[tuple[int, int], Any] = {}
    for part, answer in solve_ranges([(0, 8), (8, 16), (16, 24)], solve, workers=2, patience=4.0):
        found[part] = answer
        assert len(multiprocessing.active_children()) <= 2, "a worker that hangs is still there"
    assert found.pop((HANGS_AT, HANGS_AT + 1)) is None
    assert all(part == answer for part, answer in found.items())
    assert sorted(found) == [(0, 8), (8, 12), (12, 13), (14, 16), (16, 24)]


def test_a_fault_of_the_campaign_is_told() -> None:
    """Not a scene's failure: it comes home."""
    with pytest.raises(KeyError, match="a slip"):
        list(solve_ranges([(0, 8)], fails, workers=1, patience=60.0))


def test_nothing_to_do() -> None:
    assert list(solve_ranges([], solve, workers=2)) == []
