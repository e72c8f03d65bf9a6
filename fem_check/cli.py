"""`fem-check`: list, run, book, contact, cost, report, release. It formats and calls; the checks compute."""

from __future__ import annotations

import importlib.util
import json
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

import click
from rich.box import SIMPLE
from rich.console import Console, Group
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from fem_check.release.command import release

RESULTS = "fem_check_results"
"""The working folder's own folder, unless another is named."""

OUT_OF_TOLERANCE = 1
BAD_INPUT = 2

# The number that a quantity is shown with, and its unit.
DISPLAY = {"m": (1e6, "µm"), "Pa": (1e-6, "MPa")}


def refuse(message: str) -> NoReturn:
    """Say what is wrong, on stderr, and stop with the exit code for bad input."""
    Console(stderr=True, soft_wrap=True, highlight=False, markup=False).print(f"fem-check: {message}")
    sys.exit(BAD_INPUT)


@contextmanager
def progress_bar(quiet: bool) -> Iterator[Any]:
    """A progress bar on stderr; yields a function that makes a progress callback for a named task."""
    console = Console(stderr=True)
    bar = Progress(
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.fields[stage]}"),
        TimeElapsedColumn(),
        console=console,
        transient=True,
        disable=quiet or not console.is_terminal,
    )
    with bar:
        tasks: dict[str, Any] = {}

        def reporter(name: str) -> Any:
            tasks[name] = bar.add_task(name, total=1.0, stage="")

            def report(stage: str, part: float) -> None:
                bar.update(tasks[name], completed=part, stage=stage)

            return report

        yield reporter


@click.group()
@click.version_option(package_name="qsbearing", prog_name="fem-check")
def cli() -> None:
    """Three-dimensional finite-element checks of the contacts that qsbearing takes from Hertz."""


@cli.command("list")
def list_checks() -> None:
    """List the checks (name, kind, question, tolerance) and the cases of the validation book."""
    checks = _load_checks()
    from fem_check.book.case import EVIDENCE
    from fem_check.book.cases import ALL as CASES

    table = Table(show_lines=False)
    for heading in ("check", "kind", "question", "tolerance"):
        table.add_column(heading, overflow="fold")
    for check in checks.values():
        table.add_row(check.name, str(check.kind), check.question, check.tolerance)
    book = Table(title="fem-check book", show_lines=False)
    for heading in ("case", "evidence", "title"):
        book.add_column(heading, overflow="fold")
    for case in CASES.values():
        book.add_row(case.name, EVIDENCE[case.texts.evidence], case.texts.title)
    Console().print(table, book)


@cli.command("run")
@click.argument("names", nargs=-1, metavar="[CHECK ...]")
@click.option("--level", type=click.Choice(["quick", "release"]), default="quick", show_default=True)
@click.option("--scene", default=None, help="Your bearing: a scene file (TOML) or a name of the catalogue.")
@click.option("--out", default=RESULTS, show_default=True, type=click.Path(path_type=Path, file_okay=False))
@click.option("--json", "as_json", is_flag=True, help="One record per line on stdout, and nothing else.")
def run_checks(names: tuple[str, ...], level: str, scene: str | None, out: Path, as_json: bool) -> None:
    """Run checks, all by default, on B218 or on a bearing of yours.

    Prints each comparison with its reference and keeps the records in a folder.
    """
    _load_checks()
    from fem_check import runner
    from fem_check.agreement import EXAMPLE, Level

    finished: list[str] = []
    failed = False
    console = Console()
    try:
        chosen = runner.selected(names)
        with progress_bar(as_json) as reporter:
            for entry in runner.run(chosen, Level(level), out, lambda check: reporter(check.name), scene or EXAMPLE):
                failed |= entry["verdict"] != "pass"
                finished.append(entry["check"])
                if as_json:
                    print(json.dumps(entry), flush=True)
                else:
                    console.print(agreement_table(entry))
    except runner.BadInputError as problem:
        refuse(str(problem) + _kept(finished, out))
    except KeyboardInterrupt:
        refuse("interrupted" + _kept(finished, out))
    except OSError as problem:
        refuse(f"the records in {out} cannot be written: {problem}")
    if not as_json:
        console.print(f"records: {out / level}", soft_wrap=True, highlight=False)
    sys.exit(OUT_OF_TOLERANCE if failed else 0)


