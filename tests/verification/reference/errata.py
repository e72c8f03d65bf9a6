"""What each error of the source paper does to an answer: `python -m tests.verification.reference.errata` writes
errata.json.

The plane case of Wang, Yan, Zhang & Hong (chapter 19; equations 19.x) written out in floats, with each of their errors
as a switch: the corrected equations and those with one error put back are solved from the same start. It shares no code
with the package, which only gives the start; a test holds the corrected ones against it.
"""

from __future__ import annotations

import json
import math
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

import qsbearing as qs
from fem_check.rows.row_text import scientific
from qsbearing.results import provenance

DATA = Path(__file__).with_name("errata.json")

# B218, SI units and radians.
Z, D, DM, R = 16, 0.022225, 0.12526, 0.0116281
FREE_ANGLE, MODULUS, POISSON, DENSITY = math.radians(40.0), 2.08e11, 0.3, 7800.0
SPEED, AXIAL, RADIAL = 10_000 * math.pi / 30, 17_800.0, 6_000.0
KI, KO = 4.1097262e10, 4.2748637e10
"""Hertz at the free angle, N/m^1.5: the corrected (19.18)."""

F, G = R / D, D / DM
LENGTH = R - D / 2
"""Of a contact line, unloaded."""
MASS = DENSITY * math.pi * D**3 / 6
INERTIA = MASS * D**2 / 10


@dataclass(frozen=True)
class Equations:
    """The equations with what is printed otherwise; as it stands, corrected."""

    distance_of_centres: float = (2 * F - 1) * D
    """(19.7)."""
    friction_in_radial_sum: float = 1.0
    """Sign of the friction term of (19.14)."""
    friction_in_moment: float = 1.0
    """Part of the term lambda_i f Mg of (19.15) that is there."""
    lever: float = DM / 2 + LENGTH * math.cos(FREE_ANGLE)
    """Ri of (19.3)."""
    sense_of_moment: float = 1.0
    """Of Mg: -1 takes its magnitude for it."""
    inner_control: bool = False
    """(2, 0) in place of (0, 2); the moment's term is there under inner control alone."""
    speed: float = SPEED


def balls(e: Equations, centres: NDArray) -> tuple[NDArray, ...]:
    """Fc, Mg, sines and cosines of the contact angles are taken from here: X1, X2, A1, A2 of each ball."""
    x1, x2, a1, a2 = centres
    so, co = x1 / np.hypot(x1, x2), x2 / np.hypot(x1, x2)
    si, ci = (a1 - x1) / np.hypot(a1 - x1, a2 - x2), (a2 - x2) / np.hypot(a1 - x1, a2 - x2)
    tan = si / (ci - G) if e.inner_control else so / (co + G)
    cos = 1.0 / np.sqrt(1.0 + tan**2)
    u, v = (co + tan * so) / (1 + G * co), (ci + tan * si) / (1 - G * ci)
    orbit, rotation = e.speed / (1 + v / u), -e.speed / ((u + v) * G * cos)
    force = 0.5 * MASS * DM * orbit**2
    moment = e.sense_of_moment * INERTIA * rotation * orbit * tan * cos
    return force, moment, si, ci, so, co


