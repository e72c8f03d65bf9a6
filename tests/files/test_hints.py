"""What is told of a wrong name: nothing farther than a bound, and all names that are equally near."""

from __future__ import annotations

import ast
import random
import re
from functools import cache
from pathlib import Path

import pytest

import qsbearing as qs
from qsbearing.files.file_keys import reading_tables
from qsbearing.files.result_names import why_unknown
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.unknown_key import _tables, suggest
from qsbearing.model.validation import MOST_ALIKE, SceneError, alike, question
from qsbearing.studies import keys
from qsbearing.studies.results import known_results
from tests.qsbearing.source_text import trees

ROOT = Path(qs.__file__).parent
LETTERS = "abcdefghijklmnopqrstuvwxyz_0123456789"
BOUND = 0.3
"""Of the letters of the longer name, as the page of the code states it; one letter of a name of three or four."""
WRONG = (
    "preload", "torque", "clearance_class", "max_pressure", "temperature", "readings", "speed", "x", "", "zzzz",
    "load_case", "lubricant_viscosity", "bearing_type", "inner", "width", "angle", "quite_another_name", "axial",
    "stifness", "ball_size",
)  # fmt: skip
EVERY = 8
"""Of the names of a table one of so many is misspelt in each way."""


@cache
def edits(one: str, other: str) -> int:
    """Letters changed, left out, put in, or exchanged with a neighbour, by the definition."""
    if not one or not other:
        return len(one) + len(other)
    found = [edits(one[1:], other) + 1, edits(one, other[1:]) + 1, edits(one[1:], other[1:]) + (one[0] != other[0])]
    if len(one) > 1 and len(other) > 1 and one[:2] == other[1::-1]:
        found.append(edits(one[2:], other[2:]) + 1)
    return min(found)


def parts(name: str) -> set[str]:
    return set(re.split(r"[_.\-\s]+", name.lower())) - {""}


def has_all(word: str, name: str) -> bool:
    return parts(word) <= parts(name) and any(len(part) >= 3 for part in parts(word))


def is_near(word: str, name: str) -> bool:
    longest = max(len(word), len(name))
    if abs(len(word) - len(name)) > max(BOUND * longest, 1):
        return False
    return edits(word.lower(), name.lower()) <= max(BOUND * longest, 1 if longest >= 3 else 0)


def slips(name: str, chance: random.Random) -> list[str]:
    """The name with a letter left out, changed, put in and exchanged; two of them; and without a part."""
    at = chance.randrange(len(name))
    found = [
        name[:at] + name[at + 1 :],
        name[:at] + chance.choice(LETTERS) + name[at + 1 :],
        name[:at] + chance.choice(LETTERS) + name[at:],
        name[:at] + name[at + 1 : at + 2] + name[at : at + 1] + name[at + 2 :],
        *("_".join(each for each in name.split("_") if each != part) for part in name.split("_")),
        name.replace("_", ""),
        name.upper(),
    ]
    return [*found, "".join(chance.choice(LETTERS) for _ in name), found[0][::-1]]


TABLES = {table: list(own) for table, own in _tables().items() if own}


@pytest.mark.parametrize("table", TABLES)
def test_no_hint_is_farther_than_the_bound_and_all_that_are_as_near_are_told(table: str) -> None:
    known, chance = TABLES[table], random.Random(table)
    for word in [*WRONG, *(slip for name in known for slip in slips(name, chance))]:
        found = alike(word, known)
        assert len(found) <= MOST_ALIKE
        for name in found:
            assert has_all(word, name) or is_near(word, name), (word, name)
        if found and not any(has_all(word, name) for name in known) and word.lower() not in map(str.lower, known):
            nearest = edits(word.lower(), found[0].lower())
            assert all(edits(word.lower(), name.lower()) == nearest for name in found), (word, found)
            left = [name for name in known if name not in found and abs(len(word) - len(name)) < nearest]
            left = [name for name in left if edits(word.lower(), name.lower()) < nearest]
            assert all(not is_near_by_parts(word, name) for name in left), (word, found, left)
        if has := [name for name in known if has_all(word, name)]:
            fewest = min(len(parts(name)) for name in has)
            wanted = has if len(has) <= MOST_ALIKE else [name for name in has if len(parts(name)) == fewest]
            same = [name for name in known if name.lower() == word.lower()]
            assert set(found) == set(same or (wanted if len(wanted) <= MOST_ALIKE else [])), word
        said = suggest(word, table, 1).sentence if word not in known else ""
        assert not found or not said.startswith("Did you mean") or any(name in said for name in found), (word, said)


def is_near_by_parts(word: str, name: str) -> bool:
    """Where both have as many parts: each of more than two letters is near its own."""
    one, other = re.split(r"[_.\-\s]+", word.lower()), re.split(r"[_.\-\s]+", name.lower())
    pairs = zip(one, other, strict=False) if len(one) == len(other) else ()
    return all(is_near(a, b) for a, b in pairs if max(len(a), len(b)) > 2)


def test_one_letter_wrong_is_always_told() -> None:
    for known in TABLES.values():
        for name in known:
            if len(name) > 3:
                assert name in alike(name[:2] + "~" + name[3:], known), name


def test_a_name_that_all_means_is_asked_about_as_one_question() -> None:
    assert [question(each) for each in ([], ["a"], ["a", "b"], ["a", "b", "c"])] == [
        "", "Did you mean a?", "Did you mean a or b?", "Did you mean a, b or c?",
    ]  # fmt: skip
    assert question(["a", "b"], "[{}]") == "Did you mean [a] or [b]?"


def test_what_was_told_of_another_kind_no_longer_is() -> None:
    assert suggest("preload", "operation", 1).sentence.startswith("A preload has a table of its own: [preload]")
    assert "tolerance" not in suggest("clearance_class", "bearing", "C3").sentence
    assert alike("torque", reading_tables()) == []
    scene = qs.load_scene("b218")
    problem, cause = why_unknown("max_pressure", known_results(qs.solve(scene)))
    assert cause == "Did you mean inner_max_pressure or outer_max_pressure?", problem
    with pytest.raises(AttributeError, match="Did you mean angle"):
        qs.solve(scene).inner.angel  # noqa: B018
    assert keys.suggestion("axial_laod_N", {}) == "Did you mean axial_load_N?"
    with pytest.raises(SceneError, match=r"One of life, static_safety"):
        scene_or_set_of(
            {"bearing": {"name": "b218"}, "operation": {"axial_load_N": 1}, "readings": {"torque": True}}, "a file"
        )


def test_one_helper_finds_what_is_alike() -> None:
    """Nothing else compares names, by any library or bound of its own."""
    found = set()
    for path, tree in trees("difflib|get_close_matches|SequenceMatcher", ROOT):
        names = {
            alias.name
            for node in ast.walk(tree)
            if isinstance(node, ast.Import | ast.ImportFrom)
            for alias in node.names
        }
        modules = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
        if (names | modules) & {"difflib", "get_close_matches", "SequenceMatcher"}:
            found.add(path.name)
    assert not found
