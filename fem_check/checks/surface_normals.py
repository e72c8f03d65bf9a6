"""What the pressure's direction changes: along the normals of the surface that the bodies share, not along one axis.

Half-spaces whose rectangles are inclined as that surface is are the reference. They know no strain of the whole bodies,
which the elements have: under the load ball and groove are strained by Q (C_b + C_r)/D^2, C the compliances, D the
ball's diameter. Where the pressure follows the surface this changes the difference of their curvatures, which is but
1 - R/r of the ball's own; where it acts along one axis it does not. So the elements' change exceeds the half-spaces' by
a part that grows with the load itself, not as the ellipse's size squared.
"""

from __future__ import annotations

from fem_check.independent.groove import BallInGroove
from fem_check.mechanics import boundary_element
from fem_check.rows.agreement import AgreementRow
from fem_check.solids.true_contact import READ
from fem_check.solids.true_study import TrueContactStudy

STRAINS = 2.0
"""How many times the strain over 1 - R/r the two methods may differ. From 500 N to 5 kN on both of B218's raceways, and
at 20 kN in a groove of 0.505 D, the semi-major axis differs by 1.1 to 1.4 times, all else by less."""
WHY = "half-spaces know no strain of the whole bodies: twice that strain over the bodies' difference of curvature"


def limit(groove: BallInGroove, load: float) -> float:
    """How far half-spaces may be from the elements [%]."""
    strain = load * (groove.ball.compliance + groove.race.compliance) / groove.ball_diameter**2
    return 100.0 * STRAINS * strain / (1.0 - groove.ball_radius / groove.groove_radius)


def rows(solved: TrueContactStudy) -> list[AgreementRow]:
    """Every quantity of the true contact over that with the pressure along the axis."""
    inclined, axis = (
        boundary_element.over_hertz(solved.groove, solved.load, follows_surface=follows, inclined=True)
        for follows in (True, False)
    )
    table = []
    for name in READ:
        reference = (
            1.0 + inclined.ratio[name] - axis.ratio[name]
            if name == "approach"
            else inclined.ratio[name] / axis.ratio[name]
        )
        effect, doubt = solved.ratio("surface", "exact_gap", name)
        doubt += 0.01 * (inclined.uncertainty_percent[name] + axis.uncertainty_percent[name])
        table.append(
            AgreementRow(
                f"{solved.case}: pressure along the surface's normals over along the axis, true bodies",
                f"{name} over Hertz",
                "1",
                reference,
                boundary_element.ALONG_NORMALS,
                effect,
                100.0 * doubt,
                *solved.tolerance_of(name, limit(solved.groove, solved.load), WHY),
            )
        )
    return table
