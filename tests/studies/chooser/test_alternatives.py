"""A choice is judged against every other member, and a remark says where a hypothesis moves the results."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.model.effects import EFFECTS, Entry, MomentShares
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.scene.scene import CHOICES
from qsbearing.model.solution.comparison import by_quantity
from qsbearing.model.solution.judgement import WORTH_A_WARNING
from qsbearing.model.solution.result_keys import DISPLACEMENT, STIFFNESS
from qsbearing.remarks.case_range import CaseRange
from qsbearing.remarks.hypotheses import WORTH_A_SOLVE, hypotheses
from qsbearing.reports.document import document
from qsbearing.results.remarks import every_remark
from qsbearing.studies.chooser.explain import Assessment, explain
from qsbearing.studies.chooser.explain_set import explain_set
from qsbearing.systems.sets.bearing_set import BearingSet
from tests.qsbearing.scenes import turning
from tests.systems.sets.arrangements import pair

MINIMUM = RacewayControl.MINIMUM_DISSIPATION
SCENE = qs.load_scene("b218")
CHOICE_ENTRIES = [entry for entry in EFFECTS if entry.switch.members is not None]
OF_SCENES = [entry for entry in CHOICE_ENTRIES if entry.switch.slot in CHOICES and not entry.hypothesis]
SHARED = [RacewayControl.INNER, RacewayControl.PER_BALL, MINIMUM]
EVERY = [(RacewayControl.OUTER, None), *product(SHARED, MomentShares)]
"""Outer control has one way to share the moment, every other has two."""


def under(of: Any, control: RacewayControl, shares: MomentShares | None) -> Any:
    """A scene or set by a hypothesis, put together by hand."""
    moment = qs.GyroscopicMoment() if shares is None else qs.GyroscopicMoment(shares)
    return replace(of, raceway_control=control, ball_effects=(qs.CentrifugalForce(), moment))


def row_of(of: Any, name: str, tolerance: float = 0.01) -> Assessment:
    rows = (explain_set if isinstance(of, BearingSet) else explain)(of, tolerance)[1]
    (found,) = (row for row in rows if row.effect == name)
    return found


def remarked(solution: Any, index: Any = None) -> list[Any]:
    return [each for each in every_remark(solution, index=index) if each.code == "hypotheses_differ"]


# Every member ---------------------------------------------------------------------------------------------------------


def test_every_field_that_chooses_one_of_several_is_a_choice_of_the_list() -> None:
    assert {entry.switch.slot for entry in CHOICE_ENTRIES} == {*CHOICES, "moment_shares"}


@pytest.mark.parametrize("entry", OF_SCENES, ids=[entry.name for entry in OF_SCENES])
def test_whatever_member_a_scene_has_every_other_is_judged(entry: Entry) -> None:
    """Or, beside a finest one that it has not, that one; the row's numbers are those of solves by hand."""
    slot = entry.switch.slot
    for member in CHOICES[slot]:
        scene = replace(turning(9000.0, axial_load=12e3, radial_load_y=3e3, moment_z=0.0), **{slot: member})
        row, own = row_of(scene, entry.name, 0.01), qs.solve(scene)
        said = [each["under"] for each in row.alternatives]
        assert entry.switch.members is not None
        finest = entry.switch.members.finest
        others = [each for each in CHOICES[slot] if each != member] if member == finest else [finest]
        assert said == [f'{slot} = "{each}"' for each in others]
        found = []
        for each, told in zip(others, row.alternatives, strict=True):
            other = qs.solve(replace(scene, **{slot: each}))
            changed = by_quantity(other, own) if member == finest else by_quantity(own, other)
            assert told["actual"] == pytest.approx({name: float(x) for name, x in changed.items()}, abs=1e-12)
            found.append(told["actual"])
        assert row.actual == {name: max(each[name] for each in found) for name in found[0]}
        assert row.verdict == ("needed" if max(row.actual.values()) > 0.01 else "not needed")
        assert row.add == ([] if member == finest else [f'{slot} = "{finest}"'])


