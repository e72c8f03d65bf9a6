"""One contact of ball and groove: its frame, both exact surfaces over it, and the pressure's basis on it.

The frame's origin is where the surfaces are nearest each other; xi runs across the groove, eta along rolling (z), zeta
along the normal from ball to raceway. Pressure is taken over the tangent plane. A column of force over d xi d eta is
p m with m = n/(n . e_zeta), n the normal of the surface that the deformed bodies share: that is pressure p on the true
area; the gap conjugate to it counts along zeta. Both surfaces are exact, sphere and torus, at whatever position the
bodies have: nothing here knows a mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import sin

import numpy as np
import scipy.sparse as sp

from fem_check.elements.pressure_basis import PressureBasis
from fem_check.independent.contact_problem import Array
from fem_check.solids import contact_block
from fem_check.solids.contact_block import Patch
from fem_check.solids.tetrahedral_body import TetrahedralBody

HEIGHT_ITERATIONS, ROUNDING = 8, 1e-15
"""Of Newton's iteration for the height of a groove, and the part of its radius below which an error is rounding."""


@dataclass(frozen=True)
class Sphere:
    """The ball's surface."""

    centre: Array
    """(axial, radial) [m]"""
    radius: float
    """[m]"""


@dataclass(frozen=True)
class Torus:
    """The groove's surface: a circle turned about the bearing's axis."""

    centre: Array
    """Of the circle, (axial, radial) [m]."""
    radius: float
    """[m]"""


