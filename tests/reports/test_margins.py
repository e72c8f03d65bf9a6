"""What a report opens with: how much of each limit is used, and the answer that follows from it and the remarks."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import pytest

import qsbearing as qs
from qsbearing.documents.model import LONGEST_BAR, Bar, Paragraph, Table
from qsbearing.files.scene_file import scene_of
from qsbearing.model.contact.hertz import STATIC_PRESSURE
from qsbearing.model.solution.limit import Answer, Standing
from qsbearing.readings.asked import take_asked
from qsbearing.remarks.bearing import BALLS_SPARSE
from qsbearing.remarks.kinds import Kind
from qsbearing.remarks.remark import remark
from qsbearing.reports.answers_table import answers_table
from qsbearing.reports.verdict import verdict
from qsbearing.results.built_in_limits import BUILT_IN, built_in_answers
from qsbearing.results.requirements import Answered
from qsbearing.systems.sets.remarks import STIFFNESS_UNDETERMINED
from tests.systems.heat.spindle import BEARING, EFFECTS, scene, tables

B218 = qs.load_scene("B218").bearing
BALLS: dict[str, Any] = {
    "ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()),
    "raceway_control": "outer",
}


def of(operation: qs.Operation, **other: Any) -> dict[str, Answer]:
    """Answers of a scene to the limits that hold anyway, by their names."""
    return named(qs.solve(qs.Scene(B218, operation, **other)))


def named(solution: qs.Solution) -> dict[str, Answer]:
    return {each.limit.name: each for each in built_in_answers(solution, take_asked(solution))}


def with_value(answer: Answer, value: float) -> Answer:
    """The same, had it been this number."""
    return answer._replace(value=value, state=Standing.NOT_MET if value > answer.bound else Standing.MET)


def test_each_limit_is_compared_with_its_number() -> None:
    """Of the raceway, ball and state that come closest; only limits that the scene has."""
    operation = qs.Operation(speed=9_000 * qs.rpm, axial_load=6_000.0, radial_load_y=2_000.0, tilt_y=0.0, tilt_z=0.0)
    solution = qs.solve(qs.Scene(B218, operation, **BALLS))
    found = of(operation, **BALLS)
    assert list(found) == ["contact pressure", "friction coefficient"]
    pressure = max(side.max_pressure.max() for side in (solution.inner, solution.outer))
    assert found["contact pressure"].used == pytest.approx(pressure / STATIC_PRESSURE, rel=1e-12)
    friction = max(side.required_friction.max() for side in (solution.inner, solution.outer))
    assert found["friction coefficient"].used == pytest.approx(friction / 0.06, rel=1e-12)
    given = (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=0.05))
    assert of(operation, **(BALLS | {"ball_effects": given}))["friction coefficient"].bound == 0.05
    assert list(of(replace(operation, speed=0.0))) == ["contact pressure"]


def test_a_contact_at_the_shoulder_uses_all_of_its_limit() -> None:
    """Semi-axes grow with the cube root of the load, up to that at which the reading has the ellipse at the edge."""
    asked = {"overrun": {"inner_shoulder_diameter": 118 * qs.mm}}
    scene = qs.Scene(B218, qs.Operation(axial_load=20_000.0), readings=asked)
    solution = qs.solve(scene)
    part = float(take_asked(solution)["overrun"].inner.overrun_load[0] / solution.inner.load[0])
    used = of(scene.operation, readings=asked)["inner contact to groove edge"].used
    assert used == pytest.approx(part ** (-1.0 / 3.0), rel=1e-9)


def test_ring_stress_is_that_of_the_worst_state() -> None:
    """With the largest interference that a named fit allows; of warm rings on a fit without a name, at rest."""
    tables: dict[str, Any] = {
        "bearing": {"name": "7210C"},
        "operation": {"speed_rpm": 3000, "axial_load_N": 500},
        "effects": {"ring_expansion": {"shaft_fit": "k5"}},
    }
    solution = qs.solve(scene_of(tables, ""))
    rings = solution.scene.ring_expansion
    assert rings is not None and rings.shaft_fit is not None and solution.inner_ring is not None
    tight = replace(rings, shaft_interference=rings.shaft_fit.most)
    largest = tight.states(solution.scene.bearing, solution.scene.operation)[0].equivalent_stress / 1e6
    answer = named(solution)["ring stress"]
    assert answer.value == pytest.approx(float(largest)) and answer.worst.raceway == ""
    assert answer.value > 1.2 * float(solution.inner_ring.equivalent_stress) / 1e6
    assert answer.limit.source == "yield strength; the inner ring in operation with its fit at the largest interference"
    warm = {"shaft_interference_um": 20, "inner_ring_temperature_C": 60, "shaft_temperature_C": 20}
    tables["effects"] = {"ring_expansion": warm}
    loose = named(qs.solve(scene_of(tables, "")))["ring stress"]
    assert loose.limit.source == "yield strength; the inner ring at rest and cold"


def test_the_row_that_is_closest_stands_for_its_set() -> None:
    rows = (qs.Row(B218, 0.0, "+x"), qs.Row(B218, 60 * qs.mm, "-x"))
    operation = qs.Operation(speed=0.0, axial_load=3_000.0)
    solution = qs.solve_set(qs.BearingSet(rows, operation, preload=qs.Preload(rigid=1_500.0)))
    found = {each.limit.name: each for each in built_in_answers(solution, [{}, {}])}
    assert found["contact pressure"].worst.row == 1 and found["contact pressure"].worst.raceway == "inner"
    assert "of row 1 (B218, carries +x), " in verdict([found["contact pressure"]], [], rows=solution.set.rows).text
    assert found["contact pressure"].value == pytest.approx(solution.rows[0].inner.max_pressure.max() / 1e6)
    assert found["preload"].value == pytest.approx(1_500.0)
    assert found["preload"].used == pytest.approx(1.0 / 3.0)


@pytest.mark.parametrize(
    ("load", "said", "status", "words"),
    [
        (20_000.0, (), "pass", ("Within every limit that was checked.", "The closest is contact pressure", "%)")),
        (20_000.0, (BALLS_SPARSE,), "warning", ("Within every limit that was checked", "Check the data")),
        (20_000.0, (STIFFNESS_UNDETERMINED,), "fail", ("The model does not describe this case.",)),
        (2e6, (), "fail", ("Contact pressure", "beyond the limit.")),
    ],
)
def test_the_answer_follows_from_margins_and_remarks(
    load: float, said: tuple[Kind, ...], status: str, words: tuple[str, ...]
) -> None:
    found = list(of(qs.Operation(axial_load=load)).values())
    shown = verdict(found, [remark(kind) for kind in said])
    assert shown.status == status
    for each in words:
        assert each in shown.text


COOL = tables()["thermal"] | {"limit_temperature_C": 60.0}
"""A low limit: curves end early."""


@cache
def every_answer() -> dict[str, Answer]:
    """One of each limit: of contacts and shoulders, of balls at speed, of fits, of a preload, of heat."""
    shoulders = {"inner_shoulder_diameter": 118 * qs.mm, "outer_shoulder_diameter": 131 * qs.mm}
    fits = (qs.RingExpansion(0.09, 0.16, shaft_interference=20 * qs.um),)
    turning = qs.Operation(speed=9_000 * qs.rpm)
    preload = qs.Preload(rigid=6_000.0)
    oil = {"drag_coefficient": 1.5, "least_oil_share": 0.02, "most_oil_share": 0.2, "minimum_load_factor": 10.0}
    readings = {"overrun": shoulders, "ball_slip": {"friction_coefficient": 0.07} | oil}
    found = of(turning, preload=preload, ring_effects=fits, readings=readings, **BALLS)
    hot = qs.solve(scene(thermal=COOL, operation={"speed_rpm": 8000}))
    return found | {"thermal speed limit": named(hot)["thermal speed limit"]}


def estimates(answer: Answer) -> list[float]:
    return [answer.bound, *(each.value for each in answer.limit.others)]


@pytest.mark.parametrize("what", [each.name for each in BUILT_IN])
def test_every_limit_is_taken_on_its_safe_side(what: str) -> None:
    """The smallest of its estimates; beyond it no case passes, and beyond all of them it fails."""
    found = every_answer()
    assert set(found) == {each.name for each in BUILT_IN}, "a limit that no case of this test has"
    answer, limits = found[what], estimates(found[what])
    assert answer.bound == min(limits) > 0.0
    if answer.limit.sense == ">=":
        assert answer.used == answer.bound / answer.value
        assert answer._replace(value=0.99 * answer.bound).used > 1.0 > answer._replace(value=1.01 * answer.bound).used
        return
    assert answer.used == answer.value / min(limits)
    assert verdict([with_value(answer, 0.99 * min(limits))], []).status == "pass"
    beyond = verdict([with_value(answer, 1.01 * max(limits))], [])
    assert beyond.status == "fail" and "unless" not in beyond.text
    if len(limits) > 1:
        between = verdict([with_value(answer, 0.5 * (min(limits) + max(limits)))], [])
        assert between.status == "warning" and "beyond the limit, unless" in between.text
        assert "friction" in between.text


def test_a_speed_is_judged_with_the_friction_of_the_whole_bearing() -> None:
    """Sliding in the contacts is a lower bound of the heat; its own limit is told as what low friction would allow."""
    margin = every_answer()["thermal speed limit"]
    state = qs.solve(scene(thermal=COOL, operation={"speed_rpm": 8000})).thermal
    assert state is not None and state.whole_bearing is not None and state.whole_bearing.state is not None
    ends = [each.speeds.end.factor * 8000.0 for each in (state, state.whole_bearing.state)]  # type: ignore[union-attr]
    assert ends[1] < 0.8 * ends[0]
    assert sorted(estimates(margin)) == pytest.approx(sorted(ends), rel=1e-9)
    assert margin.bound == pytest.approx(ends[1], rel=1e-9) and "palmgren" in margin.limit.source
    between = with_value(margin, 0.5 * sum(ends))
    assert f"contacts alone (the limit is then {ends[0]:,.0f} rpm)".replace(",", "") in verdict(
        [between], []
    ).text.replace(",", "")


def test_a_speed_that_only_a_lower_bound_of_the_heat_judges_does_not_pass() -> None:
    bare = {key: value for key, value in BEARING.items() if key not in ("bore_diameter_mm", "outside_diameter_mm")}
    effects = {key: value for key, value in EFFECTS.items() if key != "ring_expansion"}
    hot = qs.solve(scene(bearing=bare, effects=effects, thermal=COOL, operation={"speed_rpm": 500}))
    margin = named(hot)["thermal speed limit"]
    assert margin.used < 1.0
    shown = verdict([margin], [])
    assert shown.status == "warning" and "lower bound of the heat" in shown.text


def test_bars_end_where_their_limit_is_used_up() -> None:
    """With the mark of the limit inside; beyond it the number tells, and their colour is that of the answer."""
    pressure, friction = list(every_answer().values())[:2]
    over = with_value(friction, 30.0 * friction.bound)
    answers = Answered([], [pressure, over])
    table = next(each for each in answers_table(answers, None) if isinstance(each, Table))
    bars = [each for row in table.rows for each in row if isinstance(each, Bar)]  # type: ignore[union-attr]
    assert [each.status for each in bars] == ["pass", "fail"]
    assert bars[0].length == pytest.approx(pressure.used / LONGEST_BAR)
    assert bars[1].length == 1.0 and bars[1].word == "3000 %"
    assert Bar(float("nan")).length == 0.0 and Bar(float("inf")).word == "-"


def test_limits_are_listed_with_their_sources_and_what_was_not_checked_by_name() -> None:
    every = every_answer()
    built_in = [each for name, each in every.items() if name != "preload"]
    table, small = answers_table(Answered([], built_in), None)
    assert isinstance(table, Table) and isinstance(small, Paragraph)
    assert [str(row[0]).partition(",")[0].lower() for row in table.rows] == [each.limit.name for each in built_in]  # type: ignore[index]
    assert all(each.limit.source in small.text for each in built_in)
    assert "Not checked: preload." in small.text and "life" in small.text
