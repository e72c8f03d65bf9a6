"""Weight, cones, housings out of line and loads on rigid shafts, each against something that does not know them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from tests.systems.heat.spindle import pair
from tests.systems.sets import timoshenko
from tests.systems.sets.arrangements import S6210C
from tests.systems.sets.test_elastic_shaft import BENDING, NU, SECTION, SHAFT, SHEAR, E, bare, spindle

STEEL = qs.STEEL
G = 9.81
LINE = STEEL.density * np.pi / 4 * (0.05**2 - 0.02**2) * G  # of SECTION, 0.5 m long [N/m]
CLAMPED = {
    "axial_displacement": 0.0, "radial_displacement_y": 0.0, "radial_displacement_z": 0.0,
    "tilt_y": 0.0, "tilt_z": 0.0, "moment_y": None, "moment_z": None,
}  # fmt: skip
STIFF = {"axial": 1e12, "radial_y": 1e12, "radial_z": 1e12}


@pytest.mark.parametrize(("way", "channel"), [((0.0, -G, 0.0), 1), ((0.0, 0.0, G), 2)], ids=["-y", "+z"])
def test_a_uniform_beam_sags_under_its_weight_as_the_textbook_has_it(
    way: tuple[float, float, float], channel: int
) -> None:
    supports = (qs.ShaftSupport(0.0, **STIFF), qs.ShaftSupport(0.5, **STIFF))
    found = bare(qs.Shaft(SECTION, supports=supports, gravity=way))
    line, span, x = np.sign(sum(way)) * LINE, 0.5, np.array([0.125, 0.25, 0.31])
    bent = line * x * (span**3 - 2 * span * x**2 + x**3) / (24 * BENDING) + line * x * (span - x) / (2 * SHEAR)
    assert found.deflection(x)[:, channel] == pytest.approx(bent + line * span / 2 / 1e12, rel=1e-9)
    assert found.support_loads[:, channel] == pytest.approx([line * span / 2] * 2, rel=1e-9)
    moment = found.inner_forces(0.25)[0]
    slope = 4 if channel == 1 else 3
    assert abs(moment[slope]) == pytest.approx(LINE * span**2 / 8, rel=1e-9)


def test_weight_pulls_along_an_upright_shaft() -> None:
    found = bare(qs.Shaft(SECTION, gravity=(-G, 0.0, 0.0)), **CLAMPED)
    area = np.pi / 4 * (0.05**2 - 0.02**2)
    assert found.deflection(0.5)[0, 0] == pytest.approx(-LINE * 0.5**2 / (2 * E * area), rel=1e-9)
    assert found.load[0] == pytest.approx(LINE * 0.5, rel=1e-9)


def test_a_mass_weighs_as_its_load_and_nothing_without_gravity() -> None:
    down = {"gravity": (0.0, -G, 0.0)}
    loaded = bare(qs.Shaft(SECTION, loads=(qs.ShaftLoad(0.5, radial_y=-3.0 * G),), **down), **CLAMPED)
    heavy = bare(qs.Shaft(SECTION, masses=(qs.ShaftMass(0.5, 3.0),), **down), **CLAMPED)
    assert heavy.deflection([0.3, 0.5]) == pytest.approx(loaded.deflection([0.3, 0.5]), rel=1e-12)
    weightless = bare(qs.Shaft(SECTION, masses=(qs.ShaftMass(0.5, 3.0),)), **CLAMPED)
    assert not weightless.deflection(0.5).any()


def test_a_stepped_heavy_spindle_is_as_heavy_as_many_loads_make_it() -> None:
    """Rows, supports and a warm shaft whose length spans cases; thin slices converge with the square of their size."""
    warm = np.array([20.0, 60.0]) + qs.zero_celsius
    of = replace(SHAFT, loads=(), temperature=warm, gravity=(0.0, -G, 0.3 * G))
    heavy = qs.solve_set(spindle(of, speed=12_000 * qs.rpm))
    away = []
    for count in (4, 16):
        slices = []
        for begin, section in zip(of.ends, of.sections, strict=False):
            size = section.length / count
            area = np.pi / 4 * (section.outer_diameter**2 - section.inner_diameter**2)
            newtons = STEEL.density * area * size * G
            for number in range(count):
                at = float(begin) + (number + 0.5) * size
                slices.append(qs.ShaftLoad(at, radial_y=-newtons, radial_z=0.3 * newtons))
        sliced = qs.solve_set(spindle(replace(of, gravity=None, loads=tuple(slices)), speed=12_000 * qs.rpm))
        away.append(np.abs(sliced.row_loads - heavy.row_loads)[..., 1].max())
    assert away[0] / away[1] == pytest.approx(16.0, rel=0.25)
    assert away[1] < 0.01 * np.abs(heavy.row_loads[..., 1]).max()
    weightless = qs.solve_set(spindle(replace(of, gravity=None), speed=12_000 * qs.rpm))
    assert heavy.preload_in_operation == pytest.approx(weightless.preload_in_operation, rel=1e-9)


def test_a_cone_bends_and_weighs_as_its_closed_forms_say() -> None:
    thick, thin, long = 0.05, 0.025, 0.3
    cone = (qs.ShaftSection(long, thick, end_outer_diameter=thin),)
    tip = qs.ShaftLoad(long, axial=7.0, radial_y=5.0)
    found = bare(qs.Shaft(cone, loads=(tip,)), **CLAMPED)
    k = 6 * (1 + NU) / (7 + 6 * NU)
    shear = 4 * long / (k * E / (2 * (1 + NU)) * np.pi * thick * thin)
    assert found.deflection(long)[0, 1] == pytest.approx(
        5.0 * (64 * long**3 / (3 * np.pi * E * thick**3 * thin) + shear), rel=1e-8
    )
    assert found.deflection(long)[0, 0] == pytest.approx(7.0 * 4 * long / (np.pi * E * thick * thin), rel=1e-9)
    weight = STEEL.density * G * np.pi * long / 12 * (thick**2 + thick * thin + thin**2)
    lever = long / 4 * (thick**2 + 2 * thick * thin + 3 * thin**2) / (thick**2 + thick * thin + thin**2)
    hangs = bare(qs.Shaft(cone, gravity=(0.0, -G, 0.0)), **CLAMPED)
    assert hangs.load[[1, 4]] == pytest.approx([weight, weight * lever], rel=1e-9)


def test_steps_become_the_cone_with_the_square_of_their_length() -> None:
    """A hollow one, held and loaded within it; the steps by finite elements of the tests' own."""
    whole = qs.ShaftSection(0.5, 0.06, 0.02, end_outer_diameter=0.04, end_inner_diameter=0.03)
    found = bare(qs.Shaft((whole,), loads=(qs.ShaftLoad(0.4, radial_y=5.0),)), **CLAMPED)
    away = []
    for count in (10, 20, 40):
        nodes = np.linspace(0.0, 0.4, count + 1)
        middles = 0.5 * (nodes[1:] + nodes[:-1]) / 0.5
        sections = [timoshenko.section(0.06 - 0.02 * p, 0.02 + 0.01 * p, E, NU) for p in middles]
        load = np.zeros(2 * nodes.size)
        load[-2] = 5.0
        bent = np.linalg.solve(timoshenko.matrix(nodes, sections)[2:, 2:], load[2:])[-2:]
        away.append(np.abs(bent / found.deflection(0.4)[0, [1, 4]] - 1.0).max())
    assert np.array(away[:-1]) / away[1:] == pytest.approx([4.0, 4.0], rel=0.02)
    straight = replace(whole, end_outer_diameter=0.06, end_inner_diameter=0.02)
    plain = replace(whole, end_outer_diameter=None, end_inner_diameter=None)
    one, other = (
        bare(qs.Shaft((each,), loads=(qs.ShaftLoad(0.5, radial_y=5.0),)), **CLAMPED) for each in (straight, plain)
    )
    assert np.array_equal(one.deflection(0.3), other.deflection(0.3))


