"""The design report of a load spectrum: life under all points, and the report of the one that does most damage."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.readings.asked import take_asked
from qsbearing.results.tables import digits_of
from tests.documents.page import Page
from tests.readings.test_spectrum_files import PAIR, guide_s_file


def report_of(folder: Path, text: str) -> Page:
    (folder / "cycle.toml").write_text(text, encoding="utf-8")
    result = CliRunner().invoke(cli, ["report", str(folder / "cycle.toml"), "--out", str(folder)])
    assert result.exit_code == 0, result.output
    return Page.of((folder / "cycle_report.html").read_text(encoding="utf-8"))


def rows_of(page: Page, *heading: str) -> list[list[str]]:
    found = [table for table in page.tables if table[0][: len(heading)] == list(heading)]
    return [row for table in found for row in table[1:]]


def test_it_opens_with_the_life_and_goes_on_with_the_worst_point(tmp_path: Path) -> None:
    page = report_of(tmp_path, guide_s_file())
    solution = qs.solve(qs.load_scene(tmp_path / "cycle.toml"))
    found = take_asked(solution)["spectrum"]
    worst = int(np.argmax(found.damage_share))
    assert f"Life under the whole spectrum: {digits_of(found.duration / 3600.0)} h" in page.text
    points = rows_of(page, "point", "share")
    assert [row[1] for row in points] == ["0.9", "0.1"]
    assert [row[-1] for row in points] == [digits_of(100.0 * part) for part in found.damage_share]
    assert f"point {worst + 1}, which does {100.0 * found.damage_share[worst]:.3g} % of the damage" in page.text
    pressure = dict(page.facts)["maximum contact pressure"]
    assert pressure.startswith(f"inner {solution.inner.max_pressure[worst].max() / 1e6:.0f} MPa")
    operation = {row[0]: row[1] for row in rows_of(page, "key of a scene file") if len(row) > 1}
    assert float(operation["speed_rpm"]) == pytest.approx(solution.scene.operation.speed[worst] / qs.rpm)


def test_that_of_a_set_has_the_life_of_each_row_and_of_all(tmp_path: Path) -> None:
    page = report_of(tmp_path, PAIR.format(own="").replace("[operation]", "[operation]\naxial_load_N = 0"))
    lives = rows_of(page, "row", "bearing", "h")
    assert [row[0] for row in lives] == ["1", "2", "all"]
    assert len(rows_of(page, "point", "share")) == 4
    assert float(lives[0][2]) > 1e5 and "e+" not in lives[0][2]
    assert "of the damage of a row, more than any other point" in page.text


def test_without_equilibrium_at_a_point_there_is_none(tmp_path: Path) -> None:
    (tmp_path / "cycle.toml").write_text(guide_s_file().replace("axial_load_N = 5000", "axial_load_N = -5000"))
    result = CliRunner().invoke(cli, ["report", str(tmp_path / "cycle.toml"), "--out", str(tmp_path)])
    assert result.exit_code == 1, result.output
    assert result.stderr.startswith("qsbearing: point 1: No equilibrium: the axial load acts in -x")
    assert not list(tmp_path.glob("*.html"))
