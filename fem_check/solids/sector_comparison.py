"""One ball between both rings, finite elements against the quasi-static model, at any operating point of a scene.

The pressure's cells cut the contact's edge somewhere, and every quantity swings as the edge moves through a cell. So
each point is solved at several loads about it, all with the same condensed bodies: load by k^3 and speed by k^1.5,
which scales the ellipse by k and leaves the angles nearly as they are, k evenly over one cell. The deviation from the
model, smooth in the load, is fitted linearly in log k and read at k = 1.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass
from math import cos
from typing import Any

import numpy as np

import qsbearing
from fem_check.independent.contact_problem import Array
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.ring_sections import RingProfile
from fem_check.product.scenes import SceneProblemError, ball_count, drawing_of, load_scene, ring_sections, solved
from fem_check.solids import contact_block
from fem_check.solids.bearing_sector import BearingSector, OuterSupport, SectorLoad, SectorResults
from fem_check.solids.half_space_sector import HalfSpaceSector
from fem_check.solids.sector_geometry import Expected, SectorBearing, SectorGeometry

POSITIONS, PARTS = 16, 4
"""Loads about each operating point, and interleaved parts of them."""
HALF_SPACE_CELLS, HALF_SPACE_POSITIONS = (3, 4), 8
"""Pressure cells per semi-minor axis of the half-spaces' two grids, and loads about the point."""
ROUNDING = 7
"""Decimals of a metre to which the expected position is rounded, so that every machine takes the same mesh."""
COARSE = 3
"""Elements per semi-minor axis of the mesh that finds where a free outer ring puts the contacts."""
ROOM = {OuterSupport.RIGID: 1.05, OuterSupport.FREE: 1.15}
"""Semi-axes that the meshes are made for, over those expected: loads about the point need more room than its own, the
more so where an outer ring that grows with them moves the contact."""

QUANTITIES = {
    "axial_displacement": "m",
    **{
        f"{race} {name}": unit
        for race in ("inner", "outer")
        for name, unit in (
            ("load", "N"),
            ("angle", "deg"),
            ("semi_major_axis", "m"),
            ("semi_minor_axis", "m"),
            ("max_pressure", "Pa"),
        )
    },
}
"""What is compared, and its unit."""


@dataclass(frozen=True)
class ThrustPoint:
    """A pure thrust load at a speed: every ball carries the same."""

    axial_load: float
    """[N]"""
    speed: float
    """Of the inner ring [rad/s]."""

    @property
    def label(self) -> str:
        """In the field's units."""
        speed = f"{self.speed / qsbearing.rpm:.0f} rpm" if self.speed else "at rest"
        return f"Fa = {self.axial_load:.0f} N, {speed}"


def own_point(scene_name: str) -> ThrustPoint:
    """The thrust and the inner ring's speed of a scene; what else it carries, the sector of one ball cannot.

    Raises:
        SceneProblemError: the scene has no single, positive axial load.
    """
    solution = solved(scene_name)[0].solution
    load, speed = np.asarray(solution.load[..., 0]), np.asarray(solution.scene.operation.speed or 0.0, float)
    if load.size != 1 or speed.size != 1 or not float(load.reshape(())) > 0.0:
        raise SceneProblemError(
            f"scene {scene_name}: one ball between both rings needs one axial load above 0; a scene with a radial load "
            "or a moment alone has no ball that stands for all"
        )
    return ThrustPoint(float(load.reshape(())), float(speed.reshape(())))


@dataclass(frozen=True)
class Values:
    """Of one kind, by quantity: the mean over the positions, and twice its standard error, same unit."""

    model: dict[str, float]
    """The quasi-static model's."""
    elements: dict[str, float]
    """The finite elements'."""
    position_uncertainty: dict[str, float]


@dataclass(frozen=True)
class ComparedSector(Values):
    """One operating point on one mesh: against the model as it is by default, Hertz at the free contact angle.

    Ellipse and largest pressure less what the mesh makes of a parabola.
    """

    as_read: Values
    """As the mesh has them, against the model with Hertz at each contact's own angle and the ball's own orbit."""
    dofs: int
    solver: str


def sector_bearing(scene_name: str) -> SectorBearing:
    """The bearing of a scene.

    Raises:
        SceneProblemError: the scene has no single bearing, or cannot be read.
    """
    scene = load_scene(scene_name)
    return SectorBearing(drawing_of(scene, scene_name), ball_count(scene), ring_sections(scene, scene_name))


