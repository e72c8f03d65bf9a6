"""The evidence that applies to a scene: which checks cover it, and where it lies outside of them.

A statement stands here only with the condition under which it holds, judged from the scene and its solution.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

from qsbearing.contact.hertz import HertzForm
from qsbearing.documents.model import Badge, Block, Cell, Md, Paragraph, Section, Table
from qsbearing.effects.tilt_lever import TiltLever
from qsbearing.messages import STATIC_PRESSURE_LIMIT
from qsbearing.scene.bearing import BearingKind
from qsbearing.scene.scene import Scene
from qsbearing.sets.bearing_set import BearingSet
from qsbearing.solution import Solution
from qsbearing.units import deg


class Facts(NamedTuple):
    """What the conditions ask."""

    scene: Scene
    ellipticity: tuple[float, float]
    """Least and largest a/b of the loaded contacts."""
    radii: tuple[float, float]
    """Groove radii over the ball's diameter, inner and outer."""
    pressure: float
    """The greatest [Pa]."""


Asked = TypeVar("Asked")


@dataclass(frozen=True)
class Statement(Generic[Asked]):
    """What a check covers, and when: judged from the facts of a scene, or from a set."""

    says: str
    command: str
    applies: Callable[[Asked], bool]
    """Whether there is what is checked at all."""
    covers: Callable[[Asked], bool] = lambda asked: True
    """Whether it lies within what was checked."""


def _is_deep_groove(facts: Facts) -> bool:
    return facts.scene.bearing.kind is BearingKind.DEEP_GROOVE


def _is_b218(facts: Facts) -> bool:
    return (facts.scene.bearing.name or "").upper() == "B218"


STATEMENTS: tuple[Statement[Facts], ...] = (
    Statement(
        "The equations, to ten digits: fifty-digit solutions of scenes with every ball effect and raceway control, "
        "Hertz in exact form, tilts about the circle of groove centres.",
        "python -m tests.reference.table",
        lambda facts: True,
        lambda facts: facts.scene.hertz_form is HertzForm.EXACT and facts.scene.tilt_lever is TiltLever.GROOVE_CENTRE,
    ),
    Statement(
        "Hertz's formulas, by closed forms of a second derivation, for a/b from 1 to 50.",
        "fem-check run hertz_formula",
        lambda facts: True,
        lambda facts: facts.ellipticity[0] >= 1.0 and facts.ellipticity[1] <= 50.0,
    ),
    Statement(
        "Every contact reported for B218, with steel and ceramic balls, at eight operating points, by closed forms and "
        "finite elements. With --scene the same is done for any scene.",
        "fem-check run solution_contacts --scene SCENE",
        lambda facts: True,
        _is_b218,
    ),
    Statement(
        "Hertz's parabola against the exact gap of B218's inner groove, with f from 0.505 to 0.56.",
        "fem-check run conformity",
        lambda facts: True,
        lambda facts: min(facts.radii) >= 0.505 and max(facts.radii) <= 0.56,
    ),
    Statement(
        "Elastic contact: no pressure above that of the static load rating, where contacts yield.",
        "qsbearing run SCENE",
        lambda facts: True,
        lambda facts: facts.pressure <= STATIC_PRESSURE_LIMIT,
    ),
    Statement(
        "Balls at speed between elastic rings: one ball of B218 in three dimensions, at 10 000 rpm, under thrust.",
        "fem-check run bearing_sector",
        lambda facts: bool(facts.scene.ball_effects),
        _is_b218,
    ),
    Statement(
        "Rings that grow: thick rings by closed forms of elasticity, limits and powers. No measurement.",
        "pytest tests/effects/test_ring_expansion.py",
        lambda facts: bool(facts.scene.ring_effects),
    ),
    Statement(
        "Lives by ISO/TS 16281, of a deep-groove bearing by a commercial program; 4840 tested deep-groove bearings.",
        "fem-check book endurance_1956",
        lambda facts: "life" in facts.scene.readings,
        _is_deep_groove,
    ),
    Statement(
        "Ball-pass frequencies of two deep-groove bearings, measured, with inputs known as ranges.",
        "fem-check book motor_bearings",
        lambda facts: "frequencies" in facts.scene.readings,
        _is_deep_groove,
    ),
    Statement(
        "Films: a worked example of a 209 bearing and the standards' examples of oils. No measurement.",
        "pytest tests/readings/test_film.py",
        lambda facts: "film" in facts.scene.readings,
    ),
    Statement(
        "Friction: closed forms and brute force. No measurement.",
        "pytest tests/readings/test_friction.py",
        lambda facts: bool({"friction", "friction_estimate"} & set(facts.scene.readings)),
    ),
)

