"""Results and the catalogue as tables for people; rich lays them out."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rich import box
from rich.console import Console, Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from qsbearing.catalogue import Entry
    from qsbearing.solution import Solution

NARROWEST, WIDEST = 80, 100
"""Columns: a narrower terminal breaks the lines itself, which loses no digit; wider, no table is easier to read."""

SAME = 1e-9
"""Balls whose loads and angles differ by less than this share a row: a symmetric load makes them equal but for
rounding."""

RING_NOISE = 1e-10
"""Ring loads below this part of the largest are rounding."""

_CHANNELS = ("axial", "radial y", "radial z", "tilt y", "tilt z")
_UNITS = (("um", "N", "N/um"), ("mrad", "Nm", "Nm/mrad"))


def text_of(renderable: RenderableType, width: int | None = None) -> str:
    """The text for the terminal or file at standard output: colours and lines only where it understands them."""
    console = Console(width=width, highlight=False, soft_wrap=False)
    if width is None:
        # A file has no width to ask for; a terminal keeps its own, within reason.
        known = console.is_terminal or "COLUMNS" in os.environ
        console.width = max(min(console.width, WIDEST), NARROWEST) if known else WIDEST
    with console.capture() as capture:
        console.print(renderable)
    return "\n".join(line.rstrip() for line in capture.get().splitlines()) + "\n"


def result(solution: Solution) -> Group:
    """The report on a single case: heading, ring, balls, warnings."""
    from qsbearing import record

    found = record.record(solution)
    parts: list[RenderableType] = [_heading(solution, found)]
    if found["status"] == "converged":
        rows, count = distinct(found["balls"]), len(found["balls"])
        tables = [_ring(solution, found), _contacts(rows, count), _ellipses(rows, count)]
        if found["effects"]:
            tables.append(_motion(rows, count, found))
        parts += [Padding(table, (1, 0, 0, 0)) for table in tables]
    for sentence in found["warnings"]:
        parts.append(Padding(Text.assemble(("Warning: ", "bold yellow"), sentence), (1, 0, 0, 0)))
    return Group(*parts)


@dataclass(frozen=True)
class Row:
    """Balls that are alike, by their numbers, and what is true of each of them."""

    members: list[int]
    ball: dict[str, Any]
    azimuths: list[float]

    def names(self, count: int) -> str:
        """The balls' numbers: one, a symmetric pair, or how many."""
        if len(self.members) == count > 1:
            return f"all {count}"
        if len(self.members) > 2:
            return f"{len(self.members)} balls"
        return ", ".join(str(member) for member in self.members)

    def azimuth(self, count: int) -> str:
        """Where they stand."""
        if len(self.members) == count > 1:
            return "any"
        places = [f"{azimuth:.2f}".rstrip("0").rstrip(".") for azimuth in self.azimuths]
        return ", ".join(places) if len(places) <= 2 else f"{places[0]} ... {places[-1]}"


def distinct(balls: Sequence[dict[str, Any]]) -> list[Row]:
    """The balls with equal ones gathered, in the order of their first."""
    largest = max((ball[side]["load_N"] for ball in balls for side in ("inner", "outer")), default=0.0) or 1.0
    rows: list[Row] = []
    for position, ball in enumerate(balls):
        for row in rows:
            if _alike(row.ball, ball, largest):
                row.members.append(position)
                row.azimuths.append(ball["azimuth_deg"])
                break
        else:
            rows.append(Row([position], ball, [ball["azimuth_deg"]]))
    return rows


def _alike(one: dict[str, Any], other: dict[str, Any], largest: float) -> bool:
    for side in ("inner", "outer"):
        if abs(one[side]["load_N"] - other[side]["load_N"]) > SAME * largest:
            return False
        a, b = one[side]["angle_deg"], other[side]["angle_deg"]
        if (a is None) != (b is None) or (a is not None and abs(a - b) > 90.0 * SAME * 10.0):
            return False
    return bool(one["raceway_control"] == other["raceway_control"])


def _heading(solution: Solution, found: dict[str, Any]) -> RenderableType:
    bearing, operation = solution.scene.bearing, solution.scene.operation
    per_mm, per_deg, per_rpm = 1e3, 180.0 / math.pi, 30.0 / math.pi
    solved = found["status"] == "converged"
    kind = str(bearing.kind).replace("_", " ")
    lines = Text()
    lines.append(f"{bearing.name or 'Bearing'}", style="bold")
    lines.append(
        f"  {kind}, {float(bearing.ball_count):.0f} balls of {float(bearing.ball_diameter) * per_mm:.6g} mm on "  # type: ignore[arg-type]
        f"{float(bearing.pitch_diameter) * per_mm:.6g} mm, free contact angle "  # type: ignore[arg-type]
        f"{float(bearing.free_contact_angle) * per_deg:.5g} deg\n"  # type: ignore[arg-type]
    )
    speeds = f"Inner ring {float(operation.speed) * per_rpm:.6g} rpm"  # type: ignore[arg-type]
    if operation.outer_speed is not None:
        speeds += f", outer ring {float(operation.outer_speed) * per_rpm:.6g} rpm"  # type: ignore[arg-type]
    lines.append(f"{speeds}. {_asked_for(found)}\n")
    lines.append(found["status"].replace("_", " ").capitalize(), style="bold green" if solved else "bold red")
    if solved:
        lines.append(
            f" in {found['iterations']} iterations, {_duration(found['seconds'])}; largest imbalance "
            f"{found['residual']:.1e} of the largest force"
        )
    else:
        lines.append(f"\n{found['message']}")
    return lines


