"""Four-point bearings: known numbers, what they become with two contacts, at rest and mirrored, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.model.effects.traction import Traction
from qsbearing.results.json_record import record
from tests.qsbearing.scenes import B218, BOTH, QJ, UPRIGHT, rubbing
from tests.systems.sets.test_four_point import four_arcs

FINE = Traction(0.06, radial_points=32, points_around=80)
COMBINED = {"axial_load": 5e3, "radial_load_y": 3e3, **UPRIGHT}
compiled_only = pytest.mark.skipif(not has_fast_code(), reason="many cases take minutes in plain Python")


def loads(solution: qs.Solution) -> list[float]:
    """Of the first ball: inner, outer, then those of the opposite arcs."""
    return [float(each.load.reshape(-1)[0]) for each in solution.arcs]


def test_three_contacts_at_speed_are_the_known_ones() -> None:
    """5 kN, 10,000 rpm, mu 0.06, slip speed 0.1 m/s, 32 x 80 points, by a trial of its own."""
    solution = qs.solve(rubbing(10_000, traction=FINE, axial_load=5e3))
    assert solution.converged and solution.opposite is not None and solution.opposite.outer is not None
    np.testing.assert_allclose(loads(solution), (473.831, 882.707, 0.0, 281.368), rtol=1e-5)  # of other points
    angles = [np.degrees(each.angle[0]) for each in (solution.outer, solution.opposite.outer, solution.inner)]
    np.testing.assert_allclose(angles, (30.43248, -29.57697, 41.09669), atol=1.5e-5)
    assert solution.orbital_speed is not None and solution.balance is not None
    assert solution.orbital_speed[0] / (10_000 * qs.rpm) == pytest.approx(0.458947, abs=1e-6)
    assert solution.balance.heat == pytest.approx(1734.36, rel=1e-5)
    assert solution.balance.heat == pytest.approx(-solution.balance.torque * 10_000 * qs.rpm, rel=1e-9)


def test_a_model_with_one_arc_a_ring_errs_grossly_there() -> None:
    """Under outer control 1050.6 N press the one outer contact: here they are two, of 883 and 281 N."""
    one_arc = replace(QJ, kind="angular_contact", inner_shim=None, outer_shim=None)
    ordinary = qs.solve(qs.Scene(one_arc, qs.Operation(10_000 * qs.rpm, axial_load=5e3), BOTH, "outer"))
    assert ordinary.outer.load[0] == pytest.approx(1050.6, abs=0.05)


@pytest.mark.parametrize("shims", [{}, {"inner_shim": None}, {"outer_shim": None}, {"inner_shim": 1e-4}])
def test_with_two_contacts_it_is_the_ordinary_bearing(shims: dict[str, Any]) -> None:
    """To rounding, whatever the shims of arcs that do not touch."""
    speed, load = np.array([0.0, 3e3, 8e3]), 20e3
    arched = qs.solve(rubbing(speed, replace(QJ, **shims), axial_load=load))
    ordinary = replace(QJ, kind="deep_groove", inner_shim=None, outer_shim=None)
    expected = qs.solve(rubbing(speed, ordinary, axial_load=load))
    assert arched.opposite is not None and expected.opposite is None
    for each in filter(None, arched.opposite):
        assert (each.load == 0.0).all()
    np.testing.assert_allclose(arched.displacement, expected.displacement, rtol=1e-11, atol=1e-18)
    for name in ("load", "angle", "approach", "semi_major_axis", "max_pressure"):
        for side in ("inner", "outer"):
            of, other = getattr(getattr(arched, side), name), getattr(getattr(expected, side), name)
            np.testing.assert_allclose(of, other, rtol=1e-11, err_msg=f"{side} {name}")
    for name in ("orbital_speed", "axial_rotation", "gyroscopic_moment", "centrifugal_force"):
        np.testing.assert_allclose(getattr(arched, name), getattr(expected, name), rtol=1e-9, err_msg=name)
    assert arched.balance is not None and expected.balance is not None
    np.testing.assert_allclose(arched.balance.heat, expected.balance.heat, rtol=1e-9)
    turning = slice(1, None)  # at rest the ordinary one has tilts too
    np.testing.assert_allclose(
        arched.stiffness[turning, :3, :3], expected.stiffness[turning, :3, :3], rtol=1e-9, atol=1e-3
    )
    np.testing.assert_allclose(arched.stiffness[0, 0, 0], expected.stiffness[0, 0, 0], rtol=1e-11)


def test_displacements_count_from_first_contact_and_from_the_middle() -> None:
    solution = qs.solve(rubbing(0.0, axial_load=np.array([-5e3, -1e-3, 1e-3, 5e3])))
    middle = solution.axial_from_middle
    np.testing.assert_allclose(middle, -middle[::-1], rtol=1e-9)
    np.testing.assert_allclose(middle - solution.displacement[:, 0], 60e-6, rtol=1e-12)
    assert middle[2] == pytest.approx(60e-6, abs=2e-9)


@pytest.mark.parametrize("shims", [{}, {"inner_shim": 3e-4}, {"outer_shim": None}])
def test_a_mirrored_load_presses_the_opposite_arcs(shims: dict[str, Any]) -> None:
    """Loads and angles are those of the other side; of a ring with one arc, they are its own with the other sign."""
    bearing = replace(QJ, **shims)
    right, left = (qs.solve(rubbing(10_000, bearing, axial_load=load)) for load in (4e3, -4e3))
    assert right.converged and left.converged and right.opposite is not None and left.opposite is not None
    for side in ("inner", "outer"):
        first, other = getattr(right, side), getattr(right.opposite, side)
        mirrored, its_other = getattr(left, side), getattr(left.opposite, side)
        if other is None:
            assert its_other is None
            np.testing.assert_allclose(mirrored.angle, -first.angle, rtol=1e-8)
            np.testing.assert_allclose(mirrored.load, first.load, rtol=1e-8)
            continue
        np.testing.assert_allclose(its_other.load, first.load, rtol=1e-8)
        np.testing.assert_allclose(mirrored.load, other.load, rtol=1e-8)
        np.testing.assert_allclose(its_other.angle, -first.angle, rtol=1e-8)
    np.testing.assert_allclose(right.orbital_speed, left.orbital_speed, rtol=1e-9)
    np.testing.assert_allclose(right.axial_from_middle, -left.axial_from_middle, rtol=1e-8)


def test_slow_it_is_the_bearing_at_rest() -> None:
    """Friction is then nothing beside the loads, if slips are far below the slip speed; but balls that go round stay
    for longer where they are slower, which moves the ring under radial load."""
    law = Traction(0.06, slip_speed=10.0)
    slow, still = (qs.solve(rubbing(speed, traction=law, axial_load=5e3)) for speed in (0.05, 0.0))
    assert slow.displacement[0] == pytest.approx(still.displacement[0], rel=1e-6)
    slow, still = (qs.solve(rubbing(speed, traction=law, **COMBINED)) for speed in (0.05, 0.0))
    np.testing.assert_allclose(slow.displacement[:2], still.displacement[:2], rtol=1e-3)
    np.testing.assert_allclose(slow.inner.load, still.inner.load, atol=1e-3 * still.inner.load.max())
    assert still.friction is None and (still.orbital_speed == 0.0).all()


@pytest.mark.parametrize("given", [{"axial_load": 2e3, "radial_load_y": 5e3}, {"radial_load_y": 8e3}])
@pytest.mark.parametrize("clearance", [120e-6, 0.0, -20e-6])
def test_at_rest_four_springs_carry_the_load(given: dict[str, float], clearance: float) -> None:
    """Forces at the displacement found, by balls between four arcs each, solved one by one."""
    fields = ("ball_count", "ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius",
              "free_contact_angle")  # fmt: skip
    bearing = qs.BallBearing.from_axial_clearance(
        axial_clearance=clearance, **{name: getattr(QJ, name) for name in fields}
    )
    solution = qs.solve(rubbing(0.0, bearing, **given, **UPRIGHT))
    assert solution.converged
    touched = solution.inner.load > 0.0
    stiffness = tuple(
        float((side.load[touched] / side.approach[touched] ** 1.5)[0]) for side in (solution.inner, solution.outer)
    )
    place = solution.displacement.copy()
    place[0] = solution.axial_from_middle
    total, found = four_arcs(place, clearance, stiffness)
    largest = np.abs(found).max()
    np.testing.assert_allclose(total[0], given.get("axial_load", 0.0), atol=1e-6 * largest)
    np.testing.assert_allclose(total[1], given["radial_load_y"], atol=1e-6 * largest)
    assert solution.opposite is not None and solution.opposite.inner is not None
    np.testing.assert_allclose(solution.inner.load, found[:, 0], atol=1e-6 * largest)
    np.testing.assert_allclose(solution.opposite.inner.load, found[:, 1], atol=1e-6 * largest)


def test_balls_without_load_at_rest_have_no_place() -> None:
    """2 kN + 5 kN: three balls have four contacts; of others whose loads are nothing, no angle is given."""
    solution = qs.solve(rubbing(0.0, axial_load=2e3, radial_load_y=5e3, **UPRIGHT))
    contacts = np.sum([each.load > 0.0 for each in solution.arcs], axis=0)
    assert [int((contacts == count).sum()) for count in (4, 3, 2, 1, 0)] == [3, 0, 2, 0, 11]
    free = contacts == 0
    for each in solution.arcs:
        assert np.isnan(each.angle[free]).all() and np.isnan(each.approach[free]).all()
        assert (each.load[free] == 0.0).all()
    assert [each.code for each in (one.remark for one in qs.warnings(solution))] == ["balls_unloaded"]


def differences(scene: qs.Scene, solution: qs.Solution) -> NDArray:
    """Of the loads by displacements that are given."""
    found, step = np.zeros((3, 3)), 2e-9
    names = "axial_displacement", "radial_displacement_y", "radial_displacement_z"
    for k in range(3):
        ends = []
        for sign in (1.0, -1.0):
            moved = solution.displacement[:3].copy()
            moved[k] += sign * step
            held = qs.Operation(scene.operation.speed, **dict(zip(names, moved, strict=True)), **UPRIGHT)
            ends.append(qs.solve(replace(scene, operation=held)).load[:3])
        found[:, k] = (ends[0] - ends[1]) / (2.0 * step)
    return found


@pytest.mark.parametrize("speed", [0.0, 10_000.0])
def test_stiffness_is_the_slope_of_the_load(speed: float) -> None:
    """And under thrust at speed that of the note, 513 N/um: with one arc a ring 63."""
    scene = rubbing(speed, **COMBINED)
    solution = qs.solve(scene)
    expected = differences(scene, solution)
    np.testing.assert_allclose(solution.stiffness[:3, :3], expected, atol=2e-5 * np.abs(expected).max())
    assert np.isnan(solution.stiffness[3:]).all()
    thrust = qs.solve(rubbing(10_000, traction=Traction(0.06), axial_load=5e3))
    assert thrust.stiffness[0, 0] == pytest.approx(513e6, rel=2e-3)
    assert thrust.compliance[0, 0] == pytest.approx(1.0 / thrust.stiffness[0, 0], rel=1e-12)


def test_both_rings_carry_the_same_under_radial_load() -> None:
    """Balls carried round: what the outer ring's two arcs take is the load."""
    from qsbearing.model.solution.ring_forces import radial_forces

    forces = radial_forces(qs.solve(rubbing(10_000, **COMBINED)))
    assert forces is not None
    assert forces.on_outer[0] == pytest.approx(3e3, rel=1e-9) and forces.momentum_gap[0] < 1e-9


