"""Every part of a bearing has a temperature: given by its key, found by a heat balance, or assumed by a stated rule."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.scene_file import scene_of
from qsbearing.files.thermal_table import NODE_KEYS
from qsbearing.model.material import BY_NAME
from tests.systems.heat.spindle import tables

OWNERS = {body: (effect, key) for effect, keys in NODE_KEYS.items() for key, body in keys.items()}
"""Of every part with a temperature, the table of an effect and the key there."""
RULES = {
    "shaft": ("as the inner ring", 80.0),
    "inner_ring": ("reference temperature", 20.0),
    "outer_ring": ("reference temperature", 20.0),
    "housing": ("as the outer ring", 50.0),
    "balls": ("mean of the rings", 65.0),
}
"""What is assumed of each that is left out, between an inner ring of 80 and an outer ring of 50 °C."""
FITTED = """
bearing.name = "7210C"
operation = { speed_rpm = 0 }
preload.rigid_N = 2000
[effects.ring_expansion]
shaft_interference_um = 10
housing_interference_um = 10
housing_outside_diameter_mm = 140
"""
BEARING = qs.load_scene("7210C").bearing
GIVEN = {"inner_ring": 80.0, "outer_ring": 50.0}


def text(temperatures: dict[str, float]) -> str:
    """A bearing on both seats, so that every part matters, with these temperatures."""
    of = {effect: {} for effect, _ in OWNERS.values()}
    for body, value in temperatures.items():
        effect, key = OWNERS[body]
        of[effect][key] = value
    own = "".join(f"{key} = {value}\n" for key, value in of["ring_expansion"].items())
    balls = "".join(f"[effects.ball_expansion]\n{key} = {value}\n" for key, value in of["ball_expansion"].items())
    return FITTED + own + balls


def run(path: Path, *options: str) -> str:
    found = CliRunner().invoke(cli, ["run", str(path), *options])
    assert found.exit_code == 0, found.stderr
    return found.stdout


def by_file(temperatures: dict[str, float], folder: Path) -> tuple[dict[str, Any], float]:
    (folder / "scene.toml").write_text(text(temperatures), encoding="utf-8")
    return _told(json.loads(run(folder / "scene.toml", "--json")))


def by_record(temperatures: dict[str, float], folder: Path) -> tuple[dict[str, Any], float]:
    """The record of a run, read as the input that it holds."""
    (folder / "scene.toml").write_text(text(temperatures), encoding="utf-8")
    (folder / "record.json").write_text(run(folder / "scene.toml", "--json"), encoding="utf-8")
    return _told(json.loads(run(folder / "record.json", "--json")))


def by_sweep(temperatures: dict[str, float], folder: Path) -> tuple[dict[str, Any], float]:
    """As paths of a sweep of one point, whose file has none of them."""
    (folder / "scene.toml").write_text(text({}), encoding="utf-8")
    options = ["--out", str(folder / "s.csv"), "--overwrite"]
    for body, value in temperatures.items():
        options += ["--vary", f"effects.{'.'.join(OWNERS[body])}={value}"]
    found = CliRunner().invoke(cli, ["sweep", str(folder / "scene.toml"), *options])
    assert found.exit_code == 0, found.stderr
    names, values = ((folder / "s.csv").read_text(encoding="utf-8").splitlines()[n].split(",") for n in (0, 1))
    load = float(dict(zip(names, values, strict=True))["ring_load_axial_N"])
    return by_file(temperatures, folder)[0], load


def by_objects(temperatures: dict[str, float], folder: Path) -> tuple[dict[str, Any], float]:
    fits = {"shaft_interference": 10 * qs.um, "housing_interference": 10 * qs.um, "housing_outside_diameter": 0.14}
    warm = {f"{body}_temperature": value + qs.zero_celsius for body, value in temperatures.items() if body != "balls"}
    balls = temperatures.get("balls")
    effects: tuple[Any, ...] = (qs.RingExpansion(50 * qs.mm, 90 * qs.mm, **fits, **warm),)  # type: ignore[arg-type]
    effects += () if balls is None else (qs.BallExpansion(balls + qs.zero_celsius),)
    scene = qs.Scene(BEARING, qs.Operation(0.0), preload=qs.Preload(rigid=2000.0), ring_effects=effects)
    found = {
        body: {"temperature_C": each.value - qs.zero_celsius, "from": each.taken_from, "assumed": each.is_assumed}
        for body, each in scene.temperatures.items()
    }
    return found, float(qs.solve(scene).load[0])


def _told(record: dict[str, Any]) -> tuple[dict[str, Any], float]:
    return record["temperatures"], record["load"]["axial_N"]


DOORS = {"file": by_file, "record": by_record, "sweep": by_sweep, "objects": by_objects}


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("body", OWNERS)
def test_what_is_left_out_is_assumed_and_said_and_its_key_changes_it(body: str, door: str, tmp_path: Path) -> None:
    """By every way in, of every part: the rule's name and number, and with the key another result."""
    known = {name: value for name, value in GIVEN.items() if name != body}
    told, before = DOORS[door](known, tmp_path)
    assert set(told) == set(OWNERS), "a part that no test of this kind knows"
    source, warm = RULES[body]
    assert told[body] == {"temperature_C": pytest.approx(warm), "from": source, "assumed": True}
    told, after = DOORS[door](known | {body: warm}, tmp_path)
    assert told[body] == {"temperature_C": pytest.approx(warm), "from": "given", "assumed": False}
    assert after == pytest.approx(before, rel=1e-8), "given what was assumed"
    _, other = DOORS[door](known | {body: warm + 15.0}, tmp_path)
    assert abs(other / before - 1.0) > 0.003


