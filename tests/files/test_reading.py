"""Everything that comes in passes one reader: regular files, bounded before they are parsed, one exception."""

from __future__ import annotations

import io
import os
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from qsbearing.cli import cli
from qsbearing.files import limits, xlsx
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.json_text import parsed
from qsbearing.files.scene_file import load_scene
from qsbearing.files.table import read_table

pandas = pytest.importorskip("pandas")
openpyxl = pytest.importorskip("openpyxl")
pyarrow = pytest.importorskip("pyarrow")

Write = Callable[[str, Any], Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def put(name: str, content: Any) -> Path:
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return put


def refusal(read: Callable[[], Any]) -> str:
    with pytest.raises(SceneFileError) as caught:
        read()
    return str(caught.value)


# Regular files --------------------------------------------------------------------------------------------------------


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names")
@pytest.mark.parametrize("ending", [".toml", ".json", ".nc", ".csv", ".xlsx", ".parquet"])
def test_only_regular_files_are_read(ending: str, tmp_path: Path) -> None:
    """A pipe that nobody writes to would be waited for, and /dev/zero never ends."""
    read = read_table if ending in (".csv", ".xlsx", ".parquet") else load_scene
    pipe, device, folder, link = (tmp_path / f"{name}{ending}" for name in ("pipe", "device", "folder", "link"))
    os.mkfifo(pipe)
    device.symlink_to("/dev/zero")
    folder.mkdir()
    link.symlink_to(tmp_path / "none")
    for path, words in ((pipe, "pipe or device"), (device, "pipe or device"), (folder, "folder"), (link, "no such")):
        assert words in refusal(lambda path=path: read(path))  # type: ignore[misc]
    for name in (f"http://127.0.0.1:9/a{ending}", f"s3://bucket/a{ending}", f"file:///etc/a{ending}"):
        assert "no such file" in refusal(lambda name=name: read(Path(name)))  # type: ignore[misc]


def test_standard_input_is_a_scene() -> None:
    text = '[bearing]\nname = "B218"\n[operation]\naxial_load_N = 1000\n'
    ran = CliRunner().invoke(cli, ["run", "-", "--json"], input=text)
    assert ran.exit_code == 0 and '"axial_N": 1000' in ran.stdout
    ran = CliRunner().invoke(cli, ["run", "-"], input="[bearing")
    assert ran.exit_code == 2 and "is not TOML" in ran.stderr


# JSON -----------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"a": 1, "a": 2}', '"a" stands twice'),
        ("[NaN]", "NaN is no number"),
        ("[-Infinity]", "-Infinity is no number"),
        ('["\\ud800"]', "half a character"),
        ("[" * 70 + "]" * 70, "nested deeper"),
        ("[" + "{}," * limits.MOST_VALUES + "0]", "values"),
        ('{"a": 1', "is not JSON"),
        (b"\xff", "UTF-8"),
    ],
    ids=lambda value: str(value)[:12],
)
def test_json_is_that_of_its_standard_and_bounded(text: str | bytes, words: str) -> None:
    assert words in refusal(lambda: parsed(text if isinstance(text, bytes) else text.encode(), Path("a.json")))


def test_brackets_and_commas_in_a_text_are_no_values() -> None:
    found = ["[" * 200 + ',{"\\' * 300, "\U0001f600"]
    import json

    assert parsed(json.dumps(found).encode(), Path("a.json")) == found
    assert parsed(f'["{"," * (limits.MOST_VALUES + 1)}"]'.encode(), Path("a.json"))


