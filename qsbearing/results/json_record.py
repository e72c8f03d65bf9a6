"""A solved case as plain data in the field's units: the object that `run --json` prints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.operation import CHANNELS
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.groups import GROUPS, OF_AZIMUTH, OF_PRELOAD, RING, channels
from qsbearing.model.solution.result_keys import BALL, STIFFNESS, Result, value_at
from qsbearing.model.solution.rounding import least_force, matrix_without_rounding, rounding_of
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.status import Status
from qsbearing.model.solution.traction_groups import TRACTION
from qsbearing.model.units import um, zero_celsius
from qsbearing.model.version import __version__
from qsbearing.remarks.of_solution import message
from qsbearing.remarks.remark import Remark
from qsbearing.results.group_numbers import numbers_of, numbers_or_none
from qsbearing.results.readings_record import Readings, number, readings_record, within
from qsbearing.results.record_type import Record
from qsbearing.results.remarks import every_remark, remarks_record

DISPLACEMENT_NOISE = 1e-15
"""Of displacements [m, rad]: a hundred-thousandth of an atom."""

if TYPE_CHECKING:
    from qsbearing.systems.heat.network import Thermal
    from qsbearing.systems.sets.set_solution import SetSolution


def record(
    solution: Solution,
    readings: Readings,
    index: CasePlace = (),
    thermal_of: Thermal | None = None,
    said: Sequence[Remark] | None = None,
) -> Record:
    """One case as the object that `run --json` prints.

    Args:
        readings: what the scene asked to be read off.
        index: the case, along the solution's case axes; nothing for a single case.
        thermal_of: of a row, the set's heat balance, which has found its temperatures.
        said: the case's remarks, where they are known already.

    Returns:
        None stands for a number that there is not: not called for by the scene, not solved, or not defined.
    """
    scene = solution.scene
    said = every_remark(solution, readings, index) if said is None else said
    solved = bool(np.asarray(solution.converged)[index])
    return {
        **how_it_ended(solution, index),
        "bearing": scene.bearing.name,
        "effects": [effect.name for effect in (*scene.ring_effects, *scene.ball_effects)],
        "choices": choices(scene),
        **remarks_record(said),
        "preload": preload(solution, index),
        **{name: table_of(name, solution, index) for name in TABLES},
        "elastic_rings": elastic_rings(solution, index),
        "temperatures": temperatures(solution, index, thermal_of),
        "thermal": thermal(solution, index),
        **motion_and_stiffness(solution, _load_noise(solution, index), index),
        **_at_top(solution, index),
        "balls": balls(solution, index) if solved else [],
        **traction_record(solution, index),
        "readings": readings_record(solution, readings, index) if solved else None,
        **choice_record(solution, index),
    }


BESIDE_OTHERS = ("preload", "elastic_rings", "temperatures", "thermal", TRACTION)
"""Tables with more in them than numbers of results."""
TABLES = dict.fromkeys(
    each.table[0] for each in GROUPS if each.table and not each.axis and each.before != RING
    and each.table[0] not in BESIDE_OTHERS
)  # fmt: skip
"""All others, but those of the channels of the ring."""


def _at_top(solution: Solution, index: CasePlace) -> Record:
    """Numbers outside tables; None for what the scene does not call for."""
    numbers = (numbers_or_none(group, solution, index) for group in GROUPS if group.table == ())
    return {key: value for each in numbers for key, value in each.items()}


def how_it_ended(solution: Solution | SetSolution, index: CasePlace = ()) -> Record:
    """Of a case of a bearing or set."""
    return {
        "version": __version__,
        "status": str(np.asarray(solution.status)[index]),
        "message": message(solution, index),
        "residual": number(np.asarray(solution.residual)[index]),
        "iterations": None if is_untried(solution, index) else int(np.asarray(solution.iterations)[index]),
        "seconds": solution.seconds,
    }


def is_untried(solution: Solution | SetSolution, index: CasePlace) -> bool:
    """Whether a case is a row's that nobody has solved, since its set has no solution."""
    has_not_begun = np.asarray(solution.iterations)[index] == 0
    return bool(has_not_begun and np.asarray(solution.status)[index] == Status.NOT_CONVERGED)


