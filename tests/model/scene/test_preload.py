"""Preload: by a spring, by the load at rest, by a displacement; what growing rings and speed make of it."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.model.solution.judgement import percent
from tests.qsbearing.scenes import B218, BOTH, DEEP_GROOVE, OUTER, SPINDLE, resting, solved
from tests.qsbearing.similarity import GROWN, cold_fits, grown, warm_fits

HOT = 90.0 + qs.zero_celsius


def preloaded(preload: qs.Preload, *ring_effects: Any, bearing: qs.BallBearing = SPINDLE, **operation: Any) -> qs.Scene:
    """At rest without a speed, else with both ball effects."""
    effects, control = (BOTH, OUTER) if "speed" in operation else ((), None)
    return qs.Scene(bearing, qs.Operation(**operation), effects, control, ring_effects=ring_effects, preload=preload)


def rings(**parameters: Any) -> qs.RingExpansion:
    """Of the spindle bearing."""
    return qs.RingExpansion(65 * qs.mm, 115 * qs.mm, **parameters)


def axial(preload: qs.Preload, *ring_effects: Any, **operation: Any) -> float:
    """The preload in operation."""
    return float(solved(preloaded(preload, *ring_effects, **operation)).load[0])


def test_a_rigid_preload_is_two_solves_in_one() -> None:
    """The displacement that 500 N take at rest, held at speed: to the solver's own accuracy."""
    found = solved(preloaded(qs.Preload(rigid=500.0), speed=12_000 * qs.rpm))
    place = solved(resting(SPINDLE, axial_load=500.0)).displacement[0]
    by_hand = qs.Scene(SPINDLE, qs.Operation(speed=12_000 * qs.rpm, axial_displacement=place), BOTH, OUTER)
    assert found.load[0] == pytest.approx(solved(by_hand).load[0], rel=1e-9)
    assert found.displacement[0] == pytest.approx(place, rel=1e-9)
    assert found.preload_at_rest == pytest.approx(500.0, rel=1e-9)
    at_rest = solved(preloaded(qs.Preload(rigid=500.0)))
    assert at_rest.load[0] == pytest.approx(500.0, rel=1e-9)


def test_what_raises_a_rigid_preload_and_leaves_a_spring() -> None:
    rigid, spring = qs.Preload(rigid=500.0), qs.Preload(spring=500.0)
    growing: tuple[tuple[Any, ...], ...] = (
        (rings(inner_ring_temperature=50 + qs.zero_celsius), rings(inner_ring_temperature=HOT)),
        (rings(shaft_interference=10 * qs.um), rings(shaft_interference=20 * qs.um)),
    )
    for effects in growing:
        loads = [500.0, *(axial(rigid, effect) for effect in effects)]
        assert loads[0] * 1.1 < loads[1] < loads[2] / 1.05
        assert [axial(spring, effect) for effect in effects] == pytest.approx([500.0, 500.0], rel=1e-9)
    speeds = [axial(rigid, rings(), speed=rpm * qs.rpm) for rpm in (1.0, 6_000.0, 12_000.0)]
    assert speeds[0] < speeds[1] < speeds[2]
    ball_force_alone = axial(rigid, speed=12_000 * qs.rpm)
    assert 500.0 < ball_force_alone < speeds[2], "both raise it"
    assert axial(spring, rings(), speed=12_000 * qs.rpm) == pytest.approx(500.0, rel=1e-9)


def test_growing_rings_raise_what_a_moved_datum_would_lower() -> None:
    """10 um less clearance, of cold balls, with the position held. Counted from where the tighter bearing just touches,
    the same displacement would carry less than before; the ring that is held in its place carries more."""
    strain = 5 * qs.um / float(B218.inner_groove_centre_radius)
    effect = qs.RingExpansion(90 * qs.mm, 160 * qs.mm, inner_ring_temperature=20 + qs.zero_celsius + strain / 12e-6)
    balls = qs.BallExpansion(20 + qs.zero_celsius)
    found = solved(preloaded(qs.Preload(rigid=2000.0), effect, balls, bearing=B218))
    tight = found.scene.operating_bearing
    grooves = 2 * (tight.inner_groove_radius - B218.inner_groove_radius)
    assert B218.diametral_clearance - tight.diametral_clearance == pytest.approx(10 * qs.um - grooves, rel=1e-9)
    trap = solved(resting(replace(B218, **lengths(tight)), axial_displacement=found.displacement[0])).load[0]
    assert trap < 2000.0 < 2500.0 < found.load[0]
    # The ring where it is, its groove's centre further in it, seen from where the tight bearing touches.
    further = 5 * qs.um / float(B218.inner_groove_centre_radius) * B218.groove_centre_offsets[0]
    moved = found.displacement[0] + further - (tight.touching_offset - B218.touching_offset)
    assert solved(resting(tight, axial_displacement=moved)).load[0] == pytest.approx(found.load[0], rel=1e-9)


