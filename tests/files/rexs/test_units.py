"""The units that REXS files write: how large each is, typed from the definitions of the SI."""

from __future__ import annotations

from math import pi

import pytest

from qsbearing.files.rexs.units import unit_named

SIZES = {
    "%": 1e-2, "m": 1.0, "cm": 1e-2, "mm": 1e-3, "mum": 1e-6, "µm": 1e-6, "rad": 1.0, "mrad": 1e-3, "deg": pi / 180.0,
    "degree": pi / 180.0, "1 / min": 2.0 * pi / 60.0, "rpm": 2.0 * pi / 60.0, "rad / s": 1.0, "1 / s": 2.0 * pi,
    "N": 1.0, "kN": 1e3, "MN": 1e6, "N m": 1.0, "N mm": 1e-3, "kN m": 1e3, "N / mm^2": 1e6, "MPa": 1e6, "GPa": 1e9,
    "Pa": 1.0, "N / m^2": 1.0, "kN / mm^2": 1e9, "kg / dm^3": 1e3, "g / cm^3": 1e3, "kg / m^3": 1.0,
    "1e-6 / K": 1e-6, "1 / K": 1.0, "mm^2 / s": 1e-6, "cSt": 1e-6, "m^2 / s": 1.0, "N / m": 1.0, "N / mm": 1e3,
    "N / mum": 1e6, "N / rad": 1.0, "N mm / rad": 1e-3, "N m / rad": 1.0, "kg": 1.0, "g": 1e-3, "t": 1e3,
    "kg m^2": 1.0, "kg mm^2": 1e-6, "kg cm^2": 1e-4, "m / s^2": 1.0, "mm / s^2": 1e-3, "h": 3600.0, "min": 60.0,
    "s": 1.0,
}  # fmt: skip


@pytest.mark.parametrize("text", SIZES)
def test_a_unit_is_as_large_as_the_si_says(text: str) -> None:
    unit = unit_named(text)
    assert unit is not None
    assert unit.si(3.0) == pytest.approx(3.0 * SIZES[text], rel=1e-14)
    assert unit.of(3.0 * SIZES[text]) == pytest.approx(3.0, rel=1e-14)


def test_temperatures_have_their_zeros() -> None:
    for text, zero in (("C", 273.15), ("°C", 273.15), ("K", 0.0)):
        unit = unit_named(text)
        assert unit is not None
        assert (unit.si(20.0), unit.of(unit.si(20.0))) == pytest.approx((20.0 + zero, 20.0), rel=1e-14)
