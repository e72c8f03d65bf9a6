"""How near balls are to slipping: closed forms by hand, limits, and what is said beyond them."""

from __future__ import annotations

import copy
import tomllib
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.readings import ball_slip, friction
from qsbearing.readings.asked import take_asked
from qsbearing.readings.lubricant import RANGES
from qsbearing.remarks.remark import told
from qsbearing.results.readings_record import all_taken
from qsbearing.results.remarks import every_remark
from qsbearing.studies.chooser.choose_set import solve_any
from tests.qsbearing.scenes import solved, turning

OIL = {"drag_coefficient": 1.5, "least_oil_share": 0.02, "most_oil_share": 0.2}
B218 = turning(10e3, axial_load=17.8e3)


def codes(reading: Any) -> set[str]:
    return {said.code for said in told(reading.remarks, None)}


def test_the_gyroscopic_moment_by_hand() -> None:
    solution = solved(B218)
    found = ball_slip(solution, 0.07)
    moment, load = abs(solution.gyroscopic_moment[0]), solution.outer.load[0]
    radius = 0.5 * 22.225e-3
    assert found.outer.friction_used == pytest.approx(np.full(16, moment / radius / load / 0.07), rel=1e-12)
    assert not found.inner.friction_used.any()
    both = load + solution.inner.load[0]
    assert found.axis_moment_used == pytest.approx(moment / (0.07 * both * radius), rel=1e-12)
    assert found.least_drag_used is None
    assert found.maker_axial_load is None
    # No coefficient changes the solution: what is used goes with its inverse.
    assert ball_slip(solution, 0.14).axis_moment_used == pytest.approx(0.5 * found.axis_moment_used, rel=1e-12)


def test_drag_by_hand() -> None:
    solution = solved(B218)
    found = ball_slip(solution, 0.07, oil_density=900.0, **OIL)
    orbit, angles = solution.orbital_speed[0], (solution.inner.angle[0], solution.outer.angle[0])
    force = 0.5 * 1.5 * 900.0 * 0.25 * np.pi * 22.225e-3**2 * (orbit * 62.63e-3) ** 2
    held = 0.07 * (1.0 + np.cos(angles[0] - angles[1]))
    assert found.most_drag_used == pytest.approx(0.2 * force / (held * solution.inner.load[0]), rel=1e-10)
    assert found.least_drag_used == pytest.approx(0.1 * found.most_drag_used, rel=1e-12)
    assert found.least_axial_load == pytest.approx(16 * np.sin(angles[0]) * 0.2 * force / held, rel=1e-10)
    # The same force as in the reading of friction, at the same density.
    power = friction(solution, 0.07, drag_coefficient=1.5, fluid_density=180.0).drag_power[0]
    assert power == pytest.approx(0.2 * force * orbit * 62.63e-3, rel=1e-10)


def test_drag_grows_with_the_density_over_all_that_a_lubricant_may_have() -> None:
    least, most = RANGES["density"]
    thin, dense = (ball_slip(solved(B218), 0.07, oil_density=each, **OIL) for each in (least, most))
    assert dense.most_drag_used == pytest.approx(most / least * thin.most_drag_used, rel=1e-12)
    for each in (0.99 * least, 1.01 * most):
        with pytest.raises(qs.SceneError, match="oil_density"):
            ball_slip(solved(B218), 0.07, oil_density=each, **OIL)


def test_the_oil_is_that_of_the_lubricant() -> None:
    """At its temperature, 0.7 kg/m3 less per kelvin above 15 °C; the reading's own density goes before it."""
    share = {"drag_coefficient": 1.5, "least_oil_share": 0.02, "most_oil_share": 0.2, "friction_coefficient": 0.07}
    warm = {"iso_viscosity_grade": 32.0, "oil_temperature": 343.15}

    def used(lubricant: dict[str, float] | None, **own: float) -> float:
        readings = {"ball_slip": share | own} | ({"lubricant": lubricant} if lubricant else {})
        slip = take_asked(qs.solve(replace(solved(B218).scene, readings=readings)))["ball_slip"]
        return float(slip.most_drag_used)

    assert used(warm | {"oil_density": 900.0}) == pytest.approx((900.0 - 0.7 * 55.0) / 870.0 * used(None), rel=1e-12)
    assert used(warm) == pytest.approx((870.0 - 0.7 * 55.0) / 870.0 * used(None), rel=1e-12)
    assert used(warm, oil_density=900.0) == pytest.approx(900.0 / 870.0 * used(None), rel=1e-12)


def test_at_rest_nothing_is_used() -> None:
    found = ball_slip(solved(turning(0.0, axial_load=17.8e3)), 0.07, minimum_load_factor=50.0, **OIL)
    assert found.axis_moment_used == 0.0
    assert found.most_drag_used == 0.0
    assert found.maker_axial_load == 0.0
    assert not found.remarks


def test_without_the_moment_there_is_none() -> None:
    scene = replace(B218, ball_effects=(qs.CentrifugalForce(),))
    found = ball_slip(solved(scene), 0.07)
    assert found.axis_moment_used is None
    assert found.outer.friction_used is None


def test_makers_least_load_goes_with_the_square_of_speed() -> None:
    loads = [ball_slip(solved(turning(n, axial_load=17.8e3)), 0.07, minimum_load_factor=50.0) for n in (5e3, 10e3)]
    assert [each.maker_axial_load for each in loads] == pytest.approx([1250.0, 5000.0])
    assert loads[1].maker_load_used == pytest.approx(5000.0 / 17.8e3)


