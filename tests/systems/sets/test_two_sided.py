"""Deep-groove rows that stand by their middle planes: located, floating, held one way, and what that leaves free."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.units import um
from qsbearing.systems.sets.set_solution import ends_of
from tests.systems.sets.arrangements import S6210C, grooved_both_ways, rows, solved
from tests.systems.sets.test_equilibrium import load_of_springs

ACROSS = {"radial_load_y": 1000.0, "moment_z": 0.0}
GEAR = 2690.0


def stand(*ways: str | None, clearances: tuple[float, ...] = (10.0,), apart: float = 0.2) -> tuple[qs.Row, ...]:
    """Deep-groove rows about x = 0 with these clearances [um] in turn."""
    first = -0.5 * apart * (len(ways) - 1)
    return tuple(
        qs.Row(grooved_both_ways(clearances[n % len(clearances)] * um), first + n * apart, way)  # type: ignore[arg-type]
        for n, way in enumerate(ways)
    )


def of_rows(*ways: str | None, clearances: tuple[float, ...] = (10.0,), **operation: Any) -> qs.SetSolution:
    return solved(qs.BearingSet(stand(*ways, clearances=clearances), qs.Operation(**operation)))


def largest(found: qs.SetSolution) -> list[float]:
    return [float(row.inner.load.max()) for row in found.rows]


def half_play(clearance: float) -> float:
    """By the triangle of groove centres: ((r1 + r2 - D)^2 - (r1 + r2 - D - Pd/2)^2)^0.5 [m]."""
    span = 0.04 * 11.90625e-3
    return float(np.sqrt(span**2 - (span - 0.5 * clearance * um) ** 2))


# What rows carry ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("ways", [(None, None), ("+x", "+x"), ("both", "none")])
def test_two_clearances_do_not_press_each_other(ways: tuple[str | None, ...]) -> None:
    """Under a radial load alone; a shaft that tilts moves grooves axially by little."""
    found = of_rows(*ways, clearances=(10.0, 40.0), **ACROSS)
    assert largest(found) == pytest.approx([283.472, 390.450], abs=2e-3)
    assert np.abs(found.axial_loads).max() <= (0.1 if ways == (None, None) else 1e-6)


@pytest.mark.parametrize("ways", [("+x", "-x"), ("-x", "+x"), ("both", "both")])
def test_alike_rows_do_not_press_each_other(ways: tuple[str, ...]) -> None:
    found = of_rows(*ways, **ACROSS)
    assert largest(found) == pytest.approx([283.467] * 2, abs=1e-3)
    np.testing.assert_allclose(found.axial_loads, 0.0, atol=1e-7)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_thrust_is_carried_by_whoever_is_held_against_it(way: float) -> None:
    load = {"axial_load": way * GEAR, **ACROSS}
    carried = {
        ("both", "none"): [way * GEAR, 0.0],
        ("none", "both"): [0.0, way * GEAR],
        ("+x", "-x"): [GEAR, 0.0] if way > 0.0 else [0.0, GEAR],
        ("-x", "+x"): [0.0, GEAR] if way > 0.0 else [GEAR, 0.0],
        ("both", "-x" if way > 0.0 else "+x"): [way * GEAR, 0.0],
    }
    for ways, loads in carried.items():
        np.testing.assert_allclose(of_rows(*ways, **load).axial_loads, loads, atol=1e-5, err_msg=str(ways))


def test_a_thrust_that_no_row_is_held_against_has_no_equilibrium() -> None:
    for ways in (("+x", "+x"), ("none", "none"), ("+x", "none")):
        found = qs.solve_set(qs.BearingSet(stand(*ways), qs.Operation(axial_load=-GEAR, **ACROSS)))
        assert found.status == "no_equilibrium", ways
        assert "nothing supports the load in channel axial. The axial load acts in -x, which no row carries." in (
            found.message()
        )


def warm(ways: tuple[str, ...], warmer: float, **operation: Any) -> qs.SetSolution:
    """On a shaft warmer than its housing, over 300 mm, with half plays of 97 and 137 um."""
    shaft = qs.Shaft((qs.ShaftSection(0.5, 0.04),), -0.25, temperature=293.15 + warmer)
    return solved(
        qs.BearingSet(stand(*ways, clearances=(20.0, 40.0), apart=0.3), qs.Operation(**operation), shaft=shaft)
    )


@pytest.mark.parametrize("warmer", [80.0, -80.0])
def test_a_warm_shaft_presses_rows_that_are_held_against_it(warmer: float) -> None:
    """What the shaft grows by and both plays do not leave room for; from the side that holds neither, nothing."""
    outside, inside = (warm(ways, warmer, **ACROSS) for ways in (("-x", "+x"), ("+x", "-x")))
    both = warm(("both", "both"), warmer, **ACROSS)
    pressed, free = (outside, inside) if warmer > 0.0 else (inside, outside)
    assert half_play(20.0) == pytest.approx(97e-6, abs=0.5e-6) and half_play(40.0) == pytest.approx(137e-6, abs=1e-6)
    np.testing.assert_allclose(free.axial_loads, 0.0, atol=1e-6)
    np.testing.assert_allclose(pressed.axial_loads, np.abs(both.axial_loads), rtol=1e-6)
    assert pressed.axial_loads[0] == pytest.approx(pressed.axial_loads[1], rel=1e-6)
    assert 400.0 < pressed.axial_loads[0] < 800.0
    low, high = pressed.axial_play  # type: ignore[misc]
    assert low - high == pytest.approx(0.3 * 80.0 * 12e-6 - half_play(20.0) - half_play(40.0), rel=0.02)


# Against what shares no code with it ----------------------------------------------------------------------------------


def drawn(seed: int) -> tuple[list[float], qs.Operation]:
    """Clearances [um] and loads, in every channel and not."""
    rng = np.random.default_rng(seed)
    load = rng.uniform(-1.0, 1.0, 5) * [1500.0, 800.0, 500.0, 20.0, 20.0] * (rng.random(5) < 0.8)
    names = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
    return list(rng.uniform(5.0, 60.0, 3)), qs.Operation(**dict(zip(names, load, strict=True)))


@pytest.mark.parametrize("seed", range(6))
def test_located_rows_need_what_acts(seed: int) -> None:
    """Groove centres as points in space, of rows off their middles: springs between them add up to the loads."""
    clearances, operation = drawn(seed)
    offsets = np.random.default_rng(seed).uniform(-40e-6, 40e-6, 3)
    placed = (
        replace(row, offset=offset)
        for row, offset in zip(stand("both", "both", "both", clearances=tuple(clearances)), offsets, strict=True)
    )
    found = solved(qs.BearingSet(tuple(placed), operation))
    needed = load_of_springs(found.set, list(offsets), found.displacement)
    size = np.array([1.0, 1.0, 1.0, 0.03, 0.03]) * max(np.abs(found.row_loads).max(), 1.0)
    np.testing.assert_allclose((needed - found.load) / size, 0.0, atol=1e-8)


@pytest.mark.parametrize("seed", [0, 1, 2, 11, 89, 109, 128, 258])  # from 11 on rings come back that had drawn away
def test_one_state_of_the_rings_fits_and_it_is_the_one_found(seed: int) -> None:
    """Each ring held both ways or sliding in a sleeve of its own: of all combinations one has rings that press what
    holds them and rings that have drawn away from it."""
    clearances, operation = drawn(seed)
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 5))
    ways = list(rng.choice(["+x", "-x"], count))
    offsets = rng.uniform(-60e-6, 60e-6, count)
    if {np.sign(operation.axial_load)} - {0.0, *(1.0 if way == "+x" else -1.0 for way in ways)}:
        operation = replace(operation, axial_load=-np.asarray(operation.axial_load))
    placed = zip(stand(*ways, clearances=tuple(clearances)), offsets, strict=True)
    held = tuple(replace(row, offset=offset) for row, offset in placed)
    found = solved(qs.BearingSet(held, operation))
    fitting = []
    for free in product((False, True), repeat=count):
        alone = tuple(replace(row, carries="both", offset=row.sign * np.asarray(row.offset)) for row in held)  # type: ignore[arg-type]
        groups = tuple(qs.FloatingGroup((n,)) for n, each in enumerate(free, 1) if each)
        other = qs.solve_set(qs.BearingSet(alone, operation, floating=groups))
        if not other.converged:
            continue
        signs = np.array([row.sign for row in held])
        slid = np.zeros(count)
        slid[list(free)] = ends_of(other)[0].q[0, 6:]
        presses = (other.axial_loads * signs >= -1e-6) | free
        if presses.all() and (slid * signs <= 1e-9).all():
            fitting.append(other.row_loads * 1.0)
    assert fitting
    for loads in fitting:
        np.testing.assert_allclose(found.row_loads, loads, atol=1e-5 * np.abs(loads).max())


def mirrored(of: qs.BearingSet) -> qs.BearingSet:
    """In a plane across the shaft."""
    turned = {"+x": "-x", "-x": "+x"}
    placed = tuple(
        replace(row, position=-np.asarray(row.position), carries=turned.get(str(row.carries), row.carries),
                offset=row.offset if str(row.carries) in turned else -np.asarray(row.offset))
        for row in of.rows
    )  # fmt: skip
    changed = {
        name: -np.asarray(getattr(of.operation, name)) for name in ("axial_load", "moment_y", "moment_z")
    }  # fmt: skip
    return replace(of, rows=placed, operation=replace(of.operation, **changed))


@pytest.mark.parametrize("ways", [("both", "none", "-x"), ("+x", "-x", "none")])
@pytest.mark.parametrize("speed", [0.0, 9000 * qs.rpm])
def test_a_mirror_image_carries_the_mirrored_loads(ways: tuple[str, ...], speed: float) -> None:
    clearances, operation = drawn(3)
    operation = replace(operation, axial_load=700.0, speed=speed)
    effects: dict[str, Any] = {"ball_effects": (qs.CentrifugalForce(),), "raceway_control": "outer"} if speed else {}
    placed = (replace(row, offset=7e-6) for row in stand(*ways, clearances=tuple(clearances)))
    of = qs.BearingSet(tuple(placed), operation, **effects)
    one, other = solved(of), solved(mirrored(of))
    reversed_ = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])
    np.testing.assert_allclose(one.row_loads, other.row_loads * reversed_, atol=1e-6 * np.abs(one.row_loads).max())
    np.testing.assert_allclose(one.axial_play, -other.axial_play[::-1], atol=1e-15)  # type: ignore[index]


def test_cases_differ_in_what_holds_their_rings() -> None:
    """Of one call each case as it is alone."""
    thrust = np.array([-2000.0, -1.0, 0.0, 50.0, 3000.0])
    many = of_rows("+x", "-x", "none", clearances=(10.0, 40.0, 25.0), axial_load=thrust, **ACROSS)
    for k, load in enumerate(thrust):
        one = of_rows("+x", "-x", "none", clearances=(10.0, 40.0, 25.0), axial_load=load, **ACROSS)
        np.testing.assert_allclose(many.row_loads[k], one.row_loads, atol=1e-6 * np.abs(one.row_loads).max())
        np.testing.assert_allclose(many.stiffness[k], one.stiffness, rtol=1e-6, atol=1e-3)


# Play -----------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ways", "offsets", "play"),
    [
        (("both", "none"), (0.0, 0.0), (-1.0, 1.0)),
        (("both", "both"), (0.0, 20.0), (-1.0, 0.8)),
        (("-x", "+x"), (0.0, 0.0), (-1.0, 1.0)),
        (("-x", "+x"), (-30.0, -10.0), (-1.3, 1.1)),
        (("+x", "none"), (0.0, 0.0), (-np.inf, 1.0)),
        (("none", "none"), (0.0, 0.0), (-np.inf, np.inf)),
    ],
)
def test_the_play_is_as_far_as_rows_let_the_shaft_go(
    ways: tuple[str, ...], offsets: tuple[float, ...], play: tuple[float, ...]
) -> None:
    """With clearances alike, in multiples of 100 um; a shaft without load lies amid it, on no row."""
    clearance = 2e6 * 0.04 * 11.90625e-3 * (1.0 - np.sqrt(1.0 - (1e-4 / (0.04 * 11.90625e-3)) ** 2))
    placed = (
        replace(row, offset=offset * um)
        for row, offset in zip(stand(*ways, clearances=(clearance,)), offsets, strict=True)
    )
    found = solved(qs.BearingSet(tuple(placed)))
    np.testing.assert_allclose(found.axial_play, np.array(play) * 1e-4, rtol=1e-9)  # type: ignore[arg-type]
    assert found.is_axially_free
    if np.isfinite(play).all():
        assert found.displacement[0] == pytest.approx(50e-6 * sum(play), abs=1e-12)
    assert largest(found) == [0.0, 0.0]
    said = [each.remark for each in qs.warnings(found) if each.remark.code == "axially_free"]
    width = [each.values.get("play_um") for each in said]
    assert width == ([pytest.approx(100.0 * (play[1] - play[0]))] if np.isfinite(play).all() else [None])


@pytest.mark.parametrize("fraction", [0.97, 1.03])
def test_at_the_end_of_the_play_a_row_begins_to_carry(fraction: float) -> None:
    of = qs.BearingSet(stand("both", "both", clearances=(15.0, 45.0)))
    low, high = solved(of).axial_play  # type: ignore[misc]
    for end in (low, high):
        moved = solved(replace(of, operation=qs.Operation(axial_displacement=end * fraction)))
        assert (np.abs(moved.axial_loads).max() > 1e-3) == (fraction > 1.0)


def test_a_shaft_whose_rings_all_draw_back_lies_amid_what_they_leave() -> None:
    """A cold shaft held from outside, under a radial load: both rings are free, and as far from what holds them."""
    found = warm(("-x", "+x"), -80.0, **ACROSS)
    slid = ends_of(found)[0].q[0, 6:8]
    assert found.is_axially_free and slid[0] > 1e-5
    assert slid[0] == pytest.approx(-slid[1], rel=1e-9)
    needed = warm(("both", "both"), -80.0, **ACROSS)
    assert not needed.is_axially_free


def test_a_row_under_a_radial_load_holds_the_shaft_softly() -> None:
    """Some newtons per millimetre at a newton across: a place, and no play to lie amid."""
    found = of_rows("both", "none", radial_load_y=1.0, moment_z=0.0)
    assert not found.is_axially_free
    assert 300.0 < found.stiffness[0, 0] < 4000.0


# What keeps its meaning -----------------------------------------------------------------------------------------------


def test_angular_contact_beside_a_row_that_floats() -> None:
    """A preloaded pair locates; the deep-groove row behind it slides, as one in a sleeve of its own does."""
    pair = rows("DB", S6210C)
    behind = qs.Row(grooved_both_ways(10 * um), 0.3, "none")  # type: ignore[arg-type]
    around: dict[str, Any] = {"preload": qs.Preload(rigid=500.0)}
    load = qs.Operation(axial_load=300.0, radial_load_y=900.0, moment_z=-90.0)
    found = solved(qs.BearingSet((*pair, behind), load, **around))
    sleeve = qs.FloatingGroup((3,), preload=None)
    other = solved(qs.BearingSet((*pair, replace(behind, carries="both")), load, floating=(sleeve,), **around))  # type: ignore[arg-type]
    np.testing.assert_allclose(found.row_loads, other.row_loads, atol=1e-6 * np.abs(found.row_loads).max())
    assert found.preload_at_rest is not None
    np.testing.assert_allclose(found.preload_at_rest, [500.0, 500.0, 0.0], atol=1e-6)
    held = solved(qs.BearingSet((*pair, replace(behind, carries="both")), load, **around))  # type: ignore[arg-type]
    assert held.preload_at_rest[2] == pytest.approx(0.0, abs=1e-6)  # type: ignore[index]


def test_rows_that_a_preload_presses_stand_where_they_touch() -> None:
    """As springs between groove centres at their free angles need it."""
    of = qs.BearingSet(rows("DB", grooved_both_ways(10 * um), distance=0.1), preload=qs.Preload(rigid=400.0))
    found = solved(of)
    assert not any(of.is_two_sided)
    np.testing.assert_allclose(found.axial_loads, 400.0, rtol=1e-9)
    np.testing.assert_allclose(found.preload_in_operation, 400.0, rtol=1e-9)  # type: ignore[arg-type]
    pressed = [float(row.displacement[0]) for row in found.rows]
    loaded = solved(replace(of, operation=qs.Operation(axial_load=150.0, radial_load_z=200.0, moment_y=4.0)))
    needed = load_of_springs(of, pressed, loaded.displacement)
    np.testing.assert_allclose(needed, [150.0, 0.0, 200.0, 4.0, 0.0], atol=1e-6)


def test_a_spring_presses_a_row_against_one_that_is_located() -> None:
    """As in a motor: the spring's force goes through both; a located row needs no direction, a sprung one does."""
    first, second = stand("both", "-x")
    of = qs.BearingSet((first, replace(second, sprung=True)), qs.Operation(**ACROSS), qs.Preload(spring=150.0))
    found = solved(of)
    np.testing.assert_allclose(found.axial_loads, [150.0, 150.0], rtol=1e-6)
    with pytest.raises(qs.SceneError, match="leaves open what the spring presses"):
        replace(of, rows=(first, replace(second, sprung=True, carries="both")))  # type: ignore[arg-type]


