"""A 7210B's contact constants and angle by another program, and Marc's benchmark of a sphere on a rigid plane."""

from __future__ import annotations

import numpy as np

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.published import bearing
from fem_check.rows.row_text import scientific

PROGRAM = "an open quasi-static program, read by an earlier evaluation"
MARC = "Marc, benchmark of a sphere on a rigid plane"
STEEL = {"ball_material": qs.STEEL, "ring_material": qs.STEEL}
THRUST, RPM = 2000.0, 10000.0
CONSTANTS = {"inner": 3.26859e10, "outer": 3.39992e10}
"""K of Q = K approach^1.5 [N/m^1.5]."""
ANGLE = 48.4572
"""Inner contact angle [degrees], with a softened contact law."""
RADIUS, MODULUS, POISSON, LOAD, CONTACT = 8.0, 1000.0, 0.3, 188.5, 1.010
"""Sphere [mm], its steel [MPa], load [N], and the printed radius of the contact [mm]."""


def solved(rpm: float | np.ndarray) -> qs.Solution:
    """The 7210B at these speeds."""
    operation = qs.Operation(speed=np.asarray(rpm) * qs.rpm, axial_load=THRUST)
    effects = (qs.CentrifugalForce(), qs.GyroscopicMoment())
    return qs.solve(qs.Scene(bearing(16, 12.7, 70.0, 40.0, **STEEL), operation, effects, qs.RacewayControl.OUTER))


def run() -> CaseResult:
    """Constants, angle, and the sphere."""
    solution, case = solved(RPM), f"7210B, {THRUST / 1e3:.0f} kN, {RPM:.0f} rpm"
    rows, constants = [], {}
    for name, contacts in (("inner", solution.inner), ("outer", solution.outer)):
        constants[name] = float(contacts.load[0] / contacts.approach[0] ** 1.5)
        rows.append(
            compared(case, f"{name} contact constant", "N/m^1.5", CONSTANTS[name], constants[name], PROGRAM, 5e4,
                     "six digits are printed")
        )  # fmt: skip
    angle = float(solution.inner.angle[0]) / qs.deg
    rows.append(
        compared(case, "inner contact angle", "degrees", ANGLE, angle, PROGRAM, None,
                 "a finding: the other program's contact is softer than Hertz's")
    )  # fmt: skip
    sphere = qs.point_contact(LOAD, 1e3 / RADIUS, 1e3 / RADIUS, 2e6 * MODULUS / (1.0 - POISSON**2))
    contact = 1e3 * sphere.semi_major_axis
    rows.append(
        compared("sphere of 8 mm on a rigid plane, 188.5 N", "radius of the contact", "mm", CONTACT, contact, MARC,
                 5e-4, "three decimals are printed")
    )  # fmt: skip
    speeds = np.linspace(0.0, 15000.0, 31)[1:]
    curve = solved(speeds)
    return CaseResult(
        f"Constants {scientific(constants['inner'], 6)} and {scientific(constants['outer'], 6)} N/m^1.5, inner "
        f"angle {angle:.4f} degrees (printed {ANGLE}); contact radius of the sphere {contact:.4f} mm.",
        rows,
        [
            Diagram(
                "speed, rpm", "contact angle, degrees",
                [
                    Curve("inner", "line", speeds, curve.inner.angle[:, 0] / qs.deg),
                    Curve("outer", "dashed", speeds, curve.outer.angle[:, 0] / qs.deg),
                    Curve("the other program, inner", "circles", [RPM], [ANGLE]),
                ],
            )
        ],
    )  # fmt: skip