@pytest.mark.parametrize(
    ("preload", "power"),
    [({"spring": 3000.0}, 0), ({"rigid": 3000.0}, 2), ({"axial_displacement": 20 * qs.um}, 1)],
)
def test_uniform_heat_is_a_similarity(preload: dict[str, float], power: int) -> None:
    """All lengths grow by s = 1 + alpha dT, held displacements among them, and forces by s^2, but for a spring's: the
    grown bearing, cold and with grown fits, is the same."""
    (kind, value), s = *preload.items(), GROWN
    loads = {"radial_load_y": 2e3, "radial_load_z": 500.0, "moment_y": 0.0, "moment_z": 30.0}
    warm = solved(qs.Scene(B218, qs.Operation(**loads), ring_effects=warm_fits(), preload=qs.Preload(**preload)))
    given = qs.Preload(**{kind: value * s**power})
    same = solved(qs.Scene(grown(), qs.Operation(**loads), ring_effects=cold_fits(), preload=given))
    for name in ("angle", "load", "max_pressure"):
        np.testing.assert_allclose(getattr(warm.inner, name), getattr(same.inner, name), rtol=1e-8)
    np.testing.assert_allclose(warm.load, same.load, rtol=1e-8, atol=1e-6)
    np.testing.assert_allclose(warm.displacement, same.displacement, rtol=1e-8, atol=1e-15)


def test_groove_centres_move_axially_in_their_rings_and_held_displacements_with_the_shaft() -> None:
    """The groove centres, d and the touching ball: (r - D/2) sin a0 of each ring, and what the preload has moved the
    inner ring by, grow with their bodies; balls of another temperature do not matter to where grooves are."""
    bodies = {"shaft": 60.0, "inner_ring": 50.0, "outer_ring": 35.0}
    scene = preloaded(
        qs.Preload(rigid=2e3),
        *warm_fits(**{body: celsius + qs.zero_celsius for body, celsius in bodies.items()}),
        bearing=B218,
    )
    found = solved(scene)
    held = solved(resting(axial_load=2e3)).displacement[0]
    assert found.displacement[0] == pytest.approx(held * (1 + 12e-6 * 40.0), rel=1e-9)
    line = found.inner.approach[0] + found.outer.approach[0] + found.scene.operating_bearing.groove_centre_distance
    arm = float(B218.inner_groove_radius - 0.5 * B218.ball_diameter) * np.sin(B218.free_contact_angle)
    apart = arm * (1 + 12e-6 * 30.0) + arm * (1 + 12e-6 * 15.0) + found.displacement[0]
    assert line * np.sin(found.inner.angle[0]) == pytest.approx(apart, rel=1e-9)


def lengths(bearing: qs.BallBearing) -> dict[str, Any]:
    names = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius", "free_contact_angle")
    return {name: getattr(bearing, name) for name in names}


def test_a_displacement_counts_from_just_touching() -> None:
    found = solved(preloaded(qs.Preload(axial_displacement=8 * qs.um), speed=9_000 * qs.rpm))
    assert found.displacement[0] == pytest.approx(8 * qs.um, rel=1e-9)
    assert found.preload_at_rest == pytest.approx(
        solved(resting(SPINDLE, axial_displacement=8 * qs.um)).load[0], rel=1e-9
    )
    assert solved(preloaded(qs.Preload(axial_displacement=-8 * qs.um))).preload_at_rest == 0.0


def test_arrays_span_cases_and_other_channels_stay_what_they_are() -> None:
    loads = {"radial_load_y": 300.0, "moment_z": 0.0}
    preload = qs.Preload(rigid=np.array([[300.0], [900.0]]))
    many = solved(preloaded(preload, speed=np.array([0.0, 5e3, 9e3]) * qs.rpm, **loads))
    assert many.shape == (2, 3)
    np.testing.assert_allclose(many.preload_at_rest, [[300.0] * 3, [900.0] * 3], rtol=1e-9)
    one = solved(preloaded(qs.Preload(rigid=900.0), speed=5e3 * qs.rpm, **loads))
    np.testing.assert_allclose(many.load[1, 1], one.load, rtol=1e-8, atol=1e-6)
    assert np.isnan(one.compliance[0]).all(), "the axial displacement is held"
    spring = solved(preloaded(qs.Preload(spring=900.0), speed=5e3 * qs.rpm, **loads))
    assert np.isfinite(spring.compliance).all()
    assert spring.load[1] == one.load[1] == pytest.approx(300.0)


