"""What the usual points of a contact leave of errors, in random thrust cases: `python -m
tests.verification.benchmarks.friction_points` measures and keeps the record, two minutes.

Cases are those of `tests/verification/campaign/friction.py` under thrust, with Coulomb's law and at speed: others have
no error, or none that says anything. Each is solved with the usual points and with `FINE` ones; errors are counted as
`qsbearing.model.solution.comparison` does, displacements and loads relative to sizes that do not vanish. Cases are told
apart by the gyroscopic margin, below which balls creep or slip: there slips turn round within the ellipse.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from math import ceil, floor, log10
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects.traction import ANGLES, RADII, Traction, TractionLaw
from qsbearing.model.solution.comparison import errors, read
from qsbearing.model.solution.point_errors import CREEPING
from qsbearing.results import provenance
from tests.verification.campaign.friction import draw

RECORD = Path(__file__).with_suffix(".json")
CASES, BATCH, SEED = 2000, 200, 64
FINE = (64, 160)
QUANTITIES = {
    "displacement": ("axial_displacement",),
    "contact loads": ("inner_load", "outer_load"),
    "axial stiffness": ("axial_stiffness",),
    "radial stiffness": ("radial_stiffness",),
}
PARTS = {"median": 0.5, "in_95_of_100": 0.95, "largest": 1.0}
BOTH = (qs.CentrifugalForce(), qs.GyroscopicMoment())


def batch(number: int) -> tuple[qs.Scene, Traction]:
    """Of these scenes, and their law."""
    return draw(np.random.default_rng([SEED, number]), False, BATCH)


def batches() -> Iterator[tuple[int, qs.Scene, Traction]]:
    """Those under Coulomb's law, without end."""
    number = 0
    while True:
        scene, law = batch(number)
        if law.law is TractionLaw.COULOMB:
            yield number, scene, law
        number += 1


def found(scene: qs.Scene, law: Traction, points: tuple[int, int]) -> qs.Solution:
    """With balls that friction moves, and so many points."""
    of = replace(law, radial_points=points[0], points_around=points[1])
    return qs.solve(replace(scene, ball_effects=BOTH, raceway_control="friction", traction=of))  # type: ignore[arg-type]


def of_batch(scene: qs.Scene, law: Traction) -> tuple[NDArray, NDArray]:
    """(errors (case, quantity), gyroscopic margins) of the cases at speed that have a solution."""
    usual, fine = (found(scene, law, points) for points in ((RADII, ANGLES), FINE))
    assert usual.friction is not None
    with np.errstate(all="ignore"):
        judged = errors(read(usual), read(fine))
        margin = usual.friction.least_gyroscopic_margin
    is_there = usual.converged & fine.converged & (np.asarray(scene.operation.speed) != usual_outer(scene))
    columns = [np.max([judged[name] for name in names], axis=0) for names in QUANTITIES.values()]
    return np.stack(columns, axis=-1)[is_there], margin[is_there]


def usual_outer(scene: qs.Scene) -> NDArray:
    """Speed of the outer rings."""
    outer = scene.operation.outer_speed
    return np.asarray(0.0 if outer is None else outer, float)


def measure() -> dict[str, Any]:
    """The record."""
    of_batches: dict[int, tuple[NDArray, NDArray]] = {}
    for number, scene, law in batches():
        of_batches[number] = of_batch(scene, law)
        if sum(len(margin) for _, margin in of_batches.values()) >= CASES:
            break
    every, margins = (np.concatenate(each)[:CASES] for each in zip(*of_batches.values(), strict=True))
    made = provenance.of_run("python -m tests.verification.benchmarks.friction_points")
    first = min(of_batches)
    return {
        "provenance": made,
        "points": [RADII, ANGLES],
        "fine": FINE,
        "creep": summary(every[margins < CREEPING]),
        "held": summary(every[margins >= CREEPING]),
        "first_batch": {"number": first, **summary(of_batches[first][0])},
    }


def summary(of: NDArray) -> dict[str, Any]:
    """Of errors (case, quantity), to three digits."""
    by_name = {
        name: {part: float(f"{np.quantile(of[:, k], q):.3g}") for part, q in PARTS.items()}
        for k, name in enumerate(QUANTITIES)
    }
    return {"cases": len(of), "errors": by_name}


def rounded_up(error: float) -> float:
    """To two digits."""
    size = 10.0 ** (floor(log10(error)) - 1)
    return float(f"{ceil(error / size * (1.0 - 1e-9)) * size:.2g}")


if __name__ == "__main__":
    RECORD.write_text(json.dumps(measure(), indent=1) + "\n", encoding="utf-8")
