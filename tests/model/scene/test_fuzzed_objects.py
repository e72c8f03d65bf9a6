"""Anything given to the Python objects and to `solve`: errors that say so, or a result in finite numbers.

Every number that is accepted is looked at once more where the solver takes over: what is not finite must not get there.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.kernel.newton import STALLED
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution import solver as solving
from qsbearing.remarks.of_solution import message, warnings
from tests.qsbearing.any_scene import CHOICES, bearings, bounded, few, many, operations


@pytest.fixture(autouse=True, scope="module")
def nothing_but_numbers() -> Iterator[list[int]]:
    """Look at every case record on its way into the solver."""
    solve_records, passed = solving.solve_records, [0]

    def watched(cases: NDArray, *rest: Any, **options: Any) -> None:
        for name in cases.dtype.names or ():
            field = cases[name]
            if field.dtype.kind == "f":
                assert np.isfinite(field).all(), f"the solver is handed {name} = {field}"
        passed[0] += cases.size
        solve_records(cases, *rest, **options)

    # Compiling, or loading, the kernel takes its own time.
    assert_result(qs.solve(qs.load_scene("b218")))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(solving, "solve_records", watched)
        yield passed


JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.text(max_size=5),
    st.binary(max_size=3),
    st.floats(),  # NaN, infinities and subnormals among them
    st.integers(),
    st.sampled_from(
        [
            *(10**400, -(10**400), 10**5000, [10**5000], 1j, Decimal("NaN"), Decimal("1e-3"), Fraction(1, 3)),
            *(object(), [], {}, {"a": 1}, set(), range(3)),
        ]
    ),
    st.sampled_from(
        [
            np.array([]),
            np.array([1.0, np.nan]),
            np.array([np.inf]),
            np.array([1 + 2j]),
            np.array(["x"]),
            np.array([None]),
            np.array([[1.0, 2.0], [3.0, 4.0]]),
            np.float32(0.01),
            np.int8(7),
            np.ma.masked_array([1.0, 2.0], mask=[0, 1]),
            [1.0, [2.0]],
            [1.0, None],
            (0.01, 0.02),
        ]
    ),
)


def made(build: Callable[[], qs.Scene]) -> qs.Scene | None:
    """The scene; None if it is refused, which it must be with errors that say so."""
    try:
        return build()
    except qs.SceneError as error:
        assert error.errors
        for each in error.errors:
            assert each.field
            assert each.problem
        assert str(error)
        return None


def assert_result(solution: qs.Solution) -> None:
    """One of the three, with a sentence; numbers where it is solved, and nowhere else."""
    for index in np.ndindex(solution.shape):
        status = str(np.asarray(solution.status)[index])
        assert status in list(qs.Status)
        assert message(solution, index)
        is_solved = status == "converged"
        for sentence in warnings(solution, index):
            assert "nan" not in sentence.split()
        assert np.isfinite(solution.displacement[index]).all() == is_solved
        assert np.isfinite(solution.load[index]).all() == is_solved
        there = np.isfinite(solution.azimuth[index])
        for contacts in (solution.inner, solution.outer):
            load, pressure, angle = (
                getattr(contacts, name)[index][there] for name in ("load", "max_pressure", "angle")
            )
            assert np.isfinite(load).all() == is_solved
            assert np.isfinite(pressure).all() == is_solved
            if is_solved:
                assert (load >= 0.0).all()
                assert np.isfinite(angle[load > 0.0]).all()
        for array in (solution.centrifugal_force, solution.gyroscopic_moment, solution.orbital_speed):
            if array is not None and is_solved:
                assert np.isfinite(array[index][there]).all()
        if is_solved:
            assert np.asarray(solution.residual)[index] <= STALLED
            assert np.isfinite(qs.stiffness(solution.scene, solution)[index]).all()


def solve_or_refuse(bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]) -> None:
    """Refused with errors, or solved to a result."""
    with bounded():
        scene = made(
            lambda: qs.Scene(
                qs.BallBearing(**bearing),
                qs.Operation(**operation),
                **{name: choice() if callable(choice) else choice for name, choice in choices.items()},
            )
        )
        if scene is None:
            return
        try:
            solution = qs.solve(scene)
        except ValueError as error:
            # A temperature of the balls that is to be found needs a heat balance.
            assert "broadcast" in str(error) or "ball_temperature: missing" in str(error)
            return
        assert_result(solution)


@few
@given(bearings(), operations(), CHOICES)
def test_whatever_is_accepted_has_a_result(
    bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]
) -> None:
    """Numbers out to the ends of every allowed range."""
    solve_or_refuse(bearing, operation, choices)


SOUND_BEARING: dict[str, Any] = {
    "ball_count": 16,
    "ball_diameter": 22.225e-3,
    "pitch_diameter": 125.26e-3,
    "inner_groove_radius": 11.6281e-3,
    "outer_groove_radius": 11.6281e-3,
    "free_contact_angle": 0.7,
}
SOUND_OPERATION: dict[str, Any] = {"speed": 500.0, "axial_load": 8e3, "radial_load_y": 1e3, "moment_z": 0.0}
SOUND_CHOICES: dict[str, Any] = {"ball_effects": (qs.CentrifugalForce(),), "raceway_control": "outer"}

FIELDS = {
    "bearing": [*SOUND_BEARING, "ball_material", "ring_material", "kind", "name"],
    "operation": [
        *("speed", "outer_speed", "first_ball_azimuth"),
        *(name for channel in CHANNELS for name in (channel.load, channel.displacement)),
    ],
    "choices": ["ball_effects", "raceway_control", "hertz_angle", "hertz_form", "tilt_lever"],
    "material": ["elastic_modulus", "poisson_ratio", "density", "thermal_expansion"],
    "ring_expansion": [field.name for field in dataclasses.fields(qs.RingExpansion) if field.init],
    "ball_expansion": [field.name for field in dataclasses.fields(qs.BallExpansion)],
    "preload": ["spring", "rigid", "axial_displacement"],
}

SOUND_RINGS: dict[str, Any] = {
    **{"bore_diameter": 0.09, "outside_diameter": 0.16, "shaft_interference": 1e-5, "inner_ring_temperature": 350.0},
    **{"housing_interference": -1e-6, "housing_outside_diameter": 0.2, "outer_ring_temperature": 340.0},
}


def junk_in_one_field(part: str, field: str, value: Any) -> None:
    """One field of a sound scene replaced by anything."""
    parts = {"bearing": dict(SOUND_BEARING), "operation": dict(SOUND_OPERATION), "choices": dict(SOUND_CHOICES)}
    if part == "material":
        steel = {"elastic_modulus": 208e9, "poisson_ratio": 0.3, "density": 7800.0}
        parts["bearing"]["ball_material"] = qs.Material(**{**steel, field: value})
    elif part == "ring_expansion":
        parts["choices"]["ring_effects"] = lambda: (qs.RingExpansion(**{**SOUND_RINGS, field: value}),)
    elif part == "ball_expansion":
        parts["choices"]["ring_effects"] = lambda: (qs.BallExpansion(**{"ball_temperature": 350.0, field: value}),)
    elif part == "preload":
        del parts["operation"]["axial_load"]
        parts["choices"]["preload"] = lambda: qs.Preload(**{field: value})
    else:
        parts[part][field] = value
    solve_or_refuse(**parts)


ANY_FIELD = st.sampled_from([(part, field) for part, fields in FIELDS.items() for field in fields])


@few
@given(ANY_FIELD, JUNK)
def test_anything_in_any_field(place: tuple[str, str], value: Any) -> None:
    junk_in_one_field(*place, value)


NO_NUMBERS = {
    "nan": math.nan,
    "infinity": math.inf,
    "minus infinity": -math.inf,
    "beyond floats": 10**400,
    "text": "1",
    "true": True,
    "none": None,
    "complex": 1j,
    "complex array": np.array([1.0 + 2.0j]),
    "nan in an array": np.array([1.0, np.nan]),
    "rows of unlike lengths": [1.0, [2.0]],
}


@pytest.mark.parametrize("value", list(NO_NUMBERS.values()), ids=list(NO_NUMBERS))
@pytest.mark.parametrize(
    "place", [(part, field) for part, fields in FIELDS.items() for field in fields], ids=lambda place: place[1]
)
def test_what_is_no_number_in_every_field(place: tuple[str, str], value: Any) -> None:
    """Each of the usual non-numbers, in each field."""
    if place[1] == "name":
        return
    junk_in_one_field(*place, value)


@few
@given(st.sampled_from(["start", "threads", "accuracy", "residual_tolerance"]), JUNK)
def test_anything_as_an_argument_of_solve(name: str, value: Any) -> None:
    """A result, or an error that says what is wrong with the value, not one from deep inside."""
    scene = qs.Scene(qs.BallBearing(**SOUND_BEARING), qs.Operation(**SOUND_OPERATION), **SOUND_CHOICES)
    with bounded():
        try:
            solution = qs.solve(scene, **{name: value})
        except (ValueError, TypeError, ArithmeticError) as error:
            assert str(error)
            return
        assert solution.status in list(qs.Status)


@pytest.mark.heavy
@many
@given(bearings(), operations(), CHOICES)
def test_many_results(bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]) -> None:
    solve_or_refuse(bearing, operation, choices)


@pytest.mark.heavy
@many
@given(ANY_FIELD, JUNK)
def test_much_junk(place: tuple[str, str], value: Any) -> None:
    junk_in_one_field(*place, value)
