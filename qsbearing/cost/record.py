"""What `qsbearing cost` found, as plain data: `cost.json`.

    kind, version, machine, settings, definition, notes    what this is, where and how thoroughly it was measured,
                                                    how errors are counted, why some curves are not monotone
    bearing, scene                                  what was looked at
    contact     {what, load_N, forms: [{form, seconds, errors: {approach, semi_major_axis, semi_minor_axis,
                max_pressure}}]}                    one Hertz contact of B218 by each form, against 50 digits
    fidelity    [{name, speed_rpm, dm_n_mm_rpm, rungs: [{rung, words, one_case_s, batch_case_s, one_case_over_top,
                batch_case_over_top, memory_MB, errors: {answer: relative error}, accuracy}]}]
    speeds      {dm_n_mm_rpm: [...], rungs: {rung: {group of answers: [relative errors]}}}
    tolerance   [{name, starts: [{start, words, steps: [{tolerance, converged, residual, iterations, error, one_case_s,
                batch_case_s, and both over_default}]}]}]
    scaling     {cases: [...], balls: [...], workers: [...]}, each with case_s, memory_MB and a ratio

Every time, memory and ratio is {median, low, high}: the median of all rounds and the stretch between their 5 % and 95 %
quantiles; times in seconds, memory in MB, of the whole process. An error is null where a rung does not give the answer.
"""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from qsbearing import __version__
from qsbearing.cost import fidelity, scaling, tolerance
from qsbearing.cost.answers import NAMES
from qsbearing.cost.machine import machine

if TYPE_CHECKING:
    from collections.abc import Callable

    from qsbearing.cost.settings import Settings
    from qsbearing.scene import Scene

PARTS = ("fidelity", "tolerance", "scaling")

DEFINITION = (
    "errors are against the top rung at the same bearing, loads and speed; each over a size that cannot vanish: "
    "contact loads, semi-axes and pressures over the largest of the raceway, angles over the largest of both raceways, "
    "displacements over the largest of all (tilts times dm/2; at least the approach across the most loaded ball), "
    "stiffnesses over their own value; contacts below a tenth of the largest load count with their load only; of "
    "several balls or channels the worst counts; accuracy is the worst of all answers that a rung gives"
)


NOTES = (
    "A finer rung need not be nearer below dm n of some 4e5 mm rpm: control by each ball gives heavily loaded balls to "
    "the inner raceway there, so outer control puts the gyroscopic moment in the wrong place, and where Jones's "
    "criterion is nearly a tie the free and the actual angle decide it differently.",
    "The centrifugal force alone comes nearer again at the highest speeds: there the balls settle at outer angles near "
    "zero, where they have no gyroscopic moment.",
    "The thrust estimate can show a smaller worst error than the static rungs: it gives fewer answers to be wrong in.",
    "One call is overhead of the call itself but for actual-angle Hertz; a start given costs more there than the "
    "iterations it saves, which in a batch it does not.",
)
"""Where the curves are not what one expects, and why."""


def measure(
    scene: Scene,
    settings: Settings,
    progress: Callable[[str], None] = lambda words: None,
    parts: tuple[str, ...] = PARTS,
) -> dict[str, Any]:
    """Everything measured, in the form above.

    Args:
        scene: bearing and operation; its effects and choices do not matter, for the ladder goes through all of them.
        progress: told in a few words what is being measured, before each step of `steps`.
        parts: which of `PARTS`.
    """
    where = machine()
    found: dict[str, Any] = {
        "kind": "qsbearing cost",
        "version": __version__,
        "machine": where,
        "settings": asdict(settings),
        "definition": DEFINITION,
        "notes": list(NOTES),
        "answers": list(NAMES),
        "bearing": scene.bearing.name,
        "scene": _words(scene),
    }
    if "fidelity" in parts:
        found["contact"] = fidelity.contact(settings, tolerance.truth()["contact"])
        found["speeds"] = fidelity.by_speed(scene)
        found["fidelity"] = fidelity.measure(scene, settings, progress)
    if "tolerance" in parts:
        found["tolerance"] = tolerance.measure(settings, progress)
    if "scaling" in parts:
        found["scaling"] = scaling.measure(scene, settings, progress)
    return found


def steps(settings: Settings, parts: tuple[str, ...] = PARTS) -> int:
    """How often `measure` reports progress."""
    from qsbearing.cost.ladder import LADDER

    counts = {
        "fidelity": 1 + settings.processes + len(LADDER),
        "tolerance": 1 + settings.processes,
        "scaling": settings.processes + len(settings.sizes) + len(settings.ball_counts) + 2,
    }
    return sum(counts[part] for part in parts)


def _words(scene: Scene) -> str:
    """The scene's loads in a line."""
    from qsbearing.operation import CHANNELS

    units = {False: ("N", 1.0, "um", 1e6), True: ("Nm", 1.0, "mrad", 1e3)}
    said = []
    for channel in CHANNELS:
        load_unit, load_size, unit, size = units[channel.is_rotation]
        load, displacement = getattr(scene.operation, channel.load), getattr(scene.operation, channel.displacement)
        if load is not None and load != 0.0:
            said.append(f"{channel.words} {float(load) * load_size:.6g} {load_unit}")
        if displacement is not None:
            said.append(f"{channel.words} held at {float(displacement) * size:.6g} {unit}")
    return ", ".join(said) or "no load"
