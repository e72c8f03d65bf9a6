"""Groups: random scenes that one call can solve, in the units of a scene file.

Numbers are drawn in millimetres, degrees, rpm and so on, and only then turned to SI by the very factors that the file
reader uses, so that a scene written to a file with all its digits is the same scene to the last bit.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.files.keys import (
    BALL_DEVIATIONS,
    BALL_EXPANSION,
    BEARING,
    EFFECTS,
    MATERIAL,
    OPERATION,
    PRELOAD,
    RING_EXPANSION,
    Key,
)
from qsbearing.model.contact.hertz import effective_modulus

GROUP = 25
"""Scenes of a group."""

STEEL = (208.0, 0.3, 7800.0)
SILICON_NITRIDE = (315.0, 0.26, 3200.0)
"""Elastic modulus [GPa], Poisson's ratio, density [kg/m3]."""

YIELD_LOAD = 6.5e-5
"""Of one ball over E'D^2: about 15 N/mm2 of ball diameter squared for steel, where static load ratings lie."""

LOAD_KEYS = ("axial_load_N", "radial_load_y_N", "radial_load_z_N", "moment_y_Nm", "moment_z_Nm")
DISPLACEMENT_KEYS = (
    "axial_displacement_um",
    "radial_displacement_y_um",
    "radial_displacement_z_um",
    "tilt_y_mrad",
    "tilt_z_mrad",
)
MATERIAL_KEYS = [key.name for key in MATERIAL[:3]]
NUMBERS_OF_EFFECTS = ("friction_coefficient", "deviations")

_KEYS = {
    key.name: key
    for key in (*BEARING, *MATERIAL, *OPERATION, *PRELOAD, *RING_EXPANSION, *BALL_EXPANSION, *EFFECTS, BALL_DEVIATIONS)
}


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
    orbit: qs.OrbitRadius = qs.OrbitRadius.PITCH_CIRCLE
    more: dict[str, dict[str, NDArray]] = field(default_factory=dict)
    """Of a preload, ring and ball expansion, and of what the table of effects holds as numbers; empty for none."""

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
            more={name: cut(table) for name, table in self.more.items()},
        )

    def scene(self) -> qs.Scene:
        """All its scenes as one, with arrays; of a part by a whole number, with plain numbers."""
        materials = {
            side: qs.Material(*(_in_si(_KEYS[key], value) for key, value in table.items()))
            for side, table in self.materials.items()
        }
        friction, deviations = (_fields(self.more.get("effects", {})).get(name) for name in NUMBERS_OF_EFFECTS)
        makers = {
            "centrifugal_force": qs.CentrifugalForce,
            "gyroscopic_moment": lambda: qs.GyroscopicMoment(self.shares or qs.MomentShares.CONTROLLING, friction),
        }
        growing = {"ring_expansion": qs.RingExpansion, "ball_expansion": qs.BallExpansion}
        ring_effects = [make(**_fields(self.more[name])) for name, make in growing.items() if name in self.more]
        if deviations is not None:
            ring_effects.append(qs.BallDiameterDeviations(deviations))
        return qs.Scene(
            qs.BallBearing(**_fields(self.bearing), **materials, kind=self.kind),
            qs.Operation(**_fields(self.operation)),
            tuple(makers[effect]() for effect in self.effects),
            self.control,
            self.hertz_angle,
            self.hertz_form,
            self.tilt_lever,
            tuple(ring_effects),
            qs.Preload(**_fields(self.more["preload"])) if "preload" in self.more else None,
            orbit_radius=self.orbit,
        )

    def toml(self, index: int, sentence: str) -> str:
        """One of its scenes as a scene file, every number with all its digits."""
        lines = [f"# {line}" for line in sentence.splitlines()]
        lines += ["[bearing]", f'kind = "{self.kind}"', *_lines(self.bearing, index)]
        for side, table in self.materials.items():
            lines.append(f"{side} = {{ {', '.join(_lines(table, index))} }}")
        lines += ["", "[operation]", *_lines(self.operation, index)]
        if "preload" in self.more:
            lines += ["", "[preload]", *_lines(self.more["preload"], index)]
        lines += ["", "[effects]"]
        lines.append(f"ball = [{', '.join(f'{chr(34)}{effect}{chr(34)}' for effect in self.effects)}]")
        if self.control is not None:
            lines.append(f'raceway_control = "{self.control}"')
        if self.shares is not None:
            lines.append(f'moment_shares = "{self.shares}"')
        for key in ("hertz_angle", "hertz_form", "tilt_lever"):
            lines.append(f'{key} = "{getattr(self, key)}"')
        if self.orbit is not qs.OrbitRadius.PITCH_CIRCLE:
            lines.append(f'orbit_radius = "{self.orbit}"')
        lines += _lines(self.more.get("effects", {}), index)
        for name in ("ring_expansion", "ball_expansion"):
            if name in self.more:
                lines += ["", f"[effects.{name}]", *_lines(self.more[name], index)]
        return "\n".join(lines) + "\n"


def _fields(table: dict[str, NDArray]) -> dict[str, Any]:
    """A table of a scene file as fields of Python."""
    return {_KEYS[key].field: _in_si(_KEYS[key], value) for key, value in table.items()}


def _in_si(key: Key, value: NDArray) -> Any:
    product = key.si(value) if key.zero else value * key.size  # zero keeps its sign
    return product if np.ndim(product) else float(product)


def _lines(table: dict[str, NDArray], index: int) -> list[str]:
    return [f"{key} = {value[index].tolist()!r}" for key, value in table.items()]


def yield_load(bearing: dict[str, NDArray], materials: dict[str, dict[str, NDArray]]) -> NDArray:
    """The load [N] at which all balls of a bearing, equally loaded, reach their static rating."""
    ball, ring = materials["ball_material"], materials["ring_material"]
    modulus = effective_modulus(
        ball["elastic_modulus_GPa"] * 1e3, ball["poisson_ratio"], ring["elastic_modulus_GPa"] * 1e3,
        ring["poisson_ratio"],
    )  # fmt: skip
    product: NDArray = bearing["ball_count"] * YIELD_LOAD * modulus * bearing["ball_diameter_mm"] ** 2
    return product


def one_of(rng: np.random.Generator, choices: Any, weights: Any = None) -> Any:
    """One of these, by weight."""
    return choices[int(rng.choice(len(choices), p=weights))]


def mixture(rng: np.random.Generator, one: NDArray, other: NDArray, share: float) -> NDArray:
    """The first for this share of scenes, the second for the rest."""
    return np.where(rng.random(one.size) < share, one, other)
