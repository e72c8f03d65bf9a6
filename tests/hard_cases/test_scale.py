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
from qsbearing.compiled import COMPILED
from tests.hard_cases.cases import CASES, CONVERGED
from tests.hard_cases.scenes import BY_NAME, scene_of
from tests.qsbearing.scenes import DISPLACEMENTS, LOADS

NAMES = [case["name"] for case in CASES if case["expected"] == CONVERGED]
LENGTHS = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")


def resized(scene: qs.Scene, length: float = 1.0, modulus: float = 1.0, density: float = 1.0) -> qs.Scene:
    """The scene with its sizes, moduli and densities so many times as large, and all else to match."""
    bearing, operation = scene.bearing, scene.operation
    fields: dict[str, Any] = {name: getattr(bearing, name) * length for name in LENGTHS}
    for side, heavier in (("ball_material", density), ("ring_material", 1.0)):
        material = getattr(bearing, side)
        fields[side] = replace(
            material, elastic_modulus=material.elastic_modulus * modulus, density=material.density * heavier
        )
    speed = (modulus / density) ** 0.5 / length
    changes: dict[str, Any] = {name: getattr(operation, name) * speed for name in ("speed", "outer_speed")}
    for i, (load, displacement) in enumerate(zip(LOADS, DISPLACEMENTS, strict=True)):
        if getattr(operation, load) is not None:
            changes[load] = getattr(operation, load) * modulus * length ** (3 if i > 2 else 2)
        if getattr(operation, displacement) is not None:
            changes[displacement] = getattr(operation, displacement) * (1.0 if i > 2 else length)
    return replace(scene, bearing=replace(bearing, **fields), operation=replace(operation, **changes))


def same(one: NDArray, other: NDArray, size: Any = 1.0) -> bool:
    """Whether the first, so many times as large, is the other to the last bit."""
    return np.array_equal(one * size, other, equal_nan=True)


def assert_same_digits(scene: qs.Scene, **sizes: float) -> None:
    """The scene and its resized self: equal angles, equal digits of everything else."""
    changed = resized(scene, **sizes)
    one, other = qs.solve(scene), qs.solve(changed)
    assert one.status == other.status
    assert one.iterations == other.iterations
    assert one.residual == other.residual
    length, modulus = sizes.get("length", 1.0), sizes.get("modulus", 1.0)
    force = modulus * length**2
    assert same(one.displacement, other.displacement, np.array([length, length, length, 1.0, 1.0]))
    assert same(one.load, other.load, force * np.array([1.0, 1.0, 1.0, length, length]))
    for race in ("inner", "outer"):
        a, b = getattr(one, race), getattr(other, race)
        assert same(a.angle, b.angle)
        assert same(a.load, b.load, force)
        assert same(a.approach, b.approach, length)
        assert same(a.semi_major_axis, b.semi_major_axis, length)
        assert same(a.max_pressure, b.max_pressure, modulus)
    assert one.raceway_control is None or list(one.raceway_control) == list(other.raceway_control)
    unit = np.array([1.0, 1.0, 1.0, length, length])
    stiffness = qs.stiffness(scene, one), qs.stiffness(changed, other)
    assert same(stiffness[0], stiffness[1], force / length * np.outer(unit, unit))


@pytest.mark.parametrize("name", NAMES if COMPILED else NAMES[:1])
def test_micro_and_giant(name: str) -> None:
    """Each hard case thirty-two times smaller (micro: eight) and four times larger."""
    scene = scene_of(BY_NAME[name])
    assert_same_digits(scene, length=2.0**-3 if name == "micro" else 2.0**-5)
    assert_same_digits(scene, length=2.0**2)


@pytest.mark.parametrize("name", NAMES[::4] if COMPILED else NAMES[:1])
def test_softer_stiffer_heavier(name: str) -> None:
    """A quarter of the modulus; four times; and balls of half the orbital speed but four times the density."""
    scene = scene_of(BY_NAME[name])
    assert_same_digits(scene, modulus=0.25)
    assert_same_digits(scene, modulus=4.0)
    heavier = 2.0 if name.startswith(("ceramic", "fastest")) else 0.25
    if heavier == 0.25:
        assert_same_digits(scene, density=heavier)


def test_what_is_resized_is_another_scene() -> None:
    """The comparison has something to compare: in other proportions the digits differ."""
    scene = scene_of(BY_NAME["three_balls"])
    slower = replace(scene, operation=replace(scene.operation, speed=0.5 * float(np.asarray(scene.operation.speed))))
    assert not same(qs.solve(scene).inner.angle, qs.solve(slower).inner.angle)
    with pytest.raises(AssertionError):
        one, other = qs.solve(scene), qs.solve(resized(scene, length=3.0))
        assert same(one.inner.load, other.inner.load, 9.0)
