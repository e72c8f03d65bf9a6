"""Effects and choices: which are in, which are not, how much each matters here, and what the model assumes anyway."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from qsbearing.documents.model import Badge, Block, Bullets, Cell, Md, Paragraph, Section, Table
from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.accuracy import DEFAULT_ACCURACY
from qsbearing.model.effects import EFFECTS, QUANTITIES
from qsbearing.model.effects.ball_motion import MotionOfBalls
from qsbearing.model.effects.hertz_angle import HertzAngle
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.judgement import WORDS, unit_of
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.bearing import chosen
from qsbearing.remarks.wording import capital
from qsbearing.reports.evidence import of_rows
from qsbearing.studies.chooser.explain import DATA_MISSING, NEEDED, NOT_NEEDED, Assessment
from qsbearing.systems.sets.set_solution import SetSolution

STEADY = (
    "The motion is steady, and every ball is in equilibrium by itself: no cage force, no drag, no lubricant film under "
    "load."
)
OF_SETS = (
    "Shaft and housing are rigid: nothing bends, and the distances of the rows change only with the temperatures of "
    "shaft and housing in the input."
)
OF_SHAFTS = (
    "The shaft bends, shears and stretches as a Timoshenko beam of the sections in the input; housings are "
    "linear springs where the input has their stiffness. Bearing rings do not stiffen the shaft."
)
RIGID = "Ball loads deform the contacts only, not the rings or their seats: Hertz's ellipses in round grooves."
GROWN = "Rings change their size as round rings do, with the rotation, fits and heat that the input names."
NOT_GROWN = "Rings keep the size that they have at rest and cold: rotation, fits and heat do not change it."
EXACT = "The geometry is exact: {balls}, evenly spaced, {grooves}."
FREE_ANGLE = "Hertz's constants are those of the free contact angle, for every ball."
ROLLING = {
    RacewayControl.OUTER: "Every ball rolls without spin on the outer raceway (outer control, a hypothesis).",
    RacewayControl.INNER: "Every ball rolls without spin on the inner raceway (inner control, a hypothesis).",
    RacewayControl.PER_BALL: "Each ball rolls without spin on one raceway, by Jones's criterion (a hypothesis).",
    RacewayControl.FRICTION: "Friction in both contacts moves each ball, in balance with its loads and inertia.",
    RacewayControl.MINIMUM_DISSIPATION: "Each ball spins so that the friction power is least (a hypothesis).",
}
ALIKE = "All balls have the mean axis and orbital speed, as a cage without clearance imposes (a hypothesis)."
UNBOUNDED = (
    "Friction carries the whole gyroscopic moment; the friction coefficient that this requires is a result, in the "
    "table of inertia and motion."
)
NOT_MODELLED = "vibration, cage forces, oil drag on the balls, plastic deformation"
NEVER = f"Never in the model: {NOT_MODELLED}."
BOUNDED = "Contacts carry the gyroscopic moment up to the friction coefficient of the input; beyond it they slip."


def _of_shaft(solution: SetSolution) -> str:
    """What the set assumes of shaft and housing."""
    of = solution.set
    bends = of.shaft is not None and of.shaft.sections
    is_elastic = bends or any(row.housing_stiffness is not None for row in of.rows)
    return OF_SHAFTS if is_elastic else OF_SETS


def assumptions(scene: Scene) -> list[str]:
    """What the solution of this scene rests on, in sentences."""
    said = [STEADY, RIGID, NOT_GROWN if scene.ring_expansion is None else GROWN]
    alike = scene.ball_diameter_deviations is None
    balls = "all balls alike" if alike else "balls of the diameters in the input"
    is_round = scene.seats_out_of_round is None
    said.append(
        EXACT.format(balls=balls, grooves="grooves round and true" if is_round else "grooves with the given lobes")
    )
    if scene.hertz_angle is HertzAngle.FREE:
        said.append(FREE_ANGLE)
    if scene.raceway_control is not None:
        said.append(ROLLING[scene.raceway_control])
    if scene.ball_motion is MotionOfBalls.COMMON:
        said.append(ALIKE)
    if scene.gyroscopic_moment is not None:
        said.append(UNBOUNDED if scene.gyroscopic_moment.friction_coefficient is None else BOUNDED)
    return said


def section(solution: Solution, requested: Scene, rows: Sequence[Assessment], tolerance: float) -> Section:
    """Whether the model is right, assumptions, and a row for each effect and choice.

    Args:
        solution: of the scene with its effects.
        asked: the scene as it was given, which may leave the choice of effects to a tolerance.
        rows: of `explain`.
        tolerance: above which a change counts.
    """
    said = [] if solution.choice is None else chosen(solution, requested, IN_FILE)
    right = is_right(rows, tolerance, solution.friction is not None)
    return _section(right, assumptions(solution.scene), said, rows, tolerance)


def section_of_set(solution: SetSolution, rows: Sequence[Assessment]) -> Section:
    """Likewise of a set."""
    assumed = of_rows({number: assumptions(row.scene) for number, row in enumerate(solution.rows, 1)})
    said = [text if which is None else f"{capital(which)}: {text}" for text, which in assumed]
    right = is_right(rows, DEFAULT_ACCURACY)
    return _section(right, [_of_shaft(solution), *said], [], rows, DEFAULT_ACCURACY)


def _section(
    right: Sequence[Block], assumed: Sequence[str], said: Sequence[str], rows: Sequence[Assessment], tolerance: float
) -> Section:
    blocks: list[Block] = [*right, Paragraph("Assumptions of this solution:"), Bullets(assumed), *map(Paragraph, said)]
    words = (
        "How much each effect and choice of the model changes the results: found by solving with and without it; with "
        "≈ under usual parameters where its own are not known. It is needed if leaving it out changes a result by more "
        f"than {100 * tolerance:g} %, displacements in parts of the largest one."
    )
    headings = (
        "effect or choice",
        "in scene",
        *("\n".join([*WORDS[name].split(), unit_of(name)]) for name in QUANTITIES),
        "assessment",
    )
    lines = [_line(row) for row in rows]
    why = [Md(f"`{row.effect}`: {row.why}") for row in rows if row.why]
    blocks += [Paragraph(words), Table(headings, lines, "ll" + "r" * len(QUANTITIES) + "l", stack=True), Bullets(why)]
    return Section("Assumptions and effects", blocks, "effects")


def _lacking(
    rows: Sequence[Assessment], tolerance: float, is_by_friction: bool
) -> Iterator[tuple[Assessment, str, bool]]:
    """What the model leaves out, or has as a hypothesis, though it changes a result by more than the tolerance, the
    largest change first; the quantity that it changes most, and whether it is a hypothesis."""
    what = {entry.name: entry for entry in EFFECTS}
    for row in sorted(rows, key=lambda row: -row.size(row.largest) if row.largest else 0.0):
        most = row.largest or QUANTITIES[0]
        if row.in_scene and row.verdict == NEEDED:
            continue
        if row.verdict in (NEEDED, DATA_MISSING):
            yield row, most, False
        elif what[row.effect].hypothesis and row.size(most) > tolerance and not is_by_friction:
            yield row, most, True


def left_out(rows: Sequence[Assessment], tolerance: float, is_by_friction: bool = False) -> Section:
    """In short, for page 1: what the model leaves out, or has as a hypothesis, and how much each would change.

    Args:
        is_by_friction: whether friction moves the balls, so that no hypothesis is left open.
    """
    title = "What the model leaves out"
    lines: list[list[Cell]] = [
        [row.what, f"{row.change_in(most)} of the {WORDS[most]}"]
        for row, most, _ in _lacking(rows, tolerance, is_by_friction)
    ]
    more = Paragraph(Md(f"{NEVER} [Every effect, and what to do](#effects)."), is_small=True)
    if not lines:
        said = f"Nothing that it lacks changes a result by more than {100 * tolerance:g} %."
        return Section(title, [Paragraph(said), more], "left-out")
    return Section(title, [Table(("effect or choice", "would change"), lines, "ll"), more], "left-out")


def is_right(rows: Sequence[Assessment], tolerance: float, is_by_friction: bool = False) -> list[Block]:
    """In short: what the model has or lacks that changes a result by more than the tolerance, and what to do.

    Args:
        is_by_friction: whether friction moves the balls, so that no hypothesis is left open.
    """
    title = "Is the model right for this case?"
    lines: list[list[Cell]] = []
    for row, most, is_open in _lacking(rows, tolerance, is_by_friction):
        change = f"{row.change_in(most)} of the {WORDS[most]}"
        if is_open:
            where = Md("see [the range below the table of effects](#effects)")
            lines.append([row.what, Badge("a hypothesis", "finding"), change, where])
        else:
            advice = f"give {row.needs}" if row.verdict == DATA_MISSING else f"add {', '.join(row.add)}"
            lines.append([row.what, Badge("no", _status(row)), change, advice])
    needed = [row for row in rows if row.in_scene and row.verdict == NEEDED]
    needed.sort(key=lambda row: -row.size(row.largest) if row.largest else 0.0)
    has = [f"{row.what}: {row.change_in(most)} of the {WORDS[most]}" for row in needed if (most := row.largest)]
    limit = f"changes a result by more than {100 * tolerance:g} %"
    said = f"In the model, and needed: {'; '.join(has)}." if has else f"Nothing that the model has {limit}."
    said = f"{said} {NEVER}"
    if not lines:
        return [Paragraph(Md(f"**{title}** Nothing that it lacks {limit}. {said}"))]
    headings = ("effect or choice", "in the model", "would change", "what to do")
    return [Table(headings, lines, "llll", title, stack=True), Paragraph(said)]


def _status(row: Assessment) -> str:
    """What its colour stands for: of what is lacking by the size of the change, whatever the reason."""
    if row.verdict == NOT_NEEDED or (row.verdict == NEEDED and row.in_scene):
        return "pass"
    if row.verdict in (NEEDED, DATA_MISSING):
        return "fail" if row.is_large else "finding"
    return "missing"


def _line(row: Assessment) -> list[Cell]:
    changes = (row.change(name).replace("\n", " ") for name in QUANTITIES)
    return [row.what, "yes" if row.in_scene else "no", *changes, Badge(row.verdict, _status(row))]
