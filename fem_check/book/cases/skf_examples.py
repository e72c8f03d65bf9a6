"""Worked examples of SKF's General Catalogue: rating life of a 6309, two friction factors of a 22208 E."""

from __future__ import annotations

import numpy as np

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.published import bearing
from qsbearing.readings import film_thickness, friction_estimate, life_factors

LIFE = "SKF General Catalogue, Russian edition, pp. 78-81"
FRICTION = "SKF General Catalogue, Russian edition, pp. 104-105"
C, P, RPM = 55.3e3, 10e3, 3000.0
NU, NU_1 = 20e-6, 8.15e-6
"""Viscosity of the 6309's oil, and the one that the catalogue's diagram asks for [m^2/s]."""
OIL, SPEED, BORE, OUTSIDE = 68.0, 3500.0, 40.0, 80.0
"""22208 E: mm^2/s, rpm, mm."""


def life(load: float | np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Basic rating life of the 6309 [10^6 revolutions, hours] under a radial load [N]."""
    ball_bearing = bearing(8, 17.5, 72.5, 0.0, kind=qs.BearingKind.DEEP_GROOVE)
    operation = qs.Operation(speed=RPM * qs.rpm, radial_load_y=load, axial_displacement=0.0, tilt_y=0.0, tilt_z=0.0)
    reading = qs.readings.life(qs.solve(qs.Scene(ball_bearing, operation)), dynamic_load_rating=C)
    millions = np.asarray(reading.basic_rating_life) / 1e6
    return millions, millions * 1e6 / RPM / 60.0


def run() -> CaseResult:
    """Printed against computed."""
    millions, hours = life(P)
    pitch = 0.5 * (BORE + OUTSIDE) * 1e-3
    starved = friction_estimate.replenishment_factor(np.array(OIL), np.array(SPEED), BORE, OUTSIDE, 5.5, 3e-8)
    nu_1 = float(life_factors.reference_viscosity(RPM * qs.rpm, 72.5e-3))
    a = "6309: C 55.3 kN, P 10 kN, 3000 rpm"
    b = "22208 E: 68 mm²/s, 3500 rpm"
    rows = [
        compared(a, "L10", "10⁶ rev", 169.0, millions, LIFE, 0.5, "printed to a million"),
        compared(a, "L10h", "h", 940.0, hours, LIFE, 0.5, "printed to an hour"),
        compared(
            a,
            "viscosity that the film needs, by ISO 281's formula",
            "mm²/s",
            1e6 * NU_1,
            1e6 * nu_1,
            LIFE,
            None,
            "a finding: the catalogue's diagram and the standard's formula differ by a fifth",
        ),
        compared(
            b,
            "inlet shear heating factor",
            "1",
            0.85,
            film_thickness.inlet_shear_heating(SPEED * qs.rpm, pitch, OIL * 1e-6),
            FRICTION,
            5e-3,
            "two decimals are printed",
        ),
        compared(b, "replenishment factor", "1", 0.8, starved, FRICTION, 0.05, "one decimal is printed"),
        compared(
            b,
            "replenishment factor, regression",
            "1",
            0.7988,
            starved,
            "the formula by hand",
            5e-5,
            "four digits: K_rs 3e-8, K_Z 5.5 of spherical roller bearings",
        ),
    ]
    loads = np.linspace(3e3, 20e3, 40)
    return CaseResult(
        f"6309: {float(millions):.1f} million revolutions, {float(hours):.1f} h; printed 169 and 940.",
        rows,
        [
            Diagram(
                "equivalent load, kN",
                "L10, 10⁶ revolutions",
                [
                    Curve("computed", "line", loads / 1e3, life(loads)[0]),
                    Curve("printed", "circles", [P / 1e3], [169.0]),
                ],
                x_scale="log",
                y_scale="log",
            )
        ],
    )
