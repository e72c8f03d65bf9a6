"""Meshes of a ball and of ring segments: gmsh's OpenCASCADE solids, 10-node tetrahedra with nodes on the true surfaces.

Half of each body is meshed, z >= 0; x is the bearing's axis, y radial, z tangential. Below each contact stands a small
block, part of the solid, cut evenly along the ellipse's axes (transfinite): its elements are as slender as the ellipse,
which takes a fifth of the elements that equal-sided ones would. From there elements grow with the distance.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import cos, pi, radians, sin
from pathlib import Path
from typing import Any

import numpy as np

from fem_check.contact_problem import Array
from fem_check.meshing import MeshError, gmsh_problem

PATCH = 1.3
"""Half-sides of the block under a contact, in semi-axes of the contact that is expected there."""
DEPTH = 1.5
"""Its depth, in semi-minor axes."""
DEPTH_GROWTH = 1.25
"""Of the block's layers; their number is this part of the elements per semi-axis:"""
LAYERS = 0.8
BESIDE = 0.8
"""Element size beside the block, in semi-minor axes,"""
GROWTH = 0.5
"""and what it gains per length of distance."""
FAR = 0.25
"""Largest element, in ball radii."""
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

    @property
    def half_length(self) -> float:
        """Of the block along the major axis [m]."""
        return PATCH * self.semi_major_axis

    @property
    def half_width(self) -> float:
        """Of the block along the minor axis [m]."""
        return PATCH * self.semi_minor_axis


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
    """A mesh of 10-node tetrahedra: vertices first, then edges' mid-nodes in gmsh's order."""

    points: Array
    """(3, node) [m]"""
    tetrahedra: Array
    """(10, element)"""

    def save(self, path: Path) -> None:
        """Write whole or not at all; compressed."""
        handle, temporary = tempfile.mkstemp(suffix=".npz", dir=path.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                np.savez_compressed(file, points=self.points, tetrahedra=self.tetrahedra.astype(np.int32))
            Path(temporary).chmod(0o644)
            Path(temporary).replace(path)
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise

    @classmethod
    def read(cls, path: Path) -> BodyMesh:
        """Read what `save` wrote."""
        try:
            with np.load(path) as file:
                return cls(file["points"], file["tetrahedra"].astype(np.int64))
        except (OSError, ValueError, KeyError) as problem:
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
        blocks += _revolved(occ, face, axis, patch.half_width / radius)
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
        block = _revolved(occ, face, np.array([1.0, 0.0, 0.0]), _mm(patch.half_width) / position[1])
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


def _section_face(occ: Any, section: RingSection) -> int:
    centre, radius = _mm(section.groove_centre), _mm(section.groove_radius)
    high, low = (centre + radius * section.direction(angle) for angle in (HIGH_SHOULDER, -LOW_SHOULDER))
    half = 0.5 * section.side * _mm(section.width)
    back = _mm(section.back_radius)
    corners = [low, (centre[0] - half, low[1]), (centre[0] - half, back), (centre[0] + half, back)]
    points = [occ.addPoint(x, y, 0.0) for x, y in (*corners, (centre[0] + half, high[1]), high)]
    lines = [occ.addLine(first, second) for first, second in zip(points[:-1], points[1:], strict=True)]
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
    if len(solids) != len(patches) + 1:
        raise MeshError(f"the body fell into {len(solids)} solids, not into {len(patches)} blocks and a rest")
    sizes = []
    for block in solids[: len(patches)]:
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
    model.mesh.setOrder(2)
    return _read(model)


def _cut_block(model: Any, block: int, patch: Patch, inward: float, elements: int) -> int:
    """Cut the block evenly along the ellipse's axes; returns the field of element sizes round it."""
    depth = inward * patch.normal
    along = np.array([-depth[1], depth[0]])
    faces = [tag for _, tag in model.getBoundary([(3, block)], oriented=False)]
    curves = {tag for face in faces for _, tag in model.getBoundary([(2, face)], oriented=False)}
    if len(faces) != 6 or len(curves) != 12:
        raise MeshError(f"the block under the contact has {len(faces)} faces and {len(curves)} edges, not 6 and 12")
    half = max(2, round(PATCH * elements))
    for curve in curves:
        ends = [np.array(model.getValue(0, tag, [])) for _, tag in model.getBoundary([(1, curve)], oriented=True)]
        step = ends[1] - ends[0]
        parts = np.abs([step[:2] @ along, step[2], step[:2] @ depth])
        if parts.argmax() == 0:
            model.mesh.setTransfiniteCurve(curve, 2 * half + 1)
        elif parts.argmax() == 1:
            model.mesh.setTransfiniteCurve(curve, half + 1)
        else:
            growth = DEPTH_GROWTH if step[:2] @ depth > 0.0 else 1.0 / DEPTH_GROWTH
            model.mesh.setTransfiniteCurve(curve, max(2, round(LAYERS * elements)) + 1, "Progression", growth)
    for face in faces:
        model.mesh.setTransfiniteSurface(face)
    model.mesh.setTransfiniteVolume(block)
    field = model.mesh.field
    distance = field.add("Distance")
    field.setNumbers(distance, "SurfacesList", faces)
    field.setNumber(distance, "Sampling", 20)
    size = field.add("MathEval")
    field.setString(size, "F", f"{BESIDE * _mm(patch.semi_minor_axis)!r} + {GROWTH!r} * F{distance}")
    return int(size)


def _read(model: Any) -> BodyMesh:
    tags, coordinates, _ = model.mesh.getNodes()
    kinds, _, nodes = model.mesh.getElements(3)
    if list(kinds) != [11]:
        raise MeshError(f"gmsh made elements of the kinds {list(kinds)}, not 10-node tetrahedra (11) alone")
    quality = model.mesh.getElementQualities(model.mesh.getElements(3)[1][0], "minSICN")
    if min(quality) <= 0.0:
        raise MeshError("gmsh made a tetrahedron that is folded over")
    tetrahedra = np.asarray(nodes[0], dtype=np.int64).reshape(-1, 10).T
    used = np.unique(tetrahedra)
    position = np.empty(int(max(tags)) + 1, dtype=np.int64)
    position[np.asarray(tags, dtype=np.int64)] = np.arange(len(tags))
    points = np.asarray(coordinates).reshape(-1, 3)[position[used]].T * 1e-3
    return BodyMesh(points, np.searchsorted(used, tetrahedra))
