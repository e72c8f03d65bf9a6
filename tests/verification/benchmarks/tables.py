"""Tables of the guide and the README, built from the records: `python -m tests.verification.benchmarks.tables` writes
them into the pages, and all else that follows from records."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import qsbearing as qs
from fem_check.cost import record as cost_record
from fem_check.cost import table as cost_table
from fem_check.release import steps
from fem_check.release.steps import RECOMPUTED, SCENES
from fem_check.report import evidence
from fem_check.report import random_scenes as random_scenes_of
from fem_check.report.evidence import Kept
from fem_check.report.figures import sector as sector_figures
from fem_check.report.rows import as_read, difference, quantity, used
from fem_check.rows import row_text
from fem_check.rows.agreement import MeshLevel
from fem_check.running import known, records_store
from qsbearing.model.solution.point_errors import CREEP, HELD
from tests.guide import agreement, claims, interface
from tests.reports import evidence_numbers
from tests.systems.rotor_dynamics import spindle
from tests.verification.benchmarks import before, cost, marked
from tests.verification.benchmarks.record import RECORD
from tests.verification.hard_cases import table as hard_cases_table

GUIDE = Path(qs.__file__).parent / "guide"
ROOT = Path(__file__).parents[3]
GATE = records_store.FOLDER / "gate" / MeshLevel.RELEASE
CAMPAIGNS = GATE / "campaign"

QUANTITIES = {
    "approach": "approach",
    "semi_major_axis": "$a$",
    "semi_minor_axis": "$b$",
    "max_pressure": "$p_0$",
    "max_shear_stress": r"$\tau_{max}$",
}
HALF_SPACE_CHECKS = ("half_space_contacts",)


def read(path: Path) -> Any:
    """A record."""
    return json.loads(path.read_text(encoding="utf-8"))


def markdown(headings: list[str], rows: list[list[str]]) -> str:
    """A table."""
    lines = ["| " + " | ".join(headings) + " |", "|" + "---|" * len(headings)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def between(times: dict[str, float], unit: str) -> str:
    """Median and range."""
    return f"{times['median']:g} {unit} ({times['min']:g} to {times['max']:g})"


def timing() -> str:
    """What things cost."""
    record = read(RECORD)
    start, single, batch, million = (record[name] for name in ("start_up", "single_calls", "batch", "million"))
    machine = record["machine"]
    rows = [
        ["`qsbearing --help`", between(start["help_s"], "s")],
        ["`qsbearing run b218`, the first time", between(start["run_s"], "s")],
        ["`qsbearing explain b218`, the first time", between(start["explain_s"], "s")],
        ["one `solve(scene)`, thrust", between(single["thrust"], "µs")],
        ["one `solve(scene)`, combined load, free tilt", between(single["combined"], "µs")],
        [f"{batch['points']:,} random points, one thread", between(batch["one_thread"], "µs per point")],
        [f"{batch['points']:,} random points, two threads", between(batch["two_threads"], "µs per point")],
        [f"{million['points']:,} points: peak memory of the process", f"{million['peak_memory_MB']} MB"],
    ]
    return (
        markdown(["what", "median (smallest to largest)"], rows)
        + f"\n\n{batch['converged']:,} of the {batch['points']:,} points converged, the largest residual being "
        f"{batch['largest_residual']:.0e}. Measured on {machine['cores']} shared cores ({machine['processor']}), "
        f"Python {machine['python']}, numba {machine['numba']}, numpy {machine['numpy']}; the load average was "
        f"{machine['load_average']:g} at the start. Of the three commands the processor time is given, at load average "
        f"{start['load_average']:g}, which makes it longer."
    )


def alternatives() -> str:
    """Beside a general solver, and what the initial guess saves."""
    record = read(RECORD)
    scipy, start = record["against_scipy"], record["starting_values"]
    times = [
        ["`scipy.optimize.root`, all 2Z + 3 unknowns", str(scipy["scipy_right"]), between(scipy["scipy_ms"], "ms")],
        ["`qsbearing.solve` from the same start", str(scipy["solve_right"]), between(scipy["solve_ms"], "ms")],
    ]
    iterations = [
        [name, *(f"{start[key][value]:g}" for value in ("mean", "median", "p99"))]
        for key, name in (
            ("plain", "from pure thrust at rest, all balls at the static angle"),
            ("improved", "from the closed-form thrust equilibrium at speed (the default)"),
        )
    ]
    headings = [f"Newton iterations, {start['points']:,} random points", "mean", "median", "99 % within"]
    return (
        markdown([f"{scipy['points']} random points, one at a time", "correct", "per point"], times)
        + "\n\n"
        + markdown(headings, iterations)
    )


def finite_elements() -> str:
    """What each accuracy costs."""
    record = cost_record.read()
    if record is None:
        raise ValueError("there is no record of `fem-check cost`")
    choices = cost_table.mesh_choices(record)
    return f"{choices.caption}:\n\n{markdown(choices.headings, choices.rows)}"


def contacts() -> str:
    """Largest deviation from Hertz of each check of half-spaces."""
    entries = records_store.read_all()
    rows = []
    for name in HALF_SPACE_CHECKS:
        entry = entries[name]
        worst = {
            quantity: max(abs(row["deviation_percent"]) for row in entry["rows"] if row["quantity"] == quantity)
            for quantity in QUANTITIES
        }
        rows.append([name, entry["level"], entry["verdict"], *(f"{value:.2g}" for value in worst.values())])
    gated = entries[HALF_SPACE_CHECKS[0]]
    rows.append(["tolerance", gated["level"], "", *(f"{_tolerance(gated, name):g}" for name in QUANTITIES)])
    return markdown(["check", "level", "verdict", *QUANTITIES.values()], rows)


def _tolerance(entry: dict[str, Any], quantity: str) -> float:
    return float(next(row["tolerance_percent"] for row in entry["rows"] if row["quantity"] == quantity))


def coverage() -> str:
    """How often the true error of exact cases exceeds its uncertainty."""
    rows = records_store.read_all()["convergence_order"]["rows"]
    (share,) = (row for row in rows if row["quantity"] == "share whose error exceeds its uncertainty")
    return (
        f"{100.0 * share['found']:.2g} % of cases ({share['case']}; at most {share['tolerance_percent']:g} % allowed)"
    )


def sector_costs() -> str:
    """What the sector at the release level takes."""
    entry = records_store.read_all()["bearing_sector"]
    series = entry["pictures"]["bearing_sector"].values()
    count = sum(len(state["load_N"]) for states in series for state in states.values())
    return (
        f"{entry['cpu_seconds'] / 60.0:.0f} minutes of processor time for {count} comparisons, and "
        f"{entry['peak_memory_MB'] / 1e3:.1f} GB of memory"
    )


def true_geometry() -> str:
    """Deviation of B218's true bodies from Hertz."""
    table: dict[str, dict[str, float]] = {}
    for row in records_store.read_all()["true_geometry"]["rows"]:
        case = row["case"].removesuffix(": true contact")
        if case != row["case"]:
            table.setdefault(case, {})[row["quantity"]] = row["deviation_percent"]
    names = [name for name in QUANTITIES if name != "max_shear_stress"]
    rows = [[case, *(f"{found[name]:+.2f}" for name in names)] for case, found in table.items()]
    return markdown(["contact", *(QUANTITIES[name] for name in names)], rows)


