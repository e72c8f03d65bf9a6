"""A null is no value: it is refused at every key that a file may have, through every door that JSON comes in by."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest

import qsbearing as qs
from qsbearing.app import answers
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.scene_or_set import load_scene_or_set
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.version import __version__
from qsbearing.studies.schema import file_schema
from qsbearing.studies.study import Study

Tables = dict[str, Any]
Path_ = tuple[str | int, ...]
SCENE: Tables = {"bearing": {"name": "b218"}, "operation": {"axial_load_N": 1000.0}}
SCHEMA = file_schema()
VALID = jsonschema.Draft7Validator(SCHEMA)


def places(schema: Tables, before: Path_ = ()) -> Iterator[Path_]:
    """The path of every key that the schema names, and of every item of its lists; those of lists count from 0."""
    if "$ref" in schema:
        schema = SCHEMA["definitions"][schema["$ref"].rpartition("/")[2]]
    for each in (*schema.get("anyOf", ()), *schema.get("allOf", ())):
        yield from places(each, before)
    for name, own in schema.get("properties", {}).items():
        yield (*before, name)
        yield from places(own, (*before, name))
    if "items" in schema and before:
        yield (*before, 0)
        yield from places(schema["items"], (*before, 0))


EVERY = list(dict.fromkeys(places({key: each for key, each in SCHEMA.items() if key != "allOf"})))


def with_null(path: Path_) -> Tables:
    """The scene with tables and lists as far as this path, and a null at its end."""
    document = copy.deepcopy(SCENE)
    table: Any = document
    for step, following in zip(path, (*path[1:], None), strict=True):
        value: Any = None if following is None else [] if following == 0 else {}
        if step == 0:
            table.append(value)
        elif following is None or not isinstance(table.get(step), dict):
            table[step] = value
        table = table[step]
    return document


def spelled(path: Path_) -> str:
    return ".".join("1" if step == 0 else str(step) for step in path)


def of_file(document: Tables, folder: Path) -> None:
    path = folder / "result.json"
    path.write_text(json.dumps({"version": __version__, "input": document}), encoding="utf-8")
    load_scene_or_set(path)


def of_page(document: Tables, _: Path) -> None:
    answers.checked(document, "")


def of_study(document: Tables, _: Path) -> None:
    Study.of(document, {"speed_rpm": [0, 1]})


def of_tool(document: Tables, folder: Path) -> None:
    pytest.importorskip("mcp")
    from qsbearing.app.mcp.folder import Folder
    from qsbearing.app.mcp.tools import Tools

    Tools(Folder(folder)).solve(document)


def test_the_walk_finds_the_keys() -> None:
    assert {("operation", "speed_rpm"), ("shaft", "loads", 0, "axial_N"), ("effects", "ball", 0)} <= set(EVERY)
    assert len(EVERY) > 300


@pytest.mark.parametrize("door", [of_file, of_page, of_study, of_tool])
def test_a_null_is_refused_at_every_key(door: Callable[[Tables, Path], None], tmp_path: Path) -> None:
    passed = []
    for path in EVERY:
        try:
            door(with_null(path), tmp_path)
        except SceneFileError as error:
            found = {(each.key, each.problem) for each in error.errors}  # type: ignore[attr-defined]
        else:
            found = set()
        passed += [] if found == {(spelled(path), "is null")} else [(path, found)]
    assert not passed


def test_the_schema_refuses_it_too() -> None:
    assert [path for path in EVERY if VALID.is_valid(with_null(path))] == []


def test_all_nulls_are_told_at_once(tmp_path: Path) -> None:
    with pytest.raises(SceneFileError) as caught:
        of_file(SCENE | {"operation": {"speed_rpm": None, "axial_load_N": None}}, tmp_path)
    assert "2 errors" in str(caught.value)
    assert "null is no value: write one, or leave the key out" in str(caught.value)


def test_no_record_holds_one_and_all_stay_readable() -> None:
    """What `run --json` keeps under `input`."""
    for name in ("b218", "7210C", "7210C_hybrid", "turbopump25"):
        assert "null" not in json.dumps(input_tables(qs.load_scene(name)))
