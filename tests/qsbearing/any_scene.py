"""Random scenes out to the ends of every allowed range, and a limit of time for each."""

from __future__ import annotations

import contextlib
import faulthandler
import functools
import math
import time
from collections.abc import Iterator
from typing import Any

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.model.operation import CHANNELS

LIMIT = 10.0 if has_fast_code() else 120.0
"""Seconds of the processor for one example: a solve takes a thousandth of one, the slowest refusals some tenths."""

HANGING = 300.0
"""Seconds after which an example that has not come back ends everything: compiled code cannot be interrupted."""

few = settings(max_examples=20 if has_fast_code() else 3, suppress_health_check=[HealthCheck.too_slow])
many = settings(parent=few, max_examples=1000 if has_fast_code() else 10)


@functools.cache
def compile_kernel() -> None:
    """Solve once, and once where there is no equilibrium: compilation is no part of an example's time."""
    scene = qs.load_scene("b218")
    qs.stiffness(scene, qs.solve(scene))
    qs.solve(qs.Scene(scene.bearing, qs.Operation(axial_load=-1e3)))


@contextlib.contextmanager
def bounded() -> Iterator[None]:
    """No hang: an example has its time."""
    compile_kernel()
    faulthandler.dump_traceback_later(HANGING, exit=True)
    began = time.process_time()
    try:
        yield
    finally:
        faulthandler.cancel_dump_traceback_later()
    assert time.process_time() - began < LIMIT


def spread(low: float, high: float) -> st.SearchStrategy[float]:
    """Positive numbers over many decades, the ends included."""
    inner = st.floats(math.log10(low), math.log10(high)).map(lambda power: min(max(10.0**power, low), high))
    return st.one_of(inner, st.sampled_from([low, high]))


def signed(most: float, least: float = 1e-12) -> st.SearchStrategy[float]:
    """Of either sign, zero included."""
    return st.one_of(
        st.just(0.0), st.just(-0.0), st.builds(math.copysign, spread(least, most), st.sampled_from([1.0, -1.0]))
    )


@st.composite
def bearings(draw: Any) -> dict[str, Any]:
    """Fields of a bearing that the door lets in, to its very ends."""
    diameter = draw(spread(6e-5, 0.9))
    count = (
        draw(st.one_of(st.integers(1, 40), st.sampled_from([1, 2, 1000])))
        if has_fast_code()
        else draw(st.integers(1, 4))
    )
    least = diameter / math.sin(math.pi / count) if count > 1 else diameter
    material = st.builds(qs.Material, spread(1e9, 2e12), st.floats(0.0, 0.499), spread(100.0, 25000.0))
    return {
        "ball_count": count,
        "ball_diameter": diameter,
        "pitch_diameter": min(least * draw(spread(1.0 + 1e-9, 100.0)), 20.0),
        "inner_groove_radius": diameter
        * draw(st.one_of(st.floats(0.5, 1.0), spread(1e-15, 0.5).map(lambda f: 0.5 + f))),
        "outer_groove_radius": diameter
        * draw(st.one_of(st.floats(0.5, 1.0), spread(1e-15, 0.5).map(lambda f: 0.5 + f))),
        "free_contact_angle": draw(st.one_of(st.floats(0.0, 85.0 * qs.deg), st.sampled_from([0.0, 1e-300, 1e-9]))),
        "ball_material": draw(material),
        "ring_material": draw(material),
        "kind": draw(st.sampled_from([qs.BearingKind.ANGULAR_CONTACT, qs.BearingKind.DEEP_GROOVE])),
    }


@st.composite
def operations(draw: Any) -> dict[str, Any]:
    """Fields of an operation that the door lets in."""
    fields: dict[str, Any] = {
        "speed": draw(signed(1e5)),
        "outer_speed": draw(st.one_of(st.none(), signed(1e5))),
        "first_ball_azimuth": draw(st.floats(-6.28, 6.28)),
    }
    for channel in CHANNELS:
        if draw(st.booleans()):
            fields[channel.load] = draw(signed(1e8))
        else:
            fields[channel.displacement] = draw(signed(0.2 if channel.is_rotation else 0.1))
    return fields


CHOICES = st.fixed_dictionaries(
    {
        "raceway_control": st.one_of(st.none(), st.sampled_from(list(qs.RacewayControl))),
        "hertz_angle": st.sampled_from(list(qs.HertzAngle)),
        "hertz_form": st.sampled_from(list(qs.HertzForm)),
        "tilt_lever": st.sampled_from(list(qs.TiltLever)),
        "ball_effects": st.sets(
            st.sampled_from([qs.CentrifugalForce(), qs.GyroscopicMoment(), qs.GyroscopicMoment("harris")]), max_size=2
        ).map(tuple),
    }
)
