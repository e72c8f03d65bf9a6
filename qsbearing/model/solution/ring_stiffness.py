"""The ring's stiffness matrix of solved cases, and what is read off it: compliance, locked and effective stiffnesses.

A single number called the stiffness of a channel may mean two things, which differ where channels are coupled:

locked      the diagonal of the matrix: how its load grows while every other channel is kept from moving;
effective   the reciprocal of the compliance's diagonal: how its load grows while the other free channels move so as
            to keep theirs, which is what two solves with neighbouring loads show.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.results import stiffness_of_cases
from qsbearing.model.solution.solved_cases import SolvedCases

SOFTEST = 1e-9
"""A direction this much softer than the stiffest is resisted by rounding only (chosen: far above the rounding of a
stiffness, 1e-13, and far below any bearing's ratio of stiffnesses)."""


def tangents(solved: SolvedCases, part: slice, cases: NDArray) -> NDArray:
    """Stiffness (case, 5, 5), SI, of a stretch of flattened cases."""
    out = np.empty((cases.size, 5, 5))
    stiffness_of_cases(*solved.given(part, cases), out)
    return out if solved.following is None else out + solved.following()[part]


def scaled_tangents(solved: SolvedCases, part: slice, cases: NDArray) -> tuple[NDArray, NDArray]:
    """Stiffness of the free channels with tilts measured at the pitch circle, all in N/m; and the scale of each."""
    free = solved.maker.free_channels
    scale = np.ones((cases.size, 5))
    scale[:, 3:] = 2.0 / (cases["pitch_diameter"] * cases["length"])[:, None]
    scale = scale[:, free]
    matrix = tangents(solved, part, cases)[:, free[:, None], free]
    return matrix * scale[:, :, None] * scale[:, None, :], scale


def tangents_of_all(solved: SolvedCases) -> NDArray:
    """Stiffness (case, 5, 5), SI, of all flattened cases."""
    out = np.empty((solved.maker.count, 5, 5))
    solved.in_threads(lambda part, cases: stiffness_of_cases(*solved.given(part, cases), out[part]))
    return out if solved.following is None else out + solved.following()


def compliance(solved: SolvedCases) -> NDArray:
    """Inverse of the stiffness over the free channels (case, 5, 5), SI, of all flattened cases; else NaN."""
    out = np.full((solved.maker.count, 5, 5), np.nan)
    free = solved.maker.free_channels
    for part, cases in solved.stretches() if free.size else ():
        scaled, scale = scaled_tangents(solved, part, cases)
        out[part, free[:, None], free] = inverse(scaled) * (scale[:, :, None] * scale[:, None, :])
    return out


def inverse(matrices: NDArray) -> NDArray:
    """Of stiffnesses (..., n, n) of one unit each; NaN where nothing resists some direction, or a number is missing."""
    listed = matrices.reshape(-1, *matrices.shape[-2:])
    regular = np.isfinite(listed).all((-1, -2))
    regular[regular] = np.linalg.cond(listed[regular]) < 1.0 / SOFTEST
    out = np.full(listed.shape, np.nan)
    out[regular] = np.linalg.inv(listed[regular])
    return out.reshape(matrices.shape)
