"""The pictures of README and guide: `python -m tests.benchmarks.guide_pictures`, in a second or two."""

from __future__ import annotations

import dataclasses
import io
import re
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

import qsbearing as qs
from qsbearing.pictures.life import LifePanel, life_against
from qsbearing.pictures.speed import against_speed

GUIDE = Path(qs.__file__).parent / "guide"
LOADS = (2.0, 8.0, 20.0)
"""Axial loads [kN]."""
SPEEDS = np.linspace(0.0, 15_000.0, 41) * qs.rpm


def speed_sweep() -> qs.Solution:
    """B218 under pure thrust over the speed, both ball effects, outer raceway control: shape (load, speed)."""
    operation = qs.Operation(speed=SPEEDS, axial_load=np.array(LOADS)[:, None] * qs.kN)
    return qs.solve(dataclasses.replace(qs.load_scene("b218"), operation=operation))


GROOVES = np.linspace(0.51, 0.54, 31)
COUNTS = np.arange(12, 18)


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


def svg(figure: Figure) -> str:
    """A figure as SVG: no date and a fixed salt, so that the same picture is the same file; paths to 1/100 point."""
    file = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "qsbearing"}):
        figure.savefig(file, format="svg", metadata={"Date": None})
    lean = re.sub(r"\n\s*", "\n", re.sub(r"<!--.*?-->\n?", "", file.getvalue()))
    return re.sub(r' d="[^"]*"', lambda path: re.sub(r"(\.\d\d)\d+", r"\1", path[0]).replace("\n", " "), lean)


def main() -> None:
    """Draw and keep the pictures."""
    figure = against_speed(speed_sweep(), [f"{load:g} kN" for load in LOADS])
    (GUIDE / "b218_speed.svg").write_text(svg(figure), encoding="utf-8")
    (GUIDE / "b218_life.svg").write_text(svg(life_against(lives())), encoding="utf-8")


if __name__ == "__main__":
    main()
