"""The report on a solved case as tables for people: ring, contacts, ellipses, motion, warnings."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from qsbearing.documents.model import Block, Callout, Paragraph, Table
from qsbearing.documents.numbers import duration, plain
from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.flatten import case_arrays
from qsbearing.model.solution.groups import (
    ANGLE,
    APEX,
    CONTACT,
    CONTACT_LOAD,
    DEVIATION,
    ELSEWHERE,
    FRICTION,
    GEOMETRY,
    OF_BALL,
    RING_SHAPE,
    RING_STATE,
    SIDES,
    SPEEDS,
)
from qsbearing.model.solution.judgement import percent
from qsbearing.model.solution.result_keys import STIFFNESS, Result, printed_unit
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.traction_groups import OPPOSITE
from qsbearing.model.units import deg, mm, mrad, rpm, um
from qsbearing.remarks.wording import Words
from qsbearing.results.json_record import how_it_ended, record
from qsbearing.results.key_results import answer, are_rounding, levers_of
from qsbearing.results.readings_record import Readings, number
from qsbearing.results.record_type import Record
from qsbearing.results.remarks import blocks, every_remark
from qsbearing.results.tables import freedom

if TYPE_CHECKING:
    from qsbearing.systems.heat.network import Thermal
    from qsbearing.systems.sets.set_solution import SetSolution

SAME = 7
"""Balls whose loads over the largest and angles in degrees are equal to so many decimals share a row: a symmetric load
makes them equal but for rounding."""

_UNITS = (("µm", "N", "N/µm"), ("mrad", "N m", "N m/mrad"))


def result(solution: Solution, readings: Readings, words: Words = IN_FILE) -> list[Block]:
    """The report on a single case: heading, the answer, ring, balls, what was read off, warnings."""
    said = every_remark(solution, readings)
    of_case = record(solution, {}, said=said)
    parts = _heading(solution, of_case)
    if of_case["status"] == "converged":
        parts.append(answer(solution, readings))
        parts += [*_tables(solution, of_case), *_balance(solution, of_case), *heat_tables(of_case)]
        if readings:
            from qsbearing.results.readings_report import readings_tables  # a scene without readings does not load them

            parts += readings_tables(readings, solution.scene)
    return [*parts, *blocks(said, is_apart=True, words=words)]


def heat_tables(record: Record) -> list[Block]:
    """Of a record's steady state; none where it has none."""
    if record["thermal"] is None:
        return []
    from qsbearing.results.thermal_report import thermal_tables  # loaded only where there is heat

    return thermal_tables(record["thermal"])


def tables(solution: Solution) -> list[Table]:
    """The tables of a single case that is solved: ring, stiffness, contacts, ellipses, motion, friction."""
    of_case = record(solution, {}, said=())
    of_balance = [each for each in _balance(solution, of_case) if isinstance(each, Table)]
    return [*_tables(solution, of_case), *of_balance]


def tables_of_balls(solution: Solution, thermal_of: Thermal | None = None) -> list[Table]:
    """The tables of a solved case that tell of its balls: lengths in operation, contacts, ellipses, motion.

    Args:
        thermal_of: of a row, the set's heat balance, which has found its temperatures.
    """
    of_case = record(solution, {}, (), thermal_of, ())
    return [*_expansion(solution, of_case), *_of_balls(solution, of_case)]


def tables_of_rings(solution: Solution, thermal_of: Thermal | None = None) -> list[Table]:
    """Those of them that are not of its balls: lengths in operation, rings, temperatures."""
    return _expansion(solution, record(solution, {}, (), thermal_of, ()))


def _tables(solution: Solution, record: Record) -> list[Table]:
    tables = [
        channels_table("Inner ring", solution, record),
        *_expansion(solution, record),
        stiffness_table(solution, record),
    ]
    return [*tables, stiffness_matrix_table(record), *_of_balls(solution, record)]


def _balance(solution: Solution, record: Record) -> list[Block]:
    """Of friction that moves the balls."""
    if solution.friction is None:
        return []
    from qsbearing.results.traction_record import tables_of_balance  # loaded only where friction moves the balls

    return tables_of_balance(solution, record)


