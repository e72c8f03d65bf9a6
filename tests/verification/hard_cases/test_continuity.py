"""Sweeps through what is hard: continuous where the physics is, jumping where it jumps, the same from either side.

Each sweep is solved three times: every point from scratch, in one call, and point after point from its neighbour, up
and down.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.remarks.of_solution import warnings
from tests.qsbearing.scenes import B218, DEEP_GROOVE, PER_BALL, UPRIGHT, fewer, resting, turning
from tests.verification.hard_cases.generate import load_reference

DEEP = replace(B218, kind=qs.BearingKind.DEEP_GROOVE)
PLAY = replace(DEEP_GROOVE, free_contact_angle=9 * qs.deg, ball_count=9, pitch_diameter=46 * qs.mm)
"""A deep-groove bearing with play."""
AGREES = 1e-10
"""Of the largest load: the tolerance, 1e-12, at either end, and what the condition of these cases, up to 1e2, adds."""

Make = Callable[[Any], qs.Scene]
"""A scene from one number, or a scene of many cases from an array."""


@dataclass(frozen=True)
class Sweep:
    """A scene that depends on one number, from its first value to its last."""

    make: Make
    first: float
    last: float
    points: int = 61


CLEAR = {"radial_displacement_y": 0.0, "radial_displacement_z": 0.0, **UPRIGHT}
SMOOTH = {
    "unloading at rest": Sweep(
        lambda v: resting(DEEP, axial_load=8e3, radial_load_y=v, **UPRIGHT), 0.0, 9e3
    ),
    "unloading at speed": Sweep(
        lambda v: turning(3000, DEEP, axial_load=4e3, radial_load_y=v, **UPRIGHT), 0.0, 12e3, 241
    ),
    "unloading, free to tilt": Sweep(
        lambda v: turning(
            6000, DEEP, axial_load=6e3, radial_load_y=v, radial_load_z=0.2 * v, moment_y=0.0, moment_z=0.0
        ),
        0.0,
        9e3,
    ),
    "speed at light thrust": Sweep(lambda v: turning(v, DEEP, axial_load=200.0), 0.0, 14e3, 141),
    "speed at light load, balls lost": Sweep(
        lambda v: turning(v, DEEP, axial_load=200.0, radial_load_y=100.0, **UPRIGHT), 0.0, 14e3, 141
    ),
    "speed with play": Sweep(
        lambda v: turning(v, PLAY, axial_load=20.0, radial_load_y=300.0, **UPRIGHT), 0.0, 15e3, 151
    ),
    "thrust reversed at rest": Sweep(
        lambda v: resting(PLAY, axial_load=v, radial_load_y=500.0, **UPRIGHT), 300.0, -300.0
    ),
    "thrust reversed at speed": Sweep(
        lambda v: turning(8000, PLAY, axial_load=v, radial_load_y=500.0, **UPRIGHT), 300.0, -300.0
    ),
    "from clearance to preload": Sweep(
        lambda v: turning(9000, DEEP, axial_displacement=v, **CLEAR), -4e-4, 1e-4, 101
    ),
    "a turning ring stopped and reversed": Sweep(
        lambda v: turning(v, DEEP, axial_load=5e3, radial_load_y=3e3, moment_z=0.0), 3e3, -3e3
    ),
    "rings together to rings apart": Sweep(
        lambda v: turning(6000, DEEP, outer_rpm=v, axial_load=2e3, radial_load_y=500.0, moment_z=0.0), 6e3, -6e3
    ),
}  # fmt: skip


def loads(solution: qs.Solution) -> NDArray:
    """(point, contact)."""
    assert solution.converged.all(), solution.status
    return np.concatenate([solution.inner.load, solution.outer.load], axis=-1)


def cold(make: Make, values: NDArray) -> qs.Solution:
    """Every point from scratch."""
    return qs.solve(make(values))


def warm(make: Make, values: NDArray) -> list[qs.Solution]:
    """Point after point, each from the one before."""
    solutions: list[qs.Solution] = []
    for value in values:
        solutions.append(qs.solve(make(float(value)), start=solutions[-1] if solutions else None))
    return solutions


def warm_loads(make: Make, values: NDArray) -> NDArray:
    return np.array([loads(solution) for solution in warm(make, values)])


@pytest.mark.parametrize("name", list(SMOOTH))
def test_up_down_and_from_scratch_agree_without_a_jump(name: str) -> None:
    """One state at every point, however it is come to: no branch is left, none is taken by mistake.

    With half the step the largest change of any contact load is half as large: no part of it is a jump. A jump would
    stay; a load that sets in like a square root would fall to 0.71.
    """
    sweep = SMOOTH[name]
    points = fewer(sweep.points, 9)
    fine = loads(cold(sweep.make, np.linspace(sweep.first, sweep.last, 2 * points - 1)))
    coarse, values = fine[::2], np.linspace(sweep.first, sweep.last, points)
    largest_coarse, largest_fine = (np.abs(np.diff(array, axis=0)).max() for array in (coarse, fine))
    assert largest_fine <= (0.6 if points > 20 else 0.72) * largest_coarse
    up, down = warm_loads(sweep.make, values), warm_loads(sweep.make, values[::-1])[::-1]
    assert np.abs(up - coarse).max() <= AGREES * coarse.max()
    assert np.abs(down - coarse).max() <= AGREES * coarse.max()


@pytest.mark.parametrize(
    ("name", "least"),
    [
        ("unloading at rest", 8),
        ("unloading at speed", 1),
        ("speed at light load, balls lost", 8),
        ("from clearance to preload", 16),
    ],
)
def test_balls_are_lost_on_the_way(name: str, least: int) -> None:
    """The sweeps go through what they are for: at one end all balls are loaded, at the other so many have left."""
    sweep = SMOOTH[name]
    lost = (cold(sweep.make, np.linspace(sweep.first, sweep.last, 5)).inner.load == 0.0).sum(axis=-1)
    assert lost.min() == 0
    assert lost.max() >= least


# Symmetry and jumps under reversal ----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["thrust reversed at rest", "thrust reversed at speed"])
def test_a_reversed_thrust_mirrors_the_bearing(name: str) -> None:
    """The same axial load the other way: every angle's sign turns, every load stays, x mirrors about the middle."""
    sweep = SMOOTH[name]
    middle = -float(PLAY.groove_centre_distance) * np.sin(9 * qs.deg)
    for value in (300.0, 40.0, 1.0):
        one, other = qs.solve(sweep.make(value)), qs.solve(sweep.make(-value))
        assert other.inner.load == pytest.approx(one.inner.load, rel=1e-9, abs=1e-9 * one.inner.load.max())
        assert other.displacement[0] - middle == pytest.approx(-(one.displacement[0] - middle), rel=1e-8)
        loaded = one.inner.load > 0.0
        assert other.inner.angle[loaded] == pytest.approx(-one.inner.angle[loaded], rel=1e-8)


