"""Four-point bearings recomputed from what their solutions say, and that the recomputation turns red."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.friction_balance import FrictionMotion
from qsbearing.model.solution.friction_motion import friction_motion
from tests.qsbearing.scenes import UPRIGHT, rubbing
from tests.verification.campaign.arched import RecomputedArches, batch, contacts, draw, solved
from tests.verification.campaign.friction import BALANCE

compiled_only = pytest.mark.skipif(not has_fast_code(), reason="hundreds of bearings take hours in plain Python")


@compiled_only
def test_random_four_point_bearings_are_what_their_balls_say() -> None:
    """A hundred, among them balls with two and with three contacts."""
    with np.errstate(all="ignore"):
        found = batch(np.random.default_rng([1, 0]), 100, 4)
        count = contacts(friction_motion(*draw(np.random.default_rng([1, 0]), False, 100)))
    assert found.wrong == {}
    assert found.not_converged == []
    assert found.ended["converged"] >= 103
    assert set(count) >= {2, 3} and count[3] > 20


def one_of_each() -> tuple[qs.Scene, Traction, FrictionMotion]:
    """Under thrust and combined load, with drag."""
    law = Traction(cage_drag=3.0)
    speed = np.array([10_000.0, -6_000.0])
    scene = rubbing(speed, traction=law, axial_load=5e3, radial_load_y=np.array([1.0, 3e3]), **UPRIGHT)
    return scene, law, friction_motion(scene, law)


def of_opposite(name: str, part: float) -> Callable[[FrictionMotion], FrictionMotion]:
    """One quantity of an outer contact of the opposite arc, changed."""

    def change(found: FrictionMotion) -> FrictionMotion:
        assert found.opposite is not None and found.opposite.outer is not None
        values = getattr(found.opposite.outer, name).copy()
        values[0, 3] *= 1.0 + part
        return replace(found, opposite=found.opposite._replace(outer=replace(found.opposite.outer, **{name: values})))

    return change


def of_balls(found: FrictionMotion) -> FrictionMotion:
    values = found.angular_velocity.copy()
    values[0, 3, 0] *= 1.0 + 1e-6
    return replace(found, angular_velocity=values)


def without_opposite(found: FrictionMotion) -> FrictionMotion:
    assert found.opposite is not None
    return replace(found, opposite=found.opposite._replace(outer=None))


@pytest.mark.parametrize(
    ("change", "error"),
    [
        (of_opposite("load", 1e-7), "force on a ball"),
        (of_opposite("angle", 1e-7), "force on a ball"),
        (of_balls, "moment on a ball"),
        (without_opposite, "force on a ball"),
    ],
)
def test_a_wrong_number_is_found(change: Any, error: str) -> None:
    scene, traction, found = one_of_each()
    right, wrong = (RecomputedArches(scene, traction, each).errors() for each in (found, change(found)))
    assert max(each.max() for each in right.values()) < 0.1 * BALANCE
    assert wrong[error][0] > BALANCE


def test_another_shim_is_found() -> None:
    """The contact lines of the opposite arcs then do not reach from one groove centre to the other."""
    scene, traction, found = one_of_each()
    assert RecomputedArches(scene, traction, found).closure().max() < 1e-13
    shim = float(np.asarray(scene.bearing.inner_shim))
    other = replace(scene, bearing=replace(scene.bearing, inner_shim=1.000001 * shim))
    assert RecomputedArches(other, traction, found).closure().min() > 1e-8
    assert solved(scene, traction).wrong == {}
