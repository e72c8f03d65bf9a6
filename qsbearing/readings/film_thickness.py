"""Thickness of the oil film in every contact, and the film parameter.

Source: B. Hamrock & D. Dowson, J. Lubrication Technology 99 (1977) 264-276; Hamrock, *Fundamentals of Fluid Film
Lubrication*. With U = eta u/(E' Rx), G = xi E', W = Q/(E' Rx^2), k = a/b, E' = 2/[(1-nu1^2)/E1 + (1-nu2^2)/E2]:

    minimum  h/Rx = 3.63 U^0.68 G^0.49 W^-0.073 (1 - e^(-0.68 k))
    central  h/Rx = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k))

u is each contact's own entrainment speed and Rx its rolling radius at its own angle. (Codes that take half of E' or
call the first formula "central" are in circulation.)

Range: elastic contacts, fully flooded with oil, isothermal, steady. The fits were computed for loads W of 1e-7 to 1e-6,
far below a bearing's, and are used beyond by custom.

Shear heats the oil in the inlet, which thins it and the film by the factor

    phi = 1/[1 + 0.1 (1 + 14.8 S^0.83) L^0.64],     L = beta eta (2 u)^2/k,   S: sliding over the sum of the speeds

told next to the isothermal film. It is usually put down to W. Wilson & S. Sheu 1983, whose paper was not at hand: the
constants and the sum of the speeds are those of github.com/PedroTayer/contact_mechanics and
github.com/cfernandesFEUP/GEARpie, which agree. They give no range; it was made for rolling line contacts. S is zero
here: raceway control lets the contact's centre roll, and spin drags in on one side what it holds back on the other.
SKF's factor for the same (General Catalogue) was made for friction; it is told as well. Films starved of oil are
thinner still: no source with constants was found.
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, field
from math import exp, log, nan
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.compiler.compiled import entry, kernel
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.described import given_in
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import mm, rpm
from qsbearing.model.validation import LENGTH, ErrorDetail, Quantity, within
from qsbearing.readings.ball_motion import AXIS, MOTION, contact_motion, gamma, motion_arrays, ring_speeds
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.entry import Reading, ReadingTable, both_or_neither, simply, with_arguments
from qsbearing.readings.lubricant import OilState
from qsbearing.readings.passes import SAME_SHAPE, filled, of_balls, of_cases
from qsbearing.remarks.kinds import CHECK, NOTE, SEE_CHOICES, WRONG, Kind
from qsbearing.remarks.remark import Remark, Remarked, Remarks, remark, remarks

MIXED = 1.0
"""Film parameter below which surfaces touch over much of the contact; full separation takes about 3."""

FACTOR_SPREAD = 0.12
"""By which published factors for the heat of the inlet differ: the one taken here from that of P. Gupta et al. 1992
(from memory), at contacts of 1 to 2 GPa whose film is reduced to three quarters."""

WARM_INLET = 0.9
"""Reduction by the heat of the inlet, or SKF's factor for it, below which it is said (chosen: 10 %)."""

NEEDS = ("load", "sine", "cosine", "semi_major_axis", "semi_minor_axis"), AXIS

PRESSURE_VISCOSITY_ESTIMATED = Kind(
    "pressure_viscosity_estimated", CHECK, SEE_CHOICES,
    "the pressure-viscosity coefficient is an estimate for mineral oil, good to some 30 % (15 % of the film "
    "thickness)",
)  # fmt: skip
FILM_ISOTHERMAL = Kind(
    "film_isothermal", WRONG, SEE_CHOICES,
    "SKF's inlet shear heating factor is below {limit:g}: the true film is thinner than this isothermal one",
)  # fmt: skip
FILM_REDUCED = Kind(
    "film_reduced", NOTE, SEE_CHOICES,
    "inlet heating reduces the film of {raceways:an} contact by more than {limit_percent:.0f} %; published "
    "factors of this reduction differ by {spread_percent:.0f} %",
)  # fmt: skip
FILM_THIN = Kind(
    "film_thin", NOTE, SEE_CHOICES, "a film parameter is below 1: asperities touch over much of {raceways:that} contact"
)


