"""Elastic rings in the solver: printed values, limits, and relations that any equilibrium between them obeys."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.effects.elastic_rings import deflections_at_balls, grooves_of
from qsbearing.model.effects.ring_section import bending_height

B218 = qs.load_scene("b218").bearing
FREE = qs.ElasticRings(outside_diameter=160 * qs.mm, outer_width=30 * qs.mm, housing="free")
BOTH = replace(FREE, bore_diameter=90 * qs.mm, inner_width=30 * qs.mm, shaft="free")
COMPOUND = replace(
    BOTH, housing=None, housing_outside_diameter=200 * qs.mm, housing_elastic_modulus=70e9, shaft="solid"
)
SHOULDERS = replace(
    BOTH, outer_shoulder_diameter=132.4 * qs.mm, outer_open_diameter=146.3 * qs.mm, inner_shoulder_diameter=118 * qs.mm
)
ALL = {"shoulders": SHOULDERS, "both free": BOTH, "compound": COMPOUND}
COMBINED = {"axial_load": 17800.0, "radial_load_y": 10000.0, "tilt_y": 0.0, "tilt_z": 0.0}
GENERAL = {"axial_load": 17800.0, "radial_load_y": 3000.0, "radial_load_z": 2000.0, "moment_y": 50.0, "moment_z": -80.0}
AT_SPEED: dict[str, dict[str, Any]] = {
    "at rest": {},
    "outer control": {
        "ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()),
        "raceway_control": "outer",
    },
    "minimum dissipation, own orbits": {
        "ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()),
        "raceway_control": "minimum_dissipation",
        "orbit_radius": "displaced",
        "hertz_angle": "actual",
    },
}
DISPLACEMENTS = ("axial_displacement", "radial_displacement_y", "radial_displacement_z", "tilt_y", "tilt_z")


def solved(rings: qs.ElasticRings | None, loads: dict[str, float], speed: float = 0.0, **effects: Any) -> qs.Solution:
    scene = qs.Scene(B218, qs.Operation(speed=speed, **loads), ring_effects=(rings,) if rings else (), **effects)
    solution = qs.solve(scene, residual_tolerance=1e-13)
    assert solution.converged, qs.message(solution)
    return solution


TABLE = [
    (0, 500, "+6.70", "-0.03", "0.02"),
    (0, 2000, "+10.45", "-0.13", "0.07"),
    (0, 17800, "+19.57", "-1.01", "0.52"),
    (0, 44500, "+23.81", "-2.12", "1.15"),
    (10000, 500, "+1.58", "-0.79", "0.77"),
    (10000, 2000, "+1.59", "-0.78", "0.74"),
    (10000, 17800, "+33.09", "-1.34", "0.87"),
    (10000, 44500, "+26.75", "-2.37", "1.43"),
]
"""Uniform growth of B218's free outer ring, by Lame's formula iterated around a solver by hand: changes of axial
displacement and inner load [%] and of the inner angle [deg]; beside them finite elements of a sector agree to 0.7 %."""


@pytest.mark.parametrize(("rpm", "axial", "displacement", "load", "angle"), TABLE)
def test_thrust_grows_a_free_ring_evenly(rpm: int, axial: int, displacement: str, load: str, angle: str) -> None:
    """To the printed digits, with the groove's bottom at 73.863 mm as they were made."""
    area, a, b = np.pi * 2 * 73.863e-3 * 30e-3, 73.863e-3, 80e-3
    growth = a / 208e9 * ((a * a + b * b) / (b * b - a * a) + 0.3) / area
    effects = {"ball_effects": (qs.CentrifugalForce(),), "raceway_control": "outer"} if rpm else {}
    rigid, free = (
        solved(rings, {"axial_load": axial}, rpm * qs.rpm, **effects)
        for rings in (None, qs.ElasticRings(outer_compliance=(growth,)))
    )
    change = free.displacement[0] - rigid.displacement[0]
    assert f"{100 * change / abs(rigid.displacement[0]):+.2f}" == displacement
    assert f"{100 * (free.inner.load[0] / rigid.inner.load[0] - 1):.2f}" == load
    assert f"{(free.inner.angle[0] - rigid.inner.angle[0]) / qs.deg:.2f}" == angle
    described = solved(FREE, {"axial_load": axial}, rpm * qs.rpm, **effects)
    assert described.outer_shape is not None
    # Its groove bottom lies 0.13 um further out.
    grown = growth * (described.outer.load * described.outer.cosine).sum()
    assert described.outer_shape.growth == pytest.approx(grown, rel=1e-4)
    # Z balls also bulge the ring between them: without shoulders by 6 % of its growth.
    bulge = described.outer_shape.amplitudes[..., 16] / described.outer_shape.growth
    assert 0.05 < bulge < 0.07


