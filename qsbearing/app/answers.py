"""What the page asks and what it is told: the tables of a scene file in, plain data out.

Raises, all of them:
    SceneError: everything that is wrong with the tables.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from qsbearing.app import drawn
from qsbearing.app.inputs import ON_PAGE, addable, fields
from qsbearing.documents.html import part
from qsbearing.documents.model import Remark
from qsbearing.files import catalogue
from qsbearing.files.catalogue.spindle_series import spindle_bearings
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.scene_file import document_of, scene_of
from qsbearing.files.scene_or_set import is_set
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.toml import tables_of
from qsbearing.model.effects import EFFECTS, QUANTITIES
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.judgement import WORDS
from qsbearing.model.solution.solution import Solution
from qsbearing.reports.key_results import key_results
from qsbearing.results import report
from qsbearing.results.readings_record import taken
from qsbearing.results.readings_report import readings_tables
from qsbearing.results.remarks import blocks, every_remark, message
from qsbearing.studies.chooser.choose import solve
from qsbearing.studies.chooser.explain import explain

Tables = dict[str, Any]
Answer = dict[str, Any]
TOLERANCE = 0.01
"""The relative change above which an effect is said to be needed."""


def start(source: str) -> Answer:
    """What the page begins with: a scene by file or catalogue name, and the names of the catalogue."""
    document, _, label = document_of(source)
    names = [entry.name for entry in catalogue.entries()]
    names += sorted({entry.name for entry in spindle_bearings().values()} - set(names))
    return checked(document, label) | {"label": label, "catalogue": names, "quantities": [*map(WORDS.get, QUANTITIES)]}


def opened(text: str, label: str) -> Answer:
    """The scene of a file's text."""
    return checked(tables_of(text, Path(label or "scene")), label)


def checked(document: Tables, label: str) -> Answer:
    """The tables of a scene with every default in them, and the fields of the page."""
    return shown(input_tables(_scene(document, label)))


def shown(document: Tables) -> Answer:
    """Tables as they are, and their fields."""
    return {"document": document, "fields": fields(document), "addable": addable(document)}


def solved(document: Tables, label: str) -> Answer:
    """How the case ended, its key results and warnings, and the section."""
    solution = solve(_scene(document, label))
    found = taken(solution)
    key = key_results(solution, found) if solution.converged else Remark(message(solution), "fail")
    return {
        "is_solved": bool(solution.converged), "key": part([key]),
        "warnings": part(blocks(every_remark(solution, found), words=ON_PAGE)), **pictured(document, label, "section"),
    }  # fmt: skip


def pictured(document: Tables, label: str, name: str) -> Answer:
    """One picture; empty where there is no solution."""
    if name not in drawn.PANELS:
        raise SceneFileError("page", [FileErrorDetail("", "no such picture")])
    solution = solve(_scene(document, label))
    return {"picture": drawn.drawn(name, solution) if solution.converged else "", "alt": drawn.PANELS[name].alt}


def detailed(document: Tables, label: str) -> Answer:
    """What each effect and choice changes, and whether it can be switched; and all tables of the solution."""
    solution = _named(document, label)
    scene, found = solution.scene, taken(solution)
    tables = [*report.tables(solution), *readings_tables(found, scene)] if solution.converged else []
    rows = zip(EFFECTS, explain(scene, TOLERANCE, ON_PAGE)[1], strict=True)
    return {
        "tables": part(tables),
        "effects": [
            {
                "effect": row.effect, "what": row.what, "is_in": row.in_scene, "verdict": row.verdict,
                "why": row.why, "changes": [row.change(quantity) for quantity in QUANTITIES],
                "can": (entry.coarser if row.in_scene else entry.finer)(scene) is not scene,
            }
            for entry, row in rows
        ],
    }  # fmt: skip


def switched(document: Tables, label: str, effect: str, is_on: bool) -> Answer:
    """The tables with an effect or choice in its finest form, or without it."""
    entry = next((each for each in EFFECTS if each.name == effect), None)
    if entry is None:
        raise SceneFileError("page", [FileErrorDetail("", "no such effect")])
    scene = _scene(document, label)
    if scene.tolerance is not None:
        scene = _named(document, label).scene
    return shown(input_tables((entry.finer if is_on else entry.coarser)(scene)))


def saved(document: Tables, label: str) -> Answer:
    """The scene as the text of a file, and as the command that solves it."""
    import tomli_w

    scene = _scene(document, label)
    name = "".join(letter if letter.isalnum() else "_" for letter in scene.bearing.name.lower()) or "scene"
    text = tomli_w.dumps(input_tables(scene))
    command = f"cat > {name}.toml <<'END'\n{text}END\nqsbearing run {name}.toml\n"
    return {"file": f"{name}.toml", "text": text, "command": command}


def _named(document: Tables, label: str) -> Solution:
    """The solution of the scene with its effects named one by one."""
    solution = solve(_scene(document, label))
    return solution if solution.choice is None else solve(replace(solution.scene, tolerance=None))


def _scene(document: Tables, label: str) -> Scene:
    for is_another, what in ((is_set(document), "a set of rows"), ("spectrum" in document, "several operating points")):
        if is_another:
            cause = "`qsbearing run` and `qsbearing report` take it; this page shows one bearing at one operating point"
            raise SceneFileError(label or "scene", [FileErrorDetail("", f"is {what}", cause=cause)])
    return scene_of(document, label or "scene", label)
