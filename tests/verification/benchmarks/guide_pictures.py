"""The pictures of README and guide: `python -m tests.verification.benchmarks.guide_pictures`, in a second or two."""

from __future__ import annotations

import dataclasses
import io
import json
import re
import tempfile
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

import qsbearing as qs
from fem_check.cost import picture as cost_picture
from fem_check.cost import record as cost_record
from fem_check.running import records_store
from qsbearing.files.set_file import set_of
from qsbearing.pictures import deformed_shaft, overview
from qsbearing.pictures.style import GREY, STYLE, figure_of_size, legend, plain
from qsbearing.readings.rating_life import MILLION, Life
from qsbearing.studies.cost import figures
from tests.guide.pages import blocks, run_page
from tests.systems.rotor_dynamics import spindle
from tests.verification.benchmarks.coordinate_drawing import coordinate_drawing
from tests.verification.benchmarks.friction_drawing import over_friction
from tests.verification.benchmarks.sector_drawing import bearing_sector

GUIDE = Path(qs.__file__).parent / "guide"


GROOVES = np.linspace(0.51, 0.54, 31)
COUNTS = np.arange(12, 18)


class LifePanel(NamedTuple):
    """One panel: a life along one case axis."""

    label: str
    """What varies, with its unit."""
    values: ArrayLike
    """Its values, as many as the life's cases."""
    life: Life
    is_count: bool = False
    """Whole numbers, between which there is nothing."""


def life_against(panels: Sequence[LifePanel]) -> Figure:
    """Reference life of the bearing and of each of its raceways, a panel for each thing that varies."""
    figure = figure_of_size(4.5 * len(panels), 3.6)
    all_axes = np.atleast_1d(figure.subplots(1, len(panels), sharey=True))
    for axes, panel in zip(all_axes, panels, strict=True):
        values = np.asarray(panel.values, float)
        for name, lives in (("inner", panel.life.inner_life), ("outer", panel.life.outer_life)):
            style = {key: STYLE[name][key] for key in ("color", "linestyle")}
            marker = {key: STYLE[name][key] for key in ("marker", "markerfacecolor") if key in STYLE[name]}
            dots = marker if panel.is_count else {}
            axes.plot(values, lives / MILLION, linewidth=1.4, label=f"{name} raceway alone", **style, **dots)
        both = panel.life.basic_reference_rating_life / MILLION
        axes.plot(values, both, color=GREY, linewidth=2.0, marker="." if panel.is_count else None, label="bearing")
        axes.set_xlabel(panel.label, fontsize=9)
        axes.set_ylim(bottom=0.0)
        plain(axes)
    all_axes[0].set_ylabel("reference rating life, million revolutions", fontsize=9)
    legend(figure, all_axes[0])
    return figure


def lives() -> list[LifePanel]:
    """B218's lives at 10 kN and 10 000 rpm against both groove radii and against the ball count."""
    scene = qs.load_scene("b218")
    scene = dataclasses.replace(scene, operation=qs.Operation(speed=10_000 * qs.rpm, axial_load=10 * qs.kN))
    radius = GROOVES * float(scene.bearing.ball_diameter)  # type: ignore[arg-type]
    grooves = dataclasses.replace(scene.bearing, inner_groove_radius=radius, outer_groove_radius=radius)
    counts = dataclasses.replace(scene.bearing, ball_count=COUNTS)
    found = [qs.readings.life(qs.solve(dataclasses.replace(scene, bearing=each))) for each in (grooves, counts)]
    return [
        LifePanel("groove radius over ball diameter, both raceways", GROOVES, found[0]),
        LifePanel("number of balls", COUNTS, found[1], is_count=True),
    ]


def deformed_spindle() -> Figure:
    """The spindle of the guide's page as it bends."""
    file = next(block.text for block in blocks(GUIDE / "spindle.md") if block.language == "toml")
    return deformed_shaft(qs.solve_set(set_of(tomllib.loads(file), "spindle.toml", "spindle")))


