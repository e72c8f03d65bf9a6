"""Does the motion that qsbearing assumes or computes come out of Newton's and Euler's laws? One rigid ball between its
grooves, integrated in time with Hertz's forces and Coulomb's friction: no centrifugal force, gyroscopic moment or
raceway control is put in.

Where friction acts at points, the inner raceway has none and the ball begins with outer control's axis, size and sign
of the gyroscopic moment are proved: the outer contact alone can bear it. The control is not: points have no spin
moment, so that the axis stays where it starts. Friction over both ellipses finds the axis, from either start."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

import qsbearing as qs
from fem_check.independent.ball_runs import motion, run, settled
from fem_check.independent.ball_starts import begun, controlled
from fem_check.independent.contact_problem import Array
from fem_check.independent.free_ball import FreeBallCase, FreeBalls
from fem_check.independent.slip_friction import Coulomb, at_centre, over_ellipse
from fem_check.product.scenes import drawing_at_rest
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress
from fem_check.rows.row_text import scientific
from qsbearing.model.effects.raceway_control import HYPOTHESES
from qsbearing.model.effects.traction import Traction
from qsbearing.studies.chooser import by_friction

BOTH = (qs.CentrifugalForce(), qs.GyroscopicMoment())
DISPLACED: dict[str, Any] = {"ball_effects": BOTH, "orbit_radius": "displaced"}
"""Balls go round where they are pressed, as free ones do."""
POINTS = "Newton's and Euler's laws, friction at points of the outer raceway alone, from outer control's axis"
ELLIPSES = "Newton's and Euler's laws, friction over both ellipses, 6 x 16 points"
HYPOTHESIS, OTHER_FRICTION = "; raceway control: ", "; friction coefficient "
"""Begin the ends of cases in which the product assumes the balls' axes, or has other friction than the free balls."""
SLIP_SPEED = 0.02
"""[m/s] Nothing drives the balls: the creep below this speed slows them in proportion to it. It and twice as much,
extrapolated to none, leave its square."""
FRICTION, ELLIPSE_FRICTION, ELLIPSE_SLIP = 0.3, 0.07, 0.1
RUN = {MeshLevel.QUICK: (1e-3, 5e-7), MeshLevel.RELEASE: (2e-3, 2.5e-7)}
"""Duration and step of runs with points [s]: friction below the slip speed answers within 1e-6 s."""
DAMPING = 1000.0
"""[N s/m] Of contacts with friction at points: it ends the swing with which they begin."""
TOLERANCES = {
    MeshLevel.QUICK: {"angle": 0.002, "load": 1e-4, "orbital speed": 4e-6, "gyroscopic moment": 1e-3},
    MeshLevel.RELEASE: {"angle": 0.002, "load": 5e-5, "orbital speed": 4e-6, "gyroscopic moment": 1.4e-4},
}
"""Of angles in degrees, of the others over themselves: asked for beforehand, by what an earlier run of another code
left; at the quick level by its longer steps."""
WHY = "set beforehand: what damping, creep and steps left in another code; without the moment angles are 0.15° off"
SHARED = 22.40e-6, 0.01e-6
"""Displacement of B218's ring with friction at both points [m]: another code's, to its last digit."""
SETTLING, SETTLING_STEP = 0.15, 5e-6
"""Of friction over ellipses [s]: the slowest decay is by 90 1/s."""
FEW_POINTS = 0.05e-6, 2e-4
"""Of displacement [m] and orbit over the ring's speed: what 6 x 16 points and other few ones differ by."""


def scenes() -> dict[str, qs.Scene]:
    """Three bearings in which inertia turns the contact lines apart by 19 to 51 degrees."""
    b218 = qs.load_scene("b218").bearing
    turbine = qs.BallBearing(
        15, 20.64 * qs.mm, 154.5 * qs.mm, 0.54 * 20.64 * qs.mm, 0.52 * 20.64 * qs.mm, 24.0 * qs.deg
    )
    of = {
        "B218, 10000 rpm, 17800 N": (b218, 10_000.0, 17_800.0),
        "B218, 15000 rpm, 8000 N": (b218, 15_000.0, 8_000.0),
        "15 balls of 20.64 mm, 24°, 12000 rpm, 2224 N": (turbine, 12_000.0, 2_224.0),
    }
    return {
        name: qs.Scene(
            bearing, qs.Operation(rpm * qs.rpm, axial_load=load), raceway_control=qs.RacewayControl.OUTER, **DISPLACED
        )
        for name, (bearing, rpm, load) in of.items()
    }


