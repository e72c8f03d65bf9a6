"""The catalogue's bearings and materials as their sources print them, typed again, in the sources' own terms.

Where a source gives a dimension in two ways, the other one stands here: a diameter in inches, a groove as a multiple of
the ball, a pitch diameter as the mean of two others, a contact angle by the clearance.
"""

from __future__ import annotations

from math import acos, degrees

INCH = 25.4e-3
PSI = 6894.757293
POUND_PER_CUBIC_INCH = 0.45359237 / INCH**3

STEEL = {"elastic_modulus": 2.08e5 * 1e6, "poisson_ratio": 0.3, "density": 7.8e-6 * 1e9}
"""Wang, Yan, Zhang & Hong, table of parameters: 2.08e5 MPa, 0.3, 7.8e-6 kg/mm3."""
SILICON_NITRIDE = {"elastic_modulus": 315e9, "poisson_ratio": 0.26, "density": 3.2e3}
"""GMN catalogue 4000 0813 EN, material characteristics: 315 GPa, 0.26, 3.2 g/cm3."""
EXPANSION = {"steel": 12e-6, "silicon nitride": 3.2e-6}
"""Of bearing steel, handbooks' usual value; of Si3N4, the GMN catalogue. Per kelvin."""
TURBOPUMP_STEEL = {"elastic_modulus": 29e6 * PSI, "poisson_ratio": 0.25, "density": 0.28 * POUND_PER_CUBIC_INCH}
"""OpenJones, example of Nosaka et al.: 29e6 psi, 0.25, 0.28 lb/in3."""


def _bearing(
    balls: int,
    diameter: float,
    pitch: float,
    grooves: tuple[float, float],
    angle: float,
    ball: dict[str, float],
    ring: dict[str, float],
) -> dict[str, float]:
    """SI units, but the angle in degrees."""
    return {
        "ball_count": balls,
        "ball_diameter": diameter,
        "pitch_diameter": pitch,
        "inner_groove_radius": grooves[0],
        "outer_groove_radius": grooves[1],
        "free_contact_angle": angle,
        **{f"ball_material.{name}": value for name, value in ball.items()},
        **{f"ring_material.{name}": value for name, value in ring.items()},
    }


def _alike(radius: float) -> tuple[float, float]:
    return radius, radius


_B218_GROOVES = 11.6281e-3
_GMN_GROOVES = round(0.518 * 12.7, 2) * 1e-3
_NOSAKA = (0.56 * 7.938e-3, 0.52 * 7.938e-3)

BEARINGS = {
    # Harris & Kotzalas, the 218 bearing: 7/8 inch, di 102.7938, do 147.7264 mm; grooves of Wang et al.; 40 degrees.
    "b218": _bearing(
        16, 7.0 / 8.0 * INCH, 0.5 * (102.7938e-3 + 147.7264e-3), _alike(_B218_GROOVES),
        degrees(acos(1.0 - 0.4826e-3 / (2.0 * (2.0 * _B218_GROOVES - 7.0 / 8.0 * INCH)))), STEEL, STEEL,
    ),
    # GMN catalogue 4000 0813 EN, S 6210 C: 15 balls of 1/2 inch between 50 and 90 mm; f = 0.518 is inferred there.
    "7210c": _bearing(15, 0.5 * INCH, 0.5 * (50e-3 + 90e-3), _alike(_GMN_GROOVES), 15.0, STEEL, STEEL),
    "7210c_hybrid": _bearing(
        15, 0.5 * INCH, 0.5 * (50e-3 + 90e-3), _alike(_GMN_GROOVES), 15.0, SILICON_NITRIDE, STEEL
    ),
    # github.com/minzhun/ISO16281, Test_BallBearing.py: Z 7, Dw 11.5, Dpw 43.5, ri 0.52 Dw, re 0.53 Dw, no clearance.
    "iso16281_7ball": _bearing(
        7, 11.5e-3, 43.5e-3, (0.52 * 11.5e-3, 0.53 * 11.5e-3), 0.0,
        {"elastic_modulus": 210e9, "poisson_ratio": 0.3, "density": 7.8e3},
        {"elastic_modulus": 210e9, "poisson_ratio": 0.3, "density": 7.8e3},
    ),
    # OpenJones, example of Nosaka et al.: 10 balls of 5/16 inch, 38.5 mm, f 0.56 and 0.52, 20 degrees.
    "turbopump25": _bearing(10, 5.0 / 16.0 * INCH, 38.5e-3, _NOSAKA, 20.0, TURBOPUMP_STEEL, TURBOPUMP_STEEL),
    "turbopump25_hybrid": _bearing(
        10, 5.0 / 16.0 * INCH, 38.5e-3, _NOSAKA, 20.0,
        {"elastic_modulus": 320e9, "poisson_ratio": 0.26, "density": 3.16e3}, TURBOPUMP_STEEL,
    ),
}  # fmt: skip
"""By name of the catalogue."""

UNITS = {
    "ball_count": "1", "poisson_ratio": "1", "elastic_modulus": "Pa", "density": "kg/m3", "free_contact_angle": "deg",
    **dict.fromkeys(("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"), "m"),
}  # fmt: skip

TYPED = 1e-9
"""Relative: the same number twice."""
PRINTED = {
    "ball_count": 0.0, "ball_diameter": 6.4e-5, "pitch_diameter": 4e-5, "inner_groove_radius": TYPED,
    "outer_groove_radius": TYPED, "free_contact_angle": 1.5e-4, "elastic_modulus": 1e-6, "poisson_ratio": TYPED,
    "density": 1e-6, "thermal_expansion": TYPED,
}  # fmt: skip
"""Relative, half a unit of the last digit printed: 7.938 mm for 5/16 inch, 125.26 mm for the mean of two others, six
digits for what stands here in psi and pounds; an angle that follows from lengths of six digits by a difference."""
