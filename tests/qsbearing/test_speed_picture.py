"""The picture of a speed sweep shows the solution, and only what is loaded."""

from __future__ import annotations

import dataclasses
from io import BytesIO

import numpy as np
import pytest

import qsbearing as qs

pytest.importorskip("matplotlib")

from qsbearing.pictures.speed import against_speed

SPEEDS = np.linspace(0.0, 12_000.0, 13) * qs.rpm
SCENE = qs.load_scene("b218")


def sweep(**operation: object) -> qs.Solution:
    return qs.solve(dataclasses.replace(SCENE, operation=qs.Operation(speed=SPEEDS, **operation)))


def test_curves_are_the_solution_in_the_units_of_the_axes() -> None:
    loads = np.array([[2e3], [8e3]])
    solution = sweep(axial_load=loads)
    angles, contact_loads = against_speed(solution, ["2 kN", "8 kN"]).axes
    expected = [contacts.angle[..., 0] / qs.deg for contacts in (solution.inner, solution.outer)]
    for axes, values in (
        (angles, expected),
        (contact_loads, [solution.inner.load[..., 0], solution.outer.load[..., 0]]),
    ):
        drawn = [line for line in axes.lines if line.get_xdata().size]
        np.testing.assert_array_equal([line.get_ydata() for line in drawn], np.concatenate(values))
        np.testing.assert_allclose([line.get_xdata() for line in drawn], np.tile(SPEEDS / qs.rpm, (4, 1)))
        assert axes.get_xlabel() == "speed of the inner ring, rpm"
        assert sorted(text.get_text() for text in axes.texts) == ["2 kN", "2 kN", "8 kN", "8 kN"]
    assert angles.get_ylabel() == "contact angle, deg"
    assert contact_loads.get_ylabel() == "contact load, N"


def test_an_unloaded_contact_has_no_angle() -> None:
    solution = sweep(axial_load=500.0, radial_load_y=4000.0, tilt_z=0.0)
    unloaded = int(np.argmax((solution.inner.load == 0.0).any(axis=0)))
    lost = solution.inner.load[:, unloaded] == 0.0
    assert lost.any()
    figure = against_speed(solution, ball=unloaded)
    (inner, *_) = [line for line in figure.axes[0].lines if line.get_xdata().size]
    np.testing.assert_array_equal(np.isnan(inner.get_ydata()), lost)
    figure.savefig(BytesIO(), dpi=40)


@pytest.mark.parametrize(
    ("operation", "labels"),
    [
        (qs.Operation(speed=SPEEDS[1], axial_load=1e3), ()),
        (qs.Operation(speed=SPEEDS[1], axial_load=np.array([1e3, 2e3])), ()),
        (qs.Operation(speed=SPEEDS, axial_load=1e3), ("one", "two")),
    ],
    ids=["one case", "one speed", "a label too many"],
)
def test_what_is_no_speed_sweep_is_refused(operation: qs.Operation, labels: tuple[str, ...]) -> None:
    solution = qs.solve(dataclasses.replace(SCENE, operation=operation))
    with pytest.raises(ValueError, match="labels for" if labels else "needs speeds"):
        against_speed(solution, labels)
