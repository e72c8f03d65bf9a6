"""Balls go round, whichever raceway controls them: radially loaded bearings, checked from outside the kernel."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.systems.heat import spindle
from tests.verification.campaign import realistic
from tests.verification.campaign.checks import findings, standing_balls
from tests.verification.campaign.group import Group
from tests.verification.campaign.mounted import of_one_ball_count

pytestmark = pytest.mark.skipif(not has_fast_code(), reason="thousands of bearings take hours in plain Python")

CONTROLS = ["inner", "per_ball", "minimum_dissipation", "outer"]
BOTH = ("centrifugal_force", "gyroscopic_moment")
VARIANTS: dict[str, dict[str, Any]] = {
    "both": {},
    "centrifugal alone": {"effects": BOTH[:1]},
    "gyroscopic alone": {"effects": BOTH[1:]},
    "harris": {"shares": qs.MomentShares.HARRIS},
    "friction coefficient": {"friction": 0.07},
    "moments free": {"held": (False,) * 5},
    "displaced orbits": {"orbit": qs.OrbitRadius.DISPLACED},
}
COUNT = 150


def radially_loaded(
    control: str,
    *,
    effects: tuple[str, ...] = BOTH,
    shares: qs.MomentShares = qs.MomentShares.CONTROLLING,
    friction: float | None = None,
    held: tuple[bool, ...] = (False, False, False, True, True),
    orbit: qs.OrbitRadius = qs.OrbitRadius.PITCH_CIRCLE,
) -> Group:
    """Bearings with up to five times the radial load that all balls carry, so that most have balls without load."""
    rng = np.random.default_rng(17)
    bearing, materials = realistic.draw_bearing(rng, COUNT)
    operation = realistic.draw_operation(rng, held, (True, False), bearing, materials)
    side = operation["axial_load_N"] / np.tan(np.radians(bearing["free_contact_angle_deg"]))
    operation |= {
        "axial_load_N": 0.1 * operation["axial_load_N"],
        "radial_load_y_N": 0.1 * side * rng.uniform(0.8, 5.0, COUNT),
        "outer_speed_rpm": np.zeros(COUNT),
    }
    return Group(
        qs.BearingKind.ANGULAR_CONTACT, effects, qs.RacewayControl(control),
        shares if "gyroscopic_moment" in effects else None, qs.HertzAngle.FREE, qs.HertzForm.EXACT,
        qs.TiltLever.GROOVE_CENTRE, held, bearing, materials, operation, orbit,
        {} if friction is None else {"effects": {"friction_coefficient": np.full(COUNT, friction)}},
    )  # fmt: skip


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("variant", VARIANTS)
def test_balls_go_round(control: str, variant: str) -> None:
    """All checks; what converges is a good part, and most of it with balls that have left the inner raceway."""
    scene = radially_loaded(control, **VARIANTS[variant]).scene()
    with np.errstate(all="ignore"):
        solution = qs.solve(scene)
        failed = findings(scene, solution).failed()
    assert [name for name, bad in failed.items() if (bad & solution.converged).any()] == []
    assert solution.converged.sum() > 0.15 * COUNT
    assert ((solution.inner.load == 0.0).any(axis=-1) & solution.converged).sum() > 0.05 * COUNT


@pytest.mark.parametrize("control", CONTROLS)
def test_balls_of_tandems_go_round(control: str) -> None:
    group = of_one_ball_count(radially_loaded(control).part(slice(0, 40)))
    scene = group.scene()
    bearing = replace(scene.bearing, ball_count=int(group.bearing["ball_count"][0]))
    apart = 0.5 * np.asarray(bearing.pitch_diameter, float)
    loads = {name: getattr(scene.operation, name) for name in ("speed", "axial_load", "radial_load_y")}
    operation = qs.Operation(**loads, radial_load_z=0.0, tilt_y=0.0, tilt_z=0.0)
    rows = (qs.Row(bearing, 0.0, "+x"), qs.Row(bearing, apart, "+x"))
    tandem = qs.BearingSet(rows, operation, ball_effects=scene.ball_effects, raceway_control=scene.raceway_control)
    with np.errstate(all="ignore"):
        solution = qs.solve_set(tandem)
        failed = [findings(row.scene, row).failed().items() for row in solution.rows]
    wrong = [name for row in failed for name, bad in row if (bad & solution.converged).any()]
    assert [name for name in wrong if name != "misplaced"] == []  # against the shaft
    assert solution.converged.sum() >= 10


@pytest.mark.parametrize("control", CONTROLS)
def test_balls_of_warm_bearings_go_round(control: str) -> None:
    """A steady state of heat, under a radial load that lifts balls."""
    loads = {"axial_load_N": 150.0, "radial_load_y_N": 700.0, "tilt_y_mrad": 0.0, "tilt_z_mrad": 0.0}
    effects = spindle.EFFECTS | {"raceway_control": control}
    given = spindle.scene(operation={"speed_rpm": 8000} | loads, effects=effects, preload=None)
    turning = replace(given.operation, speed=np.array([8000.0, 10_000.0]) * qs.rpm)
    solution = qs.solve(replace(given, operation=turning))
    assert solution.converged.all()
    assert (solution.inner.load == 0.0).any(axis=-1).all()
    assert not any(bad.any() for bad in standing_balls(solution.scene, solution).values())
