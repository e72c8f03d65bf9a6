"""What a file describes, a scene or a set of rows; how a set is read is imported only for one."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from qsbearing.files.keys import MAKES_SET
from qsbearing.files.scene_file import document_of, scene_of
from qsbearing.model.scene.scene import Scene

if TYPE_CHECKING:
    from qsbearing.systems.sets.bearing_set import BearingSet


def load_scene_or_set(source: str | os.PathLike[str], may_infer: bool = False) -> Scene | BearingSet:
    """What a file describes: a set where it has [[rows]], else a scene.

    Args:
        may_infer: as for `scene_of`.

    Raises:
        SceneFileError: everything that is wrong with it, at once.
    """
    document, file, label = document_of(source)
    return scene_or_set_of(document, file, label, may_infer)


def scene_or_set_of(
    document: dict[str, Any], file: str, label: str = "", may_infer: bool = False
) -> Scene | BearingSet:
    """The scene or set of a parsed file.

    Args:
        file: what to call the file in errors.
        label: the scene's or set's name.
    """
    if not is_set(document):
        return scene_of(document, file, label, may_infer)
    from qsbearing.files.set_file import set_of

    return set_of(document, file, label)


def is_set(document: dict[str, Any]) -> bool:
    """Whether these tables are those of a set."""
    return bool(set(document) & set(MAKES_SET))
