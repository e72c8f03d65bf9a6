"""One contact of ball and raceway as true bodies: half a ball and a segment of the ring, at the loaded contact angle.

The ball is cut at its equator, the plane through its centre normal to the contact, which is a plane of symmetry: as
between two equal and opposite contacts. The ring's segment is one ball pitch wide, between planes of symmetry; its bore
(inner ring) or outside diameter (outer ring) is rigid. From that seat to the ball's equator the approach counts, less
nothing: it holds what Hertz's half-spaces have and the compliance of both bodies. The ball moves freely along the
groove, so that the load acts exactly along the contact angle.

Each body is condensed twice: with the pressure along the normal that the deformed surfaces share, which is the true
contact; and along the contact's axis, which is the half-spaces' problem on the true bodies, for a reference that knows
only half-spaces.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, replace
from functools import cached_property
from math import acos, cos, pi, sin

import numpy as np
import scipy.sparse as sp

from fem_check import meshing
from fem_check.elements import fields
from fem_check.elements.elastic_body import silent
from fem_check.elements.fields import NodalFields
from fem_check.independent import references
from fem_check.independent.contact_problem import Array
from fem_check.independent.groove import BallInGroove
from fem_check.independent.references import ellipse
from fem_check.independent.ring_sections import (
    BORE_BELOW_PITCH,
    HIGH_SHOULDER,
    LOW_SHOULDER,
    OUTSIDE_ABOVE_PITCH,
    WIDTH,
    RingProfile,
)
from fem_check.mechanics import contact
from fem_check.mechanics.measuring import central_shape
from fem_check.rows.agreement import Progress
from fem_check.solids import bodies, contact_block
from fem_check.solids.bodies import RingSection
from fem_check.solids.body_mesh import BodyMesh
from fem_check.solids.condensation import NEAR, condense_supported, moved
from fem_check.solids.contact_block import Patch
from fem_check.solids.contact_frame import ContactFrame, Sphere, Torus
from fem_check.solids.mesh_room import NoRoomError
from fem_check.solids.tetrahedral_body import TetrahedralBody

POSITIONS = 16
"""Loads over which each result is averaged: they move the contact's edge evenly through one cell of the mesh. On the
inner groove at 5 kN the gap's part of a moves from 8 to 16 by 0.017 % with 4 elements, a sixth of the uncertainty that
this mesh gives it, and from 16 to 32 by 0.006 %; on 8 elements all parts move by less than 0.005 and 0.001 %."""
READ = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")
SHAPE = ("slant", "bend")
"""Of the pressure along the groove's section, see `measuring.central_shape`."""


def loaded_angle(inner: BallInGroove, outer: BallInGroove, load: float) -> float:
    """Contact angle of a bearing at rest under thrust, where each ball carries `load` [rad].

    The groove centres' distance across the bearing stays; along the contact line it grows by both approaches (Harris &
    Kotzalas, thrust-loaded ball bearings). The approaches are Hertz's: the angle is a place to look at, not a result.
    """
    distance = inner.groove_radius + outer.groove_radius - inner.ball_diameter
    stretched = distance + sum(ellipse(groove.problem(load)).approach for groove in (inner, outer))
    # Rounded, so that every machine takes the same mesh.
    return round(acos(distance * cos(inner.contact_angle) / stretched), 6)


