"""Meshes of a ball and of ring segments: gmsh's OpenCASCADE solids, 10-node tetrahedra with nodes on the true surfaces.

Half of each body is meshed, z >= 0; x is the bearing's axis, y radial, z tangential. Below each contact stands a small
block, part of the solid, cut evenly along the ellipse's axes (transfinite): its elements are as slender as the ellipse,
which takes a fifth of the elements that equal-sided ones would. From there elements grow with the distance.
"""

from __future__ import annotations

import itertools
import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import cos, log, log1p, pi, radians, sin, sqrt
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from fem_check.contact_problem import Array
from fem_check.meshing import MeshError, gmsh_problem

PATCH = 1.3
"""Half-sides of the patch that may carry pressure, in semi-axes of the contact that is expected there."""
WIDTH, DEPTH = 2.7, 2.5
"""Half-width and depth of the block of slender elements below it, in semi-minor axes."""
ALONG = 1.5
"""Elements per semi-major axis over those per semi-minor axis: both ends of the ellipse need some, and more slender
elements are less exact."""
FIRST_LAYER = 0.6
"""Depth of the first layer below the contact, over the length of an element along the minor axis."""
REVISION = 2
"""Raised where meshes change though none of their lengths does, so that none is taken for another."""
STRAIGHT = 1e-12
"""An edge whose middle is no farther than this from its node [m] is straight."""
GMSH_EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3))
"""Ends of the edges on which gmsh's nodes 4 to 9 of a tetrahedron lie."""
FAR = 0.25
"""Largest element, in ball radii."""


def cells(elements: float) -> int:
    """Number of elements on a half-side of the patch."""
    return max(2, round(PATCH * elements))


def depth_growth(elements: int) -> float:
    """Length of each layer below the contact over the one above."""
    return 1.0 + 2.0 / elements


def side_growth(elements: int) -> float:
    """Length of each element beside the patch over the one before."""
    return 1.0 + 2.4 / elements


def free_size(elements: int) -> tuple[float, float]:
    """Size of the equal-sided elements at the block, in semi-minor axes, and its growth per distance."""
    return 1.8 / sqrt(elements), 0.8 / sqrt(elements)


HIGH_SHOULDER, LOW_SHOULDER = radians(70.0), radians(20.0)
"""The groove's arc ends here, on the loaded and on the other side of the radial plane."""


@dataclass(frozen=True)
class Patch:
    """Where a contact is expected, and how large."""

    normal: Array
    """Unit vector (axial, radial) from the body's circle centre (ball, or groove profile) to the contact."""
    semi_major_axis: float
    """[m]"""
    semi_minor_axis: float
    """[m]"""
    along: float = ALONG
    """Elements per semi-major axis over those per semi-minor axis."""

    @property
    def half_length(self) -> float:
        """Of the block along the major axis [m]."""
        return PATCH * self.semi_major_axis

    @property
    def half_width(self) -> float:
        """Of the patch along the minor axis [m]."""
        return PATCH * self.semi_minor_axis

    @property
    def block_half_width(self) -> float:
        """Of the block [m]."""
        return WIDTH * self.semi_minor_axis


@dataclass(frozen=True)
class RingSection:
    """Cross-section of a ring: a rectangle with the groove and two shoulders."""

    groove_centre: Array
    """Centre of the groove's profile (axial, radial) [m]."""
    groove_radius: float
    """[m]"""
    back_radius: float
    """Of the cylinder away from the groove: bore of an inner, outside of an outer ring [m]."""
    width: float
    """[m], centred on the groove."""
    is_inner: bool

    @property
    def side(self) -> float:
        """-1 for the inner ring, which has the ball above it, +1 for the outer ring."""
        return -1.0 if self.is_inner else 1.0

    def direction(self, angle: float) -> Array:
        """From the groove's centre to its profile at a contact angle [rad]."""
        return self.side * np.array([sin(angle), cos(angle)])


