"""Factors of life and of equivalent loads against other prints of the same tables, typed from these.

Static factors f0, those of the dynamic rating (fc) and of reliability are typed a second time for the validation book.
"""

from __future__ import annotations

import numpy as np
import pytest

import qsbearing as qs
from fem_check.book.published import bearing
from qsbearing.readings import life_factors
from qsbearing.readings.static_rating import static_equivalent_load

DEEP_GROOVE = {  # f0 Fa/C0: e and Y; X = 0.56. Koyo, "Calculation of equivalent radial / axial load" (3_1_32)
    0.172: (0.19, 2.30), 0.345: (0.22, 1.99), 0.689: (0.26, 1.71), 1.03: (0.28, 1.55), 1.38: (0.30, 1.45),
    2.07: (0.34, 1.31), 3.45: (0.38, 1.15), 5.17: (0.42, 1.04), 6.89: (0.44, 1.0),
}  # fmt: skip
FIFTEEN = {  # f0 Fa/C0: e and Y; X = 0.44. Koyo, the same page
    0.178: (0.38, 1.47), 0.357: (0.40, 1.40), 0.714: (0.43, 1.30), 1.07: (0.46, 1.23), 1.43: (0.47, 1.19),
    2.14: (0.50, 1.12), 3.57: (0.55, 1.02), 5.35: (0.56, 1.00),
}  # fmt: skip
STEEP = {  # degrees: e, X, Y
    25.0: (0.68, 0.41, 0.87),  # LYC, "Equivalent dynamic load", table 2
    30.0: (0.80, 0.39, 0.76),  # Koyo, the same page
    40.0: (1.14, 0.35, 0.57),  # both
}
STATIC = {15.0: 0.46, 25.0: 0.38, 30.0: 0.33, 40.0: 0.26}
"""Y0 by degrees: Koyo; LYC, "Equivalent static load", table 4."""
Z, D = 15, 10.0
"""Balls and their diameter [mm]."""


def factors(angle: float, relative: float) -> tuple[float, float]:
    """X and Y of an angle [degrees] at Fa/(Z D^2) [N/mm^2]."""
    of = bearing(Z, D, 80.0, angle)
    axial = relative * Z * D**2
    alone = float(qs.readings.equivalent_load(of, 0.0, axial))
    return (float(qs.readings.equivalent_load(of, 0.1 * axial, axial)) - alone) / (0.1 * axial), alone / axial


def limit(angle: float, relative: float) -> float:
    """e: the largest Fa/Fr at which the load is the radial one."""
    of = bearing(Z, D, 80.0, angle)
    axial = relative * Z * D**2
    over = np.linspace(0.005, 2.0, 1996) + 5e-4
    is_radial = qs.readings.equivalent_load(of, axial / over, axial) == axial / over
    return float(over[is_radial].max()) - 5e-4 + 1e-12


@pytest.mark.parametrize("relative", DEEP_GROOVE)
def test_deep_groove_bearings_have_the_printed_factors(relative: float) -> None:
    e, Y = DEEP_GROOVE[relative]
    assert factors(0.0, relative) == pytest.approx((0.56, Y))
    assert limit(0.0, relative) == pytest.approx(e, abs=1e-3)


@pytest.mark.parametrize("printed", FIFTEEN)
def test_fifteen_degrees_have_the_printed_factors(printed: float) -> None:
    """The print's loads are over cos(15 degrees), rounded to three digits."""
    e, Y = FIFTEEN[printed]
    relative = printed * np.cos(15.0 * qs.deg)
    assert factors(15.0, relative) == pytest.approx((0.44, Y), abs=2e-3)
    assert limit(15.0, relative) == pytest.approx(e, abs=2e-3)


@pytest.mark.parametrize("angle", STEEP)
def test_steep_angles_have_the_printed_factors(angle: float) -> None:
    e, X, Y = STEEP[angle]
    assert factors(angle, 1.0) == pytest.approx((X, Y))
    assert limit(angle, 1.0) == pytest.approx(e, abs=1e-3)


@pytest.mark.parametrize("angle", [0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0])
def test_both_formulas_of_the_equivalent_load_meet_at_e(angle: float) -> None:
    """X + Y e = 1, but for the rounding of e and Y to two decimals: of angles that no print is at hand of, too."""
    for relative in DEEP_GROOVE:
        (X, Y), e = factors(angle, relative), limit(angle, relative)
        assert X + Y * e == pytest.approx(1.0, abs=0.006 * (Y + e)), relative


@pytest.mark.parametrize("angle", STATIC)
def test_static_factors_are_as_printed(angle: float) -> None:
    of = bearing(Z, D, 80.0, angle)
    assert static_equivalent_load(of, 0.0, 1000.0) == pytest.approx(1000.0 * STATIC[angle])
    assert static_equivalent_load(of, 400.0, 1000.0) == pytest.approx(max(200.0 + 1000.0 * STATIC[angle], 400.0))


CLEANLINESS = {
    # Grease: NREL DG03, table 7, as github.com/frasere/ISO-281 has it in classes_funcs.py.
    "grease_high": (0.0864, 0.6796), "grease_normal": (0.0432, 1.141), "grease_slight": (0.0177, 1.887),
    "grease_severe": (0.0115, 2.662), "grease_very_severe": (0.00617, 4.06),
    # Oil: ISO 281:2007, annex A, by its letters.
    "filter_6": (0.0864, 0.5663), "filter_12": (0.0864 / 2.0, 0.9987), "filter_25": (0.0864 / 3.0, 1.6329),
    "filter_40": (0.0864 / 4.0, 2.3362), "oil_13_10": (0.0864, 0.6796), "oil_15_12": (0.0864 / 3.0, 1.141),
    "oil_19_16": (0.0864 / 10.0, 2.5164),
}  # fmt: skip
"""Gain and loss; those of filters fall as 1, 1/2, 1/3, 1/4."""


@pytest.mark.parametrize("kind", CLEANLINESS)
def test_contamination_factors_are_as_printed(kind: str) -> None:
    gain, loss = CLEANLINESS[kind]
    for kappa, dm in ((0.3, 80.0), (1.0, 150.0), (4.0, 400.0)):
        expected = min(gain * kappa**0.68 * dm**0.55, 1.0) * (1.0 - loss / dm ** (1.0 / 3.0))
        found = qs.readings.contamination_factor(qs.readings.Cleanliness(kind), kappa, dm * qs.mm)
        assert found == pytest.approx(max(expected, 0.0), rel=1e-12)


@pytest.mark.parametrize(
    ("speed", "dm", "printed"), [(10.0, 100.0, 665.6), (500.0, 50.0, 36.61), (4000.0, 100.0, 7.115)]
)
def test_the_reference_viscosity_by_hand(speed: float, dm: float, printed: float) -> None:
    """ISO 281:2007, 9.3.3.2, with a pocket calculator: 45000 n^-0.83 dm^-0.5, or 4500 n^-0.5 dm^-0.5 [mm^2/s]."""
    assert life_factors.reference_viscosity(speed * qs.rpm, dm * qs.mm) * 1e6 == pytest.approx(printed, rel=2e-4)
