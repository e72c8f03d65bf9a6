"""One ball between both rings, finite elements against the quasi-static model, at any operating point of a scene.

The pressure's cells cut the contact's edge somewhere, and every quantity swings as the edge moves through a cell. So
each point is solved at several loads about it, all with the same condensed bodies: load by k^3 and speed by k^1.5,
which scales the ellipse by k and leaves the angles nearly as they are, k evenly over one cell. The deviation from the
model, smooth in the load, is fitted linearly in log k and read at k = 1.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

import qsbearing
from fem_check.contact_problem import Array, ElasticConstants
from fem_check.scenes import OperatingPoint, SceneProblemError
from fem_check.solids.bearing_sector import (
    BearingSector,
    Expected,
    OuterSupport,
    SectorBearing,
    SectorLoad,
    SectorResults,
)

POSITIONS = 16
"""Loads about each operating point."""
ROUNDING = 7
"""Decimals of a metre to which the expected position is rounded, so that every machine takes the same mesh."""

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
class Compared:
    """One operating point on one mesh."""

    model: dict[str, float]
    """The quasi-static model's values."""
    found: dict[str, float]
    """The finite elements', mean over the positions."""
    position_uncertainty: dict[str, float]
    """Twice the standard error of that mean, same unit."""
    dofs: int
    solver: str
    worst_imbalance: float


def sector_bearing(scene_name: str) -> SectorBearing:
    """The bearing of a scene.

    Raises:
        SceneProblemError: the scene has no single bearing, or cannot be read.
    """
    try:
        bearing = qsbearing.load_scene(scene_name).bearing
    except (OSError, ValueError, KeyError) as problem:
        raise SceneProblemError(f"scene {scene_name}: {problem}") from problem

    def constants(material: qsbearing.Material) -> ElasticConstants:
        return ElasticConstants(float(material.elastic_modulus), float(material.poisson_ratio))

    try:
        return SectorBearing(
            ball_count=round(float(bearing.ball_count)),
            ball_diameter=float(bearing.ball_diameter),
            pitch_diameter=float(bearing.pitch_diameter),
            inner_groove_radius=float(bearing.inner_groove_radius),
            outer_groove_radius=float(bearing.outer_groove_radius),
            free_contact_angle=float(bearing.free_contact_angle),
            ball=constants(bearing.ball_material),
            ring=constants(bearing.ring_material),
            ball_density=float(bearing.ball_material.density),
        )
    except TypeError as problem:
        raise SceneProblemError(f"scene {scene_name}: the sector needs a single bearing ({problem})") from problem


def model(scene_name: str, point: OperatingPoint, *, gyroscopic_moment: bool) -> qsbearing.Solution:
    """The quasi-static model at an operating point: with centrifugal force at speed, outer raceway control.

    Raises:
        SceneProblemError: the model has no solution there with both raceways loaded.
    """
    scene = qsbearing.load_scene(scene_name)
    effects: tuple[qsbearing.CentrifugalForce | qsbearing.GyroscopicMoment, ...] = ()
    if point.speed:
        effects = (qsbearing.CentrifugalForce(),)
        if gyroscopic_moment:
            effects = (*effects, qsbearing.GyroscopicMoment())
    solution = qsbearing.solve(
        dataclasses.replace(
            scene,
            operation=qsbearing.Operation(speed=point.speed, axial_load=point.axial_load),
            ball_effects=effects,
            raceway_control=qsbearing.RacewayControl.OUTER if effects else None,
        )
    )
    if not float(solution.inner.load[0]) > 0.0:
        raise SceneProblemError(f"{scene_name} at {point.label}: the model gives the inner raceway no load")
    return solution


def expected(bearing: SectorBearing, solution: qsbearing.Solution) -> Expected:
    """Where the model puts the bodies; the finite elements mesh them there."""
    angle = float(solution.outer.angle[0])
    reach = bearing.outer_groove_radius - bearing.ball_radius + float(solution.outer.approach[0])
    centre = bearing.groove_centre(inner=False) + reach * np.array([np.sin(angle), np.cos(angle)])
    axes = [
        (round(float(c.semi_major_axis[0]), ROUNDING), round(float(c.semi_minor_axis[0]), ROUNDING))
        for c in (solution.inner, solution.outer)
    ]
    return Expected(
        round(float(solution.displacement[0]), ROUNDING),
        (round(float(centre[0]), ROUNDING), round(float(centre[1]), ROUNDING)),
        *axes,
    )


def compare(
    scene_name: str,
    point: OperatingPoint,
    elements: int,
    supports: Sequence[OuterSupport],
    *,
    gyroscopic_moment: bool = False,
    positions: int = POSITIONS,
) -> dict[OuterSupport, Compared]:
    """Solve one operating point on one mesh, with each support of the outer ring."""
    bearing = sector_bearing(scene_name)
    nominal = model(scene_name, point, gyroscopic_moment=gyroscopic_moment)
    sector = BearingSector(bearing, expected(bearing, nominal), elements, supports, friction=gyroscopic_moment)
    factors = 1.0 + ((np.arange(positions) + 0.5) / positions - 0.5) / elements
    deviations: dict[OuterSupport, list[Array]] = {support: [] for support in supports}
    worst = 0.0
    for factor in factors:
        near = OperatingPoint(point.axial_load * factor**3, point.speed * factor**1.5)
        reference = _of_model(model(scene_name, near, gyroscopic_moment=gyroscopic_moment))
        for support in supports:
            results = sector.solve(SectorLoad(near.axial_load, near.speed, gyroscopic_moment), support)
            worst = max(worst, results.imbalance)
            deviations[support].append(_deviation(_of_elements(results), reference))
    reference = _of_model(nominal)
    values = np.array(list(reference.values()))
    table = np.column_stack([np.ones(positions), np.log(factors)])
    compared = {}
    for support in supports:
        found = np.array(deviations[support])
        fit = np.linalg.lstsq(table, found, rcond=None)[0]
        error = 2.0 * (found - table @ fit).std(axis=0, ddof=2) / np.sqrt(positions)
        scale = np.where(_relative(), values, 1.0)
        compared[support] = Compared(
            reference,
            dict(zip(QUANTITIES, values + fit[0] * scale, strict=True)),
            dict(zip(QUANTITIES, np.abs(error * scale), strict=True)),
            sector.dofs,
            sector.ball.solver,
            worst,
        )
    return compared


def _relative() -> Array:
    # Angles and the displacement may pass through zero: their deviation is a difference, the others' a ratio.
    return np.array([unit not in ("deg",) and name != "axial_displacement" for name, unit in QUANTITIES.items()])


def _deviation(found: dict[str, float], reference: dict[str, float]) -> Array:
    f, r = np.array(list(found.values())), np.array(list(reference.values()))
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
    values = [results.axial_displacement]
    for c in (results.inner, results.outer):
        values += [c.load, float(np.degrees(c.angle)), c.semi_major_axis, c.semi_minor_axis, c.max_pressure]
    return dict(zip(QUANTITIES, values, strict=True))
