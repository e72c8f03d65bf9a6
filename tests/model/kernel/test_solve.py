"""How the solver behaves: batches, threads, starts, random campaigns and the ends of its range."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ellipe

import qsbearing as qs
from qsbearing.model.compiler.compiled import entry, has_fast_code
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.compiler.threads import thread_count
from qsbearing.model.effects.raceway_control import CONTROL_CODES, HYPOTHESES
from qsbearing.model.kernel.ball_inertia import inertia
from qsbearing.model.kernel.workspace import GIVEN, working_memory
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.solved_cases import solved_of
from qsbearing.remarks.of_solution import warnings
from tests.qsbearing.mechanics import ring_load
from tests.qsbearing.scenes import (
    B218,
    BOTH,
    BOTH_HARRIS,
    DEEP_GROOVE,
    DISPLACEMENTS,
    INNER,
    LOADS,
    OUTER,
    PER_BALL,
    SPINDLE,
    UPRIGHT,
    fewer,
    general_scenes,
    held_at,
    lever,
    resting,
    solved,
    turning,
    with_operation,
)

SCENES = general_scenes()
READINGS = (
    "displacement",
    "load",
    "centrifugal_force",
    "gyroscopic_moment",
    "orbital_speed",
    "rotation_speed",
)
CONTACT_READINGS = ("angle", "load", "approach", "semi_major_axis", "max_pressure", "required_friction")


def everything(solution: qs.Solution, index: Any = ...) -> dict[str, NDArray]:
    """All numbers of a solution (or of one of its cases), by name."""
    found = {name: getattr(solution, name) for name in READINGS}
    for race in ("inner", "outer"):
        found |= {f"{race} {name}": getattr(getattr(solution, race), name) for name in CONTACT_READINGS}
    found["stiffness"] = qs.stiffness(solution.scene, solution)
    return {name: np.asarray(value)[index] for name, value in found.items() if value is not None}


def assert_same_bits(one: dict[str, NDArray], other: dict[str, NDArray]) -> None:
    assert one.keys() == other.keys()
    for name, value in one.items():
        assert np.array_equal(value, other[name], equal_nan=True), name


def random_operation(count: int, seed: int, **fixed: Any) -> dict[str, Any]:
    """Thrusts over three decades with radial loads up to 0.6 and moments up to 0.2 dm/2 of them."""
    rng = np.random.default_rng(seed)
    axial = 10.0 ** rng.uniform(2.0, 4.5, count)
    arm = 0.2 * 0.5 * float(np.asarray(B218.pitch_diameter))
    return {
        "axial_load": axial,
        "radial_load_y": axial * rng.uniform(-0.6, 0.6, count),
        "radial_load_z": axial * rng.uniform(-0.6, 0.6, count),
        "moment_y": axial * arm * rng.uniform(-1.0, 1.0, count),
        "moment_z": axial * arm * rng.uniform(-1.0, 1.0, count),
    } | fixed


# -------------------------------------------------------------------------------------------------------------- batches


@pytest.mark.parametrize("control", [OUTER, PER_BALL])
def test_a_batch_is_its_cases(control: qs.RacewayControl) -> None:
    """Each case of an array call holds the same bits as the case solved alone."""
    count = fewer(40, 4)
    operation = random_operation(count, 1)
    rpm = np.linspace(300.0, 14000.0, count)
    batch = qs.solve(turning(rpm, control=control, **operation))
    numbers = everything(batch)
    for k in range(count):
        single = qs.solve(
            turning(rpm[k], control=control, **{key: float(value[k]) for key, value in operation.items()})
        )
        assert single.status == batch.status[k]
        assert single.iterations == batch.iterations[k]
        assert_same_bits(everything(single), {name: value[k] for name, value in numbers.items()})


def test_many_cases_are_few_cases() -> None:
    """A batch beyond the size of one stretch of work, read in one go, holds the same bits as its parts."""
    count = fewer(1500, 66)
    operation = random_operation(count, 2, radial_load_z=0.0, moment_y=0.0)
    rpm = np.linspace(500.0, 9000.0, count)
    whole = qs.solve(turning(rpm, **operation))
    cut = count // 3
    parts = [
        qs.solve(
            turning(rpm[part], **{key: value[part] if np.shape(value) else value for key, value in operation.items()})
        )
        for part in (slice(0, cut), slice(cut, None))
    ]
    one, two = (everything(part) for part in parts)
    assert_same_bits(everything(whole), {name: np.concatenate([one[name], two[name]]) for name in one})


def test_threads_change_nothing() -> None:
    """The same bits with one thread, two and five."""
    count = fewer(2500, 66)  # three stretches
    scene = turning(np.linspace(300.0, 14000.0, count), **random_operation(count, 3))
    expected = everything(qs.solve(scene, threads=1))
    for threads in (2, 5) if has_fast_code() else (2,):
        assert_same_bits(everything(qs.solve(scene, threads=threads)), expected)


def test_case_axes_broadcast() -> None:
    """A column of speeds and a row of loads make a table of cases."""
    rpm, load = np.array([1000.0, 5000.0, 9000.0])[:, None], np.array([5e3, 20e3])
    table = solved(turning(rpm, axial_load=load))
    assert table.shape == (3, 2)
    assert table.displacement.shape == (3, 2, 5)
    assert table.inner.load.shape == table.azimuth.shape == (3, 2, 16)
    assert qs.stiffness(table.scene, table).shape == (3, 2, 5, 5)
    for i in range(3):
        for k in range(2):
            single = solved(turning(float(rpm[i, 0]), axial_load=float(load[k])))
            assert_same_bits(everything(single), everything(table, (i, k)))


def test_shapes_that_do_not_broadcast() -> None:
    """Two rows of different length have no common case axes; the message names the fields."""
    with pytest.raises(ValueError, match="axial_load"):
        qs.solve(turning(np.array([1e3, 2e3]), axial_load=np.array([1e3, 2e3, 3e3])))


def test_ball_count_as_an_array() -> None:
    """Bearings of other counts in one call: balls that a case does not have are NaN, those it has are as alone."""
    counts = np.array([9, 16, 1, 13])
    bearing = replace(B218, ball_count=counts)
    batch = solved(
        turning(6000, bearing, axial_load=1e3 * counts, radial_displacement_y=0.0, radial_displacement_z=0.0, **UPRIGHT)
    )
    assert batch.azimuth.shape == (4, 16)
    for k, count in enumerate(counts):
        single = solved(
            turning(
                6000,
                replace(B218, ball_count=int(count)),
                axial_load=1e3 * int(count),
                radial_displacement_y=0.0,
                radial_displacement_z=0.0,
                **UPRIGHT,
            )
        )
        assert np.isnan(batch.azimuth[k, count:]).all()
        for race in ("inner", "outer"):
            for name in CONTACT_READINGS:
                row = getattr(getattr(batch, race), name)[k]
                assert np.isnan(row[count:]).all()
                assert np.array_equal(row[:count], getattr(getattr(single, race), name))
        assert batch.raceway_control is not None
        assert (batch.raceway_control[k, count:] == "").all()
        assert np.array_equal(batch.displacement[k], single.displacement)


def test_geometry_and_materials_as_arrays() -> None:
    """Every number of a bearing may span cases; each case is the bearing that it says."""
    factor = np.array([1.0, 1.02, 0.97])
    bearing = replace(
        B218,
        ball_diameter=22.225 * qs.mm * factor,
        inner_groove_radius=11.6281 * qs.mm * factor**2 + 0.4 * qs.mm,
        outer_groove_radius=11.7 * qs.mm * factor + 0.2 * qs.mm,
        pitch_diameter=125.26 * qs.mm / factor,
        free_contact_angle=np.array([40.0, 25.0, 33.0]) * qs.deg,
        ball_material=qs.Material(
            np.array([208e9, 315e9, 250e9]), np.array([0.3, 0.26, 0.28]), np.array([7800.0, 3200.0, 5000.0])
        ),
    )
    loads = {"axial_load": 9e3, "radial_load_y": 1e3, "moment_z": -20.0}
    batch = solved(turning(7000, bearing, hertz_angle="actual", **loads))
    for k in range(3):
        ball = bearing.ball_material
        single_bearing = replace(
            bearing,
            **{
                name: float(np.asarray(getattr(bearing, name))[k])
                for name in ("ball_diameter", "inner_groove_radius", "outer_groove_radius", "pitch_diameter")
            },
            free_contact_angle=float(np.asarray(bearing.free_contact_angle)[k]),
            ball_material=qs.Material(
                *(float(np.asarray(value)[k]) for value in (ball.elastic_modulus, ball.poisson_ratio, ball.density))
            ),
        )
        single = solved(turning(7000, single_bearing, hertz_angle="actual", **loads))
        # numpy's and Python's sine and power may differ in the last bit.
        assert batch.inner.load[k] == pytest.approx(single.inner.load, rel=1e-11)
        assert batch.displacement[k] == pytest.approx(single.displacement, rel=1e-9, abs=1e-15)


# ------------------------------------------------------------------------------------------------------- no equilibrium


@pytest.mark.parametrize("rpm", [None, 5000.0])
def test_a_reversed_thrust_has_no_equilibrium(rpm: float | None) -> None:
    """An angular-contact bearing carries thrust one way only: the case says so, holds NaN, and spoils no neighbour."""
    load = np.array([12e3, -5e3, 8e3, 20e3])
    make = (lambda axial: resting(axial_load=axial)) if rpm is None else (lambda axial: turning(rpm, axial_load=axial))
    batch = qs.solve(make(load))
    assert list(batch.status) == ["converged", "no_equilibrium", "converged", "converged"]
    numbers = everything(batch)
    for name, value in numbers.items():
        assert np.isnan(value[1]).all(), name
    for k in (0, 2, 3):
        assert_same_bits(
            everything(qs.solve(make(float(load[k])))), {name: value[k] for name, value in numbers.items()}
        )
    groove = replace(B218, kind=qs.BearingKind.DEEP_GROOVE)
    assert qs.solve(resting(groove, axial_load=-5e3)).status is qs.Status.CONVERGED


def unclipped_thrust(axial_load: float, rpm: float) -> tuple[float, float, float]:
    """B218 under thrust, inner control with all friction inside: angles and Qi, where Qi may come out negative.

    Qi = (q + T cos ai)/sin ai and Qo = q/sin ao leave two equations: the ball's radial balance, which gives ao for any
    ai, and the radial distance of the groove centres, which gives ai. Written from Harris & Kotzalas alone.
    """
    ball, pitch, reach, free = 22.225e-3, 125.26e-3, 11.6281e-3 - 11.1125e-3, 40 * qs.deg
    stiffness_i, stiffness_o = 4.1097262e10, 4.2748637e10
    gamma, mass, speed = ball / pitch, 7800 * np.pi / 6 * ball**3, rpm * qs.rpm
    q = axial_load / 16

    def friction_and_throw(ai: float, ao: float) -> tuple[float, float]:
        beta = np.arctan2(np.sin(ai), np.cos(ai) - gamma)
        u = np.cos(ao) + np.tan(beta) * np.sin(ao)
        v = np.cos(ai) + np.tan(beta) * np.sin(ai)
        orbit = speed / (1 + (1 + gamma * np.cos(ao)) * v / ((1 - gamma * np.cos(ai)) * u))
        turn = -speed / ((u / (1 + gamma * np.cos(ao)) + v / (1 - gamma * np.cos(ai))) * gamma * np.cos(beta))
        moment = 0.1 * mass * ball**2 * turn * orbit * np.sin(beta)
        return 2.0 * moment / ball, 0.5 * mass * pitch * orbit**2

    def inner_load(ai: float, ao: float) -> float:
        return float((q + friction_and_throw(ai, ao)[0] * np.cos(ai)) / np.sin(ai))

    def radial_balance(ao: float, ai: float) -> float:
        friction, throw = friction_and_throw(ai, ao)
        return inner_load(ai, ao) * np.cos(ai) + friction * np.sin(ai) - q / np.tan(ao) + throw

    def outer_angle(ai: float) -> float:
        return float(brentq(radial_balance, 0.01 * qs.deg, 80 * qs.deg, args=(ai,), xtol=1e-14))

    def span(ai: float) -> float:
        ao = outer_angle(ai)
        stretch_i = (max(inner_load(ai, ao), 0.0) / stiffness_i) ** (2 / 3)
        stretch_o = (q / np.sin(ao) / stiffness_o) ** (2 / 3)
        return (reach + stretch_i) * np.cos(ai) + (reach + stretch_o) * np.cos(ao) - 2 * reach * np.cos(free)

    ai = float(brentq(span, 40 * qs.deg, 70 * qs.deg, xtol=1e-14))
    return ai, outer_angle(ai), inner_load(ai, outer_angle(ai))


@pytest.mark.parametrize(("axial_load", "rpm"), [(2e3, 9200.0), (500.0, 4600.0)])
def test_friction_that_the_inner_contact_just_carries(axial_load: float, rpm: float) -> None:
    """Just below the speed at which inner control ends: the equations written out give the package's answer."""
    ai, ao, Qi = unclipped_thrust(axial_load, rpm)
    assert 0.0 < Qi < 5.0
    solution = solved(turning(rpm, control=INNER, axial_load=axial_load))
    # The stiffnesses above have eight digits.
    assert solution.inner.angle[0] == pytest.approx(ai, abs=1e-8)
    assert solution.outer.angle[0] == pytest.approx(ao, abs=1e-8)
    assert solution.inner.load[0] == pytest.approx(Qi, abs=1e-6)


