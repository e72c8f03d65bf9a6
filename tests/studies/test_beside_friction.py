"""Effects that balls moved by friction do not know: judged by what they change under outer control, and said so."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.model.effects import EFFECTS
from qsbearing.model.effects.elastic_rings import ENTRY as ELASTIC_RINGS
from qsbearing.model.effects.hertz_angle import ENTRY as HERTZ_ANGLE
from qsbearing.model.effects.hypotheses import under_control
from qsbearing.model.effects.orbit_radius import ENTRY as ORBIT_RADIUS
from qsbearing.model.solution.changes import changes, is_unknown_to_friction
from qsbearing.model.solution.comparison import by_quantity
from qsbearing.model.solution.limit import Standing
from qsbearing.model.validation import SceneError
from qsbearing.remarks.of_solution import every_remark
from qsbearing.results.readings_record import all_taken
from qsbearing.results.requirements import required_answers
from qsbearing.results.whole import whole_record
from qsbearing.studies.chooser.explain import explain
from tests.files.test_traction import HELD, tables

RADIAL = {"radial_load_y_N": 3000.0, **HELD}


def scene(**more: Any) -> qs.Scene:
    of = scene_of(tables({"friction_coefficient": 0.07}, **more), "a file")
    assert isinstance(of, qs.Scene)
    return of


def solved_twice(of: qs.Scene) -> list[tuple[qs.Solution, qs.Solution]]:
    """Under outer control: without elastic rings, and with each that is assumed."""
    under = under_control(of, qs.RacewayControl.OUTER)
    without = qs.solve(under)
    return [(without, qs.solve(each.of)) for each in ELASTIC_RINGS.assume(under, [without.operating_point])]


@pytest.mark.parametrize("load", [{}, RADIAL], ids=["thrust", "radial"])
def test_a_remark_says_what_bending_rings_change_under_outer_control(load: dict[str, Any]) -> None:
    of = scene(**load)
    solution = qs.solve(of)
    (said,) = (each for each in every_remark(solution, {}) if each.code == "effect_unknown_to_friction")
    by = [by_quantity(*each)[said.values["quantity"]] for each in solved_twice(of)]
    assert said.values["effect"] == "elastic_rings" and len(by) == 2
    np.testing.assert_allclose(said.values["changes"], by, rtol=1e-9)
    text = str(said.said())
    assert "under outer control" in text and "give" not in text
    found = changes(ELASTIC_RINGS, solution)
    for each, (without, with_it) in zip(found, solved_twice(of), strict=True):
        shift = with_it.displacement - without.displacement
        np.testing.assert_allclose(each.displacement - solution.displacement, shift, rtol=1e-6, atol=1e-13)
        ratio = np.diagonal(with_it.stiffness)[:3] / np.diagonal(without.stiffness)[:3]
        np.testing.assert_allclose(each.stiffness[:3] / np.diagonal(solution.stiffness)[:3], ratio, rtol=1e-9)


def test_explain_says_so_and_gives_no_line_that_is_refused() -> None:
    of = scene(**RADIAL)
    rows = {each.effect: each for each in explain(of, 0.01)[1]}
    unknown = {"elastic_rings", "hertz_angle", "orbit_radius", "seats_out_of_round", "unequal_balls"}
    assert {name for name, each in rows.items() if each.under_control} == unknown
    for name in unknown:
        assert rows[name].under_control == "outer" and not rows[name].add and not rows[name].needs
    rings = rows["elastic_rings"]
    assert rings.verdict == "likely needed, data missing" and "under outer control" in rings.why
    largest = max(by_quantity(*each)["stiffness"] for each in solved_twice(of))
    assert rings.size("stiffness") == pytest.approx(float(largest), rel=1e-9)
    outer = under_control(of, qs.RacewayControl.OUTER)
    for name, choice in (("hertz_angle", {"hertz_angle": "actual"}), ("orbit_radius", {"orbit_radius": "displaced"})):
        actual = by_quantity(qs.solve(outer), qs.solve(replace(outer, **choice)))
        assert rows[name].actual == {key: pytest.approx(float(x), rel=1e-9) for key, x in actual.items()}
    thrust = {each.effect: each for each in explain(scene(), 0.01)[1]}
    assert thrust["orbit_radius"].under_control == "" and thrust["orbit_radius"].add, "friction knows it under thrust"


def test_chosen_effects_leave_none_of_them_unsaid() -> None:
    """Nor are they chosen: the scene would be refused."""
    solution = qs.solve(scene(**RADIAL), effects="auto")
    assert solution.choice is not None and solution.friction is not None
    assert not {"elastic_rings", "hertz_angle", "orbit_radius"} & {*solution.choice.added, *solution.choice.effects}
    said = [each.values["effect"] for each in every_remark(solution, {}) if each.code == "effect_unknown_to_friction"]
    assert said == ["elastic_rings"]


def test_what_is_refused_beside_friction_is_what_is_said_not_to_go_with_it() -> None:
    solution = qs.solve(scene(**RADIAL))
    outer = under_control(solution.scene, qs.RacewayControl.OUTER)
    unknown = {each.name for each in EFFECTS if is_unknown_to_friction(each, solution)}
    made = {
        "unequal_balls": {"ring_effects": (qs.BallDiameterDeviations(np.full(16, 1e-6)),)},
        "seats_out_of_round": {"ring_effects": (qs.SeatsOutOfRound(outer_two_lobe_amplitude=1e-6),)},
        "elastic_rings": {"ring_effects": ELASTIC_RINGS.assume(outer, [solution.operating_point])[0].of.ring_effects},
        "hertz_angle": {"hertz_angle": "actual"},
        "orbit_radius": {"orbit_radius": "displaced"},
    }
    assert set(made) == unknown
    for changed in made.values():
        assert qs.solve(replace(outer, **changed)).converged
        with pytest.raises(SceneError):
            replace(solution.scene, **changed)


def test_cases_of_a_law_are_told_each() -> None:
    """The solution under outer control has no axis of friction coefficients."""
    of = replace(scene(), traction=qs.Traction(np.array([0.03, 0.07, 0.1])))
    solution = qs.solve(of)
    (_, free) = changes(ELASTIC_RINGS, solution)
    assert free.displacement is not None and free.displacement.shape == (3, 5)
    assert all(each.shape == (3,) for each in (*free.errors.values(), free.is_solved))
    shift = free.displacement - solution.displacement
    np.testing.assert_allclose(shift, np.broadcast_to(shift[0], shift.shape), rtol=1e-9)


def test_a_requirement_is_open_that_bending_rings_would_not_meet() -> None:
    """333 N/um by friction; a free outer ring takes a tenth under outer control."""
    (without, with_it) = solved_twice(scene())[1]
    by_proportion = qs.solve(scene()).stiffness[0, 0] * with_it.stiffness[0, 0] / without.stiffness[0, 0] / 1e6
    for least, state in ((290.0, Standing.MET), (300.0, Standing.OPEN), (340.0, Standing.NOT_MET)):
        document = tables({"friction_coefficient": 0.07}) | {"require": {"locked_stiffness_axial": f">= {least:g}"}}
        solution = qs.solve(scene_of(document, "a file"))
        (answer,) = required_answers(solution, all_taken(solution))
        assert answer.state is state and answer.value == pytest.approx(333.0, abs=0.5)
        if state is Standing.OPEN:
            assert answer.reason is not None
            assert answer.reason.values["found"] == pytest.approx(by_proportion, rel=1e-9)
            text = whole_record(solution, all_taken(solution))["requirements"][0]["text"]
            assert text.endswith(f"it would be {by_proportion:.4g} N/µm by its change under outer control")


def test_a_required_displacement_is_moved_by_as_much() -> None:
    (without, with_it) = solved_twice(scene())[1]
    more = with_it.displacement[0] - without.displacement[0]
    found = qs.solve(scene()).displacement[0] + more
    for part, state in ((0.999, Standing.OPEN), (1.001, Standing.MET)):
        document = tables({"friction_coefficient": 0.07})
        document["require"] = {"displacement_axial_um": f"<= {float(part * found / qs.um)!r}"}
        solution = qs.solve(scene_of(document, "a file"))
        (answer,) = required_answers(solution, all_taken(solution))
        assert answer.state is state


def test_a_choice_not_worth_a_remark_counts_where_little_is_to_spare() -> None:
    """The actual angle in Hertz's formulas, which friction does not know."""
    of = scene(**RADIAL)
    outer = qs.solve(under_control(of, qs.RacewayControl.OUTER))
    actual = qs.solve(replace(outer.scene, hertz_angle="actual"))
    friction = qs.solve(of)
    ratio = actual.inner.max_pressure.max() / outer.inner.max_pressure.max()
    value = friction.inner.max_pressure.max() / qs.MPa
    assert 1e-4 < abs(ratio - 1.0) < 0.02
    assert changes(HERTZ_ANGLE, friction)[0].against is not None and changes(ORBIT_RADIUS, friction)
    document = tables({"friction_coefficient": 0.07}, **RADIAL)
    sense, bound = ("<=" if ratio > 1.0 else ">="), float(value * 0.5 * (1.0 + ratio))
    document["require"] = {"inner_max_pressure_max_MPa": f"{sense} {bound!r}"}
    solution = qs.solve(scene_of(document, "a file"))
    (answer,) = required_answers(solution, all_taken(solution))
    assert answer.state is Standing.OPEN
