"""Bearings, operations and scenes: derived lengths, and every error of an input named at once."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import fields, replace
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import qsbearing as qs
from tests.qsbearing.scenes import B218, BOTH, CENTRIFUGAL, OUTER, SPINDLE

B218_FIELDS = {field.name: getattr(B218, field.name) for field in fields(B218)}
OF_CLEARANCE = ("free_contact_angle", "radial_interference")
"""What follows from a clearance."""


def errors_of(make: Any, **arguments: Any) -> dict[str, qs.ErrorDetail]:
    """The errors of what cannot be made, by field."""
    with pytest.raises(qs.SceneError) as caught:
        make(**arguments)
    found = {error.field: error for error in caught.value.errors}
    assert len(found) == len(caught.value.errors)
    for error in caught.value.errors:
        assert str(error) in str(caught.value)
    return found


def bearing_errors(**changes: Any) -> dict[str, qs.ErrorDetail]:
    return errors_of(qs.BallBearing, **{**B218_FIELDS, **changes})


# ------------------------------------------------------------------------------------------------------ derived lengths


MICROMETRES = st.floats(-30.0, 30.0).map(lambda size: size * qs.um)
CHANGES = st.fixed_dictionaries(
    dict.fromkeys(("inner_groove_centre", "outer_groove_centre", "ball_diameter", "outer_groove_radius"), MICROMETRES)
)
TIGHT = replace(B218, free_contact_angle=10 * qs.deg)
"""Its clearance of 31 um is soon taken up."""


@given(CHANGES, CHANGES)
def test_changes_of_lengths_add_up(one: dict[str, float], other: dict[str, float]) -> None:
    """Two changes are one of their sum, also through a clearance below zero; and groove centres move as told."""
    both = {name: one[name] + other[name] for name in one}
    twice = TIGHT.with_changed_lengths(**one).with_changed_lengths(**other)
    once = TIGHT.with_changed_lengths(**both)
    for name in ("ball_diameter", "outer_groove_radius", "pitch_diameter", "inner_groove_centre_radius"):
        assert getattr(twice, name) == pytest.approx(getattr(once, name), rel=1e-13)
    assert twice.diametral_clearance == pytest.approx(once.diametral_clearance, rel=1e-9, abs=1e-15)
    for side in ("inner", "outer"):
        moved = getattr(once, f"{side}_groove_centre_radius") - getattr(TIGHT, f"{side}_groove_centre_radius")
        assert moved == pytest.approx(both[f"{side}_groove_centre"], abs=1e-15)
    assert (once.free_contact_angle == 0.0) == (once.diametral_clearance <= 0.0)


def test_lengths_of_b218() -> None:
    """Against the 218 bearing of Harris & Kotzalas: Pd 0.48 mm, and the formulas written out."""
    assert B218.groove_centre_distance == pytest.approx(1.0312e-3, rel=1e-12)
    # The literature's 0.4826 mm is 40.004 degrees with these groove radii.
    assert B218.diametral_clearance == pytest.approx(0.4826e-3, rel=3e-4)
    assert B218.diametral_clearance == pytest.approx(2 * 1.0312e-3 * (1 - np.cos(40 * qs.deg)), rel=1e-13)
    reach = (11.6281 - 22.225 / 2) * 1e-3
    assert B218.inner_groove_centre_radius == pytest.approx(62.63e-3 + reach * np.cos(40 * qs.deg), rel=1e-14)
    assert B218.ball_mass == pytest.approx(7800 * 4 / 3 * np.pi * (22.225e-3 / 2) ** 3, rel=1e-14)
    assert B218.ball_inertia == pytest.approx(0.4 * float(B218.ball_mass) * (22.225e-3 / 2) ** 2, rel=1e-14)
    assert B218.effective_modulus == pytest.approx(208e9 / (1 - 0.3**2), rel=1e-14)


def test_effective_modulus_of_unlike_materials() -> None:
    """2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2: between twice the softer and the mean of equals."""
    expected = 2.0 / ((1 - 0.26**2) / 315e9 + (1 - 0.3**2) / 208e9)
    assert SPINDLE.effective_modulus == pytest.approx(expected, rel=1e-14)
    assert 208e9 / (1 - 0.3**2) < SPINDLE.effective_modulus < 315e9 / (1 - 0.26**2)


@given(clearance=st.floats(0.0, 1.5e-3))
def test_clearance_and_angle_are_each_other(clearance: float) -> None:
    """Pd to angle and back: no digit lost at small clearances, where 1 - cos would cancel."""
    numbers = {name: value for name, value in B218_FIELDS.items() if name not in OF_CLEARANCE}
    bearing = qs.BallBearing.from_diametral_clearance(diametral_clearance=clearance, **numbers)
    assert bearing.diametral_clearance == pytest.approx(clearance, rel=1e-14, abs=1e-300)


@given(angle=st.floats(0.0, 84.0 * qs.deg))
def test_angle_and_clearance_are_each_other(angle: float) -> None:
    """The other way round; equal clearances make equal bearings."""
    numbers = {name: value for name, value in B218_FIELDS.items() if name not in OF_CLEARANCE}
    clearance = replace(B218, free_contact_angle=angle).diametral_clearance
    again = qs.BallBearing.from_diametral_clearance(diametral_clearance=clearance, **numbers)
    assert again.free_contact_angle == pytest.approx(angle, rel=1e-13, abs=1e-150)


@pytest.mark.parametrize("clearance", [-2e-3, 5e-3, float("nan")])
def test_clearance_of_no_bearing(clearance: float) -> None:
    """Further below zero than balls can be wedged, or wider than the grooves allow."""
    numbers = {name: value for name, value in B218_FIELDS.items() if name not in OF_CLEARANCE}
    with pytest.raises(qs.SceneError, match="diametral_clearance"):
        qs.BallBearing.from_diametral_clearance(diametral_clearance=clearance, **numbers)


def test_lengths_of_an_array_of_bearings() -> None:
    """Derived lengths follow the arrays."""
    diameters = np.array([20e-3, 22.225e-3])
    bearing = replace(B218, ball_diameter=diameters, free_contact_angle=np.array([[15.0], [40.0]]) * qs.deg)
    assert bearing.ball_mass.shape == (2,)
    assert bearing.inner_groove_centre_radius.shape == (2, 2)
    assert bearing.groove_centre_distance[1] == B218.groove_centre_distance


# -------------------------------------------------------------------------------------------------- errors of a bearing


@pytest.mark.parametrize(
    ("change", "slip"),
    [
        ({"ball_diameter": 22.225}, "millimetres"),
        ({"ball_diameter": 22225.0}, "micrometres"),
        ({"pitch_diameter": 125.26}, "millimetres"),
        ({"inner_groove_radius": 11.6281}, "millimetres"),
        ({"free_contact_angle": 40.0}, "degrees"),
        ({"ring_material": qs.Material(208.0, 0.3, 7800.0)}, "gigapascals"),
        ({"ring_material": qs.Material(2.08e5, 0.3, 7800.0)}, "megapascals"),
        ({"ball_material": qs.Material(208e9, 0.3, 7.8)}, "g/cm"),
        ({"ball_material": qs.Material(208e9, 0.3, 7.8e-6)}, "kg/mm"),
    ],
    ids=str,
)
def test_mistakes_of_unit_are_named(change: dict[str, Any], slip: str) -> None:
    """A number in the wrong unit is refused, and the unit it is likely in is said."""
    assert any(slip in error.cause for error in bearing_errors(**change).values())


@pytest.mark.parametrize(
    ("change", "field", "words"),
    [
        ({"ball_count": 0}, "bearing.ball_count", "too small"),
        ({"ball_count": 7.5}, "bearing.ball_count", "whole number"),
        ({"ball_count": 18}, "bearing.pitch_diameter", "do not fit"),
        ({"ball_diameter": -22e-3}, "bearing.ball_diameter", "negative"),
        ({"ball_diameter": float("nan")}, "bearing.ball_diameter", "not a finite number"),
        ({"ball_diameter": float("inf")}, "bearing.ball_diameter", "not a finite number"),
        ({"ball_diameter": "22.225 mm"}, "bearing.ball_diameter", "not a number"),
        ({"ball_diameter": True}, "bearing.ball_diameter", "not a number"),
        ({"ball_diameter": None}, "bearing.ball_diameter", "not a"),
        ({"ball_diameter": np.array([])}, "bearing.ball_diameter", "empty"),
        ({"inner_groove_radius": 11.1e-3}, "bearing.inner_groove_radius", "smaller than the ball"),
        ({"inner_groove_radius": 22.225e-3 / 2}, "bearing.inner_groove_radius", "smaller than the ball"),
        ({"outer_groove_radius": 23.3e-3}, "bearing.outer_groove_radius", "far larger"),
        ({"free_contact_angle": -0.1}, "bearing.free_contact_angle", "range"),
        ({"free_contact_angle": 1.5}, "bearing.free_contact_angle", "range"),
        ({"ball_material": qs.Material(208e9, 0.5, 7800.0)}, "bearing.ball_material.poisson_ratio", "too large"),
        ({"ring_material": qs.Material(-208e9, 0.3, 7800.0)}, "bearing.ring_material.elastic_modulus", "negative"),
    ],
    ids=str,
)
def test_each_error_of_a_bearing(change: dict[str, Any], field: str, words: str) -> None:
    """The field and what is wrong with it."""
    found = bearing_errors(**change)
    assert words in found[field].problem


def test_one_bad_entry_of_an_array() -> None:
    """The worst entry is shown, and the good ones are not complained of."""
    found = bearing_errors(ball_diameter=np.array([22.225e-3, 22.225, 22e-3]))
    assert set(found) == {"bearing.ball_diameter"}
    assert found["bearing.ball_diameter"].value == 22.225


def test_all_errors_of_a_bearing_at_once() -> None:
    """Six mistakes, six errors."""
    found = bearing_errors(
        ball_count=-3,
        ball_diameter="thick",
        pitch_diameter=125.26,
        inner_groove_radius=float("nan"),
        free_contact_angle=40.0,
        ring_material=qs.Material(208.0, 0.3, 7800.0),
    )
    assert set(found) == {
        "bearing.ball_count",
        "bearing.ball_diameter",
        "bearing.pitch_diameter",
        "bearing.inner_groove_radius",
        "bearing.free_contact_angle",
        "bearing.ring_material.elastic_modulus",
    }


def test_neighbouring_balls_just_fit() -> None:
    """Z balls touch on a pitch circle of D/sin(pi/Z): a hair more is a bearing, a hair less is none."""
    touching = 22.225e-3 / np.sin(np.pi / 16)
    replace(B218, pitch_diameter=touching * (1 + 1e-9))
    with pytest.raises(qs.SceneError, match="do not fit"):
        replace(B218, pitch_diameter=touching * (1 - 1e-9))


# ----------------------------------------------------------------------------------------------- errors of an operation


@pytest.mark.parametrize(
    ("load", "displacement"),
    [
        ("axial_load", "axial_displacement"),
        ("radial_load_y", "radial_displacement_y"),
        ("radial_load_z", "radial_displacement_z"),
        ("moment_y", "tilt_y"),
        ("moment_z", "tilt_z"),
    ],
)
def test_a_channel_has_its_load_or_its_displacement(load: str, displacement: str) -> None:
    """Both at once is an error, zeros included; either alone is not."""
    tilts = {} if "tilt" in displacement else {"moment_y": 0.0, "moment_z": 0.0}
    assert f"operation.{load}" in errors_of(qs.Operation, **tilts, **{load: 0.0, displacement: 0.0})
    qs.Operation(**tilts, **{load: 0.0})
    qs.Operation(**tilts, **{displacement: 0.0})


@pytest.mark.parametrize(
    ("radial", "moment", "tilt"),
    [
        ("radial_load_y", "moment_z", "tilt_z"),
        ("radial_load_z", "moment_y", "tilt_y"),
        ("radial_displacement_y", "moment_z", "tilt_z"),
        ("radial_displacement_z", "moment_y", "tilt_y"),
    ],
)
def test_a_radial_load_needs_the_tilt_that_answers(radial: str, moment: str, tilt: str) -> None:
    """Free or held must be said; a radial load of zero needs neither, the other tilt does not count."""
    value = 1e-5 if "displacement" in radial else 100.0
    error = errors_of(qs.Operation, **{radial: value})[f"operation.{moment}"]
    assert moment in error.cause
    assert tilt in error.cause
    other = "moment_y" if moment == "moment_z" else "moment_z"
    assert f"operation.{moment}" in errors_of(qs.Operation, **{radial: value, other: 0.0})
    assert f"operation.{moment}" in errors_of(qs.Operation, **{radial: np.array([0.0, value])})
    qs.Operation(**{radial: value, moment: 0.0})
    qs.Operation(**{radial: value, tilt: 0.0})
    qs.Operation(**{radial: 0.0})


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("axial_load", "1 kN", "not a number"),
        ("axial_load", float("nan"), "finite"),
        ("axial_load", 1e11, "too large"),
        ("axial_displacement", 14.7, "too large"),
        ("tilt_y", 1.5, "too large"),
        ("first_ball_azimuth", 90.0, "too large"),
        ("speed", float("inf"), "finite"),
        ("outer_speed", [1.0, float("nan")], "finite"),
    ],
)
def test_each_error_of_an_operation(field: str, value: Any, words: str) -> None:
    """The field and what is wrong with it."""
    assert words in errors_of(qs.Operation, **{field: value})[f"operation.{field}"].problem


def test_mistakes_of_unit_in_an_operation() -> None:
    """Micrometres as metres, degrees as radians."""
    found = errors_of(qs.Operation, axial_displacement=14.7, tilt_y=1.5)
    assert "millimetres" in found["operation.axial_displacement"].cause
    assert "degrees" in found["operation.tilt_y"].cause


def test_all_errors_of_an_operation_at_once() -> None:
    """Doubled, unstated, not a number and out of range, in one error."""
    with pytest.raises(qs.SceneError) as caught:
        qs.Operation(speed="fast", axial_load=1.0, axial_displacement=1.0, radial_load_y=10.0, first_ball_azimuth=90.0)
    assert [error.field for error in caught.value.errors] == [
        "operation.speed",
        "operation.first_ball_azimuth",
        "operation.axial_load",
        "operation.axial_displacement",
        "operation.moment_z",
    ]


# ---------------------------------------------------------------------------------------------------- errors of a scene


def test_effects_need_a_raceway_control_and_the_reverse() -> None:
    """Kinematics without a hypothesis, and a hypothesis without a use."""
    thrust = qs.Operation(axial_load=1e3, speed=100.0)
    missing = errors_of(qs.Scene, bearing=B218, operation=thrust, ball_effects=BOTH)["raceway_control"]
    assert "centrifugal_force and gyroscopic_moment" in missing.detail
    assert "outer, inner, per_ball, minimum_dissipation or friction" in missing.cause
    idle = errors_of(qs.Scene, bearing=B218, operation=thrust, raceway_control=OUTER)["raceway_control"]
    assert "no ball effect" in idle.problem


def test_an_effect_named_twice() -> None:
    """Two of a kind would be counted once or twice: neither is meant."""
    twice = errors_of(qs.Scene, bearing=B218, ball_effects=CENTRIFUGAL * 2, raceway_control=OUTER)
    assert "twice" in twice["ball_effects"].problem


def test_a_speed_in_revolutions_per_minute() -> None:
    """10 000 rpm given as rad/s is possible; what no bearing has run at is refused, with the likely reason."""
    qs.Scene(B218, qs.Operation(speed=10_000 * qs.rpm))
    error = errors_of(qs.Scene, bearing=B218, operation=qs.Operation(speed=15_000.0))["operation.speed"]
    assert "revolutions per minute" in error.cause
    both = errors_of(qs.Scene, bearing=B218, operation=qs.Operation(speed=1e6, outer_speed=-1e6))
    assert set(both) == {"operation.speed", "operation.outer_speed"}


def test_all_errors_of_a_scene_at_once() -> None:
    """An effect twice, no control, and a speed beyond any bearing."""
    found = errors_of(qs.Scene, bearing=B218, operation=qs.Operation(speed=1e6), ball_effects=CENTRIFUGAL * 2)
    assert set(found) == {"ball_effects", "raceway_control", "operation.speed"}


@pytest.mark.parametrize("field", ["hertz_angle", "hertz_form", "tilt_lever", "raceway_control"])
def test_a_choice_that_does_not_exist(field: str) -> None:
    """A misspelt choice is refused, or at least never solved as if it were another."""
    with pytest.raises((qs.SceneError, ValueError, KeyError, TypeError)):
        qs.solve(
            qs.Scene(
                B218, qs.Operation(axial_load=1e3, speed=10.0), BOTH, **{"raceway_control": OUTER, field: "nonsense"}
            )
        )


@pytest.mark.parametrize(
    "effects",
    [(qs.CentrifugalForce,), ("centrifugal_force",), qs.CentrifugalForce(), (None,), (*CENTRIFUGAL, 3)],
    ids=["class", "word", "bare", "none", "number"],
)
def test_what_is_not_a_ball_effect(effects: Any) -> None:
    """A class in place of its instance, a word, an effect outside a tuple: refused, never left out in silence."""
    thrust = qs.Operation(axial_load=1e3, speed=10.0)
    with pytest.raises((qs.SceneError, ValueError, TypeError, AttributeError)):
        qs.solve(qs.Scene(B218, thrust, effects, OUTER))


@pytest.mark.parametrize(
    "choice",
    [
        {"hertz_angle": qs.HertzAngle.ACTUAL},
        {"hertz_angle": qs.HertzAngle.ZERO},
        {"hertz_form": qs.HertzForm.BREWE_HAMROCK_1977},
        {"tilt_lever": qs.TiltLever.PITCH_CIRCLE},
        {"raceway_control": qs.RacewayControl.INNER},
    ],
    ids=str,
)
def test_a_choice_by_its_word(choice: dict[str, Any]) -> None:
    """The plain word of a choice means the choice (or is refused); it never means another one."""
    operation = qs.Operation(axial_load=9e3, radial_load_y=2e3, moment_z=0.0, speed=700.0)
    numbers: dict[str, Any] = {"raceway_control": OUTER, **choice}
    expected = qs.solve(qs.Scene(B218, operation, BOTH, **numbers))
    words = {name: str(value) for name, value in numbers.items()}
    try:
        found = qs.solve(qs.Scene(B218, operation, BOTH, **words))
    except (qs.SceneError, ValueError):
        return
    assert np.array_equal(found.inner.load, expected.inner.load)


@pytest.mark.parametrize("kind", [kind for kind in qs.BearingKind if kind is not qs.BearingKind.FOUR_POINT])
def test_a_kind_by_its_word(kind: qs.BearingKind) -> None:
    """Likewise for the kind of a bearing, which a reversed thrust tells apart."""
    expected = qs.solve(qs.Scene(replace(B218, kind=kind), qs.Operation(axial_load=-1e3)))
    try:
        found = qs.solve(qs.Scene(replace(B218, kind=str(kind)), qs.Operation(axial_load=-1e3)))  # type: ignore[arg-type]
    except (qs.SceneError, ValueError):
        return
    assert found.status is expected.status


# ---------------------------------------------------------------------------------------------------------- the package


PUBLIC_MODULES = {"readings"}
"""Those that are public as modules: nothing else has their name."""


def test_no_public_name_is_also_a_module() -> None:
    """Importing a module puts it into the package under its name, where it would hide the public thing of that name."""
    assert {name for name in qs.__all__ if find_spec(f"qsbearing.{name}") is not None} == PUBLIC_MODULES


def test_public_names_survive_any_order_of_imports() -> None:
    """Whoever imports the inner modules first still finds the public names."""
    code = (
        "import pkgutil, importlib, types, qsbearing\n"
        "[importlib.import_module(f'qsbearing.{m.name}') for m in pkgutil.iter_modules(qsbearing.__path__)"
        " if m.name not in ('__main__', 'figures', 'cli')]\n"
        "bad = {n for n in qsbearing.__all__ if isinstance(getattr(qsbearing, n), types.ModuleType)}\n"
        f"assert bad == {PUBLIC_MODULES}, bad"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_every_public_name_is_there() -> None:
    """All that is promised can be had, and nothing else by a slip of the pen."""
    for name in qs.__all__:
        assert getattr(qs, name) is not None
    assert set(qs.__all__) <= set(dir(qs))
    with pytest.raises(AttributeError, match="bearings"):
        qs.bearings  # noqa: B018


@pytest.mark.parametrize("given", [0.52 * qs.mm, 0.52], ids=["file", "python"])
def test_a_groove_radius_given_as_f_is_named(given: float) -> None:
    with pytest.raises(qs.SceneError) as raised:
        replace(qs.load_scene("7210c").bearing, inner_groove_radius=given)
    (error,) = raised.value.errors
    assert error.cause == "Given as f = r/D? f D = 0.52 x 12.7 mm = 6.604 mm"