def test_pure_thrust_reversed_jumps_across_the_play_and_says_so() -> None:
    """Nothing but thrust: through zero the ring crosses its axial play, 2 BD sin(a0), whatever the step."""
    play = 2.0 * float(PLAY.groove_centre_distance) * np.sin(9 * qs.deg)
    for tiny in (1.0, 1e-3, 1e-6):
        one, other = (qs.solve(resting(PLAY, axial_load=sign * tiny)) for sign in (1.0, -1.0))
        jump = one.displacement[0] - other.displacement[0]
        assert jump > play
        # What the contacts yield: their axial stiffness grows from nothing with the third root of the load.
        assert jump - play < 2.0 * 3e-6 * tiny ** (2.0 / 3.0)
    nothing = qs.solve(resting(PLAY, axial_load=0.0))
    assert nothing.converged
    assert any("No load acts on the ring" in words for words in warnings(nothing))


def test_an_open_side_lets_go_at_zero() -> None:
    """An angular-contact bearing under falling thrust: solved down to a billionth of a newton, refused below zero."""
    thrust = np.array([1e3, 1.0, 1e-3, 1e-6, 1e-9, -1e-9, -1e-6, -1e-3, -1.0, -1e3])
    found = qs.solve(resting(axial_load=thrust)).status
    assert [str(status) for status in found] == ["converged"] * 5 + ["no_equilibrium"] * 5


# Raceway control ----------------------------------------------------------------------------------------------------

BAND = (2081.51116, 2086.90434)
"""rpm at B218's 17.8 kN: above the last consistent inner control, below the first consistent outer (50 digits)."""


