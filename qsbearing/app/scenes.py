"""The scene or set of the page's tables, and its solution.

Raises, all of them:
    SceneError: everything that is wrong with the tables.
"""

from __future__ import annotations

import json
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import refused
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.toml import check_tables
from qsbearing.model.scene.arched_rings import IN_RUN, refuse_arched
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.solution import Solution
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution

Tables = dict[str, Any]
KEPT = 4
"""Solutions that are kept for the next question on the same input, such as another picture."""
OF_HYPOTHESES, OF_FRICTION = ("moment_shares", "friction_coefficient"), ("traction",)
"""Of [effects], what means something under a hypothesis of raceway control, or with friction alone."""


def read(document: Tables, label: str) -> Scene | BearingSet:
    """What the tables describe."""
    check_tables(document, Path(label or "scene"))
    if "spectrum" in document:
        cause = "`qsbearing run` and `qsbearing report` take it; this page shows one operating point"
        raise refused(label or "scene", "is several operating points", cause)
    of = scene_or_set_of(_of_its_control(document), label or "scene", label)
    refuse_arched(getattr(of, "bearing", None), "this page", IN_RUN)
    return of


def _of_its_control(document: Tables) -> Tables:
    """The tables without what belongs to another raceway control than the one that the page's list has chosen."""
    table, beside = document.get("effects"), beside_control(document)
    if not isinstance(table, dict):
        return document
    return document | {"effects": {name: each for name, each in table.items() if name not in beside}}


def beside_control(document: Tables) -> tuple[str, ...]:
    """Keys of [effects] that mean nothing under the raceway control of these tables."""
    table = document.get("effects")
    is_friction = isinstance(table, dict) and table.get("raceway_control") == "friction"
    return OF_HYPOTHESES if is_friction else OF_FRICTION


def named(document: Tables, label: str) -> Scene | BearingSet:
    """The scene or set with its effects named one by one, where it asks to have them chosen."""
    of = read(document, label)
    if of.tolerance is None:
        return of
    return replace(requested(solution_of(document, label)), tolerance=None)


def solution_of(document: Tables, label: str) -> Solution | SetSolution:
    """Its solution, solved or not."""
    return _solution_of(json.dumps(document), label)


@lru_cache(maxsize=KEPT)
def _solution_of(text: str, label: str) -> Solution | SetSolution:
    return solve_any(read(json.loads(text), label))
