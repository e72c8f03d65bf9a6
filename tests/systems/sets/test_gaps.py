"""Rows with clearance, loaded across their shaft: gaps in which nothing resists until balls touch."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from tests.systems.sets.arrangements import S6210E, grooved_both_ways, solved
from tests.systems.sets.test_equilibrium import load_of_springs

CHANNELS = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
FEW, MORE = 20, 30
"""Iterations that a case with gaps takes at most, of those drawn here: without thrust it starts where its balls touch;
with a light one, from a shaft that the thrust alone has centred."""


def drawn(seed: int, count: int, *, thrust: float) -> qs.BearingSet:
    """Two such rows, 0.05 to 0.3 m apart, with clearances of 5 to 80 um, under loads of 3 N to 3 kN across the shaft.

    Args:
        thrust: along the shaft, either way, over the loads across it.
    """
    generator = np.random.default_rng(seed)
    first, second = generator.uniform(5.0, 80.0, (2, count)) * qs.um
    apart, size = generator.uniform(0.05, 0.3, count), 10.0 ** generator.uniform(0.5, 3.5, count)
    loads = size * generator.uniform(-1.0, 1.0, (5, count))
    loads[0] *= thrust
    loads[3:] *= 0.5 * apart
    rows = qs.Row(grooved_both_ways(first), 0.0), qs.Row(grooved_both_ways(second), apart)
    return qs.BearingSet(rows, qs.Operation(**dict(zip(CHANNELS, loads, strict=True))))


def case_of(of: qs.BearingSet, k: int) -> qs.BearingSet:
    """One case alone."""

    def alone(part: object, *names: str) -> dict[str, float]:
        return {name: float(np.ravel(getattr(part, name))[k]) for name in names if np.ndim(getattr(part, name))}

    rows = tuple(
        replace(
            row,
            bearing=replace(row.bearing, **alone(row.bearing, "free_contact_angle", "radial_interference")),
            **alone(row, "position"),
        )
        for row in of.rows
    )
    return replace(of, rows=rows, operation=replace(of.operation, **alone(of.operation, *CHANNELS)))


def assert_in_equilibrium(of: qs.BearingSet, found: qs.SetSolution) -> None:
    """Every case: springs between groove centres, summed up as vectors, need at its displacement what acts."""
    size = np.array([1.0, 1.0, 1.0, 0.035, 0.035])
    for k in range(found.shape[0]):
        one = case_of(of, k)
        load = np.array([float(getattr(one.operation, name)) for name in CHANNELS]) / size  # type: ignore[arg-type]
        needed = load_of_springs(one, [0.0, 0.0], found.displacement[k]) / size
        largest = max(np.abs(load).max(), np.abs(found.row_loads[k] / size).max())
        np.testing.assert_allclose(needed, load, atol=1e-8 * largest)


@pytest.mark.parametrize(("thrust", "most"), [(0.0, FEW), (0.3, MORE)])
def test_rows_with_clearance_reach_their_equilibrium(thrust: float, most: int) -> None:
    """Each has one, in few iterations, whichever way the thrust acts; and it is one."""
    of = drawn(2, 24, thrust=thrust)
    found = solved(of)
    assert found.iterations.max() < most
    assert_in_equilibrium(of, found)


def test_rows_with_clearance_are_solved_by_way_of_their_own_solve(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the compiled method finds nothing: the same equilibrium."""
    of = drawn(2, 12, thrust=0.0)
    direct = solved(of)
    monkeypatch.setattr("qsbearing.systems.sets.problem.solve_directly", lambda *given: None)
    found = solved(of)
    np.testing.assert_allclose(found.row_loads, direct.row_loads, atol=1e-6 * np.abs(direct.row_loads).max())
    assert_in_equilibrium(of, found)


def test_rows_of_every_kind_across_a_gap() -> None:
    """A located pair with end play beside a row that floats: one sleeve more whose gap is to be closed."""
    deep = grooved_both_ways(np.array(40 * qs.um))
    located = qs.Row(S6210E, 0.0, "+x", offset=-5e-6), qs.Row(S6210E, 0.02, "-x", offset=-5e-6)
    of = qs.BearingSet(
        (*located, qs.Row(deep, 0.3)),
        qs.Operation(radial_load_y=np.array([20.0, 300.0, -900.0]), moment_z=np.array([0.0, 5.0, -80.0])),
        floating=(qs.FloatingGroup((3,)),),
    )
    found = solved(of)
    assert found.iterations.max() < FEW
    np.testing.assert_allclose(found.row_loads.sum(axis=1)[:, 1], of.operation.radial_load_y, rtol=1e-9)
    np.testing.assert_allclose(found.axial_loads[:, 2], 0.0, atol=1e-6)
