"""The sector's judged rows: what it finds against the quasi-static model, against a bound that it has no part in.

Ellipse and largest pressure are judged as the finite elements read them. The model has Hertz there; what the true
surfaces make of Hertz's values comes from boundary elements on half-spaces, with the exact gap and the pressure along
the surface's normal, at the model's load and angle.

Loads, angles and displacement are judged twice. With half-spaces for bodies nothing but the gap's shape is left
between sector and model. With the meshed bodies their own elasticity turns the angles: a groove is moved along its ring
by a displacement of the size Q/(E t), t the ring's thickness between groove and seat, which turns the contact line by
that over the distance of the groove centres. Twice that size is allowed: a bound, no prediction.
"""

from __future__ import annotations

from math import degrees, radians, sin, tan

from fem_check.independent.references import hertz
from fem_check.mechanics import boundary_element
from fem_check.rows.agreement import AgreementRow, MeshLevel
from fem_check.solids.sector_comparison import QUANTITIES, Values
from fem_check.solids.sector_geometry import SectorBearing

ELLIPSE = ("semi_major_axis", "semi_minor_axis", "max_pressure")
TOLERANCES: dict[MeshLevel, dict[str, float | None]] = {
    MeshLevel.QUICK: {"semi_major_axis": 0.9, "semi_minor_axis": None, "max_pressure": 2.5},
    MeshLevel.RELEASE: {"semi_major_axis": 0.6, "semi_minor_axis": 1.3, "max_pressure": 1.5},
}
WHY_ELLIPSE = (
    "the meshes' uncertainty, and what second-order boundary elements and a load 0.7 % larger leave open (a quarter of "
    "a per cent each); 5 % of an elastic modulus are 1.6 % of an axis and 3.3 % of the pressure"
)
WHY_FOUND = "a finding: three elements on a semi-minor axis leave 1.6 % open; judged at the release level, on six"
HALF_SPACE_TOLERANCES = {"load": 0.12, "angle": 0.1}
WHY_HALF_SPACE = (
    "two to three times what the gap's shape was found to do; a tenth of the centrifugal force does 2 % and 1°"
)
SURFACE_PART, DISPLACEMENT_GRID = 0.25, 0.3
WHY_DISPLACEMENT = (
    "of each approach a quarter of (a/R)², to the second power of which true surfaces differ from their parabola: "
    "boundary elements find 0.11 of it for the gap's shape in B218, the pressure's direction does about as much; seen "
    "along the axis; and 0.3 % for the grid"
)
WHY_ELASTIC = "twice the size of a groove's own displacement, Q/(E t) for each ring, over the groove centres' distance"


def of_bodies(
    case: str, values: Values, bearing: SectorBearing, level: MeshLevel, *, rigid: bool
) -> list[AgreementRow]:
    """Meshed bodies.

    Args:
        values: as read, of the finest mesh; the uncertainty with that of the meshes.
        rigid: whether the outside diameter is; where it is free the ring grows, which the model's rings do not, and
            all of this is a finding.
    """
    if not rigid:
        return []
    return [*_ellipses(case, values, bearing, TOLERANCES[level]), *_elastic_bodies(case, values, bearing)]


def _surfaces(values: Values, bearing: SectorBearing, race: str) -> dict[str, float]:
    """What the true surfaces make of Hertz's values, at the model's load and angle."""
    groove = bearing.drawing.groove(race, radians(values.model[f"{race} angle"]))
    return boundary_element.over_hertz(groove, values.model[f"{race} load"], follows_surface=True).ratio


def _ellipses(
    case: str, values: Values, bearing: SectorBearing, tolerances: dict[str, float | None]
) -> list[AgreementRow]:
    rows = []
    for race in ("inner", "outer"):
        surfaces = _surfaces(values, bearing, race)
        for kind in ELLIPSE:
            name = f"{race} {kind}"
            reference = values.model[name] * surfaces[kind]
            rows.append(
                AgreementRow(
                    f"{case}: as read, against the model and boundary elements",
                    name,
                    QUANTITIES[name],
                    reference,
                    f"qsbearing.solve, Hertz at the contact's own angle; {boundary_element.ALONG_NORMALS}",
                    values.elements[name],
                    100.0 * values.position_uncertainty[name] / reference,
                    tolerances[kind],
                    WHY_ELLIPSE if tolerances[kind] is not None else WHY_FOUND,
                )
            )
    return rows


def turned(bearing: SectorBearing, values: Values) -> float:
    """By how much, as a size, the rings' own elasticity turns a contact line [deg]."""
    drawing, moved = bearing.drawing, 0.0
    for race in ("inner", "outer"):
        inner = race == "inner"
        section = bearing.section(bearing.groove_centre(inner=inner), inner=inner)
        bottom = section.groove_centre[1] + section.side * section.groove_radius
        thickness = abs(section.back_radius - bottom)
        moved += values.model[f"{race} load"] / (drawing.ring.elastic_modulus * thickness)
    return degrees(moved / drawing.groove_centre_distance)


def _elastic_bodies(case: str, values: Values, bearing: SectorBearing) -> list[AgreementRow]:
    angle = 2.0 * turned(bearing, values)
    allowed = {f"{race} angle": angle for race in ("inner", "outer")}
    # Q sin(alpha) is given by the thrust.
    for race in ("inner", "outer"):
        allowed[f"{race} load"] = 100.0 * radians(angle) / tan(radians(values.model[f"{race} angle"]))
    return [
        _against_model(f"{case}: elastic bodies against the model", name, values, allowed[name], WHY_ELASTIC)
        for name in sorted(allowed)
    ]


def of_half_spaces(case: str, values: Values, bearing: SectorBearing) -> list[AgreementRow]:
    """Half-spaces in the bodies' place."""
    rows = [
        _against_model(case, f"{race} {kind}", values, tolerance, WHY_HALF_SPACE)
        for race in ("inner", "outer")
        for kind, tolerance in HALF_SPACE_TOLERANCES.items()
    ]
    moved = 0.0
    for race in ("inner", "outer"):
        angle = radians(values.model[f"{race} angle"])
        hertzian = hertz(bearing.drawing.groove(race, angle).problem(values.model[f"{race} load"]))
        part = SURFACE_PART * (hertzian.semi_major_axis / bearing.ball_radius) ** 2
        moved += part * hertzian.approach / abs(sin(angle))
    tolerance = DISPLACEMENT_GRID + 100.0 * moved / abs(values.model["axial_displacement"])
    return [*rows, _against_model(case, "axial_displacement", values, tolerance, WHY_DISPLACEMENT)]


def _against_model(case: str, name: str, values: Values, tolerance: float, why: str) -> AgreementRow:
    """A row against the model; the tolerance in per cent, of an angle in degrees."""
    reference = values.model[name]
    if QUANTITIES[name] == "deg":
        tolerance *= 100.0 / abs(reference)
    uncertainty = 100.0 * values.position_uncertainty[name] / abs(reference)
    source = "qsbearing.solve, Hertz at the contact's own angle, the ball's own orbit"
    return AgreementRow(
        case, name, QUANTITIES[name], reference, source, values.elements[name], uncertainty, tolerance, why
    )
