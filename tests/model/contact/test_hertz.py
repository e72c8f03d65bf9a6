"""Hertz's contact against the classical equations at forty digits, against textbook values, and at its limits.

The classical equation is ((k^2+1) E - 2 K)/((k^2-1) E) = (B - A)/(B + A) with A <= B the curvatures of the gap
(K. L. Johnson, Contact Mechanics, 4.2; Harris & Kotzalas). mpmath solves it here by bisection, with its own elliptic
integrals and none of the package's rearrangement.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp

import qsbearing as qs
from qsbearing.model.contact.elliptic import both_parts, second_kind
from qsbearing.model.contact.hertz import FORM_CODES, contact_shape, stiffness_at_angle
from tests.qsbearing.scenes import B218

DIGITS = 40
MODULUS = 2.2e11
ELLIPTICITIES = ["1.0000001", "1.001", "1.1", "2", "5", "8.155", "30", "100", "300", "1000"]


@cache
def curvature_ratio(k: str) -> Any:
    """A/B of the ellipse k = a/b, from the classical equation."""
    with mp.workdps(DIGITS):
        k2 = mp.mpf(k) ** 2
        m = 1 - 1 / k2
        K, E = mp.ellipk(m), mp.ellipe(m)
        difference = ((k2 + 1) * E - 2 * K) / ((k2 - 1) * E)
        return (1 - difference) / (1 + difference)


def classical(k: str, load: Any, larger: Any, modulus: Any) -> tuple[Any, Any, Any, Any]:
    """(a, b, approach, p0) by the classical formulas, at forty digits."""
    with mp.workdps(DIGITS):
        kk, load, larger, modulus = mp.mpf(k), mp.mpf(load), mp.mpf(larger), mp.mpf(modulus)
        m = 1 - 1 / kk**2
        K, E = mp.ellipk(m), mp.ellipe(m)
        total = larger * (1 + curvature_ratio(k))
        a = mp.cbrt(6 * kk**2 * E * load / (mp.pi * total * modulus))
        b = a / kk
        approach = K * mp.cbrt(9 * total / (2 * E) * (load / (mp.pi * kk * modulus)) ** 2)
        return a, b, approach, 3 * load / (2 * mp.pi * a * b)


# Rounding of some dozens of operations; near the circle A/B itself cancels no digit of the answer.
ROUNDING = 2e-14


@pytest.mark.parametrize("k", ELLIPTICITIES)
def test_exact_contact_from_circle_to_needle(k: str) -> None:
    """Semi-axes, approach and pressure for k from 1 to 1000."""
    larger = 190.0
    smaller = float(mp.mpf(larger) * curvature_ratio(k))
    contact = qs.point_contact(1234.5, larger, smaller, MODULUS)
    # The larger k, the less the curvature's own rounding shifts it; near the circle k - 1 goes with the square root.
    a, b, approach, pressure = classical(k, "1234.5", larger, MODULUS)
    assert contact.semi_major_axis == pytest.approx(float(a), rel=ROUNDING)
    assert contact.semi_minor_axis == pytest.approx(float(b), rel=ROUNDING)
    assert contact.approach == pytest.approx(float(approach), rel=ROUNDING)
    assert contact.max_pressure == pytest.approx(float(pressure), rel=ROUNDING)
    assert contact.ellipticity == pytest.approx(float(k), rel=ROUNDING)
    assert contact.stiffness_constant * contact.approach**1.5 == pytest.approx(1234.5, rel=ROUNDING)


def test_circle() -> None:
    """Equal curvatures: a^3 = 3 Q R/(4 E*), delta = a^2/R, with E* = E'/2 (Johnson, 4.22-4.24)."""
    curvature = 50.0
    contact = qs.point_contact(800.0, curvature, curvature, MODULUS)
    radius = (3.0 * 800.0 / (4.0 * curvature * MODULUS / 2.0)) ** (1.0 / 3.0)
    assert contact.semi_major_axis == pytest.approx(radius, rel=ROUNDING)
    assert contact.semi_minor_axis == pytest.approx(radius, rel=ROUNDING)
    assert contact.approach == pytest.approx(radius**2 * curvature, rel=ROUNDING)
    assert contact.max_pressure == pytest.approx(1.5 * 800.0 / (np.pi * radius**2), rel=ROUNDING)


