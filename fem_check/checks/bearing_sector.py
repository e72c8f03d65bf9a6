"""Ball between both rings: where does the quasi-static model stop being true, and what do the rings' supports do?"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import qsbearing
from fem_check import convergence, meshing, sector_comparison, sector_pictures
from fem_check.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row
from fem_check.contact import ContactError
from fem_check.scenes import beyond_thrust, solved
from fem_check.sector_comparison import QUANTITIES, Compared, OperatingPoint, own_point
from fem_check.solids import contact_block
from fem_check.solids.bearing_sector import BearingSector, OuterSupport, SectorLoad
from fem_check.solids.sector_geometry import SectorGeometry

ELEMENTS = {Level.QUICK: (2, 3, 4), Level.RELEASE: (2, 3, 4, 5)}
"""Per semi-minor axis; five take 2 GB."""
ORDER = 2.0
"""By which the errors of all else fall at least; on half-spaces those of the ellipse fall by 2.4 (`convergence_order`).
"""
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
"""Largest uncertainty allowed at the release level, outside diameter fixed, centrifugal force alone; in per cent, of
angles in degrees."""
FOLLOWING_APPROACH = {
    OuterSupport.RIGID: ("axial_displacement",),
    OuterSupport.FREE: ("axial_displacement", "load", "angle"),
}
"""What has the error of the contacts' approaches on a mesh. In rigid seats loads and angles hardly depend on these; a
free outer ring takes the place that they leave it."""
MOMENT_STEP = ", gyroscopic moment"
WITH_MOMENT = f"{OuterSupport.RIGID}{MOMENT_STEP}"
"""Names the series with it."""
MODEL = "qsbearing.solve, Hertz at the free contact angle, the same effects"
EQUILIBRIUM_TOLERANCE = 1e-5
# The limit of light loads has an exact answer: Hertz's contact, and the model. What keeps a real bearing from it
# shrinks with the load by a known power: the bodies' compliance, linear in the load, beside an approach that grows with
# its 2/3rd power; and the grooves' shape beside their parabola, with the square of the ellipse.
LIMIT_POWERS = {"axial_displacement": 1.0 / 3.0, "semi_major_axis": 2.0 / 3.0, "semi_minor_axis": 2.0 / 3.0}


def quantity_kind(quantity: str) -> str:
    """Without the raceway's name."""
    return quantity.removeprefix("inner ").removeprefix("outer ")


@dataclass(frozen=True)
class Studied:
    """One operating point, from all meshes."""

    point: OperatingPoint
    compared: Compared
    uncertainty: dict[str, float]
    """Of each quantity found, same unit."""
    sector: BearingSector
    """Its finest mesh."""

    def scale(self, name: str) -> float:
        """What deviations and uncertainties count in: a hundredth of the model's value, or a degree."""
        return 1.0 if QUANTITIES[name] == "deg" else abs(self.compared.model[name]) / 100.0

    def deviation(self, name: str) -> float:
        """Elements less model, per cent or degrees."""
        return (self.compared.found[name] - self.compared.model[name]) / self.scale(name)

    def uncertain(self, name: str) -> float:
        """The uncertainty, per cent or degrees."""
        return self.uncertainty[name] / self.scale(name)


def study(
    scene: str, point: OperatingPoint, level: Level, support: OuterSupport, *, gyroscopic_moment: bool = False
) -> Studied:
    """Solve a point on all meshes: ellipse and pressure of the finest, the rest extrapolated at the release level."""
    meshes: list[Compared] = []
    sizes: list[float] = []
    try:
        where = sector_comparison.place(scene, point, support, gyroscopic_moment=gyroscopic_moment)
        for elements in ELEMENTS[level]:
            try:
                geometry = SectorGeometry(sector_comparison.sector_bearing(scene), where, elements)
                sector = BearingSector(geometry, support, friction=gyroscopic_moment)
                meshes.append(sector_comparison.compare(scene, point, sector))
            except ContactError:
                # The coarsest mesh may lack room for the loads about the point; three are enough.
                if elements != ELEMENTS[level][0] or len(ELEMENTS[level]) < 4:
                    raise
                continue
            sizes.append(contact_block.PATCH / contact_block.cells(elements))
    except ContactError as problem:
        raise ContactError(f"{point.label}, outside diameter {support}: {problem}") from problem
    last = meshes[-1]
    found, uncertainty = {}, {}
    for name in QUANTITIES:
        values = [mesh.found[name] for mesh in meshes]
        if quantity_kind(name) in FOLLOWING_APPROACH[support] and level is Level.RELEASE:
            found[name], of_mesh = convergence.extrapolated(sizes, values)
        else:
            found[name], of_mesh = values[-1], convergence.uncertainty_at_order(sizes, values, ORDER)
        uncertainty[name] = of_mesh + last.position_uncertainty[name]
    return Studied(point, replace(last, found=found), uncertainty, sector)