def test_the_schema_has_the_key_of_every_part() -> None:
    schema = CliRunner().invoke(cli, ["schema"]).stdout
    found = json.loads(schema)["definitions"]
    for effect, key in OWNERS.values():
        assert key in found[effect]["properties"]


def test_tables_say_assumed(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(text(GIVEN), encoding="utf-8")
    lines = [line.split() for line in run(tmp_path / "scene.toml").splitlines()]
    assert ["balls", "65", "assumed:", "mean", "of", "the", "rings"] in lines
    assert ["inner", "ring", "80", "given"] in lines


def test_a_bearing_that_is_warm_throughout_keeps_its_preload() -> None:
    """A similarity: forces grow as 1 + alpha dT squared, and no further."""
    warm = {f"{side}_ring_temperature": 80.0 + qs.zero_celsius for side in ("inner", "outer")}
    rings = qs.RingExpansion(50 * qs.mm, 90 * qs.mm, **warm)
    scene = qs.Scene(BEARING, qs.Operation(0.0), preload=qs.Preload(rigid=300.0), ring_effects=(rings,))
    assert qs.solve(scene).load[0] == pytest.approx(300.0 * (1.0 + 12e-6 * 60.0) ** 2, rel=1e-8)


def test_without_a_temperature_of_a_ring_nothing_is_assumed() -> None:
    """Off means absent: no effect is added, and no temperature is listed."""
    scene = qs.Scene(BEARING, qs.Operation(axial_load=500.0), ring_effects=(qs.RingExpansion(0.05, 0.09),))
    assert scene.temperatures == {}
    assert scene.operating_bearing.ball_diameter == scene.bearing.ball_diameter


def test_of_several_cases_each_has_the_mean_of_its_own_rings() -> None:
    inner = np.array([40.0, 80.0]) + qs.zero_celsius
    rings = qs.RingExpansion(0.05, 0.09, inner_ring_temperature=inner, outer_ring_temperature=40.0 + qs.zero_celsius)
    many = qs.solve(qs.Scene(BEARING, qs.Operation(axial_load=500.0), ring_effects=(rings,)))
    for number, balls in enumerate((40.0, 60.0)):
        warm = qs.RingExpansion(
            0.05, 0.09, inner_ring_temperature=inner[number], outer_ring_temperature=40.0 + qs.zero_celsius
        )
        given = (warm, qs.BallExpansion(balls + qs.zero_celsius))
        one = qs.solve(qs.Scene(BEARING, qs.Operation(axial_load=500.0), ring_effects=given))
        assert many.inner.load[number] == pytest.approx(one.inner.load, rel=1e-9)


def test_balls_without_a_coefficient_of_expansion_are_refused_between_warm_rings() -> None:
    bearing = replace(BEARING, ball_material=qs.Material(208e9, 0.3, 7800.0))
    warm = qs.RingExpansion(0.05, 0.09, inner_ring_temperature=350.0)
    with pytest.raises(qs.SceneError, match=r"ball_material.thermal_expansion: missing"):
        qs.Scene(bearing, qs.Operation(axial_load=500.0), ring_effects=(warm,))


def test_ten_kelvins_more_or_less_are_told_where_the_balls_are_assumed() -> None:
    """By `explain` and in the remarks of a run, as solved with balls that much colder and warmer; given, nothing."""
    warm = {"inner_ring_temperature": 80.0 + qs.zero_celsius, "outer_ring_temperature": 70.0 + qs.zero_celsius}
    held: dict[str, Any] = {"operation": qs.Operation(0.0), "preload": qs.Preload(rigid=1000.0)}
    rings = qs.RingExpansion(50 * qs.mm, 90 * qs.mm, **warm)  # type: ignore[arg-type]
    scene = qs.Scene(BEARING, ring_effects=(rings,), **held)
    load = qs.solve(scene).load[0]
    said = [each.remark for each in qs.warnings(qs.solve(scene)) if "assumed as warm" in each]
    assert [each.values["effect"] for each in said] == ["ball_expansion"]
    changes = []
    for kelvins in (-10.0, 10.0):
        balls = qs.BallExpansion(75.0 + kelvins + qs.zero_celsius)
        given = qs.Scene(
            scene.bearing, scene.operation, preload=scene.preload, ring_effects=(*scene.ring_effects, balls)
        )
        other = qs.solve(given).load[0]
        changes.append(abs(load / other - 1.0))
        assert not [each for each in qs.warnings(qs.solve(given)) if "assumed as warm" in each]
    assert said[0].values["changes"] == pytest.approx(changes, rel=1e-6)
    assert said[0].values["under"] == ("10 K colder", "10 K warmer")


# With a heat balance ------------------------------------------------------------------------------------------------


def hot(**changed: Any) -> qs.Solution:
    own = tables(**changed)
    del own["effects"]["ball_expansion"]
    return qs.solve(scene_of(own, ""))


def test_a_node_of_the_balls_is_that_of_balls_whose_expansion_nothing_names() -> None:
    named, unnamed = qs.solve(scene_of(tables(), "")), hot()
    assert unnamed.thermal.temperatures["balls"] == pytest.approx(named.thermal.temperatures["balls"], abs=1e-6)
    assert unnamed.load[0] == pytest.approx(named.load[0], rel=1e-9)


def test_without_a_node_balls_are_at_the_mean_of_their_rings_at_every_step() -> None:
    """The steady state then holds with balls that are given what it assumed."""
    between = [
        {"between": ["inner_ring", "outer_ring"], "W_per_K": 1.0},
        {"between": ["outer_ring", "ambient"], "W_per_K": 3.0},
    ]
    found = hot(thermal={"limit_temperature_C": 200.0, "fixed": {"ambient_C": 27.0}, "conductances": between})
    of = found.scene.temperatures
    assert of["balls"].is_assumed
    mean = 0.5 * (of["inner_ring"].value + of["outer_ring"].value)
    assert of["balls"].value == pytest.approx(mean, rel=1e-14)
    given = (*found.scene.ring_effects, qs.BallExpansion(mean))
    same = qs.solve(replace(found.scene, ring_effects=given))
    assert same.load[0] == pytest.approx(found.load[0], rel=1e-9)


# Far from room temperature ------------------------------------------------------------------------------------------


def far(temperatures: dict[str, float], expansion: float | None = None) -> list[Any]:
    steel = qs.STEEL if expansion is None else qs.Material(208e9, 0.3, 7800.0, expansion)
    bearing = replace(BEARING, ball_material=steel, ring_material=steel)
    warm = {f"{body}_temperature": each + qs.zero_celsius for body, each in temperatures.items() if body != "balls"}
    fits = {"shaft_interference": 0.0, "housing_interference": 0.0, "housing_outside_diameter": 0.14}
    effects: tuple[Any, ...] = (qs.RingExpansion(0.05, 0.09, **fits, **warm),)  # type: ignore[arg-type]
    if "balls" in temperatures:
        effects += (qs.BallExpansion(temperatures["balls"] + qs.zero_celsius),)
    found = qs.solve(qs.Scene(bearing, qs.Operation(axial_load=2000.0), ring_effects=effects))
    return [each.remark for each in qs.warnings(found) if each.remark.code == "expansion_far"]


@pytest.mark.parametrize("body", OWNERS)
@pytest.mark.parametrize(("warm", "is_far"), [(-51.0, True), (-49.0, False), (299.0, False), (301.0, True)])
def test_a_part_beyond_the_range_of_its_coefficient_is_named(body: str, warm: float, is_far: bool) -> None:
    others = {name: 20.0 if warm < 0 else 250.0 for name in OWNERS if name != body}
    said = far(others | {body: warm})
    assert bool(said) == is_far
    if is_far:
        assert said[0].values["parts"] == body.replace("_", " ")
        assert said[0].values["temperature_C"] == pytest.approx(warm)


def test_a_coefficient_that_is_given_for_there_is_not_doubted() -> None:
    cold = dict.fromkeys(OWNERS, -253.0)
    assert far(cold) and not far(cold, 7.2e-6)


@pytest.mark.parametrize(
    ("material", "warm", "is_far"),
    [("aluminium", 240.0, False), ("aluminium", 260.0, True), ("cast iron", -5.0, True), ("titanium", 260.0, False)],
)
def test_some_materials_have_narrower_ranges(material: str, warm: float, is_far: bool) -> None:
    housing = {"housing_interference": 0.0, "housing_outside_diameter": 0.14, "housing_material": BY_NAME[material]}
    ring = {f"{part}_temperature": warm + qs.zero_celsius for part in ("inner_ring", "outer_ring", "housing")}
    rings = qs.RingExpansion(0.05, 0.09, **housing, **ring)  # type: ignore[arg-type]
    bearing = replace(BEARING, ball_material=qs.STEEL, ring_material=qs.STEEL)
    found = qs.solve(qs.Scene(bearing, qs.Operation(axial_load=2000.0), ring_effects=(rings,)))
    said = [each.remark.values["parts"] for each in qs.warnings(found) if each.remark.code == "expansion_far"]
    assert said == (["housing"] if is_far else [])
