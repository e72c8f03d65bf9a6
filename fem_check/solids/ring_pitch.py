"""One pitch of a free outer ring under its ball, in three dimensions: how far it grows and bends beyond its contact.

Hertz's pressure presses the groove along the contact's axis; the work that it does with the outside diameter free, less
that with the outside diameter fixed, has no part of the contact in it. Both cut planes are planes of symmetry: as many
balls as fit round the ring carry the same, which bends it with n = Z, 2 Z, ... besides making it grow.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin

import numpy as np

from fem_check.independent.references import hertz
from fem_check.solids.bearing_sector import OuterSupport, ring_support
from fem_check.solids.condensation import moved
from fem_check.solids.sector_geometry import Expected, SectorBearing, SectorGeometry
from fem_check.solids.tetrahedral_body import TetrahedralBody


@dataclass(frozen=True)
class RingPitch:
    """A ring's segment, pressed by its ball at some contact angle [rad] with some load [N]."""

    bearing: SectorBearing
    angle: float
    load: float
    elements: int

    @cached_property
    def _axes(self) -> tuple[float, float]:
        exact = hertz(self.bearing.drawing.groove("outer", self.angle).problem(self.load))
        return exact.semi_major_axis, exact.semi_minor_axis

    @cached_property
    def geometry(self) -> SectorGeometry:
        """The ball where it touches the groove at that angle."""
        reach = self.bearing.groove_radius(inner=False) - self.bearing.ball_radius
        axial, radial = self.bearing.groove_centre(inner=False) + reach * np.array([sin(self.angle), cos(self.angle)])
        return SectorGeometry(self.bearing, Expected(0.0, (axial, radial), self._axes, self._axes), self.elements)

    @cached_property
    def radial_compliance(self) -> float:
        """Radial displacement of the groove by one ball's radial load, as all balls carry it [m/N]."""
        basis = self.geometry.frames[1].basis
        x, y = basis.points
        pressure = np.sqrt(np.maximum(1.0 - (x / self._axes[0]) ** 2 - (y / self._axes[1]) ** 2, 0.0))
        pressure *= 0.5 / (basis.forces @ pressure)  # of half the load, for half the contact is meshed
        body = TetrahedralBody(self.geometry.mesh("outer"), self.bearing.drawing.ring)
        matrix = body.stiffness
        force = self.geometry.frames[1].loads(body, on_ball=False, along="axis") @ pressure
        free, fixed = (
            force @ moved(body, force, *ring_support(body, self.geometry, "outer", support), matrix).ravel()
            for support in (OuterSupport.FREE, OuterSupport.RIGID)
        )
        return float(2.0 * (free - fixed)) / cos(self.angle) ** 2