@pytest.mark.parametrize("carries", ["+x", "-x"])
def test_a_row_in_a_tilted_housing_is_the_bearing_with_that_tilt(carries: str) -> None:
    """The seat turns about the balls' centres; a bearing's tilt is about the plane of its inner groove centres."""
    sign, tilt, aside, speed = (1.0 if carries == "+x" else -1.0), 0.4 * qs.mrad, 3 * qs.um, 9000 * qs.rpm
    choices = {"ball_effects": (qs.CentrifugalForce(),), "raceway_control": qs.RacewayControl.OUTER}
    row = qs.Row(S6210C, 0.0, carries, housing_tilt_z=tilt, housing_radial_z=aside)
    straight = {"radial_displacement_y": 0.0, "radial_displacement_z": 0.0, "tilt_y": 0.0, "tilt_z": 0.0}
    whole = qs.solve_set(
        qs.BearingSet((row,), qs.Operation(speed=speed, axial_load=sign * 800.0, **straight), **choices)
    )
    lever = (S6210C.inner_groove_radius - S6210C.ball_diameter / 2) * np.sin(S6210C.free_contact_angle)
    moved = {"radial_displacement_y": -lever * sign * tilt, "radial_displacement_z": -aside, "tilt_y": 0.0}
    alone = qs.solve(
        qs.Scene(S6210C, qs.Operation(speed=speed, axial_load=800.0, tilt_z=-sign * tilt, **moved), **choices)
    )
    assert whole.rows[0].inner.load == pytest.approx(alone.inner.load, rel=1e-8)
    assert sign * whole.displacement[0] == pytest.approx(alone.displacement[0], rel=1e-8)
    assert whole.load[1:3] == pytest.approx(alone.load[1:3], rel=1e-8)