@dataclass(frozen=True)
class ContactFrame:
    """Where ball and groove touch, and the frame there; vectors are (axial, radial) in the plane of symmetry."""

    ball: Sphere
    groove: Torus
    normal: Array
    """Unit vector from ball to raceway."""
    patch: Patch
    """Expected extent of the contact."""
    elements: int
    """Pressure cells per semi-minor axis, as the mesh has elements."""
    ball_share: float
    """The ball's share of both bodies' compliance: by so much of the gap the ball's surface gives way."""

    @property
    def tangent(self) -> Array:
        """Unit vector across the groove."""
        return np.array([-self.normal[1], self.normal[0]])

    @property
    def origin(self) -> Array:
        """On the ball's undeformed surface."""
        return self.ball.centre + self.ball.radius * self.normal

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Of the patch, along xi; where the groove ends, its edge."""
        low, high = (
            self.groove.radius * sin(length / self.groove.radius) if reach != contact_block.PATCH else length
            for length, reach in zip(self.patch.lengths, self.patch.reach, strict=True)
        )
        return -low, high

    @cached_property
    def basis(self) -> PressureBasis:
        """Hat functions over half the patch, eta >= 0."""
        x, y = self.ends, self.patch.half_width
        along, across = contact_block.cells(self.patch.along * self.elements), contact_block.cells(self.elements)
        return PressureBasis(np.linspace(*x, 2 * along + 1), np.linspace(0.0, y, across + 1))

    def ball_height(self, xi: Array, eta: Array, ball: Sphere | None = None) -> tuple[Array, Array]:
        """Height zeta of the ball's surface and its outward normals in frame axes, (3, point)."""
        ball = ball or self.ball
        offset = ball.centre - self.origin
        x, depth = xi - offset @ self.tangent, offset @ self.normal
        rise = np.sqrt(ball.radius**2 - x * x - eta * eta)
        return depth + rise, np.stack([x, eta, rise]) / ball.radius

    def groove_height(
        self, xi: Array, eta: Array, groove: Torus | None = None, start: Array | None = None
    ) -> tuple[Array, Array]:
        """Height zeta of the groove's surface and its normals into the ring in frame axes, (3, point).

        Args:
            xi: across the groove, (point,) [m].
            eta: along rolling.
            groove: another than that of the frame.
            start: heights nearby, from which to begin.
        """
        groove = groove or self.groove
        # Newton's iteration for the height; distances from the circle's centre line.
        zeta = np.zeros_like(xi) if start is None else start
        for _ in range(HEIGHT_ITERATIONS):
            axial = self.origin[0] + xi * self.tangent[0] + zeta * self.normal[0]
            height = self.origin[1] + xi * self.tangent[1] + zeta * self.normal[1]
            reach = np.hypot(height, eta)
            across, up = axial - groove.centre[0], reach - groove.centre[1]
            distance = np.hypot(across, up)
            gradient = np.stack([across, up * height / reach, up * eta / reach]) / distance
            step = (distance - groove.radius) / (gradient[:2].T @ self.normal)
            zeta = zeta - step
            if np.abs(step).max(initial=0.0) < np.sqrt(ROUNDING) * groove.radius:
                break  # the error left is that step's square
        return zeta, np.stack([self.tangent @ gradient[:2], gradient[2], self.normal @ gradient[:2]])

    def gap(self, xi: Array, eta: Array, ball: Sphere | None = None, groove: Torus | None = None) -> Array:
        """Gap along zeta of the undeformed surfaces, negative where they overlap [m]."""
        return self.groove_height(xi, eta, groove)[0] - self.ball_height(xi, eta, ball)[0]

    def force_direction(self, xi: Array, eta: Array) -> Array:
        """m, the force over d xi d eta per pressure, ball to raceway; in frame axes, (3, point)."""
        ball, groove = self.ball_height(xi, eta)[1], self.groove_height(xi, eta)[1]
        shared = (1.0 - self.ball_share) * ball / ball[2] + self.ball_share * groove / groove[2]
        return shared

    def in_space(self, vectors: Array) -> Array:
        """Frame axes to axial, radial, tangential; (3, point)."""
        plane = np.outer(self.tangent, vectors[0]) + np.outer(self.normal, vectors[2])
        return np.concatenate([plane, vectors[1:2]])

    def loads(self, body: TetrahedralBody, *, on_ball: bool, along: str = "normal") -> sp.csr_matrix:
        """Nodal forces on a body whose mesh stands in space, of each basis function of unit pressure, (dof, basis).

        Args:
            body: the ball or the ring; its nodes in (axial, radial, tangential), the ball's centre in its place.
            on_ball: which of the two it is.
            along: "normal" of the surface; "axis": of the tangent plane, as half-spaces have it; "tangent": the same
                force as along the normal, but across the groove, towards growing xi on the ball.
        """
        height = self.ball_height if on_ball else self.groove_height

        def on_patch(points: Array) -> Array:
            xi, eta, zeta = self.coordinates(points)
            near = (np.abs(xi) < 1.2 * max(self.patch.lengths)) & (eta < 1.5 * self.patch.half_width)
            surface = np.full(xi.shape, np.inf)
            surface[near] = height(xi[near], eta[near])[0]
            return np.abs(zeta - surface) < 1e-6 * self.ball.radius

        facets = body.facets(on_patch)
        xi, eta, _ = self.coordinates(facets.points)
        projected = np.abs(self.normal @ facets.directed_areas[:2])
        weights = sp.diags(projected) @ self.basis.values(xi, eta)
        if along == "normal":
            direction = self.in_space(self.force_direction(xi, eta))
        elif along == "axis":
            direction = self.in_space(np.stack([np.zeros_like(xi), np.zeros_like(xi), np.ones_like(xi)]))
        else:
            direction = -self.in_space(_across(self.force_direction(xi, eta)))
        sign = -1.0 if on_ball else 1.0
        return body.surface_loads(facets, [sp.csr_matrix(sp.diags(sign * d) @ weights) for d in direction])

    def coordinates(self, points: Array) -> Array:
        """(axial, radial, tangential) to xi, eta, zeta; (3, point)."""
        offset = points[:2] - self.origin[:, None]
        return np.stack([self.tangent @ offset, points[2], self.normal @ offset])

    def pressure_on(self, points: Array, pressure: Array, *, on_ball: bool) -> Array:
        """Pressure at points of a body, zero away from the contact, (point,).

        Args:
            points: (axial, radial, tangential), (3, point).
            pressure: its coefficients, (basis,).
            on_ball: which body's surface.
        """
        xi, eta, zeta = self.coordinates(points)
        near = (xi > self.ends[0]) & (xi < self.ends[1]) & (eta < self.patch.half_width)
        height = (self.ball_height if on_ball else self.groove_height)(xi[near], eta[near])[0]
        near[near] = np.abs(zeta[near] - height) < 1e-5 * self.ball.radius
        values = np.zeros(points.shape[1])
        values[near] = self.basis.values(xi[near], eta[near]) @ pressure
        return values

    @cached_property
    def resultants(self) -> Array:
        """Force on the raceway in the plane, of each basis function, both halves; shape (2, basis)."""
        return self._summed(self.force_direction)

    @cached_property
    def friction_resultants(self) -> Array:
        """Force on the ball of the same pressures as friction, towards growing xi; shape (2, basis)."""
        return self._summed(lambda x, y: _across(self.force_direction(x, y)))

    def _summed(self, direction: Callable[[Array, Array], Array]) -> Array:
        along, into = (self.basis.weighted(lambda x, y, axis=axis: direction(x, y)[axis]) for axis in (0, 2))  # type: ignore[misc]
        return 2.0 * (np.outer(self.tangent, along) + np.outer(self.normal, into))

    def weighted_gap(self, ball: Sphere, groove: Torus) -> Array:
        """Integral of each basis function times the gap at a position of the bodies, (basis,)."""
        return self.basis.weighted(
            lambda x, y: self.groove_height(x, y, groove, self._heights)[0] - self.ball_height(x, y, ball)[0]
        )

    @cached_property
    def _heights(self) -> Array:
        """Of the groove in its own place, at the points where gaps are weighted: other places are micrometres away."""
        (x, y), _ = self.basis.samples
        return self.groove_height(x, y)[0]


def _across(direction: Array) -> Array:
    """The force turned by a right angle in the plane of xi and zeta, and of its magnitude."""
    size = np.linalg.norm(direction, axis=0)
    flat = np.stack([direction[2], np.zeros_like(size), -direction[0]])
    return flat * (size / np.linalg.norm(flat, axis=0))
