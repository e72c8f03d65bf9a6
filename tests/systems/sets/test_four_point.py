"""Two opposed rows at one place are a four-point bearing at rest, with equal shim angles in both rings.

The reference has one set of balls with four arcs (two in each ring), solved ball by ball here.
"""

from __future__ import annotations

import dataclasses
from math import cos, radians, sin
from typing import Any

import numpy as np
import pytest
from scipy.optimize import root

import qsbearing as qs
from qsbearing.files.set_file import set_of

Z, D, PITCH, F, ALPHA, PA = 16, 22.225e-3, 125.26e-3, 0.52, radians(35.0), 120e-6
"""B218's balls in the rings of a QJ bearing: contact angle 35 degrees, axial clearance 120 um."""
L = (F - 0.5) * D
TOTAL = 2.0 * L * sin(ALPHA)


def ball_bearing() -> qs.BallBearing:
    return qs.BallBearing(Z, D, PITCH, F * D, F * D, ALPHA, name="QJ")


def four_point(clearance: float = PA, **channels: Any) -> qs.BearingSet:
    """At rest the arcs of a diagonal stand half the clearance nearer to each other than just touching rings: as far
    as a tilt turns them about the middle, each row stands by a quarter of it before the place of the balls."""
    rows = tuple(
        qs.Row(ball_bearing(), -sign * 0.25 * clearance, carries, offset=-0.5 * clearance)
        for carries, sign in (("+x", 1.0), ("-x", -1.0))
    )
    held = {"tilt_y": 0.0, "tilt_z": 0.0} if not any(name.startswith("moment") for name in channels) else {}
    return qs.BearingSet(rows, qs.Operation(**held, **channels))


