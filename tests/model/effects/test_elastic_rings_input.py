"""Elastic rings from scene files and back, what is refused, and what is read off their solutions."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing import pictures
from qsbearing.cli import cli
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.effects.elastic_rings import deflections_at_balls, grooves_of
from qsbearing.model.solution.ring_shape import AROUND, groove_shape, radial_loads

HEAD = """
[bearing]
name = "B218"
[operation]
axial_load_N = 17800
radial_load_y_N = 9000
tilt_y_mrad = 0
tilt_z_mrad = 0
"""
OUTER = {
    "free": 'outer = {outside_diameter_mm = 160, width_mm = 30, housing = "free"}',
    "shoulders": "outer = {outside_diameter_mm = 160, width_mm = 30, shoulder_diameter_mm = 132.4, "
    'open_diameter_mm = 146.3, housing = "free"}',
    "housing": "outer = {outside_diameter_mm = 160, width_mm = 30, housing = {outside_diameter_mm = 220, "
    "elastic_modulus_GPa = 70, poisson_ratio = 0.33}}",
    "compliances": "outer = {housing = {compliance_um_per_N = [5e-5, 0, 0.02, 0.003]}}",
    "rigid": 'outer = {housing = "rigid"}',
}
INNER = {
    "free": 'inner = {bore_diameter_mm = 90, width_mm = 30, shaft = "free"}',
    "solid": 'inner = {bore_diameter_mm = 90, width_mm = 30, shaft = "solid"}',
    "hollow": "inner = {bore_diameter_mm = 90, width_mm = 30, shaft = {bore_diameter_mm = 40}}",
}
B218 = qs.load_scene("b218").bearing
PRESSED = {"bore_diameter": 90 * qs.mm, "outside_diameter": 160 * qs.mm}


def written(folder: Path, *lines: str, more: str = "") -> Path:
    path = folder / "scene.toml"
    path.write_text(HEAD + "[effects.elastic_rings]\n" + "\n".join(lines) + "\n" + more)
    return path


def refused(path: Path) -> str:
    with pytest.raises(qs.SceneFileError) as error:
        qs.load_scene(path)
    return str(error.value)


@pytest.mark.parametrize("outer", OUTER.values(), ids=OUTER)
@pytest.mark.parametrize("inner", INNER.values(), ids=INNER)
def test_a_file_is_read_written_and_read_again(outer: str, inner: str, tmp_path: Path) -> None:
    scene = qs.load_scene(written(tmp_path, outer, inner))
    assert scene.elastic_rings is not None
    again = scene_of(input_tables(scene), "again", "")
    assert again == scene


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ('outer = {outside_diameter_mm = 140, width_mm = 30, housing = "free"}', "bottom of the outer groove"),
        ("outer = {outside_diameter_mm = 160, width_mm = 30}", "effects.elastic_rings.outer.housing: missing"),
        ('outer = {outside_diameter_mm = 160, widht_mm = 30, housing = "free"}', "Did you mean outer.width_mm?"),
        ('outer = {outside_diameter_mm = "160", width_mm = 30, housing = "free"}', "is not a number"),
        ('outer = {outside_diameter_mm = 160, width_mm = 30, housing = "fre"}', 'not one of "rigid", "free"'),
        ("inner = {bore_diameter_mm = 90, width_mm = 30, shaft = {bore_diameter_mm = 95}}", "within the ring's bore"),
        (OUTER["shoulders"].replace("132.4", "148"), "on the balls' side of the bottom of the outer groove"),
        (OUTER["shoulders"].replace("132.4", "124"), "on the ring's side of the outer groove's centre circle"),
        (OUTER["shoulders"].replace("shoulder_diameter_mm = 132.4, ", ""), "outer.shoulder_diameter_mm: missing"),
        ("inner = {shaft = {compliance_um_per_N = [-1]}}", "is negative"),
        ("inner = {width_mm = 30, shaft = {compliance_um_per_N = [1e-4]}}", "is given together with"),
        ("", "describes no ring"),
    ],
)  # fmt: skip
def test_mistakes_are_named(line: str, said: str, tmp_path: Path) -> None:
    assert said in refused(written(tmp_path, line))


def test_a_size_that_no_catalogue_prints_is_missing(tmp_path: Path) -> None:
    path = written(tmp_path, 'outer = {width_mm = 30, housing = "free"}')
    path.write_text(path.read_text().replace("B218", "ISO16281_7ball"))
    assert "effects.elastic_rings.outer.outside_diameter_mm: missing" in refused(path)


FIT = "[effects.ring_expansion]\nbore_diameter_mm = 90\noutside_diameter_mm = {}\nhousing_outside_diameter_mm = 220\n"


HOUSING = "outer = {outside_diameter_mm = 160, width_mm = 30, housing = {outside_diameter_mm = 220}}"


def test_one_seat_is_described_alike(tmp_path: Path) -> None:
    """Beside ring expansion there is one seat: diameters agree, and interference adds up."""
    other = written(tmp_path, HOUSING, more=FIT.format(162) + "housing_interference_um = 20\n")
    assert "is another than" in refused(other)
    free = written(tmp_path, OUTER["free"], more=FIT.format(160) + "housing_interference_um = 20\n")
    assert "is free, but" in refused(free)
    tight = qs.load_scene(written(tmp_path, HOUSING, more=FIT.format(160) + "housing_interference_um = 60\n"))
    solution = qs.solve(tight)
    assert not any("lift off" in each for each in qs.warnings(solution))
    assert solution.outer_ring is not None and solution.outer_shape is not None
    assert solution.outer_ring.seat_pressure > 0.0


PRESSED_RINGS = qs.ElasticRings(
    outside_diameter=160 * qs.mm, outer_width=30 * qs.mm, housing_outside_diameter=220 * qs.mm,
    outer_shoulder_diameter=132.4 * qs.mm,
)  # fmt: skip
FREE_RINGS = replace(PRESSED_RINGS, housing="free", housing_outside_diameter=None)
THRUST: dict[str, Any] = {"axial_load": 17800.0, "tilt_y": 0.0, "tilt_z": 0.0}


def in_housing(interference: Any, rings: qs.ElasticRings = PRESSED_RINGS, **loads: Any) -> qs.Solution:
    """B218 under thrust, its outer ring fitted so [m]."""
    fit = qs.RingExpansion(**PRESSED, housing_interference=interference, housing_outside_diameter=220 * qs.mm)
    return qs.solve(qs.Scene(B218, qs.Operation(**THRUST | loads), ring_effects=(fit, rings)))


ALUMINIUM = qs.Material(70e9, 0.33, 2700.0)


@pytest.mark.parametrize(
    ("here", "there", "said"),
    [
        ({}, ALUMINIUM, "housing_elastic_modulus = 2.08e+11 Pa: is that of the rings, for it is left out, but the"),
        ({"housing_elastic_modulus": 70e9}, None, "is given here, but the housing of ring_expansion has 208 GPa"),
        ({"housing_elastic_modulus": 70e9}, ALUMINIUM, "housing_poisson_ratio"),
        ({"housing_elastic_modulus": 70e9, "housing_poisson_ratio": 0.33}, ALUMINIUM, ""),
    ],
)
def test_a_housing_is_of_one_material(here: dict[str, float], there: qs.Material | None, said: str) -> None:
    """Described for elastic rings and for the fit; left out, it is of the rings' in either."""
    fit = qs.RingExpansion(
        **PRESSED, housing_interference=60e-6, housing_outside_diameter=220 * qs.mm, housing_material=there
    )
    effects = (fit, replace(PRESSED_RINGS, **here))
    if not said:
        qs.Scene(B218, qs.Operation(**THRUST), ring_effects=effects)
        return
    with pytest.raises(qs.SceneError, match="One body has one material") as error:
        qs.Scene(B218, qs.Operation(**THRUST), ring_effects=effects)
    assert said in str(error.value)


