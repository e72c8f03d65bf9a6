"""A set is proved to have no equilibrium where no forces of its balls can bear its loads, and nowhere else."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.systems.sets.arrangements import pair
from tests.verification.campaign import elastic_rings, spindles
from tests.verification.campaign.certificates import NOT_PROVED
from tests.verification.campaign.deep_groove import draw_sets as draw_deep_groove
from tests.verification.campaign.deep_groove import is_carried
from tests.verification.campaign.set_certificates import _has_friction, cone, forces, is_unsupported
from tests.verification.campaign.sets import draw_sets

compiled_only = pytest.mark.skipif(not has_fast_code(), reason="hundreds of sets take hours in plain Python")


def solved(draw: Any, seed: int, n: int = 6) -> qs.SetSolution:
    with np.errstate(all="ignore"):
        return qs.solve_set(draw(np.random.default_rng([1, seed]), n))


@compiled_only
@pytest.mark.parametrize("draw", [draw_sets, spindles.draw_spindles], ids=["sets", "spindles"])
def test_the_cone_is_what_balls_bear(draw: Any) -> None:
    """Its generators, each with the force that the solution has there, are the loads of every set that is solved: with
    offsets, springs, sleeves, spacers, supports and shafts that are warm."""
    seen = 0
    for seed in range(24):
        solution = solved(draw, seed)
        if any(_has_friction(row.scene) for row in solution.rows):
            continue
        for k in np.flatnonzero(solution.converged):
            pressing, wanted = cone(solution, int(k))
            found = forces(solution, int(k))
            if solution.set.shaft is not None and solution.set.shaft.supports:
                radial = solution.support_loads[k][:, 1:3].ravel()
                found = np.concatenate([found, radial, 0.0 * radial])
            assert np.abs(pressing @ found - wanted).max() <= 1e-9 * np.abs(found).max()
            assert not is_unsupported(solution, int(k))
            seen += 1
    assert seen > 20


def test_a_thrust_that_no_row_carries_is_proved() -> None:
    tandem = replace(pair(), rows=tuple(replace(row, carries="+x") for row in pair().rows), preload=None)
    load = np.array([-500.0, 500.0])
    of = replace(tandem, operation=qs.Operation(axial_load=load), ball_effects=(), raceway_control=None)
    solution = qs.solve_set(of)
    assert list(solution.status) == ["no_equilibrium", "converged"]
    assert is_unsupported(solution, 0)
    assert not is_unsupported(solution, 1)


def test_friction_on_a_ring_takes_the_proof_away() -> None:
    """Under inner control the gyroscopic moment's friction presses the ring, too."""
    rows = tuple(replace(row, carries="+x") for row in pair().rows)
    of = qs.BearingSet(
        rows, qs.Operation(speed=500.0, axial_load=np.array([-500.0, -500.0])),
        ball_effects=(qs.CentrifugalForce(), qs.GyroscopicMoment()), raceway_control="inner",
    )  # fmt: skip
    with np.errstate(all="ignore"):
        solution = qs.solve_set(of)
    assert not is_unsupported(solution, 0)
    outer = replace(of, raceway_control="outer")
    with np.errstate(all="ignore"):
        assert is_unsupported(qs.solve_set(outer), 0)


@compiled_only
def test_a_set_of_deep_groove_rows_is_refused_where_nothing_holds_it() -> None:
    for seed in range(20):
        solution = solved(draw_deep_groove, seed, 10)
        refused = (solution.status == "no_equilibrium") & (np.asarray(solution.set.operation.speed) == 0.0)
        assert not (refused & is_carried(solution.set, solution.shape)).any()


@compiled_only
def test_refusals_between_elastic_rings_have_an_equilibrium_that_is_not_admissible() -> None:
    """Recomputed where the solver left them, with the deflections of both rings."""
    with np.errstate(all="ignore"):
        batches = [elastic_rings.batch(np.random.default_rng([1, number]), 100) for number in range(6)]
    refused = sum(n for each in batches for how, n in each.ended.items() if how.startswith("no_equilibrium"))
    kinds = sum((each.refusals for each in batches), batches[0].refusals.__class__())
    assert refused == sum(kinds.values()) > 10
    assert kinds["over the shoulder, an equilibrium"] > 0 and kinds[NOT_PROVED] == 0


@compiled_only
def test_evidence_between_elastic_rings_needs_an_equilibrium(monkeypatch: pytest.MonkeyPatch) -> None:
    """With deflections a hundred-thousandth off it is none."""
    right = elastic_rings.deflections
    monkeypatch.setattr(elastic_rings, "deflections", lambda *given: right(*given) * (1.0 + 1e-5))
    with np.errstate(all="ignore"):
        batches = [elastic_rings.batch(np.random.default_rng([1, number]), 100) for number in range(6)]
    assert sum(each.refusals[NOT_PROVED] for each in batches) > 0
