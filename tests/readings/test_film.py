"""Oils and films: worked examples of the standards and of Hamrock's bearing, power laws, bad input."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.readings import Lubricant, OilState, lubricant
from tests.qsbearing.scenes import B218, DEEP_GROOVE, UPRIGHT, resting, solved, turning

THIN = OilState(0.02, 2e-8)


def test_films_grow_as_the_formulas_say() -> None:
    """With speed to the 0.68 or 0.67, with viscosity the same, with xi to the 0.49 or 0.53."""
    slow, fast = (solved(resting(DEEP_GROOVE, axial_load=1e3, speed=w)) for w in (100.0, 200.0))
    films = [qs.readings.film(slow, THIN), qs.readings.film(fast, THIN)]
    films += [qs.readings.film(slow, OilState(0.04, 2e-8)), qs.readings.film(slow, OilState(0.02, 4e-8))]
    for name, speed, pressure in (("minimum_thickness", 0.68, 0.49), ("central_thickness", 0.67, 0.53)):
        first, faster, thicker, stiffer = (getattr(each.outer, name)[0] for each in films)
        assert faster / first == pytest.approx(2**speed, rel=1e-12)
        assert thicker / first == pytest.approx(2**speed, rel=1e-12)
        assert stiffer / first == pytest.approx(2**pressure, rel=1e-12)


def test_round_contacts() -> None:
    """The part of the shape, which long ellipses hide, of grooves twice as wide as the ball."""
    flat = replace(
        B218, inner_groove_radius=22.225e-3, outer_groove_radius=22.225e-3, free_contact_angle=0.0, kind="deep_groove"
    )
    solution = solved(resting(flat, axial_displacement=0.0, radial_load_y=100.0, speed=10.0, **UPRIGHT))
    found = qs.readings.film(solution, THIN).outer
    k = solution.outer.semi_major_axis[0] / solution.outer.semi_minor_axis[0]
    assert k < 1.8
    g, D, E = 22.225 / 125.26, 22.225e-3, float(B218.effective_modulus)
    Rx = 0.5 * D * (1 + g)
    u = qs.readings.kinematics(solution).outer.entrainment_speed[0]
    U, G, W = 0.02 * u / (E * Rx), 2e-8 * E, solution.outer.load[0] / (E * Rx**2)
    least = 3.63 * U**0.68 * G**0.49 * W**-0.073 * (1 - np.exp(-0.68 * k))
    central = 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1 - 0.61 * np.exp(-0.73 * k))
    assert found.minimum_thickness[0] == pytest.approx(Rx * least, rel=1e-12)
    assert found.central_thickness[0] == pytest.approx(Rx * central, rel=1e-12)


def test_load_hardly_thins_the_film() -> None:
    """W^-0.073 at a fixed angle."""
    scene = resting(
        DEEP_GROOVE, axial_displacement=0.0, radial_load_y=np.array([500.0, 5000.0]), speed=300.0, **UPRIGHT
    )
    h = qs.readings.film(solved(scene), THIN).inner.minimum_thickness[:, 0]
    assert h[1] / h[0] == pytest.approx(10**-0.073, rel=1e-9)


def test_each_ball_has_its_own_film() -> None:
    solution = solved(turning(8e3, axial_load=12e3, radial_load_y=4e3, moment_z=0.0))
    found = qs.readings.film(solution, THIN)
    assert np.ptp(found.inner.minimum_thickness) > 0.0
    assert (found.inner.minimum_thickness < found.inner.central_thickness).all()
    assert found.inner.film_parameter is None
    assert found.inlet_shear_heating is None
    assert found.warnings == ()


def test_what_the_film_is_warned_of() -> None:
    solution = solved(turning(np.array([100.0, 12e3]), axial_load=12e3))
    oil = Lubricant.from_grade(68).at(343.15)
    found = qs.readings.film(solution, oil, ball_roughness=0.1e-6, raceway_roughness=0.3e-6)
    words = " | ".join(found.warnings)
    assert "estimate" in words
    assert "1 of 2 cases, the first 0: a film parameter" in words
    assert "1 of 2 cases, the first 1: inlet heating reduces the film of an inner contact" in words
    assert found.inner.thermal_reduction is not None
    assert found.outer.film_parameter == pytest.approx(
        found.outer.minimum_thickness * found.outer.thermal_reduction / np.hypot(0.1e-6, 0.3e-6)
    )
    for raceway in (found.inner, found.outer):
        assert raceway.reduced_minimum_thickness == pytest.approx(raceway.minimum_thickness * raceway.thermal_reduction)
        assert raceway.film_parameter == pytest.approx(raceway.reduced_minimum_thickness / found.combined_roughness)
    assert sum("12 %" in sentence for sentence in found.warnings) == 2
    skf = qs.readings.film(solution, OilState(oil.dynamic_viscosity, 2e-8, oil.kinematic_viscosity))
    assert skf.inner.thermal_reduction is None
    assert skf.inner.reduced_minimum_thickness is None
    assert skf.combined_roughness is None
    assert any(sentence.startswith("1 of 2 cases, the first 1: SKF") for sentence in skf.warnings)


def test_the_heat_of_the_inlet_as_its_sources_have_it() -> None:
    """By hand, with the sum of both surfaces' speeds; a slow contact is not heated."""
    solution = solved(turning(np.array([1e-3, 10e3]), axial_load=12e3))
    oil = OilState(0.05, 2e-8, temperature_viscosity=0.04, thermal_conductivity=0.13)
    found = qs.readings.film(solution, oil).inner
    u = qs.readings.kinematics(solution).inner.entrainment_speed
    L = 0.04 * 0.05 * (2 * u) ** 2 / 0.13
    assert found.thermal_reduction == pytest.approx(1 / (1 + 0.1 * L**0.64), rel=1e-12)
    assert found.thermal_reduction is not None
    assert found.thermal_reduction[0, 0] == pytest.approx(1.0, abs=1e-6)
    assert found.thermal_reduction[1, 0] < 0.7
    assert found.minimum_thickness == pytest.approx(
        qs.readings.film(solution, THIN).inner.minimum_thickness * 2.5**0.68
    )


