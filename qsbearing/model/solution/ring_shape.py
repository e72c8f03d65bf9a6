"""What elastic rings make of a solved case: growth and shape of each ring, pressure at its seat.

From the balls' radial loads on each ring, by the compliances of `effects.elastic_rings`; arrays lead with case axes.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.elastic_rings import ElasticRings, RingCompliance, grooves_of
from qsbearing.model.effects.ring_compliance import MOST_HARMONICS
from qsbearing.model.solution.groups import SolvedScene

AROUND = np.linspace(0.0, 2.0 * np.pi, 361)[:-1]
"""Azimuths at which extremes around a ring are looked for [rad]."""


class RingShape(NamedTuple):
    """How one ring has given way; away from the balls positive: an outer ring grows, an inner one is pressed inward."""

    growth: NDArray
    """Even all round, n = 0; shape (*cases) [m]."""
    bending: NDArray
    """Largest departure from that around the groove [m]."""
    amplitudes: NDArray
    """By harmonics along the last axis, n = 0, 1, 2, ... [m]."""
    seat_pressure: NDArray | None
    """Mean at the seat by the balls' loads, a fit's not included [Pa]; None where no seat is described."""
    least_seat_pressure: NDArray | None
    """Around the seat: the pressure that its fit must make up where it is below zero [Pa]."""
    largest_seat_pressure: NDArray | None
    """[Pa]"""


def radial_loads(solution: SolvedScene) -> tuple[NDArray, NDArray]:
    """Of each ball on the inner and the outer ring, friction's part included; shape (*cases, ball) [N]; 0: no ball."""
    loads = []
    moment, turning = solution.scene.gyroscopic_moment, solution.gyroscopic_moment
    for side in (solution.inner, solution.outer):
        load = side.load * side.cosine
        if side.required_friction is not None and moment is not None and turning is not None:
            most = np.inf if moment.friction_coefficient is None else moment.friction_coefficient
            most = np.asarray(most, float)[..., None]
            friction = np.nan_to_num(np.minimum(side.required_friction, most) * side.load)
            load = load + np.sign(np.nan_to_num(turning)) * friction * side.sine
        loads.append(np.nan_to_num(load))
    return loads[0], loads[1]


def shape_of(solution: SolvedScene, side: str) -> RingShape | None:
    """Of the inner or the outer ring; None where the scene has it rigid."""
    number, compliance = _compliance(solution, side)
    if compliance is None:
        return None
    sums = _fourier_sums(solution, radial_loads(solution)[number])
    amplitude = _by_case(compliance.by_load, sums)
    moved = _around(amplitude)
    solved = np.where(solution.converged, 1.0, np.nan)
    pressures: tuple[Any, Any, Any] = (None, None, None)
    if compliance.seat is not None:
        harmonics = _by_case(compliance.seat, sums)
        pressure = _around(harmonics)
        pressures = (
            harmonics[..., 0].real * solved,
            pressure.min(axis=-1) * solved,
            pressure.max(axis=-1) * solved,
        )
    growth = amplitude[..., 0].real
    bending = np.abs(moved - growth[..., None]).max(axis=-1)
    return RingShape(growth * solved, bending * solved, np.abs(amplitude) * solved[..., None], *pressures)


def mean_seat_pressure(solution: SolvedScene, rings: ElasticRings, side: str) -> NDArray:
    """By the solution's loads at the seat of one of these rings; shape (*cases) [Pa]."""
    number = ("inner", "outer").index(side)
    compliance = rings.compliances(grooves_of(solution.scene.operating_bearing))[number]
    assert compliance is not None and compliance.seat is not None
    return np.asarray(compliance.seat[0] * radial_loads(solution)[number].sum(axis=-1))


def groove_shape(solution: SolvedScene, side: str, azimuth: NDArray) -> NDArray:
    """How far the groove has moved away from the balls at these azimuths; shape (*cases, azimuth) [m]."""
    number, compliance = _compliance(solution, side)
    if compliance is None:
        return np.zeros((*solution.shape, azimuth.size))
    return _around(_by_case(compliance.by_load, _fourier_sums(solution, radial_loads(solution)[number])), azimuth)


def _compliance(solution: SolvedScene, side: str) -> tuple[int, RingCompliance | None]:
    number, rings = ("inner", "outer").index(side), solution.scene.elastic_rings
    return number, None if rings is None else rings.compliances(grooves_of(solution.scene.operating_bearing))[number]


def _fourier_sums(solution: SolvedScene, load: NDArray) -> NDArray:
    """Sum of F exp(i n psi) over the balls, (*cases, harmonic)."""
    n = np.arange(MOST_HARMONICS + 1)
    turned = np.exp(1j * n * np.nan_to_num(solution.azimuth)[..., None])
    return np.asarray((load[..., None] * turned).sum(axis=-2))


def _by_case(by_harmonic: NDArray, sums: NDArray) -> NDArray:
    """Amplitudes (*cases, harmonic) of a linear answer by harmonic, whose first axis is the harmonic."""
    return np.moveaxis(by_harmonic, 0, -1) * sums


def _around(amplitude: NDArray, azimuth: NDArray = AROUND) -> NDArray:
    """Their sum at these azimuths, (*cases, azimuth)."""
    n = np.arange(amplitude.shape[-1])
    return np.asarray((amplitude @ np.exp(-1j * n[:, None] * azimuth)).real)


def share_of_displacement(solution: SolvedScene, rigid: SolvedScene) -> NDArray:
    """What part of the axial displacement is the rings': all of it less that between rigid rings; shape (*cases)."""
    own, other = solution.displacement[..., 0], rigid.displacement[..., 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray((own - other) / own)
