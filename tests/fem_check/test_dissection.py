"""The elimination order of a brick."""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from fem_check import dissection, linear_solver, meshing
from fem_check.elastic_body import DisplacementSpace, stiffness


@pytest.fixture(scope="module")
def brick():
    space = DisplacementSpace(meshing.load(meshing.half_space(4)))
    matrix = stiffness(space, 0.3)
    ranks = dissection.grid_ranks(space.nodes)
    free = np.flatnonzero(np.repeat(ranks[2] < ranks[2].max(), 3))  # held at its deepest face
    return sp.csc_matrix(matrix[free][:, free]), ranks[:, free // 3]


def test_it_is_a_permutation(brick):
    _, ranks = brick
    assert np.array_equal(np.sort(dissection.order(ranks)), np.arange(ranks.shape[1]))


def test_vertices_stand_on_even_ranks():
    space = DisplacementSpace(meshing.load(meshing.half_space(4)))
    ranks = dissection.grid_ranks(space.nodes)
    # A node of a 20-node brick lies between vertices along one axis at most.
    assert (ranks % 2).sum(axis=0).max() == 1


def test_the_halves_do_not_touch_and_the_fill_is_less(brick):
    matrix, ranks = brick
    order = dissection.order(ranks)
    options = {"SymmetricMode": True, "Equil": False}
    ours = splu(matrix[order][:, order].tocsc(), permc_spec="NATURAL", diag_pivot_thresh=0.0, options=options)
    general = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    assert ours.L.nnz < general.L.nnz


def test_scipy_solves_in_that_order(brick, monkeypatch):
    matrix, ranks = brick
    monkeypatch.setenv(linear_solver.ENVIRONMENT, "scipy")
    sides = np.random.default_rng(3).normal(size=(matrix.shape[0], 2))
    factor = linear_solver.factorise(matrix, dissection.order(ranks))
    found = factor.solve(sides)
    assert np.abs(matrix @ found - sides).max() < 1e-9 * np.abs(matrix).max() * np.abs(found).max()
