"""The dialogue of a language model with the tools: its calls are made again; its numbers are those that they tell."""

from __future__ import annotations

import asyncio
import json
import re
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("mcp")

from mcp import Client

from qsbearing.app import work
from qsbearing.app.mcp.server import server
from tests.guide.pages import GUIDE

PAGE = (GUIDE / "language_models.md").read_text(encoding="utf-8")
DIALOGUE = PAGE[PAGE.index("## A dialogue") :]
CALL = re.compile(r"`(\w+)`[^`]*?:\n\n```json\n(.*?)```\n\nAnswer[^`]*?:\n\n```json\n(.*?)```", re.DOTALL)


class Told(float):
    """A number with as many digits as it is written with."""

    digits: int


def told(text: str) -> Told:
    found = Told(text)
    found.digits = len(text.replace(".", "").replace("-", "").lstrip("0")) or 1
    if "." not in text:
        found.digits = len(text.strip("-").rstrip("0")) or 1
    return found


def is_rounded(number: Told, value: float) -> bool:
    """Whether a number is what a value rounds to."""
    return float(f"{value:.{number.digits}g}") == number


def differences(shown: Any, found: Any, path: str = "") -> list[str]:
    """Where what is shown is not a part of what was found."""
    if isinstance(shown, dict):
        lacks = [f"{path}.{key}: not there" for key in shown if key not in found]
        return lacks + [
            each for key in shown if key in found for each in differences(shown[key], found[key], f"{path}.{key}")
        ]
    if isinstance(shown, list):
        if len(shown) != len(found):
            return [f"{path}: {len(found)} of them"]
        pairs = enumerate(zip(shown, found, strict=True))
        return [each for number, (one, other) in pairs for each in differences(one, other, f"{path}.{number}")]
    if isinstance(shown, Told):
        return [] if is_rounded(shown, found) else [f"{path}: {found}"]
    return [] if shown == found else [f"{path}: {found}"]


def numbers(data: Any) -> list[float]:
    """All that there are."""
    if isinstance(data, dict | list):
        return [one for each in (data.values() if isinstance(data, dict) else data) for one in numbers(each)]
    if isinstance(data, str):
        return [float(each) for each in re.findall(r"(?<![\w.])\d+(?:\.\d+)?", data)]
    return [] if data is None or isinstance(data, bool) else [float(data)]


def test_the_dialogue_is_true(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work, "LONGEST", 900.0)  # the solver may have to be compiled first, beside other tests
    calls = [
        (name, json.loads(given), json.loads(shown, parse_float=told, parse_int=told))
        for name, given, shown in CALL.findall(DIALOGUE)
    ]
    assert [name for name, *_ in calls] == ["find", "describe", "find", "find"]
    assert len(calls) == DIALOGUE.count("```json") / 2

    async def ask() -> list[Any]:
        async with Client(server(tmp_path)) as client:
            return [(await client.call_tool(name, given)).structured_content for name, given, _ in calls]

    answers = asyncio.run(ask())
    for (name, _, shown), found in zip(calls, answers, strict=True):
        assert differences(shown, found) == [], name
    known = [numbers(part) for part in (DIALOGUE.partition("Call of")[0], [given for _, given, _ in calls], answers)]
    said = " ".join(re.findall(r"^> \*\*Model:\*\*.*?(?=\n\n|\Z)", DIALOGUE, re.DOTALL | re.MULTILINE))
    for text, percent in re.findall(r"(?<![\w.])(\d[\d,]*(?:\.\d+)?)( %)?", said.replace("\n> ", " ")):
        one = told(text.replace(",", ""))
        assert any(is_rounded(one, value * 100.0 if percent else value) for part in known for value in part) or (
            percent and one == 1.0  # of the range in which the goal counts as met
        ), text
