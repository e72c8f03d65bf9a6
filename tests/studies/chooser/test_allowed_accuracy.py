"""The errors that may be allowed are one range wherever one is given: in Python, files, schema, commands and tools."""

from __future__ import annotations

from typing import get_args, get_type_hints

import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.scene_file import scene_of
from qsbearing.files.schema import scene_schema
from qsbearing.model.accuracy import ALLOWED, COARSEST, FINEST

BEARING = qs.load_scene("b218").bearing


def refusals(accuracy: float) -> list[bool]:
    """Of Python, of a file and of each command."""
    refused = []
    tables = {"bearing": {"name": "b218"}, "operation": {"axial_load_N": 1.0}, "effects": "auto", "tolerance": accuracy}
    for make in (
        lambda: qs.Scene(BEARING, qs.Operation(axial_load=1.0), tolerance=accuracy),
        lambda: scene_of(tables, ""),
    ):
        try:
            make()
            refused.append(False)
        except qs.SceneError:
            refused.append(True)
    return refused


@pytest.mark.parametrize("accuracy", [0.0, -0.01, 0.5 * FINEST, 2.0 * COARSEST])
def test_what_is_beyond_is_refused_everywhere(accuracy: float) -> None:
    assert refusals(accuracy) == [True, True]
    for words in (["explain", "b218", "--tolerance"], ["run", "b218", "--accuracy"]):
        result = CliRunner().invoke(cli, [*words, str(accuracy)])
        assert result.exit_code == 2 and ALLOWED in result.stderr, words


def test_the_ends_are_taken() -> None:
    assert refusals(FINEST) == refusals(COARSEST) == [False, False]


def test_schema_and_tools_have_the_same_ends() -> None:
    schema = scene_schema()["properties"]["tolerance"]
    assert (schema["minimum"], schema["maximum"]) == (FINEST, COARSEST)
    tools = pytest.importorskip("qsbearing.app.mcp.tools")
    (field,) = get_args(get_type_hints(tools.Tools.explain, include_extras=True)["tolerance"])[1:]
    ends = {name: getattr(each, name) for each in field.metadata for name in ("ge", "le") if hasattr(each, name)}
    assert ends == {"ge": FINEST, "le": COARSEST}
