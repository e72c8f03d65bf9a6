"""The README's timing tables, built from the record: `python -m tests.benchmarks.tables` puts them in."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from fem_check.cost import record as cost_record
from fem_check.cost import tables as cost_tables
from tests.benchmarks.record import RECORD

README = Path(__file__).parents[2] / "README.md"


def between(times: dict[str, float], unit: str) -> str:
    """Median and range."""
    return f"{times['median']:g} {unit} ({times['min']:g} to {times['max']:g})"


def timing(record: dict[str, Any]) -> str:
    """What things cost."""
    start, single, batch, million = (record[name] for name in ("start_up", "single_calls", "batch", "million"))
    machine = record["machine"]
    rows = [
        ("`qsbearing --help`", between(start["help_s"], "s")),
        ("`qsbearing run b218`, from cold", between(start["run_s"], "s")),
        ("the same, the first time, with compilation", f"{start['first_run_with_compilation_s']:g} s"),
        ("one `solve(scene)`, thrust", between(single["thrust"], "µs")),
        ("one `solve(scene)`, combined load, free tilt", between(single["combined"], "µs")),
        (f"{batch['points']:,} random points, one thread", between(batch["one_thread"], "µs a point")),
        (f"{batch['points']:,} random points, two threads", between(batch["two_threads"], "µs a point")),
        (f"{million['points']:,} points: peak memory of the process", f"{million['peak_memory_MB']} MB"),
    ]
    lines = ["| what | median (smallest to largest) |", "|---|---|", *(f"| {what} | {cost} |" for what, cost in rows)]
    lines += [
        "",
        f"{batch['converged']:,} of the {batch['points']:,} points converged, the largest residual being "
        f"{batch['largest_residual']:.0e}. Measured on {machine['cores']} shared cores ({machine['processor']}), "
        f"Python {machine['python']}, numba {machine['numba']}, numpy {machine['numpy']}; the load average was "
        f"{machine['load_average']:g} at the start.",
    ]
    return "\n".join(lines)


def alternatives(record: dict[str, Any]) -> str:
    """Beside what one would write instead, and what the starting values save."""
    scipy, start = record["against_scipy"], record["starting_values"]
    lines = [
        f"| {scipy['points']} random points, one at a time | right | a point |",
        "|---|---|---|",
        f"| `scipy.optimize.root`, all 2Z + 3 unknowns | {scipy['scipy_right']} | {between(scipy['scipy_ms'], 'ms')} |",
        f"| `qsbearing.solve` from the same start | {scipy['solve_right']} | {between(scipy['solve_ms'], 'ms')} |",
        "",
        f"| Newton iterations, {start['points']:,} random points | mean | median | 99 % within |",
        "|---|---|---|---|",
        *(
            f"| {name} | {start[key]['mean']:g} | {start[key]['median']:g} | {start[key]['p99']:g} |"
            for key, name in (
                ("plain", "from pure thrust at rest, all balls at the static angle"),
                ("improved", "from the closed-form thrust balance at speed (the default)"),
            )
        ),
    ]
    return "\n".join(lines)


def filled(readme: str, record: dict[str, Any]) -> str:
    """The README with its tables made anew."""
    made = [("timing", timing(record)), ("alternatives", alternatives(record))]
    finite_elements = cost_record.read()
    if finite_elements is not None:
        made.append(("finite elements", cost_tables.summary(finite_elements)))
    for name, table in made:
        pattern = rf"(<!-- {name}: made by tests/benchmarks/tables.py -->\n).*?(<!-- end of {name} -->)"
        readme, found = re.subn(pattern, lambda m, t=table: f"{m[1]}{t}\n{m[2]}", readme, flags=re.DOTALL)
        if found != 1:
            raise ValueError(f"README.md has {found} places for the table {name}, not one")
    return readme


def main() -> None:
    """Rewrite the README's tables."""
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    README.write_text(filled(README.read_text(encoding="utf-8"), record), encoding="utf-8")


if __name__ == "__main__":
    main()
