"""Is what `qsbearing.solve` reports right: every contact, the balls' motion and forces, the ring's equilibrium?

Judged from the drawing's dimensions alone (`drawing`, `references`, `equilibrium`: no code of qsbearing), and by finite
elements. Contacts of one shape are similar at every load, so one finite-element contact stands for all balls and
operating points; where each contact has a shape of its own (`hertz_angle = "actual"`), the most and the least slender.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

import qsbearing
from fem_check import equilibrium, half_space_contact, references
from fem_check.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row, collapsed
from fem_check.checks import groove_contacts
from fem_check.contact_problem import QUANTITIES, ContactProblem
from fem_check.drawing import Drawing
from fem_check.equilibrium import Contacts
from fem_check.groove import RACES
from fem_check.half_space_contact import TOLERANCES, WHY, MeshStudy
from fem_check.scenes import Solved, drawing_of, load_scene, operating_points, solve, solved

TOLERANCE = 1e-8
"""Of closed forms: both sides work at full precision, and lose some digits in root finding and in differences."""
SHEAR_TOLERANCES = {"max_shear_stress": 1e-7, "max_shear_depth": 1e-4}
"""One side integrates numerically; a maximum's position is known to the square root of the precision of its value."""
POWERS = {**dict.fromkeys(QUANTITIES, 1.0 / 3.0), "approach": 2.0 / 3.0}
"""Of the load, at which each quantity of similar contacts grows (Hertz)."""
OF_SOLUTION = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")


@dataclass(frozen=True)
class Loaded:
    """One loaded contact of a solution."""

    label: str
    problem: ContactProblem
    """As it follows from the drawing."""
    reported: dict[str, float]


def loaded_contacts(drawing: Drawing, race: str, points: tuple[Solved, ...]) -> list[Loaded]:
    """Every loaded contact of a race, at all operating points."""
    found = []
    for point in points:
        scene, contacts = point.solution.scene, getattr(point.solution, race)
        for ball in np.flatnonzero(contacts.load > 0.0):
            angle = {"free": None, "zero": 0.0, "actual": float(contacts.angle[ball])}[str(scene.hertz_angle)]
            load = float(contacts.load[ball])
            reported = {name: float(getattr(contacts, name)[ball]) for name in OF_SOLUTION}
            problem = drawing.groove(race, angle).problem(load)
            found.append(Loaded(f"{point.label}, ball {ball}, Q = {load:.4g} N", problem, reported))
    return found


@lru_cache(maxsize=64)
def _shear(ellipticity: float, poisson_ratio: float) -> Any:
    return qsbearing.subsurface_shear(ellipticity, poisson_ratio)


def with_shear(contact: Loaded) -> dict[str, float]:
    """What is reported of a contact, with the largest shear below it that qsbearing gives."""
    a, b = contact.reported["semi_major_axis"], contact.reported["semi_minor_axis"]
    shear = _shear(float(f"{a / b:.12g}"), contact.problem.race.poisson_ratio)
    return contact.reported | {
        "max_shear_stress": shear.stress * contact.reported["max_pressure"],
        "max_shear_depth": shear.depth * b,
    }


def closed_form_rows(contacts: list[Loaded], extremes: list[Loaded]) -> Iterator[Row]:
    """Every contact against Hertz from the drawing; its shear for the contacts of the extreme shapes."""
    for contact in contacts:
        exact = references.hertz(contact.problem)
        shear = any(contact is extreme for extreme in extremes)
        for name, found in (with_shear(contact) if shear else contact.reported).items():
            yield Row(
                contact.label,
                name,
                QUANTITIES[name],
                getattr(exact, name),
                f"from the drawing: {references.SHEAR_SOURCE if name in SHEAR_TOLERANCES else references.HERTZ_SOURCE}",
                found,
                None,
                100.0 * SHEAR_TOLERANCES.get(name, TOLERANCE),
                "two derivations at full precision, some digits lost in root finding; the shear is integrated, and its "
                "depth known to the square root of its precision",
            )


def element_rows(contacts: list[Loaded], study: MeshStudy, level: Level) -> Iterator[Row]:
    """Every contact of the study's shape against the finite elements, each value at its load's power."""
    for contact in contacts:
        if not np.isclose(_slenderness(contact), _ratio(study.problem), rtol=1e-12, atol=0.0):
            continue
        size = contact.problem.load / study.problem.load
        for name, found in with_shear(contact).items():
            reference = study.value(name) * size ** POWERS[name]
            yield Row(
                contact.label,
                name,
                QUANTITIES[name],
                reference,
                "finite elements, finest mesh",
                found,
                100.0 * study.uncertainty(name) / study.value(name),
                TOLERANCES[level][name],
                WHY[level],
            )


