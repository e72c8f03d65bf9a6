"""Ready pictures around an operating point: their numbers are those of single solves, what they need is said."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import qsbearing as qs

pytest.importorskip("matplotlib")
from qsbearing import pictures
from qsbearing.pictures.operating_maps import loaded

BEARING = qs.load_scene("7210C").bearing
BALLS = {
    "ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()),
    "raceway_control": qs.RacewayControl.OUTER,
}
TURNING = qs.Operation(speed=12_000 * qs.rpm, axial_load=800.0, radial_load_y=300.0, tilt_y=0.0, tilt_z=0.0)
THRUST = qs.Scene(BEARING, TURNING, **BALLS)  # type: ignore[arg-type]
WARM = qs.Scene(
    BEARING,
    qs.Operation(speed=12_000 * qs.rpm, tilt_y=0.0, tilt_z=0.0),
    preload=qs.Preload(rigid=600.0),
    ring_effects=(qs.RingExpansion(0.05, 0.09, inner_ring_temperature=30.0 + qs.zero_celsius),),
    **BALLS,  # type: ignore[arg-type]
)


def test_a_map_s_colours_are_the_stiffness_of_its_points() -> None:
    """At the operating point, and at half the speed under more load."""
    figure = pictures.stiffness_map(THRUST)
    for channel, axes in enumerate(figure.axes):
        filled = next(each for each in axes.collections if each.get_array() is not None and each.get_array().size > 2)
        levels = np.asarray(filled.levels)  # type: ignore[attr-defined]
        for speed, part in ((1.0, 1.0), (0.5, 1.5)):
            scene = loaded(THRUST, np.asarray(part))
            assert scene is not None
            operation = dataclasses.replace(scene.operation, speed=speed * 12_000 * qs.rpm)
            stiffness = qs.solve(dataclasses.replace(scene, operation=operation)).locked_stiffness[channel] * qs.um
            drawn = filled.get_paths()
            inside = [path.contains_point((speed * 12_000, part)) for path in drawn]
            assert inside.index(True) == np.searchsorted(levels, stiffness) - 1


def test_the_preload_over_temperature_is_that_of_single_solves() -> None:
    axes = pictures.preload_over_temperature(WARM).axes[0]
    curve = next(line for line in axes.get_lines() if len(line.get_xdata()) > 2)
    for celsius in (30.0, 50.0):
        rings = dataclasses.replace(WARM.ring_effects[0], inner_ring_temperature=celsius + qs.zero_celsius)
        solution = qs.solve(dataclasses.replace(WARM, ring_effects=(rings,)))
        assert solution.preload_loads is not None
        expected = float(solution.preload_loads.arrays[1])
        assert np.interp(celsius, *curve.get_data()) == pytest.approx(expected, rel=2e-3), "between points of the curve"
    assert any("3 times" in text.get_text() for text in axes.texts)


def test_what_they_need_is_said() -> None:
    still = dataclasses.replace(THRUST, operation=dataclasses.replace(TURNING, speed=0.0))
    with pytest.raises(ValueError, match="turns and is loaded"):
        pictures.stiffness_map(still)
    for lacking in (dataclasses.replace(WARM, ring_effects=()), dataclasses.replace(WARM, preload=None)):
        with pytest.raises(ValueError, match="needs a preload"):
            pictures.preload_over_temperature(lacking)