def second_moment(shoulders: tuple[float, float], height: float = 6.1376, radius: float = 11.6281) -> float:
    """Of a section 30 mm wide with a groove of this radius between shoulders, by a sum over its height [mm4]."""
    x = np.linspace(-15.0, 15.0, 60001)
    arc = radius - np.sqrt(np.maximum(radius**2 - x**2, 0.0))
    t = height + np.minimum(arc, np.where(x > 0.0, *shoulders))
    t[np.abs(x) > radius] = (height + np.where(x > 0.0, *shoulders))[np.abs(x) > radius]
    middle = np.trapezoid(t * t / 2.0, x) / np.trapezoid(t, x)
    return float(np.trapezoid(t**3 / 12.0 + t * (t / 2.0 - middle) ** 2, x))


@pytest.mark.parametrize("shoulders", [(7.65, 0.7), (4.15, 4.15), (0.0, 0.0), (11.0, 0.0)])
def test_a_section_with_shoulders_bends_as_its_second_moment_says(shoulders: tuple[float, float]) -> None:
    found = bending_height(6.1376, 30.0, 11.6281, shoulders)
    assert bending_height(6.1376, np.array([20.0, 30.0]), 11.6281, shoulders)[1] == found  # widths of a study
    assert 30.0 * found**3 / 12.0 == pytest.approx(second_moment(shoulders), rel=3e-5)  # the sum's steps


def test_shoulders_stiffen_bending_and_leave_growth() -> None:
    """The seat is where it was; of several cases each has its own; a deep groove's open side is as its other one."""
    high = np.array([140.0, 132.4]) * qs.mm
    for rings in (FREE, COMPOUND):
        plain = rings.compliances(grooves_of(B218))[1]
        with_shoulder = replace(rings, outer_shoulder_diameter=high).compliances(grooves_of(B218))[1]
        assert plain is not None and with_shoulder is not None
        np.testing.assert_allclose(with_shoulder.by_load[0], plain.by_load[0])
        ratio = with_shoulder.by_load[2:9] / plain.by_load[2:9, None]
        assert (ratio < (0.9 if rings is FREE else 0.99)).all() and (ratio[:, 1] < ratio[:, 0]).all()
    thin = replace(FREE, outer_shoulder_diameter=132.4 * qs.mm, outer_open_diameter=146.3 * qs.mm)
    found = thin.compliances(grooves_of(B218))[1]
    free = FREE.compliances(grooves_of(B218))[1]
    assert found is not None and free is not None
    expected = second_moment((0.0, 0.0)) / second_moment((7.665, 0.715))
    # Of n = 2 as a thin ring, good to 1 % here; the rectangle's middle lies 2 % nearer the axis.
    assert found.by_load[2] / free.by_load[2] == pytest.approx(expected * (75.04 / 76.93) ** 3, rel=1e-2)
    deep = replace(B218, kind=qs.BearingKind.DEEP_GROOVE)
    one = replace(FREE, outer_shoulder_diameter=140 * qs.mm)
    both = replace(one, outer_open_diameter=140 * qs.mm)
    assert one.compliances(grooves_of(deep))[1].by_load[2] == both.compliances(grooves_of(B218))[1].by_load[2]  # type: ignore[union-attr]
    scene = qs.Scene(deep, qs.Operation(**COMBINED), ring_effects=(one,))
    other = qs.Scene(B218, qs.Operation(**COMBINED), ring_effects=(both,))
    np.testing.assert_allclose(qs.solve(scene).inner.load, qs.solve(other).inner.load, rtol=1e-9)