@dataclass(frozen=True)
class BodyMesh:
    """Curved tetrahedra: their vertices, and the nodes of those edges that are not straight."""

    points: Array
    """Vertices, (3, vertex) [m]."""
    tetrahedra: Array
    """Vertices of each, (4, element)."""
    curved_edges: Array
    """Vertices of each curved edge, (2, edge)."""
    curved_nodes: Array
    """The node in its middle, on the true surface, (3, edge) [m]."""

    def shifted(self, by: Array) -> BodyMesh:
        """The mesh moved as a whole by a vector [m]."""
        return replace(self, points=self.points + by[:, None], curved_nodes=self.curved_nodes + by[:, None])

    def turned(self, axes: Array) -> BodyMesh:
        """The mesh in other axes: those of its own are the columns of `axes`, shape (3, 3)."""
        return replace(self, points=axes @ self.points, curved_nodes=axes @ self.curved_nodes)

    def save(self, path: Path) -> None:
        """Write whole or not at all; compressed, in single precision: 1e-9 m, where elements are 1e-5 m and more.

        The gap never comes from these points.
        """
        handle, temporary = tempfile.mkstemp(suffix=".npz", dir=path.parent)
        small = np.uint16 if self.points.shape[1] < 2**16 else np.uint32
        try:
            with os.fdopen(handle, "wb") as file:
                np.savez_compressed(
                    file,
                    points=self.points.astype(np.float32),
                    tetrahedra=self.tetrahedra.astype(small),
                    curved_edges=self.curved_edges.astype(small),
                    curved_nodes=self.curved_nodes.astype(np.float32),
                )
            Path(temporary).chmod(0o644)
            Path(temporary).replace(path)
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise

    @classmethod
    def read(cls, path: Path) -> BodyMesh:
        """Read what `save` wrote.

        Raises:
            MeshError: the file is missing or damaged.
        """
        try:
            with np.load(path) as file:
                return cls(
                    file["points"].astype(np.float64),
                    file["tetrahedra"].astype(np.int64),
                    file["curved_edges"].astype(np.int64),
                    file["curved_nodes"].astype(np.float64),
                )
        except (OSError, ValueError, KeyError, BadZipFile) as problem:
            raise MeshError(f"{path} is no mesh of a body ({problem})") from problem


def ball(radius: float, patches: Sequence[Patch], elements: int) -> BodyMesh:
    """Half a ball about the origin.

    Args:
        radius: [m].
        patches: its contacts; they must not overlap.
        elements: per semi-axis of each contact.
    """
    with _model() as gmsh:
        occ = gmsh.model.occ
        solid = occ.addSphere(0, 0, 0, _mm(radius), -1, -0.5 * pi, 0.5 * pi, pi)
        occ.rotate([(3, solid)], 0, 0, 0, 1, 0, 0, 0.5 * pi)
        # The sphere's poles, where its parametrisation is singular, go as far from all contacts as they can.
        normals = np.array([patch.normal for patch in patches])
        pole = np.linalg.eigh(normals.T @ normals)[1][:, 0]
        occ.rotate([(3, solid)], 0, 0, 0, 0, 0, 1, float(np.arctan2(-pole[0], pole[1])))
        return _with_blocks(gmsh, solid, radius, patches, elements)


def quarter_ball(radius: float, patch: Patch, elements: int) -> BodyMesh:
    """Half of `ball` that is left of its equator, the plane through its centre normal to the contact.

    Args:
        radius: [m].
        patch: its contact.
        elements: per semi-axis of the contact.
    """
    with _model() as gmsh:
        occ = gmsh.model.occ
        solid = occ.addSphere(0, 0, 0, _mm(radius), -1, -0.5 * pi, 0.5 * pi, 0.5 * pi)
        # From a quarter round the z axis to one round the contact's tangent: no pole comes near the contact.
        occ.rotate([(3, solid)], 0, 0, 0, 1, 0, 0, 0.5 * pi)
        occ.rotate([(3, solid)], 0, 0, 0, 0, 0, 1, float(np.arctan2(patch.normal[1], patch.normal[0])))
        return _with_blocks(gmsh, solid, radius, [patch], elements)


def _with_blocks(gmsh: Any, solid: int, radius: float, patches: Sequence[Patch], elements: int) -> BodyMesh:
    occ = gmsh.model.occ
    blocks = []
    for patch in patches:
        face = _block_face(occ, np.zeros(2), patch, _mm(radius), inward=True)
        # About the contact's tangent (x') through the centre, from the plane of symmetry towards z > 0.
        axis = np.cross([*patch.normal, 0.0], [0.0, 0.0, 1.0])
        blocks += _block(occ, face, axis, patch, radius)
    occ.fragment([(3, solid)], [(3, block) for block in blocks])
    occ.synchronize()
    positions = [_mm(radius) * patch.normal for patch in patches]
    return _meshed(gmsh, patches, positions, [-1.0] * len(patches), elements, FAR * _mm(radius))


