"""The references against books, limits and each other."""

from math import pi

import numpy as np
import pytest

from fem_check.checks.half_space_contacts import ellipse_of
from fem_check.independent.contact_problem import ContactProblem, ElasticConstants
from fem_check.independent.groove import BallInGroove
from fem_check.independent.references import axis_ratio, curvature_ratio, hertz, largest_shear
from fem_check.product.hertz import of_qsbearing

STEEL = ElasticConstants(208e9, 0.3)


def b218(race: str) -> BallInGroove:
    return BallInGroove("B218", race, 22.225e-3, 11.6281e-3, 125.26e-3, np.radians(40.0), STEEL, STEEL)


# B218 at 40 degrees and 1000 N, from two other solutions of Hertz's equations at full precision; last digit printed.
@pytest.mark.parametrize(
    ("race", "a", "b", "p0", "delta"),
    [("inner", 1.738585, 0.213182, 1288.233, 8.397011), ("outer", 1.700768, 0.246577, 1138.529, 8.179344)],
)
def test_b218(race, a, b, p0, delta):
    ellipse = hertz(b218(race).problem(1000.0))
    assert ellipse.semi_major_axis * 1e3 == pytest.approx(a, abs=6e-7)
    assert ellipse.semi_minor_axis * 1e3 == pytest.approx(b, abs=6e-7)
    assert ellipse.max_pressure * 1e-6 == pytest.approx(p0, abs=6e-4)
    assert ellipse.approach * 1e6 == pytest.approx(delta, abs=6e-7)


def test_circle_is_the_textbooks():
    radius, load = 10e-3, 100.0
    ellipse = hertz(ContactProblem("sphere", 1.0 / radius, 1.0 / radius, STEEL, STEEL, load))
    modulus = 1.0 / (2.0 * STEEL.compliance)
    a = (0.75 * load * radius / modulus) ** (1.0 / 3.0)
    # Closed forms both: rounding only.
    assert ellipse.semi_major_axis == pytest.approx(a, rel=1e-12)
    assert ellipse.semi_minor_axis == pytest.approx(a, rel=1e-12)
    assert ellipse.approach == pytest.approx(a * a / radius, rel=1e-12)
    assert ellipse.max_pressure == pytest.approx(1.5 * load / (pi * a * a), rel=1e-12)


def test_shear_of_the_circle():
    # On the axis of a circular contact (Johnson 1985, eqs 3.45): closed form in the depth.
    z = np.linspace(0.3, 0.7, 400001)
    radial = -(1.3 * (1.0 - z * np.arctan(1.0 / z)) - 0.5 / (1.0 + z * z))
    axial = -1.0 / (1.0 + z * z)
    shear = 0.5 * np.abs(radial - axial)
    stress, depth = largest_shear(1.0, 0.3)
    assert stress == pytest.approx(shear.max(), rel=1e-9)
    assert depth == pytest.approx(z[shear.argmax()], abs=2e-5)  # a flat maximum on a grid of 1e-6


def test_shear_tends_to_the_line_contact():
    # Johnson 1985, section 4.2: 0.300 p0 at 0.786 b for a line, approached like 1/k: at k = 200 within 0.4 %.
    stress, depth = largest_shear(200.0, 0.3)
    assert stress == pytest.approx(0.3003, rel=4e-3)
    assert depth == pytest.approx(0.7862, rel=4e-3)


@pytest.mark.parametrize("k", [1.0, 1.0001, 3.0, 20.0, 300.0])
def test_shape_and_its_inverse(k):
    assert axis_ratio(curvature_ratio(1.0 / k)) == pytest.approx(1.0 / k, rel=1e-9)


def test_powers_of_the_load():
    light, heavy = hertz(b218("inner").problem(1.0)), hertz(b218("inner").problem(1000.0))
    assert heavy.approach / light.approach == pytest.approx(100.0, rel=1e-12)
    assert heavy.semi_major_axis / light.semi_major_axis == pytest.approx(10.0, rel=1e-12)


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_exact_gap_begins_as_the_parabola(race):
    groove = b218(race)
    problem = groove.problem(1.0)
    x, y = np.array([1e-5, 0.0]), np.array([0.0, 1e-5])
    # The next term is of order (x/R)^2 = 1e-6 times a conformity factor of about 20.
    np.testing.assert_allclose(groove.gap(x, y), problem.parabolic_gap(x, y), rtol=1e-4)


def test_bad_contacts_are_refused():
    with pytest.raises(ValueError, match="positive, finite load"):
        ContactProblem("x", 1.0, 2.0, STEEL, STEEL, 0.0)
    with pytest.raises(ValueError, match="the first the smaller"):
        ContactProblem("x", 3.0, 2.0, STEEL, STEEL, 1.0)
    with pytest.raises(ValueError, match="inner, outer"):
        b218("middle")


# Both derivations claim full precision, and lose some digits of 16 in root finding; the shear is integrated by one of
# them, and a maximum's position is known to the square root of the precision of its value.
SHAPES = (1.0, 1.001, 2.0, 5.0, 10.0, 20.0, 50.0)
TOLERANCES = {"max_shear_stress": 1e-10, "max_shear_depth": 1e-6}


def against_carlson(ellipticity: float) -> dict[str, float]:
    """How far qsbearing's contact of a shape is from that in Carlson's integrals, over it."""
    problem = ellipse_of(ellipticity)
    exact, ours = hertz(problem), of_qsbearing(problem)
    return {name: abs(value / getattr(exact, name) - 1.0) for name, value in ours.items()}


@pytest.mark.parametrize("ellipticity", SHAPES)
def test_qsbearing_agrees_from_a_circle_to_a_long_ellipse(ellipticity):
    off = against_carlson(ellipticity)
    assert {name: each for name, each in off.items() if each > TOLERANCES.get(name, 1e-12)} == {}
