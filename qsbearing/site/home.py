"""The first page of the site: what this is, a run made with the site, three ways in, how far to trust the numbers."""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path
from typing import Any

from qsbearing import pictures
from qsbearing.documents.drawing import picture
from qsbearing.files.scene_file import load_scene
from qsbearing.model.solution.solver import solve
from qsbearing.model.version import __version__
from qsbearing.reports.effects import NOT_MODELLED
from qsbearing.results.key_results import answer

TEXT = Path(__file__).with_name("home.md")
PICTURE = "home.svg"
EXAMPLE = "b218"
SHOWN = (
    "Section through a ball of the 218 bearing at 10,000 rpm: rings, lines of action, contact angles, loads and "
    "pressures"
)
"""What the picture shows, for those who do not see it."""


def home(folder: Path) -> str:
    """Its Markdown; the picture of the run is written to the folder."""
    parts = {"version": __version__, **run(folder), "trust": trust()}
    return re.sub(r"<!-- (\w+) -->", lambda mark: parts[mark[1]], TEXT.read_text(encoding="utf-8"))


def run(folder: Path) -> dict[str, str]:
    """The key results that the command prints, as a table, and their picture: the same bytes every time."""
    solution = solve(load_scene(EXAMPLE))
    lines = (f"| {name} | {values} |" for name, values in answer(solution, {}).pairs)
    drawn = picture(pictures.section(solution), SHOWN)
    (folder / PICTURE).write_bytes(drawn.data)
    return {
        "result": "\n".join(["| quantity | result |", "|---|---|", *lines]),
        "picture": f"![{drawn.alt}]({PICTURE})",
    }


def trust() -> str:
    """What page 1 of the validation report answers, from the records; loaded by name, as no module of qsbearing imports
    its check."""
    evidence = import_module("fem_check.report.evidence").read()
    page_one, random = (import_module(f"fem_check.report.{name}") for name in ("page_one", "random_scenes"))
    asked = import_module("fem_check.report.questions").all_of(evidence)
    text = "\n\n".join(
        [
            "Answered from the records in this version, each line by its worst case. `fem-check report` has all, and "
            "says of which commits they are.",
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