def ring(section: RingSection, patch: Patch, half_pitch: float, elements: int) -> BodyMesh:
    """Half a pitch of a ring about the x axis, its groove's bottom above z = 0.

    Args:
        section: cross-section.
        patch: its contact.
        half_pitch: angle of the segment [rad].
        elements: per semi-axis of the contact.

    Raises:
        MeshError: the contact reaches over a shoulder.
    """
    angle = float(np.arctan2(section.side * patch.normal[0], section.side * patch.normal[1]))
    reach = patch.half_length / section.groove_radius
    if angle + reach > HIGH_SHOULDER or angle - reach < -LOW_SHOULDER:
        raise MeshError(
            f"a contact at {np.degrees(angle):.1f} deg that needs {np.degrees(reach):.1f} deg to either side does not "
            f"fit a groove from -{np.degrees(LOW_SHOULDER):.0f} to {np.degrees(HIGH_SHOULDER):.0f} deg"
        )
    with _model() as gmsh:
        occ = gmsh.model.occ
        solid = _revolved(occ, _section_face(occ, section), np.array([1.0, 0.0, 0.0]), half_pitch)
        centre, radius = _mm(section.groove_centre), _mm(section.groove_radius)
        position = centre + radius * patch.normal
        face = _block_face(occ, centre, patch, radius, inward=False)
        block = _block(occ, face, np.array([1.0, 0.0, 0.0]), patch, 1e-3 * position[1])
        occ.fragment([(3, tag) for tag in solid], [(3, tag) for tag in block])
        occ.synchronize()
        return _meshed(gmsh, [patch], [position], [1.0], elements, FAR * radius)


# --- geometry; millimetres, which gmsh's tolerances are made for ------------------------------------------------------


def _mm(length: Any) -> Any:
    return 1e3 * length


@contextmanager
def _model() -> Iterator[Any]:
    problem = gmsh_problem()
    if problem is not None:
        raise MeshError(f"a mesh of the bodies has to be made, but {problem}")
    import gmsh

    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.add("body")
        yield gmsh
    finally:
        gmsh.finalize()


def _block_face(occ: Any, centre: Array, patch: Patch, radius: float, *, inward: bool) -> int:
    """The block's section in the plane z = 0: a piece of a circular band along the surface."""
    depth = DEPTH * _mm(patch.semi_minor_axis)
    other = radius - depth if inward else radius + depth
    middle = float(np.arctan2(patch.normal[1], patch.normal[0]))
    half = _mm(patch.half_length) / radius

    def point(distance: float, angle: float) -> int:
        return int(occ.addPoint(centre[0] + distance * cos(angle), centre[1] + distance * sin(angle), 0.0))

    hub = occ.addPoint(*centre, 0.0)
    near = [point(radius, middle - half), point(radius, middle + half)]
    deep = [point(other, middle - half), point(other, middle + half)]
    loop = [
        occ.addCircleArc(near[0], hub, near[1]),
        occ.addLine(near[1], deep[1]),
        occ.addCircleArc(deep[1], hub, deep[0]),
        occ.addLine(deep[0], near[0]),
    ]
    return int(occ.addPlaneSurface([occ.addCurveLoop(loop)]))


def _block(occ: Any, face: int, axis: Array, patch: Patch, radius: float) -> list[int]:
    """The patch's part of the block and the part beside it."""
    patch_angle, angle = patch.half_width / radius, patch.block_half_width / radius
    beside = occ.copy([(2, face)])
    occ.rotate(beside, 0, 0, 0, *axis, patch_angle)
    return _revolved(occ, face, axis, patch_angle) + _revolved(occ, beside[0][1], axis, angle - patch_angle)


def _section_face(occ: Any, section: RingSection) -> int:
    centre, radius = _mm(section.groove_centre), _mm(section.groove_radius)
    high, low = (centre + radius * section.direction(angle) for angle in (HIGH_SHOULDER, -LOW_SHOULDER))
    half = 0.5 * section.side * _mm(section.width)
    back = _mm(section.back_radius)
    corners = [low, (centre[0] - half, low[1]), (centre[0] - half, back), (centre[0] + half, back)]
    points = [occ.addPoint(x, y, 0.0) for x, y in (*corners, (centre[0] + half, high[1]), high)]
    lines = [occ.addLine(first, second) for first, second in itertools.pairwise(points)]
    lines.append(occ.addCircleArc(points[-1], occ.addPoint(*centre, 0.0), points[0]))
    return int(occ.addPlaneSurface([occ.addCurveLoop(lines)]))


def _revolved(occ: Any, face: int, axis: Array, angle: float) -> list[int]:
    return [tag for dim, tag in occ.revolve([(2, face)], 0, 0, 0, *axis, angle) if dim == 3]


# --- elements --------------------------------------------------------------------------------------------------------


