"""Oil: viscosity by temperature, density, and how viscosity rises with pressure.

Sources: ASTM D341 (viscosity and temperature); ASTM D2270 / ISO 2909 (viscosity index; the coefficients of its
appendix); ISO 3448 (viscosity grades, mm^2/s at 40 C); A. Wooster 1951, as G. Stachowiak & A. Batchelor, *Engineering
Tribology*, print it (pressure-viscosity coefficient of mineral oils).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from math import log10
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.described import number
from qsbearing.model.units import mm
from qsbearing.model.validation import (
    RATIO,
    ErrorDetail,
    Field,
    Quantity,
    SceneError,
    Sentence,
    raise_if_any,
    within,
)
from qsbearing.readings.entry import ReadingTable

FREEZING = 273.15
RANGES = {
    "grade": (7.0, 3200.0), "viscosity_index": (0.0, 400.0), "density": (500.0, 2500.0),
    "pressure_viscosity": (1e-9, 1e-7),
}  # fmt: skip
"""What an oil may have: its grade [mm^2/s], else SI."""
DENSITY_SLOPE = 0.7
"""Mineral oil loses so much density with temperature [kg/(m^3 K)]; usual value."""

VISCOSITY = Quantity("m^2/s", (("mm2_s", "mm^2/s", 1e-6),))
KELVIN = Quantity("K", (("C", "degrees Celsius", 1.0),))

# fmt: off
_INDEX = np.array([  # from this viscosity at 100 C [mm^2/s]: L = a Y^2 + b Y + c, H = d Y^2 + e Y + f (ASTM D2270)
    (2.0, 1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077),
    (3.8, 3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183),
    (4.4, 2.5000, -7.2143, 13.812, 0.82143, 1.5679, 0.119),
    (5.0, 0.10100, 16.6350, -45.469, 0.04985, 9.1613, -18.557),
    (6.4, 3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656),
    (7.0, 0.01191, 21.4750, -72.870, 0.79762, -0.7321, 14.610),
    (7.7, 0.41858, 16.1558, -56.040, 0.05794, 10.5156, -28.240),
    (9.0, 0.88779, 7.5527, -16.600, 0.26665, 6.7015, -10.810),
    (12.0, 0.76720, 10.7972, -38.180, 0.20073, 8.4658, -22.490),
    (15.0, 0.97305, 5.3135, -2.200, 0.28889, 5.9741, -4.930),
    (18.0, 0.97256, 5.2500, -0.980, 0.24504, 7.4160, -16.730),
    (22.0, 0.91413, 7.4759, -21.820, 0.20323, 9.1267, -34.230),
    (28.0, 0.87031, 9.7157, -50.770, 0.18411, 10.1015, -46.750),
    (40.0, 0.84703, 12.6752, -133.310, 0.17029, 11.4866, -80.620),
    (55.0, 0.85921, 11.1009, -83.190, 0.17130, 11.3680, -76.940),
    (70.0, 0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947),
])
# fmt: on


OIL_DENSITY, VISCOSITY_INDEX = 870.0, 95.0
"""Of an oil of which nothing else is said; the index, where a grade is given."""


@dataclass(frozen=True)
class OilState:
    """An oil at its operating temperature; SI units. Any number may be an array that broadcasts to the cases."""

    dynamic_viscosity: ArrayLike
    """eta at the contacts' inlet, at atmospheric pressure [Pa s]."""
    pressure_viscosity: ArrayLike
    """xi, the logarithmic rise of viscosity with pressure [1/Pa]."""
    kinematic_viscosity: ArrayLike | None = None
    """nu [m^2/s]; None: not known, and neither is what rests on it."""
    is_estimated: bool = False
    """Whether the pressure-viscosity coefficient is an estimate."""
    temperature_viscosity: ArrayLike | None = None
    """beta, the logarithmic fall of viscosity with temperature [1/K], and"""
    thermal_conductivity: ArrayLike | None = None
    """k [W/(m K)]; without both a film is not reduced by the heat of its inlet."""
    density: ArrayLike | None = None
    """rho there [kg/m^3]; None: not known."""


