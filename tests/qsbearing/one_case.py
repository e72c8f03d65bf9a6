"""What an entry of the kernel takes to solve one case: for tests that call its inner functions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.case import CaseMaker
from qsbearing.state import working_memory


def one_case(scene: qs.Scene) -> tuple[NDArray, ...]:
    """(cases, rings, balls, displacement, position, control) of a scene of one case, nothing solved yet."""
    maker = CaseMaker(scene)
    count = maker.ball_axis
    return (
        maker.make(),
        *working_memory(count),
        np.zeros(5),
        np.zeros((count, 3)),
        np.zeros(count, np.int8),
    )
