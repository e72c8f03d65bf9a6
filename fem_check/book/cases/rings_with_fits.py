"""Both rings turning on fitted seats at five temperatures: another program's growth, angles and loads.

The other program moves the groove centres by what the bottoms of the grooves grow, and leaves the groove radii cold.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared

PROGRAM = "an open Python program of ball bearings, run by an earlier evaluation"
HAND = "Lamé's thick rings with rotation, worked out in the case"
Numbers = tuple[float, float, float, float]
"""Elastic modulus [Pa], Poisson's ratio, density [kg/m^3], expansion [1/K]."""
STEEL: Numbers = (203e9, 0.28, 7830.0, 1.13e-5)
SHAFT: Numbers = (205e9, 0.29, 7850.0, 1.33783e-5)
HOUSING: Numbers = (205e9, 0.29, 7850.0, 1.33174e-5)
D, PITCH, ANGLE = 22.225e-3, 167.5375e-3, 27.0 * qs.deg
INNER_GROOVE, OUTER_GROOVE = 11.557e-3, 11.445875e-3
BORE, OUTSIDE, HOLLOW, OUTER_HOUSING, FIT = 133.35e-3, 201.725e-3, 100e-3, 220e-3, 50e-6
REFERENCE, INNER, OUTER, WARM_SHAFT, WARM_HOUSING = 159.85, 177.85, 168.85, 175.85, 161.85
"""[°C]"""
INNER_RPM, OUTER_RPM, THRUST = 12000.0, 4000.0, 2000.0
GROWTH = {"inner": 47.64, "outer": -2.14}
"""Of the grooves by the other program [µm]."""
CONTACTS = {
    "inner angle": 27.971,
    "outer angle": 2.1630,
    "inner load": 213.21,
    "outer load": 2649.43,
    "centrifugal": 2459.2,
}
"""Degrees and N of each ball; the force follows from the loads."""


def scene() -> qs.Scene:
    """The other program's input."""
    steel = qs.Material(*STEEL)
    bearing = qs.BallBearing(20, D, PITCH, INNER_GROOVE, OUTER_GROOVE, ANGLE, ball_material=steel, ring_material=steel)
    rings = qs.RingExpansion(
        BORE, OUTSIDE, shaft_interference=FIT, shaft_bore_diameter=HOLLOW, shaft_material=qs.Material(*SHAFT),
        shaft_temperature=WARM_SHAFT + qs.zero_celsius, inner_ring_temperature=INNER + qs.zero_celsius,
        outer_ring_temperature=OUTER + qs.zero_celsius, housing_interference=FIT,
        housing_outside_diameter=OUTER_HOUSING, housing_material=qs.Material(*HOUSING),
        housing_temperature=WARM_HOUSING + qs.zero_celsius, reference_temperature=REFERENCE + qs.zero_celsius,
    )  # fmt: skip
    balls = qs.BallExpansion(REFERENCE + qs.zero_celsius, REFERENCE + qs.zero_celsius)  # theirs do not grow
    operation = qs.Operation(speed=INNER_RPM * qs.rpm, outer_speed=OUTER_RPM * qs.rpm, axial_load=THRUST)
    return qs.Scene(bearing, operation, (qs.CentrifugalForce(),), qs.RacewayControl.OUTER, ring_effects=(rings, balls))


def as_theirs(of: qs.Scene, growth: float) -> qs.Solution:
    """The scene with cold groove radii, and centres that part by the growth of both grooves' bottoms [m]."""
    steel, cold = qs.Material(*STEEL), INNER_GROOVE + OUTER_GROOVE - D
    angle = np.arccos((cold * np.cos(ANGLE) + growth) / cold)
    pitch = of.operating_bearing.pitch_diameter
    bearing = qs.BallBearing(20, D, pitch, INNER_GROOVE, OUTER_GROOVE, angle, ball_material=steel, ring_material=steel)
    return qs.solve(replace(of, bearing=bearing, ring_effects=()))


def read(solution: qs.Solution) -> dict[str, float]:
    """CONTACTS of a solution."""
    return {
        "inner angle": float(solution.inner.angle[0]) / qs.deg, "outer angle": float(solution.outer.angle[0]) / qs.deg,
        "inner load": float(solution.inner.load[0]), "outer load": float(solution.outer.load[0]),
        "centrifugal": float(np.asarray(solution.centrifugal_force)[0]),
    }  # fmt: skip


