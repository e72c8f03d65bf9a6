"""Seats out of round: what turns and what cancels, other bearings, springs and energy, and what is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files import catalogue
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.effects import EFFECTS
from qsbearing.model.solution.judgement import judge
from tests.model.effects.uneven import contacts, turned
from tests.qsbearing.mechanics import lobe, ring_load, stored_energy
from tests.qsbearing.scenes import (
    B218,
    DEEP_GROOVE,
    INNER,
    LOADS,
    MINIMUM_DISSIPATION,
    OUTER,
    SPINDLE,
    held_at,
    lever,
    loaded_as,
    lobes,
    resting,
    solved,
    turning,
    unequal_balls,
    with_operation,
)

FIVE = {"axial_load": 12e3, "radial_load_y": 3e3, "radial_load_z": -1.5e3, "moment_y": 40.0, "moment_z": -60.0}
PLAIN = {"axial_load": 12e3, "radial_load_y": 3e3, "moment_z": 0.0}
STRAIGHT = {"tilt_y": 0.0, "tilt_z": 0.0}
NUMBERS = {2: "two", 3: "three"}


def of(scene: qs.Scene, **seats: Any) -> qs.Scene:
    """The scene with such seats, beside its other ring effects."""
    return replace(scene, ring_effects=(*scene.ring_effects, qs.SeatsOutOfRound(**seats)))


def form(ring: str, number: int, amplitude: Any, phase: Any = 0.0) -> dict[str, Any]:
    """One form, by the names of its fields."""
    name = f"{ring}_{NUMBERS[number]}_lobe"
    return {f"{name}_amplitude": amplitude, f"{name}_phase": phase}


def codes(solution: qs.Solution) -> set[str]:
    """Of what is remarked."""
    return {each.remark.code for each in qs.warnings(solution)}


def assert_same(one: qs.Solution, other: qs.Solution, rel: float, turns: int = 0) -> None:
    """The same in every contact, of balls so many places farther on."""
    for name, array in contacts(one).items():
        assert contacts(other)[name] == pytest.approx(np.roll(array, turns, axis=-1), rel=rel), name


# ------------------------------------------------------------------------------------------------ what turns, cancels


def test_lobes_and_loads_that_go_round_turn_the_answer() -> None:
    """By three balls of sixteen: the rings turned with the load are the same bearing."""
    turns, seats = 3, lobes()
    angle = 2.0 * np.pi * turns / 16
    load = np.array([FIVE[name] for name in LOADS])

    scene = turning(8000, **FIVE)
    on = {name: value + angle * name.endswith("phase") for name, value in vars(seats).items()}
    one, other = solved(of(scene, **vars(seats))), solved(of(loaded_as(scene, turned(load, angle)), **on))
    size = np.array([1e-5, 1e-5, 1e-5, 1e-4, 1e-4])
    assert other.displacement / size == pytest.approx(turned(one.displacement, angle) / size, abs=1e-9)
    assert_same(one, other, 1e-9, turns)


@pytest.mark.parametrize("number", [2, 3])
@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_a_phase_a_whole_lobe_farther_is_the_same_form(ring: str, number: int) -> None:
    scene = turning(8000, **FIVE)
    one, other = (solved(of(scene, **form(ring, number, 2e-6, phase))) for phase in (0.3, 0.3 + 2.0 * np.pi / number))
    assert one.displacement == pytest.approx(other.displacement, rel=1e-9)
    assert_same(one, other, 1e-9)


@pytest.mark.parametrize("number", [2, 3])
def test_a_crest_of_the_inner_ring_is_a_valley_of_the_outer_one(number: int) -> None:
    """Half a lobe farther on, at rest and at speed: what counts is how near the grooves stand."""
    for scene in (turning(8000, **FIVE), turning(6000, control=INNER, **FIVE), resting(**FIVE)):
        one = solved(of(scene, **form("inner", number, 2e-6, 0.3)))
        other = solved(of(scene, **form("outer", number, 2e-6, 0.3 + np.pi / number)))
        assert one.displacement == pytest.approx(other.displacement, rel=1e-9)
        assert_same(one, other, 1e-9)


def test_both_rings_alike_are_as_round_ones() -> None:
    """Crest upon crest, the same amplitude: nothing stands nearer anywhere."""
    scene = turning(8000, **FIVE)
    both = solved(of(scene, **form("inner", 2, 3e-6, 1.1), **form("outer", 2, 3e-6, 1.1)))
    round_one = solved(scene)
    assert both.displacement == pytest.approx(round_one.displacement, rel=1e-10)
    assert_same(both, round_one, 1e-10)


def test_two_lobes_under_thrust_leave_the_ring_where_it_is() -> None:
    """Balls that face each other carry alike, so that nothing moves the ring aside or tilts it; three lobes repeat
    every 120 degrees, of fifteen balls every five."""
    size = np.array([1e-9, 1e-9, 1e-9, 1e-8])
    oval = solved(of(turning(8000, axial_load=12e3), **form("outer", 2, 2e-6, 0.4)))
    assert oval.displacement[1:] / size == pytest.approx(np.zeros(4), abs=1e-4)
    assert oval.inner.load == pytest.approx(np.roll(oval.inner.load, 8), rel=1e-9)
    assert np.ptp(oval.inner.load) > 0.01 * oval.inner.load.max()
    fifteen = turning(8000, replace(B218, ball_count=15), axial_load=12e3)
    three = solved(of(fifteen, **form("outer", 3, 2e-6, 0.4)))
    assert three.displacement[1:] / size == pytest.approx(np.zeros(4), abs=1e-4)
    assert three.inner.load == pytest.approx(np.roll(three.inner.load, 5), rel=1e-9)


def test_the_phase_is_where_the_inner_raceway_stands_out() -> None:
    """The crest of the inner ring presses, that of the outer ring gives room; at +y for 0, at +z for 90 degrees."""
    scene = resting(axial_load=12e3, **STRAIGHT)
    for number in NUMBERS:
        for phase, ball in ((0.0, 0), (0.5 * np.pi, 4), (-0.5 * np.pi, 12)):
            assert solved(of(scene, **form("inner", number, 2e-6, phase))).inner.load.argmax() % 16 in {
                ball, (ball + 16 // number) % 16, *((ball + 8,) if number == 2 else ())
            }  # fmt: skip
            assert solved(of(scene, **form("outer", number, 2e-6, phase))).inner.load[ball] < 0.99 * 1200.0


# ------------------------------------------------------------------------------------------------ none is none


@pytest.mark.parametrize(
    "scene",
    [
        turning(8000, axial_load=12e3),
        turning(8000, **PLAIN),
        turning(8000, **FIVE),
        replace(turning(9000, control=MINIMUM_DISSIPATION, **PLAIN), orbit_radius="displaced"),
        replace(resting(radial_load_y=2e3, tilt_y=0.0, tilt_z=0.0), preload=qs.Preload(rigid=2e3)),
        replace(turning(8000, **FIVE), ring_effects=(unequal_balls(),)),
    ],
    ids=["thrust", "one plane", "five loads", "minimum dissipation, own orbits", "preload", "unequal balls"],
)
def test_no_amplitude_is_none_to_the_last_bit(scene: qs.Scene) -> None:
    one, absent = solved(of(scene, **form("outer", 2, 0.0, 0.3))), solved(scene)
    for name in ("displacement", "load", "iterations", "residual", "stiffness"):
        assert np.array_equal(getattr(one, name), getattr(absent, name)), name
    for name, array in contacts(one).items():
        assert np.array_equal(array, contacts(absent)[name], equal_nan=True), name


# ------------------------------------------------------------------------------------------------ bearings, springs


@pytest.mark.parametrize(("number", "amplitude"), [(3, 4e-6), (3, 0.0), (2, 4e-6)])
def test_lobes_that_all_balls_meet_are_another_bearing(number: int, amplitude: float) -> None:
    """As many balls as lobes, each at a crest: the inner groove stands farther out everywhere. Under thrust, with
    curvatures at each contact's own angle, nothing else is left of the round bearing."""
    few = replace(B218, ball_count=number)
    scene = resting(few, hertz_angle="actual", axial_load=3e3, radial_displacement_y=0.0, radial_displacement_z=0.0,
                    **STRAIGHT)  # fmt: skip
    wider = few.with_changed_lengths(inner_groove_centre=amplitude)
    one, same = solved(of(scene, **form("inner", number, amplitude))), solved(replace(scene, bearing=wider))
    datum = float(wider.touching_offset - few.touching_offset)
    assert one.displacement[0] - datum == pytest.approx(same.displacement[0], rel=1e-6)
    assert one.inner.load == pytest.approx(same.inner.load, rel=1e-6)
    assert one.inner.angle == pytest.approx(same.inner.angle, rel=1e-6)
    if amplitude:
        assert abs(one.inner.angle[0] / solved(scene).inner.angle[0] - 1.0) > 1e-3


