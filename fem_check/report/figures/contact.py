"""One contact: its pressure."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from fem_check.report.figures.style import map_of
from fem_check.rows.record import Record


def pressure_map(entry: Record) -> Figure:
    """Pressure over the ellipse, with Hertz's outline."""
    contact = entry["pictures"]["contact"]
    x, y, p = (np.asarray(contact["ellipse"][name]) for name in "xyp")
    loaded = x**2 + y**2 < 1.15
    figure, axes = plt.subplots(figsize=(5.0, 2.4), layout="constrained")
    # One quarter is solved, of true bodies one half; the picture is mirrored in the planes of symmetry.
    every_x, every_y, every_p = [], [], []
    for sx in (1, -1) if x.min() >= 0.0 else (1,):
        for sy in (1, -1):
            every_x.append(sx * x[loaded])
            every_y.append(sy * y[loaded])
            every_p.append(p[loaded])
    u, v, w = (np.concatenate(parts) for parts in (every_x, every_y, every_p))
    _, first = np.unique(np.round(np.stack([u, v]), 6), axis=1, return_index=True)
    a, b = contact["a_mm"], contact["b_mm"]
    picture = map_of(axes, u[first] * a, v[first] * b, w[first] * contact["p0_MPa"], a, b)
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(a * np.cos(angle), b * np.sin(angle), color="black", linewidth=1.2, label="Hertz's edge")
    axes.legend(loc="upper right")
    figure.colorbar(picture, ax=axes, label="pressure, MPa", ticks=MaxNLocator(8))
    axes.set(xlabel="across the groove, mm", ylabel="along rolling, mm (stretched)", title=title(contact))
    return figure


def title(contact: dict[str, Any]) -> str:
    """What is shown."""
    return f"{contact['name']}, Q = {contact['load_N']:.0f} N ({contact['label']})"