def _asked_for(found: dict[str, Any]) -> str:
    if not found["effects"]:
        words = "No ball effects (static)"
    else:
        names = [name.replace("_", " ") for name in found["effects"]]
        words = " and ".join(names).capitalize()
        control = found["choices"]["raceway_control"].replace("_", " ")
        words += f"; raceway control: {control}"
        if found["choices"]["moment_shares"]:
            words += f"; moment shares: {found['choices']['moment_shares']}"
    defaults = {"hertz_angle": "free", "hertz_form": "exact", "tilt_lever": "groove_centre"}
    for name, usual in defaults.items():
        if found["choices"][name] != usual:
            words += f"; {name.replace('_', ' ')}: {found['choices'][name].replace('_', ' ')}"
    return words


def _duration(seconds: float) -> str:
    if seconds >= 0.1:
        return f"{seconds:.2g} s (starting the compiled solver included)"
    return f"{seconds * 1e3:.2g} ms"


def _ring(solution: Solution, found: dict[str, Any]) -> Table:
    from qsbearing import record
    from qsbearing.operation import CHANNELS

    heading = ("", "displacement", "", "load", "", "stiffness", "", "imposed")
    table = _table("Inner ring", heading, left=(0, 2, 4, 6, 7))
    table.columns[7].style = "dim"
    displacements, loads = list(found["displacement"].values()), list(found["load"].values())
    # What the solver leaves of a balance that is exactly zero is shown as zero.
    force = max(abs(load) for load in loads[:3])
    lever = float(solution.scene.bearing.pitch_diameter) / 2.0  # type: ignore[arg-type]
    noise = RING_NOISE * max(force, max(abs(load) for load in loads[3:]) / lever)
    for i, words in enumerate(_CHANNELS):
        length, force_unit, rate = _UNITS[i >= 3]
        held = getattr(solution.scene.operation, CHANNELS[i].displacement) is not None
        table.add_row(
            words,
            _digits(displacements[i], 1e-9),
            length,
            _digits(loads[i], noise * (lever if i >= 3 else 1.0)),
            force_unit,
            _digits(found["stiffness_SI"][i][i] / record.STIFFNESS[i][1], 1e-9),
            rate,
            "displacement" if held else "load",
        )
    return table


def _digits(value: float, noise: float, significant: int = 6) -> str:
    return "0" if abs(value) <= noise else f"{value:.{significant}g}"


def _contacts(rows: list[Row], count: int) -> Table:
    table = _table(
        "Contacts",
        ("ball", "azimuth\ndeg", "angle i\ndeg", "angle o\ndeg", "load i\nN", "load o\nN", "p0 i\nMPa", "p0 o\nMPa"),
        left=(0, 1),
    )
    pairs = [(key, side) for key in ("angle_deg", "load_N", "max_pressure_MPa") for side in ("inner", "outer")]
    return _filled(table, rows, count, [_column([_pressed(row, side, key) for row in rows]) for key, side in pairs])


def _ellipses(rows: list[Row], count: int) -> Table:
    heading = ("ball", "azimuth\ndeg", "a i\nmm", "b i\nmm", "a o\nmm", "b o\nmm", "delta i\num", "delta o\num")
    table = _table("Contact ellipses: a across, b along the rolling direction; delta: approach", heading, left=(0, 1))
    pairs = [(side, key) for side in ("inner", "outer") for key in ("semi_major_axis_mm", "semi_minor_axis_mm")]
    pairs += [("inner", "approach_um"), ("outer", "approach_um")]
    return _filled(table, rows, count, [_column([_pressed(row, side, key) for row in rows], 5) for side, key in pairs])