@pytest.mark.parametrize("bearing", [B218, SPINDLE, DEEP_GROOVE], ids=["B218", "spindle", "deep groove"])
def test_held_rings_press_each_ball_by_its_own_spring(bearing: qs.BallBearing) -> None:
    """Q = K (|A| - BD)^1.5 with A2 = (19.4) + r_i - r_o, in closed form: both contacts of a ball at rest in series."""
    angle, size = float(np.asarray(bearing.free_contact_angle)), 2e-6
    place = np.array([12e-6, 6e-6, -4e-6, 5e-5, -3e-5])
    scene = of(held_at(resting(bearing), place), **vars(lobes(size)))
    solution = solved(scene)
    psi, length = solution.azimuth, float(bearing.groove_centre_distance)
    tilt = lever(scene) * (place[3] * np.sin(psi) - place[4] * np.cos(psi))
    axial = length * np.sin(angle) + place[0] + tilt
    across = length * np.cos(angle) + place[1] * np.cos(psi) + place[2] * np.sin(psi)
    approach = np.hypot(axial, across + lobe(solution)) - length
    series = solved(held_at(resting(bearing), [8e-6, 5e-6, 0.0, 0.0, 0.0]))
    own = np.hypot(length * np.sin(angle) + 8e-6, length * np.cos(angle) + 5e-6 * np.cos(psi)) - length
    stiffness = series.inner.load[0] / own[0] ** 1.5
    expected = stiffness * np.maximum(approach, 0.0) ** 1.5
    assert solution.inner.load == pytest.approx(expected, rel=1e-9)
    round_ones = stiffness * np.maximum(np.hypot(axial, across) - length, 0.0) ** 1.5
    assert np.abs(expected / np.maximum(round_ones, 1e-3) - 1.0).max() > 0.05


