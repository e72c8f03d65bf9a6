"""A solution as a user reads it: as text, stiffness and compliance, as a table."""

from __future__ import annotations

import dataclasses
import gc
import weakref

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.remarks.of_solution import warnings
from tests.qsbearing.scenes import B218, BOTH, OUTER, solved, turning

COMBINED = qs.Scene(
    B218, qs.Operation(speed=10_000 * qs.rpm, axial_load=3e3, radial_load_y=4e3, tilt_z=0.0), BOTH, OUTER
)
# The last row is pulled apart.
MANY = qs.Scene(
    B218,
    qs.Operation(
        speed=np.array([1e3, 5e3]) * qs.rpm,
        axial_load=np.array([[8e3], [3e3], [-10.0]]),
        radial_load_y=np.array([0.0, 4e3]),
        moment_z=0.0,
    ),
    BOTH,
    OUTER,
)


@pytest.fixture(scope="module")
def one() -> qs.Solution:
    return qs.solve(COMBINED)


@pytest.fixture(scope="module")
def many() -> qs.Solution:
    return qs.solve(MANY)


# As text --------------------------------------------------------------------------------------------------------------


def test_a_single_solution_prints_what_came_out(one: qs.Solution) -> None:
    text = str(one)
    assert text.startswith(f"Solution of B218: converged, {one.iterations} iterations, residual ")
    assert f"axial_um {one.displacement[0] / qs.um:.6g}" in text
    assert f"largest load {one.outer.load.max():.6g} N" in text
    low, high = (f"{angle / qs.deg:.5g}" for angle in (one.outer.angle.min(), one.outer.angle.max()))
    assert f"outer raceway: largest load {one.outer.load.max():.6g} N, contact angle {low} to {high} deg" in text
    assert len(text.splitlines()) == 5


def test_no_load_is_printed_as_a_negative_zero() -> None:
    held = dataclasses.replace(COMBINED.operation, radial_displacement_z=0.0, tilt_y=0.0)
    solution = qs.solve(dataclasses.replace(COMBINED, operation=held))
    assert np.signbit(solution.load[2])
    assert "radial_z_N 0, moment_y_Nm 0," in str(solution)


def test_an_unsolved_one_prints_why() -> None:
    solution = qs.solve(qs.Scene(B218, qs.Operation(axial_load=-1e3)))
    assert str(solution).endswith("no_equilibrium, 0 iterations, residual inf, open_side") or "open_side" in str(
        solution
    )


def test_many_print_their_counts_and_the_first_that_failed(many: qs.Solution) -> None:
    assert str(many) == "Solution of B218: 6 cases (3, 2), 4 converged, 2 no_equilibrium (the first: (2, 0))"


# Stiffness and compliance ---------------------------------------------------------------------------------------------


def test_stiffness_is_that_of_the_function(one: qs.Solution, many: qs.Solution) -> None:
    assert np.array_equal(one.stiffness, qs.stiffness(COMBINED, one))
    assert many.stiffness.shape == (3, 2, 5, 5)
    assert np.isnan(many.stiffness[2]).all()
    alone = dataclasses.replace(MANY.operation, speed=5e3 * qs.rpm, axial_load=3e3, radial_load_y=4e3)
    single = qs.solve(dataclasses.replace(MANY, operation=alone))
    np.testing.assert_allclose(many.stiffness[1, 1], single.stiffness, rtol=1e-9, atol=1e-6 * single.stiffness.max())


def test_an_equal_scene_is_as_good_as_the_same(many: qs.Solution) -> None:
    copy = dataclasses.replace(MANY, operation=dataclasses.replace(MANY.operation, speed=MANY.operation.speed.copy()))
    assert copy is not MANY
    assert np.array_equal(qs.stiffness(copy, many), many.stiffness, equal_nan=True)
    other = dataclasses.replace(MANY, operation=dataclasses.replace(MANY.operation, speed=1.0))
    for scene in (other, COMBINED, dataclasses.replace(MANY, ball_effects=BOTH[:1])):
        with pytest.raises(ValueError, match=r"solution\.stiffness"):
            qs.stiffness(scene, many)


