"""Ellipses on their grooves: the distance from the edge is that of the reading; who states the shoulder is said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing import pictures
from qsbearing.pictures.ellipse_on_groove import edges_told, on_grooves
from qsbearing.readings import overrun

SHOULDERS = {"inner_shoulder_diameter": 0.1135, "outer_shoulder_diameter": 0.1365, "inner_open_diameter": 0.1042}


def b218(load: float, speed: float = 0.0, **asked: float) -> qs.Solution:
    scene = qs.load_scene("b218")
    operation = qs.Operation(speed, axial_load=load, radial_load_y=0.3 * load, tilt_y=0.0, tilt_z=0.0)
    return qs.solve(replace(scene, operation=operation, readings={"overrun": asked} if asked else {}))


@pytest.mark.parametrize("load", [5e3, 9e4])
def test_the_distance_is_that_of_the_reading(load: float) -> None:
    check_distances(b218(load, **SHOULDERS), SHOULDERS)


def test_an_unstated_shoulder_is_as_high_as_the_other() -> None:
    """At a speed that presses the balls outwards, so that the outer ellipse is nearer to the one that is not stated."""
    stated = {name: diameter for name, diameter in SHOULDERS.items() if "shoulder" in name}
    solution = b218(5e3, 15e3 * qs.rpm, **stated)
    outer = on_grooves(solution, ())["outer"]
    assert outer is not None and outer.edges.low == -outer.edges.high
    check_distances(solution, stated)


def check_distances(solution: qs.Solution, shoulders: dict[str, float]) -> None:
    found, read = on_grooves(solution, ()), overrun(solution, **shoulders)
    for side, raceway in (("inner", read.inner), ("outer", read.outer)):
        own = found[side]
        assert own is not None and raceway is not None
        assert own.distance == pytest.approx(float(raceway.edge_distance[own.ball]), rel=1e-9)
        assert own.ball == int(np.argmax(getattr(solution, side).load))


def test_an_ellipse_beyond_its_edge_is_said_to_be() -> None:
    solution = b218(9e4, **SHOULDERS | {"inner_shoulder_diameter": 0.1105})
    inner = on_grooves(solution, ())["inner"]
    assert inner is not None and inner.distance < 0.0
    share = overrun(solution, **SHOULDERS | {"inner_shoulder_diameter": 0.1105}).inner
    assert share is not None
    texts = [each.get_text() for each in pictures.ellipse_on_groove(solution).axes[0].texts]
    assert any(f"{100.0 * float(share.share_beyond[inner.ball]):.2g} % is beyond the edge" in each for each in texts)


def test_whose_shoulders_these_are_is_said() -> None:
    stated = edges_told(on_grooves(b218(5e3, **SHOULDERS), ()).items())
    assert stated == "shoulders by [readings.overrun]"
    plain = qs.load_scene("b218")
    bare = replace(plain.bearing, name="", outline=None)
    assumed = qs.solve(replace(plain, bearing=bare, operation=qs.Operation(axial_load=5e3)))
    found = on_grooves(assumed, ())
    assert edges_told(found.items()) == "shoulders assumed, of usual proportions"
    inner = found["inner"]
    assert inner is not None and inner.edges.high >= float(np.asarray(bare.free_contact_angle)) + np.radians(29.9)
    texts = " ".join(each.get_text() for each in pictures.ellipse_on_groove(assumed).axes[0].texts)
    assert "≈ " in texts


def test_a_raceway_without_load_says_so() -> None:
    scene = qs.load_scene("b218")
    still = replace(scene, operation=qs.Operation(axial_displacement=-1e-4), ball_effects=(), raceway_control=None)
    texts = [each.get_text() for each in pictures.ellipse_on_groove(qs.solve(still)).axes[0].texts]
    assert texts == ["inner raceway: no load", "outer raceway: no load"]