@pytest.mark.parametrize("departure", [1e-15, 1e-12, 1e-9, 1e-6, 1e-4])
def test_the_circle_is_approached_smoothly(departure: float) -> None:
    """Just off the circle k - 1 = (2/3) x the departure of the curvature ratio, nothing jumps."""
    contact = qs.point_contact(800.0, 50.0 * (1.0 + departure), 50.0, MODULUS)
    # Of first order; the rest is of second order and rounding.
    assert contact.ellipticity - 1.0 == pytest.approx(2.0 / 3.0 * departure, abs=departure**2 + 5e-15)


@given(ratio=st.floats(1e-6, 1.0), load=st.floats(1e-3, 1e6))
def test_swapped_curvatures(ratio: float, load: float) -> None:
    """The two planes are equal before Hertz: the same contact, bit for bit."""
    assert qs.point_contact(load, 100.0, 100.0 * ratio, MODULUS) == qs.point_contact(
        load, 100.0 * ratio, 100.0, MODULUS
    )


@given(ratio=st.floats(1e-6, 1.0), load=st.floats(1.0, 1e5), factor=st.floats(1.1, 10.0))
def test_powers_of_the_load(ratio: float, load: float, factor: float) -> None:
    """Semi-axes and pressure as Q^(1/3), approach as Q^(2/3), the constant not at all."""
    one, more = (qs.point_contact(Q, 100.0, 100.0 * ratio, MODULUS) for Q in (load, factor * load))
    assert more.semi_major_axis / one.semi_major_axis == pytest.approx(factor ** (1 / 3), rel=1e-13)
    assert more.max_pressure / one.max_pressure == pytest.approx(factor ** (1 / 3), rel=1e-13)
    assert more.approach / one.approach == pytest.approx(factor ** (2 / 3), rel=1e-13)
    assert more.stiffness_constant == one.stiffness_constant


@pytest.mark.parametrize("kc", ["1", "0.9999999999", "0.99", "0.5", "0.1", "1e-3", "1e-6"])
def test_elliptic_integrals(kc: str) -> None:
    """B, D, their sum K, and E by the complementary modulus, against mpmath at forty digits."""
    with mp.workdps(DIGITS):
        modulus = mp.mpf(kc)
        m = 1 - modulus**2
        K, E = mp.ellipk(m), mp.ellipe(m)
        D = (K - E) / m if m else mp.pi / 4
        expected = (K - D, D, K, E)
    B, D = both_parts(float(kc))
    for found, value in zip((B, D, B + D, second_kind(float(kc))), expected, strict=True):
        assert found == pytest.approx(float(value), rel=2e-15)  # some units of rounding


# --------------------------------------------------------------------------------------------------------- closed forms


def contacts_of_b218(form: qs.HertzForm, cosine: float) -> tuple[float, float]:
    """Deflection per load^(2/3) of B218's inner and outer contact."""
    values = []
    for side in (-1, 1):
        f = 11.6281 / 22.225
        K, _ = stiffness_at_angle(FORM_CODES[form], 22.225e-3, 125.26e-3, f, 1e11, np.sqrt(1 - cosine**2), cosine, side)
        values.append(K ** (-2.0 / 3.0))
    return values[0], values[1]


