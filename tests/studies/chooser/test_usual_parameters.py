"""What `explain` and `run` say of effects whose parameters a scene lacks, beside solves with rings that are stated.

`pytest -m heavy` compares 200 random scenes, the usual run a few of them.
"""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.catalogue.spindle_series import spindle_bearings
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.effects import QUANTITIES
from qsbearing.model.effects.ring_dimensions import OWN, USUAL, ring_dimensions
from qsbearing.model.solution.comparison import by_quantity
from qsbearing.studies.chooser.explain import explain
from qsbearing.studies.chooser.explain_set import explain_set
from tests.qsbearing.scenes import solved
from tests.systems.sets.arrangements import PAIR_FILE, pair

FACTOR = 1.5
"""As close as what rests on usual proportions has to be."""
NOTICED = 0.01
"""Changes below one per cent carry no verdict."""
SERIES = [
    name
    for name, entry in sorted(spindle_bearings().items())
    if name.startswith("7") and "outer_shoulder_diameter_mm" in entry.dimensions
]
LOADINGS: tuple[dict[str, Any], ...] = (
    {},
    {"radial_load_y": 0.8, "tilt_y": 0.0, "tilt_z": 0.0},
    {"radial_load_y": 0.5, "moment_z": 0.0},
    {"axial_load": None, "radial_load_y": 0.8, "tilt_y": 0.0, "tilt_z": 0.0},
)
"""Beside a thrust, in parts of it: alone, with tilts prevented, free to tilt, under a rigid preload in its place."""


def random_scene(rng: np.random.Generator) -> qs.Scene:
    """A bearing of the catalogue with both ball effects, at rest or up to dm n = 1.2e6."""
    bearing = qs.load_scene(str(rng.choice(SERIES))).bearing
    pressing = float(rng.uniform(2e6, 4e7)) * float(bearing.ball_diameter) ** 2
    thrust = float(bearing.ball_count * pressing * np.sin(bearing.free_contact_angle))
    loads: dict[str, Any] = {"axial_load": 1.0} | LOADINGS[rng.integers(len(LOADINGS))]
    loads = {name: None if part is None else thrust * part * rng.uniform(0.2, 1.8) for name, part in loads.items()}
    speed = 0.0 if rng.random() < 0.3 else rng.uniform(0.0, 1.2e6) / float(bearing.pitch_diameter / qs.mm) * qs.rpm
    preload = qs.Preload(rigid=thrust) if loads["axial_load"] is None else None
    effects = (qs.CentrifugalForce(), qs.GyroscopicMoment())
    return qs.Scene(bearing, qs.Operation(speed=speed, **loads), effects, qs.RacewayControl.OUTER, preload=preload)


def stated(bearing: qs.BallBearing) -> dict[str, list[Any]]:
    """The effects that explain assumes, by hand from the catalogue's diameters."""
    own, ball = bearing.outline, float(bearing.ball_diameter)
    assert own is not None
    bottom = float(bearing.outer_groove_centre_radius + bearing.outer_groove_radius)
    ring = {
        "outside_diameter": own.outside_diameter,
        "outer_width": own.width,
        "outer_shoulder_diameter": own.outer_shoulder_diameter,
        "outer_open_diameter": 2.0 * (bottom - 0.03 * ball),
    }
    steel = qs.ElasticRings(**ring, housing_outside_diameter=1.4 * own.outside_diameter)
    return {
        "ring_expansion": [qs.RingExpansion(own.bore_diameter, own.outside_diameter)],
        "elastic_rings": [steel, qs.ElasticRings(**ring, housing="free")],
    }


def compared(count: int, seed: int) -> dict[str, list[float]]:
    """Ratios of what explain prints to what solving finds, of changes that count; and those not assessed."""
    rng = np.random.default_rng(seed)
    found: dict[str, list[float]] = {"own": [], "usual": [], "not assessed": []}
    for scene in (random_scene(rng) for _ in range(count)):
        plain = qs.solve(scene)
        if not plain.converged:
            continue
        for kind, asked in (("own", scene), ("usual", replace(scene, bearing=replace(scene.bearing, outline=None)))):
            rows = {row.effect: row for row in explain(asked, 0.01)[1]}
            for name, effects in stated(scene.bearing).items():
                shown = rows[name].assumed
                found["not assessed"].append(float(not shown or all(each["actual"] is None for each in shown)))
                for assumed, effect in zip(shown, effects, strict=True):
                    full = by_quantity(plain, qs.solve(replace(scene, ring_effects=(effect,))))
                    for quantity in QUANTITIES if assumed["actual"] else ():
                        one, other = assumed["actual"][quantity], float(full[quantity])
                        if one is not None and np.isfinite(other) and max(one, other) > NOTICED:
                            found[kind].append(one / other)
    return found


def within(ratios: list[float], factor: float) -> float:
    """The share of ratios that are off by less than a factor."""
    return float(np.mean([1.0 / factor < ratio < factor for ratio in ratios]))


