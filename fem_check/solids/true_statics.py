"""What one true contact's bodies must be: supports, stiffness and mass by statics and the drawing alone; and the
approach, by boundary elements, a series for the ball and a Fourier series for the ring."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np

from fem_check.independent import finite_bodies
from fem_check.independent.contact_problem import Array
from fem_check.independent.references import ellipse
from fem_check.mechanics import boundary_element
from fem_check.rows.agreement import AgreementRow, MeshLevel
from fem_check.solids.sector_statics import (
    STIFFNESS_TOLERANCE,
    WHY_STIFFNESS,
    dilation_work,
    force,
    section_moment,
)
from fem_check.solids.true_contact import CondensedContact

BODY_TOLERANCES = {MeshLevel.QUICK: 0.5, MeshLevel.RELEASE: 0.3}
BODY_REASON = (
    "per cent of the whole approach, of which the bodies' size makes 1 to 3 %; set beforehand: tetrahedra of 6 (8) per "
    "semi-axis give the ball's and the ring's part within 0.3 (0.2) %"
)
FORCE_TOLERANCE = 0.02
"""Per cent."""
WHY_FORCE = "statics; the facets' quadrature misses up to 1e-4 of a resultant on the coarsest mesh: twice that"
BALL_SOURCE = "elastic sphere in Legendre polynomials (Lur'e 1964, section 6.4) less its half-space"
RING_SOURCE = "ring in a Fourier series, quadratic elements over its section, less its half-space"


def rows(case: str, condensed: CondensedContact, load: float) -> list[AgreementRow]:
    """Every row is judged."""
    return force_rows(case, condensed, condensed.pressure(load), load) + body_rows(case, condensed)


def force_rows(case: str, condensed: CondensedContact, pressure: Array, load: float) -> list[AgreementRow]:
    """What holds each body, against the load along the contact's normal; both halves of the bodies."""
    frame = condensed.contact.frame
    ball, ring = (2.0 * (each.held @ pressure)[:2] for each in condensed.bodies)
    axial, radial = load * frame.normal
    rows = [
        force(case, "force of the equator on the ball, along the contact's normal", load, float(frame.normal @ ball)),
        force(case, "force on the ball along the groove, over the load", 0.0, float(frame.tangent @ ball) / load, "1"),
        force(case, "axial force of the seat on the ring", -axial, float(ring[0])),
        force(case, "radial force of seat and neighbours on the ring", -radial, float(ring[1])),
    ]
    return [replace(row, tolerance_percent=FORCE_TOLERANCE, why_tolerance=WHY_FORCE) for row in rows]


def body_rows(case: str, condensed: CondensedContact) -> list[AgreementRow]:
    """Stiffness and mass of half the ball's half and of half a pitch of the ring, against the drawing."""
    contact = condensed.contact
    groove = contact.groove
    volumes = (
        np.pi / 3.0 * groove.ball_radius**3,
        section_moment(contact.section) * pi / contact.ball_count,
    )
    rows = []
    for name, body, material, volume in zip(
        ("ball", "ring"), condensed.bodies, (groove.ball, groove.race), volumes, strict=True
    ):
        for quantity, unit, reference, value, source in (
            (
                "work of a uniform dilation",
                "N m",
                dilation_work(material, volume),
                body.dilation,
                "3 E V/(1 - 2 nu), volume of the drawn body",
            ),
            ("mass over density", "m3", volume, body.volume, "volume of the drawn body"),
        ):
            rows.append(
                AgreementRow(
                    case,
                    f"{quantity}, {name}",
                    unit,
                    reference,
                    source,
                    value,
                    None,
                    STIFFNESS_TOLERANCE[name],
                    WHY_STIFFNESS,
                )
            )
    return rows


def approach_rows(
    case: str,
    condensed: CondensedContact,
    load: float,
    added: list[tuple[float, float]],
    approach: tuple[float, float],
    level: MeshLevel,
) -> list[AgreementRow]:
    """What each body adds to Hertz's approach, and the whole; every row is judged.

    Args:
        added: by ball and ring [m/N], each with its uncertainty.
        approach: over Hertz's, with its uncertainty.
    """
    contact = condensed.contact
    groove = contact.groove
    excess = (
        finite_bodies.ball_excess(groove, load),
        finite_bodies.ring_excess(groove, contact.ball_count, contact.ring_profile, load),
    )
    hertzian = ellipse(groove.problem(load)).approach / load
    gap = boundary_element.over_hertz(groove, load)

    def row(quantity: str, expected: float, source: str, computed: float, doubt: float) -> AgreementRow:
        uncertainty, tolerance = 100.0 * doubt / expected, BODY_TOLERANCES[level]
        return AgreementRow(case, quantity, "m/N", expected, source, computed, uncertainty, tolerance, BODY_REASON)

    rows = [
        row(f"Hertz plus what the {body} adds", hertzian + expected, source, hertzian + computed, doubt)
        for body, source, expected, (computed, doubt) in zip(
            ("ball", "ring"), (BALL_SOURCE, RING_SOURCE), excess, added, strict=True
        )
    ]
    computed, doubt = (hertzian * each for each in approach)
    expected = gap.ratio["approach"] * hertzian + sum(excess)
    doubt += 0.01 * gap.uncertainty_percent["approach"] * expected
    source = f"{boundary_element.SOURCE}; {BALL_SOURCE}; {RING_SOURCE}"
    return [*rows, row("approach over load", expected, source, computed, doubt)]
