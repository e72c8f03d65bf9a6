"""How thoroughly to measure."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Settings:
    """Numbers of repeats and sizes of what is measured."""

    rounds: int = 10
    """In each process; each task once a round."""
    processes: int = 3
    """Fresh processes over which the rounds are spread."""
    batch: int = 100
    """Cases in the batches that the ladder is timed on."""
    sizes: tuple[int, ...] = (1, 10, 100, 1_000, 10_000, 100_000)
    """Cases in one call."""
    ball_counts: tuple[int, ...] = (4, 8, 16, 32, 64, 128, 256)
    shared: int = 20_000
    """Cases that are shared out to threads and processes."""


FULL = Settings()
QUICK = Settings(rounds=3, processes=1, batch=20, sizes=(1, 10, 100, 1_000), ball_counts=(4, 16, 64), shared=4_000)
"""For a look: a few seconds, with a spread that means little."""