def judge(found: dict[str, list[float]]) -> None:
    """With the bearing's dimensions explain solves what the test solves, but for rounding; with proportions in their
    place nearly all is within the factor (98 % of 2,150 numbers)."""
    assert found["own"] == pytest.approx(np.ones(len(found["own"])), rel=1e-6)
    assert within(found["usual"], FACTOR) > 0.95
    assert np.mean(found["not assessed"]) <= 0.05


def test_a_few_random_scenes() -> None:
    judge(compared(4, seed=1))


@pytest.mark.heavy
def test_random_scenes() -> None:
    judge(compared(200, seed=0))


DEEP_GROOVE = """
[bearing]
kind = "deep_groove"
ball_count = 9
ball_diameter_mm = 12.7
pitch_diameter_mm = 60
inner_groove_radius_mm = 6.6
outer_groove_radius_mm = 6.73
diametral_clearance_mm = 0.014
ball_material = "steel"
ring_material = "steel"
[operation]
speed_rpm = 6000
axial_load_N = 600
radial_load_y_N = 2500
tilt_y_mrad = 0
tilt_z_mrad = 0
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"
"""
"""Whose elastic rings an estimate put at 800 to 4000 %."""


def elastic(rows: list[Any]) -> list[dict[str, float]]:
    """By assumption, what elastic rings change."""
    (row,) = (row for row in rows if row.effect == "elastic_rings")
    assert row.verdict == "likely needed, data missing"
    return [each["actual"] for each in row.assumed]


def test_a_deep_groove_bearing_under_radial_load() -> None:
    """Beside a free ring of 80 x 18 mm with shoulders of 66 mm, within the factor."""
    scene = scene_of(tomllib.loads(DEEP_GROOVE), "")
    free = qs.ElasticRings(outside_diameter=80e-3, outer_width=18e-3, outer_shoulder_diameter=66e-3, housing="free")
    full = by_quantity(solved(scene), solved(replace(scene, ring_effects=(free,))))
    in_housing, last = elastic(explain(scene, 0.01)[1])
    for quantity in QUANTITIES:
        assert 1.0 / FACTOR < last[quantity] / full[quantity] < FACTOR, quantity
        assert in_housing[quantity] < 0.5 * last[quantity]


def test_the_bearing_s_own_dimensions_are_used_where_they_are_known() -> None:
    """The catalogue's, or those of the file; the README's scene by the diameters of its ring expansion."""
    named = qs.load_scene("7210c").bearing
    own = ring_dimensions(named)
    assert (own.outside, own.width, own.shoulder, own.origin) == (90e-3, 20e-3, pytest.approx(76.9e-3), OWN)
    bare = replace(named, outline=None)
    assert ring_dimensions(bare).origin == USUAL
    rings = qs.RingExpansion(50e-3, 92e-3)
    assert ring_dimensions(bare, (rings,)).outside == 92e-3
    text = '[bearing]\nname = "7210C"\noutside_diameter_mm = 91\n[operation]\naxial_load_N = 1000\n'
    of_file = scene_of(tomllib.loads(text), "").bearing
    assert ring_dimensions(of_file).outside == pytest.approx(91e-3)
    again = scene_of(input_tables(scene_of(tomllib.loads(text), "")), "").bearing
    assert again.outline == of_file.outline


def test_a_pair_s_elastic_rings_are_solved_with_its_preload() -> None:
    """Rigid preload: what the bearing alone would predict of its displacement, nothing, is not what the pair does."""
    of = pair("DB", 720.0, speed=10_000 * qs.rpm, axial_load=200.0, radial_load_y=400.0, moment_z=0.0)
    in_housing, free = elastic(explain_set(of, 0.01)[1])
    assert 0.01 < in_housing["displacement"] < free["displacement"] < 0.5
    assert free["load"] < 0.5


def test_the_temperature_of_a_shaft_changes_what_ring_expansion_would(tmp_path: Path) -> None:
    """Inner rings are as warm as it, by whatever the file says of ring expansion: nothing."""
    body = "[shaft]\ntemperature_C = {}\n[[shaft.sections]]\nlength_mm = 20\nouter_diameter_mm = 50\n"
    found = []
    for celsius in (20.0, 35.0, 60.0):
        (tmp_path / "pair.toml").write_text(PAIR_FILE + body.format(celsius))
        of = qs.load_set(tmp_path / "pair.toml")
        (row,) = (row for row in explain_set(of, 0.01)[1] if row.effect == "ring_expansion")
        stated = qs.RingExpansion(50e-3, 90e-3, inner_ring_temperature=celsius + qs.zero_celsius)
        full = by_quantity(qs.solve_set(of), qs.solve_set(replace(of, ring_effects=(stated,))))
        assert row.assumed[0]["actual"]["load"] == pytest.approx(float(full["load"]), rel=1e-6)
        assert "as warm as the shaft" in row.why
        found.append(row.assumed[0]["actual"]["load"])
    assert found[0] < 0.5 * found[1] < 0.5 * found[2]
