"""Workers that do not come back are ended, and what they hung on is left out; all else is done."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection
from typing import Any

import pytest

from tests.campaign.sizes import GROUP
from tests.campaign.worker import Task, solve_chunks

HANGS_AT = (1, 4)
"""Group and scene of chunk 5 that never end."""


def run_chunk(
    seed: int,
    chunk: int,
    count: int,
    *,
    isolated: Collection[int] = (),
    hung: Collection[int] = (),
    beat: Callable[[int, int], None] = lambda group, scene: None,
) -> dict[str, Any]:
    """Stands in for the solver: quick everywhere, endless at one place."""
    group, scene = HANGS_AT
    for number in range(3):
        if number not in isolated:
            beat(number, -1)
            if (chunk, number) == (5, group):
                time.sleep(3600)
            continue
        for k in range(GROUP):
            if GROUP * number + k in hung:
                continue
            beat(number, k)
            if (chunk, number, k) == (5, group, scene):
                time.sleep(3600)
    return {"chunk": chunk, "hung": sorted(hung), "isolated": sorted(isolated), "seed": seed}


def fails(seed: int, chunk: int, count: int, **rest: Any) -> dict[str, Any]:
    """A fault of the campaign itself."""
    if chunk:
        raise KeyError("a slip")
    return {}


def test_a_scene_that_never_ends_is_left_out() -> None:
    """The group is tried scene by scene, then without the one that hangs; the other chunks never notice."""
    found = {done["chunk"]: done for done in solve_chunks([Task(4, 9), Task(5, 9), Task(6, 9)], 7, 2, 1.5, run_chunk)}
    assert sorted(found) == [4, 5, 6]
    assert found[5]["isolated"] == [HANGS_AT[0]]
    assert found[5]["hung"] == [GROUP * HANGS_AT[0] + HANGS_AT[1]]
    assert found[4]["hung"] == found[6]["hung"] == []
    assert all(done["memory_MB"] > 1.0 for done in found.values())


def test_a_fault_of_the_campaign_is_told() -> None:
    """Not a scene's failure: the traceback comes home."""
    with pytest.raises(RuntimeError, match="a slip"):
        list(solve_chunks([Task(3, 9)], 7, 1, 30.0, fails))


def test_nothing_to_do() -> None:
    assert list(solve_chunks([], 7, 2)) == []