def test_any_preload_can_be_mounted_that_does_not_crush_the_bearing() -> None:
    """From nothing to a thousand times what it bears; beyond, the case says so, and the others are solved."""
    loads = np.array([0.0, 1e-6, 1.0, 1e4, 1e6, 1e8])
    wide = dict.fromkeys(("inner_groove_radius", "outer_groove_radius"), 0.95 * DEEP_GROOVE.ball_diameter)
    solution = qs.solve(preloaded(qs.Preload(rigid=loads), bearing=replace(DEEP_GROOVE, **wide)))
    np.testing.assert_allclose(solution.load[:5, 0], loads[:5], rtol=1e-9)
    assert solution.status[5] == "no_equilibrium"
    assert qs.message(solution, 5).startswith("At rest and cold, under its preload alone: No equilibrium")
    assert np.isnan(solution.preload_at_rest[5])


@pytest.mark.parametrize("rpm", [0.0, 8_000.0])
def test_a_preload_before_fitting_mounted_and_in_operation(rpm: float) -> None:
    """Three solves by hand: the cold bearing at the place that 300 N took, with its fit at rest, and in operation."""
    fit = {"shaft_interference": 8 * qs.um}
    tight, warm = rings(**fit), rings(**fit, inner_ring_temperature=50 + qs.zero_celsius)
    found = solved(preloaded(qs.Preload(rigid=300.0), warm, speed=rpm * qs.rpm, radial_load_y=50.0, tilt_z=0.0))
    place = solved(resting(SPINDLE, axial_load=300.0)).displacement[0]
    mounted = solved(replace(resting(SPINDLE, axial_displacement=place), ring_effects=(tight,))).load[0]
    alone = solved(preloaded(qs.Preload(rigid=300.0), warm, speed=rpm * qs.rpm)).load[0]
    assert found.preload_unmounted == found.preload_at_rest == pytest.approx(300.0, rel=1e-9)
    assert found.preload_mounted == pytest.approx(mounted, rel=1e-9)
    assert mounted > 450.0
    assert found.preload_in_operation == pytest.approx(alone, rel=1e-9)
    # given as the mounted load, it is the same preload
    given = qs.Preload(mounted=mounted)
    same = solved(replace(found.scene, preload=given))
    np.testing.assert_allclose(same.displacement, found.displacement, rtol=1e-9, atol=1e-15)
    assert same.preload_at_rest == same.preload_mounted == pytest.approx(mounted, rel=1e-9)
    assert same.preload_unmounted == pytest.approx(300.0, rel=1e-9)
    cold = solved(preloaded(given, tight))
    assert cold.load[0] == pytest.approx(mounted, rel=1e-9), "at rest and cold it is what it says"


def preload_warnings(preload: qs.Preload, *ring_effects: Any, **operation: Any) -> list[str]:
    """What is said of the preload itself."""
    said = qs.warnings(qs.solve(preloaded(preload, *ring_effects, **operation)))
    return [each for each in said if each.startswith("Preload")]


def test_a_bearing_warns_of_a_preload_that_has_grown_or_fallen() -> None:
    """By the judgement of sets: beyond three times, below a hundredth; below half, what is left and the stiffness."""
    rigid = qs.Preload(rigid=300.0)
    assert preload_warnings(rigid) == preload_warnings(qs.Preload(spring=300.0), speed=12_000 * qs.rpm) == []
    fit = rings(shaft_interference=20 * qs.um)
    (said,) = preload_warnings(rigid, fit)
    found = solved(preloaded(rigid, fit))
    assert found.preload_state == "excessive"
    three = f"{found.preload_unmounted:.4g} N before fitting, {found.preload_mounted:.4g} N mounted"
    assert said.startswith(
        f"Preload excessive: the bearing is pressed by {three} and {found.load[0]:.4g} N in operation"
    )
    assert preload_warnings(qs.Preload(mounted=300.0), fit) == [], "the fit is in it"
    (lost,) = preload_warnings(rigid, rings(outer_ring_temperature=60 + qs.zero_celsius))
    assert lost == "Preload lost: the bearing carries 0 N in operation; its preload is 300 N before fitting."
    warm = rings(outer_ring_temperature=22.5 + qs.zero_celsius)
    (fallen,), found = preload_warnings(rigid, warm), solved(preloaded(rigid, warm))
    assert 0.01 < found.preload_share < 0.5
    assert found.preload_state == "reduced"
    before = solved(preloaded(rigid)).stiffness[0, 0] / 1e6
    part = f"of its preload of 300 N before fitting ({100 * found.preload_share:.3g} %)"
    assert f"speed and heat leave the bearing only {found.load[0]:.4g} N {part}" in fallen
    assert f"fell from {before:.4g} N/µm mounted to {found.stiffness[0, 0] / 1e6:.4g} N/µm" in fallen
    several = solved(preloaded(qs.Preload(rigid=np.array([300.0, 5000.0])), fit))
    assert list(several.preload_state) == ["excessive", "maintained"]
    assert any(each.startswith("1 of 2 cases, the first 0: Preload excessive") for each in qs.warnings(several))


