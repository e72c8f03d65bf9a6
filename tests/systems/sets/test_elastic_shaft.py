"""Bearings on an elastic shaft: textbook beams, a beam of finite elements, statics from outside, and limits."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.systems.sets import elastic_shaft
from qsbearing.systems.sets.beam import Beam
from tests.qsbearing import similarity
from tests.qsbearing.scenes import B218, BOTH, OUTER
from tests.systems.sets import timoshenko
from tests.systems.sets.arrangements import S6210C

STEEL = qs.STEEL
E, NU = float(STEEL.elastic_modulus), float(STEEL.poisson_ratio)
SECTION = (qs.ShaftSection(0.5, 0.05, 0.02),)
BENDING, SHEAR = timoshenko.section(0.05, 0.02, E, NU)
PLANES = {"y": ("radial_y", "moment_z", 1, 4, 1.0), "z": ("radial_z", "moment_y", 2, 3, -1.0)}
"""Of each plane: its force, its moment, the channels of both, and how a slope of its deflection counts as a tilt."""


def bare(shaft: qs.Shaft, **operation: Any) -> qs.SetSolution:
    """A shaft whose one row touches nothing."""
    row = qs.Row(S6210C, 0.1, offset=-200 * qs.um)
    operation = {"moment_y": 0.0, "moment_z": 0.0} | operation
    return qs.solve_set(qs.BearingSet((row,), qs.Operation(**operation), shaft=shaft, reference_position=0.0))


def spindle(
    of: qs.Shaft | None, *, housing: qs.HousingStiffness | None = None, speed: float = 0.0, **parts: Any
) -> qs.BearingSet:
    """Two pairs back to back, 150 mm apart."""
    rows = tuple(
        qs.Row(S6210C, at, carries, housing_stiffness=housing)
        for at, carries in ((0.0, "+x"), (0.02, "-x"), (0.15, "+x"), (0.17, "-x"))
    )
    choices = {"ball_effects": BOTH, "raceway_control": OUTER} if speed else {}
    operation = parts.pop("operation", {})
    return qs.BearingSet(
        rows,
        qs.Operation(speed=speed, **({"moment_y": 0.0, "moment_z": 0.0} | operation)),
        parts.pop("preload", qs.Preload(rigid=1500.0)),
        shaft=of,
        **(choices | parts),
    )


TOOL = qs.ShaftLoad(-0.07, axial=-200.0, radial_y=400.0, radial_z=-150.0, moment_y=3.0, moment_z=5.0)
SHAFT = qs.Shaft(
    (qs.ShaftSection(0.08, 0.06, 0.02), qs.ShaftSection(0.1, 0.05, 0.02), qs.ShaftSection(0.12, 0.05, 0.03)),
    start=-0.08,
    loads=(TOOL,),
    points={"tool": -0.07, "tail": 0.2},
)


@pytest.mark.parametrize("plane", PLANES)
def test_a_cantilever_bends_as_the_textbook_has_it(plane: str) -> None:
    force, _, i, slope, sign = PLANES[plane]
    clamped = {"axial_displacement": 0.0, "radial_displacement_y": 0.0, "radial_displacement_z": 0.0}
    clamped |= {"tilt_y": 0.0, "tilt_z": 0.0, "moment_y": None, "moment_z": None}
    shaft = qs.Shaft(SECTION, loads=(qs.ShaftLoad(0.5, **{force: 5.0}),))
    found = bare(shaft, **clamped)
    x = np.array([0.0, 0.2, 0.5])
    line = 5.0 * (x**2 * (3 * 0.5 - x) / (6 * BENDING) + x / SHEAR)
    assert found.deflection(x)[:, i] == pytest.approx(line, rel=1e-9, abs=1e-18)
    assert found.deflection(x)[:, slope] == pytest.approx(sign * 5.0 * (x - x**2) / (2 * BENDING), rel=1e-9, abs=1e-15)
    assert found.load[i] == pytest.approx(-5.0, rel=1e-9)
    assert found.load[slope] == pytest.approx(-sign * 2.5, rel=1e-9)


@pytest.mark.parametrize(("at", "where"), [(0.25, 0.25), (0.5, 0.5)], ids=["simply supported", "overhanging"])
def test_beams_on_two_stiff_supports_bend_as_the_textbook_has_it(at: float, where: float) -> None:
    stiff, far = 1e12, 0.5 if at < 0.5 else 0.3
    springs = {"axial": stiff, "radial_y": stiff, "radial_z": stiff}
    supports = (qs.ShaftSupport(0.0, **springs), qs.ShaftSupport(far, **springs))
    found = bare(qs.Shaft(SECTION, loads=(qs.ShaftLoad(at, radial_y=5.0),), supports=supports))
    if at < far:
        deflection = 5.0 * (0.5**3 / (48 * BENDING) + 0.5 / (4 * SHEAR) + 0.5 / stiff)
    else:
        a = at - far
        bent = a**2 * at / (3 * BENDING) + (a + a**2 / far) / SHEAR
        deflection = 5.0 * (bent + ((a / far) ** 2 + (at / far) ** 2) / stiff)
    assert found.deflection(where)[0, 1] == pytest.approx(deflection, rel=1e-9)
    right = 5.0 * at / far
    assert found.support_loads[:, 1] == pytest.approx([5.0 - right, right], rel=1e-9)
    middle = found.inner_forces(0.1)[0]
    assert middle[4] == pytest.approx((5.0 - right) * -0.1, rel=1e-9)


def test_a_stepped_shaft_on_springs_agrees_with_finite_elements_of_another_program() -> None:
    steps, places = [(0.2, 0.06, 0.0), (0.15, 0.04, 0.01), (0.25, 0.05, 0.03)], np.array([0.05, 0.3, 0.55])
    springs = np.array([2e8, 5e7, 1e8])
    supports = tuple(qs.ShaftSupport(p, radial_y=k, radial_z=1e8) for p, k in zip(places, springs, strict=True))
    shaft = qs.Shaft(
        tuple(qs.ShaftSection(*each) for each in steps),
        loads=(qs.ShaftLoad(0.6, radial_y=300.0, moment_z=20.0), qs.ShaftLoad(0.12, radial_y=-700.0)),
        supports=(*supports, qs.ShaftSupport(0.0, axial=1e8)),
    )
    nodes = np.array([0.0, 0.05, 0.12, 0.2, 0.3, 0.35, 0.55, 0.6])
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    sections = [timoshenko.section(*steps[np.searchsorted([0.2, 0.35], x)][1:], E, NU) for x in middles]
    matrix, load = timoshenko.matrix(nodes, sections), np.zeros(16)
    for place, spring in zip(places, springs, strict=True):
        matrix[2 * np.argmin(abs(nodes - place)), 2 * np.argmin(abs(nodes - place))] += spring
    load[[14, 15, 4]] = 300.0, 20.0, -700.0
    expected = np.linalg.solve(matrix, load).reshape(-1, 2)
    found = bare(shaft).deflection(nodes)
    assert found[:, 1] == pytest.approx(expected[:, 0], rel=1e-9)
    assert found[:, 4] == pytest.approx(expected[:, 1], rel=1e-9)


@pytest.mark.parametrize("speed", [0.0, 12_000 * qs.rpm])
def test_rows_carry_what_is_applied(speed: float) -> None:
    housing = qs.HousingStiffness(axial=4e8, radial=6e8, tilt=5e5)
    found = qs.solve_set(spindle(SHAFT, housing=housing, speed=speed, operation={"radial_load_z": 250.0}))
    forces, moments = np.array([-200.0, 400.0, -150.0 + 250.0]), np.array([0.0, 3.0, 5.0])
    moments = moments + np.cross([-0.07, 0, 0], [-200.0, 400.0, -150.0]) + np.cross([0.085, 0, 0], [0, 0, 250.0])
    for row, solution in zip(found.set.rows, found.rows, strict=True):
        load = solution.load * np.array([row.sign, 1, 1, row.sign, row.sign])
        centre = float(row.position) + row.sign * float(row.bearing.groove_centre_offsets[0])
        forces = forces - load[:3]
        moments = moments - np.cross([centre, 0, 0], load[:3]) - np.array([0, *load[3:]])
    assert np.abs(forces).max() < 1e-9 * 400.0
    assert np.abs(moments[1:]).max() < 1e-9 * 60.0


def test_each_ring_stands_where_shaft_and_housing_have_it() -> None:
    """Recomputed from the deflection line and each row's own load on its housing."""
    found = qs.solve_set(spindle(SHAFT, housing=qs.HousingStiffness(axial=4e8, radial=6e8, tilt=5e5)))
    preloaded = [float(each) for each in found._structure.matrices[:, 0, 0, 0]]
    assert preloaded == [1.0, -1.0, 1.0, -1.0]
    for row, solution in zip(found.set.rows, found.rows, strict=True):
        flip = np.array([row.sign, 1, 1, row.sign, row.sign])
        arm = row.sign * float(row.bearing.groove_centre_offsets[0])
        load = solution.load * flip
        load[3:] += np.array([-arm * load[2], arm * load[1]])
        sunk = load / np.array([4e8, 6e8, 6e8, 5e5, 5e5])
        ring = found.deflection(row.position)[0] - sunk
        ring[1:3] += np.array([arm * ring[4], -arm * ring[3]])
        assert solution.displacement[1:] == pytest.approx((ring * flip)[1:], rel=1e-9, abs=1e-15)


