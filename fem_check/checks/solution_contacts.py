"""Is what `qsbearing` solves right: every contact, the balls' motion and forces, the equilibrium and its stiffness?

Judged from what is given alone (`drawing`, `references`, `quasi_static`: no code of qsbearing), and by finite elements.
Contacts of one shape are similar at every load, so one finite-element contact stands for all balls and operating
points; where each contact has a shape of its own (`hertz_angle = "actual"`), the most and the least slender. At the
quick level one raceway is enough: what finite elements make of other shapes and materials, `half_space_contacts` tells.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from operator import attrgetter
from typing import Any

import numpy as np

import qsbearing
from fem_check.checks import product_scenes
from fem_check.independent import catalogue_sources, references
from fem_check.independent.contact_problem import QUANTITIES, ContactProblem
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.equilibrium import own_angle
from fem_check.independent.groove import RACES
from fem_check.mechanics import half_space_contact
from fem_check.mechanics.half_space_contact import TOLERANCES, WHY, MeshStudy
from fem_check.product import problems
from fem_check.product.scenes import (
    ROW,
    SolvedPoint,
    drawing_at_rest,
    drawing_of,
    load,
    load_scene,
    operating_points,
    solve,
    solve_set,
    solved,
)
from fem_check.product.solution_equilibrium import compared_arrays, equilibrium_rows
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress, collapsed
from fem_check.rows.row_text import span

CLOSED_FORM_TOLERANCE = 1e-12
"""Of Hertz's formulas: some hundred times rounding."""
SHEAR_TOLERANCES = {"max_shear_stress": 1e-10, "max_shear_depth": 1e-6}
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
    form: str
    """Of Hertz's ellipse: exact, or a published fit."""
    reported: dict[str, float]


def loaded_contacts(race: str, points: Sequence[SolvedPoint], name: str) -> list[Loaded]:
    """Every loaded contact of a race, at all operating points."""
    loaded = []
    for point in points:
        scene, contacts = point.solution.scene, getattr(point.solution, race)
        balls = problems.row_of(scene, name).balls
        for ball in np.flatnonzero(contacts.load > 0.0):
            angle = own_angle(str(scene.hertz_angle), float(contacts.angle[ball]))
            load = float(contacts.load[ball])
            reported = {name: float(getattr(contacts, name)[ball]) for name in OF_SOLUTION}
            problem = balls[ball].groove(race, angle).problem(load)
            form = str(scene.hertz_form)
            loaded.append(Loaded(f"{point.label}, {race}, ball {ball}, Q = {load:.4g} N", problem, form, reported))
    return loaded


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


def closed_form_rows(contacts: list[Loaded], extremes: list[Loaded]) -> Iterator[AgreementRow]:
    """Every contact against Hertz from the drawing; its shear for the contacts of the extreme shapes."""
    for contact in contacts:
        exact = references.ellipse(contact.problem, contact.form)
        shear = contact.form == "exact" and any(contact is extreme for extreme in extremes)
        if shear:
            exact = references.hertz(contact.problem)
        for name, value in (with_shear(contact) if shear else contact.reported).items():
            yield AgreementRow(
                contact.label,
                name,
                QUANTITIES[name],
                getattr(exact, name),
                f"from the drawing: {references.SHEAR_SOURCE if name in SHEAR_TOLERANCES else references.HERTZ_SOURCE}",
                value,
                None,
                100.0 * SHEAR_TOLERANCES.get(name, CLOSED_FORM_TOLERANCE),
                "two derivations at full precision, some digits lost in root finding; the shear is integrated, and its "
                "depth known to the square root of its precision",
            )


def element_rows(contacts: list[Loaded], study: MeshStudy, level: MeshLevel) -> Iterator[AgreementRow]:
    """Every contact of the study's shape against the finite elements, each value at its load's power."""
    for contact in contacts:
        if not np.isclose(_slenderness(contact), _ratio(study.problem), rtol=1e-12, atol=0.0):
            continue
        size = contact.problem.load / study.problem.load
        for name, value in with_shear(contact).items():
            reference = study.value(name) * size ** POWERS[name]
            yield AgreementRow(
                contact.label,
                name,
                QUANTITIES[name],
                reference,
                "finite elements, finest mesh",
                value,
                100.0 * study.uncertainty(name) / study.value(name),
                TOLERANCES[level][name],
                WHY[level],
            )


