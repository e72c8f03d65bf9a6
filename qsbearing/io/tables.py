"""How tables look, and the catalogue as tables; rich lays them out."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Sequence
from typing import Any

from rich import box
from rich.console import Console, Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from qsbearing.io.catalogue import Entry
from qsbearing.ranked_warning import Rank, in_order

NARROWEST, WIDEST = 80, 100
"""Columns: a narrower terminal breaks the lines itself, which loses no digit; wider, no table is easier to read."""

COLOURS = {Rank.WRONG_MODEL: "bold red", Rank.CHECK_DATA: "bold yellow", Rank.GOOD_TO_KNOW: "bold"}


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


def plain_table(title: str, heading: Sequence[str], left: tuple[int, ...] = (0,)) -> Table:
    """A table without frames, numbers to the right."""
    table = Table(title=title, box=box.SIMPLE_HEAD, show_edge=False, title_justify="left", title_style="bold")
    table.pad_edge, table.padding = False, (0, 1, 0, 0)
    for number, name in enumerate(heading):
        table.add_column(name, justify="left" if number in left else "right", no_wrap=True)
    return table


def digits_of(value: Any) -> str:
    """A number to five digits; a dash where there is none."""
    return f"{float(value) + 0.0:.5g}" if math.isfinite(value) else "-"


def warning_lines(warnings: Iterable[str]) -> list[Text]:
    """Each on a line of its own, what matters most first."""
    lines = []
    for each in in_order(warnings):
        lines.append(Text(each.line))
        lines[-1].stylize(COLOURS[each.rank], 0, len(each.rank.words) + 1)
    return lines


def catalogue(entries: Sequence[Entry]) -> Group:
    """All entries, one a row, their sources below."""
    heading = ("name", "kind", "Z", "D\nmm", "dm\nmm", "alpha0\ndeg", "balls", "rings", "from")
    table = plain_table("Catalogue", heading, left=(0, 1, 6, 7, 8))
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
        "`qsbearing catalogue NAME` shows where each number comes from; `qsbearing run NAME` solves an example. "
        "Standard spindle bearings: `qsbearing catalogue --bore 70 --angle 15`."
    )
    return Group(table, Padding(notes, (1, 0, 0, 0)), Padding(hint, (1, 0, 0, 0)))


def spindle_table(entries: Sequence[Entry]) -> Group:
    """Standard bearings, one a row; what is inferred is marked."""
    heading = ("name", "d", "D", "B", "Z", "Dw", "dm", "alpha0\ndeg", "f *", "C\nN", "balls")
    table = plain_table("Spindle bearings, lengths in mm", heading, left=(0, 10))
    for entry in entries:
        bearing, own = entry.bearing, entry.dimensions
        lengths = [own[f"{key}_mm"] for key in ("bore_diameter", "outside_diameter", "width")]
        f = bearing["inner_groove_radius_mm"] / bearing["ball_diameter_mm"]
        sizes = [bearing[key] for key in ("ball_diameter_mm", "pitch_diameter_mm", "free_contact_angle_deg")]
        numbers = (*lengths, bearing["ball_count"], *sizes)
        rating = f"{own['dynamic_load_rating_N']:.0f}"
        table.add_row(
            entry.name, *(f"{each:g}" for each in numbers), f"{f:.4f}", rating, _material(bearing["ball_material"])
        )
    notes = "* inferred: groove radius coefficient, which the source does not print."
    source = f"From {entries[0].source.partition(', row')[0]}."
    return Group(
        table, Text(), Text(f"{notes} {source} `qsbearing catalogue NAME` shows where each number comes from.")
    )


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
        table.add_row(key, shown, Text(origin, style=_style(origin)))
        for number, source in entry.material_provenance.items():
            if number.startswith(f"{key}."):
                table.add_row("", number.removeprefix(f"{key}."), Text(source, style=_style(source)))
    for key, size in entry.dimensions.items():
        origin = entry.dimensions_source or "catalogue row"
        table.add_row(key, f"{size:g}", f"{origin}; what needs the bore or the outside diameter takes it from here")
    head = Text.assemble((entry.name, "bold"), f"  {entry.description}\n", ("Source: ", "bold"), entry.source)
    return Group(head, Padding(table, (1, 0, 0, 0)))


def _style(origin: str) -> str:
    return "yellow" if origin.startswith(("assumed", "inferred")) else ""


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
