"""Static and dynamic ratings: relations. Standards' tables, catalogues and endurance tests: the validation book."""

from __future__ import annotations

import numpy as np
import pytest

import qsbearing as qs
from fem_check.book.published import (
    ISO_STEEL,
    bearing,
)
from qsbearing.readings import bearing_numbers, dynamic_rating, life_factors
from qsbearing.readings.bearing_numbers import INNER, OUTER
from qsbearing.readings.static_rating import static_equivalent_load

"""ISO 76 prints one decimal; its own arithmetic adds a little to the 0.05 of rounding (largest found: 0.053)."""


def test_fatigue_limit_both_ways() -> None:
    """By Hertz C0/19.2 where one raceway governs both, so that C0/22 is 14 % lower; above 100 mm (100/dm)^0.5."""
    small, large = bearing(15, 10, 80, 15), bearing(15, 20, 160, 15)
    for each, scale in ((small, 1.0), (large, np.sqrt(100 / 160))):
        hertz = qs.readings.fatigue_load_limit(each)
        simple = qs.readings.fatigue_load_limit(each, "static_rating")
        assert simple == pytest.approx(qs.readings.static_load_rating(each) / 22 * scale, rel=1e-12)
        assert hertz / simple == pytest.approx(22 * 0.2288 * 5 * (1500 / 4200) ** 3, rel=1e-12)
        assert hertz / simple == pytest.approx(1.146, abs=0.001)


def test_static_equivalent_load() -> None:
    forty = bearing(15, 10, 80, 40)
    assert static_equivalent_load(forty, 1000, 2000) == pytest.approx(0.5 * 1000 + 0.26 * 2000)
    assert static_equivalent_load(forty, 1000, 100) == 1000
    between = static_equivalent_load(bearing(15, 10, 80, 17.5), 0.0, 1000.0)
    assert between == pytest.approx(440.0)  # Y0 between 0.46 and 0.42


# ------------------------------------------------------------------------------------------------------ dynamic rating


def test_outside_its_table_iso_281_has_no_rating() -> None:
    assert np.isnan(qs.readings.dynamic_load_rating(bearing(6, 10, 24, 0.0), "iso_281"))


def test_large_balls_meet_the_small_ones() -> None:
    """D^1.8 and 3.647 D^1.4 agree at 25.4 mm to the rounding of 3.647."""
    below, above = dynamic_rating.size_factor(25.4e-3), dynamic_rating.size_factor(25.4001e-3)
    assert above == pytest.approx(below, rel=2e-4)


def test_contact_ratings_are_the_bearing_s() -> None:
    """Both routes to a contact's rating agree at zero angle, to the rounding of 1.04, 1.044, 0.407 and 0.389.

    At 40 degrees they differ by cos(alpha)^0.3, as the docstring says.
    """
    for angle, apart in ((0.0, 1.0), (40.0, np.cos(40 * qs.deg) ** -0.3)):
        b = bearing(15, 10, 80, angle, 0.515, 0.525)
        spread = qs.readings.element_load_ratings(b, qs.readings.dynamic_load_rating(b))
        for side, rating in zip((INNER, OUTER), spread, strict=True):
            direct = dynamic_rating.contact_load_rating(b, np.full(15, angle * qs.deg), side, 1.3)
            assert direct[0] / rating == pytest.approx(apart, rel=0.006)


# ------------------------------------------------------------------------------------------------------ factors of life


def test_the_modification_factor_is_continuous() -> None:
    """At kappa = 0.4 its pieces agree to 4e-4, which both misprints in circulation break (1.6e-3 and 1 %)."""
    for border in (0.4, 1.0):
        below, above = (float(life_factors.lubrication_term(border * (1 + h))) for h in (-1e-9, 0.0))
        assert above == pytest.approx(below, rel=5e-4)
    assert qs.readings.life_modification_factor(0.4, 1.0, 1e-12, 1.0) == pytest.approx(0.1, rel=1e-2)


def test_values_of_the_modification_factor() -> None:
    """At kappa 2.45: eC Cu/P 0.107, 0.067, 0.0268, 0.04 give 5.50, 2.74, 1.02, 1.49."""
    found = qs.readings.life_modification_factor(2.45, np.array([0.107, 0.067, 0.0268, 0.04]), 1.0, 1.0)
    assert found == pytest.approx([5.50, 2.74, 1.02, 1.49], abs=0.0051)


def test_the_modification_factor_has_its_domain() -> None:
    factor = qs.readings.life_modification_factor
    assert np.isnan(factor(0.09, 0.5, 100.0, 1000.0))
    assert factor(40.0, 0.5, 100.0, 1000.0) == factor(4.0, 0.5, 100.0, 1000.0)
    assert factor(4.0, 1.0, 1000.0, 900.0) == 50.0
    rising = factor(np.array([0.1, 0.2, 0.4, 0.8, 1.6, 3.2]), 0.5, 100.0, 1000.0)
    assert (np.diff(rising) > 0.0).all()


