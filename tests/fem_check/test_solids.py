"""True bodies: curved elements, rigid motions, exact surfaces, the contact condition."""

from math import pi, radians

import numpy as np
import pytest
import scipy.sparse as sp

from fem_check import meshing
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.independent.references import hertz
from fem_check.meshing import MeshError
from fem_check.product.scenes import drawing_at_rest, groove_contact, load_scene
from fem_check.solids import bodies, contact_results, normal_contact
from fem_check.solids.bodies import RingSection
from fem_check.solids.body_mesh import BodyMesh
from fem_check.solids.condensation import condense_free
from fem_check.solids.contact_block import Patch
from fem_check.solids.contact_frame import ContactFrame, Sphere, Torus
from fem_check.solids.half_space_sector import half_spaces
from fem_check.solids.tetrahedral_body import TetrahedralBody

needs_gmsh = pytest.mark.skipif(meshing.gmsh_problem() is not None, reason=str(meshing.gmsh_problem()))
STEEL = ElasticConstants(208e9, 0.3)
RADIUS = 11.1125e-3
ANGLE = radians(40.0)
UP = np.array([np.sin(ANGLE), np.cos(ANGLE)])


@pytest.fixture(scope="module")
def frame():
    """The outer contact of B218, overlapping by 10 um."""
    groove = Torus(np.array([0.0, 62.63e-3 - 0.5156e-3 * UP[1]]), 11.6281e-3)
    ball = Sphere(groove.centre + (0.5156e-3 + 10e-6) * UP, RADIUS)
    return ContactFrame(ball, groove, UP, Patch(UP, 2.0e-3, 0.29e-3), 3, 0.5)


@pytest.fixture(scope="module")
def ball():
    mesh = bodies.ball(RADIUS, [Patch(UP, 2.0e-3, 0.29e-3), Patch(-UP, 2.0e-3, 0.25e-3)], 2)
    return TetrahedralBody(mesh, STEEL)


@needs_gmsh
def test_curved_elements_fill_the_ball_and_pass_the_patch_test(ball):
    volume = ball.mass.sum() / 3.0
    # Quadratic facets miss a sphere's volume by the fourth power of their angle: 0.25 rad here, 1e-4.
    assert volume == pytest.approx(2.0 / 3.0 * pi * RADIUS**3, rel=3e-4)
    gradient = np.array([[1.0, 0.3, -0.2], [0.1, -0.5, 0.4], [0.7, 0.2, 0.9]])
    displacement = (gradient @ ball.nodes).T.ravel()
    forces = (ball.stiffness @ displacement).reshape(-1, 3)
    inside = np.setdiff1d(
        np.arange(ball.space.count), ball.mesh.dofs.get_facet_dofs(ball.mesh.boundary_facets()).flatten()
    )
    assert np.abs(forces[inside]).max() < 1e-9 * np.abs(forces).max()
    strain = 0.5 * (gradient + gradient.T)
    lame, shear = 208e9 * 0.3 / (1.3 * 0.4), 208e9 / 2.6
    energy = 0.5 * lame * np.trace(strain) ** 2 + shear * (strain * strain).sum()
    assert 0.5 * displacement @ ball.stiffness @ displacement == pytest.approx(energy * volume, rel=1e-6)


@needs_gmsh
def test_a_rigid_motion_costs_nothing_and_shows_nothing(ball):
    x, y, _ = ball.nodes
    turned = np.stack([-y, x, np.zeros_like(x)], axis=1).ravel()
    moved = np.tile([1.0, -2.0, 0.0], ball.space.count)
    size = abs(ball.stiffness).max()
    assert np.abs(ball.stiffness @ moved).max() < 1e-9 * size
    assert np.abs(ball.stiffness @ turned).max() < 1e-9 * size * RADIUS
    # A body force alone is all balanced: it leaves no displacement.
    free = condense_free(ball, sp.csr_matrix(np.stack([ball.mass @ moved, ball.mass @ turned], axis=1)))
    pushed = np.zeros(3 * ball.space.count)
    pushed[3 * np.argmax(x)] = 1.0
    some = condense_free(ball, sp.csr_matrix(pushed[:, None])).flexibility[0, 0]
    weight = (ball.mass @ moved).sum() ** 2
    assert np.abs(free.flexibility).max() < 1e-9 * some * weight


@needs_gmsh
def test_surface_loads_add_up_to_the_pressure(ball, frame):
    centred = TetrahedralBody(bodies.ball(RADIUS, [frame.patch], 2).shifted(np.array([*frame.ball.centre, 0.0])), STEEL)
    x, y = frame.basis.points
    pressure = np.maximum(0.0, 1.0 - (x / frame.basis.lines_x[-1]) ** 2 - (y / frame.patch.half_width) ** 2)
    forces = (frame.loads(centred, on_ball=True) @ pressure).reshape(-1, 3).sum(axis=0)
    expected = -0.5 * frame.resultants @ pressure
    # What separates them is the quadrature over cells that do not match the facets, here at their coarsest.
    assert forces[:2] == pytest.approx(expected, abs=1e-3 * np.hypot(*expected))


