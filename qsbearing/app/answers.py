"""What the page asks and what it is told: the tables of a scene file in, plain data out.

Raises, all of them:
    SceneError: everything that is wrong with the tables.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from qsbearing.app import channels, drawn, required
from qsbearing.app.effect_forms import can_be_added, with_effect, without_printed
from qsbearing.app.inputs import ON_PAGE, addable, fields
from qsbearing.app.inputs import label as words_of
from qsbearing.app.scenes import Tables, named, read, solution_of
from qsbearing.app.shaft_drawing import drawing
from qsbearing.documents.html import part
from qsbearing.documents.model import Callout
from qsbearing.files import catalogue
from qsbearing.files.catalogue.spindle_series import spindle_bearings
from qsbearing.files.file_errors import refused
from qsbearing.files.scene_file import document_of
from qsbearing.files.scene_or_set import is_set
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.toml import read_back, tables_of
from qsbearing.model.accuracy import DEFAULT_ACCURACY
from qsbearing.model.effects import EFFECTS, QUANTITIES, Entry
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.judgement import WORDS, unit_of
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.of_solution import message
from qsbearing.remarks.remark import row_name
from qsbearing.remarks.wording import capital
from qsbearing.results import report, set_report
from qsbearing.results.key_results import KeyResult, results_of
from qsbearing.results.readings_record import all_taken
from qsbearing.results.readings_report import readings_tables
from qsbearing.results.remarks import blocks, every_remark
from qsbearing.results.set_key_results import results_of_row, results_of_shaft, rows_table
from qsbearing.studies.changed_keys import changed
from qsbearing.studies.chooser.explain import explain
from qsbearing.studies.chooser.explain_set import coarser, explain_set
from qsbearing.studies.study import Read
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution

Answer = dict[str, Any]
SECTION = "section"
"""The picture that comes with the key results."""
OF_SET = (
    "A set of rows: to add rows, sections or loads, or to take them out, change the file and open it again. All their "
    "numbers are changed here, most of them in the drawing too."
)


def start(source: str, settings: Sequence[tuple[str, Any]] = ()) -> Answer:
    """What the page begins with: a scene or set by file or catalogue name, and the names of the catalogue.

    Args:
        settings: keys, and the values that they take instead, as `run --set` has them.
    """
    document, file, label = document_of(source)
    made = Read(document, file, label)
    _, (document, _, _), _ = changed(made, settings, lambda of: read(copy.deepcopy(of.document), label or file))
    names = [entry.name for entry in catalogue.entries()]
    names += sorted({entry.name for entry in spindle_bearings().values()} - set(names))
    quantities = [f"{WORDS[name]}, {unit_of(name)}" for name in QUANTITIES]
    told = {"label": label, "catalogue": names, "quantities": quantities, "ends": required.ENDINGS}
    return checked(document, label) | told


def opened(text: str, label: str) -> Answer:
    """The scene or set of a file's text."""
    return checked(tables_of(text, Path(label or "scene")), label)


def checked(document: Tables, label: str) -> Answer:
    """The tables of a scene or set with every default in them, and the fields of the page."""
    return shown(input_tables(read(document, label)))


def of_bearing(document: Tables, label: str, name: str) -> Answer:
    """The tables with another bearing of the catalogue, whose dimensions effects take then."""
    return checked(without_printed(document) | {"bearing": {"name": name}}, label)


def shown(document: Tables) -> Answer:
    """Tables as they are, their fields, and what else is to know of these."""
    told = {"document": document, "fields": fields(document), "addable": addable(document)}
    told |= {"note": OF_SET if is_set(document) else "", "drawing": drawing(document)}
    return told | {"channels": channels.channels(document)}


def put_way(document: Tables, channel: str, way: str, value: float | None = None) -> Answer:
    """The tables with another way for a channel or the preload, as `channels.with_way` makes them."""
    try:
        return shown(channels.with_way(document, channel, way, value))
    except (KeyError, AttributeError, TypeError):
        raise refused("page", "no such channel, or no such way of one") from None


def solved(document: Tables, label: str) -> Answer:
    """How the case ended, key results of the bearing or of the shaft and each row, a table of all rows, the answers to
    what is required, remarks, of a bearing the section, the names of the pictures to ask for, and the effects with
    whether they can be switched."""
    solution = solution_of(document, label)
    readings, is_solved = all_taken(solution), bool(solution.converged)
    key: list[KeyResult] = []
    rows: list[Answer] = []
    every_row = ""
    picture, pictures = "", drawn.names(solution) if is_solved else []
    if is_solved and isinstance(solution, Solution):
        key, picture = results_of(solution, readings), drawn.drawn(SECTION, solution)
        pictures.remove(SECTION)
    elif is_solved and isinstance(solution, SetSolution):
        key = results_of_shaft(solution, readings)
        rows = [
            {"name": capital(row_name(row, k)), "key": _plain(results_of_row(solution, k, readings[k]))}
            for k, row in enumerate(solution.set.rows)
        ]
        every_row = part([rows_table(solution, readings)])
    said = [] if is_solved else [Callout(message(solution), "fail")]
    return {
        "is_solved": is_solved,
        "key": _plain(key),
        "rows": rows,
        "every_row": every_row,
        "required": required.told(solution, readings),
        "channels": channels.found(solution.displacement, solution.load) if is_solved else {},
        "warnings": part([*said, *blocks(every_remark(solution, readings), words=ON_PAGE)]),
        "picture": picture,
        "pictures": pictures,
        "effects": _switches(requested(solution)),
    }


