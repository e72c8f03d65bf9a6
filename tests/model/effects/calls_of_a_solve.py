"""Run with NUMBA_DISABLE_JIT=1: which functions of the package a solve enters, as JSON on stdout.

With compilation switched off the kernel is plain Python, so that the interpreter's profile hook sees every call.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import qsbearing as qs
from qsbearing.model.solution import flatten
from tests.qsbearing.scenes import (
    B218,
    BOTH,
    CENTRIFUGAL,
    INNER,
    MINIMUM_DISSIPATION,
    PER_BALL,
    lobes,
    resting,
    turning,
    unequal_balls,
)

PACKAGE = f"{Path(qs.__file__).parent}/"
FEW = replace(B218, ball_count=5)
"""Every call is watched, which is slow: five balls show as much as sixteen."""
LOADS = {"axial_load": 4e3, "radial_load_y": 600.0, "radial_load_z": 100.0, "moment_y": 1.0, "moment_z": -5.0}


def calls_of(scene: qs.Scene) -> dict[str, int]:
    """How often each function was entered in a solve, a stiffness and all that every scene can be asked for."""
    seen: Counter[CodeType] = Counter()
    solve = qs.solve  # imported before anything is counted
    flatten._stiffness_of_one.cache_clear()  # of the scene before

    def hook(frame: FrameType, event: str, argument: Any) -> None:
        if event == "call" and frame.f_code.co_filename.startswith(PACKAGE):
            seen[frame.f_code] += 1

    sys.setprofile(hook)
    try:
        solution = solve(scene)
        qs.stiffness(scene, solution)
        for contacts in (solution.inner, solution.outer):
            assert contacts.load.max() > 0.0
            assert contacts.max_pressure.max() > 0.0
            assert contacts.angle.max() > 0.0
    finally:
        sys.setprofile(None)
    found: Counter[str] = Counter()
    for code, times in seen.items():
        found[f"{Path(code.co_filename).stem}.{code.co_name}"] += times
    return dict(found)


def main() -> None:
    """One entry a scene."""
    scenes = {
        "static": resting(FEW, **LOADS),
        "static, actual angle": resting(FEW, hertz_angle="actual", **LOADS),
        "at zero speed": turning(0, FEW, **LOADS),
        "centrifugal": turning(6000, FEW, effects=CENTRIFUGAL, **LOADS),
        "gyroscopic": turning(6000, FEW, effects=(qs.GyroscopicMoment(),), **LOADS),
        "both": turning(6000, FEW, effects=BOTH, **LOADS),
        "both, actual angle": turning(6000, FEW, effects=BOTH, hertz_angle="actual", **LOADS),
        "inner control": turning(6000, FEW, effects=BOTH, control=INNER, **LOADS),
        "unequal balls": replace(turning(6000, FEW, effects=BOTH, **LOADS), ring_effects=(unequal_balls(FEW),)),
        "seats out of round": replace(turning(6000, FEW, effects=BOTH, **LOADS), ring_effects=(lobes(),)),
        "friction coefficient": turning(6000, FEW, effects=(qs.GyroscopicMoment(friction_coefficient=0.01),), **LOADS),
        "own orbits": replace(turning(6000, FEW, effects=BOTH, **LOADS), orbit_radius="displaced"),
        "minimum dissipation": turning(6000, FEW, effects=BOTH, control=MINIMUM_DISSIPATION, **LOADS),
        "by each ball": turning(2000, FEW, effects=BOTH, control=PER_BALL, **LOADS),
    }
    print(json.dumps({name: calls_of(scene) for name, scene in scenes.items()}))


if __name__ == "__main__":
    main()
