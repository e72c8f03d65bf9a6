"""The wild envelope: everything that a scene may ask for, whether or not anybody would build it.

| quantity | range |
|---|---|
| kind | angular contact or deep groove, half each |
| balls | 3 to 60 of 0.5 to 100 mm (log-uniform) that fit their pitch circle, filled to 25-97 % |
| groove radius / D | 0.505 to 0.56, a fifth of them from 0.5005 to 0.75 |
| free contact angle | 0 to 75 degrees, mostly 10 to 45 (deep groove: 0 to 20) |
| materials | steel, hybrid, a tenth each with any balls (3 to 630 GPa, 890 to 19 000 kg/m3) and any rings |
| speed | at rest to 5 million mm rpm; either ring, together or against each other, both directions |
| effects | every combination with every control and share of the moment; a sixth static |
| channels | all 32 patterns of loads and displacements in turn |
| loads | a millionth of the static rating, or of a newton, to three times the rating; whole patterns of zeros |
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.operation import CHANNELS
from tests.verification.campaign.group import (
    DISPLACEMENT_KEYS,
    GROUP,
    LOAD_KEYS,
    MATERIAL_KEYS,
    SILICON_NITRIDE,
    STEEL,
    Group,
    mixture,
    one_of,
    yield_load,
)

SPEED_PARAMETER = 5e6
"""Largest dm n [mm rpm]."""

LEAST_OPEN_ANGLE = 1.5
"""Degrees; scene files take smaller angles of angular-contact bearings, other than zero, for radians."""

MOST_LOAD, MOST_SHIFT_UM, MOST_TILT_MRAD = 9.9e7, 9.9e4, 190.0
"""Within the bounds of `Operation`."""

# Every way of asking for effects and control, and of choosing the rest.
EFFECTS = ((), ("centrifugal_force",), ("gyroscopic_moment",), ("centrifugal_force", "gyroscopic_moment"))
CONTROLS = (qs.RacewayControl.OUTER, qs.RacewayControl.INNER, qs.RacewayControl.PER_BALL)
"""Those that the records on file were drawn from: a seed stays the same scenes."""
MOTIONS = tuple(
    (effects, control, shares)
    for effects in EFFECTS
    for control in (CONTROLS if effects else (None,))
    for shares in (tuple(qs.MomentShares) if "gyroscopic_moment" in effects else (None,))
)
HELD = tuple(itertools.product((False, True), repeat=5))


def draw_group(rng: np.random.Generator, number: int) -> Group:
    """A group; its number decides which channels are held, so that all 32 patterns come round in turn."""
    held = HELD[number % len(HELD)]
    kind = one_of(rng, [qs.BearingKind.ANGULAR_CONTACT, qs.BearingKind.DEEP_GROOVE])
    effects, control, shares = one_of(rng, MOTIONS, [0.16, *[0.84 / (len(MOTIONS) - 1)] * (len(MOTIONS) - 1)])
    choices = {
        "hertz_angle": one_of(rng, list(qs.HertzAngle), [0.5, 0.4, 0.1]),
        "hertz_form": one_of(rng, list(qs.HertzForm), [0.9, 0.05, 0.05]),
        "tilt_lever": one_of(rng, list(qs.TiltLever), [0.9, 0.1]),
    }
    bearing, materials = draw_bearing(rng, kind)
    operation = draw_operation(rng, kind, held, bearing, materials)
    return Group(
        kind, effects, control, shares, held=held, bearing=bearing, materials=materials, operation=operation, **choices
    )


def draw_bearing(
    rng: np.random.Generator, kind: qs.BearingKind
) -> tuple[dict[str, NDArray], dict[str, dict[str, NDArray]]]:
    """Bearings of 3 to 60 balls of 0.5 to 100 mm that fit their pitch circle, and materials of balls and rings."""
    n = GROUP
    diameter = 10.0 ** rng.uniform(np.log10(0.5), 2.0, n)
    count = rng.integers(3, 61, n)
    pitch = diameter / (np.sin(np.pi / count) * rng.uniform(0.25, 0.97, n))
    coefficients = [mixture(rng, rng.uniform(0.505, 0.56, n), 0.5 + 10.0 ** rng.uniform(-3.3, np.log10(0.25), n), 0.8)]
    coefficients.append(np.where(rng.random(n) < 0.3, coefficients[0], rng.permutation(coefficients[0])))
    if kind is qs.BearingKind.DEEP_GROOVE:
        angle = mixture(rng, rng.uniform(0.0, 20.0, n), 75.0 * rng.random(n) ** 2, 0.7)
        angle = mixture(rng, angle, 10.0 ** rng.uniform(-6.0, 0.0, n), 0.95)
        angle[rng.random(n) < 0.1] = 0.0
    else:
        angle = mixture(rng, rng.uniform(10.0, 45.0, n), rng.uniform(LEAST_OPEN_ANGLE, 75.0, n), 0.7)
        angle[rng.random(n) < 0.01] = 0.0
    bearing = {
        "ball_count": count.astype(float),
        "ball_diameter_mm": diameter,
        "pitch_diameter_mm": pitch,
        "inner_groove_radius_mm": coefficients[0] * diameter,
        "outer_groove_radius_mm": coefficients[1] * diameter,
        "free_contact_angle_deg": angle,
    }
    odd = np.stack([10.0 ** rng.uniform(0.5, 2.8, n), rng.uniform(0.0, 0.49, n), 10.0 ** rng.uniform(2.95, 4.28, n)])
    other = np.stack([10.0 ** rng.uniform(0.5, 2.8, n), rng.uniform(0.0, 0.49, n), 10.0 ** rng.uniform(2.95, 4.28, n)])
    which = rng.choice(4, n, p=[0.5, 0.3, 0.1, 0.1])
    ball = np.choose(which, [np.array(STEEL)[:, None], np.array(SILICON_NITRIDE)[:, None], odd, odd])
    ring = np.choose(which, [np.array(STEEL)[:, None], np.array(STEEL)[:, None], np.array(STEEL)[:, None], other])
    return bearing, {
        "ball_material": dict(zip(MATERIAL_KEYS, ball, strict=True)),
        "ring_material": dict(zip(MATERIAL_KEYS, ring, strict=True)),
    }


def draw_operation(
    rng: np.random.Generator,
    kind: qs.BearingKind,
    held: tuple[bool, ...],
    bearing: dict[str, NDArray],
    materials: dict[str, dict[str, NDArray]],
) -> dict[str, NDArray]:
    """Speeds, and each channel's load or displacement."""
    n = GROUP
    diameter, pitch = (bearing[key] for key in ("ball_diameter_mm", "pitch_diameter_mm"))
    operation = dict(zip(("speed_rpm", "outer_speed_rpm"), draw_speeds(rng, pitch), strict=True))
    # Of the whole bearing: six decades below to three times its yield, or anything from a millionth of a newton.
    full = yield_load(bearing, materials)
    relative = full * 10.0 ** rng.uniform(-6.0, 0.5, n)
    absolute = 10.0 ** rng.uniform(-6.0, np.log10(3.0 * full))
    size = mixture(rng, relative, absolute, 0.85)
    # And as a displacement: the approach that such a load makes, or a good part of the play between the grooves.
    approach = 1e3 * diameter * 1.2e-3 * (size / full) ** (2.0 / 3.0)
    span = 1e3 * (bearing["inner_groove_radius_mm"] + bearing["outer_groove_radius_mm"] - diameter)
    reach = np.minimum(mixture(rng, approach, span * 10.0 ** rng.uniform(-4.0, -0.5, n), 0.8), 0.01 * 1e3 * diameter)
    shape = draw_shape(rng, kind)
    lever = 0.5 * pitch
    for i, channel in enumerate(CHANNELS):
        if held[i]:
            value = reach * shape[i] / (lever if channel.is_rotation else 1.0)
            most = MOST_TILT_MRAD if channel.is_rotation else MOST_SHIFT_UM
            operation[DISPLACEMENT_KEYS[i]] = np.clip(value, -most, most)
        else:
            value = size * shape[i] * (lever * 1e-3 if channel.is_rotation else 1.0)
            operation[LOAD_KEYS[i]] = np.clip(value, -MOST_LOAD, MOST_LOAD)
    first = rng.uniform(-360.0, 360.0, n)
    operation["first_ball_azimuth_deg"] = np.where(rng.random(n) < 0.4, 0.0, first)
    return operation


