"""The same scene in other sizes: the same digits, to the last bit where the change of size is exact.

With lengths a power of two times as large, loads its square, moments its cube and speeds its inverse times, nothing
without dimension changes; neither does it with moduli a power of four times as large and loads with them, speeds the
power's root, or with denser balls at lower speed. Powers of two make the change itself exact in floating point.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.qsbearing.scenes import DISPLACEMENTS, LOADS, general_scenes
from tests.verification.hard_cases.cases import CASES, CONVERGED
from tests.verification.hard_cases.scenes import scene_of

GENERAL = general_scenes()
HARD = [case["name"] for case in CASES if case["expected"] == CONVERGED]
NAMES = [*GENERAL, *HARD] if has_fast_code() else list(GENERAL)[:1]
LENGTHS = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")


def resized(scene: qs.Scene, length: float, modulus: float, density: float) -> qs.Scene:
    """The scene with its sizes, moduli and densities so many times as large, and all else to match."""
    bearing, operation = scene.bearing, scene.operation
    fields: dict[str, Any] = {name: getattr(bearing, name) * length for name in LENGTHS}
    for side, heavier in (("ball_material", density), ("ring_material", 1.0)):
        material = getattr(bearing, side)
        fields[side] = replace(
            material, elastic_modulus=material.elastic_modulus * modulus, density=material.density * heavier
        )
    speed = (modulus / density) ** 0.5 / length
    changes: dict[str, Any] = {
        name: getattr(operation, name) * speed
        for name in ("speed", "outer_speed")
        if getattr(operation, name) is not None
    }
    for i, (load, displacement) in enumerate(zip(LOADS, DISPLACEMENTS, strict=True)):
        if getattr(operation, load) is not None:
            changes[load] = getattr(operation, load) * modulus * length ** (3 if i > 2 else 2)
        if getattr(operation, displacement) is not None:
            changes[displacement] = getattr(operation, displacement) * (1.0 if i > 2 else length)
    return replace(scene, bearing=replace(bearing, **fields), operation=replace(operation, **changes))


def same(one: NDArray, other: NDArray, size: Any = 1.0) -> bool:
    """Whether the first, so many times as large, is the other to the last bit."""
    return np.array_equal(one * size, other, equal_nan=True)


# Smaller, larger, softer, lighter; no size, modulus or density leaves the range that a scene may have.
CHANGES = ((0.125, 1.0, 1.0), (4.0, 1.0, 1.0), (1.0, 0.25, 1.0), (0.5, 0.25, 0.25))


@pytest.mark.parametrize("name", NAMES)
def test_the_same_digits(name: str) -> None:
    """Equal angles, iterations and residuals, equal digits of everything else."""
    scene = GENERAL[name] if name in GENERAL else scene_of(name)
    one = qs.solve(scene)
    stiffness = qs.stiffness(scene, one)
    for length, modulus, density in CHANGES:
        other = qs.solve(resized(scene, length, modulus, density))
        assert (one.status, one.iterations, one.residual) == (other.status, other.iterations, other.residual)
        force, unit = modulus * length**2, np.array([1.0, 1.0, 1.0, length, length])
        assert same(one.displacement, other.displacement, length / unit)
        assert same(one.load, other.load, force * unit)
        for race in ("inner", "outer"):
            a, b = getattr(one, race), getattr(other, race)
            assert same(a.angle, b.angle)
            assert same(a.load, b.load, force)
            assert same(a.approach, b.approach, length)
            assert same(a.semi_major_axis, b.semi_major_axis, length)
            assert same(a.max_pressure, b.max_pressure, modulus)
        assert one.raceway_control is None or list(one.raceway_control) == list(other.raceway_control)
        assert same(stiffness, qs.stiffness(other.scene, other), force / length * np.outer(unit, unit))