def _of_balls(solution: Solution, record: Record) -> list[Table]:
    rows, count = distinct(record["balls"]), len(record["balls"])
    tables = [contacts_table(rows, count), _ellipses(rows, count)]
    if any(OPPOSITE in row.ball for row in rows):
        others = [replace(row, ball=row.ball | row.ball[OPPOSITE]) for row in rows]
        of_arcs = contacts_table(others, count), _ellipses(others, count)
        tables += [replace(each, caption=f"Opposite arcs: {each.caption}") for each in of_arcs]
    return [*tables, _motion(rows, count, record)] if solution.scene.ball_effects else tables


@dataclass(frozen=True)
class AlikeBalls:
    """Balls that are alike, by their numbers, and what is true of each of them."""

    members: list[int]
    ball: Record
    azimuths: list[float]

    def names(self, count: int) -> tuple[str, str]:
        """The balls and their azimuths: one, a symmetric pair, or how many."""
        if len(self.members) == count > 1:
            return f"all {count}", "any"
        places = [f"{azimuth:.2f}".rstrip("0").rstrip(".") for azimuth in self.azimuths]
        if len(self.members) > 2:
            return f"{len(self.members)} balls", f"{places[0]} ... {places[-1]}"
        return ", ".join(map(str, self.members)), ", ".join(places)


def distinct(balls: Sequence[Record]) -> list[AlikeBalls]:
    """The balls with equal ones gathered, in the order of their first."""
    largest = max((ball[side]["load_N"] for ball in balls for side in SIDES), default=0.0) or 1.0
    rows: dict[Any, AlikeBalls] = {}
    for i, ball in enumerate(balls):
        contacts = [of[side] for of in (ball, ball.get(OPPOSITE, {})) for side in SIDES if side in of]
        loads = (round((each["load_N"] or 0.0) / largest, SAME) for each in contacts)
        angles = (each["angle_deg"] for each in contacts)
        alike = (*loads, *(None if angle is None else round(angle, SAME) for angle in angles), ball["raceway_control"])
        row = rows.setdefault(alike, AlikeBalls([], ball, []))
        row.members.append(i)
        row.azimuths.append(ball["azimuth_deg"])
    return list(rows.values())


def _heading(solution: Solution, record: Record) -> list[Block]:
    name = solution.scene.bearing.name or "Bearing"
    parts: list[Block] = [
        Paragraph(f"{name}  {geometry_text(solution)}", name),
        Paragraph(f"{speeds_text(solution)}. {requested_for(record)}"),
    ]
    preload = record["preload"]
    if preload is not None and record["status"] == "converged":
        parts.append(Paragraph(f"Preload ({preload['kind'].replace('_', ' ')}): {preload_text(preload)}"))
    return [*parts, *ending(record)]


def geometry_text(solution: Solution) -> str:
    """The bearing of a single case: kind, balls, free contact angle."""
    numbers = case_arrays(solution.scene)
    count, ball, pitch, angle = (
        float(numbers[name]) for name in ("ball_count", "ball_diameter", "pitch_diameter", "free_contact_angle")
    )
    kind = str(solution.scene.bearing.kind).replace("_", " ")
    balls = f"{count:.0f} balls of {ball / mm:.6g} mm on {pitch / mm:.6g} mm"
    play = solution.scene.bearing.axial_clearance
    clearance = "" if play is None else f", axial clearance {float(play) / um:.5g} µm"
    return f"{kind}, {balls}, free contact angle {angle / deg:.5g} deg{clearance}"


def speeds_text(solution: Solution) -> str:
    """The speeds of both rings of a single case."""
    numbers = case_arrays(solution.scene)
    return f"Inner ring {float(numbers['speed']) / rpm:.6g} rpm{outer_turning(numbers.get('outer_speed'))}"


def outer_turning(speed: Any) -> str:
    """What is said of the outer rings' speed [rad/s] beside that of the inner ones; nothing where none is given."""
    return "" if speed is None else f", outer ring {float(speed) / rpm:.6g} rpm"


def loads_text(solution: Solution | SetSolution) -> str:
    """What loads the free channels of ring or shaft, in a single case; empty where nothing does."""
    return named_loads([float(solution.load[i]) if i in solution.free_channels else 0.0 for i in range(len(CHANNELS))])


