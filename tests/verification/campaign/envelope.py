"""The envelopes by name: how each draws scenes, from (seed, chunk) alone, and how many it allows not to converge.

A chunk is made of groups. What one array call cannot vary (kind, effects, control, held channels, ...) is drawn by
group; everything else by scene. An envelope is a function that draws a group.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import numpy as np
from scipy.stats import poisson

from tests.verification.campaign import mounted, realistic, wild
from tests.verification.campaign.group import GROUP, Group

CHUNK = 1000
"""Scenes of a chunk."""

WHOLE = 1_000_000
"""Scenes from which the allowed rate is asked for as it stands."""

CHANCE = 0.05
"""A sample smaller than that may have as many scenes not converged as a solver that just keeps the rate exceeds in
this share of samples (Poisson): it has ceil(count rate) or fewer in only half of them."""


def allowed_of(count: int, rate: float) -> int:
    """How many of so many cases may end as not converged."""
    strict = ceil(count * rate)
    return strict if count >= WHOLE else max(strict, int(poisson.ppf(1.0 - CHANCE, count * rate)))


@dataclass(frozen=True)
class Envelope:
    """How scenes are drawn, and the share of them that may end as not converged."""

    draw_group: Callable[[np.random.Generator, int], Group]
    """From random numbers, and the group's number in the campaign."""
    rate: float
    basis: str
    """When the rate was set, and from what."""
    is_certified: bool = True
    """Whether each refusal needs a certificate, rather than each group a twin."""

    def allowed(self, count: int) -> int:
        """How many of so many scenes may end as not converged."""
        return allowed_of(count, self.rate)


ENVELOPES = {
    "wild": Envelope(wild.draw_group, rate=2e-4, basis="2026-11-23: the first million"),
    "realistic": Envelope(
        realistic.draw_group,
        rate=0.0,
        basis="2026-11-23: use, but for those named",
    ),
    "mounted": Envelope(
        mounted.draw_group,
        rate=3e-4,
        basis="2026-11-24: the first runs",
        is_certified=False,
    ),
}


def chunk_groups(seed: int, chunk: int, count: int = CHUNK, envelope: str = "wild") -> list[Group]:
    """The groups of a chunk; of a shorter one the same first scenes."""
    rng = np.random.default_rng([seed, chunk])
    groups = []
    for number in range(CHUNK // GROUP):
        group = ENVELOPES[envelope].draw_group(rng, chunk * (CHUNK // GROUP) + number)
        left = count - GROUP * number
        if left > 0:
            groups.append(group if left >= GROUP else group.part(slice(0, left)))
    return groups


def scene_file(envelope: str, seed: int, number: int, sentence: str = "") -> str:
    """One scene of a campaign as a scene file."""
    chunk, index = divmod(number, CHUNK)
    group = chunk_groups(seed, chunk, envelope=envelope)[index // GROUP]
    title = f"Campaign scene {scene_name(envelope, seed, number)}"
    return group.toml(index % GROUP, f"{title}: {sentence}" if sentence else f"{title}.")


def scene_name(envelope: str, seed: int, number: int) -> str:
    """By which a scene is found again: ENVELOPE/SEED/CHUNK/INDEX."""
    chunk, index = divmod(number, CHUNK)
    return f"{envelope}/{seed}/{chunk}/{index}"
