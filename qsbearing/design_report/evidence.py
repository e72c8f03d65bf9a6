"""The evidence that applies to a scene: which checks cover it, and where it lies outside of them.

A statement stands here only with the condition under which it holds, judged from the scene and its solution.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from qsbearing.contact.hertz import HertzForm
from qsbearing.documents.model import Badge, Block, Cell, Md, Paragraph, Section, Table
from qsbearing.effects.tilt_lever import TiltLever
from qsbearing.messages import STATIC_PRESSURE_LIMIT
from qsbearing.scene.bearing import BearingKind
from qsbearing.scene.scene import Scene
from qsbearing.solution import Solution


class Facts(NamedTuple):
    """What the conditions ask."""

    scene: Scene
    ellipticity: tuple[float, float]
    """Least and largest a/b of the loaded contacts."""
    radii: tuple[float, float]
    """Groove radii over the ball's diameter, inner and outer."""
    pressure: float
    """The greatest [Pa]."""


@dataclass(frozen=True)
class Statement:
    """What a check covers, and when."""

    says: str
    command: str
    applies: Callable[[Facts], bool]
    """Whether the scene has what is checked at all."""
    covers: Callable[[Facts], bool] = lambda facts: True
    """Whether it lies within what was checked."""


def _is_deep_groove(facts: Facts) -> bool:
    return facts.scene.bearing.kind is BearingKind.DEEP_GROOVE


def _is_b218(facts: Facts) -> bool:
    return (facts.scene.bearing.name or "").upper() == "B218"


STATEMENTS = (
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


def section(solution: Solution) -> Section:
    """The statements that apply, with whether this scene lies within what was checked."""
    facts = _facts(solution)
    rows: list[list[Cell]] = [
        [
            each.says,
            Md(f"`{each.command}`"),
            Badge("covered", "pass") if each.covers(facts) else Badge("outside", "finding"),
        ]
        for each in STATEMENTS
        if each.applies(facts)
    ]
    words = (
        "What was checked and applies to a scene like this. Outside: the scene lies beyond what was checked, which "
        "does not make it wrong. The validation report, `fem-check report`, has the numbers."
    )
    blocks: list[Block] = [Paragraph(Md(words)), Table(("what was checked", "again by", "this scene"), rows, "lll")]
    return Section("Evidence that applies", blocks, "evidence")


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
