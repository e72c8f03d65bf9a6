"""Whether pictures are drawn. Drawing takes most of a report's time, so that it is left to tests of pictures: in all
others a figure is made, with all that it shows, but saved as an empty picture."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import IO, Any

import pytest

BLANK = b'<svg xmlns="http://www.w3.org/2000/svg" width="9pt" height="9pt" viewBox="0 0 9 9"></svg>'


class _Drawing:
    """How many ask for it."""

    asked = 0


@contextmanager
def drawing() -> Iterator[None]:
    """Within, figures are drawn as they are saved."""
    _Drawing.asked += 1
    try:
        yield
    finally:
        _Drawing.asked -= 1


@contextmanager
def blank() -> Iterator[None]:
    """Within, figures are saved as an empty picture, but for what is within `drawing`."""
    if find_spec("matplotlib") is None:
        yield
        return
    from matplotlib.figure import Figure

    save = Figure.savefig

    def saved(figure: Figure, target: IO[bytes] | Path, **options: Any) -> None:
        if _Drawing.asked:
            save(figure, target, **options)
        elif isinstance(target, Path):
            target.write_bytes(BLANK)
        else:
            target.write(BLANK)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", saved)
        yield