@pytest.mark.parametrize(
    ("load", "mu", "more", "code"),
    [
        (17.8e3, 0.03, {}, "axis_not_held"),
        (2e3, 0.05, OIL | {"least_oil_share": 0.5, "most_oil_share": 1.0}, "balls_skid"),
        (2e3, 0.05, OIL | {"least_oil_share": 0.001, "most_oil_share": 1.0}, "balls_may_skid"),
        (2e3, 0.05, {"minimum_load_factor": 50.0}, "least_load_missed"),
    ],
)
def test_what_is_beyond_its_limit_is_said(load, mu, more, code) -> None:  # type: ignore[no-untyped-def]
    found = ball_slip(solved(turning(10e3, axial_load=load)), mu, **more)
    assert code in codes(found)
    assert code not in codes(ball_slip(solved(turning(1e3, axial_load=17.8e3)), 0.1, **more))


def document(**operation: float) -> dict[str, Any]:
    """Of B218 at 10,000 rpm, a file's tables."""
    effects = {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"}
    return {"bearing": {"name": "B218"}, "operation": {"speed_rpm": 10e3} | operation, "effects": effects}


def made(of: dict[str, Any]) -> Any:
    return scene_or_set_of(copy.deepcopy(of), "", "")


def said_of(of: dict[str, Any]) -> dict[str, str]:
    """The remarks of a scene or set with their sentences, by their codes."""
    solution = solve_any(made(of))
    return {each.code: each.said() for each in every_remark(solution, all_taken(solution))}


HELD_TILTS = {"tilt_y_mrad": 0.0, "tilt_z_mrad": 0.0}
SLIPPING = [
    ({"axial_load_N": 8e3}, {"readings": {"ball_slip": {"friction_coefficient": 0.05}}}, {}, "axis_not_held"),
    ({"axial_load_N": 17.8e3}, {}, {"raceway_control": "inner"}, "friction_beyond"),
    ({"axial_load_N": 17.8e3}, {"readings": {"friction": {"friction_coefficient": 0.07}}}, {}, "friction_may_be_low"),
    ({"axial_load_N": 8e3}, {}, {"friction_coefficient": 0.05}, "balls_slip"),
]


@pytest.mark.parametrize(("load", "more", "effects", "code"), SLIPPING, ids=lambda each: str(each))
def test_slip_names_the_line_that_solves_for_it(load: Any, more: Any, effects: Any, code: str) -> None:
    """Which is taken where it is written in place of the hypothesis, and of the coefficient that bounds it."""
    line, of = 'raceway_control = "friction"', document(**load) | more
    assert line in said_of(of | {"effects": of["effects"] | effects})[code]
    assert solve_any(made(of | {"effects": of["effects"] | tomllib.loads(line)})).friction is not None


def test_slip_names_no_line_that_would_be_refused() -> None:
    """Free tilts under radial load, rows of a set, another coefficient of the reading."""
    slip = {"readings": {"ball_slip": {"friction_coefficient": 0.05}}}
    held = document(axial_load_N=8e3, radial_load_y_N=500.0, **HELD_TILTS) | slip
    free = document(axial_load_N=8e3, radial_load_y_N=500.0, moment_z_Nm=0.0) | slip
    assert "friction" in said_of(held)["axis_not_held"].partition("raceway_control")[2]
    assert "raceway_control =" not in said_of(free)["axis_not_held"]
    other = document(axial_load_N=8e3) | {"readings": {"friction": {"friction_coefficient": 0.05}}}
    assert "raceway_control =" not in said_of(other)["friction_given_exceeded"]
    pair = document(axial_load_N=8e3) | {"rows": [{"position_mm": 30.0 * k, "carries": "+x"} for k in (0, 1)]}
    pair["readings"] = {"ball_slip": {"friction_coefficient": 0.02}}
    assert "raceway_control =" not in said_of(pair)["axis_not_held"]


def test_the_moment_is_larger_than_what_friction_holds() -> None:
    said = said_of(document(axial_load_N=8e3) | {"readings": {"ball_slip": {"friction_coefficient": 0.05}}})
    assert "larger than what the friction of both contacts" in said["axis_not_held"]


def test_friction_of_contacts_says_when_it_may_be_too_low() -> None:
    """B218 needs 0.069 at its outer contacts."""
    needed = solved(B218).outer.required_friction[0]
    said = [codes(friction(solved(B218), times * needed)) for times in (0.95, 1.05, 1.95, 2.05)]
    assert [("friction_may_be_low" in each, "friction_given_exceeded" in each) for each in said] == [
        (False, True),
        (True, False),
        (True, False),
        (False, False),
    ]


def test_numbers_out_of_range_are_named_at_once() -> None:
    with pytest.raises(qs.SceneError) as error:
        ball_slip(solved(B218), 0.0, drag_coefficient=1.0, minimum_load_factor=-1.0)
    assert {each.field for each in error.value.errors} == {
        "friction_coefficient", "least_oil_share", "most_oil_share", "minimum_load_factor",
    }  # fmt: skip
    with pytest.raises(qs.SceneError, match="above most_oil_share"):
        ball_slip(solved(B218), 0.07, drag_coefficient=1.0, least_oil_share=0.3, most_oil_share=0.2)


def test_many_cases_are_those_one_by_one() -> None:
    speeds = np.array([3e3, 10e3])
    oil = OIL | {"most_oil_share": np.array([0.2, 0.3])}
    both = ball_slip(solved(turning(speeds, axial_load=17.8e3)), np.array([0.05, 0.07]), **oil)  # type: ignore[arg-type]
    for k, speed in enumerate(speeds):
        alone = OIL | {"most_oil_share": (0.2, 0.3)[k]}
        one = ball_slip(solved(turning(speed, axial_load=17.8e3)), (0.05, 0.07)[k], **alone)
        assert both.most_drag_used[k] == pytest.approx(one.most_drag_used, rel=1e-9)
        assert both.axis_moment_used[k] == pytest.approx(one.axis_moment_used, rel=1e-9)