def span_of_pairs() -> Figure:
    """Stiffness at the spindle's tool against the distance of its pairs, for shafts of three diameters."""
    file = next(block.text for block in blocks(GUIDE / "spindle.md") if block.language == "toml")
    distances = np.linspace(50.0, 220.0, 35)
    figure = figure_of_size(5.2, 3.4)
    axes = figure.subplots()
    for diameter, style in ((50, "-"), (60, "--"), (70, ":")):
        tables = tomllib.loads(file)
        tables["shaft"]["sections"][1]["outer_diameter_mm"] = diameter
        of = set_of(tables, "spindle.toml")
        rear = (
            dataclasses.replace(row, position=(distances + at) * qs.mm)
            for at, row in zip((0, 20), of.rows[2:], strict=True)
        )
        found = qs.solve_set(dataclasses.replace(of, rows=(*of.rows[:2], *rear)))
        stiffness = found.points["tool"].effective_stiffness[:, 1] * qs.um
        axes.plot(distances, stiffness, style, color=STYLE["outer"]["color"], label=f"{diameter} mm")
        best = int(np.argmax(stiffness))
        axes.plot(distances[best], stiffness[best], "o", color=GREY, markersize=4)
    axes.set_xlabel("distance of the pairs, mm", fontsize=9)
    axes.set_ylabel("stiffness at the tool, N/µm", fontsize=9)
    axes.set_ylim(bottom=0.0)
    plain(axes)
    axes.legend(frameon=False, fontsize=9)
    return figure


def svg(figure: Figure) -> str:
    """A figure as SVG: no date and a fixed salt, so that the same picture is the same file."""
    file = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "qsbearing"}):
        figure.savefig(file, format="svg", metadata={"Date": None})
    return lean(file.getvalue())


def lean(text: str) -> str:
    """An SVG without comments and dates, its paths to 1/100 point."""
    text = re.sub(r"\n\s*", "\n", re.sub(r"<!--.*?-->\n?|<dc:date>.*?</dc:date>", "", text, flags=re.DOTALL))
    return re.sub(r' d="[^"]*"', lambda path: re.sub(r"(\.\d\d)\d+", r"\1", path[0]).replace("\n", " "), text)


def gallery() -> None:
    """Run the gallery's own commands and keep the pictures that they make."""
    with tempfile.TemporaryDirectory() as name, matplotlib.rc_context({"svg.hashsalt": "qsbearing"}):
        run_page(GUIDE / "gallery.md", Path(name), heavy=False)
        for path in Path(name).glob("*.svg"):
            (GUIDE / "gallery" / path.name).write_text(lean(path.read_text(encoding="utf-8")), encoding="utf-8")


def of_records() -> dict[str, Figure]:
    """What checks and cost runs have on record, by file name."""
    sector = records_store.read_all()["bearing_sector"]
    elements = cost_record.read()
    levels = json.loads((Path(figures.__file__).parent / "records" / "b218_combined.json").read_text(encoding="utf-8"))
    assert elements is not None
    return {
        "sector.svg": bearing_sector(sector),
        "element_cost.svg": cost_picture.draw(elements),
        "model_levels.svg": figures.speeds(levels),
    }


def main() -> None:
    """Draw and keep the pictures."""
    gallery()
    for name, figure in of_records().items():
        (GUIDE / name).write_text(svg(figure), encoding="utf-8")
    (GUIDE / "section.svg").write_text(svg(overview(qs.solve(qs.load_scene("b218")))), encoding="utf-8")
    (GUIDE / "coordinates.svg").write_text(svg(coordinate_drawing()), encoding="utf-8")
    (GUIDE / "spindle.svg").write_text(svg(spindle.picture(spindle.read())), encoding="utf-8")
    (GUIDE / "deformed_shaft.svg").write_text(svg(deformed_spindle()), encoding="utf-8")
    (GUIDE / "span.svg").write_text(svg(span_of_pairs()), encoding="utf-8")
    (GUIDE / "ball_axis.svg").write_text(svg(over_friction()), encoding="utf-8")
    (GUIDE / "b218_life.svg").write_text(svg(life_against(lives())), encoding="utf-8")


if __name__ == "__main__":
    main()