# CSV ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("name;speed_rpm;axial_load_N\na, b;1000,5;2.000\n", {"speed_rpm": "1000.5", "axial_load_N": "2000"}),
        ("name;speed_rpm\na, b;10.25\n", {"speed_rpm": "10.25"}),
        ("name;speed_rpm\na, b;0.250\n", {"speed_rpm": "0.250"}),
        ("name;speed_rpm\na, b;1.234,5\n", {"speed_rpm": "1234.5"}),
        ("name;speed_rpm\na, b;1,234.5\n", {"speed_rpm": "1234.5"}),
        ("name;speed_rpm\na, b;1.234.567\n", {"speed_rpm": "1234567"}),
        ("name;speed_rpm\na, b;-2,5e3\n", {"speed_rpm": "-2.5e3"}),
        ('name,speed_rpm\n"a, b",10.000\n', {"speed_rpm": "10.000"}),
        ('"na;me",speed_rpm\n"a, b",10\n', {"speed_rpm": "10"}),
        ("name;speed_rpm\n\na, b;10\n", {"speed_rpm": "10"}),
    ],
)
def test_decimals_of_a_csv_are_those_that_its_cells_show(text: str, expected: dict[str, str], write: Write) -> None:
    """A comma in a label stays."""
    found = read_table(write("a.csv", text), ("name", "na;me"))
    assert {key: found[key][0] for key in expected} == expected
    assert next(iter(found.values())) == ["a, b"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("speed_rpm;axial_load_N\n10.000;2.500\n", ["10.000 may be 10000 or 10.000", "--decimal"]),
        ("speed_rpm;axial_load_N\n10,000;2,500\n", ["10,000 may be 10000 or 10.000"]),
        ("speed_rpm;axial_load_N\n10,5;2.5\n", ["after a comma, 10,5", "after a point, 2.5"]),
        ("speed_rpm,axial_load_N\n10,5,2,5\n", ["row 1 has 4 cells", "decimal commas"]),
        ('speed_rpm\n"10\n', ["is not CSV"]),
        ("speed_rpm\n1\0\n", ["null characters"]),
        ("speed_rpm\n" + "1" * (limits.LONGEST_CELL + 1), ["a cell has more than 10,000 characters"]),
        (",".join(f"a{i}" for i in range(limits.MOST_COLUMNS + 1)) + "\n1\n", ["has 501 columns; at most 500"]),
        ("a\n" + "1\n" * 1001, ["has 1,001 rows; at most 1,000"]),
    ],
    ids=lambda value: str(value)[:20],
)
def test_a_csv_in_doubt_or_too_large_is_refused(
    text: str, words: list[str], write: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "MOST_ROWS", 1000)  # in place of a million
    said = refusal(lambda: read_table(write("a.csv", text)))
    for each in words:
        assert each in said


def test_the_option_says_what_the_decimals_are(write: Write, tmp_path: Path) -> None:
    path = write("a.csv", "speed_rpm;axial_load_N\n10.000;2.500\n")
    assert read_table(path, decimal=".") == {"speed_rpm": ["10.000"], "axial_load_N": ["2.500"]}
    assert read_table(path, decimal=",") == {"speed_rpm": ["10000"], "axial_load_N": ["2500"]}
    for decimal, speed in ((",", "10000"), (".", "10")):
        out = tmp_path / "out.csv"
        ran = CliRunner().invoke(cli, ["run", "b218", "--points", str(path), "--out", str(out), "--decimal", decimal])
        assert ran.exit_code == 0 and out.read_text().splitlines()[1].startswith(f"{speed},")
    quoted = read_table(write("b.csv", 'speed_rpm\n"10,5"\n"1.5"\n'), decimal=",")["speed_rpm"]
    assert quoted[0] == "10.5"
    with pytest.raises(ValueError):
        float(quoted[1])


# Spreadsheets ---------------------------------------------------------------------------------------------------------


def workbook(rows: list[list[Any]]) -> bytes:
    book, data = openpyxl.Workbook(), io.BytesIO()
    for row in rows:
        book.active.append(row)
    book.save(data)
    return data.getvalue()


def with_part(data: bytes, name: str, content: bytes) -> bytes:
    """A workbook with one of its parts in place of what it was."""
    result = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(result, "w", zipfile.ZIP_DEFLATED) as new:
        for part in old.infolist():
            new.writestr(part.filename, content if part.filename == name else old.read(part))
    return result.getvalue()


