"""A bearing's heaviest contacts: Hertz, finite elements of half-spaces, finite elements of the true bodies.

On half-spaces Hertz is exact, so that column verifies what `qsbearing.solve` reports; the true bodies tell how far the
idealisation is from this ball and this groove, which is a finding. Load and angle are equilibrium's: of balls and rings
found from the drawing alone (`quasi_static`), each contact with the approach that the elements give it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees

import numpy as np

import qsbearing
from fem_check.checks import solution_contacts
from fem_check.independent import references
from fem_check.independent.contact_problem import QUANTITIES, ContactProblem
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.equilibrium import own_angle
from fem_check.independent.groove import RACES
from fem_check.independent.quasi_static import NoReferenceError
from fem_check.independent.ring_sections import RingProfile
from fem_check.mechanics import half_space_contact
from fem_check.mechanics.contact import ContactError
from fem_check.mechanics.half_space_contact import TOLERANCES, WHY, MeshStudy
from fem_check.meshing import MeshError
from fem_check.product import problems
from fem_check.product.scenes import (
    SolvedPoint,
    ball_count,
    beyond_thrust,
    drawing_at_rest,
    load,
    ring_sections,
    solve,
    solve_set,
    solved,
)
from fem_check.product.solution_equilibrium import reference_near
from fem_check.rows import convergence
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress
from fem_check.rows.record import NO_MESH, MeshRecord
from fem_check.solids.mesh_room import room, with_room
from fem_check.solids.true_contact import READ, CondensedContact, TrueContact
from fem_check.solids.true_study import ring_doubt

ELEMENTS = {MeshLevel.QUICK: (3, 4, 5), MeshLevel.RELEASE: (4, 6, 8)}
"""Of true bodies, per semi-axis."""
HALF_SPACES, TRUE_BODIES = "half-spaces", "true bodies"
HERTZ = "qsbearing.solve"
ANGLE_TOLERANCE = 0.02
"""[degrees]: as the largest uncertainty allowed to the angles of the sector."""
FINDING = "a finding: sphere, groove and elastic bodies as they are, against half-spaces and a parabola"
Refused = str
"""Why something was not solved, in a sentence."""


@dataclass(frozen=True)
class Heaviest:
    """The contact of a raceway that carries most."""

    point: SolvedPoint
    source: str
    race: str
    ball: int

    @property
    def solution(self) -> qsbearing.Solution:
        """Of the whole bearing."""
        return self.point.solution

    @cached_property
    def drawing(self) -> BearingDrawing:
        """With the ball's own diameter, as the rings have grown."""
        return problems.row_of(self.solution.scene, self.source).balls[self.ball]

    def reported(self, name: str) -> float:
        """What the solution says of the contact; SI."""
        return float(getattr(getattr(self.solution, self.race), name)[self.ball])

    @cached_property
    def problem(self) -> ContactProblem:
        """As the solution's Hertz has it: at the angle that the scene asks for."""
        angle = own_angle(str(self.solution.scene.hertz_angle), self.reported("angle"))
        return self.drawing.groove(self.race, angle).problem(self.reported("load"))

    @property
    def is_exact(self) -> bool:
        """Whether Hertz's ellipse is not one of the published fits."""
        return str(self.solution.scene.hertz_form) == "exact"

    @property
    def case(self) -> str:
        """Name, raceway, ball, load and angle."""
        where = "" if self.point.label == "own operation" else f" {self.point.label},"
        angle = degrees(self.reported("angle"))
        return (
            f"{self.drawing.name} {self.race}:{where} ball {self.ball + 1}, Q = {self.reported('load'):.4g} N at "
            f"{angle:.2f}°"
        )


def operated(source: str) -> tuple[SolvedPoint, ...]:
    """A scene as it is operated; a set row by row."""
    of = load(source)
    if isinstance(of, qsbearing.BearingSet) or source != EXAMPLE:
        return solved(source)
    return (SolvedPoint("own operation", solve(source, "own operation", of)),)


def heaviest(points: Sequence[SolvedPoint], source: str, race: str) -> Heaviest | None:
    """Of one bearing at its points; None where nothing presses the raceway."""
    loads = [np.asarray(getattr(point.solution, race).load) for point in points]
    most = int(np.argmax([each.max() for each in loads]))
    ball = int(np.argmax(loads[most]))
    return Heaviest(points[most], source, race, ball) if loads[most][ball] > 0.0 else None


