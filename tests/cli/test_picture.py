"""`run --picture`: what --plot draws, and what it cannot draw of a scene or set."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import pytest
from click.testing import CliRunner

from qsbearing import pictures
from qsbearing.cli import cli, pictured
from tests.systems.sets.arrangements import PAIR_FILE

pytest.importorskip("matplotlib")

SHAFT = """
[[shaft.sections]]
length_mm = 120
outer_diameter_mm = 50
[shaft]
start_mm = -50
"""


def ended(*arguments: str) -> tuple[int, str]:
    found = CliRunner().invoke(cli, ["run", *arguments])
    return found.exit_code, found.stderr


@pytest.mark.parametrize("name", pictured.OF_BEARING)
def test_every_picture_of_a_bearing_is_written(name: str, tmp_path: Path) -> None:
    target = tmp_path / "picture.svg"
    assert ended("b218", "--plot", str(target), "--picture", name)[0] == 0
    assert target.read_bytes().startswith((b"<svg", b"<?xml"))


def test_what_cannot_be_drawn_is_refused_in_a_sentence(tmp_path: Path) -> None:
    rigid, target = tmp_path / "pair.toml", str(tmp_path / "a.svg")
    rigid.write_text(PAIR_FILE)
    assert ended("b218", "--picture", "section") == (
        2,
        "qsbearing: --picture says what --plot draws: give --plot FILE\n",
    )
    code, said = ended("b218", "--plot", target, "--picture", "campbell")
    assert code == 2 and "is none of a bearing; overview, under_load, section" in said
    code, said = ended(str(rigid), "--plot", target, "--picture", "section")
    assert code == 2 and "is none of a set" in said
    code, said = ended(str(rigid), "--plot", target, "--picture", "campbell")
    assert code == 2 and "this set's shaft is rigid" in said
    assert not (tmp_path / "a.svg").exists()


@pytest.mark.skipif(find_spec("ross") is not None, reason="ROSS is installed")
def test_a_campbell_diagram_needs_the_rotor_program(tmp_path: Path) -> None:
    bent = tmp_path / "bent.toml"
    bent.write_text(PAIR_FILE + SHAFT)
    code, said = ended(str(bent), "--plot", str(tmp_path / "a.svg"), "--picture", "campbell")
    assert (
        code == 2 and said.startswith("qsbearing: --picture campbell needs ross: pip install") and said.count("\n") == 1
    )


def test_pictures_have_the_names_that_they_have_in_python() -> None:
    assert {*pictured.OF_BEARING, *pictured.OF_SET} <= set(pictures.__all__)
