"""Thick rings against the equations that define them, and against closed forms of machine-element books."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from qsbearing.model.effects.annulus import Elastic, PlaneStress, displacement, stress_by_pressure, stress_by_rotation

STEEL = Elastic(208e9, 0.3, 7800.0)
SIZES = st.tuples(st.floats(0.0, 0.9), st.floats(0.02, 0.98), st.floats(-3e8, 3e8), st.floats(-3e8, 3e8))


def derivative(function: Any, radius: float) -> float:
    """Exact to rounding: a complex step loses nothing to a difference."""
    return float(np.imag(function(radius + 1e-30j)) / 1e-30)


@given(SIZES, st.floats(0.0, 5e3), st.floats(0.0, 0.49))
def test_equilibrium_compatibility_and_boundaries(
    sizes: tuple[float, float, float, float], speed: float, poisson: float
) -> None:
    """What defines the solution: forces on an element in rotation balance, strains come from one displacement, the
    surfaces carry the pressures. Each to rounding of the largest stress."""
    ratio, place, inner, outer = sizes
    b = 0.08
    a = ratio * b
    material = Elastic(208e9, poisson, 7800.0)

    def stress(radius: Any) -> PlaneStress:
        one = stress_by_pressure(radius, a, b, inner if ratio > 0.0 else 0.0, outer)
        other = stress_by_rotation(radius, a, b, speed, material)
        return PlaneStress(one.radial + other.radial, one.hoop + other.hoop)

    r = a + place * (b - a)
    radial, hoop = stress(r)
    scale = 1e-9 * (1.0 + abs(inner) + abs(outer) + 7800.0 * (speed * b) ** 2) / (1.0 - ratio) ** 2
    assert r * derivative(lambda x: stress(x).radial, r) + radial - hoop + 7800.0 * speed**2 * r**2 == pytest.approx(
        0.0, abs=scale
    )
    strain = derivative(lambda x: displacement(x, stress(x), material), r)
    assert 208e9 * strain == pytest.approx(radial - poisson * hoop, abs=scale)
    assert stress(b).radial == pytest.approx(-outer, abs=scale)
    if ratio > 0.01:
        assert stress(a).radial == pytest.approx(-inner, abs=scale)


def test_a_thin_ring_is_a_membrane() -> None:
    """Hoop stress p r/t and rho v^2; the thickness is what is neglected, so the error is about t/r."""
    a, b = 0.05, 0.05 * 1.001
    assert stress_by_pressure(a, a, b, 1e6, 0.0).hoop == pytest.approx(1e6 * 0.05 / 5e-5, rel=1e-3)
    assert stress_by_rotation(a, a, b, 2e3, STEEL).hoop == pytest.approx(7800.0 * (2e3 * 0.05) ** 2, rel=2e-3)


def test_a_small_hole_doubles_the_stress_of_a_rotating_disk() -> None:
    """Timoshenko & Goodier on rotating disks: at a small hole twice the stress at the centre of a solid one."""
    b = 0.1
    solid = stress_by_rotation(1e-9, 0.0, b, 1e3, STEEL)
    pierced = stress_by_rotation(1e-6, 1e-6, b, 1e3, STEEL)
    assert solid.radial == pytest.approx(solid.hoop, rel=1e-12)
    assert solid.hoop == pytest.approx((3 + 0.3) / 8 * 7800.0 * 1e6 * b**2, rel=1e-12)
    assert pierced.hoop == pytest.approx(2.0 * solid.hoop, rel=1e-6)