@pytest.mark.parametrize("effects", AT_SPEED.values(), ids=AT_SPEED)
@pytest.mark.parametrize("loads", [COMBINED, GENERAL], ids=["combined", "general"])
def test_stiff_rings_are_rigid(loads: dict[str, float], effects: dict[str, Any]) -> None:
    """Rings 1e15 times as stiff deflect by as much less, which is less than the rounding of a solution."""
    table = tuple(1e-15 * np.asarray(each.by_load) for each in BOTH.compliances(grooves_of(B218)) if each is not None)
    stiff = qs.ElasticRings(inner_compliance=tuple(table[0]), outer_compliance=tuple(table[1]))
    speed = 8000 * qs.rpm if effects else 0.0
    one, other = solved(None, loads, speed, **effects), solved(stiff, loads, speed, **effects)
    np.testing.assert_allclose(other.inner.load, one.inner.load, rtol=1e-12)
    scale = np.abs(one.displacement).max()
    np.testing.assert_allclose(other.displacement, one.displacement, rtol=1e-12, atol=1e-12 * scale)


@pytest.mark.parametrize("effects", AT_SPEED.values(), ids=AT_SPEED)
@pytest.mark.parametrize("loads", [{"axial_load": 17800.0}, COMBINED, GENERAL], ids=["thrust", "combined", "general"])
@pytest.mark.parametrize("rings", ALL.values(), ids=ALL)
def test_deflections_follow_from_the_loads(
    rings: qs.ElasticRings, loads: dict[str, float], effects: dict[str, Any]
) -> None:
    """The grooves' distance at each ball, from its contacts, is the rigid rings' less what the balls' loads make of it.

    Recomputed from the results alone; the radial load on the outer ring includes friction and centrifugal force.
    """
    speed = 6000 * qs.rpm if effects else 0.0
    s = solved(rings, loads, speed, **effects)
    f = 11.6281 / 22.225
    lengths = [(f - 0.5) * 22.225 * qs.mm + side.approach for side in (s.inner, s.outer)]
    found = sum(length * side.cosine for length, side in zip(lengths, (s.inner, s.outer), strict=True))
    rigid = B218.groove_centre_distance * np.cos(40 * qs.deg) + s.displacement[1] * np.cos(s.azimuth)
    rigid = rigid + s.displacement[2] * np.sin(s.azimuth)
    across = 0.0 if s.gyroscopic_moment is None else s.gyroscopic_moment / (22.225 * qs.mm)
    shares = (0.0, 2.0) if effects.get("raceway_control") == "outer" else None
    if effects and shares is None:
        fc = s.centrifugal_force
        outer = s.outer.load * s.outer.cosine  # friction's share is not among the results: bounded below
        inner = outer - fc
        slack = 2.0 * np.abs(across).max() / np.abs(inner).max()
    else:
        outer = s.outer.load * s.outer.cosine + (0.0 if shares is None else shares[1] * across * s.outer.sine)
        inner = s.inner.load * s.inner.cosine
        slack = 1e-8
    deflection = deflections_at_balls(rings.compliances(grooves_of(B218)), s.azimuth, inner, outer)
    np.testing.assert_allclose(rigid - found, deflection, atol=slack * np.abs(deflection).max())


