"""The envelope: random scenes in the units of a scene file, drawn from (seed, chunk) alone.

Numbers are drawn in millimetres, degrees, rpm and so on, and only then turned to SI by the very factors that the file
reader uses, so that a scene written to a file with all its digits is the same scene to the last bit.

A chunk is made of groups. What one array call cannot vary (kind, effects, control, held channels, ...) is drawn by
group; everything else by scene.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.hertz import effective_modulus
from qsbearing.operation import CHANNELS
from qsbearing.scene_keys import BEARING, MATERIAL, OPERATION, Key
from tests.campaign.sizes import CHUNK, GROUP

STEEL = (208.0, 0.3, 7800.0)
SILICON_NITRIDE = (315.0, 0.26, 3200.0)
"""Elastic modulus [GPa], Poisson's ratio, density [kg/m3]."""

YIELD_LOAD = 6.5e-5
"""Of one ball over E'D^2: about 15 N/mm2 of ball diameter squared for steel, where static load ratings lie."""

SPEED_PARAMETER = 5e6
"""Largest dm n [mm rpm]."""

LEAST_OPEN_ANGLE = 1.5
"""Degrees; scene files take smaller angles of angular-contact bearings, other than zero, for radians."""

MOST_LOAD, MOST_SHIFT_UM, MOST_TILT_MRAD = 9.9e7, 9.9e4, 190.0
"""Within the bounds of `Operation`."""

# Every way of asking for effects and control, and of choosing the rest.
EFFECTS = ((), ("centrifugal_force",), ("gyroscopic_moment",), ("centrifugal_force", "gyroscopic_moment"))
MOTIONS = tuple(
    (effects, control, shares)
    for effects in EFFECTS
    for control in (tuple(qs.RacewayControl) if effects else (None,))
    for shares in (tuple(qs.MomentShares) if "gyroscopic_moment" in effects else (None,))
)
HELD = tuple(itertools.product((False, True), repeat=5))

_KEYS = {key.name: key for key in (*BEARING, *MATERIAL, *OPERATION)}
_LOAD_KEYS = ("axial_load_N", "radial_load_y_N", "radial_load_z_N", "moment_y_Nm", "moment_z_Nm")
_DISPLACEMENT_KEYS = (
    "axial_displacement_um",
    "radial_displacement_y_um",
    "radial_displacement_z_um",
    "tilt_y_mrad",
    "tilt_z_mrad",
)


@dataclass(frozen=True)
class Group:
    """Scenes that one call can solve: common choices, and arrays by the keys of a scene file."""

    kind: qs.BearingKind
    effects: tuple[str, ...]
    control: qs.RacewayControl | None
    shares: qs.MomentShares | None
    hertz_angle: qs.HertzAngle
    hertz_form: qs.HertzForm
    tilt_lever: qs.TiltLever
    held: tuple[bool, ...]
    bearing: dict[str, NDArray]
    materials: dict[str, dict[str, NDArray]]
    operation: dict[str, NDArray]

    @property
    def size(self) -> int:
        """How many scenes."""
        return int(self.bearing["ball_count"].size)

    @property
    def family(self) -> str:
        """Control, kind and class of held channels: what the summary counts by."""
        motion = "+".join(effect.partition("_")[0] for effect in self.effects) or "static"
        pattern = {0: "all loaded", 5: "all held"}.get(sum(self.held), "mixed")
        return f"{self.control or 'none'}/{motion}/{self.kind}/{pattern}"

    def part(self, index: Any) -> Group:
        """Some of its scenes."""

        def cut(table: dict[str, NDArray]) -> dict[str, NDArray]:
            return {key: value[index] for key, value in table.items()}

        return replace(
            self,
            bearing=cut(self.bearing),
            materials={side: cut(table) for side, table in self.materials.items()},
            operation=cut(self.operation),
        )

    def scene(self) -> qs.Scene:
        """All its scenes as one, with arrays; of a part by a whole number, with plain numbers."""
        materials = {
            side: qs.Material(*(_in_si(_KEYS[key], value) for key, value in table.items()))
            for side, table in self.materials.items()
        }
        bearing = {_KEYS[key].field: _in_si(_KEYS[key], value) for key, value in self.bearing.items()}
        operation = {_KEYS[key].field: _in_si(_KEYS[key], value) for key, value in self.operation.items()}
        makers = {
            "centrifugal_force": qs.CentrifugalForce,
            "gyroscopic_moment": lambda: qs.GyroscopicMoment(self.shares or qs.MomentShares.CONTROLLING),
        }
        return qs.Scene(
            qs.BallBearing(**bearing, **materials, kind=self.kind),
            qs.Operation(**operation),
            tuple(makers[effect]() for effect in self.effects),
            self.control,
            self.hertz_angle,
            self.hertz_form,
            self.tilt_lever,
        )

    def toml(self, index: int, sentence: str) -> str:
        """One of its scenes as a scene file, every number with all its digits."""
        lines = [f"# {line}" for line in sentence.splitlines()]
        lines += ["[bearing]", f'kind = "{self.kind}"', *_lines(self.bearing, index)]
        for side, table in self.materials.items():
            lines.append(f"{side} = {{ {', '.join(_lines(table, index))} }}")
        lines += ["", "[operation]", *_lines(self.operation, index), "", "[effects]"]
        lines.append(f"ball = [{', '.join(f'{chr(34)}{effect}{chr(34)}' for effect in self.effects)}]")
        if self.control is not None:
            lines.append(f'raceway_control = "{self.control}"')
        if self.shares is not None:
            lines.append(f'moment_shares = "{self.shares}"')
        for key in ("hertz_angle", "hertz_form", "tilt_lever"):
            lines.append(f'{key} = "{getattr(self, key)}"')
        return "\n".join(lines) + "\n"