@dataclass(frozen=True)
class Lubricant:
    """An oil by its viscosity at two temperatures; SI units. Viscosities and density may be arrays, of many oils.

    Raises:
        SceneError: numbers that are no oil; every error, at once.
    """

    temperatures: tuple[float, float]
    """Of the two measured points [K], rising."""
    viscosities: tuple[ArrayLike, ArrayLike]
    """Kinematic, at those temperatures [m^2/s], falling."""
    density: ArrayLike = OIL_DENSITY
    """At 15 C [kg/m^3]."""
    pressure_viscosity: ArrayLike | None = None
    """xi at any temperature [1/Pa]; None: estimated from the viscosity, as for mineral oil."""

    def __post_init__(self) -> None:
        errors = []
        for i in (0, 1):
            errors += within(f"temperatures[{i}]", self.temperatures[i], KELVIN, 200.0, 600.0)
            errors += within(f"viscosities[{i}]", self.viscosities[i], VISCOSITY, 0.5e-6, 1.0)
        errors += within("density", self.density, Quantity("kg/m^3"), *RANGES["density"])
        if self.pressure_viscosity is not None:
            errors += within(
                "pressure_viscosity", self.pressure_viscosity, Quantity("1/Pa"), *RANGES["pressure_viscosity"]
            )
        falls = np.asarray(self.viscosities[0], float) > np.asarray(self.viscosities[1], float)
        falls = falls & (self.temperatures[0] < self.temperatures[1])
        if not errors and not falls.all():
            cause = "Two measured points, the colder one first: its viscosity is the higher one"
            where = ~falls if falls.ndim else None
            errors.append(ErrorDetail("viscosities", "do not fall as temperature rises", cause=cause, where=where))
        raise_if_any(errors)

    @classmethod
    def from_grade(
        cls, grade: ArrayLike, viscosity_index: ArrayLike = VISCOSITY_INDEX, **fields: ArrayLike | None
    ) -> Lubricant:
        """An oil by its ISO viscosity grade (mm^2/s at 40 C) and viscosity index; 95 is usual for mineral oil.

        Raises:
            SceneError: a grade or index out of range.
        """
        errors = within("grade", grade, Quantity("mm^2/s at 40 C"), *RANGES["grade"])
        errors += within("viscosity_index", viscosity_index, RATIO, *RANGES["viscosity_index"])
        raise_if_any(errors)
        hot = viscosity_at_100(grade, viscosity_index)
        points = (FREEZING + 40.0, FREEZING + 100.0), (np.asarray(grade, float)[()] * mm**2, hot * mm**2)
        return cls(*points, **fields)  # type: ignore[arg-type]

    def kinematic_viscosity(self, temperature: ArrayLike) -> NDArray:
        """nu at a temperature [K], in m^2/s: log log(nu + 0.7) = A - B log T, nu in mm^2/s (ASTM D341).

        Range: 2 mm^2/s and more; below, the standard adds terms that are not here.
        """
        low = np.log10(np.log10(np.asarray(self.viscosities[0], float) / mm**2 + 0.7))
        double = low - self._slope() * (np.log10(np.asarray(temperature, float)) - log10(self.temperatures[0]))
        return np.asarray((10.0 ** (10.0**double) - 0.7) * mm**2)

    def temperature_viscosity(self, temperature: ArrayLike) -> NDArray:
        """beta = B (nu + 0.7) ln(nu + 0.7)/(nu T), minus the slope of ln nu by the same formula [1/K]; nu in mm^2/s."""
        T, shifted = np.asarray(temperature, float), self.kinematic_viscosity(temperature) / mm**2 + 0.7
        return np.asarray(self._slope() * shifted * np.log(shifted) / ((shifted - 0.7) * T))

    def _slope(self) -> NDArray:
        """B."""
        T1, T2 = self.temperatures
        low, high = (np.log10(np.log10(np.asarray(nu, float) / mm**2 + 0.7)) for nu in self.viscosities)
        return np.asarray((low - high) / (log10(T2) - log10(T1)))

    def at(self, temperature: ArrayLike) -> OilState:
        """The oil at an operating temperature [K].

        Raises:
            SceneError: a temperature out of range.
        """
        raise_if_any(within("temperature", temperature, KELVIN, 200.0, 600.0, "is not an oil temperature in kelvin"))
        nu = self.kinematic_viscosity(temperature)
        warmer = np.asarray(temperature, float) - FREEZING - 15.0
        rho = np.asarray(self.density, float) - DENSITY_SLOPE * warmer
        eta = nu * rho
        xi = estimated_pressure_viscosity(eta) if self.pressure_viscosity is None else self.pressure_viscosity
        k = thermal_conductivity(temperature, self.density)
        return OilState(eta, xi, nu, self.pressure_viscosity is None, self.temperature_viscosity(temperature), k, rho)


def thermal_conductivity(temperature: ArrayLike, density: ArrayLike) -> NDArray:
    """k = 0.12 (1 - 0.0005 t/3)/rho of mineral oils [W/(m K)]: t in C, rho at 15 C over that of water.

    As github.com/PedroTayer/contact_mechanics and github.com/cfernandesFEUP/GEARpie have it; 0.13 to 0.14 usually.

    Args:
        temperature: [K].
        density: [kg/m^3].
    """
    celsius = np.asarray(temperature, float) - FREEZING
    return np.asarray(0.12 * (1.0 - 0.0005 * celsius / 3.0) / (np.asarray(density, float) / 1000.0))


def estimated_pressure_viscosity(dynamic_viscosity: ArrayLike) -> NDArray:
    """xi = (0.6 + 0.965 log10 eta) 1e-8 /Pa, eta in mPa s: mineral oils, after Wooster.

    Unconfirmed: from memory, no text with the two constants was found. Measured oils lie within some 30 % of it, which
    is 15 % of a film; poly-alpha-olefins below it.
    """
    eta = np.asarray(dynamic_viscosity, float)
    return np.asarray((0.6 + 0.965 * np.log10(np.maximum(eta / 1e-3, 1.0))) * 1e-8)


