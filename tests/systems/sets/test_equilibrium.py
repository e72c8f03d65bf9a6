"""The set's equilibrium: statics in three dimensions, symmetries, stiffness against differences, reciprocity."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.compiler import threads
from qsbearing.model.scene.scene import CHOICES
from qsbearing.results.remarks import every_remark
from tests.qsbearing.scenes import (
    B218,
    BOTH,
    CENTRIFUGAL,
    DEEP_GROOVE,
    MINIMUM_DISSIPATION,
    OUTER,
    PER_BALL,
    lobes,
    unequal_balls,
)
from tests.systems.sets.arrangements import DISTANCE, ROWS, S6210C, S6210E, pair, rows, solved, with_load

MIRROR = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])
"""What a mirror across the shaft does to displacements and loads."""


def contact_stiffness(bearing: qs.BallBearing) -> float:
    """Q/approach^1.5 of both contacts in series."""
    lone = qs.solve(qs.Scene(bearing, qs.Operation(axial_load=1000.0, tilt_y=0.0, tilt_z=0.0)))
    return float(lone.inner.load[0] / (lone.inner.approach[0] + lone.outer.approach[0]) ** 1.5)


def load_of_springs(of: qs.BearingSet, offsets: list[float], displacement: NDArray) -> NDArray:
    """Forces and moments that a set at rest needs at this displacement: groove centres as points in space, a spring
    between each two, summed up as vectors."""
    reference = np.array([float(of.reference), 0.0, 0.0])
    moved, turned = displacement[:3], np.array([0.0, *displacement[3:]])
    total = np.zeros(6)
    for row, offset, both in zip(of.rows, offsets, of.is_two_sided, strict=True):
        bearing, K = row.bearing, contact_stiffness(row.bearing)
        span, angle, side = bearing.groove_centre_distance, bearing.free_contact_angle, row.sign
        begins = 0.0 if both else side * np.sin(angle)  # of a row that stands by its middle, grooves in one plane
        inner_reach = bearing.inner_groove_radius - 0.5 * bearing.ball_diameter  # type: ignore[operator]
        for j in range(int(bearing.ball_count)):  # type: ignore[arg-type]
            psi = 2.0 * np.pi * j / bearing.ball_count  # type: ignore[operator]
            radial = np.array([0.0, np.cos(psi), np.sin(psi)])
            line = np.array([begins, 0.0, 0.0]) + np.cos(angle) * radial
            ball = np.array([row.position, 0.0, 0.0]) + 0.5 * bearing.pitch_diameter * radial  # type: ignore[operator]
            inner = ball + inner_reach * line
            outer = inner - span * line - np.array([side * offset, 0.0, 0.0])
            between = inner + moved + np.cross(turned, inner - reference) - outer
            plane = (
                np.array([between[0], 0.0, 0.0]) + between @ radial * radial
            )  # a ball does not resist along its orbit
            length = np.linalg.norm(plane)
            force = K * max(length - span, 0.0) ** 1.5 * plane / length
            total[:3] += force
            total[3:] += np.cross(inner - reference, force)
    assert abs(total[3]) < 1e-9 * np.abs(total).max()
    return total[[0, 1, 2, 4, 5]]


@pytest.mark.parametrize("arrangement", ["DB", "DF", "TBT", "QBC"])
def test_statics_in_three_dimensions(arrangement: str) -> None:
    """Rows of two kinds, unequal offsets, a reference elsewhere, every channel loaded: to the solver's accuracy."""
    load = np.array([150.0, 300.0, -200.0, 4.0, -3.0])
    names = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
    offsets = [6e-6, 4e-6, 5e-6, 3e-6][: len(ROWS[arrangement])]
    placed = rows(arrangement, S6210C, S6210E)
    placed = tuple(replace(row, offset=offset) for row, offset in zip(placed, offsets, strict=True))
    of = qs.BearingSet(placed, qs.Operation(**dict(zip(names, load, strict=True))), reference_position=7e-3)
    found = solved(of)
    needed = load_of_springs(of, offsets, found.displacement)
    size = np.array([1.0, 1.0, 1.0, 0.035, 0.035]) * 300.0
    np.testing.assert_allclose(needed / size, load / size, atol=1e-8)
    np.testing.assert_allclose(found.row_loads.sum(axis=0) / size, load / size, atol=1e-9)


