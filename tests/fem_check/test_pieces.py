"""Small parts: point load, basis, active set, solvers, convergence, rows."""

import sys
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.optimize import nnls

from fem_check.elements import boussinesq, elastic_body, linear_solver
from fem_check.elements.pressure_basis import PressureBasis
from fem_check.mechanics import contact
from fem_check.product.solution_equilibrium import compared_arrays
from fem_check.rows import convergence
from fem_check.rows.agreement import AgreementRow, collapsed, covered
from fem_check.rows.compared import compared


def test_point_load_on_the_surface_and_below():
    # Johnson 1985, eq. 3.22: u_z = (1-nu^2)/(pi E r) on the surface; below the load (1+nu)(3-2nu)/(2 pi E z).
    nu = 0.3
    zero = np.array([0.0])
    _, _, surface = boussinesq.point_load_displacement(np.array([2.0]), zero, zero, nu)
    assert surface[0] == pytest.approx((1 - nu**2) / (2.0 * np.pi))
    _, _, below = boussinesq.point_load_displacement(zero, zero, np.array([2.0]), nu)
    assert below[0] == pytest.approx((1 + nu) * (3 - 2 * nu) / (4.0 * np.pi))


def test_far_field_of_the_hats_is_that_of_their_force():
    basis = PressureBasis(np.linspace(0, 1, 4), np.linspace(0, 1, 4))
    points = np.array([[30.0, 0.0], [40.0, 0.0], [0.0, 50.0]])
    displacement = boussinesq.pressure_displacement(points, basis.samples[0], basis.loads, 0.3)
    whole = displacement.sum(axis=2)
    force = 4.0 * basis.forces.sum()
    single = np.stack(boussinesq.point_load_displacement(points[0], points[1], points[2], 0.3)) * force
    # The quadrupole of a patch of size 1 at distance 50: (1/50)^2.
    np.testing.assert_allclose(whole, single, rtol=2e-3, atol=1e-12)


def test_hats_integrate_exactly():
    basis = PressureBasis(np.array([0.0, 0.3, 1.0]), np.array([0.0, 0.6, 2.0]))
    x, y = np.meshgrid([0.0, 0.3, 1.0], [0.0, 0.6, 2.0], indexing="ij")
    inside = (x**2 + (y / 2.0) ** 2).ravel() <= 1.0 + 1e-9
    assert basis.points.shape[1] == inside.sum()
    # The hat at the origin is (1 - x/0.3)(1 - y/0.6): its volume and second moment by hand.
    assert basis.forces[0] == pytest.approx(0.3 * 0.6 / 4.0)
    assert basis.weighted(lambda x, y: x**2)[0] == pytest.approx(0.3**3 / 12.0 * 0.3)


def test_active_set_is_the_constrained_minimum():
    generator = np.random.default_rng(7)
    count = 30
    root = generator.normal(size=(count, count))
    flexibility = root @ root.T + count * np.eye(count)
    gaps, areas = generator.uniform(0, 3, count), generator.uniform(0.5, 1.5, count)
    pressure, (approach,), left = contact.active_set(flexibility, gaps, areas[:, None], np.array([0.2]), gaps < 1.0)
    # At its approach the pressure minimises the energy over p >= 0: another route to it, by least squares.
    factor = np.linalg.cholesky(flexibility)
    other, _ = nnls(factor.T, np.linalg.solve(factor, approach * areas - gaps))
    np.testing.assert_allclose(pressure, other, atol=1e-9)
    assert areas @ pressure == pytest.approx(0.2)
    assert pressure.min() >= 0.0
    assert left.min() >= -1e-9


@pytest.mark.parametrize("solver", ["rslab", "scipy SuperLU"])
def test_every_solver_solves(solver, monkeypatch):
    if solver != "rslab":
        monkeypatch.setitem(sys.modules, "rslab", None)  # as where it is not installed
    size = 200
    matrix = sp.diags([np.full(size - 1, -1.0), np.full(size, 2.5), np.full(size - 1, -1.0)], [-1, 0, 1]).tocsc()
    sides = np.random.default_rng(1).normal(size=(size, 3))
    factor = linear_solver.factorise(matrix)
    assert factor.solver == solver
    np.testing.assert_allclose(matrix @ factor.solve(sides), sides, atol=1e-12)
    np.testing.assert_allclose(matrix @ factor.solve(sides[:, 0]), sides[:, 0], atol=1e-12)
    stiffer = (matrix + sp.identity(size)).tocsc()  # of the same pattern
    np.testing.assert_allclose(stiffer @ linear_solver.factorise(stiffer).solve(sides), sides, atol=1e-12)