def _kept(finished: list[str], out: Path) -> str:
    return f"\nrecords of {', '.join(finished)} are kept in {out}" if finished else ""


@cli.command("book")
@click.argument("names", nargs=-1, metavar="[CASE ...]")
@click.option("--out", default=RESULTS, show_default=True, type=click.Path(path_type=Path, file_okay=False))
@click.option("--json", "as_json", is_flag=True, help="One record per line on stdout, and nothing else.")
def book_cases(names: tuple[str, ...], out: Path, as_json: bool) -> None:
    """Hold qsbearing against published catalogues, standards and measurements, all cases by default.

    Writes a record, a page and a picture of each case, and an index, into the folder `book` of a folder of results.
    """
    _load_checks()
    from fem_check import book

    try:
        with progress_bar(as_json) as reporter:
            found = book.run_book(names, out, reporter("book"))
    except book.UnknownCaseError as problem:
        refuse(str(problem))
    except OSError as problem:
        refuse(f"the book in {out} cannot be written: {problem}")
    if as_json:
        for entry in found:
            print(json.dumps(entry))
    else:
        table = Table(box=SIMPLE, padding=(0, 1), pad_edge=False)
        for heading in ("case", "kind", "", "found"):
            table.add_column(heading, overflow="fold")
        for entry in found:
            style = {"pass": "green", "fail": "bold red"}[entry["verdict"]]
            table.add_row(entry["case"], entry["kind"], Text(entry["verdict"], style=style), Text(entry["summary"]))
        Console().print(table)
        Console(soft_wrap=True, highlight=False).print(f"pages: {out / 'book' / 'README.md'}")
    sys.exit(OUT_OF_TOLERANCE if any(entry["verdict"] == "fail" for entry in found) else 0)


