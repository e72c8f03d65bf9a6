"""Effects and choices: which are in, which are not, how much each matters here, and what the model assumes anyway."""

from __future__ import annotations

from collections.abc import Sequence

from qsbearing.chooser.explain import Row, explain
from qsbearing.chooser.explain_set import explain_set
from qsbearing.documents.model import Badge, Block, Bullets, Cell, Md, Paragraph, Section, Table
from qsbearing.effects import QUANTITIES
from qsbearing.judgement import WORDS
from qsbearing.messages import chosen
from qsbearing.scene.scene import Scene
from qsbearing.sets.bearing_set import BearingSet
from qsbearing.solution import Solution

DEFAULT_TOLERANCE = 0.01

ASSUMED = (
    "The motion is steady, and every ball is in equilibrium by itself: no cage force, no drag, no lubricant film under "
    "load.",
    "Rings are rigid but for their contacts, and contacts are elastic: Hertz's ellipses in grooves of constant radius.",
    "The geometry is exact: all balls alike, evenly spaced, grooves round and true.",
)
OF_SETS = (
    "Shaft and housing are rigid: rows keep their distance, nothing bends, and nothing grows along the shaft with heat."
)
SPINNING = (
    "The axis of each ball follows from raceway control, a hypothesis; friction carries the gyroscopic moment, and the "
    "friction coefficient that it takes is a result, in the table of inertia and motion."
)


def section(solution: Solution, asked: Scene, tolerance: float) -> Section:
    """Assumptions, and a row for each effect and choice.

    Args:
        solution: of the scene with its effects.
        asked: the scene as it was given, which may leave the choice of effects to a tolerance.
        tolerance: above which a change counts.
    """
    _, rows = explain(solution.scene, tolerance, verify=True)
    assumed = [*ASSUMED, *([SPINNING] if solution.scene.ball_effects else [])]
    said = [] if solution.choice is None else chosen(solution, asked)
    return _section("What holds for every scene of this model:", assumed, said, rows, tolerance)


def section_of_set(of: BearingSet) -> Section:
    """Likewise of a set."""
    _, rows = explain_set(of, DEFAULT_TOLERANCE)
    assumed = [OF_SETS, *ASSUMED, *([SPINNING] if of.ball_effects else [])]
    return _section("What holds for every set of this model:", assumed, [], rows, DEFAULT_TOLERANCE)


def _section(first: str, assumed: Sequence[str], said: Sequence[str], rows: Sequence[Row], tolerance: float) -> Section:
    blocks: list[Block] = [Paragraph(first), Bullets(assumed), *map(Paragraph, said)]
    words = (
        "Each effect and choice of the model, found by solving with and without it: the relative change of what people "
        f"read. Above {100 * tolerance:g} % it is needed."
    )
    headings = ("effect or choice", "in", *(f"{WORDS[name]}, %" for name in QUANTITIES), "verdict")
    lines = [_line(row) for row in rows]
    why = [Md(f"`{row.effect}`: {row.why}") for row in rows if row.why]
    blocks += [Paragraph(words), Table(headings, lines, "ll" + "r" * len(QUANTITIES) + "l"), Bullets(why)]
    return Section("Assumptions and effects", blocks, "effects")


def _line(row: Row) -> list[Cell]:
    found = row.actual if row.actual is not None else row.predicted
    changes = [_percent(None if found is None else found.get(name, 0.0)) for name in QUANTITIES]
    status = {"needed": "pass" if row.in_scene else "finding", "not needed": "pass"}.get(row.verdict, "missing")
    return [row.what, "yes" if row.in_scene else "no", *changes, Badge(row.verdict, status)]


def _percent(value: float | None) -> str:
    if value is None:
        return ""
    return "0" if value < 1e-6 else f"{100 * value:.2g}" if value < 1.0 else f"{100 * value:.0f}"