@dataclass(frozen=True)
class RacewayFilm:
    """Film in the contacts of one raceway; arrays of shape (*cases, ball), NaN where a ball does not touch it."""

    central_thickness: NDArray
    """[m]."""
    minimum_thickness: NDArray
    """[m]; both isothermal."""
    film_parameter: NDArray | None
    """Lambda, the minimum film over the surfaces' combined roughness [-]; None without roughness. Reduced by the heat
    of the inlet where that is known."""
    thermal_reduction: NDArray | None
    """phi, by which the heat of the inlet reduces both thicknesses [-]; None without the oil's beta and k. Published
    factors differ by `FACTOR_SPREAD`."""

    @property
    def reduced_minimum_thickness(self) -> NDArray | None:
        """The minimum as the heat of the inlet leaves it [m]; None where that is not known."""
        return None if self.thermal_reduction is None else self.minimum_thickness * self.thermal_reduction


@dataclass(frozen=True)
class Film(Remarked):
    """Oil films of a solution."""

    inner: RacewayFilm
    outer: RacewayFilm
    inlet_shear_heating: NDArray | None
    """SKF's factor phi_ish = 1/(1 + 1.84e-9 (n dm)^1.28 nu^0.64), n rpm, dm mm, nu mm^2/s; shape (*cases) [-]. None
    where the oil's kinematic viscosity is not known."""
    combined_roughness: NDArray | None
    """Root mean square of ball and raceway together [m]; (*cases), None without roughness."""
    remarks: Remarks


@dataclass(frozen=True)
class FilmArguments:
    """What `film` takes."""

    oil: OilState
    _: KW_ONLY
    ball_roughness: ArrayLike | None = field(default=None, metadata=given_in("um"))
    raceway_roughness: ArrayLike | None = field(default=None, metadata=given_in("um"))

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """Everything out of range, and one roughness without the other."""
        errors = within("oil.dynamic_viscosity", self.oil.dynamic_viscosity, Quantity("Pa s"), 1e-4, 1e3)
        errors += within("oil.pressure_viscosity", self.oil.pressure_viscosity, Quantity("1/Pa"), 1e-9, 1e-7)
        cause = "The film parameter needs both; leave both out for the thickness alone"
        return errors + both_or_neither(
            {
                "ball_roughness": (self.ball_roughness, LENGTH, 1e-10, 1e-4),
                "raceway_roughness": (self.raceway_roughness, LENGTH, 1e-10, 1e-4),
            },
            cause,
        )

    @property
    def combined_roughness(self) -> Any:
        """Root mean square of both [m]; None without them."""
        if self.ball_roughness is None or self.raceway_roughness is None:
            return None
        return np.hypot(np.asarray(self.ball_roughness, float), np.asarray(self.raceway_roughness, float))


@with_arguments(FilmArguments)
def film(solution: Solution, given: FilmArguments) -> Film:
    """Film thickness in every contact of every case.

    Args:
        oil: at its operating temperature; `Lubricant.at` makes one, with the numbers of a mineral oil's heating.
        ball_roughness, raceway_roughness: Rq of the surfaces, root mean square [m]; both, or no film parameter.

    Returns:
        Film thickness of every contact.

    Raises:
        SceneError: every number that is out of range, at once.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> oil = qs.readings.Lubricant.from_grade(46).at(70 + qs.zero_celsius)
        >>> print(f"{qs.readings.film(solution, oil).inner.minimum_thickness[0] / qs.um:.2f} µm")
        0.93 µm
    """
    oil, rough = given.oil, given.combined_roughness
    solution.read_at_once(*NEEDS)
    inner, outer = (
        _raceway(solution, contacts, oil, side, rough)
        for side, contacts in ((INNER, solution.inner), (OUTER, solution.outer))
    )
    factor = None if oil.kinematic_viscosity is None else _inlet_shear_heating(solution, oil.kinematic_viscosity)
    return Film(inner, outer, factor, rough, remarks(_found(oil, inner, outer, factor), solution.shape))