def named_loads(loads: Iterable[float]) -> str:
    """Those of a load [N, N m] that are not zero, in the order of the channels."""
    return ", ".join(
        f"{channel.label} {load:.5g} {_UNITS[channel.is_rotation][1]}"
        for channel, load in zip(CHANNELS, loads, strict=True)
        if load != 0.0
    )


def preload_text(preload: Record) -> str:
    """A record's preload in its three states, and what has become of it."""
    states = (("unmounted_N", "before fitting"), ("mounted_N", "mounted, at rest"), ("in_operation_N", "in operation"))
    text = ", ".join(f"{preload[key]:.6g} N {words}" for key, words in states)
    if preload["share"] is None:
        return text
    share = percent(preload["share"], digits=3)
    return f"{text}: {preload['state']}; without external loads {share} of the given preload"


def ending(record: Record) -> list[Block]:
    """Why the case of a record has no solution; nothing where it has one."""
    status, message = record["status"].replace("_", " ").capitalize(), record["message"]
    if record["status"] == "converged":
        return []
    if message.startswith(status):
        return [Callout(message, "fail", status, "red")]
    return [Callout(status, "fail", status, "red"), Paragraph(message)]


def pulse(solution: Solution | SetSolution) -> list[Block]:
    """How the solver came to a single case; nothing where it did not, or of several cases."""
    if solution.shape or not solution.converged:
        return []
    record = how_it_ended(solution)
    took = f"Converged in {record['iterations']} iterations, {duration(record['seconds'])}"
    told = f"{took}; largest imbalance {record['residual']:.1e} of the largest force"
    return [Callout(told, "pass", "Converged", "green", is_apart=True)]


def requested_for(record: Record) -> str:
    """The effects of a record, and the choices that are not the usual ones."""
    choices = record["choices"]
    *others, last = record["effects"] or ["No ball effects (static)"]
    named = f"{', '.join(others)} and {last}".capitalize() if others else last[0].upper() + last[1:]
    if choices["raceway_control"]:
        named += f"; raceway control: {choices['raceway_control']}"
    if choices["moment_shares"]:
        named += f"; moment shares: {choices['moment_shares']}"
    if choices["orbit_radius"] == "displaced":
        named += "; each ball on its own orbit"
    if choices["ball_motion"] == "common":
        named += "; all balls moving alike"
    for name, usual in (("hertz_angle", "free"), ("hertz_form", "exact"), ("tilt_lever", "groove_centre")):
        if choices[name] != usual:
            named += f"; {name}: {choices[name]}"
    return named.replace("_", " ")


FROM_MIDDLE = "axial from middle"


def channels_table(title: str, solution: Solution | SetSolution, record: Record) -> Table:
    """Displacement and load of ring or shaft."""
    rows = []
    values = zip(CHANNELS, record["displacement"].values(), record["load"].values(), strict=True)
    rounding = are_rounding(solution.displacement, levers_of(solution))
    for i, (channel, displacement, load) in enumerate(values):
        length, force, _ = _UNITS[channel.is_rotation]
        moved = digits(0.0 if rounding[i] else displacement, 0.0)
        imposed = "load" if i in solution.free_channels else "displacement"
        rows.append((channel.label, moved, length, digits(load, 0.0), force, imposed))
    middle, notes = record.get("axial_from_middle_um"), []
    if middle is not None:
        rows.insert(1, (FROM_MIDDLE, digits(middle, 1e-9), "µm", "", "", ""))
        notes = [("axial:", "from where the balls just touch one side, at the free contact angle"),
                 (f"{FROM_MIDDLE}:", "from where the grooves of both rings lie in one plane")]  # fmt: skip
    return Table(("", "displacement", "", "load", "", "imposed"), rows, "lrlrll", title, notes=notes)


def heading_of(result: Result) -> str:
    """Two words on the first line, and the rest with the unit below."""
    words = (result.heading or result.plain_name).split()
    below = filter(None, (*words[2:], printed_unit(result.unit)))
    return "\n".join(filter(None, (" ".join(words[:2]), " ".join(below))))


