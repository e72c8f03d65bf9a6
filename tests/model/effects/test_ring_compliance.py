"""Compliances of rings: printed values, textbook cases, limits, and relations that define them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from qsbearing.model.effects.ring_compliance import (
    MOST_HARMONICS,
    Annulus,
    by_load,
    inner_ring_compliance,
    of_section,
    outer_ring_compliance,
    rim_compliances,
)

E, NU = 208e9, 0.3
PRINTED = {
    (73.863e-3, 80e-3): "4.565170e-12 9.372514e-10 1.326635e-10 3.808272e-11 1.505310e-11 7.181628e-12 2.300791e-12",
    (99e-3, 101e-3): "2.394325e-11 7.935083e-08 1.116320e-08 3.177101e-09 1.241955e-09 5.844898e-10 1.808058e-10",
}
"""u_n/p_n [m/Pa] for n = 0, 2, 3, 4, 5, 6, 8 as computed elsewhere from the same theory, to seven digits."""
RADII = st.tuples(st.floats(0.05, 0.98), st.floats(0.01, 0.5), st.floats(0.0, 0.45))
HOLLOW = st.just(0.0) | st.floats(1e-3, 0.9)


@pytest.mark.parametrize("radii", PRINTED)
def test_printed_values(radii: tuple[float, float]) -> None:
    """To the last printed digit."""
    compliance = outer_ring_compliance(Annulus(*radii, E, NU), None).groove
    assert [f"{compliance[n]:.6e}" for n in (0, 2, 3, 4, 5, 6, 8)] == PRINTED[radii].split()


def test_thin_ring_bends_as_a_bar() -> None:
    """u_n = p_n B R^4/(E I (n^2 - 1)^2), from which a ring departs with the square of h/R."""
    radius, n = 0.1, np.arange(2, 7)
    errors = []
    for thickness in (2e-3, 1e-3):
        compliance = outer_ring_compliance(Annulus(radius - thickness / 2, radius + thickness / 2, E, NU), None).groove[
            2:7
        ]
        thin = radius**4 / (E * thickness**3 / 12.0 * (n**2 - 1.0) ** 2)
        errors.append(abs(compliance / thin - 1.0))
    assert np.all(errors[1] < 0.02)
    assert np.all(errors[1] < 0.6 * errors[0])


def test_two_opposed_loads() -> None:
    """Timoshenko, Strength of Materials: they change the diameter by (pi/4 - 2/pi) P R^3/(E I)."""
    radius, thickness, width = 0.1, 1e-4, 0.01
    ring = Annulus(radius - thickness / 2, radius + thickness / 2, E, NU)
    c = by_load(outer_ring_compliance(ring, None).groove, ring.a, width)
    n = np.arange(len(c))
    diameter = 2.0 * np.sum((c * (1.0 + (-1.0) ** n))[2:])
    bar = radius**3 / (E * width * thickness**3 / 12.0)
    assert diameter / bar == pytest.approx(np.pi / 4 - 2 / np.pi, rel=3e-4)  # what is beyond n = 24, and (h/R)


@given(RADII)
def test_reciprocity(sizes: tuple[float, float, float]) -> None:
    """Maxwell and Betti: the work of one rim's pressure on the displacements by the other's is the same both ways."""
    ratio, outside, poisson = sizes
    found = rim_compliances(Annulus(ratio * outside, outside, E, poisson))
    one, other = found.bore_by_outside * ratio, -found.outside_by_bore
    scale = np.maximum(abs(found.bore_by_bore), abs(found.outside_by_outside))
    assert np.all(abs(one - other) <= 1e-6 * scale)


@given(RADII)
def test_ring_in_housing_of_its_own_material_grows_as_one(sizes: tuple[float, float, float]) -> None:
    """Uniform growth has no shear: a ring cut in two at any radius is the same ring; so is a shaft in a ring."""
    ratio, outside, poisson = sizes
    bore, cut = ratio * outside, 0.5 * (1.0 + ratio) * outside
    whole = Annulus(bore, outside, E, poisson)
    inside, around = Annulus(bore, cut, E, poisson), Annulus(cut, outside, E, poisson)
    assert outer_ring_compliance(inside, around).groove[0] == pytest.approx(
        outer_ring_compliance(whole, None).groove[0], rel=1e-9, abs=0.0
    )
    assert inner_ring_compliance(around, inside).groove[0] == pytest.approx(
        inner_ring_compliance(whole, None).groove[0], rel=1e-9, abs=0.0
    )
    disk = inner_ring_compliance(around, Annulus(0.0, cut, E, poisson)).groove[0]
    assert disk == pytest.approx(outside * (1.0 - poisson) / E, rel=1e-9, abs=0.0)


@given(RADII, HOLLOW)
def test_any_seat_stiffens(sizes: tuple[float, float, float], hollow: float) -> None:
    """Every harmonic deflects less in a housing or on a shaft than free, and a seat that is endlessly stiff least."""
    ratio, outside, poisson = sizes
    ring = Annulus(ratio * outside, outside, E, poisson)
    loads = np.r_[0, 2 : MOST_HARMONICS + 1]

    def least_to_most(one: NDArray, *others: NDArray) -> None:
        for softer in others:
            assert np.all(one[loads] <= softer[loads] * (1.0 + 1e-6))
            one = softer

    def housing(modulus: float) -> Annulus:
        return Annulus(outside, 1.5 * outside, modulus, poisson)

    def shaft(modulus: float) -> Annulus:
        return Annulus(hollow * ring.a, ring.a, modulus, poisson)

    compliances = [
        outer_ring_compliance(ring, each).groove for each in (housing(1e3 * E), housing(E), housing(0.1 * E), None)
    ]
    least_to_most(*compliances)
    assert np.all(compliances[0][loads] > 0.0)
    compliances = [
        inner_ring_compliance(ring, each).groove for each in (shaft(1e3 * E), shaft(E), shaft(0.1 * E), None)
    ]
    least_to_most(*compliances)
    assert np.all(compliances[0][loads] > 0.0)


def test_solid_shaft_is_the_limit_of_a_small_bore() -> None:
    """In bending, where a small hole hardly matters."""
    ring = Annulus(0.045, 0.052, E, NU)
    solid = inner_ring_compliance(ring, Annulus(0.0, 0.045, E, NU))
    hollow = inner_ring_compliance(ring, Annulus(1e-4 * 0.046, 0.045, E, NU))
    np.testing.assert_allclose(hollow.groove[2:], solid.groove[2:], rtol=1e-5)
    np.testing.assert_allclose(hollow.seat[2:], solid.seat[2:], rtol=1e-5)


def test_cases_are_as_each_alone() -> None:
    """Arrays over cases, solid and hollow shafts among them."""
    bores = np.array([0.0, 0.02, 0.03])
    ring = Annulus(0.045, 0.052, E, NU)
    together = inner_ring_compliance(ring, Annulus(bores, 0.045, E, NU))
    for k, bore in enumerate(bores):
        alone = inner_ring_compliance(ring, Annulus(bore, 0.045, E, NU))
        np.testing.assert_allclose(together.groove[:, k], alone.groove, rtol=1e-12)


def test_what_is_left_of_bending_without_local_compression() -> None:
    """A half-plane's part goes, which high harmonics of any body have in common."""
    ring = Annulus(73.863e-3, 80e-3, E, NU)
    compliance = outer_ring_compliance(ring, None).groove
    left = of_section(compliance, ring.a, E)
    assert left[:3] == pytest.approx(compliance[:3], rel=5e-4, abs=0.0)
    assert left[0] == compliance[0]
    # Thin beside its harmonics' lengths the ring bends; where they are as short as it is thick, it hardly does.
    assert left[16] > 0.5 * compliance[16]
    assert left[24] < 0.5 * compliance[24]
    narrow = by_load(left, ring.a, 0.01)
    assert narrow[13:].sum() < 1.5e-3 * narrow.sum()
    solid = inner_ring_compliance(Annulus(0.045, 0.052, E, NU), Annulus(0.0, 0.045, E, NU)).groove
    half_plane = 2 * 0.052 / (E * np.arange(16, 25))
    np.testing.assert_allclose(solid[16:], half_plane, rtol=0.1)  # wavelengths of a fifth of the shaft
    assert np.all(of_section(solid, 0.052, E)[16:] < 0.1 * half_plane)