def test_an_arrangement_of_two_rows_has_a_name_and_of_more_its_directions() -> None:
    told = {name: qs.BearingSet(rows(name), qs.Operation()).arrangement for name in ("DB", "TBT")}
    assert told == {"DB": "DB (back to back)", "TBT": "+x +x -x"}


def test_one_row_is_the_bearing_alone() -> None:
    """About the plane of its inner groove centres, which is the origin of a bearing's own channels."""
    operation = qs.Operation(10_000 * qs.rpm, axial_load=8000.0, radial_load_y=4000.0, moment_z=20.0)
    plane = (B218.inner_groove_radius - 0.5 * B218.ball_diameter) * np.sin(B218.free_contact_angle)  # type: ignore[operator]
    of = qs.BearingSet((qs.Row(B218),), operation, reference_position=plane, ball_effects=BOTH, raceway_control=OUTER)
    alone = qs.solve(qs.Scene(B218, operation, BOTH, OUTER))
    found = solved(of)
    np.testing.assert_allclose(found.displacement, alone.displacement, rtol=1e-8, atol=1e-15)
    np.testing.assert_allclose(found.stiffness, alone.stiffness, rtol=1e-7, atol=1e-9 * np.abs(alone.stiffness).max())
    np.testing.assert_allclose(found.rows[0].outer.angle, alone.outer.angle, rtol=1e-9)


def test_rows_have_balls_of_their_own() -> None:
    """One row, again as alone; and a pair mounted by force, cold, with the balls that it has."""
    operation = qs.Operation(10_000 * qs.rpm, axial_load=8000.0, radial_load_y=4000.0, moment_z=20.0)
    plane = (B218.inner_groove_radius - 0.5 * B218.ball_diameter) * np.sin(B218.free_contact_angle)  # type: ignore[operator]
    row = qs.Row(B218, ring_effects=(unequal_balls(),))
    found = solved(qs.BearingSet((row,), operation, reference_position=plane, ball_effects=BOTH, raceway_control=OUTER))
    alone = qs.solve(qs.Scene(B218, operation, BOTH, OUTER, ring_effects=(unequal_balls(),)))
    np.testing.assert_allclose(found.rows[0].inner.load, alone.inner.load, rtol=1e-9)
    np.testing.assert_allclose(found.stiffness, alone.stiffness, rtol=1e-7, atol=1e-9 * np.abs(alone.stiffness).max())
    large = qs.BallDiameterDeviations(np.full(int(S6210C.ball_count), 3e-6))  # type: ignore[arg-type]
    preload = qs.Preload(rigid=720.0)
    still = solved(qs.BearingSet(rows("DB", ring_effects=(large,)), preload=preload))
    np.testing.assert_allclose(still.axial_loads, [720.0, 720.0], rtol=1e-9)
    equal = solved(qs.BearingSet(rows("DB"), preload=preload))
    assert still.rows[0].displacement[0] < equal.rows[0].displacement[0] - 5e-6, "touched earlier, by 3 um/sin(15 deg)"


