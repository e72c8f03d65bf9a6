"""Random scenes of every kind that the model knows: predictions are fitted to them, the choice of effects tried on.

Bearings from miniature to large, contact angles from deep groove to 45 degrees, steel and ceramic balls; ball loads
from light preload to about the static rating; speeds from rest to dm n = 3e6 mm rpm; thrust, combined loads with free
and held tilts, moments, rigid preload, misalignment; every subset of effects and every choice.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace
from typing import Any

import numpy as np

import qsbearing as qs

LOADINGS = (
    "thrust",
    "combined, free tilt",
    "combined, held tilt",
    "five channels",
    "preload",
    "misaligned",
    "deep groove",
)
_LOADING_SHARES = (0.2, 0.2, 0.15, 0.15, 0.1, 0.1, 0.1)
_BOTH = (qs.CentrifugalForce(), qs.GyroscopicMoment())
_EFFECTS = (_BOTH, (qs.CentrifugalForce(),), (qs.GyroscopicMoment(),), ())
_CONTROLS = ("outer", "per_ball", "inner")


def batches(seed: int, count: int, size: int = 50) -> Iterator[qs.Scene]:
    """So many scenes, each with a case axis of so many cases; all that is drawn follows from the seed."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        yield batch(rng, size)


def batch(rng: np.random.Generator, size: int) -> qs.Scene:
    """Scenes that make the same choices, in one."""
    loading = str(rng.choice(LOADINGS, p=_LOADING_SHARES))
    effects = _EFFECTS[rng.choice(4, p=(0.7, 0.12, 0.06, 0.12))]
    gyroscopic = any(isinstance(effect, qs.GyroscopicMoment) for effect in effects)
    if gyroscopic and rng.random() < 0.25:
        effects = tuple(
            qs.GyroscopicMoment(qs.MomentShares.HARRIS) if isinstance(effect, qs.GyroscopicMoment) else effect
            for effect in effects
        )
    control = str(rng.choice(_CONTROLS, p=(0.5, 0.35, 0.15)))
    bearing = _bearings(rng, size, is_deep=loading == "deep groove")
    return qs.Scene(
        bearing,
        _operations(rng, size, loading, bearing, inner_controlled=bool(effects) and control == "inner"),
        effects,
        qs.RacewayControl(control) if effects else None,
        hertz_angle=qs.HertzAngle(str(rng.choice(["actual", "free"]))),
        hertz_form=qs.HertzForm(str(rng.choice(["exact", "hamrock_brewe_1983"], p=(0.9, 0.1)))),
    )


def _log_uniform(rng: np.random.Generator, low: float, high: float, size: int) -> Any:
    return np.exp(rng.uniform(np.log(low), np.log(high), size))


def _bearings(rng: np.random.Generator, size: int, is_deep: bool) -> qs.BallBearing:
    count = np.rint(rng.uniform(*((6, 12) if is_deep else (8, 32)), size))
    ball = _log_uniform(rng, 2e-3, 60e-3, size)
    pitch = ball * np.maximum(count / np.pi * rng.uniform(1.15, 1.8, size), 2.8)
    inner, outer = (ball * rng.uniform(0.512, 0.54, size) for _ in range(2))
    angle = rng.uniform(0.0, 10.0, size) if is_deep else rng.uniform(10.0, 45.0, size)
    return qs.BallBearing(
        count,
        ball,
        pitch,
        inner,
        outer,
        angle * qs.deg,
        ball_material=qs.SILICON_NITRIDE if rng.random() < 0.35 else qs.STEEL,
        kind=qs.BearingKind.DEEP_GROOVE if is_deep else qs.BearingKind.ANGULAR_CONTACT,
    )


def _operations(
    rng: np.random.Generator, size: int, loading: str, bearing: qs.BallBearing, inner_controlled: bool
) -> qs.Operation:
    count, ball, pitch = (np.asarray(x) for x in (bearing.ball_count, bearing.ball_diameter, bearing.pitch_diameter))
    angle = np.maximum(np.asarray(bearing.free_contact_angle), 8.0 * qs.deg)
    # Inner control has no solution where the inner load falls too far: a scene that names it turns slower.
    parameter = _log_uniform(rng, 3e3, 3e5 if inner_controlled else 3e6, size)
    speed = np.where(rng.random(size) < 0.05, 0.0, parameter / (pitch / qs.mm) * qs.rpm)
    speeds: dict[str, Any] = {"speed": speed}
    turning = rng.random()
    if turning < 0.1:
        speeds = {"speed": 0.0 * speed, "outer_speed": speed}
    elif turning < 0.15:
        speeds = {"speed": speed, "outer_speed": -0.4 * speed}
    per_ball = _log_uniform(rng, 3e5, 2e7, size) * ball**2  # N: Q/D^2 from 0.3 to 20 MPa
    axial = count * per_ball * np.sin(angle)
    radial = axial / np.tan(angle) * rng.uniform(0.0, 0.5, size)
    upright = {"tilt_y": 0.0, "tilt_z": 0.0}
    if loading == "thrust":
        return qs.Operation(**speeds, axial_load=axial)
    if loading == "combined, free tilt":
        return qs.Operation(**speeds, axial_load=axial, radial_load_y=radial, moment_z=0.0)
    if loading == "combined, held tilt":
        return qs.Operation(**speeds, axial_load=axial, radial_load_y=radial, **upright)
    if loading == "five channels":
        moment = axial * pitch * rng.uniform(-0.08, 0.08, (2, size))
        across = rng.uniform(0.0, 2.0 * np.pi, size)
        return qs.Operation(
            **speeds,
            axial_load=axial,
            radial_load_y=0.6 * radial * np.cos(across),
            radial_load_z=0.6 * radial * np.sin(across),
            moment_y=moment[0],
            moment_z=moment[1],
        )
    approach = 3.5e-11 ** (2.0 / 3.0) * per_ball ** (2.0 / 3.0) * (0.022 / ball) ** (1.0 / 3.0) * 2.0
    if loading == "preload":
        return qs.Operation(
            **speeds, axial_displacement=approach / np.sin(angle), radial_load_y=0.5 * radial, **upright
        )
    if loading == "misaligned":
        tilt = approach / (pitch * np.sin(angle)) * rng.uniform(-0.8, 0.8, size)
        return qs.Operation(**speeds, axial_load=axial, tilt_z=tilt, tilt_y=0.0)
    side = rng.uniform(0.2, 1.0, size)
    return qs.Operation(**speeds, axial_load=axial, radial_load_y=side * count * per_ball / 5.0, **upright)


def case(scene: qs.Scene, index: int) -> qs.Scene:
    """One case of an array scene, as a scene of its own."""
    return replace(scene, bearing=_pick(scene.bearing, index), operation=_pick(scene.operation, index))


def _pick(part: Any, index: int) -> Any:
    chosen = {
        field.name: float(value[index])
        for field in fields(part)
        if isinstance(value := getattr(part, field.name), np.ndarray) and value.ndim
    }
    return replace(part, **chosen)
