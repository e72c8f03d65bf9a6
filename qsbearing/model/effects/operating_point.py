"""What indicators read of a solved scene: its contacts in a few numbers, and how fast its balls would move.

The solution may lack any effect: its contacts stand for those of the scene with it. Motion is that of a ball whose two
contact angles are alike (Harris & Kotzalas; the equations of `qsbearing.model.kernel.kinematics` at equal angles).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import radians
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

SMALLEST_ANGLE = radians(1.0)
"""Contact angles below it are judged as if they were this large [rad]."""

LIGHT = 0.1
"""Contacts that carry less than this part of the largest load do not count: only their load is read. A ball that light
may soon lose its raceway, where stiffness starts with an infinite slope: errors then grow out of proportion to every
indicator (measured: of 6,500 random scenes without such a ball none erred by more than five times what was predicted,
of the others one in ten)."""


class Contacts(Protocol):
    """All contacts of one raceway, as `qsbearing.model.solution` has them: arrays of shape (*cases, ball)."""

    @property
    def load(self) -> NDArray: ...
    @property
    def angle(self) -> NDArray: ...
    @property
    def sine(self) -> NDArray: ...
    @property
    def cosine(self) -> NDArray: ...
    @property
    def approach(self) -> NDArray: ...
    @property
    def required_friction(self) -> NDArray | None: ...


class Solved(Protocol):
    """What is read here of a solution, which lies above the effects."""

    scene: Any
    shape: tuple[int, ...]

    @property
    def inner(self) -> Contacts: ...
    @property
    def outer(self) -> Contacts: ...
    @property
    def azimuth(self) -> NDArray: ...
    @property
    def displacement(self) -> NDArray: ...
    @property
    def compliance(self) -> NDArray: ...
    @property
    def raceway_control(self) -> NDArray | None: ...
    @property
    def converged(self) -> Any: ...


@dataclass(frozen=True)
class OperatingPoint:
    """A solution as indicators read it; arrays of shape (*cases) unless said otherwise, SI and radians."""

    solution: Solved
    requested: Any = None
    """A scene with everything whose influence is asked for, parameters included; None: the solution's own."""

    @property
    def full_scene(self) -> Any:
        """The scene that says with which parameters an effect is asked for, whether the solution has it or not."""
        return self.scene if self.requested is None else self.requested

    @property
    def scene(self) -> Any:
        """The scene of the solution."""
        return self.solution.scene

    @property
    def bearing(self) -> Any:
        """The bearing in operation."""
        return self.scene.operating_bearing

    @property
    def axial_is_held(self) -> bool:
        """Whether the ring keeps its axial position, whatever changes."""
        scene = self.scene
        rigid = scene.preload is not None and scene.preload.kind != "spring"
        return rigid or scene.operation.axial_displacement is not None

    @cached_property
    def load(self) -> NDArray:
        """Inner contact loads (*cases, ball); zero where there is no ball."""
        return np.nan_to_num(self.solution.inner.load)

    @cached_property
    def largest_load(self) -> NDArray:
        """Of the inner contacts [N]."""
        return self.load.max(axis=-1)

    @cached_property
    def is_heavy(self) -> NDArray:
        """Which inner contacts count (*cases, ball)."""
        return self.load > LIGHT * self.largest_load[..., None]

    @cached_property
    def has_light_ball(self) -> NDArray:
        """Whether some ball carries so little that no indicator can be trusted; also where a case is not solved."""
        is_there = np.isfinite(self.solution.azimuth)
        light = (is_there & ~self.is_heavy).any(axis=-1)
        return np.asarray(light | ~np.asarray(self.solution.converged))

    def over_load(self, force: Any) -> NDArray:
        """A force (*cases) over each inner contact load that counts (*cases, ball); zero for the others."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.is_heavy, np.asarray(force)[..., None] / self.load, 0.0)

    def at_largest_load(self, array: NDArray) -> NDArray:
        """The entry (*cases) of an array (*cases, ball) that belongs to the most loaded inner contact."""
        top = np.argmax(self.load, axis=-1)[..., None]
        return np.take_along_axis(array, top, axis=-1)[..., 0]

    @cached_property
    def angle(self) -> NDArray:
        """Contact angle of the most loaded inner contact."""
        return self.at_largest_load(self.solution.inner.angle)

    @cached_property
    def diameter_ratio(self) -> NDArray:
        """g = D/dm."""
        bearing = self.bearing
        return np.asarray(bearing.ball_diameter, float) / np.asarray(bearing.pitch_diameter, float)

    @cached_property
    def ring_speeds(self) -> tuple[NDArray, NDArray]:
        """Of inner and outer ring [rad/s]."""
        operation = self.scene.operation
        outer = 0.0 if operation.outer_speed is None else operation.outer_speed
        return np.asarray(operation.speed, float), np.asarray(outer, float)

    @cached_property
    def orbital_speed(self) -> NDArray:
        """Of the most loaded ball's centre [rad/s]."""
        inner, outer = self.ring_speeds
        g = self.diameter_ratio * np.cos(self.angle)
        return np.asarray(0.5 * (inner * (1.0 - g) + outer * (1.0 + g)))

    @cached_property
    def rotation(self) -> tuple[NDArray, NDArray]:
        """(omega_R, beta) of the most loaded ball under outer raceway control: signed, [rad/s], and its attitude."""
        inner, outer = self.ring_speeds
        g, gamma = self.diameter_ratio * np.cos(self.angle), self.diameter_ratio
        attitude = np.arctan2(np.sin(self.angle), np.cos(self.angle) + gamma)
        # Along the contact line itself the speed is the rolling one; about the axis tilted from it, 1/cos of it.
        rolling = 0.5 * (outer - inner) / gamma * (1.0 - g * g)
        return rolling / np.cos(attitude - self.angle), attitude