def test_a_small_form_changes_loads_by_their_springs_alone() -> None:
    """To first order the ring feels nothing of two or three lobes, which have neither mean nor first harmonic: dQ =
    k r cos(alpha), the same free and held."""
    free, held = resting(axial_load=17_800.0), resting(axial_load=17_800.0, **STRAIGHT)
    start = solved(free)
    spring = 1.5 * start.inner.load[0] / (start.inner.approach[0] + start.outer.approach[0])
    for scene in (free, held):
        for number in NUMBERS:
            solution = solved(of(scene, **form("inner", number, 1e-8)))
            change = solution.inner.load - start.inner.load[0]
            expected = spring * np.cos(start.inner.angle[0]) * 1e-8 * np.cos(number * solution.azimuth)
            assert change == pytest.approx(expected, abs=0.02 * np.abs(expected).max())
            assert np.abs(solution.displacement - start.displacement)[0] < 1e-11


def test_energy_is_the_work_of_the_radial_loads_on_a_growing_form() -> None:
    """At rest, rings held: d(energy)/d(amplitude) = sum of Q cos(alpha) cos n(psi - phase), integrated by Gauss."""
    place = np.array([12e-6, 6e-6, -4e-6, 5e-5, -3e-5])
    held, largest = held_at(resting(), place), 5e-6
    nodes, weights = np.polynomial.legendre.leggauss(24)
    work = 0.0
    for node, weight in zip(nodes, weights, strict=True):
        solution = solved(of(held, **form("inner", 3, 0.5 * largest * (1.0 + node), 0.4)))
        radial = np.nan_to_num(solution.inner.load * solution.inner.cosine)
        work += 0.5 * largest * weight * float(radial @ np.cos(3.0 * (solution.azimuth - 0.4)))
    start, end = solved(held), solved(of(held, **form("inner", 3, largest, 0.4)))
    gained = stored_energy(end) - stored_energy(start)
    assert work == pytest.approx(gained, rel=1e-6)
    assert abs(gained) > 0.01 * stored_energy(start)


