"""The points of a study: its grid, cut into chunks that are made one at a time, and the values of each."""

from __future__ import annotations

from functools import cached_property, lru_cache
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.studies.study import Sampling, Study

CHUNK = 16_384
"""Points of a chunk: some tenths of a second of work, some megabytes of results."""
BLOCK = 65_536
"""Samples drawn at a time, each block from a generator of its own, so that every chunk can draw its own."""

SAMPLE = "sample"
"""The axis of all keys that vary at random."""


class Points:
    """The grid of a study: its axes in their order, then the samples; never there as a whole."""

    def __init__(self, study: Study) -> None:
        self.study = study
        self.dims = tuple(axis.key for axis in study.axes) + ((SAMPLE,) if study.samples else ())
        self.shape = tuple(len(axis.values) for axis in study.axes) + ((study.samples,) if study.samples else ())
        self.count = prod(self.shape)

    @cached_property
    def _split(self) -> tuple[int, int]:
        """The axis that is cut, and how many of its values make a chunk; all axes after it are whole."""
        axis, after = len(self.shape), 1
        while axis > 0 and after * self.shape[axis - 1] <= CHUNK:
            axis -= 1
            after *= self.shape[axis]
        return axis - 1, max(1, CHUNK // after)

    @property
    def chunk_count(self) -> int:
        axis, width = self._split
        return prod(self.shape[:axis]) * -(-self.shape[axis] // width) if axis >= 0 else 1

    def chunk(self, number: int) -> tuple[slice, ...]:
        """The block of the grid that is one chunk: one slice per axis."""
        axis, width = self._split
        if axis < 0:
            return tuple(slice(0, length) for length in self.shape)
        parts = -(-self.shape[axis] // width)
        before, part = divmod(number, parts)
        index = np.unravel_index(before, self.shape[:axis]) if axis else ()
        cut = slice(part * width, min((part + 1) * width, self.shape[axis]))
        whole = (slice(0, length) for length in self.shape[axis + 1 :])
        return (*(slice(int(i), int(i) + 1) for i in index), cut, *whole)

    def size(self, number: int) -> int:
        """Points of a chunk."""
        return prod(part.stop - part.start for part in self.chunk(number))

    def values(self, chunk: tuple[slice, ...]) -> dict[str, NDArray]:
        """What each key takes at the points of a chunk, flattened, in the keys' units; those of one value as one."""
        shape = tuple(part.stop - part.start for part in chunk)
        along = dict(zip(self.dims, chunk, strict=True))
        by_key: dict[str, NDArray] = {}
        for axis in self.study.variables:
            values = getattr(axis, "values", None)
            if values is not None and len(values) == 1:
                by_key[axis.key] = np.asarray(values[0])
        for place, axis in enumerate(self.study.axes):
            values = np.asarray(axis.values)[along[axis.key]]
            wide = values.reshape(-1, *(1,) * (len(shape) - place - 1))
            by_key[axis.key] = np.broadcast_to(wide, shape).ravel()
        if self.study.samples:
            for key, values in self.samples(along[SAMPLE]).items():
                by_key[key] = np.broadcast_to(values, shape).ravel()
        return by_key

    def samples(self, part: slice) -> dict[str, NDArray]:
        """The values of the random keys at a stretch of the samples."""
        if part.stop <= part.start:
            return {each.key: np.empty(0) for each in self.study.distributions}
        blocks = range(part.start // BLOCK, -(-part.stop // BLOCK))
        drawn = np.concatenate([_quantiles(*self._sampler, number) for number in blocks])
        drawn = drawn[part.start - blocks.start * BLOCK : part.stop - blocks.start * BLOCK]
        return {each.key: each.at(drawn[:, i]) for i, each in enumerate(self.study.distributions)}

    @property
    def _sampler(self) -> tuple[Sampling, int, int, int]:
        study = self.study
        return study.sampling, study.seed, len(study.distributions), study.samples

    def coordinates(self, samples: slice) -> dict[str, tuple[tuple[str, ...], NDArray]]:
        """Dimensions and values of every varied key: along its axis, or at these samples."""
        by_key: dict[str, Any] = {axis.key: ((axis.key,), np.asarray(axis.values)) for axis in self.study.axes}
        for axis in self.study.variables:
            values = getattr(axis, "values", None)
            if values is not None and len(values) == 1:
                by_key[axis.key] = ((), np.asarray(values[0]))
        if self.study.samples:
            by_key |= {key: ((SAMPLE,), values) for key, values in self.samples(samples).items()}
        return by_key


@lru_cache(maxsize=4)
def _quantiles(sampling: Sampling, seed: int, keys: int, samples: int, number: int) -> NDArray:
    """One block of sample points in the unit cube, none on its faces; shape (point, key)."""
    count = min(BLOCK, samples - number * BLOCK)
    if sampling is Sampling.RANDOM:
        drawn = np.random.default_rng([seed, number]).random((count, keys))
    elif sampling is Sampling.LATIN_HYPERCUBE:
        from scipy.stats.qmc import LatinHypercube

        drawn = LatinHypercube(keys, rng=np.random.default_rng([seed, number])).random(count)
    else:
        from scipy.stats.qmc import Sobol

        engine = Sobol(keys, rng=np.random.default_rng(seed))
        if number:
            engine.fast_forward(number * BLOCK)
        whole = 1 << (count - 1).bit_length()  # a power of two, as the method wants it; the rest is left out
        drawn = engine.random(whole)[:count]
    return np.clip(drawn, 2.0**-53, 1.0 - 2.0**-53)
