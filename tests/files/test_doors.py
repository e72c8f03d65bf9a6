"""Doors × faults: whatever is wrong with what comes in is exit code 2 with sentences, or it does not matter.

Never a traceback, a wait without end or a half-written file, and 130 only for Ctrl-C.
"""

from __future__ import annotations

import json
import os
import random
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("openpyxl")
pytest.importorskip("pyarrow")
pytest.importorskip("h5netcdf")
pytest.importorskip("starlette")

from qsbearing.app.server import application
from qsbearing.files.limits import MOST_KEYS
from qsbearing.files.output_file import Writer
from tests.files import doors
from tests.files.doors import DOORS, PARTS, Page, answered, emptied, good_files, judged, left, resumed

FEW, MANY = (4, 8), (20, 80)
"""Places at which a file is cut, and bytes of it that are changed; in the normal run and in the heavy one."""
MUTATED = int(os.environ.get("QSBEARING_MUTATED", "10000"))
LONGEST = 5.0
"""Seconds of processor time of one answer to a mutated input."""
STRANGE = [
    *(b"&#10;", b"&#0;", b"&#x202e;", b"&#1114112;", b"&#xd800;", b"&lt;", b"]]>", b"\\u0000", b"\\ud800", b"\\n"),
    *(letter.encode() for letter in "²٢２\u2028\x85\u202e\ufeff"),
] * 8
"""Character references and escapes of all forms, and what Python takes for a digit, a line end or nothing."""
OUTSIDE = ("study nc",)
"""Asked in heavy runs alone: the file is read by "result nc" in the same way."""


