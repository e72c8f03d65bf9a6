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
from qsbearing.documents.model import Remark, Table
from qsbearing.files import catalogue
from qsbearing.files.catalogue.spindle_series import spindle_bearings
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.file_keys import IN_FILE
from qsbearing.files.scene_file import document_of
from qsbearing.files.scene_or_set import is_set, scene_or_set_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.toml import tables_of
from qsbearing.model.effects import EFFECTS, QUANTITIES
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.judgement import WORDS
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.wording import Words
from qsbearing.reports.key_results import key_results, key_results_of_set
from qsbearing.results import report, set_report
from qsbearing.results.readings_record import taken
from qsbearing.results.readings_report import readings_tables
from qsbearing.results.remarks import blocks, every_remark, message
from qsbearing.studies.chooser.choose import solve
from qsbearing.studies.chooser.choose_set import solve_any, solve_set
from qsbearing.studies.chooser.explain import explain
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution

Tables = dict[str, Any]
Answer = dict[str, Any]
TOLERANCE = 0.01
"""The relative change above which an effect is said to be needed."""
SECTION = "section"
"""The picture that comes with the key results."""
OF_SET = (
    "A set of rows: this page changes what [operation] gives, speed and loads of the shaft, and the preload. Rows, "
    "shaft and effects are as the file has them: to change these, change the file and open it again."
)


def start(source: str) -> Answer:
    """What the page begins with: a scene or set by file or catalogue name, and the names of the catalogue."""
    document, _, label = document_of(source)
    names = [entry.name for entry in catalogue.entries()]
    names += sorted({entry.name for entry in spindle_bearings().values()} - set(names))
    return checked(document, label) | {"label": label, "catalogue": names, "quantities": [*map(WORDS.get, QUANTITIES)]}


def opened(text: str, label: str) -> Answer:
    """The scene or set of a file's text."""
    return checked(tables_of(text, Path(label or "scene")), label)


def checked(document: Tables, label: str) -> Answer:
    """The tables of a scene or set with every default in them, and the fields of the page."""
    return shown(input_tables(_read(document, label)))


def shown(document: Tables) -> Answer:
    """Tables as they are, their fields, and what else is to know of these."""
    note = OF_SET if is_set(document) else ""
    return {"document": document, "fields": fields(document), "addable": addable(document), "note": note}


def solved(document: Tables, label: str) -> Answer:
    """How the case ended, key results, warnings, of a bearing the section, and the names of the pictures to ask for."""
    solution = _solution(document, label)
    found = _taken(solution)
    names = list(drawn.panels(solution)) if solution.converged else []
    return {
        "is_solved": bool(solution.converged),
        "key": part(_key_results(solution, found) if solution.converged else [Remark(message(solution), "fail")]),
        "warnings": part(blocks(every_remark(solution, found), words=_words(solution))),
        "picture": drawn.drawn(SECTION, solution) if SECTION in names else "",
        "pictures": [name for name in names if name != SECTION],
    }


def _words(solution: Solution | SetSolution) -> Words:
    """How remarks name fields: of a set as the file does, in which what they advise is changed."""
    return ON_PAGE if isinstance(solution, Solution) else IN_FILE


def _key_results(solution: Solution | SetSolution, found: Any) -> list[Table]:
    if isinstance(solution, Solution):
        return [key_results(solution, found)]
    return key_results_of_set(solution, found)


def pictured(document: Tables, label: str, name: str) -> Answer:
    """One picture; empty where there is no solution."""
    solution = _solution(document, label)
    panel = drawn.panels(solution).get(name)
    if panel is None:
        raise SceneFileError("page", [FileErrorDetail("", "no such picture")])
    return {"picture": drawn.drawn(name, solution) if solution.converged else "", "alt": panel.alt}


def detailed(document: Tables, label: str) -> Answer:
    """What each effect and choice changes, and whether it can be switched, of a set nothing; and all tables of the
    solution."""
    of = _read(document, label)
    if isinstance(of, BearingSet):
        of_set = solve_set(of)
        return {"tables": part(set_report.tables(of_set, _taken(of_set)) if of_set.converged else []), "effects": []}
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
    """The scene or set as the text of a file, and as the command that solves it."""
    import tomli_w

    of = _read(document, label)
    own = of.name if isinstance(of, BearingSet) else of.bearing.name
    name = "".join(letter if letter.isalnum() else "_" for letter in own.lower()) or "scene"
    text = tomli_w.dumps(input_tables(of))
    command = f"cat > {name}.toml <<'END'\n{text}END\nqsbearing run {name}.toml\n"
    return {"file": f"{name}.toml", "text": text, "command": command}


def _named(document: Tables, label: str) -> Solution:
    """The solution of the scene with its effects named one by one."""
    solution = solve(_scene(document, label))
    return solution if solution.choice is None else solve(replace(solution.scene, tolerance=None))


def _solution(document: Tables, label: str) -> Solution | SetSolution:
    return solve_any(_read(document, label))


def _taken(solution: Solution | SetSolution) -> Any:
    """What is asked to be read off; of a set by row."""
    return taken(solution) if isinstance(solution, Solution) else [taken(row) for row in solution.rows]


def _scene(document: Tables, label: str) -> Scene:
    """One whose effects can be switched."""
    found = _read(document, label)
    if isinstance(found, BearingSet):
        raise SceneFileError(label or "set", [FileErrorDetail("", "is a set of rows", cause=OF_SET)])
    return found


def _read(document: Tables, label: str) -> Scene | BearingSet:
    if "spectrum" in document:
        cause = "`qsbearing run` and `qsbearing report` take it; this page shows one operating point"
        raise SceneFileError(label or "scene", [FileErrorDetail("", "is several operating points", cause=cause)])
    return scene_or_set_of(document, label or "scene", label)
