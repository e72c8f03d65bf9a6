"""What accuracy costs one's own scene, within ten seconds: a table to choose a model level from.

    kind, version, machine, bearing, scene    as in `qsbearing.studies.cost.record`
    seconds                                   processor time that all of it may take
    levels     [{level, text, errors {quantity: error}, costs [{cases, seconds, measured}], is_asked}]
    elements   {contact, method, error, seconds, date}, or null where no record of finite elements is installed

`errors` are those at the scene's own operating point against the last level, as `qsbearing.model.solution.comparison`
counts them; null where one of the two has no solution. `costs` are processor times of one thread for so many cases
in one call; what would take too long is extrapolated from the most cases that were measured (`measured` false), at
the same time a case. Finite elements are never run: error (against Hertz) and time are those of their own record, on
its machine, for one of the contacts alone.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.documents.numbers import duration, plain
from qsbearing.model.effects import EFFECTS, QUANTITIES
from qsbearing.model.scene.arched_rings import NOTHING_TO_COMPARE, refuse_arched
from qsbearing.model.solution import comparison
from qsbearing.model.version import __version__
from qsbearing.studies.chooser.choose import completed, without
from qsbearing.studies.cost import measuring, speeds
from qsbearing.studies.cost.record import BASE, added, name_of, short_number, solve_one, text_of_loads
from qsbearing.studies.cost.speeds import Requested

BUDGET = 9.0
"""Processor time in seconds that solving may take: with the start of the program and the table, ten."""
COUNTS = (1, 10, 100, 1_000, 10_000)
"""Cases in one call, as far as the time goes."""
SHOWN = {1: "1\ncase", 1_000: "1,000\ncases", 1_000_000: "1e6\ncases"}
"""Cases whose time is given, and the headings of their columns."""
ROUNDS = 5
"""Of the calls with one case, each in turn; more cases average by themselves."""

Level = tuple[str, str, Requested]
"""Its key, its words, and the scene or set at that level."""


def levels(scene: Any) -> list[Level]:
    """From nothing that may be left out to the full model: each adds one effect or choice to that before.

    Effects with parameters, such as ring expansion, are there where the scene names them.
    """
    full = completed(scene)
    entries = [entry for entry in EFFECTS if not entry.hypothesis and entry.coarser(full) is not full]
    steps: list[Level] = [("coarsest", BASE, without(full, reversed(entries)))]
    for count, entry in enumerate(entries, start=1):
        steps.append((entry.name, added(entry), without(full, reversed(entries[count:]))))
    is_one_of_them = any(of == scene for _, _, of in steps)
    return steps if is_one_of_them else [("as_given", "the scene as it is", scene), *steps]


def measure(scene: Requested, progress: Callable[[str], None] = lambda text: None) -> dict[str, Any]:
    """The table as data, in the form above.

    Args:
        scene: bearing or set and its operation.
        progress: told what is being measured, before each of `COUNTS`.
    """
    refuse_arched(getattr(scene, "bearing", None), "`cost`", NOTHING_TO_COMPARE)
    began = measuring.now()
    listed = levels(scene)
    full = solve_one(listed[-1][2])
    rows: list[dict[str, Any]] = []
    for name, text, of in listed:
        errors = comparison.by_quantity(solve_one(of), full)
        row: dict[str, Any] = {
            "level": name,
            "text": text,
            "errors": {each: short_number(errors[each]) for each in QUANTITIES},
        }
        rows.append(row | {"is_asked": of == scene})
    times = _timed([of for _, _, of in listed], began + BUDGET, progress)
    for k, row in enumerate(rows):
        row["costs"] = [_cost(cases, {count: seconds[k] for count, seconds in times.items()}) for cases in SHOWN]
    return {
        "kind": "qsbearing cost, one scene",
        "version": __version__,
        "machine": measuring.machine(),
        "bearing": name_of(scene),
        "scene": text_of_loads(scene),
        "seconds": BUDGET,
        "definition": comparison.__doc__,
        "levels": rows,
        "elements": elements(),
    }


def _timed(scenes: list[Requested], end: float, progress: Callable[[str], None]) -> dict[int, list[float]]:
    """Seconds of one call of each, by the number of cases: so many as fit before the end, and one case in any event."""
    times: dict[int, list[float]] = {}
    for count in COUNTS:
        rounds = ROUNDS if count == 1 else 2
        if times and measuring.now() + rounds * sum(times[last := max(times)]) * count / last > end:
            break
        progress(f"{count:,} cases in one call")
        calls = [partial(solve_one, speeds.batch(each, count), threads=1) for each in scenes]
        turns = [[measuring.seconds_of(call) for call in calls] for _ in range(rounds)]
        times[count] = [min(each) for each in zip(*turns, strict=True)]
    return times


def _cost(cases: int, times: dict[int, float]) -> dict[str, Any]:
    if cases in times:
        return {"cases": cases, "seconds": float(f"{times[cases]:.3g}"), "measured": True}
    most = max(count for count in times if count < cases)
    return {"cases": cases, "seconds": float(f"{times[most] * cases / most:.3g}"), "measured": False}


def elements() -> dict[str, Any] | None:
    """The finest mesh of the record of what finite elements cost; the package that makes it is not imported."""
    package = find_spec("fem_check")
    if package is None or package.origin is None:
        return None
    path = Path(package.origin).parent / "records" / "cost" / "release.json"
    if not path.is_file():
        return None
    record = json.loads(path.read_text(encoding="utf-8"))
    best = min(record["meshes"], key=lambda mesh: mesh["worst_error"])
    method = f"{best['family'].partition(',')[0]}, {best['elements_per_semi_axis']} a semi-axis"
    return {
        "contact": record["contact"],
        "method": method,
        "error": short_number(best["worst_error"]),
        "seconds": best["seconds"]["median"],
        "date": record["provenance"]["date"][:10],
    }


GROUPS = {
    "displ.": ("displacement",),
    "loads,\nangles": ("load", "contact_angle"),
    "pres-\nsures": ("pressure",),
    "stiff-\nness": ("stiffness",),
}
"""Columns of errors: their quantities."""


def blocks(record: dict[str, Any]) -> list[Block]:
    """The data as paragraphs and one table."""
    rows = []
    for row in record["levels"]:
        shown = [_percent([row["errors"][name] for name in names]) for names in GROUPS.values()]
        mark = " ←" if row["is_asked"] else ""
        rows.append((row["text"] + mark, *shown, *map(_duration, row["costs"])))
    said: list[Block] = [
        Paragraph(f"{record['bearing']}  {record['scene']}", record["bearing"] or ""),
        Paragraph(measuring.in_a_line(record["machine"])),
    ]
    how = (
        "←: this scene. Errors against the last level, at this operating point. Processor time of one thread; *: not "
        "measured, at the time a case of the most cases that were."
    )
    if fe := record["elements"]:
        time = _duration({"seconds": fe["seconds"], "measured": True})
        rows.append(("one contact by finite elements †", "", "", _percent([fe["error"]]), "", time, "", ""))
        how += (
            f" †: {fe['contact']}, {fe['method']}, error of all its results against Hertz: from the record of "
            f"{fe['date']} on its machine, not run here."
        )
    return [
        *said,
        Table(("error in %, time", *GROUPS, *SHOWN.values()), rows, caption="What accuracy costs"),
        Paragraph(how, is_apart=True),
    ]


def _percent(errors: list[float | None]) -> str:
    """The largest, in per cent to two digits; "-" where one has no number."""
    known = [100.0 * error for error in errors if error is not None]
    return plain(max(known), ".2g") if len(known) == len(errors) else "-"


def _duration(cost: dict[str, Any]) -> str:
    """Of a cost, with a star where it was not measured."""
    return duration(cost["seconds"]) + "*" * (not cost["measured"])
