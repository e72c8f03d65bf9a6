"""The first page of the site: what this is, a run made with the site, three ways in, how far to trust the numbers."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

from qsbearing.model.version import __version__
from qsbearing.reports.effects import NOT_MODELLED

TEXT = Path(__file__).with_name("home.md")
PICTURE = "home.svg"
EXAMPLE = "b218"
WIDE = {"COLUMNS": "200", "PYTHONIOENCODING": "utf-8"}
"""A terminal in which a result is one line."""


def home(folder: Path) -> str:
    """Its Markdown; the picture of the run is written to the folder."""
    parts = {"version": __version__, "result": run(folder / PICTURE), "trust": trust()}
    return re.sub(r"<!-- (\w+) -->", lambda mark: parts[mark[1]], TEXT.read_text(encoding="utf-8"))


def run(picture: Path) -> str:
    """The key results that the command prints, as a table, and its picture."""
    command = [sys.executable, "-m", "qsbearing", "run", EXAMPLE, "--plot", str(picture), "--picture", "section"]
    environment = os.environ | WIDE
    printed = subprocess.run(command, env=environment, check=True, capture_output=True, encoding="utf-8").stdout
    lines = printed.split("\n\n")[1].splitlines()
    rows = [re.split(r"\s{2,}", line.strip(), maxsplit=1) for line in lines]
    return "\n".join(["| quantity | result |", "|---|---|", *(f"| {name} | {values} |" for name, values in rows)])


def trust() -> str:
    """What page 1 of the validation report answers, from the records; loaded by name, as no module of qsbearing imports
    its check."""
    evidence = import_module("fem_check.report.evidence").read()
    page_one, random = (import_module(f"fem_check.report.{name}") for name in ("page_one", "random_scenes"))
    asked = import_module("fem_check.report.questions").all_of(evidence)
    text = "\n\n".join(
        [
            "Answered from the records of the release, each line by its worst case. `fem-check report` has all.",
            "| question | worst case | verdict |\n|---|---|---|\n" + "".join(map(_row, random.beside(evidence, asked))),
            *(f"**{words}** {'; '.join(parts)}." for words, parts in page_one.uses(evidence, asked).items()),
            _random([random.scenes(kept) for kept in evidence.random_scenes]),
            f"**Not modelled:** {NOT_MODELLED}; lubricant films and groove edges in the equilibrium "
            "([limits](limits.md)).",
        ]
    )
    return re.sub(r"(?<=[ |])-(?=\d)", "\N{MINUS SIGN}", text)


def _row(question: Any) -> str:
    verdict = f'<span class="verdict {question.verdict.status}">{question.verdict.word}</span>'
    answer = f"<br>{question.answer}" if question.answer else ""
    cells = (f"**{question.text}**{answer}", question.worst, verdict)
    return f"| {' | '.join(cells)} |\n"


def _random(scenes: list[Any]) -> str:
    """Each campaign by itself: their populations differ."""
    if not scenes:
        return "Random scenes are not on record."
    lost = ", ".join(f"{one.not_converged} of {one.count:,} {one.name}" for one in scenes)
    return (
        f"**Random scenes** solved wrongly: {sum(one.wrong for one in scenes)}; not converged: {lost} "
        "([hard cases](hard_cases.md))."
    )
