"""Quantiles and ranges of arrays that are read from the disk some at a time: exact, in a memory that does not grow."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from xarray import DataArray

MOST = 1 << 20
"""Numbers that are in memory at a time: 8 MB."""
ROUNDING = 1e-9
"""Of a result's printed unit: a number that is no larger is zero."""
DIGIT = 16
"""Bits that are told apart in one passage over the numbers."""

Blocks = Callable[[], Iterable[NDArray]]
"""The same blocks of numbers, as often as they are asked for."""


def blocks(values: DataArray) -> Iterator[NDArray]:
    """An array in its order, in blocks of at most `MOST` numbers."""
    if values.size <= MOST or not values.dims:
        yield values.values
        return
    dim, length = values.dims[0], values.shape[0]
    each = values.size // length
    if each > MOST:
        for number in range(length):
            yield from blocks(values.isel({dim: number}))
        return
    step = MOST // each
    for start in range(0, length, step):
        yield values.isel({dim: slice(start, start + step)}).values


def blocks_of(values: DataArray) -> Blocks:
    """Its blocks; where there is but one, it is read once."""
    if values.size > MOST:
        return partial(blocks, values)
    kept = values.values
    return lambda: (kept,)


def varies_from_zero(numbers: Blocks) -> bool:
    """Whether any number is finite and, but for rounding, not zero."""
    return any(bool((np.isfinite(block) & (abs(block) > ROUNDING)).any()) for block in numbers())


def quantiles(numbers: Blocks, levels: Sequence[float]) -> list[float]:
    """Quantiles of the finite numbers, interpolated between neighbours as numpy does; empty where there is none."""
    count = sum(int(np.isfinite(block).sum()) for block in numbers())
    if count == 0:
        return []
    if count <= MOST:
        together = np.concatenate([_finite(block) for block in numbers()])
        return [float(value) for value in np.quantile(together, levels)]
    ranks = np.asarray(levels) * (count - 1)
    below = np.floor(ranks).astype(int)
    above = np.minimum(below + 1, count - 1)
    at_rank = _order_statistics(numbers, sorted({*below.tolist(), *above.tolist()}))
    return [
        float(at_rank[low] + (at_rank[high] - at_rank[low]) * (rank - low))
        for rank, low, high in zip(ranks, below.tolist(), above.tolist(), strict=True)
    ]


def histogram(numbers: Blocks, edges: NDArray) -> NDArray:
    """How many of the finite numbers lie between each pair of edges."""
    counts = np.zeros(edges.size - 1, int)
    for block in numbers():
        counts += np.histogram(_finite(block), edges)[0]
    return counts


def _finite(block: NDArray) -> NDArray:
    flat = np.asarray(block, float).ravel()
    return flat[np.isfinite(flat)]


def _order_statistics(numbers: Blocks, ranks: list[int]) -> dict[int, float]:
    """The numbers of these ranks, from 0: by one more digit of each in every passage, as a radix sort finds them."""
    heads = np.zeros(len(ranks), np.uint64)  # of each rank's number, the bits that are known
    left = np.array(ranks)  # its rank among the numbers that share them
    for shift in range(64 - DIGIT, -1, -DIGIT):
        known, which = np.unique(heads, return_inverse=True)
        counts = np.zeros((known.size, 1 << DIGIT), int)
        for block in numbers():
            bits = _ordered_bits(_finite(block))
            above = (bits >> np.uint64(shift + DIGIT)) if shift + DIGIT < 64 else np.zeros_like(bits)
            for row, head in enumerate(known):
                digits = (bits[above == head] >> np.uint64(shift)) & np.uint64((1 << DIGIT) - 1)
                counts[row] += np.bincount(digits.astype(np.intp), minlength=1 << DIGIT)
        for number, row in enumerate(which):
            upto = np.cumsum(counts[row])
            digit = int(np.searchsorted(upto, left[number], "right"))
            left[number] -= upto[digit] - counts[row][digit]
            heads[number] = (heads[number] << np.uint64(DIGIT)) | np.uint64(digit)
    return dict(zip(ranks, _numbers_of(heads).tolist(), strict=True))


_SIGN = np.uint64(1 << 63)


def _ordered_bits(numbers: NDArray) -> NDArray:
    """Whole numbers in the order of these floats: of a negative one all bits are turned, of others the sign."""
    bits = np.ascontiguousarray(numbers).view(np.uint64)
    return np.where(bits & _SIGN, ~bits, bits | _SIGN)


def _numbers_of(bits: NDArray) -> NDArray:
    return np.where(bits & _SIGN, bits & ~_SIGN, ~bits).view(np.float64)