def test_compliance_is_how_the_free_channels_give() -> None:
    """Against the change of displacement between two solutions; a prescribed displacement has no compliance."""
    operation = qs.Operation(
        speed=5000 * qs.rpm, axial_load=8e3, radial_load_y=2e3, radial_displacement_z=1e-6, moment_z=5.0, moment_y=0.0
    )
    step = np.array([3.0, 4.0, 0.0, 0.1, -0.2])

    def moved(part: float) -> np.ndarray:
        names = {0: "axial_load", 1: "radial_load_y", 3: "moment_y", 4: "moment_z"}
        loads = {name: getattr(operation, name) + part * step[i] for i, name in names.items()}
        return qs.solve(qs.Scene(B218, dataclasses.replace(operation, **loads), BOTH, OUTER)).displacement

    compliance = qs.solve(qs.Scene(B218, operation, BOTH, OUTER)).compliance
    free = [0, 1, 3, 4]
    expected = compliance[np.ix_(free, free)] @ step[free]
    np.testing.assert_allclose((moved(0.5) - moved(-0.5))[free], expected, rtol=1e-5, atol=1e-13)
    assert np.isnan(compliance[2]).all()
    assert np.isnan(compliance[:, 2]).all()


def test_locked_and_effective_stiffness_are_what_neighbouring_solves_show() -> None:
    """One newton more in y: with all else held it moves by the locked stiffness, with the other loads kept by far more.

    Tolerance: of a central difference over a step of 1e-4 of the load.
    """
    operation = qs.Operation(axial_load=8e3, radial_load_y=2e3, radial_displacement_z=0.0, moment_z=0.0, tilt_y=0.0)
    scene = qs.Scene(B218, operation)
    solution = qs.solve(scene)
    x, _, _, _, tilt = solution.displacement
    held = qs.Operation(axial_displacement=x, radial_load_y=2e3, radial_displacement_z=0.0, tilt_y=0.0, tilt_z=tilt)

    def rate(kept: qs.Operation) -> float:
        loads = 2e3 + np.array([-0.1, 0.1])
        moved = qs.solve(qs.Scene(B218, dataclasses.replace(kept, radial_load_y=loads))).displacement[:, 1]
        return float(0.2 / (moved[1] - moved[0]))

    locked, effective = solution.locked_stiffness, solution.effective_stiffness
    assert rate(operation) == pytest.approx(effective[1], rel=1e-6)
    assert rate(held) == pytest.approx(locked[1], rel=1e-6)
    assert effective[1] < 0.5 * locked[1]
    assert np.isnan(effective[[2, 3]]).all(), "a prescribed displacement has none"
    assert np.isfinite(locked).all()


def test_compliance_where_there_is_none(many: qs.Solution) -> None:
    """Not solved; nothing free; a direction that nothing resists: one ball does not resist a radial load across it."""
    assert np.isfinite(many.compliance[:2]).all()
    assert np.isnan(many.compliance[2]).all()
    held = qs.Operation(
        axial_displacement=2e-5, radial_displacement_y=0.0, radial_displacement_z=0.0, tilt_y=0.0, tilt_z=0.0
    )
    assert np.isnan(qs.solve(qs.Scene(B218, held)).compliance).all()
    single = dataclasses.replace(B218, ball_count=1)
    operation = qs.Operation(axial_displacement=2e-5, radial_displacement_y=0.0, tilt_y=0.0, tilt_z=0.0)
    solution = qs.solve(qs.Scene(single, operation))
    assert solution.converged
    assert np.isnan(solution.compliance).all()
    assert any("displacement of the ring in radial z" in sentence for sentence in qs.warnings(solution))


# As a table -----------------------------------------------------------------------------------------------------------


