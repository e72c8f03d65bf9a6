"""The skill for language models: its commands run, and what it says of results is what the program has."""

from __future__ import annotations

import contextlib
import json
import re
import shlex
from pathlib import Path

import pytest
from click.testing import CliRunner

from qsbearing.cli import cli
from qsbearing.documents.guide import skill_text
from qsbearing.remarks.kinds import Severity
from tests.guide.pages import run_command

pytest.importorskip("xarray")

TEXT = skill_text()
COMMANDS = re.findall(r"`(qsbearing [^`]+)`", TEXT)


def test_the_command_prints_it() -> None:
    assert CliRunner().invoke(cli, ["skill"]).stdout == TEXT
    head = TEXT.split("---\n")[1]
    assert re.match(r"name: qsbearing\ndescription: .{50,1024}\n$", head), "as readers of skills want it"


def test_its_commands_run(tmp_path: Path) -> None:
    ran = 0
    for command in COMMANDS:
        words = shlex.split(command)
        if len(words) == 2 and words[1] in cli.commands:
            ran += words[1] in ("catalogue", "schema")
            if words[1] not in ("catalogue", "schema"):
                continue  # named, without its scene
        if "NAME" in words:
            continue
        with contextlib.chdir(tmp_path):
            run_command(words, tmp_path)
        ran += 1
    assert ran >= 12


def test_its_words_are_those_of_results(tmp_path: Path) -> None:
    found = json.loads(CliRunner().invoke(cli, ["run", "b218", "--json"]).stdout)
    for key in ("status", "message", "remarks", "effective_stiffness", "locked_stiffness"):
        assert f"`{key}`" in TEXT
        assert key in found
    assert {each.name.lower() for each in Severity} <= set(re.findall(r"`(\w+)`", TEXT))
