"""The README stays true: its code runs, its scene solves, its commands are CI's, its tables are the record's."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import qsbearing as qs
from tests.benchmarks import tables
from tests.benchmarks.record import RECORD

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    """Code blocks of one language."""
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.DOTALL)


def test_the_python_runs_and_prints_what_it_says(capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = blocks("python")
    exec(compile(code, "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert "converged 49.94" in printed
    assert "(3, 8, 5) (3, 8, 16)" in printed


def test_the_scene_file_solves(tmp_path: Path) -> None:
    (text,) = blocks("toml")
    path = tmp_path / "my.toml"
    path.write_text(text, encoding="utf-8")
    solution = qs.solve(qs.load_scene(path))
    assert solution.converged
    assert solution.gyroscopic_moment is not None


def test_ci_calls_the_test_command_literally() -> None:
    commands = [line for block in blocks("sh") for line in block.splitlines() if line.endswith(".venv/bin/pytest")]
    assert len(commands) == 1
    assert commands[0] in (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()


def test_the_tables_are_made_from_the_record() -> None:
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    assert tables.filled(README, record) == README
    assert "|" in tables.timing(record)


@pytest.mark.parametrize("floor", ["formulas", "what is asked", "the kernel", "answers", "the door"])
def test_every_file_on_the_map_exists(floor: str) -> None:
    (line,) = [line for line in README.splitlines() if line.startswith(f"| {floor} |")]
    names = re.findall(r"`([a-z_]+)/?`", line)
    assert len(names) > 2
    for name in names:
        place = ROOT / "qsbearing" / name
        assert place.is_dir() or place.with_suffix(".py").exists(), name