@dataclass(frozen=True)
class TrueContact:
    """The bodies of one contact, meshed for loads near one; SI units, radians."""

    groove: BallInGroove
    """Ball and raceway at the loaded contact angle."""
    ball_count: int
    load: float
    """That the mesh is made for [N]."""
    elements: int
    """Per semi-axis of the ellipse."""
    profile: RingProfile | None = None
    """Of the ring; None: by the proportions of the 218 series."""

    @cached_property
    def frame(self) -> ContactFrame:
        """Where the undeformed bodies touch; the ball's centre lies on the pitch circle."""
        groove = self.groove
        side = -1.0 if groove.race_name == "inner" else 1.0
        normal = side * np.array([sin(groove.contact_angle), cos(groove.contact_angle)])
        centre = np.array([0.0, 0.5 * groove.pitch_diameter])
        # Rounded: the same mesh on every machine. Its size is a choice, not part of the problem.
        exact = ellipse(groove.problem(self.load))
        a, b = (float(f"{axis:.4g}") for axis in (exact.semi_major_axis, exact.semi_minor_axis))
        patch = Patch(normal, a, b, 1.0, self._reach(a))
        compliances = groove.ball.compliance, groove.race.compliance
        return ContactFrame(
            Sphere(centre, groove.ball_radius),
            Torus(centre + (groove.ball_radius - groove.groove_radius) * normal, groove.groove_radius),
            normal,
            patch,
            self.elements,
            compliances[0] / sum(compliances),
        )

    def _reach(self, semi_major_axis: float) -> tuple[float, float]:
        """Of the patch: to the groove's edge where that is near."""
        high, low = (
            room if room < contact_block.PATCH + contact_block.BESIDE else contact_block.PATCH
            for room in self.groove_beside(semi_major_axis)
        )
        return high, low

    def groove_beside(self, semi_major_axis: float) -> tuple[float, float]:
        """How far the groove reaches from the contact, towards larger and smaller angles, in semi-major axes."""
        profile, angle = self.ring_profile, self.groove.contact_angle
        scale = self.groove.groove_radius / semi_major_axis
        return scale * (profile.high_shoulder - angle), scale * (profile.low_shoulder + angle)

    @property
    def ring_profile(self) -> RingProfile:
        """The ring's, given or assumed."""
        groove = self.groove
        offset = -BORE_BELOW_PITCH if groove.race_name == "inner" else OUTSIDE_ABOVE_PITCH
        return self.profile or RingProfile(
            0.5 * groove.pitch_diameter + offset * groove.ball_diameter, WIDTH * groove.ball_diameter
        )

    @cached_property
    def section(self) -> RingSection:
        """The ring's section."""
        groove, profile = self.groove, self.ring_profile
        return RingSection(
            self.frame.groove.centre,
            groove.groove_radius,
            profile.back_radius,
            profile.width,
            groove.race_name == "inner",
            profile.high_shoulder,
            profile.low_shoulder,
        )

    def mesh_file(self, body: str) -> str:
        """Name of the file of a body's mesh, with a digest of all that it is made from."""
        patch = self.frame.patch
        far = bodies.FAR if body == "ring" else bodies.far_in_half_ball(self.elements)
        recipe: list[object] = [patch.semi_major_axis, patch.semi_minor_axis, *_mesh_choices(self.elements, far)]
        recipe += [f"{self.groove.ball_radius:.9g}"]
        recipe += [f"{reach:.6g}" for reach in patch.reach if reach != contact_block.PATCH]
        if body == "ring":
            section = self.section
            lengths = (*section.groove_centre, section.groove_radius, section.back_radius, section.width)
            recipe += [self.groove.race_name, self.ball_count, *(f"{length:.6g}" for length in lengths)]
            shoulders = section.high_shoulder, section.low_shoulder
            recipe += [f"{angle:.6g}" for angle in shoulders if shoulders != (HIGH_SHOULDER, LOW_SHOULDER)]
        digest = hashlib.sha256(json.dumps(recipe).encode()).hexdigest()[:12]
        return f"true_{body}_{self.elements:02d}-{digest}.npz"

    def mesh(self, body: str) -> BodyMesh:
        """Of "ball" (about its centre, contact towards +y) or "ring": kept in the repository, in the cache, or made."""
        name = self.mesh_file(body)
        kept, path = meshing.committed_folder() / name, meshing.cache_folder() / name
        if kept.is_file() or path.is_file():
            return BodyMesh.read(kept if kept.is_file() else path)
        patch = self.frame.patch
        if body == "ball":
            towards_y = replace(patch, normal=np.array([0.0, 1.0]))
            made = bodies.quarter_ball(self.groove.ball_radius, towards_y, self.elements)
        else:
            made = bodies.ring(self.section, patch, self.half_pitch, self.elements)
        path.parent.mkdir(parents=True, exist_ok=True)
        made.save(path)
        return BodyMesh.read(path)  # so that a mesh just made and one read again are the same

    @property
    def cells(self) -> float:
        """Cells of the mesh per semi-axis of the contact it is made for; a whole number of them fills the patch."""
        return (len(self.frame.basis.lines_y) - 1) * self.frame.patch.semi_minor_axis / self.frame.patch.half_width

    @property
    def half_pitch(self) -> float:
        """Half the angle from ball to ball [rad]."""
        return pi / self.ball_count

    def ball(self) -> TetrahedralBody:
        """Half the ball, in its place."""
        frame = self.frame
        axes = np.zeros((3, 3))
        axes[:2, 0], axes[:2, 1], axes[2, 2] = -frame.tangent, frame.normal, 1.0
        mesh = self.mesh("ball").turned(axes).shifted(np.append(frame.ball.centre, 0.0))
        return TetrahedralBody(mesh, self.groove.ball)

    def ring(self) -> TetrahedralBody:
        """The ring's segment."""
        return TetrahedralBody(self.mesh("ring"), self.groove.race)

    def condensed(self, progress: Progress = silent) -> CondensedContact:
        """Mesh both bodies and condense them."""
        frame, groove = self.frame, self.groove
        count = len(frame.basis.forces)
        progress("ball", 0.0)
        across = frame.tangent
        ball = self.ball()
        poles = [_nearest(ball, frame.ball.centre + side * groove.ball_radius * across) for side in (1.0, -1.0)]
        spread = np.zeros((3 * ball.space.count, 1))
        for node, side in zip(poles, (0.5, -0.5), strict=True):
            spread[3 * node : 3 * node + 2, 0] = side * across
        half = condense_supported(ball, _loads(frame, ball, spread, on_ball=True), *self._equator(ball))
        progress("ring", 0.5)
        ring = self.ring()
        segment = condense_supported(ring, _loads(frame, ring, None, on_ball=False), *self._segment(ring))
        surface, axis = slice(0, count), slice(count, 2 * count)
        return CondensedContact(
            self,
            {
                True: half.flexibility[surface, surface] + segment.flexibility[surface, surface],
                False: half.flexibility[axis, axis] + segment.flexibility[axis, axis],
            },
            (
                BodyAlone(half.flexibility[surface, surface], half.held[:, surface], half.dilation, ball.volume),
                BodyAlone(
                    segment.flexibility[surface, surface], segment.held[:, surface], segment.dilation, ring.volume
                ),
            ),
            half.flexibility[-1, surface],
            half.dofs + segment.dofs,
            half.solver,
        )

    def fields(self, pressure: Array) -> dict[str, NodalFields]:
        """Displacement, stress and pressure of both bodies under a pressure along the surfaces' normal."""
        by_body = {}
        for name, body, held in (("ball", self.ball(), self._equator), ("ring", self.ring(), self._segment)):
            on_ball = name == "ball"
            force = self.frame.loads(body, on_ball=on_ball) @ pressure
            on_contact = self.frame.pressure_on(body.nodes, pressure, on_ball=on_ball)
            by_body[name] = fields.of_body(body.space, moved(body, force, *held(body)), on_contact, body.material)
        return by_body

    def _equator(self, ball: TetrahedralBody) -> tuple[Array, sp.csr_matrix]:
        """Which unknowns of the ball are zero, and the directions they count in: normal, tangent, z."""
        frame, count = self.frame, ball.space.count
        offset = ball.nodes[:2] - frame.ball.centre[:, None]
        fixed = np.zeros((count, 3), dtype=bool)
        fixed[np.abs(ball.nodes[2]) < NEAR, 2] = True
        fixed[np.abs(frame.normal @ offset) < NEAR, 0] = True
        # The load has no part along the groove: one node holds the ball there and carries nothing.
        fixed[_nearest(ball, frame.ball.centre), 1] = True
        axes = np.zeros((3, 3))
        axes[:2, 0], axes[:2, 1], axes[2, 2] = frame.normal, frame.tangent, 1.0
        return fixed, sp.csr_matrix(sp.kron(sp.identity(count), axes))

    def _segment(self, ring: TetrahedralBody) -> tuple[Array, sp.csr_matrix]:
        """The same of the ring: rigid seat, planes of symmetry through the contact and midway to the next ball."""
        _, y, z = ring.nodes
        c, s = cos(self.half_pitch), sin(self.half_pitch)
        cut = np.abs(z * c - y * s) < NEAR
        fixed = np.zeros((ring.space.count, 3), dtype=bool)
        fixed[(np.abs(z) < NEAR) | cut, 2] = True
        fixed[np.abs(np.hypot(y, z) - self.section.back_radius) < NEAR] = True
        # On the cut the third unknown is the displacement across it.
        turned = sp.csr_matrix(np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]))
        turn = sp.kron(sp.diags(cut.astype(float)), turned) + sp.kron(sp.diags(1.0 - cut), sp.identity(3))
        return fixed, sp.csr_matrix(turn)


