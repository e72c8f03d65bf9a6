"""Rings under loads at points and under pressure inside: textbooks' deflections by the model's series of harmonics."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from fem_check.book.case import CaseResult, Curve, Diagram, compared
from qsbearing.model.effects.ring_compliance import Annulus, by_load, rim_compliances

THIN = "Timoshenko, Strength of Materials, part II, thin rings; Roark, circular rings, case 1"
MANY = "Roark's Formulas for Stress and Strain, circular rings, equal radial loads at equal distances"
THICK = "Timoshenko & Goodier, Theory of Elasticity, thick-walled cylinder (Lame)"
MODULUS, POISSON = 208e9, 0.3
THICKNESS = 5e-3
"""Of the thin ring, over its mean radius: shear and normal force make 3e-5 there."""
OPPOSED = (0.149, -0.137)
"""Printed changes of diameter along and across two loads that pull it apart, over P R³/(E I)."""
THREE = 0.01594
"""Outward deflection at each of three equal loads, over P R³/(E I): the formula's value, to four digits."""
DIGIT = "half of the last printed digit, and harmonics beyond the model's 24th (3e-4 of it)"


def deflection(loads: int, angle: NDArray) -> NDArray:
    """Of a thin ring from inside by equal loads, outward, over P R³/(E I); angles from one of them."""
    bore = 1.0 - 0.5 * THICKNESS
    ring = Annulus(bore, 1.0 + 0.5 * THICKNESS, MODULUS, POISSON)
    compliance = by_load(rim_compliances(ring).bore_by_bore, bore, 1.0)
    n = np.arange(loads, len(compliance), loads)
    bending = MODULUS * THICKNESS**3 / 12.0
    return np.asarray(loads * bending * np.cos(np.multiply.outer(angle, n)) @ compliance[n])


def grown(ratio: float) -> float:
    """Growth of the bore by pressure inside, over p a/E, of a ring whose outside is so many times its bore."""
    ring = Annulus(1.0, ratio, MODULUS, POISSON)
    return float(rim_compliances(ring).bore_by_bore[0]) * MODULUS


def run() -> CaseResult:
    """Two and three loads, and pressure."""
    along, across = 2.0 * deflection(2, np.array([0.0, 0.5 * pi]))
    three = float(deflection(3, np.zeros(1))[0])
    case = f"thin ring, thickness {THICKNESS:g} mean radii, two opposed loads from inside"
    rows = [
        compared(case, "diameter along the loads, over P R³/(E I)", "1", OPPOSED[0], along, THIN, 6e-4, DIGIT),
        compared(case, "diameter across them", "1", OPPOSED[1], across, THIN, 6e-4, DIGIT),
        compared(
            "the same, three equal loads", "radius at a load, over P R³/(E I)", "1", THREE, three, MANY, 5e-5,
            "harmonics beyond the model's 24th, 3e-3 of it",
        ),
    ]  # fmt: skip
    for ratio, printed in ((1.1, 10.8238), (2.0, 1.9667)):
        rows.append(
            compared(
                f"thick ring, outside {ratio:g} bores, pressure inside", "growth of the bore over p a/E", "1", printed,
                grown(ratio), THICK, 5e-5, "half of the last digit of the formula's value",
            )
        )  # fmt: skip
    angle = np.linspace(0.0, pi, 181)
    degrees = np.degrees(angle)
    return CaseResult(
        f"Two opposed loads change a thin ring's diameters by {along:.4f} and {across:.4f} P R³/(E I), three push it "
        f"out by {three:.5f} at each.",
        rows,
        [
            Diagram(
                "angle from a load, degrees", "outward, over P R³/(E I)",
                [
                    Curve("two loads", "line", degrees, deflection(2, angle)),
                    Curve("three loads", "dashed", degrees, deflection(3, angle)),
                    Curve("printed", "circles", [0.0, 90.0, 0.0], [0.5 * OPPOSED[0], 0.5 * OPPOSED[1], THREE]),
                ],
            )
        ],
    )  # fmt: skip