def test_an_ever_stiffer_shaft_ends_as_the_rigid_one(monkeypatch: pytest.MonkeyPatch) -> None:
    arm = -0.07 - 0.085
    at_reference = {"axial_load": -200.0, "radial_load_y": 400.0, "radial_load_z": -150.0}
    at_reference |= {"moment_y": 3.0 + 150.0 * arm, "moment_z": 5.0 + 400.0 * arm}
    rigid = qs.solve_set(spindle(None, speed=12_000 * qs.rpm, operation=at_reference))
    away = []
    for factor in (1e3, 1e6, 1e14):
        monkeypatch.setattr(elastic_shaft, "Beam", lambda *a, by=factor: Beam(*a[:4], a[4] * by, a[5]))
        found = qs.solve_set(spindle(SHAFT, speed=12_000 * qs.rpm))
        away.append(np.abs(found.displacement - rigid.displacement).max() / np.abs(rigid.displacement).max())
        assert found.points["tool"].effective_stiffness is not None
    assert away[0] / away[1] == pytest.approx(1e3, rel=0.01)
    assert away[2] < 1e-10
    assert found.axial_loads == pytest.approx(rigid.axial_loads, rel=1e-10)
    scale = np.sqrt(np.outer(*2 * [np.diagonal(rigid.stiffness)]))
    assert np.abs((found.stiffness - rigid.stiffness) / scale).max() < 1e-10


