"""The weight of a shaft and of what is fixed to it, as loads at points.

A piece of shaft between two neighbouring cuts weighs on the points of Gauss's rule. What a load moves at a cut, and the
inner forces there, are polynomials of the load's place on such a piece, of degree 3 at most where the piece is a
cylinder: two points are exact. Along a cone the weight of a length changes too, and six points are as good as exact.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from qsbearing.systems.sets.shaft import Shaft, ShaftLoad


def mass_loads(of: Shaft) -> list[ShaftLoad]:
    """The weight of what is fixed to it; none without gravity."""
    return [_load(of.gravity, each.position, each.mass) for each in of.masses] if of.gravity is not None else []


def _load(gravity: tuple[float, float, float], position: ArrayLike, mass: ArrayLike) -> ShaftLoad:
    return ShaftLoad(position, *(np.asarray(mass) * each for each in gravity))  # type: ignore[arg-type]


def weight(of: Shaft, cuts: Sequence[ArrayLike]) -> list[ShaftLoad]:
    """Forces that displace the shaft at these positions, which may span cases, as its weight does; none without
    gravity."""
    if of.gravity is None:
        return []
    loads = mass_loads(of)
    if of.sections:
        ends = of.ends
        every = np.stack(np.broadcast_arrays(*(np.asarray(each, float) for each in (*ends, *cuts))))
        every = np.sort(np.clip(every, ends[0], ends[-1]), axis=0)
        begin, end = every[:-1], every[1:]
        number = np.clip(np.searchsorted(ends, 0.5 * (begin + end), side="right") - 1, 0, len(of.sections) - 1)
        density = np.array([float(np.asarray(each.material.density)) for each in of.sections])[number]
        length = np.diff(ends)[number]
        sides = ([getattr(each, f"{side}_diameters") for each in of.sections] for side in ("outer", "inner"))
        outer, inner = (np.array(each)[number] for each in sides)
        points = np.polynomial.legendre.leggauss(6 if any(each.is_conical for each in of.sections) else 2)
        for point, share in zip(*points, strict=True):
            place = 0.5 * (begin + end) + 0.5 * point * (end - begin)
            part = (place - ends[number]) / length
            squares = ((one[..., 0] + part * (one[..., 1] - one[..., 0])) ** 2 for one in (outer, inner))
            area = 0.25 * np.pi * (next(squares) - next(squares))
            masses = 0.5 * share * (end - begin) * density * area
            loads += [_load(of.gravity, *each) for each in zip(place, masses, strict=True)]
    return loads