@compiled_only
def test_heat_and_contacts_go_over_into_each_other_along_speed() -> None:
    """A third contact opens at some speed: displacement and heat do not jump there, and none is left out."""
    solution = qs.solve(rubbing(np.linspace(2500.0, 6500.0, 161), axial_load=5e3))
    assert solution.counts() == "converged 161" or solution.converged.all()
    assert solution.opposite is not None and solution.opposite.outer is not None and solution.balance is not None
    opened = solution.opposite.outer.load[:, 0]
    assert opened[0] == 0.0 and opened[-1] > 50.0
    for values in (solution.displacement[:, 0], solution.balance.heat, solution.orbital_speed[:, 0]):  # type: ignore[index]
        steps = np.abs(np.diff(values))
        assert steps.max() < 12.0 * np.median(steps) + 1e-9


def test_life_counts_every_arc_as_a_raceway() -> None:
    """The loads of the second outer arc shorten the outer ring's life as Weibull's law adds them up."""
    solution = qs.solve(rubbing(10_000, axial_load=5e3))
    found = qs.readings.life(solution)
    inner_rating, outer_rating = qs.readings.element_load_ratings(QJ, found.dynamic_load_rating)
    inner, outer, _, opposite = loads(solution)
    damage = (outer / outer_rating) ** (10.0 / 3.0) + (opposite / outer_rating) ** (10.0 / 3.0)
    assert found.outer_life == pytest.approx(1e6 * damage**-0.9, rel=1e-9)
    assert found.inner_life == pytest.approx(1e6 * (inner_rating / inner) ** 3.0, rel=1e-9)
    both = (found.inner_life / 1e6) ** (-10.0 / 9.0) + damage
    assert found.basic_reference_rating_life == pytest.approx(1e6 * both**-0.9, rel=1e-9)
    assert np.isnan(found.equivalent_load) and np.isnan(found.basic_rating_life)
    by_contact = qs.readings.life(solution, capacity="lundberg_palmgren")  # type: ignore[arg-type]
    assert by_contact.outer_life < qs.readings.life(
        qs.solve(rubbing(0.0, axial_load=5e3)), capacity="lundberg_palmgren"  # type: ignore[arg-type]
    ).outer_life  # fmt: skip


