"""How far a ring deflects under the pressure of its balls, alone or with shaft or housing, by harmonics.

Source        Timoshenko & Goodier, Theory of Elasticity: Lame's cylinder, n = 0; Michell's solution of the plane
              problem in polar coordinates, n >= 2 (displacements of its terms as in Barber, Elasticity, table 9.1)
Equation      Airy's function cos(n theta) (A r^n + B r^(n+2) + C r^-n + D r^(2-n)), plane stress; both rims without
              shear. A term r^m has sigma_r = (m - n^2) r^(m-2) cos(n theta), tau = n (m - 1) r^(m-2) sin(n theta)
Assumes       a ring of rectangular section, free to contract along its axis; a smooth seat, on which it may slide but
              from which it does not part: ring and seat move radially as one
When not      a section that varies much along its axis; its twisting is no part of this

n = 1 moves a ring as a body: that load its mount carries, and its place holds 0. All arguments are SI and may be arrays
over cases; harmonics n = 0, 1, 2, ... lie along the first axis of results.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.annulus import Elastic, displacement, stress_by_pressure

MOST_HARMONICS = 24
"""As many are taken (`of_section` says what is left out)."""
SOLID = 1e-4
"""A bore this much smaller than the outside hardly counts in bending, whose stress at the centre vanishes or, n = 2, is
disturbed by the square of that; closer to zero its equations overflow."""


class Annulus(NamedTuple):
    """A ring, shaft or housing a < r < b of some material; a = 0 is a solid shaft."""

    a: Any
    b: Any
    modulus: Any
    poisson_ratio: Any


class RimCompliances(NamedTuple):
    """Outward displacement of one rim by a pressure cos(n theta) on one rim, bore or outside [m/Pa], by harmonics."""

    bore_by_bore: NDArray
    bore_by_outside: NDArray
    outside_by_bore: NDArray
    outside_by_outside: NDArray


def rim_compliances(body: Annulus) -> RimCompliances:
    """Of a ring or seat; of a solid shaft `outside_by_outside` alone means something."""
    body = Annulus(*np.broadcast_arrays(*(np.asarray(each, float) for each in body)))
    bent = _michell(body)
    return RimCompliances(*(np.stack([uniform, 0.0 * uniform, *bent[..., i, j]]) for i, j, uniform in _uniform(body)))


def _uniform(body: Annulus) -> list[tuple[int, int, NDArray]]:
    elastic = Elastic(body.modulus, body.poisson_ratio, 0.0)
    displacements = []
    for i, radius in enumerate(
        (np.where(body.a < SOLID * body.b, body.b, body.a), body.b)
    ):  # a solid shaft has no bore
        for j, pressures in enumerate(((1.0, 0.0), (0.0, 1.0))):
            stress = stress_by_pressure(radius, body.a, body.b, *pressures)
            displacements.append((i, j, np.asarray(displacement(radius, stress, elastic))))
    return displacements


def _michell(body: Annulus) -> NDArray:
    """(harmonic from 2 on, *cases, rim moved, rim pressed); lengths in b."""
    a, b, modulus, nu = body
    n = np.arange(2.0, MOST_HARMONICS + 1).reshape(-1, *(1,) * a.ndim)
    is_solid = a < SOLID * b
    ratio = np.where(is_solid, 0.5, a / b)
    kappa = (3.0 - nu) / (1.0 + nu)
    shape = np.broadcast_shapes(n.shape, a.shape)
    # Each term is 1 at the rim where it is largest, so that high harmonics stay well conditioned.
    terms: list[tuple[Any, Any, Any]] = [  # the power m, the radius of 1, and 2 G u_r/r^(m-1)
        (n, 1.0, -n),
        (n + 2.0, 1.0, kappa - 1.0 - n),
        (-n, ratio, n),
        (2.0 - n, ratio, kappa - 1.0 + n),
    ]
    system, moved = np.zeros((*shape, 4, 4)), np.zeros((*shape, 2, 4))
    for column, (m, largest_at, outward) in enumerate(terms):
        for rim, radius in enumerate((ratio, 1.0)):
            size = (radius / largest_at) ** m / radius
            system[..., rim, column] = (m - n * n) * size / radius
            system[..., 2 + rim, column] = n * (m - 1.0) * size / radius
            moved[..., rim, column] = outward * size
    # In a solid shaft the last two terms are endless at the centre: there the bore's equations say that they vanish.
    solid = np.broadcast_to(is_solid, shape)[..., None]
    system[..., (0, 2), :] = np.where(solid[..., None], np.eye(4)[2:], system[..., (0, 2), :])
    system[..., (1, 3), 2:] = np.where(solid[..., None], 0.0, system[..., (1, 3), 2:])
    pressed = np.zeros((*shape, 4, 2))
    pressed[..., 0, 0] = np.where(solid[..., 0], 0.0, -1.0)
    pressed[..., 1, 1] = -1.0
    return np.asarray(moved @ np.linalg.solve(system, pressed) * (b * (1.0 + nu) / modulus)[..., None, None])  # b/2G


class PressureCompliance(NamedTuple):
    """How a ring deflects under a pressure p_n cos(n theta) on the bottom of its groove, by harmonics."""

    groove: NDArray
    """u_n/p_n, away from the balls [m/Pa]."""
    seat: NDArray
    """Pressure at its seat over p_n; 0 without a seat."""


def outer_ring_compliance(ring: Annulus, housing: Annulus | None) -> PressureCompliance:
    """Of an outer ring, in a housing or free; its groove's bottom is its bore."""
    ring, housing = _broadcast(ring, housing)
    own = rim_compliances(ring)
    if housing is None:
        return PressureCompliance(own.bore_by_bore, 0.0 * own.bore_by_bore)
    held = rim_compliances(housing).bore_by_bore - own.outside_by_outside
    seat = _ratio(own.outside_by_bore, held)
    return PressureCompliance(own.bore_by_bore + own.bore_by_outside * seat, seat)


