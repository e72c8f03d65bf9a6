"""A process that solves in plain Python, within one that does not."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler import compiled


@contextmanager
def in_plain_python() -> Iterator[None]:
    """Within, nothing is machine code."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(compiled, "IS_PLAIN", True)
        patch.setattr(compiled, "HAS_NUMBA", False)
        for entry in compiled.entries:
            patch.setattr(entry, "_run", None)
        yield


def digits(solution: qs.Solution) -> tuple[object, ...]:
    """All that a solve finds, to the last bit."""
    arrays = solution.displacement, solution.stiffness, solution.inner.load, solution.outer.angle, solution.residual
    codes = str(solution.status), str(solution.reason), int(solution.iterations)
    return *codes, *(array.tobytes() for array in map(np.asarray, arrays))
