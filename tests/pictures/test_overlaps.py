"""No text of a picture lies on another, or leaves it, at the size it has, somewhat smaller and far larger."""

from __future__ import annotations

import itertools
import tomllib
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.systems.rotor_dynamics.natural_frequencies import NaturalFrequencies
from tests.guide.pages import GUIDE, blocks

pytest.importorskip("matplotlib")
from matplotlib.text import Text

from qsbearing import pictures
from qsbearing.pictures.campbell import figure_of
from qsbearing.reports import curves, over_speed, set_curves

SIZES = (0.8, 1.0, 1.5)
"""Parts of the size that a picture has; letters keep theirs."""
FILES = {
    "bearing": ("ten_minutes", "my.toml"),
    "elastic rings": ("elastic_rings", "free.toml"),
    "pair": ("sets", "pair.toml"),
    "spindle": ("spindle", "spindle.toml"),
}
EDGE = 1.0
"""By how much letters may touch [points]: boxes of text have room for letters that it does not have."""


@cache
def solved(name: str) -> Any:
    page, file = FILES[name]
    texts = [each.text for each in blocks(GUIDE / f"{page}.md") if each.language == "toml"]
    parts = [text for text in texts if text.startswith(f"# {file}") or (file == "my.toml" and text == texts[0])]
    return solve_any(scene_or_set_of(tomllib.loads("".join(parts)), file, file))


def of_speed(name: str) -> Any:
    solution = solved(name)
    swept = curves.over_speed(solution) if isinstance(solution, qs.Solution) else set_curves.over_speed(solution.set)
    assert swept is not None
    return over_speed.figure_of(swept, [])


DRAWN: dict[str, Callable[[], Any]] = {
    **{f"{name} under load": lambda name=name: pictures.under_load(solved(name)) for name in FILES},  # type: ignore[misc]
    **{f"{name} over speed": lambda name=name: of_speed(name) for name in FILES if name != "elastic rings"},  # type: ignore[misc]
    **{f"sheet of the {name}": lambda name=name: pictures.overview(solved(name)) for name in FILES},  # type: ignore[misc]
    "section": lambda: pictures.section(solved("bearing")),
    "loads": lambda: pictures.load_distribution(solved("bearing")),
    "angles": lambda: pictures.contact_angles(solved("bearing")),
    "ellipses": lambda: pictures.contact_ellipses(solved("bearing")),
    "angles of rows": lambda: pictures.contact_angles(solved("spindle")),
    "loads of rows": lambda: pictures.load_distribution(solved("spindle")),
    "bent shaft": lambda: pictures.deformed_shaft(solved("spindle")),
    "grooves": lambda: pictures.ring_shape(solved("elastic rings")),
    **{
        f"ellipses on grooves of the {name}": lambda name=name: pictures.ellipse_on_groove(solved(name))
        for name in FILES
    },  # type: ignore[misc]
}
DRAWN |= {
    f"campbell, {name}": lambda shift=shift: of_whirls(shift) for name, shift in (("critical", 0.3), ("none", 9.0))
}  # type: ignore[misc]


def of_whirls(shift: float) -> Any:
    """Of a rotor whose modes part with the speed, with a critical speed or without."""
    speeds = np.linspace(20.0, 1900.0, 25)
    modes = np.array([1500.0, 5200.0]) * (shift + 0.7)
    parting = 0.25 * speeds[:, None]
    found = NaturalFrequencies(speeds, modes + parting, modes - parting, np.full((25, 1), 4200.0))
    return figure_of(found, 1256.0, "spindle, +x -x +x -x")


def texts_of(figure: Any) -> list[Text]:
    """Those that are seen: no label of a tick beyond the ends of its axis, nothing of axes that are off."""
    hidden = set()
    for axes in figure.axes:
        for axis in axes._axis_map.values():
            low, high = sorted(axis.get_view_interval())
            for tick in axis.get_major_ticks():
                if not (axes.axison and low - 1e-9 <= tick.get_loc() <= high + 1e-9):
                    hidden |= {id(tick.label1), id(tick.label2)}
            hidden |= set() if axes.axison else {id(axis.label)}
    every = (each for each in figure.findobj(Text) if each.get_visible() and each.get_text().strip())
    return [each for each in every if id(each) not in hidden]


def overlaps(figure: Any) -> list[tuple[str, str]]:
    """Pairs of texts that lie on each other, and texts that leave the picture."""
    figure.draw_without_rendering()
    edge = EDGE * figure.dpi / 72.0
    boxes = [(each.get_text(), each.get_window_extent()) for each in texts_of(figure)]
    width, height = figure.bbox.width, figure.bbox.height
    found = [
        (name, "edge")
        for name, box in boxes
        if box.x0 < -edge or box.y0 < -edge or box.x1 > width + edge or box.y1 > height + edge
    ]
    for (one, a), (other, b) in itertools.combinations(boxes, 2):
        if min(a.x1, b.x1) - max(a.x0, b.x0) > edge and min(a.y1, b.y1) - max(a.y0, b.y0) > edge:
            found.append((one, other))
    return found


@pytest.mark.parametrize("name", DRAWN)
def test_no_text_lies_on_another(name: str) -> None:
    figure = DRAWN[name]()
    width, height = figure.get_size_inches()
    for size in SIZES:
        figure.set_size_inches(size * width, size * height)
        assert overlaps(figure) == [], f"at {size:g} of its size"


def test_what_lies_on_another_is_seen() -> None:
    figure = DRAWN["angles"]()
    box = figure.axes[0].title.get_position()
    figure.axes[0].text(*box, "on the title", transform=figure.axes[0].transAxes, ha="center")
    assert overlaps(figure)