def _mesh_choices(elements: int, far: float) -> list[float]:
    """What `contact_block` and `bodies` settle: a mesh made under another choice is another file."""
    lengths = [contact_block.PATCH, contact_block.WIDTH, contact_block.DEPTH, contact_block.FIRST_LAYER, far]
    growth = [contact_block.depth_growth(elements), contact_block.side_growth(elements)]
    return [elements, contact_block.REVISION, *lengths, *growth, *contact_block.free_size(elements)]


def _nearest(body: TetrahedralBody, point: Array) -> int:
    return int(np.argmin(((body.nodes[:2] - point[:, None]) ** 2).sum(axis=0) + body.nodes[2] ** 2))


def _loads(frame: ContactFrame, body: TetrahedralBody, further: Array | None, *, on_ball: bool) -> sp.csr_matrix:
    parts = [frame.loads(body, on_ball=on_ball, along=along) for along in ("normal", "axis")]
    return sp.csr_matrix(sp.hstack(parts if further is None else [*parts, further]))


@dataclass(frozen=True)
class BodyAlone:
    """One of the two bodies, half of it as it is meshed."""

    flexibility: Array
    """(basis, basis)"""
    held: Array
    """Force of what holds it, per pressure; (axial, radial, tangential) by basis."""
    dilation: float
    """See `CondensedSolid`."""
    volume: float
    """[m3]"""


