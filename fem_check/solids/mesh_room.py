"""Room for a contact on its mesh: how far round the groove it reaches, and larger meshes where it fills one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from fem_check import meshing
from fem_check.independent.groove import BallInGroove
from fem_check.independent.references import ellipse
from fem_check.mechanics.contact import ContactError
from fem_check.solids import contact_block

T = TypeVar("T")
MESH_LOADS = (1.0, 1.4, 2.0)
"""What a mesh is made for, over the load, until the contact finds room on its patch: a groove hardly larger than the
ball makes a contact whose semi-minor axis is larger than Hertz's."""


class NoRoomError(ContactError):
    """The contact fills the patch that the mesh allows."""


def room(groove: BallInGroove, load: float) -> tuple[float, float]:
    """The contact's angle, and how far round the groove its elements reach to either side [rad]."""
    return groove.contact_angle, contact_block.PATCH * ellipse(
        groove.problem(load)
    ).semi_major_axis / groove.groove_radius


def with_room(solved: Callable[[float], T], load: float) -> T:
    """What is solved on a mesh that is made for a load, or for more where the contact needs more room.

    Raises:
        NoRoomError: none of `MESH_LOADS` gives it enough.
    """
    full: NoRoomError | None = None
    for more in MESH_LOADS:
        try:
            return solved(more * load)
        except NoRoomError as problem:
            full = problem
        except meshing.MeshError as problem:
            if full is None:
                raise
            raise NoRoomError(f"{full}; a mesh for {more:g} times the load is refused: {problem}") from problem
    assert full is not None
    raise full
