"""What gives way where a load acts on a shaft: which part each row, the shaft and each seat has in the deflection."""

from __future__ import annotations

import numpy as np

from qsbearing.documents.model import Block, Paragraph, Section, Shares
from qsbearing.documents.numbers import plain
from qsbearing.model.operation import CHANNELS
from qsbearing.model.units import um
from qsbearing.systems.sets.set_solution import SetSolution

RADIAL = (1, 2)
LEAST = 0.005
"""Parts below it are put together."""
REST = "others"


def what_yields(solution: SetSolution) -> Section | None:
    """At the first point of the shaft that is named, in the direction across it in which it moves most; None without
    one."""
    name, point = next(iter(solution.points.items()), ("", None))
    if point is None:
        return None
    moved = np.abs(point.displacement)
    channel = max(RADIAL, key=lambda each: float(moved[each]))
    shares = {part: float(of_channels[channel]) for part, of_channels in point.relative_shares.items()}
    if not all(np.isfinite(each) for each in shares.values()):
        return None
    parts = sorted(((part, each) for part, each in shares.items() if each >= LEAST), key=lambda each: -each[1])
    rest = 1.0 - sum(each for _, each in parts)
    parts += [(REST, rest)] if rest >= LEAST else []
    stiffness = plain(float(point.effective_stiffness[channel]) * um, ".3g")
    said = f"{CHANNELS[channel].label}: {stiffness} N/µm. Parts of what it moves under a load there."
    blocks: list[Block] = [Shares(parts), Paragraph(said, is_small=True)]
    return Section(f"What gives way at the {name}", blocks, "gives-way")
