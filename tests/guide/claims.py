"""What the README states with numbers, made from records or by a run: its sentences hold these words, and the guide's
page on releases names the command that makes each again."""

from __future__ import annotations

import json
import re
import shlex
from functools import cache
from typing import Any, NamedTuple

from click.testing import CliRunner

from fem_check.running import records_store
from qsbearing.cli import cli
from tests.reports import evidence_numbers
from tests.verification.benchmarks import record

B218 = "qsbearing run b218"
FRICTION_RANGE = [0.03, 0.1]
FRICTION = f"{B218} --set effects.raceway_control=friction --set 'effects.traction.friction_range={FRICTION_RANGE}'"


class Claim(NamedTuple):
    """A part of a sentence of the README."""

    says: str
    command: str
    """Makes its numbers again."""


def of_run(*words: str) -> dict[str, Any]:
    """The record of a run of B218."""
    return dict(json.loads(CliRunner().invoke(cli, ["run", "b218", *words, "--json"]).stdout))


@cache
def all_claims() -> list[Claim]:
    """In the order of the README."""
    return [*_of_b218(), *_of_time(), *_of_scenes(), *_of_elements(), _of_catalogues(), *_of_friction()]


def _of_b218() -> list[Claim]:
    loaded, resting = (of_run(*words)["balls"][0] for words in ((), ("--set", "operation.speed_rpm=0")))
    more = 100.0 * (loaded["outer"]["load_N"] / loaded["inner"]["load_N"] - 1.0)
    return [
        Claim(f"contact angles would be {resting['inner']['angle_deg']:.1f}°", f"{B218} --set operation.speed_rpm=0"),
        Claim(f"the outer raceway carries {more:.0f} % more load", B218),
    ]


def _of_time() -> list[Claim]:
    made = json.loads(record.RECORD.read_text(encoding="utf-8"))
    single, batch = made["single_calls"]["combined"], made["batch"]
    says = (
        f"solves a case in {single['median']:.0f} µs, {batch['points']:,} at once in "
        f"{batch['one_thread']['median']:.1f} µs each"
    )
    return [Claim(says, made["provenance"]["command"])]


def _of_scenes() -> list[Claim]:
    """The sentence itself is made by the tables of the README."""
    found = []
    for path in sorted((records_store.FOLDER / "gate/release/campaign").glob("*/summary.json")):
        made = json.loads(path.read_text(encoding="utf-8"))
        if "envelope" in made:
            says = f"{len(made['not_converged'])} of {made['count']:,} {made['envelope']}"
            found.append(Claim(says, made["provenance"]["command"]))
    fifty = evidence_numbers.reference()
    table = evidence_numbers.read("tests/verification/reference/table.json")
    assert fifty["largest"] <= table["tolerance"]
    says = f"{fifty['scenes']} scenes against an independent solution with 50 digits agree to {table['tolerance']:.0e}"
    return [*found, Claim(says, table["provenance"]["command"])]


JUDGED = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure", "max_shear_stress")
"""Of contacts on half-spaces."""


def _of_elements() -> list[Claim]:
    made = evidence_numbers.read(f"{evidence_numbers.RELEASE}/half_space_contacts.json")
    rows = [each for each in made["rows"] if each["quantity"] in JUDGED]
    deviation, uncertainty = (
        evidence_numbers.largest(each[f"{name}_percent"] for each in rows) for name in ("deviation", "uncertainty")
    )
    sector = evidence_numbers.bearing_sector()
    held = max(map(abs, sector["rigid"]["load_percent"]))
    command = evidence_numbers.read(f"{evidence_numbers.RELEASE}/bearing_sector.json")["provenance"]["command"]
    return [
        Claim(
            f"Finite elements of half-spaces agree with Hertz within {deviation:.1g} % (± {uncertainty:.1g} %)",
            made["provenance"]["command"],
        ),
        Claim(f"in rigid seats within {held:.1f} % up to {sector['load_N'][1] / 1000.0:.1f} kN of thrust", command),
    ]


def _of_catalogues() -> Claim:
    made = evidence_numbers.read(f"{evidence_numbers.BOOK}/gmn_rigidities.json")
    row = next(each for each in made["rows"] if each["quantity"] == "rms deviation")
    count = re.search(r"(\d+) values predicted", row["case"])
    assert count is not None
    says = f"{count[1]} axial stiffnesses of a catalogue at 25° agree to {100.0 * row['found']:.1f} % rms"
    return Claim(says, made["provenance"]["command"])


def _of_friction() -> list[Claim]:
    """The band over hypotheses, and over the coefficient of friction."""
    hypotheses = next(each["values"] for each in of_run()["remarks"] if each["code"] == "hypotheses_differ")
    words = shlex.split(FRICTION)[3:]
    least, most = of_run(*words)["traction"]["band"]["displacement"]["axial_um"]
    of, to = hypotheses["displacement_least"], hypotheses["displacement_most"]
    return [
        Claim(f"By hypotheses the displacement above is {of:.1f} to {to:.1f} µm", "qsbearing explain b218"),
        Claim(f"coefficients of {FRICTION_RANGE[0]} to {FRICTION_RANGE[1]}, is {least:.1f} to {most:.1f} µm", FRICTION),
    ]


def plain(markdown: str) -> str:
    """Sentences in one line, without the addresses of links."""
    return re.sub(r"\s+", " ", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", markdown))


def table() -> str:
    """As Markdown."""
    lines = [f"| {each.says} | `{each.command}` |" for each in all_claims()]
    return "\n".join(["| the README says | made again by |", "|---|---|", *lines])