SECTOR = {
    "inner load": r"$Q_i$, %",
    "inner angle": r"$\alpha_i$, deg",
    "outer angle": r"$\alpha_o$, deg",
    "inner semi_major_axis": "$a$ inner, %",
    "inner semi_minor_axis": "$b$ inner, %",
    "inner max_pressure": "$p_0$ inner, %",
}


def sector() -> str:
    """One ball between elastic rings: finite elements less model."""
    rows = []
    record = records_store.read_all()["bearing_sector"]
    for support, states in record["pictures"]["bearing_sector"].items():
        for state, curve in states.items():
            for index, load in enumerate(curve["load_N"]):
                found = [(curve[name]["deviation"][index], curve[name]["uncertainty"][index]) for name in SECTOR]
                found.insert(0, sector_figures.micrometres(record, support, state, load))
                cells = (f"{deviation:+.2f} ± {uncertainty:.2f}" for deviation, uncertainty in found)
                rows.append([support, state, f"{load:,.0f}", *cells])
    headings = ["outside diameter", "", "axial load, N", "axial displacement, µm", *SECTOR.values()]
    return markdown(headings, rows)


def gyroscopic_moment() -> str:
    """Angles of B218 at rest, and at speed without and with the gyroscopic moment."""
    scene = qs.load_scene("b218")
    load = scene.operation.axial_load
    at_rest = {"ball_effects": (), "raceway_control": None, "operation": qs.Operation(axial_load=load)}
    scenes = {
        "at rest": dataclasses.replace(scene, **at_rest),
        "at speed, centrifugal force alone": dataclasses.replace(scene, ball_effects=(qs.CentrifugalForce(),)),
        "at speed, and the gyroscopic moment": scene,
    }
    rows = []
    for name, each in scenes.items():
        solution = qs.solve(each)
        rows.append([name, *(f"{angle[0] / qs.deg:.2f}" for angle in (solution.inner.angle, solution.outer.angle))])
    return markdown(["", r"$\alpha_i$, deg", r"$\alpha_o$, deg"], rows)