def test_rows_have_seats_of_their_own() -> None:
    """One row, again as alone; a pair of which one housing is oval, under loads in a plane that it leaves."""
    operation = qs.Operation(10_000 * qs.rpm, axial_load=8000.0, radial_load_y=4000.0, moment_z=20.0)
    plane = (B218.inner_groove_radius - 0.5 * B218.ball_diameter) * np.sin(B218.free_contact_angle)  # type: ignore[operator]
    row = qs.Row(B218, ring_effects=(lobes(),))
    found = solved(qs.BearingSet((row,), operation, reference_position=plane, ball_effects=BOTH, raceway_control=OUTER))
    alone = qs.solve(qs.Scene(B218, operation, BOTH, OUTER, ring_effects=(lobes(),)))
    np.testing.assert_allclose(found.rows[0].inner.load, alone.inner.load, rtol=1e-9)
    np.testing.assert_allclose(found.stiffness, alone.stiffness, rtol=1e-7, atol=1e-9 * np.abs(alone.stiffness).max())
    oval = qs.SeatsOutOfRound(outer_two_lobe_amplitude=2e-6, outer_two_lobe_phase=0.4)
    first, second = rows("DB")
    pressed = qs.Operation(radial_load_y=300.0, moment_z=0.0)
    of = qs.BearingSet((replace(first, ring_effects=(oval,)), second), pressed, qs.Preload(rigid=720.0))
    one = solved(of)
    assert abs(one.displacement[2]) > 1e-9, "the oval makes the ring leave the plane"
    assert np.abs(one.row_loads.sum(axis=0) - one.load)[:3].max() < 1e-6
    for each in one.rows:
        np.testing.assert_allclose(each.inner.load, qs.solve(each.scene).inner.load, rtol=1e-8)


def test_a_pair_under_no_load_is_symmetric() -> None:
    found = solved(pair("DB", axial_load=0.0))
    assert np.all(found.displacement == 0.0)
    assert np.all(found.axial_loads == 0.0)
    loaded = solved(pair("DB", 500.0, speed=10_000 * qs.rpm))
    np.testing.assert_allclose(loaded.axial_loads[0], loaded.axial_loads[1], rtol=1e-12)
    np.testing.assert_allclose(loaded.rows[0].inner.load, loaded.rows[1].inner.load, rtol=1e-12)
    assert loaded.stiffness[0, 3] == pytest.approx(0.0, abs=1e-6)


def test_tandem_rows_share_pure_thrust() -> None:
    """Each is a bearing under half of it."""
    found = solved(pair("DT", speed=10_000 * qs.rpm, axial_load=800.0))
    alone = qs.solve(qs.Scene(S6210C, qs.Operation(10_000 * qs.rpm, axial_load=400.0), BOTH, OUTER))
    for row in found.rows:
        np.testing.assert_allclose(row.load[0], 400.0, rtol=1e-10)
        np.testing.assert_allclose(row.inner.angle, alone.inner.angle, rtol=1e-10)
        np.testing.assert_allclose(row.outer.load, alone.outer.load, rtol=1e-10)
    assert found.displacement[0] == pytest.approx(alone.displacement[0], rel=1e-10)


def test_a_spacer_between_tandem_rows_shifts_their_shares() -> None:
    first, second = rows("DT")
    found = solved(qs.BearingSet((replace(first, offset=1e-6), second), qs.Operation(axial_load=800.0)))
    assert found.axial_loads[0] > found.axial_loads[1] > 0.0
    assert found.axial_loads.sum() == pytest.approx(800.0, rel=1e-10)


load = st.floats(-1.0, 1.0)


@given(st.sampled_from(sorted(ROWS)), load, load, load, load, load, st.sampled_from([0.0, 6_000.0, 14_000.0]))
def test_balance_mirror_and_reciprocity(
    arrangement: str, x: float, y: float, z: float, my: float, mz: float, rpm: float
) -> None:
    """Rows add up to the load; the mirrored set under the mirrored load answers with the mirror image; at rest the
    stiffness is symmetric."""
    load = np.array([300.0 * x, 200.0 * y, 200.0 * z, 4.0 * my, 4.0 * mz])
    if arrangement == "DT":
        load[0] = 500.0 + abs(load[0])
    names = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
    effects = {"ball_effects": CENTRIFUGAL, "raceway_control": OUTER} if rpm else {}
    preload = None if arrangement == "DT" else qs.Preload(rigid=700.0)
    operation = qs.Operation(rpm * qs.rpm, **dict(zip(names, load, strict=True)))
    of = qs.BearingSet(rows(arrangement, S6210C, S6210E), operation, preload, **effects)
    found = solved(of)
    size = np.array([1.0, 1.0, 1.0, 0.035, 0.035])
    largest = np.abs(found.row_loads / size).max()
    np.testing.assert_allclose(found.row_loads.sum(axis=0) / size, load / size, atol=1e-9 * largest)
    turned = {"+x": "-x", "-x": "+x"}
    mirrored = tuple(
        replace(row, position=-row.position, carries=turned[row.carries])
        for row in of.rows  # type: ignore[operator]
    )
    other = solved(with_load(replace(of, rows=mirrored), **dict(zip(names, MIRROR * load, strict=True))))
    scale = np.array([1.0, 1.0, 1.0, 0.035, 0.035])
    moved = np.abs(found.displacement * scale).max()
    np.testing.assert_allclose(
        other.displacement * MIRROR * scale, found.displacement * scale, atol=1e-7 * moved + 1e-13
    )
    if not rpm:
        weighed = found.stiffness / size[:, None] / size
        np.testing.assert_allclose(weighed, weighed.T, atol=1e-9 * np.abs(weighed).max())


