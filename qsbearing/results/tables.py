"""How tables look, and the catalogue as tables; rich lays them out."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import Any

from rich import box
from rich.console import Group
from rich.padding import Padding
from rich.table import Table as RichTable
from rich.text import Text

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.documents.numbers import plain
from qsbearing.files.catalogue import CatalogueEntry
from qsbearing.files.keys import PRINTED
from qsbearing.model.operation import CHANNELS

TOO_LOW = "too low for the shoulder that carries the thrust, so that it is not used as one"
_PRINTED = {key.name for key in PRINTED}


def digits_of(value: Any) -> str:
    """A number to five digits; a dash where there is none."""
    if not math.isfinite(value):
        return "-"
    return plain(float(value) + 0.0)


def catalogue(entries: Sequence[CatalogueEntry]) -> list[Block]:
    """All entries, one a row, their sources below."""
    heading = ("name", "kind", "Z", "D\nmm", "dm\nmm", "alpha0\ndeg", "balls", "rings", "from")
    sources: list[str] = []
    rows = []
    for entry in entries:
        bearing = entry.bearing
        if entry.source not in sources:
            sources.append(entry.source)
        rows.append((
            entry.name,
            bearing["kind"].replace("_", " "),
            str(bearing["ball_count"]),
            f"{bearing['ball_diameter_mm']:g}",
            f"{bearing['pitch_diameter_mm']:g}",
            f"{_free_angle(bearing):.4g}",
            _material(bearing["ball_material"]),
            _material(bearing["ring_material"]),
            f"[{sources.index(entry.source) + 1}]",
        ))  # fmt: skip
    hint = (
        "`qsbearing catalogue NAME` shows where each number comes from; `qsbearing run NAME` solves an example. "
        "Standard spindle bearings: `qsbearing catalogue --bore 70 --angle 15`."
    )
    notes = [(f"[{number}]", source) for number, source in enumerate(sources, 1)]
    return [Table(heading, rows, "llrrrrlll", "Catalogue", notes=notes), Paragraph(hint, is_apart=True)]


def spindle_table(entries: Sequence[CatalogueEntry]) -> list[Block]:
    """Standard bearings, one a row; what is inferred is marked."""
    heading = ("name", "d", "D", "B", "Z", "Dw", "dm", "alpha0\ndeg", "f *", "C\nN", "balls")
    rows = []
    for entry in entries:
        bearing, own = entry.bearing, entry.dimensions
        lengths = [own[f"{key}_mm"] for key in ("bore_diameter", "outside_diameter", "width")]
        f = bearing["inner_groove_radius_mm"] / bearing["ball_diameter_mm"]
        sizes = [bearing[key] for key in ("ball_diameter_mm", "pitch_diameter_mm", "free_contact_angle_deg")]
        numbers = (*lengths, bearing["ball_count"], *sizes)
        rating = f"{own['dynamic_load_rating_N']:.0f}"
        balls = _material(bearing["ball_material"])
        rows.append((entry.name, *(f"{each:g}" for each in numbers), f"{f:.4f}", rating, balls))
    notes = "* inferred: groove radius coefficient, which the source does not print."
    source = f"From {entries[0].source.partition(', row')[0]}."
    said = f"{notes} {source} `qsbearing catalogue NAME` shows where each number comes from."
    table = Table(heading, rows, "lrrrrrrrrrl", "Spindle bearings, lengths in mm")
    return [table, Paragraph(said, is_apart=True)]


def catalogue_entry(entry: CatalogueEntry) -> Group:
    """One entry, with the origin of every number."""
    table = RichTable(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
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
        use = "used wherever an effect or reading takes it and the scene does not state it"
        use = TOO_LOW if "_face_" in key else use if key in _PRINTED else ""
        table.add_row(key, f"{size:g}", "; ".join(filter(None, (origin, use))))
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
    return f"{modulus:g} GPa, {ratio:g},\n{density:g} kg/m³" if full else f"{modulus:.4g} GPa"


def freedom(free: Collection[int]) -> str:
    """Which channels are free to move, and which are not, by the numbers of the free ones."""
    groups = {"free": [i for i in range(5) if i in free], "displacement given": [i for i in range(5) if i not in free]}
    labels = {words: ", ".join(CHANNELS[i].label for i in group) for words, group in groups.items()}
    return "; ".join(f"{words}: {names}" for words, names in labels.items() if names)