def _expansion(solution: Solution, record: Record) -> list[Table]:
    """Lengths before and after the ring effects, and the state of the rings."""
    operating, rings = record["operating_geometry"], record["rings"]
    tables = []
    if operating is not None:
        rows = []
        for each in GEOMETRY:
            cold = digits(number(each.of(solution.scene.bearing)), 0.0)
            rows.append((each.plain_name, cold, digits(operating[each.key], 0.0), printed_unit(each.unit)))
        heading = ("", "at rest, cold", "in operation", "")
        tables.append(Table(heading, rows, "lrrl", "Geometry before loading"))
    if rings is not None:
        states = [(side, *(digits(state[each.key], 1e-9) for each in RING_STATE)) for side, state in rings.items()]
        tables.append(Table(("", *map(heading_of, RING_STATE)), states, caption="Rings"))
    return tables + _shapes(record) + temperature_tables(record)


def _shapes(record: Record) -> list[Table]:
    """How elastic rings have deflected."""
    elastic = record["elastic_rings"]
    if elastic is None:
        return []
    heading = ("", *map(heading_of, RING_SHAPE))
    share = elastic["share_of_axial_displacement"]
    part = "" if share is None else f"; {plain(100.0 * share, '.3g')} % of the axial displacement"
    rows = [
        (side, *(digits(elastic[side][each.key], 1e-9) for each in RING_SHAPE))
        for side in ("inner", "outer")
        if elastic[side] is not None
    ]
    return [Table(heading, rows, caption=f"Rings deflected by the ball loads{part}")]


def temperature_tables(record: Record) -> list[Table]:
    """The temperatures that a record was solved with, those that its file leaves out among them."""
    if record["temperatures"] is None:
        return []
    rows = [
        (body.replace("_", " "), f"{each['temperature_C']:.6g}", "assumed: " * each["assumed"] + each["from"])
        for body, each in record["temperatures"].items()
    ]
    return [Table(("", "°C", "from"), rows, "lrl", "Temperatures")]


def stiffness_table(solution: Solution | SetSolution, record: Record) -> Table:
    """Locked and effective stiffness of a solution's record, channel by channel; its title states which are free."""
    heading = ("", "locked (other\ndisplacements held)", "effective\n(other loads held)", "")
    rows = []
    for channel, each in zip(CHANNELS, STIFFNESS, strict=True):
        values = (digits(record[kind][each.key], 1e-9) for kind in ("locked_stiffness", "effective_stiffness"))
        rows.append((channel.label, *values, _UNITS[channel.is_rotation][2]))
    return Table(heading, rows, "lrrl", f"Stiffness ({freedom(solution.free_channels)})")


def stiffness_matrix_table(record: Record) -> Table:
    """The whole tangent of a record."""
    tilts = [channel.is_rotation for channel in CHANNELS]
    sizes = [mrad if tilt else um for tilt in tilts]  # of a column's displacement
    heading = [f"{channel.label}\n/{'mrad' if tilt else 'µm'}" for channel, tilt in zip(CHANNELS, tilts, strict=True)]
    matrix, rows = record["stiffness_SI"], []
    for i, channel in enumerate(CHANNELS):
        cells = [
            digits(None if each is None else each * size, 0.0) for each, size in zip(matrix[i], sizes, strict=True)
        ]
        rows.append((channel.label, _UNITS[channel.is_rotation][1], *cells))
    return Table(("", "", *heading), rows, "llrrrrr", "Stiffness matrix: load (row) per displacement (column)")


def digits(value: float | None, noise: float) -> str:
    """A number to six digits; what is rounding as zero, what there is not as a dash."""
    if value is None:
        return "-"
    return "0" if abs(value) <= noise else f"{value:.6g}"


def _head_of(result: Result, side: str = "") -> str:
    """Of a column of balls."""
    words = result.heading or result.plain_symbol or result.plain_name
    return f"{words} {side[:1]}".rstrip() + "\n" + (printed_unit(result.unit) or "-")


ELLIPSES = ("semi_major_axis", "semi_minor_axis", "approach")
"""Results of contacts with a table of their own."""
FIRST = (ANGLE, CONTACT_LOAD)