def test_reference_viscosity_and_ratio() -> None:
    """dm 380 mm, 500 rpm: nu1 13.3 mm^2/s by the formula."""
    assert life_factors.reference_viscosity(500 * qs.rpm, 0.38) * 1e6 == pytest.approx(13.3, abs=0.05)
    assert qs.readings.viscosity_ratio(20e-6, 3000 * qs.rpm, 72.5e-3) == pytest.approx(2.07, abs=0.01)


def test_cleaner_oil_and_thicker_film_suffer_less() -> None:
    kinds = list(qs.readings.Cleanliness)
    table = np.array([qs.readings.contamination_factor(kind, [0.2, 1.0, 3.0], 0.08) for kind in kinds])
    assert (table >= 0.0).all()
    assert (table < 1.0).all()
    assert (np.diff(table, axis=1) >= 0.0).all()
    for group in ("filter", "oil", "grease"):
        rows = table[[str(kind).startswith(group) for kind in kinds]]
        assert (np.diff(rows, axis=0) <= 0.0).all()
    assert qs.readings.contamination_factor("grease_very_severe", 1.0, 0.02) == 0.0


def test_numbers_of_a_deep_groove_bearing() -> None:
    """Its nominal angle is zero, whatever angle its clearance makes."""
    b = bearing(9, 10, 50, 12.0, kind=qs.BearingKind.DEEP_GROOVE)
    numbers = bearing_numbers.BearingNumbers(b)
    assert numbers.nominal_gamma == pytest.approx(0.2)
    assert b.ball_material is ISO_STEEL
    assert not numbers.is_hybrid


# ------------------------------------------------------------------------------------------------------ thrust bearings


def test_dynamic_ratings_of_thrust_bearings_as_printed() -> None:
    """ISO 281, C.5: fc 85.1 at 45 degrees and gamma 0.16; 60 degrees, D 7.5, Z 27, D/dm 0.091: Ca = 28 663 N.

    The latter's fc, 61.12, is read at gamma 0.046 between the table's values for 0.04 and 0.05, of three digits each;
    gamma is 0.0455.
    """
    D = 7.5
    steep = bearing(8, D, D / 0.16 * np.cos(45.001 * qs.deg), 45.001)
    size = np.cos(45 * qs.deg) ** 0.7 * 8 ** (2 / 3) * D**1.8
    assert qs.readings.dynamic_load_rating(steep, "iso_281", 1.0) / size == pytest.approx(85.1, abs=0.05)
    size = np.cos(60 * qs.deg) ** 0.7 * np.tan(60 * qs.deg) * 27 ** (2 / 3) * D**1.8
    table = [
        qs.readings.dynamic_load_rating(bearing(27, D, D / gamma * np.cos(60 * qs.deg), 60), "iso_281", 1.0) / size
        for gamma in (0.04, 0.05)
    ]
    assert np.interp(0.046, [0.04, 0.05], table) == pytest.approx(61.12, abs=0.05)
    assert pytest.approx(28663, abs=1.0) == 1.3 * 61.12 * size
    example = bearing(27, D, D / 0.091, 60)
    assert qs.readings.dynamic_load_rating(example, "iso_281") == pytest.approx(28663, rel=0.003)


def test_axial_ratings_of_a_radial_bearing_as_printed() -> None:
    """ISO 281, C.5: 40 degrees, C = 18 651 N: Caa = 23 493 N. ISO 76, A.5: C0 = 18 731 N: 50 430 N."""
    forty = bearing(27, 7.5, 7.5 / 0.091, 40)
    assert qs.readings.axial_load_rating(forty, 18651.0) == pytest.approx(23493, abs=1.0)
    assert qs.readings.axial_static_load_rating(forty, 18731.0) == pytest.approx(50430, abs=1.0)
    steep = bearing(27, 7.5, 7.5 / 0.091, 60)
    assert np.isnan(qs.readings.axial_load_rating(steep, 18651.0))
    assert np.isnan(qs.readings.axial_static_load_rating(steep, 18731.0))


def test_static_rating_of_a_thrust_bearing_as_printed() -> None:
    """ISO 76, A.5: 60 degrees, D 7.5, Z 27, D/dm 0.091: C0a = 76 049 N with f0 = 57.82 at gamma 0.046."""
    found = qs.readings.static_load_rating(bearing(27, 7.5, 7.5 / 0.091, 60, 0.54, 0.54))
    assert found == pytest.approx(76049, rel=(0.05 + 0.05) / 57.82)  # rounding of gamma and of the table
    P0 = static_equivalent_load(bearing(27, 7.5, 82, 60), np.array([0.0, 100.0, 500.0]), 1000.0)
    assert P0[:2] == pytest.approx([1000.0, 1000 + 2.3 * 100 * np.tan(60 * qs.deg)])
    assert np.isnan(P0[2])


def test_fatigue_limit_of_a_thrust_bearing() -> None:
    """By Hertz C0a (1500/4200)^3 = C0a/21.95: here the simple estimate, C0a/22, is the same."""
    steep = bearing(20, 10, 80, 60, 0.54, 0.54)
    hertz, simple = (qs.readings.fatigue_load_limit(steep, by) for by in qs.readings.static_rating.FatigueLimit)
    assert hertz == pytest.approx(qs.readings.static_load_rating(steep) * (1500 / 4200) ** 3)
    assert hertz / simple == pytest.approx(1.0, abs=0.003)