def test_splitting_sections_changes_nothing() -> None:
    first, *others = SHAFT.sections
    split = (replace(first, length=0.03), replace(first, length=0.05), *others)
    one, other = (qs.solve_set(spindle(replace(SHAFT, sections=each))) for each in (SHAFT.sections, split))
    x = np.linspace(-0.08, 0.22, 7)
    assert np.abs(one.deflection(x) - other.deflection(x)).max() < 1e-10 * np.abs(one.deflection(x)).max()


def test_the_reference_is_only_where_answers_are_meant() -> None:
    """The shaft is clamped at it in the equations: another one shows the same spindle."""
    one, other = (qs.solve_set(spindle(SHAFT, reference_position=at)) for at in (-0.07, 0.15))
    assert one.axial_loads == pytest.approx(other.axial_loads, rel=1e-9)
    x = np.linspace(-0.08, 0.22, 7)
    away = np.abs(one.deflection(x) - other.deflection(x))[:, 1:]
    assert away.max() < 1e-9 * np.abs(one.deflection(x)[:, 1:]).max()
    tool = one.points["tool"]
    assert np.linalg.inv(one.stiffness) == pytest.approx(tool.compliance, rel=1e-6, abs=1e-6 * tool.compliance.max())


def test_a_loads_work_is_shared_by_all_that_gives_way_and_is_reciprocal() -> None:
    support = qs.ShaftSupport(0.2, radial_y=2e7, radial_z=2e7)
    of = spindle(replace(SHAFT, supports=(support,)), housing=qs.HousingStiffness(radial=6e8, axial=4e8))
    found = qs.solve_set(of)
    tool = found.points["tool"]
    assert set(tool.shares) == {
        "shaft",
        *(f"{part} {n}" for part in ("row", "housing") for n in range(1, 5)),
        "support 1",
    }
    total = np.sum(list(tool.shares.values()), axis=0)
    assert total == pytest.approx(np.diagonal(tool.compliance), rel=1e-10)
    assert min(share.min() for share in tool.shares.values()) >= 0.0
    sizes = np.sqrt(np.outer(*2 * [np.diagonal(tool.compliance)]))
    assert np.abs((tool.compliance - tool.compliance.T) / sizes).max() < 1e-9
    more = 400.0 + np.array([4.0, -4.0])
    near = qs.solve_set(replace(of, shaft=replace(of.shaft, loads=(replace(TOOL, radial_y=more),))))
    slope = (near.deflection([-0.07])[0, 0] - near.deflection([-0.07])[1, 0]) / 8.0
    assert slope == pytest.approx(tool.compliance[:, 1], rel=1e-5)


