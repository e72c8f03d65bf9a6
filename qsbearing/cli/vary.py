"""The option that varies keys of a scene, and the study that it asks for."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from qsbearing.cli.output import refuse_all, warnings_as_notes
from qsbearing.cli.settings import changed_read

if TYPE_CHECKING:
    from qsbearing.studies.changed_keys import ChangedKey
    from qsbearing.studies.study import Study

vary_option = click.option(
    "--vary",
    multiple=True,
    metavar="KEY=VALUES",
    help="A numeric key of the scene file and its values: START:STOP:COUNT, START:STOP:COUNT:log, A,B,C, "
    "normal(MEAN,SD), uniform(LOW,HIGH) or triangular(LOW,MODE,HIGH). Repeat it for each further key; all combinations "
    "are solved.",
)


def pairs_of(vary: tuple[str, ...], form: str, problems: list[str]) -> dict[str, str]:
    """What each key takes; what is none is added to the problems."""
    varied: dict[str, str] = {}
    for text in vary:
        key, equals, values = text.partition("=")
        if not equals or key.strip() in varied:
            problems.append(f"--vary {text}: " + ("is varied twice" if equals else form))
        varied[key.strip()] = values
    return varied


def study_of(
    scene: str, vary: tuple[str, ...], given: dict[str, Any], settings: Sequence[str] = ()
) -> tuple[Study, tuple[ChangedKey, ...]]:
    """The study of a scene or study file with the keys that are varied beside it, and what --set has changed in it.

    Raises:
        SceneError: what is wrong with it.
    """
    from qsbearing.studies.study import Study

    problems: list[str] = []
    varied = pairs_of(vary, "has no values. Write KEY=START:STOP:COUNT or KEY=A,B,C", problems)
    refuse_all(problems)
    options = {name: value for name, value in given.items() if value is not None and value != ()}
    with warnings_as_notes():
        study, _, changes = changed_read(scene, settings, lambda read: Study.of(read, varied, **options))
    return study, changes