@kernel
def minimum_thickness(ln_U: float, ln_G: float, ln_W: float, shape: float) -> float:
    """h/Rx at the thinnest place of the film, by the logarithms of U, G and W."""
    return 3.63 * exp(0.68 * ln_U + 0.49 * ln_G - 0.073 * ln_W) * shape


@kernel
def minimum_shape(k: float) -> float:
    """1 - e^(-0.68 k): the minimum film's part that the ellipse makes."""
    return 1.0 - exp(-0.68 * k)


@kernel
def central_thickness(ln_U: float, ln_G: float, ln_W: float, shape: float) -> float:
    """h/Rx at the centre of the film, likewise."""
    return 2.69 * exp(0.67 * ln_U + 0.53 * ln_G - 0.067 * ln_W) * shape


@kernel
def central_shape(k: float) -> float:
    """1 - 0.61 e^(-0.73 k): the central film's."""
    return 1.0 - 0.61 * exp(-0.73 * k)


@kernel
def thermal_reduction(ln_L: float) -> float:
    """phi of a contact that rolls without sliding, by the logarithm of L."""
    return 1.0 / (1.0 + 0.1 * exp(0.64 * ln_L))


@entry(
    MOTION, float, int, int, array_of(float), (array_of(float),) * 6, *[array_of(float, 2)] * 5, int, int,
    array_of(float, 3),
)  # fmt: skip
def _fill(
    motion: tuple[Any, ...], side: float, at_reduction: int, at_ratio: int, gamma: NDArray,
    numbers: tuple[NDArray, ...], load: NDArray, sine: NDArray, cosine: NDArray, semi_major_axis: NDArray,
    semi_minor_axis: NDArray, begin: int, stop: int, out: NDArray,
) -> None:  # fmt: skip
    """Central and minimum thickness; tables of the heat's reduction and of the film parameter, unless below zero."""
    diameter, modulus, eta, xi, roughness, heating = numbers
    k_before, least, central = 0.0, 0.0, 0.0
    for k in range(begin, stop):
        radius, E = 0.5 * diameter[k], modulus[k]
        ln_E, ln_G, ln_eta, ln_heating = log(E), log(xi[k] * E), log(eta[k]), log(4.0 * heating[k])
        for j in range(load.shape[1]):
            if not load[k, j] > 0.0:
                for i in range(out.shape[0]):
                    out[i, k, j] = nan
                continue
            ratio = semi_major_axis[k, j] / semi_minor_axis[k, j]
            if abs(ratio - k_before) > SAME_SHAPE * ratio:
                k_before, least, central = ratio, minimum_shape(ratio), central_shape(ratio)
            pace, _, _ = contact_motion(motion, side, sine[k, j], cosine[k, j], k, j)
            Rx = radius * (1.0 + side * gamma[k] * cosine[k, j])
            ln_u, ln_R, ln_Q = log(pace * radius), log(Rx), log(load[k, j])
            ln_U, ln_W = ln_eta + ln_u - ln_E - ln_R, ln_Q - ln_E - 2.0 * ln_R
            thinnest = Rx * minimum_thickness(ln_U, ln_G, ln_W, least)
            out[0, k, j] = Rx * central_thickness(ln_U, ln_G, ln_W, central)
            out[1, k, j] = thinnest
            if at_reduction > 0:
                out[at_reduction, k, j] = thermal_reduction(ln_heating + 2.0 * ln_u)
                thinnest *= out[at_reduction, k, j]
            if at_ratio > 0:
                out[at_ratio, k, j] = thinnest / roughness[k]


def inlet_shear_heating(speed: ArrayLike, pitch_diameter: ArrayLike, kinematic_viscosity: ArrayLike) -> NDArray:
    """phi_ish = 1/(1 + 1.84e-9 (n dm)^1.28 nu^0.64) of SKF's General Catalogue; arguments in SI units."""
    n, dm = np.abs(np.asarray(speed, float)) / rpm, np.asarray(pitch_diameter, float) / mm
    nu = np.asarray(kinematic_viscosity, float) / mm**2
    return np.asarray(1.0 / (1.0 + 1.84e-9 * (n * dm) ** 1.28 * nu**0.64))