def rows_of(case: str, studied: Studied) -> list[Row]:
    """The differences from the model: findings, without a tolerance."""
    compared = studied.compared
    return [
        Row(
            case,
            name,
            unit,
            compared.model[name],
            MODEL,
            compared.found[name],
            100.0 * studied.uncertainty[name] / abs(compared.model[name]),
            None,
            "a finding: true surfaces, elastic rings and the orbit's own radius against Hertz and rigid rings",
        )
        for name, unit in QUANTITIES.items()
    ]


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """All points, the supports side by side, then the gyroscopic moment."""
    rows: list[Row] = []
    series: dict[str, Any] = {}
    points = POINTS[level] if scene == EXAMPLE else (own_point(scene),)
    dofs, solver, imbalance = 0, "", 0.0
    at_rest: list[Studied] = []
    for done, point in enumerate(points):
        progress(point.label, done / len(points))
        steps = [(support, "") for support in SUPPORTS[level]]
        if level is Level.RELEASE and point.speed:
            steps.append((OuterSupport.RIGID, MOMENT_STEP))
        for support, step in steps:
            studied = study(scene, point, level, support, gyroscopic_moment=bool(step))
            rows += rows_of(f"{point.label}, outside diameter {support}{step}", studied)
            _keep(series, f"{support}{step}", studied)
            dofs, solver = max(dofs, studied.compared.dofs), studied.compared.solver
            imbalance = max(imbalance, studied.compared.worst_imbalance)
            if support is OuterSupport.RIGID and not step:
                drawn = studied
                if not point.speed:
                    at_rest.append(studied)
    if level is Level.RELEASE:
        rows += uncertainty_rows(series)
        if len(at_rest) > 1:
            rows += _light_load_limit(*at_rest[:2])
    rows.append(_equilibrium(imbalance))
    notes = [
        _support_note(series),
        *(uncertainty_note(series, key, level) for key in series),
        moment_note(series),
        bearing_note(scene),
        NOTE,
    ]
    mesh = {"elements_per_semi_axis": ELEMENTS[level][-1], "dofs": dofs, "file": "sector-*.npz"}
    pictures = {"bearing_sector": series, "sector": _drawn(drawn)}
    return Findings(rows, mesh, solver, pictures, [note for note in notes if note])


def _drawn(studied: Studied) -> dict[str, Any]:
    """A point on its finest mesh, for the pictures."""
    point, sector = studied.point, studied.sector
    return sector_pictures.of_sector(sector, sector.solve(SectorLoad(point.axial_load, point.speed)), point.label)


def _light_load_limit(light: Studied, heavier: Studied) -> list[Row]:
    """Deviations from the model at two light loads, continued to none by the power of each."""
    rows = []
    ratio = heavier.point.axial_load / light.point.axial_load
    for name in QUANTITIES:
        kind = quantity_kind(name)
        if kind not in LIMIT_POWERS:
            continue
        growth = ratio ** LIMIT_POWERS[kind]
        gain = (growth + 1.0) / (growth - 1.0)
        limit = (growth * light.deviation(name) - heavier.deviation(name)) / (growth - 1.0)
        uncertainty = (growth * light.uncertain(name) + heavier.uncertain(name)) / (growth - 1.0)
        rows.append(
            Row(
                f"limit of light loads, from {light.point.axial_load:.0f} and {heavier.point.axial_load:.0f} N at rest",
                f"{name} over the model's",
                "1",
                1.0,
                "exact: the deviations vanish with the load",
                1.0 + limit / 100.0,
                uncertainty,
                2.0 * gain * BOUNDS[kind],
                f"twice the uncertainty aimed at, {BOUNDS[kind]:g} %, as the continuation enlarges it",
            )
        )
    return rows


def largest_uncertainty(states: dict[str, Any]) -> dict[str, float]:
    """Of any case of one series, per kind of quantity; per cent or degrees."""
    largest = dict.fromkeys(BOUNDS, 0.0)
    for curve in states.values():
        for name in QUANTITIES:
            kind = quantity_kind(name)
            if kind in BOUNDS:
                largest[kind] = max(largest[kind], *curve[name]["uncertainty"])
    return largest


def uncertainty_rows(series: dict[str, Any]) -> list[Row]:
    """What the comparison with the model resolves where the outside diameter is fixed.

    It has a tolerance where centrifugal force acts alone. With the gyroscopic moment it is a finding: none was set
    before that series was first run.
    """
    alone = "outside diameter rigid, centrifugal force alone, all loads and speeds: largest uncertainty"
    with_moment = "outside diameter rigid, gyroscopic moment, all loads at speed: largest uncertainty"
    return [
        *_uncertainties(
            alone,
            series[str(OuterSupport.RIGID)],
            "what the comparison must resolve: a twentieth to a fifth of the largest difference in these cases",
            BOUNDS,
        ),
        *(
            _uncertainties(with_moment, series[WITH_MOMENT], "a finding: see the notes")
            if WITH_MOMENT in series
            else ()
        ),
    ]