@pytest.mark.parametrize("shaft", [None, SHAFT], ids=["rigid", "elastic"])
def test_a_housing_moved_as_a_whole_takes_the_shaft_along(shaft: qs.Shaft | None) -> None:
    of = spindle(shaft, speed=12_000 * qs.rpm, operation={"radial_load_y": 300.0}, reference_position=0.05)
    aside, tilt_y, tilt_z = 20 * qs.um, 0.1 * qs.mrad, -0.2 * qs.mrad
    rows = tuple(
        replace(
            row, housing_radial_y=aside + tilt_z * (row.position - 0.05),
            housing_radial_z=-tilt_y * (row.position - 0.05), housing_tilt_y=tilt_y, housing_tilt_z=tilt_z,
        )
        for row in of.rows
    )  # fmt: skip
    there, moved = qs.solve_set(of), qs.solve_set(replace(of, rows=rows))
    assert moved.row_loads == pytest.approx(there.row_loads, rel=1e-6, abs=1e-5)
    by = moved.displacement - there.displacement
    assert by == pytest.approx([0.0, aside, 0.0, tilt_y, tilt_z], abs=1e-12)


def test_one_seat_out_of_line_presses_the_rows() -> None:
    of = spindle(None, speed=12_000 * qs.rpm)
    first, *others = of.rows
    bent = np.array([0.0, 0.2, 0.4]) * qs.mrad
    found = qs.solve_set(replace(of, rows=(replace(first, housing_tilt_z=bent), *others)))
    assert found.converged.all()
    straight = qs.solve_set(of)
    assert found.row_loads[0] == pytest.approx(straight.row_loads, rel=1e-8, abs=1e-6)
    largest = [row.inner.load.max(axis=-1) for row in found.rows]
    assert (np.diff(largest[0]) > 0.0).all()
    assert found.preload_mounted is not None


def test_a_rigid_shaft_carries_its_loads_where_they_act() -> None:
    arm = -0.07 - 0.085
    at_reference = {"axial_load": -200.0, "radial_load_y": 400.0, "radial_load_z": -150.0}
    at_reference |= {"moment_y": 3.0 + 150.0 * arm, "moment_z": 5.0 + 400.0 * arm}
    moved = qs.solve_set(spindle(None, speed=12_000 * qs.rpm, operation=at_reference))
    rigid = qs.Shaft(loads=SHAFT.loads, points=SHAFT.points)
    found = qs.solve_set(spindle(rigid, speed=12_000 * qs.rpm))
    assert found.row_loads == pytest.approx(moved.row_loads, rel=1e-9, abs=1e-7)
    assert found.displacement == pytest.approx(moved.displacement, rel=1e-9)
    assert found.stiffness == pytest.approx(moved.stiffness, rel=1e-7, abs=1e-2)
    y = moved.displacement[1] + arm * moved.displacement[4]
    assert found.points["tool"].displacement[1] == pytest.approx(y, rel=1e-9)
    assert "shaft" not in found.points["tool"].shares
    hung = qs.Shaft(masses=(qs.ShaftMass(-0.07, 40.0),), gravity=(0.0, -10.0, 0.0))
    loaded = qs.Shaft(loads=(qs.ShaftLoad(-0.07, radial_y=-400.0),))
    one, other = (qs.solve_set(spindle(each)).row_loads for each in (hung, loaded))
    assert one == pytest.approx(other, rel=1e-12)


def test_a_rigid_shaft_with_loads_gets_as_warm_as_one_loaded_at_its_reference() -> None:
    there = qs.solve_set(pair())
    operation = {"speed_rpm": 5000, "axial_load_N": 60, "moment_z_Nm": 0}
    found = qs.solve_set(pair(operation=operation, shaft={"loads": [{"position_mm": 25.0, "radial_y_N": 100}]}))
    assert there.thermal is not None and found.thermal is not None
    assert found.thermal.temperatures["shaft"] == pytest.approx(there.thermal.temperatures["shaft"], rel=1e-8)
    assert found.row_loads == pytest.approx(there.row_loads, rel=1e-6, abs=1e-6)


def test_errors_of_weight_cones_and_alignment_are_named_at_once() -> None:
    with pytest.raises(qs.SceneError) as caught:
        qs.Shaft(
            (qs.ShaftSection(0.1, 0.05, 0.02, end_outer_diameter=0.01),),
            masses=(qs.ShaftMass(0.05, -1.0, polar_inertia=-1.0),),
            gravity=(0.0, -9.81),  # type: ignore[arg-type]
        )
    fields = {error.field for error in caught.value.errors}
    assert fields == {
        "shaft.section 1.inner_diameter", "shaft.mass 1.mass", "shaft.mass 1.polar_inertia", "shaft.gravity",
    }  # fmt: skip
    for wrong in ({"gravity": (0.0, -9.81, 0.0)}, {"temperature": 300.0}):
        with pytest.raises(qs.SceneError):
            qs.Shaft(**wrong)  # type: ignore[arg-type]
    with pytest.raises(qs.SceneError) as caught:
        qs.BearingSet((qs.Row(S6210C, housing_tilt_z=0.4, housing_radial_y=3.0),))
    assert {error.field for error in caught.value.errors} == {"row 1.housing_tilt_z", "row 1.housing_radial_y"}