def campaigns_of(names: dict[MeshLevel, dict[str, int]]) -> list[Any]:
    """Those of these that are on record."""
    paths = (CAMPAIGNS / name / "summary.json" for name in sorted(names[MeshLevel.RELEASE]))
    return [read(path) for path in paths if path.is_file()]


def random_scenes() -> str:
    """What the README says of single bearings, each envelope by itself, as page 1 of the validation report counts it;
    and whether any campaign has a wrong result."""
    all_of = evidence.read()
    single = [random_scenes_of.scenes(kept) for kept in all_of.campaigns]
    lost = ", ".join(f"{one.not_converged.partition(' ')[0]} of {one.count:,} {one.name}" for one in single)
    wrong = sum(random_scenes_of.scenes(kept).wrong for kept in all_of.random_scenes)
    link = "([hard cases](qsbearing/guide/hard_cases.md))"
    return f"Not converged: {lost}\nrandom bearings; wrong in {len(all_of.random_scenes)} campaigns: {wrong} {link}"


def strength(record: dict[str, Any]) -> str:
    """How many refusals of a campaign are proved, have evidence, or neither."""
    one = random_scenes_of.scenes(Kept("", record, ""))
    each = {"proved": one.proved, "with evidence": one.evidence, "not proved": one.unproved}
    return ", ".join(f"{number:,} {word}" for word, number in each.items() if number) or "none"


def campaigns() -> str:
    """Every recorded campaign of random scenes."""
    rows = []
    for record in campaigns_of(SCENES):
        classes = record["classes"]
        wrong = record["bar"]["failures"] if "bar" in record else record["failures_total"]
        iterations = record["iterations_of_converged"]
        rows.append(
            [
                record.get("envelope", "wild"),
                str(record["seed"]),
                *(f"{number:,}" for number in (record["count"], classes["converged"])),
                f"{classes.get('no_equilibrium', 0):,} ({strength(record)})",
                *(f"{number:,}" for number in (classes.get("not_converged", 0), wrong)),
                " / ".join(f"{iterations[key]:,}" for key in ("median", "99 %", "most")),
                f"{max(record['largest'].values()):.0e}",
            ]
        )
    headings = ["envelope", "seed", "scenes", "converged", "no equilibrium", "not converged", "wrong"]
    return markdown([*headings, "iterations: median / 99 % / most", "largest imbalance"], rows)


SHOWN = {"error of the gives": "error of the ring deflections", "give over thickness": "deflection over thickness"}
"""Names of the records as the guide prints them."""


def recomputed() -> str:
    """Every recorded campaign of cases recomputed from what their solutions say."""
    rows = []
    for record in campaigns_of(RECOMPUTED):
        ended = record["ended"]
        refused, lost = (known.of_status(ended, status) for status in (known.REFUSED, "not_converged"))
        wrong = len(record["wrong"])
        worst = ", ".join(f"{SHOWN.get(name, name)} {value:.1g}" for name, value in record["largest"].items())
        counts = (f"{record['count']:,}", f"{ended['converged']:,}", f"{refused:,} ({strength(record)})", f"{lost:,}")
        rows.append([record["campaign"].replace("_", " "), str(record["seed"]), *counts, f"{wrong:,}", worst])
    headings = ["cases", "seed", "number", "converged", "no equilibrium", "not converged", "wrong", "largest"]
    return markdown(headings, rows)


def hard_cases() -> str:
    """How the named hard cases ended."""
    cases = read(hard_cases_table.DATA)["cases"]
    within = sum(case["verdict"] == "within 1e-9" for case in cases)
    expected = sum(case["verdict"] == "as expected" for case in cases)
    return markdown(
        ["cases", "within 1e-9 of their 50-digit solution", "without one, as expected", "otherwise"],
        [[str(number) for number in (len(cases), within, expected, len(cases) - within - expected)]],
    )


def free_ball() -> str:
    """Every row of the ball that only Newton's and Euler's laws move."""
    rows = []
    for row in records_store.read_all()["free_ball"]["rows"]:
        told, unit = row_text.of_row(row), row_text.in_unit(row)[1]
        numbers = (row_text.with_unit(each, unit if unit != "1" else "") for each in (told.reference, told.found))
        share = f"{100.0 * used(row):.0f} %" if row["tolerance_percent"] else ""
        rows.append([as_read(row["case"]), quantity(row["quantity"]), *numbers, difference(row), told.tolerance, share])
    headings = ["case", "", "by Newton's laws", "qsbearing", "difference", "limit", "of the limit"]
    return markdown(headings, rows)


