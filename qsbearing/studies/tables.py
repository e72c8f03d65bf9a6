"""A study's results as a table: one row per point, or per ball of a point; units in the headings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import prod
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from qsbearing.studies.summary import words

if TYPE_CHECKING:
    import pandas
    from xarray import Dataset


def frame_of(results: Dataset) -> pandas.DataFrame:
    """The results as a table of pandas, status and reason in words."""
    dims = results["status"].dims
    frame = results.to_dataframe([*dims, *(dim for dim in results.dims if dim not in dims)]).reset_index()
    for name in ("status", "reason"):
        frame[name] = np.array(words(results[name]), object)[frame[name]]
    frame.loc[frame["reason"] == "none", "reason"] = ""
    if "azimuth" in frame:  # a ball axis is as long as the largest ball count
        frame = frame[frame["azimuth"].notna() | (frame["ball"] == 0)]
    columns = {name: values.attrs.get("column", name) for name, values in results.data_vars.items()}
    return frame.rename(columns=columns)


def write_table(results: Dataset, file: BinaryIO, form: str) -> None:
    """Write it as ".csv" or ".parquet", in blocks of points.

    Raises:
        OSError: it cannot be written.
    """
    frames = (frame_of(part) for part in parts_of(results))
    if form == ".csv":
        for number, frame in enumerate(frames):
            file.write(frame.to_csv(index=False, header=number == 0, lineterminator="\n").encode())
    else:
        _write_parquet(frames, file)


def write_indices(indices: Dataset, file: BinaryIO, form: str) -> None:
    """Write Sobol indices as ".nc", ".csv" or ".parquet".

    Raises:
        OSError: it cannot be written.
    """
    if form == ".nc":
        file.write(indices.to_netcdf(engine="h5netcdf"))
    elif form == ".csv":
        file.write(indices.to_dataframe().to_csv(lineterminator="\n").encode())
    else:
        _write_parquet([indices.to_dataframe().reset_index()], file)


def parts_of(results: Dataset, most: int = 1 << 17) -> Iterator[Dataset]:
    """The results in their order, cut along their axes into parts of at most so many rows."""
    dims = results["status"].dims
    if not dims or prod(results.sizes.values()) <= most:
        yield results
        return
    along = next((dim for dim in dims if results.sizes[dim] > 1), dims[-1])
    step = max(1, most * results.sizes[along] // prod(results.sizes.values()))
    for start in range(0, results.sizes[along], step):
        part = results.isel({along: slice(start, start + step)})
        if along not in part.coords:  # a plain number, which goes on where the part before it ended
            part = part.assign_coords({along: np.arange(start, start + part.sizes[along])})
        if part.sizes[along] == results.sizes[along]:
            yield part
        else:
            yield from parts_of(part, most)


def _write_parquet(frames: Iterable[pandas.DataFrame], file: BinaryIO) -> None:
    from pyarrow import Table
    from pyarrow.parquet import ParquetWriter

    writer: ParquetWriter | None = None
    try:
        for frame in frames:
            table = Table.from_pandas(frame, schema=writer and writer.schema, preserve_index=False)
            writer = writer or ParquetWriter(file, table.schema)
            writer.write_table(table)
    finally:
        if writer is not None:
            writer.close()