def _ratio(problem: ContactProblem) -> float:
    return problem.curvature_x / problem.curvature_y


def _slenderness(contact: Loaded) -> float:
    return _ratio(contact.problem)


def mechanics_rows(points: tuple[SolvedPoint, ...], name: str) -> Iterator[AgreementRow]:
    """Every number of the solutions against the reference's own equilibria."""
    for point in points:
        solution = point.solution
        make = partial(problems.of_scene, solution.scene, name)
        yield from equilibrium_rows(point.label, make, [solution], solution, solution.displacement)


def set_rows(label: str, solution: qsbearing.SetSolution, name: str) -> Iterator[AgreementRow]:
    """Every number of a set's solution against the reference's own equilibrium."""
    slide = [] if solution.slide is None else [solution.slide]
    moved = np.concatenate([solution.displacement, slide])
    yield from equilibrium_rows(label, partial(problems.of_set, solution.set, name), solution.rows, solution, moved)


def contact_rows(
    case: str,
    points: Sequence[SolvedPoint],
    name: str,
    level: MeshLevel,
    progress: Progress,
    by_elements: Sequence[str] = RACES,
) -> tuple[list[AgreementRow], MeshStudy | None]:
    """Every contact of one bearing's solutions by closed form, those of the extreme shapes by finite elements too.

    Args:
        by_elements: raceways that finite elements judge.
    """
    rows: list[AgreementRow] = []
    study = None
    for race in RACES:
        contacts = loaded_contacts(race, points, name)
        if not contacts:
            continue
        loads = tuple(sorted({contact.problem.load for contact in contacts}))
        of_race = f"{case} {race}: {stands_for(points)}, {span(loads)}"
        extremes = [min(contacts, key=_slenderness)]
        if max(map(_slenderness, contacts)) > _slenderness(extremes[0]):
            extremes.append(max(contacts, key=_slenderness))
        rows += collapsed(closed_form_rows(contacts, extremes), f"{of_race}; closed form")
        if contacts[0].form != "exact" or race not in by_elements:
            continue
        of_shape: list[AgreementRow] = []
        for extreme in extremes:
            study = half_space_contact.mesh_study(extreme.problem, half_space_contact.SEQUENCES[level], progress)
            of_shape += element_rows(contacts, study, level)
        rows += collapsed(of_shape, f"{of_race}; finite elements")
    return rows, study


def stands_for(points: Sequence[SolvedPoint]) -> str:
    """What rows of several operating points are called."""
    if len(points) == 1:
        return str(points[0].label)
    return f"{len(points)} {'rows' if points[0].label.startswith(ROW) else 'operating points'}"


def clearance_rows(drawing: BearingDrawing) -> Iterator[AgreementRow]:
    """The free contact angle that qsbearing makes of the drawing's clearance, and the clearance that it tells."""
    lengths = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")
    clearance = drawing.diametral_clearance
    bearing = qsbearing.BallBearing.from_diametral_clearance(
        ball_count=8, diametral_clearance=clearance, **{name: getattr(drawing, name) for name in lengths}
    )
    for quantity, unit, computed, expected in (
        ("free contact angle of a clearance", "rad", bearing.free_contact_angle, drawing.free_contact_angle),
        ("diametral clearance of a free contact angle", "m", bearing.diametral_clearance, clearance),
    ):
        yield compared_arrays(drawing.name, quantity, unit, np.asarray(computed), np.asarray(expected))