def model(
    scene_name: str, point: ThrustPoint, *, gyroscopic_moment: bool, free_outer_ring: bool = False
) -> qsbearing.Solution:
    """The quasi-static model at an operating point: equal balls; at speed outer control and their inertia.

    Args:
        free_outer_ring: the outer ring gives way as one whose outside diameter is free; else both rings are rigid.

    Raises:
        SceneProblemError: the model has no solution there with both raceways loaded.
    """
    scene = load_scene(scene_name)
    effects: tuple[qsbearing.CentrifugalForce | qsbearing.GyroscopicMoment, ...] = ()
    if point.speed:
        effects = (qsbearing.CentrifugalForce(),)
        if gyroscopic_moment:
            effects = (*effects, qsbearing.GyroscopicMoment())
    left_out = (qsbearing.BallDiameterDeviations, qsbearing.ElasticRings, qsbearing.SeatsOutOfRound)
    ring_effects: tuple[Any, ...] = tuple(each for each in scene.ring_effects if not isinstance(each, left_out))
    if free_outer_ring:
        bearing = sector_bearing(scene_name)
        profile = bearing.sections.profile(bearing.drawing, "outer")
        ring_effects = (*ring_effects, free_ring(bearing.drawing, profile))
    solution = qsbearing.solve(
        dataclasses.replace(
            scene,
            operation=qsbearing.Operation(speed=point.speed, axial_load=point.axial_load),
            ball_effects=effects,
            raceway_control=qsbearing.RacewayControl.OUTER if effects else None,
            preload=None,
            orbit_radius=qsbearing.OrbitRadius.PITCH_CIRCLE,
            ring_effects=ring_effects,
        )
    )
    if not float(solution.inner.load[0]) > 0.0:
        raise SceneProblemError(f"{scene_name} at {point.label}: the model gives the inner raceway no load")
    return solution


def free_ring(drawing: BearingDrawing, profile: RingProfile) -> qsbearing.ElasticRings:
    """The effect that lets the outer ring give way as one whose outside diameter is free."""
    centre, radius = drawing.outer_groove_centre_radius, drawing.outer_groove_radius
    shoulder, opposite = (
        2.0 * (centre + radius * cos(angle)) for angle in (profile.high_shoulder, profile.low_shoulder)
    )
    return qsbearing.ElasticRings(
        outside_diameter=2.0 * profile.back_radius, outer_width=profile.width, housing="free",
        outer_shoulder_diameter=shoulder, outer_open_diameter=opposite,
    )  # fmt: skip


def with_free_ring(scene_name: str, point: ThrustPoint) -> dict[str, float]:
    """What the model computes at a point where its outer ring gives way as a free one, by quantity."""
    return _of_model(model(scene_name, point, gyroscopic_moment=False, free_outer_ring=True))


def nearest(solution: qsbearing.Solution) -> qsbearing.Solution:
    """The model at the same point as near to true surfaces as it comes: Hertz at each contact's own angle, and at speed
    the ball on its own orbit."""
    scene = solution.scene
    orbit = qsbearing.OrbitRadius.DISPLACED if scene.ball_effects else scene.orbit_radius
    return qsbearing.solve(dataclasses.replace(scene, hertz_angle=qsbearing.HertzAngle.ACTUAL, orbit_radius=orbit))


def expected(bearing: SectorBearing, solution: qsbearing.Solution) -> Expected:
    """Where the model puts the bodies; the finite elements mesh them there."""
    angle = float(solution.outer.angle[0])
    reach = bearing.groove_radius(inner=False) - bearing.ball_radius + float(solution.outer.approach[0])
    centre = bearing.groove_centre(inner=False) + reach * np.array([np.sin(angle), np.cos(angle)])
    contacts = (solution.inner, solution.outer)
    return _rounded(float(solution.displacement[0]), centre, contacts, ROOM[OuterSupport.RIGID])


def _rounded(axial_displacement: float, ball_centre: Array, contacts: Iterable[Any], room: float) -> Expected:
    def rounded(value: Any) -> float:
        return round(float(np.ravel(value)[0]), ROUNDING)

    return Expected(
        rounded(axial_displacement),
        (rounded(ball_centre[0]), rounded(ball_centre[1])),
        *[(rounded(room * c.semi_major_axis), rounded(room * c.semi_minor_axis)) for c in contacts],
    )


def place(scene_name: str, point: ThrustPoint, support: OuterSupport, *, gyroscopic_moment: bool = False) -> Expected:
    """Where the bodies are meshed: the model's position; with a support that it knows nothing of, where a coarse mesh
    there finds them."""
    bearing = sector_bearing(scene_name)
    near = expected(bearing, model(scene_name, point, gyroscopic_moment=gyroscopic_moment))
    if support is OuterSupport.RIGID:
        return near
    results = BearingSector(SectorGeometry(bearing, near, COARSE), support).solve(
        SectorLoad(point.axial_load, point.speed)
    )
    return _rounded(results.axial_displacement, results.ball_centre, (results.inner, results.outer), ROOM[support])