def test_a_sheet_has_the_cells_that_are_seen(write: Write) -> None:
    data = workbook([["speed_rpm", "axial_load_N", None], [1000, 2.5, None], [None, 3], [], [None]])
    assert read_table(write("a.xlsx", data)) == {"speed_rpm": [1000, None], "axial_load_N": [2.5, 3]}


def test_a_formula_without_a_value_is_not_empty(write: Write) -> None:
    said = refusal(lambda: read_table(write("a.xlsx", workbook([["speed_rpm"], ["=1000*2"]]))))
    assert "row 2, column 1 holds the formula =1000*2" in said and "once and save it" in said


SHEET = "xl/worksheets/sheet1.xml"
HEAD = b'<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main">'


@pytest.mark.parametrize(
    ("sheet", "words"),
    [
        (HEAD + b"<sheetData>" + b"<row/>" * 10_000 + b"</sheetData></worksheet>", "1,000,000"),
        (HEAD + b" " * 2_000_000, "1,000,000"),
        (b'<!DOCTYPE x [<!ENTITY a "aaaa">]>' + HEAD + b"<sheetData/></worksheet>", "declares entities"),
        (HEAD + b'<sheetData><row r="1"><c r="XFD1"><v>1</v></c></row></sheetData></worksheet>', "16,384"),
        (HEAD + b'<dimension ref="A1:XFD1048576"/><sheetData/></worksheet>', "is empty"),
        (HEAD, "cannot be read"),
    ],
    ids=["rows", "blanks", "entities", "wide", "dimension", "cut"],
)
def test_a_sheet_that_would_fill_the_memory_is_refused_before(
    sheet: bytes, words: str, write: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(xlsx, "MOST_TAGS", 10_000)
    monkeypatch.setattr(xlsx, "LARGEST_PART", 1_000_000)
    path = write("a.xlsx", with_part(workbook([["a"], [1]]), SHEET, sheet))
    assert path.stat().st_size < 1_000_000
    assert words in refusal(lambda: read_table(path))


# Parquet --------------------------------------------------------------------------------------------------------------


def test_a_named_index_is_a_column(write: Write) -> None:
    frame = pandas.DataFrame({"speed_rpm": [1000, 2000], "axial_load_N": [1.0, 2.0], "name": ["a", None]})
    found = read_table(write("a.parquet", frame.set_index("speed_rpm").to_parquet()))
    assert found == {"speed_rpm": [1000, 2000], "axial_load_N": [1.0, 2.0], "name": ["a", None]}
    found = read_table(write("a.parquet", frame.drop(0).to_parquet()))
    assert list(found) == ["speed_rpm", "axial_load_N", "name"], "an index without a name is none"


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"speed_rpm": [[1.0, 2.0]]}, "column speed_rpm holds list"),
        ({"speed_rpm": [b"1"]}, "column speed_rpm holds binary"),
        ({"name": ["a" * (limits.LONGEST_CELL + 1)] * 1000}, "a cell has more than"),
        ({"speed_rpm": []}, "no rows"),
    ],
    ids=["list", "bytes", "long", "none"],
)
def test_columns_that_are_no_numbers_or_texts_are_refused(columns: dict[str, Any], words: str, write: Write) -> None:
    assert words in refusal(lambda: read_table(write("a.parquet", pandas.DataFrame(columns).to_parquet())))


def test_a_parquet_file_says_its_size_before_it_is_read(write: Write) -> None:
    table = pyarrow.table({"speed_rpm": pyarrow.array([1.0]).take(pyarrow.array([0] * (limits.MOST_ROWS + 1)))})
    data = io.BytesIO()
    pyarrow.parquet.write_table(table, data)
    assert len(data.getvalue()) < 100_000
    assert "1,000,001 rows" in refusal(lambda: read_table(write("a.parquet", data.getvalue())))
