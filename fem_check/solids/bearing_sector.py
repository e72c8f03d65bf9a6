"""One ball between both rings: half a ball pitch, three elastic bodies, both contact angles free.

The bodies are meshed where they are expected, undeformed, so that they overlap by the approaches; pressures and
positions are then the finite elements' own: the inner ring's axial displacement and the ball's centre follow by
Newton's method from the equilibrium of ball and inner ring, with the exact surfaces at every step. The ball is free;
the force that balances its contacts acts as a body force, as the centrifugal force does. The inner ring's bore is
rigid, the outer ring is held as `OuterSupport` says; both cut planes of the segment are planes of symmetry.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from enum import StrEnum
from functools import cached_property
from math import atan, cos, hypot, pi, sin, tan

import numpy as np
import scipy.sparse as sp
from scipy.optimize import root

from fem_check import meshing
from fem_check.contact import ContactError
from fem_check.contact_problem import Array, ElasticConstants
from fem_check.solids import body_mesh, contact_results, normal_contact
from fem_check.solids.body_mesh import BodyMesh, Patch, RingSection
from fem_check.solids.condensation import CondensedSolid, condense_free, condense_supported
from fem_check.solids.contact_frame import ContactFrame, Sphere, Torus
from fem_check.solids.contact_results import ContactResults
from fem_check.solids.normal_contact import NormalContact
from fem_check.solids.tetrahedral_body import TetrahedralBody

# Bore, outside diameter and width of the 218 series (90, 160, 30 mm), radii in ball diameters from the pitch circle of B218:
# what a bearing gets whose ring sections are not known.
BORE_BELOW_PITCH, OUTSIDE_ABOVE_PITCH, WIDTH = 17.63 / 22.225, 17.37 / 22.225, 30.0 / 22.225
FRICTION_ITERATIONS = 20
FRICTION_TOLERANCE = 1e-8
RESIDUAL = 1e-7
"""Largest imbalance left, over the largest force."""


class OuterSupport(StrEnum):
    """How the outer ring is held."""

    RIGID = "rigid"
    """All of its outside diameter is fixed, as in a stiff housing with a tight fit."""
    FREE = "free"
    """Its outside diameter is free, as in a loose housing; the face that the axial load presses on a shoulder is held
    axially."""


@dataclass(frozen=True)
class SectorBearing:
    """What the sector needs to know of a bearing; SI units, radians."""

    ball_count: int
    ball_diameter: float
    pitch_diameter: float
    inner_groove_radius: float
    outer_groove_radius: float
    free_contact_angle: float
    ball: ElasticConstants
    ring: ElasticConstants
    ball_density: float

    @property
    def ball_radius(self) -> float:
        """[m]"""
        return 0.5 * self.ball_diameter

    @property
    def ball_mass(self) -> float:
        """[kg]"""
        return self.ball_density * pi * self.ball_diameter**3 / 6.0

    @property
    def free_direction(self) -> Array:
        """(axial, radial), along the unloaded contact line."""
        return np.array([sin(self.free_contact_angle), cos(self.free_contact_angle)])

    @property
    def free_ball_centre(self) -> Array:
        """Where the free contact angle is just reached."""
        return np.array([0.0, 0.5 * self.pitch_diameter])

    def groove_centre(self, *, inner: bool) -> Array:
        """Centre of a groove's profile, in the same position."""
        if inner:
            return self.free_ball_centre + (self.inner_groove_radius - self.ball_radius) * self.free_direction
        return self.free_ball_centre - (self.outer_groove_radius - self.ball_radius) * self.free_direction

    def section(self, groove_centre: Array, *, inner: bool) -> RingSection:
        """A ring's section by the proportions of the 218 series."""
        offset = -BORE_BELOW_PITCH if inner else OUTSIDE_ABOVE_PITCH
        return RingSection(
            groove_centre,
            self.inner_groove_radius if inner else self.outer_groove_radius,
            0.5 * self.pitch_diameter + offset * self.ball_diameter,
            WIDTH * self.ball_diameter,
            inner,
        )


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
class SectorLoad:
    """What acts on the bearing."""

    axial_load: float
    """On the whole inner ring [N]."""
    speed: float = 0.0
    """Of the inner ring [rad/s]; the ball's orbit and rotation follow by outer raceway control."""
    gyroscopic_moment: bool = False
    """React the gyroscopic moment by friction at the outer raceway."""


