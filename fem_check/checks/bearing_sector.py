"""Ball between both rings: where does the quasi-static model stop being true, and what do the rings' supports do?"""

from __future__ import annotations

from math import pi
from typing import Any

import qsbearing
from fem_check import convergence, references, sector_comparison
from fem_check.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row
from fem_check.scenes import groove_contact
from fem_check.sector_comparison import QUANTITIES, Compared, OperatingPoint, own_point
from fem_check.solids import body_mesh
from fem_check.solids.bearing_sector import OuterSupport

ELEMENTS = {Level.QUICK: (2, 3, 4), Level.RELEASE: (3, 4, 5)}
"""Per semi-minor axis; five take 2 GB."""
POINTS = {
    Level.QUICK: (OperatingPoint(17800.0, 10000.0 * qsbearing.rpm),),
    Level.RELEASE: tuple(
        OperatingPoint(load, speed * qsbearing.rpm)
        for load in (500.0, 2000.0, 17800.0, 44500.0)
        for speed in (0.0, 10000.0)
    ),
}
"""Of the example; another scene is compared at its own thrust and speed."""
SUPPORTS = {Level.QUICK: (OuterSupport.RIGID,), Level.RELEASE: (OuterSupport.RIGID, OuterSupport.FREE)}
BOUNDS = {
    "axial_displacement": 0.2,
    "load": 0.05,
    "angle": 0.02,
    "semi_major_axis": 0.2,
    "semi_minor_axis": 0.5,
}
"""Largest uncertainty aimed at at the release level, in per cent, of angles in degrees."""
MODEL = "qsbearing.solve, Hertz at the free contact angle, the same effects"
EQUILIBRIUM_TOLERANCE = 1e-5
# A light contact: 2.4 N a ball. The groove's shape then moves the ellipse by 0.02 % and the bodies' own compliance the
# approach by 0.25 %, by the power laws of their size; what the mesh adds is its uncertainty.
LIGHT = OperatingPoint(25.0, 0.0)
LIGHT_TOLERANCE = {"semi_major_axis": 2.0, "semi_minor_axis": 2.0}


def quantity_kind(quantity: str) -> str:
    """Without the raceway's name."""
    return quantity.removeprefix("inner ").removeprefix("outer ")


def study(
    scene: str,
    point: OperatingPoint,
    level: Level,
    supports: tuple[OuterSupport, ...],
    *,
    gyroscopic_moment: bool = False,
) -> dict[OuterSupport, tuple[Compared, dict[str, float]]]:
    """The finest mesh's comparison with the uncertainty of each quantity found, per support."""
    meshes = [
        sector_comparison.compare(scene, point, elements, supports, gyroscopic_moment=gyroscopic_moment)
        for elements in ELEMENTS[level]
    ]
    sizes = [body_mesh.PATCH / body_mesh.cells(elements) for elements in ELEMENTS[level]]
    found = {}
    for support in supports:
        last = meshes[-1][support]
        uncertainty = {}
        for name in QUANTITIES:
            values = [mesh[support].found[name] for mesh in meshes]
            uncertainty[name] = convergence.estimate(sizes, values).uncertainty + last.position_uncertainty[name]
        found[support] = (last, uncertainty)
    return found


def rows_of(case: str, compared: Compared, uncertainty: dict[str, float]) -> list[Row]:
    """The differences from the model: findings, without a tolerance."""
    return [
        Row(
            case,
            name,
            unit,
            compared.model[name],
            MODEL,
            compared.found[name],
            100.0 * uncertainty[name] / abs(compared.model[name]),
            None,
            "a finding: true surfaces, elastic rings and the orbit's own radius against Hertz and rigid rings",
        )
        for name, unit in QUANTITIES.items()
    ]


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """All points, the supports side by side, then the gyroscopic moment."""
    rows: list[Row] = []
    series: dict[str, Any] = {}
    largest = dict.fromkeys(BOUNDS, 0.0)
    points = POINTS[level] if scene == EXAMPLE else (own_point(scene),)
    dofs, solver, imbalance = 0, "", 0.0
    for done, point in enumerate(points):
        progress(point.label, done / len(points))
        steps = [(study(scene, point, level, SUPPORTS[level]), "")]
        if level is Level.RELEASE and point.speed:
            steps.append(
                (study(scene, point, level, (OuterSupport.RIGID,), gyroscopic_moment=True), ", gyroscopic moment")
            )
        for found, step in steps:
            for support, (compared, uncertainty) in found.items():
                rows += rows_of(f"{point.label}, outside diameter {support}{step}", compared, uncertainty)
                _keep(series, f"{support}{step}", point, compared, uncertainty)
                for name in QUANTITIES:
                    kind = quantity_kind(name)
                    if kind in BOUNDS:
                        scale = 1.0 if kind == "angle" else abs(compared.model[name]) / 100.0
                        largest[kind] = max(largest[kind], uncertainty[name] / scale)
                dofs, solver = compared.dofs, compared.solver
                imbalance = max(imbalance, compared.worst_imbalance)
    if level is Level.RELEASE:
        rows += _light_load(scene, level)
    rows.append(_equilibrium(imbalance))
    notes = [_support_note(series), _uncertainty_note(largest, level)]
    mesh = {"elements_per_semi_axis": ELEMENTS[level][-1], "dofs": dofs, "file": "sector-*.npz"}
    return Findings(rows, mesh, solver, {"bearing_sector": series}, [note for note in notes if note])


