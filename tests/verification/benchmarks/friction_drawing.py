"""Displacement and stiffness of B218 over the friction coefficient, beside what hypotheses of raceway control say."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

import qsbearing as qs
from qsbearing.model.effects.hypotheses import other_controls
from qsbearing.pictures.style import GREY, STYLE, figure_of_size, plain

COEFFICIENTS = np.geomspace(0.02, 0.2, 46)
USUAL = (0.03, 0.1)


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
        axes.axvspan(*USUAL, color=GREY, alpha=0.15, linewidth=0.0)
        axes.semilogx(COEFFICIENTS, values, color=STYLE["outer"]["color"], linewidth=1.8)
        for under, each in others:
            level = float(getattr(each, name)[0] / size)
            axes.axhline(level, color=GREY, linestyle="--", linewidth=0.9)
            words = ", ".join(re.findall('"(.*?)"', under)).replace("_", " ") or under
            axes.annotate(words, (COEFFICIENTS[-1], level), fontsize=7, ha="right", va="bottom", color=GREY)
        axes.annotate("friction", (COEFFICIENTS[0], values[0]), fontsize=8, va="bottom", color=STYLE["outer"]["color"])
        axes.set_xlabel("friction coefficient of the contacts", fontsize=9)
        axes.set_ylabel(label, fontsize=9)
        axes.set_xticks([0.02, 0.03, 0.05, 0.07, 0.1, 0.2], ["0.02", "0.03", "0.05", "0.07", "0.1", "0.2"])
        axes.set_xticks([], minor=True)
        plain(axes)
    return figure
