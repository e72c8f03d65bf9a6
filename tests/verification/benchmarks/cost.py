"""What accuracy costs, made anew: `python -m tests.verification.benchmarks.cost [FILE]`, on a quiet machine about two
minutes, measures one scene and keeps the record. Its pictures and its table follow with those of the guide."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import qsbearing as qs
from qsbearing.results import provenance
from qsbearing.studies.cost import figures, record
from qsbearing.studies.cost.tables import levels_of, select, worst
from tests.verification.benchmarks import auto_accuracy

SCENE = Path(__file__).with_name("b218_combined.toml")
RECORDS = Path(qs.__file__).parent / "studies" / "cost" / "records"
RECORD = RECORDS / f"{SCENE.stem}.json"
PICTURES = RECORDS / "pictures"


def load() -> dict[str, Any]:
    """The kept record."""
    return dict(json.loads(RECORD.read_text(encoding="utf-8")))


def measure(target: Path) -> None:
    """Measure and keep the record."""
    found = record.measure(qs.load_scene(SCENE), record.FULL, lambda text: print(text, file=sys.stderr, flush=True))
    found["provenance"] = provenance.of_run("python -m tests.verification.benchmarks.cost")
    rows = {key: found.pop(key) for key in ("measured", "errors")}
    # One row a line: the differences of two records can be read.
    parts = [f" {json.dumps(key)}: {json.dumps(value)}" for key, value in found.items()]
    for key, listed in rows.items():
        lines = ",\n  ".join(map(json.dumps, listed))
        parts.append(f" {json.dumps(key)}: [\n  {lines}\n ]")
    target.write_text("{\n" + ",\n".join(parts) + "\n}\n", encoding="utf-8")


def draw() -> None:
    """The pictures of the kept record."""
    PICTURES.mkdir(exist_ok=True)
    for name, make in figures.PICTURES.items():
        (PICTURES / f"{RECORD.stem}-{name}.png").write_bytes(figures.png(make(load())))


def table(found: dict[str, Any]) -> str:
    """The table: times of the levels, and errors by speed."""
    named = [row for row in select(found["errors"], level=levels_of(found)[0].name) if row["speed"] is not None][:-1]
    speeds = [f"{row['speed']}, {_power(row['dm_n_mm_rpm'])}" if row["dm_n_mm_rpm"] else "rest" for row in named]
    settings, machine = found["settings"], found["machine"]
    heading = [f"{found['bearing']}, {found['scene']}", "one call", f"a case of {settings['batch']}", *speeds]
    lines = [f"| {' | '.join(heading)} |", "|" + "---|" * len(heading)]
    for level in levels_of(found):
        times = [_micro(row["case_s"]) for row in select(found["measured"], part="levels", name=level.name)]
        errors = [_errors(row) for row in select(found["errors"], level=level.name) if row["speed"] is not None][:-1]
        lines.append(f"| {' | '.join([level.text, *times, *errors])} |")
    lines += [
        "",
        "Each line adds one effect to the line above. The last four columns give the relative errors against the last "
        "line: of displacement, loads and angles / of pressures. Times are processor times: medians of "
        f"{settings['rounds']} rounds in each of {settings['processes']} processes, with the range from 5 % to 95 % of "
        f"them in brackets. Measured on {machine['processor']}, {machine['cores']} cores, Python {machine['python']}, "
        f"numba {machine['numba']}, load average {machine['load_average']:g} at the start.",
        "",
        _trial(),
    ]
    return "\n".join(lines)


def _trial() -> str:
    """How the automatic choice does on random scenes."""
    trial = json.loads(auto_accuracy.RECORD.read_text(encoding="utf-8"))
    kept, worst = trial["within_tolerance"], trial["worst"][0]
    return (
        f'Of {trial["scenes"]} random operating points, `effects = "auto"` at {trial["tolerance"]:g} kept all results '
        f"within this tolerance at {kept}, and left out at least one effect at {trial['something_left_out']}. The "
        f"largest error is {worst['error']:.3g} ({worst['quantity'].replace('_', ' ')}). At {trial['solved_once']} "
        f"points the indicators were sufficient, with one solution; on average, {trial['solves_mean']:g} "
        "solutions were needed."
    )


def _errors(row: dict[str, Any]) -> str:
    pair = [worst(row, names) for names in (("contact_angle", "load", "displacement"), ("pressure",))]
    return "0" if pair == [0.0, 0.0] else " / ".join("-" if error is None else f"{error:.1g}" for error in pair)


def _micro(time: dict[str, float]) -> str:
    return f"{time['median'] * 1e6:.3g} µs ({time['low'] * 1e6:.3g} to {time['high'] * 1e6:.3g})"


def _power(value: float) -> str:
    return f"{value:.2g}".replace("e+0", "e")


def main() -> None:
    """Measure, keep."""
    measure(Path(sys.argv[1]) if sys.argv[1:] else RECORD)


if __name__ == "__main__":
    main()