@dataclass(frozen=True)
class SectorResults:
    """What the finite elements found."""

    axial_displacement: float
    """Of the inner ring's bore, from where the free contact angle is just reached [m]."""
    ball_centre: Array
    """Mean position of the ball's material (axial, radial) [m]."""
    inner: ContactResults
    outer: ContactResults
    centrifugal_force: float
    """[N]"""
    gyroscopic_moment: float
    """Magnitude [N m]."""
    imbalance: float
    """Of ball and inner ring, over the largest of load per ball and centrifugal force."""
    penetration: float
    """See `NormalContact`."""


class BearingSector:
    """The three bodies, condensed onto their contacts; then any load near the expected one takes milliseconds."""

    def __init__(
        self,
        bearing: SectorBearing,
        expected: Expected,
        elements: int,
        supports: Sequence[OuterSupport] = (OuterSupport.RIGID,),
        friction: bool = False,
        meshes: Callable[[str], BodyMesh] | None = None,
    ) -> None:
        """Mesh and condense.

        Args:
            bearing: the bearing.
            expected: where the bodies are meshed.
            elements: per semi-axis of each contact.
            supports: how the outer ring may be held.
            friction: also condense the outer contact's friction, for the gyroscopic moment.
            meshes: gives the mesh of "ball", "inner", "outer"; None: made by gmsh, or read where they were kept.
        """
        self.bearing = bearing
        self.expected = expected
        self.elements = elements
        self.friction = friction
        inner, outer = self.frames
        source = meshes or self.made_mesh
        ball = TetrahedralBody(source("ball").shifted(np.array([*expected.ball_centre, 0.0])), bearing.ball)
        loads = [frame.loads(ball, on_ball=True) for frame in self.frames]
        if friction:
            loads.append(outer.loads(ball, on_ball=True, along="tangent"))
        self.ball = condense_free(ball, sp.csr_matrix(sp.hstack(loads)))
        self.inner_ring = self._ring(source("inner"), inner, OuterSupport.RIGID, inner=True)
        self.outer_rings = {support: self._ring(source("outer"), outer, support, inner=False) for support in supports}
        self.counts = (len(inner.basis.forces), len(outer.basis.forces))

    @cached_property
    def frames(self) -> tuple[ContactFrame, ContactFrame]:
        """Inner and outer contact at the expected position."""
        bearing = self.bearing
        centre = np.array(self.expected.ball_centre)
        share = bearing.ball.compliance / (bearing.ball.compliance + bearing.ring.compliance)
        frames = []
        for inner, (a, b) in ((True, self.expected.inner_axes), (False, self.expected.outer_axes)):
            groove = self._groove(self.expected.axial_displacement, inner=inner)
            line = centre - groove.centre
            normal = line / hypot(*line)
            frames.append(
                ContactFrame(
                    Sphere(centre, bearing.ball_radius), groove, normal, Patch(normal, a, b), self.elements, share
                )
            )
        return frames[0], frames[1]

    def _groove(self, axial_displacement: float, *, inner: bool) -> Torus:
        bearing = self.bearing
        centre = bearing.groove_centre(inner=inner)
        if inner:
            return Torus(centre + np.array([axial_displacement, 0.0]), bearing.inner_groove_radius)
        return Torus(centre, bearing.outer_groove_radius)

    def made_mesh(self, name: str) -> BodyMesh:
        """A body's mesh: from the cache, or made now and kept there; the ball's about its own centre."""
        inner, outer = self.frames
        recipe = [name, asdict(self.bearing), asdict(self.expected), self.elements, _mesh_constants()]
        digest = hashlib.sha256(json.dumps(recipe, sort_keys=True, default=str).encode()).hexdigest()[:12]
        file = f"sector-{name}-{digest}.npz"
        for folder in (meshing.committed_folder(), meshing.cache_folder()):
            if (folder / file).is_file():
                return BodyMesh.read(folder / file)
        path = meshing.cache_folder() / file
        if name == "ball":
            mesh = body_mesh.ball(self.bearing.ball_radius, [inner.patch, outer.patch], self.elements)
        else:
            frame = inner if name == "inner" else outer
            section = self.bearing.section(frame.groove.centre, inner=name == "inner")
            mesh = body_mesh.ring(section, frame.patch, pi / self.bearing.ball_count, self.elements)
        path.parent.mkdir(parents=True, exist_ok=True)
        mesh.save(path)
        return mesh

    def _ring(self, mesh: BodyMesh, frame: ContactFrame, support: OuterSupport, *, inner: bool) -> CondensedSolid:
        body = TetrahedralBody(mesh, self.bearing.ring)
        section = self.bearing.section(frame.groove.centre, inner=inner)
        half_pitch = pi / self.bearing.ball_count
        small = 1e-9
        x, y, z = body.nodes
        fixed = np.zeros((body.space.count, 3), dtype=bool)
        fixed[np.abs(z) < small, 2] = True
        cut = np.abs(z * cos(half_pitch) - y * sin(half_pitch)) < small
        fixed[cut, 2] = True
        if support is OuterSupport.RIGID:
            fixed[np.abs(np.hypot(y, z) - section.back_radius) < small] = True
        else:
            fixed[np.abs(x - (section.groove_centre[0] + 0.5 * section.width)) < small, 0] = True
        # On the second cut plane the third unknown is the displacement across it.
        turned = np.flatnonzero(cut)
        turn = sp.lil_matrix(sp.identity(3 * body.space.count))
        c, s = cos(half_pitch), sin(half_pitch)
        turn[3 * turned + 1, 3 * turned + 1] = c
        turn[3 * turned + 2, 3 * turned + 2] = c
        turn[3 * turned + 2, 3 * turned + 1] = s
        turn[3 * turned + 1, 3 * turned + 2] = -s
        loads = [frame.loads(body, on_ball=False)]
        if self.friction and not inner:
            loads.append(frame.loads(body, on_ball=False, along="tangent"))
        return condense_supported(body, sp.csr_matrix(sp.hstack(loads)), fixed, sp.csr_matrix(turn))

    @property
    def dofs(self) -> int:
        """Unknowns of all three bodies."""
        return self.ball.dofs + self.inner_ring.dofs + next(iter(self.outer_rings.values())).dofs

    def flexibility(self, support: OuterSupport) -> Array:
        """Of all bodies together: inner normal, outer normal (, outer friction)."""
        total = self.ball.flexibility.copy()
        first = self.counts[0]
        total[:first, :first] += self.inner_ring.flexibility
        total[first:, first:] += self.outer_rings[support].flexibility
        return total

    def solve(self, load: SectorLoad, support: OuterSupport = OuterSupport.RIGID) -> SectorResults:
        """Positions and pressures in equilibrium.

        Raises:
            ContactError: no equilibrium found near the expected position.
        """
        if load.gyroscopic_moment and not self.friction:
            raise ValueError("a gyroscopic moment needs the sector condensed with friction=True")
        friction = np.zeros(self.counts[1])
        flexibility = self.flexibility(support)
        start = np.zeros(3)
        for _ in range(FRICTION_ITERATIONS):
            state = _State(self, load, flexibility, friction)
            found = root(state.residual, start, method="hybr", options={"xtol": 1e-13, "eps": 1e-7})
            worst = float(np.abs(state.residual(found.x)).max())
            if not worst < RESIDUAL:
                raise ContactError(
                    f"no equilibrium of ball and inner ring: {worst:.1e} of the load is left ({found.message})"
                )
            start = found.x
            if not load.gyroscopic_moment:
                break
            previous, friction = friction, state.friction_pressures()
            if np.abs(friction - previous).max() < FRICTION_TOLERANCE * friction.max():
                break
        return state.results(worst)


