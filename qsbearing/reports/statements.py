"""What was checked, with what result, and in what a scene differs from it: the statements of the design report."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np

from qsbearing.documents.numbers import plain
from qsbearing.model.bearing import BearingKind
from qsbearing.model.contact.hertz import STATIC_PRESSURE, first_yield_pressure
from qsbearing.model.material import SILICON_NITRIDE
from qsbearing.model.units import MPa, deg
from qsbearing.remarks.wording import Span
from qsbearing.reports.conditions import (
    NOTHING,
    Difference,
    SceneFacts,
    beyond,
    faster,
    groove,
    not_thrust,
    other_bearing,
    other_choices,
    other_effects,
    other_formulas,
    per_area,
)

NUMBERS: dict[str, Any] = json.loads((Path(__file__).parent / "evidence.json").read_text(encoding="utf-8"))
"""What the records say; tests.reports.evidence_numbers reads it from them."""
OUTER, OF_BALLS = ("outer",), ("centrifugal_force", "gyroscopic_moment")
FIRST_YIELD = first_yield_pressure(1700e6)
"""Of bearing steel with a yield strength of 1700 MPa [Pa]."""
B218_DIAMETER, B218_ANGLE = 22.225, 40.0
"""Of the check of grooves [mm, deg]."""
ANGLE_MARGIN = 10.0
"""From that contact angle [deg]: it changes the curvature along B218's inner groove by less than 3 %."""
Of = TypeVar("Of")


@dataclass(frozen=True)
class Statement(Generic[Of]):
    """What was checked, and how a scene, by its facts, or a set compares with it."""

    says: str
    found: Callable[[Sequence[Of]], str]
    """The result, in numbers of the record; of all scenes, or rows of a set, that have what is checked."""
    command: str
    differences: Callable[[Of], list[Difference]]
    """In what it differs from what was checked; nothing: it lies within."""
    applies: Callable[[Of], bool] = lambda of: True
    """Whether it has what is checked at all."""


def _asks(*names: str) -> Callable[[SceneFacts], bool]:
    return lambda facts: bool(set(names) & set(facts.scene.readings))


def _spread(span: list[float]) -> str:
    return " to ".join(f"{each:+.2g}" if abs(each) >= 0.1 else f"{each:+.1g}" for each in span)


def _within(span: list[float]) -> str:
    return f"{max(map(abs, span)):.2g}"


def _equations(facts: SceneFacts) -> list[Difference]:
    in_some = tuple(name for name in ("unequal_balls", "seats_out_of_round") if NUMBERS["reference"][f"has_{name}"])
    return other_formulas(facts) + other_effects(facts, (*OF_BALLS, *in_some))


def _ellipticity(facts: SceneFacts) -> list[Difference]:
    low, high = NUMBERS["hertz_formula"]["ellipticity"]
    return beyond("a/b", facts.ellipticity, (low, high)) + [
        each for each in other_formulas(facts) if each.reason.startswith("Hertz")
    ]


def _contacts(facts: SceneFacts) -> list[Difference]:
    low, high = NUMBERS["solution_contacts"]["load_N"]
    differences = other_bearing(facts, "B218", balls=(SILICON_NITRIDE,))
    differences += faster(facts, NUMBERS["bearing_sector"]["speed_rpm"])
    for side in ("inner", "outer"):
        differences += beyond(f"{side} contact load", facts.loads[side], (low, high), " N")
    return differences + other_effects(facts, OF_BALLS) + other_choices(facts, OUTER)


def _gap(facts: SceneFacts) -> list[Difference]:
    """B218's inner groove, whatever its radius."""
    high = NUMBERS["conformity"]["load_N"][1] / B218_DIAMETER**2
    differences = other_bearing(facts, "B218", ("ball_diameter", "pitch_diameter"))
    f = groove(facts, "inner")
    differences += beyond("inner groove radius over D", (f, f), tuple(NUMBERS["conformity"]["f"]))
    low, high_angle = facts.angles["inner"]
    if max(abs(low - B218_ANGLE), abs(high_angle - B218_ANGLE)) > ANGLE_MARGIN:
        own = " to ".join(dict.fromkeys((f"{low:.1f}", f"{high_angle:.1f}")))
        differences.append(Difference(f"inner contact angle {own} deg, checked at {B218_ANGLE:g} deg"))
    return differences + beyond("inner Q/D²", (0.0, per_area(facts, "inner")[1]), (0.0, high), " N/mm²")


def _true_bodies(facts: SceneFacts) -> list[Difference]:
    numbers = NUMBERS["true_geometry"]
    differences = other_bearing(facts, "B218")
    for side in ("inner", "outer"):
        differences += beyond(f"{side} contact load", (0.0, facts.loads[side][1]), (0.0, numbers["load_N"][1]), " N")
        differences += beyond(f"{side} contact angle", facts.angles[side], tuple(numbers["angle_deg"]), " deg")
    return differences


