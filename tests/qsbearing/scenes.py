"""Bearings and scenes that several tests share: SI units inside, speeds in revolutions per minute at the call."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code

B218 = qs.BallBearing(
    ball_count=16,
    ball_diameter=22.225 * qs.mm,
    pitch_diameter=125.26 * qs.mm,
    inner_groove_radius=11.6281 * qs.mm,
    outer_groove_radius=11.6281 * qs.mm,
    free_contact_angle=40 * qs.deg,
    name="B218",
)
"""The worked example of the literature; groove radii and pitch diameter of Wang et al., angle of Harris & Kotzalas."""

SPINDLE = qs.BallBearing(
    ball_count=20,
    ball_diameter=12.7 * qs.mm,
    pitch_diameter=89.5 * qs.mm,
    inner_groove_radius=6.731 * qs.mm,
    outer_groove_radius=6.604 * qs.mm,
    free_contact_angle=15 * qs.deg,
    ball_material=qs.SILICON_NITRIDE,
    name="hybrid spindle bearing",
)
"""Small angle, ceramic balls, grooves that differ."""

DEEP_GROOVE = qs.BallBearing(
    ball_count=7,
    ball_diameter=11.5 * qs.mm,
    pitch_diameter=43.5 * qs.mm,
    inner_groove_radius=0.52 * 11.5 * qs.mm,
    outer_groove_radius=0.53 * 11.5 * qs.mm,
    free_contact_angle=0.0,
    ball_material=qs.Material(210 * qs.GPa, 0.3, 7800.0),
    ring_material=qs.Material(210 * qs.GPa, 0.3, 7800.0),
    kind=qs.BearingKind.DEEP_GROOVE,
    name="seven-ball deep-groove bearing",
)
"""The bearing of a published set of ISO/TS 16281 results, without clearance."""

QJ = qs.BallBearing.from_axial_clearance(
    axial_clearance=120 * qs.um,
    ball_count=16,
    ball_diameter=22.225 * qs.mm,
    pitch_diameter=125.26 * qs.mm,
    inner_groove_radius=0.52 * 22.225 * qs.mm,
    outer_groove_radius=0.52 * 22.225 * qs.mm,
    free_contact_angle=35 * qs.deg,
    name="QJ",
)
"""A four-point bearing of B218's balls, both rings arched."""

CENTRIFUGAL = (qs.CentrifugalForce(),)
BOTH = (qs.CentrifugalForce(), qs.GyroscopicMoment())
BOTH_HARRIS = (qs.CentrifugalForce(), qs.GyroscopicMoment(qs.MomentShares.HARRIS))

OUTER, INNER, PER_BALL = qs.RacewayControl.OUTER, qs.RacewayControl.INNER, qs.RacewayControl.PER_BALL
MINIMUM_DISSIPATION = qs.RacewayControl.MINIMUM_DISSIPATION

UPRIGHT = {"tilt_y": 0.0, "tilt_z": 0.0}
"""A shaft so stiff that it holds both tilts at nothing."""

LOADS = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
DISPLACEMENTS = ("axial_displacement", "radial_displacement_y", "radial_displacement_z", "tilt_y", "tilt_z")


def resting(bearing: qs.BallBearing = B218, *, hertz_angle: str = "free", **operation: Any) -> qs.Scene:
    """A static scene: no ball effect, no kinematics."""
    return qs.Scene(bearing, qs.Operation(**operation), hertz_angle=qs.HertzAngle(hertz_angle))


def rubbing(
    rpm: ArrayLike, bearing: qs.BallBearing = QJ, traction: qs.Traction | None = None, **operation: Any
) -> qs.Scene:
    """With balls that friction moves."""
    given = qs.Operation(speed=np.asarray(rpm, float)[()] * qs.rpm, **operation)
    return qs.Scene(bearing, given, BOTH, "friction", traction=traction)  # type: ignore[arg-type]


