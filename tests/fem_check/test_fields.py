"""Fields of meshed bodies and their files: volumes, stresses of a known displacement, what ParaView reads."""

import itertools
from dataclasses import replace

import meshio
import numpy as np
import pytest

from fem_check import meshing
from fem_check.elements import elastic_body, fields
from fem_check.elements.element_family import SERENDIPITY
from fem_check.independent import references
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.mechanics import half_space_contact
from fem_check.product.scenes import groove_contact
from fem_check.solids.true_study import contacts

STEEL = ElasticConstants(208e9, 0.3)


@pytest.fixture(scope="module")
def study():
    return half_space_contact.mesh_study(groove_contact("b218", "inner").problem(1000.0), (3, 3))


@pytest.fixture(scope="module")
def block(study):
    return half_space_contact.field(study)


@pytest.fixture(scope="module")
def bodies():
    contact = contacts("b218", "inner", 2000.0, (3,))[0]
    exact = references.hertz(contact.groove.problem(2000.0))
    x, y = contact.frame.basis.points
    inside = 1.0 - (x / exact.semi_major_axis) ** 2 - (y / exact.semi_minor_axis) ** 2
    return contact.fields(exact.max_pressure * np.sqrt(np.clip(inside, 0.0, None))), contact


def volumes(path) -> np.ndarray:
    """Volume of each cell of a file by the shape functions of its kind as VTK numbers them; negative if mirrored."""
    mesh = meshio.read(path)
    (cells,) = mesh.cells
    _, corners, edges = fields.CELLS[cells.data.shape[1]]
    nodes = np.concatenate([corners, [corners[list(edge)].mean(axis=0) for edge in edges]])
    top = 1 if len(corners) == 4 else 2
    powers = [p for p in itertools.product(range(4), repeat=3) if sum(p) <= (2 if top == 1 else 4)]
    if top == 2:  # serendipity: superlinear degree two
        powers = [p for p in powers if sum(each for each in p if each > 1) <= 2 and max(p) <= 2]
    assert len(powers) == len(nodes)

    def table(points, derivative=None):
        columns = []
        for p in powers:
            factors = []
            for axis, power in enumerate(p):
                x = points[:, axis]
                factors.append(power * x ** max(power - 1, 0) if axis == derivative else x**power)
            columns.append(np.prod(factors, axis=0))
        return np.stack(columns, axis=1)

    coefficients = np.linalg.inv(table(nodes))  # of each shape function in powers
    gauss, weight = np.polynomial.legendre.leggauss(5)
    gauss, weight = 0.5 * (gauss + 1.0), 0.5 * weight
    u, v, w = (each.ravel() for each in np.meshgrid(gauss, gauss, gauss, indexing="ij"))
    weights = np.einsum("i,j,k->ijk", weight, weight, weight).ravel()
    points = np.stack([u, v, w], axis=1)
    if top == 1:  # the cube collapsed onto the tetrahedron
        points, weights = np.stack([u, v * (1 - u), w * (1 - u) * (1 - v)], axis=1), weights * (1 - u) ** 2 * (1 - v)
    slopes = np.stack([table(points, axis) @ coefficients for axis in range(3)])
    jacobian = np.einsum("aqs,csx->cqax", slopes, mesh.points[cells.data])
    return np.linalg.det(jacobian) @ weights


def test_bricks_of_the_half_space_have_positive_volumes_that_fill_the_block(block, tmp_path):
    block.write(tmp_path / "block.vtu")
    of_bricks = volumes(tmp_path / "block.vtu")
    assert of_bricks.min() > 0.0
    assert of_bricks.sum() == pytest.approx(np.prod(np.ptp(block.nodes, axis=1)), rel=1e-9)


