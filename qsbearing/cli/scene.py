"""From the name of a scene to its solution, with what a user should hear on the way."""

from __future__ import annotations

import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from copy import deepcopy
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from qsbearing.cli.ball_sets import note_of_lists
from qsbearing.cli.output import note, note_remark, refuse, warnings_as_notes
from qsbearing.cli.settings import settings_of

if TYPE_CHECKING:
    from qsbearing.model.scene.scene import Scene
    from qsbearing.model.solution.limit import Answer
    from qsbearing.model.validation import SceneError
    from qsbearing.studies.changed_keys import ChangedKey
    from qsbearing.systems.sets.bearing_set import BearingSet

T = TypeVar("T")

PATIENCE = 2.0
"""Seconds of silence on a terminal."""


class LoadedFile(NamedTuple):
    """What a command is asked to solve."""

    of: Scene | BearingSet
    document: dict[str, Any]
    """The tables that it was made of; of a sweep's result those of its study."""
    changes: tuple[ChangedKey, ...]
    """What --set has put into them."""


def load_scene_or_set(source: str, settings: Sequence[str] = (), may_infer: bool = False) -> LoadedFile:
    """The scene or set of a file or of a catalogue entry; of several operating points, if it says so. Ends with exit
    code 2 and every error if there is none.

    Args:
        settings: keys and the values that they take instead, as --set has them.
        may_infer: whether a bearing may be a list, those that its data sheet allows; else the best is taken, and said.
    """
    from qsbearing.files.scene_file import document_of
    from qsbearing.files.scene_or_set import scene_or_set_of

    def made(given: str) -> LoadedFile:
        document, file, label = document_of(given)
        if not settings:
            return LoadedFile(scene_or_set_of(deepcopy(document), file, label, may_infer), document, ())
        from qsbearing.studies.changed_keys import changed
        from qsbearing.studies.study import Read

        def make(of: Read) -> Scene | BearingSet:
            return scene_or_set_of(deepcopy(of.document), of.file, of.label, may_infer)

        of, read, changes = changed(Read(document, file, label), pairs, make)
        return LoadedFile(of, read.document, changes)

    pairs = settings_of(settings)
    loaded = _loaded(made, source)
    if source.lower().endswith(".nc"):
        with warnings.catch_warnings(action="ignore"):  # which it gave when it was read
            loaded = loaded._replace(document=document_of(source, True)[0])
    if not may_infer:
        note_of_lists(loaded.document)
    return loaded


def load_one(source: str, settings: Sequence[str] = ()) -> LoadedFile:
    """Likewise, of one operating point."""
    loaded = load_scene_or_set(source, settings)
    if "spectrum" in loaded.of.readings:
        refuse(
            f"{source}: [[spectrum]] has several operating points, which only `qsbearing run` and `report` solve: "
            "leave it out here"
        )
    return loaded


def _loaded(read: Callable[[str], T], source: str) -> T:
    from qsbearing.model.compiler.threads import thread_count
    from qsbearing.model.validation import SceneError

    try:
        with warnings_as_notes():
            loaded = read(source)
        _told_by_sweep(source)
    except SceneError as error:
        refuse(str(error))
    try:
        thread_count()
    except ValueError as error:  # a mistake in its environment variable
        refuse(str(error))
    return loaded


def _told_by_sweep(source: str) -> None:
    """Say what the sweep remarks whose first point is solved again."""
    if not source.lower().endswith(".nc"):
        return
    from pathlib import Path

    from qsbearing.files.netcdf import attributes_of, damage_told
    from qsbearing.studies.remarked import KEPT, of_results

    with damage_told(Path(source)):
        said = of_results(attributes_of(Path(source), KEPT))
    for each in said:
        note_remark(each, f"{source}: ")


def solve(requested: Scene | BearingSet, tolerance: float | None = None) -> Any:
    """Its solution; the effects of a scene are chosen to a tolerance where one is given."""
    from qsbearing.model.scene.scene import Scene

    if not isinstance(requested, Scene):
        from qsbearing.studies.chooser.choose_set import solve_set

        with solving():
            return solve_set(requested, effects=None if tolerance is None else "auto", accuracy=tolerance)
    from qsbearing.studies.chooser import choose

    with solving():
        return choose.solve(requested, effects=None if tolerance is None else "auto", accuracy=tolerance)


def answers_to_required(solution: Any, readings: Any = None) -> list[Answer]:
    """The answers to what its scene or set requires.

    Args:
        readings: where they are taken already.
    """
    from qsbearing.model.solution.changes import requested

    if not requested(solution).require:
        return []
    from qsbearing.results.readings_record import all_taken
    from qsbearing.results.requirements import required_answers

    return required_answers(solution, all_taken(solution) if readings is None else readings)


def is_missed(required: list[Answer]) -> bool:
    """Whether a requirement is not met."""
    return any(each.state == "not met" for each in required)


@contextmanager
def solving() -> Iterator[None]:
    """Say on a terminal, once, that it takes longer than anybody waits in silence; ends with exit code 2 where what is
    asked turns out to be wrong."""
    timer = threading.Timer(PATIENCE, note, ["still solving ..."])
    timer.daemon = True
    if sys.stderr.isatty():
        timer.start()
    from qsbearing.model.validation import SceneError

    try:
        yield
    except SceneError as error:  # what only a heat balance finds wrong
        refuse(in_keys(error))
    finally:
        timer.cancel()


def in_keys(error: SceneError) -> str:
    """Errors of the Python objects by the keys and in the units of the file."""
    from qsbearing.files.file_errors import translate

    return "\n".join(str(translate(each)) for each in error.errors)
