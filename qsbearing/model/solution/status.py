"""How a case ended, and why it has no equilibrium; the kernel's codes by their names."""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.admissibility import (
    CONVERGED,
    FRICTION_WITHOUT_LOAD,
    NO_EQUILIBRIUM,
    NO_ORBIT,
    NOT_CONVERGED,
    OPEN_SIDE,
    OVER_SHOULDER,
    UNSUPPORTED,
)


class Status(StrEnum):
    """How a case ended."""

    CONVERGED = "converged"
    """Balls and ring are in equilibrium."""
    NO_EQUILIBRIUM = "no_equilibrium"
    """Nothing in the bearing supports the load; `message` says which channel or which hypothesis fails."""
    NOT_CONVERGED = "not_converged"
    """No equilibrium was found; that is no proof that there is none."""


class Reason(StrEnum):
    """Why a case has no equilibrium."""

    UNSUPPORTED = "unsupported"
    """Nothing supports the load: the ring moves without end, and the energy falls without bound."""
    OPEN_SIDE = "open_side"
    """Balls would have to press on the open side of the inner groove, at angles below zero."""
    OVER_SHOULDER = "over_shoulder"
    """Balls would have to press beyond 90 degrees, where no groove is."""
    FRICTION_WITHOUT_LOAD = "friction_without_load"
    """The raceway-control hypothesis puts friction where too little load or none carries it."""
    NO_ORBIT = "no_orbit"
    """Rolling under the raceway-control hypothesis would leave balls standing, or carry them backwards."""


_REASONS = {
    UNSUPPORTED: Reason.UNSUPPORTED,
    FRICTION_WITHOUT_LOAD: Reason.FRICTION_WITHOUT_LOAD,
    NO_ORBIT: Reason.NO_ORBIT,
    OPEN_SIDE: Reason.OPEN_SIDE,
    OVER_SHOULDER: Reason.OVER_SHOULDER,
}
"""Several may hold; the first of these is reported."""

STATUS_OF_CODE = dict(zip((CONVERGED, NO_EQUILIBRIUM, NOT_CONVERGED), Status, strict=True))


def reasons(results: NDArray) -> NDArray:
    """The reason of each case record by its name; empty where there is an equilibrium, or none is known."""
    names = np.full(results["notes"].shape, "", dtype=f"<U{max(map(len, Reason))}")
    for bit, reason in reversed(_REASONS.items()):
        names[(results["status"] == NO_EQUILIBRIUM) & ((results["notes"] & bit) != 0)] = reason
    return names
