"""`fem-check contact`: one contact of a scene."""

from __future__ import annotations

import json
import sys
import time

import click

from fem_check.cli.agreement_table import agreement_table
from fem_check.cli.output import FEM, OUT_OF_TOLERANCE, progress_bar, refuse, require
from qsbearing.cli.output import print_table
from qsbearing.documents.model import Paragraph


@click.command("contact")
@click.option("--scene", required=True, help="A scene file (TOML) or a name of the catalogue.")
@click.option("--race", required=True, help="Raceway: inner or outer.")
@click.option("--load-N", "load", required=True, type=float, help="Normal load of the contact [N].")
@click.option("--elements", default=None, type=int, help="Elements per semi-axis; 8 unless --accuracy is given.")
@click.option(
    "--accuracy", default=None, type=float, help="Largest relative error, such as 1e-3; chooses the cheapest mesh."
)
@click.option(
    "--geometry",
    type=click.Choice(["parabolic", "true"]),
    default="parabolic",
    show_default=True,
    help="parabolic: half-spaces and Hertz's gap; true: ball and ring with their real shapes.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the record as JSON, and nothing else.")
def contact(
    scene: str,
    race: str,
    load: float,
    elements: int | None,
    accuracy: float | None,
    geometry: str,
    as_json: bool,
) -> None:
    """Solve one contact of a scene and compare it with Hertz.

    Exit codes: 0 within tolerance, 1 out of tolerance, 2 bad input or a missing dependency.
    """
    require(*FEM)
    from fem_check import memory, meshing, records_store, row_text, runner, single_contact
    from fem_check.contact import ContactError
    from fem_check.cost import mesh_choice
    from fem_check.cost import record as cost_record
    from fem_check.meshing import MeshError
    from fem_check.scenes import SceneProblemError, groove_contact

    if not 0.0 < load < float("inf"):
        refuse(f"--load-N {load:g}: must be above 0 N and finite")
    if accuracy is not None and not 0.0 < accuracy < 1.0:
        refuse(f"--accuracy {accuracy:g}: must be a relative error above 0 and below 1 (1e-3 is 0.1 %)")
    if accuracy is not None and elements is not None:
        refuse("--accuracy and --elements: give only one of them, because --accuracy chooses the elements")
    if accuracy is not None and geometry == "true":
        refuse("--accuracy and --geometry true: --accuracy works for half-spaces only; give --elements instead")
    least = single_contact.LEAST_ELEMENTS if geometry == "parabolic" else single_contact.LEAST_TRUE_ELEMENTS
    if elements is not None and elements < least:
        refuse(f"--elements {elements}: must be at least {least} per semi-axis")
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
                print_table([Paragraph(choice.message)])
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
        print_table(agreement_table(entry))
        if accuracy is not None:
            meshes = ", ".join(map(str, sequence))
            print_table(
                [
                    Paragraph(
                        f"Accuracy asked: {accuracy:.3g}; reached, uncertainty included: "
                        f"{row_text.scientific(reached, 2)} ({row_text.in_words(quantity)}), with {meshes} elements "
                        "per semi-axis."
                    )
                ]
            )
    failed = findings.verdict == "fail" or (accuracy is not None and reached > accuracy)
    sys.exit(OUT_OF_TOLERANCE if failed else 0)
