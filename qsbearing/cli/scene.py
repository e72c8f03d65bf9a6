"""From the name of a scene to its solution, with what a user should hear on the way."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from qsbearing.cli.output import note, refuse, warnings_as_notes

if TYPE_CHECKING:
    from qsbearing.model.scene.scene import Scene
    from qsbearing.model.validation import SceneError
    from qsbearing.systems.sets.bearing_set import BearingSet

T = TypeVar("T")
Requested = TypeVar("Requested", bound="Scene | BearingSet")

PATIENCE = 2.0
"""Seconds of silence on a terminal."""


def load(source: str) -> Scene:
    """The scene of a file or of a catalogue entry; ends with exit code 2 and every error if there is none."""
    from qsbearing.files.scene_file import document_of, scene_of

    return _of_one_point(_loaded(lambda given: scene_of(*document_of(given)), source), source)


def load_scene_or_set(source: str, may_infer: bool = False) -> Scene | BearingSet:
    """Likewise, but a file with rows is a set; of several operating points, if it says so.

    Args:
        may_infer: whether a bearing may be a list, those that its data sheet allows.
    """
    from qsbearing.files.scene_or_set import load_scene_or_set

    return _loaded(partial(load_scene_or_set, may_infer=may_infer), source)


def load_one(source: str) -> Scene | BearingSet:
    """Likewise, of one operating point."""
    return _of_one_point(load_scene_or_set(source), source)


def _of_one_point(requested: Requested, source: str) -> Requested:
    if "spectrum" in requested.readings:
        refuse(
            f"{source}: [[spectrum]] has several operating points, which only `qsbearing run` and `report` solve: "
            "leave it out here"
        )
    return requested


def _loaded(read: Callable[[str], T], source: str) -> T:
    from qsbearing.model.compiler.threads import thread_count
    from qsbearing.model.validation import SceneError

    try:
        with warnings_as_notes():
            loaded = read(source)
    except SceneError as error:
        refuse(str(error))
    _told_by_sweep(source)
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

    from qsbearing.files.netcdf import attributes_of
    from qsbearing.studies.remarked import KEPT, of_results

    for each in of_results(attributes_of(Path(source), KEPT)):
        note(f"{source}: {each.text}")


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
