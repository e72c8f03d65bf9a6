"""A shaft as a Timoshenko beam, by integration from one end to the other; nothing here comes from `qsbearing`.

Along the beam in one plane, with everything beyond a section known from statics,

    slope' = M/(E I),    w' = slope + V/(k G A),    V = sum of forces beyond,  M = sum of F (a - x) + moments beyond,

M linear and V constant between loads and steps, so that each piece is integrated exactly. Shear coefficient of a hollow
circle: G. R. Cowper, J. Applied Mechanics 33, 1966, 335-340.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from math import pi

import numpy as np

from fem_check.independent.contact_problem import Array


@dataclass(frozen=True)
class BeamSection:
    """A length of the shaft; SI units."""

    begin: float
    end: float
    outer_diameter: float
    inner_diameter: float
    elastic_modulus: float
    poisson_ratio: float

    @property
    def bending(self) -> float:
        """E I [N m2]."""
        return self.elastic_modulus * pi / 64.0 * (self.outer_diameter**4 - self.inner_diameter**4)

    @property
    def shear(self) -> float:
        """k G A [N]."""
        nu, m2 = self.poisson_ratio, (self.inner_diameter / self.outer_diameter) ** 2
        k = 6.0 * (1.0 + nu) * (1.0 + m2) ** 2
        k /= (7.0 + 6.0 * nu) * (1.0 + m2) ** 2 + (20.0 + 12.0 * nu) * m2
        area = 0.25 * pi * (self.outer_diameter**2 - self.inner_diameter**2)
        return k * self.elastic_modulus / (2.0 * (1.0 + nu)) * area


def shape(sections: list[BeamSection], at: Array, forces: Array, moments: Array, stations: Array) -> Array:
    """Deflection and slope at `stations`, from the first section's begin, where both are taken as zero; (2, station).

    Args:
        sections: end to end.
        at: positions of forces and moments, which balance, (load,) [m].
        forces: across the shaft [N].
        moments: that turn it in the sense of a positive slope [N m].
        stations: positions [m].
    """
    stops = np.unique(np.concatenate([[each.begin for each in sections], [sections[-1].end], at, stations]))
    w, slope = 0.0, 0.0
    deflections = {stops[0]: (w, slope)}
    for x, beyond in itertools.pairwise(stops):
        section = next(each for each in sections if each.begin <= 0.5 * (x + beyond) <= each.end)
        right = at > 0.5 * (x + beyond)
        shear = float(forces[right].sum())
        moment = float((forces[right] * (at[right] - x)).sum() + moments[right].sum())
        h, bending = beyond - x, section.bending
        w += slope * h + (0.5 * moment * h**2 - shear * h**3 / 6.0) / bending + shear * h / section.shear
        slope += (moment * h - 0.5 * shear * h**2) / bending
        deflections[beyond] = (w, slope)
    return np.array([deflections[each] for each in stations]).T