def test_a_clearance_closes() -> None:
    """The ring grows as a free one until the clearance is used up; then the housing carries, and nothing jumps.

    All clearances at once are as each alone. In the closed state the ring's outside has grown by half the clearance and
    what the housing's bore has by its pressure.
    """
    clearance = np.linspace(0.0, 30.0, 61) * qs.um
    both = in_housing(-clearance)
    assert both.converged.all() and both.outer_shape is not None and both.outer_ring is not None
    free = qs.solve(qs.Scene(B218, qs.Operation(**THRUST), ring_effects=(FREE_RINGS,)))
    assert free.outer_shape is not None
    moved = both.displacement[:, 0]
    assert both.scene.elastic_rings is not None
    touches = np.asarray(both.scene.elastic_rings.housing_touches) > 0.0
    assert touches[0] and not touches[-1] and (np.diff(touches.astype(int)) <= 0).all()
    np.testing.assert_allclose(moved[~touches], free.displacement[0], rtol=1e-9)
    # Softer the larger the clearance, evenly, with no step as it is used up but that of the bulges at the balls, which
    # a housing holds.
    steps = np.diff(moved[touches])
    assert (steps > 0.0).all() and steps.max() < 1.2 * steps.min()
    bulge = free.outer_shape.amplitudes[16] / np.tan(40 * qs.deg)
    assert 0.0 <= free.displacement[0] - moved[touches][-1] < steps.max() + 1.2 * bulge
    pressure = (both.outer_shape.seat_pressure + both.outer_ring.seat_pressure)[touches]
    assert (pressure >= 0.0).all() and pressure[0] > 1e6 and pressure[-1] < 0.05 * pressure[0]
    a, b = 80.0 * qs.mm, 110.0 * qs.mm
    bore = pressure * a / 208e9 * ((a * a + b * b) / (b * b - a * a) + 0.3)
    ring = 73.863 * qs.mm
    load = (both.outer.load * both.outer.cosine).sum(axis=1)[touches] / (2.0 * np.pi * ring * 30 * qs.mm)
    size = a * a - ring * ring
    outside = (2.0 * load * ring * ring * a - pressure * a * (a * a + ring * ring - 0.3 * size)) / (208e9 * size)
    np.testing.assert_allclose(outside - bore, 0.5 * clearance[touches], atol=2e-9)
    for k in (3, 50):
        alone = in_housing(-clearance[k])
        assert alone.displacement[0] == pytest.approx(moved[k], rel=1e-9)
        # Between rigid rings the clearance stays open, whatever the elastic ones did.
        fit = qs.RingExpansion(**PRESSED)
        rigid = qs.solve(qs.Scene(B218, qs.Operation(**THRUST), ring_effects=(fit,)))
        assert alone.elastic_share == pytest.approx(1.0 - rigid.displacement[0] / moved[k], rel=1e-6)