def case_of(name: str, scene: qs.Scene) -> FreeBallCase:
    """One ball of a bearing under thrust."""
    speed, load, count = scene.operation.speed, scene.operation.axial_load, scene.bearing.ball_count
    thrust = float(np.asarray(load)) / float(np.asarray(count))
    return FreeBallCase(drawing_at_rest(scene, name), float(np.asarray(speed)), thrust)


def moment_rows(level: MeshLevel) -> Iterator[AgreementRow]:
    """The product under outer control against balls that no control holds."""
    by_name = scenes()
    cases = [case_of(name, scene) for name, scene in by_name.items()]
    balances = [controlled(case, "outer") for case in cases]
    slip_speed = np.repeat([SLIP_SPEED, 2.0 * SLIP_SPEED], len(cases))
    law = Coulomb(np.array([[0.0], [FRICTION]]), slip_speed)
    balls = FreeBalls(cases * 2, law, at_centre(), damping=DAMPING)
    duration, step = RUN[level]
    end = motion(balls, run(balls, begun(balls, balances * 2), duration, step=step, samples=2).states[-1])

    def still(values: Array) -> Array:
        return np.asarray(2.0 * values[..., : len(cases)] - values[..., len(cases) :])

    for number, (name, scene) in enumerate(by_name.items()):
        product, limits = qs.solve(scene), TOLERANCES[level]
        for race, angle, load in zip(("inner", "outer"), still(end.angle), still(end.load), strict=True):
            contacts = getattr(product, race)
            degrees = float(np.degrees(angle[number]))
            yield AgreementRow(
                name, f"{race} angle", "deg", degrees, POINTS, float(np.degrees(contacts.angle[0])), None,
                100.0 * limits["angle"] / abs(degrees), WHY,
            )  # fmt: skip
            yield AgreementRow(
                name, f"{race} load", "N", float(load[number]), POINTS, float(contacts.load[0]), None,
                100.0 * limits["load"], WHY,
            )  # fmt: skip
        assert product.orbital_speed is not None and product.gyroscopic_moment is not None
        for quantity, unit, reference, measured in (
            ("orbital speed", "rad/s", still(end.orbit)[number], product.orbital_speed[0]),
            ("gyroscopic moment", "N m", still(end.moment)[number], product.gyroscopic_moment[0]),
        ):
            yield AgreementRow(
                name, quantity, unit, float(reference), POINTS, float(measured), None, 100.0 * limits[quantity], WHY
            )


def share_rows() -> Iterator[AgreementRow]:
    """Friction at both points: how it divides the moment is no hypothesis."""
    name, scene = next(iter(scenes().items()))
    case = case_of(name, scene)
    balls = FreeBalls([case] * 2, Coulomb(np.array([[0.2], [0.2]]), np.array([0.1, 0.2])), at_centre())
    start = begun(balls, [controlled(case, "outer")] * 2)
    end = motion(balls, run(balls, start, 8e-3, step=2e-6, samples=2).states[-1])
    at = f"{name}: friction at both points"
    yield AgreementRow(
        at, "axial_displacement", "m", SHARED[0], "another code of Newton's and Euler's laws",
        float(2.0 * end.displacement[0] - end.displacement[1]), None, 100.0 * SHARED[1] / SHARED[0],
        "set beforehand: the last digit of the other code",
    )  # fmt: skip
    yield AgreementRow(
        at, "share of the inner raceway over Qi/(Qi + Qo)", "1", 1.0, "friction of one coefficient at both contacts",
        float(end.inner_share[0] * end.load[:, 0].sum() / end.load[0, 0]), None, 0.03,
        "set beforehand: creep, which divides otherwise, is 1e-3 of the slip speed",
    )  # fmt: skip