def _in_si(key: Key, value: NDArray) -> Any:
    product = value * key.size
    return product if np.ndim(product) else float(product)


def _lines(table: dict[str, NDArray], index: int) -> list[str]:
    return [f"{key} = {float(value[index])!r}" for key, value in table.items()]


# Drawing ------------------------------------------------------------------------------------------------------------


def chunk_groups(seed: int, chunk: int, count: int = CHUNK) -> list[Group]:
    """The groups of a chunk; of a shorter one the same first scenes."""
    rng = np.random.default_rng([seed, chunk])
    groups = []
    for number in range(CHUNK // GROUP):
        group = draw_group(rng, chunk * (CHUNK // GROUP) + number)
        left = count - GROUP * number
        if left > 0:
            groups.append(group if left >= GROUP else group.part(slice(0, left)))
    return groups


def draw_group(rng: np.random.Generator, number: int) -> Group:
    """A group; its number decides which channels are held, so that all 32 patterns come round in turn."""
    held = HELD[number % len(HELD)]
    kind = _one(rng, list(qs.BearingKind))
    effects, control, shares = _one(rng, MOTIONS, [0.16, *[0.84 / (len(MOTIONS) - 1)] * (len(MOTIONS) - 1)])
    choices = {
        "hertz_angle": _one(rng, list(qs.HertzAngle), [0.5, 0.4, 0.1]),
        "hertz_form": _one(rng, list(qs.HertzForm), [0.9, 0.05, 0.05]),
        "tilt_lever": _one(rng, list(qs.TiltLever), [0.9, 0.1]),
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
    coefficients = [_mixed(rng, rng.uniform(0.505, 0.56, n), 0.5 + 10.0 ** rng.uniform(-3.3, np.log10(0.25), n), 0.8)]
    coefficients.append(np.where(rng.random(n) < 0.3, coefficients[0], rng.permutation(coefficients[0])))
    if kind is qs.BearingKind.DEEP_GROOVE:
        angle = _mixed(rng, rng.uniform(0.0, 20.0, n), 75.0 * rng.random(n) ** 2, 0.7)
        angle = _mixed(rng, angle, 10.0 ** rng.uniform(-6.0, 0.0, n), 0.95)
        angle[rng.random(n) < 0.1] = 0.0
    else:
        angle = _mixed(rng, rng.uniform(10.0, 45.0, n), rng.uniform(LEAST_OPEN_ANGLE, 75.0, n), 0.7)
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
    names = [key.name for key in MATERIAL[:3]]
    return bearing, {
        "ball_material": dict(zip(names, ball, strict=True)),
        "ring_material": dict(zip(names, ring, strict=True)),
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
    diameter, pitch, count = (bearing[key] for key in ("ball_diameter_mm", "pitch_diameter_mm", "ball_count"))
    operation = dict(zip(("speed_rpm", "outer_speed_rpm"), draw_speeds(rng, pitch), strict=True))
    ball, ring = materials["ball_material"], materials["ring_material"]
    modulus = effective_modulus(
        ball["elastic_modulus_GPa"] * 1e3, ball["poisson_ratio"], ring["elastic_modulus_GPa"] * 1e3,
        ring["poisson_ratio"],
    )  # fmt: skip
    # Of the whole bearing: six decades below to three times its yield, or anything from a millionth of a newton.
    full = count * YIELD_LOAD * modulus * diameter**2
    relative = full * 10.0 ** rng.uniform(-6.0, 0.5, n)
    absolute = 10.0 ** rng.uniform(-6.0, np.log10(3.0 * full))
    size = _mixed(rng, relative, absolute, 0.85)
    # And as a displacement: the approach that such a load makes, or a good part of the play between the grooves.
    approach = 1e3 * diameter * 1.2e-3 * (size / full) ** (2.0 / 3.0)
    span = 1e3 * (bearing["inner_groove_radius_mm"] + bearing["outer_groove_radius_mm"] - diameter)
    reach = np.minimum(_mixed(rng, approach, span * 10.0 ** rng.uniform(-4.0, -0.5, n), 0.8), 0.01 * 1e3 * diameter)
    shape = draw_shape(rng, kind)
    lever = 0.5 * pitch
    for i, channel in enumerate(CHANNELS):
        if held[i]:
            value = reach * shape[i] / (lever if channel.is_rotation else 1.0)
            most = MOST_TILT_MRAD if channel.is_rotation else MOST_SHIFT_UM
            operation[_DISPLACEMENT_KEYS[i]] = np.clip(value, -most, most)
        else:
            value = size * shape[i] * (lever * 1e-3 if channel.is_rotation else 1.0)
            operation[_LOAD_KEYS[i]] = np.clip(value, -MOST_LOAD, MOST_LOAD)
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


def _one(rng: np.random.Generator, choices: Any, weights: Any = None) -> Any:
    return choices[int(rng.choice(len(choices), p=weights))]


def _mixed(rng: np.random.Generator, one: NDArray, other: NDArray, share: float) -> NDArray:
    """The first for this share of scenes, the second for the rest."""
    return np.where(rng.random(one.size) < share, one, other)