def test_stiffness_is_the_slope_of_the_load() -> None:
    """Exact derivatives, by central differences of prescribed displacements."""
    scene = replace(turning(5000, **FIVE), orbit_radius="displaced", ring_effects=(lobes(3e-6),))
    solution = solved(scene)
    steps = np.array([1e-7, 1e-7, 1e-7, 2e-6, 2e-6])
    at = solution.displacement + np.concatenate([np.diag(steps), -np.diag(steps)])
    loads = solved(held_at(scene, at)).load
    slopes = ((loads[:5] - loads[5:]) / (2.0 * steps[:, None])).T
    own = np.sqrt(np.abs(np.diag(solution.stiffness)))
    assert np.abs((slopes - solution.stiffness) / np.outer(own, own)).max() < 1e-5


def test_elastic_rings_give_way_to_lobes() -> None:
    """A free outer ring bends towards round: the balls' loads differ less than in one that is held, and the grooves
    join the contacts with form and deflection both."""
    scene = replace(resting(axial_load=5e3, **STRAIGHT), ring_effects=())
    rings = qs.ElasticRings(outside_diameter=160 * qs.mm, outer_width=30 * qs.mm, housing="free")
    stiff = solved(of(scene, **form("outer", 2, 4e-6)))
    soft = solved(of(replace(scene, ring_effects=(rings,)), **form("outer", 2, 4e-6)))
    assert np.ptp(soft.inner.load) < 0.9 * np.ptp(stiff.inner.load)
    assert soft.inner.load.argmax() % 8 == stiff.inner.load.argmax() % 8 == 4


# ------------------------------------------------------------------------------------------------ random scenes

AMPLITUDE, PHASE = st.floats(0.0, 8e-6), st.floats(-np.pi, np.pi)


@settings(max_examples=60, deadline=None)
@given(
    sizes=st.tuples(*[AMPLITUDE] * 4), phases=st.tuples(*[PHASE] * 4), axial=st.floats(500.0, 30e3),
    radial=st.floats(0.0, 0.3), direction=PHASE, rpm=st.sampled_from([0.0, 3000.0, 9000.0]),
    first=st.floats(0.0, 0.39), bearing=st.sampled_from([B218, SPINDLE]),
)  # fmt: skip
def test_random_seats_are_in_balance(
    sizes: tuple[float, ...], phases: tuple[float, ...], axial: float, radial: float, direction: float, rpm: float,
    first: float, bearing: qs.BallBearing,
) -> None:  # fmt: skip
    """The ring's loads are the sum of the forces at the contact points, whatever the seats."""
    y, z = (radial * axial * float(each) for each in (np.cos(direction), np.sin(direction)))
    loads = {"axial_load": axial, "radial_load_y": y, "radial_load_z": z, **STRAIGHT, "first_ball_azimuth": first}
    scene = turning(rpm, bearing, control=OUTER, **loads) if rpm else resting(bearing, **loads)
    names = [(ring, number) for ring in ("inner", "outer") for number in NUMBERS]
    seats: dict[str, Any] = {}
    for (ring, number), size, phase in zip(names, sizes, phases, strict=True):
        seats |= form(ring, number, size, phase)
    solution = solved(of(scene, **seats))
    size = max(solution.inner.load.max(), solution.outer.load.max())
    unit = np.array([1.0, 1.0, 1.0, lever(scene), lever(scene)]) * size
    assert ring_load(solution) / unit == pytest.approx(solution.load / unit, abs=1e-11)


# ------------------------------------------------------------------------------------------------ hard cases


