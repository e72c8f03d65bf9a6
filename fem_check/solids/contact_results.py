"""What is read off a solved contact: load, angle, ellipse, largest pressure."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2

import numpy as np

from fem_check.contact import ContactError
from fem_check.contact_problem import Array
from fem_check.solids.contact_frame import ContactFrame

FIT_REACH = 0.6
"""The largest pressure is read from a fit within this part of the ellipse."""


@dataclass(frozen=True)
class ContactResults:
    """Quantities of one contact; SI units."""

    load: float
    """Size of the normal pressure's resultant [N]."""
    angle: float
    """Of that resultant, from the radial plane towards +x on the raceway's side of load [rad]."""
    semi_major_axis: float
    """sqrt(5 <xi^2>) of the pressure about its own centre, on the tangent plane [m]; exact for Hertz's pressure."""
    semi_minor_axis: float
    """sqrt(5 <eta^2>) [m]."""
    max_pressure: float
    """Of the pressure itself, by a smooth fit round its centre [Pa]."""


def read(frame: ContactFrame, pressure: Array) -> ContactResults:
    """Read a contact.

    Raises:
        ContactError: the contact is unloaded, or reaches the edge of its patch.
    """
    force = frame.resultants @ pressure
    basis = frame.basis
    total = float(basis.forces @ pressure)
    if not total > 0.0:
        raise ContactError("a contact of the ball is not loaded")
    x, y = basis.points
    edge = (np.abs(x) >= basis.lines_x[-1] * (1.0 - 1e-9)) | (y >= basis.lines_y[-1] * (1.0 - 1e-9))
    if (pressure[edge] > 0.0).any():
        raise ContactError("a contact fills the whole patch that its mesh allows: it is not where it was expected")
    centre = float(basis.weighted(lambda x, y: x) @ pressure) / total
    a = np.sqrt(5.0 * (basis.weighted(lambda x, y: (x - centre) ** 2) @ pressure) / total)
    b = np.sqrt(5.0 * (basis.weighted(lambda x, y: y**2) @ pressure) / total)
    side = 1.0 if frame.normal[1] > 0.0 else -1.0
    return ContactResults(
        load=float(np.hypot(*force)),
        angle=atan2(side * force[0], side * force[1]),
        semi_major_axis=float(a),
        semi_minor_axis=float(b),
        max_pressure=_largest(x - centre, y, pressure, float(a), float(b)),
    )


def _largest(x: Array, y: Array, pressure: Array, a: float, b: float) -> float:
    """Largest value of a fit to p^2, of which Hertz's is quadratic; even in y, any power of x to the fourth."""
    u, v = x / a, (y / b) ** 2
    near = u * u + v < FIT_REACH**2
    u, v = u[near], v[near]
    # On the plane of symmetry a point stands for itself, beside it for two.
    weight = np.where(v > 0.0, 2.0, 1.0) ** 0.5
    powers = [np.ones_like(u), u, u * u, v, u * v, u**3, u**4, u * u * v, v * v]
    table = np.stack(powers, axis=1)[:, : max(4, min(len(powers), len(u) // 2))]
    fit = np.linalg.lstsq(table * weight[:, None], pressure[near] ** 2 * weight, rcond=None)[0]
    at = np.linspace(-0.3, 0.3, 1201)
    along = np.stack([np.ones_like(at), at, at * at, 0 * at, 0 * at, at**3, at**4, 0 * at, 0 * at])[: len(fit)]
    return float(np.sqrt((fit @ along).max()))
