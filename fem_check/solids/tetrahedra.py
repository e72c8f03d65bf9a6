"""gmsh's 10-node tetrahedra of a solid with its blocks below the contacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from fem_check.independent.contact_problem import Array
from fem_check.meshing import MeshError
from fem_check.solids.body_mesh import BodyMesh
from fem_check.solids.contact_block import Patch, cut_block

STRAIGHT = 1e-12
"""An edge whose middle is no farther than this from its node [m] is straight."""
GMSH_EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3))
"""Ends of the edges on which gmsh's nodes 4 to 9 of a tetrahedron lie."""

REMEDIES = ((1.0, 1.0), (1.25, 0.8), (1.5, 0.6), (2.0, 0.45))
"""While gmsh fails or a curved element is folded over, in turn: times as many elements along the contact, where the
surface sags between two nodes by as much as a slender element is thick; and the size of the largest elements, which
fold at a sharp edge. (gmsh's own remedy, high-order optimisation, ends the process where it fails.)"""


def meshed(
    gmsh: Any, patches: Sequence[Patch], positions: list[Array], inward: list[float], elements: int, far: float
) -> BodyMesh:
    """Mesh the model; `inward` is the sign of each patch's normal that points into the body."""
    model = gmsh.model
    solids = sorted((tag for _, tag in model.getEntities(3)), key=lambda tag: model.occ.getMass(3, tag))
    if len(solids) != 2 * len(patches) + 1:
        raise MeshError(f"the body fell into {len(solids)} solids, not into {2 * len(patches)} blocks and a rest")
    for option in ("MeshSizeExtendFromBoundary", "MeshSizeFromPoints", "MeshSizeFromCurvature"):
        gmsh.option.setNumber(f"Mesh.{option}", 0)
    field = model.mesh.field
    for more_along, size in REMEDIES:
        sizes = []
        for block in solids[:-1]:
            centre = np.array(model.occ.getCenterOfMass(3, block))[:2]
            index = int(np.argmin([np.linalg.norm(centre - position) for position in positions]))
            patch = replace(patches[index], along=more_along * patches[index].along)
            sizes.append(cut_block(model, block, patch, inward[index], elements))
        smallest = field.add("Min")
        field.setNumbers(smallest, "FieldsList", sizes)
        field.setAsBackgroundMesh(smallest)
        gmsh.option.setNumber("Mesh.MeshSizeMax", size * far)
        model.mesh.clear()
        try:
            _generate(model)
        except Exception as fault:  # gmsh raises no other kind
            problem = str(fault)
            continue
        if not _is_folded(model):
            return _read(model)
        problem = "a tetrahedron is folded over"
    raise MeshError(
        f"gmsh cannot mesh a body with {elements} elements per semi-axis, nor with more along the contact: {problem}; "
        "try another number of elements"
    )


def _generate(model: Any) -> None:
    model.mesh.generate(3)
    # gmsh cuts the quadrangles between a block and the rest by either diagonal; both sides must take the same.
    split = _split_surfaces(model)
    if split:
        model.mesh.clear()
        for surface in split:
            model.mesh.setTransfiniteSurface(surface, "Right")
        model.mesh.generate(3)
        if _split_surfaces(model):
            raise MeshError("gmsh's tetrahedra do not fit those of the block under the contact")
    model.mesh.setOrder(2)


def _is_folded(model: Any) -> bool:
    quality = model.mesh.getElementQualities(model.mesh.getElements(3)[1][0], "minSICN")
    return bool(min(quality) <= 0.0)


def _split_surfaces(model: Any) -> list[int]:
    """Surfaces between two solids whose triangles are not faces of the tetrahedra on both sides."""

    def keys(nodes: Any, corners: int) -> Array:
        return np.sort(np.asarray(nodes, dtype=np.int64).reshape(-1, corners), axis=1)

    faces = {}
    for _, solid in model.getEntities(3):
        tetrahedra = keys(model.mesh.getElements(3, solid)[2][0], 4)
        faces[solid] = {tuple(face) for left in range(4) for face in np.delete(tetrahedra, left, axis=1).tolist()}
    split = []
    for _, surface in model.getEntities(2):
        solids = model.getAdjacencies(2, surface)[0]
        if len(solids) == 2:
            triangles = keys(model.mesh.getElements(2, surface)[2][0], 3).tolist()
            if not all(tuple(triangle) in faces[solid] for solid in solids for triangle in triangles):
                split.append(int(surface))
    return split


def _read(model: Any) -> BodyMesh:
    tags, coordinates, _ = model.mesh.getNodes()
    kinds, _, nodes = model.mesh.getElements(3)
    if list(kinds) != [11]:
        raise MeshError(f"gmsh made elements of the kinds {list(kinds)}, not 10-node tetrahedra (11) alone")
    tetrahedra = np.asarray(nodes[0], dtype=np.int64).reshape(-1, 10).T
    position = np.empty(int(max(tags)) + 1, dtype=np.int64)
    position[np.asarray(tags, dtype=np.int64)] = np.arange(len(tags))
    points = np.asarray(coordinates).reshape(-1, 3).T * 1e-3
    tetrahedra = position[tetrahedra]
    edges = np.concatenate([tetrahedra[list(ends)] for ends in GMSH_EDGES], axis=1)
    middles, first = np.unique(np.concatenate(list(tetrahedra[4:])), return_index=True)
    ends = edges[:, first]
    curved = np.linalg.norm(points[:, middles] - points[:, ends].mean(axis=1), axis=0) > STRAIGHT
    vertices = np.unique(tetrahedra[:4])
    return BodyMesh(
        points[:, vertices],
        np.searchsorted(vertices, tetrahedra[:4]),
        np.searchsorted(vertices, ends[:, curved]),
        points[:, middles[curved]],
    )