def test_a_ring_that_touches_its_housing_somewhere_is_told() -> None:
    """Under radial load, in either state; not where the clearance is wide."""
    said = {um: qs.warnings(in_housing(-um * qs.um, radial_load_y=10000.0)) for um in (1.0, 18.0, 100.0)}
    assert any("lift off the housing" in each for each in said[1.0])
    assert any("so far that it touches the housing" in each for each in said[18.0])
    assert not any("housing" in each for each in said[100.0])


def test_a_seat_is_looked_at_only_where_fit_and_balls_both_move_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Either alone is solved once, whatever an earlier solve of both has found of the seats: that is no input."""
    both = in_housing(-100 * qs.um)
    assert qs.stiffness(replace(both.scene, ring_effects=(both.scene.ring_expansion, PRESSED_RINGS)), both) is not None
    with pytest.raises((ValueError, TypeError), match="housing_touches"):  # the latter from Python 3.13 on
        replace(PRESSED_RINGS, housing_touches=0.0)
    alone = replace(both.scene, ring_effects=(both.scene.elastic_rings,))
    expected = qs.solve(qs.Scene(B218, qs.Operation(**THRUST), ring_effects=(PRESSED_RINGS,)))
    monkeypatch.delattr("qsbearing.model.solution.solver.solve_closing")
    assert qs.solve(alone).displacement[0] == expected.displacement[0]
    with pytest.raises(NameError):
        in_housing(-100 * qs.um)


def test_clearances_in_sets_are_refused() -> None:
    fit = qs.RingExpansion(**PRESSED, housing_interference=-5 * qs.um, housing_outside_diameter=220 * qs.mm)
    rows = tuple(qs.Row(B218, position=x * qs.mm, carries=c) for x, c in ((0.0, "+x"), (50.0, "-x")))
    with pytest.raises(qs.SceneError, match="of clearance to its ring in operation"):
        qs.BearingSet(rows, qs.Operation(axial_load=1000.0), ring_effects=(fit, PRESSED_RINGS))


def test_a_seat_that_parts_is_said(tmp_path: Path) -> None:
    """Without a fit the housing does not pull the ring back on the unloaded side."""
    solution = qs.solve(qs.load_scene(written(tmp_path, OUTER["housing"])))
    assert any("outer ring would lift off the housing" in each for each in qs.warnings(solution))
    assert solution.outer_shape is not None
    assert solution.outer_shape.least_seat_pressure < 0.0 < solution.outer_shape.seat_pressure


def test_seat_carries_the_load(tmp_path: Path) -> None:
    """The mean pressure is what the balls press outward less what the ring holds by its hoop; n = 1 goes through."""
    solution = qs.solve(qs.load_scene(written(tmp_path, OUTER["housing"])))
    compliance = solution.scene.elastic_rings.compliances(grooves_of(B218))[1]  # type: ignore[union-attr]
    assert compliance is not None and compliance.seat is not None
    radial = radial_loads(solution)[1]
    azimuth = np.linspace(0.0, 2.0 * np.pi, 721)[:-1]
    n = np.arange(25)[:, None, None]
    waves = np.cos(n * (azimuth[:, None] - solution.azimuth))
    pressure = (compliance.seat[:, None, None] * radial * waves).sum(axis=(0, 2))
    carried = (pressure * np.cos(azimuth)).mean() * 2.0 * np.pi * 80 * qs.mm * 30 * qs.mm
    assert carried == pytest.approx(9000.0, rel=1e-9)
    assert solution.outer_shape.largest_seat_pressure == pytest.approx(pressure.max(), rel=1e-3)  # type: ignore[union-attr]


@pytest.mark.parametrize("control", ["outer", "per_ball", "minimum_dissipation"])
def test_deflections_are_those_of_the_solver(control: str) -> None:
    """Reported shape and loads, friction included, against the deflections that the solver kept."""
    rings = qs.ElasticRings(
        outside_diameter=160 * qs.mm, outer_width=30 * qs.mm, housing="free",
        bore_diameter=90 * qs.mm, inner_width=30 * qs.mm, shaft="solid",
    )  # fmt: skip
    loads: dict[str, Any] = {"axial_load": 17800.0, "radial_load_y": 5000.0, "tilt_y": 0.0, "tilt_z": 0.0}
    s = qs.solve(
        qs.Scene(
            B218, qs.Operation(speed=6000 * qs.rpm, **loads), ring_effects=(rings,), raceway_control=control,  # type: ignore[arg-type]
            ball_effects=(qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=0.08)),
        )
    )  # fmt: skip
    deflection = deflections_at_balls(rings.compliances(grooves_of(B218)), s.azimuth, *radial_loads(s))
    np.testing.assert_allclose(s.groove_deflection, deflection, rtol=1e-9)
    both = groove_shape(s, "inner", s.azimuth) + groove_shape(s, "outer", s.azimuth)
    np.testing.assert_allclose(s.groove_deflection, both, rtol=1e-9)
    assert s.outer_shape is not None and s.inner_shape is not None
    # The harmonic n = Z moves all balls alike.
    even = sum(shape.growth + shape.amplitudes[16] for shape in (s.outer_shape, s.inner_shape))
    assert even == pytest.approx(deflection.mean(), rel=1e-9)


def test_the_command_prints_it(tmp_path: Path) -> None:
    path = written(tmp_path, OUTER["free"], INNER["solid"])
    found = CliRunner().invoke(cli, ["run", str(path)])
    assert "Rings deflected by the ball loads" in found.output
    record = json.loads(CliRunner().invoke(cli, ["run", str(path), "--json"]).output)
    elastic = record["elastic_rings"]
    assert 0.1 < elastic["share_of_axial_displacement"] < 0.3
    assert elastic["outer"]["growth_um"] > 5.0
    assert elastic["outer"]["seat_pressure_MPa"] is None
    assert elastic["inner"]["seat_pressure_MPa"] > 0.0
    assert record["balls"][0]["groove_deflection_um"] > 5.0
    plain = json.loads(CliRunner().invoke(cli, ["run", "b218", "--json"]).output)
    assert plain["elastic_rings"] is None
    assert plain["balls"][0]["groove_deflection_um"] is None


def test_its_picture(tmp_path: Path) -> None:
    """The groove as drawn, over all of the circumference, is the one that is reported."""
    solution = qs.solve(qs.load_scene(written(tmp_path, OUTER["free"])))
    axes = pictures.ring_shape(solution).axes[0]
    drawn = {line.get_label(): np.asarray(line.get_ydata()) for line in axes.get_lines()}["outer raceway"]
    shape = groove_shape(solution, "outer", AROUND)
    np.testing.assert_allclose((drawn[:-1] - 1.0) / 0.16, shape / np.abs(shape).max(), atol=1e-9)
    assert len(pictures.overview(solution).axes) == 4