def _elastic(facts: SceneFacts) -> list[Difference]:
    if facts.pressure > STATIC_PRESSURE:
        return [Difference(f"above {STATIC_PRESSURE / MPa:.0f} MPa: permanent dents", True)]
    if facts.pressure > FIRST_YIELD:
        return [Difference(f"above {FIRST_YIELD / MPa:.0f} MPa, where yielding begins below the surface")]
    return []


def _sector(facts: SceneFacts) -> list[Difference]:
    numbers = NUMBERS["bearing_sector"]
    differences = other_bearing(facts, "B218") + faster(facts, numbers["speed_rpm"])
    differences += not_thrust(facts, tuple(numbers["load_N"]))
    return differences + other_effects(facts, OF_BALLS) + other_choices(facts, OUTER)


def _sector_result(facts: Sequence[SceneFacts]) -> str:
    rigid, free = NUMBERS["bearing_sector"]["rigid"], NUMBERS["bearing_sector"]["free"]
    return (
        f"Outside diameter rigid: contact loads within {_within(rigid['load_percent'])} %, angles within "
        f"{_within(rigid['angle_deg'])} deg; finite elements minus model: axial displacement "
        f"{_spread(rigid['displacement_percent'])} %, b {_spread(rigid['semi_minor_axis_percent'])} %, p0 "
        f"{_spread(rigid['pressure_percent'])} %. Outside diameter free: axial displacement "
        f"{_spread(free['displacement_percent'])} %, loads {_spread(free['load_percent'])} %"
    )


def _other_program(facts: SceneFacts) -> list[Difference]:
    return other_bearing(facts, "ISO16281_7ball") + other_effects(facts, ()) + _unmodified(facts)


def _endurance(facts: SceneFacts) -> list[Difference]:
    differences = (
        [] if facts.scene.bearing.kind is BearingKind.DEEP_GROOVE else [Difference("not a deep-groove bearing")]
    )
    if abs(facts.ring[0]) > NOTHING * np.abs(facts.ring).max():
        differences.append(Difference("axial load, tested under radial load"))
    return differences + other_effects(facts, ()) + _unmodified(facts)


def _unmodified(facts: SceneFacts) -> list[Difference]:
    life = facts.scene.readings.get("life", {})
    is_modified = bool({"viscosity_ratio", "contamination_factor", "cleanliness"} & set(life))
    return [Difference("no modified life in the check", True)] if is_modified else []


def _motors(facts: SceneFacts) -> list[Difference]:
    differences = (
        [] if facts.scene.bearing.kind is BearingKind.DEEP_GROOVE else [Difference("not a deep-groove bearing")]
    )
    if np.abs(facts.ring[1:]).max() > NOTHING * np.abs(facts.ring).max():
        differences.append(Difference("radial load or moment, measured under a spring's thrust"))
    return differences + faster(facts, 1800.0)


def _spindles(facts: SceneFacts) -> list[Difference]:
    return not_thrust(facts, (0.0, np.inf)) + other_effects(facts, ())


def _has_spindle_angle(facts: SceneFacts) -> bool:
    angle = float(np.asarray(facts.scene.bearing.free_contact_angle)) / deg
    return facts.scene.bearing.kind is BearingKind.ANGULAR_CONTACT and 14.5 <= angle <= 25.5


_reference, _hertz, _points = NUMBERS["reference"], NUMBERS["hertz_formula"], NUMBERS["solution_contacts"]
_gaps, _bodies, _rigs = NUMBERS["conformity"], NUMBERS["true_geometry"]["percent"], NUMBERS["motor_bearings"]
_pairs, _lives, _tests = NUMBERS["gmn_rigidities"], NUMBERS["iso_16281_seven_balls"], NUMBERS["endurance_1956"]