@pytest.mark.parametrize(
    ("axial_load", "rpm"), [(2e3, 9400.0), (2e3, 9600.0), (2e3, 12000.0), (500.0, 4800.0), (500.0, 9400.0)]
)
def test_friction_at_a_contact_without_load(axial_load: float, rpm: float) -> None:
    """Beyond it the equations want the inner contact to pull: there is no equilibrium, and none is reported."""
    assert unclipped_thrust(axial_load, rpm)[2] < 0.0
    solution = qs.solve(turning(rpm, control=INNER, axial_load=axial_load))
    assert solution.status is qs.Status.NO_EQUILIBRIUM
    assert np.isnan(solution.inner.load).all()


STEEP_THRUST = qs.BallBearing(
    ball_count=24,
    ball_diameter=23.334e-3,
    pitch_diameter=254.717e-3,
    inner_groove_radius=13.0459e-3,
    outer_groove_radius=12.9221e-3,
    free_contact_angle=56.16155 * qs.deg,
)


@pytest.mark.parametrize("rpm", [3300.0, 3354.557, 3600.0])
def test_contact_lines_more_than_a_right_angle_apart(rpm: float) -> None:
    """Iterations pass through such states with speeds other than those of rolling: none of them is a solution."""
    effects = (qs.CentrifugalForce(), qs.GyroscopicMoment(moment_shares="harris"))
    scene = turning(rpm, STEEP_THRUST, effects=effects, control=INNER, axial_load=181.7515, tilt_y=0.0, tilt_z=0.0)
    solution = qs.solve(scene)
    assert solution.status is qs.Status.NO_EQUILIBRIUM
    assert solution.reason == qs.Reason.FRICTION_WITHOUT_LOAD