def four_arcs(displacement: Any, clearance: float, stiffness: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Load of the ring (x, y, moment z) at its displacement, and each ball's contact loads: inner +x, -x, outer +x, -x.

    In a ring the arc that carries +x has its centre g/2 from the mid-plane: before it in the outer ring, behind it in
    the inner one; 2 BD sin(alpha0) = 2 g + Pa with equal shims.
    """
    half = 0.5 * (TOTAL - 0.5 * clearance)  # g/2
    x, y, tilt = displacement[0], displacement[1], displacement[4]
    radius, outer_radius = 0.5 * PITCH + L * cos(ALPHA), 0.5 * PITCH - L * cos(ALPHA)
    total, loads = np.zeros(3), []
    for psi in 2.0 * np.pi * np.arange(Z) / Z:
        c = cos(psi)
        inner = [np.array([x - tilt * radius * c + s * half, radius + (y + tilt * s * half) * c]) for s in (1.0, -1.0)]
        outer = [np.array([-s * half, outer_radius]) for s in (1.0, -1.0)]
        # From a contact's groove centre to the ball's, or back: a spring that pushes the ball once it is longer than L.
        signs = np.array([1.0, 1.0, -1.0, -1.0])
        k = np.repeat(stiffness, 2)

        def contacts(ball: np.ndarray, centres: Any = (*inner, *outer), signs: Any = signs, k: Any = k) -> Any:
            along = signs[:, None] * (np.array(centres) - ball)
            length = np.hypot(*along.T)
            return k * np.maximum(length - L, 0.0) ** 1.5, along / length[:, None]

        def push(ball: np.ndarray, contacts: Any = contacts, signs: Any = signs) -> np.ndarray:
            load, unit = contacts(ball)
            return (signs * load) @ unit / 1e3

        start = 0.25 * np.sum([*inner, *outer], axis=0)
        load, unit = contacts(start)
        if load.any():
            found = root(push, start, tol=1e-15)
            load, unit = contacts(found.x)
            assert np.abs(push(found.x)).max() < 1e-9 * load.max() + 1e-12
        total[:2] += (load[:2] @ unit[:2]) * (1.0, c)
        total[2] += (load[:2] * (np.array([half, -half]) * unit[:2, 1] - radius * unit[:2, 0])).sum() * c
        loads.append(load)
    return total, np.array(loads)


STATES: dict[str, tuple[float, dict[str, float]]] = {
    "thrust": (PA, {"axial_load": 5000.0}),
    "thrust and radial, tilt held": (PA, {"axial_load": 2000.0, "radial_load_y": 5000.0}),
    "radial": (0.0, {"radial_load_y": 8000.0}),
    "moment": (0.0, {"moment_z": 300.0}),
    "thrust and moment": (PA, {"axial_load": 5000.0, "moment_z": 500.0}),
    "thrust and radial, tilt free": (PA, {"axial_load": 2000.0, "radial_load_y": 2000.0, "moment_z": 0.0}),
}


@pytest.mark.parametrize("name", STATES)
def test_two_rows_carry_what_a_ball_with_four_arcs_does(name: str) -> None:
    """To 1e-4: the two diagonals cross at the ball only while they have moved little against each other."""
    clearance, channels = STATES[name]
    solution = qs.solve_set(four_point(clearance, **channels))
    assert solution.converged and "four-point" in solution.set.arrangement
    plus, minus = solution.rows
    touched = plus.inner.load > 0.0
    stiffness = tuple(
        float((side.load[touched] / side.approach[touched] ** 1.5)[0]) for side in (plus.inner, plus.outer)
    )
    total, loads = four_arcs(solution.displacement, clearance, stiffness)
    largest = np.abs(loads).max()
    given = [channels.get(key, 0.0) for key in ("axial_load", "radial_load_y")]
    np.testing.assert_allclose(total[:2], given, atol=1e-4 * max(given, default=0.0) + 1e-4 * largest)
    if "moment_z" in channels:
        assert total[2] == pytest.approx(channels["moment_z"], rel=1e-4, abs=1e-4 * largest * PITCH)
    for row, side in ((plus, 0), (minus, 1)):  # of single balls the diagonals part a little
        np.testing.assert_allclose(row.inner.load, loads[:, side], atol=2e-3 * largest)


def test_at_one_position_a_free_tilt_is_a_little_off() -> None:
    """Nothing where the tilts are held or there is no clearance."""
    clearance, channels = STATES["thrust and radial, tilt free"]
    apart = four_point(clearance, **channels)
    shared = dataclasses.replace(apart, rows=tuple(dataclasses.replace(row, position=0.0) for row in apart.rows))
    tilts = [qs.solve_set(of).displacement[4] for of in (apart, shared)]
    assert 3e-4 < abs(tilts[1] / tilts[0] - 1.0) < 2e-2
    clearance, channels = STATES["thrust and radial, tilt held"]
    held = four_point(clearance, **channels)
    shared = dataclasses.replace(held, rows=tuple(dataclasses.replace(row, position=0.0) for row in held.rows))
    moved = [qs.solve_set(of).displacement for of in (held, shared)]
    np.testing.assert_allclose(moved[0], moved[1], rtol=1e-12)


def test_known_numbers() -> None:
    """Stribeck's 4.37 over both diagonals gives 1334 and 1140 N for the second and the third."""
    both, three, four = (qs.solve_set(four_point(*STATES[name][:1], **STATES[name][1])) for name in (
        "thrust and radial, tilt held", "radial", "moment",
    ))  # fmt: skip
    contacts = sum((row.inner.load > 0.0).astype(int) for row in both.rows)
    assert [int((contacts == count).sum()) for count in (2, 1, 0)] == [3, 2, 11]
    assert three.rows[0].inner.load.max() == pytest.approx(1323, abs=1)
    assert four.rows[0].inner.load.max() == pytest.approx(1108, abs=1)


def test_the_clearance_is_felt_in_both_directions() -> None:
    ends = [qs.solve_set(four_point(PA, axial_load=load)).displacement[0] for load in (1e-3, -1e-3)]
    assert ends[0] - ends[1] == pytest.approx(PA, rel=1e-3)


FILE = {
    "bearing": {"name": "7210C"},
    "rows": [{"position_mm": 0.0, "carries": "+x"}, {"position_mm": 0.0, "carries": "-x"}],
    "operation": {"axial_load_N": 500.0},
}


def test_beyond_rest_two_rows_at_one_place_are_refused() -> None:
    assert set_of(FILE, "a file").arrangement.startswith("four-point")
    at_speed = FILE | {"effects": {"ball": ["centrifugal_force"], "raceway_control": "outer"}}
    rings = {"outer": {"outside_diameter_mm": 90.0, "width_mm": 20.0, "housing": "free"}}
    alike = FILE | {"rows": [FILE["rows"][0], FILE["rows"][0]]}
    near = at_speed | {"rows": [FILE["rows"][0], FILE["rows"][1] | {"position_mm": 0.06}]}
    for tables, words in (
        (near, "four-point bearing at rest only"),
        (at_speed, "four-point bearing at rest only"),
        (FILE | {"effects": {"elastic_rings": rings}}, "there are elastic rings"),
        (FILE | {"operation": {"axial_load_N": 500.0, "speed_rpm": 100.0}}, "there is a speed"),
        (alike, "opposite directions"),
    ):
        with pytest.raises(qs.SceneFileError) as raised:
            set_of(tables, "a file")
        (error,) = raised.value.errors
        assert error.key == "row 2.position_mm" and words in str(error)
        remedy = (
            "Four-point bearings are solved at rest only, without ball effects and elastic rings: set speed_rpm = 0."
        )
        assert (remedy in str(error)) == (tables is not alike)


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("four_point", "inner_shim_mm: missing: a four-point bearing has two arcs"),
        ("four_point_contact", 'kind = "four_point"'),
        ("double_row", "two [[rows]]"),
        ("self_aligning", "Only rows of balls in grooved raceways"),
        ("angular", "Did you mean angular_contact?"),
    ],
)
def test_other_kinds_are_answered_with_what_there_is(kind: str, words: str) -> None:
    with pytest.raises(qs.SceneFileError) as raised:
        set_of(FILE | {"bearing": {"name": "7210C", "kind": kind}}, "a file")
    assert words in str(raised.value)