def test_tetrahedra_of_the_true_bodies_have_positive_volumes_that_fill_them(bodies, tmp_path):
    by_name, contact = bodies
    by_name["ball"].write(tmp_path / "ball.vtu")
    by_name["ring"].write(tmp_path / "ring.vtu")
    ball = volumes(tmp_path / "ball.vtu")
    assert ball.min() > 0.0 and volumes(tmp_path / "ring.vtu").min() > 0.0
    # Half a ball, of which half is modelled; elements away from the contact are coarse, their curved faces are not.
    radius = 1e3 * contact.groove.ball_radius
    assert ball.sum() == pytest.approx(np.pi / 3.0 * radius**3, rel=2e-4)
    # The pressure that was put on, and the stress below it: Johnson, section 4.3.
    p0 = 1e-6 * references.hertz(contact.groove.problem(2000.0)).max_pressure
    for body in by_name.values():
        assert body.pressure.max() == pytest.approx(p0, rel=1e-6)  # meshes are kept in single precision
        assert 0.45 * p0 < body.von_mises.max() < 0.7 * p0


@pytest.mark.parametrize(
    ("components", "expected"),
    [
        ((3.0, 0.0, 0.0, 0.0, 0.0, 0.0), 3.0),
        ((2.0, 2.0, 2.0, 0.0, 0.0, 0.0), 0.0),
        ((0.0, 0.0, 0.0, 1.0, 0.0, 0.0), 3.0**0.5),
        ((0.0, 0.0, 0.0, 0.0, 2.0, 0.0), 2.0 * 3.0**0.5),
        ((5.0, 5.0, 5.0, 0.0, 0.0, -1.0), 3.0**0.5),
        ((4.0, 1.0, 0.0, 1.0, 2.0, 3.0), 55.0**0.5),
    ],
)
def test_von_mises_stress_of_plain_states(block, components, expected):
    """In tension the stress itself, under pressure all round none, in shear that times the root of 3; all together by
    hand, ((3^2 + 1^2 + 4^2)/2 + 3 (1 + 4 + 9))^0.5."""
    state = replace(block, stress=np.tile(np.array(components)[:, None], block.nodes.shape[1]))
    np.testing.assert_allclose(state.von_mises, expected, rtol=1e-12, atol=1e-12)


def test_stress_of_an_even_strain_is_hooke_s():
    mesh = meshing.load(meshing.half_space(3))
    space = elastic_body.DisplacementSpace(mesh, SERENDIPITY)
    strain = 1e-4 * np.array([[1.0, 0.3, -0.2], [0.3, -0.5, 0.4], [-0.2, 0.4, 0.7]])
    turned = strain + 1e-4 * np.array(
        [[0.0, 0.6, -0.1], [-0.6, 0.0, 0.2], [0.1, -0.2, 0.0]]
    )  # a rotation strains nothing
    expected = STEEL.elastic_modulus / 1.3 * (strain + 0.3 / 0.4 * np.trace(strain) * np.identity(3))
    stress = fields.stress(space, space.nodes.T @ turned, STEEL)
    components = [expected[each] for each in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))]
    np.testing.assert_allclose(stress, np.broadcast_to(np.array(components)[:, None], stress.shape), rtol=1e-9)


def test_the_file_of_a_half_space_holds_hertz(block, tmp_path):
    block.write(tmp_path / "block.vtu")
    data = meshio.read(tmp_path / "block.vtu").point_data
    exact = references.hertz(groove_contact("b218", "inner").problem(1000.0))
    p0 = 1e-6 * exact.max_pressure
    # One position of a coarse mesh, at its nodes: a few per cent.
    assert data["pressure_MPa"].max() == pytest.approx(p0, rel=0.05)
    assert data["von_mises_MPa"].max() == pytest.approx(0.58 * p0, rel=0.08)
    origin = int(np.argmin((block.nodes**2).sum(axis=0)))
    assert data["stress_MPa"][origin, 2] == pytest.approx(-p0, rel=0.1)
    # Equal bodies share the approach; the centre sinks by all of its half but nothing else.
    assert data["displacement_mm"][origin, 2] == pytest.approx(0.5e3 * exact.approach, rel=0.01)


def test_scaled_is_a_similar_contact(study, block):
    eight = half_space_contact.field(
        half_space_contact.mesh_study(groove_contact("b218", "inner").problem(8000.0), (3, 3))
    )
    similar = block.scaled(length=2.0, stress=2.0)
    for name in ("nodes", "displacement", "stress", "pressure"):
        expected = getattr(eight, name)
        np.testing.assert_allclose(getattr(similar, name), expected, rtol=1e-6, atol=1e-9 * np.abs(expected).max())
