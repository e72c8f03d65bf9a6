"""Warnings of effects that a scene lacks, though they are predicted to change its results."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.ball_messages import Warnings
from qsbearing.judgement import WORDS, WORTH_A_WARNING, Judgement, estimated, lacking_data, lines_to_add, missing
from qsbearing.solution import Solution


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
        return f"Missing here, and predicted to matter: {' and '.join(said)}. To include it, under [effects]: {lines}"

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
            errors = {name: float(np.ravel(error)[part.start + i]) for name, error in each.errors.items()}
            changes = ", ".join(
                f"{WORDS[name]} {estimated(errors[name])}"
                for name in sorted(errors, key=lambda one: -errors[one])
                if errors[name] > WORTH_A_WARNING
            )
            entry = each.entry
            said.append(
                f"{entry.what}, estimated ({entry.without_parameters}) to change {changes}. To include it, give "
                f"{entry.needs}."
            )
        return f"Not in the scene for want of numbers, and likely needed: {' Also: '.join(said)}"

    yield np.asarray(matters.any(axis=0)), sentence


def _matters(judged: list[Judgement], part: slice) -> NDArray:
    """Which effects (first axis) change some answer noticeably in which cases of a stretch."""
    errors = np.stack([each.largest.reshape(-1)[part] for each in judged])
    return np.asarray(np.isfinite(errors) & (errors > WORTH_A_WARNING))
