"""Sets of rows recomputed from what their solutions say, and that the recomputation turns red."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.systems.sets.arrangements import pair
from tests.verification.campaign import spindles
from tests.verification.campaign.checks import MOST_IMBALANCE
from tests.verification.campaign.group import GROUP
from tests.verification.campaign.sets import draw_sets, wrong_of

compiled_only = pytest.mark.skipif(not has_fast_code(), reason="hundreds of sets take hours in plain Python")


def wrong_sets(seed: int, calls: int) -> list[str]:
    """Of so many calls of 25 sets each, in words: call, set and promise."""
    found = []
    for call in range(calls):
        with np.errstate(all="ignore"):
            wrong = wrong_of(qs.solve_set(draw_sets(np.random.default_rng([seed, call]))))
        found += [f"{call}/{k}: {name}" for name, bad in wrong.items() for k in np.flatnonzero(bad)]
    return found


@compiled_only
def test_random_sets_are_what_their_rows_say() -> None:
    assert wrong_sets(seed=2, calls=4) == []


def wrong_spindles(seed: int, calls: range) -> list[str]:
    """The same of sets on elastic shafts."""
    found = []
    for call in calls:
        with np.errstate(all="ignore"):
            wrong = spindles.wrong_of(qs.solve_set(spindles.draw_spindles(np.random.default_rng([seed, call]))))
        found += [f"{call}/{k}: {name}" for name, bad in wrong.items() for k in np.flatnonzero(bad)]
    return found


@compiled_only
def test_a_random_spindle_is_what_its_parts_say() -> None:
    """Two rows with a spacer on a warm shaft with a support."""
    assert wrong_spindles(7, range(1)) == []


@compiled_only
def test_balls_of_a_set_are_balanced_by_the_forces_of_the_set() -> None:
    """Case 17 has a row with 0.2 % of the load: 6e-12 N are left, 1e-9 of its balls' loads, 1e-12 of the set's. A row
    that alone carries the set has no such excuse."""
    with np.errstate(all="ignore"):
        solution = qs.solve_set(draw_sets(np.random.default_rng([1, 177]), 100))
        assert solution.converged[17] and not any(bad[17] for bad in wrong_of(solution).values())
        solution.rows[0].outer.load[17, 3] += 1e-9 * solution.rows[0].load[17, 0]
        assert wrong_of(solution)["imbalance"][17]


@compiled_only
def test_hot_tandem_sets_without_load_are_solved() -> None:
    """Rows that touch here and there: what rounding of positions presses, 1e-31 N, is no load that could be unequal."""
    of = draw_sets(np.random.default_rng([7, 2]))
    assert {row.sign for row in of.rows} == {1.0}
    assert of.ring_effects
    solution = qs.solve_set(replace(of, operation=qs.Operation(np.zeros(GROUP))))
    assert solution.converged.all()
    assert (solution.residual <= MOST_IMBALANCE).all()
    for row in solution.rows:
        assert np.nanmax(np.abs(row.inner.load)) < 1e-15


@pytest.mark.parametrize(
    ("quantity", "channel", "promise"),
    [("load", 1, "shaft in equilibrium"), ("load", 4, "shaft in equilibrium"), ("displacement", 2, "shaft rigid")],
)
def test_a_set_that_is_wrong_is_found(quantity: str, channel: int, promise: str) -> None:
    """One number of one row, changed by a millionth."""
    loads = {"axial_load": 100.0, "radial_load_y": 80.0, "radial_load_z": -30.0, "moment_y": 1.0, "moment_z": 0.5}
    of = pair("DB", 300.0, speed=1000.0, **loads)
    solution = qs.solve_set(replace(of, operation=replace(of.operation, speed=np.array([1000.0]))))
    assert not any(bad[0] for bad in wrong_of(solution).values())
    getattr(solution.rows[1], quantity)[0, channel] *= 1.0 + 1e-6
    assert wrong_of(solution)[promise] == [True]
