"""Thrust alone, at rest, by explicit formulas: the cheapest fidelity, for the back of an envelope.

Source        Harris & Kotzalas, static thrust of angular-contact bearings: with K_n both contacts in series,
                  Fa = Z K_n BD^1.5 sin(a) (cos(a0)/cos(a) - 1)^1.5,      delta_a = BD sin(a - a0)/cos(a)
              Contacts by the fit of Brewe & Hamrock 1977 at the free contact angle.
Equation      with t = Fa/(Z K_n BD^1.5) the first line reads cos(a) = cos(a0)/(1 + (t/sin(a))^(2/3)). Put into itself
              three times from sin(a)^4 = sin(a0)^4 + 2 sqrt(2) t, which is right for a small load and for a0 = 0, it
              contracts by (2/3)/tan(a) delta/(BD tan(a)), a third at most
Assumes       pure thrust, all balls alike, no speed
Gives         axial displacement and stiffness, contact angle, loads, semi-axes, pressures; None for all else, and
              nothing at all under other loads
"""

from __future__ import annotations

from math import acos, cos, log, pi, sin, sqrt
from typing import TYPE_CHECKING

from qsbearing.hertz import effective_modulus

if TYPE_CHECKING:
    from qsbearing.scene import Scene

Estimate = dict[str, float]
"""Answers by the names of `qsbearing.cost.answers`, SI."""

SUBSTITUTIONS = 3


def loaded_angle(load_number: float, free_angle: float) -> float:
    """Contact angle under the thrust Fa = t Z K_n BD^1.5 [rad]."""
    cosine = cos(free_angle)
    sine = sqrt(sqrt(sin(free_angle) ** 4 + 2.0 * sqrt(2.0) * load_number))
    for _ in range(SUBSTITUTIONS):
        sine = sqrt(1.0 - (cosine / (1.0 + (load_number / min(sine, 1.0)) ** (2.0 / 3.0))) ** 2)
    return acos(cosine / (1.0 + (load_number / sine) ** (2.0 / 3.0)))


def contact_constants(curvature_x: float, curvature_y: float, modulus: float) -> tuple[float, float, float]:
    """(Q/delta^1.5, a/Q^(1/3), b/Q^(1/3)) by Brewe & Hamrock 1977; curvatures 1/Rx >= 1/Ry [1/m], E' [Pa]."""
    ratio = curvature_x / curvature_y
    k = 1.0339 * ratio**0.636
    first, second = 1.5277 + 0.6023 * log(ratio), 1.0003 + 0.5968 / ratio
    total = curvature_x + curvature_y
    a = (6.0 * k * k * second / (pi * total * modulus)) ** (1.0 / 3.0)
    return pi * k * modulus * sqrt(second / (4.5 * total * first**3)), a, a / k


def is_pure_thrust(scene: Scene) -> bool:
    """Whether a single axial load is all that acts, tilts and radial channels being free or held at nothing."""
    operation = scene.operation
    others = (
        operation.radial_load_y,
        operation.radial_load_z,
        operation.moment_y,
        operation.moment_z,
        operation.radial_displacement_y,
        operation.radial_displacement_z,
        operation.tilt_y,
        operation.tilt_z,
    )
    load = operation.axial_load
    return (
        isinstance(load, float | int)
        and load > 0.0
        and all(value is None or (isinstance(value, float | int) and value == 0.0) for value in others)
    )


def thrust_estimate(scene: Scene) -> Estimate | None:
    """The answers under thrust; None where the load is another, or its fields are arrays."""
    if not is_pure_thrust(scene):
        return None
    bearing = scene.bearing
    count, ball, pitch = float(bearing.ball_count), float(bearing.ball_diameter), float(bearing.pitch_diameter)  # type: ignore[arg-type]
    inner_radius, outer_radius = float(bearing.inner_groove_radius), float(bearing.outer_groove_radius)  # type: ignore[arg-type]
    free = float(bearing.free_contact_angle)  # type: ignore[arg-type]
    thrust = float(scene.operation.axial_load)  # type: ignore[arg-type]
    one, two = bearing.ball_material, bearing.ring_material
    modulus = effective_modulus(one.elastic_modulus, one.poisson_ratio, two.elastic_modulus, two.poisson_ratio)  # type: ignore[arg-type]
    gamma = ball / pitch * cos(free)
    sides = [
        contact_constants(2.0 / (ball * (1.0 + sign * gamma)), 2.0 / ball - 1.0 / radius, modulus)
        for sign, radius in ((-1.0, inner_radius), (1.0, outer_radius))
    ]
    series = (sides[0][0] ** (-2.0 / 3.0) + sides[1][0] ** (-2.0 / 3.0)) ** -1.5
    distance = inner_radius + outer_radius - ball
    angle = loaded_angle(thrust / (count * series * distance**1.5), free)
    load = thrust / (count * sin(angle))
    approach = (load / series) ** (2.0 / 3.0)
    found = {
        "axial_displacement": distance * sin(angle - free) / cos(angle),
        "axial_stiffness": count
        * (1.5 * load / approach * sin(angle) ** 2 + load * cos(angle) ** 2 / (distance + approach)),
        "ring_load": thrust,
        "approach": approach,
    }
    for side, (_, a, b) in zip(("inner", "outer"), sides, strict=True):
        size = load ** (1.0 / 3.0)
        found |= {
            f"{side}_load": load,
            f"{side}_angle": angle,
            f"{side}_semi_major_axis": a * size,
            f"{side}_semi_minor_axis": b * size,
            f"{side}_max_pressure": 1.5 * size / (pi * a * b),
        }
    return found