def _light_load(scene: str, level: Level) -> list[Row]:
    """The limit in which Hertz is exact."""
    found, uncertainty = study(scene, LIGHT, level, (OuterSupport.RIGID,))[OuterSupport.RIGID]
    rows = []
    for race in ("inner", "outer"):
        exact = references.hertz(groove_contact(scene, race).problem(found.found[f"{race} load"]))
        for name, tolerance in LIGHT_TOLERANCE.items():
            reference = getattr(exact, name)
            rows.append(
                Row(
                    f"{LIGHT.label}: the limit of light loads",
                    f"{race} {name}",
                    "m",
                    reference,
                    references.HERTZ_SOURCE,
                    found.found[f"{race} {name}"],
                    100.0 * uncertainty[f"{race} {name}"] / reference,
                    tolerance,
                    "set beforehand: the mesh's uncertainty at this level; the groove's shape is below 0.03 % here",
                )
            )
    return rows


def _equilibrium(imbalance: float) -> Row:
    return Row(
        "all cases: ball and inner ring",
        "imbalance over load",
        "1",
        0.0,
        "statics",
        imbalance,
        None,
        100.0 * EQUILIBRIUM_TOLERANCE,
        "a hundred times what the nonlinear solver is asked for",
    )


def _keep(
    series: dict[str, Any], key: str, point: OperatingPoint, compared: Compared, uncertainty: dict[str, float]
) -> None:
    """Add a point to the series from which the report draws."""
    curve = series.setdefault(key, {}).setdefault("at speed" if point.speed else "at rest", {"load_N": []})
    curve["load_N"].append(point.axial_load)
    for name, unit in QUANTITIES.items():
        scale = 1.0 if unit == "deg" else abs(compared.model[name]) / 100.0
        entry = curve.setdefault(name, {"deviation": [], "uncertainty": []})
        entry["deviation"].append((compared.found[name] - compared.model[name]) / scale)
        entry["uncertainty"].append(uncertainty[name] / scale)


def _support_note(series: dict[str, Any]) -> str:
    if str(OuterSupport.FREE) not in series:
        return ""
    free = series[str(OuterSupport.FREE)]

    def span(name: str, unit: str) -> str:
        values = [value for curve in free.values() for value in curve[name]["deviation"]]
        return f"{min(values):+.2g} to {max(values):+.2g} {unit}"

    displacement = ", ".join(
        f"{min(curve['axial_displacement']['deviation']):+.0f} to "
        f"{max(curve['axial_displacement']['deviation']):+.0f} % {state}"
        for state, curve in free.items()
    )
    return (
        f"With the outside diameter free, against the model's rigid rings: axial displacement {displacement}; inner "
        f"contact load {span('inner load', '%')}, inner contact angle {span('inner angle', 'deg')}. Which is right is "
        "for the designer to say: a tight fit in a stiff housing is near the rigid case, where the model holds within "
        "the rows above; a loose or thin housing lets the outer ring grow. That softens the bearing axially and takes "
        "preload away, far more than anything that Hertz leaves out, and it turns the contact angle."
    )


def _uncertainty_note(largest: dict[str, float], level: Level) -> str:
    parts = [
        f"{name.replace('_', ' ')} {value:.2g} {'deg' if name == 'angle' else '%'} (aimed at: {BOUNDS[name]:g})"
        for name, value in largest.items()
    ]
    return (
        f"Largest uncertainty of any case at the level {level}, meshes and positions of the contact's edge together: "
        + "; ".join(parts)
        + ". Ring sections follow the 218 series (bore 90, outside diameter 160, width 30 mm), shoulders at "
        f"{body_mesh.HIGH_SHOULDER * 180.0 / pi:.0f} and {body_mesh.LOW_SHOULDER * 180.0 / pi:.0f} degrees. The axial "
        "displacement is that of the rigid bore; the ball's position is the mean of its material. Without the step "
        "'gyroscopic moment', model and elements have the centrifugal force alone."
    )


CHECK = Check(
    name="bearing_sector",
    question="One ball between two elastic rings: where does the quasi-static model stop being true?",
    kind=Kind.VALIDATION,
    reference="qsbearing.solve; Hertz for a light load",
    tolerance="differences are findings; light load 2 % of Hertz; equilibrium 1e-5",
    run=run,
    largest_dofs=lambda level: {Level.QUICK: 60_000, Level.RELEASE: 110_000}[level],
)
