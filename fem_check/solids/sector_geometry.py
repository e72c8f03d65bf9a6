"""Where the sector's bodies are: half a ball and its segments of both rings, meshed where they are expected."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, astuple, dataclass, field
from functools import cached_property
from math import cos, hypot, pi, sin

import numpy as np

from fem_check import meshing
from fem_check.independent.contact_problem import Array
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.ring_sections import BORE_BELOW_PITCH, OUTSIDE_ABOVE_PITCH, WIDTH, RingSections
from fem_check.solids import bodies, contact_block
from fem_check.solids.bodies import RingSection
from fem_check.solids.body_mesh import BodyMesh
from fem_check.solids.contact_block import Patch
from fem_check.solids.contact_frame import ContactFrame, Sphere, Torus


@dataclass(frozen=True)
class SectorBearing:
    """What the sector needs to know of a bearing; SI units, radians."""

    drawing: BearingDrawing
    ball_count: int
    sections: RingSections = field(default_factory=RingSections)

    @property
    def ball_radius(self) -> float:
        """[m]"""
        return 0.5 * self.drawing.ball_diameter

    @property
    def free_direction(self) -> Array:
        """(axial, radial), along the unloaded contact line."""
        return np.array([sin(self.drawing.free_contact_angle), cos(self.drawing.free_contact_angle)])

    @property
    def free_ball_centre(self) -> Array:
        """Where the free contact angle is just reached."""
        return np.array([0.0, 0.5 * self.drawing.pitch_diameter])

    def groove_radius(self, *, inner: bool) -> float:
        """[m]"""
        return self.drawing.inner_groove_radius if inner else self.drawing.outer_groove_radius

    def groove_centre(self, *, inner: bool) -> Array:
        """Centre of a groove's profile, in the same position."""
        beyond = (self.groove_radius(inner=inner) - self.ball_radius) * self.free_direction
        return self.free_ball_centre + (beyond if inner else -beyond)

    def section(self, groove_centre: Array, *, inner: bool) -> RingSection:
        """A ring's section: as far as it is known, else by the proportions of the 218 series."""
        profile = self.sections.profile(self.drawing, "inner" if inner else "outer")
        return RingSection(
            groove_centre,
            self.groove_radius(inner=inner),
            profile.back_radius,
            profile.width,
            inner,
            profile.high_shoulder,
            profile.low_shoulder,
        )

    @property
    def dimensions(self) -> list[float]:
        """All that the meshes depend on."""
        d = self.drawing
        lengths = (d.ball_diameter, d.pitch_diameter, d.inner_groove_radius, d.outer_groove_radius)
        profiles = [of.profile(d, race) for of in (self.sections, RingSections()) for race in ("inner", "outer")]
        own, usual = ([length for each in some for length in astuple(each)] for some in (profiles[:2], profiles[2:]))
        # Sections as the proportions make them, but for rounding, have the same meshes.
        more = [] if np.allclose(own, usual, rtol=1e-9, atol=0.0) else own
        return [*lengths, d.free_contact_angle, self.ball_count, *more]


@dataclass(frozen=True)
class Expected:
    """Where the bodies are meshed: positions and sizes near the solution, of which they are not part."""

    axial_displacement: float
    """Of the inner ring, from where the free contact angle is just reached [m]."""
    ball_centre: tuple[float, float]
    """(axial, radial) [m]"""
    inner_axes: tuple[float, float]
    """Semi-axes of the ellipse [m]."""
    outer_axes: tuple[float, float]


@dataclass(frozen=True)
class SectorGeometry:
    """The undeformed bodies of one ball pitch, the inner ring and the ball moved to where they are expected."""

    bearing: SectorBearing
    expected: Expected
    elements: int
    """Per semi-axis of each contact."""

    @cached_property
    def frames(self) -> tuple[ContactFrame, ContactFrame]:
        """Inner and outer contact at the expected position."""
        bearing = self.bearing
        centre = np.array(self.expected.ball_centre)
        ball, ring = bearing.drawing.ball.compliance, bearing.drawing.ring.compliance
        share = ball / (ball + ring)
        frames = []
        for inner, (a, b) in ((True, self.expected.inner_axes), (False, self.expected.outer_axes)):
            groove = self.groove(self.expected.axial_displacement, inner=inner)
            line = centre - groove.centre
            normal = line / hypot(*line)
            frames.append(
                ContactFrame(
                    Sphere(centre, bearing.ball_radius), groove, normal, Patch(normal, a, b), self.elements, share
                )
            )
        return frames[0], frames[1]

    def groove(self, axial_displacement: float, *, inner: bool) -> Torus:
        bearing = self.bearing
        moved = np.array([axial_displacement if inner else 0.0, 0.0])
        return Torus(bearing.groove_centre(inner=inner) + moved, bearing.groove_radius(inner=inner))

    def mesh_file(self, name: str) -> str:
        """Name of the file of a body's mesh, with a digest of all that it is made from."""
        recipe = [name, self.bearing.dimensions, asdict(self.expected), self.elements, _mesh_constants()]
        digest = hashlib.sha256(json.dumps(recipe, sort_keys=True).encode()).hexdigest()[:12]
        return f"sector-{name}-{digest}.npz"

    def mesh(self, name: str) -> BodyMesh:
        """Of "ball", "inner" or "outer", in its place: kept in the repository, in the cache, or made now by gmsh."""
        mesh = self.standing_mesh(name)
        return mesh.shifted(np.array([*self.expected.ball_centre, 0.0])) if name == "ball" else mesh

    def standing_mesh(self, name: str) -> BodyMesh:
        """The same, the ball's about its own centre."""
        inner, outer = self.frames
        file = self.mesh_file(name)
        for folder in (meshing.committed_folder(), meshing.cache_folder()):
            if (folder / file).is_file():
                return BodyMesh.read(folder / file)
        path = meshing.cache_folder() / file
        if name == "ball":
            mesh = bodies.ball(self.bearing.ball_radius, [inner.patch, outer.patch], self.elements)
        else:
            frame = inner if name == "inner" else outer
            section = self.bearing.section(frame.groove.centre, inner=name == "inner")
            mesh = bodies.ring(section, frame.patch, pi / self.bearing.ball_count, self.elements)
        path.parent.mkdir(parents=True, exist_ok=True)
        mesh.save(path)
        return BodyMesh.read(path)  # so that a mesh just made and one read again are the same


def _mesh_constants() -> list[float]:
    return [
        contact_block.REVISION,
        contact_block.PATCH,
        contact_block.DEPTH,
        contact_block.WIDTH,
        contact_block.FIRST_LAYER,
        contact_block.ALONG,
        contact_block.depth_growth(1),
        contact_block.side_growth(1),
        *contact_block.free_size(1),
        bodies.FAR,
        BORE_BELOW_PITCH,
        OUTSIDE_ABOVE_PITCH,
        WIDTH,
    ]