def test_an_amplitude_that_closes_the_clearance_is_solved_and_told() -> None:
    """Ten micrometres of radial clearance: lobes of fourteen close it while the ring stands centred, and it can evade
    them between seven balls; those of twenty press balls against each other without any load."""
    loose = qs.BallBearing.from_diametral_clearance(
        **{name: getattr(DEEP_GROOVE, name) for name in ("ball_count", "ball_diameter", "pitch_diameter",
           "inner_groove_radius", "outer_groove_radius", "ball_material", "ring_material", "kind")},
        diametral_clearance=20e-6,
    )  # fmt: skip
    across = {"radial_load_y": 0.0, "radial_load_z": 0.0}
    scene = resting(loose, axial_displacement=-float(loose.touching_offset), **across, **STRAIGHT)
    for amplitude, is_told, is_wedged in ((8e-6, False, False), (14e-6, True, False), (20e-6, True, True)):
        solution = solved(of(scene, **form("outer", 3, amplitude, np.pi / 3.0)))
        load = np.nan_to_num(solution.inner.load)
        assert bool(load.max() > 1.0) is is_wedged
        assert load @ np.cos(solution.azimuth) == pytest.approx(0.0, abs=1e-9 * max(load.max(), 1.0))
        assert ("lobes_wedge" in codes(solution)) is is_told


def test_a_ring_that_lobes_wedge_has_a_place_without_load() -> None:
    """It is said to be undetermined only where no ball holds it."""
    scene = resting(DEEP_GROOVE, axial_load=0.0)
    assert "ring_unloaded" in codes(solved(scene))
    for seats in (qs.SeatsOutOfRound(**form("outer", 3, 6e-6)), qs.BallDiameterDeviations(np.full(7, 2e-6))):
        wedged = solved(replace(scene, ring_effects=(seats,)))
        assert wedged.inner.load.max() > 1.0
        assert "ring_unloaded" not in codes(wedged)


@pytest.mark.parametrize("load", [0.0, 1e-9, 1e-3])
def test_hardly_any_load_beside_what_lobes_press(load: float) -> None:
    """What counts is the imbalance over the contacts' loads: over a nanonewton, rounding would never do."""
    scene = of(resting(DEEP_GROOVE, radial_load_y=load, moment_z=0.0), **form("outer", 3, 6e-6, 0.2))
    solution = solved(scene)
    assert solution.inner.load.max() > 10.0
    assert solution.iterations < 30


def test_turning_lobes_are_told() -> None:
    """Those of the ring that turns, and no others."""
    for seats, rpm, outer_rpm, expected in (
        (form("inner", 2, 1e-6), 3000, 0, True),
        (form("outer", 2, 1e-6), 3000, 0, False),
        (form("outer", 2, 1e-6), 0, 3000, True),
        (form("inner", 2, 0.0), 3000, 0, False),
    ):
        solution = solved(of(turning(rpm, outer_rpm=outer_rpm, **PLAIN), **seats))
        assert ("lobes_turn" in codes(solution)) is expected


@pytest.mark.parametrize("amplitude", [50e-6, 200e-6])
def test_large_lobes_unload_balls(amplitude: float) -> None:
    """Far beyond any approach, at rest and at speed: some balls carry all of the thrust; at speed inertia opens
    the angles, and light balls keep both raceways."""
    for scene in (resting(axial_load=2e3), turning(3000, axial_load=2e3)):
        solution = solved(of(scene, **form("outer", 2, amplitude)))
        assert (solution.inner.load == 0.0).any() or scene.ball_effects
        assert solution.load[0] == pytest.approx(2e3)


# ------------------------------------------------------------------------------------------------ cases and results


def test_amplitudes_and_phases_of_cases_are_those_of_each_case_alone() -> None:
    """A turn of the inner ring at once, some of it round, by two speeds: more cases than lanes have."""
    sizes = np.where(np.arange(40)[:, None] % 7 == 0, 0.0, 2e-6)
    phases = np.linspace(0.0, np.pi, 40)[:, None]
    many = solved(of(turning(np.array([4000.0, 9000.0]), **FIVE), **form("inner", 2, sizes, phases)))
    assert many.shape == (40, 2)
    for k in (0, 1, 20, 39):
        for speed, rpm in enumerate((4000.0, 9000.0)):
            seats = form("inner", 2, float(sizes[k, 0]), float(phases[k, 0]))
            one = solved(of(turning(rpm, **FIVE), **seats))
            assert np.array_equal(many.displacement[k, speed], one.displacement)
            for name, array in contacts(one).items():
                assert np.array_equal(contacts(many)[name][k, speed], array), name
            assert np.array_equal(many.stiffness[k, speed], one.stiffness)