@dataclass(frozen=True)
class TrueBodyRatios:
    """Quantities over Hertz's, by name, each with its uncertainty."""

    values: dict[str, tuple[float, float]]
    mesh: MeshRecord
    solver: str


def true_bodies(contact: Heaviest, elements: Sequence[int], progress: Progress) -> TrueBodyRatios | Refused:
    """The contact of the true bodies over Hertz at its own angle, on a sequence of meshes; or why there is none."""
    angle, pressed = round(contact.reported("angle"), 6), float(f"{contact.reported('load'):.5g}")
    groove = contact.drawing.groove(contact.race, angle)
    balls = ball_count(contact.solution.scene)

    def solved(mesh_load: float) -> tuple[CondensedContact, list[list[dict[str, float]]]]:
        profile = profile_of(contact, mesh_load)
        pairs = []
        for number, count in enumerate(elements):
            progress(f"{contact.race}, true bodies, {count} elements per semi-axis", number / len(elements))
            condensed = TrueContact(groove, balls, mesh_load, count, profile).condensed()
            pairs.append([condensed.over_hertz(pressed, follows_surface=True, parabola=each) for each in (False, True)])
        return condensed, pairs

    try:
        condensed, pairs = with_room(solved, pressed)
    except (MeshError, ContactError, np.linalg.LinAlgError) as problem:
        return str(problem)
    values = {}
    assumed = ring_doubt(contact.solution.scene, contact.source, groove, pressed)
    for name in READ:
        # The bodies' size moves the approach alone; of the ellipse the ratio to a parabola keeps the mesh's error out.
        ratios = [true[name] / (1.0 if name == "approach" else parabola[name]) for true, parabola in pairs]
        values[name] = ratios[-1], convergence.largest_change(ratios) + (assumed if name == "approach" else 0.0)
    mesh: MeshRecord = {"elements_per_semi_axis": elements[-1], "dofs": condensed.dofs, "file": "true_ball, true_ring"}
    return TrueBodyRatios(values, mesh, condensed.solver)


def profile_of(contact: Heaviest, load: float | None = None) -> RingProfile:
    """The section of a contact's ring, with room for the contact at a load [N]; None: at its own."""
    scene, source = contact.solution.scene, contact.source
    groove = contact.drawing.groove(contact.race, contact.reported("angle"))
    needs = room(groove, contact.reported("load") if load is None else load)
    return ring_sections(scene, source).profile(drawing_at_rest(scene, source), contact.race, needs)


def half_space_rows(contact: Heaviest, study: MeshStudy, level: MeshLevel) -> list[AgreementRow]:
    """What the solution reports of a contact against the elements."""
    why = WHY[level] if contact.is_exact else "a finding: the scene asks for a published fit of Hertz's ellipse"
    return [
        AgreementRow(
            f"{contact.case}; {HALF_SPACES}",
            name,
            QUANTITIES[name],
            contact.reported(name),
            HERTZ,
            study.value(name),
            100.0 * study.uncertainty(name) / abs(contact.reported(name)),
            TOLERANCES[level][name] if contact.is_exact else None,
            why,
        )
        for name in READ
    ]


def true_rows(contact: Heaviest, over_hertz: TrueBodyRatios | Refused) -> list[AgreementRow]:
    """What the solution reports against the true bodies."""
    exact = references.ellipse(
        contact.drawing.groove(contact.race, contact.reported("angle")).problem(contact.reported("load"))
    )
    rows = []
    for name in READ:
        reference, case = contact.reported(name), f"{contact.case}; {TRUE_BODIES}"
        if isinstance(over_hertz, Refused):
            rows.append(AgreementRow(case, name, QUANTITIES[name], reference, HERTZ, None, None, None, over_hertz))
            continue
        scale = getattr(exact, name)
        value, uncertainty = (scale * each for each in over_hertz.values[name])
        rows.append(
            AgreementRow(
                case, name, QUANTITIES[name], reference, HERTZ, value, 100.0 * uncertainty / reference, None, FINDING
            )
        )
    return rows


Ratios = dict[str, tuple[float, float]]
"""Of each raceway: approach over Hertz's, and its uncertainty."""


