"""What is said of a case of a batch is what is said of the point by itself, with the same numbers."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.file_keys import IN_FILE
from qsbearing.results.remarks import every_remark
from tests.qsbearing.scenes import B218, BOTH, INNER, UPRIGHT, turning
from tests.systems.sets.arrangements import rows

RINGS = (qs.RingExpansion(90 * qs.mm, 160 * qs.mm, shaft_interference=20 * qs.um, yield_strength=600e6),)
READINGS = {
    "life": {"viscosity_ratio": 2.0, "contamination_factor": 0.5},
    "static_safety": {},
    "overrun": {"outer_shoulder_diameter": 141e-3},
    "friction": {"friction_coefficient": 0.02},
    "ball_advance": {"pocket_clearance": 1e-5},
}


def scene(rpm: Any, load: Any, **others: Any) -> qs.Scene:
    return qs.Scene(B218, qs.Operation(speed=rpm * qs.rpm, **load), **others)


def by_friction(rpm: Any, load: Any) -> qs.Scene:
    return replace(turning(rpm, axial_load=load), raceway_control="friction", traction=qs.Traction(cage_drag=14.0))


def of_set(rpm: Any, load: Any) -> qs.BearingSet:
    operation = qs.Operation(speed=rpm * qs.rpm, axial_load=load, radial_load_y=200.0, moment_z=0.0)
    balls: dict[str, Any] = {"ball_effects": BOTH, "raceway_control": "outer"}
    return qs.BearingSet(rows("DB", B218), operation, preload=qs.Preload(rigid=720.0), **balls)


BATCHES: dict[str, tuple[Callable[[Any, Any], Any], list[float], list[float]]] = {
    "bare": (lambda rpm, load: scene(rpm, {"axial_load": load}), [0.0, 3000.0, 9000.0], [2e3, 10e3]),
    "inner control": (
        lambda rpm, load: turning(rpm, effects=(qs.GyroscopicMoment(),), control=INNER, axial_load=load),
        [500.0, 3000.0, 6000.0], [200.0, 3e3],
    ),
    "radial": (lambda rpm, load: turning(rpm, axial_load=load, radial_load_y=4e3, **UPRIGHT), [3e3, 9e3], [2e3, 1e4]),
    "rings": (lambda rpm, load: scene(rpm, {"axial_load": load}, ring_effects=RINGS), [0.0, 3e3, 6e4], [5e3, 6e5]),
    "friction": (by_friction, [1e3, 6e3], [2e3, 1e4]),
    "readings": (
        lambda rpm, load: scene(
            rpm, {"axial_load": load, "radial_load_y": 0.3 * load, **UPRIGHT}, ball_effects=BOTH,
            raceway_control="outer", readings=READINGS,
        ),
        [300.0, 6000.0], [2e3, 15e3, 60e3],
    ),
    "set": (of_set, [0.0, 6000.0], [300.0, 3e3, 30e3]),
}  # fmt: skip


def said(solution: Any, index: tuple[int, ...] | None = None) -> dict[Any, Any]:
    """The numbers of each remark by its code and whom it is about, as JSON has them."""
    records = [json.loads(json.dumps(each.record(IN_FILE))) for each in every_remark(solution, index=index)]
    return {(each["code"], repr(each["of"]), each["values"].get("effect")): each["values"] for each in records}


def same(one: Any, other: Any) -> bool:
    """Equal but for what both solvers leave of a residual, of numbers that follow from differences."""
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list):
        return len(one) == len(other) and all(map(same, one, other))
    return bool(one == (pytest.approx(other, rel=1e-6, abs=1e-9) if isinstance(one, float) else other))


@pytest.mark.parametrize("name", BATCHES)
def test_each_case_of_a_batch_has_the_remarks_of_its_point_alone(name: str) -> None:
    make, speeds, loads = BATCHES[name]
    solve: Any = qs.solve_set if name == "set" else qs.solve
    rpm, load = np.meshgrid(speeds, loads, indexing="ij")
    batch = solve(make(rpm, load))
    codes = set()
    for place in np.ndindex(batch.shape):
        of_case, alone = said(batch, place), said(solve(make(float(rpm[place]), float(load[place]))))
        assert of_case.keys() == alone.keys(), place
        assert [key for key in alone if not same(of_case[key], alone[key])] == [], place
        codes |= {code for code, *_ in alone}
    assert len(codes) > 1, "or there is little to compare"


def test_of_a_batch_numbers_are_those_of_the_case_that_is_named() -> None:
    make, speeds, loads = BATCHES["readings"]
    rpm, load = np.meshgrid(speeds, loads, indexing="ij")
    solution = qs.solve(make(rpm, load))
    counted = 0
    for each in every_remark(solution):
        if each.of.cases is not None and each.of.cases.count > 1:
            whose = each.kind, replace(each.of, cases=None), each.values.get("effect")
            of_first = every_remark(solution, index=each.of.cases.first)
            (own,) = (one for one in of_first if (one.kind, one.of, one.values.get("effect")) == whose)
            assert own.values == each.values
            counted += 1
    assert counted > 2