def test_a_solution_starts_from_a_neighbour() -> None:
    scene = replace(turning(8000, **FIVE), ring_effects=(lobes(),))
    near = with_operation(scene, axial_load=12.1e3)
    warm, cold = solved(near, start=solved(scene)), solved(near)
    assert warm.iterations <= cold.iterations
    assert warm.inner.load == pytest.approx(cold.inner.load, rel=1e-10)


def test_balls_that_all_go_round_alike_know_lobes() -> None:
    """The mean of all balls' motion, as under a radial load."""
    scene = replace(of(turning(8000, axial_load=12e3), **form("outer", 2, 3e-6)), ball_motion="common")
    solution = solved(scene)
    assert np.ptp(solution.orbital_speed) == pytest.approx(0.0, abs=1e-9)  # type: ignore[arg-type]
    assert np.ptp(solution.inner.load) > 10.0


def test_a_preload_as_mounted_has_the_seats() -> None:
    """Which the bearing takes when it is fitted, and not before."""
    scene = turning(6000, radial_load_y=2e3, **STRAIGHT)
    for preload, has_them in ((qs.Preload(mounted=300.0), True), (qs.Preload(rigid=300.0), False)):
        lobed = solved(of(replace(scene, preload=preload), **form("outer", 2, 8e-6)))
        assert (lobed.scene.as_preloaded.seats_out_of_round is not None) is has_them  # type: ignore[union-attr]


SCENE = """[bearing]
name = "B218"
[operation]
axial_load_N = 5000
[effects.seats_out_of_round]
{}
"""
OVAL = "outer_two_lobe_amplitude_um = 1.5\nouter_two_lobe_phase_deg = 90"


def test_files_name_them_and_results_repeat_them(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.format(OVAL), encoding="utf-8")
    scene = qs.load_scene(file)
    seats = scene.seats_out_of_round
    assert seats == qs.SeatsOutOfRound(outer_two_lobe_amplitude=1.5 * qs.um, outer_two_lobe_phase=90 * qs.deg)
    found = json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).stdout)
    assert found["effects"] == ["seats_out_of_round"]
    loads = [ball["inner"]["load_N"] for ball in found["balls"]]
    assert loads == pytest.approx(list(solved(scene).inner.load), rel=1e-12)
    assert loads[0] > loads[4], "a crest of the outer ring gives room"
    assert input_tables(scene)["effects"]["seats_out_of_round"] == {
        "outer_two_lobe_amplitude_um": 1.5,
        "outer_two_lobe_phase_deg": 90.0,
    }
    swept = CliRunner().invoke(cli, ["sweep", str(file), "--vary", "outer_two_lobe_amplitude_um=0:2:3"])
    assert swept.exit_code == 0, swept.output


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("outer_two_lobe_amplitude_um = -1", "outer_two_lobe_amplitude_um = -1 µm: is negative"),
        ("outer_two_lobe_phase_deg = 10", "outer_two_lobe_phase_deg: is given without an amplitude"),
        ("inner_four_lobe_amplitude_um = 1", "four and more are waviness"),
        ("outer_1_lobe_amplitude_um = 1", "One lobe is a ring that stands aside"),
        ("outer_two_lobe_amplitude_um = 300", "is more than 1% of the ball diameter"),
        ("", "has no amplitude"),
        (OVAL.replace("90", "400"), "outer_two_lobe_phase_deg = 400 deg: is too large"),
        (OVAL.replace("1.5", '"much"'), "is not a number"),
    ],
)
def test_files_that_are_refused(tmp_path: Path, line: str, words: str) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.format(line), encoding="utf-8")
    done = CliRunner().invoke(cli, ["run", str(file)])
    assert done.exit_code == 2
    assert words in " ".join(done.stderr.split()), done.stderr


