"""One ball between both rings: half a ball pitch, three elastic bodies, both contact angles free.

The bodies are meshed where they are expected, undeformed, so that they overlap by the approaches; pressures and
positions are then the finite elements' own: the inner ring's axial displacement and the ball's centre follow by
Newton's method from the equilibrium of ball and inner ring, with the exact surfaces at every step. The ball is free;
the force that balances its contacts acts as a body force, as the centrifugal force does. The inner ring's bore is
rigid, the outer ring is held as `OuterSupport` says; both cut planes of the segment are planes of symmetry.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from math import atan, cos, hypot, pi, sin, tan

import numpy as np
import scipy.sparse as sp
from scipy.optimize import root

from fem_check.independent.contact_problem import Array
from fem_check.independent.references import ellipse
from fem_check.mechanics.contact import ContactError, active_set
from fem_check.solids import contact_results, normal_contact
from fem_check.solids.condensation import NEAR, CondensedSolid, condense_free, condense_supported
from fem_check.solids.contact_frame import ContactFrame, Sphere
from fem_check.solids.contact_results import ContactResults
from fem_check.solids.normal_contact import NormalContact
from fem_check.solids.sector_geometry import SectorGeometry
from fem_check.solids.tetrahedral_body import TetrahedralBody

FRICTION_ITERATIONS = 20
FRICTION_TOLERANCE = 1e-8
XTOL = 1e-11
"""Of the positions' micrometres: below it their metres round."""
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
    pressures: tuple[Array, Array]
    """Coefficients of each contact's basis functions [Pa]."""
    friction: Array
    """Coefficients of the friction at the outer contact [Pa]; zero without a gyroscopic moment."""
    gaps: tuple[Array, Array]
    """Mean gap over each basis function, of the deformed bodies [m]."""


class Sector:
    """Positions and pressures in equilibrium, whatever bodies give way under the contacts' pressures."""

    flexibility: Array
    """Of all bodies together: inner normal, outer normal (, outer friction)."""

    def __init__(self, geometry: SectorGeometry, support: OuterSupport, friction: bool) -> None:
        self.geometry = geometry
        self.support = support
        self.friction = friction
        inner, outer = geometry.frames
        self.counts = (len(inner.basis.forces), len(outer.basis.forces))

    def solve(self, load: SectorLoad) -> SectorResults:
        """Positions and pressures in equilibrium.

        Raises:
            ContactError: no equilibrium found near the expected position.
        """
        if load.gyroscopic_moment and not self.friction:
            raise ValueError("a gyroscopic moment needs the sector condensed with friction=True")
        friction = np.zeros(self.counts[1])
        start = np.zeros(3)
        for _ in range(FRICTION_ITERATIONS):
            state = _State(self, load, friction)
            equilibrium = root(state.residual, start, method="hybr", options={"xtol": XTOL, "eps": 1e-7})
            worst = float(np.abs(state.residual(equilibrium.x)).max())
            if not worst < RESIDUAL:
                raise ContactError(
                    f"no equilibrium of ball and inner ring: {worst:.1e} of the load is left ({equilibrium.message})"
                )
            start = equilibrium.x
            if not load.gyroscopic_moment:
                break
            previous, friction = friction, state.friction_pressures()
            if np.abs(friction - previous).max() < FRICTION_TOLERANCE * friction.max():
                break
        return state.results(worst)