@pytest.mark.parametrize(
    "make", [lambda **o: resting(**o), lambda **o: turning(3000, **o)], ids=["at rest", "at speed"]
)
def test_one_ball_resists_no_thrust_alone(make: Any) -> None:
    """A ring on one ball, free to shift and tilt, runs away."""
    bearing = replace(B218, ball_count=1)
    solution = qs.solve(with_operation(replace(make(axial_load=500.0), bearing=bearing)))
    assert solution.status is qs.Status.NO_EQUILIBRIUM


# ------------------------------------------------------------------------------------------------------ raceway control


def jones_choice(solution: qs.Solution) -> NDArray:
    """Jones's criterion on a single solved case, with elliptic integrals and semi-axes of our own: outer or inner."""
    sides = []
    for contacts in (solution.inner, solution.outer):
        with np.errstate(invalid="ignore"):
            ratio = contacts.semi_minor_axis / contacts.semi_major_axis
        sides.append(np.nan_to_num(contacts.load * contacts.semi_major_axis * ellipe(1.0 - ratio**2)))
    inner, outer = sides
    between = np.cos(solution.inner.angle - solution.outer.angle)
    return np.where(outer * between > inner, "outer", "inner")


@pytest.mark.parametrize("hertz_angle", ["free", "actual"])
@pytest.mark.parametrize(
    "effects", [BOTH, (qs.CentrifugalForce(),), (qs.CentrifugalForce(), qs.GyroscopicMoment(qs.MomentShares.HARRIS))]
)
def test_control_by_each_ball_is_jones_s_choice(effects: tuple, hertz_angle: str) -> None:
    """Where the solver calls the choice consistent, it is the one of the criterion evaluated on the answer."""
    count = fewer(30, 3)
    operation = random_operation(count, 5)
    rpm = np.linspace(800.0, 4000.0, count)
    seen: set[str] = set()
    inconsistent = 0
    for k in range(count):
        numbers = {key: float(value[k]) for key, value in operation.items()}
        solution = qs.solve(turning(rpm[k], control=PER_BALL, effects=effects, hertz_angle=hertz_angle, **numbers))
        if solution.status is not qs.Status.CONVERGED:
            continue
        assert solution.raceway_control is not None
        if any("consistent" in words for words in warnings(solution)):
            inconsistent += 1
            assert (solution.raceway_control != jones_choice(solution)).any()
            continue
        assert list(solution.raceway_control) == list(jones_choice(solution))
        seen |= set(solution.raceway_control)
    assert seen == {"outer", "inner"}
    assert inconsistent <= count // 4


