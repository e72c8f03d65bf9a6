"""A ball and ring segments: gmsh's OpenCASCADE solids, meshed.

Half of each body is meshed, z >= 0; x is the bearing's axis, y radial, z tangential. Below each contact stands a block
of slender elements, part of the solid.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, pi, sin
from typing import Any

import numpy as np

from fem_check.independent.contact_problem import Array
from fem_check.independent.ring_sections import HIGH_SHOULDER, LOW_SHOULDER
from fem_check.meshing import MeshError
from fem_check.solids.body_mesh import BodyMesh
from fem_check.solids.contact_block import Patch, block_face, block_solids
from fem_check.solids.gmsh_model import gmsh_model, millimetres, revolved
from fem_check.solids.tetrahedra import meshed

ROUNDING = 1e-9
"""Of an angle [rad]: a patch may end at the groove's edge."""
FAR = 0.25
"""Largest element, in ball radii."""


def far_in_half_ball(elements: int) -> float:
    """The same of `quarter_ball`: finer with the contact's elements, or all meshes would share its error.

    A ball's equator is off by up to 0.11 % with FAR, by 0.005 % with half of it.
    """
    return min(FAR, 1.0 / elements)


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
    high_shoulder: float = HIGH_SHOULDER
    """Angle round the groove to the shoulder on the loaded side of the radial plane [rad]."""
    low_shoulder: float = LOW_SHOULDER
    """To the other shoulder."""

    @property
    def side(self) -> float:
        """-1 for the inner ring, which has the ball above it, +1 for the outer ring."""
        return -1.0 if self.is_inner else 1.0

    def direction(self, angle: float) -> Array:
        """From the groove's centre to its profile at a contact angle [rad]."""
        return self.side * np.array([sin(angle), cos(angle)])


def ball(radius: float, patches: Sequence[Patch], elements: int) -> BodyMesh:
    """Half a ball about the origin.

    Args:
        radius: [m].
        patches: its contacts; they must not overlap.
        elements: per semi-axis of each contact.
    """
    with gmsh_model() as gmsh:
        occ = gmsh.model.occ
        solid = occ.addSphere(0, 0, 0, millimetres(radius), -1, -0.5 * pi, 0.5 * pi, pi)
        occ.rotate([(3, solid)], 0, 0, 0, 1, 0, 0, 0.5 * pi)
        # The sphere's poles, where its parametrisation is singular, go as far from all contacts as they can.
        normals = np.array([patch.normal for patch in patches])
        pole = np.linalg.eigh(normals.T @ normals)[1][:, 0]
        occ.rotate([(3, solid)], 0, 0, 0, 0, 0, 1, float(np.arctan2(-pole[0], pole[1])))
        return _with_blocks(gmsh, solid, radius, patches, elements, FAR)


def quarter_ball(radius: float, patch: Patch, elements: int) -> BodyMesh:
    """Half of `ball` that is left of its equator, the plane through its centre normal to the contact.

    Args:
        radius: [m].
        patch: its contact.
        elements: per semi-axis of the contact.
    """
    with gmsh_model() as gmsh:
        occ = gmsh.model.occ
        solid = occ.addSphere(0, 0, 0, millimetres(radius), -1, -0.5 * pi, 0.5 * pi, 0.5 * pi)
        # From a quarter round the z axis to one round the contact's tangent: no pole comes near the contact.
        occ.rotate([(3, solid)], 0, 0, 0, 1, 0, 0, 0.5 * pi)
        occ.rotate([(3, solid)], 0, 0, 0, 0, 0, 1, float(np.arctan2(patch.normal[1], patch.normal[0])))
        return _with_blocks(gmsh, solid, radius, [patch], elements, far_in_half_ball(elements))