class BearingSector(Sector):
    """The three bodies, condensed onto their contacts; then any load near the expected one takes milliseconds."""

    def __init__(
        self, geometry: SectorGeometry, support: OuterSupport = OuterSupport.RIGID, friction: bool = False
    ) -> None:
        """Mesh and condense.

        Args:
            geometry: the bodies, and where they are meshed.
            support: how the outer ring is held.
            friction: also condense the outer contact's friction, for the gyroscopic moment.
        """
        super().__init__(geometry, support, friction)
        inner, outer = geometry.frames
        ball = TetrahedralBody(geometry.mesh("ball"), geometry.bearing.drawing.ball)
        kinds = ("normal", "tangent") if friction else ("normal",)
        on_ball = [(inner, "normal"), *((outer, kind) for kind in kinds), (inner, "axis"), (outer, "axis")]
        self.ball = condense_free(ball, _loads(ball, on_ball))
        self.inner_ring = condensed_ring(geometry, "inner", ("normal", "axis"), OuterSupport.RIGID)
        self.outer_ring = condensed_ring(geometry, "outer", (*kinds, "axis"), support)

    def supports(self, results: SectorResults) -> dict[str, Array]:
        """Forces of what holds each body on it, summed over its mesh and over both halves [N].

        "inner" and "outer": along the axis, radially and along rolling; "ball": of what only stops its rigid motions.
        """
        inner, outer = results.pressures
        rubbing = [results.friction] if self.friction else []
        unused = [np.zeros_like(inner), np.zeros_like(outer)]
        bodies = {
            "inner": (self.inner_ring, [inner, unused[0]]),
            "outer": (self.outer_ring, [outer, *rubbing, unused[1]]),
            "ball": (self.ball, [inner, outer, *rubbing, *unused]),
        }
        return {name: 2.0 * body.held @ np.concatenate(loads) for name, (body, loads) in bodies.items()}

    @property
    def dofs(self) -> int:
        """Unknowns of all three bodies."""
        return self.ball.dofs + self.inner_ring.dofs + self.outer_ring.dofs

    @cached_property
    def flexibility(self) -> Array:  # type: ignore[override]
        """Of all bodies together: inner normal, outer normal (, outer friction)."""
        first, second = self.counts
        count = first + second * (2 if self.friction else 1)
        total = self.ball.flexibility[:count, :count].copy()
        total[:first, :first] += self.inner_ring.flexibility[:first, :first]
        total[first:, first:] += self.outer_ring.flexibility[: count - first, : count - first]
        return total

    def parabola_over_hertz(self, race: str, results: ContactResults) -> dict[str, float]:
        """A contact's ellipse and pressure over Hertz's where Hertz is exact but for the bodies' size and the mesh.

        The same bodies under the same load at the same place, with Hertz's parabola for a gap and the pressure along
        the contact's axis: what differs from 1 is the mesh, for the bodies' size moves the approach alone.
        """
        inner, frames = race == "inner", self.geometry.frames
        frame, ring = (frames[0], self.inner_ring) if inner else (frames[1], self.outer_ring)
        first, second = self.counts
        on_ball = slice(-first - second, -second) if inner else slice(-second, None)
        on_ring = slice(-(first if inner else second), None)
        flexibility = self.ball.flexibility[on_ball, on_ball] + ring.flexibility[on_ring, on_ring]
        problem = self.geometry.bearing.drawing.groove(race, results.angle).problem(results.load)
        exact = ellipse(problem)
        basis = frame.basis
        gaps = basis.weighted(lambda x, y: problem.parabolic_gap(x - results.centre, y))
        x, y = basis.points
        start = np.hypot((x - results.centre) / exact.semi_major_axis, y / exact.semi_minor_axis) < 1.0
        along = basis.weighted(lambda x, y: x - results.centre)
        motions = np.column_stack([basis.forces, along * np.abs(basis.forces).max() / np.abs(along).max()])
        pressure, _, _ = active_set(flexibility, gaps, motions, np.array([0.5 * results.load, 0.0]), start)
        quantities = contact_results.ellipse(frame, pressure)
        return {name: value / getattr(exact, name) for name, value in quantities.items()}


def condensed_ring(geometry: SectorGeometry, name: str, kinds: Sequence[str], support: OuterSupport) -> CondensedSolid:
    """A segment of the inner or the outer ring, condensed onto the pressure of its contact.

    Args:
        geometry: the bodies.
        name: "inner" or "outer".
        kinds: directions of the pressure, see `ContactFrame.loads`.
        support: how the cylinder away from the groove is held.
    """
    frame = geometry.frames[0 if name == "inner" else 1]
    body = TetrahedralBody(geometry.mesh(name), geometry.bearing.drawing.ring)
    loads = _loads(body, [(frame, kind) for kind in kinds])
    return condense_supported(body, loads, *ring_support(body, geometry, name, support))