@cli.command("contact")
@click.option("--scene", required=True, help="A scene file (TOML) or the name of a built-in example.")
@click.option("--race", required=True, help="inner or outer")
@click.option("--load-N", "load", required=True, type=float, help="Normal load of the contact.")
@click.option("--elements", default=None, type=int, help="Per semi-axis; 8 unless an accuracy is asked for.")
@click.option(
    "--accuracy", default=None, type=float, help="Largest relative error; the cheapest mesh for it is chosen."
)
@click.option(
    "--geometry",
    type=click.Choice(["parabolic", "true"]),
    default="parabolic",
    show_default=True,
    help="Half-spaces and Hertz's gap, or ball and ring as they are.",
)
@click.option("--json", "as_json", is_flag=True, help="The record on stdout, and nothing else.")
def contact(
    scene: str,
    race: str,
    load: float,
    elements: int | None,
    accuracy: float | None,
    geometry: str,
    as_json: bool,
) -> None:
    """Solve one contact of a scene and compare it with Hertz."""
    _load_checks()
    from fem_check import memory, meshing, records_store, runner, single_contact
    from fem_check.contact import ContactError
    from fem_check.cost import mesh_choice
    from fem_check.cost import record as cost_record
    from fem_check.meshing import MeshError
    from fem_check.scenes import SceneProblemError, groove_contact

    if not 0.0 < load < float("inf"):
        refuse(f"--load-N {load:g}: a contact carries a positive load")
    if accuracy is not None and not 0.0 < accuracy < 1.0:
        refuse(f"--accuracy {accuracy:g}: a relative error, above 0 and below 1 (1e-3 is a tenth of a per cent)")
    if accuracy is not None and elements is not None:
        refuse("--accuracy and --elements: an accuracy chooses the elements; name one of the two")
    if accuracy is not None and geometry == "true":
        refuse("--accuracy and --geometry true: the meshes of true bodies are chosen by --elements")
    least = single_contact.LEAST_ELEMENTS if geometry == "parabolic" else single_contact.LEAST_TRUE_ELEMENTS
    if elements is not None and elements < least:
        refuse(f"--elements {elements}: at least {least} per semi-axis")
    console = Console(soft_wrap=True, highlight=False)
    try:
        groove = groove_contact(scene, race)
        choices = [None] if accuracy is None else mesh_choice.proposals(accuracy, cost_record.read())
        memory.restart_peak()
        start, cpu = time.perf_counter(), time.process_time()
        for choice in choices:
            sequence = (
                choice.sequence if choice else single_contact.sequence_of(elements or single_contact.USUAL_ELEMENTS)
            )
            if choice and not as_json:
                console.print(choice.message)
            runner.refuse_too_large(meshing.half_space(sequence[-1]).dofs, f"{sequence[-1]} elements per semi-axis")
            with progress_bar(as_json) as reporter:
                findings = single_contact.run(scene, groove, load, sequence, geometry, reporter("contact"), accuracy)
            if accuracy is None:
                break
            reached, quantity = mesh_choice.reached(findings.rows)
            if reached <= accuracy:
                break
        seconds, cpu_seconds = time.perf_counter() - start, time.process_time() - cpu
    except (
        SceneProblemError,
        MeshError,
        ContactError,
        mesh_choice.AccuracyError,
        records_store.RecordError,
        runner.BadInputError,
        ValueError,
    ) as problem:
        refuse(str(problem))
    entry = records_store.record(
        None, "contact", single_contact.level_of(sequence[-1]), findings, seconds, cpu_seconds, memory.peak_MB()
    )
    if accuracy is not None:
        entry["accuracy"] = {"asked": accuracy, "reached": reached, "reached_by": quantity, "sequence": sequence}
    if as_json:
        print(json.dumps(entry))
    else:
        Console().print(agreement_table(entry))
        if accuracy is not None:
            meshes = ", ".join(map(str, sequence))
            console.print(
                f"Accuracy asked: {accuracy:.3g}; reached, uncertainty included: {reached:.1e} "
                f"({quantity.replace('_', ' ')}), with {meshes} elements per semi-axis."
            )
    failed = findings.verdict == "fail" or (accuracy is not None and reached > accuracy)
    sys.exit(OUT_OF_TOLERANCE if failed else 0)


@cli.command("cost")
@click.option("--level", type=click.Choice(["quick", "release"]), default="quick", show_default=True)
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    default="fem_check_results",
    show_default=True,
    help="Folder of results; the record and its picture are written into its folder `cost`.",
)
@click.option("--json", "as_json", is_flag=True, help="The record on stdout, and nothing else.")
def cost(level: str, out: Path, as_json: bool) -> None:
    """Measure error, time and memory for element families and meshes."""
    _load_checks()
    from concurrent.futures.process import BrokenProcessPool

    from fem_check import meshing, records_store, runner
    from fem_check.agreement import Level
    from fem_check.cost import measurement, picture, record, table

    path = record.path_of(level, out)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=path.parent).close()  # before the work, not after it
        finest = max(max(counts) for counts in measurement.MESHES[Level(level)].values())
        runner.refuse_too_large(meshing.half_space(finest).dofs, f"cost at level {level}")
        with progress_bar(as_json) as reporter:
            found = measurement.measure(Level(level), reporter("cost"))
        records_store.replace(path, records_store.text(found))
        records_store.replace(path.with_suffix(".png"), picture.png(found))
    except BrokenProcessPool:
        refuse("a process that solved a contact was ended from outside, as it is when memory runs out")
    except (meshing.MeshError, runner.BadInputError, ValueError) as problem:
        refuse(str(problem))
    except OSError as problem:
        refuse(f"{path.parent} cannot be written: {problem}")
    if as_json:
        print(json.dumps(found))
        return
    console = Console()
    for each in (table.measured(found), table.mesh_choices(found)):
        shown_table = Table(title=each.title, title_justify="left", box=SIMPLE, padding=(0, 1), pad_edge=False)
        for index, heading in enumerate(each.headings):
            shown_table.add_column(heading, justify="right" if index else "left", overflow="fold")
        for row in each.rows:
            shown_table.add_row(*row)
        console.print(shown_table)
    plain = Console(soft_wrap=True, highlight=False, markup=False)
    plain.print(table.remark(found), f"wrote {path}", sep="\n")


