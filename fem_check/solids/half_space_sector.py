"""The sector with half-spaces for bodies: the same surfaces, positions, inertia and equilibrium, no mesh.

All that the bodies' size does is absent, so that the quasi-static model must come out, but for what boundary elements
say of the gap's shape. What the sector with meshed bodies finds beyond this is those bodies' own elasticity.

The influence of pressure follows `fem_check.mechanics.boundary_element`, on rectangles a few to a cell of the pressure.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from scipy import fft

from fem_check.independent.contact_problem import Array
from fem_check.independent.drawing import BearingDrawing
from fem_check.mechanics.boundary_element import lengthwise_influence, normal_influence
from fem_check.solids.bearing_sector import OuterSupport, Sector
from fem_check.solids.contact_frame import ContactFrame
from fem_check.solids.sector_geometry import SectorGeometry

SUBDIVISIONS = 3
"""Rectangles along each side of a cell."""


class HalfSpaceSector(Sector):
    """Ball and rings as half-spaces; a gyroscopic moment's friction, opposite on bodies of one material, moves no gap.

    Of two materials it would, by the second Dundurs constant: left out.
    """

    def __init__(self, geometry: SectorGeometry) -> None:
        super().__init__(geometry, OuterSupport.RIGID, friction=True)

    @cached_property
    def flexibility(self) -> Array:  # type: ignore[override]
        """Inner normal, outer normal, outer friction; of the last only its place."""
        first, second = self.counts
        total = np.zeros((first + 2 * second,) * 2)
        inner, outer = (half_spaces(frame, self.geometry.bearing.drawing) for frame in self.geometry.frames)
        total[:first, :first] = inner
        total[first : first + second, first : first + second] = outer
        return total


def half_spaces(frame: ContactFrame, drawing: BearingDrawing) -> Array:
    """Flexibility of two half-spaces under a contact's pressure functions, each with its mirror image at y < 0."""
    basis = frame.basis
    lines, sides = [], []
    for grid in (basis.lines_x, basis.lines_y):
        step = (grid[1] - grid[0]) / SUBDIVISIONS
        lines.append(grid[0] + step * (np.arange(SUBDIVISIONS * (len(grid) - 1)) + 0.5))
        sides.append(float(step))
    x, y = np.meshgrid(*lines, indexing="ij")
    half = basis.values(x.ravel(), y.ravel()).toarray()
    slope = frame.force_direction(x.ravel(), y.ravel())[0].reshape(x.shape)
    slope = np.concatenate([slope[:, ::-1], slope], axis=1)
    count = (x.shape[0], 2 * x.shape[1])
    shape = [fft.next_fast_len(2 * n - 1, real=True) for n in count]
    at = [np.fft.fftfreq(n, 1.0 / n) * side for n, side in zip(shape, sides, strict=True)]
    direct, along = (
        fft.rfft2(influence(at[0][:, None], at[1], *sides)) for influence in (normal_influence, lengthwise_influence)
    )
    compliances = drawing.ball.compliance, drawing.ring.compliance
    poisson = (drawing.ball.poisson_ratio * compliances[0] + drawing.ring.poisson_ratio * compliances[1]) / sum(
        compliances
    )
    e = poisson / (1.0 - poisson)
    square, shared = -0.25 * (0.5 + e) * along, direct + 0.5 * (e - 0.5) * along

    def displacement(pressure: Array) -> Array:
        p, ssp, sp = (fft.rfft2(each, s=shape) for each in (pressure, slope**2 * pressure, slope * pressure))
        parts = [
            fft.irfft2(each, s=shape)[: count[0], : count[1]]
            for each in (direct * p + square * ssp, square * p, shared * sp)
        ]
        return np.asarray(parts[0] + slope**2 * parts[1] + slope * parts[2])

    moved = np.empty_like(half)
    for number, each in enumerate(half.T):
        upper = each.reshape(x.shape)
        moved[:, number] = displacement(np.concatenate([upper[:, ::-1], upper], axis=1))[:, x.shape[1] :].ravel()
    flexibility = sum(compliances) * sides[0] * sides[1] * (half.T @ moved)
    return 0.5 * (flexibility + flexibility.T)