def equilibrium_rows(
    contacts: dict[str, Heaviest], method: str, approaches: Ratios | Refused, level: MeshLevel
) -> dict[str, list[AgreementRow]]:
    """Load and angle of each contact where all contacts have these approaches."""
    rows: dict[str, list[AgreementRow]] = {race: [] for race in contacts}
    by_race: dict[str, list[tuple[float, float]]] = {}
    reason = approaches if isinstance(approaches, Refused) else ""
    if not isinstance(approaches, Refused):
        try:
            by_race = _loads_and_angles(contacts, approaches)
        except (NoReferenceError, np.linalg.LinAlgError) as problem:
            reason = f"no equilibrium with these approaches: {problem}"
    judged = method == HALF_SPACES and all(each.is_exact for each in contacts.values())
    why = "set beforehand: as the approaches; angles 0.02 degrees" if judged else FINDING
    for race, contact in contacts.items():
        case = f"{contact.case}; {method}"
        for number, (name, unit) in enumerate((("load", "N"), ("angle", "deg"))):
            reported = contact.reported(name)
            reference = round(degrees(reported), 9) if name == "angle" else reported
            if reason:
                rows[race].append(AgreementRow(case, name, unit, reference, HERTZ, None, None, None, reason))
                continue
            values = [each[number] for each in by_race[race]]
            scale = abs(reference) or 1.0
            uncertainty = sum(abs(each - values[0]) for each in values[1:])
            tolerance = TOLERANCES[level]["approach"] if name == "load" else 100.0 * ANGLE_TOLERANCE / scale
            rows[race].append(
                AgreementRow(
                    case, name, unit, reference, HERTZ, values[0], 100.0 * uncertainty / scale,
                    tolerance if judged else None, why,
                )
            )  # fmt: skip
    return rows


def _loads_and_angles(contacts: dict[str, Heaviest], approaches: Ratios) -> dict[str, list[tuple[float, float]]]:
    """Load and angle [degrees] of each contact: at the approaches found, then with each raceway's off by its
    uncertainty."""
    by_race: dict[str, list[tuple[float, float]]] = {race: [] for race in contacts}
    source = next(iter(contacts.values())).source
    values = {race: approaches.get(race, (1.0, 0.0)) for race in RACES}
    whole = load(source)
    of = solve_set(source, whole) if isinstance(whole, qsbearing.BearingSet) else None
    for moved in (None, *(race for race, (_, doubt) in values.items() if doubt)):
        inner, outer = (value + (doubt if race == moved else 0.0) for race, (value, doubt) in values.items())
        first = next(iter(contacts.values())).solution
        if of is None:
            rows, problem, moved_by = [first], problems.of_scene(first.scene, source), first.displacement
        else:
            rows, problem = list(of.rows), problems.of_set(of.set, source)
            moved_by = np.concatenate([of.displacement, [] if of.slide is None else [of.slide]])
        placed = tuple(
            replace(each, row=replace(each.row, over_hertz=(inner, outer)))
            if solution.scene.bearing == first.scene.bearing
            else each
            for each, solution in zip(problem.rows, rows, strict=True)
        )
        states = reference_near(replace(problem, rows=placed), rows, moved_by).states
        for race, contact in contacts.items():
            number = 0 if of is None else _row_number(contact)
            state = states[number]
            load_, normal = (state.q_i, state.inner) if race == "inner" else (state.q_o, state.outer)
            angle = float(np.degrees(np.arctan2(*normal[contact.ball])))
            by_race[race].append((float(load_[contact.ball]), angle))
    return by_race


