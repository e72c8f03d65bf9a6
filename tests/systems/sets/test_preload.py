"""Preloaded sets: printed rigidities, unloading, springs, and what speed makes of a preload."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.solution.preload_state import PreloadState
from qsbearing.systems.sets.preload_limits import preload_summary
from qsbearing.systems.sets.preload_search import StateChange, sentence, together
from tests.qsbearing.scenes import B218, BOTH, CENTRIFUGAL, OUTER
from tests.qsbearing.similarity import FITS, GROWN, warm_fits
from tests.systems.sets.arrangements import DISTANCE, S6210C, S6210E, pair, printed, rows, solved, spindle, with_load


@pytest.mark.parametrize(
    ("bearing", "name", "computed"),
    [
        (S6210C, "S 6210 C TA", (75.15, 124.78, 177.98)),
        (S6210E, "S 6210 E TA", (177.22, 271.27, 362.62)),
    ],
)
def test_printed_rigidities_of_pairs(bearing: qs.BallBearing, name: str, computed: tuple[float, ...]) -> None:
    """Validation: GMN's catalogue 4000 0813 EN. The groove radius was fitted to the 15 degree row, the 25 degree row
    is predicted. Printed to 1 N/um; `computed` stands with its two printed decimals."""
    row = printed(name)
    forces = np.array([row[f"Fv{size}"] for size in "LMS"])
    rigidities = np.array([row[f"Cax{size}"] for size in "LMS"])
    found = solved(qs.BearingSet(rows("DB", bearing), preload=qs.Preload(rigid=forces)))
    stiffness = found.stiffness[:, 0, 0] / 1e6
    np.testing.assert_allclose(stiffness, computed, atol=0.006)
    np.testing.assert_allclose(stiffness, rigidities, atol=0.5)  # half of the last printed digit


def test_a_pair_is_twice_as_stiff_as_its_row() -> None:
    """The tangent of a row under its preload, the contact angle free; at speed at the preload that is left."""
    for speed in (0.0, 8_000 * qs.rpm):
        effects = {"ball_effects": CENTRIFUGAL, "raceway_control": OUTER} if speed else {}
        found = solved(qs.BearingSet(rows("DB"), qs.Operation(speed), qs.Preload(rigid=720.0), **effects))
        operation = qs.Operation(speed, axial_load=found.axial_loads[0])
        alone = qs.solve(qs.Scene(S6210C, operation, *effects.values()))
        assert found.stiffness[0, 0] == pytest.approx(2.0 * alone.stiffness[0, 0], rel=1e-9)


def test_the_load_that_unloads_a_row() -> None:
    """2^(3/2) = 2.83 times the preload where the contact angle hardly changes, as with a steep and stiff bearing: the
    loaded row is then pressed twice as far. Changing angles make it somewhat more."""
    steep = replace(B218, free_contact_angle=80 * qs.deg)
    factors = {}
    for name, bearing in (("steep", steep), ("15 deg", S6210C)):
        of = qs.BearingSet(rows("DB", bearing), preload=qs.Preload(rigid=100.0))
        mounted = solved(of).rows[1].displacement[0]
        held = solved(with_load(of, axial_displacement=mounted))  # just so far that the second row is no longer pressed
        assert abs(held.axial_loads[1]) < 1e-9
        factors[name] = held.load[0] / 100.0
    assert factors["steep"] == pytest.approx(2.0**1.5, rel=2e-3)
    assert factors["15 deg"] > factors["steep"]
    lost = solved(pair("DB", 100.0, axial_load=1.1 * factors["15 deg"] * 100.0))
    assert list(lost.preload_state) == ["maintained", "lost"]
    (sentence,) = (each for each in lost.warnings() if each.startswith("Preload lost"))
    assert "row 2 (S 6210 C, carries -x)" in sentence
    assert "its preload is 100 N" in sentence


def test_three_ways_to_the_same_preload() -> None:
    """A force, the displacement that it takes, and that displacement as ring faces ground off."""
    by_force = solved(pair("DB", 720.0, speed=10_000 * qs.rpm))
    mounted = by_force.rows[0].displacement[0]
    total = qs.Preload(axial_displacement=2.0 * mounted)
    by_displacement = solved(replace(by_force.set, preload=total))
    first, second = rows("DB")
    ground = (replace(first, offset=2.0 * mounted), second)
    by_faces = solved(replace(by_force.set, rows=ground, preload=None))
    for other in (by_displacement, by_faces):
        np.testing.assert_allclose(other.axial_loads, by_force.axial_loads, rtol=1e-9)
        np.testing.assert_allclose(other.preload_at_rest, [720.0, 720.0], rtol=1e-9)
    assert by_faces.displacement[0] == pytest.approx(-mounted, rel=1e-9)


def test_tandem_rows_share_the_preload_of_their_side() -> None:
    found = solved(qs.BearingSet(rows("TBT"), preload=qs.Preload(rigid=600.0)))
    np.testing.assert_allclose(found.axial_loads, [300.0, 300.0, 600.0], rtol=1e-9)


def test_a_spring_keeps_its_force() -> None:
    """At any speed and load the sprung row carries the spring's force, and the other the load as well. Axially the
    shaft rests on that other row alone."""
    first, second = rows("DB")
    of = qs.BearingSet(
        (first, replace(second, sprung=True)),
        qs.Operation(np.array([0.0, 5_000.0, 15_000.0]) * qs.rpm, axial_load=50.0),
        qs.Preload(spring=300.0), ball_effects=CENTRIFUGAL, raceway_control=OUTER,
    )  # fmt: skip
    found = solved(of)
    np.testing.assert_allclose(found.axial_loads[:, 1], 300.0, rtol=1e-10)
    np.testing.assert_allclose(found.axial_loads[:, 0], 350.0, rtol=1e-10)
    np.testing.assert_allclose(found.stiffness[:, 0, 0], found.rows[0].stiffness[:, 0, 0], rtol=1e-9)
    assert list(found.preload_state[2]) == ["maintained", "maintained"]
    # differences of the whole set, the spring sliding
    step = 0.01
    more, less = (solved(with_load(of, axial_load=50.0 + sign * step)).displacement[:, 0] for sign in (1.0, -1.0))
    np.testing.assert_allclose(2.0 * step / (more - less), found.stiffness[:, 0, 0], rtol=1e-5)


def test_more_than_the_spring_gives_way() -> None:
    first, second = rows("DB")
    of = qs.BearingSet((first, replace(second, sprung=True)), qs.Operation(axial_load=-310.0), qs.Preload(spring=300.0))
    found = qs.solve_set(of)
    assert found.status == "no_equilibrium"
    assert "The axial load in -x is more than the spring's 300 N." in found.message()
    assert np.isnan(found.displacement).all()
    assert np.isnan(found.rows[0].inner.load).all()


def test_more_than_the_spring_is_unsupported_where_no_row_gives_way() -> None:
    """At speed the rows may stay pressed on the way: that the spring gives no more is reason enough."""
    first, second = rows("DB")
    operation = qs.Operation(
        14_937.207712996758 * qs.rpm, axial_load=-805.4271168722496, radial_load_y=94.72420263843988, moment_z=0.0
    )
    pair_on_spring = (first, replace(second, sprung=True))
    of = qs.BearingSet(pair_on_spring, operation, qs.Preload(spring=300.0), ball_effects=BOTH, raceway_control=OUTER)
    found = qs.solve_set(of)
    assert (found.status, found.reason) == (qs.Status.NO_EQUILIBRIUM, qs.Reason.UNSUPPORTED)
    assert "The axial load in -x is more than the spring's 300 N." in found.message()


def test_a_preload_that_no_row_carries() -> None:
    """Balls of 2.4 mm under 100 MN: the row is pressed further than its balls are large, at rest already."""
    small = spindle("S 619/5 C TA", 0.52)
    both = (qs.Row(S6210C, 0.0), qs.Row(small, 0.05, "-x"))  # type: ignore[arg-type]
    found = qs.solve_set(qs.BearingSet(both, preload=qs.Preload(rigid=np.array([500.0, 1e8]))))
    assert list(found.status) == ["converged", "no_equilibrium"]
    assert "row 2 (S 619/5 C, carries -x) cannot carry the preload" in found.message(1)
    assert [qs.message(found, k) for k in (0, 1, None)] == [found.message(k) for k in (0, 1, None)]
    assert len({qs.message(found, k) for k in (0, 1, None)}) == 3
    assert qs.warnings(found, 0) == found.warnings(0)
    assert np.isnan(found.row_loads[1]).all()
    assert found.row_loads[0, 0, 0] == pytest.approx(500.0, rel=1e-9)


def test_a_row_that_gives_way_at_speed() -> None:
    """Inner control asks friction of contacts that a spring presses too lightly; it says which row and from when."""
    first, second = rows("DB", B218, replace(B218, ball_material=qs.SILICON_NITRIDE, name="hybrid 218"))
    of = qs.BearingSet(
        (first, replace(second, sprung=True)), qs.Operation(15_000 * qs.rpm), qs.Preload(spring=1000.0),
        ball_effects=BOTH, raceway_control=qs.RacewayControl.INNER,
    )  # fmt: skip
    found = qs.solve_set(of)
    assert found.status == "no_equilibrium"
    assert found.row_that_gives_way == 0  # steel balls are heavier
    said = "Row 1 (B218, carries +x) has no solution. No equilibrium under this raceway control"
    assert found.message().startswith(said)
    (ends,) = qs.preload_speeds(of, 15_000 * qs.rpm)
    assert (ends.row, ends.state) == (0, "no_equilibrium")
    assert ends.sentence.startswith("Row 1 (B218, carries +x): no equilibrium at")
    at = np.array([0.99, 1.0]) * ends.speed
    assert list(qs.solve_set(with_load(of, speed=at)).status) == ["converged", "no_equilibrium"]


def test_a_load_that_no_row_carries() -> None:
    found = qs.solve_set(pair("DT", axial_load=-200.0))
    assert found.status == "no_equilibrium"
    assert "The axial load acts in -x, which no row carries." in found.message()
    assert qs.message(found) == found.message()
    assert qs.warnings(found) == found.warnings()


def test_speeds_at_which_a_preload_runs_away() -> None:
    """Centrifugal forces press fixed rows ever harder; the speed found is where the sentence says."""
    of = pair("DB", 240.0, speed=0.0)
    found = qs.preload_speeds(of, 30_000 * qs.rpm)
    assert [(each.row, each.state) for each in found] == [(0, "excessive"), (1, "excessive")]
    at = np.array([0.999, 1.001]) * found[0].speed
    below, above = solved(with_load(of, speed=at)).axial_loads[:, 0]
    assert below < 3.0 * 240.0 < above
    assert found[0].sentence.startswith("Row 1 (S 6210 C, carries +x): the preload exceeds 3 times its given value")
    first, second = rows("DB")
    sprung = replace(of, rows=(first, replace(second, sprung=True)), preload=qs.Preload(spring=240.0))
    assert qs.preload_speeds(sprung, 30_000 * qs.rpm) == []


def test_what_becomes_of_several_rows_is_said_once_and_of_one_alone_by_itself() -> None:
    """Whichever rows: a preload that runs away is a matter of all; one that is lost, or a set that ends, of its own."""
    of = qs.BearingSet(rows("DB"), preload=qs.Preload(rigid=720.0))
    every = [
        *(StateChange(speed, row, "maintained", PreloadState.EXCESSIVE) for row, speed in enumerate((900.0, 901.0))),
        *(StateChange(950.0, row, "maintained", PreloadState.LOST) for row in (0, 1)),
        StateChange(990.0, -1, "", "no_equilibrium"),
    ]
    said = [sentence(of, same, lambda where: "here", "at once") for same in together(every)]
    begun = ("Rows 1 and 2: the preload exceeds", "Row 1 (", "Row 2 (", "The set: no equilibrium")
    assert len(said) == len(begun)
    assert all(text.startswith(beginning) for text, beginning in zip(said, begun, strict=True)), said


def test_speeds_at_which_a_preload_is_lost() -> None:
    """An outer ring that a warm, turning row outgrows is not there; but a shaft load is: the row that it relieves is
    free at rest, and pressed again at speed."""
    of = pair("DB", 240.0, axial_load=800.0, speed=0.0)
    found = qs.preload_speeds(of, 20_000 * qs.rpm)
    assert found[0] == qs.preload_speeds(of, 1_000 * qs.rpm)[0]
    assert (found[0].row, found[0].state, found[0].speed) == (1, "lost", 0.0)


def test_what_is_wrong_is_said_at_once() -> None:
    with pytest.raises(qs.SceneError) as caught:
        qs.BearingSet(
            (qs.Row(S6210C, 0.0), qs.Row(S6210C, 0.0, "right", offset=1.0)),  # type: ignore[arg-type]
            preload=qs.Preload(spring=100.0),
        )
    said = [each.field for each in caught.value.errors]
    assert said == ["row 2.carries", "row 2.offset", "row 2.position", "preload.spring"]
    with pytest.raises(qs.SceneError, match=r"has no row to press against.*All rows carry in \+x"):
        qs.BearingSet(rows("DT"), preload=qs.Preload(rigid=100.0))
    with pytest.raises(qs.SceneError, match="raceway_control: missing") as caught:
        qs.BearingSet(rows("DB"), ball_effects=CENTRIFUGAL)
    assert len(caught.value.errors) == 1  # not once a row
    both = (replace(row, sprung=True) for row in rows("DB"))
    with pytest.raises(qs.SceneError, match="opposite directions"):
        qs.BearingSet(tuple(both), preload=qs.Preload(spring=100.0))


def test_arrangements_by_their_names() -> None:
    names = [pair(name).arrangement for name in ("DB", "DF", "DT")]
    assert names == ["DB (back to back)", "DF (face to face)", "DT (tandem)"]
    assert qs.BearingSet(rows("TBT")).arrangement == "+x +x -x"
    assert float(qs.BearingSet(rows("TBT")).reference) == pytest.approx(0.0, abs=1e-12)
    assert float(qs.BearingSet((qs.Row(S6210C, 0.1), qs.Row(S6210C, 0.1 + DISTANCE))).reference) == pytest.approx(0.11)


def test_life_of_a_set() -> None:
    """Never above the weakest row's; two equal rows live 2^-0.9 of one; an unloaded row takes nothing."""
    found = solved(pair("DB", 240.0, speed=8_000 * qs.rpm, axial_load=np.linspace(0.0, 500.0, 6)))
    lives = [qs.readings.life(row).basic_reference_rating_life for row in found.rows]
    whole = qs.system_life(lives)
    assert np.all(whole <= np.minimum(*lives))
    assert whole[0] == pytest.approx(2.0**-0.9 * lives[0][0], rel=1e-12)
    assert qs.system_life([1.0, np.inf]) == 1.0
    assert qs.system_life([np.inf, np.inf]) == np.inf
    assert qs.system_life([3.0, 2.0]) == pytest.approx((3.0 ** (-10 / 9) + 2.0 ** (-10 / 9)) ** -0.9)


