"""`fem-check contact`: chosen contacts of a scene against Hertz."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import click

from fem_check.cli.output import FEM, OUT_OF_TOLERANCE, progress_bar, refuse, require
from fem_check.cli.ring_options import ring_options, set_ring_options
from qsbearing.cli.output import print_table, print_text
from qsbearing.documents.model import Paragraph
from qsbearing.model.validation import printable


@click.command("contact", short_help="Solve contacts of a bearing and compare them with Hertz.")
@click.option("--scene", required=True, help="A scene file (TOML) or a name of the catalogue.")
@click.option("--race", default="both", show_default=True, help="Raceway: inner, outer or both.")
@click.option(
    "--load-N",
    "load_texts",
    multiple=True,
    metavar="Q[,Q...]",
    help="Normal loads of the contact [N], separated by commas; by default those of the scene's own balls.",
)
@click.option(
    "--angle",
    "angle_text",
    default=None,
    metavar="free|loaded|DEG",
    help="Contact angle: free, loaded, or in degrees; by default free with --load-N, loaded for the scene's own loads.",
)
@click.option("--elements", default=None, type=int, help="Elements per semi-axis; 8 unless --accuracy is given.")
@click.option(
    "--accuracy", default=None, type=float, help="Largest relative error, such as 1e-3; chooses the cheapest mesh."
)
@click.option(
    "--geometry",
    type=click.Choice(["parabolic", "true", "both"]),
    default="parabolic",
    show_default=True,
    help="parabolic: half-spaces and Hertz's gap; true: ball and ring with their real shapes, about a minute each; "
    "both: side by side.",
)
@ring_options
@click.option(
    "--out",
    default=None,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for the table (CSV, JSON, HTML) and the fields for ParaView (VTU).",
)
@click.option("--json", "as_json", is_flag=True, help="Print the record as JSON, and nothing else.")
def contact(
    scene: str,
    race: str,
    load_texts: tuple[str, ...],
    angle_text: str | None,
    elements: int | None,
    accuracy: float | None,
    geometry: str,
    out: Path | None,
    as_json: bool,
    **rings: float | None,
) -> None:
    """Solve contacts of a scene at chosen loads and compare them with Hertz, in one table.

    Exit codes: 0 within tolerance, 1 out of tolerance, 2 bad input or a missing dependency.
    """
    require(*FEM, *([] if out is None else ["jinja2"]))
    from fem_check import meshing
    from fem_check.contacts import chosen, files, half_spaces, record, run, shown, true_bodies
    from fem_check.cost import mesh_choice
    from fem_check.cost import record as cost_record
    from fem_check.mechanics.contact import ContactError
    from fem_check.meshing import MeshError
    from fem_check.product.scenes import SceneProblemError
    from fem_check.rows import row_text
    from fem_check.running import memory, records_store, runner

    faults: list[str] = []
    loads, angle = _loads(load_texts, faults), _angle(angle_text, faults)
    if accuracy is not None and not 0.0 < accuracy < 1.0:
        faults.append(f"--accuracy {accuracy:g}: must be a relative error above 0 and below 1 (1e-3 is 0.1 %)")
    if accuracy is not None and elements is not None:
        faults.append("--accuracy and --elements: give only one of them, because --accuracy chooses the elements")
    if accuracy is not None and geometry != "parabolic":
        faults.append(
            f"--accuracy and --geometry {geometry}: --accuracy works for half-spaces only; give --elements instead"
        )
    given = [f"--{name.replace('_', '-')}-mm" for name, value in rings.items() if value is not None]
    if given and geometry == "parabolic":
        faults.append(f"{', '.join(given)}: half-spaces have no rings; give --geometry true or both too")
    least = half_spaces.LEAST_ELEMENTS if geometry == "parabolic" else true_bodies.LEAST_ELEMENTS
    if elements is not None and elements < least:
        faults.append(f"--elements {elements}: must be at least {least} per semi-axis")
    if faults:
        refuse("\nfem-check: ".join(faults))
    elements = elements or half_spaces.USUAL_ELEMENTS
    set_ring_options(rings)
    try:
        contacts = chosen.chosen(scene, race, loads, angle)
        choices = [None] if accuracy is None else mesh_choice.proposals(accuracy, cost_record.read())
        memory.restart_peak()
        start, cpu = time.perf_counter(), time.process_time()
        for choice in choices:
            sequence = choice.sequence if choice else half_spaces.sequence_of(elements)
            if choice and not as_json:
                print_table([Paragraph(choice.message)])
            runner.refuse_too_large(meshing.half_space(sequence[-1]).dofs, f"{sequence[-1]} elements per semi-axis")
            with progress_bar(as_json) as reporter:
                if geometry == "true":
                    outcome = run.of_true_bodies(contacts, elements, reporter("contact"))
                elif geometry == "both":
                    outcome = run.of_both(contacts, sequence, elements, reporter("contact"))
                else:
                    outcome = run.of_half_spaces(contacts, sequence, accuracy, reporter("contact"))
            if accuracy is None:
                break
            reached, quantity = mesh_choice.reached(outcome.findings.rows)
            if reached <= accuracy:
                break
        seconds, cpu_seconds = time.perf_counter() - start, time.process_time() - cpu
        level = half_spaces.level_of(sequence[-1])
        entry: record.ContactsRecord = {
            **records_store.record(
                None, "contact", level, outcome.findings, seconds, cpu_seconds, memory.peak_MB(), scene
            ),
            **outcome.known,
        }
        if accuracy is not None:
            entry["accuracy"] = {"asked": accuracy, "reached": reached, "reached_by": quantity, "sequence": sequence}
        written = [] if out is None else files.write(entry, outcome.maps(), outcome.fields(), out)
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
    except OSError as problem:
        refuse(f"--out {out}: the files cannot be written: {problem.strerror or problem}")
    if as_json:
        print(json.dumps(entry))
    else:
        print_table(shown.for_terminal(entry))
        if accuracy is not None:
            print_table(
                [
                    Paragraph(
                        f"Accuracy asked: {accuracy:.3g}; reached, uncertainty included: "
                        f"{row_text.scientific(reached, 2)} ({row_text.in_words(quantity)}), with "
                        f"{', '.join(map(str, sequence))} elements per semi-axis."
                    )
                ]
            )
        if written:
            print_text(f"files: {', '.join(path.name for path in written)} in {printable(str(out))}\n")
    failed = outcome.findings.verdict == "fail" or (accuracy is not None and reached > accuracy)
    sys.exit(OUT_OF_TOLERANCE if failed else 0)


def _loads(texts: Sequence[str], faults: list[str]) -> list[float]:
    """The loads of all options, each once [N]."""
    loads: list[float] = []
    for text in (part.strip() for whole in texts for part in whole.split(",")):
        try:
            load = float(text)
        except ValueError:
            faults.append(f"--load-N {text!r}: must be a number of newtons; several are separated by commas")
            continue
        if not 0.0 < load < float("inf"):
            faults.append(f"--load-N {text}: must be above 0 N and finite")
        elif load not in loads:
            loads.append(load)
    return loads


def _angle(text: str | None, faults: list[str]) -> str | float | None:
    """The contact angle: free, loaded or a number [degrees]."""
    if text in (None, "free", "loaded"):
        return text
    try:
        degrees = float(text)
    except ValueError:
        degrees = float("nan")
    if not 0.0 <= degrees < 90.0:
        faults.append(f"--angle {text}: must be free, loaded, or an angle from 0 to below 90 degrees")
    return degrees