def turning(
    rpm: ArrayLike,
    bearing: qs.BallBearing = B218,
    *,
    outer_rpm: ArrayLike = 0.0,
    effects: Iterable[Any] = BOTH,
    control: qs.RacewayControl = OUTER,
    hertz_angle: str = "free",
    **operation: Any,
) -> qs.Scene:
    """A scene at speed: both ball effects under outer-raceway control unless told otherwise."""
    speeds = {"speed": np.asarray(rpm, float) * qs.rpm, "outer_speed": np.asarray(outer_rpm, float) * qs.rpm}
    return qs.Scene(
        bearing,
        qs.Operation(**{name: value if value.shape else float(value) for name, value in speeds.items()}, **operation),
        tuple(effects),
        control,
        hertz_angle=qs.HertzAngle(hertz_angle),
    )


def general_scenes() -> dict[str, qs.Scene]:
    """Scenes without symmetry, one for every way in which the equations differ; all have a solution."""
    five = {"axial_load": 12e3, "radial_load_y": 3e3, "radial_load_z": -1.5e3, "moment_y": 40.0, "moment_z": -60.0}
    inner = {"axial_load": 14e3, "radial_load_y": 2.5e3, "radial_load_z": 1e3, "moment_y": 25.0, "moment_z": -80.0}
    spindle = {"axial_load": 1.5e3, "radial_load_y": 200.0, "radial_load_z": 150.0, "moment_y": 2.0, "moment_z": -3.0}
    unloading = {"axial_load": 9e3, "radial_load_y": 5e3, "radial_load_z": -2.5e3, "moment_y": 60.0, "moment_z": -90.0}
    groove = {"axial_load": 150.0, "radial_load_y": 400.0, "radial_load_z": 100.0, "moment_y": 3.0, "moment_z": -8.0}
    preload = {
        "axial_displacement": 20e-6,
        "radial_load_y": 5e3,
        "radial_load_z": 700.0,
        "moment_y": 0.0,
        "tilt_z": 2e-4,
    }
    return {
        "at rest": resting(**five),
        "at rest, actual angle, unloading": resting(hertz_angle="actual", **unloading),
        "outer control": turning(8000, **five),
        "outer control, actual angle": turning(8000, hertz_angle="actual", **five),
        "centrifugal force alone": turning(9000, effects=CENTRIFUGAL, **five),
        "gyroscopic moment alone": turning(7000, effects=(qs.GyroscopicMoment(),), **five),
        "inner control, own share": turning(5000, control=INNER, **inner),
        "inner control, halved share": turning(5000, control=INNER, effects=BOTH_HARRIS, **inner),
        "control by each ball": turning(
            2600, control=PER_BALL, axial_load=20e3, radial_load_y=9e3, radial_load_z=2e3, moment_y=0.0, moment_z=-250.0
        ),
        "outer ring turning": turning(0, outer_rpm=6000, **five),
        "counter-rotation": turning(7000, outer_rpm=-4000, **five),
        "hybrid spindle": turning(24000, SPINDLE, **spindle),
        "deep groove, both signs of angle": turning(15000, DEEP_GROOVE, **groove),
        "rigid preload": turning(6000, **preload),
        "other lever": replace(turning(8000, **five), tilt_lever=qs.TiltLever.PITCH_CIRCLE),
        "other form": replace(turning(8000, **five), hertz_form=qs.HertzForm.HAMROCK_BREWE_1983),
    }


