"""The working memory: one record for the ring and the state of the solve, one for each ball that is solved.

Records travel through the kernel as single pointers, which keeps its calls, and its compilation, short. One thread uses
one workspace and one set of balls for all its cases; nothing in them outlives a case but the balls' azimuths.

A case itself is never changed. What a continuation varies stands here: a factor on its loads, a factor on its speeds,
and the bound on friction.
"""

from __future__ import annotations

from threading import local

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.kernel.case import CASE, OWN_BALL, RESULT, record
from qsbearing.model.kernel.snapshots import SNAPSHOTS

MOST_WAVES = 12
"""Waves round a ring that balls are told apart by, as many as half their number; of more balls the shorter waves, which
make 1e-3 of the deflection under a ball, are left out."""
RING_MODES = 2 * MOST_WAVES + 1
"""Modes of so many waves: cosines and sines, and uniform growth."""

BALL = record(
    # By a ball's number in the bearing:
    ("azimuth_cosine", np.float64),
    ("azimuth_sine", np.float64),
    ("index", np.int64),  # of the ball in this array that is solved for it
    # By index among the balls solved:
    ("number", np.int64),  # in the bearing
    ("diameter", np.float64),
    ("inner_stiffness", np.float64),  # where balls are unequal and curvatures are not taken at each ball's own angle
    ("outer_stiffness", np.float64),
    ("inner_spin", np.float64),  # a E/Q^(1/3) of each raceway, where raceway control weighs them
    ("outer_spin", np.float64),
    ("cosine", np.float64),
    ("sine", np.float64),
    ("weight", np.float64),  # how many equal balls it stands for
    ("control", np.int64),  # its raceway control
    ("control_changes", np.int64),
    ("factor", np.float64, (5,)),  # through which each channel solved feels its force, weight included
    ("lever", np.float64, (5,)),  # through which each channel solved moves its inner groove centre
    # Contact lines: unit vectors (sine, cosine) of the contact angles, and approaches. At rest the inner line alone
    # stands for both contacts, from groove centre to groove centre.
    ("outer_sine", np.float64),
    ("outer_cosine", np.float64),
    ("outer_approach", np.float64),
    ("inner_sine", np.float64),
    ("inner_cosine", np.float64),
    ("inner_approach", np.float64),
    ("outer_inverse", np.float64),  # 1/length
    ("inner_inverse", np.float64),
    ("outer_step1", np.float64),  # steps of the two lines, axial and radial
    ("outer_step2", np.float64),
    ("inner_step1", np.float64),
    ("inner_step2", np.float64),
    ("closure1", np.float64),  # residual of loop closure: what the lines lack between the groove centres
    ("closure2", np.float64),
    ("turn", np.float64),  # the larger turn of its contact lines by the step
    ("follows_inertia", np.bool_),  # its inner load hardly counts beside its centrifugal force
    ("snapshot", np.float64, (SNAPSHOTS, 6)),
    ("snapshot_control", np.int64, (SNAPSHOTS,)),
    # Evaluated: its imbalance, and its force on the ring (axial, radial, moment about the groove centre circle).
    ("imbalance", np.float64, (2,)),
    ("force", np.float64, (3,)),
    ("condensed", np.float64, (3,)),  # the same after the ball's own step
    ("stiffness", np.float64, (3, 2)),  # of that, by the inner groove centre's displacement
    ("y1", np.float64),  # the ball's own step is -(y + Y dA)
    ("y2", np.float64),
    ("y11", np.float64),
    ("y12", np.float64),
    ("y21", np.float64),
    ("y22", np.float64),
    # Elastic rings: by how much their grooves part at it, radially, and the step of that; its radial force on the outer
    # ring, likewise condensed, and the stiffness of that.
    ("deflection", np.float64),
    ("lobe", np.float64),  # where grooves are out of round
    ("deflection_step", np.float64),
    ("outer_force", np.float64),
    ("outer_condensed", np.float64),
    ("outer_stiffness_1", np.float64),
    ("outer_stiffness_2", np.float64),
    ("deflection_snapshot", np.float64, (SNAPSHOTS,)),
)

