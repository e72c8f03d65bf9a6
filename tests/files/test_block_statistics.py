"""Statistics of arrays that are read in blocks are those of the whole array."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from qsbearing.files import block_statistics
from qsbearing.files.block_statistics import blocks, histogram, quantiles, varies_from_zero

QUANTILES = (0.0, 0.05, 0.3, 0.5, 0.95, 1.0)
NUMBERS = st.one_of(
    st.floats(width=64), st.sampled_from([0.0, -0.0, 1.0, 5e-324, -5e-324]), st.floats(1500.0, 1500.000001)
)


@pytest.fixture(autouse=True, scope="module")
def few_in_memory() -> Iterator[None]:
    """Otherwise quantiles of a million numbers are numpy's own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(block_statistics, "MOST", 7)
        yield


def in_parts(values: NDArray) -> object:
    return lambda: np.array_split(values, 3)


@given(st.lists(NUMBERS, min_size=1, max_size=60))
def test_quantiles_are_those_of_numpy(values: list[float]) -> None:
    array = np.array(values)
    finite = array[np.isfinite(array)]
    found = quantiles(in_parts(array), QUANTILES)  # type: ignore[arg-type]
    if finite.size == 0:
        assert found == []
        return
    with np.errstate(over="ignore", invalid="ignore"):
        expected = np.quantile(finite, QUANTILES)
        between = np.diff(np.sort(finite), append=finite.max()).max()
    if np.isfinite(expected).all() and np.isfinite(between):
        # Interpolating between two neighbours rounds, by a few units in the last place of the larger.
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=4e-16 * np.abs(finite).max())


def test_order_statistics_are_exact() -> None:
    values = np.random.default_rng(1).normal(size=1001)
    assert quantiles(in_parts(values), [0.0, 0.25, 0.5, 1.0]) == np.sort(values)[[0, 250, 500, 1000]].tolist()  # type: ignore[arg-type]


def test_histograms_add_up() -> None:
    values = np.append(np.random.default_rng(2).normal(size=500), [np.nan, np.inf])
    edges = np.linspace(-1.0, 1.0, 9)
    np.testing.assert_array_equal(histogram(in_parts(values), edges), np.histogram(values, edges)[0])  # type: ignore[arg-type]
    assert varies_from_zero(in_parts(values))  # type: ignore[arg-type]
    assert not varies_from_zero(in_parts(np.array([0.0, np.nan, np.inf])))  # type: ignore[arg-type]


@pytest.mark.parametrize("shape", [(), (1,), (23,), (4, 5), (1, 20), (5, 1, 3), (2, 9, 2), (3, 0)])
def test_blocks_are_the_array_in_its_order(shape: tuple[int, ...]) -> None:
    xarray = pytest.importorskip("xarray")
    values = xarray.DataArray(np.arange(float(np.prod(shape))).reshape(shape))
    found = list(blocks(values))
    np.testing.assert_array_equal(np.concatenate([block.ravel() for block in found]), values.values.ravel())
    assert all(block.size <= 7 for block in found)