CHANNEL_UNITS = {
    "order": [channel.label.replace(" ", "_") for channel in CHANNELS],
    "displacement_SI": ["rad" if channel.is_rotation else "m" for channel in CHANNELS],
    "load_SI": ["N m" if channel.is_rotation else "N" for channel in CHANNELS],
}
"""Of `stiffness_SI`, a load (row) per displacement (column), and of `compliance_SI`, the other way round."""


def motion_and_stiffness(solution: Solution | SetSolution, noise: NDArray, index: CasePlace = ()) -> Record:
    """Of the ring, or of a set's shaft; what is rounding is zero.

    Args:
        noise: loads of each channel up to which they are rounding [N, N m].
    """
    solved = bool(np.asarray(solution.converged)[index])
    rounding = {"displacement": DISPLACEMENT_NOISE, "load": noise}
    motion: Record = {}
    stiffness: Record = {}
    for group in channels(RING):
        values = value_at(group.holder, solution)[index]
        if group.prefix in rounding:
            values = np.where(np.abs(values) <= rounding[group.prefix], 0.0, values)
        (stiffness if group.results is STIFFNESS else motion)[group.prefix] = of_channels(group.results, values)
    return {
        **motion,
        "channels": CHANNEL_UNITS,
        **stiffness,
        "stiffness_SI": _matrix_rows(solution.stiffness[index]) if solved else None,
        "compliance_SI": _matrix_rows(solution.compliance[index]) if solved else None,
    }


def choice_record(solution: Any, index: CasePlace) -> Record:
    """What was chosen and left out; null where the scene names its effects."""
    choice = solution.choice
    if choice is None:
        return {"left_out": None, "accuracy": None}
    left_out = [
        {"effect": one.effect, "estimated_error": number(np.broadcast_to(one.estimated_error, solution.shape)[index])}
        for one in choice.left_out
    ]
    chosen = {"asked": choice.tolerance, "has": list(choice.effects), "added": list(choice.added)}
    return {"left_out": left_out, "accuracy": {**chosen, "solves": choice.solves}}


def choices(scene: Scene) -> dict[str, str | None]:
    """The scene's choices among several models, in the words of its file; None where nothing asks."""
    gyroscopic, is_moved = scene.gyroscopic_moment, scene.raceway_control == "friction"
    return {
        "raceway_control": None if scene.raceway_control is None else str(scene.raceway_control),
        "moment_shares": None if gyroscopic is None or is_moved else str(gyroscopic.moment_shares),
        "hertz_angle": str(scene.hertz_angle),
        "hertz_form": str(scene.hertz_form),
        "tilt_lever": str(scene.tilt_lever),
        "orbit_radius": str(scene.orbit_radius) if scene.ball_effects else None,
        "ball_motion": str(scene.ball_motion) if scene.ball_effects else None,
    }


def preload(solution: Solution, index: CasePlace = ()) -> Record | None:
    """The preload before fitting, mounted and in operation; None where the scene has none."""
    if solution.scene.preload is None:
        return None
    numbers = numbers_or_none(OF_PRELOAD, solution, index)
    last = {"axial_displacement_um": numbers.pop("axial_displacement_um")}
    state = str(np.asarray(solution.preload_state)[index]) or None
    return {"kind": solution.scene.preload.kind, **numbers, "state": state, **last}


def elastic_rings(solution: Solution, index: CasePlace = ()) -> Record | None:
    """How the rings deflect, and what part of the axial displacement that is; None between rigid rings."""
    if solution.scene.elastic_rings is None:
        return None
    sides = ("inner", "outer")
    table: Record = dict.fromkeys(("share_of_axial_displacement", *sides))
    table |= table_of("elastic_rings", solution, index) or {}
    for side in sides:
        if table[side] is not None:
            amplitudes = getattr(solution, f"{side}_shape").amplitudes[index]
            table[side]["amplitudes_um"] = [number(value / um) for value in amplitudes]
    return table


