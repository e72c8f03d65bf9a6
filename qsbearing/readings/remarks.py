"""What a reading adds to its numbers in words: where they leave the range of their source, and what was assumed."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from qsbearing.model.ranked_warning import in_order, said_of

CHOICES = "readings#choices-that-change-the-numbers"
"""Where the guide says more of most of them."""
Remarks = tuple[str, ...]


def remarks(found: Iterable[tuple[Any, str]], shape: tuple[int, ...]) -> Remarks:
    """The sentences that hold in some case, each with the cases that it holds in.

    Args:
        found: (where it holds, the sentence with its rank); the first broadcasts to the case axes.
        shape: the case axes of the solution; none for a single case.
    """
    said: list[str] = []
    for where, sentence in found:
        marked = np.broadcast_to(np.asarray(where, bool), shape)
        if not marked.any():
            continue
        if not shape:
            said.append(sentence)
            continue
        first = tuple(int(i) for i in np.argwhere(marked)[0])
        name = first[0] if len(first) == 1 else first
        said.append(said_of(f"{np.count_nonzero(marked)} of {marked.size} cases, the first {name}", sentence))
    return tuple(in_order(said))