def _uncertainties(
    case: str, states: dict[str, Any], why: str, bounds: Mapping[str, float] = MappingProxyType({})
) -> list[Row]:
    """Rows of the largest uncertainties of one series; without a bound a finding."""
    return [
        Row(
            case,
            kind,
            "deg" if kind == "angle" else "1",
            0.0,
            "four meshes, and sixteen positions of the contact's edge",
            value if kind == "angle" else value / 100.0,
            None,
            (100.0 if kind == "angle" else 1.0) * bounds[kind] if kind in bounds else None,
            why,
        )
        for kind, value in largest_uncertainty(states).items()
    ]


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


def _keep(series: dict[str, Any], key: str, studied: Studied) -> None:
    """Add a point to the series from which the report draws."""
    state = "at speed" if studied.point.speed else "at rest"
    curve = series.setdefault(key, {}).setdefault(state, {"load_N": []})
    curve["load_N"].append(studied.point.axial_load)
    for name in QUANTITIES:
        entry = curve.setdefault(name, {"deviation": [], "uncertainty": []})
        entry["deviation"].append(studied.deviation(name))
        entry["uncertainty"].append(studied.uncertain(name))


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


def uncertainty_note(series: dict[str, Any], key: str, level: Level) -> str:
    """What the cases of one series resolve."""
    parts = [
        f"{name.replace('_', ' ')} {value:.2g} {'deg' if name == 'angle' else '%'}"
        for name, value in largest_uncertainty(series[key]).items()
    ]
    return (
        f"Largest uncertainty of any case with the outside diameter {key} at the level {level}, meshes and positions "
        f"of the contact's edge together: {'; '.join(parts)}."
    )


def moment_note(series: dict[str, Any]) -> str:
    """Whether the series with gyroscopic moment would meet the tolerances of that without."""
    if WITH_MOMENT not in series:
        return ""
    found = largest_uncertainty(series[WITH_MOMENT])
    more = [
        f"{kind.replace('_', ' ')} {found[kind]:.2g} {'deg' if kind == 'angle' else '%'} where {bound:g} are allowed"
        for kind, bound in BOUNDS.items()
        if found[kind] > bound
    ]
    return (
        "The tolerances on the uncertainty are those of centrifugal force alone. No tolerance was set for the series "
        "with gyroscopic moment before its first run, so its uncertainties are findings; by the tolerances of "
        f"centrifugal force alone {'it would fail: ' + ', '.join(more) if more else 'it would pass'}."
    )


def bearing_note(scene: str) -> str:
    """The ring sections, each given or assumed; and what of a scene's own loads the sector leaves out."""
    bearing = sector_comparison.sector_bearing(scene)
    profiles = {race: bearing.sections.profile(bearing.drawing, race) for race in ("inner", "outer")}
    beside = [] if scene == EXAMPLE else beyond_thrust(solved(scene)[0].solution)
    left_out = f" One ball knows thrust and speed alone; left out: {', '.join(beside)}." if beside else ""
    return f"{bearing.sections.told(bearing.drawing, profiles)}{left_out}"


NOTE = (
    "The axial "
    "displacement is that of the rigid bore; the ball's position is the mean of its material. Ellipse and largest "
    "pressure are over those of Hertz's parabola on the same bodies, mesh, load and place, where Hertz is exact: what "
    "the mesh does to both cancels. Without the step 'gyroscopic moment', model and elements have the centrifugal "
    "force alone."
)


CHECK = Check(
    name="bearing_sector",
    question="One ball between two elastic rings: where does the quasi-static model stop being true?",
    kind=Kind.MODEL_COMPARISON,
    reference="qsbearing.solve; exact in the limit of light loads",
    tolerance="differences are findings; uncertainty (centrifugal force alone), light loads, equilibrium: rows",
    run=run,
    largest_dofs=lambda level: {Level.QUICK: 60_000, Level.RELEASE: 110_000}[level],
)


def keep_meshes() -> None:
    """Put the quick level's meshes into the repository, and what they are into their manifest."""
    folder = meshing.committed_folder()
    for path in folder.glob("sector-*.npz"):
        path.unlink()
    entries = {}
    for point in POINTS[Level.QUICK]:
        where = sector_comparison.place(EXAMPLE, point, OuterSupport.RIGID)
        for elements in ELEMENTS[Level.QUICK]:
            geometry = SectorGeometry(sector_comparison.sector_bearing(EXAMPLE), where, elements)
            for body in ("ball", "inner", "outer"):
                path = folder / geometry.mesh_file(body)
                geometry.standing_mesh(body).save(path)
                entries[path.name] = {
                    "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
                    "gmsh": meshing.gmsh_version(),
                }
    (folder / "sector_manifest.json").write_text(json.dumps(dict(sorted(entries.items())), indent=1) + "\n")


if __name__ == "__main__":
    keep_meshes()