def _inlet_shear_heating(solution: Solution, kinematic_viscosity: ArrayLike) -> NDArray:
    inner, outer = ring_speeds(solution)
    pitch = BearingNumbers(solution.scene.operating_bearing).pitch_diameter
    return np.broadcast_to(inlet_shear_heating((inner - outer)[..., 0], pitch, kinematic_viscosity), solution.shape)


def _raceway(
    solution: Solution, contacts: RacewayContacts, oil: OilState, side: float, rough: NDArray | None
) -> RacewayFilm:
    numbers = BearingNumbers(solution.scene.operating_bearing)
    is_heated = oil.temperature_viscosity is not None and oil.thermal_conductivity is not None
    heating: NDArray | float = nan
    if is_heated:
        beta, eta, k = (
            np.asarray(each, float)
            for each in (oil.temperature_viscosity, oil.dynamic_viscosity, oil.thermal_conductivity)
        )
        heating = beta * eta / k
    g, *given = of_cases(
        solution, gamma(solution)[..., 0], numbers.ball_diameter, numbers.effective_modulus, oil.dynamic_viscosity,
        oil.pressure_viscosity, nan if rough is None else rough, heating,
    )  # fmt: skip
    shape = contacts.semi_major_axis, contacts.semi_minor_axis
    arrays = of_balls(contacts.load, contacts.sine, contacts.cosine, *shape)
    at_reduction = 2 if is_heated else -1
    at_ratio = -1 if rough is None else 2 + is_heated
    places = side, at_reduction, at_ratio
    films = filled(solution, max(1, *places[1:]) + 1, _fill, motion_arrays(solution), *places, g, tuple(given), *arrays)
    parameter, reduction = (None if at < 0 else films[at] for at in (at_ratio, at_reduction))
    return RacewayFilm(films[0], films[1], parameter, reduction)


def _found(oil: OilState, inner: RacewayFilm, outer: RacewayFilm, factor: NDArray | None) -> list[tuple[Any, Remark]]:
    holding: list[tuple[Any, Remark]] = []
    if oil.is_estimated:
        holding.append((True, remark(PRESSURE_VISCOSITY_ESTIMATED)))
    if factor is not None and inner.thermal_reduction is None:
        holding.append((factor < WARM_INLET, remark(FILM_ISOTHERMAL, limit=WARM_INLET)))
    spread = {"limit_percent": 100.0 * (1.0 - WARM_INLET), "spread_percent": 100.0 * FACTOR_SPREAD}
    for name, raceway in (("inner", inner), ("outer", outer)):
        if raceway.thermal_reduction is not None:
            heated = (raceway.thermal_reduction < WARM_INLET).any(axis=-1)
            holding.append((heated, remark(FILM_REDUCED, name, **spread)))
        if raceway.film_parameter is not None:
            holding.append(((raceway.film_parameter < MIXED).any(axis=-1), remark(FILM_THIN, name)))
    return holding


ENTRY = Reading(
    name="film",
    gives="central and minimum thickness with each ball's own entrainment speed; film parameter",
    by="Hamrock & Dowson; ASTM D341, D2270",
    take=simply(film),
    record=FilmArguments,
    table=ReadingTable(
        example="""\
ball_roughness_um = 0.02
raceway_roughness_um = 0.1
""",
    ),
    needs=NEEDS,
    of_case=(
        Result("inlet_shear_heating", words="inlet shear heating by SKF"),
        Result("combined_roughness", "um"),
    ),
    of_contact=(
        Result("central_thickness", "um", "central thickness, isothermal"),
        Result("minimum_thickness", "um", "minimum thickness, isothermal"),
        Result("reduced_minimum_thickness", "um", "the minimum reduced by inlet heating"),
        Result("film_parameter", words="film parameter, of the reduced minimum", symbol=r"\Lambda"),
        Result("thermal_reduction", words="film reduction by inlet heating"),
    ),
    scope="Film: the film parameter is that of the reduced minimum; the other thicknesses are isothermal. Published "
    f"factors of the reduction by inlet heating differ by about {100 * FACTOR_SPREAD:.0f} %.",
)