def _ratio(problem: ContactProblem) -> float:
    return problem.curvature_x / problem.curvature_y


def _slenderness(contact: Loaded) -> float:
    return _ratio(contact.problem)


def mechanics_rows(drawing: Drawing, point: Solved) -> Iterator[Row]:
    """Geometry, motion, forces of the balls, and the ring's equilibrium at one operating point."""
    solution = point.solution
    scene, azimuth = solution.scene, np.asarray(solution.azimuth)
    lever = drawing.inner_groove_centre_radius
    if scene.tilt_lever is qsbearing.TiltLever.PITCH_CIRCLE:
        lever = 0.5 * drawing.pitch_diameter

    def row(quantity: str, found: float, source: str) -> Row:
        why = "equations that hold exactly; the solver ends at rounding"
        return Row(point.label, quantity, "1", 0.0, source, found, None, 100.0 * TOLERANCE, why)

    def difference(found: Any, expected: Any, scale: float) -> float:
        return float(np.abs(np.asarray(found) - expected).max(initial=0.0)) / scale

    inner, outer = (
        Contacts(*(np.nan_to_num(getattr(getattr(solution, race), name)) for name in ("load", "angle", "approach")))
        for race in RACES
    )
    placed = np.isfinite(solution.inner.angle) & np.isfinite(solution.outer.angle)
    wrong = sum(int(np.sum((each.load > 0.0) != (each.approach > 0.0))) for each in (inner, outer))
    yield row("contacts loaded without approach, or the reverse", wrong, "only what is compressed carries load")
    missed = equilibrium.closure(drawing, inner, outer, azimuth, np.asarray(solution.displacement), lever)[placed]
    largest = max(inner.approach.max(), outer.approach.max())
    yield row("loop closure, over the approach", difference(missed, 0.0, largest), "displacement, angles, approaches")

    none = np.zeros_like(azimuth)
    inner_friction = outer_friction = np.zeros((len(azimuth), 2))
    centrifugal = none
    if scene.raceway_control is not None:
        speeds = [float(np.asarray(value or 0.0)) for value in (scene.operation.speed, scene.operation.outer_speed)]
        control, both = np.asarray(solution.raceway_control), (inner.load > 0.0) & (outer.load > 0.0)
        orbit, rotation = equilibrium.rolling(drawing, inner, outer, speeds[0], speeds[1], control)
        # A ball that one raceway has lost rolls by a convention of the model's, which is taken as it is reported.
        orbit = np.where(both, orbit, np.asarray(solution.orbital_speed))
        turning = max(map(abs, speeds)) or 1.0
        source = "no slip at both contacts, no spin at the controlling one"
        yield row("orbital speed, over the ring's", difference(solution.orbital_speed, orbit, turning), source)
        own = -np.sign(speeds[0] - speeds[1]) * np.hypot(*rotation.T)
        reported = np.asarray(solution.rotation_speed)
        yield row("rotation speed, over the ring's", difference(reported[both], own[both], turning), source)
        if solution.centrifugal_force is not None:
            centrifugal = equilibrium.centrifugal_force(drawing, orbit)
            found = difference(solution.centrifugal_force, centrifugal, centrifugal.max() or 1.0)
            yield row("centrifugal force", found, "m r omega^2 of a solid sphere at the pitch circle")
        if solution.gyroscopic_moment is not None:
            assert scene.gyroscopic_moment is not None
            moment = equilibrium.gyroscopic_moment(drawing, orbit, rotation)
            moment = np.where(both, moment, -np.asarray(solution.gyroscopic_moment))
            found = difference(solution.gyroscopic_moment, -moment, np.abs(moment).max() or 1.0)
            yield row("gyroscopic moment", found, "rate of change of a solid sphere's angular momentum")
            halves = scene.gyroscopic_moment.moment_shares is qsbearing.MomentShares.HARRIS
            inner_share = np.where(control == "inner", 0.5 if halves else 1.0, 0.0)
            inner_friction = equilibrium.friction(inner, moment, inner_share, drawing, outward=False)
            outer_friction = equilibrium.friction(outer, moment, 1.0 - inner_share, drawing, outward=True)
            for race, contacts, force in (("inner", inner, inner_friction), ("outer", outer, outer_friction)):
                asked = np.hypot(*force.T)[both] / contacts.load[both]
                reported = np.asarray(getattr(solution, race).required_friction)[both]
                found = difference(reported, asked, 1.0)
                yield row(f"required friction, {race}", found, "friction force over normal load")

    left = equilibrium.on_ball(inner, outer, inner_friction + outer_friction, centrifugal)
    forces = float(max(inner.load.max(), outer.load.max()))
    yield row("force left on a ball, over the largest load", difference(left, 0.0, forces), "Newton's second law")
    carried = equilibrium.on_ring(drawing, inner, inner_friction, azimuth, lever)
    size = forces * np.array([1.0, 1.0, 1.0, lever, lever]) * len(azimuth)
    reported = np.asarray(solution.load)
    yield row("ring's load, over that of the balls", difference(reported / size, carried / size, 1.0), "equilibrium")
    asked = np.array([_prescribed_load(scene, channel) for channel in range(5)])
    free = np.isfinite(asked)
    found = difference((asked / size)[free], (carried / size)[free], 1.0)
    yield row("load asked for, over that of the balls", found, "the scene's operation")


