"""Contact angles and contact loads against the speed of the inner ring."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from qsbearing.pictures.style import GREY, STYLE, figure_of_size, legend, plain, raceways
from qsbearing.solution import Solution
from qsbearing.units import deg, rpm

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def against_speed(solution: Solution, labels: Sequence[str] = (), ball: int = 0) -> Figure:
    """Inner and outer contact angle and load of one ball against speed, in two panels.

    Args:
        solution: its last case axis runs over the speed; a first axis, if there is one, gives a curve each.
        labels: name of each curve, written on it.
        ball: index of the ball shown; under pure thrust all are alike.

    A contact without load has no angle to show, and a case that did not converge leaves a gap in its curves.

    Raises:
        ValueError: no speeds along the last of one or two case axes, or not as many labels as curves.
    """
    speed = np.atleast_2d(np.broadcast_to(solution.scene.operation.speed, solution.shape)) / rpm
    if len(solution.shape) not in (1, 2) or not np.ptp(speed, axis=-1).all():
        raise ValueError(f"a solution of shape {solution.shape}: needs speeds along the last of one or two case axes")
    if labels and len(labels) != len(speed):
        raise ValueError(f"{len(labels)} labels for {len(speed)} curves")
    figure = figure_of_size(9.0, 3.9)
    panels = figure.subplots(1, 2)
    angles, loads = [], []
    for name, contacts in raceways(solution):
        load = np.atleast_2d(contacts.load[..., ball])
        loads.append(load)
        angles.append(np.where(load > 0.0, np.atleast_2d(contacts.angle[..., ball]) / deg, np.nan))
        line = {key: STYLE[name][key] for key in ("color", "linestyle")}
        for axes, values in zip(panels, (angles[-1], load), strict=True):
            axes.plot(speed.T, values.T, linewidth=1.4, **line)
            axes.plot([], [], label=f"{name} raceway", **line)
    for axes, curves, title in zip(panels, (angles, loads), ("contact angle, deg", "contact load, N"), strict=True):
        axes.set_xlabel("speed of the inner ring, rpm", fontsize=9)
        axes.set_ylabel(title, fontsize=9)
        axes.set_xlim(float(speed.min()), float(speed.max()))
        axes.set_ylim(bottom=min(0.0, float(np.nanmin(curves))))
        plain(axes)
        if labels:
            _label_curves(axes, np.concatenate([speed, speed]), np.concatenate(curves), [*labels, *labels])
    legend(figure, panels[0])
    return figure


def _label_curves(axes: Axes, speed: NDArray, curves: NDArray, labels: Sequence[str]) -> None:
    """Write each label on its curve, where the nearest other curve is farthest away."""
    inside = np.ones(curves.shape[1], dtype=bool)
    margin = max(1, curves.shape[1] // 12)
    inside[:margin] = inside[-margin:] = False
    for index, label in enumerate(labels):
        others = np.abs(np.delete(curves, index, axis=0) - curves[index])
        gap = np.nanmin(others, axis=0, initial=np.inf)
        at = int(np.argmax(np.where(inside & np.isfinite(curves[index]), gap, -1.0)))
        box = {"facecolor": "white", "edgecolor": "none", "pad": 0.8}
        axes.text(
            speed[index, at], curves[index, at], label, fontsize=8, ha="center", va="center", color=GREY, bbox=box
        )