def grown_scenes() -> dict[str, qs.Scene]:
    """Scenes whose rings and balls have grown: with clearance left, and with the balls wedged between the rings."""
    hot = 60.0 + qs.zero_celsius
    rings = qs.RingExpansion(90 * qs.mm, 160 * qs.mm, shaft_interference=25 * qs.um, inner_ring_temperature=hot)
    loads = {"axial_load": 9e3, "radial_load_y": 3e3, "radial_load_z": 500.0, "moment_y": 20.0, "moment_z": -30.0}
    narrow = replace(DEEP_GROOVE, ball_material=qs.STEEL, ring_material=qs.STEEL)
    tight = qs.RingExpansion(25 * qs.mm, 62 * qs.mm, inner_ring_temperature=hot)
    light = {"axial_load": 150.0, "radial_load_y": 400.0, "radial_load_z": 100.0, "moment_y": 3.0, "moment_z": -8.0}
    return {
        "grown rings and balls": replace(turning(9000, **loads), ring_effects=(rings, qs.BallExpansion(hot))),
        "rigid preload in grown rings": replace(
            turning(9000, radial_load_y=2e3, radial_load_z=0.0, moment_y=0.0, moment_z=0.0),
            ring_effects=(rings,),
            preload=qs.Preload(rigid=2e3),
        ),
        "wedged": replace(turning(12000, narrow, **light), ring_effects=(tight,)),
        "wedged, at rest": replace(resting(narrow, hertz_angle="actual", **light), ring_effects=(tight,)),
    }


def unequal_balls(bearing: qs.BallBearing = B218, spread: float = 2e-6) -> qs.BallDiameterDeviations:
    """Deviations up to this size, without a pattern."""
    return qs.BallDiameterDeviations(spread * np.sin(7.0 * np.arange(int(np.asarray(bearing.ball_count))) ** 1.5 + 0.3))


def unequal_scenes() -> dict[str, qs.Scene]:
    """Scenes whose balls differ, one for every way in which the equations do."""
    five = {"axial_load": 12e3, "radial_load_y": 3e3, "radial_load_z": -1.5e3, "moment_y": 40.0, "moment_z": -60.0}
    groove = {"axial_load": 150.0, "radial_load_y": 400.0, "radial_load_z": 100.0, "moment_y": 3.0, "moment_z": -8.0}
    hot = 60.0 + qs.zero_celsius
    balls = (unequal_balls(),)
    return {
        "unequal balls at rest": replace(resting(**five), ring_effects=balls),
        "unequal balls under thrust": replace(turning(8000, axial_load=12e3), ring_effects=balls),
        "unequal balls, actual angle": replace(turning(8000, hertz_angle="actual", **five), ring_effects=balls),
        "unequal balls, inner control": replace(
            turning(5000, control=INNER, effects=BOTH_HARRIS, **five), ring_effects=balls
        ),
        "unequal balls, hot": replace(turning(8000, **five), ring_effects=(*balls, qs.BallExpansion(hot))),
        "unequal balls without clearance": replace(
            turning(15000, DEEP_GROOVE, **groove), ring_effects=(unequal_balls(DEEP_GROOVE),)
        ),
        "unequal balls, rigid preload": replace(
            turning(6000, radial_load_y=2e3, radial_load_z=0.0, moment_y=0.0, moment_z=0.0),
            ring_effects=balls,
            preload=qs.Preload(rigid=2e3),
        ),
    }


def lobes(size: float = 1e-6) -> qs.SeatsOutOfRound:
    """Two and three lobes of both rings, none of which points at another's crest."""
    return qs.SeatsOutOfRound(
        inner_two_lobe_amplitude=0.8 * size,
        inner_two_lobe_phase=0.4,
        inner_three_lobe_amplitude=0.5 * size,
        inner_three_lobe_phase=-1.2,
        outer_two_lobe_amplitude=1.7 * size,
        outer_two_lobe_phase=1.8,
        outer_three_lobe_amplitude=1.1 * size,
        outer_three_lobe_phase=0.7,
    )


