"""Numbers of data sheets that tell more than ratings do, and what bounds the lists."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from fem_check.book.published import gmn_rows
from qsbearing.inference.ball_passes import with_ball_set
from qsbearing.inference.data_sheet import DataSheet, RigidityKind
from qsbearing.inference.rigidity import pair_rigidity
from tests.inference.data_sheets import deep_groove, gmn, sheet, snfa
from tests.inference.test_infer_bearing import sets


def numbers(fields: dict[str, Any]) -> dict[str, Any]:
    """Without the ratings."""
    return {key: value for key, value in fields.items() if not key.endswith("_rating")}


SIZE_6205 = numbers(deep_groove(25, 52, 1, 1))


def refused(**fields: Any) -> str:
    with pytest.raises(qs.SceneError) as caught:
        qs.infer_bearing(**fields)
    return str(caught.value)


def test_ball_passes_tell_the_set_without_ratings() -> None:
    """SKF 6205: 9 balls of 7.938 mm on 39.04 mm, where (25 + 52)/2 is 38.5."""
    found = qs.infer_bearing(**SIZE_6205, outer_ball_pass=3.585, inner_ball_pass=5.415)
    assert sets(found) == [(9, 7.94)]
    assert np.asarray(found.bearing.pitch_diameter) == pytest.approx(39.04e-3, abs=0.01e-3)
    f = found.bearing.inner_groove_radius / found.bearing.ball_diameter
    assert f.min() == pytest.approx(0.515) and f.max() == pytest.approx(0.525), "which they do not tell"


def test_ball_passes_tell_every_printed_set() -> None:
    """Rounded to three decimals."""
    known = [each for series in (gmn(gmn_rows(), "S "), *snfa().values()) for each in series]
    wrong = []
    for each in known:
        d, D = each.sheet["bore_diameter"], each.sheet["outside_diameter"]
        angle = each.sheet["free_contact_angle"]
        g = each.ball_diameter * np.cos(angle) / (0.5 * (d + D))
        passes = [round(0.5 * each.ball_count * (1.0 + sign * g), 3) for sign in (-1, 1)]
        bearing = DataSheet(**numbers(each.sheet), outer_ball_pass=passes[0], inner_ball_pass=passes[1])
        told = with_ball_set(bearing, [])
        assert told.ball_count == each.ball_count
        wrong += [each.name] * (abs(told.ball_diameter / each.ball_diameter - 1.0) > 0.001)  # type: ignore[operator]
    assert len(known) > 240 and not wrong


def test_a_ball_spin_may_be_printed_twice() -> None:
    passes = {"outer_ball_pass": 3.578, "inner_ball_pass": 5.422}
    said = [str(each) for each in qs.infer_bearing(**SIZE_6205, **passes, ball_spin=4.677).remarks]
    assert any("twice" in each and "2.338" in each for each in said)
    assert not any("twice" in each for each in qs.infer_bearing(**SIZE_6205, **passes, ball_spin=2.338).remarks)
    assert "ball_spin" in refused(**SIZE_6205, **passes, ball_spin=2.5)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"outer_ball_pass": 3.6, "inner_ball_pass": 5.415}, "not a whole number"),
        ({"outer_ball_pass": 5.415, "inner_ball_pass": 3.585}, "exchanged"),
        ({"outer_ball_pass": 3.585}, "bearing.inner_ball_pass: missing"),
        (
            {"outer_ball_pass": 2.5, "inner_ball_pass": 4.5, "bore_diameter": 2e-3, "outside_diameter": 5e-3},
            "no usual size",
        ),
        ({"outer_ball_pass": 3.585, "inner_ball_pass": 5.415, "ball_count": 8}, "9 balls"),
        (
            {"outer_ball_pass": 3.585, "inner_ball_pass": 5.415, "ball_diameter": 7.9e-3, "pitch_diameter": 38e-3},
            "38.8",
        ),
    ],
)
def test_ball_passes_of_no_bearing_are_refused(wrong: dict[str, float], said: str) -> None:
    assert said in refused(**SIZE_6205 | wrong)


def test_known_balls_need_no_ratings() -> None:
    given = qs.infer_bearing(**SIZE_6205, ball_count=9, ball_diameter=7.938e-3)
    assert sets(given) == [(9, 7.94)]
    said = refused(**SIZE_6205, ball_count=9)
    assert "dynamic_load_rating" in said and "static_load_rating" in said


def test_a_printed_rigidity_has_a_kind() -> None:
    """SNFA VEB 50, 25 degrees, prints the unloading rigidity: f = 0.5485, where a tangent asks for another."""
    known = next(each for each in snfa()["VEB", 25] if each.name == "VEB 50")
    fields = known.sheet | {"dynamic_rating_factor": 0.68, "static_rating_factor": 0.61, "maker": "SNFA"}
    fields |= {"ball_count": 21, "pair_rigidity": 132 * qs.N / qs.um, "pair_preload": 330.0}

    def f(**more: Any) -> float:
        best = qs.infer_bearing(**fields, **more).at(0)
        return float(best.inner_groove_radius / best.ball_diameter)

    assert f() == pytest.approx(0.5485, abs=0.0008)
    assert f(pair_rigidity_kind="unloading") == f()
    assert f(pair_rigidity_kind="tangent") > 0.555


def test_the_unloading_rigidity_of_hertz_at_a_constant_angle() -> None:
    """2.83 preloads over the deflection for 3 as a tangent; at 60 degrees the angle hardly changes."""
    f = 0.52 * 8e-3
    bearing = qs.BallBearing(20, 8e-3, 0.06, f, f, np.radians(60.0))
    both = [pair_rigidity(bearing, 100.0, kind) for kind in (RigidityKind.UNLOADING, RigidityKind.TANGENT)]
    assert both[0] / both[1] == pytest.approx(2.0 * np.sqrt(2.0) / 3.0, rel=0.01)


def test_thin_deep_groove_bearings_may_have_balls_in_millimetres() -> None:
    assert (13, 3.5) in sets(qs.infer_bearing(**deep_groove(20, 32, 4000, 2470, maker="NSK")))
    inch = refused(**deep_groove(20, 32, 4000, 2470, maker="NSK", size_steps="inch"))
    assert "Nearest is 13 x 3.5 mm" in inch and "this size in millimetres is not looked at" in inch


def test_thin_spindle_bearings_have_balls_in_inches() -> None:
    """GMN 61806 C."""
    found = sets(qs.infer_bearing(**sheet(30, 42, 15, 3850, 3250, maker="GMN")))
    assert (22, 3.17) in found or (22, 3.18) in found
    assert all(np.isclose(diameter / 25.4 * 64 % 1, (0, 1), atol=0.02).any() for _, diameter in found)


@pytest.mark.parametrize(
    ("fields", "known"),
    [
        (sheet(50, 110, 40, 68900, 47500, maker="SKF"), (12, 19.05)),  # 7310 BEP
        (sheet(40, 90, 40, 50000, 32500, maker="SKF"), (13, 15.08)),  # 7308 BEGAPH
        (deep_groove(40, 80, 32500, 17800, maker="NTN", f0=14.0), (9, 11.91)),  # 6208
        (deep_groove(40, 80, 32500, 17800, maker="NTN", f0=14.0), (8, 12.7)),
    ],
)
def test_raised_ratings_and_full_fills_are_in_the_list(fields: dict[str, Any], known: tuple[int, float]) -> None:
    assert known in sets(qs.infer_bearing(**fields))


def test_ratings_that_leave_two_sets_list_both() -> None:
    assert len(sets(qs.infer_bearing(**sheet(40, 80, 40, 36500, 26000, maker="SKF")))) >= 2  # 7208 BEP


def test_a_refusal_names_the_nearest_set_and_what_excludes_it() -> None:
    said = refused(**deep_groove(50, 110, 62000, 38500, maker="NSK", f0=13.2))  # NSK 6310
    assert "Nearest is" in said and "of computed, fill" in said
    light = refused(**sheet(110, 170, 17, 70000, 55000, maker="GMN"))  # SM 6022 C
    assert "Nearest is 14 x 19.05 mm" in light


def test_rings_without_room_for_a_usual_ball_are_said_in_one_sentence() -> None:
    found = refused(**sheet(0.3, 0.5, 15, 100, 50, rating_practice="iso"))
    assert found.count("bearing.") == 1 and "no usual ball fits" in found
    small = refused(**sheet(1.055, 2.8015, 50.62, 230.84, 221.81, rating_practice="iso"))
    assert small.count("\n") <= 1 and "no ball set" in small


def test_random_data_sheets_give_lists_or_one_sentence() -> None:
    random = np.random.default_rng(4)
    lists = 0
    for _ in range(60):
        bore, share, angle = random.uniform(1.0, 200.0), random.uniform(1.1, 3.0), random.uniform(5.0, 60.0)
        dynamic = 30.0 * bore ** random.uniform(1.0, 2.0)
        fields = sheet(bore, bore * share, angle, dynamic, dynamic * random.uniform(0.4, 1.4), rating_practice="iso")
        try:
            qs.infer_bearing(**fields)
            lists += 1
        except qs.SceneError as error:
            assert [each.field for each in error.errors] in (
                ["bearing.static_load_rating"], ["bearing.outside_diameter"]
            ), str(error)  # fmt: skip
    assert lists < 60
