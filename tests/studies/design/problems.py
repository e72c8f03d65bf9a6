"""Ten searches over bearings, each a second time for scipy's differential evolution on `qs.solve`.

What is asked for stands once in the words of `qs.find` and once as Python on a solution: the second knows nothing of
keys, names, units of files and of how a search ranks its points.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs

SPINDLE: dict[str, Any] = {
    "bearing": {"name": "7210C_hybrid"},
    "operation": {"speed_rpm": 18000.0, "radial_load_y_N": 300.0, "tilt_z_mrad": 0.0},
    "preload": {"rigid_N": 300.0},
    "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"},
}

PRINTED_RATING = 47_500.0
"""C in N: GMN, catalogue 4000 0813 EN, row HY S 6210 C TA."""


def scene(
    rigid: Any = 300.0, speed: Any = 18000.0, balls: Any = 15, diameter: Any = 12.7, f: Any = 6.58 / 12.7,
    angle: Any = 15.0,
) -> qs.Scene:  # fmt: skip
    """The spindle bearing with these numbers, which may be arrays, from Python's objects alone."""
    bearing = qs.BallBearing(
        balls, diameter * 1e-3, 70e-3, f * diameter * 1e-3, f * diameter * 1e-3, np.radians(angle),
        ball_material=qs.SILICON_NITRIDE,
    )  # fmt: skip
    operation = qs.Operation(speed=speed * np.pi / 30.0, radial_load_y=300.0, tilt_z=0.0)
    effects = (qs.CentrifugalForce(), qs.GyroscopicMoment())
    control = qs.RacewayControl.OUTER
    return qs.Scene(bearing, operation, preload=qs.Preload(rigid=rigid), ball_effects=effects, raceway_control=control)


def stiffness(solution: qs.Solution) -> NDArray:
    return np.asarray(solution.effective_stiffness[..., 1] / 1e6)


def axial(solution: qs.Solution) -> NDArray:
    return np.asarray(solution.locked_stiffness[..., 0] / 1e6)


def pressure(solution: qs.Solution) -> NDArray:
    return np.asarray(solution.inner.max_pressure.max(axis=-1) / 1e6)


def friction(solution: qs.Solution) -> NDArray:
    return np.asarray(solution.outer.required_friction.max(axis=-1))


def least_load(solution: qs.Solution) -> NDArray:
    return np.asarray(solution.inner.load.min(axis=-1))


def life(solution: qs.Solution) -> NDArray:
    """With the rating that the catalogue prints of the bearing."""
    return np.asarray(qs.readings.life(solution, dynamic_load_rating=PRINTED_RATING).basic_duration / 3600.0)


def life_of_geometry(solution: qs.Solution) -> NDArray:
    """Of a bearing that no catalogue has."""
    return np.asarray(qs.readings.life(solution).basic_duration / 3600.0)


Result = Callable[[qs.Solution], NDArray]


@dataclass(frozen=True)
class Problem:
    """A search in words, and the same as functions; variables in the order of `scene`'s arguments named here."""

    vary: dict[str, Any]
    arguments: Sequence[str]
    goals: dict[str, tuple[Result, float]] = dataclasses.field(default_factory=dict)
    most: dict[str, tuple[Result, float]] = dataclasses.field(default_factory=dict)
    least: dict[str, tuple[Result, float]] = dataclasses.field(default_factory=dict)
    minimise: tuple[str, Result] | None = None
    maximise: tuple[str, Result] | None = None
    is_feasible: bool = True

    @property
    def words(self) -> dict[str, Any]:
        """The arguments of `qs.find`."""
        return {
            "goals": [f"{name}={value}" for name, (_, value) in self.goals.items()],
            "limits": [f"{name}<={value}" for name, (_, value) in self.most.items()]
            + [f"{name}>={value}" for name, (_, value) in self.least.items()],
            "minimise": self.minimise and self.minimise[0],
            "maximise": self.maximise and self.maximise[0],
        }

    def solved(self, values: NDArray) -> qs.Solution:
        """At values of the variables, shape (variable,) or (variable, point)."""
        return qs.solve(scene(**dict(zip(self.arguments, values, strict=True))))

    def violation(self, solution: qs.Solution) -> NDArray:
        """The largest of all goals and limits, as a part of its value."""
        parts = [np.abs(of(solution) / value - 1.0) for of, value in self.goals.values()]
        parts += [of(solution) / value - 1.0 for of, value in self.most.values()]
        parts += [1.0 - of(solution) / value for of, value in self.least.values()]
        return np.maximum(np.max(parts, axis=0), 0.0)

    def cost(self, solution: qs.Solution) -> NDArray:
        """What differential evolution makes small, without the penalty."""
        if self.minimise:
            return self.minimise[1](solution)
        return -self.maximise[1](solution) if self.maximise else np.zeros(solution.shape)