@pytest.mark.parametrize("speed", [0.0, 12_000 * qs.rpm])
@pytest.mark.parametrize("arrangement", ["DB", "DF", "QBC"])
def test_stiffness_against_differences(arrangement: str, speed: float) -> None:
    """Central differences of neighbouring prescribed displacements; their own error is the step squared."""
    names = ("axial_displacement", "radial_displacement_y", "radial_displacement_z", "tilt_y", "tilt_z")
    place, step = np.array([1e-6, 2e-6, -1e-6, 2e-5, 1e-5]), np.array([1e-9, 1e-9, 1e-9, 3e-8, 3e-8])
    points = place + np.concatenate([np.zeros((1, 5)), np.diag(step), -np.diag(step)])
    effects = {"ball_effects": BOTH, "raceway_control": OUTER} if speed else {}
    operation = qs.Operation(speed, **dict(zip(names, points.T, strict=True)))
    found = solved(qs.BearingSet(rows(arrangement), operation, qs.Preload(rigid=700.0), **effects))
    differences = ((found.load[1:6] - found.load[6:]) / (2.0 * step[:, None])).T
    size = np.array([1.0, 1.0, 1.0, 0.035, 0.035])
    matrix = found.stiffness[0] / size[:, None] / size
    np.testing.assert_allclose(differences / size[:, None] / size, matrix, atol=3e-6 * np.abs(matrix).max())


def test_a_prescribed_shaft_gives_its_reactions() -> None:
    """Held where a load took it, each channel's reaction is that load."""
    free = solved(pair("DB", 500.0, speed=8_000 * qs.rpm, axial_load=100.0, radial_load_y=200.0, moment_z=0.0))
    x, y, _, _, tilt = free.displacement
    held = solved(pair("DB", 500.0, speed=8_000 * qs.rpm, axial_displacement=x, radial_displacement_y=y, tilt_z=tilt))
    np.testing.assert_allclose(held.load, [100.0, 200.0, 0.0, 0.0, 0.0], atol=1e-8 * 500.0)


def test_cases_are_solved_as_if_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(threads, "CHUNK", 4)  # several stretches of them
    loads, speeds = np.array([0.0, 150.0, -300.0]), np.array([[0.0], [5_000.0], [12_000.0]]) * qs.rpm
    many = solved(pair("DB", 400.0, speed=speeds, axial_load=loads, radial_load_y=250.0, moment_z=0.0))
    assert many.displacement.shape == (3, 3, 5)
    assert many.row_loads.shape == (3, 3, 2, 5)
    one = solved(pair("DB", 400.0, speed=12_000 * qs.rpm, axial_load=150.0, radial_load_y=250.0, moment_z=0.0))
    np.testing.assert_allclose(many.displacement[2, 1], one.displacement, rtol=1e-7, atol=1e-15)
    np.testing.assert_allclose(many.rows[1].inner.load[2, 1], one.rows[1].inner.load, rtol=1e-7)


