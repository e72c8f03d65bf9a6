"""Ready pictures of a bearing around its operating point: stiffness over speed and load, preload over temperature."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import RingExpansion
from qsbearing.model.operation import CHANNELS, Operation
from qsbearing.model.scene.preload import FORCES, Preload
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.preload_state import EXCESSIVE
from qsbearing.model.solution.solver import solve
from qsbearing.model.units import rpm, um, zero_celsius
from qsbearing.pictures.study.contours import contour_lines
from qsbearing.pictures.style import GREY, RED, figure_of_size, name_of, plain, write_above

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POINTS = 25
"""Along each axis."""
SPEEDS, LOADS = (0.1, 1.5), (0.25, 1.75)
"""Parts of the scene's own speed and loads."""
LEVELS = 9
WARMER = (-10.0, 40.0)
"""From which to which temperature of the inner ring, over that of the scene [K]."""


def loaded(scene: Scene, parts: NDArray) -> Scene | None:
    """The scene with its loads, a preload by force among them, times these parts; None if it has none."""
    loads: dict[str, Any] = {}
    for channel in CHANNELS:
        value = getattr(scene.operation, channel.load)
        if value is not None and float(value) != 0.0:
            loads[channel.load] = float(value) * parts
    operation: Operation = replace(scene.operation, **loads)
    preload: Preload | None = scene.preload
    if preload is not None:
        forces = {kind: getattr(preload, kind) for kind in FORCES}
        given = {kind: float(value) * parts for kind, value in forces.items() if value is not None}
        loads |= given
        preload = replace(preload, **given)
    return replace(scene, operation=operation, preload=preload) if loads else None


def stiffness_map(scene: Scene) -> Figure:
    """Locked stiffness along and across the axis over the speed and all loads in proportion, from a tenth of the
    scene's speed to one and a half times it, and from a quarter of its loads to one and three quarters.

    Args:
        scene: of a single case that turns and is loaded.

    Raises:
        ValueError: it stands still, or nothing loads it.
    """
    from matplotlib.ticker import MaxNLocator

    own = float(np.asarray(scene.operation.speed))
    parts = np.linspace(*LOADS, POINTS)
    varied = loaded(scene, parts[:, None])
    if own == 0.0 or varied is None:
        raise ValueError("a map over speed and load needs a scene that turns and is loaded")
    speeds = own * np.linspace(*SPEEDS, POINTS)
    solution = solve(replace(varied, operation=replace(varied.operation, speed=speeds[None, :])))
    figure = figure_of_size(9.0, 3.6)
    for channel, axes in enumerate(figure.subplots(1, 2)):
        values = np.where(solution.converged, solution.locked_stiffness[..., channel] * um, np.nan)
        shown = np.ma.masked_invalid(values)
        if shown.count() and shown.max() > shown.min():
            levels = list(map(float, MaxNLocator(LEVELS).tick_values(float(shown.min()), float(shown.max()))))
            axes.contourf(speeds / rpm, parts, shown, levels, cmap="Blues")
            contour_lines(axes, speeds / rpm, parts, shown, levels[1:-1])
        axes.plot(own / rpm, 1.0, "o", color="black", markersize=5)
        axes.set_title(f"{CHANNELS[channel].label} locked stiffness, N/µm", fontsize=10)
        axes.set_xlabel("inner ring, rpm", fontsize=9)
        axes.set_ylabel("load factor (1 = this case)", fontsize=9)
        axes.locator_params(axis="x", nbins=5)
        axes.tick_params(labelsize=8)
    write_above(figure, name_of(scene))
    return figure


def preload_over_temperature(scene: Scene) -> Figure:
    """Preload in operation, without external loads, over the temperature of the inner ring; all else as it is.

    Args:
        scene: of a single case, with a preload by force or displacement and with the expansion of its rings.

    Raises:
        ValueError: it has no preload, or no expansion of the rings.
    """
    rings = scene.ring_expansion
    if scene.preload is None or scene.preload.kind == "spring" or rings is None:
        raise ValueError("preload over temperature needs a preload, other than a spring, and [effects.ring_expansion]")
    warmer = np.linspace(*WARMER, POINTS)
    given = rings.inner_ring_temperature
    own = float(np.asarray(rings.reference_temperature if given is None else given))
    varied = replace(rings, inner_ring_temperature=own + warmer)
    effects = tuple(varied if isinstance(each, RingExpansion) else each for each in scene.ring_effects)
    solution = solve(replace(scene, ring_effects=effects))
    assert solution.preload_loads is not None
    stated, alone, _ = solution.preload_loads.arrays
    figure = figure_of_size(5.6, 3.4)
    axes = figure.subplots()
    along = own + warmer - zero_celsius
    axes.plot(along, np.where(solution.converged, alone, np.nan), color="black", linewidth=1.4)
    most = EXCESSIVE * float(np.max(stated))
    if most > 0.0:
        axes.axhline(most, color=RED, linewidth=1.0, linestyle=(0, (4, 3)))
        words = f"{EXCESSIVE:g} times what is given"
        axes.annotate(words, (along[0], most), (2, 3), textcoords="offset points", fontsize=8, color=RED)
    axes.axvline(own - zero_celsius, color=GREY, linewidth=0.8, linestyle=":")
    axes.set_ylim(bottom=0.0)
    axes.set_title("preload in operation, N", fontsize=10)
    axes.set_xlabel("temperature of the inner ring, °C", fontsize=9)
    plain(axes)
    write_above(figure, name_of(scene))
    return figure
