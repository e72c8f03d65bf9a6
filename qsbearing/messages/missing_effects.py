"""Warnings of effects that a scene lacks, though they are predicted to change its results."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.messages.balls import Warnings
from qsbearing.model.ranked_warning import wrong_model
from qsbearing.model.solution.judgement import (
    WORDS,
    WORTH_A_WARNING,
    Judgement,
    estimated,
    lacking_data,
    lines_to_add,
    missing,
)
from qsbearing.model.solution.solution import Solution

EXPLAINED = "accuracy"


def missing_warnings(solution: Solution, part: slice) -> Warnings:
    """Effects and choices that the scene could name as it is."""
    if solution.choice is not None:  # what was left out there is said with its error
        return
    judged = missing(solution)
    if not judged:
        return
    matters = _matters(judged, part)

    def sentence(i: int) -> str:
        named = [each for each, which in zip(judged, matters[:, i], strict=True) if which]
        said = []
        for each in named:
            quantity, error = each.worst(part.start + i)
            said.append(f"{each.entry.what} ({WORDS[quantity]} {estimated(error)})")
        lines = ", ".join(lines_to_add(solution.scene, [each.entry for each in named]))
        return wrong_model(f"Not simulated: {' and '.join(said)}. Add under [effects]: {lines}", EXPLAINED)

    yield np.asarray(matters.any(axis=0)), sentence


def data_warnings(solution: Solution, part: slice) -> Warnings:
    """Effects that need numbers of the scene, which no choice of effects can add either."""
    judged = lacking_data(solution)
    if not judged:
        return
    matters = _matters(judged, part)

    def sentence(i: int) -> str:
        said = []
        for each in (one for one, which in zip(judged, matters[:, i], strict=True) if which):
            quantity, error = each.worst(part.start + i)
            said.append(f"{each.entry.what} ({WORDS[quantity]} {estimated(error)}), which needs {each.entry.needs}")
        return wrong_model(f"Not simulated, because input data are missing: {'; '.join(said)}", EXPLAINED)

    yield np.asarray(matters.any(axis=0)), sentence


def _matters(judged: list[Judgement], part: slice) -> NDArray:
    """Which effects (first axis) change some answer noticeably in which cases of a stretch."""
    errors = np.stack([each.largest.reshape(-1)[part] for each in judged])
    return np.asarray(np.isfinite(errors) & (errors > WORTH_A_WARNING))
