"""Shims of arched grooves: the geometry of two arcs by construction, and what is no four-point bearing, all at once."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import qsbearing as qs
from tests.qsbearing.scenes import B218, QJ

D = 22.225e-3
FIELDS: dict[str, Any] = {
    "ball_count": 16, "ball_diameter": D, "pitch_diameter": 125.26e-3, "inner_groove_radius": 0.52 * D,
    "outer_groove_radius": 0.53 * D, "free_contact_angle": 35 * qs.deg, "kind": "four_point",
}  # fmt: skip


def test_one_resting_angle_by_the_axial_clearance() -> None:
    """The bearing of the note: 30.4 degrees, shims of 0.450 mm."""
    assert QJ.kind is qs.BearingKind.FOUR_POINT and QJ.is_arched and not B218.is_arched
    assert QJ.inner_shim == pytest.approx(0.450e-3, abs=5e-7) and QJ.outer_shim == QJ.inner_shim
    for side in ("inner", "outer"):
        angle = QJ.resting_angle(side)
        assert angle is not None and np.degrees(angle) == pytest.approx(30.4, abs=0.02)
    assert QJ.axial_clearance == pytest.approx(120e-6, rel=1e-12)
    assert B218.axial_clearance is None and B218.resting_angle("inner") is None and B218.apex_angle("outer") is None


def gaps(bearing: qs.BallBearing, along: float, across: float, ball: tuple[float, float]) -> list[float]:
    """By how far a ball stands off each arc, of rings that far apart from the middle, by the distance of its centre.

    Groove centres stand half a shim to either side of each ring's middle. They are apart radially as far as a ball
    on one arc of each ring, diagonally, at the free contact angle needs.
    """
    inner_length, outer_length = bearing.arc_length("inner"), bearing.arc_length("outer")
    apart = float((inner_length + outer_length) * np.cos(np.asarray(bearing.free_contact_angle)))
    found = []
    for sign in (1.0, -1.0):
        for length, shim, at, side in (
            (inner_length, bearing.inner_shim, (along, apart + across), 1.0),
            (outer_length, bearing.outer_shim, (0.0, 0.0), -1.0),
        ):
            centre = at[0] + sign * side * 0.5 * (0.0 if shim is None else float(np.asarray(shim)))
            found.append(float(length) - float(np.hypot(ball[0] - centre, ball[1] - at[1])))
    return found


def play(bearing: qs.BallBearing, direction: tuple[float, float]) -> float:
    """How far the inner ring goes this way from the middle until no place of the ball is free of all arcs."""
    apart = float((bearing.arc_length("inner") + bearing.arc_length("outer")) * np.cos(0.610865238))
    x, z = np.meshgrid(np.linspace(-6e-4, 6e-4, 1201), np.linspace(0.3 * apart, 1.0 * apart, 701))

    def room(step: float) -> float:
        least = [np.inf * np.ones_like(x)]
        inner, outer = bearing.arc_length("inner"), bearing.arc_length("outer")
        for sign in (1.0, -1.0):
            own = sign * 0.5 * np.asarray(bearing.inner_shim if bearing.inner_shim is not None else 0.0)
            other = -sign * 0.5 * np.asarray(bearing.outer_shim if bearing.outer_shim is not None else 0.0)
            at = step * direction[0] + own, apart + step * direction[1]
            least.append(inner - np.hypot(x - at[0], z - at[1]))
            least.append(outer - np.hypot(x - other, z))
        return float(np.min(least, axis=0).max())

    return float(brentq(room, 0.0, 7e-4, xtol=1e-9))


def test_clearances_are_how_far_rings_move_till_a_ball_has_no_place() -> None:
    """Searched over places of the ball on a grid of a micrometre, of rings with unlike shims."""
    for shims in ({"inner_shim": 0.44e-3, "outer_shim": 0.62e-3}, {"inner_shim": 0.2e-3, "outer_shim": 0.1e-3}):
        bearing = qs.BallBearing(**FIELDS, **shims)
        to_either_side = play(bearing, (1.0, 0.0))
        assert bearing.axial_clearance is not None
        assert 2.0 * to_either_side == pytest.approx(float(bearing.axial_clearance), abs=4e-6)
        outward = play(bearing, (0.0, 1.0))
        assert 2.0 * outward == pytest.approx(float(bearing.diametral_clearance), abs=6e-6)


def test_the_ratio_of_clearances_is_that_which_makers_print() -> None:
    """Pd/Pa goes to tan(alpha0), 0.700 at 35 degrees."""
    small = qs.BallBearing.from_axial_clearance(axial_clearance=1e-7, **FIELDS)
    assert small.axial_clearance is not None
    assert small.diametral_clearance / small.axial_clearance == pytest.approx(np.tan(35 * qs.deg), rel=1e-3)
    assert np.tan(35 * qs.deg) == pytest.approx(0.700, abs=5e-4)


def test_a_ball_touches_where_the_clearance_says() -> None:
    """On the diagonal at the free contact angle, with the inner ring moved half the clearance; the others stand off."""
    assert QJ.axial_clearance is not None and QJ.outer_shim is not None
    length, alpha = float(QJ.arc_length("outer")), 35 * qs.deg
    ball = -0.5 * float(np.asarray(QJ.outer_shim)) + length * np.sin(alpha), length * np.cos(alpha)
    inner, outer, other_inner, other_outer = gaps(QJ, 0.5 * float(QJ.axial_clearance), 0.0, ball)
    assert abs(inner) < 1e-15 and abs(outer) < 1e-15
    assert other_inner > 1e-5 and other_outer > 1e-5


def errors_of(make: Any, **fields: Any) -> list[tuple[str, str]]:
    with pytest.raises(qs.SceneError) as caught:
        make(**fields)
    return [(each.field.removeprefix("bearing."), str(each)) for each in caught.value.errors]


@pytest.mark.parametrize(
    ("changed", "fields", "words"),
    [
        ({}, ["inner_shim"], "two arcs in the groove of one ring or of both"),
        ({"inner_shim": -1e-3}, ["inner_shim"], "negative"),
        ({"inner_shim": 0.9e-3}, ["inner_shim"], "more than 85 degrees"),
        ({"inner_shim": 0.45}, ["inner_shim"], "too large"),
        ({"inner_shim": "wide", "outer_shim": 9.0}, ["inner_shim", "outer_shim"], "not a number"),
        (
            {"inner_shim": 0.2e-3, "free_contact_angle": 0.0, "radial_interference": 1e-6},
            ["radial_interference"],
            "four-point bearing",
        ),
        ({"inner_shim": 0.2e-3, "ball_count": 0, "outer_shim": -1.0}, ["ball_count", "outer_shim"], "too small"),
        ({"kind": "deep_groove", "inner_shim": 1e-4, "outer_shim": 1e-4}, ["inner_shim", "outer_shim"], "two arcs"),
    ],
)  # fmt: skip
def test_what_is_no_four_point_bearing_is_refused_at_once(
    changed: dict[str, Any], fields: list[str], words: str
) -> None:
    found = errors_of(qs.BallBearing, **FIELDS | changed)
    assert [field for field, _ in found] == fields
    assert any(words in text for _, text in found)


def test_one_arched_ring_that_wedges_the_ball_is_refused() -> None:
    """Of the note: f 0.52, 30 degrees and 120 um of axial clearance by the inner shim alone: Pd = -205 um."""
    fields = FIELDS | {"outer_groove_radius": 0.52 * D, "free_contact_angle": 30 * qs.deg}
    shim = 2.0 * 0.04 * D * np.sin(30 * qs.deg) - 120e-6
    ((field, text),) = errors_of(qs.BallBearing, **fields, inner_shim=shim)
    assert field == "inner_shim" and "wedges the balls" in text and "-204.7 um" in text
    wide = qs.BallBearing(**fields, inner_shim=0.4e-3)
    assert wide.diametral_clearance > 0.0 and wide.outer_shim is None


def test_arrays_are_cases_and_the_first_wrong_one_is_named() -> None:
    many = qs.BallBearing.from_axial_clearance(axial_clearance=np.array([-2e-5, 0.0, 1e-4]), **FIELDS)
    np.testing.assert_allclose(many.axial_clearance, [-2e-5, 0.0, 1e-4], atol=1e-18)
    assert (np.sign(many.diametral_clearance) == [-1, 0, 1]).all() or many.diametral_clearance[1] < 1e-18
    ((field, text),) = errors_of(
        qs.BallBearing.from_axial_clearance, axial_clearance=np.array([1e-4, 5e-3, -5e-3]), **FIELDS
    )
    assert field == "axial_clearance" and "0.005 m" in text and "no room for a shim" in text


@pytest.mark.parametrize(
    ("changed", "fields"),
    [
        ({"kind": "deep_groove"}, ["axial_clearance"]),
        ({"inner_shim": 1e-4}, ["inner_shim"]),
        ({"inner_shim": 1e-4, "axial_clearance": 1.0}, ["inner_shim", "axial_clearance"]),
        ({"ball_count": 0.5, "axial_clearance": 1.0}, ["ball_count", "axial_clearance"]),
        ({"axial_clearance": "0.1 mm"}, ["axial_clearance"]),
    ],
)  # fmt: skip
def test_an_axial_clearance_is_refused_where_it_makes_no_shims(changed: dict[str, Any], fields: list[str]) -> None:
    found = errors_of(qs.BallBearing.from_axial_clearance, **FIELDS | {"axial_clearance": 1e-4} | changed)
    assert [field for field, _ in found] == fields


def test_a_diametral_clearance_makes_no_four_point_bearing() -> None:
    fields = {name: value for name, value in FIELDS.items() if name != "free_contact_angle"}
    found = errors_of(qs.BallBearing.from_diametral_clearance, diametral_clearance=1e-4, **fields, inner_shim=1e-4)
    assert [field for field, _ in found] == ["diametral_clearance"]


def test_ordinary_bearings_have_no_shims_and_their_clearance() -> None:
    assert B218.inner_shim is None and B218.outer_shim is None
    alike = replace(QJ, kind="deep_groove", inner_shim=None, outer_shim=None)
    room = 2.0 * alike.groove_centre_distance * (1.0 - np.cos(35 * qs.deg))
    assert alike.diametral_clearance == pytest.approx(float(room), rel=1e-12)