def test_what_a_load_at_one_place_moves_at_another_is_mutual() -> None:
    loads = [qs.ShaftLoad(-0.07, radial_y=1.0), qs.ShaftLoad(0.2, radial_y=1.0)]
    supports = tuple(qs.ShaftSupport(p, axial=1e7, radial_y=1e8, radial_z=1e8) for p in (0.0, 0.15))
    moved = [bare(replace(SHAFT, loads=(load,), supports=supports)).deflection([0.2, -0.07])[:, 1] for load in loads]
    assert moved[0][0] == pytest.approx(moved[1][1], rel=1e-10)


def test_a_preload_is_what_rows_carry_however_soft_their_housing() -> None:
    found = qs.solve_set(spindle(replace(SHAFT, loads=()), housing=qs.HousingStiffness(axial=2e7)))
    assert found.axial_loads == pytest.approx(np.full(4, 750.0), rel=1e-9)
    assert found.preload_unmounted == pytest.approx(np.full(4, 750.0), rel=1e-9)


def test_a_housing_is_in_series_with_its_row() -> None:
    row = qs.Row(S6210C, 0.0, housing_stiffness=qs.HousingStiffness(axial=5e7))
    found = qs.solve_set(qs.BearingSet((row,), qs.Operation(axial_load=800.0)))
    alone = qs.solve_set(qs.BearingSet((qs.Row(S6210C, 0.0),), qs.Operation(axial_load=800.0)))
    assert found.displacement[0] == pytest.approx(alone.displacement[0] + 800.0 / 5e7, rel=1e-9)
    assert 1.0 / found.stiffness[0, 0] == pytest.approx(1.0 / alone.stiffness[0, 0] + 1.0 / 5e7, rel=1e-9)


