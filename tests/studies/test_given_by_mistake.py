"""What is given in place of something else, or is no number: every public function and field says what to do."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.results.readings_record import all_taken
from qsbearing.results.whole import whole_record
from tests.model.effects.test_elastic_rings_input import FREE_RINGS
from tests.qsbearing.scenes import B218

KINDS = {"Scene", "BearingSet", "Solution", "SetSolution", "Study"}
ROW = {"bearing": {"name": "7210C"}, "position_mm": 10, "carries": "-x"}
PAIR = {"operation": {"axial_load_N": 100}, "rows": [ROW | {"position_mm": -10, "carries": "+x"}, ROW]}
ALSO_TAKES = {"find": "files, names and tables too"}


@cache
def given() -> dict[str, Any]:
    scene, of_set = qs.load_scene("b218"), scene_or_set_of(PAIR | {"preload": {"rigid_N": 300}}, "", "")
    return {
        "a scene": scene,
        "a set": of_set,
        "a solution": qs.solve(scene),
        "a set's solution": qs.solve_set(of_set),
        "a name": "b218",
        "nothing": None,
    }


def functions() -> Iterator[tuple[str, Any]]:
    """Public functions that take a scene, a set, a solution or a study first."""
    for module in (qs, qs.readings):
        for name in getattr(module, "__all__", dir(module)):
            function = getattr(module, name)
            if name.startswith("_") or not inspect.isfunction(function):
                continue
            first = next(iter(inspect.signature(function).parameters.values()), None)
            if first is not None and kinds(first) and name not in ALSO_TAKES:
                yield name, function


def kinds(parameter: inspect.Parameter) -> set[str]:
    """Those that it takes."""
    words = str(parameter.annotation).replace("SolutionOfCases", "Solution | SetSolution")
    return set(words.replace("|", " ").split()) & KINDS


@pytest.mark.parametrize("name, function", list(functions()))
def test_a_function_says_what_it_takes(name: str, function: Any) -> None:
    first, *others = inspect.signature(function).parameters.values()
    takes = kinds(first)
    needed = {each.name: None for each in others if each.default is each.empty and each.kind != each.VAR_KEYWORD}
    wrong = 0
    for what, value in given().items():
        if type(value).__name__ not in takes:
            wrong += 1
            with pytest.raises(TypeError, match=rf"^{name} takes an? .*, not ") as raised:
                function(value, **needed)
            is_known = isinstance(value, qs.Scene | qs.BearingSet) and "Study" not in takes
            assert ("qs." in str(raised.value)) >= is_known, (what, str(raised.value))
    assert wrong


def test_there_are_functions_to_ask() -> None:
    assert {"solve", "solve_set", "sweep", "warnings", "message", "film"} <= {name for name, _ in functions()}


def test_readings_that_are_none_are_refused_with_those_that_are() -> None:
    scene, of_set = given()["a scene"], given()["a set"]
    wrong = {"nope": {}}
    for solve in (
        lambda: qs.solve(replace(scene, readings=wrong)),
        lambda: qs.solve_set(replace(of_set, readings=wrong)),
        lambda: qs.solve_set(replace(of_set, rows=(replace(of_set.rows[0], readings=wrong), *of_set.rows[1:]))),
    ):
        with pytest.raises(qs.SceneError, match=r"readings\.nope: is not a reading") as raised:
            solve()
        assert all(name in str(raised.value) for name in ("life", "film", "frequencies"))


def with_numbers() -> Iterator[tuple[Any, str]]:
    """Objects that hold a scene's numbers, and each field that has one."""
    objects = (
        B218,
        B218.ball_material,
        qs.Operation(speed=100.0, outer_speed=1.0, axial_load=1.0, radial_load_y=1.0, radial_load_z=1.0, tilt_y=1e-6,
                     tilt_z=1e-6),
        qs.Operation(axial_displacement=1e-6, radial_displacement_y=1e-6, radial_displacement_z=1e-6, moment_y=1.0,
                     moment_z=1.0),
        qs.Preload(rigid=100.0), qs.Preload(spring=100.0), qs.Preload(mounted=100.0),
        qs.GyroscopicMoment(friction_coefficient=0.1),
        qs.RingExpansion(0.09, 0.16, shaft_interference=1e-5),
        qs.BallExpansion(ball_temperature=300.0),
        FREE_RINGS,
    )  # fmt: skip
    for of in objects:
        assert is_dataclass(of)
        for each in fields(of):
            value = getattr(of, each.name)
            if each.init and isinstance(value, float | int) and not isinstance(value, bool):
                yield of, each.name


@pytest.mark.parametrize(
    "of, name", [pytest.param(of, name, id=f"{type(of).__name__}.{name}") for of, name in with_numbers()]
)
def test_masked_elements_are_refused_by_every_field(of: Any, name: str) -> None:
    value = getattr(of, name)
    whole = np.ma.masked_array([value, value], mask=[False, False])
    masked = np.ma.masked_array([value, value], mask=[False, True])

    def made(number: Any) -> Any:
        scene = replace(of, **{name: number})
        if isinstance(scene, qs.Material):
            replace(B218, ball_material=scene)
        if not isinstance(scene, qs.BallBearing | qs.Material):
            raise_errors = getattr(scene, "errors", None)
            if raise_errors is not None:
                found = raise_errors(B218) if inspect.signature(raise_errors).parameters else raise_errors()
                if found:
                    raise qs.SceneError(found)
        return scene

    made(whole)
    with pytest.raises(qs.SceneError, match=rf"{name}: has masked elements"):
        made(masked)


def test_a_row_that_was_not_tried_says_so_and_has_no_numbers() -> None:
    operation = {"axial_load_N": 1e5, "radial_load_y_N": 2000, "moment_z_Nm": 0}
    of = scene_or_set_of(PAIR | {"operation": operation}, "", "")
    assert isinstance(of, qs.BearingSet)
    solution = qs.solve_set(of)
    assert not solution.converged
    untried = [n for n, each in enumerate(solution.rows) if each.status == "not_converged" and each.iterations == 0]
    assert untried
    found = whole_record(solution, all_taken(solution))["rows"]
    for n in untried:
        assert "was not tried" in qs.message(solution.rows[n]) and np.isnan(solution.rows[n].residual)
    for each in found:
        assert each.get("residual", None) != 0.0