def test_the_ellipse_ends_before_the_apex_or_it_is_said() -> None:
    """r (|alpha| - asin(g/2r)) - a; with hardly a shim, the arcs of a ring are one, and would count twice."""
    solution = qs.solve(rubbing(10_000, axial_load=5e3))
    radius, angle = 0.52 * 22.225e-3, solution.outer.angle[0]
    assert QJ.outer_shim is not None and solution.opposite is not None and solution.opposite.outer is not None
    margin = radius * (angle - np.arcsin(0.5 * np.asarray(QJ.outer_shim) / radius)) - solution.outer.semi_major_axis[0]
    assert solution.outer.apex_margin is not None
    assert solution.outer.apex_margin[0] == pytest.approx(margin, rel=1e-12)
    assert margin == pytest.approx(4.184e-3, abs=1e-6)
    assert "apex_passed" not in [each.remark.code for each in qs.warnings(solution)]
    shallow = qs.solve(rubbing(0.0, replace(QJ, inner_shim=1e-6, outer_shim=1e-6), axial_load=5e3))
    assert [each.remark.code for each in qs.warnings(shallow)].count("apex_passed") == 2
    ordinary = qs.solve(rubbing(3e3, B218, axial_load=5e3))
    assert ordinary.outer.apex_margin is None and ordinary.opposite is None