def catalogue_rows() -> Iterator[AgreementRow]:
    """The catalogue's dimensions and materials against their sources, typed again."""
    why = "half a unit of the last digit printed; the same number typed twice: rounding"
    for name, printed in catalogue_sources.BEARINGS.items():
        bearing = qsbearing.load_scene(name).bearing
        for field, expected in printed.items():
            value = float(attrgetter(field)(bearing)) / (qsbearing.deg if field == "free_contact_angle" else 1.0)
            kind = field.rpartition(".")[2]
            yield AgreementRow(
                name,
                field.replace("_material.", "'s "),
                catalogue_sources.UNITS[kind],
                expected,
                catalogue_sources.__doc__.splitlines()[0],
                value,
                None,
                100.0 * catalogue_sources.PRINTED[kind],
                why,
            )
    for material in (qsbearing.STEEL, qsbearing.SILICON_NITRIDE):
        expected = catalogue_sources.EXPANSION[material.name]
        yield AgreementRow(
            material.name,
            "thermal_expansion",
            "1/K",
            expected,
            "handbooks; GMN catalogue 4000 0813 EN",
            float(np.asarray(material.thermal_expansion)),
            None,
            100.0 * catalogue_sources.PRINTED["thermal_expansion"],
            why,
        )


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """The scene's bearing or set. The example's also with ceramic balls, which tells the two materials apart, and under
    everything else that `solve` offers."""
    of, points = load(scene), solved(scene)
    name = drawing_of(points[0].solution.scene, scene).name
    rows: list[AgreementRow] = []
    study = None
    usual = scene == EXAMPLE and level is MeshLevel.QUICK
    for alike in of_one_bearing(points):
        bearing = drawing_of(alike[0].solution.scene, scene).name
        more, study = contact_rows(bearing, alike, scene, level, progress, RACES[:1] if usual else RACES)
        rows += more
    if isinstance(of, qsbearing.BearingSet):
        rows += collapsed(set_rows("the set", solve_set(scene, of), scene), f"{name}: {len(points)} rows on one shaft")
    else:
        rows += collapsed(mechanics_rows(points, scene), f"{name}: {stands_for(points)}")
    rows += collapsed(clearance_rows(drawing_at_rest(points[0].solution.scene, scene)), name)
    rows += collapsed(catalogue_rows(), "the catalogue and its sources")
    if scene == EXAMPLE:
        hybrid = dataclasses.replace(load_scene(scene).bearing, ball_material=qsbearing.SILICON_NITRIDE)
        points = tuple(
            SolvedPoint(label, solve(scene, label, dataclasses.replace(each, bearing=hybrid)))
            for label, each in operating_points(scene).items()
        )
        more, _ = contact_rows(f"{name}, ceramic balls", points, scene, level, progress, () if usual else RACES)
        rows += more + collapsed(mechanics_rows(points, scene), f"{name}, ceramic balls: {stands_for(points)}")
        rows += collapsed(product_rows(progress), f"{name} and other scenes for solve: {product_scenes.COUNT}")
    if study is None:
        return Findings(rows)
    return Findings(rows, half_space_contact.mesh_entry(study.bodies), study.bodies.race.solver)


def of_one_bearing(points: Sequence[SolvedPoint]) -> list[list[SolvedPoint]]:
    """The points, those of one bearing together: contacts of one shape are similar where their materials are alike."""
    groups: list[list[SolvedPoint]] = []
    for point in points:
        for group in groups:
            if group[0].solution.scene.bearing == point.solution.scene.bearing:
                group.append(point)
                break
        else:
            groups.append([point])
    return groups


def product_rows(progress: Progress) -> Iterator[AgreementRow]:
    """Everything that `solve` offers, each by the scene or set that has it; contacts by their closed form."""
    for label, each in product_scenes.scenes().items():
        progress(label, 0.0)
        points = (SolvedPoint(label, solve("of the check", label, each)),)
        for race in RACES:
            yield from closed_form_rows(loaded_contacts(race, points, label), [])
        yield from mechanics_rows(points, label)
        yield from clearance_rows(drawing_at_rest(each, label))
    for label, of in product_scenes.sets().items():
        progress(label, 0.0)
        yield from set_rows(label, solve_set(label, of), label)


CHECK = Check(
    name="solution_contacts",
    question="Are the contacts, motion, equilibrium and stiffness found by qsbearing right, with every effect "
    "and in sets?",
    kind=CheckKind.VERIFICATION,
    reference="closed forms and a separate equilibrium from the drawing, with no code of qsbearing; finite elements",
    tolerance="closed forms 1e-12 (shear 1e-10, its depth 1e-6), equilibrium 1e-9 (stiffness 1e-6); catalogue 0.02 %; "
    "finite elements: quick 0.13 to 0.3 %, release 0.01 to 0.05 %",
    run=run,
    largest_dofs=half_space_contact.largest_dofs,
)
