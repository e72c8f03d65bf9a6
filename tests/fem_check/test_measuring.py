"""How the largest pressure is read: from the pressure, exactly for Hertz's."""

from types import SimpleNamespace

import numpy as np
import pytest

from fem_check.checks import load_power_law
from fem_check.elements.pressure_basis import PressureBasis
from fem_check.independent.contact_problem import QUANTITIES
from fem_check.independent.references import hertz
from fem_check.mechanics import boundary_element, contact, half_space_contact, measuring
from fem_check.mechanics.measuring import Measured, Soundness
from fem_check.product.scenes import groove_contact
from fem_check.rows import convergence


def grid(points):
    index = (np.arange(points) - points // 2) / (points // 2.4)
    return tuple(part.ravel() for part in np.meshgrid(index, index, indexing="ij"))


def test_hertz_pressure_is_read_exactly():
    x, y = grid(41)
    pressure = 3.0 * np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0))
    assert measuring.central_pressure(x, y, np.ones_like(x), pressure) == pytest.approx(3.0, rel=1e-13)


def test_a_slanted_pressure_is_read_exactly():
    x, y = grid(41)
    pressure = 3.0 * np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0)) * (1.0 + 0.02 * x + 0.1 * x**2 - 0.05 * y**2)
    shape = measuring.central_shape(x, y, np.ones_like(x), pressure)
    assert shape == pytest.approx((3.0, 0.02, 0.1), rel=1e-10)


def test_semi_axes_of_hertz_pressure():
    # Of a bilinear pressure on 200 elements per semi-axis, whose last ring of elements holds 1e-5 of the moments.
    lines = np.arange(0.0, 1.25, 0.005)
    basis = PressureBasis(lines, lines)
    pressures = np.sqrt(np.maximum(1.0 - (basis.points**2).sum(axis=0), 0.0))[:, None]
    of = SimpleNamespace(basis=basis, pressures=pressures, unit_lengths=np.array([3.0]))
    a, b = measuring.ellipse(of)
    assert (a[0], b[0]) == pytest.approx((3.0, 3.0), rel=1e-4)


def test_without_an_ellipse_nothing_is_read_but_the_approach():
    # Tension far out makes the second moments negative.
    lines = np.arange(0.0, 1.25, 0.05)
    basis = PressureBasis(lines, lines)
    square = (basis.points**2).sum(axis=0)
    pressures = np.where(square < 0.8, 1.0, -0.5)[:, None]
    of = SimpleNamespace(
        basis=basis,
        pressures=pressures,
        unit_lengths=np.ones(1),
        approaches=np.ones(1),
        penetration=0.0,
        load_error=0.0,
    )
    assert basis.forces @ pressures[:, 0] > 0.0
    body = SimpleNamespace(asymmetry=0.0, reaction=-basis.forces)
    by_quantity = measuring.measure(of, body, body).each
    assert {name for name, values in by_quantity.items() if np.isnan(values).all()} == set(QUANTITIES) - {"approach"}


@pytest.mark.parametrize("elements", [6, 12])
def test_hertz_pressure_sampled_on_the_mesh(elements):
    # Straight lines between the nodes cut the rounded top: h^2/12 of its curvature, which is 1 at the centre and twice
    # that at the edge of the fit, in each of two directions.
    lines = np.arange(0.0, 1.25, 1.0 / elements)
    basis = PressureBasis(lines, lines)
    (x, y), area = basis.samples
    nodal = np.sqrt(np.maximum(1.0 - (basis.points**2).sum(axis=0), 0.0))
    central = measuring.central_pressure(x, y, area, basis.values(x, y) @ nodal)
    assert abs(central - 1.0) < 2.0 * 2.0 / (12.0 * elements**2)


def test_a_close_groove_is_read_within_the_gate():
    # Sampled finely, so that only the form of the fit is in question; 8000 N: 1.7 % off Hertz.
    groove = groove_contact("b218", "inner")
    problem = groove.problem(8000.0)
    exact = hertz(problem)
    a, b = exact.semi_major_axis, exact.semi_minor_axis
    points = 65
    index = (np.arange(points) - points // 2) * 2.3 / points
    x, y = np.meshgrid(index, index, indexing="ij")
    compliance = problem.ball.compliance + problem.race.compliance
    spacing = 2.3 / points
    pressure, _ = boundary_element.solve(
        groove.gap(a * x, b * y) / b, problem.load * compliance / b**2, (a / b * spacing, spacing)
    )
    read = measuring.central_pressure(x.ravel(), y.ravel(), np.ones(x.size), pressure.ravel())
    assert read == pytest.approx(pressure.max(), rel=1e-4)


def test_largest_pressure_is_not_load_over_ellipse():
    groove = groove_contact("b218", "inner")
    problem = groove.problem(5000.0)
    bodies = half_space_contact.condensed_bodies(problem, 6)
    unit = contact.edge_positions(hertz(problem).semi_minor_axis, bodies.edge_element)
    flexibility = contact.total_flexibility(problem, bodies.ball, bodies.race)
    read = []
    for gap in (groove.gap, None):
        solution = contact.solve(problem, bodies.basis, flexibility, unit, gap)
        read.append(measuring.measure(solution, bodies.ball, bodies.race).mean.max_pressure)
    reference = boundary_element.over_hertz(groove, 5000.0)
    # 0.05 points is the gate; 3Q/(2 pi a b) is 0.57 points too high.
    assert 100.0 * (read[0] / read[1] - reference.ratio["max_pressure"]) == pytest.approx(0.0, abs=0.05)


def test_values_that_agree_have_no_scatter_whatever_they_are():
    assert convergence.scatter([[0.0, 0.0], [2.0, 2.0, 2.0]]) == 0.0
    # Beside others they only add degrees of freedom.
    assert convergence.scatter([[0.0, 0.0], [1.0, 1.1]]) == convergence.scatter([[5.0, 5.0], [1.0, 1.1]]) > 0.0


def test_scatter_of_positions_is_the_largest_of_all_loads():
    # A swing of which eight positions keep one part in their mean, at a phase where half of them do not show it.
    def at(phase, size):
        swing = 0.01 * np.cos(np.pi * np.arange(8) + phase)
        each = dict.fromkeys(QUANTITIES, size * (1.0 + swing))
        return Measured(each, Soundness(0.0, 0.0, 0.0, 0.0))

    blind, seen = at(0.5 * np.pi, 1.0), at(0.0, 5.0)
    assert blind.position_uncertainty("approach") < 1e-12
    for series in ([blind, seen], [seen, blind]):
        assert load_power_law.position_scatter(series, "approach") == pytest.approx(0.01, rel=1e-9)


def test_meshes_too_near_the_finest_are_no_estimate():
    # Cells per half-side of the sector's patch with 2 to 5 elements a semi-axis: the last two differ by a fifth only.
    sizes, values = [1 / 3, 1 / 4, 1 / 5, 1 / 6], [0.6, 0.3, 0.54, 1.06]
    assert convergence.well_apart(sizes, values) == ([1 / 3, 1 / 4, 1 / 6], [0.6, 0.3, 1.06])
    assert convergence.uncertainty_at_order(*convergence.well_apart(sizes, values), 2.0) == pytest.approx(0.76)
    assert convergence.well_apart(sizes[:3], values[:3]) == (sizes[:3], values[:3])