def contacts_table(rows: list[AlikeBalls], count: int) -> Table:
    """Angles, loads and pressures of the balls' contacts, and whatever else is known of them."""
    others = [each for each in CONTACT if each not in (*FIRST, FRICTION) and each.name not in ELLIPSES]
    pairs = [(side, each) for each in (*FIRST, *others) for side in SIDES]
    pairs = [(side, each) for side, each in pairs if any(row.ball[side][each.key] is not None for row in rows)]
    heading = [_head_of(each, side) for side, each in pairs]
    columns = [_contact_column(rows, *pair) for pair in pairs]
    deviations = [row.ball[DEVIATION.key] for row in rows]
    if any(deviation is not None for deviation in deviations):
        heading, columns = [_head_of(DEVIATION), *heading], [_column(deviations, 4), *columns]
    return _per_ball("Contacts", heading, rows, count, columns)


def _ellipses(rows: list[AlikeBalls], count: int) -> Table:
    *axes, approach = (each for name in ELLIPSES for each in CONTACT if each.name == name)
    pairs = [(side, each) for side in SIDES for each in axes] + [(side, approach) for side in SIDES]
    title = "Contact ellipses: a across, b along rolling; δ: approach"
    if any(APEX[0].key in row.ball[side] for row in rows for side in SIDES):
        title += "; apex: from the ellipse's end to the groove's apex"
        pairs += [(side, APEX[0]) for side in SIDES]
    heading = [_head_of(each, side) for side, each in pairs]
    return _per_ball(title, heading, rows, count, [_contact_column(rows, *pair, 5) for pair in pairs])


def _motion(rows: list[AlikeBalls], count: int, record: Record) -> Table:
    gyroscopic = "gyroscopic_moment" in record["effects"]
    title = "Ball inertia and motion" + ("; µ: friction coefficient that Mg requires" if gyroscopic else "")
    shown = [each for each in OF_BALL if each not in ELSEWHERE and any(row.ball[each.key] is not None for row in rows)]
    columns = {_head_of(each): _column([row.ball[each.key] for row in rows]) for each in shown if each not in SPEEDS}
    if gyroscopic:
        for side in SIDES:
            columns[_head_of(FRICTION, side)] = _column([row.ball[side][FRICTION.key] for row in rows], 4)
    for each in SPEEDS:
        columns[_head_of(each)] = _column([row.ball[each.key] for row in rows], 5)
    if record["choices"]["raceway_control"] == "per_ball":  # else it is one for all, and stands in the heading
        columns["control"] = [row.ball["raceway_control"] for row in rows]
    if any(row.ball["slips"] is not None for row in rows):
        columns["slips"] = ["yes" if row.ball["slips"] else "no" for row in rows]
    return _per_ball(title, list(columns), rows, count, list(columns.values()))


def _contact_column(rows: list[AlikeBalls], side: str, of: Result, significant: int = 6) -> list[str]:
    """A contact's numbers; none where the two do not touch: no ellipse, no contact line, only a gap."""
    contacts = [row.ball[side] for row in rows]
    always = of is CONTACT_LOAD or of.name == "approach"
    values = [each[of.key] if always or each[CONTACT_LOAD.key] != 0.0 else None for each in contacts]
    return _column(values, significant)


def _column(values: list[float | None], significant: int = 6) -> list[str]:
    """Cells with the decimals that give the largest value its significant digits; a dash where there is no number."""
    largest = max((abs(value) for value in values if value is not None), default=0.0)
    if largest == 0.0:
        return ["-" if value is None else "0" for value in values]
    decimals = min(max(significant - 1 - math.floor(math.log10(largest)), 0), 6)
    return ["-" if value is None else _rounded(value, decimals) for value in values]


def _rounded(value: float, decimals: int) -> str:
    text = f"{value:.{decimals}f}"
    return text if float(text) != 0.0 else "0"  # no "-0.000"


def _per_ball(
    title: str, heading: Sequence[str], rows: list[AlikeBalls], count: int, columns: Sequence[Sequence[str]]
) -> Table:
    cells = [(*row.names(count), *own) for row, own in zip(rows, zip(*columns, strict=True), strict=True)]
    unloaded = [number for number, row in enumerate(rows) if row.ball["inner"]["load_N"] == 0.0]
    return Table(("ball", "azimuth\ndeg", *heading), cells, "ll" + "r" * len(heading), title, faint=unloaded)
