"""The case: what the kernel is given of one scene, a flat record of numbers and choices, free of dimensions.

Inside, lengths are in ball diameters D, forces in E'D^2, masses in ball masses m, speeds in sqrt(E'D/m), so that the
same bearing in any size gives the same digits. The formulas do not change: they are written with D, m and E', which
here happen to be 1.
"""

from __future__ import annotations

from typing import Any

import numpy as np


def record(*fields: tuple[Any, ...]) -> np.dtype:
    """A record of these fields; plain Python reads them as machine code does."""
    return np.dtype((np.record, np.dtype(list(fields), align=True)))


CASE = record(
    ("ball_count", np.int64),
    ("pitch_diameter", np.float64),
    ("inner_coefficient", np.float64),
    ("outer_coefficient", np.float64),
    ("sin_free", np.float64),
    ("cos_free", np.float64),
    ("unequal_balls", np.bool_),  # each has a diameter of its own
    ("elastic_rings", np.bool_),  # grooves part under the balls' loads
    ("out_of_round", np.bool_),  # grooves stand nearer at some azimuths than at others, before any load
    ("interference", np.float64),  # how much less room, radially, the grooves leave than the balls need
    ("tilt_lever", np.float64),
    ("hertz_cosine", np.float64),  # of the angle at which curvatures are taken, where it is not each ball's own
    ("inner_stiffness", np.float64),  # there
    ("outer_stiffness", np.float64),
    ("series_stiffness", np.float64),
    ("first_azimuth", np.float64),
    ("inner_speed", np.float64),
    ("outer_speed", np.float64),
    ("prescribed", np.float64, (5,)),  # each channel's load or displacement
    ("displacement_given", np.uint8, (5,)),  # which of the two
    ("centrifugal", np.bool_),
    ("gyroscopic", np.bool_),
    ("friction_coefficient", np.float64),  # that contacts offer against the gyroscopic moment; NO_BOUND for no bound
    ("displaced_orbit", np.bool_),  # balls go round at their own radius
    ("common_motion", np.bool_),  # all balls move alike, so:
    ("common_orbit", np.float64),
    ("common_axial_rotation", np.float64),
    ("common_radial_rotation", np.float64),  # towards the bearing axis
    ("actual_angle", np.bool_),
    ("one_sided", np.bool_),
    ("control", np.int64),
    ("shares", np.int64),
    ("form", np.int64),
    ("length", np.float64),  # units of this case, SI
    ("force", np.float64),
    ("speed", np.float64),
)
"""One case."""

OWN_BALL = record(
    ("diameter", np.float64),
    ("inner_stiffness", np.float64),  # as those of the case, for a ball of this diameter
    ("outer_stiffness", np.float64),
    ("outer_compliance", np.float64),  # of elastic rings, for the harmonic of the ball's number
    ("inner_compliance", np.float64),
    (
        "lobe",
        np.float64,
    ),  # of grooves out of round: by how much farther the inner one stands out there than the outer one
)
"""One ball of a case with unequal balls or grooves out of round; one harmonic of a case with elastic rings."""

RESULT = record(
    ("displacement", np.float64, (5,)),  # of the ring; at first the start, where one is given
    ("load", np.float64, (5,)),  # on the ring, reactions of prescribed displacements included
    ("residual", np.float64),
    ("reached", np.float64),  # the part of the speed that all this is for
    ("iterations", np.int32),
    ("status", np.int8),
    ("notes", np.int8),  # what there is to say about the case, as bits
)
"""What the kernel finds for one case, but for its balls."""

BALL_MASS = 1.0
BALL_INERTIA = 0.1
