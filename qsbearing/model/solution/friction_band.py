"""From where to where displacement and stiffness go over the range in which the friction coefficient lies.

Neither need rise or fall with it, so that its ends are not enough: the scene is solved at coefficients between them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.of_cases import may_solve_alike, solve_alike
from qsbearing.model.solution.solution import Solution

COUNT = 17
"""Coefficients in equal ratios, ends included (chosen: of B218 at 10,000 rpm over 0.03 to 0.1, under 8 and 17.8 kN and
with 3 kN across, 65 of them move no end of axial displacement, axial or radial stiffness by more than 0.1 %)."""


class Band(NamedTuple):
    """The least and the largest, each (*cases, 5), SI; NaN where some coefficient has no solution."""

    over: tuple[float, float]
    """Of the coefficient."""
    solves: int
    displacement: tuple[NDArray, NDArray]
    stiffness: tuple[NDArray, NDArray]
    """Locked."""


def friction_band(solution: Solution) -> Band | None:
    """Of a solution whose law of friction has a range; None without one, and at rest."""
    law = solution.scene.traction
    if law is None or law.friction_range is None or solution.friction is None or not may_solve_alike(solution):
        return None
    of_cases = np.geomspace(*law.friction_range, COUNT).reshape(-1, *[1] * len(solution.shape))
    many = replace(solution.scene, traction=replace(law, friction_coefficient=of_cases), readings={})
    band: Solution = solve_alike(solution, many)

    least, most = law.friction_range
    is_within = (solution.friction.friction_coefficient >= least) & (solution.friction.friction_coefficient <= most)

    def ends(own: NDArray, others: NDArray) -> tuple[NDArray, NDArray]:
        every = np.concatenate([np.where(is_within[..., None], own, others[0])[None], others])
        return every.min(axis=0), every.max(axis=0)

    displacement = ends(solution.displacement, band.displacement)
    stiffness = ends(solution.locked_stiffness, band.locked_stiffness)
    return Band(law.friction_range, COUNT, displacement, stiffness)