PAIR = pair("DB", 720.0, speed=15_000 * qs.rpm, axial_load=300.0)


def ends(every: list[Any], key: str) -> tuple[float, float]:
    """The least and the most of a displacement or stiffness by its key, of those that have a solution."""
    keys = [each.key for each in DISPLACEMENT], [each.key for each in STIFFNESS]
    is_stiffness = key in keys[1]
    channel, size = (
        keys[is_stiffness].index(key),
        next(each.unit_size for each in (*DISPLACEMENT, *STIFFNESS) if each.key == key),
    )
    found = [each.stiffness[channel, channel] if is_stiffness else each.displacement[channel] for each in every]
    return min(found) / size, max(found) / size


@pytest.mark.parametrize("own", EVERY, ids=["-".join(filter(None, each)) for each in EVERY])
@pytest.mark.parametrize("of", [SCENE, PAIR], ids=["bearing", "pair"])
def test_a_hypothesis_is_compared_with_all_seven(of: Any, own: tuple[RacewayControl, MomentShares | None]) -> None:
    solve = qs.solve_set if isinstance(of, BearingSet) else qs.solve
    of = under(of, *own)
    row, every = row_of(of, "raceway_control"), [solve(under(of, *each)) for each in EVERY]
    assert len(row.alternatives) == len(EVERY) - 1
    solved = [each for each in every if each.converged]
    for name in ("displacement", "stiffness"):
        span = row.range[name]
        assert (span["least"], span["most"]) == pytest.approx(ends(solved, span["key"]), rel=1e-9)
    largest = [by_quantity(each, solve(of)) for each in solved]
    for name, change in (row.actual or {}).items():
        assert change == pytest.approx(max(float(each[name]) for each in largest), rel=1e-9, abs=1e-12)
    assert (row.verdict, bool(row.actual)) == ("not assessed", True)
    assert f"{row.range['displacement']['most']:.4g} µm (" in row.why


def test_what_b218_is_by_each_hypothesis() -> None:
    """Outer control against the other extreme, and friction from 0.1 to 0.03."""
    spans = row_of(SCENE, "raceway_control").range
    assert [round(spans["displacement"][end], 2) for end in ("here", "least", "most")] == [14.76, 14.76, 32.29]
    assert [round(spans["stiffness"][end]) for end in ("here", "least", "most")] == [289, 289, 651]
    assert spans["stiffness"]["most_under"] == 'raceway_control = "inner", moment_shares = "controlling"'
    slip = row_of(SCENE, "gyroscopic_slip")
    assert [each["under"] for each in slip.assumed] == ["µ = 0.1", "µ = 0.03"]
    assert slip.verdict == "likely needed, data missing"
    assert round(slip.range["displacement"]["most"], 2) == 21.39
    assert round(slip.range["stiffness"]["most"]) == 375


def test_a_hypothesis_without_a_solution_is_named_and_in_no_range() -> None:
    of = turning(15_000.0, axial_load=3e3)
    row = row_of(of, "raceway_control")
    none = [each["under"] for each in row.alternatives if each["actual"] is None]
    assert none
    assert all(each in row.why for each in none)
    assert row.range["displacement"]["most_under"] not in none


def test_at_rest_a_hypothesis_does_not_matter() -> None:
    row = row_of(turning(0.0, axial_load=12e3), "raceway_control")
    assert (row.verdict, max((row.actual or {}).values())) == ("not needed", 0.0)


# Remark ---------------------------------------------------------------------------------------------------------------


def test_a_run_says_what_rests_on_a_hypothesis() -> None:
    result = CliRunner().invoke(cli, ["run", "b218"])
    words = " ".join(result.stdout.split())
    assert "axial displacement is 14.76 to 32.29 µm (here 14.76) and the axial stiffness is 289.2 to 651 N/µm" in words
    assert "qsbearing explain FILE" in words
    found = json.loads(CliRunner().invoke(cli, ["run", "b218", "--json"]).stdout)["remarks"]
    (values,) = (each["values"] for each in found if each["code"] == "hypotheses_differ")
    assert values["displacement_most"] == pytest.approx(32.2904, rel=1e-5)


