"""A certificate is given where a bearing has no equilibrium, and nowhere else: each kind, given and withheld."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.qsbearing.scenes import B218, BOTH, INNER, OUTER, resting, turning
from tests.verification.campaign.certificates import (
    NONE,
    PROOFS,
    certify,
    forces_of_balls,
    null_motion,
    restrictions_broken,
    supports_nothing,
    unsupported_direction,
)
from tests.verification.campaign.checks import findings
from tests.verification.campaign.envelope import chunk_groups
from tests.verification.campaign.group import DISPLACEMENT_KEYS, LOAD_KEYS, MATERIAL_KEYS, STEEL, Group

compiled_only = pytest.mark.skipif(not has_fast_code(), reason="a thousand iterations take minutes in plain Python")

B218_KEYS = {
    "ball_count": 16.0,
    "ball_diameter_mm": 22.225,
    "pitch_diameter_mm": 125.26,
    "inner_groove_radius_mm": 11.6281,
    "outer_groove_radius_mm": 11.6281,
    "free_contact_angle_deg": 40.0,
}
STATIC: dict[str, Any] = {"effects": ()}
INNER_CONTROL = {"control": INNER}
ONLY_GYROSCOPIC = {"effects": ("gyroscopic_moment",), "shares": qs.MomentShares.HARRIS}
ONE_BALL = {"ball_count": 1.0, "kind": qs.BearingKind.DEEP_GROOVE}

# With all channels held every ball is for itself, and where it lies is seen from the displacement alone.
HELD = {**dict.fromkeys(DISPLACEMENT_KEYS[1:], 0.0), "first_ball_azimuth_deg": 0.0}
OPEN_SIDE = HELD | {"axial_displacement_um": -700.0, "radial_displacement_y_um": 300.0}
"""The inner groove's centre is drawn back behind the outer one's, and the first balls are pressed behind it."""
OVER_SHOULDER = HELD | {
    "free_contact_angle_deg": 75.0,
    "axial_displacement_um": 40.0,
    "radial_displacement_y_um": -300.0,
}
"""The inner groove's centre lies radially inside the outer one's where the first ball is."""
LOST = HELD | {"axial_displacement_um": -232.0}
"""At speed all balls lie on the outer raceway, and have only just lost the inner one."""
FAST = {"axial_load_N": 2e3}
"""At 9600 rpm friction alone would carry more than this thrust."""
SLIPPING = FAST | {"radial_load_y_N": 100.0}
"""At 9600 rpm the balls' gyroscopic moment asks the inner raceway for more friction than load."""
UNPRESSED = {
    "free_contact_angle_deg": 10.5,
    "axial_load_N": 100.0,
    "radial_displacement_y_um": 0.0,
    "radial_displacement_z_um": 0.0,
    "moment_y_Nm": 5.0,
}
"""A moment that leaves balls without load; where both raceways share the gyroscopic moment, the outer one, which no
centrifugal force presses, is asked for friction."""


def one_scene(
    effects: tuple[str, ...] = ("centrifugal_force", "gyroscopic_moment"),
    control: qs.RacewayControl = OUTER,
    hertz_angle: qs.HertzAngle = qs.HertzAngle.FREE,
    kind: qs.BearingKind = qs.BearingKind.ANGULAR_CONTACT,
    shares: qs.MomentShares = qs.MomentShares.CONTROLLING,
    **values: float,
) -> Group:
    """A B218 of steel, or what differs from it, by the keys of a scene file."""
    held = tuple(key in values for key in DISPLACEMENT_KEYS)
    channels = [
        pair[is_held] for pair, is_held in zip(zip(LOAD_KEYS, DISPLACEMENT_KEYS, strict=True), held, strict=True)
    ]
    keys = ("speed_rpm", "outer_speed_rpm", *channels, "first_ball_azimuth_deg")

    def arrays(table: dict[str, float]) -> dict[str, Any]:
        return {key: np.array([value]) for key, value in table.items()}

    steel = arrays(dict(zip(MATERIAL_KEYS, STEEL, strict=True)))
    return Group(
        kind,
        effects,
        control if effects else None,
        shares if "gyroscopic_moment" in effects else None,
        hertz_angle,
        qs.HertzForm.EXACT,
        qs.TiltLever.GROOVE_CENTRE,
        held,
        arrays({key: values.get(key, value) for key, value in B218_KEYS.items()}),
        {"ball_material": steel, "ring_material": steel},
        arrays({key: values.get(key, 0.0) for key in keys}),
    )


