"""Pictures of the report: their texts are large enough to read, and smoothing keeps Hertz's own pressure."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import matplotlib.pyplot as plt
from matplotlib.text import Text

from fem_check.report import evidence
from fem_check.report.agreement import contacts_of
from fem_check.report.figures import drawn
from fem_check.report.figures.ellipses import ellipses
from fem_check.report.figures.style import INCHES, smoothed

SMALLEST = 8.0
"""Of the numbers at axes [pt], a figure being `INCHES` wide at most."""


def test_every_text_can_be_read() -> None:
    checks = evidence.read().checks
    figures = {name: drawn.drawing_of(kept.data).draw(kept.data) for name, kept in checks.items()}
    figures["agreement"] = ellipses(contacts_of(checks["true_geometry"].data))
    for name, figure in figures.items():
        texts = [text for text in figure.findobj(Text) if text.get_text().strip()]  # type: ignore[attr-defined]
        assert min(text.get_fontsize() for text in texts) >= SMALLEST, name
        assert figure.get_size_inches()[0] <= INCHES
    plt.close("all")


def test_boxes_of_all_sizes_lie_on_a_line_to_the_value_without_end() -> None:
    """As the caption says, and in one unit."""
    (axes,) = drawn.DRAWN["body_size"].draw(evidence.read().checks["body_size"].data).axes
    boxes, without_end, far_field, _ = (np.asarray(line.get_xydata()) for line in axes.get_lines())
    _, at_zero = np.polyfit(*boxes.T, 1)
    assert at_zero == pytest.approx(without_end[0, 1], rel=2e-4)
    assert at_zero == pytest.approx(far_field[0, 1], rel=2e-4)
    plt.close("all")


@pytest.mark.parametrize("count", [15, 21])
def test_smoothing_keeps_hertz_s_pressure(count: int) -> None:
    """Its square is a polynomial: it comes back at every point of the grid, with few points and with many."""
    a, b = 2.0, 0.3
    x, y = (each.ravel() for each in np.meshgrid(a * np.linspace(-1, 1, count), b * np.linspace(-1, 1, count)))
    inside = 1.0 - (x / a) ** 2 - (y / b) ** 2
    pressure = 1.5e9 * np.sqrt(np.clip(inside, 0.0, None))
    u, v, square = smoothed(x, y, pressure, a, b, (11, 9))
    near = u**2 + v**2 < 1.25
    np.testing.assert_allclose(square[near], (1.0 - u**2 - v**2)[near], atol=1e-9)
    assert (square[~near] == 0.0).all() and (~near).any()