def viscosity_index(cold: float, hot: float) -> float:
    """VI of an oil; ASTM D2270, L and H of its reference oils.

        100 (L - U)/(L - H) up to 100;  above  100 + (10^N - 1)/0.00715, N = log10(H/U)/log10(Y)

    Args:
        cold: U, viscosity at 40 C [mm^2/s].
        hot: Y, viscosity at 100 C [mm^2/s], 2 or more.
    """
    low, high = _reference_oils(hot)
    if cold >= high:
        return 100.0 * (low - cold) / (low - high)
    return float(100.0 + ((high / cold) ** (1.0 / log10(hot)) - 1.0) / 0.00715)


def viscosity_at_100(cold: ArrayLike, index: ArrayLike) -> Any:
    """Viscosity at 100 C [mm^2/s] of an oil of this viscosity at 40 C [mm^2/s] and viscosity index."""
    pairs = np.stack([each.ravel() for each in np.broadcast_arrays(np.asarray(cold, float), np.asarray(index, float))])
    different, which = np.unique(pairs, axis=1, return_inverse=True)
    viscosities = np.array([_viscosity_at_100(*map(float, pair)) for pair in different.T])
    return viscosities[which].reshape(np.broadcast_shapes(np.shape(cold), np.shape(index)))[()]


@lru_cache(maxsize=256)
def _viscosity_at_100(cold: float, index: float) -> float:
    """Of one oil."""
    from scipy.optimize import brentq

    def surplus(hot: float) -> float:
        low, high = _reference_oils(hot)
        if index <= 100.0:
            return low - 0.01 * index * (low - high) - cold
        return high * hot ** -log10(0.00715 * (index - 100.0) + 1.0) - cold

    return float(brentq(surplus, 1.2, 1000.0, xtol=1e-10))


def _reference_oils(hot: float) -> tuple[float, float]:
    """L and H, viscosities at 40 C of the oils of index 0 and 100 that are as viscous at 100 C [mm^2/s]."""
    row = _INDEX[max(int(np.searchsorted(_INDEX[:, 0], hot, side="right")) - 1, 0)]
    return float(np.polyval(row[1:4], hot)), float(np.polyval(row[4:7], hot))


TABLE = ReadingTable(
    inputs=(
        number("iso_viscosity_grade", range=RANGES["grade"]),
        number("viscosity_index", range=RANGES["viscosity_index"]),
        number("viscosity_at_40", "mm2/s"),
        number("viscosity_at_100", "mm2/s"),
        number("oil_temperature", "C"),
        number("oil_density", "kg/m3", RANGES["density"]),
        number("pressure_viscosity", "1/GPa", RANGES["pressure_viscosity"]),
    ),
    example="""\
iso_viscosity_grade = 68           # or viscosity_at_40C_mm2_s and viscosity_at_100C_mm2_s
oil_temperature_C = 70
""",
    note="for film, and for the viscosity ratio of life",
)
"""The oil of a scene file."""


def oil_of(numbers: Mapping[str, Any]) -> tuple[OilState | None, list[ErrorDetail]]:
    """An oil at its temperature by the numbers of a scene file (SI), or what is wrong with them."""
    given = dict(numbers)
    temperature = given.pop("oil_temperature", None)
    fields = {
        "density": given.pop("oil_density", OIL_DENSITY),
        "pressure_viscosity": given.pop("pressure_viscosity", None),
    }
    grade, index = given.pop("iso_viscosity_grade", None), given.pop("viscosity_index", None)
    cold, hot = given.pop("viscosity_at_40", None), given.pop("viscosity_at_100", None)
    errors: list[ErrorDetail] = []
    if temperature is None:
        errors.append(ErrorDetail("oil_temperature", "missing"))
    by_points = cold is not None and hot is not None
    if (grade is None) == (cold is None and hot is None) or (grade is None and not by_points):
        either = Sentence(
            "Give {grade}, or {cold} and {hot}",
            grade=Field("iso_viscosity_grade"), cold=Field("viscosity_at_40"), hot=Field("viscosity_at_100"),
        )  # fmt: skip
        errors.append(ErrorDetail("iso_viscosity_grade", "does not make one oil", cause=either))
    elif index is not None and grade is None:
        cause = "Leave it out: two viscosities make the index"
        errors.append(ErrorDetail("viscosity_index", "is given together with two viscosities", cause=cause))
    if errors:
        return None, errors
    try:
        if grade is not None:
            oil = Lubricant.from_grade(grade, VISCOSITY_INDEX if index is None else index, **fields)
        else:
            points = (FREEZING + 40.0, FREEZING + 100.0), (cold, hot)
            oil = Lubricant(*points, **fields)
        return oil.at(temperature), []
    except SceneError as error:
        return None, [replace(each, field=_KEY.get(each.field, each.field)) for each in error.errors]


_KEY = {
    "grade": "iso_viscosity_grade",
    "density": "oil_density",
    "temperature": "oil_temperature",
    "viscosities[0]": "viscosity_at_40",
    "viscosities[1]": "viscosity_at_100",
    "viscosities": "viscosity_at_100",
}
"""What an oil's fields are called there."""
