"""The guide's drawing of axes, azimuth, tilts and contact angles."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle

INNER, OUTER, GREY = "#d55e00", "#0072b2", "0.45"
ANGLE_I, ANGLE_O = np.radians(48.0), np.radians(30.0)


def _arrow(axes: Any, start: tuple[float, float], end: tuple[float, float], colour: str = "black") -> None:
    style = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.2, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=style)


def _write(axes: Any, x: float, y: float, text: str, colour: str = "black", **where: Any) -> None:
    axes.text(x, y, text, color=colour, fontsize=9, **({"ha": "center", "va": "center"} | where))


def _from_the_side_of_x(axes: Any) -> None:
    """All balls, looking against +x: y upwards, z to the left, so that the azimuth turns as the eye expects."""
    axes.add_patch(Circle((0, 0), 1.0, fill=False, color=GREY, linestyle=":", linewidth=0.8))
    for number in range(12):
        psi = 2 * np.pi * number / 12
        marked = number == 2
        at = (-np.sin(psi), np.cos(psi))
        axes.add_patch(Circle(at, 0.19, facecolor="0.8" if marked else "white", edgecolor="black", linewidth=0.9))
    _arrow(axes, (0, 0), (0, 1.45))
    _arrow(axes, (0, 0), (-1.45, 0))
    axes.plot([0, -0.78 * np.sin(np.pi / 3)], [0, 0.78 * np.cos(np.pi / 3)], color="black", linewidth=0.8)
    axes.add_patch(Arc((0, 0), 1.0, 1.0, theta1=90, theta2=150, linewidth=0.9))
    _arrow(axes, (-0.42, 0.27), (-0.44, 0.24))
    axes.add_patch(Circle((0, 0), 0.06, fill=True, facecolor="white", edgecolor="black"))
    axes.plot([0], [0], "k.", markersize=3)
    _write(axes, 0.1, 1.45, "y", ha="left")
    _write(axes, -1.45, -0.14, "z")
    _write(axes, 0.14, -0.14, "x", ha="left")
    _write(axes, -0.31, 0.58, "ψ")
    # Tilts: right-handed about y and about z.
    axes.add_patch(Arc((0, 1.32), 0.34, 0.13, theta1=200, theta2=520, linewidth=1.0, color=OUTER))
    _arrow(axes, (0.10, 1.27), (0.145, 1.285), OUTER)
    _write(axes, 0.28, 1.22, "tilt y", OUTER, ha="left")
    axes.add_patch(Arc((-1.32, 0), 0.13, 0.34, theta1=-70, theta2=250, linewidth=1.0, color=OUTER))
    _arrow(axes, (-1.285, 0.125), (-1.30, 0.155), OUTER)
    _write(axes, -1.40, 0.30, "tilt z", OUTER)
    # The inner ring turns from y to z.
    axes.add_patch(Arc((0, 0), 1.35, 1.35, theta1=-70, theta2=-15, linewidth=1.0, color=INNER))
    _arrow(axes, (0.652, -0.19), (0.664, -0.12), INNER)
    _write(axes, 0.36, -0.36, "ω", INNER)
    axes.set(xlim=(-1.65, 1.4), ylim=(-1.3, 1.65), aspect="equal")
    axes.set_title("looking against +x", fontsize=9)
    axes.axis("off")


def _section(axes: Any) -> None:
    """One ball at speed between its grooves, x to the right, the radius upwards."""
    radius = 1.0
    inner = np.array([np.sin(ANGLE_I), np.cos(ANGLE_I)])
    outer = np.array([np.sin(ANGLE_O), np.cos(ANGLE_O)])
    axes.add_patch(Circle((0, 0), radius, facecolor="0.93", edgecolor="black", linewidth=1.0))
    groove = 1.12
    for direction, colour, low, high in ((-inner, INNER, 195, 268), (outer, OUTER, 18, 92)):
        centre = direction * (radius - groove)
        axes.add_patch(Arc(centre, 2 * groove, 2 * groove, theta1=low, theta2=high, color=colour, linewidth=2.2))
    axes.plot([0, 0], [-1.62, 1.62], color=GREY, linestyle="-.", linewidth=0.8)
    _write(axes, -0.06, 1.72, "radial plane", GREY)
    for direction, colour, name in ((-inner, INNER, "Qi"), (outer, OUTER, "Qo")):
        axes.plot([0, direction[0]], [0, direction[1]], color=colour, linewidth=1.0)
        tip, tail = direction * 1.02, direction * 1.62
        _arrow(axes, tuple(tail), tuple(tip), colour)
        _write(axes, *(direction * 1.78), name, colour)
    axes.add_patch(Arc((0, 0), 0.9, 0.9, theta1=90 - np.degrees(ANGLE_O), theta2=90, color=OUTER))
    axes.add_patch(Arc((0, 0), 0.9, 0.9, theta1=270 - np.degrees(ANGLE_I), theta2=270, color=INNER))
    _write(axes, 0.17, 0.60, "αo", OUTER)
    _write(axes, -0.27, -0.58, "αi", INNER)
    _arrow(axes, (0, 0), (0, 0.83), "black")
    _write(axes, -0.19, 0.66, "Fc")
    # The axis of the ball's own rotation: axially against x, radially outwards.
    beta = np.radians(22.0)
    spin = np.array([-np.cos(beta), np.sin(beta)])
    _arrow(axes, tuple(-0.30 * spin), tuple(1.02 * spin), "0.25")
    _write(axes, -0.98, 0.60, "axis of the\nball's rotation", "0.25", ha="right")
    _write(axes, -1.05, -0.28, "inner\nring", INNER, ha="right")
    _write(axes, 1.06, 0.42, "outer\nring", OUTER, ha="left")
    _arrow(axes, (-1.9, -1.75), (-1.15, -1.75), INNER)
    _write(axes, -1.02, -1.75, "Fx of the shaft", INNER, ha="left")
    _arrow(axes, (0.75, -1.75), (1.55, -1.75))
    _write(axes, 1.68, -1.75, "x")
    axes.set(xlim=(-2.0, 2.0), ylim=(-1.95, 1.95), aspect="equal")
    axes.set_title("a ball at speed, in its own plane", fontsize=9)
    axes.axis("off")


def coordinate_drawing() -> Figure:
    """Both views beside each other."""
    figure = Figure(figsize=(8.0, 3.9), dpi=150, layout="constrained")
    left, right = figure.subplots(1, 2)
    _from_the_side_of_x(left)
    _section(right)
    return figure