def lobed_scenes() -> dict[str, qs.Scene]:
    """Scenes with seats out of round, one for every way in which the equations do."""
    five = {"axial_load": 12e3, "radial_load_y": 3e3, "radial_load_z": -1.5e3, "moment_y": 40.0, "moment_z": -60.0}
    groove = {"axial_load": 150.0, "radial_load_y": 400.0, "radial_load_z": 100.0, "moment_y": 3.0, "moment_z": -8.0}
    hot = 60.0 + qs.zero_celsius
    seats = (lobes(),)
    rings = qs.RingExpansion(90 * qs.mm, 160 * qs.mm, shaft_interference=25 * qs.um, inner_ring_temperature=hot)
    return {
        "lobes at rest": replace(resting(**five), ring_effects=seats),
        "lobes under thrust": replace(turning(8000, axial_load=12e3), ring_effects=seats),
        "lobes, actual angle": replace(turning(8000, hertz_angle="actual", **five), ring_effects=seats),
        "lobes, inner control": replace(turning(5000, control=INNER, effects=BOTH_HARRIS, **five), ring_effects=seats),
        "lobes, unequal balls, hot": replace(
            turning(8000, **five), ring_effects=(*seats, unequal_balls(), qs.BallExpansion(hot))
        ),
        "lobes without clearance": replace(turning(15000, DEEP_GROOVE, **groove), ring_effects=seats),
        "lobes, grown rings, rigid preload": replace(
            turning(6000, radial_load_y=2e3, radial_load_z=0.0, moment_y=0.0, moment_z=0.0),
            ring_effects=(rings, *seats),
            preload=qs.Preload(mounted=2e3),
        ),
    }


def names_of(scenes: dict[str, qs.Scene], *, but: Iterable[str] = ()) -> list[str]:
    """Names to parametrise over."""
    return [name for name in scenes if name not in set(but)]


def with_operation(scene: qs.Scene, **changes: Any) -> qs.Scene:
    """The scene with some fields of its operation changed."""
    return replace(scene, operation=replace(scene.operation, **changes))


def loaded_as(scene: qs.Scene, load: ArrayLike) -> qs.Scene:
    """The scene with all five channels loaded; load (*cases, 5)."""
    array = np.asarray(load, float)
    channels = {name: array[..., i] if array.ndim > 1 else float(array[i]) for i, name in enumerate(LOADS)}
    return with_operation(replace(scene, preload=None), **channels, **dict.fromkeys(DISPLACEMENTS))


def held_at(scene: qs.Scene, displacement: ArrayLike) -> qs.Scene:
    """The scene with all five channels held; displacement (*cases, 5)."""
    array = np.asarray(displacement, float)
    channels = {name: array[..., i] if array.ndim > 1 else float(array[i]) for i, name in enumerate(DISPLACEMENTS)}
    return with_operation(replace(scene, preload=None), **channels, **dict.fromkeys(LOADS))


def solved(scene: qs.Scene, **options: Any) -> qs.Solution:
    """The solution, all of whose cases must have converged."""
    solution = qs.solve(scene, **options)
    assert np.all(solution.converged), (solution.status, solution.iterations, solution.residual)
    return solution


def lever(scene: qs.Scene) -> float:
    """The radius at which axial forces make moments."""
    if scene.tilt_lever is qs.TiltLever.PITCH_CIRCLE:
        return 0.5 * float(np.asarray(scene.operating_bearing.pitch_diameter))
    return float(scene.operating_bearing.inner_groove_centre_radius)


def moment_shares(scene: qs.Scene, control: NDArray) -> tuple[NDArray, NDArray]:
    """(lambda_i, lambda_o) of every ball, by its control."""
    effect = scene.gyroscopic_moment
    inner = np.asarray(control) == "inner"
    own = 1.0 if effect is not None and effect.moment_shares is qs.MomentShares.HARRIS else 2.0
    return np.where(inner, own, 0.0), np.where(inner, 2.0 - own, 2.0)


def fewer(compiled: int, plain: int) -> int:
    """A number of cases: the first with the compiled kernel, the second when it runs as plain Python."""
    return compiled if has_fast_code() else plain
