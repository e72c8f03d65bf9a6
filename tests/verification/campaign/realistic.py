"""The realistic envelope: angular-contact bearings as catalogues have them, under loads that they are chosen for.

| quantity | range |
|---|---|
| balls | 8 to 25 of 3 to 40 mm (log-uniform) that fit their pitch circle, filled to 65-97 % |
| groove radius / D | 0.515 to 0.54; the same on both rings for a third |
| free contact angle | 12 to 45 degrees: any, or one of 12, 15, 18, 20, 25, 30, 40, 45 |
| balls | steel (65 %) or silicon nitride; steel rings |
| speed | dm n to 2.5 million mm rpm, uniform (60 %) or log-uniform from 1000; a tenth at rest, a tenth backwards |
| ring that turns | the inner (85 %), the outer (10 %), both in the same direction |
| effects | both (80 %), centrifugal force alone or none (10 % each) |
| control | outer or of each ball, half each |
| axial load | log-uniform from 0.2 % of the axial static rating, a light preload, to the rating |
| rigid preload | for a fifth of the groups, in place of the axial load, the displacement that it makes |
| radial load | Fr tan(alpha) to 0.8 Fa, which unloads half of the balls; for a sixth to 3 Fa; at most C0r |
| moment | to half of Fa dm/2, the arm at which balls unload; for a sixth to all of it |
| tilts | held, at zero or at up to half of the approach, or free |

Static ratings are those of ISO 76, f0 = 14.7 radially and 61.6 axially; the real f0 falls by up to a third with D/dm.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
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

SPEED_PARAMETER = 2.5e6
"""Largest dm n [mm rpm]."""

RADIAL_RATING, AXIAL_RATING = 14.7, 61.6
"""N/mm2: C0r = 14.7 Z D^2 cos(alpha), C0a = 61.6 Z D^2 sin(alpha)."""

ANGLES = (12.0, 15.0, 18.0, 20.0, 25.0, 30.0, 40.0, 45.0)
"""Degrees, as catalogues list them."""

BOTH = ("centrifugal_force", "gyroscopic_moment")

# Held channels, in the order x, y, z, tilt y, tilt z, and whether there are radial loads and moments; with shares.
THRUST, COMBINED, OVERHUNG = (False, False), (True, False), (True, True)
PATTERNS = (
    ((False, False, False, False, False), THRUST, 0.2),  # free in all, as a spring-loaded outer ring
    ((False, False, False, True, True), THRUST, 0.1),
    ((False, False, False, True, True), COMBINED, 0.3),  # a stiff shaft
    ((False, False, False, False, False), COMBINED, 0.1),
    ((False, False, False, False, False), OVERHUNG, 0.1),
    ((True, False, False, True, True), COMBINED, 0.1),  # rigid preload
    ((True, False, False, False, False), OVERHUNG, 0.1),
)


def draw_group(rng: np.random.Generator, number: int, size: int = GROUP) -> Group:
    """A group; its number says nothing here."""
    effects = one_of(rng, (BOTH, BOTH[:1], ()), [0.8, 0.1, 0.1])
    control = one_of(rng, (qs.RacewayControl.OUTER, qs.RacewayControl.PER_BALL)) if effects else None
    shares = one_of(rng, list(qs.MomentShares)) if "gyroscopic_moment" in effects else None
    held, acting = PATTERNS[int(rng.choice(len(PATTERNS), p=[share for *_, share in PATTERNS]))][:2]
    angle = one_of(rng, (qs.HertzAngle.FREE, qs.HertzAngle.ACTUAL), [0.7, 0.3])
    bearing, materials = draw_bearing(rng, size)
    operation = draw_operation(rng, held, acting, bearing, materials)
    return Group(
        qs.BearingKind.ANGULAR_CONTACT, effects, control, shares, angle, qs.HertzForm.EXACT,
        qs.TiltLever.GROOVE_CENTRE, held, bearing, materials, operation,
    )  # fmt: skip


def draw_bearing(rng: np.random.Generator, n: int = GROUP) -> tuple[dict[str, NDArray], dict[str, dict[str, NDArray]]]:
    """Bearings, and materials of balls and rings."""
    diameter = 10.0 ** rng.uniform(np.log10(3.0), np.log10(40.0), n)
    count = rng.integers(8, 26, n)
    pitch = diameter / (np.sin(np.pi / count) * rng.uniform(0.65, 0.97, n))
    inner, outer = rng.uniform(0.515, 0.54, (2, n))
    outer = mixture(rng, inner, outer, 1.0 / 3.0)
    angle = mixture(rng, rng.uniform(12.0, 45.0, n), rng.choice(ANGLES, n), 0.5)
    bearing = {
        "ball_count": count.astype(float),
        "ball_diameter_mm": diameter,
        "pitch_diameter_mm": pitch,
        "inner_groove_radius_mm": inner * diameter,
        "outer_groove_radius_mm": outer * diameter,
        "free_contact_angle_deg": angle,
    }
    ring = np.repeat(np.array(STEEL)[:, None], n, axis=1)
    ball = np.where(rng.random(n) < 0.65, ring, np.array(SILICON_NITRIDE)[:, None])
    return bearing, {
        "ball_material": dict(zip(MATERIAL_KEYS, ball, strict=True)),
        "ring_material": dict(zip(MATERIAL_KEYS, ring, strict=True)),
    }


def draw_operation(
    rng: np.random.Generator,
    held: tuple[bool, ...],
    acting: tuple[bool, bool],
    bearing: dict[str, NDArray],
    materials: dict[str, dict[str, NDArray]],
) -> dict[str, NDArray]:
    """Speeds, and each channel's load or displacement."""
    n, (has_radial, has_moment) = bearing["ball_diameter_mm"].size, acting
    diameter, pitch, count = (bearing[key] for key in ("ball_diameter_mm", "pitch_diameter_mm", "ball_count"))
    angle = np.radians(bearing["free_contact_angle_deg"])
    speed, outer_speed = draw_speeds(rng, pitch)
    rating = AXIAL_RATING * count * diameter**2 * np.sin(angle)
    axial = rating * 10.0 ** rng.uniform(np.log10(0.002), 0.0, n)
    radial = axial / np.tan(angle) * mixture(rng, rng.uniform(0.0, 0.8, n), rng.uniform(0.8, 3.0, n), 5.0 / 6.0)
    radial = np.minimum(radial, RADIAL_RATING * count * diameter**2 * np.cos(angle)) * has_radial
    arm = mixture(rng, rng.uniform(0.0, 0.5, n), rng.uniform(0.5, 1.0, n), 5.0 / 6.0)
    moment = axial * 0.5e-3 * pitch * arm * has_moment
    # Of both contacts together, at the free angle and within a tenth: 1.2e-3 D at the rating of steel.
    share = axial / np.sin(angle) / yield_load(bearing, materials)
    approach = 1e3 * diameter * 1.2e-3 * share ** (2.0 / 3.0)
    tilt = approach / (0.5 * pitch) * mixture(rng, np.zeros(n), rng.uniform(0.0, 0.5, n), 0.6)
    loads = [axial, *_in_plane(rng, radial), *_in_plane(rng, moment)]
    displacements: list[Any] = [approach / np.sin(angle), None, None, *_in_plane(rng, tilt)]
    operation = {"speed_rpm": speed, "outer_speed_rpm": outer_speed}
    for i, is_held in enumerate(held):
        operation[(DISPLACEMENT_KEYS if is_held else LOAD_KEYS)[i]] = (displacements if is_held else loads)[i]
    operation["first_ball_azimuth_deg"] = mixture(rng, np.zeros(n), rng.uniform(-180.0, 180.0, n), 0.4)
    return operation


def draw_speeds(rng: np.random.Generator, pitch: NDArray) -> tuple[NDArray, NDArray]:
    """Speeds of inner and outer ring [rpm]."""
    n = pitch.size
    uniform, logarithmic = rng.uniform(0.0, SPEED_PARAMETER, n), 10.0 ** rng.uniform(3.0, np.log10(SPEED_PARAMETER), n)
    speed = mixture(rng, uniform, logarithmic, 0.6) / pitch * np.where(rng.random(n) < 0.1, -1.0, 1.0)
    speed = mixture(rng, np.zeros(n), speed, 0.1)
    turning = rng.choice(3, n, p=[0.85, 0.1, 0.05])
    share = rng.uniform(0.0, 1.0, n)
    inner = np.where(turning == 1, 0.0, speed)
    outer = np.choose(turning, [np.zeros(n), speed, share * speed])
    return inner, outer


def _in_plane(rng: np.random.Generator, size: NDArray) -> tuple[NDArray, NDArray]:
    """Components along y and z: along y for half of the scenes, as a scene file is likely to have it."""
    azimuth = mixture(rng, np.zeros(size.size), rng.uniform(-np.pi, np.pi, size.size), 0.5)
    return size * np.cos(azimuth), size * np.sin(azimuth)