@dataclass(frozen=True)
class CondensedContact:
    """Both bodies under every pressure basis function; then any load near the mesh's takes milliseconds."""

    contact: TrueContact
    flexibility: dict[bool, Array]
    """Of both bodies, with the pressure along the surfaces' normal (True) or the contact's axis (False)."""
    bodies: tuple[BodyAlone, BodyAlone]
    """Ball and ring, pressed along the surfaces' normal."""
    bulge: Array
    """By how much each basis function pushes the ball's equator out, across the groove [m/Pa]."""
    dofs: int
    solver: str

    def over_hertz(self, load: float, *, follows_surface: bool, parabola: bool = False) -> dict[str, float]:
        """Quantities over Hertz's at the loaded contact angle and `SHAPE`, mean over `POSITIONS` loads about `load`.

        No larger than to where the groove's edge would cut the ellipse.

        Args:
            load: [N]; the mesh must have room for its contact.
            follows_surface: pressure along the normal of the surfaces, or along the contact's axis.
            parabola: Hertz's parabola in place of the exact gap.
        """
        size = (load / self.contact.load) ** (1.0 / 3.0)
        beside = min(self.contact.groove_beside(ellipse(self.contact.groove.problem(load)).semi_major_axis)) - 1.0
        # Semi-axes grow with the cube root of the load: from half a cell less to half a cell more.
        spread = min(1.0 / (size * self.contact.cells), max(2.0 * beside, 0.0))
        at_positions = []
        start: Array | None = None
        for position in range(POSITIONS):
            part = load * (1.0 + ((position + 0.5) / POSITIONS - 0.5) * spread) ** 3
            try:
                pressure, approach = self._pressure(part, follows_surface, parabola, start)
            except NoRoomError as problem:
                raise NoRoomError(
                    f"the contact at {load:g} N fills the patch of the mesh that is made for {self.contact.load:g} N "
                    f"{problem}, with {self.contact.elements} elements per semi-axis; reduce the load, or take more "
                    "elements"
                ) from None
            start = pressure > 0.0
            exact = ellipse(self.contact.groove.problem(part))
            values = (approach, *self._read(pressure))
            scales = [*(getattr(exact, name) for name in READ), *(1.0 for _ in SHAPE)]
            at_positions.append(np.divide(values, scales))
        return dict(zip((*READ, *SHAPE), (float(mean) for mean in np.mean(at_positions, axis=0)), strict=True))

    def pressure(self, load: float) -> Array:
        """Coefficients of the true contact's pressure under a load [Pa]."""
        return self._pressure(load, follows_surface=True, parabola=False)[0]

    def _pressure(
        self, load: float, follows_surface: bool, parabola: bool, start: Array | None = None
    ) -> tuple[Array, float]:
        frame = self.contact.frame
        basis = frame.basis
        problem = self.contact.groove.problem(load)
        gaps = basis.weighted(problem.parabolic_gap if parabola else frame.gap)
        if start is None:
            exact = ellipse(problem)
            start = np.hypot(basis.points[0] / exact.semi_major_axis, basis.points[1] / exact.semi_minor_axis) < 1.0
        # The ball moves along the normal, which is the approach, and along the groove, where no force acts on it.
        along = basis.weighted((lambda x, y: frame.force_direction(x, y)[0]) if follows_surface else (lambda x, y: x))
        scale = float(np.abs(basis.forces).max() / np.abs(along).max())
        motions = np.column_stack([basis.forces, scale * along])
        pressure, moved, _ = contact.active_set(
            self.flexibility[follows_surface], gaps, motions, np.array([0.5 * load, 0.0]), start
        )
        x, y = basis.points
        # Where the groove ends the contact may.
        high, low = (reach == contact_block.PATCH for reach in frame.patch.reach)
        pressed, near = pressure > 0.0, 1.0 - 1e-9
        filled = {
            "towards the shoulder": high & (x <= near * basis.lines_x[0]),
            "towards the open side": low & (x >= near * basis.lines_x[-1]),
            "along rolling": y >= near * basis.lines_y[-1],
        }
        if ends := [end for end, nodes in filled.items() if (nodes & pressed).any()]:
            raise NoRoomError(" and ".join(ends))
        return pressure, float(moved[0])

    def _read(self, pressure: Array) -> tuple[float, ...]:
        """Semi-axes about the pressure's own centre, the pressure there, and what `SHAPE` names."""
        basis = self.contact.frame.basis
        (x, y), area = basis.samples
        at = basis.values(x, y) @ pressure
        share = at * area / (at @ area)
        x = x - share @ x
        a, b = float(np.sqrt(5.0 * (share @ x**2))), float(np.sqrt(5.0 * (share @ y**2)))
        return a, b, *central_shape(x / a, y / b, area, at)

    def added_compliances(self, load: float) -> tuple[float, float]:
        """What ball and ring each add to the approach of a half-space under Hertz's gap, over the load [m/N].

        The difference of twice the energies, work along the displacement and along the gap: at the solution it is
        stationary, so that the mesh's error in the pressure counts squared.
        """
        problem = self.contact.groove.problem(load)
        pressure, _ = self._pressure(load, follows_surface=True, parabola=True)
        exact = ellipse(problem)
        # Means over Hertz's pressure, of which <x^2> = a^2/5; each half-space has its compliance's share of all.
        along_gap = (
            0.1 * problem.curvature_x * exact.semi_major_axis**2 + 0.1 * problem.curvature_y * exact.semi_minor_axis**2
        )
        basis = self.contact.frame.basis
        force = float(basis.forces @ pressure)
        rest = exact.approach + along_gap - 2.0 * float(basis.weighted(problem.parabolic_gap) @ pressure) / force
        ball, ring = (float(pressure @ body.flexibility @ pressure) / force for body in self.bodies)
        share = self.contact.frame.ball_share
        return (ball - share * rest) / load, (ring - (1.0 - share) * rest) / load

    def bulges(self, load: float) -> tuple[float, float]:
        """By how much the ball's equator moves out, across the groove: finite elements, exact sphere [m]."""
        frame = self.contact.frame
        pressure, _ = self._pressure(load, follows_surface=True, parabola=False)
        (x, y), area = frame.basis.samples
        slant = frame.ball_height(x, y)[1][2]
        forces = 2.0 * area * (frame.basis.values(x, y) @ pressure) / slant
        # The pole across the groove lies at right angles to the contact.
        sphere = references.pressed_sphere(x / frame.ball.radius, forces, frame.ball.radius, self.contact.groove.ball)
        return float(self.bulge @ pressure), sphere