OF_SETS: tuple[Statement[BearingSet], ...] = (
    Statement(
        "Statics of sets at rest, to 1e-8: the balls of two to four rows as springs between points in three "
        "dimensions, under every load at once.",
        "pytest tests/sets/test_equilibrium.py",
        lambda of: True,
        lambda of: not of.ball_effects and not any(of.effects_of(row) for row in of.rows) and len(of.rows) <= 4,
    ),
    Statement(
        "Relations of sets at rest and at speed: rows add up to the load, mirror images, stiffness against "
        "differences; up to four rows.",
        "pytest tests/sets/test_equilibrium.py",
        lambda of: True,
        lambda of: len(of.rows) <= 4,
    ),
    Statement(
        "Axial rigidities of rigidly preloaded pairs at rest, as a maker prints them (GMN S 6210, 15 and 25 degrees).",
        "pytest tests/sets/test_preload.py",
        lambda of: len(of.rows) == 2 and of.is_opposed,
        lambda of: _is_printed_pair(of),
    ),
)


def _is_printed_pair(of: BearingSet) -> bool:
    angles = [float(np.asarray(row.bearing.free_contact_angle)) / deg for row in of.rows]
    is_rigid = of.preload is not None and of.preload.spring is None
    return is_rigid and float(np.asarray(of.operation.speed)) == 0.0 and min(angles) > 14.99 and max(angles) < 25.01


def section(solutions: Sequence[Solution], of: BearingSet | None = None) -> Section:
    """The statements that apply, with whether this scene or set lies within what was checked.

    Args:
        solutions: of the scene, or of each row of the set.
    """
    facts = [_facts(solution) for solution in solutions]
    rows: list[list[Cell]] = []
    for each in STATEMENTS:
        concerned = [one for one in facts if each.applies(one)]
        if concerned:
            rows.append(_line(each, all(each.covers(one) for one in concerned)))
    rows += [] if of is None else [_line(each, each.covers(of)) for each in OF_SETS if each.applies(of)]
    what = "scene" if of is None else "set"
    words = (
        f"What was checked and applies to a {what} like this. Outside: the {what} lies beyond what was checked, which "
        "does not make it wrong. The validation report, `fem-check report`, has the numbers."
    )
    blocks: list[Block] = [Paragraph(Md(words)), Table(("what was checked", "again by", f"this {what}"), rows, "lll")]
    return Section("Evidence that applies", blocks, "evidence")


def _line(statement: Statement[Any], is_covered: bool) -> list[Cell]:
    verdict = Badge("covered", "pass") if is_covered else Badge("outside", "finding")
    return [statement.says, Md(f"`{statement.command}`"), verdict]


def _facts(solution: Solution) -> Facts:
    bearing = solution.scene.operating_bearing
    diameter = float(np.asarray(bearing.ball_diameter))
    ratios, pressures = [], []
    for side in (solution.inner, solution.outer):
        loaded = side.load > 0.0
        ratios.append(side.semi_major_axis[loaded] / side.semi_minor_axis[loaded])
        pressures.append(side.max_pressure[loaded])
    found, most = (np.concatenate(each) for each in (ratios, pressures))
    radii = tuple(
        float(np.asarray(getattr(bearing, f"{side}_groove_radius"))) / diameter for side in ("inner", "outer")
    )
    return Facts(
        solution.scene,
        (float(found.min(initial=np.inf)), float(found.max(initial=1.0))),
        (radii[0], radii[1]),
        float(most.max(initial=0.0)),
    )