class _State:
    """Bodies at a trial position, under given friction."""

    def __init__(self, sector: BearingSector, load: SectorLoad, flexibility: Array, friction: Array) -> None:
        self.sector = sector
        self.load = load
        self.flexibility = flexibility
        self.friction = friction
        self.contact: NormalContact | None = None
        self.unit = 1e-6
        """Of the position's unknowns [m]."""

    def residual(self, position: Array) -> Array:
        """Imbalance of ball (axial, radial) and inner ring (axial), over the load per ball."""
        sector, bearing = self.sector, self.sector.bearing
        self.displacement = sector.expected.axial_displacement + self.unit * position[0]
        ball = Sphere(np.array(sector.expected.ball_centre) + self.unit * position[1:], bearing.ball_radius)
        self.ball = ball
        count = sum(sector.counts)
        gaps = np.concatenate(
            [
                frame.weighted_gap(ball, sector._groove(self.displacement, inner=inner))
                for frame, inner in zip(sector.frames, (True, False), strict=True)
            ]
        )
        gaps = gaps + self.flexibility[:count, count:] @ self.friction[: self.flexibility.shape[0] - count]
        start = self.contact.active if self.contact is not None else None
        self.contact = normal_contact.solve(self.flexibility[:count, :count], gaps, start)
        inner, outer = self.forces()
        per_ball = self.load.axial_load / bearing.ball_count
        self.centrifugal, self.gyroscopic = self.inertia(inner, outer)
        rubbing = sector.frames[1].friction_resultants @ self.friction
        on_ball = rubbing - inner - outer + np.array([0.0, self.centrifugal])
        scale = max(per_ball, self.centrifugal)
        return np.array([*on_ball, inner[0] + per_ball]) / scale

    def pressures(self) -> tuple[Array, Array]:
        """Inner and outer."""
        assert self.contact is not None
        first = self.sector.counts[0]
        return self.contact.pressures[:first], self.contact.pressures[first:]

    def forces(self) -> tuple[Array, Array]:
        """Of the normal pressure on the inner and on the outer raceway (axial, radial)."""
        first, second = (
            frame.resultants @ pressure for frame, pressure in zip(self.sector.frames, self.pressures(), strict=True)
        )
        return first, second

    def inertia(self, inner: Array, outer: Array) -> tuple[float, float]:
        """Centrifugal force and size of the gyroscopic moment, from this state's orbit radius and angles."""
        if not self.load.speed:
            return 0.0, 0.0
        bearing = self.sector.bearing
        radius = float(self.ball.centre[1])
        orbit, rotation, attitude = motion(
            bearing.ball_radius / radius, np.arctan2(-inner[0], -inner[1]), np.arctan2(outer[0], outer[1])
        )
        speed = self.load.speed
        inertia = 0.1 * bearing.ball_mass * bearing.ball_diameter**2
        return (
            bearing.ball_mass * radius * (orbit * speed) ** 2,
            inertia * abs(orbit * rotation * sin(attitude)) * speed**2,
        )

    def friction_pressures(self) -> Array:
        """Friction that gives the gyroscopic moment, everywhere the same part of the pressure."""
        _, outer = self.pressures()
        share = 2.0 * self.gyroscopic / self.sector.bearing.ball_diameter / hypot(*self.forces()[1])
        return share * outer

    def results(self, imbalance: float) -> SectorResults:
        """Everything read."""
        assert self.contact is not None
        inner, outer = (
            contact_results.read(frame, pressure)
            for frame, pressure in zip(self.sector.frames, self.pressures(), strict=True)
        )
        return SectorResults(
            self.displacement,
            self.ball.centre,
            inner,
            outer,
            self.centrifugal,
            self.gyroscopic,
            imbalance,
            self.contact.penetration,
        )