@cli.command("report")
@click.option("--out", default=RESULTS, show_default=True, type=click.Path(path_type=Path, file_okay=False))
@click.option(
    "--records",
    default=None,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder of records; unless named, that of --out, or where it has none, those that came with the package.",
)
@click.option(
    "--previous",
    default=None,
    type=click.Path(path_type=Path, file_okay=False, exists=True),
    help="Folder of an earlier release's records, to be compared with.",
)
def report(out: Path, records: Path | None, previous: Path | None) -> None:
    """Write the validation report, HTML and PDF, from records alone; runs no check.

    Exit codes: 0 written, whatever the verdict in it; 2 no records, or a missing dependency.
    """
    _load_checks()
    _check_documents()
    from fem_check import records_store
    from fem_check.report import evidence, files

    try:
        folder = records or (out if records_store.read_all(out) else records_store.FOLDER)
        found = evidence.read(folder)
        written = files.write(found, None if previous is None else evidence.read(previous, alone=True), out)
    except (records_store.RecordError, OSError) as problem:
        refuse(str(problem))
    console = Console(soft_wrap=True, highlight=False)
    console.print(*(f"wrote {path}" for path in written), f"from the records in {folder}", sep="\n")


def _check_documents() -> None:
    missing = [name for name in ("jinja2", "typst", "markdown_it") if importlib.util.find_spec(name) is None]
    if missing:
        refuse(f"the report needs {', '.join(missing)}: pip install 'qsbearing[report]'")


cli.add_command(release)


def _load_checks() -> dict[str, Any]:
    try:
        from fem_check.checks import ALL
    except ImportError as problem:
        refuse(f"{problem}: the finite-element checks need `pip install qsbearing[fem]`")
    return dict(ALL)


def shown(value: float, unit: str) -> tuple[float, str]:
    """A value in the unit that tables use."""
    factor, name = DISPLAY.get(unit, (1.0, "" if unit == "1" else unit))
    return value * factor, name


def agreement_table(entry: dict[str, Any]) -> Group:
    """A record as tables, one per case."""
    style = {"pass": "green", "fail": "bold red"}
    parts: list[Any] = [
        Text.assemble(
            (f"{entry['check']} ({entry['level']}): ", "bold"),
            (entry["verdict"], style[entry["verdict"]]),
            f"   {entry['seconds']:.1f} s, {entry['peak_memory_MB']} MB"
            + (f", {entry['mesh']['dofs']} unknowns, {entry['solver']}" if entry["mesh"].get("dofs") else ""),
        )
    ]
    for case in dict.fromkeys(row["case"] for row in entry["rows"]):
        table = Table(title=case, title_justify="left", box=SIMPLE, padding=(0, 1), pad_edge=False)
        table.add_column("", no_wrap=True)
        for heading in ("reference", "found", "dev. %", "± %", "tol. %"):
            table.add_column(heading, justify="right", no_wrap=True)
        table.add_column("")
        table.add_column("")
        for row in entry["rows"]:
            if row["case"] != case:
                continue
            reference, unit = shown(row["reference"], row["unit"])
            found, _ = shown(row["found"], row["unit"])
            table.add_row(
                f"{row['quantity']} \\[{unit}]" if unit else row["quantity"],
                f"{reference:.6g}",
                f"{found:.6g}",
                f"{row['deviation_percent']:+.2g}",
                "" if row["uncertainty_percent"] is None else f"{row['uncertainty_percent']:.2g}",
                "" if row["tolerance_percent"] is None else f"{row['tolerance_percent']:.2g}",
                Text(row["verdict"], style=style.get(row["verdict"], "")),
                f"worst: {row['worst_at']}" if row["worst_at"] else "",
            )
        parts.append(table)
    return Group(*parts)


def main() -> None:
    """Entry point."""
    cli()