def test_no_consistent_control_is_said() -> None:
    """At 17 800 N near 2084 rpm outer control calls for inner control and the reverse: a warning, and a number."""
    scene = turning(2084, control=PER_BALL, axial_load=17.8e3)
    outer, inner = (solved(replace(scene, raceway_control=control)) for control in (OUTER, INNER))
    assert set(jones_choice(outer)) == {"inner"}
    assert set(jones_choice(inner)) == {"outer"}
    solution = solved(scene)
    assert any("No consistent raceway control" in words for words in warnings(solution))
    slow, fast = (solved(turning(rpm, control=PER_BALL, axial_load=17.8e3)) for rpm in (1500, 3000))
    assert set(slow.raceway_control) == {"inner"}  # type: ignore[arg-type]
    assert set(fast.raceway_control) == {"outer"}  # type: ignore[arg-type]
    for consistent in (slow, fast, outer, inner):
        assert not any("consistent" in words for words in warnings(consistent))


# ---------------------------------------------------------------------------------------------------------------- start


def test_starting_from_a_neighbour() -> None:
    """The same answer from a start nearby, to the tolerance of the solve, in fewer iterations."""
    here = turning(8000, axial_load=10e3, radial_load_y=5e3, moment_z=-100.0)
    there = turning(8300, axial_load=10.3e3, radial_load_y=5e3, moment_z=-95.0)
    cold, warm = solved(there), solved(there, start=solved(here))
    assert warm.inner.load == pytest.approx(cold.inner.load, abs=1e-10 * cold.inner.load.max())
    assert warm.displacement == pytest.approx(cold.displacement, abs=1e-10 * np.abs(cold.displacement).max())
    assert warm.iterations <= cold.iterations
    again = solved(there, start=cold)
    assert again.iterations <= 1
    assert again.displacement == pytest.approx(cold.displacement, rel=1e-9, abs=1e-14)


@pytest.mark.parametrize("name", list(SCENES))
def test_starting_from_the_solution(name: str) -> None:
    """A solution is a place where the solver stays; at rest, where any way is short, it may walk again."""
    first = solved(SCENES[name])
    again = solved(SCENES[name], start=first)
    assert again.iterations <= (1 if SCENES[name].ball_effects else first.iterations)
    assert again.inner.load == pytest.approx(first.inner.load, abs=1e-10 * first.inner.load.max())


def test_one_start_for_many_cases_and_many_for_many() -> None:
    """A single case starts a batch; a batch starts a batch of the same axes, failed cases included."""
    load = np.array([9e3, -1e3, 11e3])
    cold = qs.solve(turning(7000, axial_load=load))
    for start in (qs.solve(turning(7000, axial_load=10e3)), qs.solve(turning(6000, axial_load=load))):
        warm = qs.solve(turning(7000, axial_load=load), start=start)
        assert list(warm.status) == list(cold.status)
        assert warm.inner.load == pytest.approx(cold.inner.load, rel=1e-10, nan_ok=True)


def test_a_far_start_does_no_harm() -> None:
    """From rest and light load to speed and heavy load, and back: the same answers."""
    near, far = resting(axial_load=50.0), turning(14000, axial_load=40e3, radial_load_y=20e3, moment_z=0.0)
    for scene, start in ((far, near), (near, far)):
        cold, warm = solved(scene), solved(scene, start=solved(start))
        assert warm.inner.load == pytest.approx(cold.inner.load, rel=1e-9)


@pytest.mark.parametrize("rpm", [0.0, 6000.0])
@pytest.mark.parametrize(
    "symmetric",
    [
        {"axial_load": 9e3},
        {"axial_load": 9e3, "radial_load_y": 2e3, "moment_z": 0.0},
        {"axial_load": 9e3, "radial_load_z": 2e3, "moment_y": 0.0},
        {"axial_load": 9e3, "radial_load_y": 2e3, **UPRIGHT},
    ],
    ids=["thrust", "x-y", "x-z", "upright"],
)
def test_a_start_without_symmetry_for_a_scene_with_it(symmetric: dict[str, float], rpm: float) -> None:
    """Channels that symmetry settles are settled from any start, and balls that are equal come out equal."""
    crooked = {"axial_load": 8e3, "radial_load_y": 1.5e3, "radial_load_z": -900.0, "moment_y": 15.0, "moment_z": -30.0}
    scene = turning(rpm, **symmetric)
    cold, warm = solved(scene), solved(scene, start=solved(turning(rpm, **crooked)))
    assert warm.inner.load == pytest.approx(cold.inner.load, rel=1e-9)
    assert warm.displacement == pytest.approx(cold.displacement, rel=1e-8, abs=1e-14)


def test_a_start_of_other_axes_is_refused() -> None:
    """Other ball axes or another number of cases."""
    start = solved(turning(3000, SPINDLE, axial_load=np.array([1e3, 2e3])))
    with pytest.raises(ValueError, match="start has"):
        qs.solve(turning(3000, axial_load=np.array([1e3, 2e3])), start=start)
    with pytest.raises(ValueError, match="start has"):
        qs.solve(turning(3000, SPINDLE, axial_load=np.array([1e3, 2e3, 3e3])), start=start)


