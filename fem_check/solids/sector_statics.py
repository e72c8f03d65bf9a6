"""What the sector's forces and stiffnesses must be by statics alone, from the drawing: nothing here knows a mesh.

Forces found are those of the supports of the meshed bodies, summed over their nodes after the solution; forces expected
follow from Newton's law for ball and ring. Each body's stiffness is its work under a uniform dilation, for which the
stress is E/(1 - 2 nu) everywhere, times the volume of the drawn body.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, sin

import numpy as np

from fem_check.independent.contact_problem import ElasticConstants
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.references import hertz
from fem_check.rows.agreement import AgreementRow
from fem_check.solids.bearing_sector import BearingSector, Sector, SectorLoad, SectorResults
from fem_check.solids.bodies import RingSection

FORCE_TOLERANCE = 0.05
"""Per cent."""
WHY_FORCE = (
    "statics; the facets' quadrature misses up to 3e-4 of a resultant under the heaviest loads, the Hertzian approach "
    "that places the ball's orbit 1e-5 of its radius"
)
STIFFNESS_TOLERANCE = {"ball": 0.01, "inner ring": 5e-4, "outer ring": 5e-4, "ring": 5e-4}
WHY_STIFFNESS = (
    "uniform strain is exact for the elements; their curved faces miss 5e-5 of the ball's volume at the most, 1e-6 "
    "of a ring's: twice and five times that"
)
BALANCE_TOLERANCE = 1e-6
"""Per cent of the largest force: rounding in the linear solver."""


@dataclass(frozen=True)
class Inertia:
    """Of one ball on its orbit, outer ring at rest."""

    centrifugal_force: float
    """[N]"""
    gyroscopic_moment: float
    """Magnitude [N m]."""


def inertia(sector: Sector, load: SectorLoad, results: SectorResults) -> Inertia:
    """Of a solved case, at its angles and outer load."""
    inner, outer = results.inner, results.outer
    return _rolling(sector.geometry.bearing.drawing, inner.angle, outer.angle, outer.load, load.speed)


def _rolling(
    drawing: BearingDrawing, inner_angle: float, outer_angle: float, outer_load: float, speed: float
) -> Inertia:
    """Newton's law for a ball that rolls, and does not spin, on the outer raceway, and rolls on the inner one.

    With no spin on the raceway at rest the ball turns about the tangent of the outer contact, by r w/R for a centre
    that goes round at the radius r with w; on the inner raceway r w (1 + cos(ai - ao)) = (r - R cos ai) times the
    ring's speed. The moment of momentum J r w/R, inclined to the bearing's axis by ao, goes round with w.
    """
    contact = hertz(drawing.groove("outer", outer_angle).problem(outer_load))
    reach = drawing.outer_groove_radius - 0.5 * drawing.ball_diameter + contact.approach
    radius = drawing.outer_groove_centre_radius + reach * cos(outer_angle)
    ball = 0.5 * drawing.ball_diameter
    orbit = speed * (1.0 - ball / radius * cos(inner_angle)) / (1.0 + cos(inner_angle - outer_angle))
    mass = drawing.ball_density * pi / 6.0 * drawing.ball_diameter**3
    return Inertia(mass * radius * orbit**2, 0.4 * mass * ball * radius * orbit**2 * abs(sin(outer_angle)))


def rows(case: str, sector: BearingSector, load: SectorLoad, results: SectorResults) -> list[AgreementRow]:
    """Supports, inertia and stiffness of one solved case of meshed bodies; every row is judged."""
    held = sector.supports(results)
    per_ball = load.axial_load / sector.geometry.bearing.ball_count
    scale = max(per_ball, results.centrifugal_force)
    forces = [
        force(case, "axial force of the bore on the inner ring", per_ball, float(held["inner"][0])),
        force(case, "axial force of the seat on the outer ring", per_ball, -float(held["outer"][0])),
        AgreementRow(
            case, "force left on the ball, over the largest", "1", 0.0, "statics: every load on it is balanced",
            float(np.abs(held["ball"]).max()) / scale, None, BALANCE_TOLERANCE, "rounding in the linear solver, 1e-10",
        ),
    ]  # fmt: skip
    if load.speed:
        expected = inertia(sector, load, results).centrifugal_force
        radial = -float(held["inner"][1] + held["outer"][1])
        forces.append(force(case, "centrifugal force, from both rings' supports", expected, radial))
    return forces + inertia_rows(case, sector, load, results) + _stiffness(case, sector)


def inertia_rows(case: str, sector: Sector, load: SectorLoad, results: SectorResults) -> list[AgreementRow]:
    """Inertia of the ball from its contacts' resultants."""
    if not load.speed:
        return []
    inner, outer = (
        frame.resultants @ pressure for frame, pressure in zip(sector.geometry.frames, results.pressures, strict=True)
    )
    rubbing = sector.geometry.frames[1].friction_resultants @ results.friction
    of = inertia(sector, load, results)
    balancing = float((inner + outer - rubbing)[1])
    rows = [force(case, "centrifugal force, from the contacts", of.centrifugal_force, balancing)]
    if load.gyroscopic_moment:
        moment = sector.geometry.bearing.ball_radius * hypot(*rubbing)
        rows.append(force(case, "gyroscopic moment, from the friction", of.gyroscopic_moment, moment, "N m"))
    return rows