def test_its_record_has_the_opposite_arcs_and_ordinary_ones_have_no_such_keys() -> None:
    solution = qs.solve(rubbing(10_000, traction=FINE, axial_load=5e3))
    of_case = record(solution, {})
    ball, traction = of_case["balls"][0], of_case["traction"]
    assert ball["opposite"]["outer"]["load_N"] == pytest.approx(281.369, rel=1e-5)
    assert ball["opposite"]["inner"]["load_N"] == 0.0 and ball["outer"]["apex_margin_mm"] > 4.0
    heat = sum(of["heat_W"] for part in (traction["balls"][0], traction["balls"][0]["opposite"]) for side in
               ("inner", "outer") for of in [part[side]])  # fmt: skip
    assert 16.0 * heat == pytest.approx(traction["heat_W"], rel=1e-9)
    assert traction["gyroscopic_margin"] is None and traction["skid_margin"] is None
    table = solution.to_dataframe()
    assert table["outer_opposite_load_N"][0] == pytest.approx(281.369, rel=1e-5)
    assert table["outer_opposite_traction_heat_W"].notna().all() and "inner_shim_mm" in table
    plain = qs.solve(rubbing(3e3, B218, axial_load=5e3))
    of_case = record(plain, {})
    assert "opposite" not in of_case["balls"][0] and "apex_margin_mm" not in of_case["balls"][0]["inner"]
    assert "opposite" not in of_case["traction"]["balls"][0]
    assert not [name for name in plain.to_dataframe() if "opposite" in name or "shim" in name or "apex" in name]


