"""Do finite elements give Hertz's contact, whatever its shape, between like and unlike bodies?

Half-spaces, for which Hertz is exact. Contacts of one shape are similar at every load, so each shape is solved at one:
the circle, an ellipse more slender than any bearing's, and the scene's own contacts; at the quick level, where
`solution_contacts` judges the example's inner contact too, one of the two ellipses.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi

from fem_check.independent import references
from fem_check.independent.contact_problem import ContactProblem, ElasticConstants
from fem_check.independent.groove import RACES
from fem_check.mechanics import half_space_contact
from fem_check.mechanics.half_space_contact import SEQUENCES, MeshStudy
from fem_check.mechanics.pictures import contact_pictures
from fem_check.product.scenes import SceneProblemError, groove_contact, operating_loads
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress, collapsed
from fem_check.rows.row_text import span

STEEL = ElasticConstants(elastic_modulus=208e9, poisson_ratio=0.3)
CERAMIC = ElasticConstants(elastic_modulus=310e9, poisson_ratio=0.26)
RADIUS = 10e-3
"""Of the ball on a plane, and along the short axis of the slender ellipse [m]."""
SLENDER = 20.0
TEXTBOOK_SHEAR = "Johnson 1985, section 3.4: 0.31 p0 at 0.48 a (nu = 0.3)"
JOHNSON = "Johnson 1985, eqs 4.22 to 4.24: a = (3QR/4E*)^(1/3), delta = a²/R, p0 = 3Q/(2 pi a²)"


@dataclass(frozen=True)
class HalfSpaceContact:
    """One contact to be solved."""

    case: str
    problem: ContactProblem
    is_circle: bool = False
    """A ball on a plane, of which the textbook tells more."""


def ellipse_of(ellipticity: float, load: float = 1000.0) -> ContactProblem:
    """A contact of steel with a/b as given."""
    ratio = references.curvature_ratio(1.0 / ellipticity)
    return ContactProblem(f"k = {ellipticity:g}", ratio / RADIUS, 1.0 / RADIUS, STEEL, STEEL, load)


def circle(load: float = 100.0) -> HalfSpaceContact:
    """A ceramic ball on a steel plane."""
    name = f"silicon nitride ball, R = 10 mm, on a steel plane, Q = {load:.0f} N"
    return HalfSpaceContact(
        name, ContactProblem("circle", 1.0 / RADIUS, 1.0 / RADIUS, CERAMIC, STEEL, load), is_circle=True
    )


def of_scene(level: MeshLevel, scene: str) -> list[HalfSpaceContact]:
    """The inner contact as it is; at the release level also the outer one, with a ceramic ball.

    Raises:
        SceneProblemError: no contact carries load.
    """
    contacts = []
    for race in RACES if level is MeshLevel.RELEASE else RACES[:1]:
        loads, groove = operating_loads(scene, race), groove_contact(scene, race)
        if not loads:
            raise SceneProblemError(f"scene {scene}: no contact of the {race} raceway carries load")
        ball = ""
        if race == "outer":
            groove, ball = replace(groove, ball=CERAMIC), ", silicon nitride ball"
        contacts.append(HalfSpaceContact(f"{groove.name} {race}{ball}: {span(loads)}", groove.problem(loads[-1])))
    return contacts


def contacts(level: MeshLevel, scene: str) -> list[HalfSpaceContact]:
    """All of a level; the last is drawn: where it is solved, the scene's inner contact."""
    slender = HalfSpaceContact(f"a/b = {SLENDER:g}, steel, Q = 1000 N", ellipse_of(SLENDER))
    if level is MeshLevel.QUICK:
        return [circle(), slender] if scene == EXAMPLE else [circle(), *of_scene(level, scene)]
    return [circle(), slender, *reversed(of_scene(level, scene))]


def circle_rows(of: HalfSpaceContact, study: MeshStudy, rows: list[AgreementRow]) -> list[AgreementRow]:
    """A circle's rows, against the textbook's formulas where it has one."""
    problem = of.problem
    modulus = 1.0 / (problem.ball.compliance + problem.race.compliance)
    a = (0.75 * problem.load * RADIUS / modulus) ** (1.0 / 3.0)
    p0 = 1.5 * problem.load / (pi * a * a)
    textbook = {"approach": a * a / RADIUS, "semi_major_axis": a, "semi_minor_axis": a, "max_pressure": p0}
    rows = [
        replace(row, reference=textbook[row.quantity], reference_source=JOHNSON) if row.quantity in textbook else row
        for row in rows
    ]
    # Textbooks print the largest shear as 0.31 p0 at 0.48 a for nu = 0.3, to two digits: half a unit of the last.
    for name, ratio, scale in (("max_shear_stress", 0.31, p0), ("max_shear_depth", 0.48, a)):
        rows.append(
            AgreementRow(
                f"{of.case}, over p0 and a", name, "1", ratio, TEXTBOOK_SHEAR,
                study.value(name) / scale, 100.0 * study.uncertainty(name) / (scale * ratio), 100.0 * 0.005 / ratio,
                "half a unit of the printed last digit",
            )
        )  # fmt: skip
    return rows


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Every shape."""
    rows: list[AgreementRow] = []
    sound: list[AgreementRow] = []
    for of in contacts(level, scene):
        study = half_space_contact.mesh_study(of.problem, SEQUENCES[level], progress)
        more = half_space_contact.rows(of.case, study, level, references.HERTZ_SOURCE)
        rows += circle_rows(of, study, more) if of.is_circle else more
        sound += half_space_contact.soundness_rows(of.case, [*study.sequence, *study.stretched])
    rows += collapsed(sound, f"{len(sound) // 2} contacts, all meshes")
    pictures = contact_pictures(study.solution, study.bodies, "the heaviest load")
    return Findings(rows, half_space_contact.mesh_entry(study.bodies), study.bodies.race.solver, pictures)


CHECK = Check(
    name="half_space_contacts",
    question="Do finite elements of half-spaces give Hertz's contact for every shape, of like and unlike bodies?",
    kind=CheckKind.VERIFICATION,
    reference="Hertz in closed form, exact for this idealised problem; Johnson 1985 for the circle",
    tolerance="quick 0.13 % approach, 0.3 % semi-axes, pressure and shear; release 0.02 % and 0.05 %",
    run=run,
    largest_dofs=half_space_contact.largest_dofs,
)
