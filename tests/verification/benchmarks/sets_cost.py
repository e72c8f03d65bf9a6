"""What a case of a set costs beside its rows alone: `python -m tests.verification.benchmarks.sets_cost` prints the
guide's table.

Each row alone is solved under the load that the set gives it, and held at the displacement that the set gives it.
Processor time of one core, the best of several runs of 1000 random cases.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

import qsbearing as qs
from qsbearing.model.operation import CHANNELS
from tests.qsbearing.scenes import BOTH, OUTER
from tests.systems.sets.arrangements import rows, solved

CASES, RUNS = 1000, 5


def best(work: Callable[[], object]) -> float:
    """Processor time of the fastest run, in microseconds a case."""
    times = []
    for _ in range(RUNS):
        began = time.process_time()
        work()
        times.append(time.process_time() - began)
    return min(times) / CASES * 1e6


def sample(arrangement: str, is_turning: bool, loaded: int) -> qs.BearingSet:
    """Random cases: thrust, with a radial load, or with both radial loads and moments."""
    generator = np.random.default_rng(1)

    def random(low: float, high: float) -> np.ndarray:
        return generator.uniform(low, high, CASES)

    loads = {"axial_load": random(-150.0, 300.0)}
    if loaded > 0:
        loads |= {"radial_load_y": random(50.0, 400.0), "moment_z": random(-2.0, 2.0)}
    if loaded > 1:
        loads |= {"radial_load_z": random(50.0, 400.0), "moment_y": random(-2.0, 2.0)}
    effects = {"ball_effects": BOTH, "raceway_control": OUTER} if is_turning else {}
    speed = random(3_000.0, 15_000.0) * qs.rpm if is_turning else 0.0
    return qs.BearingSet(rows(arrangement), qs.Operation(speed, **loads), qs.Preload(rigid=700.0), **effects)  # type: ignore[arg-type]


def cost(of: qs.BearingSet) -> tuple[float, float, float]:
    """(the set, its rows alone under their loads, its rows alone at their displacements)."""
    found = solved(of)
    loaded = []
    for row in found.rows:
        loads = {channel.load: row.load[..., i] for i, channel in enumerate(CHANNELS)}
        loaded.append(replace(row.scene, operation=qs.Operation(row.scene.operation.speed, **loads)))
    alone = [
        sum(best(lambda scene=scene: qs.solve(scene, threads=1)) for scene in scenes)  # type: ignore[misc]
        for scenes in (loaded, [row.scene for row in found.rows])
    ]
    return best(lambda: qs.solve_set(of, threads=1)), alone[0], alone[1]


def main() -> None:
    """Print the table."""
    print("| set | load | the set, µs | rows loaded | rows held | ratio |\n|---|---|---|---|---|---|")
    for arrangement in ("DB", "QBC"):
        for is_turning in (False, True):
            for loaded, name in enumerate(("thrust", "and a radial load", "and all others")):
                whole, alone, held = cost(sample(arrangement, is_turning, loaded))
                what = f"{arrangement}, {'at speed' if is_turning else 'at rest'}"
                print(f"| {what} | {name} | {whole:.1f} | {alone:.1f} | {held:.1f} | {whole / alone:.1f} |")


if __name__ == "__main__":
    main()