def test_every_fault_is_said_at_once() -> None:
    with pytest.raises(qs.SceneError) as raised:
        qs.SeatsOutOfRound(inner_two_lobe_amplitude=-1e-6, outer_three_lobe_phase=0.1, outer_two_lobe_amplitude=np.nan)
    assert {error.field.split(".")[1] for error in raised.value.errors} == {
        "inner_two_lobe_amplitude", "outer_three_lobe_phase", "outer_two_lobe_amplitude"
    }  # fmt: skip


def test_of_many_cases_the_impossible_are_told() -> None:
    sizes = np.array([0.0, 1e-6, 4e-4])
    with pytest.raises(qs.SceneError) as raised:
        of(resting(axial_load=1e3), **form("inner", 3, sizes))
    assert np.array_equal(raised.value.errors[0].where, [False, False, True])


def test_what_is_estimated_of_one_effect_is_its_own_beside_another() -> None:
    """Whichever of the two stands first in the scene."""
    both = of(replace(turning(8000, **FIVE), ring_effects=(unequal_balls(),)), **form("outer", 2, 2e-6, 0.3))
    one, other = solved(both), solved(replace(both, ring_effects=both.ring_effects[::-1]))
    for entry in (each for each in EFFECTS if each.name in ("unequal_balls", "seats_out_of_round")):
        errors = judge(entry, one).errors
        assert errors["pressure"] > 1e-3
        assert judge(entry, other).errors == pytest.approx(errors, rel=1e-9)


@pytest.mark.parametrize(("load", "least", "most"), [(230.0, 0.55, 0.65), (520.0, 0.33, 0.38), (1040.0, 0.2, 0.25)])
def test_a_micrometre_in_a_spindle_bearing_of_70_mm(load: float, least: float, most: float) -> None:
    """A 7014C, by sizes that fit its printed ratings: an oval of a micrometre changes the balls' loads by six tenths at
    a light preload, by a third at a medium one."""
    bearing = qs.BallBearing(
        ball_count=19, ball_diameter=11.906e-3, pitch_diameter=90e-3, inner_groove_radius=6.191e-3,
        outer_groove_radius=6.191e-3, free_contact_angle=15 * qs.deg, ball_material=qs.STEEL, ring_material=qs.STEEL,
    )  # fmt: skip
    scene = resting(bearing, axial_load=load)
    change = solved(of(scene, **form("outer", 2, 1e-6))).inner.load / solved(scene).inner.load - 1.0
    assert least < np.abs(change).max() < most


CHOICES = [
    dict(zip(("hertz_angle", "hertz_form", "tilt_lever", "orbit_radius", "raceway_control"), each, strict=True))
    for each in product(
        qs.HertzAngle,
        qs.HertzForm,
        qs.TiltLever,
        qs.OrbitRadius,
        [each for each in qs.RacewayControl if each != "friction"],
    )
]


@pytest.mark.parametrize("name", [entry.name for entry in catalogue.entries()])
def test_every_choice_of_every_bearing_of_the_catalogue_knows_lobes(name: str) -> None:
    """The same two ways, by a crest of the inner ring and by a valley of the outer one; and not as without any."""
    bearing = qs.load_scene(name).bearing
    load = 0.02 * float(np.asarray(bearing.ball_diameter) ** 2) * 1e9 / 16.0
    at_speed = turning(3000, bearing, axial_load=load, radial_load_y=0.1 * load, **STRAIGHT)
    for choices in CHOICES:
        scene = replace(at_speed, **choices)
        one, other, absent = (
            solved(each)
            for each in (
                of(scene, **form("inner", 2, 1e-6, 0.3)),
                of(scene, **form("outer", 2, 1e-6, 0.3 + 0.5 * np.pi)),
                scene,
            )
        )
        assert one.inner.load == pytest.approx(other.inner.load, rel=1e-8), choices
        assert one.outer.angle == pytest.approx(other.outer.angle, rel=1e-8), choices
        assert np.abs(one.inner.load - absent.inner.load).max() > 1e-3 * absent.inner.load.max(), choices
