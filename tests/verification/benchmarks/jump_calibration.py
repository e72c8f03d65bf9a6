"""How well jumps between neighbours are told from bends: `python -m tests.verification.benchmarks.jump_calibration`,
some minutes.

Random realistic bearings along speed. Every step that stands out is refined: between the two neighbours 32 more points
are solved. A jump stays in one of the 32 steps; a bend is shared out among them. That is a judgement of its own: it
knows neither the thresholds nor the causes.
"""

from __future__ import annotations

import sys
from collections import Counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.pictures.study import jumps as module
from qsbearing.pictures.study.jumps import WORDS, Cause, jumps
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep

SWEEPS, POINTS, FINER, SEED = 300, (25, 121), 32, 2025
STAYS = 0.5
"""A step of which one finer step is more than this part is a jump."""
LOOKED_AT = 1.5, 0.05
"""Steps that are refined: so much larger than those beside them, and so many degrees."""
SHOWN = [(ratio, least) for ratio in (2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0) for least in (0.1, 0.25, 0.5, 1.0)]


def random_study(random: np.random.Generator) -> dict[str, Any]:
    """A bearing of 5 to 40 mm balls, from hardly to heavily loaded, so that many balls lose the inner raceway."""
    diameter = float(np.exp(random.uniform(np.log(5.0), np.log(40.0))))
    pitch = diameter * random.uniform(4.5, 9.0)
    count = int(random.uniform(0.6, 0.95) * np.pi * pitch / diameter)
    axial = diameter**2 * count * float(np.exp(random.uniform(np.log(0.01), np.log(4.0))))
    return {
        "bearing": {
            "ball_count": count,
            "ball_diameter_mm": diameter,
            "pitch_diameter_mm": pitch,
            "inner_groove_radius_mm": diameter * random.uniform(0.512, 0.535),
            "outer_groove_radius_mm": diameter * random.uniform(0.512, 0.535),
            "free_contact_angle_deg": random.uniform(12.0, 42.0),
            "ball_material": str(random.choice(["steel", "silicon nitride"])),
            "ring_material": "steel",
        },
        "operation": {
            "axial_load_N": axial,
            "radial_load_y_N": axial * random.uniform(0.0, 2.5),
            **({"tilt_z_mrad": 0.0, "tilt_y_mrad": 0.0} if random.random() < 0.5 else {"moment_z_Nm": 0.0}),
        },
        "effects": {
            "ball": ["centrifugal_force", "gyroscopic_moment"],
            "raceway_control": str(random.choice(["outer", "inner", "per_ball"])),
        },
    }


def solved(document: dict[str, Any], speeds: NDArray) -> Any:
    """The sweep over these speeds."""
    return sweep(Study.of({**document}, {"speed_rpm": speeds.tolist()}))


def steps(results: Any) -> tuple[NDArray, NDArray]:
    """The largest step of a loaded contact's angle from each point to the next, and by how much it stands out."""
    size, out = np.zeros(results.sizes["speed_rpm"] - 1), np.zeros(results.sizes["speed_rpm"] - 1)
    for side in ("inner", "outer"):
        angle = results[f"{side}_angle"].where(results[f"{side}_load"] > 0.0)
        step = abs(angle.diff("speed_rpm", label="lower"))
        ratio = (step / np.maximum(module._larger_neighbour(step, "speed_rpm"), 1e-12)).values
        ratio = np.nan_to_num(np.where(step.values > LOOKED_AT[1], ratio, 0.0))
        at = ratio.argmax(axis=1)[:, None]
        found = np.take_along_axis(np.nan_to_num(step.values), at, 1)[:, 0], np.take_along_axis(ratio, at, 1)[:, 0]
        size, out = np.where(found[1] > out, found[0], size), np.maximum(found[1], out)
    return size, out


def is_jump(document: dict[str, Any], low: float, high: float) -> bool:
    """Whether the step between two speeds stays in one of the finer ones."""
    fine = solved(document, np.linspace(low, high, FINER + 1))
    if (fine["status"] != 0).any():
        return True
    for side in ("inner", "outer"):
        angle = fine[f"{side}_angle"].where(fine[f"{side}_load"] > 0.0)
        whole = abs(angle[-1] - angle[0])
        if bool((abs(angle.diff("speed_rpm")).max("speed_rpm") > np.maximum(STAYS * whole, LOOKED_AT[1])).any()):
            return True
    return False


def main(count: int = SWEEPS) -> None:
    """Print what was found."""
    random = np.random.default_rng(SEED)
    causes: Counter[str] = Counter()
    judged: list[tuple[float, float, bool]] = []
    points = 0
    for _ in range(count):
        document = random_study(random)
        bearing = document["bearing"]
        most = random.uniform(0.5e6, 2.5e6) / bearing["pitch_diameter_mm"]
        number = int(random.integers(*POINTS))
        speeds = np.linspace(most / number, most, number)
        results = solved(document, speeds)
        points += int((results["status"] == 0).sum())
        cause = jumps(results, "speed_rpm").values
        causes.update(WORDS[Cause(each)] for each in cause[cause > 0].tolist())
        size, out = steps(results)
        switched = cause == Cause.CONTROL_SWITCHES  # known jumps: would their step alone have told?
        for at in np.flatnonzero(((out > LOOKED_AT[0]) | switched) & (cause != Cause.BRANCH_ENDS)):
            judged.append((out[at], size[at], is_jump(document, speeds[at], speeds[at + 1])))
    sys.stdout.write(f"{count} sweeps, {points} points solved; marked: {dict(causes)}\n")
    ratio, size, true = (np.array(each) for each in zip(*judged, strict=True)) if judged else (np.empty(0),) * 3
    sys.stdout.write(f"{ratio.size} steps refined, switches of control among them; {int(true.sum())} are jumps\n")
    sys.stdout.write("stands out   degrees   jumps marked   jumps missed   bends marked\n")
    for least_ratio, least in SHOWN:
        marked = (ratio > least_ratio) & (size > least)
        row = (marked & true).sum(), (~marked & true).sum(), (marked & ~true).sum()
        sys.stdout.write(f"{least_ratio:10g} {least:9g}" + "".join(f"{int(each):15d}" for each in row) + "\n")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else SWEEPS)