def compare(
    scene_name: str,
    point: ThrustPoint,
    sector: BearingSector,
    *,
    gyroscopic_moment: bool = False,
    positions: int = POSITIONS,
) -> ComparedSector:
    """Compare one operating point on one mesh, made for it."""
    cell = ROOM[sector.support] * contact_block.PATCH / contact_block.cells(sector.geometry.elements)
    factors = 1.0 + cell * ((np.arange(positions) + 0.5) / positions - 0.5)
    deviations: dict[str, list[Array]] = {"default": [], "as read": []}
    for factor in factors:
        near = ThrustPoint(point.axial_load * factor**3, point.speed * factor**1.5)
        solution = model(scene_name, near, gyroscopic_moment=gyroscopic_moment)
        results = sector.solve(SectorLoad(near.axial_load, near.speed, gyroscopic_moment))
        read, mesh = _of_elements(results), _of_parabola(sector, results)
        corrected = {name: value / mesh.get(name, 1.0) for name, value in read.items()}
        deviations["default"].append(_deviation(corrected, _of_model(solution)))
        deviations["as read"].append(_deviation(read, _of_model(nearest(solution))))
    solution = model(scene_name, point, gyroscopic_moment=gyroscopic_moment)
    default = _averaged(_of_model(solution), deviations["default"], factors)
    as_read = _averaged(_of_model(nearest(solution)), deviations["as read"], factors)
    return ComparedSector(
        default.model,
        default.elements,
        default.position_uncertainty,
        as_read,
        sector.dofs,
        sector.ball.solver,
    )


def half_spaces(scene_name: str, point: ThrustPoint, *, gyroscopic_moment: bool) -> tuple[Values, HalfSpaceSector]:
    """The sector with half-spaces for bodies against `nearest`, and its finer grid's sector.

    The uncertainty is that of the positions and the change from the coarser grid.
    """
    bearing, per_grid = sector_bearing(scene_name), []
    where = place(scene_name, point, OuterSupport.RIGID, gyroscopic_moment=gyroscopic_moment)
    for elements in HALF_SPACE_CELLS:
        sector = HalfSpaceSector(SectorGeometry(bearing, where, elements))
        cell = ROOM[OuterSupport.RIGID] * contact_block.PATCH / contact_block.cells(elements)
        factors = 1.0 + cell * ((np.arange(HALF_SPACE_POSITIONS) + 0.5) / HALF_SPACE_POSITIONS - 0.5)
        deviations = []
        for factor in factors:
            near = ThrustPoint(point.axial_load * factor**3, point.speed * factor**1.5)
            reference = nearest(model(scene_name, near, gyroscopic_moment=gyroscopic_moment))
            results = sector.solve(SectorLoad(near.axial_load, near.speed, gyroscopic_moment))
            deviations.append(_deviation(_of_elements(results), _of_model(reference)))
        reference = nearest(model(scene_name, point, gyroscopic_moment=gyroscopic_moment))
        per_grid.append(_averaged(_of_model(reference), deviations, factors))
    coarse, fine = per_grid
    change = {
        name: abs(fine.elements[name] - coarse.elements[name]) + fine.position_uncertainty[name] for name in QUANTITIES
    }
    return Values(fine.model, fine.elements, change), sector


def _averaged(reference: dict[str, float], deviations: list[Array], factors: Array) -> Values:
    """Deviations at all positions as one value at the point itself."""
    values = np.array(list(reference.values()))
    table = np.column_stack([np.ones(len(factors)), np.log(factors)])
    at_positions = np.array(deviations)
    fit = np.linalg.lstsq(table, at_positions, rcond=None)[0]
    # Positions are spread evenly, not drawn: the scatter of evenly spread parts of them tells how well they average.
    parts = np.array([np.linalg.lstsq(table[k::PARTS], at_positions[k::PARTS], rcond=None)[0][0] for k in range(PARTS)])
    error = 2.0 * parts.std(axis=0, ddof=1) / np.sqrt(PARTS)
    scale = np.where(_relative(), values, 1.0)
    return Values(
        reference,
        dict(zip(QUANTITIES, values + fit[0] * scale, strict=True)),
        dict(zip(QUANTITIES, np.abs(error * scale), strict=True)),
    )


def _relative() -> Array:
    # Angles and the displacement may pass through zero: their deviation is a difference, the others' a ratio.
    return np.array([unit not in ("deg",) and name != "axial_displacement" for name, unit in QUANTITIES.items()])


def _deviation(computed: dict[str, float], reference: dict[str, float]) -> Array:
    f, r = np.array(list(computed.values())), np.array(list(reference.values()))
    return np.where(_relative(), f / r - 1.0, f - r)


def _of_model(solution: qsbearing.Solution) -> dict[str, float]:
    values = [float(solution.displacement[0])]
    for c in (solution.inner, solution.outer):
        values += [
            float(c.load[0]),
            float(np.degrees(c.angle[0])),
            float(c.semi_major_axis[0]),
            float(c.semi_minor_axis[0]),
            float(c.max_pressure[0]),
        ]
    return dict(zip(QUANTITIES, values, strict=True))


def _of_elements(results: SectorResults) -> dict[str, float]:
    """Everything found, as it is read."""
    values = [results.axial_displacement]
    for c in (results.inner, results.outer):
        values += [c.load, float(np.degrees(c.angle)), c.semi_major_axis, c.semi_minor_axis, c.max_pressure]
    return dict(zip(QUANTITIES, values, strict=True))


def _of_parabola(sector: BearingSector, results: SectorResults) -> dict[str, float]:
    """What the same mesh makes of ellipse and pressure of contacts where Hertz is exact, over Hertz's."""
    return {
        f"{race} {name}": ratio
        for race, c in (("inner", results.inner), ("outer", results.outer))
        for name, ratio in sector.parabola_over_hertz(race, c).items()
    }