def inner_ring_compliance(ring: Annulus, shaft: Annulus | None) -> PressureCompliance:
    """Of an inner ring, on a shaft or free; its groove's bottom is its outside."""
    ring, shaft = _broadcast(ring, shaft)
    own = rim_compliances(ring)
    if shaft is None:
        return PressureCompliance(-own.outside_by_outside, 0.0 * own.outside_by_outside)
    held = rim_compliances(shaft).outside_by_outside - own.bore_by_bore
    seat = _ratio(own.bore_by_outside, held)
    return PressureCompliance(-(own.outside_by_outside + own.outside_by_bore * seat), seat)


def _broadcast(ring: Annulus, seat: Annulus | None) -> tuple[Annulus, Annulus | None]:
    """Both over the same cases."""
    numbers = np.broadcast_arrays(*(np.asarray(each, float) for each in (*ring, *(seat or ()))))
    return Annulus(*numbers[:4]), None if seat is None else Annulus(*numbers[4:])


def _ratio(moved: NDArray, held: NDArray) -> NDArray:
    return np.divide(moved, held, out=np.zeros(np.broadcast(moved, held).shape), where=held != 0.0)


def of_section(compliance: NDArray, radius: Any, modulus: Any) -> NDArray:
    """u_n/p_n by which the section moves as one: less what is local.

    That is a half-plane's compression, 2 r/(E n), which Hertz's contact has already. Harmonics shorter than the ring is
    wide count too: finite elements of one pitch in three dimensions have more deflection than with them, not less. Of
    the bending under one load on a thin ring, what is beyond n = 12 makes 1.3e-3, beyond 24 2e-4.
    """
    n = np.arange(float(len(compliance))).reshape(-1, *(1,) * (compliance.ndim - 1))
    local = 2.0 * np.asarray(radius, float) / (np.asarray(modulus, float) * np.maximum(n, 1.0))
    return np.where(n < 2.0, compliance, np.maximum(compliance - local, 0.0))


def by_load(compliance: NDArray, radius: Any, width: Any) -> NDArray:
    """c_n [m/N]: a load F at one place moves the groove, an angle t further, by the sum of c_n F cos(n t).

    The load's harmonics are p_n = e_n F/(2 pi r B), e_0 = 1, else 2.
    """
    size = np.full((len(compliance), *(1,) * (compliance.ndim - 1)), 2.0)
    size[0] = 1.0
    return np.asarray(size * compliance / (2.0 * np.pi * np.asarray(radius, float) * np.asarray(width, float)))