def test_per_ball_control_and_deep_grooves() -> None:
    """Controls that change from ball to ball, and rows that carry both ways."""
    of = replace(pair("DB", 400.0, speed=12_000 * qs.rpm, radial_load_y=300.0, moment_z=0.0), raceway_control=PER_BALL)
    found = solved(of)
    np.testing.assert_allclose(found.row_loads.sum(axis=0)[:3], [0.0, 300.0, 0.0], atol=1e-7)
    deep = (qs.Row(DEEP_GROOVE, 0.0), qs.Row(DEEP_GROOVE, 0.1))
    both = solved(qs.BearingSet(deep, qs.Operation(axial_load=-500.0, radial_load_y=800.0, moment_z=0.0)))
    np.testing.assert_allclose(both.row_loads.sum(axis=0), [-500.0, 800.0, 0.0, 0.0, 0.0], atol=1e-6)


def test_distance_and_arrangement() -> None:
    """Back to back the contact lines part, so that distance adds to the lever of a moment; face to face they meet."""
    tilts = {
        (arrangement, distance): solved(pair(arrangement, 500.0, distance=distance)).stiffness[4, 4]
        for arrangement in ("DB", "DF")
        for distance in (DISTANCE, 2 * DISTANCE, 4 * DISTANCE)
    }
    back, face = (np.array([tilts[name, n * DISTANCE] for n in (1, 2, 4)]) for name in ("DB", "DF"))
    assert back[0] < back[1] < back[2]
    assert np.all(back > face)


def test_the_reference_moves_moments_only() -> None:
    """The same forces at another point of the shaft with the moment that makes them equal."""
    base = pair("DB", 500.0, speed=8_000 * qs.rpm, axial_load=100.0, radial_load_y=300.0, moment_z=2.0)
    elsewhere = with_load(replace(base, reference_position=0.05), moment_z=2.0 - 300.0 * 0.05)
    one, other = solved(base), solved(elsewhere)
    np.testing.assert_allclose(one.rows[0].inner.load, other.rows[0].inner.load, rtol=1e-8)
    assert other.displacement[1] == pytest.approx(one.displacement[1] + 0.05 * one.displacement[4], rel=1e-7)


@pytest.mark.parametrize("control", [OUTER, PER_BALL, MINIMUM_DISSIPATION])
@pytest.mark.parametrize("kind", ["rigid", "spring"])
def test_both_solvers_agree(monkeypatch: pytest.MonkeyPatch, control: qs.RacewayControl, kind: str) -> None:
    """All unknowns at once, compiled, and by way of each row's own solve: one equilibrium, to the solvers' accuracy."""
    generator = np.random.default_rng(7)
    count = 12
    placed = tuple(replace(row, sprung=kind == "spring" and row.carries == "-x") for row in rows("TBT", S6210C, S6210E))
    loads = {
        name: size * generator.uniform(-1.0, 1.0, count)
        for name, size in (("radial_load_y", 300.0), ("radial_load_z", 200.0), ("moment_y", 4.0), ("moment_z", 3.0))
    }
    operation = qs.Operation(np.linspace(0.0, 15_000.0, count) * qs.rpm, axial_load=150.0, **loads)  # type: ignore[arg-type]
    of = qs.BearingSet(placed, operation, qs.Preload(**{kind: 700.0}), ball_effects=BOTH, raceway_control=control)
    direct = solved(of)
    monkeypatch.setattr("qsbearing.systems.sets.problem.solve_directly", lambda *given: None)
    by_rows = solved(of)
    assert by_rows.iterations.sum() != direct.iterations.sum()
    size = np.array([1.0, 1.0, 1.0, 0.035, 0.035])
    gap = np.abs((direct.displacement - by_rows.displacement) * size).max()
    assert gap < 1e-8 * np.abs(direct.displacement * size).max()
    np.testing.assert_allclose(direct.row_loads / size, by_rows.row_loads / size, atol=1e-6)
    for one, other in zip(direct.rows, by_rows.rows, strict=True):
        np.testing.assert_allclose(one.inner.load, other.inner.load, rtol=1e-7, atol=1e-7)
        np.testing.assert_allclose(one.outer.angle, other.outer.angle, rtol=1e-7, atol=1e-9)


