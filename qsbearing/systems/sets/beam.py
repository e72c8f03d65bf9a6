"""The shaft as a Timoshenko beam, clamped at one section: what a load at one place moves at another.

A shaft clamped at its reference position is two cantilevers, whose inner forces follow from statics. By the unit-load
theorem, with s running from the clamp to the nearer of the places x and a on the same side of it,

    v(x) = integral of (x - s) ((a - s) F + M)/(E I) + F/(k G A),      dv/dx = integral of ((a - s) F + M)/(E I),

both integrals by Gauss's rule, which is exact for sections of constant diameters and, with more points, as good as
exact for cones: nothing is meshed. Bending in the planes xy and xz and tension do not interact.

Shear coefficient k: Cowper, The shear coefficient in Timoshenko's beam theory (1966), hollow circular section, with
m = inner over outer diameter:

    k = 6 (1 + nu) (1 + m^2)^2 / ((7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2)
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Beam(NamedTuple):
    """Sections end to end; arrays over the sections last."""

    begin: NDArray
    end: NDArray
    outer: NDArray
    """Diameters [m]: where each section begins, and by how much they grow to where it ends; shape (2, ..., section)."""
    inner: NDArray
    """Diameters of the bore [m], as of `outer`."""
    modulus: NDArray
    poisson_ratio: NDArray

    def at(self, place: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        """(E A [N], E I [N m^2], k G A [N]) of each section at a place in it."""
        part = (place - self.begin) / (self.end - self.begin)
        outer, inner = (first + part * grows for first, grows in (self.outer, self.inner))
        area = 0.25 * np.pi * (outer**2 - inner**2)
        second_moment = np.pi / 64.0 * (outer**4 - inner**4)
        shear_modulus = 0.5 * self.modulus / (1.0 + self.poisson_ratio)
        shear = shear_coefficient(self.poisson_ratio, inner, outer) * shear_modulus * area
        return self.modulus * area, self.modulus * second_moment, shear


CYLINDER, CONE = (np.polynomial.legendre.leggauss(points) for points in (2, 8))
"""Gauss's rules, (points, weights) on -1 to 1. Along a cylinder 2 points are exact; along a cone whose diameter
doubles, 8 are good to 1e-8, and with their number the error falls geometrically."""


def shear_coefficient(poisson_ratio: ArrayLike, inner_diameter: ArrayLike, outer_diameter: ArrayLike) -> NDArray:
    """Cowper's, of a hollow circular section."""
    nu, m = np.asarray(poisson_ratio, float), np.asarray(inner_diameter, float) / np.asarray(outer_diameter, float)
    ring = (1.0 + m**2) ** 2
    return np.asarray(6.0 * (1.0 + nu) * ring / ((7.0 + 6.0 * nu) * ring + (20.0 + 12.0 * nu) * m**2))


def flexibility(beam: Beam, clamp: NDArray, at: NDArray, loaded: NDArray) -> NDArray:
    """What unit loads move, the shaft clamped; shape (..., at, loaded, 5, 5) [m/N, rad/N, m/(N m), rad/(N m)].

    Displacements are rows and loads columns, in the order x, y, z, tilt y, tilt z; tilt z is dy/dx, tilt y is -dz/dx.

    Args:
        beam: arrays of shape (..., section).
        clamp: shape (...).
        at, loaded: places of shape (..., at) and (..., loaded), in the beam.
    """
    held = clamp[..., None, None]
    x, a = np.broadcast_arrays(at[..., :, None], loaded[..., None, :])
    nearest = np.where(np.abs(x - held) < np.abs(a - held), x, a)
    nearest = np.where((x - held) * (a - held) > 0.0, nearest, held)
    low, high = np.minimum(nearest, held)[..., None], np.maximum(nearest, held)[..., None]
    whole = Beam(*(each[..., None, None, :] for each in beam))
    begin, end = np.maximum(whole.begin, low), np.minimum(whole.end, high)
    length, middle = np.maximum(end - begin, 0.0), 0.5 * (begin + end)
    total = np.zeros((5, *x.shape))
    points, weights = CONE if beam.outer[1].any() or beam.inner[1].any() else CYLINDER
    for point, weight in zip(points, 0.5 * weights, strict=True):
        place, part = middle + 0.5 * point * length, weight * length
        tension, bending, shear = whole.at(np.clip(place, whole.begin, whole.end))
        to_x, to_a = x[..., None] - place, a[..., None] - place
        bent = to_x * to_a / bending + 1.0 / shear
        each = (bent, to_x / bending, to_a / bending, 1.0 / bending, 1.0 / tension)
        total += np.stack(np.broadcast_arrays(*((part * one).sum(axis=-1) for one in each)))
    deflection, by_moment, slope, turn, stretch = total
    out = np.zeros((*deflection.shape, 5, 5))
    out[..., 0, 0] = stretch
    out[..., 1, 1] = out[..., 2, 2] = deflection
    out[..., 1, 4], out[..., 2, 3] = by_moment, -by_moment
    out[..., 4, 1], out[..., 3, 2] = slope, -slope
    out[..., 3, 3] = out[..., 4, 4] = turn
    return out


def rigid_motion(arm: ArrayLike) -> NDArray:
    """What a rigid shaft's displacement is this far along it; shape (..., 5, 5)."""
    lever = np.asarray(arm, float)
    out = np.zeros((*lever.shape, 5, 5))
    out[..., range(5), range(5)] = 1.0
    out[..., 1, 4], out[..., 2, 3] = lever, -lever
    return out