def force(case: str, name: str, reference: float, computed: float, unit: str = "N") -> AgreementRow:
    """A force from statics."""
    source = "statics, from the drawing"
    return AgreementRow(case, name, unit, reference, source, computed, None, FORCE_TOLERANCE, WHY_FORCE)


def _stiffness(case: str, sector: BearingSector) -> list[AgreementRow]:
    bearing, frames = sector.geometry.bearing, sector.geometry.frames
    half_pitch = pi / bearing.ball_count
    volumes = {
        name: section_moment(bearing.section(frame.groove.centre, inner=name == "inner")) * half_pitch
        for name, frame in zip(("inner", "outer"), frames, strict=True)
    }
    drawing = bearing.drawing
    expected = {
        "ball": (sector.ball, drawing.ball, 2.0 / 3.0 * pi * bearing.ball_radius**3),
        "inner ring": (sector.inner_ring, drawing.ring, volumes["inner"]),
        "outer ring": (sector.outer_ring, drawing.ring, volumes["outer"]),
    }
    return [
        AgreementRow(
            case,
            f"work of a uniform dilation, {name}",
            "N m",
            dilation_work(material, volume),
            "3 E V/(1 - 2 nu), volume of the drawn body",
            body.dilation,
            None,
            STIFFNESS_TOLERANCE[name],
            WHY_STIFFNESS,
        )
        for name, (body, material, volume) in expected.items()
    ]


def dilation_work(material: ElasticConstants, volume: float) -> float:
    """Of a unit dilation along every axis [N m]."""
    return 3.0 * material.elastic_modulus * volume / (1.0 - 2.0 * material.poisson_ratio)


def section_moment(section: RingSection) -> float:
    """Radius integrated over a ring's section [m3]: its volume per angle, by Green's theorem round the outline."""
    angles = np.linspace(section.high_shoulder, -section.low_shoulder, 4001)
    arc = section.groove_centre + section.groove_radius * section.side * np.stack([np.sin(angles), np.cos(angles)], 1)
    half = 0.5 * section.side * section.width
    left, right = section.groove_centre[0] - half, section.groove_centre[0] + half
    back = section.back_radius
    corners = np.array([[left, arc[-1, 1]], [left, back], [right, back], [right, arc[0, 1]]])
    x, r = np.concatenate([arc, corners]).T
    x_next, r_next = np.roll(x, -1), np.roll(r, -1)
    # int r^2/2 dx along each straight piece.
    return abs(float(np.sum((x_next - x) * (r * r + r * r_next + r_next * r_next)))) / 6.0
