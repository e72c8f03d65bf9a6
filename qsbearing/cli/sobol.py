"""Sobol indices on the command line: a table, a file, a picture."""

from __future__ import annotations

from contextlib import nullcontext
from typing import TYPE_CHECKING

from qsbearing.cli.output import print_table
from qsbearing.cli.picture_file import draw_to
from qsbearing.cli.sweep_problems import ending

if TYPE_CHECKING:
    from qsbearing.studies.study import Study


def show_indices(study: Study, count: int, out: str | None, picture: str | None) -> None:
    """Find the indices; print them, and write and draw them where that is asked for.

    Raises:
        SceneError: the study is wrong.
        OSError: the file cannot be written.
    """
    from qsbearing.io.output_file import output_stream
    from qsbearing.studies import summary
    from qsbearing.studies.sobol import sobol_indices
    from qsbearing.studies.tables import write_indices

    with output_stream(out) if out else nullcontext() as file:
        indices = sobol_indices(study, count)
        if file is not None:
            write_indices(indices, file, ending(out or ""))
    if picture is not None:
        draw_to(indices, picture)
    print_table(summary.table_of_indices(indices))
