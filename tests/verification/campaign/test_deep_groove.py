"""Random deep-groove sets recomputed, and that the recomputation turns red."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.systems.sets import one_way, problem, rigid_shaft
from tests.systems.sets.test_two_sided import stand
from tests.verification.campaign.deep_groove import BATCH, draw_sets, wrong_of

compiled_only = pytest.mark.skipif(not has_fast_code(), reason="hundreds of sets take hours in plain Python")


def wrong_sets(seed: int, calls: range) -> list[str]:
    """In words: call, set and promise."""
    found = []
    for call in calls:
        with np.errstate(all="ignore"):
            wrong = wrong_of(qs.solve_set(draw_sets(np.random.default_rng([seed, call]), BATCH)))
        found += [f"{call}/{k}: {name}" for name, bad in wrong.items() for k in np.flatnonzero(bad)]
    return found


@compiled_only
def test_random_sets_are_what_their_rows_say() -> None:
    """Among them sets both of whose rings pull while one has to carry the thrust (5), and unloaded ones (0 to 20)."""
    assert wrong_sets(1, range(20)) == []


def loaded(*ways: str, **operation: Any) -> qs.BearingSet:
    """One case along an axis."""
    of = {"axial_load": 300.0, "radial_load_y": 800.0, "radial_load_z": -200.0, "moment_y": 2.0, "moment_z": 1.0}
    cases = {name: np.array([value]) for name, value in ({"speed": 0.0} | of | operation).items()}
    return qs.BearingSet(stand(*ways, clearances=(10.0, 40.0, 25.0)), qs.Operation(**cases))


@pytest.mark.parametrize(
    ("quantity", "channel", "promise"),
    [
        ("load", 1, "shaft in equilibrium"),
        ("load", 4, "shaft in equilibrium"),
        ("displacement", 2, "shaft rigid"),
        ("displacement", 0, "grooves where the shaft has them"),
    ],
)
def test_a_set_that_is_wrong_is_found(quantity: str, channel: int, promise: str) -> None:
    """One number of one row, changed by a millionth."""
    solution = qs.solve_set(loaded("both", "both"))
    assert not any(bad[0] for bad in wrong_of(solution).values())
    getattr(solution.rows[1], quantity)[0, channel] *= 1.0 + 1e-6
    assert wrong_of(solution)[promise] == [True]


def lost_state(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rings stay where they are held."""
    monkeypatch.setattr(one_way, "_turn", lambda problem, part, which, rings: np.zeros(len(which), bool))


def lost_lever(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rows as if their inner grooves stood beside their places."""
    monkeypatch.setattr(rigid_shaft, "own_lever", lambda of, row: 1e-5)


def lost_heat(monkeypatch: pytest.MonkeyPatch) -> None:
    """Grooves where they were cold, of rings that have grown."""
    right = problem.offset_in_operation

    def moved(of: Any, number: int, offset: Any) -> Any:
        return right(of, number, np.asarray(offset) + 1e-9)

    monkeypatch.setattr(problem, "offset_in_operation", moved)


@compiled_only
@pytest.mark.parametrize(
    ("plant", "promise"),
    [
        (lost_state, "ring pulled"),
        (lost_lever, "shaft in equilibrium"),
        (lost_heat, "grooves where the shaft has them"),
    ],
)
def test_planted_errors_are_found(monkeypatch: pytest.MonkeyPatch, plant: Any, promise: str) -> None:
    plant(monkeypatch)
    assert any(each.endswith(promise) for each in wrong_sets(1, range(4)))


def test_a_wrong_play_and_a_place_beside_its_middle_are_found() -> None:
    nothing = dict.fromkeys(("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z"), 0.0)
    solution = qs.solve_set(loaded("both", "-x", "none", **nothing))
    assert not any(bad[0] for bad in wrong_of(solution).values())
    solution._outcome.play[0, 1] += 1e-9
    assert wrong_of(solution)["play"] == [True]
    other = qs.solve_set(replace(solution.set, rows=solution.set.rows))
    other.displacement[0, 0] += 1e-9
    assert wrong_of(other)["not amid its play"] == [True]


def test_a_thrust_that_is_not_solved_although_a_row_is_held_against_it_is_found() -> None:
    solution = qs.solve_set(loaded("both", "none"))
    solution.mark_unsolved(np.array([True]), 1)
    assert wrong_of(solution)["no equilibrium at rest"] == [True]