def _motion(rows: list[Row], count: int, found: dict[str, Any]) -> Table:
    gyroscopic = "gyroscopic_moment" in found["effects"]
    title = "Ball inertia and motion" + ("; mu: the friction that Mg demands" if gyroscopic else "")
    heading = ["ball", "azimuth\ndeg"]
    columns: list[list[str]] = []
    for key, words in (("centrifugal_force_N", "Fc\nN"), ("gyroscopic_moment_Nmm", "Mg\nNmm")):
        if any(row.ball[key] is not None for row in rows):
            heading.append(words)
            columns.append(_column([row.ball[key] for row in rows]))
    if gyroscopic:
        for side, letter in (("inner", "i"), ("outer", "o")):
            heading.append(f"mu {letter}\n-")
            columns.append(_column([row.ball[side]["required_friction"] for row in rows], significant=4))
    heading += ["orbit\nrpm", "rotation\nrpm"]
    columns += [_column([row.ball[key] for row in rows], 5) for key in ("orbital_speed_rpm", "rotation_speed_rpm")]
    if found["choices"]["raceway_control"] == "per_ball":  # else it is one for all, and stands in the heading
        heading.append("control")
        columns.append([row.ball["raceway_control"] for row in rows])
    return _filled(_table(title, heading, left=(0, 1)), rows, count, columns)


def _pressed(row: Row, side: str, key: str) -> float | None:
    """A contact's number; None where the two do not touch: no ellipse, no line of contact, only a gap."""
    contact = row.ball[side]
    untouched = contact["load_N"] == 0.0 and key not in ("load_N", "approach_um")
    return None if untouched else contact[key]


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


def _filled(table: Table, rows: list[Row], count: int, columns: list[list[str]]) -> Table:
    for row, cells in zip(rows, zip(*columns, strict=True), strict=True):
        lost = row.ball["inner"]["load_N"] == 0.0
        table.add_row(row.names(count), row.azimuth(count), *cells, style="dim" if lost else None)
    return table


def _table(title: str, heading: Sequence[str], left: tuple[int, ...] = (0,)) -> Table:
    table = Table(title=title, box=box.SIMPLE_HEAD, show_edge=False, title_justify="left", title_style="bold")
    table.pad_edge, table.padding = False, (0, 1, 0, 0)
    for position, words in enumerate(heading):
        table.add_column(words, justify="left" if position in left else "right", no_wrap=True)
    return table


def catalogue(entries: Sequence[Entry]) -> Group:
    """All entries, one a row, their sources below."""
    heading = ("name", "kind", "Z", "D\nmm", "dm\nmm", "alpha0\ndeg", "balls", "rings", "from")
    table = _table("Catalogue", heading, left=(0, 1, 6, 7, 8))
    for column in (table.columns[1], *table.columns[6:8]):
        column.no_wrap, column.min_width = False, 7
    sources: list[str] = []
    for entry in entries:
        bearing = entry.bearing
        if entry.source not in sources:
            sources.append(entry.source)
        table.add_row(
            entry.name,
            bearing["kind"].replace("_", " "),
            str(bearing["ball_count"]),
            f"{bearing['ball_diameter_mm']:g}",
            f"{bearing['pitch_diameter_mm']:g}",
            f"{_free_angle(bearing):.4g}",
            _material(bearing["ball_material"]),
            _material(bearing["ring_material"]),
            f"[{sources.index(entry.source) + 1}]",
        )
    notes = Table(box=None, show_header=False, pad_edge=False)
    notes.add_column(no_wrap=True)
    notes.add_column()
    for position, source in enumerate(sources):
        notes.add_row(f"[{position + 1}]", Text(source))
    hint = Text(
        "`qsbearing catalogue NAME` tells where each number comes from; `qsbearing run NAME` solves an example."
    )
    return Group(table, Padding(notes, (1, 0, 0, 0)), Padding(hint, (1, 0, 0, 0)))


def catalogue_entry(entry: Entry) -> Group:
    """One entry, with the origin of every number."""
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    table.add_column("", no_wrap=True)
    table.add_column("value", no_wrap=True)
    table.add_column("where it comes from")
    for key, value in entry.bearing.items():
        if key == "kind":
            continue
        origin = entry.provenance.get(key, "")
        shown = _material(value, full=True) if key.endswith("_material") else f"{value:g}"
        table.add_row(key, shown, Text(origin, style="yellow" if key in entry.assumed else ""))
    head = Text.assemble((entry.name, "bold"), f"  {entry.description}\n", ("Source: ", "bold"), entry.source)
    return Group(head, Padding(table, (1, 0, 0, 0)))


def _free_angle(bearing: dict[str, Any]) -> float:
    if "free_contact_angle_deg" in bearing:
        return float(bearing["free_contact_angle_deg"])
    distance = bearing["inner_groove_radius_mm"] + bearing["outer_groove_radius_mm"] - bearing["ball_diameter_mm"]
    return math.degrees(2.0 * math.asin(math.sqrt(bearing["diametral_clearance_mm"] / (4.0 * distance))))


def _material(value: Any, full: bool = False) -> str:
    if isinstance(value, str):
        return value
    modulus, ratio, density = (value[key] for key in ("elastic_modulus_GPa", "poisson_ratio", "density_kg_m3"))
    return f"{modulus:g} GPa, {ratio:g},\n{density:g} kg/m3" if full else f"{modulus:.4g} GPa"