def thrust_by_jones(rpm: Any) -> qs.Scene:
    return turning(rpm, control=PER_BALL, axial_load=17.8e3)


def controls(solution: qs.Solution) -> str:
    """One letter for each ball."""
    assert solution.raceway_control is not None
    return "".join(word[0] for word in solution.raceway_control)


def three_ways(make: Make, values: NDArray) -> tuple[list[qs.Solution], ...]:
    """Each point alone from scratch, up from its neighbour, and down from it."""
    alone = [qs.solve(make(float(value))) for value in values]
    return alone, warm(make, values), warm(make, values[::-1])[::-1]


def test_control_switches_where_the_reference_says() -> None:
    """Inner below the band, outer above. Within it neither is consistent: which is found may depend on the way, but it
    is the equilibrium of one of the two, and the solution says that it is not consistent."""
    values = np.array([2050.0, 2075.0, BAND[0] - 1e-3, BAND[0] + 1e-3, 2084.0, BAND[1] - 1e-3, BAND[1] + 1e-3, 2100.0])
    for solutions in three_ways(thrust_by_jones, values):
        for value, solution in zip(values, solutions, strict=True):
            assert solution.converged
            within = BAND[0] < value < BAND[1]
            assert bool(solution.control_is_consistent) != within, value
            assert any("No consistent raceway control" in words for words in warnings(solution)) == within
            if not within:
                assert set(controls(solution)) == {"i" if value < BAND[0] else "o"}
            (word,) = set(solution.raceway_control)  # type: ignore[arg-type]
            pure = qs.solve(turning(value, control=qs.RacewayControl(str(word)), axial_load=17.8e3))
            assert solution.inner.load == pytest.approx(pure.inner.load, rel=1e-10)


def test_the_jump_at_the_switch_is_the_reference_s() -> None:
    """Across the band the loads jump by what the fifty-digit solutions on its two sides differ by."""
    reference = {entry["case"]["name"]: entry["result"] for entry in load_reference()}
    found = cold(thrust_by_jones, np.array([BAND[0] - 5.4, BAND[0] - 1e-4, BAND[1] + 1e-4])).outer.load[:, 0]
    inner, outer = (
        float(reference[f"control_switches_{side}_side"]["balls"][0]["outer"]["load"]) for side in ("inner", "outer")
    )
    assert abs(outer - inner) > 0.5
    # The references stand a millionth of the speed from the band's ends, these points a twentieth of that.
    assert found[2] - found[1] == pytest.approx(outer - inner, rel=1e-3)
    # Within one control the same step in speed changes next to nothing.
    assert abs(found[1] - found[0]) < 0.3 * abs(outer - inner)


def test_balls_switch_one_after_the_other() -> None:
    """With every ball loaded otherwise, control passes from inner to outer ball by ball, and no other jumps occur.

    Up, down and from scratch: the same controls and loads wherever both are consistent; elsewhere other controls may
    be found, each an equilibrium, each with its warning.
    """

    def make(rpm: float) -> qs.Scene:
        loads = {"axial_load": 20e3, "radial_load_y": 9e3, "radial_load_z": 2e3, "moment_y": 0.0, "moment_z": -250.0}
        return turning(rpm, control=PER_BALL, **loads)

    scratch, up, down = three_ways(make, np.linspace(1500.0, 4500.0, fewer(121, 5)))
    patterns = [controls(solution) for solution in scratch]
    outer = [pattern.count("o") for pattern in patterns]
    assert outer[0] <= 4
    assert outer[-1] >= 14
    assert all(other >= one for one, other in pairwise(outer))
    for one, other in [*zip(scratch, up, strict=True), *zip(scratch, down, strict=True)]:
        if controls(one) == controls(other):
            assert np.abs(loads(one) - loads(other)).max() <= AGREES * loads(one).max()
        else:
            assert not one.control_is_consistent or not other.control_is_consistent
            assert other.converged
    if has_fast_code():
        # Between switches the loads drift evenly; where some ball switches they may jump.
        change = np.abs(np.diff([loads(solution) for solution in scratch], axis=0)).max(axis=1)
        switched = np.array([one != other for one, other in pairwise(patterns)])
        assert change[~switched].max() <= 2.0 * np.median(change[~switched])
        assert change[switched].max() > change[~switched].max()
