"""What is read off a solved contact: load, angle, ellipse, largest pressure."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2

import numpy as np

from fem_check.independent.contact_problem import Array
from fem_check.mechanics.contact import ContactError
from fem_check.solids.contact_frame import ContactFrame

FIT_REACH = 0.75
"""The largest pressure is read from a fit within this part of the ellipse: the edge, where the discrete pressure
oscillates, stays out."""


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
    centre: float
    """Of the pressure, from the frame's origin across the groove [m]."""


def read(frame: ContactFrame, pressure: Array) -> ContactResults:
    """Read a contact.

    Raises:
        ContactError: the contact is unloaded, or reaches the edge of its patch.
    """
    force = frame.resultants @ pressure
    if not (pressure > 0.0).any():
        raise ContactError("a contact of the ball is not loaded")
    side = 1.0 if frame.normal[1] > 0.0 else -1.0
    return ContactResults(
        load=float(np.hypot(*force)), angle=atan2(side * force[0], side * force[1]), **_read(frame, pressure)
    )


def ellipse(frame: ContactFrame, pressure: Array) -> dict[str, float]:
    """Semi-axes and largest pressure of a loaded contact, by their names in `ContactResults`.

    Raises:
        ContactError: it reaches the edge of its patch.
    """
    quantities = _read(frame, pressure)
    del quantities["centre"]
    return quantities


def _read(frame: ContactFrame, pressure: Array) -> dict[str, float]:
    basis = frame.basis
    total = float(basis.forces @ pressure)
    x, y = basis.points
    edge = (np.abs(x) >= basis.lines_x[-1] * (1.0 - 1e-9)) | (y >= basis.lines_y[-1] * (1.0 - 1e-9))
    if (pressure[edge] > 0.0).any():
        raise ContactError("a contact fills the whole patch that its mesh allows: it is not where it was expected")
    centre = float(basis.weighted(lambda x, y: x) @ pressure) / total
    a = np.sqrt(5.0 * (basis.weighted(lambda x, y: (x - centre) ** 2) @ pressure) / total)
    b = np.sqrt(5.0 * (basis.weighted(lambda x, y: y**2) @ pressure) / total)
    return {
        "centre": centre,
        "semi_major_axis": float(a),
        "semi_minor_axis": float(b),
        "max_pressure": _largest(frame, pressure, centre, float(a), float(b)),
    }


def _largest(frame: ContactFrame, pressure: Array, centre: float, a: float, b: float) -> float:
    """Largest value of Hertz's pressure times a quadratic, fitted by least squares over the inner part of the ellipse.

    Even in eta by symmetry; samples fade out towards the reach of the fit. For Hertz's own pressure it is exact.
    """
    (xi, eta), area = frame.basis.samples
    x, y = (xi - centre) / a, eta / b
    rho2 = x * x + y * y
    near = rho2 < FIT_REACH**2
    weight = np.sqrt(area[near] * (FIT_REACH**2 - rho2[near]))
    x, y, rho2 = x[near], y[near], rho2[near]
    table = np.sqrt(1.0 - rho2) * np.stack([np.ones_like(x), x, x * x, y * y])
    values = (frame.basis.values(xi[near], eta[near]) @ pressure) * weight
    fit = np.linalg.lstsq((table * weight).T, values, rcond=None)[0]
    at = np.linspace(-0.3, 0.3, 601)
    return float((np.sqrt(1.0 - at * at) * (fit[0] + fit[1] * at + fit[2] * at * at)).max())