def critical_speeds() -> str:
    """Of the guide's spindle, against preload."""
    rows = [
        [f"{int(preload):,}", *(f"{found[kind]:,.0f}" for kind in spindle.KINDS)]
        for preload, found in spindle.read()["critical_speed_rpm"].items()
    ]
    headings = ["preload, N", *(f"stiffness {name}, rpm" for name in spindle.KINDS.values())]
    return markdown(headings, rows)


def tilts() -> str:
    """The same, by what stands for tilts."""
    found = spindle.read()["tilt_rpm"]
    whole = next(iter(found.values()))
    rows = [
        [name, f"{rpm:,.0f}", f"{100.0 * (rpm / whole - 1.0):+.1f}" if rpm != whole else ""]
        for name, rpm in found.items()
    ]
    return markdown(["`tilt`", "rpm", "difference, %"], rows)


def errors_of_points() -> str:
    """Of friction with the usual points of a contact."""
    rows = [
        [f"{of.balls}, {of.cases:,} cases", name, *(f"{100.0 * part:.2g} %" for part in each)]
        for of in (HELD, CREEP)
        for name, each in of.errors.items()
    ]
    return markdown(["balls", "error of", "median", "in 95 of 100 less than", "largest"], rows)


NAMED_STEPS = 6
"""Of the gate, the longest of each kind."""
AT_ONCE = {"first, on all cores": 1, "on one core, two at a time": 2, "alone, at the end": 1}
"""Kinds of steps of the gate by how they run, and how many of a kind run at once."""


def gate_minutes() -> str:
    """How long the last gate took, by how its steps run; those that are new since have no time."""
    done = read(GATE / "steps.json")["steps"]
    first, shared, alone = AT_ONCE
    kinds: dict[str, list[tuple[float, str]]] = {}
    for step in steps.all_steps(MeshLevel.RELEASE):
        kind = first if step.is_first else alone if step.is_alone else shared
        if step.name in done:
            kinds.setdefault(kind, []).append((done[step.name]["seconds"] / 60.0, step.name.removeprefix("check ")))
    rows = []
    for kind, found in kinds.items():
        found.sort(reverse=True)
        named = ", ".join(f"{name} {minutes:.1f}" for minutes, name in found[:NAMED_STEPS])
        others = f", {len(found) - NAMED_STEPS} others" if len(found) > NAMED_STEPS else ""
        whole = sum(minutes for minutes, _ in found) / AT_ONCE[kind]
        rows.append([kind, f"{whole:.0f}", f"{named}{others}"])
    return markdown(["steps that run", "minutes of the clock", "minutes of each"], rows)


PAGES: dict[str, dict[str, Callable[[], str]]] = {
    "model.md": {"gyroscopic moment": gyroscopic_moment},
    "accuracy.md": {"cost": lambda: cost.table(cost.load())},
    "ball_axis.md": {"errors of points": errors_of_points},
    "timing.md": {
        "timing": timing,
        "before": lambda: before.table(before.load()),
        "alternatives": alternatives,
    },
    "finite_elements.md": {
        "contacts": contacts,
        "true geometry": true_geometry,
        "sector": sector,
        "finite elements": finite_elements,
        "coverage": coverage,
        "costs of the sector": sector_costs,
    },
    "rotor_dynamics.md": {"critical speeds": critical_speeds, "tilts": tilts},
    "free_ball.md": {"free ball": free_ball},
    "hard_cases.md": {"campaigns": campaigns, "recomputed cases": recomputed, "hard cases": hard_cases},
    "interface.md": {
        "files": lambda: interface.table("files", "table"),
        "python": lambda: interface.table("python", "in"),
        "commands": lambda: interface.table("commands", "command"),
        "json": lambda: interface.table("json", "in"),
    },
    "releasing.md": {"minutes of the gate": gate_minutes, "numbers of the README": claims.table},
    "README.md": {"random scenes": random_scenes},
}
"""Pages, and the tables of each."""


def path_of(page: str) -> Path:
    """The README's, or that of a page of the guide."""
    return ROOT / page if page == "README.md" else GUIDE / page


def filled(page: str) -> str:
    """A page with its tables made anew."""
    text = path_of(page).read_text(encoding="utf-8")
    for name, make in PAGES[page].items():
        text = marked.filled(text, name, make())
    return text


def main() -> None:
    """Rewrite the tables of every page, the page of B218's agreement, the list of hard cases, the pictures of what
    accuracy costs, and the numbers of the design report's evidence."""
    evidence_numbers.main()
    agreement.main()
    cost.draw()
    hard_cases_table.TABLE.write_text(hard_cases_table.markdown(read(hard_cases_table.DATA)["cases"]), encoding="utf-8")
    for page in PAGES:
        path_of(page).write_text(filled(page), encoding="utf-8")


if __name__ == "__main__":
    main()
