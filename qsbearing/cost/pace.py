"""How long a solve takes: measured ratios to two reference solves, and these two timed on this machine, now.

    seconds = first t1 + balls * ball[kind] (t2 - t1)

t1 is a thrust-loaded bearing, nearly all overhead of the call; t2 - t1 is what combined load with every contact's own
angle takes beyond it, nearly all arithmetic. `first` is how much longer the first solve of a scene takes in a fresh
process than a repeated one: the processor has not seen it yet. `balls` are those that a solve iterates: one under
thrust, half of them where the load lies in a plane. The ratios are medians over random scenes.
"""

from __future__ import annotations

import statistics
import time
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.bearing import BallBearing
from qsbearing.effects import CentrifugalForce, GyroscopicMoment
from qsbearing.hertz import HertzForm
from qsbearing.operation import CHANNELS, Operation
from qsbearing.raceway_control import RacewayControl
from qsbearing.scene import HertzAngle, Scene
from qsbearing.solving import solve
from qsbearing.units import deg, mm, rpm

if TYPE_CHECKING:
    from collections.abc import Callable

CALIBRATION_ROUNDS = 7


def reference_scenes() -> tuple[Scene, Scene]:
    """B218 under thrust, and under combined load with actual-angle Hertz: the machine's overhead, and its
    arithmetic."""
    bearing = BallBearing(16, 22.225 * mm, 125.26 * mm, 11.6281 * mm, 11.6281 * mm, 40 * deg)
    effects = (CentrifugalForce(), GyroscopicMoment())
    thrust = Scene(bearing, Operation(speed=8000 * rpm, axial_load=1e4), effects, RacewayControl.OUTER)
    loaded = Operation(speed=8000 * rpm, axial_load=1e4, radial_load_y=3e3, moment_z=0.0)
    return thrust, replace(thrust, operation=loaded, hertz_angle=HertzAngle.ACTUAL)


def calibration(rounds: int = CALIBRATION_ROUNDS) -> dict[str, float]:
    """Seconds of the two reference solves on this machine, now: medians of solves in turn, the first not counted."""
    scenes = dict(zip(("thrust", "combined"), reference_scenes(), strict=True))
    times: dict[str, list[float]] = {name: [] for name in scenes}
    for turn in range(rounds + 1):
        for name, scene in scenes.items():
            seconds = timed(lambda scene=scene: solve(scene, threads=1))  # type: ignore[misc]
            if turn:
                times[name].append(seconds)
    return {name: statistics.median(values) for name, values in times.items()}


def timed(function: Callable[[], Any]) -> float:
    """Seconds of one call."""
    began = time.perf_counter()
    function()
    return time.perf_counter() - began


def kind(scene: Scene) -> str:
    """What the time of a ball depends on: whether balls move, whose angle Hertz takes, whether all balls are alike."""
    moving = bool(scene.ball_effects) and bool(_largest(scene.operation.speed, scene.operation.outer_speed))
    motion = "rest"
    if moving:
        motion = "per_ball" if scene.raceway_control is RacewayControl.PER_BALL else "moving"
    dear = scene.hertz_angle is HertzAngle.ACTUAL and scene.hertz_form is HertzForm.EXACT
    return "/".join((motion, "actual_angle" if dear else "free_angle", "thrust" if _is_thrust(scene) else "combined"))


def balls(scene: Scene) -> float:
    """How many balls the solve iterates, over all cases (mirror images and equal balls are solved once)."""
    count = np.asarray(scene.bearing.ball_count, float)
    if _is_thrust(scene):
        return float(np.ones_like(count).mean())
    operation = scene.operation
    xy = not _largest(operation.radial_load_z, operation.radial_displacement_z, operation.moment_y, operation.tilt_y)
    xz = not _largest(operation.radial_load_y, operation.radial_displacement_y, operation.moment_z, operation.tilt_z)
    return float((np.floor(0.5 * count) + 1.0 if xy or xz else count).mean())


def _is_thrust(scene: Scene) -> bool:
    return not any(
        _largest(getattr(scene.operation, channel.load), getattr(scene.operation, channel.displacement))
        for channel in CHANNELS[1:]
    )


def _largest(*values: Any) -> float:
    return max((float(np.abs(np.asarray(value, float)).max()) for value in values if value is not None), default=0.0)


def seconds(scene: Scene, table: dict[str, Any], here: dict[str, float]) -> float:
    """Expected time of solving a single case [s].

    Args:
        table: the measured ratios, `first` and `ball` by kind.
        here: the calibration of this machine.
    """
    arithmetic = max(here["combined"] - here["thrust"], 0.0)
    return float(table["first"] * here["thrust"] + balls(scene) * table["ball"][kind(scene)] * arithmetic)
