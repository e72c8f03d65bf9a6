"""A solution's balls and ring against the equilibrium found from the drawing alone, without code of qsbearing."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

import qsbearing
from fem_check.independent import quasi_static
from fem_check.independent.contact_problem import Array
from fem_check.independent.equilibrium import BallRow, BallStates
from fem_check.independent.quasi_static import BalanceProblem, Equilibrium, NoReferenceError
from fem_check.rows.agreement import AgreementRow

TOLERANCE = 1e-9
"""Of equilibria: both sides work at full precision, and lose some digits in soft directions."""
STIFFNESS_TOLERANCE = 1e-6
"""Relative to its largest term, all in newtons per metre."""
SMALL_ANGLE = 0.1
"""Contact angles below it are judged as if they were this large [rad]."""
BALANCE_SOURCE = "equilibrium of balls and ring found from the drawing alone"


def equilibrium_rows(
    label: str,
    make: Callable[[], BalanceProblem],
    rows: Sequence[qsbearing.Solution],
    whole: qsbearing.Solution | qsbearing.SetSolution,
    displacement: Array,
) -> Iterator[AgreementRow]:
    """A solution against the equilibrium of the same problem that the reference finds.

    Args:
        make: makes the problem.
        rows: the solution of each row of balls.
        whole: the solution of all: of the shaft, or of the only row.
        displacement: of the shaft's channels that the solution tells.
    """
    try:
        problem = make()
        equilibrium = reference_near(problem, rows, displacement)
        stiffness = quasi_static.stiffness(equilibrium)
    except NoReferenceError as failed:
        why = f"{failed}: what is reported is not in equilibrium either"
        yield AgreementRow(label, "equilibria found", "1", 1.0, BALANCE_SOURCE, 0.0, None, 0.0, why)
        return
    lever, states = problem.lever, equilibrium.states
    forces = max(float(max(each.q_i.max(), each.q_o.max())) for each in states)
    approaches = max(float(max(np.abs(each.delta_i).max(), np.abs(each.delta_o).max())) for each in states)
    lengths = problem.scale[: len(displacement)]
    largest = float(np.abs(np.where(problem.held, 0.0, equilibrium.shaft)[: len(displacement)] * lengths).max())

    def row(
        quantity: str, unit: str, got: Any, expected: Any, scale: float, tolerance: float = TOLERANCE
    ) -> AgreementRow:
        return compared_arrays(label, quantity, unit, np.asarray(got), np.asarray(expected), scale, tolerance)

    moved = equilibrium.shaft[: len(displacement)] * lengths
    yield row("displacement, tilts at the groove centres", "m", displacement * lengths, moved, max(largest, approaches))
    load = equilibrium.load[:5] / problem.scale[:5]
    yield row("load, moments over the lever", "N", whole.load / problem.scale[:5], load, forces)
    if len(rows) > 1:
        each = [equilibrium.row_load(number) / problem.scale[:5] for number in range(len(rows))]
        yield row("load of each row", "N", [one.load / problem.scale[:5] for one in rows], each, forces)
    size = np.outer([1.0, 1.0, 1.0, lever, lever], [1.0, 1.0, 1.0, lever, lever])
    yield row(
        "stiffness, tilts at the lever", "N/m", whole.stiffness / size, stiffness / size,
        float(np.abs(stiffness / size).max()), STIFFNESS_TOLERANCE,
    )  # fmt: skip
    # Where a solution says that no controls are consistent, there must be none.
    consistent = all(each.control_is_consistent for each in rows) or quasi_static.settles(equilibrium)
    for placed, state, control, solution in zip(problem.rows, states, equilibrium.controls, rows, strict=True):
        yield from ball_rows(label, placed.row, state, control, solution)
        if consistent and control is not None and placed.row.model.control == "per_ball" and placed.row.turns:
            jones = placed.row.jones_control(state)
            yield row(
                "balls that follow Jones's criterion", "1", float(np.sum(control == jones)), float(len(jones)), 0.0
            )


def ball_rows(
    label: str, of: BallRow, state: BallStates, control: Array | None, solution: qsbearing.Solution
) -> Iterator[AgreementRow]:
    """The balls of one row."""

    def row(quantity: str, unit: str, got: Any, expected: Any, scale: float = 0.0) -> AgreementRow:
        return compared_arrays(label, quantity, unit, np.nan_to_num(np.asarray(got)), np.asarray(expected), scale)

    inner, outer = solution.inner, solution.outer
    yield row("contact load", "N", [inner.load, outer.load], [state.q_i, state.q_o])
    # A ball that touches nothing has no place while it stands still.
    placed = (state.q_i > 0.0) | (state.q_o > 0.0)
    pair = np.array([state.inner, state.outer])[:, placed]
    yield row(
        "contact angle",
        "rad",
        np.array([inner.angle, outer.angle])[:, placed],
        np.arctan2(*np.moveaxis(pair, 2, 0)),
        SMALL_ANGLE,
    )
    approach = np.array([state.delta_i, state.delta_o])[:, placed]
    yield row("approach and gap", "m", np.array([inner.approach, outer.approach])[:, placed], approach)
    if control is None:
        return
    yield row("orbital speed", "rad/s", solution.orbital_speed, state.orbit)
    sense = -np.sign(of.inner_speed - of.outer_speed)
    turned = [solution.axial_rotation, -np.asarray(solution.radial_rotation)]
    yield row("rotation, its axis", "rad/s", turned, state.rotation.T)
    yield row("rotation speed", "rad/s", solution.rotation_speed, sense * np.hypot(*state.rotation.T))
    if of.model.centrifugal:
        yield row("centrifugal force", "N", solution.centrifugal_force, state.centrifugal)
    if of.model.gyroscopic:
        rolled = np.where(placed, state.moment, 0.0)
        yield row("gyroscopic moment", "N m", -np.asarray(solution.gyroscopic_moment), rolled)
        both = (state.q_i > 0.0) & (state.q_o > 0.0)
        required = [state.required["inner"][both] / state.q_i[both], state.required["outer"][both] / state.q_o[both]]
        reported = [np.asarray(each.required_friction)[both] for each in (inner, outer)]
        yield row("required friction", "1", reported, required)


def compared_arrays(
    label: str,
    quantity: str,
    unit: str,
    computed: Array,
    expected: Array,
    scale: float = 0.0,
    tolerance: float = TOLERANCE,
) -> AgreementRow:
    """An array against its reference in one row: the largest of the reference, and that off by the worst deviation.

    Args:
        scale: at least this is the largest: of what the array is a small part of.
    """
    worst = float(np.abs(computed - expected).max(initial=0.0))
    size = max(float(np.abs(expected).max(initial=0.0)), scale)
    why = "two solutions at full precision; soft directions lose digits"
    if quantity.startswith("stiffness"):
        why = "differences of loads lose half the digits"
    return AgreementRow(label, quantity, unit, size, BALANCE_SOURCE, size + worst, None, 100.0 * tolerance, why)


def reference_near(problem: BalanceProblem, rows: Sequence[qsbearing.Solution], displacement: Array) -> Equilibrium:
    """The reference's equilibrium: found on its own way from rest, or, where there are others, from the solution.

    A start decides only which of several equilibria is found; none that is not one ends there.

    Raises:
        NoReferenceError: no equilibrium was found either way.
    """
    controls = [_control(placed.row, solution) for placed, solution in zip(problem.rows, rows, strict=True)]
    shaft = np.zeros(quasi_static.CHANNELS)
    shaft[: len(displacement)] = displacement
    own = None
    try:
        own = quasi_static.at_speed(problem, controls)
        apart = float(np.abs((own.shaft - shaft) * problem.scale).max())
        if apart <= TOLERANCE * max(float(np.abs(shaft * problem.scale).max()), 1e-9):
            return own
    except NoReferenceError:
        pass
    positions = []
    for placed, solution in zip(problem.rows, rows, strict=True):
        at, length = solution.outer, placed.row.lengths[1]
        place = (length + at.approach) * np.array([at.sine, at.cosine])
        positions.append(np.where(np.isfinite(place), place, 0.5 * placed.row.groove_centres(placed.moved(shaft)).T).T)
    try:
        return quasi_static.solve(problem, (shaft, positions), controls)
    except NoReferenceError:
        if own is None:
            raise
        return own


def _control(row: BallRow, solution: qsbearing.Solution) -> Array | None:
    """Of each ball. Which one a ball follows under Jones's criterion is judged beside."""
    return None if row.model.control is None else np.asarray(solution.raceway_control)