def motion(ratio: float, inner_angle: float, outer_angle: float) -> tuple[float, float, float]:
    """Orbital speed and rotation speed over the inner ring's speed, and attitude angle, under outer raceway control.

    Args:
        ratio: ball diameter over pitch diameter.
        inner_angle: contact angle at the inner raceway [rad].
        outer_angle: at the outer raceway [rad].

    Source: Harris & Kotzalas, Advanced Concepts of Bearing Technology, chapter on ball motion; no spin at the outer
    raceway, no slip at the contacts' centres.
    """
    attitude = atan(sin(outer_angle) / (cos(outer_angle) + ratio))
    t = tan(attitude)
    outer = (cos(outer_angle) + t * sin(outer_angle)) / (1.0 + ratio * cos(outer_angle))
    inner = (cos(inner_angle) + t * sin(inner_angle)) / (1.0 - ratio * cos(inner_angle))
    return 1.0 / (1.0 + inner / outer), -1.0 / ((outer + inner) * ratio * cos(attitude)), attitude


def _mesh_constants() -> list[float]:
    return [
        body_mesh.PATCH,
        body_mesh.DEPTH,
        body_mesh.WIDTH,
        body_mesh.FIRST_LAYER,
        body_mesh.depth_growth(1),
        body_mesh.side_growth(1),
        *body_mesh.free_size(1),
        body_mesh.FAR,
        BORE_BELOW_PITCH,
        OUTSIDE_ABOVE_PITCH,
        WIDTH,
    ]
