"""Measures what the README states and keeps it: `python -m tests.verification.benchmarks.record [FILE]`.

Competing figures are taken in turn within one run, since a shared machine's speed drifts; each is the median of
repeats, with the smallest and the largest beside it.
"""

from __future__ import annotations

import json
import os
import platform
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.model.solution.solved_cases import solved_of
from qsbearing.results import provenance
from tests.verification.benchmarks import scenes, scipy_root

RECORD = Path(__file__).with_name("record.json")
POINTS = 100_000
SCIPY_POINTS = 60


def timed(function: Callable[[], Any]) -> float:
    """Seconds of one call."""
    began = time.perf_counter()
    function()
    return time.perf_counter() - began


def spread(seconds: list[float], unit: float) -> dict[str, float]:
    """Median, smallest and largest, in a unit of so many seconds, to three digits."""
    rounded = [float(f"{value / unit:.3g}") for value in (statistics.median(seconds), min(seconds), max(seconds))]
    return dict(zip(("median", "min", "max"), rounded, strict=True))


def interleaved(functions: dict[str, Callable[[], Any]], repeats: int) -> dict[str, list[float]]:
    """Seconds of each function, taken in turn; the first round warms up and does not count."""
    times: dict[str, list[float]] = {name: [] for name in functions}
    for turn in range(repeats + 1):
        for name, function in functions.items():
            seconds = timed(function)
            if turn:
                times[name].append(seconds)
    return times


def cold_start(bytecode: str, *arguments: str) -> float:
    """Processor time of the command in a fresh process that finds no compiled kernel, but Python's own bytecode, which
    an installation has written [s]."""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
    command = [sys.executable, "-m", "qsbearing", *arguments]
    with tempfile.TemporaryDirectory() as empty:
        environment |= {"NUMBA_CACHE_DIR": empty, "PYTHONPYCACHEPREFIX": bytecode}
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True, capture_output=True, env=environment)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def start_up() -> dict[str, Any]:
    """Processor time of commands as they are first run."""
    commands = {"help": ("--help",), "run": ("run", "b218"), "explain": ("explain", "b218")}
    times: dict[str, list[float]] = {name: [] for name in commands}
    with tempfile.TemporaryDirectory() as bytecode:
        for turn in range(8):
            for name, words in commands.items():
                taken = cold_start(bytecode, *words)
                if turn:
                    times[name].append(taken)
    load = round(os.getloadavg()[0], 1)
    return {f"{name}_s": spread(each, 1.0) for name, each in times.items()} | {"load_average": load}


def single_calls() -> dict[str, Any]:
    """One warm `solve`, everything included."""
    thrust, combined = scenes.thrust(), scenes.combined()
    times = interleaved({"thrust": lambda: qs.solve(thrust), "combined": lambda: qs.solve(combined)}, 500)
    return {name: spread(seconds, 1e-6) for name, seconds in times.items()}


def batch() -> dict[str, Any]:
    """Many random points in one call, on one and on two threads."""
    scene = scenes.random_points(POINTS)
    solution = qs.solve(scene)
    times = interleaved(
        {"one_thread": lambda: qs.solve(scene, threads=1), "two_threads": lambda: qs.solve(scene, threads=2)}, 5
    )
    return {
        "points": POINTS,
        "converged": int(solution.converged.sum()),
        "largest_residual": float(f"{solution.residual.max():.2g}"),
        **{name: spread(seconds, 1e-6 * POINTS) for name, seconds in times.items()},
    }


def starting_values() -> dict[str, Any]:
    """Newton iterations from the plain start and from the improved one, over the same points."""
    scene = scenes.random_points(POINTS, seed=1)
    improved = qs.solve(scene).iterations
    plain = qs.solve(scene, start=scenes.plain_start(scene)).iterations

    def summary(iterations: np.ndarray) -> dict[str, float]:
        return {
            "mean": float(f"{iterations.mean():.3g}"),
            "median": float(np.median(iterations)),
            "p99": float(np.percentile(iterations, 99)),
        }

    return {"points": POINTS, "plain": summary(plain), "improved": summary(improved)}


def against_scipy() -> dict[str, Any]:
    """The same points from the same start by `scipy.optimize.root` and by `solve`."""
    scene = scenes.random_points(SCIPY_POINTS, seed=2)
    start = scenes.plain_start(scene)
    ours = qs.solve(scene, start=start)
    case = solved_of(start).maker.make(0, 1)[0]
    unit = float(case["force"] / case["length"] ** 1.5)
    operation = scene.operation
    problems = [
        scipy_root.Problem(
            scene.bearing,
            float(case["inner_stiffness"]) * unit,
            float(case["outer_stiffness"]) * unit,
            *(float(field[k]) for field in (operation.axial_load, operation.radial_load_y, operation.speed)),
        )
        for k in range(SCIPY_POINTS)
    ]
    starts = [scipy_root.start_of(problem, start, k) for k, problem in enumerate(problems)]
    singles = [single(scene, k) for k in range(SCIPY_POINTS)]
    right, theirs, mine = 0, [], []
    for k, (problem, guess) in enumerate(zip(problems, starts, strict=True)):
        began = time.perf_counter()
        good, displacement = scipy_root.solve(problem, guess)
        theirs.append(time.perf_counter() - began)
        mine.append(timed(lambda k=k: qs.solve(singles[k], threads=1)))
        expected = ours.displacement[k, [0, 1, 4]]
        right += good and bool(np.allclose(displacement, expected, rtol=1e-6, atol=1e-9))
    return {
        "points": SCIPY_POINTS,
        "scipy_right": right,
        "scipy_ms": spread(theirs, 1e-3),
        "solve_right": int(ours.converged.sum()),
        "solve_ms": spread(mine, 1e-3),
    }


def single(scene: qs.Scene, k: int) -> qs.Scene:
    """One point of a batch as a scene of its own."""
    operation = scene.operation
    return scenes.at_speed(
        qs.Operation(
            speed=float(np.asarray(operation.speed)[k]),
            axial_load=float(np.asarray(operation.axial_load)[k]),
            radial_load_y=float(np.asarray(operation.radial_load_y)[k]),
            moment_z=0.0,
        )
    )


def million() -> dict[str, Any]:
    """Peak memory of a process that solves a million points and reads their inner loads' maximum."""
    code = (
        "import resource, numpy as np, qsbearing as qs\n"
        "from tests.verification.benchmarks import scenes\n"
        "solution = qs.solve(scenes.random_points(1_000_000))\n"
        "assert solution.converged.all()\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return {"points": 1_000_000, "peak_memory_MB": round(int(done.stdout.split()[-1]) / 1024)}


def machine() -> dict[str, Any]:
    """Where this was measured."""
    import numba

    model = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        lines = info.read_text(encoding="utf-8").splitlines()
        names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
        model = names[0] if names else model
    return {
        "processor": model,
        "cores": os.cpu_count(),
        "load_average": round(os.getloadavg()[0], 1),
        "python": platform.python_version(),
        "numba": numba.__version__,
        "numpy": np.__version__,
        "qsbearing": qs.__version__,
    }


def main() -> None:
    """Measure everything and write the record."""
    record = {"machine": machine(), "provenance": provenance.of_run("python -m tests.verification.benchmarks.record")}
    for part in (start_up, single_calls, batch, starting_values, against_scipy, million):
        print(f"{part.__name__} ...", file=sys.stderr, flush=True)
        record[part.__name__] = part()
    target = Path(sys.argv[1]) if sys.argv[1:] else RECORD
    target.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(record, indent=1))


if __name__ == "__main__":
    main()
