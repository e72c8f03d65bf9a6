"""How the tests run: the same examples of hypothesis every time, and one thread for small matrices."""

from __future__ import annotations

import os
from typing import IO

# Before numpy is loaded: with matrices of some hundred rows the other threads only wait, which costs processor time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Tests solve more than plain Python pays for; those of the plain way start processes of their own.
os.environ.setdefault("QSBEARING_COMPILED", "1")
# Tables are as wide as in a file, whatever the terminal; pytest-xdist sets it in its processes.
os.environ.pop("COLUMNS", None)

import pytest
from hypothesis import settings

from qsbearing.model.compiler.compiled import COMPILED

settings.register_profile(
    "qsbearing", derandomize=True, deadline=None, database=None, max_examples=60 if COMPILED else 4
)
settings.load_profile("qsbearing")


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures are made but stay blank, for tests of a document's words: drawing takes most of a report's time."""

    def blank(figure: object, target: IO[bytes], **_: object) -> None:
        target.write(b'<svg xmlns="http://www.w3.org/2000/svg" width="9pt" height="9pt" viewBox="0 0 9 9"></svg>')

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", blank)