STATEMENTS: tuple[Statement[SceneFacts], ...] = (
    Statement(
        f"The solution of the equations: {_reference['scenes']} scenes solved to fifty digits.",
        lambda facts: f"Loads, angles, displacements and stiffness within {_reference['largest']:.0e}",
        "python -m tests.verification.reference.table",
        _equations,
    ),
    Statement(
        "Hertz's formulas against closed forms derived a second time.",
        lambda facts: f"Within {_hertz['largest_percent']:.0e} %",
        "pytest tests/fem_check/test_references.py",
        _ellipticity,
    ),
    Statement(
        f"Every contact reported for B218, steel and ceramic balls, at {_points['operating_points']} operating points "
        "up to 10000 rpm, thrust and radial load, against closed forms and finite elements of half-spaces. With "
        "`--scene` the same is done for any scene.",
        lambda facts: (
            f"Closed forms within {_points['closed_form_percent']:.0e} %, finite elements within "
            f"{plain(_points['finite_elements_percent'], '.1g')} %"
        ),
        "fem-check run solution_contacts --scene SCENE",
        _contacts,
    ),
    Statement(
        "Hertz's parabola against the exact gap between ball and inner groove of B218 at its free contact angle, "
        "the groove radius varied.",
        lambda facts: (
            f"Hertz's worst quantity at {_gaps['load_N'][1]:.0f} N is off by "
            + ", ".join(f"{off:.1f} % (f {f})" for f, off in _gaps["largest_percent"].items())
        ),
        "fem-check run conformity",
        _gap,
    ),
    Statement(
        "Hertz against finite elements of B218's true ball and rings, both raceways, at rest, up to 5000 N per ball.",
        lambda facts: (
            f"Finite elements minus Hertz: a {_spread(_bodies['semi_major_axis'])} %, b "
            f"{_spread(_bodies['semi_minor_axis'])} %, p0 {_spread(_bodies['max_pressure'])} %, approach "
            f"{_spread(_bodies['approach'])} %"
        ),
        "fem-check run true_geometry",
        _true_bodies,
    ),
    Statement(
        f"Elastic contact. Bearing steel begins to yield below the surface near {FIRST_YIELD / MPa:.0f} MPa; "
        f"{STATIC_PRESSURE / MPa:.0f} MPa is ISO 76's limit, a permanent dent of 1e-4 D.",
        lambda facts: f"Maximum pressure here: {Span(each.pressure / MPa for each in facts):.0f} MPa",
        "qsbearing run SCENE",
        _elastic,
    ),
    Statement(
        "The whole model against one ball of B218 between elastic rings, in three dimensions: thrust, at rest and "
        "at 10000 rpm.",
        _sector_result,
        "fem-check run bearing_sector",
        _sector,
    ),
    Statement(
        "Expansion of the rings against closed forms of thick rings, limits and powers.",
        lambda facts: "Closed forms to rounding. No measurement",
        "pytest tests/model/effects/test_ring_expansion.py",
        lambda facts: [],
        lambda facts: facts.scene.ring_expansion is not None,
    ),
    Statement(
        "Unequal balls: all balls with one deviation against a bearing of such balls, one large ball against its "
        "spring.",
        lambda facts: "To ten digits. No measurement",
        "pytest tests/model/effects/test_unequal_balls.py",
        lambda facts: [],
        lambda facts: facts.scene.ball_diameter_deviations is not None,
    ),
    Statement(
        "Seats out of round: lobes turned with the load, one ball against its spring, a second solver.",
        lambda facts: "To nine digits. No measurement",
        "pytest tests/model/effects/test_seats_out_of_round.py",
        lambda facts: [],
        lambda facts: facts.scene.seats_out_of_round is not None,
    ),
    Statement(
        "Axial stiffness of preloaded pairs of spindle bearings, 15 to 25 degrees, as a maker's catalogue prints it.",
        lambda facts: (
            f"{_pairs['values']} values of {_pairs['bearings']} bearings: {plain(100 * _pairs['rms'], '.2g')} % rms, "
            f"largest {plain(100 * _pairs['largest'], '.2g')} %, with one groove radius fitted to each bearing. "
            "No measurement"
        ),
        "fem-check book gmn_rigidities",
        _spindles,
        _has_spindle_angle,
    ),
    Statement(
        "Lives and displacements by ISO/TS 16281 of a deep-groove bearing of seven balls, at rest, against another "
        "program.",
        lambda facts: (
            f"Displacements within {plain(_lives['displacements_percent'], '.1g')} %, {_lives['lives']} lives within "
            f"{plain(_lives['lives_percent'], '.1g')} %"
        ),
        "fem-check book iso_16281_seven_balls",
        _other_program,
        _asks("life"),
    ),
    Statement(
        f"Rating life against {_tests['bearings']} tested deep-groove bearings.",
        lambda facts: (
            f"Measured over computed {_tests['measured_over_computed']:.2f} on average; single groups scatter by a "
            f"factor of {_tests['scatter_factor']:.1f}"
        ),
        "fem-check book endurance_1956",
        _endurance,
        _asks("life"),
    ),
    Statement(
        "Ball-pass frequencies measured at two deep-groove motor bearings with a spring, inputs known as ranges; and "
        "at a rig under radial load alone.",
        lambda facts: (
            f"{_rigs['inside']} of {_rigs['groups']} groups inside the computed range, with the recommended spring "
            f"force {_rigs['inside_recommended']}. Under radial load the cage lags by "
            f"{100 * NUMBERS['mfpt_rig']['slip'][0]:.1f} to {100 * NUMBERS['mfpt_rig']['slip'][1]:.1f} %, which the "
            "model does not have"
        ),
        "fem-check book motor_bearings",
        _motors,
        _asks("frequencies"),
    ),
    Statement(
        "The film formulas against a textbook's example of a 209 bearing and the standards' examples of oils.",
        lambda facts: f"Within {plain(NUMBERS['hamrock_209_film']['textbook_percent'], '.1g')} %. No measurement",
        "fem-check book hamrock_209_film",
        lambda facts: [],
        _asks("film"),
    ),
    Statement(
        "The friction formulas against closed forms and direct numerical integration.",
        lambda facts: "The integrals agree. No measurement",
        "pytest tests/readings/test_friction.py",
        lambda facts: [],
        _asks("friction", "friction_estimate"),
    ),
)
