"""Run with NUMBA_DISABLE_JIT=1: hard cases as plain Python with every floating-point trap set.

    python -m tests.hard_cases.watched NAME ...

A name is a hard case's, or SEED/CHUNK/INDEX of a campaign's scene, or `trap`, which walks into each of the traps.

Three traps. numpy raises on a division by zero, an overflow or an invalid operation wherever one of its numbers takes
part, and the fields of the kernel's records are such numbers. Python itself raises ZeroDivisionError, OverflowError
(powers, exp) and ValueError (roots and logarithms of negative numbers). What neither sees, a product or sum of plain
floats that overflows without a word, is caught by looking at every local variable of every kernel function at the
moment when it returns: none may be infinite or not a number.

Underflow is let pass: a product below 1e-308 becomes zero or loses digits beside numbers of order one, and both are
harmless where every quantity is in units of the bearing.
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import numpy as np

import qsbearing as qs
from tests.hard_cases.scenes import BY_NAME, scene_of

PACKAGE = Path(qs.__file__).parent
SENTINELS: frozenset[tuple[str, str]] = frozenset()
"""(function, variable) that hold infinity on purpose."""


def bad_numbers(value: Any) -> bool:
    """Whether a local variable is, or holds, an infinity or what is not a number."""
    if isinstance(value, float):
        return not math.isfinite(value)
    if isinstance(value, tuple):
        return any(bad_numbers(part) for part in value)
    return False


class Watch:
    """A profile hook that looks at what the kernel's functions leave behind."""

    def __init__(self) -> None:
        self.seen: set[str] = set()
        self.returns = 0
        self._ours: dict[CodeType, bool] = {}

    def __call__(self, frame: FrameType, event: str, argument: Any) -> None:
        if event != "return":
            return
        code = frame.f_code
        if code not in self._ours:
            self._ours[code] = Path(code.co_filename).parent in (PACKAGE, PACKAGE / "effects")
        if not self._ours[code]:
            return
        self.returns += 1
        for name, value in frame.f_locals.items():
            if bad_numbers(value) and (code.co_name, name) not in SENTINELS:
                self.seen.add(f"{Path(code.co_filename).stem}.{code.co_name}: {name} = {value}")
        if bad_numbers(argument) and (code.co_name, "return") not in SENTINELS:
            self.seen.add(f"{Path(code.co_filename).stem}.{code.co_name} returns {argument}")


def named_scene(name: str) -> qs.Scene:
    """A hard case, or a campaign's scene."""
    if name in BY_NAME:
        return scene_of(BY_NAME[name])
    from tests.campaign.envelope import chunk_groups
    from tests.campaign.sizes import GROUP

    seed, chunk, index = map(int, name.split("/"))
    return chunk_groups(seed, chunk, index + 1)[-1].part(index % GROUP).scene()


def trap() -> dict[str, Any]:
    """What the traps catch when something walks into them."""
    from qsbearing.contact import contact_load
    from qsbearing.linear import solve_in_place

    watch = Watch()
    raised = []
    with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
        sys.setprofile(watch)
        contact_load(1e200, 1e200)  # plain floats overflow without a word
        sys.setprofile(None)
        for walk in (
            lambda: contact_load(np.float64(1e200), 1e200),
            lambda: contact_load(1e300, np.float64("inf")) and np.float64(1.0) / np.float64(0.0),
            lambda: solve_in_place(np.full((2, 2), np.inf), np.ones(2), 2),
        ):
            try:
                walk()
            except ArithmeticError as error:
                raised.append(type(error).__name__)
    return {"raised": raised, "seen": sorted(watch.seen)}


def watched(name: str) -> dict[str, Any]:
    """How a case ends under the traps."""
    if name == "trap":
        return trap()
    scene = named_scene(name)
    watch = Watch()
    solve = qs.solve  # imported before it is watched
    with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
        sys.setprofile(watch)
        try:
            solution = solve(scene, threads=1)
        except (ArithmeticError, ValueError) as error:
            return {"raised": f"{type(error).__name__}: {error}", "seen": sorted(watch.seen)}
        finally:
            sys.setprofile(None)
    return {
        "status": str(solution.status),
        "displacement": solution.displacement.tolist(),
        "returns": watch.returns,
        "seen": sorted(watch.seen),
    }


def main(names: list[str]) -> None:
    """One entry a case, as JSON."""
    print(json.dumps({name: watched(name) for name in names}))


if __name__ == "__main__":
    main(sys.argv[1:])
