"""Sobol indices: which part of each result's variance each random key makes, alone and with all the others."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.model.compiler.threads import thread_count
from qsbearing.model.solution.result_keys import MAX, SIZE, reduced
from qsbearing.model.validation import check_kind
from qsbearing.studies import keys as known_keys
from qsbearing.studies.chunk import MAIN, Plan, plan_of, solve_points
from qsbearing.studies.dataset import attributes
from qsbearing.studies.points import CHUNK, Points
from qsbearing.studies.remarked import Look, together
from qsbearing.studies.remarked import attributes as of_remarks
from qsbearing.studies.scenes import check
from qsbearing.studies.study import Study

if TYPE_CHECKING:
    import xarray

EDGE = 2.0**-53
"""Quantiles stay this far within (0, 1), where a normal distribution is finite."""
MOST = 1 << 18
"""Base samples: indices to some thousandths; of ten keys and ten results they are 250 MB."""
RESAMPLES = 100
"""Of the bootstrap: an uncertainty is then itself known to 7 %, 1/sqrt(200)."""
TWO_SIDED_95 = 1.96
"""Standard errors on either side that a normal estimate stays within in 95 of 100 cases."""


def count_problem(count: int) -> str:
    """What is wrong with a number of base samples; empty where nothing is."""
    if count < 2 or count > MOST or count & (count - 1):
        return f"is not a power of two from 2 to {MOST}"
    return ""


def sobol_indices(study: Study, count: int = 1024) -> xarray.Dataset:
    """First-order and total Sobol indices of each result for each random key (Saltelli's estimators, by scipy).

    Args:
        study: one whose keys all vary at random, independently; of results that each ball has, the largest is taken.
        count: base samples, a power of two; (keys + 2) times as many points are solved. An index is then known to a few
            hundredths with 1024.

    Returns:
        xarray.Dataset: `first_order` and `total`, and `first_order_error` and `total_error`: half the width of their
        95 % confidence intervals by the bootstrap (an upper estimate, as the base samples are spread more evenly than
        independent ones). Dimensions (result, key). NaN where a result is constant, or where points of the study have
        no solution; the attribute `unsolved` counts those.

    Raises:
        SceneFileError: nothing varies at random, a key has listed values, or the study is wrong; every error at once.
        ImportError: xarray is not installed (the `studies` extra).

    Examples:
        >>> spread = {"axial_load_N": {"normal": [17e3, 1e3]}, "speed_rpm": {"uniform": [9e3, 11e3]}}
        >>> study = qs.Study.of("b218", spread)
        >>> indices = qs.sobol_indices(study, 64)
        >>> print(dict(indices.sizes))
        {'result': 10, 'key': 2}
    """
    import xarray

    check_kind("sobol_indices", study, "Study")
    study = study if study.quantities else study.replaced(quantities=MAIN)
    plan = _checked(study, count)
    keys, names = [each.key for each in study.distributions], [each.name for each in plan.results]
    looks: list[Look] = []
    one, other, mixed = _results_of(plan, _base_samples(study, count), looks)
    first, total = _indices(one, other, mixed)
    random = np.random.default_rng(study.seed)
    again = [random.integers(0, count, count) for _ in range(RESAMPLES)]
    spread = np.std([_indices(one[:, i], other[:, i], mixed[:, :, i]) for i in again], axis=0, ddof=1)
    dims = ("result", "key")
    return xarray.Dataset(
        {
            "first_order": (dims, first),
            "first_order_error": (dims, TWO_SIDED_95 * spread[0]),
            "total": (dims, total),
            "total_error": (dims, TWO_SIDED_95 * spread[1]),
        },
        {"result": names, "key": keys, "unit": ("key", [known_keys.known(key).unit or "1" for key in keys])},
        attributes(plan)
        | of_remarks(together(looks), count * (len(keys) + 2))
        | {
            "base_samples": count,
            "points": count * (len(keys) + 2),
            "unsolved": int(sum(np.isnan(part).any(axis=-2).sum() for part in (one, other, mixed))),
        },
    )


def _checked(study: Study, count: int) -> Plan:
    """What is kept of each point."""
    errors: list[Any] = []
    if not study.distributions or study.axes:
        cause = "Vary keys by normal(MEAN,SD), uniform(LOW,HIGH) or triangular(LOW,MODE,HIGH) alone"
        errors.append(FileErrorDetail("vary", "Sobol indices need random keys only", cause=cause))
    if count_problem(count):
        errors.append(FileErrorDetail("count", count_problem(count), count))
    try:
        plan = plan_of(study, check(study), Points(study))
    except SceneFileError as error:
        errors += error.errors
    if errors:
        raise SceneFileError(study.file, errors)
    return plan


def _base_samples(study: Study, count: int) -> Iterator[dict[str, NDArray]]:
    """Values of the keys at both sets of base samples, then at the first set with each key's from the second."""
    from scipy.stats.qmc import Sobol

    keys = study.distributions
    fixed = {each.key: np.asarray(each.values[0]) for each in study.variables if hasattr(each, "values")}
    drawn = Sobol(2 * len(keys), rng=np.random.default_rng(study.seed)).random(count)
    drawn = np.clip(drawn, EDGE, 1.0 - EDGE)
    one = {each.key: each.at(drawn[:, i]) for i, each in enumerate(keys)}
    other = {each.key: each.at(drawn[:, len(keys) + i]) for i, each in enumerate(keys)}
    yield fixed | one
    yield fixed | other
    for each in keys:
        yield fixed | one | {each.key: other[each.key]}


def _results_of(
    plan: Plan, samples: Iterator[dict[str, NDArray]], looks: list[Look]
) -> tuple[NDArray, NDArray, NDArray]:
    """Results at the two sets, shape (result, sample), and at the mixed ones, shape (key, result, sample)."""
    one, other, *mixed = (_solved(plan, values, looks) for values in samples)
    return one, other, np.array(mixed)


def _solved(plan: Plan, values: dict[str, NDArray], looks: list[Look]) -> NDArray:
    """Shape (result, sample); what was seen of remarks is added to `looks`."""
    count = max(array.size for array in values.values())
    out = np.empty((len(plan.results), count))
    for start in range(0, count, CHUNK):
        part = slice(start, start + CHUNK)
        given = {key: array[part] if array.ndim else array for key, array in values.items()}
        chunk = solve_points(plan, given, thread_count(), False)
        looks.append(chunk.remarks)
        for row, result in enumerate(plan.results):
            numbers = chunk.results[result.name]
            over = SIZE if result.result.is_signed else MAX
            out[row, part] = reduced(over, numbers, True) if result.is_per_ball else numbers
    return out


def _indices(one: NDArray, other: NDArray, mixed: NDArray) -> NDArray:
    """First-order and total indices, shape (2, result, key)."""
    from scipy.stats import sobol_indices as by_scipy

    # scipy fails at one result of one key, whose index it takes for a plain number: it gets each result twice.
    given = {"f_A": np.repeat(one, 2, 0), "f_B": np.repeat(other, 2, 0), "f_AB": np.repeat(mixed, 2, 1)}
    with np.errstate(invalid="ignore", divide="ignore"):
        indices = by_scipy(func=given, n=one.shape[1])
    shape = (one.shape[0], 2, mixed.shape[0])
    both = np.array([np.reshape(each, shape)[:, 0] for each in (indices.first_order, indices.total_order)])
    # scipy makes zeros of what is not finite, which would say that no key matters.
    known = np.isfinite(one).all(axis=1) & np.isfinite(other).all(axis=1) & np.isfinite(mixed).all(axis=(0, 2))
    both[:, ~known | (np.ptp(one, axis=1) == 0.0)] = np.nan
    return both
