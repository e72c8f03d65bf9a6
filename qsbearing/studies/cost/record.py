"""What `qsbearing cost` finds, as plain data: `cost.json`.

    kind, version, machine, settings    what this is, where and how thoroughly it was measured
    definition, bearing, scene          how errors are counted, what was looked at
    measured    [{part, name, cases, case_s, over_last, error, memory_MB}]
    errors      [{dm_n_mm_rpm, speed, level, then the worst error of each group of results}]
    provenance                          of the run, set by the command (see `qsbearing.results.provenance`)

`part` is what is varied: "levels" or "cases". `case_s` is the processor's time of a call over its cases,
`over_last` that over the time of the last of its series (the finest level, the most cases):
{median, low, high}, the median of all rounds and their 5 % and 95 % quantiles. `error` is the worst of all results
against the last of the series, `memory_MB` the peak of a process that makes this call alone. Null stands for what does
not apply or has no number.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import always_compiled
from qsbearing.model.effects import EFFECTS
from qsbearing.model.effects.entry import Entry
from qsbearing.model.operation import CHANNELS
from qsbearing.model.scene.arched_rings import NOTHING_TO_COMPARE, refuse_arched
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution import comparison
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solver import solve
from qsbearing.model.version import __version__
from qsbearing.studies.chooser.choose import without
from qsbearing.studies.cost import measuring, speeds
from qsbearing.studies.cost.measuring import machine
from qsbearing.studies.cost.speeds import Requested
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.solve import solve_set


@dataclass(frozen=True)
class Level:
    """One model level: the first so many of the list, at their finest."""

    name: str
    """A key, in files: what it adds to the level before it."""
    text: str
    count: int

    def of(self, scene: Any) -> Any:
        """The scene's or set's bearings and operation at this level, whatever effects and choices it names."""
        scene = without(scene, reversed(EFFECTS))
        for entry in EFFECTS[: self.count]:
            scene = scene if entry.hypothesis else entry.finer(scene)
        return scene


BASE = "the coarsest of all"


def added(entry: Entry) -> str:
    """What a level adds to the one before, in words."""
    return f"+ {entry.what.partition(' (')[0]}"


LEVELS = (
    Level("coarsest", BASE, 0),
    *(
        Level(entry.name, added(entry), count)
        for count, entry in enumerate(EFFECTS, start=1)
        if not entry.needs and not entry.hypothesis
    ),
)


@dataclass(frozen=True)
class Settings:
    """How thoroughly to measure."""

    rounds: int = 10
    """In each process; each call once a round."""
    processes: int = 3
    """Fresh processes over which the rounds are spread."""
    batch: int = 100
    """Cases in the batches that levels are timed on."""
    sizes: tuple[int, ...] = (1, 10, 100, 1_000, 10_000, 100_000)
    """Cases in one call."""


FULL = Settings()
QUICK = Settings(rounds=3, processes=1, batch=20, sizes=(1, 10, 100, 1_000, 10_000))
"""For a look: a few seconds, with a spread that means little."""


MOST_OF_SETS = 1_000
"""Cases of a set in one call: each is several bearings."""


@dataclass(frozen=True)
class Call:
    """One call of the solver that is measured."""

    part: str
    name: str
    scene: Requested
    cases: int = 1

    def prepared(self) -> Callable[[], Solution | SetSolution]:
        """All but the call itself done."""
        return partial(solve_one, speeds.batch(self.scene, self.cases), threads=1)

    def memory(self) -> float:
        """Peak memory of this process once it has made the call, results kept [MB]."""
        solution = self.prepared()()
        peak = measuring.peak_MB()
        assert solution.shape is not None  # still held
        return float(f"{peak:.4g}")


def solve_one(of: Any, threads: int | None = None) -> Solution | SetSolution:
    """Whichever it is, as it stands."""
    return solve(of, threads=threads) if isinstance(of, Scene) else solve_set(of, threads=threads)


def series(scene: Requested, settings: Settings) -> list[list[Call]]:
    """All that is measured; the last of each series is what the others are compared with."""
    counts = (1, settings.batch)
    by_level = [[Call("levels", level.name, level.of(scene), cases) for level in LEVELS] for cases in counts]
    return [*by_level, [Call("cases", f"{count:,}", scene, count) for count in settings.sizes]]


def steps(settings: Settings) -> int:
    """How often `measure` reports progress."""
    return 1 + settings.processes + len(settings.sizes)


def measure(
    scene: Requested, settings: Settings, progress: Callable[[str], None] = lambda text: None
) -> dict[str, Any]:
    """Everything measured, in the form above.

    Args:
        scene: bearing and operation; its effects and choices matter for all but the levels, which have their own.
        progress: told what is being measured, before each of `steps`.
    """
    refuse_arched(getattr(scene, "bearing", None), "`cost`", NOTHING_TO_COMPARE)
    if not isinstance(scene, Scene):
        settings = replace(settings, sizes=tuple(size for size in settings.sizes if size <= MOST_OF_SETS))
    always_compiled()
    where = machine()
    progress("errors along the speed")
    along = errors(scene)
    rounds: measuring.Times = {}
    for turn in range(settings.processes):
        progress(f"times, process {turn + 1} of {settings.processes}")
        for key, values in measuring.in_fresh_process(times, scene, settings).items():
            rounds.setdefault(key, []).extend(values)
    rows = []
    for k, calls in enumerate(series(scene, settings)):
        last = calls[-1].prepared()()
        for j, call in enumerate(calls):
            row = {key: getattr(call, key) for key in ("part", "name", "cases")}
            row["case_s"] = measuring.spread(rounds[k, j])
            row["over_last"] = measuring.ratio(rounds, (k, j), (k, len(calls) - 1))
            row |= {"error": None, "memory_MB": None}
            if call.part == "cases":
                progress(f"memory of {call.name} cases")
                row["memory_MB"] = measuring.in_fresh_process(call.memory)
            else:
                row["error"] = short_number(np.max(comparison.largest(call.prepared()(), last)))
            rows.append(row)
    return {
        "kind": "qsbearing cost",
        "version": __version__,
        "machine": where,
        "settings": asdict(settings),
        "definition": comparison.__doc__,
        "bearing": name_of(scene),
        "scene": text_of_loads(scene),
        "measured": rows,
        "errors": along,
    }


def times(scene: Requested, settings: Settings) -> measuring.Times:
    """Seconds a case of every call, by the positions of its series and in it; all taken in turn."""
    listed = {(k, j): call for k, calls in enumerate(series(scene, settings)) for j, call in enumerate(calls)}
    seconds = measuring.interleaved({key: call.prepared() for key, call in listed.items()}, settings.rounds)
    return {key: [value / listed[key].cases for value in values] for key, values in seconds.items()}


def errors(scene: Requested, levels: tuple[Level, ...] = LEVELS) -> list[dict[str, Any]]:
    """Error of each quantity that people read at every level against the last, along the speeds."""
    names, swept = speeds.along_speeds(scene)
    parameter = speeds.dm_n(swept)
    full = solve_one(levels[-1].of(swept))
    rows = []
    for level in levels:
        by_quantity = comparison.by_quantity(solve_one(level.of(swept)), full)
        rows += [
            {"dm_n_mm_rpm": float(f"{parameter[k]:.4g}"), "speed": name, "level": level.name}
            | {quantity: short_number(values[k]) for quantity, values in by_quantity.items()}
            for k, name in enumerate(names)
        ]
    return rows


def short_number(value: NDArray | float) -> float | None:
    """To four digits; None for what has no number."""
    return float(f"{value:.4g}") if np.isfinite(value) else None


def name_of(scene: Requested) -> str | None:
    """The bearing's, or the set's."""
    return scene.bearing.name if isinstance(scene, Scene) else scene.name


def text_of_loads(scene: Requested) -> str:
    """The scene's or set's loads in a line."""
    said = []
    for channel in CHANNELS:
        load_unit, unit, size = ("Nm", "mrad", 1e3) if channel.is_rotation else ("N", "um", 1e6)
        load, displacement = getattr(scene.operation, channel.load), getattr(scene.operation, channel.displacement)
        if load:
            said.append(f"{channel.label} {float(load):.6g} {load_unit}")
        if displacement is not None:
            said.append(f"{channel.label} held at {float(displacement) * size:.6g} {unit}")
    return ", ".join(said) or "no load"