def kind_of(group: Group, solution: qs.Solution) -> str:
    """Of the certificate of the only case."""
    return certify(group, solution, np.array([0]))[0].kind


def refused(**values: Any) -> tuple[Group, qs.Solution]:
    """A scene that must be refused, and what it ended as."""
    group = one_scene(**values)
    solution = qs.solve(group.scene())
    assert solution.status == [qs.Status.NO_EQUILIBRIUM]
    return group, solution


@pytest.mark.parametrize(
    ("values", "kind"),
    [
        ({"axial_load_N": -5e3, "speed_rpm": 1000.0}, "unsupported direction"),
        (STATIC | ONE_BALL | {"moment_y_Nm": 3.0}, "null motion"),
        (STATIC | OPEN_SIDE, "open side, unique equilibrium"),
        (STATIC | OPEN_SIDE | {"hertz_angle": qs.HertzAngle.ACTUAL}, "open side, an equilibrium"),
        (OPEN_SIDE | {"speed_rpm": 2000.0}, "open side, an equilibrium"),
        (STATIC | OVER_SHOULDER, "over the shoulder, an equilibrium"),
        (OVER_SHOULDER | {"speed_rpm": 2000.0}, "over the shoulder, an equilibrium"),
        pytest.param(
            INNER_CONTROL | SLIPPING | {"speed_rpm": 9600.0},
            "friction above the load, an equilibrium",
            marks=compiled_only,
        ),
        pytest.param(INNER_CONTROL | FAST | {"speed_rpm": 9600.0}, "friction above the thrust", marks=compiled_only),
        pytest.param(
            INNER_CONTROL | UNPRESSED | ONLY_GYROSCOPIC | {"speed_rpm": 6000.0},
            "friction without load, an equilibrium",
            marks=compiled_only,
        ),
    ],
)
def test_each_kind_where_it_is_right(values: dict[str, Any], kind: str) -> None:
    group, solution = refused(**values)
    assert kind_of(group, solution) == kind
    assert (kind in PROOFS) == (kind in ("unsupported direction", "null motion", "open side, unique equilibrium"))


@compiled_only
@pytest.mark.parametrize(
    ("chunk", "index", "kind"),
    [
        (60, 61, "over the shoulder, under more thrust"),
        (8, 27, "friction above the thrust"),
        (96, 825, "friction above the thrust"),
    ],
)
def test_a_falling_thrust_tells_what_ends_the_equilibria(chunk: int, index: int, kind: str) -> None:
    """Scenes of the campaign on file: of grooves far wider than the ball, and of soft balls."""
    for group in chunk_groups(1, chunk):
        count = group.operation["speed_rpm"].size
        if index < count:
            break
        index -= count
    alone = group.part([index])
    assert kind_of(alone, qs.solve(alone.scene())) == kind
    more = replace(alone, operation=alone.operation | {"axial_load_N": 1e5 * alone.operation["axial_load_N"]})
    assert qs.solve(more.scene()).converged.all()


RESTRICTED = {
    "open side": OPEN_SIDE | {"speed_rpm": 2000.0},
    "over the shoulder": OVER_SHOULDER | {"speed_rpm": 2000.0},
    "friction above the load": INNER_CONTROL | SLIPPING | {"speed_rpm": 9600.0},
}