def _prescribed_load(scene: qsbearing.Scene, channel: int) -> float:
    """The load that a scene asks for in a channel; NaN where it prescribes the displacement."""
    loads = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
    displacements = ("axial_displacement", "radial_displacement_y", "radial_displacement_z", "tilt_y", "tilt_z")
    if getattr(scene.operation, displacements[channel]) is not None:
        return float("nan")
    return float(np.asarray(getattr(scene.operation, loads[channel]) or 0.0))


def bearing_rows(
    name: str, drawing: Drawing, points: tuple[Solved, ...], level: Level, progress: Progress
) -> tuple[list[Row], MeshStudy | None]:
    """Every row of one bearing."""
    rows: list[Row] = []
    study = None
    stands_for = f"{len(points)} operating points" if len(points) > 1 else points[0].label
    for race in RACES:
        contacts = loaded_contacts(drawing, race, points)
        if not contacts:
            continue
        loads = tuple(sorted({contact.problem.load for contact in contacts}))
        case = f"{name} {race}: {stands_for}, {groove_contacts.span(loads)}"
        extremes = [min(contacts, key=_slenderness)]
        if max(map(_slenderness, contacts)) > _slenderness(extremes[0]):
            extremes.append(max(contacts, key=_slenderness))
        rows += collapsed(closed_form_rows(contacts, extremes), f"{case}; closed form")
        elements: list[Row] = []
        for extreme in extremes:
            study = half_space_contact.mesh_study(extreme.problem, level, progress)
            elements += element_rows(contacts, study, level)
        rows += collapsed(elements, f"{case}; finite elements")
    mechanics = [row for point in points for row in mechanics_rows(drawing, point)]
    return rows + collapsed(mechanics, f"{name}: {stands_for}"), study


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """The scene's bearing; the example's also with ceramic balls, which tells the two materials apart."""
    points = solved(scene)
    drawing = drawing_of(points[0].solution.scene, scene)
    rows, study = bearing_rows(drawing.name, drawing, points, level, progress)
    if scene == EXAMPLE:
        hybrid = dataclasses.replace(load_scene(scene).bearing, ball_material=qsbearing.SILICON_NITRIDE)
        points = tuple(
            Solved(label, solve(scene, label, dataclasses.replace(each, bearing=hybrid)))
            for label, each in operating_points(scene).items()
        )
        drawing = drawing_of(points[0].solution.scene, scene)
        more, study = bearing_rows(f"{drawing.name}, ceramic balls", drawing, points, level, progress)
        rows += more
    if study is None:
        return Findings(rows)
    return Findings(rows, groove_contacts.mesh_entry(study), study.bodies.race.solver)


CHECK = Check(
    name="solution_contacts",
    question="Is what qsbearing.solve reports right: contacts, the balls' motion, the equilibrium of balls and ring?",
    kind=Kind.VERIFICATION,
    reference="closed forms and mechanics from the drawing's dimensions, without code of qsbearing; finite elements",
    tolerance="closed forms 1e-8 (shear 1e-7, its depth 1e-4); finite elements: quick 0.3 %, release 0.02 to 0.05 %",
    run=run,
    largest_dofs=groove_contacts.largest_dofs,
)
