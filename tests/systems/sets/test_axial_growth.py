"""Shaft, housing and spacers that grow, and groups that slide: what becomes of rows' loads."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.operation import STRAIGHT
from tests.systems.sets.arrangements import S6210C
from tests.systems.sets.test_elastic_shaft import SHAFT, spindle

WARM = 45.0 + qs.zero_celsius
STRAIN = 12e-6 * 25.0
UNLOADED = replace(SHAFT, loads=())
HOUSING = qs.Housing(temperature=35.0 + qs.zero_celsius, material=replace(qs.STEEL, thermal_expansion=10e-6))
REAR = qs.FloatingGroup((3, 4))


def pressed(of: qs.BearingSet, *offsets: float) -> qs.BearingSet:
    """The set with these offsets of its rows."""
    rows = tuple(replace(row, offset=float(row.offset) + by) for row, by in zip(of.rows, offsets, strict=True))
    return replace(of, rows=rows)


def loads(of: qs.BearingSet) -> Any:
    """Axial loads of the rows."""
    return qs.solve_set(of).axial_loads


def test_a_warm_shaft_in_a_warm_housing_presses_rows_as_offsets_do() -> None:
    """The shaft as long as it becomes, cold, and rows pressed by what rings part."""
    of = replace(spindle(replace(UNLOADED, temperature=WARM), preload=None), housing=HOUSING)
    of = pressed(of, *4 * [10 * qs.um])
    s = 1.0 + STRAIN
    sections = tuple(
        replace(
            each, length=each.length * s, outer_diameter=each.outer_diameter * s, inner_diameter=each.inner_diameter * s
        )
        for each in UNLOADED.sections
    )
    apart = (STRAIN - 15.0 * 10e-6) * (np.array([0.0, 0.02, 0.15, 0.17]) - 0.085) * np.array([1, -1, 1, -1])
    larger = replace(UNLOADED, sections=sections, start=0.085 + (UNLOADED.start - 0.085) * s, points={})
    rows = tuple(replace(row, position=0.085 + (float(row.position) - 0.085) * s) for row in of.rows)
    cold = pressed(replace(of, rows=rows, shaft=larger, housing=None), *(apart + STRAIN * 10 * qs.um))
    assert loads(of) == pytest.approx(loads(cold), rel=1e-9)


@pytest.mark.parametrize("is_inner", [True, False])
def test_a_spacer_of_other_length_or_heat_is_an_offset(is_inner: bool) -> None:
    """Ring faces ground off by as much; half each, since a set is free along the shaft."""
    of = spindle(None, preload=qs.Preload(axial_displacement=20 * qs.um))
    of = replace(of, rows=of.rows[:2])
    lengths = {"inner_length": 10.004 * qs.mm, "outer_length": 10.010 * qs.mm}
    ground = pressed(of, 3 * qs.um, 3 * qs.um)
    assert loads(replace(of, spacers=(qs.Spacer((1, 2), **lengths),))) == pytest.approx(loads(ground), rel=1e-6)
    name, sign = ("inner", -1.0) if is_inner else ("outer", 1.0)
    heated = qs.Spacer((1, 2), **{f"{name}_length": 10 * qs.mm, f"{name}_temperature": WARM})
    by = 0.5 * sign * STRAIN * 10 * qs.mm
    assert loads(replace(of, spacers=(heated,))) == pytest.approx(loads(pressed(of, by, by)), rel=1e-6)
    turned = qs.Spacer((2, 1), **lengths)
    assert loads(replace(of, spacers=(turned,))) == pytest.approx(loads(ground), rel=1e-6)


def test_a_spacer_as_warm_as_its_body_changes_nothing() -> None:
    of = replace(spindle(replace(UNLOADED, temperature=WARM)), housing=HOUSING)
    spacer = qs.Spacer((2, 3), 100 * qs.mm, 100 * qs.mm, outer_material=HOUSING.material)
    assert loads(replace(of, spacers=(spacer,))) == pytest.approx(loads(of), rel=1e-9)


def test_a_group_that_floats_lets_the_shaft_grow() -> None:
    of = spindle(UNLOADED)
    cold, warm = (replace(of, shaft=replace(UNLOADED, temperature=each)) for each in (None, WARM))
    assert loads(warm)[[0, 3]] != pytest.approx(loads(cold)[[0, 3]], rel=0.2)
    floating = [qs.solve_set(replace(each, floating=(REAR,))) for each in (cold, warm)]
    assert floating[0].axial_loads == pytest.approx(np.full(4, 1500.0), rel=1e-9)  # each pair has the preload
    # Within a pair, 20 mm of the shaft grow by 6 um and its rows are pressed by as much.
    pair = replace(of, rows=of.rows[:2], shaft=replace(UNLOADED, temperature=WARM))
    assert floating[1].axial_loads[:2] == pytest.approx(loads(pair), rel=1e-3)
    assert floating[1].axial_loads[2] == pytest.approx(floating[1].axial_loads[3], rel=1e-9)


def test_a_floating_group_carries_no_axial_load_and_a_spring_its_force() -> None:
    for force in (0.0, 300.0, -250.0):
        of = replace(spindle(SHAFT), floating=(replace(REAR, spring=force),))
        found = qs.solve_set(of)
        along = found.axial_loads * np.array([1.0, -1.0, 1.0, -1.0])
        assert found.converged
        assert along[2:].sum() == pytest.approx(-force, abs=1e-6)
        assert along[:2].sum() == pytest.approx(force - 200.0, abs=1e-6)


def test_a_group_has_a_preload_of_its_own() -> None:
    of = replace(spindle(UNLOADED), floating=(replace(REAR, preload=qs.Preload(mounted=400.0)),))
    assert loads(of) == pytest.approx([1500.0, 1500.0, 400.0, 400.0], rel=1e-9)


def test_tandems_spring_loaded_against_each_other_keep_their_force() -> None:
    rows = tuple(qs.Row(S6210C, at, way) for at, way in ((0.0, "+x"), (0.02, "+x"), (0.15, "-x"), (0.17, "-x")))
    temperatures = np.array([20.0, 60.0]) + qs.zero_celsius
    shaft = replace(UNLOADED, temperature=temperatures)
    of = qs.BearingSet(rows, shaft=shaft, floating=(replace(REAR, spring=500.0),))
    found = qs.solve_set(of)
    assert found.axial_loads.reshape(2, 2, 2).sum(axis=-1) == pytest.approx(np.full((2, 2), 500.0), rel=1e-9)


def test_a_load_beyond_the_spring_of_a_sleeve_pushes_the_shaft_out() -> None:
    rows = tuple(qs.Row(S6210C, at, way) for at, way in ((0.0, "+x"), (0.02, "+x"), (0.15, "-x"), (0.17, "-x")))
    springs = replace(REAR, spring=500.0)
    load = qs.Operation(axial_load=np.array([-490.0, -510.0]), **STRAIGHT)
    found = qs.solve_set(qs.BearingSet(rows, load, shaft=UNLOADED, floating=(springs,)))
    assert list(found.status) == ["converged", "no_equilibrium"]
    assert found.reason[1] == "unsupported"
    assert "nothing supports the load in channel axial" in found.message(1)
    assert "All rows that carry in -x float" in found.message(1)
    # Not where a support holds the shaft, nor where a row that does not float carries in the load's direction.
    held = replace(UNLOADED, supports=(qs.ShaftSupport(0.1, axial=1e8),))
    assert np.all(qs.solve_set(qs.BearingSet(rows, load, shaft=held, floating=(springs,))).converged)
    tilted = qs.Operation(axial_load=-510.0, moment_y=0.0, moment_z=1e5, radial_load_y=0.0, radial_load_z=0.0)
    overturned = qs.solve_set(qs.BearingSet(rows, tilted, shaft=held, floating=(springs,)))
    assert not overturned.converged and "channel axial" not in overturned.message()
    rear = qs.FloatingGroup((3,), 500.0)
    assert np.all(qs.solve_set(qs.BearingSet(rows, load, shaft=UNLOADED, floating=(rear,))).converged)


def test_stiffness_lets_a_sleeve_slide() -> None:
    of = replace(spindle(SHAFT), floating=(REAR,))
    found = qs.solve_set(of)
    more = -200.0 + np.array([2.0, -2.0])
    near = qs.solve_set(replace(of, shaft=replace(SHAFT, loads=(replace(SHAFT.loads[0], axial=more),))))
    slope = (near.deflection(-0.07)[0, 0] - near.deflection(-0.07)[1, 0]) / 4.0
    assert slope == pytest.approx(found.points["tool"].compliance[:, 0], rel=1e-5, abs=1e-14)


def test_rings_take_their_seat_from_the_shaft() -> None:
    """A diameter, a material and a temperature are given once."""
    seat = {"bore_diameter": 50 * qs.mm, "outside_diameter": 90 * qs.mm, "shaft_interference": 4 * qs.um}
    of = replace(spindle(replace(UNLOADED, temperature=WARM)), ring_effects=(qs.RingExpansion(**seat),))
    given = {"shaft_material": qs.STEEL, "shaft_temperature": WARM}
    bores = (20 * qs.mm, 20 * qs.mm, 30 * qs.mm, 30 * qs.mm)
    for row, bore in zip(of.rows, bores, strict=True):
        assert of.effects_of(row) == (qs.RingExpansion(**seat, **given, shaft_bore_diameter=bore),)
    with pytest.raises(qs.SceneError, match=r"differs from shaft\.temperature"):
        replace(of, ring_effects=(qs.RingExpansion(**seat, shaft_temperature=WARM + 5.0),))


def test_every_error_of_surroundings_is_named() -> None:
    of = spindle(UNLOADED)
    for wrong, field in (
        ({"spacers": (qs.Spacer((1, 5), 0.01),)}, "spacer 1.rows"),
        ({"floating": (REAR, qs.FloatingGroup((4,)))}, "floating 2.rows"),
        ({"floating": (qs.FloatingGroup((2, 4)),)}, "preload.rigid"),
    ):
        with pytest.raises(qs.SceneError) as caught:
            replace(of, **wrong)
        assert [error.field for error in caught.value.errors] == [field]
    with pytest.raises(qs.SceneError, match="no length"):
        qs.Spacer((1, 2))
    with pytest.raises(qs.SceneError, match="thermal_expansion"):
        qs.Housing(WARM, replace(qs.STEEL, thermal_expansion=None))
