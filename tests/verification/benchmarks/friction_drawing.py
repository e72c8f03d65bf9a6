"""Displacement and stiffness of B218 over the friction coefficient, beside what hypotheses of raceway control say."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import qsbearing as qs
from qsbearing.model.effects.hypotheses import other_controls
from qsbearing.pictures.style import GREY, STYLE, figure_of_size, plain
from qsbearing.studies.chooser import by_friction

COEFFICIENTS = np.geomspace(0.02, 0.2, 46)


def levels(others: list[tuple[str, Any]], read: Callable[[Any], Any]) -> dict[float, list[str]]:
    """Of hypotheses by their names: those that say the same stand at one level; of how they share a moment that one
    raceway carries whole, nothing is said."""
    at: dict[float, list[str]] = {}
    for under, each in others:
        control, *shares = re.findall('"(.*?)"', under) or [under]
        level = round(float(read(each)), 6)
        words = control.replace("_", " ")
        of_level = at.setdefault(level, [])
        if words not in of_level:
            of_level.append(", ".join([words, *shares]) if shares and control not in ("outer", "per_ball") else words)
    return at


def over_friction() -> Figure:
    """Both, as lines over the coefficient; hypotheses as levels, the usual coefficients as a band."""
    scene = qs.load_scene("b218")
    law = qs.Traction(COEFFICIENTS, radial_points=32, points_around=80)
    moved = qs.solve(replace(scene, raceway_control="friction", traction=law))
    others = [("outer", qs.solve(scene)), *((each.under, qs.solve(each.of)) for each in other_controls(scene))]
    figure = figure_of_size(9.0, 3.8)
    panels = figure.subplots(1, 2)
    for axes, name, label, size in zip(
        panels, ("displacement", "locked_stiffness"), ("axial displacement, µm", "axial stiffness, N/µm"),
        (qs.um, 1.0 / qs.um), strict=True,
    ):  # fmt: skip
        values = getattr(moved, name)[:, 0] / size
        axes.axvspan(*by_friction.USUAL, color=GREY, alpha=0.15, linewidth=0.0)
        axes.semilogx(COEFFICIENTS, values, color=STYLE["outer"]["color"], linewidth=1.8)
        for level, names in levels(others, lambda each, name=name, size=size: getattr(each, name)[0] / size).items():
            axes.axhline(level, color=GREY, linestyle="--", linewidth=0.9)
            style = {"fontsize": 7, "ha": "right", "va": "bottom", "color": GREY}
            axes.annotate("; ".join(names), (COEFFICIENTS[-1], level), **style)
        style = {"fontsize": 8, "ha": "right", "va": "top", "color": STYLE["outer"]["color"]}
        axes.annotate("friction", (COEFFICIENTS[-1], values[-1]), (0, -2 if name == "displacement" else 12),
                      textcoords="offset points", **style)  # fmt: skip
        axes.set_xlabel("friction coefficient of the contacts", fontsize=9)
        axes.set_ylabel(label, fontsize=9)
        axes.set_xticks([0.02, 0.03, 0.05, 0.07, 0.1, 0.2], ["0.02", "0.03", "0.05", "0.07", "0.1", "0.2"])
        axes.set_xticks([], minor=True)
        plain(axes)
    return figure
