"""What `run` prints, in its order: the answer, tables, remarks, and how the solver came to it."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from rich.console import Console

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.documents import terminal
from qsbearing.documents.model import Table
from qsbearing.documents.terminal import text_of
from qsbearing.files.set_file import load_set
from tests.guide.pages import GUIDE, blocks

PULSE = "Converged in"


@pytest.fixture
def spindle(tmp_path: Path) -> Path:
    """That of the guide."""
    text = next(each.text for each in blocks(GUIDE / "spindle.md") if each.text.startswith("# spindle.toml"))
    (tmp_path / "spindle.toml").write_text(text)
    return tmp_path / "spindle.toml"


def lines(*words: str | Path) -> list[str]:
    result = CliRunner().invoke(cli, ["run", *map(str, words)])
    assert result.exit_code in (0, 1, 3), result.output
    return result.stdout.splitlines()


def test_the_answer_stands_before_the_tables_and_the_solver_last() -> None:
    said = lines("b218")
    solution = qs.solve(qs.load_scene("b218"))
    first = "\n".join(said[: said.index("Inner ring")])
    for number in (
        f"axial {solution.displacement[0] / qs.um:.4g} µm", f"inner {solution.inner.angle[0] / qs.deg:.1f} deg",
        f"outer {solution.outer.load.max():.4g} N", f"inner {solution.inner.max_pressure.max() / qs.MPa:.4g} MPa",
        f"axial {solution.effective_stiffness[0] / 1e6:.4g} N/µm",
    ):  # fmt: skip
        assert number in first
    order = [first.index(each) for each in ("displacement", "angles", "load", "pressure")]
    assert order == sorted(order)
    assert said[-1].startswith(PULSE) and not any(line.startswith(PULSE) for line in said[:-1])


def test_without_a_solution_the_reason_stands_first(tmp_path: Path) -> None:
    (tmp_path / "no.toml").write_text('[bearing]\nname = "B218"\n[operation]\naxial_load_N = -1000\n')
    said = lines(tmp_path / "no.toml")
    assert any(line.startswith("No equilibrium") for line in said[:4])
    assert not any(line.startswith(PULSE) for line in said)


def test_of_a_spindle_the_stiffness_of_the_tool_stands_in_the_first_ten_lines(spindle: Path) -> None:
    said = lines(spindle)
    (stiff,) = (line for line in said[:10] if line.startswith("tool: stiffness"))
    tool = qs.solve_set(load_set(spindle)).points["tool"].effective_stiffness
    assert [float(each) for each in re.findall(r"[\d.]+", stiff)] == pytest.approx(
        [float(f"{each / 1e6:.4g}") for each in np.asarray(tool)[:3]]
    )
    assert any("preload in operation" in line and "rows 1 and 2" in line for line in said[:18])
    assert said[-1].startswith(PULSE)


def test_requirements_stand_before_all(spindle: Path) -> None:
    spindle.write_text(spindle.read_text() + '[require]\ntool_effective_stiffness_radial_y = ">= 30"\n')
    said = lines(spindle)
    assert "requirement" in said[0] and any("tool_effective_stiffness_radial_y" in line for line in said[:6])


def test_a_wide_terminal_is_used_and_a_file_has_a_hundred_columns(monkeypatch: pytest.MonkeyPatch) -> None:
    table = Table(("", *(f"column{number}" for number in range(14))), [("row", *("1234567" for _ in range(14)))])
    assert max(map(len, text_of([table]).splitlines())) <= terminal.USUAL
    for columns, width in ((90, 90), (140, 140), (200, 140), (40, 80)):
        monkeypatch.setenv("COLUMNS", str(columns))
        assert Console().width == columns
        longest = max(map(len, text_of([table]).splitlines()))
        assert width - 11 < longest <= width