def test_page_one_of_a_report_says_it() -> None:
    whole = document(qs.solve(SCENE), SCENE, "", "qsbearing report b218")
    assert "the hypothesis of raceway control and moment shares (any other instead)" in str(whole.head)
    said = str(next(section for section, _ in whole.walk() if section.title == "Remarks"))
    assert "Raceway control is a hypothesis. By all hypotheses that have a solution, the axial displ" in said


def test_a_pair_says_it_of_its_shaft() -> None:
    of = pair("DB", 720.0, speed=20_000 * qs.rpm, axial_load=300.0)
    solution = qs.solve_set(of)
    (said,) = remarked(solution)
    assert said.of.rows == ()
    every = [each for each in (qs.solve_set(under(of, *each)) for each in EVERY) if each.converged]
    for name, moved in (("displacement", "axial_um"), ("stiffness", "radial_y_N_per_um")):
        given = said.values[f"{name}_least"], said.values[f"{name}_most"]
        assert given == pytest.approx(ends(every, moved), rel=1e-9)


def test_of_several_cases_those_that_it_concerns_are_counted() -> None:
    of = turning(np.array([0.0, 500.0, 10_000.0]), axial_load=17_800.0)
    (said,) = remarked(qs.solve(of))
    assert (said.of.cases.count, said.of.cases.first) == (1, (2,))
    assert remarked(qs.solve(of), 1) == []


def test_where_displacements_are_held_the_stiffness_alone_is_named() -> None:
    (said,) = remarked(qs.solve(turning(15_000.0, axial_displacement=30e-6)))
    assert "displacement" not in said.text
    assert "stiffness is" in said.text


def test_below_the_speed_at_which_it_matters_nothing_is_solved_again(monkeypatch: pytest.MonkeyPatch) -> None:
    solution = qs.solve(turning(300.0, axial_load=17_800.0))
    monkeypatch.setattr(solution, "_solve_alike", lambda of: pytest.fail("solved again"))
    assert list(hypotheses(CaseRange(solution, slice(0, 1)))) == []


def test_below_the_threshold_of_inertia_no_hypothesis_matters() -> None:
    """Random bearings, loads and speeds with |2 Mg/(D Q)| just below it, each by all hypotheses."""
    rng, count = np.random.default_rng(5), 400
    ball = rng.uniform(5.0, 30.0, count) * qs.mm
    grooves = [rng.uniform(0.51, 0.54, count) * ball for _ in range(2)]
    pitch, angle = ball * rng.uniform(4.0, 9.0, count), rng.uniform(12.0, 42.0, count) * qs.deg
    bearing = qs.BallBearing(11, ball, pitch, *grooves, angle)
    thrust = 11.0 * (ball / qs.mm) ** 2 * 10.0 ** rng.uniform(-2.0, 0.7, count)
    loads = {"axial_load": thrust, "radial_load_y": thrust * rng.choice([0.0, 0.3, 0.8], count), "tilt_y": 0.0}
    speed = 10.0 ** rng.uniform(3.5, 5.5, count) / (pitch / qs.mm) * qs.rpm
    of = under(qs.Scene(bearing, qs.Operation(speed=speed, tilt_z=0.0, **loads)), *EVERY[0])
    own = qs.solve(of)
    slow = np.asarray(next(e for e in EFFECTS if e.name == "gyroscopic_moment").indicator(own.operating_point))
    slow = (slow < WORTH_A_SOLVE) & np.asarray(own.converged)
    assert slow.sum() > 100
    for each in EVERY[1:]:
        other = qs.solve(under(of, *each))
        changes = by_quantity(other, own)
        for name in ("displacement", "stiffness"):
            assert changes[name][slow & np.asarray(other.converged)].max() < WORTH_A_WARNING, (each, name)
