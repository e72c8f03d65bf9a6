"""Run with NUMBA_DISABLE_JIT=1: hard cases as plain Python with every floating-point trap set.

    python -m tests.verification.hard_cases.watched NAME ...

A name is a hard case's, or `random SEED`, or `trap`, which walks into each of the traps.

Three traps. numpy raises on a division by zero, an overflow or an invalid operation wherever one of its numbers takes
part, and the fields of the kernel's records are such numbers: `CompiledEntry.plain` replaces them, this leaves them.
Python itself raises ZeroDivisionError, OverflowError (powers, exp) and ValueError (roots and logarithms of negative
numbers). What neither sees, a product or sum of plain floats that overflows without a word, is caught by looking at
every local variable of every kernel function at the moment when it returns: none may be infinite or not a number.

Underflow is let pass: a product below 1e-308 becomes zero or loses digits beside numbers of order one, and both are
harmless where every quantity is in units of the bearing.
"""

from __future__ import annotations

import json
import math
import sys
from dataclasses import replace
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.model.compiler.compiled import CompiledEntry
from tests.qsbearing.scenes import B218, INNER, OUTER, PER_BALL, turning
from tests.verification.hard_cases.scenes import BY_NAME, scene_of


def bad_numbers(value: Any) -> bool:
    """Whether a local variable is, or holds, an infinity or what is not a number."""
    if isinstance(value, float):
        return not math.isfinite(value)
    return isinstance(value, tuple) and any(bad_numbers(part) for part in value)


class Watch:
    """A profile hook that looks at what the functions of a folder leave behind."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.seen: set[str] = set()
        self._ours: dict[CodeType, bool] = {}

    def __call__(self, frame: FrameType, event: str, argument: Any) -> None:
        if event != "return":
            return
        code = frame.f_code
        if code not in self._ours:
            self._ours[code] = self.folder in Path(code.co_filename).parents
        if not self._ours[code]:
            return
        for name, value in (*frame.f_locals.items(), ("its result", argument)):
            if bad_numbers(value):
                self.seen.add(f"{Path(code.co_filename).stem}.{code.co_name}: {name} = {value}")


def random_scene(seed: int) -> qs.Scene:
    """Loads from nearly nothing to crushing, speeds to dm n = 3e6, balls with room between wide grooves and without."""
    rng = np.random.default_rng(seed)
    bearing = replace(
        B218,
        ball_count=int(rng.integers(2, 9)),
        inner_groove_radius=B218.ball_diameter * rng.uniform(0.502, 0.6),
        outer_groove_radius=B218.ball_diameter * rng.uniform(0.502, 0.6),
        free_contact_angle=rng.uniform(0.0, 70.0) * qs.deg,
        kind=qs.BearingKind(rng.choice(["angular_contact", "deep_groove"])),
    )
    thrust = 10.0 ** rng.uniform(-3.0, 5.0)
    side = thrust * rng.uniform(-0.5, 0.5, 4) * np.array([1.0, 1.0, 0.05, 0.05])
    loads = dict(zip(("radial_load_y", "radial_load_z", "moment_y", "moment_z"), map(float, side), strict=True))
    control = (OUTER, INNER, PER_BALL)[rng.integers(3)]
    return turning(float(rng.uniform(0.0, 24e3)), bearing, control=control, axial_load=thrust, **loads)


def squared(x: float) -> float:
    """Overflows without a word if x is a plain float, and numpy's way otherwise."""
    square = x * x
    return 1.0 / square


def with_traps(entry: CompiledEntry, *args: Any) -> Any:
    """In place of `CompiledEntry.plain`, which lets numbers be none and gives the kernel Python's."""
    return entry.function(*args)


def trap() -> dict[str, Any]:
    """What the traps catch when something walks into them."""
    watch = Watch(Path(__file__).parent)
    raised = []
    entry = CompiledEntry(squared, (float,))
    with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
        sys.setprofile(watch)
        squared(1e200)
        sys.setprofile(None)
        for walk in (
            lambda: squared(np.float64(1e200)),
            lambda: entry(np.float64(0.0)),
            lambda: squared(np.float64("inf") - np.float64("inf")),
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
    scene = scene_of(name) if name in BY_NAME else random_scene(int(name.removeprefix("random ")))
    watch = Watch(Path(qs.__file__).parent)
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
        "seen": sorted(watch.seen),
    }


if __name__ == "__main__":
    CompiledEntry.plain = with_traps  # type: ignore[method-assign]
    print(json.dumps({name: watched(name) for name in sys.argv[1:]}))