def _row_number(contact: Heaviest) -> int:
    return int(contact.point.label.rpartition(" ")[2]) - 1


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Both contacts of each bearing."""
    rows: list[AgreementRow] = []
    notes: list[str] = []
    mesh = NO_MESH.copy()
    solver = ""
    points = operated(scene)
    for point in points:
        ring_sections(point.solution.scene, scene)  # refuses faults before the work
    for alike in solution_contacts.of_one_bearing(points):
        every = {race: heaviest(alike, scene, race) for race in RACES}
        contacts = {race: each for race, each in every.items() if each is not None}
        notes += [
            f"{alike[0].solution.scene.bearing.name or scene}: nothing presses the {race} raceway; it has no contact."
            for race in RACES
            if race not in contacts
        ]
        if not contacts:
            continue
        ideal: dict[str, MeshStudy] = {}
        true: dict[str, TrueBodyRatios | Refused] = {}
        for race, contact in contacts.items():
            progress(f"{race}, half-spaces", 0.0)
            ideal[race] = half_space_contact.mesh_study(contact.problem, half_space_contact.SEQUENCES[level], progress)
            true[race] = true_bodies(contact, ELEMENTS[level], progress)
        on_half_spaces = equilibrium_rows(contacts, HALF_SPACES, _of_half_spaces(contacts, ideal), level)
        of_true_bodies = equilibrium_rows(contacts, TRUE_BODIES, _of_true_bodies(contacts, true), level)
        for race, contact in contacts.items():
            rows += half_space_rows(contact, ideal[race], level) + on_half_spaces[race]
            rows += true_rows(contact, true[race]) + of_true_bodies[race]
            last = true[race]
            mesh = half_space_contact.mesh_entry(ideal[race].bodies) if isinstance(last, Refused) else last.mesh
            solver = ideal[race].bodies.race.solver
        notes += _notes(contacts)
    return Findings(rows, mesh, solver, notes=notes)


def _of_half_spaces(contacts: dict[str, Heaviest], ideal: dict[str, MeshStudy]) -> Ratios:
    exact = {race: references.ellipse(contact.problem).approach for race, contact in contacts.items()}
    return {
        race: (study.value("approach") / exact[race], study.uncertainty("approach") / exact[race])
        for race, study in ideal.items()
    }


def _of_true_bodies(contacts: dict[str, Heaviest], true: dict[str, TrueBodyRatios | Refused]) -> Ratios | Refused:
    """Over what the equilibrium takes for Hertz's approach: at its angle, of its form."""
    ratios: Ratios = {}
    for race, each in true.items():
        if isinstance(each, Refused):
            return f"needs the {race} contact's approach, which was refused"
        contact = contacts[race]
        at_own = references.ellipse(contact.drawing.groove(race, contact.reported("angle")).problem(1.0)).approach
        at_hertz_angle = references.ellipse(contact.problem, str(contact.solution.scene.hertz_form)).approach
        scale = at_own * contact.reported("load") ** (2.0 / 3.0) / at_hertz_angle
        value, uncertainty = each.values["approach"]
        ratios[race] = scale * value, scale * uncertainty
    return ratios


def _notes(contacts: dict[str, Heaviest]) -> list[str]:
    first = next(iter(contacts.values()))
    scene, source = first.solution.scene, first.source
    drawing = drawing_at_rest(scene, source)
    profiles = {race: profile_of(contact) for race, contact in contacts.items()}
    left_out = [
        effect
        for effect, there in (
            ("friction of the gyroscopic moment", scene.gyroscopic_moment is not None),
            ("the rings' growth by rotation, fits and heat beyond the grooves' own", bool(scene.ring_effects)),
        )
        if there
    ]
    notes = [ring_sections(scene, source).told(drawing, profiles)]
    notes.append(
        "True bodies: half a ball, held at its equator, and one ball pitch of the ring, its seat rigid; each contact "
        "alone under its own load. Left out: neighbours that carry less"
        + "".join(f"; {each}" for each in left_out)
        + ". Their load and angle are those of the equilibrium in which all contacts have these approaches."
    )
    beside = beyond_thrust(first.solution)
    if beside:
        notes.append(
            "One ball between both rings (fem-check run bearing_sector) knows thrust and the inner ring's speed alone; "
            f"it leaves out: {', '.join(beside)}."
        )
    return notes


CHECK = Check(
    name="bearing_contacts",
    question="Your bearing: is Hertz solved right for its heaviest contacts, and how far are the true bodies from it?",
    kind=CheckKind.VERIFICATION,
    reference="finite elements of half-spaces; an equilibrium from the drawing alone; true bodies for comparison",
    tolerance="half-spaces: quick 0.3 %, release 0.02 to 0.05 %; angle 0.02 degrees; true bodies: findings",
    run=run,
    largest_dofs=lambda level: max(
        half_space_contact.largest_dofs(level), {MeshLevel.QUICK: 45_000, MeshLevel.RELEASE: 110_000}[level]
    ),
)