@pytest.mark.parametrize("speed", [0.0, 12_000 * qs.rpm])
@pytest.mark.parametrize("inner, outer", [(20.0, 20.0), (60.0, 20.0), (20.0, 45.0)])
def test_a_rigid_pair_is_twice_a_bearing_with_rigid_preload(speed: float, inner: float, outer: float) -> None:
    """By symmetry the shaft of a pair stays: each row, loose on a shaft and in a housing that do not grow, is the
    single bearing held where its preload took it, hot or cold, still or turning; and rings that grow apart from cold
    balls take the preload away, from both."""
    temperatures = {"inner_ring_temperature": inner, "outer_ring_temperature": outer}
    temperatures |= {"shaft_temperature": 20.0, "housing_temperature": 20.0}
    hot = {name: value + qs.zero_celsius for name, value in temperatures.items()}
    loose = {"shaft_interference": -0.1 * qs.mm, "housing_interference": -0.1 * qs.mm, "housing_outside_diameter": 0.15}
    growth = qs.RingExpansion(50 * qs.mm, 90 * qs.mm, **loose, **hot)  # type: ignore[arg-type]
    effects: dict[str, Any] = {"ball_effects": BOTH, "raceway_control": OUTER} if speed else {}
    preload = qs.Preload(rigid=720.0)
    ring, ball = (replace(each, thermal_expansion=12e-6) for each in (S6210C.ring_material, S6210C.ball_material))
    bearing = replace(S6210C, ring_material=ring, ball_material=ball)
    effects["ring_effects"] = (growth, qs.BallExpansion(20.0 + qs.zero_celsius))
    alone = qs.solve(qs.Scene(bearing, qs.Operation(speed), preload=preload, **effects))
    found = solved(qs.BearingSet(rows("DB", bearing), qs.Operation(speed), preload, **effects))
    np.testing.assert_allclose(found.axial_loads, alone.load[0], rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(found.rows[0].displacement, alone.displacement, rtol=1e-9, atol=1e-15)
    assert found.preload_at_rest == pytest.approx(720.0, rel=1e-9)
    assert found.preload_in_operation == pytest.approx(found.axial_loads, rel=1e-8, abs=1e-9)
    if outer > 20.0 and not speed:
        assert list(found.preload_state) == ["lost", "lost"]


# Fits ---------------------------------------------------------------------------------------------------------------


def fitted_pair(preload: qs.Preload, interference: float = 8 * qs.um, **operation: Any) -> qs.BearingSet:
    """Two rows of S 6210 C on a fit."""
    rings = qs.RingExpansion(50 * qs.mm, 90 * qs.mm, shaft_interference=interference)
    return qs.BearingSet(rows("DB"), qs.Operation(**operation), preload, ring_effects=(rings,))


def test_a_preload_before_fitting_mounted_and_in_operation() -> None:
    """Each row is the bearing alone with its fit, where the preload took it; given mounted, it is the same set."""
    found = solved(fitted_pair(qs.Preload(rigid=300.0), axial_load=50.0))
    alone = qs.solve(
        qs.Scene(S6210C, qs.Operation(), ring_effects=found.set.ring_effects, preload=qs.Preload(rigid=300.0))
    )
    np.testing.assert_allclose(found.preload_unmounted, 300.0, rtol=1e-9)
    np.testing.assert_allclose(found.preload_at_rest, 300.0, rtol=1e-9)
    np.testing.assert_allclose(found.preload_mounted, alone.load[0], rtol=1e-9)
    np.testing.assert_allclose(found.preload_in_operation, found.preload_mounted, rtol=1e-9)
    mounted = solved(fitted_pair(qs.Preload(mounted=alone.load[0]), axial_load=50.0))
    np.testing.assert_allclose(mounted.axial_loads, found.axial_loads, rtol=1e-9)
    np.testing.assert_allclose(mounted.preload_at_rest, alone.load[0], rtol=1e-9)
    np.testing.assert_allclose(mounted.preload_unmounted, 300.0, rtol=1e-9)
    assert alone.load[0] > 600.0
    assert list(mounted.preload_state) == ["maintained", "maintained"]


def test_what_is_said_of_a_preload_at_rest_does_not_speak_of_speed() -> None:
    found = solved(fitted_pair(qs.Preload(rigid=300.0), 20 * qs.um))
    first = next(each for each in found.warnings() if each.startswith("Preload"))
    assert first.startswith("Preload excessive: row 1 (S 6210 C, carries +x) is pressed by 300 N before fitting, ")
    assert f"{found.preload_mounted[0]:.4g} N mounted and {found.preload_in_operation[0]:.4g} N in operation" in first
    assert not any("at speed" in each for each in [*found.warnings(), *preload_summary(found)])
    assert any(
        each.startswith("Fitting changes the preload of the rows from 300 N to") for each in preload_summary(found)
    )
    (excessive, _) = qs.preload_speeds(found.set, 1_000 * qs.rpm)
    assert excessive.sentence.endswith("exceeds 3 times its given value already at rest, under these loads.")


@pytest.mark.parametrize(
    ("rpm", "load", "kept"),
    [
        (0.0, 0.0, None),
        (0.0, 20.0, "up to 10 times the loads"),
        (2000.0, 0.0, "up to 3000 rpm (1.5 times the speed)"),
        (2000.0, 20.0, "up to 3000 rpm (1.5 times the speed) and up to 10 times the loads"),
    ],
)
def test_up_to_where_a_preload_is_kept_is_said_of_what_varies(rpm: float, load: float, kept: str | None) -> None:
    said = preload_summary(solved(pair("DB", 720.0, speed=rpm * qs.rpm, axial_load=load)))
    expected = [] if kept is None else [f"All rows keep their preload {kept}."]
    assert [each for each in said if each.startswith("All rows keep")] == expected


def test_how_much_of_a_maintained_preload_is_left_is_said() -> None:
    """Where a load relieves a row: what it leaves, and how its stiffness fell; the share is that without the load."""
    found = solved(pair("DB", 720.0, axial_load=1300.0))
    share = found.axial_loads[1] / 720.0
    assert list(found.preload_state) == ["maintained", "reduced"]
    assert found.preload_share == pytest.approx([1.0, 1.0], rel=1e-9)
    assert 0.01 < share < 0.5
    (said,) = (each for each in found.warnings() if each.startswith("Preload"))
    row = "row 2 (S 6210 C, carries -x)"
    assert said.startswith(f"Preload reduced: the loads leave {row} only {found.axial_loads[1]:.4g} N of its preload")
    before, now = (each.rows[1].stiffness[0, 0] / 1e6 for each in (found.mounted, found))
    part = f"of 720 N before fitting ({100 * share:.3g} %)"
    assert f"{part}; its axial stiffness fell from {before:.4g}" in said
    assert f"to {now:.4g} N/µm" in said
    many = solved(pair("DB", 720.0, axial_load=np.array([0.0, 1300.0])))
    (said,) = (each for each in many.warnings() if "Preload" in each)
    assert said.startswith(f"1 of 2 cases, the first 1: Preload reduced: the loads leave {row} only ")


# Heat -----------------------------------------------------------------------------------------------------------------


def of_b218(arrangement: str, scale: float, bearing: qs.BallBearing, kind: str, value: float) -> qs.BearingSet:
    """Rows of B218 with all lengths of the set scaled, loaded from all sides, and preloaded in one of the ways."""
    found = rows(arrangement, bearing, distance=60 * qs.mm * scale)
    if kind == "spring":
        found = tuple(replace(row, sprung=row.sign < 0.0) for row in found)
    if kind == "offset":
        found = (replace(found[0], offset=value), *found[1:])
    preload = None if kind == "offset" else qs.Preload(**{kind: value})
    loads = {"axial_load": 500.0, "radial_load_y": 900.0, "radial_load_z": -300.0, "moment_y": 20.0, "moment_z": -30.0}
    larger = {name: load * scale ** (3 if "moment" in name else 2) for name, load in loads.items()}
    return qs.BearingSet(found, qs.Operation(**larger), preload, reference_position=0.01 * scale)


@pytest.mark.parametrize("arrangement", ["DB", "DF", "TBT"])
@pytest.mark.parametrize(
    ("kind", "value"), [("rigid", 8e3), ("axial_displacement", 5e-5), ("spring", 8e3), ("offset", 5e-5)]
)
def test_uniform_heat_is_a_similarity(arrangement: str, kind: str, value: float) -> None:
    """Distances, offsets and held displacements grow as the bearings do: under loads that grow with their square and
    moments with their cube, every row carries as much more. A spring keeps its force, and is given more here."""
    cold = solved(replace(of_b218(arrangement, 1.0, B218, kind, value), ring_effects=(qs.RingExpansion(**FITS),)))
    of = of_b218(arrangement, GROWN, B218, kind, value * GROWN**2 if kind == "spring" else value)
    of = replace(of, rows=tuple(replace(row, position=row.position / GROWN) for row in of.rows))  # type: ignore[operator]
    of = replace(of, reference_position=0.01, ring_effects=warm_fits())
    warm = solved(of)
    np.testing.assert_allclose(warm.axial_loads, cold.axial_loads * GROWN**2, rtol=1e-7)
    np.testing.assert_allclose(warm.rows[0].inner.load, cold.rows[0].inner.load * GROWN**2, rtol=1e-7)
    np.testing.assert_allclose(warm.displacement[:3], cold.displacement[:3] * GROWN, rtol=1e-7)
    np.testing.assert_allclose(warm.displacement[3:], cold.displacement[3:], rtol=1e-7)


def test_a_warmer_shaft_parts_inner_rings_as_spacers_would() -> None:
    """Back to back it takes from the preload what its growth between the rows is, face to face it adds as much; in
    tandem it shifts load from row to row. A set of rows close to each other with offsets of that size carries the
    same."""
    shaft, housing = 12e-6 * 40.0, 12e-6 * 10.0
    bodies = {"shaft": 60.0, "inner_ring": 20.0, "outer_ring": 20.0, "housing": 30.0}
    effects = warm_fits(**{body: celsius + qs.zero_celsius for body, celsius in bodies.items()})
    carried = {}
    for arrangement in ("DB", "DF", "TBT"):
        apart = rows(arrangement, B218, distance=60 * qs.mm)
        together = tuple(
            replace(row, position=place, offset=row.sign * (shaft - housing) * (float(row.position) - place))
            for place, row in zip((0.0, 1e-3, 2e-3), apart, strict=False)
        )
        one, other = (
            solved(qs.BearingSet(each, preload=qs.Preload(axial_displacement=8e-5), ring_effects=effects))
            for each in (apart, together)
        )
        # the offsets given are lengths of the shaft, which grow by a two-thousandth once more
        np.testing.assert_allclose(one.axial_loads, other.axial_loads, rtol=2e-3)
        carried[arrangement] = one.axial_loads
    at_one_place = rows("DB", B218, distance=0.0)
    none = solved(qs.BearingSet(at_one_place, preload=qs.Preload(axial_displacement=8e-5), ring_effects=effects))
    assert carried["DB"][0] < none.axial_loads[0] < carried["DF"][0]


def test_a_shaft_that_is_not_as_warm_at_every_row_grows_between_them_by_the_mean() -> None:
    """Three rows at 20, 40 and 80 degrees, 50 and 100 mm apart, counted from 10 mm before the second."""
    places, celsius = np.array([0.0, 0.05, 0.15]), (20.0, 40.0, 80.0)
    effects = (warm_fits(shaft=each + qs.zero_celsius, housing=20.0 + qs.zero_celsius) for each in celsius)
    found = tuple(
        qs.Row(B218, float(place), "+x", ring_effects=effect)  # type: ignore[arg-type]
        for place, effect in zip(places, effects, strict=True)
    )
    of = qs.BearingSet(found, qs.Operation(axial_load=1e3), reference_position=0.04)
    moved = [float(of.growth[0](of.rows[number].position)) for number in range(3)]
    expected = 12e-6 * np.array([-10.0 * 0.04, 10.0 * 0.01, 10.0 * 0.01 + 40.0 * 0.1])
    np.testing.assert_allclose(moved, expected, rtol=1e-9)
    both = warm_fits(shaft=np.array([20.0, 80.0]) + qs.zero_celsius)
    spanning = replace(of, rows=(*of.rows[:2], replace(of.rows[2], ring_effects=both)))
    np.testing.assert_allclose(
        spanning.growth[0](spanning.rows[2].position), [12e-6 * (0.1 + 10.0 * 0.1), expected[2]], rtol=1e-9
    )
    assert solved(spanning).axial_loads.shape == (2, 3)