def test_a_dataframe_holds_results_status_and_inputs(many: qs.Solution) -> None:
    frame = pytest.importorskip("pandas") and many.to_dataframe()
    assert len(frame) == 6 * 16, "a case that is not solved keeps its rows"
    case = frame[(frame["case_0"] == 1) & (frame["case_1"] == 1)]
    assert list(case["ball"]) == list(range(16))
    np.testing.assert_allclose(case["outer_load_N"], many.outer.load[1, 1])
    np.testing.assert_allclose(case["inner_angle_deg"], many.inner.angle[1, 1] / qs.deg)
    np.testing.assert_allclose(case["orbital_speed_rpm"], many.orbital_speed[1, 1] / qs.rpm)
    expected = {
        "ring_displacement_radial_y_um": many.displacement[1, 1, 1] / qs.um,
        "ring_load_axial_N": 3e3,
        "ring_locked_stiffness_tilt_z_Nm_per_mrad": many.stiffness[1, 1, 4, 4] * qs.mrad,
        "ring_effective_stiffness_radial_y_N_per_um": qs.um / many.compliance[1, 1, 1, 1],
        "ring_stiffness_SI_axial_by_tilt_z": many.stiffness[1, 1, 0, 4],
        "status": "converged",
        "reason": "",
        "bearing": "B218",
        "speed_rpm": 5000.0,
        "axial_load_N": 3000.0,
        "radial_load_y_N": 4000.0,
        "moment_z_Nm": 0.0,
        "ball_diameter_mm": 22.225,
        "free_contact_angle_deg": 40.0,
        "ring_material_elastic_modulus_GPa": 208.0,
    }
    for name, value in expected.items():
        assert (case[name] == value).all() or np.allclose(case[name].astype(float), value, rtol=1e-12), name
    unsolved = frame[frame["case_0"] == 2]
    assert (unsolved["status"] == "no_equilibrium").all()
    assert (unsolved["reason"] == "open_side").all()
    assert (
        unsolved[["outer_load_N", "ring_displacement_axial_um", "ring_locked_stiffness_axial_N_per_um"]]
        .isna()
        .all(axis=None)
    )
    assert (unsolved["axial_load_N"] == -10.0).all()


def test_an_array_that_no_result_depends_on_spans_cases_like_any_other() -> None:
    """The ring's density: one case for each, and a row of the table for each ball of them."""
    rings = dataclasses.replace(qs.STEEL, density=np.array([7800.0, 7900.0]))
    solution = qs.solve(dataclasses.replace(COMBINED, bearing=dataclasses.replace(B218, ring_material=rings)))
    assert solution.shape == (2,)
    assert np.array_equal(solution.inner.load[0], solution.inner.load[1])
    assert len(pytest.importorskip("pandas") and solution.to_dataframe()) == 32


def test_a_dataframe_has_no_column_for_what_is_not_asked_for() -> None:
    pytest.importorskip("pandas")
    solution = qs.solve(qs.Scene(dataclasses.replace(B218, ball_count=np.array([9, 12])), qs.Operation(axial_load=1e3)))
    frame = solution.to_dataframe()
    assert len(frame) == 9 + 12
    left_out = {"centrifugal_force_N", "raceway_control", "inner_required_friction", "radial_load_y_N", "tilt_z_mrad"}
    assert not left_out & set(frame)


@pytest.mark.parametrize("hertz_angle", ["free", "actual"])
def test_ellipses_of_bearings_that_vary(hertz_angle: str) -> None:
    """Each case has its own bearing's ellipses, whatever stood before it in the batch."""
    radius = np.array([11.4, 11.6281, 11.6281, 12.0]) * 1e-3
    pitch = np.array([125.26, 125.26, 130.0, 130.0]) * 1e-3
    angle = np.array([40.0, 40.0, 40.0, 25.0]) * qs.deg
    changes = {"inner_groove_radius": radius, "pitch_diameter": pitch, "free_contact_angle": angle}
    together = solved(turning(6e3, dataclasses.replace(B218, **changes), axial_load=9e3, hertz_angle=hertz_angle))
    for k in range(4):
        one = dataclasses.replace(B218, **{name: float(values[k]) for name, values in changes.items()})
        alone = solved(turning(6e3, one, axial_load=9e3, hertz_angle=hertz_angle))
        for name in ("semi_major_axis", "semi_minor_axis", "max_pressure"):
            for side in ("inner", "outer"):
                found = getattr(getattr(together, side), name)[k]
                assert found == pytest.approx(getattr(getattr(alone, side), name), rel=1e-9), (name, side)


def test_a_solution_is_freed_when_it_is_let_go() -> None:
    """By its last reference, and not when the garbage collector comes by: chunks of a study would pile up."""
    solution = qs.solve(MANY)
    contacts, freed = solution.outer, weakref.ref(solution)
    assert solution.outer.load is contacts.load, "read once"
    assert solution.inner.required_friction is solution.inner.required_friction
    assert solution.effective_stiffness.shape == (3, 2, 5)
    assert solution.operating_point.load.shape == (3, 2, 16)
    assert warnings(solution)
    gc.disable()
    try:
        del solution
        assert freed() is not None
        assert contacts.angle.shape == (3, 2, 16), "the contacts hold it as long as they are held"
        del contacts
        assert freed() is None
    finally:
        gc.enable()