def _meshed(
    gmsh: Any, patches: Sequence[Patch], positions: list[Array], inward: list[float], elements: int, far: float
) -> BodyMesh:
    """Mesh the model; `inward` is the sign of each patch's normal that points into the body."""
    model = gmsh.model
    solids = sorted((tag for _, tag in model.getEntities(3)), key=lambda tag: model.occ.getMass(3, tag))
    if len(solids) != 2 * len(patches) + 1:
        raise MeshError(f"the body fell into {len(solids)} solids, not into {2 * len(patches)} blocks and a rest")
    sizes = []
    for block in solids[:-1]:
        centre = np.array(model.occ.getCenterOfMass(3, block))[:2]
        index = int(np.argmin([np.linalg.norm(centre - position) for position in positions]))
        sizes.append(_cut_block(model, block, patches[index], inward[index], elements))
    field = model.mesh.field
    smallest = field.add("Min")
    field.setNumbers(smallest, "FieldsList", sizes)
    field.setAsBackgroundMesh(smallest)
    for option in ("MeshSizeExtendFromBoundary", "MeshSizeFromPoints", "MeshSizeFromCurvature"):
        gmsh.option.setNumber(f"Mesh.{option}", 0)
    gmsh.option.setNumber("Mesh.MeshSizeMax", far)
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
    return _read(model)


def _split_surfaces(model: Any) -> list[int]:
    """Surfaces between two solids whose triangles are not faces of the tetrahedra on both sides."""

    def keys(nodes: Any, corners: int) -> Array:
        return np.sort(np.asarray(nodes, dtype=np.int64).reshape(-1, corners), axis=1)

    faces = {}
    for _, solid in model.getEntities(3):
        tetrahedra = keys(model.mesh.getElements(3, solid)[2][0], 4)
        faces[solid] = {tuple(face) for left in range(4) for face in np.delete(tetrahedra, left, axis=1).tolist()}
    found = []
    for _, surface in model.getEntities(2):
        solids = model.getAdjacencies(2, surface)[0]
        if len(solids) == 2:
            triangles = keys(model.mesh.getElements(2, surface)[2][0], 3).tolist()
            if not all(tuple(triangle) in faces[solid] for solid in solids for triangle in triangles):
                found.append(int(surface))
    return found


def _cut_block(model: Any, block: int, patch: Patch, inward: float, elements: int) -> int:
    """Cut the block evenly along the ellipse's axes; returns the field of element sizes round it."""
    depth = inward * patch.normal
    along = np.array([-depth[1], depth[0]])
    faces = [tag for _, tag in model.getBoundary([(3, block)], oriented=False)]
    curves = {tag for face in faces for _, tag in model.getBoundary([(2, face)], oriented=False)}
    if len(faces) != 6 or len(curves) != 12:
        raise MeshError(f"the block under the contact has {len(faces)} faces and {len(curves)} edges, not 6 and 12")
    half = cells(elements)
    depth_ratio, side_ratio = depth_growth(elements), side_growth(elements)
    for curve in curves:
        ends = [np.array(model.getValue(0, tag, [])) for _, tag in model.getBoundary([(1, curve)], oriented=True)]
        step = ends[1] - ends[0]
        parts = np.abs([step[:2] @ along, step[2], step[:2] @ depth])
        if parts.argmax() == 0:
            model.mesh.setTransfiniteCurve(curve, 2 * cells(patch.along * elements) + 1)
        elif parts.argmax() == 2:
            count = _layers(DEPTH, FIRST_LAYER / elements, depth_ratio)
            ratio = depth_ratio if step[:2] @ depth > 0.0 else 1.0 / depth_ratio
            model.mesh.setTransfiniteCurve(curve, count + 1, "Progression", ratio)
        elif min(ends[0][2], ends[1][2]) < 0.5 * _mm(patch.half_width):
            model.mesh.setTransfiniteCurve(curve, half + 1)
        else:
            count = _layers(WIDTH - PATCH, side_ratio / elements, side_ratio)
            model.mesh.setTransfiniteCurve(
                curve, count + 1, "Progression", side_ratio if step[2] > 0.0 else 1.0 / side_ratio
            )
    for face in faces:
        model.mesh.setTransfiniteSurface(face)
    model.mesh.setTransfiniteVolume(block)
    field = model.mesh.field
    distance = field.add("Distance")
    field.setNumbers(distance, "SurfacesList", faces)
    field.setNumber(distance, "Sampling", 20)
    size = field.add("MathEval")
    start, growth = free_size(elements)
    field.setString(size, "F", f"{start * _mm(patch.semi_minor_axis)!r} + {growth!r} * F{distance}")
    return int(size)


def _layers(length: float, first: float, growth: float) -> int:
    """How many elements, each longer than the one before, fill a length."""
    return max(1, round(log1p(length * (growth - 1.0) / first) / log(growth)))


def _read(model: Any) -> BodyMesh:
    tags, coordinates, _ = model.mesh.getNodes()
    kinds, _, nodes = model.mesh.getElements(3)
    if list(kinds) != [11]:
        raise MeshError(f"gmsh made elements of the kinds {list(kinds)}, not 10-node tetrahedra (11) alone")
    quality = model.mesh.getElementQualities(model.mesh.getElements(3)[1][0], "minSICN")
    if min(quality) <= 0.0:
        raise MeshError("gmsh made a tetrahedron that is folded over")
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