def draw_speeds(rng: np.random.Generator, pitch: NDArray) -> tuple[NDArray, NDArray]:
    """Speeds of inner and outer ring [rpm]: rest, inner alone, outer alone, together, against each other."""
    n = pitch.size
    parameter = np.where(
        rng.random(n) < 0.6,
        SPEED_PARAMETER * rng.random(n) ** 2,
        10.0 ** rng.uniform(0.0, np.log10(SPEED_PARAMETER), n),
    )
    speed = parameter / pitch * np.where(rng.random(n) < 0.2, -1.0, 1.0)
    share = rng.uniform(-1.0, 1.0, n)
    way = rng.choice(5, n, p=[0.1, 0.6, 0.1, 0.18, 0.02])
    zero = np.zeros(n)
    inner = np.choose(way, [zero, speed, zero, speed, speed])
    outer = np.choose(way, [zero, zero, speed, share * speed, speed])
    return inner, outer


def draw_shape(rng: np.random.Generator, kind: qs.BearingKind) -> NDArray:
    """How much of a scene's size falls to each channel, (5, scene); whole patterns of zeros come often."""
    n = GROUP
    shape = rng.normal(size=(5, n))
    side = 10.0 ** rng.uniform(-2.5, 0.3, (2, n))
    side[:, rng.random(n) < 0.5] = 0.3
    shape[1:3] *= side[0]
    shape[3:] *= side[1]
    if kind is qs.BearingKind.ANGULAR_CONTACT:
        shape[0] = np.abs(shape[0]) * np.where(rng.random(n) < 0.1, -1.0, 1.0)
    patterns = np.array(
        [
            [1, 1, 1, 1, 1],  # everything
            [1, 0, 0, 0, 0],  # thrust alone
            [1, 1, 0, 0, 1],  # the x-y plane
            [1, 0, 1, 1, 0],  # the x-z plane
            [0, 1, 1, 0, 0],  # radial alone
            [0, 0, 0, 1, 1],  # a moment alone
            [1, 1, 1, 0, 0],  # no moment
            [0, 0, 0, 0, 0],  # nothing
        ]
    )
    return shape * patterns[rng.choice(len(patterns), n, p=[0.5, 0.1, 0.1, 0.08, 0.05, 0.03, 0.12, 0.02])].T