# ---------------------------------------------------------------------------------------------------------------- oils


@pytest.mark.parametrize(("cold", "hot", "index"), [(73.30, 8.86, 92), (22.83, 5.05, 156), (53.47, 7.80, 111)])
def test_viscosity_index_of_the_standard_s_examples(cold: float, hot: float, index: int) -> None:
    """ASTM D2270's own three, printed as whole numbers."""
    assert lubricant.viscosity_index(cold, hot) == pytest.approx(index, abs=0.5)
    assert lubricant.viscosity_at_100(cold, lubricant.viscosity_index(cold, hot)) == pytest.approx(hot, rel=1e-9)


def test_an_oil_goes_through_its_points() -> None:
    oil = Lubricant((313.15, 373.15), (68e-6, 8.5e-6))
    assert oil.kinematic_viscosity(np.array([313.15, 373.15])) == pytest.approx([68e-6, 8.5e-6], rel=1e-12)
    between = oil.kinematic_viscosity(np.linspace(290.0, 400.0, 50))
    assert (np.diff(between) < 0.0).all()
    state = oil.at(313.15)
    assert state.dynamic_viscosity == pytest.approx(68e-6 * (870 - 0.7 * 25), rel=1e-12)
    assert state.is_estimated
    assert not Lubricant((313.15, 373.15), (68e-6, 8.5e-6), pressure_viscosity=2e-8).at(313.15).is_estimated


def test_how_an_oil_heats() -> None:
    """beta is the slope of ln nu; a mineral oil conducts 0.13 to 0.14 W/(m K), less when warm."""
    oil, h = Lubricant.from_grade(68), 1e-3
    for T in (290.0, 313.15, 360.0):
        colder, warmer = (float(oil.kinematic_viscosity(T + step)) for step in (-h, h))
        assert oil.temperature_viscosity(T) == pytest.approx(-np.log(warmer / colder) / (2 * h), rel=1e-7)
    conductivity = lubricant.thermal_conductivity(np.array([273.15, 373.15]), 870.0)
    assert conductivity == pytest.approx([0.12 / 0.87, 0.12 / 0.87 * (1 - 0.05 / 3)])


def test_grades() -> None:
    """VG 68 with index 95: 68 mm^2/s at 40 C; the reference oils' table has no jump between its rows."""
    oil = Lubricant.from_grade(68)
    assert oil.viscosities[0] == pytest.approx(68e-6)
    assert lubricant.viscosity_index(68.0, oil.viscosities[1] * 1e6) == pytest.approx(95.0)
    borders = lubricant._INDEX[1:, 0]
    for border in borders:
        below, above = (np.array(lubricant._reference_oils(border * (1 + h))) for h in (-1e-12, 1e-12))
        assert above == pytest.approx(below, rel=3e-3)  # the standard's own rows meet to 0.3 %


def test_bad_oils_name_every_fault() -> None:
    with pytest.raises(qs.SceneError) as caught:
        Lubricant((40.0, 373.15), (68.0, 8.5e-6), density=0.87)
    fields = {error.field for error in caught.value.errors}
    assert fields == {"temperatures[0]", "viscosities[0]", "density"}
    with pytest.raises(qs.SceneError, match="do not fall"):
        Lubricant((373.15, 313.15), (8.5e-6, 68e-6))
    with pytest.raises(qs.SceneError, match="not an oil temperature"):
        Lubricant.from_grade(68).at(70.0)
    with pytest.raises(qs.SceneError, match="grade"):
        Lubricant.from_grade(1.0)
    with pytest.raises(qs.SceneError, match="dynamic_viscosity"):
        qs.readings.film(solved(resting(B218, axial_load=1e3)), OilState(-0.02, 2e-8))