def _plain(key_results: list[KeyResult]) -> list[Answer]:
    return [
        each._asdict() | {"parts": [one._asdict() | {"number": one.number} for one in each.parts]}
        for each in key_results
    ]


def _switches(of: Scene | BearingSet) -> list[Answer]:
    """Every effect and choice: whether it is in, and whether it can be switched."""
    switches = []
    for entry in EFFECTS:
        other = {is_on: _with(entry, of, is_on) for is_on in (True, False)}
        is_in = other[True] is of and other[False] is not of
        can = other[not is_in] is not of or (not is_in and can_be_added(entry, of))
        switches.append(
            {"effect": entry.name, "words": words_of(entry.name), "what": entry.what, "is_in": is_in, "can": can}
        )
    return switches


def _with(entry: Entry, of: Scene | BearingSet, is_on: bool) -> Scene | BearingSet:
    """The scene or set with an effect or choice in its finest form, or without it."""
    if not is_on and isinstance(of, BearingSet):
        return coarser(entry, of)
    changed: Scene | BearingSet = entry.finer(of) if is_on else entry.coarser(of)
    return changed


def pictured(document: Tables, label: str, name: str, row: int = 0) -> Answer:
    """One picture, of a set that of a row; empty where there is no solution."""
    solution = solution_of(document, label)
    if name not in drawn.names(solution) or (isinstance(solution, SetSolution) and not 0 <= row < len(solution.rows)):
        raise refused("page", "no such picture")
    return {"picture": drawn.drawn(name, solution, row) if solution.converged else "", "alt": drawn.ALT[name]}


def detailed(document: Tables, label: str) -> Answer:
    """All tables of the solution."""
    solution = solution_of(document, label)
    readings = all_taken(solution)
    if not solution.converged:
        return {"tables": ""}
    if isinstance(solution, SetSolution):
        return {"tables": part(set_report.tables(solution, readings))}
    return {"tables": part([*report.tables(solution), *readings_tables(readings, solution.scene)])}


def effects(document: Tables, label: str) -> Answer:
    """What each effect and choice changes, found by solving with and without it, and whether it is needed."""
    of = named(document, label)
    accuracy = DEFAULT_ACCURACY
    rows = (explain_set(of, accuracy) if isinstance(of, BearingSet) else explain(of, accuracy, ON_PAGE))[1]
    addable_effects = {entry.name for entry in EFFECTS if entry.switch.effect_type and can_be_added(entry, of)}
    records = []
    for row in rows:
        changes = {quantity: row.change(quantity) for quantity in QUANTITIES}
        largest = row.largest
        most = "" if not largest else "0 %" if changes[largest] == "0" else f"{WORDS[largest]} {row.change_in(largest)}"
        told: Answer = {"effect": row.effect, "what": row.what, "verdict": row.verdict, "why": row.why}
        told |= {"is_missing": row.effect in addable_effects and not row.in_scene and row.is_large}
        records.append(told | {"most": most, "changes": list(changes.values())})
    return {"effects": records}


def switched(document: Tables, label: str, effect: str, is_on: bool) -> Answer:
    """The tables with an effect or choice in its finest form, or without it; and what is assumed with it."""
    entry = next((each for each in EFFECTS if each.name == effect), None)
    if entry is None:
        raise refused("page", "no such effect")
    if not is_on:
        return shown(input_tables(_with(entry, named(document, label), False))) | {"said": ""}
    tables, said = with_effect(entry, document, label)
    return shown(tables) | {"said": said}


def saved(document: Tables, label: str) -> Answer:
    """The scene or set as the text of a file, and as the command that solves it."""
    import tomli_w

    of = read(document, label)
    own = of.name if isinstance(of, BearingSet) else of.bearing.name
    name = "".join(letter if letter.isalnum() else "_" for letter in own.lower()) or "scene"
    tables = input_tables(of)
    text = tomli_w.dumps(tables)
    read_back(text, tables, Path(f"{name}.toml"))
    command = f"cat > {name}.toml <<'END'\n{text}END\nqsbearing run {name}.toml\n"
    return {"file": f"{name}.toml", "text": text, "command": command}
