"""The kernel's working memory: one record for the ring, one for each ball that is solved.

Records travel through the kernel as single pointers, which keeps its calls, and its compilation, short. One thread
uses one ring and one set of balls for all its cases; nothing in them outlives a case but the balls' azimuths.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from qsbearing.keeping import SLOTS

if TYPE_CHECKING:
    from numpy.typing import NDArray

_BALL = np.dtype(
    [
        # By a ball's own number in the bearing:
        ("azimuth_cosine", np.float64),
        ("azimuth_sine", np.float64),
        ("place", np.int64),  # where the ball that is solved for it stands in this array
        # By place among the balls solved:
        ("number", np.int64),
        ("cosine", np.float64),
        ("sine", np.float64),
        ("weight", np.float64),  # how many equal balls it stands for
        ("control", np.int64),  # its raceway control
        ("changes", np.int64),  # how often that has changed
        ("factor", np.float64, (5,)),  # through which each channel solved feels its force, weight included
        ("lever", np.float64, (5,)),  # through which each channel solved moves its inner groove centre
        # Links: the contact lines as unit vectors (sine, cosine), and what they are longer than at touching. At rest
        # the inner link alone stands for both, from groove centre to groove centre.
        ("outer_sine", np.float64),
        ("outer_cosine", np.float64),
        ("outer_approach", np.float64),
        ("inner_sine", np.float64),
        ("inner_cosine", np.float64),
        ("inner_approach", np.float64),
        ("outer_inverse", np.float64),  # 1/length
        ("inner_inverse", np.float64),
        ("du1", np.float64),  # the links' steps
        ("du2", np.float64),
        ("dv1", np.float64),
        ("dv2", np.float64),
        ("gap1", np.float64),  # what the links lack of the chain between the grooves' centres
        ("gap2", np.float64),
        ("turn", np.float64),  # the larger turn of its contact lines by the step
        ("is_idle", np.bool_),  # its place is its inertia's more than the ring's
        ("saved", np.float64, (SLOTS, 6)),  # links to come back to, by slot
        ("saved_control", np.int64, (SLOTS,)),
        ("force", np.float64, (3,)),  # on the ring: axial, radial, and moment about the groove centres' circle
        ("condensed", np.float64, (3,)),  # the same with the ball's own step taken out
        ("stiffness", np.float64, (3, 2)),  # of that, by the inner groove centre's displacement
        ("y1", np.float64),  # the ball's own step is -(y + Y dA)
        ("y2", np.float64),
        ("y11", np.float64),
        ("y12", np.float64),
        ("y21", np.float64),
        ("y22", np.float64),
        # Derivatives by its own place: of its imbalance, with the inverse of their determinant, and of its force.
        ("own11", np.float64),
        ("own12", np.float64),
        ("own21", np.float64),
        ("own22", np.float64),
        ("inverse", np.float64),
        ("by_own", np.float64, (3, 2)),
        # On ways to a balance: the dead force on it, what of that acts; its share of a tangent and of Newton's step.
        ("dead", np.float64, (2,)),
        ("push", np.float64, (2,)),
        ("tangent", np.float64, (2,)),
        ("first", np.float64, (2,)),
    ],
    align=True,
)
BALL = np.dtype((np.record, _BALL))

_RING = np.dtype(
    [
        ("displacement", np.float64, (5,)),
        ("step", np.float64, (5,)),
        ("before", np.float64, (5,)),
        ("saved", np.float64, (SLOTS, 5)),  # displacements to come back to, by slot
        ("saved_scale", np.float64, (SLOTS,)),  # and the largest force there
        ("load", np.float64, (5,)),  # the case's own, while others stand in for it
        ("balls", np.int64),  # how many balls are solved
        ("channels", np.int64),  # how many channels are solved: free, and in the plane of symmetry
        ("channel", np.int64, (5,)),  # which
        ("row", np.int64, (5,)),  # for each, which of a ball's three forces it feels
        ("in_plane", np.float64, (5,)),  # 1 for channels that the symmetry leaves, 0 where it makes all vanish
        ("imbalance", np.float64, (5,)),  # of the channels solved: the balls' forces less the load
        ("right", np.float64, (5,)),
        ("matrix", np.float64, (5, 5)),
        ("kept_matrix", np.float64, (5, 5)),  # before it was solved with
        ("orientation", np.float64),  # the sign of its determinant
        ("inertia_grows", np.bool_),  # on a path: with the part, as dead forces on the balls fade
        ("dead", np.float64, (5,)),  # on ways to a balance: as of a ball
        ("frozen", np.float64),  # the largest force on a ball that stands in for inertia, while it does
        ("tangent", np.float64, (5,)),
        ("first", np.float64, (5,)),
        ("floor", np.float64),  # least stiffness of anything
        ("limit", np.float64),  # the most friction that contacts may carry, over their load; 0 for no limit
        ("grip", np.float64),  # what of that they do, less on a path
        ("scale", np.float64),  # the largest force
        ("reached", np.float64),  # the part of the speed that ring and balls stand for
        ("at_rest", np.bool_),  # no inertia: each ball is one link
        ("largest_approach", np.float64),  # of any inner link, or link at rest
        ("ran_away", np.bool_),  # at rest nothing stopped it
        ("azimuth_count", np.float64),  # the balls' azimuths stand for this many, the first at
        ("azimuth_first", np.float64),
    ],
    align=True,
)
RING = np.dtype((np.record, _RING))


def working_memory(balls: int) -> tuple[NDArray, NDArray]:
    """(ring, balls) for bearings of up to this many balls."""
    return np.zeros(1, RING), np.zeros(balls, BALL)
