"""The block of slender elements below a contact: its geometry, and how gmsh cuts it.

Part of the solid, cut evenly along the ellipse's axes (transfinite): its elements are as slender as the ellipse, which
takes a fifth of the elements that equal-sided ones would. From there elements grow with the distance.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, log, log1p, sin, sqrt
from typing import Any

import numpy as np

from fem_check.independent.contact_problem import Array
from fem_check.meshing import MeshError
from fem_check.solids.gmsh_model import millimetres, revolved

PATCH = 1.3
"""Half-sides of the patch that may carry pressure, in semi-axes of the contact that is expected there."""
BESIDE = 0.1
"""Groove that is left beside the patch, in semi-axes; where a shoulder leaves less, the patch ends at its edge, for
elements in a narrower strip would be slivers."""
WIDTH, DEPTH = 2.7, 2.5
"""Half-width and depth of the block of slender elements below it, in semi-minor axes."""
ALONG = 1.5
"""Elements per semi-major axis over those per semi-minor axis: both ends of the ellipse need some, and more slender
elements are less exact."""
FIRST_LAYER = 0.6
"""Depth of the first layer below the contact, over the length of an element along the minor axis."""
REVISION = 2
"""Raised where meshes change though none of their lengths does, so that none is taken for another."""


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

    reach: tuple[float, float] = (PATCH, PATCH)
    """Of the patch along the major axis, towards larger and towards smaller contact angles, in semi-axes: another
    than `PATCH` where it ends at the groove's edge."""

    @property
    def lengths(self) -> tuple[float, float]:
        """Of the block along the surface, towards larger and towards smaller contact angles [m]."""
        return self.reach[0] * self.semi_major_axis, self.reach[1] * self.semi_major_axis

    @property
    def half_width(self) -> float:
        """Of the patch along the minor axis [m]."""
        return PATCH * self.semi_minor_axis

    @property
    def block_half_width(self) -> float:
        """Of the block [m]."""
        return WIDTH * self.semi_minor_axis


def block_face(occ: Any, centre: Array, patch: Patch, radius: float, *, inward: bool) -> int:
    """The block's section in the plane z = 0: a piece of a circular band along the surface."""
    depth = DEPTH * millimetres(patch.semi_minor_axis)
    other = radius - depth if inward else radius + depth
    middle = float(np.arctan2(patch.normal[1], patch.normal[0]))
    angles = [millimetres(length) / radius for length in patch.lengths]

    def point(distance: float, angle: float) -> int:
        return int(occ.addPoint(centre[0] + distance * cos(angle), centre[1] + distance * sin(angle), 0.0))

    hub = occ.addPoint(*centre, 0.0)
    near = [point(radius, middle - angles[0]), point(radius, middle + angles[1])]
    deep = [point(other, middle - angles[0]), point(other, middle + angles[1])]
    loop = [
        occ.addCircleArc(near[0], hub, near[1]),
        occ.addLine(near[1], deep[1]),
        occ.addCircleArc(deep[1], hub, deep[0]),
        occ.addLine(deep[0], near[0]),
    ]
    return int(occ.addPlaneSurface([occ.addCurveLoop(loop)]))


def block_solids(occ: Any, face: int, axis: Array, patch: Patch, radius: float) -> list[int]:
    """The patch's part of the block and the part beside it."""
    patch_angle, angle = patch.half_width / radius, patch.block_half_width / radius
    beside = occ.copy([(2, face)])
    occ.rotate(beside, 0, 0, 0, *axis, patch_angle)
    return revolved(occ, face, axis, patch_angle) + revolved(occ, beside[0][1], axis, angle - patch_angle)


def cut_block(model: Any, block: int, patch: Patch, inward: float, elements: int) -> int:
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
        elif min(ends[0][2], ends[1][2]) < 0.5 * millimetres(patch.half_width):
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
    field.setString(size, "F", f"{start * millimetres(patch.semi_minor_axis)!r} + {growth!r} * F{distance}")
    return int(size)


def _layers(length: float, first: float, growth: float) -> int:
    """How many elements, each longer than the one before, fill a length."""
    return max(1, round(log1p(length * (growth - 1.0) / first) / log(growth)))
