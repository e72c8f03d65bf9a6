"""A process that has solved nothing, and solves in plain Python."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler import compiled


@contextmanager
def as_new(allowance: float = 1e9) -> Iterator[None]:
    """Within, this process has loaded nothing, and may spend so many seconds in plain Python before it loads or
    compiles."""
    with pytest.MonkeyPatch.context() as patch:
        for price in ("LOADING", "LOADING_MORE", "COMPILING"):
            patch.setattr(compiled, price, allowance)
        patch.setattr(compiled._process, "always", False)
        patch.setattr(compiled._process, "plain", 0.0)
        for entry in compiled._entries:
            patch.setattr(entry, "_compiled", None)
            patch.setattr(entry, "_plain", 0.0)
        yield


def digits(solution: qs.Solution) -> tuple[object, ...]:
    """All that a solve finds, to the last bit."""
    arrays = solution.displacement, solution.stiffness, solution.inner.load, solution.outer.angle, solution.residual
    codes = str(solution.status), str(solution.reason), int(solution.iterations)
    return *codes, *(array.tobytes() for array in map(np.asarray, arrays))
