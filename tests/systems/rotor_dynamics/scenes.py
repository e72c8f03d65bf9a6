"""Bearings in operation that leave no entry of the stiffness at nothing."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

import qsbearing as qs
from tests.qsbearing.scenes import BOTH, DEEP_GROOVE, OUTER, SPINDLE


def spindle_bearing(speed: ArrayLike, sense: float = 1.0) -> qs.Solution:
    """An angular-contact bearing under thrust, both radial loads and both tilts, with both ball effects."""
    operation = qs.Operation(
        speed=speed,
        axial_load=900.0,
        radial_load_y=500.0,
        radial_load_z=-200.0,
        tilt_y=sense * 0.2 * qs.mrad,
        tilt_z=sense * -0.1 * qs.mrad,
    )
    return solved(qs.Scene(SPINDLE, operation, ball_effects=BOTH, raceway_control=OUTER))


def deep_groove_bearing(sense: float) -> qs.Solution:
    """A bearing that carries thrust either way, and the same in a mirror across its axis; sense is 1 or -1."""
    operation = qs.Operation(
        speed=9_000 * qs.rpm,
        axial_load=sense * 1500.0,
        radial_load_y=400.0,
        radial_load_z=300.0,
        moment_y=sense * 2.0,
        moment_z=sense * 1.0,
    )
    return solved(qs.Scene(DEEP_GROOVE, operation, ball_effects=BOTH, raceway_control=OUTER))


def pair(speed: ArrayLike, axial_load: float) -> qs.SetSolution:
    """A pair in an O arrangement under loads in all channels; groove centres of the inner rings 0.1 m apart.

    Positions of rows are those of the balls, tilts of a row turn about its ring's groove centres.
    """
    outside = 0.05 + (SPINDLE.inner_groove_radius - 0.5 * SPINDLE.ball_diameter) * np.sin(SPINDLE.free_contact_angle)
    operation = qs.Operation(
        speed=speed, axial_load=axial_load, radial_load_y=600.0, radial_load_z=-250.0, moment_y=8.0, moment_z=3.0
    )
    rows = qs.Row(SPINDLE, position=-outside), qs.Row(SPINDLE, position=outside, carries="-x")
    return qs.solve_set(
        qs.BearingSet(rows, operation, qs.Preload(rigid=1200.0), ball_effects=BOTH, raceway_control=OUTER)
    )


def solved(scene: qs.Scene) -> qs.Solution:
    """A solution that is there."""
    solution = qs.solve(scene)
    assert np.all(solution.converged)
    return solution
