"""A picture to a file, of a solution or of a study's results."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from qsbearing.cli.output import refuse

if TYPE_CHECKING:
    import xarray

    from qsbearing.sets.set_solution import SetSolution
    from qsbearing.solution.solution import Solution

PICTURES = (".png", ".svg", ".pdf")


def form_of(target: str) -> str:
    """The ending of a file's name, which says how to draw."""
    return os.path.splitext(target)[1].lower()  # noqa: PTH122 - pathlib costs --help its time


def drawn(solution: Solution | SetSolution, target: str) -> bytes:
    """The picture of one case, in the form that the file's name asks for."""
    from io import BytesIO

    from qsbearing.pictures import overview

    picture = BytesIO()
    overview(solution).savefig(picture, format=form_of(target)[1:])
    return picture.getvalue()


def draw_to(results: xarray.Dataset, target: str, **chosen: Any) -> None:
    """Draw results to a file, whole or not at all; ends with exit code 2 where they cannot be drawn."""
    from io import BytesIO

    from qsbearing.io.output_file import output_file
    from qsbearing.pictures.study import PictureError, picture

    data = BytesIO()
    form = form_of(target)
    if form not in PICTURES:
        refuse(f"{target}: the name must end in one of {', '.join(PICTURES)}")
    try:
        with output_file(target) as write:
            picture(results, **chosen).savefig(data, format=form[1:])
            write(data.getvalue())
    except PictureError as error:
        refuse(str(error))
    except OSError as error:
        refuse(f"{target}: {error}")