class _State:
    """Bodies at a trial position, under given friction."""

    def __init__(self, sector: Sector, load: SectorLoad, friction: Array) -> None:
        self.sector = sector
        self.geometry = sector.geometry
        self.load = load
        self.friction = friction
        self.contact: NormalContact | None = None
        self.unit = 1e-6
        """Of the position's unknowns [m]."""

    def residual(self, position: Array) -> Array:
        """Imbalance of ball (axial, radial) and inner ring (axial), over the load per ball."""
        sector, geometry, bearing = self.sector, self.geometry, self.geometry.bearing
        self.displacement = geometry.expected.axial_displacement + self.unit * position[0]
        ball = Sphere(np.array(geometry.expected.ball_centre) + self.unit * position[1:], bearing.ball_radius)
        self.ball = ball
        count, flexibility = sum(sector.counts), sector.flexibility
        gaps = np.concatenate(
            [
                frame.weighted_gap(ball, geometry.groove(self.displacement, inner=inner))
                for frame, inner in zip(geometry.frames, (True, False), strict=True)
            ]
        )
        gaps = gaps + flexibility[:count, count:] @ self.friction[: flexibility.shape[0] - count]
        start = self.contact.active if self.contact is not None else None
        self.contact = normal_contact.solve(flexibility[:count, :count], gaps, start)
        inner, outer = self.forces()
        per_ball = self.load.axial_load / bearing.ball_count
        self.centrifugal, self.gyroscopic = self.inertia(inner, outer)
        rubbing = geometry.frames[1].friction_resultants @ self.friction
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
            frame.resultants @ pressure for frame, pressure in zip(self.geometry.frames, self.pressures(), strict=True)
        )
        return first, second

    def inertia(self, inner: Array, outer: Array) -> tuple[float, float]:
        """Centrifugal force and size of the gyroscopic moment, from this state's orbit radius and angles."""
        if not self.load.speed:
            return 0.0, 0.0
        bearing = self.geometry.bearing
        radius = float(self.ball.centre[1])
        orbit, rotation, attitude = motion(
            bearing.ball_radius / radius, np.arctan2(-inner[0], -inner[1]), np.arctan2(outer[0], outer[1])
        )
        speed = self.load.speed
        return (
            bearing.drawing.ball_mass * radius * (orbit * speed) ** 2,
            bearing.drawing.ball_inertia * abs(orbit * rotation * sin(attitude)) * speed**2,
        )

    def friction_pressures(self) -> Array:
        """Friction that gives the gyroscopic moment, everywhere the same part of the pressure."""
        _, outer = self.pressures()
        share = 2.0 * self.gyroscopic / self.geometry.bearing.drawing.ball_diameter / hypot(*self.forces()[1])
        return share * outer

    def results(self, imbalance: float) -> SectorResults:
        """Everything read."""
        assert self.contact is not None
        frames, first = self.geometry.frames, self.sector.counts[0]
        inner, outer = (
            contact_results.read(frame, pressure) for frame, pressure in zip(frames, self.pressures(), strict=True)
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
            self.pressures(),
            self.friction,
            (self.contact.left[:first] / frames[0].basis.forces, self.contact.left[first:] / frames[1].basis.forces),
        )


def ring_support(
    body: TetrahedralBody, geometry: SectorGeometry, name: str, support: OuterSupport
) -> tuple[Array, sp.csr_matrix]:
    """Which unknowns of a ring are zero, and the rotation of the unknowns on its second cut plane, as
    `condense_supported` takes them."""
    bearing, frame = geometry.bearing, geometry.frames[0 if name == "inner" else 1]
    section = bearing.section(frame.groove.centre, inner=name == "inner")
    half_pitch = pi / bearing.ball_count
    x, y, z = body.nodes
    fixed = np.zeros((body.space.count, 3), dtype=bool)
    fixed[np.abs(z) < NEAR, 2] = True
    cut = np.abs(z * cos(half_pitch) - y * sin(half_pitch)) < NEAR
    fixed[cut, 2] = True
    if support is OuterSupport.RIGID:
        fixed[np.abs(np.hypot(y, z) - section.back_radius) < NEAR] = True
    else:
        fixed[np.abs(x - (section.groove_centre[0] + 0.5 * section.width)) < NEAR, 0] = True
    # On the second cut plane the third unknown is the displacement across it.
    c, s = cos(half_pitch), sin(half_pitch)
    turned = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    turn = sp.kron(sp.diags(cut.astype(float)), turned) + sp.kron(sp.diags(1.0 - cut), sp.identity(3))
    return fixed, sp.csr_matrix(turn)


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


def _loads(body: TetrahedralBody, loads: Sequence[tuple[ContactFrame, str]]) -> sp.csr_matrix:
    """Nodal forces of the pressures of these contacts, each along its direction; the ball is the body between both."""
    on_ball = len({id(frame) for frame, _ in loads}) > 1
    return sp.csr_matrix(sp.hstack([frame.loads(body, on_ball=on_ball, along=along) for frame, along in loads]))