def solve(e: Equations, start: NDArray) -> dict[str, float]:
    """Solve the 2 Z + 3 equations; lengths in um, angles in degrees, tilt in mrad, of the ball at azimuth 0."""
    psi = 2.0 * math.pi * np.arange(Z) / Z
    shares = (2.0, 0.0) if e.inner_control else (0.0, 2.0)

    def parts(unknown: NDArray) -> tuple[NDArray, ...]:
        dx, dy, tilt = unknown[:3] * 1e-6
        x1, x2 = unknown[3:].reshape(2, Z) * 1e-6
        a1 = e.distance_of_centres * math.sin(FREE_ANGLE) + dx + e.lever / DM * -tilt * np.cos(psi)  # tilt as DM gamma
        a2 = e.distance_of_centres * math.cos(FREE_ANGLE) + dy * np.cos(psi)
        qi = KI * np.maximum(np.hypot(a1 - x1, a2 - x2) - LENGTH, 0.0) ** 1.5
        qo = KO * np.maximum(np.hypot(x1, x2) - LENGTH, 0.0) ** 1.5
        return qi, qo, *balls(e, np.stack([x1, x2, a1, a2]))

    def imbalance(unknown: NDArray) -> NDArray:
        qi, qo, force, moment, si, ci, so, co = parts(unknown)
        ti, to = shares[0] * moment / D, shares[1] * moment / D
        axial = qi * si - ti * ci
        radial = qi * ci + e.friction_in_radial_sum * ti * si
        ring = (
            axial.sum() - AXIAL,
            (radial * np.cos(psi)).sum() - RADIAL,
            ((axial * e.lever + e.friction_in_moment * shares[0] * F * moment) * np.cos(psi)).sum() / DM,
        )
        of_balls = (qi * si - qo * so - ti * ci + to * co, qi * ci - qo * co + ti * si - to * so + force)
        return np.concatenate([ring, *of_balls]) / AXIAL

    found = root(imbalance, start, method="hybr", tol=1e-13, options={"maxfev": 20_000})
    if np.abs(imbalance(found.x)).max() > 1e-9:
        raise ArithmeticError(f"not solved: {e}")
    qi, _, _, _, si, ci, so, co = parts(found.x)
    return {
        "axial displacement, µm": float(found.x[0]),
        "radial displacement, µm": float(found.x[1]),
        "tilt, mrad": float(found.x[2] * 1e-6 / DM * 1e3),
        "αi,°": float(np.degrees(np.arctan2(si, ci)[0])),
        "αo,°": float(np.degrees(np.arctan2(so, co)[0])),
        "Qi, N": float(qi[0]),
    }


def package(speed: float = SPEED, inner_control: bool = False) -> qs.Solution:
    """The scene as the package solves it."""
    scene = qs.load_scene("b218")
    operation = qs.Operation(speed=speed, axial_load=AXIAL, radial_load_y=RADIAL, moment_y=0.0, moment_z=0.0)
    control = qs.RacewayControl.INNER if inner_control else qs.RacewayControl.OUTER
    effects = (qs.CentrifugalForce(), qs.GyroscopicMoment(qs.MomentShares.CONTROLLING))
    return qs.solve(qs.Scene(scene.bearing, operation, effects, control))


def start_of(solution: qs.Solution) -> NDArray:
    """Ring and ball centres of a solution as unknowns: um, the tilt as that of the pitch diameter."""
    moved, length = solution.displacement, LENGTH + solution.outer.approach
    ring = [moved[0], moved[1], moved[4] * DM]
    x = length * np.sin(solution.outer.angle), length * np.cos(solution.outer.angle)
    return np.concatenate([ring, *x]) * 1e6


def difference(right: dict[str, float], wrong: dict[str, float]) -> str:
    """The three quantities that change most, as they are and as they become."""
    changes = {name: abs(wrong[name] - right[name]) / abs(right[name]) for name in right}
    most = [name for name in sorted(changes, key=lambda each: -changes[each])[:3] if changes[name] > 1e-6]
    return "; ".join(
        f"{name.partition(',')[0]} {right[name]:.4g} → {wrong[name]:.4g}{name.partition(',')[2]}" for name in most
    )