def test_a_direct_solve_is_what_its_rows_would_find() -> None:
    """Each row of a directly solved set, solved alone at its displacement: the same loads, angles and stiffness."""
    loads = {"axial_load": 100.0, "radial_load_y": 300.0, "radial_load_z": 50.0, "moment_y": 1.0, "moment_z": 0.0}
    operation = qs.Operation(9_000 * qs.rpm, **loads)
    first, *others = rows("QBC", S6210C, S6210E)
    unequal = qs.BallDiameterDeviations(1e-6 * np.cos(np.arange(int(S6210C.ball_count))))  # type: ignore[arg-type]
    placed = (replace(first, ring_effects=(unequal,)), *others)
    found = solved(qs.BearingSet(placed, operation, qs.Preload(rigid=900.0), None, BOTH, OUTER))
    for row in found.rows:
        alone = qs.solve(row.scene)
        np.testing.assert_allclose(row.load, alone.load, rtol=1e-9, atol=1e-7)
        np.testing.assert_allclose(row.inner.angle, alone.inner.angle, rtol=1e-9)
        np.testing.assert_allclose(row.stiffness, alone.stiffness, rtol=1e-6, atol=1e-6 * np.abs(alone.stiffness).max())


@pytest.mark.parametrize("arrangement", ["DB", "DF", "TBT", "QBC"])
def test_ordinary_cases_are_solved_directly(monkeypatch: pytest.MonkeyPatch, arrangement: str) -> None:
    """By the compiled method alone, in few iterations: a wrong slope in it would be slow and nothing else."""

    def refuse(*given: object) -> None:
        raise AssertionError("a case was left to the nested solve")

    monkeypatch.setattr("qsbearing.systems.sets.problem.newton", refuse)
    generator = np.random.default_rng(3)
    count = 200

    def random(size: float) -> NDArray:
        return size * generator.uniform(-1.0, 1.0, count)

    operation = qs.Operation(
        generator.uniform(500.0, 20_000.0, count) * qs.rpm, axial_load=random(400.0), radial_load_y=random(400.0),
        radial_load_z=random(300.0), moment_y=random(5.0), moment_z=random(5.0),
    )  # fmt: skip
    of = qs.BearingSet(rows(arrangement, S6210C, S6210E), operation, qs.Preload(rigid=700.0), None, BOTH, OUTER)
    turning = solved(of)
    assert turning.iterations.mean() < 7.0
    still = solved(replace(of, ball_effects=(), raceway_control=None))
    assert still.iterations.mean() < 5.5


def test_no_stiffness_where_raceway_control_contradicts_itself() -> None:
    """Such a row has several solutions side by side: differences of neighbours are no tangent, and none is reported."""
    operation = qs.Operation(
        np.array([424.2060708578242, 424.0]) * qs.rpm,
        axial_load=np.array([1168.8530554521644, 9000.0]),
        radial_load_y=np.array([103.73081221234129, 0.0]),
        moment_z=0.0,
    )
    of = qs.BearingSet(rows("DT", B218), operation, ball_effects=BOTH, raceway_control=PER_BALL)
    found = solved(of)
    assert found.control_is_consistent.tolist() == [False, True]
    assert np.isnan(found.stiffness).any(axis=(1, 2)).tolist() == [True, False]
    assert np.isnan(found.effective_stiffness[0]).all()
    assert any("No stiffness" in sentence for sentence in qs.warnings(found, 0))


@pytest.mark.parametrize("name", CHOICES)
def test_a_choice_is_given_as_a_member_or_its_word(name: str) -> None:
    for member in CHOICES[name]:
        if member not in ("displaced", "common", "friction"):  # which rows at one place, or all sets, do not know
            of = replace(pair("DB", 400.0), ball_effects=BOTH, raceway_control=OUTER)
            assert getattr(replace(of, **{name: str(member)}), name) is member


def test_a_set_whose_effects_are_chosen_is_told_of_hypotheses() -> None:
    operation = qs.Operation(speed=10_000 * qs.rpm, radial_load_y=500.0, moment_z=0.0)
    of = replace(pair("DB", 720.0), operation=operation)
    chosen = qs.solve_set(replace(of, tolerance=0.01))
    assert "hypotheses_differ" in [each.code for each in every_remark(chosen)]
