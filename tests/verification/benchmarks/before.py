"""This version beside the last release: `python -m tests.verification.benchmarks.before [FILE]` measures and keeps.

Each version runs in a process of its own, with the scenes of this one, and the two are asked in turn: a shared
machine's speed drifts, the ratio of two times taken one after the other hardly. All times are the processor's, but for
those of two threads. `--rounds N` takes so many, for a trial.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np

ROOT = Path(__file__).parents[3]
RELEASE, COMMIT = "0.2.0", "96e5871"
"""The last release: the first commit with all records of a gate that passed. To be changed after each release."""
RECORD = Path(__file__).with_suffix(".json")
ROUNDS, COLD_ROUNDS, FEW_ROUNDS, FIRST_ROUNDS = 40, 10, 6, 2
LEVELS = ("at rest", "+ centrifugal force", "+ gyroscopic moment", "+ ring expansion", "all")
"""Of effects, as in the page's first table."""
POINTS, MANY, MILLION = 1000, 100_000, 1_000_000

CALLS = {
    "thrust": "one `solve(scene)`, thrust",
    "combined": "one `solve(scene)`, combined load, free tilt",
    "planar": f"a point of {POINTS:,}, radial load along one axis",
    "general": f"a point of {POINTS:,}, loads in all five channels",
    **{f"{name}, one": f"one call, {name}" for name in LEVELS},
    **{f"{name}, many": f"a point of {POINTS:,}, {name}" for name in LEVELS},
    "two threads": f"a point of {MANY:,}, two threads",
}
COMMANDS = {
    "help": ("`qsbearing --help`", ("--help",)),
    "run": ("`qsbearing run b218`", ("run", "b218")),
    "explain": ("`qsbearing explain b218`", ("explain", "b218")),
    "first": ("`qsbearing run b218`, the first time", ("run", "b218")),
}
MEMORY = "memory"


def calls() -> dict[str, tuple[Callable[[], Any], int]]:
    """What is timed, and for how many points each stands."""
    import qsbearing as qs

    scenes = importlib.import_module("scenes")  # of this folder; `qsbearing` is the version asked
    batches = {"planar": scenes.random_points(POINTS), "general": scenes.random_general_points(POINTS)}
    one = {name: (partial(qs.solve, getattr(scenes, name)(), threads=1), 1) for name in ("thrust", "combined")}
    found = one | {name: (partial(qs.solve, scene, threads=1), POINTS) for name, scene in batches.items()}
    for name, scene in scenes.levels().items():
        axial = np.linspace(0.8, 1.2, POINTS) * scene.operation.axial_load
        batch = replace(scene, operation=replace(scene.operation, axial_load=axial))
        found[f"{name}, one"] = partial(qs.solve, scene, threads=1), 1
        found[f"{name}, many"] = partial(qs.solve, batch, threads=1), POINTS
    return found | {"two threads": (partial(qs.solve, scenes.random_points(MANY), threads=2), MANY)}


def answer() -> None:
    """For each name read, write the processor time of one point [s], the median of a tenth of a second's calls."""
    known = calls()
    for line in sys.stdin:
        call, points = known[line.strip()]
        clock = time.perf_counter if line.strip() == "two threads" else time.thread_time
        call()
        times: list[float] = []
        while sum(times) < 0.1:
            began = clock()
            call()
            times.append(clock() - began)
        print(statistics.median(times) / points, flush=True)


def environment(checkout: Path, cache: str) -> dict[str, str]:
    """Where a process finds that version, and its compiled kernel."""
    return {**os.environ, "PYTHONPATH": str(checkout), "NUMBA_CACHE_DIR": cache}