@pytest.mark.parametrize(
    ("form", "inner", "outer"),
    [(qs.HertzForm.BREWE_HAMROCK_1977, -0.0069, -0.0027), (qs.HertzForm.HAMROCK_BREWE_1983, -0.0029, 0.0034)],
)
def test_closed_forms_for_b218(form: qs.HertzForm, inner: float, outer: float) -> None:
    """What the fits cost for B218: the earlier one 0.7 % in deflection, the later one 0.3 %."""
    exact, fitted = contacts_of_b218(qs.HertzForm.EXACT, 0.766044), contacts_of_b218(form, 0.766044)
    errors = [f / e - 1.0 for f, e in zip(fitted, exact, strict=True)]
    assert errors == pytest.approx([inner, outer], abs=0.00005)


@pytest.mark.parametrize(
    ("form", "at_circle", "worst"),
    [(qs.HertzForm.BREWE_HAMROCK_1977, -0.054, 0.054), (qs.HertzForm.HAMROCK_BREWE_1983, 0.0, 0.031)],
)
def test_closed_forms_within_their_known_errors(form: qs.HertzForm, at_circle: float, worst: float) -> None:
    """From the circle to k = 15: the earlier fit misses the circle by 5.4 % in deflection, the later one meets it."""
    errors = []
    for k in np.geomspace(1.0001, 15.0, 60):
        ratio = float(curvature_ratio(repr(float(k))))
        exact = qs.point_contact(1.0, 100.0, 100.0 * ratio, MODULUS).approach
        fitted = qs.point_contact(1.0, 100.0, 100.0 * ratio, MODULUS, form).approach
        errors.append(fitted / exact - 1.0)
    assert errors[0] == pytest.approx(at_circle, abs=0.0005)
    assert np.abs(errors).max() == pytest.approx(worst, abs=0.0005)


@pytest.mark.parametrize("ratio", [1.5, 20.0, 300.0])
def test_closed_forms_are_as_published(ratio: float) -> None:
    """Brewe & Hamrock 1977 and Hamrock & Brewe 1983, written out: k, and both integrals."""
    k, K, E, _ = contact_shape(FORM_CODES[qs.HertzForm.BREWE_HAMROCK_1977], 1.0 / ratio)
    assert k == pytest.approx(1.0339 * ratio**0.636, rel=1e-15)
    assert pytest.approx(1.5277 + 0.6023 * np.log(ratio), rel=1e-15) == K
    assert pytest.approx(1.0003 + 0.5968 / ratio, rel=1e-15) == E
    k, K, E, _ = contact_shape(FORM_CODES[qs.HertzForm.HAMROCK_BREWE_1983], 1.0 / ratio)
    assert k == pytest.approx(ratio ** (2 / np.pi), rel=1e-15)
    assert pytest.approx(np.pi / 2 + (np.pi / 2 - 1) * np.log(ratio), rel=1e-15) == K
    assert pytest.approx(1 + (np.pi / 2 - 1) / ratio, rel=1e-15) == E


# --------------------------------------------------------------------------------------------- in a groove, at an angle


@pytest.mark.parametrize("form", list(qs.HertzForm))
@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("f", [0.5000001, 0.52, 1.0])
def test_stiffness_changes_with_the_angle_as_differences_say(f: float, side: int, form: qs.HertzForm) -> None:
    """d(ln K)/d(alpha) against central differences of fourth order, over all angles of either sign."""
    step = 2e-3

    def stiffness(angle: float) -> tuple[float, float]:
        arguments = (22.225e-3, 125.26e-3, f, 2.2e11, np.sin(angle), np.cos(angle), side)
        return stiffness_at_angle(FORM_CODES[form], *arguments)

    for angle in (-0.6, 0.0, 0.3, 0.7, 1.2):
        value, slope = stiffness(angle)
        far, near = (stiffness(angle + n * step)[0] - stiffness(angle - n * step)[0] for n in (2, 1))
        assert slope == pytest.approx((8.0 * near - far) / (12.0 * step) / value, abs=1e-10)  # rounding over the step