@pytest.mark.parametrize("effects", AT_SPEED.values(), ids=AT_SPEED)
@pytest.mark.parametrize("loads", [COMBINED, GENERAL], ids=["combined", "general"])
@pytest.mark.parametrize("rings", ALL.values(), ids=ALL)
def test_stiffness_against_differences(
    rings: qs.ElasticRings, loads: dict[str, float], effects: dict[str, Any]
) -> None:
    """Of reactions to held displacements; at rest it is symmetric (Maxwell)."""
    speed = 6000 * qs.rpm if effects else 0.0
    s = solved(rings, loads, speed, **effects)
    steps = np.array([1e-9, 1e-9, 1e-9, 1e-8, 1e-8])
    moved = s.displacement + np.concatenate([np.diag(steps), -np.diag(steps)])
    held = {name: moved[:, i] for i, name in enumerate(DISPLACEMENTS)}
    near = solved_all(rings, held, speed, **effects)
    differences = ((near[:5] - near[5:]) / (2.0 * steps[:, None])).T
    size = np.sqrt(np.outer(np.diag(s.stiffness), np.diag(s.stiffness)))
    np.testing.assert_allclose(differences / size, s.stiffness / size, atol=1e-6)
    if not effects:
        np.testing.assert_allclose(s.stiffness / size, s.stiffness.T / size, atol=1e-12)


def solved_all(rings: qs.ElasticRings, loads: dict[str, Any], speed: float, **effects: Any) -> Any:
    scene = qs.Scene(B218, qs.Operation(speed=speed, **loads), ring_effects=(rings,), **effects)
    solution = qs.solve(scene, residual_tolerance=1e-13)
    assert solution.converged.all()
    return solution.load


def test_work_of_the_load_is_the_energy_of_contacts_and_rings() -> None:
    """Under loads that grow from nothing: F.d, integrated, is 2/5 Q delta of the contacts and half F.w of the rings."""
    part = np.linspace(0.0, 1.0, 1001)[1:] ** 2  # loads start with an infinite slope of displacement
    loads = {"axial_load": 17800 * part, "radial_load_y": 9000 * part, "tilt_y": 0.0, "tilt_z": 0.0}
    s = qs.solve(qs.Scene(B218, qs.Operation(**loads), ring_effects=(BOTH,)))
    force, moved = s.load[:, :2], s.displacement[:, :2]
    force, moved = np.vstack([np.zeros(2), force]), np.vstack([np.zeros(2), moved])
    work = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(moved, axis=0))
    contacts = 0.4 * sum((side.load[-1] * side.approach[-1]).sum() for side in (s.inner, s.outer))
    radial = s.inner.load[-1] * s.inner.cosine[-1]
    rings = (
        0.5 * (radial * deflections_at_balls(BOTH.compliances(grooves_of(B218)), s.azimuth[-1], radial, radial)).sum()
    )
    assert rings > 0.1 * contacts
    assert work == pytest.approx(contacts + rings, rel=1e-4)  # of the trapezoidal rule


@pytest.mark.parametrize("effects", AT_SPEED.values(), ids=AT_SPEED)
def test_rotation_by_one_pitch_and_mirrors(effects: dict[str, Any]) -> None:
    """Turning the load by a ball's pitch turns the answer; half the balls solved, by symmetry, agree with all."""
    speed = 6000 * qs.rpm if effects else 0.0
    pitch = 2.0 * np.pi / 16
    answers = []
    for k in (0, 1, 4):
        y, z = 4000.0 * np.cos(k * pitch), 4000.0 * np.sin(k * pitch)
        y = 0.0 if k == 4 else y  # exactly in the x-z plane, which halves the balls otherwise than the x-y plane
        loads = {"axial_load": 17800.0, "radial_load_y": y, "radial_load_z": z, "tilt_y": 0.0, "tilt_z": 0.0}
        s = solved(BOTH, loads, speed, **effects)
        answers.append(np.roll(s.inner.load, -k))
    np.testing.assert_allclose(answers[1], answers[0], rtol=1e-9)
    np.testing.assert_allclose(answers[2], answers[0], rtol=1e-9)
    np.testing.assert_allclose(answers[0][1:], answers[0][:0:-1], rtol=1e-9)