def test_half_spaces_under_the_pressure_functions_move_as_a_half_space():
    """Hertz's pressure on its ellipse moves the contact's middle by the approach less the parabola's gap."""
    groove = groove_contact("b218", "outer")
    problem = groove.problem(1000.0)
    exact = hertz(problem)
    normal = np.array([np.sin(groove.contact_angle), np.cos(groove.contact_angle)])
    patch = Patch(normal, exact.semi_major_axis, exact.semi_minor_axis, 1.0)
    centre = np.array([0.0, 0.5 * groove.pitch_diameter])
    torus = Torus(centre + (groove.ball_radius - groove.groove_radius) * normal, groove.groove_radius)
    of = ContactFrame(Sphere(centre, groove.ball_radius), torus, normal, patch, 8, 0.5)
    x, y = of.basis.points
    left = 1.0 - (x / exact.semi_major_axis) ** 2 - (y / exact.semi_minor_axis) ** 2
    pressure = exact.max_pressure * np.sqrt(np.maximum(left, 0.0))
    work = float(pressure @ half_spaces(of, drawing_at_rest(load_scene("b218"), "b218")) @ pressure)
    gap = float(of.basis.weighted(problem.parabolic_gap) @ pressure)
    force = float(of.basis.forces @ pressure)
    # Eight bilinear cells on a pressure with an upright edge, and a slope of a/R = 0.15: a per cent.
    assert (work + gap) / force == pytest.approx(exact.approach, rel=0.01)


def test_heights_are_those_of_sphere_and_torus(frame):
    xi, eta = np.meshgrid(np.linspace(-2.5e-3, 2.5e-3, 9), np.linspace(0.0, 1e-3, 5))
    xi, eta = xi.ravel(), eta.ravel()
    for _, normals in (frame.ball_height(xi, eta), frame.groove_height(xi, eta)):
        assert np.linalg.norm(normals, axis=0) == pytest.approx(1.0)
    zeta = frame.groove_height(xi, eta)[0]
    plane = frame.origin[:, None] + np.outer(frame.tangent, xi) + np.outer(frame.normal, zeta)
    reach = np.hypot(plane[1], eta)
    off = np.hypot(plane[0] - frame.groove.centre[0], reach - frame.groove.centre[1]) - frame.groove.radius
    assert np.abs(off).max() < 1e-15
    # The overlap at the centre is the one built in.
    assert frame.gap(np.zeros(1), np.zeros(1))[0] == pytest.approx(-10e-6, rel=1e-6)


def test_gap_curvatures_are_those_of_hertz(frame):
    problem = groove_contact("b218", "outer").problem(1.0)
    h = 1e-5
    x, y = (
        (frame.gap(np.array([a]), np.array([b]))[0] - frame.gap(np.zeros(1), np.zeros(1))[0]) * 2.0 / h**2
        for a, b in ((h, 0.0), (0.0, h))
    )
    assert x == pytest.approx(problem.curvature_x, rel=1e-3)
    # Here the ball stands 10 um deep in the groove: 1e-4 of the radius from the axis.
    assert y == pytest.approx(problem.curvature_y, rel=1e-3)


def test_pressures_satisfy_the_contact_condition():
    rng = np.random.default_rng(1)
    root = rng.normal(size=(40, 40))
    flexibility = root @ root.T + 0.1 * np.eye(40)
    gaps = rng.normal(size=40)
    contact = normal_contact.solve(flexibility, gaps)
    left = flexibility @ contact.pressures + gaps
    assert contact.pressures.min() >= 0.0 and left.min() > -1e-10
    assert np.abs(contact.pressures * left).max() < 1e-9
    assert 0 < contact.active.sum() < 40


def test_hertz_pressure_is_read_back(frame):
    exact = hertz(groove_contact("b218", "outer").problem(1500.0))
    fine = ContactFrame(
        frame.ball, frame.groove, frame.normal, Patch(UP, exact.semi_major_axis, exact.semi_minor_axis), 12, 0.5
    )
    x, y = fine.basis.points
    inside = 1.0 - (x / exact.semi_major_axis) ** 2 - (y / exact.semi_minor_axis) ** 2
    contact = contact_results.read(fine, exact.max_pressure * np.sqrt(np.maximum(inside, 0.0)))
    # Linear interpolation of a pressure with an upright edge: 12 cells per semi-axis leave a third of a per cent.
    assert contact.semi_major_axis == pytest.approx(exact.semi_major_axis, rel=4e-3)
    assert contact.semi_minor_axis == pytest.approx(exact.semi_minor_axis, rel=4e-3)
    assert contact.max_pressure == pytest.approx(exact.max_pressure, rel=4e-3)
    # The normals turn with the surfaces, so the resultant is a little less than the sum of the pressure.
    assert contact.load == pytest.approx(1500.0, rel=6e-3)
    assert contact.angle == pytest.approx(ANGLE, abs=2e-4)


@needs_gmsh
def test_a_contact_over_the_shoulder_is_refused():
    section = RingSection(np.array([0.0, 62e-3]), 11.6e-3, 80e-3, 30e-3, is_inner=False)
    with pytest.raises(MeshError, match="does not fit a groove"):
        bodies.ring(section, Patch(section.direction(radians(65.0)), 2e-3, 0.3e-3), pi / 16, 2)


def test_a_damaged_mesh_is_named(tmp_path):
    path = tmp_path / "ball.npz"
    path.write_bytes(b"nothing")
    with pytest.raises(MeshError, match=r"ball\.npz is not a mesh"):
        BodyMesh.read(path)
