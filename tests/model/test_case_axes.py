"""Array fields that do not broadcast: the error names those that clash, and no others."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from tests.qsbearing.scenes import B218, OUTER

STEELS = replace(qs.STEEL, elastic_modulus=np.full(2, 208e9))
SLIP = qs.GyroscopicMoment(friction_coefficient=np.full(2, 0.1))
THREE = qs.Operation(speed=np.zeros(3), axial_load=np.full(3, 1e3))


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (
            lambda: qs.Scene(B218, qs.Operation(speed=np.zeros(3), axial_load=np.ones(4), radial_load_y=0.0)),
            "operation.speed (3,), operation.axial_load (4,)",
        ),
        (
            lambda: replace(B218, pitch_diameter=np.full(3, 0.12), ball_diameter=np.full(4, 0.022)),
            "bearing.ball_diameter (4,), bearing.pitch_diameter (3,)",
        ),
        (
            lambda: qs.Scene(replace(B218, ring_material=STEELS), qs.Operation(speed=np.zeros(3))),
            "bearing.ring_material.elastic_modulus (2,), operation.speed (3,)",
        ),
        (
            lambda: qs.Scene(B218, THREE, (SLIP,), OUTER),
            "operation.speed (3,), gyroscopic_moment.friction_coefficient (2,), operation.axial_load (3,)",
        ),
        (
            lambda: qs.Scene(B218, qs.Operation(speed=np.zeros(3)), preload=qs.Preload(spring=np.ones(2))),
            "operation.speed (3,), preload.spring (2,)",
        ),
    ],
    ids=["operation", "bearing", "material", "friction", "preload"],
)
def test_the_fields_that_clash_are_named(make: Callable[[], Any], named: str) -> None:
    with pytest.raises(qs.SceneError) as raised:
        make()
    (error,) = raised.value.errors
    assert error.problem == f"arrays do not broadcast to common case axes: {named}"
    assert error.field == named.partition(" ")[0]
    assert error.cause.endswith(f"{error.field.rpartition('.')[2]}[:, None]")


def test_the_remedy_that_is_named_works() -> None:
    operation = qs.Operation(speed=np.zeros(3)[:, None], axial_load=np.ones(4))
    assert qs.solve(qs.Scene(B218, operation)).shape == (3, 4)
