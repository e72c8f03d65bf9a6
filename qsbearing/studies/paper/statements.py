"""What is stated of a figure, and whether the results bear it out: everywhere, in a range, or nowhere."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from xarray import DataArray, Dataset


class ClaimVerdict(StrEnum):
    """On a statement."""

    HOLDS = "holds"
    HOLDS_IN_A_RANGE = "holds in a range"
    DOES_NOT_HOLD = "does not hold"


PAPER = "the paper's figures"
CONCLUSION = "the paper's conclusion"
HERE = "here"


@dataclass(frozen=True)
class Claim:
    """A sentence, who states it, and the test of it."""

    sentence: str
    source: str
    test: Callable[[Dataset], DataArray]
    """Where it holds, over the axes of the results; of a trend, between neighbours, at the first of the two."""
    is_about_all: bool = False
    """Judged at every point, not only where there is a solution."""


@dataclass(frozen=True)
class Judged:
    """A statement and what came out."""

    statement: Claim
    verdict: ClaimVerdict
    where: tuple[str, ...] = ()
    """The ranges in which it holds, where that is not everywhere or nowhere."""


def rises(name: str, along: str) -> Callable[[Dataset], DataArray]:
    """A result rises along an axis, from each point that is solved to the next; of one per ball, at ball 0."""
    return lambda results: _steps(results, name, along) > 0.0


def falls(name: str, along: str) -> Callable[[Dataset], DataArray]:
    """A result falls along an axis."""
    return lambda results: _steps(results, name, along) < 0.0


def both(*tests: Callable[[Dataset], DataArray]) -> Callable[[Dataset], DataArray]:
    """Each of several statements."""

    def test(results: Dataset) -> DataArray:
        holds = tests[0](results)
        for each in tests[1:]:
            holds = holds & each(results)
        return holds

    return test


def judge(statement: Claim, results: Dataset) -> Judged:
    """Whether a statement holds, over all points that are solved."""
    tested = statement.test(results)
    solved = tested | True if statement.is_about_all else _solved(results, tested)
    holds = tested & solved
    if bool((holds == solved).all()):
        return Judged(statement, ClaimVerdict.HOLDS)
    if not bool(holds.any()):
        return Judged(statement, ClaimVerdict.DOES_NOT_HOLD)
    return Judged(statement, ClaimVerdict.HOLDS_IN_A_RANGE, tuple(_ranges(holds, results)))


def _at_ball_0(results: Dataset, name: str) -> DataArray:
    values = results[name]
    return values.isel(ball=0) if "ball" in values.dims else values


def _steps(results: Dataset, name: str, along: str) -> DataArray:
    return _at_ball_0(results, name).diff(along, label="lower")


def _solved(results: Dataset, tested: DataArray) -> DataArray:
    """Where a statement can be judged: points that are solved, and of trends those whose next one is, too."""
    solved = results["status"] == 0
    for dim in tested.dims:
        if dim in solved.dims and tested.sizes[dim] == solved.sizes[dim] - 1:
            after = solved.isel({dim: slice(1, None)}).assign_coords({dim: solved[dim][:-1]})
            solved = solved.isel({dim: slice(None, -1)}) & after
    return solved


def _ranges(holds: DataArray, results: Dataset) -> list[str]:
    """Along the longest axis, for each value of the others."""
    dims = sorted(map(str, holds.dims), key=lambda dim: -holds.sizes[dim])
    along, others = dims[0], dims[1:]
    x = results[along].values
    last = 0 if holds.sizes[along] < x.size else -1  # a trend reaches to the next point
    lines = []
    for place in np.ndindex(*(holds.sizes[dim] for dim in others)):
        one = holds.isel(dict(zip(others, place, strict=True))).values
        head = ", ".join(f"{dim} {float(holds[dim][i]):g}" for dim, i in zip(others, place, strict=True))
        parts = [f"{x[start]:g} to {x[stop + last]:g}" for start, stop in _runs(one)]
        lines.append(f"{head}: {along} {', '.join(parts) or 'nowhere'}" if head else f"{along} {', '.join(parts)}")
    return lines


def _runs(marked: NDArray) -> Any:
    """First index of each run of marked places, and the one after its last."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], marked.astype(int), [0]])))
    return zip(edges[::2], edges[1::2], strict=True)