def table_of(name: str, solution: Solution, index: CasePlace = ()) -> Record | None:
    """The numbers that are described as of this table, those of the tables within it last; None where the scene calls
    for none of them."""
    table: Record = {}
    for group in GROUPS:
        if group.table and group.table[0] == name and not group.axis:
            own = numbers_of(group, solution, index)
            if len(group.table) > 1:
                table[group.table[1]] = own
            else:
                table = (own or {}) | table
    return table if any(each is not None for each in table.values()) else None


def temperatures(
    solution: Solution, index: CasePlace = (), thermal_of: Thermal | None = None
) -> dict[str, Record] | None:
    """Of rings, shaft, housing and balls, and whether each is given, found or assumed; None where the scene gives
    none."""
    known = solution.scene.temperatures
    if not known:
        return None
    balance = thermal_of if solution.thermal is None else solution.thermal.thermal
    nodes = () if balance is None else balance.found_nodes
    return {
        body: {
            "temperature_C": number(np.broadcast_to(each.value, solution.shape)[index] - zero_celsius),
            "from": "heat balance" if body in nodes and not each.is_assumed else each.taken_from,
            "assumed": each.is_assumed,
        }
        for body, each in known.items()
    }


def thermal(solution: Solution | SetSolution, index: CasePlace = ()) -> Record | None:
    """Temperatures and heat of the steady state; None where the scene asks for none."""
    if solution.thermal is None:
        return None
    from qsbearing.results.thermal_report import thermal_record  # loaded only where there is heat

    return thermal_record(solution, index)


OF_BALLS = (
    OF_AZIMUTH,
    *(
        each
        for each in GROUPS
        if each.axis == BALL and each is not OF_AZIMUTH and each.table and each.table[0] != TRACTION
    ),
)


def balls(solution: Solution, index: CasePlace = ()) -> list[Record]:
    """What there is to say about each ball of one case, under the keys of `run --json`."""
    called_for = [each for each in OF_BALLS if each.is_requested is None or each.is_requested(requested(solution))]
    read = [
        (group, each, each.of(value_at(group.holder, solution), index))
        for group in called_for
        for each in group.results
    ]
    control, slips = solution.raceway_control, solution.slips
    records = []
    for ball in map(int, np.flatnonzero(np.isfinite(solution.azimuth[index]))):
        own: Record = {}
        for group, each, values in read:
            holder = within(own, group, "balls")
            holder[each.key] = None if values is None else number(values[ball])
        own["raceway_control"] = None if control is None else str(control[index][ball])
        records.append(own | {"slips": None if slips is None else bool(slips[index][ball])})
    return records


def traction_record(solution: Solution, index: CasePlace = ()) -> Record:
    """What the balance of friction says, under its key, null at rest; nothing by a hypothesis."""
    if solution.balance is None:
        return {}
    if solution.friction is None:
        return {TRACTION: None}
    from qsbearing.results.traction_record import of_balance  # loaded only where friction moves the balls

    return {TRACTION: of_balance(solution, index)}


def of_channels(channels: tuple[Result, ...], values: NDArray) -> dict[str, float | None]:
    """Values of the five channels under their keys."""
    return {each.key: number(each.of(values)) for each in channels}


def _load_noise(solution: Solution, index: CasePlace) -> NDArray:
    """Of a bearing: of its largest load, those of its balls and a moment over its radius among them."""
    lever = 0.5 * np.broadcast_to(np.asarray(solution.scene.bearing.pitch_diameter, float), solution.shape)[index]
    levers = np.where([channel.is_rotation for channel in CHANNELS], lever, 1.0)
    of_balls = [np.nan_to_num(side.load[index]) for side in solution.arcs]
    of_ring = np.nan_to_num(np.abs(solution.load[index]) / levers)
    largest = max(np.max(each, initial=0.0) for each in (*of_balls, of_ring))
    least = np.broadcast_to(least_force(solution.scene.bearing), solution.shape)[index]
    return np.asarray(rounding_of(largest, least) * levers)


def _matrix_rows(matrix: NDArray) -> list[list[float | None]]:
    """A matrix as lists; what is rounding beside its diagonal is zero."""
    return [[number(value) for value in row] for row in matrix_without_rounding(matrix)]