@pytest.fixture(scope="module")
def base(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("doors")
    good_files(folder)
    return folder


@pytest.fixture
def ask(base: Path, tmp_path: Path) -> Callable[..., doors.Answer]:
    """The answer of a door to other content than its own; judged, as is what it leaves behind."""

    def answer(name: str, content: bytes | None, what: str) -> doors.Answer:
        door, folder = DOORS[name], emptied(tmp_path / "work")
        path = folder / door.name
        if content is not None:
            path.write_bytes(content)
        return finish(name, path, what)

    return answer


def finish(name: str, path: Path, what: str) -> doors.Answer:
    for _ in range(2):  # the first may compile
        began = time.process_time()
        answer = answered(DOORS[name].arguments(path))
        judged(answer, f"{name}, {what}")
        if is_fast := time.process_time() - began < LONGEST:
            break
    assert is_fast, f"{name}, {what}"
    there = {each.name for each in path.parent.iterdir()} - {path.name}
    allowed = set() if answer.code == 2 else {"out.csv", "out.svg", "made"}
    assert there <= allowed, f"{name}, {what}: {there}"
    return answer


def good(base: Path, name: str) -> bytes:
    return (base / DOORS[name].name).read_bytes()


def damaged(data: bytes, cuts: int, flips: int, seed: object) -> list[tuple[str, bytes]]:
    """Cut at so many places, and with so many single bytes changed."""
    chance = random.Random(str(seed))
    found = [(f"cut at {len(data) * i // cuts}", data[: len(data) * i // cuts]) for i in range(cuts)]
    for _ in range(flips):
        place, byte = chance.randrange(len(data)), chance.randrange(256)
        found.append((f"byte {place} is {byte}", data[:place] + bytes([byte]) + data[place + 1 :]))
    for piece in chance.sample(STRANGE, max(1, flips // 3)):
        place = chance.randrange(len(data) + 1)
        found.append((f"{piece!r} at {place}", data[:place] + piece + data[place:]))
    return found


@pytest.mark.parametrize("name", DOORS)
def test_what_is_right_is_answered(name: str, base: Path, ask: Callable[..., doors.Answer]) -> None:
    assert ask(name, good(base, name), "as it is").code == 0


WHOLE = {
    "missing": None,
    "empty": b"",
    "blank": b" \n",
    "binary": bytes(range(256)) * 40,
    "zeros": b"\0" * 1000,
    "another": b"\x89PNG\r\n\x1a\n",
    "zip": b"PK\x05\x06" + b"\0" * 18,
    "json": b'{"a": [1, {"a": null}]}',
    "utf-16": "speed_rpm = 1".encode("utf-16"),
}


@pytest.mark.parametrize("fault", WHOLE)
@pytest.mark.parametrize("name", DOORS)
def test_what_is_no_such_file_is_refused(name: str, fault: str, ask: Callable[..., doors.Answer]) -> None:
    assert ask(name, WHOLE[fault], fault).code == 2


@pytest.mark.parametrize("name", DOORS)
def test_what_is_no_regular_file_is_refused(name: str, base: Path, tmp_path: Path) -> None:
    door = DOORS[name]

    def at(what: str) -> Path:
        return emptied(tmp_path / what) / door.name

    at("folder").mkdir()
    at("link to nothing").symlink_to(tmp_path / "none")
    if hasattr(os, "mkfifo"):
        os.mkfifo(at("pipe"))
        at("device").symlink_to("/dev/zero")
    for path in [*sorted(tmp_path.glob(f"*/{door.name}")), tmp_path / "link to nothing" / door.name]:
        assert finish(name, path, path.parent.name).code == 2
    linked = at("link")
    linked.symlink_to(base / door.name)
    assert finish(name, linked, "link").code == 0


@pytest.mark.parametrize("name", DOORS)
def test_a_file_without_rights_is_refused(name: str, base: Path, tmp_path: Path, monkeypatch: Any) -> None:
    """Root may read it: the system's refusal is put in its place."""
    path = tmp_path / DOORS[name].name
    path.write_bytes(good(base, name))
    path.chmod(0)
    if os.access(path, os.R_OK):
        opened = os.open

        def refusing(file: Any, *arguments: Any, **named: Any) -> int:
            if os.fspath(file) == str(path):
                raise PermissionError(13, "Permission denied", str(file))
            return opened(file, *arguments, **named)

        monkeypatch.setattr(os, "open", refusing)
        if path.suffix == ".nc":
            pytest.skip("HDF5 opens its files itself")
    assert finish(name, path, "no rights").code == 2


@pytest.mark.parametrize("name", [name for name, door in DOORS.items() if door.limit])
def test_a_file_that_is_too_large_is_refused_unread(name: str, tmp_path: Path) -> None:
    path = tmp_path / DOORS[name].name
    with path.open("wb") as file:
        file.truncate(DOORS[name].limit + 1)
    answer = finish(name, path, "too large")
    assert answer.code == 2 and "is longer than" in answer.error


@pytest.mark.parametrize("name", [name for name in DOORS if name not in OUTSIDE])
def test_a_damaged_file_is_refused_or_answered(name: str, base: Path, ask: Callable[..., doors.Answer]) -> None:
    for what, data in damaged(good(base, name), *FEW, name):
        ask(name, data, what)


@pytest.mark.heavy
@pytest.mark.parametrize("name", DOORS)
def test_a_file_damaged_in_many_ways(name: str, base: Path, ask: Callable[..., doors.Answer]) -> None:
    for what, data in damaged(good(base, name), *MANY, name):
        ask(name, data, what)


@pytest.mark.parametrize("fault", [fault for fault in WHOLE if fault != "missing"])
def test_standard_input_is_a_door_too(fault: str) -> None:
    answer = answered(["run", "-"], WHOLE[fault])
    judged(answer, fault)
    assert answer.code == 2


# Parts of an interrupted sweep ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("part", ["plan.json", "0.npz"])
def test_damaged_parts_are_refused_or_solved_again(part: str, base: Path, tmp_path: Path) -> None:
    parts = left(base)
    assert resumed(tmp_path / "work", parts).code == 0
    for what, data in [*damaged(parts[part], 2, 4, part), ("binary", WHOLE["binary"]), ("zip", WHOLE["zip"])]:
        answer = resumed(tmp_path / "work", parts | {part: data})
        judged(answer, f"{part}, {what}")
        assert (tmp_path / "work" / "left.nc").exists() == (answer.code == 0)
    if hasattr(os, "mkfifo"):
        del parts[part]
        folder = tmp_path / "work"
        resumed(folder, parts)
        (folder / PARTS).mkdir(exist_ok=True)
        (folder / "left.nc").unlink(missing_ok=True)
        (folder / PARTS / part).unlink(missing_ok=True)
        os.mkfifo(folder / PARTS / part)
        judged(answered(["sweep", folder / "study.toml", "--out", folder / "left.nc", "--resume"]), f"{part}, a pipe")


# The page -------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def page() -> Page:
    return Page(application("b218"))


TABLES = {"bearing": {"name": "B218"}, "operation": {"speed_rpm": 0, "axial_load_N": 1000}}
QUESTIONS = {
    "solve": {"document": TABLES, "label": "a"},
    "check": {"document": TABLES, "label": "a"},
    "show": {"document": TABLES},
    "save": {"document": TABLES, "label": "a"},
    "open": {"text": doors.SCENE, "label": "a"},
}


@pytest.mark.parametrize("question", QUESTIONS)
def test_the_page_answers_or_says_what_is_wrong(question: str, page: Page) -> None:
    right = json.dumps(QUESTIONS[question]).encode()
    assert page.asked(question, right)[0] == 200
    wrong = {key: data for key, data in WHOLE.items() if data is not None}
    wrong |= {"too large": b"[" + b"1" * 1_000_000 + b"]", "keys": b"[" + b"{}," * MOST_KEYS + b"1]"}
    for fault, data in wrong.items():
        status, told = page.asked(question, data)
        assert status in (400, 413) and told["errors"][0]["text"], fault
    for what, data in damaged(right, *FEW, question):
        assert page.asked(question, data)[0] in (200, 400), what


# Places that cannot be written ----------------------------------------------------------------------------------------

WRITES: dict[str, list[str]] = {
    "run": ["run", "scene.toml", "--csv", "out.csv"],
    "points csv": ["run", "b218", "--points", "points.csv", "--out", "out.csv"],
    "points xlsx": ["run", "b218", "--points", "points.csv", "--out", "out.xlsx"],
    "sweep csv": ["sweep", "study.toml", "--out", "out.csv"],
    "plot": ["plot", "result.nc", "--out", "out.svg"],
}


@pytest.mark.parametrize("name", WRITES)
def test_a_full_disk_leaves_nothing_half_written(name: str, base: Path, tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.chdir(tmp_path)
    for path in base.iterdir():
        if path.is_file():
            (tmp_path / path.name).write_bytes(path.read_bytes())
    before = {path.name for path in tmp_path.iterdir()}

    def full(*_: Any, **__: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Writer, "fill", full)
    monkeypatch.setattr("qsbearing.studies.tables.write_table", full)
    answer = answered(list(WRITES[name]))
    assert answer.code == 2 and "No space left" in answer.error and "Traceback" not in answer.error
    kept = {f"{WRITES[name][-1]}.part"} if name.startswith("points") else set()
    assert {path.name for path in tmp_path.iterdir()} - before == kept


# Ten thousand ---------------------------------------------------------------------------------------------------------


def mutated(data: bytes, chance: random.Random) -> bytes:
    """With bytes changed, left out, repeated or put in, or cut."""
    found = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 5, 30))):
        place = chance.randrange(len(found) + 1)
        length = chance.choice((1, 1, 4, 50, 1000))
        kind = chance.randrange(5)
        if kind == 0:
            found[place : place + 1] = bytes([chance.randrange(256)])
        elif kind == 1:
            del found[place : place + length]
        elif kind == 2:
            found[place:place] = found[place : place + length]
        elif kind == 3:
            found[place:place] = bytes(chance.randrange(256) for _ in range(length))
        elif chance.random() < 0.2:
            del found[place:]
        else:
            found[place:place] = chance.choice(STRANGE)
    return bytes(found)


@pytest.mark.heavy
def test_mutated_inputs_over_all_doors(base: Path, ask: Callable[..., doors.Answer], page: Page) -> None:
    """0 tracebacks, none longer than five seconds, at most 500 MB more than before."""
    resource = pytest.importorskip("resource")
    chance = random.Random(MUTATED)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    every = [*DOORS, *QUESTIONS]
    for number in range(MUTATED):
        name = every[number % len(every)]
        if name in DOORS:
            ask(name, mutated(good(base, name), chance), f"number {number}")
        else:
            status, _ = page.asked(name, mutated(json.dumps(QUESTIONS[name]).encode(), chance))
            assert status in (200, 400, 413), (name, number)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 500_000