def balance_rows(progress: Progress) -> Iterator[AgreementRow]:
    """The product's balance of friction against what a ball comes to, from both axes."""
    name, of_control = next(iter(scenes().items()))
    law = Traction(ELLIPSE_FRICTION, ELLIPSE_SLIP)
    product = qs.solve(replace(of_control, raceway_control=qs.RacewayControl.FRICTION, traction=law))
    case = case_of(name, of_control)
    rubbing = Coulomb(np.full((2, 1), ELLIPSE_FRICTION), np.full(2, ELLIPSE_SLIP))
    balls = FreeBalls([case] * 2, rubbing, over_ellipse(6, 16))
    start = begun(balls, [controlled(case, control) for control in ("outer", "inner")])
    progress("friction over both ellipses", 0.0)
    end = settled(run(balls, start, SETTLING, step=SETTLING_STEP, samples=150))
    at = f"{name}: friction over both ellipses"
    spread = float(np.ptp(np.degrees(end.attitude)))
    yield AgreementRow(
        at, "apart, from the axes of outer and inner control", "deg", 0.0, ELLIPSES, spread, None, 100.0 * 0.002,
        "set beforehand: 20 degrees fall to 2e-5 of themselves",
    )  # fmt: skip
    speed = float(np.asarray(of_control.operation.speed))
    assert product.orbital_speed is not None
    for quantity, unit, reference, measured, within in (
        ("axial displacement", "m", end.displacement[0], product.displacement[0], FEW_POINTS[0]),
        ("orbital speed", "rad/s", end.orbit[0], product.orbital_speed[0], FEW_POINTS[1] * speed),
    ):
        yield AgreementRow(
            at, quantity, unit, float(reference), ELLIPSES, float(measured), None, 100.0 * within / float(reference),
            "set beforehand: what few points of an ellipse differ by",
        )  # fmt: skip
    assumed: dict[str, dict[str, Any]] = {
        f"{HYPOTHESIS}{each.replace('_', ' ')}": {"raceway_control": each} for each in HYPOTHESES
    }
    for mu in by_friction.USUAL:  # nobody knows the coefficient of a bearing nearer than that
        law = Traction(mu, ELLIPSE_SLIP)
        assumed[f"{OTHER_FRICTION}{mu:g}"] = {"raceway_control": qs.RacewayControl.FRICTION, "traction": law}
    for end_of_case, changes in assumed.items():
        yield AgreementRow(
            f"{at}{end_of_case}", "axial displacement", "m", float(end.displacement[0]), ELLIPSES,
            float(qs.solve(replace(of_control, **changes)).displacement[0]), None, None,
            f"a finding: what an assumption makes of it; the balls have a friction coefficient of {ELLIPSE_FRICTION:g}",
        )  # fmt: skip


def run_check(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """The moment at either level; how friction divides it and where it leads at the release level. It concerns no
    bearing that is named."""
    progress("friction at points", 0.0)
    rows = list(moment_rows(level))
    if level is MeshLevel.RELEASE:
        rows += [*share_rows(), *balance_rows(progress)]
    note = (
        "With friction at points of the outer raceway alone the moment is proved, and no control: such contacts have "
        "no spin moment, and the ball's axis stays where it starts."
    )
    return Findings(rows, solver="Runge-Kutta, fourth order", notes=[note])


def _in_words() -> str:
    quick, fine = (
        {name: scientific(value, 2).replace(".0e", "e") for name, value in TOLERANCES[level].items()}
        for level in (MeshLevel.QUICK, MeshLevel.RELEASE)
    )
    angle = TOLERANCES[MeshLevel.RELEASE]["angle"]
    return (
        f"angles {angle:g}°, loads {fine['load']}, orbital speed {fine['orbital speed']}, gyroscopic moment "
        f"{fine['gyroscopic moment']}; quick: loads {quick['load']}, moment {quick['gyroscopic moment']}"
    )


CHECK = Check(
    name="free_ball",
    question="Does the gyroscopic moment come out where a ball obeys Newton's and Euler's laws alone, and the motion "
    "that friction decides?",
    kind=CheckKind.VERIFICATION,
    reference="one rigid ball integrated in time, with Hertz's forces and Coulomb's friction; no centrifugal force, "
    "gyroscopic moment or raceway control is put in",
    tolerance=_in_words(),
    run=run_check,
    largest_dofs=lambda level: 0,
)