def test_stiffness_at_the_free_angle_is_the_contact() -> None:
    """The kernel's stiffness of a groove is that of the contact with the groove's two curvatures."""
    for side, printed in ((-1, 4.1097262e10), (1, 4.2748637e10)):
        cosine = np.cos(40 * qs.deg)
        rolling = 2.0 / (22.225e-3 * (1.0 + side * 22.225 / 125.26 * cosine))
        across = 2.0 / 22.225e-3 - 1.0 / 11.6281e-3
        modulus = float(B218.effective_modulus)
        contact = qs.point_contact(1.0, rolling, across, modulus)
        f = 11.6281 / 22.225
        K, _ = stiffness_at_angle(0, 22.225e-3, 125.26e-3, f, modulus, np.sin(40 * qs.deg), cosine, side)
        # 1/Ry = (2f - 1)/(f D) loses a digit to the nearness of groove and ball.
        assert pytest.approx(contact.stiffness_constant, rel=1e-13) == K
        assert pytest.approx(printed, abs=500.0) == K


# ----------------------------------------------------------------------------------------------------- subsurface shear


def test_shear_under_a_line() -> None:
    """Towards the infinitely long contact: 0.300 p0 at 0.786 b (Johnson, 4.1)."""
    found = qs.subsurface_shear(1000.0)
    assert found.stress == pytest.approx(0.300, abs=0.0005)
    assert found.depth == pytest.approx(0.786, abs=0.0005)


@pytest.mark.parametrize("nu", [0.2, 0.3, 0.4])
def test_shear_under_a_circle_in_closed_form(nu: float) -> None:
    """On the axis of a circular contact (Johnson, 3.45): sigma_r and sigma_z are elementary."""
    z = np.linspace(0.3, 0.7, 400_001)
    sigma_z = -1.0 / (1.0 + z**2)
    sigma_r = -(1.0 + nu) * (1.0 - z * np.arctan(1.0 / z)) + 0.5 / (1.0 + z**2)
    shear = 0.5 * (sigma_r - sigma_z)
    found = qs.subsurface_shear(1.0, nu)
    assert found.stress == pytest.approx(shear.max(), rel=1e-9)
    assert found.depth == pytest.approx(z[shear.argmax()], abs=1e-4)  # flat at its top: sqrt of the rounding


# -------------------------------------------------------------------------------------------------------- bad arguments


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ((0.0, 100.0, 10.0, 2e11), "load"),
        ((-5.0, 100.0, 10.0, 2e11), "load"),
        ((float("nan"), 100.0, 10.0, 2e11), "load"),
        ((10.0, -100.0, 10.0, 2e11), "curvature_x"),
        ((10.0, 100.0, 0.0, 2e11), "curvature_y"),
        ((10.0, 100.0, float("inf"), 2e11), "curvature_y"),
        ((10.0, 100.0, 10.0, 0.0), "effective_modulus"),
    ],
)
def test_a_contact_that_is_none(arguments: tuple[float, ...], name: str) -> None:
    """What is not positive and finite is refused by its name."""
    with pytest.raises(ValueError, match=name):
        qs.point_contact(*arguments)


def test_an_unknown_form_is_refused() -> None:
    """A form by name is as good as the member; any other name is an error."""
    assert qs.point_contact(1.0, 9.0, 3.0, 1e11, "exact") == qs.point_contact(1.0, 9.0, 3.0, 1e11)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="hertz"):
        qs.point_contact(1.0, 9.0, 3.0, 1e11, "hertz")  # type: ignore[arg-type]


@pytest.mark.parametrize(("k", "nu"), [(0.99, 0.3), (float("nan"), 0.3), (float("inf"), 0.3), (2.0, -0.1), (2.0, 0.6)])
def test_shear_of_no_ellipse(k: float, nu: float) -> None:
    """An ellipticity below one, or a Poisson's ratio that no material has."""
    with pytest.raises(ValueError, match=r"ellipticity|poisson_ratio"):
        qs.subsurface_shear(k, nu)