def test_one_arc_in_a_ring_has_no_opposite_contacts() -> None:
    """A split inner ring: three contacts at most, and the outer one carries angles of either sign."""
    solution = qs.solve(rubbing(np.array([0.0, 12e3]), replace(QJ, outer_shim=None), axial_load=-8e3))
    assert solution.converged.all() and solution.opposite is not None
    assert solution.opposite.outer is None and solution.opposite.inner is not None
    assert (solution.outer.angle < 0.0).all() and (solution.opposite.inner.load > 0.0).all()
    ball = record(solution, {}, (1,))["balls"][0]
    assert ball["opposite"]["outer"]["load_N"] is None


@pytest.mark.parametrize(
    ("changed", "fields"),
    [
        ({"raceway_control": "outer"}, ["raceway_control"]),
        ({"raceway_control": None, "ball_effects": ()}, ["raceway_control"]),
        ({"readings": {"film": {}, "life": {}, "frequencies": {}}}, ["readings.film", "readings.frequencies"]),
        (
            {"ring_effects": (qs.RingExpansion(bore_diameter=0.09, outside_diameter=0.16),), "tolerance": 0.01},
            ["ring_expansion", "tolerance"],
        ),
        ({"preload": qs.Preload(rigid=100.0), "operation": qs.Operation(1e3)}, ["preload"]),
        (
            {"operation": qs.Operation(1e3, axial_load=1e3, moment_z=10.0), "raceway_control": "inner"},
            ["raceway_control"],
        ),
        ({"operation": qs.Operation(1e3, axial_load=1e3, moment_z=10.0)}, ["operation.tilt_z"]),
    ],
)
def test_what_is_not_known_is_refused_by_name(changed: dict[str, Any], fields: list[str]) -> None:
    scene = rubbing(1e4, axial_load=5e3)
    with pytest.raises(qs.SceneError) as caught:
        replace(scene, **changed)
    assert [each.field for each in caught.value.errors] == fields


@pytest.mark.parametrize(
    "name", ["kinematics", "frequencies", "stress", "pivot_points", "static_safety", "ball_advance"]
)
def test_readings_that_know_one_contact_a_ring_refuse_it(name: str) -> None:
    solution = qs.solve(rubbing(1e4, axial_load=5e3))
    with pytest.raises(qs.SceneError) as caught:
        getattr(qs.readings, name)(solution)
    assert [each.field for each in caught.value.errors] == [f"readings.{name}"]


def test_pictures_and_rows_refuse_it() -> None:
    from qsbearing.pictures import load_distribution

    with pytest.raises(qs.SceneError, match="two contacts with one ring"):
        load_distribution(qs.solve(rubbing(1e4, axial_load=5e3)))
    with pytest.raises(qs.SceneError, match=r"row 1\.bearing: is a four-point bearing"):
        qs.BearingSet((qs.Row(QJ, 0.0, "+x"),), qs.Operation(axial_load=1e3))  # type: ignore[arg-type]


def test_a_range_of_friction_gives_a_band() -> None:
    from qsbearing.model.solution.friction_band import friction_band

    law = Traction(0.06, friction_range=(0.05, 0.07), radial_points=4, points_around=12)
    solution = qs.solve(rubbing(1e4, traction=law, axial_load=5e3))
    band = friction_band(solution)
    assert band is not None
    least, most = (ends[0] for ends in band.displacement)
    assert least <= solution.displacement[0] <= most and most - least > 1e-9