def test_what_is_wrong_with_directions_is_said() -> None:
    with pytest.raises(qs.SceneError, match=r"row 1.carries.*is of deep-groove rows only"):
        qs.BearingSet((qs.Row(S6210C, 0.0, "both"),))  # type: ignore[arg-type]
    with pytest.raises(qs.SceneError) as caught:
        qs.BearingSet(stand(None, None), preload=qs.Preload(rigid=100.0))
    assert [each.field for each in caught.value.errors] == ["row 1.carries", "row 2.carries", "preload.rigid"]
    with pytest.raises(qs.SceneError, match="Only two angular-contact rows"):
        qs.BearingSet(stand("+x", "-x", apart=0.0))
    assert [str(row.carries) for row in qs.BearingSet((*stand(None), qs.Row(S6210C, 0.1))).rows] == ["both", "+x"]


@pytest.mark.parametrize(
    ("ways", "words"),
    [
        (("both", "none"), "locating and floating"),
        (("-x", "+x"), "cross location, each row from outside"),
        (("both", "none", "+x"), "located, floating, held in +x"),
    ],
)
def test_arrangements_in_words(ways: tuple[str, ...], words: str) -> None:
    assert qs.BearingSet(stand(*ways)).arrangement == words


def test_a_ring_that_slides_takes_its_stiffness_out_of_the_shaft() -> None:
    """The tangent by differences, with one ring held and one drawn away."""

    def at(moved: NDArray) -> qs.SetSolution:
        names = ("axial_displacement", "radial_displacement_y", "radial_displacement_z", "tilt_y", "tilt_z")
        return of_rows("+x", "-x", clearances=(10.0, 40.0), **dict(zip(names, moved, strict=True)))

    found = of_rows("+x", "-x", clearances=(10.0, 40.0), axial_load=200.0, radial_load_y=900.0, moment_z=1.0)
    assert ends_of(found)[0].held[0, 6:8].tolist() == [True, False]
    step = np.array([1e-8, 1e-8, 1e-8, 1e-7, 1e-7])
    for i in range(5):
        change = np.eye(5)[i] * step[i]
        slope = (at(found.displacement + change).load - at(found.displacement - change).load) / (2.0 * step[i])
        np.testing.assert_allclose(found.stiffness[:, i], slope, rtol=2e-4, atol=1e-5 * np.abs(slope).max())