RIGID = {"rigid_N": "10:2500"}
LIFE, PRESSURE, STIFF = "life.basic_duration_h", "inner.max_pressure_MPa", "effective_stiffness_radial_y"
FRICTION = "outer.required_friction"
BALLS = [9.525, 10.319, 11.112, 11.906, 12.7]

PROBLEMS = {
    "stiffness by preload": Problem(
        RIGID, ["rigid"], {STIFF: (stiffness, 200.0)}, {PRESSURE: (pressure, 1700.0)}, {LIFE: (life, 1e4)}
    ),
    "two stiffnesses": Problem(
        RIGID | {"free_contact_angle_deg": "12:30"}, ["rigid", "angle"],
        {STIFF: (stiffness, 250.0), "locked_stiffness_axial": (axial, 120.0)},
    ),
    "stiffest at any speed": Problem(
        RIGID | {"speed_rpm": "1000:30000"}, ["rigid", "speed"],
        most={PRESSURE: (pressure, 1400.0), FRICTION: (friction, 0.01)}, least={LIFE: (life, 2e4)},
        maximise=(STIFF, stiffness),
    ),
    "fastest": Problem(
        RIGID | {"speed_rpm": "1000:40000"}, ["rigid", "speed"],
        most={FRICTION: (friction, 0.03)}, least={STIFF: (stiffness, 250.0), LIFE: (life, 5e3)},
        maximise=("orbital_speed", lambda solution: solution.orbital_speed.min(axis=-1) * 30.0 / np.pi),
    ),
    "gentlest": Problem(
        RIGID | {"groove_radius_coefficient": "0.51:0.56"}, ["rigid", "f"],
        least={STIFF: (stiffness, 220.0)}, most={FRICTION: (friction, 0.04)}, minimise=(PRESSURE, pressure),
    ),
    "ball count": Problem(
        RIGID | {"ball_count": "10:16"}, ["rigid", "balls"],
        least={STIFF: (stiffness, 230.0)}, maximise=(LIFE, life_of_geometry),
    ),
    "ball from a list": Problem(
        RIGID | {"ball_diameter_mm": BALLS, "groove_radius_coefficient": "0.515:0.54"}, ["rigid", "diameter", "f"],
        most={PRESSURE: (pressure, 1500.0)}, least={LIFE: (life_of_geometry, 3e4)}, maximise=(STIFF, stiffness),
    ),
    "loaded balls": Problem(
        {"rigid_N": "10:2500:log", "free_contact_angle_deg": "12:30", "groove_radius_coefficient": "0.515:0.54"},
        ["rigid", "angle", "f"], least={"inner_load": (least_load, 40.0), STIFF: (stiffness, 240.0)},
        minimise=(FRICTION, friction),
    ),
    "too stiff": Problem(
        RIGID, ["rigid"], {STIFF: (stiffness, 600.0)}, {PRESSURE: (pressure, 1500.0)}, is_feasible=False
    ),
    "too long a life": Problem(
        RIGID | {"speed_rpm": "8000:30000"}, ["rigid", "speed"],
        least={LIFE: (life, 1e6), STIFF: (stiffness, 300.0)}, is_feasible=False,
    ),
}  # fmt: skip
