"""Balls that friction moves, recomputed from what their solutions say, and that the recomputation turns red."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.friction_motion import FrictionMotion, friction_motion
from tests.qsbearing.scenes import B218, UPRIGHT
from tests.verification.campaign.certificates import NOT_PROVED
from tests.verification.campaign.friction import BALANCE, UNEXPLAINED, Recomputed, batch, draw, ends, holds, solved
from tests.verification.campaign.friction_certificates import as_if_found, certificates, outside

compiled_only = pytest.mark.skipif(not has_fast_code(), reason="hundreds of bearings take hours in plain Python")


@compiled_only
def test_random_bearings_are_what_their_balls_say() -> None:
    with np.errstate(all="ignore"):
        found = batch(np.random.default_rng([1, 0]), 60, 12)
    assert found.wrong == {}
    assert found.not_converged == []
    assert found.ended["converged"] >= 68


@compiled_only
def test_an_equilibrium_may_follow_one_over_the_shoulder() -> None:
    """Under outer control this bearing has a ball beyond the shoulder; friction holds its axis less, and it has not."""
    scene, traction = draw(np.random.default_rng([1, 23]), True, 40)
    with np.errstate(all="ignore"):
        found = friction_motion(scene, traction)
        assert list(np.flatnonzero(found.start.status == "no_equilibrium")) == [20]
        assert found.start.reason[20] == "over_shoulder"
        assert solved(scene, traction).wrong == {}
    assert found.status[20] == "converged"


@compiled_only
def test_a_refusal_has_an_equilibrium_over_the_shoulder() -> None:
    """It is evidence only where all of it agrees, and only of a contact that lies outside its groove."""
    scene, traction = draw(np.random.default_rng([1, 22]), False, 200)
    with np.errstate(all="ignore"):
        found = friction_motion(scene, traction)
        assert list(np.flatnonzero(found.status == "no_equilibrium")) == [42]
        passed = as_if_found(scene, traction, found)
        assert certificates(scene, traction, found, lambda of: holds(scene, traction, of)) == [
            "over the shoulder, an equilibrium"
        ]
        assert holds(scene, traction, passed)[42]
        spoilt = replace(passed.inner, load=1.001 * passed.inner.load)
        assert not holds(scene, traction, replace(passed, inner=spoilt))[42]
        assert certificates(scene, traction, found, lambda of: np.zeros(of.status.shape, bool)) == [NOT_PROVED]
    where = outside(passed)
    assert [k for k, place in enumerate(where) if place] == [42]
    below = replace(passed.inner, angle=np.full_like(passed.inner.angle, -0.1))
    assert outside(replace(passed, inner=below))[42] == "open side"
    assert not any(outside(replace(passed, inner=replace(below, load=0.0 * below.load))))


@compiled_only
def test_a_ball_off_the_inner_ring_explains_nothing() -> None:
    """Without drag such bearings have a balance: one that is not found counts against the limit."""
    scene, traction = draw(np.random.default_rng([1, 0]), True, 12)
    assert traction.cage_drag == 0.0 and traction.drag_coefficient is None
    with np.errstate(all="ignore"):
        found = friction_motion(scene, traction)
        has_lost = (found.start.inner.load == 0.0).any(axis=1)
        assert has_lost.sum() == 4 and (found.status[has_lost] == "converged").all()
        lost = replace(found, status=np.full(12, "not_converged"))
        assert set(ends(scene, traction, lost)) == {UNEXPLAINED}
        assert set(ends(scene, replace(traction, cage_drag=1e5), lost)) == {f"{UNEXPLAINED}: skids"}


def two_bearings() -> tuple[qs.Scene, Traction, FrictionMotion]:
    """B218 under combined load, at two speeds, with drag."""
    speed = np.array([10_000.0, -6_000.0]) * qs.rpm
    operation = qs.Operation(speed=speed, axial_load=17.8e3, radial_load_y=3e3, **UPRIGHT)
    scene, traction = qs.Scene(B218, operation), Traction(cage_drag=3.0)
    return scene, traction, friction_motion(scene, traction)


def test_rest_has_no_drag() -> None:
    """A cage does not push balls that stand."""
    scene = qs.Scene(B218, qs.Operation(speed=np.array([0.0, 10_000.0]) * qs.rpm, axial_load=17.8e3))
    found = friction_motion(scene, Traction(cage_drag=3.0))
    assert (found.status == "converged").all()
    assert found.displacement[0, 0] == pytest.approx(qs.solve(scene).displacement[0, 0], rel=1e-10)
    assert found.drag[0, 0] == 0.0 or np.isnan(found.drag[0, 0])
    assert found.drag[1, 0] == pytest.approx(3.0)


def of_side(name: str, part: float) -> Callable[[FrictionMotion], FrictionMotion]:
    """One quantity of an inner contact, changed."""

    def change(found: FrictionMotion) -> FrictionMotion:
        values = getattr(found.inner, name).copy()
        values[1, 3] *= 1.0 + part
        return replace(found, inner=replace(found.inner, **{name: values}))

    return change


def of_balls(name: str, place: Any, part: float) -> Callable[[FrictionMotion], FrictionMotion]:
    """One quantity of a ball."""

    def change(found: FrictionMotion) -> FrictionMotion:
        values = getattr(found, name).copy()
        values[(1, 3, *place)] *= 1.0 + part
        return replace(found, **{name: values})

    return change


CHANGED = {
    "load": (of_side("load", 1e-8), "force on a ball"),
    "angle": (of_side("angle", 1e-8), "force on a ball"),
    "axis": (of_balls("angular_velocity", (2,), 1e-7), "moment on a ball"),
    "yaw": (of_balls("angular_velocity", (1,), 1e-6), "moment on a ball"),
    "orbit": (of_balls("orbital_speed", (), 1e-8), "force on a ball"),
    "weight": (of_balls("weight", (), 1e-8), "weights"),
}


@pytest.mark.parametrize("name", CHANGED)
def test_a_wrong_number_is_found(name: str) -> None:
    change, error = CHANGED[name]
    scene, traction, found = two_bearings()
    right, wrong = (Recomputed(scene, traction, each).errors() for each in (found, change(found)))
    assert max(each.max() for each in right.values()) < 0.01 * BALANCE
    assert wrong[error][0] == right[error][0]
    assert wrong[error][1] > BALANCE


@pytest.mark.parametrize(
    ("law", "errors"),
    [
        (Traction(0.0700001, cage_drag=3.0), {"moment on a ball", "force on a ball"}),
        (Traction(slip_speed=0.1001, cage_drag=3.0), {"moment on a ball", "force on a ball"}),
        (Traction(has_curvature=False, cage_drag=3.0), {"moment on a ball", "force on a ball"}),
        (Traction(cage_drag=3.001), {"force on a ball", "outer against inner ring"}),
    ],
)
def test_another_law_is_found(law: Traction, errors: set[str]) -> None:
    scene, _, found = two_bearings()
    wrong = Recomputed(scene, law, found).errors()
    assert errors <= {name for name, each in wrong.items() if (each > BALANCE).all()}