def command_time(checkout: Path, cache: str, *arguments: str) -> float:
    """Processor time of the command in a fresh process [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "qsbearing", *arguments]
    subprocess.run(command, check=True, capture_output=True, cwd=checkout, env=environment(checkout, cache))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def peak(checkout: Path, cache: str) -> float:
    """Memory of a process that solves a million points [MB]."""
    code = (
        "import resource, qsbearing as qs, scenes\n"
        f"assert qs.solve(scenes.random_points({MILLION})).converged.all()\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)\n"
    )
    found = environment(checkout, cache)
    paths = os.pathsep.join((found["PYTHONPATH"], str(Path(__file__).parent)))
    done = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True, env=found | {"PYTHONPATH": paths}
    )
    return float(done.stdout.split()[-1])


@contextmanager
def checkout(commit: str) -> Iterator[Path]:
    """The source of a commit, while it is needed."""
    with tempfile.TemporaryDirectory() as place:
        archive = ["git", "-C", str(ROOT), "archive", "--format=zip", commit]
        with ZipFile(BytesIO(subprocess.run(archive, check=True, capture_output=True).stdout)) as packed:
            packed.extractall(place)
        yield Path(place)


def measure(earlier: Path, rounds: int = ROUNDS) -> dict[str, Any]:
    """The record: medians before and now, and the median ratio with its 5 % and 95 % quantiles."""
    from qsbearing.results import provenance
    from qsbearing.studies.cost import measuring

    both = {"before": earlier.resolve(), "now": ROOT}
    names = (*CALLS, *COMMANDS, MEMORY)
    times: dict[str, dict[str, list[float]]] = {name: {version: [] for version in both} for name in names}

    def in_turn(name: str, rounds: int, ask: Callable[[str], float]) -> None:
        for turn in range(rounds):
            for version in (*both,) if turn % 2 else (*both,)[::-1]:
                times[name][version].append(ask(version))

    with ExitStack() as stack:
        caches = {version: stack.enter_context(tempfile.TemporaryDirectory()) for version in both}
        for name, (_, arguments) in COMMANDS.items():
            if name == "first":
                continue
            for version in both:  # bytecode, and what the version compiles
                command_time(both[version], caches[version], *arguments)
            in_turn(
                name,
                min(rounds, COLD_ROUNDS),
                lambda version, arguments=arguments: command_time(both[version], caches[version], *arguments),
            )
        workers = {
            version: stack.enter_context(
                subprocess.Popen(
                    [sys.executable, __file__, "--answer"],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    text=True,
                    env=environment(path, caches[version]) | {"QSBEARING_COMPILED": "1"},
                )
            )
            for version, path in both.items()
        }

        def ask(name: str, version: str) -> float:
            worker = workers[version]
            assert worker.stdin is not None
            assert worker.stdout is not None
            print(name, file=worker.stdin, flush=True)
            return float(worker.stdout.readline())

        for name in CALLS:
            for version in both:
                ask(name, version)  # machine code is loaded
            in_turn(name, min(rounds, FEW_ROUNDS) if name == "two threads" else rounds, partial(ask, name))
        for worker in workers.values():
            worker.communicate()
        in_turn(MEMORY, 1, lambda version: peak(both[version], caches[version]))
    for _ in range(min(rounds, FIRST_ROUNDS)):
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
            empty = {"before": one, "now": other}
            in_turn(
                "first",
                1,
                lambda version, empty=empty: command_time(both[version], empty[version], *COMMANDS["first"][1]),
            )
    command = "python -m tests.verification.benchmarks.before"
    return {
        "made_by": command,
        "provenance": provenance.of_run(command),
        "machine": measuring.machine(),
        "before": f"{RELEASE} ({COMMIT})",
        "figures": {
            name: {
                **{version: float(f"{statistics.median(of[version]):.3g}") for version in both},
                "ratio": measuring.ratio(of, "now", "before"),
            }
            for name, of in times.items()
        },
    }


def table(found: dict[str, Any]) -> str:
    """The page's table."""
    lines = ["| processor time | before | now | ratio, 5 % to 95 % of the rounds |", "|---|---|---|---|"]
    told = CALLS | {name: text for name, (text, _) in COMMANDS.items()} | {MEMORY: f"{MILLION:,} points: peak memory"}
    for name, text in told.items():
        if name not in found["figures"]:
            continue
        row = found["figures"][name]
        unit, size = ("µs", 1e6) if name in CALLS else ("MB", 1.0) if name == MEMORY else ("s", 1.0)
        cells = [f"{row[version] * size:.3g} {unit}" for version in ("before", "now")]
        ratio = row["ratio"]
        lines.append(
            f"| {text} | {' | '.join(cells)} | {ratio['median']:.2f} ({ratio['low']:.2f} to {ratio['high']:.2f}) |"
        )
    machine = found["machine"]
    lines += [
        "",
        f"Before: {found['before']}. Both in turn, round by round; {machine['processor']}, {machine['cores']} "
        f"shared cores at load average {machine['load_average']:g}, which makes times longer, Python "
        f"{machine['python']}, numba {machine['numba']}.",
    ]
    return "\n".join(lines)


def load() -> dict[str, Any]:
    """The kept record."""
    return dict(json.loads(RECORD.read_text(encoding="utf-8")))


def main() -> None:
    """Measure, keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path, nargs="?", default=RECORD)
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--answer", action="store_true", help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.answer:
        answer()
        return
    with checkout(COMMIT) as earlier:
        found = measure(earlier, asked.rounds)
    asked.file.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