WORKSPACE = record(
    ("load_factor", np.float64),  # on the loads of the case
    ("speed_factor", np.float64),  # on the speeds of the case
    ("friction_bound", np.float64),  # the most friction that contacts carry, over their load; NO_BOUND for none
    ("at_rest", np.bool_),  # no inertia acts: each ball is one contact line
    ("displacement", np.float64, (5,)),
    ("step", np.float64, (5,)),
    ("reaction", np.float64, (5,)),
    ("snapshot", np.float64, (SNAPSHOTS, 5)),
    ("snapshot_force", np.float64, (SNAPSHOTS,)),  # the largest force there
    ("snapshot_residual", np.float64, (SNAPSHOTS,)),
    ("snapshot_bound", np.float64, (SNAPSHOTS,)),
    ("snapshot_speed", np.float64, (SNAPSHOTS,)),
    ("ball_count", np.int64),  # of balls solved
    ("channel_count", np.int64),  # of channels solved: loaded, and in the plane of symmetry
    ("channel", np.int64, (5,)),  # which
    ("row", np.int64, (5,)),  # for each, which of a ball's three forces it feels
    ("in_plane", np.float64, (5,)),  # 1 for channels that the symmetry leaves, 0 where it makes all vanish
    ("imbalance", np.float64, (5,)),  # of the channels solved: the balls' forces less the load
    ("right_side", np.float64, (5,)),
    ("matrix", np.float64, (5, 5)),
    ("regularisation", np.float64),  # least stiffness of anything
    ("largest_force", np.float64),
    ("largest_approach", np.float64),  # of any inner line
    ("iterations", np.int64),  # spent on the case
    ("budget", np.int64),  # after which it counts as not converged
    ("residual", np.float64),  # of the last solve
    ("azimuth_count", np.float64),  # the balls' azimuths stand for this many, the first at
    ("azimuth_first", np.float64),
    # Elastic rings (`kernel.ring_bending`):
    ("outer_compliance", np.float64, (MOST_WAVES + 1,)),  # by waves
    ("inner_compliance", np.float64, (MOST_WAVES + 1,)),
    ("mode_count", np.int64),
    ("wave", np.int64, (RING_MODES,)),  # of each mode
    ("is_sine", np.uint8, (RING_MODES,)),
    ("value", np.float64, (RING_MODES,)),  # of each mode at a ball
    ("amplitude", np.float64, (RING_MODES,)),
    ("by_mode", np.float64, (5, RING_MODES)),  # the channels' loads
    ("modes", np.float64, (RING_MODES, RING_MODES + 7)),
)


class Memory(local):
    """What a thread keeps: making records anew takes as long as a fifth of a case."""

    def __init__(self, ring: np.dtype, ball: np.dtype) -> None:
        self._types, self._balls = (ring, ball), -1
        self.kinds = array_of(ring), array_of(ball)
        self._memory: tuple[NDArray, NDArray]

    def __call__(self, balls: int) -> tuple[NDArray, NDArray]:
        """(a record of the ring, records of up to so many balls): the thread's own, used by one call at a time."""
        if self._balls < balls:
            ring, ball = self._types
            self._balls, self._memory = balls, (np.zeros(1, ring), np.zeros(balls, ball))
        return self._memory


working_memory = Memory(WORKSPACE, BALL)
"""(workspace, balls) for bearings of up to this many balls."""

GIVEN = array_of(CASE), *working_memory.kinds, array_of(OWN_BALL, 2)
"""The kinds of what the kernel is given of cases: their records, working memory, `OWN_BALL` (case, ball)."""
FOUND = array_of(RESULT), array_of(float, 3), array_of(np.int8, 2)
"""Of what it finds: results, positions (case, ball, 3 or 4), controls (case, ball)."""
