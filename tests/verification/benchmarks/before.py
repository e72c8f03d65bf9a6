"""This version beside an earlier one: `python -m tests.verification.benchmarks.before CHECKOUT`.

It measures, keeps the record and fills the guide's table; with `--from-record` it fills the table only.

Each version runs in a process of its own, with the scenes of this one, and the two are asked in turn: a shared
machine's speed drifts, the ratio of two times taken one after the other hardly. All times are the processor's.
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
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

PAGE = Path(__file__).parents[3] / "qsbearing" / "guide" / "timing.md"
RECORD = Path(__file__).with_suffix(".json")
ROUNDS, COLD_ROUNDS, FIRST_ROUNDS = 40, 10, 2
POINTS = 1000

CALLS = {
    "thrust": "one `solve(scene)`, thrust",
    "combined": "one `solve(scene)`, combined load, free tilt",
    "planar": f"a point of {POINTS:,}, radial load along one axis",
    "general": f"a point of {POINTS:,}, loads in all five channels",
}
COMMANDS = {
    "run": "`qsbearing run b218`, from cold",
    "first": "the same, the first time",
}


def calls() -> dict[str, tuple[Callable[[], Any], int]]:
    """What is timed, and for how many points each stands."""
    import qsbearing as qs

    scenes = importlib.import_module("scenes")  # of this folder; `qsbearing` is the version asked
    batches = {"planar": scenes.random_points(POINTS), "general": scenes.random_general_points(POINTS)}
    one = {name: (partial(qs.solve, getattr(scenes, name)(), threads=1), 1) for name in ("thrust", "combined")}
    return one | {name: (partial(qs.solve, scene, threads=1), POINTS) for name, scene in batches.items()}


def answer() -> None:
    """For each name read, write the processor time of one point [s], the median of a tenth of a second's calls."""
    known = calls()
    for line in sys.stdin:
        call, points = known[line.strip()]
        call()
        times: list[float] = []
        while sum(times) < 0.1:
            began = time.thread_time()
            call()
            times.append(time.thread_time() - began)
        print(statistics.median(times) / points, flush=True)


def environment(checkout: Path, cache: str) -> dict[str, str]:
    """Where a process finds that version, and its compiled kernel."""
    return {**os.environ, "PYTHONPATH": str(checkout), "NUMBA_CACHE_DIR": cache}


def command_time(checkout: Path, cache: str) -> float:
    """Processor time of the command in a fresh process [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "qsbearing", "run", "b218"]
    subprocess.run(command, check=True, capture_output=True, cwd=checkout, env=environment(checkout, cache))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(earlier: Path) -> dict[str, Any]:
    """The record: medians before and now, and the median ratio with its 5 % and 95 % quantiles."""
    from qsbearing.results import provenance
    from qsbearing.studies.cost import measuring

    both = {"before": earlier.resolve(), "now": Path(__file__).parents[3]}
    times: dict[str, dict[str, list[float]]] = {name: {version: [] for version in both} for name in (*CALLS, *COMMANDS)}

    def in_turn(name: str, rounds: int, ask: Callable[[str], float]) -> None:
        for turn in range(rounds):
            for version in (*both,) if turn % 2 else (*both,)[::-1]:
                times[name][version].append(ask(version))

    with ExitStack() as stack:
        caches = {version: stack.enter_context(tempfile.TemporaryDirectory()) for version in both}
        in_turn("first", 1, lambda version: command_time(both[version], caches[version]))
        in_turn("run", COLD_ROUNDS, lambda version: command_time(both[version], caches[version]))
        workers = {
            version: stack.enter_context(
                subprocess.Popen(
                    [sys.executable, __file__, "--answer"],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    text=True,
                    env=environment(path, caches[version]),
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
            in_turn(name, ROUNDS, partial(ask, name))
        for worker in workers.values():
            worker.communicate()
    for _ in range(FIRST_ROUNDS - 1):
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
            empty = {"before": one, "now": other}
            in_turn("first", 1, lambda version, empty=empty: command_time(both[version], empty[version]))
    named = subprocess.run(
        ["git", "-C", str(earlier), "describe", "--always", "--tags"], check=True, capture_output=True, text=True
    )
    command = "python -m tests.verification.benchmarks.before CHECKOUT"
    return {
        "made_by": command,
        "provenance": provenance.of_run(command),
        "machine": measuring.machine(),
        "before": named.stdout.strip(),
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
    for name, text in (CALLS | COMMANDS).items():
        row = found["figures"][name]
        unit, size = ("µs", 1e6) if name in CALLS else ("s", 1.0)
        cells = [f"{row[version] * size:.3g} {unit}" for version in ("before", "now")]
        ratio = row["ratio"]
        lines.append(
            f"| {text} | {' | '.join(cells)} | {ratio['median']:.2f} ({ratio['low']:.2f} to {ratio['high']:.2f}) |"
        )
    machine = found["machine"]
    lines += [
        "",
        f"Before: commit {found['before']}. Both in turn, round by round; {machine['processor']}, {machine['cores']} "
        f"shared cores at load average {machine['load_average']:g}, which makes times longer, Python "
        f"{machine['python']}, numba {machine['numba']}.",
    ]
    return "\n".join(lines)


def filled(page: str, found: dict[str, Any]) -> str:
    """The page with its table made from the record."""
    from tests.verification.benchmarks import marked

    return marked.filled(page, "before", "before", table(found))


def load() -> dict[str, Any]:
    """The kept record."""
    return dict(json.loads(RECORD.read_text(encoding="utf-8")))


def main() -> None:
    """Measure, keep, show."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("checkout", type=Path, nargs="?")
    parser.add_argument("--answer", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--from-record", action="store_true")
    asked = parser.parse_args()
    if asked.answer:
        answer()
        return
    if not asked.from_record:
        RECORD.write_text(json.dumps(measure(asked.checkout), indent=1) + "\n", encoding="utf-8")
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8"), load()), encoding="utf-8")


if __name__ == "__main__":
    main()
