"""Sobol indices: which part of each result's variance each random key makes, alone and with all the others."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from qsbearing.io.file_errors import FileErrorDetail, SceneFileError
from qsbearing.solver import thread_count
from qsbearing.studies.chunk import MAIN, plan_of, solve_points
from qsbearing.studies.points import CHUNK, Points
from qsbearing.studies.scenes import check
from qsbearing.studies.study import Study

if TYPE_CHECKING:
    import xarray

EDGE = 2.0**-53
"""Quantiles stay this far within (0, 1), where a normal distribution is finite."""


class _Quantiles:
    """A distribution as `scipy.stats.sobol_indices` asks for it."""

    def __init__(self, at: Callable[[NDArray], NDArray]) -> None:
        self._at = at

    def ppf(self, quantile: NDArray) -> NDArray:
        return self._at(np.clip(quantile, EDGE, 1.0 - EDGE))


def sobol_indices(study: Study, count: int = 1024) -> xarray.Dataset:
    """First-order and total Sobol indices of each result for each random key (Saltelli's estimators, by scipy).

    Args:
        study: one whose keys all vary at random, independently; of results that each ball has, the largest is taken.
        count: base samples, a power of two; (keys + 2) times as many points are solved. An index is then known to a few
            hundredths with 1024.

    Returns:
        xarray.Dataset: `first_order` and `total`, dimensions (result, key). NaN where a result is constant, or where
        points of the study have no solution.

    Raises:
        SceneFileError: nothing varies at random, an axis is there beside, or the study is wrong.
        ImportError: xarray is not installed (the `studies` extra).
    """
    import xarray
    from scipy import stats

    if not study.distributions or study.axes:
        cause = "Vary keys by normal(MEAN,SD), uniform(LOW,HIGH) or triangular(LOW,MODE,HIGH) alone"
        raise SceneFileError(study.file, [FileErrorDetail("vary", "Sobol indices need random keys only", cause=cause)])
    if count < 2 or count & (count - 1):
        raise SceneFileError(study.file, [FileErrorDetail("count", "is not a power of two", count)])
    study = study if study.quantities else study.replaced(quantities=MAIN)
    plan = plan_of(study, check(study), Points(study))
    keys, names = [each.key for each in study.distributions], [each.name for each in plan.results]
    fixed = {each.key: np.asarray(each.values[0]) for each in study.variables if hasattr(each, "values")}

    def solved(values: NDArray) -> NDArray:
        """Results (result, point) at values (key, point)."""
        out = np.empty((len(names), values.shape[1]))
        for start in range(0, values.shape[1], CHUNK):
            part = slice(start, start + CHUNK)
            given = dict(zip(keys, np.ascontiguousarray(values[:, part]), strict=True))
            chunk = solve_points(plan, fixed | given, thread_count())
            for row, name in enumerate(names):
                found = chunk.results[name]
                out[row, part] = found if found.ndim == 1 else np.fmax.reduce(found, axis=1)
        return out

    dists = [_Quantiles(each.at) for each in study.distributions]
    with np.errstate(invalid="ignore", divide="ignore"):
        found = stats.sobol_indices(func=solved, n=count, dists=dists, rng=np.random.default_rng(study.seed))
    shape = (len(names), len(keys))
    return xarray.Dataset(
        {
            "first_order": (("result", "key"), np.reshape(found.first_order, shape)),
            "total": (("result", "key"), np.reshape(found.total_order, shape)),
        },
        {"result": names, "key": keys},
        {"base_samples": count, "points": count * (len(keys) + 2)},
    )