def _with_blocks(gmsh: Any, solid: int, radius: float, patches: Sequence[Patch], elements: int, far: float) -> BodyMesh:
    occ = gmsh.model.occ
    blocks = []
    for patch in patches:
        face = block_face(occ, np.zeros(2), patch, millimetres(radius), inward=True)
        # About the contact's tangent (x') through the centre, from the plane of symmetry towards z > 0.
        axis = np.cross([*patch.normal, 0.0], [0.0, 0.0, 1.0])
        blocks += block_solids(occ, face, axis, patch, radius)
    occ.fragment([(3, solid)], [(3, block) for block in blocks])
    occ.synchronize()
    positions = [millimetres(radius) * patch.normal for patch in patches]
    return meshed(gmsh, patches, positions, [-1.0] * len(patches), elements, far * millimetres(radius))


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
    _refuse_over_shoulder(section, patch)
    _refuse_too_thin(section)
    with gmsh_model() as gmsh:
        occ = gmsh.model.occ
        solid = revolved(occ, _section_face(occ, section), np.array([1.0, 0.0, 0.0]), half_pitch)
        centre, radius = millimetres(section.groove_centre), millimetres(section.groove_radius)
        position = centre + radius * patch.normal
        face = block_face(occ, centre, patch, radius, inward=False)
        block = block_solids(occ, face, np.array([1.0, 0.0, 0.0]), patch, 1e-3 * position[1])
        occ.fragment([(3, tag) for tag in solid], [(3, tag) for tag in block])
        occ.synchronize()
        return meshed(gmsh, [patch], [position], [1.0], elements, FAR * radius)


def _refuse_over_shoulder(section: RingSection, patch: Patch) -> None:
    angle = float(np.arctan2(section.side * patch.normal[0], section.side * patch.normal[1]))
    rooms = section.high_shoulder - angle, section.low_shoulder + angle
    side = int(np.argmin(rooms))
    tip, needed = (length / section.groove_radius for length in (patch.semi_major_axis, patch.lengths[side]))
    if rooms[side] >= needed - ROUNDING and rooms[side] >= tip - ROUNDING:
        return
    beside = float(np.degrees(rooms[side] - tip))
    where = f"{abs(beside):.1f}° ({abs(beside) / 180.0 * pi * millimetres(section.groove_radius):.2g} mm)"
    fault = (
        f"{where} beyond the groove's edge, and finite elements of the bodies solve uncut contacts only: the reading "
        "overrun gives the load and the pressure of a cut one"
        if beside < 0.0
        else f"{where} from the groove's edge, and the elements beside it need {np.degrees(needed - tip):.1f}°: "
        "one contact alone (fem-check contact --geometry true) is meshed up to the edge"
    )
    raise MeshError(
        f"a contact at {np.degrees(angle):.1f}° does not fit a groove from {-np.degrees(section.low_shoulder):.0f}° "
        f"to {np.degrees(section.high_shoulder):.0f}°: its ellipse ends {fault}; reduce the load, or state the "
        "shoulder's diameter if the groove reaches farther"
    )


def _refuse_too_thin(section: RingSection) -> None:
    widest = section.groove_radius * sin(max(section.high_shoulder, section.low_shoulder))
    if widest >= 0.5 * section.width:
        raise MeshError(
            f"a groove {millimetres(widest):.4g} mm wide to one side does not fit a ring of the width "
            f"{millimetres(section.width):.4g} mm"
        )


def _section_face(occ: Any, section: RingSection) -> int:
    centre, radius = millimetres(section.groove_centre), millimetres(section.groove_radius)
    high, low = (centre + radius * section.direction(angle) for angle in (section.high_shoulder, -section.low_shoulder))
    half = 0.5 * section.side * millimetres(section.width)
    back = millimetres(section.back_radius)
    corners = [low, (centre[0] - half, low[1]), (centre[0] - half, back), (centre[0] + half, back)]
    points = [occ.addPoint(x, y, 0.0) for x, y in (*corners, (centre[0] + half, high[1]), high)]
    lines = [occ.addLine(first, second) for first, second in itertools.pairwise(points)]
    lines.append(occ.addCircleArc(points[-1], occ.addPoint(*centre, 0.0), points[0]))
    return int(occ.addPlaneSurface([occ.addCurveLoop(lines)]))
