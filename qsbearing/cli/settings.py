"""The option that gives keys of a scene other values than its file, and what is said of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import click

from qsbearing.cli.output import refuse_all

if TYPE_CHECKING:
    from qsbearing.documents.model import Paragraph
    from qsbearing.studies.changed_keys import ChangedKey
    from qsbearing.studies.study import Read

Made = TypeVar("Made")

set_option = click.option(
    "--set",
    "settings",
    multiple=True,
    metavar="KEY=VALUE",
    help="Another value for a key of SCENE, by its path in the file: operation.speed_rpm=12000, "
    "rows.2.position_mm=80, effects.raceway_control=friction. Repeat it for each further key.",
)


def settings_of(settings: Sequence[str]) -> list[tuple[str, Any]]:
    """Keys and their values; ends with those that are none."""
    if not settings:
        return []
    from qsbearing.studies.changed_keys import value_of

    pairs = [text.partition("=") for text in settings]
    refuse_all(
        [
            f"--set {text}: write KEY=VALUE, such as operation.speed_rpm=12000"
            for text, (key, _, value) in zip(settings, pairs, strict=True)
            if not key.strip() or not value.strip()
        ]
    )
    return [(key.strip(), value_of(value)) for key, _, value in pairs]


def changed_read(
    scene: str, settings: Sequence[str], make: Callable[[Read], Made]
) -> tuple[Made, Read, tuple[ChangedKey, ...]]:
    """What is made of a scene or study file with these settings, its tables, and what has changed in them.

    Raises:
        SceneError: what is wrong with any of it.
    """
    pairs = settings_of(settings)
    from qsbearing.studies.changed_keys import changed
    from qsbearing.studies.study import read

    return changed(read(scene), pairs, make)


def told(changes: Sequence[ChangedKey]) -> list[Paragraph]:
    """What was set, a line for each."""
    if not changes:
        return []
    from qsbearing.documents.model import Paragraph

    return [Paragraph(f"Set: {each}", "Set:") for each in changes]


def with_changes(record: dict[str, Any], changes: Sequence[ChangedKey]) -> dict[str, Any]:
    """A record with what was set; as it is where nothing was."""
    return record | {"changed_input": [each.record() for each in changes]} if changes else record