def test_a_housing_that_couples_planes_turns_with_the_load() -> None:
    """A housing soft in a direction of its own: the whole turned by a quarter is the same spindle. Loads lie in one
    plane, out of which such a housing leads."""
    turn = np.zeros((5, 5))
    turn[0, 0] = 1.0
    for i, j, value in ((1, 2, -1.0), (2, 1, 1.0), (3, 4, -1.0), (4, 3, 1.0)):
        turn[i, j] = value
    soft = np.diag([4e8, 6e8, 6e8, 5e5, 5e5])
    soft[1, 2] = soft[2, 1] = 3e8
    along_y = replace(SHAFT, loads=(qs.ShaftLoad(-0.07, radial_y=400.0),))
    along_z = replace(SHAFT, loads=(qs.ShaftLoad(-0.07, radial_z=400.0),))
    quarter = qs.Operation(moment_y=0.0, moment_z=0.0, first_ball_azimuth=0.5 * np.pi)
    one = qs.solve_set(spindle(along_y, housing=qs.HousingStiffness(matrix=soft)))
    other = qs.solve_set(
        replace(spindle(along_z, housing=qs.HousingStiffness(matrix=turn @ soft @ turn.T)), operation=quarter)
    )
    assert abs(one.deflection(-0.07)[0, 2]) > 1e-3 * abs(one.deflection(-0.07)[0, 1])
    assert turn @ one.deflection(-0.07)[0] == pytest.approx(other.deflection(-0.07)[0], rel=1e-8, abs=1e-16)


def test_a_spindle_warm_throughout_is_a_larger_one() -> None:
    s = similarity.GROWN

    def pair(bearing: qs.BallBearing, size: float, effects: tuple, temperature: float | None) -> qs.SetSolution:
        """Of this size as it is drawn; loads are those of the size in operation."""
        load = {"axial": -2000.0 * s**2, "radial_y": 4000.0 * s**2, "moment_z": 30.0 * s**3}
        shaft = qs.Shaft(
            (qs.ShaftSection(0.1 * size, 0.09 * size), qs.ShaftSection(0.3 * size, 0.085 * size, 0.03 * size)),
            start=-0.1 * size,
            loads=(qs.ShaftLoad(-0.08 * size, **load),),
            temperature=temperature,
        )
        rows = qs.Row(bearing, 0.0, "+x", offset=20 * qs.um * size), qs.Row(bearing, 0.2 * size, "-x")
        resting = qs.Operation(moment_y=0.0, moment_z=0.0)
        return qs.solve_set(qs.BearingSet(rows, resting, shaft=shaft, ring_effects=effects))

    rings = dict.fromkeys(("inner_ring", "outer_ring", "housing"), similarity.HOT)
    warm = pair(B218, 1.0, similarity.warm_fits(**rings), similarity.HOT)
    large = pair(similarity.grown(), s, similarity.cold_fits(), None)
    assert warm.deflection(-0.08)[0] == pytest.approx(large.deflection(-0.08 * s)[0], rel=1e-9, abs=1e-16)
    assert warm.axial_loads == pytest.approx(large.axial_loads, rel=1e-9)


def test_without_a_shaft_nothing_of_it_is_evaluated(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*arguments: Any) -> None:
        raise AssertionError

    for name in ("Places", "_elastic", "_modes", "flexibility"):
        monkeypatch.setattr(elastic_shaft, name, never)
    found = qs.solve_set(spindle(None))
    assert found.converged
    assert found._structure.elasticity.size == 0


def test_every_error_of_a_shaft_is_named_at_once() -> None:
    with pytest.raises(qs.SceneError) as caught:
        qs.Shaft(
            (qs.ShaftSection(-0.1, 0.05), qs.ShaftSection(0.1, 0.05, 0.06)), loads=(qs.ShaftLoad(0.0, axial="no"),)
        )
    fields = {error.field for error in caught.value.errors}
    assert fields == {"shaft.section 1.length", "shaft.section 2.inner_diameter", "shaft.load 1.axial"}
    with pytest.raises(qs.SceneError, match="beyond the sections"):
        spindle(qs.Shaft((qs.ShaftSection(0.1, 0.05),)))
    for wrong in ({}, {"axial": 1e8, "matrix": np.eye(5)}, {"matrix": -np.eye(5)}, {"radial": -1.0}):
        with pytest.raises(qs.SceneError):
            qs.HousingStiffness(**wrong)