def test_ball_counts_and_cases_together() -> None:
    """An array of bearings is solved as each alone, few balls (whose spacing folds harmonics) and many among them."""
    counts = np.array([3, 7, 16, 31, 40])
    loads = {"axial_load": 17800.0, "radial_load_y": 6000.0, "tilt_y": 0.0, "tilt_z": 0.0}
    large = replace(B218, pitch_diameter=310 * qs.mm)
    rings = qs.ElasticRings(outside_diameter=360 * qs.mm, outer_width=30 * qs.mm, housing="free")
    scene = qs.Scene(replace(large, ball_count=counts), qs.Operation(**loads), ring_effects=(rings,))
    together = qs.solve(scene)
    assert together.converged.all()
    for k, count in enumerate(counts):
        bearing = replace(large, ball_count=int(count))
        alone = qs.solve(qs.Scene(bearing, qs.Operation(**loads), ring_effects=(rings,)))
        np.testing.assert_allclose(together.inner.load[k, :count], alone.inner.load, rtol=1e-9)
        radial = np.nan_to_num(alone.inner.load * alone.inner.cosine)
        deflection = deflections_at_balls(rings.compliances(grooves_of(bearing)), alone.azimuth, radial, radial)
        line = 2 * (11.6281 - 22.225 / 2) * qs.mm + alone.inner.approach + alone.outer.approach
        rigid = B218.groove_centre_distance * np.cos(40 * qs.deg) + alone.displacement[1] * np.cos(alone.azimuth)
        beyond = 5e-3 if count > 25 else 1e-8  # waves shorter than twelve round the ring are left out
        loaded = alone.inner.load > 0
        found = rigid - line * alone.inner.cosine
        np.testing.assert_allclose(found[loaded], deflection[loaded], atol=beyond * np.abs(deflection).max())


def test_a_start_and_a_rigid_start_lead_to_the_same() -> None:
    """Continuing from a solution with other rings, or none."""
    s = solved(BOTH, COMBINED)
    rigid = solved(None, COMBINED)
    for start in (s, rigid):
        again = qs.solve(s.scene, start=start, residual_tolerance=1e-13)
        np.testing.assert_allclose(again.inner.load, s.inner.load, rtol=1e-9)
    assert qs.solve(s.scene, start=s).iterations <= 1
    back = qs.solve(rigid.scene, start=s)
    np.testing.assert_allclose(back.inner.load, rigid.inner.load, rtol=1e-9)


def test_rings_that_vary_over_cases() -> None:
    """Widths, diameters, speeds and materials as arrays: each case as it is alone; readings too."""
    widths, outsides = np.array([20.0, 30.0]) * qs.mm, np.array([[155.0], [160.0], [170.0]]) * qs.mm
    loads = {"axial_load": 17800.0, "radial_load_y": 6000.0, "tilt_y": 0.0, "tilt_z": 0.0}
    rings = qs.ElasticRings(outside_diameter=outsides, outer_width=widths, housing="free")
    together = qs.solve(qs.Scene(B218, qs.Operation(**loads), ring_effects=(rings,)))
    assert together.shape == (3, 2)
    for i, j in np.ndindex(3, 2):
        one = qs.ElasticRings(outside_diameter=outsides[i, 0], outer_width=widths[j], housing="free")
        alone = solved(one, loads)
        np.testing.assert_allclose(together.inner.load[i, j], alone.inner.load, rtol=1e-9)
        assert together.outer_shape is not None and alone.outer_shape is not None
        assert together.outer_shape.bending[i, j] == pytest.approx(alone.outer_shape.bending, rel=1e-9)
