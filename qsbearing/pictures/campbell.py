"""Campbell diagram of a spindle: natural frequencies of its own rotor over the speed, and its critical speeds.

The rotor is that of ROSS (`SetSolution.to_ross_rotor`): the shaft's sections and masses on rows in their housings, each
with the stiffness that it has at each speed. This stiffness is that of the balance at each azimuth; what it is against
the frequency of the whirl (`stiffness_over_frequency`) is not used, for it is known only under thrust alone. Damping is
none.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.case_index import Index
from qsbearing.model.units import rpm
from qsbearing.pictures.style import CHANNEL_LINES, GREY, RED, figure_of_size, legend, name_of, plain, write_above
from qsbearing.systems.rotor_dynamics.natural_frequencies import NaturalFrequencies, natural_frequencies
from qsbearing.systems.sets.preload_limits import set_at_speed
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.solve import solve_set

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SPEEDS, POINTS = (0.02, 1.5), 25
"""Parts of the set's own speed, and how many."""
SHOWN = 3
"""Lateral modes of each direction."""
HERTZ = 2.0 * np.pi
LINES = {
    "forward": {"color": CHANNEL_LINES["axial"]["color"], "linestyle": "-"},
    "backward": {"color": "#0072b2", "linestyle": "--"},
    "axial": {"color": "#d55e00", "linestyle": "-."},
}


def campbell(solution: SetSolution, index: Index = None) -> Figure:
    """Natural frequencies of a set's shaft on its rows from rest to one and a half times its speed, the line on which
    the shaft turns as fast as a mode whirls, and the critical speeds, where that line meets a forward whirl.

    Args:
        solution: of a single case, at a speed.
        index: none, as it has no case axes.

    Raises:
        ValueError: several cases, a shaft that stands still, or none of low speed that has a solution.
        SceneError: the set has no shaft of its own.
        ImportError: ROSS is not installed.
    """
    if solution.shape or index is not None:
        raise ValueError("a Campbell diagram is of a single case: solve it by itself")
    own = abs(float(np.asarray(solution.set.operation.speed)))
    if own == 0.0:
        raise ValueError("a Campbell diagram goes over the speed, and this shaft stands still")
    speeds, swept = _over_speed(solution, own)
    rotor = swept.to_ross_rotor()
    return figure_of(natural_frequencies(rotor, speeds), own, name_of(solution.set))


def _over_speed(solution: SetSolution, own: float) -> tuple[NDArray, Any]:
    """Speeds up to the last before one without a solution, and the set at these."""
    of = replace(solution.set, readings={}, require=())
    speeds = own * np.linspace(*SPEEDS, POINTS)
    swept = solve_set(set_at_speed(of, speeds))
    lost = np.flatnonzero(~np.asarray(swept.converged))
    if lost.size == 0:
        return speeds, swept
    if lost[0] < 2:
        raise ValueError("the set has no solution at low speeds, from which a Campbell diagram begins")
    return speeds[: lost[0]], solve_set(set_at_speed(of, speeds[: lost[0]]))


def figure_of(modes: NaturalFrequencies, own: float, name: str) -> Figure:
    """The picture alone.

    Args:
        own: speed of the set [rad/s].
        name: of the set.
    """
    figure = figure_of_size(7.6, 4.6)
    axes: Any = figure.subplots()
    along = modes.speeds / rpm
    for kind, style in LINES.items():
        for number, mode in enumerate(getattr(modes, kind)[:, :SHOWN].T):
            label = {"label": f"{kind} whirl" if kind != "axial" else "axial"} if number == 0 else {}
            axes.plot(along, mode / HERTZ, linewidth=1.3, **style, **label)
    axes.plot(
        [0.0, along[-1]], [0.0, modes.speeds[-1] / HERTZ], color=GREY, linestyle=":", label="1× speed of the shaft"
    )
    axes.axvline(own / rpm, color=GREY, linewidth=0.8)
    axes.set_xlim(0.0, along[-1])
    axes.set_ylim(0.0, 1.15 * _highest(modes))
    critical = modes.critical_speeds
    for each in critical:
        axes.plot(each / rpm, each / HERTZ, "o", color=RED, markersize=6, zorder=3)
        is_last = each > 0.8 * modes.speeds[-1]
        axes.annotate(
            f"{each / rpm:,.0f} rpm", (each / rpm, each / HERTZ), (-4 if is_last else 4, -8), va="top", fontsize=9,
            textcoords="offset points", color=RED, ha="right" if is_last else "left",
        )  # fmt: skip
    axes.set_xlabel("speed of the shaft, rpm; grey line: as solved", fontsize=9)
    axes.set_ylabel("natural frequency, Hz", fontsize=9)
    axes.set_title(f"{_words(modes, critical)}\nundamped; rows with their stiffness at each speed", fontsize=10)
    plain(axes)
    legend(figure, axes)
    write_above(figure, f"Campbell diagram of {name}")
    return figure


def _highest(modes: NaturalFrequencies) -> float:
    """Up to the second lateral mode at least, and to the end of the line [Hz]."""
    lateral = np.concatenate([getattr(modes, kind)[:, :2].ravel() for kind in ("forward", "backward")])
    return max(float(np.nanmax(lateral, initial=0.0)), float(modes.speeds[-1])) / HERTZ


def _words(modes: NaturalFrequencies, critical: NDArray) -> str:
    top = f"{modes.speeds[-1] / rpm:,.0f} rpm"
    if critical.size:
        return f"critical speeds up to {top}: {', '.join(f'{each / rpm:,.0f}' for each in critical)} rpm"
    lowest = float(np.nanmin(modes.forward, initial=np.inf))
    return f"no critical speed up to {top}; lowest forward whirl {lowest / HERTZ:,.0f} Hz"