def test_a_pattern_is_analysed_once(monkeypatch):
    import rslab
    from skfem import MeshHex

    analysed, analyse = [], rslab.analyze
    monkeypatch.setattr(linear_solver, "_analyses", {})
    monkeypatch.setattr(rslab, "analyze", lambda *given, **named: analysed.append(1) or analyse(*given, **named))
    for size in (20, 20, 21, 20, 22, 23, 24, 20):  # four are kept
        linear_solver.factorise(sp.csc_matrix(sp.identity(size) * size))
    assert len(analysed) == 6
    bricks = [MeshHex().refined(1).scaled(each) for each in ((1.0, 1.0, 1.0), (8.0, 1.0, 1.0))]
    one, other = (elastic_body.stiffness(elastic_body.DisplacementSpace(brick), 0.3) for brick in bricks)
    np.testing.assert_array_equal(one.indices, other.indices)
    np.testing.assert_array_equal(one.indptr, other.indptr)


def row(value: float, tolerance: float | None) -> AgreementRow:
    return AgreementRow("case", "approach", "m", 2.0, "source", value, None, tolerance, "why")


def test_a_deviation_passes_only_with_its_uncertainty():
    deviating = replace(row(2.002, 0.2), uncertainty_percent=0.09)
    assert deviating.verdict == "pass"
    assert replace(deviating, uncertainty_percent=0.11).verdict == "fail"
    assert replace(deviating, uncertainty_percent=float("nan")).verdict == "fail"


def test_similar_rows_collapse_into_their_worst():
    light, heavy = (replace(row(value, 0.2), case=case) for value, case in ((2.001, "50 N"), (1.998, "500 N")))
    other = replace(row(2.0, 0.2), quantity="load")
    approach, load = collapsed([light, heavy, other], "50 to 500 N")
    assert (approach.found, approach.case, approach.worst_at) == (1.998, "50 to 500 N", "500 N")
    assert load.quantity == "load"
    hidden, _ = collapsed([replace(light, found=float("nan")), heavy, other], "50 to 500 N")
    assert hidden.verdict == "fail"


def test_an_array_is_judged_by_its_worst_element():
    expected = np.array([[1.0, -4.0], [3.0, 2.0]])
    good = compared("case", "load", "N", expected, expected, "source")
    assert (good.verdict, good.reference, good.found) == ("pass", 4.0, 4.0)
    for place in np.ndindex(expected.shape):
        for change in (-1e-6, 1e-6):
            one = expected.copy()
            one[place] += change
            judged = compared("case", "load", "N", one, expected, "source")
            assert judged.verdict == "fail", place
            assert judged.found == pytest.approx(4.0 + 1e-6)
            assert compared("case", "load", "N", one, expected, "source", 1e-6).verdict == "pass"
    assert compared("case", "load", "N", expected[0], expected, "source").verdict == "fail"  # not by chance of shapes
    arrays = compared_arrays("case", "load", "N", expected + np.array([[0.0, 1e-6], [0.0, 0.0]]), expected)
    assert (arrays.verdict, arrays.found) == ("fail", pytest.approx(4.0 + 1e-6))


def test_an_uncertainty_too_small_fails_of_itself():
    honest, short = (replace(row(2.002, 0.2), uncertainty_percent=told) for told in (0.11, 0.09))
    assert covered("case", [honest]).verdict == "pass"
    judged = covered("case", [honest, replace(short, quantity="load"), row(2.1, 0.2)])
    assert (judged.verdict, judged.worst_at) == ("fail", "load: case")
    assert judged.found == pytest.approx(0.1 / 0.09)
    for told in (0.0, float("nan")):
        assert covered("case", [honest, replace(short, uncertainty_percent=told)]).verdict == "fail"


def test_uncertainty_at_a_known_order_bounds_the_error():
    sizes = [0.25, 0.2, 0.125]
    values = [3.0 + 2.0 * h**3 for h in sizes]
    error = abs(values[-1] - 3.0)
    # Errors that fall faster than the order taken for granted are bounded, and not by much.
    assert error <= convergence.uncertainty_at_order(sizes, values, 2.5) <= 3.0 * error
    # Two meshes that agree by chance do not hide what the coarsest says.
    assert convergence.uncertainty_at_order(sizes, [3.1, 3.0, 3.0], 2.5) > 0.01
    assert convergence.largest_change([3.1, 3.0, 3.0]) == pytest.approx(0.1)


@pytest.mark.parametrize("order", [2.0, 2.2, 2.5])
def test_extrapolation_reaches_the_limit_within_its_uncertainty(order):
    sizes = [1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0]
    noise = np.array([0.0, 0.004, -0.004, 0.004])  # as meshes that are not similar scatter
    value, uncertainty = convergence.extrapolated(sizes, list(3.0 + 0.5 * np.array(sizes) ** order + noise))
    assert abs(value - 3.0) <= uncertainty < 0.03
    with pytest.raises(ValueError, match="at least three"):
        convergence.extrapolated(sizes[:2], [3.1, 3.0])


def test_verdicts():
    assert row(2.002, 0.2).verdict == "pass"
    assert row(2.01, 0.2).verdict == "fail"
    assert row(float("nan"), 0.2).verdict == "fail"
    assert row(2.5, None).verdict == "finding"
    assert row(2.002, 0.2).deviation_percent == pytest.approx(0.1)
