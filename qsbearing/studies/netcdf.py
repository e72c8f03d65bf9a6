"""All chunks of a study as one netCDF file, written block by block."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np

from qsbearing.studies import dataset, remarked
from qsbearing.studies.chunk import Chunk, Plan
from qsbearing.studies.points import BLOCK, SAMPLE, Points

METADATA = 1 << 20
"""Bytes of a file apart from its numbers, generously."""

Chunks = Callable[[], Iterable[tuple[int, Chunk]]]
"""All chunks with their numbers, as often as they are asked for."""


def write_netcdf(place: Path, plan: Plan, points: Points, chunks: Chunks) -> None:
    """Write the file.

    Raises:
        OSError, RuntimeError: it cannot be written; HDF5 has errors of both kinds.
    """
    import h5netcdf

    _claim_room(place, plan, points)
    told = [(chunk.reasons, chunk.remarks) for _, chunk in chunks()]
    reasons = dataset.all_reasons(each for each, _ in told)
    seen = remarked.together(each for _, each in told)
    with h5netcdf.File(place, "w") as file:
        for name, length in zip(points.dims, points.shape, strict=True):
            file.dimensions[name] = length
        file.dimensions[dataset.BALL] = plan.ball_axis
        file.attrs.update(dataset.attributes(plan) | remarked.attributes(seen, points.count))
        beside = _write_coordinates(file, points)
        for name, (dims, kind, attrs) in dataset.variables_of(plan, points).items():
            variable = file.create_variable(name, dims, kind)
            variable.attrs.update(attrs | (dataset.reason_attributes(reasons) if name == "reason" else {}))
            if beside:
                variable.attrs["coordinates"] = beside
        for number, chunk in chunks():
            block = points.chunk(number)
            shape = tuple(part.stop - part.start for part in block)
            for name, values in dataset.arrays_of(chunk, reasons).items():
                file[name][block] = values.reshape((*shape, *values.shape[1:]))


def _claim_room(place: Path, plan: Plan, points: Points) -> None:
    """See that the whole file finds room, and let it go again: HDF5 does not survive a disk that fills."""
    if not hasattr(os, "posix_fallocate"):
        return
    size = METADATA + 8 * points.study.samples * len(points.study.distributions) + 8 * sum(points.shape)
    for dims, kind, _ in dataset.variables_of(plan, points).values():
        size += np.dtype(kind).itemsize * points.count * (plan.ball_axis if dims[-1:] == (dataset.BALL,) else 1)
    with place.open("wb") as file:
        os.posix_fallocate(file.fileno(), 0, size)


def _write_coordinates(file: Any, points: Points) -> str:
    """The varied keys; and the names of those that are not an axis themselves."""
    beside = []
    for name, (dims, values, attrs) in dataset.coordinates(points).items():
        variable = file.create_variable(name, dims, np.float64)
        variable.attrs.update(attrs)
        if dims != (name,):
            beside.append(name)
        if dims != (SAMPLE,):
            variable[...] = values
    for start in range(0, points.study.samples, BLOCK):
        part = slice(start, min(start + BLOCK, points.study.samples))
        for name, values in points.samples(part).items():
            file[name][part] = values
    return " ".join(beside)
