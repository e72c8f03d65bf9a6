"""Whether balls that friction moves and that are said to have no equilibrium have one where no groove is.

It is evidence, as of other refusals (`certificates.py`): that there is no other equilibrium is not proved. The balance
knows neither an open side nor shoulders on its way. What it found is read as if it were a result and recomputed as any
other; it counts if all of it holds but for the place of an inner contact that carries load.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects.traction import ANGLES, RADII, Traction
from qsbearing.model.kernel.admissibility import CONVERGED, NO_EQUILIBRIUM
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.friction_balance import FrictionMotion, balanced, read
from qsbearing.model.solution.solved_cases import solved_of
from tests.qsbearing.scenes import BOTH
from tests.verification.campaign.certificates import NOT_PROVED, RESTRICTIONS, ROUNDING


def certificates(
    scene: qs.Scene, traction: Traction, found: FrictionMotion, holds: Callable[[FrictionMotion], NDArray]
) -> list[str]:
    """What there is to say for each refusal, in the order of the cases.

    Args:
        found: that has them.
        holds: of a motion whether each case is right but for the places of its contacts.
    """
    refused = np.flatnonzero(found.status == "no_equilibrium")
    if refused.size == 0:
        return []
    passed = as_if_found(scene, traction, found)
    is_whole, places = holds(passed), outside(passed)
    return [f"{places[k]}, an equilibrium" if is_whole[k] and places[k] else NOT_PROVED for k in refused]


def as_if_found(scene: qs.Scene, traction: Traction, found: FrictionMotion) -> FrictionMotion:
    """The same balances, the refused ones as results."""
    moved = replace(scene, ball_effects=BOTH, raceway_control=qs.RacewayControl.FRICTION, traction=traction)
    unread = balanced(found.start, CaseMaker(moved, solved_of(found.start).maker.axial), traction, RADII, ANGLES)
    unread.results["status"][unread.results["status"] == NO_EQUILIBRIUM] = CONVERGED
    return read(unread)


def outside(found: FrictionMotion) -> list[str]:
    """Of each case where an inner contact carries load and no groove is; empty where none does."""
    with np.errstate(invalid="ignore"):
        is_loaded = found.inner.load > 0.0
        beyond = (is_loaded & (np.cos(found.inner.angle) < -ROUNDING)).any(axis=1)
        open_side = (is_loaded & (np.sin(found.inner.angle) < -ROUNDING)).any(axis=1)
    kinds = zip(beyond, open_side, strict=True)
    return [RESTRICTIONS["over_shoulder" if over else "open_side"] if over or side else "" for over, side in kinds]