# Files and results ----------------------------------------------------------------------------------------------------

HEAD = '[bearing]\nname = "7210C"\n[operation]\nspeed_rpm = 12000\n'
EFFECTS = '[effects]\nball = ["centrifugal_force"]\nraceway_control = "outer"\n'


@pytest.mark.parametrize(
    ("key", "value", "preload"),
    [
        ("spring_N", 400, qs.Preload(spring=400.0)),
        ("rigid_N", 400, qs.Preload(rigid=400.0)),
        ("mounted_N", 400, qs.Preload(mounted=400.0)),
        ("axial_displacement_um", 5, qs.Preload(axial_displacement=5e-6)),
    ],
)
def test_files_have_it_and_results_say_it(tmp_path: Path, key: str, value: float, preload: qs.Preload) -> None:
    file, target = tmp_path / "scene.toml", tmp_path / "out.csv"
    file.write_text(f"{HEAD}[preload]\n{key} = {value}\n{EFFECTS}")
    scene = qs.load_scene(file)
    assert getattr(scene.preload, preload.kind) == pytest.approx(getattr(preload, preload.kind), rel=1e-15)
    solution = solved(scene)
    found = json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).stdout)["preload"]
    assert found["kind"] == preload.kind
    assert found["at_rest_N"] == pytest.approx(solution.preload_at_rest, rel=1e-9)
    assert found["in_operation_N"] == pytest.approx(solution.load[0], rel=1e-9)
    assert found["unmounted_N"] == found["mounted_N"] == found["at_rest_N"], "without fits"
    assert found["carried_N"] == found["in_operation_N"]
    assert found["alone_N"] == pytest.approx(solution.preload_in_operation, rel=1e-9)
    share = solution.preload_in_operation / solution.preload_at_rest
    assert (found["share"], found["state"]) == (pytest.approx(share, rel=1e-9), solution.preload_state)
    shown = CliRunner().invoke(cli, ["run", str(file), "--csv", str(target)]).stdout
    three = (
        "{unmounted_N:.6g} N before fitting, {mounted_N:.6g} N mounted, at rest, {in_operation_N:.6g} N in operation"
    )
    assert (
        f"{three.format(**found)}: {found['state']}; without external loads {percent(share, digits=3)} of the given"
        in (" ".join(shown.split()))
    )
    with target.open(newline="") as written:
        row = next(csv.DictReader(written))
    assert float(row[f"preload_{key}"]) == pytest.approx(value)
    for state in ("at_rest_N", "unmounted_N", "mounted_N"):
        assert float(row[f"preload_{state}"]) == pytest.approx(found[state], rel=1e-12)
    assert json.loads(CliRunner().invoke(cli, ["run", "b218", "--json"]).stdout)["preload"] is None


@pytest.mark.parametrize(
    ("operation", "table", "words"),
    [
        ("axial_load_N = 500\n", "rigid_N = 500\n", {"operation.axial_load_N": "together with a preload"}),
        (
            "axial_displacement_um = 5\n",
            "spring_N = 5\n",
            {"operation.axial_displacement_um": "together with a preload"},
        ),
        ("", "rigid_N = 500\nspring_N = 2\n", {"preload.spring_N": "is given together with preload.rigid_N"}),
        ("", "", {"preload.spring_N": "is missing"}),
        ("", "rigid_kN = 0.5\n", {"preload.rigid_kN": "rigid_N = 500"}),
        ("", "rigid_N = -5\n", {"preload.rigid_N": "is negative"}),
        ("", "spring_N = 'five'\n", {"preload.spring_N": "is not a number"}),
        ("axial_load_N = 1\n", "spring_N = 1e12\n", {"operation.axial_load_N": "preload", "preload.spring_N": "large"}),
    ],
)
def test_what_is_refused(tmp_path: Path, operation: str, table: str, words: dict[str, str]) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(f"{HEAD}{operation}[preload]\n{table}")
    with pytest.raises(qs.SceneFileError) as caught:
        qs.load_scene(file)
    found = {error.key: str(error) for error in caught.value.errors}
    assert found.keys() == words.keys()
    for key, word in words.items():
        assert word in found[key]


def test_python_refuses_alike() -> None:
    with pytest.raises(qs.SceneError, match="together with a preload"):
        qs.Scene(B218, qs.Operation(axial_load=5.0), preload=qs.Preload(spring=5.0))
    with pytest.raises(qs.SceneError, match="is not a preload"):
        qs.Scene(B218, qs.Operation(), preload=500.0)
    with pytest.raises(qs.SceneError, match="is missing"):
        qs.Preload()