def effects() -> dict[str, str]:
    """What each error does, by its place in the source."""
    outer, inner = Equations(), Equations(inner_control=True)
    start, start_inner = start_of(package()), start_of(package(inner_control=True))
    right, right_inner = solve(outer, start), solve(inner, start_inner)
    printed = (2 * F - 0.5) * D
    pressed = printed - outer.distance_of_centres
    in_series = (KI ** (-2 / 3) + KO ** (-2 / 3)) ** -1.5
    loaded = math.radians(right["αo,°"])
    clearance = [2e3 * outer.distance_of_centres * (1 - math.cos(angle)) for angle in (FREE_ANGLE, loaded)]
    slow, fast = (package(speed) for speed in (100 * math.pi / 30, SPEED))
    turned = [
        float(np.degrees(getattr(fast, side).angle[0] - getattr(slow, side).angle[0])) for side in ("inner", "outer")
    ]
    return {
        "(19.7)": f"BD {1e3 * printed:.2f} mm in place of {1e3 * outer.distance_of_centres:.3f} mm: undisplaced, every "
        f"ball would be pressed by {1e3 * pressed:.1f} mm, with {scientific(in_series * pressed**1.5, 2)} N",
        "(19.14)": "inner control: "
        + difference(right_inner, solve(replace(inner, friction_in_radial_sum=-1.0), start_inner)),
        "(19.15)": "inner control: "
        + difference(right_inner, solve(replace(inner, friction_in_moment=0.0), start_inner)),
        "(19.3)": "dm/2 in its place: " + difference(right, solve(replace(outer, lever=DM / 2), start)),
        "(19.16), (19.17)": f"diametral clearance {clearance[0]:.4f} mm from α°, {clearance[1]:.4f} mm from this αo",
        "ωR, Mg": difference(right, solve(replace(outer, sense_of_moment=-1.0), start)),
        "conclusion": f"from 100 to 10,000 rpm αi changes by {turned[0]:+.2f}°, αo by {turned[1]:+.2f}°",
    }


ERRORS = (
    ("(19.7)", "B = fi + fo − 0.5", "B = fi + fo − 1", "BD of B218 is 1.031 mm, not 12.14 mm"),
    ("(19.14)", "− before the friction term", "+", "Newton's third law with (19.10)"),
    ("(19.15)", "without λi fi Mg", "with it", "friction acts at the groove, not at its centre"),
    ("(19.12)", "J not given", "J = m D²/10", "solid sphere"),
    ("(19.3)", "Ri not given", "dm/2 + (fi − ½) D cos α°", "rigid rotation of the groove centres"),
    ("(19.16), (19.17)", "αo", "free angle α°", "clearance and end play are those of the unloaded bearing"),
    ("(19.18)", "one symbol for two quantities", "K, E and Σρ told apart", "dimensions"),
    ("ωR, Mg", "magnitudes", "both negative", "the ball's angular momentum"),
    ("B218's table", "no free angle", "40°", "the 218 bearing of the literature"),
    ("conclusion", "angles' trends with speed exchanged", "αo falls, αi rises", "its own figures"),
)
NO_NUMBER = "nothing can be computed from it as printed"


def record() -> dict[str, Any]:
    """All of it."""
    found = effects()
    right = solve(Equations(), start_of(package()))
    return {
        "provenance": provenance.of_run("python -m tests.verification.reference.errata"),
        "source": "Wang, Yan, Zhang, Hong, Research on the Dynamic Properties of Ball Bearings Based on the "
        "Quasi-Static Method, Springer, chapter 19",
        "scene": "B218, 17,800 N axial, 6,000 N radial, free to tilt, 10,000 rpm, outer control unless said; "
        "contact of the ball at azimuth 0",
        "corrected": ", ".join(
            f"{name.partition(',')[0]} {value:.4g}{name.partition(',')[2]}" for name, value in right.items()
        ),
        "errors": [
            {
                "place": place,
                "printed": printed,
                "correct": correct,
                "shows": shows,
                "effect": found.get(place, NO_NUMBER),
            }
            for place, printed, correct, shows in ERRORS
        ],
    }


def main() -> None:
    """Solve and write."""
    target = Path(sys.argv[1]) if sys.argv[1:] else DATA
    found = record()
    target.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(found["corrected"], *(f"{each['place']}: {each['effect']}" for each in found["errors"]), sep="\n")


if __name__ == "__main__":
    main()
