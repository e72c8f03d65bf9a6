"""Contact ellipses side by side: pressure of the true bodies, Hertz's edge, and by how much each quantity differs."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fem_check.report.agreement import QUANTITIES, ContactAgreement
from fem_check.report.figures.style import COLOURS, PRESSURE, smoothed
from fem_check.rows.record import computed_value

WIDENED = 3.0
"""Width of the ellipses, which along rolling are slender, over their length's scale."""
LEVELS = np.array([0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.97, 1.1])
"""Of the pressure over its largest."""
POINTS = (31, 31)
"""That a map is drawn from: small in a file."""


def ellipses(contacts: Sequence[ContactAgreement]) -> Figure:
    """All contacts, from left to right; below each its differences from Hertz."""
    figure, grid = plt.subplots(
        2, len(contacts), figsize=(11.0, 4.6), layout="constrained", height_ratios=(3.0, 1.2), squeeze=False
    )
    longest = max(1e3 * each.true["semi_major_axis"]["reference"] for each in contacts)
    widest = max(abs(each.deviation(name)) for each in contacts for name in QUANTITIES)
    for axes, below, contact in zip(*grid, contacts, strict=True):
        _ellipse(axes, contact, longest)
        _bars(below, contact, 1.25 * widest)
        below.tick_params(labelleft=contact is contacts[0])
    grid[0, 0].tick_params(left=True, labelleft=True)
    grid[0, 0].set_ylabel("across the groove, mm")
    grid[1, 0].set_yticks(range(len(QUANTITIES)), [name.rpartition(" ")[2] for name, *_ in QUANTITIES.values()])
    figure.supxlabel("true bodies − Hertz, %", fontsize=9)
    return figure


def _ellipse(axes: Axes, contact: ContactAgreement, longest: float) -> None:
    """The half that is on record, mirrored; without a map the ellipse of its semi-axes."""
    a, b = (1e3 * contact.true[name]["reference"] for name in ("semi_major_axis", "semi_minor_axis"))
    angle = np.linspace(0.0, 2.0 * np.pi, 181)
    if contact.pressure:
        x, y, p = (np.asarray(contact.pressure[name]) for name in "xyp")
        x, y, p = np.tile(x, 2), np.concatenate([y, -y]), np.tile(p, 2)
        u, v, square = smoothed(y, x, p, 1.0, 1.0, POINTS)
        axes.contourf(WIDENED * b * u, a * v, square, LEVELS * np.abs(LEVELS), cmap=PRESSURE)
    else:
        width, length = (1e3 * computed_value(contact.true[name]) for name in ("semi_minor_axis", "semi_major_axis"))
        axes.fill(WIDENED * width * np.cos(angle), length * np.sin(angle), color="#d0e2f1")
    axes.plot(WIDENED * b * np.cos(angle), a * np.sin(angle), color=COLOURS[1], linewidth=1.2, linestyle="--")
    axes.set_aspect("equal")
    axes.set(xlim=(-0.52 * longest, 0.52 * longest), ylim=(-1.08 * longest, 1.08 * longest), xticks=[])
    axes.tick_params(left=False, labelleft=False)
    axes.set_title(f"{contact.race}, {contact.load:,.0f} N", fontsize=10)
    for side in axes.spines.values():
        side.set_visible(False)


def _bars(axes: Axes, contact: ContactAgreement, reach: float) -> None:
    for place, name in enumerate(QUANTITIES):
        doubt = contact.true[name]["uncertainty_percent"] or 0.0
        axes.barh(place, contact.deviation(name), 0.6, xerr=doubt, color=COLOURS[0], ecolor="black", capsize=2)
    axes.axvline(0.0, color="black", linewidth=0.8)
    axes.set(xlim=(-reach, reach), ylim=(len(QUANTITIES) - 0.5, -0.5))
    axes.tick_params(left=False, labelsize=8)
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