@compiled_only
@pytest.mark.parametrize("kind", RESTRICTED)
def test_evidence_is_an_equilibrium_at_the_part_of_the_speed_that_is_told(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The state left at half of twice the speed is evidence; the same state at any other part is none."""
    values = RESTRICTED[kind]
    _, solution = refused(**values)
    twice = one_scene(**values | {"speed_rpm": 2.0 * values["speed_rpm"]})
    for part, given in ((0.5, f"{kind}, at part of the speed"), (0.7, NONE), (1.0, NONE)):
        monkeypatch.setattr(qs.Solution, "speed_reached", property(lambda _, part=part: np.array([part])))
        assert kind_of(twice, solution) == given


def test_balls_that_lost_the_inner_raceway_are_solved_under_its_control() -> None:
    """Before, friction on an inner contact without load refused them; they are carried round at the outer raceway."""
    solution = qs.solve(one_scene(**INNER_CONTROL | LOST | {"speed_rpm": 5000.0}).scene())
    assert solution.converged.all()
    assert (solution.inner.load == 0.0).all()
    assert solution.outer.load == pytest.approx(solution.centrifugal_force, rel=1e-9)
    assert (solution.raceway_control == qs.RacewayControl.OUTER).all()


@compiled_only
@pytest.mark.parametrize("values", [*RESTRICTED.values(), STATIC | OPEN_SIDE, STATIC | OVER_SHOULDER])
def test_no_evidence_without_equilibrium(values: dict[str, Any]) -> None:
    """The state that was left, held against loads or displacements that it does not belong to."""
    _, solution = refused(**values)
    for key in ("axial_load_N", "axial_displacement_um"):
        if key in values:
            assert kind_of(one_scene(**values | {key: values[key] * (1.0 + 1e-6)}), solution) == NONE


@pytest.mark.parametrize(
    "values",
    [
        OPEN_SIDE | {"kind": qs.BearingKind.DEEP_GROOVE, "speed_rpm": 2000.0},
        STATIC | OPEN_SIDE | {"kind": qs.BearingKind.DEEP_GROOVE},
        LOST | {"speed_rpm": 5000.0},
        INNER_CONTROL | LOST | {"speed_rpm": 5000.0, "effects": ("centrifugal_force",)},
        INNER_CONTROL | SLIPPING | {"speed_rpm": 3000.0},
        # In equilibrium with friction beyond the load, which the equations as they stand do not forbid.
        INNER_CONTROL | {"axial_load_N": 200.0, "speed_rpm": 6000.0, "effects": ("gyroscopic_moment",)},
    ],
)
def test_no_certificate_where_nothing_is_broken(values: dict[str, Any]) -> None:
    """One condition less than above, and there is an equilibrium, and nothing against it."""
    group = one_scene(**values)
    solution = qs.solve(group.scene())
    assert solution.converged.all()
    assert kind_of(group, solution) == NONE
    assert not any(broken.any() for broken in restrictions_broken(group, solution).values())


def test_no_certificate_for_what_has_an_equilibrium() -> None:
    """Every scene of a chunk that is solved: nothing proves that it cannot be."""
    for group in chunk_groups(8, 0)[:: 8 if has_fast_code() else 39]:
        solution = qs.solve(group.scene(), threads=1)
        good = ~np.any(list(findings(group.scene(), solution).failed().values()), axis=0) & solution.converged
        for k in np.flatnonzero(good):
            assert unsupported_direction(group.part(int(k)).scene()) is None
            assert null_motion(group.part(int(k)).scene()) is None
        broken = restrictions_broken(group, solution)
        for name in ("open_side", "over_shoulder", "friction_without_load"):
            assert not (broken[name] & good).any(), name


def test_a_reversed_thrust_is_unsupported_along_the_axis() -> None:
    """The only direction: the ring moves back along x, and no ball is pressed."""
    direction = unsupported_direction(resting(axial_load=-5e3))
    assert direction == pytest.approx([-1.0, 0.0, 0.0, 0.0, 0.0], abs=1e-12)


def test_a_moment_beyond_the_thrust_has_a_direction_that_is_checked() -> None:
    """Thrust needs its line of action within the ball circle: a moment beyond that tilts the ring off."""
    radius = float(B218.inner_groove_centre_radius)
    for factor, found in ((0.9, False), (1.1, True)):
        scene = resting(axial_load=1e3, moment_z=factor * 1e3 * radius)
        direction = unsupported_direction(scene)
        assert (direction is not None) == found
        if direction is not None:
            forces = direction @ forces_of_balls(scene, 0.0)
            assert forces == pytest.approx(np.minimum(forces, 0.0), abs=1e-12)
            assert supports_nothing(scene, direction)
            assert not supports_nothing(scene, -direction)


def test_friction_on_the_ring_forbids_the_proof() -> None:
    """Under inner control friction, too, acts on the ring: the cone of normal loads proves nothing."""
    assert unsupported_direction(turning(3000, control=INNER, effects=BOTH, axial_load=-5e3)) is None
    assert unsupported_direction(turning(0, control=INNER, effects=BOTH, axial_load=-5e3)) is not None
    assert unsupported_direction(turning(3000, control=OUTER, effects=BOTH, axial_load=-5e3)) is not None


def test_a_ring_on_one_ball_moves_without_end() -> None:
    one = replace(B218, ball_count=1, kind=qs.BearingKind.DEEP_GROOVE)
    assert null_motion(resting(one, moment_y=3.0)) is not None
    assert null_motion(resting(replace(one, ball_count=3), axial_load=5.0, moment_y=3.0)) is None
    held = {"radial_displacement_y": 0.0, "radial_displacement_z": 0.0, "tilt_y": 0.0, "tilt_z": 0.0}
    assert null_motion(resting(one, axial_load=5.0, **held)) is None
