"""`qsbearing run --points`: one row in, one row out."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.studies.design import point_table
from qsbearing.studies.design.point_table import read_table, solve_table, table_bytes
from tests.cli.command import call

pandas = pytest.importorskip("pandas")
pytest.importorskip("openpyxl")
pytest.importorskip("pyarrow")

ROWS = (
    "name,speed_rpm,axial_load_N,radial_load_y_N,tilt_z_mrad\n"
    "slow,1000,2000,500,0\nfast,12000.5,8000,1000,0\nwrong,x,8000,0,0\nempty,1000,,0,0\nimpossible,-1e9,1,0,0\n"
    "off,1000,-500,0,0\n"
)


@pytest.fixture
def points(tmp_path: Path) -> dict[str, Path]:
    """The same rows in each form."""
    paths = {ending: tmp_path / f"points{ending}" for ending in (".csv", ".xlsx", ".parquet")}
    paths[".csv"].write_text(ROWS)
    frame = pandas.read_csv(paths[".csv"])
    frame.to_excel(paths[".xlsx"], index=False)
    frame.to_parquet(paths[".parquet"])
    return paths


@pytest.mark.parametrize("given", [".csv", ".xlsx", ".parquet"])
@pytest.mark.parametrize("wanted", [".csv", ".xlsx", ".parquet"])
def test_each_row_is_the_scene_at_its_numbers(points: dict[str, Path], tmp_path: Path, given: str, wanted: str) -> None:
    out = tmp_path / f"results{wanted}"
    result = call("run", "b218", "--points", points[given], "--out", out)
    assert result.exit_code == 0, result.output
    assert "2 of 6 rows solved" in result.stdout and "row 3" in result.stdout
    read = {".csv": pandas.read_csv, ".xlsx": pandas.read_excel, ".parquet": pandas.read_parquet}[wanted]
    found = read(out)
    assert found["name"].tolist() == [line.split(",")[0] for line in ROWS.splitlines()[1:]]
    assert found["status"].tolist() == ["converged", "converged", *["impossible"] * 3, "no_equilibrium"]
    assert "speed_rpm" in found["reason"][2] and "empty" in found["reason"][3]
    base = qs.load_scene("b218")
    for row, (speed, axial, radial) in enumerate([(1000.0, 2000.0, 500.0), (12000.5, 8000.0, 1000.0)]):
        operation = qs.Operation(speed=speed * qs.rpm, axial_load=axial, radial_load_y=radial, tilt_z=0.0)
        solution = qs.solve(dataclasses.replace(base, operation=operation))
        assert found["inner_load_max_N"][row] == pytest.approx(solution.inner.load.max(), rel=1e-9)
        assert found["inner_load_min_N"][row] == pytest.approx(solution.inner.load.min(), rel=1e-9)
        stiffness = found["ring_effective_stiffness_radial_y_N_per_um"][row]
        assert stiffness == pytest.approx(solution.effective_stiffness[1] / 1e6, rel=1e-9)
    assert np.isnan(found["inner_load_max_N"][2:].astype(float)).all()


def test_semicolons_and_decimal_commas_of_a_spreadsheet_are_read(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    path.write_text("speed_rpm;axial_load_N\n1000,5;2000\n", encoding="utf-8-sig")
    found = solve_table("b218", read_table(str(path)))
    assert found["speed_rpm"] == [1000.5]
    assert found["status"] == ["converged"]


def test_text_that_a_spreadsheet_would_run_is_inert(tmp_path: Path) -> None:
    table = {"name": ["=1+1"], "speed_rpm": [1000], "axial_load_N": [2000]}
    for ending in (".csv", ".xlsx"):
        out = tmp_path / f"r{ending}"
        out.write_bytes(table_bytes(solve_table("b218", dict(table)), ending))
        assert str(read_table(str(out))["name"][0]).startswith("'=")


def test_readings_of_the_scene_are_columns(tmp_path: Path) -> None:
    tables = {"bearing": {"name": "B218"}, "operation": {"axial_load_N": 1.0}, "readings": {"life": {}}}
    found = solve_table(tables, {"speed_rpm": [1000.0, 2000.0], "axial_load_N": [5000.0, 5000.0]})
    one, two = found["life_basic_duration_h"]
    assert one == pytest.approx(2.0 * two, rel=1e-3), "the same revolutions at twice the speed; static but for it"


def test_the_number_of_balls_may_differ_from_row_to_row() -> None:
    found = solve_table("b218", {"ball_count": [12, 16, 40], "axial_load_N": [8000.0] * 3})
    assert found["status"] == ["converged", "converged", "impossible"]
    assert found["outer_load_max_N"][0] > found["outer_load_max_N"][1]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("sped_rpm,speed\n1,2\n", ["speed_rpm", "column speed:"]),
        ("speed_rpm,speed_rpm\n1,2\n", ["two columns speed_rpm"]),
        ("speed_rpm,operation.speed_rpm\n1,2\n", ["has a column already"]),
        ("name\na\n", ["no column is a key"]),
        ("speed_rpm\n", ["no rows"]),
        ("speed_rpm,\n1,2\n", ["row 1 has 2 cells", "Is a heading missing"]),
        ("speed_rpm,,axial_load_N\n1,2,3\n", ["no heading"]),
        ("", ["is empty"]),
        ("ball_material.density_kg_m3,thermal_expansion_per_K\n1,2\n", ["not a numeric key"]),
    ],
)
def test_a_table_that_cannot_be_is_refused(tmp_path: Path, text: str, said: list[str]) -> None:
    path = tmp_path / "points.csv"
    path.write_text(text)
    result = call("run", "b218", "--points", path, "--out", tmp_path / "out.csv")
    assert result.exit_code == 2
    for words in said:
        assert words in result.output
    assert not (tmp_path / "out.csv").exists()


def test_options_that_do_not_go_together_are_all_named(tmp_path: Path) -> None:
    result = call("run", "b218", "--points", tmp_path / "a.txt", "--json", "--accuracy", "0.1")
    assert result.exit_code == 2
    for words in ("--json", "--accuracy", "--out FILE is missing", "must end in"):
        assert words in result.output
    (tmp_path / "a.xlsx").write_bytes(b"no such thing")
    result = call("run", "b218", "--points", tmp_path / "a.xlsx", "--out", tmp_path / "b.csv")
    assert result.exit_code == 2 and "is not a zip file" in result.output


def test_no_row_solved_is_exit_code_1(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("axial_load_N\n-100\n")
    assert call("run", "b218", "--points", tmp_path / "a.csv", "--out", tmp_path / "b.csv").exit_code == 1
    (tmp_path / "a.csv").write_text("axial_load_N\nx\n")
    assert call("run", "b218", "--points", tmp_path / "a.csv", "--out", tmp_path / "b.csv").exit_code == 1


# What is solved is not lost -------------------------------------------------------------------------------------------

BAD_CELLS = ("inf", "1e999", "-inf", "nan", "9" * 5000, "true", "ten", "1_0_", "\x07")


@pytest.mark.parametrize("ending", [".csv", ".xlsx", ".parquet"])
def test_a_bad_cell_costs_its_row(ending: str, tmp_path: Path) -> None:
    path, out = tmp_path / "points.csv", tmp_path / f"out{ending}"
    path.write_text(
        "name,axial_load_N\n" + "".join(f"a\x01{i},{cell}\n" for i, cell in enumerate(BAD_CELLS)) + "b,1000\n"
    )
    result = call("run", "b218", "--points", path, "--out", out)
    assert result.exit_code == 0, result.output
    found = read_table(str(out))
    assert found["status"] == ["impossible"] * len(BAD_CELLS) + ["converged"]
    assert [path.name for path in tmp_path.iterdir() if "part" in path.name] == []


@pytest.mark.parametrize("value", [10**400, -(10**400), float("inf"), None, "x", [1.0], True, 1j])
def test_a_bad_value_of_python_costs_its_row(value: object) -> None:
    found = solve_table("b218", {"axial_load_N": [value, 1000.0]})
    assert found["status"] == ["impossible", "converged"]


@pytest.mark.parametrize("ending", [".csv", ".xlsx", ".parquet"])
@pytest.mark.parametrize("error", [KeyboardInterrupt(), OSError(28, "No space left on device"), MemoryError()])
def test_rows_that_are_solved_are_kept_where_the_rest_fails(
    ending: str, error: BaseException, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, out = tmp_path / "points.csv", tmp_path / f"out{ending}"
    path.write_text("axial_load_N\n1000\n2000\n3000\n")
    monkeypatch.setattr(point_table, "CHUNK", 2)
    solve = point_table.solve_points
    calls: list[int] = []

    def failing(*arguments: object) -> object:
        calls.append(1)
        if len(calls) == 2:
            raise error
        return solve(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(point_table, "solve_points", failing)
    result = CliRunner().invoke(cli, ["run", "b218", "--points", str(path), "--out", str(out)])
    assert f"2 rows with their results are kept in {out}.part, as CSV" in result.stderr
    assert not out.exists()
    kept = out.with_name(f"{out.name}.part")
    assert pandas.read_csv(kept)["status"].tolist() == ["converged"] * 2
    monkeypatch.setattr(point_table, "solve_points", solve)
    assert call("run", "b218", "--points", path, "--out", out).exit_code == 0
    assert out.exists() and not kept.exists()


@pytest.mark.parametrize("ending", [".xlsx", ".parquet"])
def test_rows_are_kept_as_csv_where_their_file_cannot_be_written(
    ending: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object) -> bytes:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(point_table, "table_bytes", fails)
    (tmp_path / "points.csv").write_text("axial_load_N\n1000\n")
    out = tmp_path / f"out{ending}"
    result = call("run", "b218", "--points", tmp_path / "points.csv", "--out", out)
    assert result.exit_code == 2 and "No space left" in result.stderr
    assert pandas.read_csv(tmp_path / f"out{ending}.part")["status"].tolist() == ["converged"]


def test_labels_of_every_kind_are_written(tmp_path: Path) -> None:
    table = {"name": [1, "a", None, 2.5], "axial_load_N": [1000.0] * 4}
    for ending in (".csv", ".xlsx", ".parquet"):
        out = tmp_path / f"r{ending}"
        out.write_bytes(table_bytes(solve_table("b218", dict(table)), ending))
        assert [None if cell is None else str(cell) for cell in read_table(str(out))["name"]] == ["1", "a", None, "2.5"]
