"""The list of effects and choices: each can be put in and taken out, and its indicator follows what it should."""

from __future__ import annotations

import importlib
import pkgutil
from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model import effects
from qsbearing.model.effects import EFFECTS, Entry, OperatingPoint
from tests.qsbearing.scenes import resting, solved, turning

LOADS = {"axial_load": 12e3, "radial_load_y": 3e3, "moment_z": 0.0}
NAMES = [entry.name for entry in EFFECTS]
each = pytest.mark.parametrize("entry", EFFECTS, ids=NAMES)


def at_rest() -> qs.Scene:
    """A scene that says nothing of effects."""
    return resting(**LOADS)


def full() -> qs.Scene:
    """The same with everything that needs no parameters, at speed."""
    scene = at_rest()
    for entry in EFFECTS:
        scene = entry.finer(scene)
    return replace(scene, operation=qs.Operation(speed=9000 * qs.rpm, **LOADS))


def test_every_entry_of_the_folder_is_in_the_list() -> None:
    modules = [
        importlib.import_module(f"qsbearing.model.effects.{found.name}")
        for found in pkgutil.iter_modules(effects.__path__)
    ]
    entries = [value for module in modules for value in vars(module).values() if isinstance(value, Entry)]
    assert {id(entry) for entry in entries} == {id(entry) for entry in EFFECTS}
    assert len(set(NAMES)) == len(NAMES)


@each
def test_what_is_added_is_there_and_what_is_taken_out_is_not(entry: Entry) -> None:
    for scene in (at_rest(), full()):
        with_it, without = entry.finer(scene), entry.coarser(scene)
        assert not entry.can_be_added(with_it)
        assert not entry.is_in(without)
        assert entry.finer(with_it) is with_it
        assert entry.coarser(without) is without
        if entry.is_in(scene):
            assert with_it is scene
            assert entry.is_in(entry.finer(without))


@each
def test_what_needs_parameters_is_never_added_without_them(entry: Entry) -> None:
    """Hypotheses apart, which other choices may leave no room for."""
    assert entry.is_in(full()) or entry.needs or entry.hypothesis


@each
def test_indicators_and_errors_have_the_cases_axes(entry: Entry) -> None:
    scene = replace(
        full(), operation=qs.Operation(speed=np.array([[0.0, 500.0]]), axial_load=np.array([[8e3], [9e3], [1e4]]))
    )
    point = OperatingPoint(solved(scene))
    assert np.shape(entry.indicator(point)) == (3, 2)
    assert (entry.indicator(point) >= 0.0).all()
    found = entry.errors(point)
    assert set(found) <= set(effects.QUANTITIES)
    assert all(np.shape(error) == (3, 2) and (error >= 0.0).all() for error in found.values())


@pytest.mark.parametrize("name", ["centrifugal_force", "gyroscopic_moment"])
def test_inertia_grows_with_the_square_of_the_speed_and_falls_with_load(name: str) -> None:
    (entry,) = (entry for entry in EFFECTS if entry.name == name)
    speeds = qs.Operation(speed=np.array([0.0, 100.0, 200.0]) * qs.rpm, axial_load=17_800.0)
    nothing, one, other = entry.indicator(OperatingPoint(solved(replace(at_rest(), operation=speeds))))
    assert nothing == 0.0
    assert other / one == pytest.approx(4.0, rel=1e-9)
    loads = qs.Operation(speed=3000 * qs.rpm, axial_load=np.array([2e3, 2e4]))
    light, heavy = entry.indicator(OperatingPoint(solved(replace(at_rest(), operation=loads))))
    assert light > 8.0 * heavy


def test_inertia_is_that_of_the_solution() -> None:
    """Fc and Mg at equal contact angles against those of the solution, at a speed that hardly parts the angles."""
    solution = solved(turning(1000.0, axial_load=17_800.0))
    point, found = OperatingPoint(solution), {entry.name: entry for entry in EFFECTS}
    force = found["centrifugal_force"].indicator(point) * point.load.max()
    moment = found["gyroscopic_moment"].indicator(point) * point.load.max() * 22.225e-3 / 2.0
    assert force == pytest.approx(solution.centrifugal_force[0], rel=2e-3)  # type: ignore[index]
    assert moment == pytest.approx(abs(solution.gyroscopic_moment[0]), rel=1e-2)  # type: ignore[index]


def test_a_light_ball_is_noticed() -> None:
    for radial, is_light in ((3e3, False), (17_800.0, True)):
        scene = resting(axial_load=17_800.0, radial_load_y=radial, tilt_y=0.0, tilt_z=0.0)
        assert OperatingPoint(solved(scene)).has_light_ball == is_light
