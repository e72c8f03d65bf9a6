"""A study's results as a table: one row per point, or per ball of a point; units in the headings."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING

import numpy as np

from qsbearing.io.output_file import output_file
from qsbearing.studies.summary import words

if TYPE_CHECKING:
    import pandas
    from xarray import Dataset


def frame_of(results: Dataset) -> pandas.DataFrame:
    """The results as a table of pandas, status and reason in words."""
    frame = results.to_dataframe().reset_index()
    for name in ("status", "reason"):
        frame[name] = np.array(words(results[name]), object)[frame[name]]
    frame.loc[frame["reason"] == "none", "reason"] = ""
    if "azimuth" in frame:  # a ball axis is as long as the largest ball count
        frame = frame[frame["azimuth"].notna() | (frame["ball"] == 0)]
    columns = {name: values.attrs.get("column", name) for name, values in results.data_vars.items()}
    return frame.rename(columns=columns)


def write_table(results: Dataset, out: str) -> None:
    """Write it as CSV or Parquet, by the file's ending; whole or not at all.

    Raises:
        OSError: it cannot be written.
    """
    frame = frame_of(results)
    with output_file(out) as write:
        if out.lower().endswith(".csv"):
            write(frame.to_csv(index=False, lineterminator="\n").encode())
        else:
            data = BytesIO()
            frame.to_parquet(data, index=False)
            write(data.getvalue())