def pressure_by_hand() -> float:
    """Seat pressure of the inner ring on its shaft [Pa]: the overlap of both over what a unit pressure closes."""
    a, seat = 0.5 * HOLLOW, 0.5 * BORE
    bottom = 0.5 * PITCH + (INNER_GROOVE - 0.5 * D) * np.cos(ANGLE) - INNER_GROOVE
    omega = float(INNER_RPM * qs.rpm)

    def grown(r: float, inside: float, outside: float, m: Numbers, warmer: float) -> float:
        """Free growth of a turning annulus at r, plane stress; a warm body keeps its mass, so its density falls."""
        E, nu, density, expansion = m
        strain = expansion * warmer
        force = density / (1.0 + strain) * omega**2 / (8.0 * E)
        squares = (3 + nu) * (1 - nu) * (inside**2 + outside**2) * r - (1 - nu**2) * r**3
        return force * (squares + (3 + nu) * (1 + nu) * (inside * outside) ** 2 / r) + strain * r

    def softness(r: float, inside: float, outside: float, m: Numbers, sign: float) -> float:
        """Radial way of a seat at r by a unit pressure there; sign -1: at the outside of its annulus."""
        ratio = (outside**2 + inside**2) / (outside**2 - inside**2)
        return sign * r / m[0] * (ratio + sign * m[1])

    overlap = 0.5 * FIT + grown(seat, a, seat, SHAFT, WARM_SHAFT - REFERENCE)
    overlap -= grown(seat, seat, bottom, STEEL, INNER - REFERENCE)
    return overlap / (softness(seat, seat, bottom, STEEL, 1.0) - softness(seat, a, seat, SHAFT, -1.0))


def run() -> CaseResult:
    """Pressure and growth, then angles and loads as findings."""
    of = scene()
    solution = qs.solve(of)
    inner, outer = solution.inner_ring, solution.outer_ring
    assert inner is not None
    assert outer is not None
    by_hand, case = pressure_by_hand(), "inner ring 12,000 rpm, outer ring 4000 rpm, fits and temperatures"
    pressure = float(np.asarray(inner.seat_pressure))
    rows = [
        compared(case, "seat pressure of the inner ring", "MPa", 1e-6 * by_hand, 1e-6 * pressure, HAND,
                 1e-15 * by_hand, "the same closed form, worked out twice: 1e-9 of it for rounding"),
    ]  # fmt: skip
    now = of.operating_bearing
    bars: dict[str, list[float]] = {}
    for name, ring, radius, warm, side in (
        ("inner", inner, INNER_GROOVE, now.inner_groove_radius, -1.0),
        ("outer", outer, OUTER_GROOVE, now.outer_groove_radius, 1.0),
    ):
        centre, own = 1e6 * float(np.asarray(ring.groove_growth)), 1e6 * (float(np.asarray(warm)) - radius)
        bars[name] = [centre, own, centre + side * own]
        rows += [
            compared(case, f"growth of the {name} groove, its centre's with its radius's", "µm", GROWTH[name],
                     bars[name][2], PROGRAM, 0.005, "two decimals are printed"),
            compared(case, f"growth of the {name} groove's centre alone", "µm", GROWTH[name], centre, PROGRAM, None,
                     f"a finding: the radius's own growth, {own:.2f} µm, is not the centre's"),
        ]  # fmt: skip
    values = read(solution)
    theirs = read(as_theirs(of, 1e-6 * (bars["inner"][2] - bars["outer"][2])))
    for name, printed in CONTACTS.items():
        unit = "degrees" if "angle" in name else "N"
        quantity = "centrifugal force" if name == "centrifugal" else f"{name} of a ball"
        why = (
            "a finding: the other program leaves the groove radii cold and moves the centres as the bottoms"
            if name.startswith("inner") else "a finding: its centrifugal force is less, for a reason that is not known"
        )  # fmt: skip
        rows += [
            compared(case, quantity, unit, printed, values[name], PROGRAM, None, why),
            compared(f"{case}; the other program's growth put in", quantity, unit, printed, theirs[name], PROGRAM, None,
                     "a finding: what is left with cold groove radii, and centres moved as the bottoms"),
        ]  # fmt: skip
    names = ["inner centre", "inner radius", "inner bottom", "outer centre", "outer radius", "outer bottom"]
    return CaseResult(
        f"Seat pressure {1e-6 * pressure:.3f} MPa, as by hand; the grooves grow by {bars['inner'][2]:.2f} and "
        f"{bars['outer'][2]:.2f} µm, their centres by {bars['inner'][0]:.2f} and {bars['outer'][0]:.2f} µm. Inner "
        f"angle {values['inner angle']:.3f}, by the other program {CONTACTS['inner angle']} degrees, which takes one "
        f"growth for the other; with this put in {theirs['inner angle']:.3f}.",
        rows,
        [
            Diagram(
                "", "growth, µm",
                [
                    Curve("here", "dots", np.arange(6), [*bars["inner"], *bars["outer"]]),
                    Curve("the other program, grooves", "circles", [2, 5], list(GROWTH.values())),
                ],
                x_names=names, levels=[0.0],
            )
        ],
    )  # fmt: skip