# ------------------------------------------------------------------------------------------------------------ campaigns


@pytest.mark.parametrize("hertz_angle", ["free", "actual"])
@pytest.mark.parametrize("bearing", [B218, SPINDLE, DEEP_GROOVE], ids=["B218", "spindle", "deep groove"])
def test_random_scenes_converge(bearing: qs.BallBearing, hertz_angle: str) -> None:
    """From rest to high speed, thrusts over two decades, free tilts: all solved, to 1e-10 of the largest force."""
    count = fewer(2000, 12)
    bearing = replace(bearing, kind=qs.BearingKind.DEEP_GROOVE)
    size = (float(np.asarray(bearing.ball_diameter)) / 22.225e-3) ** 2
    operation = {key: size * value for key, value in random_operation(count, 7).items()}
    arm = float(np.asarray(bearing.pitch_diameter) / np.asarray(B218.pitch_diameter))
    operation["moment_y"], operation["moment_z"] = arm * operation["moment_y"], arm * operation["moment_z"]
    rpm = np.random.default_rng(8).uniform(300.0, 1.5e6 / (float(np.asarray(bearing.pitch_diameter)) * 1e3), count)
    rpm[:: max(count // 10, 2)] = 0.0
    solution = qs.solve(turning(rpm, bearing, hertz_angle=hertz_angle, **operation))
    assert solution.converged.all(), (rpm[~solution.converged], [v[~solution.converged] for v in operation.values()])
    assert solution.residual.max() <= 1e-10


def test_random_scenes_of_an_open_side() -> None:
    """An angular-contact bearing: solved, or refused for contact on its open side; nothing in between."""
    count = fewer(2000, 12)
    operation = random_operation(count, 9)
    rpm = np.random.default_rng(10).uniform(300.0, 14000.0, count)
    solution = qs.solve(turning(rpm, **operation))
    assert set(solution.status) <= {"converged", "no_equilibrium"}
    both_sides = qs.solve(turning(rpm, replace(B218, kind=qs.BearingKind.DEEP_GROOVE), **operation))
    pressing = both_sides.inner.load > 0.0
    open_side = (pressing & (both_sides.inner.angle < 0.0)).any(axis=1)
    assert np.array_equal(solution.converged, ~open_side)


def test_random_scenes_at_a_crawl() -> None:
    """Between rest and a hundred rpm balls that thrust does not reach are held by next to nothing: still solved."""
    count = fewer(500, 2)
    bearing = replace(B218, kind=qs.BearingKind.DEEP_GROOVE)
    rpm = 10.0 ** np.random.default_rng(11).uniform(-2.0, 2.0, count)
    solution = qs.solve(turning(rpm, bearing, **random_operation(count, 12)))
    failed = ~solution.converged
    assert not failed.any(), f"{failed.sum()} of {count} fail, e.g. at {rpm[failed][:5]} rpm"


@pytest.mark.parametrize("rpm", [0.0, 1000.0])
@pytest.mark.parametrize("axial_load", [1e-6, 1e-2, 1.0, 1e6, 1e8])
def test_tiny_and_huge_loads(axial_load: float, rpm: float) -> None:
    """Fourteen decades of thrust: solved, and in balance.

    The imbalance, and what the rounding of half a millimetre in the balls' places does to very small approaches.
    """
    solution = solved(turning(rpm, axial_load=axial_load))
    assert solution.residual <= 1e-10
    largest = solution.outer.load.max()
    rounding = 16 * 1.5 * largest / solution.outer.approach.max() * 0.5e-3 * np.finfo(float).eps
    assert ring_load(solution)[0] == pytest.approx(axial_load, abs=1e-11 * largest + rounding)


@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_few_balls(count: int) -> None:
    """One ball between held channels, two, three: each carries its share of the thrust as it would among sixteen."""
    bearing = replace(B218, ball_count=count)
    held = {"radial_displacement_y": 0.0, "radial_displacement_z": 0.0, **UPRIGHT}
    few = solved(turning(9000, bearing, axial_load=500.0 * count, **held))
    many = solved(turning(9000, axial_load=500.0 * 16, **held))
    assert few.inner.load == pytest.approx(many.inner.load[:count], rel=1e-11)
    assert few.outer.angle == pytest.approx(many.outer.angle[:count], rel=1e-11)
    assert few.displacement[0] == pytest.approx(many.displacement[0], rel=1e-10)


def test_a_ball_thrown_outward_touches_no_inner_ring() -> None:
    """Held clear of the inner ring at speed: every ball rides the outer groove's bottom on its centrifugal force."""
    scene = turning(
        9000, axial_displacement=-0.4 * qs.mm, radial_displacement_y=0.0, radial_displacement_z=0.0, **UPRIGHT
    )
    solution = solved(scene)
    assert not solution.inner.load.any()
    assert solution.outer.angle == pytest.approx(np.zeros(16), abs=1e-12)
    assert solution.outer.load == pytest.approx(solution.centrifugal_force, rel=1e-11)
    assert solution.load == pytest.approx(np.zeros(5), abs=1e-9)


@pytest.mark.parametrize("control", HYPOTHESES)
@pytest.mark.parametrize("rpm", [1e-2, 1e4])
def test_a_ring_that_nothing_loads_is_left_alone(rpm: float, control: qs.RacewayControl) -> None:
    """Balls thrown outward would wedge an axially free ring until it gives way: it stands where none touches it."""
    bearing = replace(DEEP_GROOVE, free_contact_angle=19.0 * qs.deg)
    free = qs.Operation(speed=rpm * qs.rpm, axial_load=0.0, radial_displacement_y=0.0, radial_displacement_z=0.0)
    solution = solved(qs.Scene(bearing, free, BOTH, control))
    assert not solution.inner.load.any()
    np.testing.assert_allclose(solution.outer.load, solution.centrifugal_force, rtol=1e-12)


@pytest.mark.parametrize("control", HYPOTHESES)
@pytest.mark.parametrize("effects", [BOTH, BOTH[:1]])
def test_balls_that_just_touch_are_thrown_outward(effects: tuple, control: qs.RacewayControl) -> None:
    """A ring held where no ball is pressed, at angle zero: nothing but the balls' own inertia loads a contact."""
    held = qs.Operation(speed=30000 * qs.rpm, **dict.fromkeys(DISPLACEMENTS, 0.0))
    solution = solved(qs.Scene(DEEP_GROOVE, held, effects, control))
    assert (solution.inner.load == 0.0).all()
    np.testing.assert_allclose(solution.outer.load, solution.centrifugal_force, rtol=1e-12)
    assert (solution.outer.angle == 0.0).all()


@pytest.mark.parametrize("held", range(1, 32))
def test_every_choice_of_held_channels(held: int) -> None:
    """Any of the 31 ways to hold some channels and load the others returns one and the same state."""
    reference = solved(SCENES["outer control"])
    operation: dict[str, Any] = dict.fromkeys((*LOADS, *DISPLACEMENTS))
    for i in range(5):
        if held >> i & 1:
            operation[DISPLACEMENTS[i]] = float(reference.displacement[i])
        else:
            operation[LOADS[i]] = float(reference.load[i])
    solution = solved(with_operation(reference.scene, **operation))
    unit = np.array([1.0, 1.0, 1.0, lever(reference.scene), lever(reference.scene)])
    assert solution.displacement * unit == pytest.approx(
        reference.displacement * unit, abs=1e-10 * np.abs(reference.displacement * unit).max()
    )
    assert solution.inner.load == pytest.approx(reference.inner.load, abs=1e-10 * reference.inner.load.max())


def test_random_held_displacements() -> None:
    """All five channels held anywhere: always a solution, whose reactions are the balls' forces."""
    count = fewer(300, 10)
    rng = np.random.default_rng(13)
    place = rng.uniform(-1.0, 1.0, (count, 5)) * np.array([2e-4, 1e-4, 1e-4, 2e-3, 2e-3])
    scene = held_at(turning(rng.uniform(300.0, 12000.0, count), replace(B218, kind=qs.BearingKind.DEEP_GROOVE)), place)
    solution = solved(scene)
    assert np.array_equal(solution.displacement, place) or solution.displacement == pytest.approx(place, rel=1e-15)
    assert solution.residual.max() <= 1e-10


# ------------------------------------------------------------------------------------------------------------ arguments


@pytest.mark.parametrize("tolerance", [0.0, -1e-9, 1e-14, 2e-6, 0.01, float("nan"), float("inf")])
def test_a_tolerance_out_of_range(tolerance: float) -> None:
    with pytest.raises(ValueError, match="residual_tolerance"):
        qs.solve(resting(axial_load=1e3), residual_tolerance=tolerance)


def test_a_looser_tolerance_is_met_and_used() -> None:
    """The imbalance is within what was asked for, and fewer iterations are spent."""
    scene = qs.load_scene("b218")
    loose, tight = solved(scene, residual_tolerance=1e-6), solved(scene)
    assert 1e-10 < loose.residual <= 1e-6
    assert tight.residual <= 1e-10
    assert loose.iterations < tight.iterations


@pytest.mark.parametrize("threads", [0, -2])
def test_a_thread_count_out_of_range(threads: int) -> None:
    with pytest.raises(ValueError, match="threads"):
        qs.solve(resting(axial_load=1e3), threads=threads)


def test_threads_from_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """The argument goes before the variable, the variable before the number of cores."""
    monkeypatch.setenv("QSBEARING_THREADS", "3")
    assert thread_count() == 3
    assert thread_count(2) == 2
    monkeypatch.delenv("QSBEARING_THREADS")
    assert thread_count() >= 1
    for wrong in ("many", "", "1.5", "0", "-1"):
        monkeypatch.setenv("QSBEARING_THREADS", wrong)
        with pytest.raises(ValueError, match=r"threads|QSBEARING_THREADS"):
            thread_count()


def test_stiffness_of_another_scene_is_refused() -> None:
    """A stiffness belongs to the scene that was solved."""
    one, other = resting(axial_load=1e3), resting(axial_load=2e3)
    with pytest.raises(ValueError, match="another scene"):
        qs.stiffness(one, qs.solve(other))


# ------------------------------------------------------------ found by campaigns: thrust far below the rest


@pytest.mark.parametrize(
    ("bearing", "speed", "load"),
    [
        (B218, 1143.4736120866744, (478.79, -2632.36, 1876.18, -28.84, 34.77)),
        (B218, 316.8070195265795, (1708.68, 9961.76, -5776.67, -132.87, 5.446)),
        (DEEP_GROOVE, 23.87101591853735, (0.524517, -13.6323, -9.41058, -0.027075, -0.05954)),
    ],
    ids=["B218, fast", "B218, slow", "deep groove"],
)
def test_control_by_each_ball_never_asks_friction_of_an_unloaded_contact(
    bearing: qs.BallBearing, speed: float, load: tuple[float, ...]
) -> None:
    """The outer raceway controls a ball that has left the inner one, by the criterion: no verdict on friction."""
    scene = turning(speed / qs.rpm, replace(bearing, kind=qs.BearingKind.DEEP_GROOVE), control=PER_BALL)
    solution = qs.solve(with_operation(scene, **dict(zip(LOADS, load, strict=True))))
    notes = solved_of(solution).results["notes"]
    assert solution.status is qs.Status.CONVERGED, (solution.status, notes, solution.residual)


@pytest.mark.parametrize("speed", [0.0, 700.0])
def test_what_is_not_a_number_is_never_converged(speed: float) -> None:
    """A start that holds NaN is left behind, at rest and at speed, whether or not it says that it failed."""
    scene = qs.Scene(B218, qs.Operation(axial_load=5e3, radial_load_y=2e3, moment_z=0.0, speed=speed), BOTH, OUTER)
    expected = qs.solve(scene)
    for codes in (0, 2):
        start = qs.solve(scene)
        before = solved_of(start)
        before.results["displacement"], before.results["status"] = np.nan, codes
        before.positions[:] = np.nan
        found = qs.solve(scene, start=start)
        assert found.converged
        assert found.displacement == pytest.approx(expected.displacement, rel=1e-9, abs=1e-15)


def test_an_idle_ball_that_friction_lifts_into_the_other_corner() -> None:
    """Rings turning against each other: the balls hardly orbit but spin fast, and friction outweighs what throws them.

    An idle ball then lies on the inward side between its grooves: inner angle below the free one, outer above.
    """
    scene = turning(
        300.0,
        replace(B218, kind=qs.BearingKind.DEEP_GROOVE),
        outer_rpm=-238.0,
        axial_load=500.0,
        radial_load_z=250.0,
        moment_y=0.0,
        moment_z=0.0,
        first_ball_azimuth=1.0,
    )
    solution = qs.solve(scene)
    assert solution.converged
    assert solution.iterations <= 20
    idle = solution.outer.load < 0.1
    assert idle.any() and not idle.all()
    assert (solution.inner.angle[idle] < 40 * qs.deg).any()
    assert (solution.outer.angle[solution.inner.angle < 30 * qs.deg] > 38 * qs.deg)[
        idle[solution.inner.angle < 30 * qs.deg]
    ].all()


STEEP = replace(B218, free_contact_angle=65 * qs.deg, ball_count=14)
"""A bearing for thrust: at αo = 0 its inner groove is out of the balls' reach below 90 degrees (2 cos 65° < 1)."""


def test_balls_thrown_over_the_inner_shoulder() -> None:
    """Light thrust at high speed: no balance has inner contacts below 90 degrees, and the verdict says so."""
    slow, fast = (qs.solve(turning(rpm, STEEP, axial_load=100.0)) for rpm in (200.0, 20_000.0))
    assert slow.converged
    assert slow.inner.angle.max() < 90 * qs.deg
    assert fast.status is qs.Status.NO_EQUILIBRIUM
    assert fast.reason == qs.Reason.OVER_SHOULDER
    assert "more than 90 degrees" in qs.message(fast)


def test_a_ball_that_slips() -> None:
    """Inner control of light balls at speed: some contact would need more friction than load; turning slowly none."""
    scene = turning(10_000.0, control=INNER, axial_load=1000.0, radial_load_y=200.0, **UPRIGHT)
    solution = qs.solve(scene)
    assert solution.status is qs.Status.NO_EQUILIBRIUM
    assert solution.reason == qs.Reason.FRICTION_WITHOUT_LOAD
    assert solution.speed_reached == 1.0
    assert qs.solve(with_operation(scene, speed=0.02 * scene.operation.speed)).converged


@pytest.mark.parametrize("control", [OUTER, INNER])
def test_balls_that_touch_neither_raceway_do_not_roll(control: qs.RacewayControl) -> None:
    """Without centrifugal force balls outside the loaded zone lie free: no moment, no friction; the rest in balance."""
    operation = qs.Operation(speed=3000 * qs.rpm, axial_load=500.0, radial_load_y=4000.0, **UPRIGHT)
    gyroscopic = (qs.GyroscopicMoment(),)
    solution = qs.solve(qs.Scene(DEEP_GROOVE, operation, gyroscopic, control))
    assert solution.converged
    free = (solution.inner.load == 0.0) & (solution.outer.load == 0.0)
    assert 0 < free.sum() < free.size
    assert (solution.gyroscopic_moment[free] == 0.0).all()
    for side in (solution.inner, solution.outer):
        assert (side.required_friction[free] == 0.0).all()
    if control is OUTER:  # then no friction acts on the inner ring
        radial = solution.inner.load * np.cos(np.nan_to_num(solution.inner.angle)) * np.cos(solution.azimuth)
        assert radial.sum() == pytest.approx(4000.0, rel=1e-10)


@pytest.mark.parametrize("axial_load, rpm", [(10.0, 1000), (100.0, 1000), (100.0, 3000)])
def test_balls_outside_the_loaded_zone_ask_for_no_friction(axial_load: float, rpm: float) -> None:
    """Under inner control, a gyroscopic moment but nothing thrown: a ball that is not pressed lies free in its gap. It
    must not be held against a raceway by friction alone, which no load there could carry."""
    radial = 30.0 if axial_load < 100.0 else 300.0
    loads = qs.Operation(speed=rpm * qs.rpm, axial_load=axial_load, radial_load_y=radial, **UPRIGHT)
    solution = solved(qs.Scene(B218, loads, (qs.GyroscopicMoment(qs.MomentShares.HARRIS),), INNER))
    free = (solution.inner.load == 0.0) & (solution.outer.load == 0.0)
    assert 0 < free.sum() < free.size
    assert (solution.gyroscopic_moment[free] == 0.0).all()
    for side in (solution.inner, solution.outer):
        assert side.required_friction[~free].max() < 1.0


@pytest.mark.parametrize("radial_displacement", [0.0, 0.5, 1.2])
@pytest.mark.parametrize("inner, outer", [(0.52, 0.54), (0.52, 0.9), (0.9, 0.52)])
def test_a_free_ball_lies_between_its_grooves_however_far_the_ring_is_moved(
    inner: float, outer: float, radial_displacement: float
) -> None:
    """A ring held where grooves leave balls all room, even one groove's centre beyond the other's: places stay places,
    the two links of each ball its grooves' centres apart, neither longer than at touching."""
    diameter = B218.ball_diameter
    bearing = replace(B218, inner_groove_radius=inner * diameter, outer_groove_radius=outer * diameter)
    reach = (inner + outer - 1.0) * diameter
    held = dict.fromkeys(DISPLACEMENTS, 0.0) | {
        "axial_displacement": -reach * np.sin(bearing.free_contact_angle),
        "radial_displacement_y": -radial_displacement * reach,
    }
    scene = qs.Scene(bearing, qs.Operation(speed=1000 * qs.rpm, **held), (qs.GyroscopicMoment(),), OUTER)
    solution = solved(scene)
    sides = (solution.inner, solution.outer)
    free = (solution.inner.load == 0.0) & (solution.outer.load == 0.0)
    assert free.any()
    links = [side.approach[free] + (f - 0.5) * diameter for side, f in zip(sides, (inner, outer), strict=True)]
    assert all((link > 0.0).all() for link in links)
    radial = reach * np.cos(bearing.free_contact_angle) - radial_displacement * reach * np.cos(solution.azimuth[free])
    chain = [
        sum(link * trig(side.angle[free]) for side, link in zip(sides, links, strict=True)) for trig in (np.sin, np.cos)
    ]
    np.testing.assert_allclose(chain[0], 0.0, atol=1e-14)
    np.testing.assert_allclose(chain[1], radial, atol=1e-14)


@entry(*GIVEN[:2], int, float, float, array_of(float))
def fill_inertia(
    cases: NDArray, workspaces: NDArray, control: int, inner_angle: float, outer_angle: float, out: NDArray
) -> None:
    """(Fc, Mg) and their derivatives by the two angles that rolling sees, as the solver has them."""
    workspaces[0].speed_factor = 1.0
    si, ci, so, co = np.sin(inner_angle), np.cos(inner_angle), np.sin(outer_angle), np.cos(outer_angle)
    out[0], out[1], out[2], out[3], out[4], out[5] = inertia(cases[0], workspaces[0], control, si, ci, so, co)


@pytest.mark.parametrize("control", [OUTER, INNER])
@pytest.mark.parametrize("inner_degrees", [40.0, 100.0, -60.0])
def test_inertia_changes_with_the_angles_as_differences_say(control: qs.RacewayControl, inner_degrees: float) -> None:
    """Lines as rolling sees them, less than a right angle apart."""
    cases = CaseMaker(turning(10_000.0, axial_load=1.0)).make()
    workspace, _ = working_memory(1)
    inner, outer, step = np.radians(inner_degrees), np.radians(20.0), 1e-5

    def at(inner: float, outer: float) -> NDArray:
        out = np.empty(6)
        fill_inertia(cases, workspace, CONTROL_CODES[control], inner, outer, out)
        return out

    values = at(inner, outer)
    by_inner = (at(inner + step, outer) - at(inner - step, outer)) / (2.0 * step)
    by_outer = (at(inner, outer + step) - at(inner, outer - step)) / (2.0 * step)
    # Second-order differences of functions of order one, by their own sizes: step^2, and rounding over the step.
    for k in (0, 3):
        size = np.abs(values).max()
        assert values[k + 1] == pytest.approx(by_inner[k], abs=1e-8 * size)
        assert values[k + 2] == pytest.approx(by_outer[k], abs=1e-8 * size)


@pytest.mark.parametrize("control", [OUTER, INNER])
def test_the_lightest_loads_come_to_rest(control: qs.RacewayControl) -> None:
    """Micronewtons, approaches a billionth of a ball: the last steps balance loads finer than places can be told.

    Read off places after each step, they stayed in motion, some 1e-10 of a load; most of these were given up.
    """
    bearing = qs.BallBearing(
        ball_count=15,
        ball_diameter=1.95 * qs.mm,
        pitch_diameter=34.4 * qs.mm,
        inner_groove_radius=0.977 * qs.mm,
        outer_groove_radius=1.072 * qs.mm,
        free_contact_angle=24.0 * qs.deg,
    )
    operation = qs.Operation(
        speed=0.13 * qs.rpm,
        axial_load=np.linspace(1e-6, 4e-6, 200),
        radial_displacement_y=1.4e-14,
        radial_displacement_z=3.2e-14,
        moment_y=0.0,
        tilt_z=0.0,
    )
    solution = qs.solve(qs.Scene(bearing, operation, (qs.GyroscopicMoment(),), control))
    assert solution.converged.all()
    assert (solution.residual <= 1e-12).all()


def test_balls_that_do_not_orbit_are_no_solution() -> None:
    """Under inner control the orbit stops where cos(ai - ao) = g cos ao: no force, no load, no equilibrium of anything.

    Newton's method came to rest there for a ring that nothing loads.
    """
    bearing = qs.BallBearing(
        ball_count=39,
        ball_diameter=9.00451541953523 * qs.mm,
        pitch_diameter=117.49696021529968 * qs.mm,
        inner_groove_radius=4.59560562499583 * qs.mm,
        outer_groove_radius=4.833885642351056 * qs.mm,
        free_contact_angle=52.81347233805633 * qs.deg,
    )
    for rpm in (15.3, 5_000.0):
        found = qs.solve(
            turning(rpm, bearing, effects=BOTH_HARRIS, control=INNER, axial_load=0.0, tilt_z=0.0, moment_y=0.0)
        )
        assert not found.converged or (found.centrifugal_force > 0.0).all()
