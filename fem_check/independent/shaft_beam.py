"""A shaft as a Timoshenko beam, by integration from one end to the other; nothing here comes from `qsbearing`.

Along the beam, with everything beyond a section known from statics,

    slope' = M/(E I),    w' = slope + V/(k G A),    u' = N/(E A),
    N, V = sums of forces beyond,    M = sum of F (a - x) + moments beyond,

M linear, V and N constant between loads and steps, so that each piece of a cylinder is integrated exactly by Gauss's
rule of a few points; along a cone the error falls geometrically with their number. Shear coefficient of a hollow
circle: G. R. Cowper, J. Applied Mechanics 33, 1966, 335-340.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from math import pi

import numpy as np

from fem_check.independent.contact_problem import Array

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(16)
"""On -1 to 1. Along a cone whose diameter doubles, 16 points are good to 1e-15."""


@dataclass(frozen=True)
class BeamSection:
    """A length of the shaft, a cylinder or a cone; SI units."""

    begin: float
    end: float
    outer_diameter: float
    """Of a cone, where it begins."""
    inner_diameter: float
    elastic_modulus: float
    poisson_ratio: float
    end_outer_diameter: float | None = None
    """Where it ends; None: a cylinder."""
    end_inner_diameter: float | None = None

    def diameters(self, place: Array) -> tuple[Array, Array]:
        """Outer and inner, at places in it."""
        part = (place - self.begin) / (self.end - self.begin)
        outer, inner = self.outer_diameter, self.inner_diameter
        last_outer = outer if self.end_outer_diameter is None else self.end_outer_diameter
        last_inner = inner if self.end_inner_diameter is None else self.end_inner_diameter
        return (1.0 - part) * outer + part * last_outer, (1.0 - part) * inner + part * last_inner

    def area(self, place: Array) -> Array:
        """Of the cross section [m2]."""
        outer, inner = self.diameters(place)
        return np.asarray(0.25 * pi * (outer**2 - inner**2))

    def tension(self, place: Array) -> Array:
        """E A [N]."""
        return self.elastic_modulus * self.area(place)

    def bending(self, place: Array) -> Array:
        """E I [N m2]."""
        outer, inner = self.diameters(place)
        return np.asarray(self.elastic_modulus * pi / 64.0 * (outer**4 - inner**4))

    def shear(self, place: Array) -> Array:
        """k G A [N]."""
        outer, inner = self.diameters(place)
        nu, m2 = self.poisson_ratio, (inner / outer) ** 2
        k = 6.0 * (1.0 + nu) * (1.0 + m2) ** 2
        k /= (7.0 + 6.0 * nu) * (1.0 + m2) ** 2 + (20.0 + 12.0 * nu) * m2
        return np.asarray(k * self.elastic_modulus / (2.0 * (1.0 + nu)) * self.area(place))


def shape(sections: list[BeamSection], at: Array, forces: Array, moments: Array, stations: Array) -> Array:
    """Deflection and slope at `stations`, from the first section's begin, where both are taken as zero; (2, station).

    Args:
        sections: end to end.
        at: positions of forces and moments, which balance, (load,) [m].
        forces: across the shaft [N].
        moments: that turn it in the sense of a positive slope [N m].
        stations: positions [m].
    """
    w, slope = 0.0, 0.0
    deflections = {sections[0].begin: (w, slope)}
    for section, x, beyond in _pieces(sections, at, stations):
        right = at > 0.5 * (x + beyond)
        shear = float(forces[right].sum())
        moment = float((forces[right] * (at[right] - x)).sum() + moments[right].sum())
        h = beyond - x
        along = 0.5 * h * (POINTS + 1.0)
        turns = 0.5 * h * WEIGHTS * (moment - shear * along) / section.bending(x + along)
        slides = 0.5 * h * WEIGHTS * shear / section.shear(x + along)
        w += slope * h + float(((h - along) * turns).sum() + slides.sum())
        slope += float(turns.sum())
        deflections[beyond] = (w, slope)
    return np.array([deflections[each] for each in stations]).T


def stretch(sections: list[BeamSection], at: Array, forces: Array, stations: Array) -> Array:
    """Axial displacement at `stations` from the first section's begin, under forces along the shaft, which balance;
    (station,)."""
    u = 0.0
    displacements = {sections[0].begin: u}
    for section, x, beyond in _pieces(sections, at, stations):
        pulled = float(forces[at > 0.5 * (x + beyond)].sum())
        place = x + 0.5 * (beyond - x) * (POINTS + 1.0)
        u += 0.5 * (beyond - x) * float((WEIGHTS * pulled / section.tension(place)).sum())
        displacements[beyond] = u
    return np.array([displacements[each] for each in stations])


def _pieces(sections: list[BeamSection], at: Array, stations: Array) -> list[tuple[BeamSection, float, float]]:
    """From one load, step or station to the next."""
    stops = np.unique(np.concatenate([[each.begin for each in sections], [sections[-1].end], at, stations]))
    return [
        (next(each for each in sections if each.begin <= 0.5 * (x + beyond) <= each.end), float(x), float(beyond))
        for x, beyond in itertools.pairwise(stops)
    ]
