"""All about what accuracy costs, made anew: `python -m tests.benchmarks.cost`, on a quiet machine about three minutes.

In this order: the reference's answers that the tolerance ladder needs, the table behind `run --accuracy`, the records
of two scenes with their pictures, and the README's table. With `--from-records` only pictures and README; with
`--again` the ladder is measured once more and held against the record: how many ratios lie within their stated spread.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from typing import Any

import qsbearing as qs
from qsbearing.cost import accuracy, answers, figures, measuring, record, settings

# What else of this folder is needed is imported where it is used: each process that measures memory imports this file.
README = Path(__file__).parents[2] / "README.md"
RECORDS = Path(qs.__file__).parent / "cost" / "records"
PICTURES = RECORDS / "pictures"
COMBINED = Path(__file__).with_name("b218_combined.toml")
SCENES: dict[str, tuple[str, tuple[str, ...]]] = {
    "b218": ("b218", ("fidelity",)),
    "b218_combined": (str(COMBINED), record.PARTS),
}
"""Names of the records: the scene, and the parts measured. Under thrust the explicit formula joins the ladder."""

MARK = "cost"


def measure() -> None:
    """Measure and keep the records."""
    RECORDS.mkdir(exist_ok=True)
    for name, (scene, parts) in SCENES.items():
        print(f"{name}: {', '.join(parts)} ...", file=sys.stderr, flush=True)
        found = record.measure(qs.load_scene(scene), settings.FULL, parts=parts)
        (RECORDS / f"{name}.json").write_text(json.dumps(found, indent=1, allow_nan=False) + "\n", encoding="utf-8")


def load(name: str) -> dict[str, Any]:
    """A kept record."""
    return dict(json.loads((RECORDS / f"{name}.json").read_text(encoding="utf-8")))


def draw() -> None:
    """The pictures of the kept records."""
    PICTURES.mkdir(exist_ok=True)
    for name in SCENES:
        found = load(name)
        for picture, make in figures.PICTURES.items():
            part = "speeds" if picture == "speeds" else picture
            if part in found:
                (PICTURES / f"{name}-{picture}.png").write_bytes(figures.png(make(found)))


def table(found: dict[str, Any]) -> str:
    """The README's table: times of the rungs, and errors by speed."""
    places = [place for place in found["fidelity"] if not place["name"].startswith("the scene")]
    own = found["fidelity"][-1]
    speeds = [
        f"{place['name']}, {_power(place['dm_n_mm_rpm'])}" if place["dm_n_mm_rpm"] else "rest" for place in places
    ]
    lines = [
        f"| {found['bearing']}, {found['scene']} | one call | a case of {found['settings']['batch']} | "
        + " | ".join(speeds)
        + " |",
        "|" + "---|" * (3 + len(places)),
    ]
    for k, rung in enumerate(own["rungs"]):
        if rung["one_case_s"] is None:
            continue
        errors = [_errors(place["rungs"][k]) for place in places]
        cells = [rung["words"], _micro(rung["one_case_s"]), _micro(rung["batch_case_s"]), *errors]
        lines.append("| " + " | ".join(cells) + " |")
    machine = found["machine"]
    lines += [
        "",
        f"Errors against the last line: displacements, loads and angles / semi-axes and pressures. Medians of "
        f"{found['settings']['rounds']} interleaved rounds in each of {found['settings']['processes']} processes, in "
        f"brackets 5 % to 95 % of them; {machine['processor']}, {machine['cores']} cores, Python {machine['python']}, "
        f"numba {machine['numba']}, load average {machine['load_average']:g} at the start.",
        "",
        _trial(),
    ]
    return "\n".join(lines)


def _trial() -> str:
    """How `--accuracy` did on scenes that its table was not built from."""
    trial, times = accuracy.table()["trial"], accuracy.table()["trial"]["time_over_expected"]
    by_round = trial["time_within_factor_2_by_round"]
    return (
        f"Of {trial['scenes']} random scenes that its table was not built from, each asked for an accuracy between "
        f"1e-5 and 0.1, `run --accuracy` met it in {trial['met']} and left something out in {trial['simplified']}; the "
        f"solve took {times['median']:g} times as long as expected ({times['low']:g} to {times['high']:g} for nine in "
        f"ten), within a factor 2 in {trial['time_within_factor_2']}: medians of {trial['rounds']} rounds; single "
        f"solves, which also measure what else the machine does, in {', '.join(map(str, by_round))}."
    )


def _errors(rung: dict[str, Any]) -> str:
    if rung["errors"] is None:
        return "-"
    motion = answers.GROUPS["displacements"] + answers.GROUPS["loads and angles"]
    pressing = answers.GROUPS["semi-axes and pressures"]
    pair = [max(rung["errors"][name] or 0.0 for name in names) for names in (motion, pressing)]
    return "0" if pair == [0.0, 0.0] else " / ".join(f"{error:.1g}" for error in pair)


def _micro(time: dict[str, float]) -> str:
    return f"{time['median'] * 1e6:.3g} µs ({time['low'] * 1e6:.3g} to {time['high'] * 1e6:.3g})"


def _power(value: float) -> str:
    return f"{value:.2g}".replace("e+0", "e")


def filled(readme: str, found: dict[str, Any]) -> str:
    """The README with its table made anew."""
    pattern = rf"(<!-- {MARK}: made by tests/benchmarks/cost.py -->\n).*?(<!-- end of {MARK} -->)"
    readme, places = re.subn(pattern, lambda m: f"{m[1]}{table(found)}\n{m[2]}", readme, flags=re.DOTALL)
    if places != 1:
        raise ValueError(f"README.md has {places} places for the table {MARK}, not one")
    return readme


def again(name: str = "b218_combined") -> tuple[int, int]:
    """(ratios within the spread that the record states, ratios) of the ladder measured once more."""
    scene, _ = SCENES[name]
    kept = load(name)
    found = record.measure(qs.load_scene(scene), settings.FULL, parts=("fidelity",))
    within, total = 0, 0
    for one, other in zip(kept["fidelity"], found["fidelity"], strict=True):
        for before, now in zip(one["rungs"], other["rungs"], strict=True):
            for key in ("one_case_over_top", "batch_case_over_top", "memory_MB"):
                if before[key] is None:
                    continue
                total += 1
                inside = measuring.agrees(before[key], now[key])
                within += inside
                if not inside:
                    print(one["name"], before["rung"], key, before[key], now[key])
    return within, total


def main() -> None:
    """Make everything, or with `--from-records` what follows from the records."""
    if sys.argv[1:] == ["--again"]:
        print("{} of {} ratios within their stated spread".format(*again()))
        return
    if sys.argv[1:] not in ([], ["--from-records"]):
        raise SystemExit(__doc__)
    if not sys.argv[1:]:
        from tests.benchmarks import advice, truth

        truth.main()
        advice.main()
        measure()
    draw()
    README.write_text(filled(README.read_text(encoding="utf-8"), load("b218_combined")), encoding="utf-8")


if __name__ == "__main__":
    main()
