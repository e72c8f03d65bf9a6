"""Damaged ZIPs, in every packing: a sentence, never a traceback; and every call into zipfile passes one guard."""

from __future__ import annotations

import ast
import random
import zipfile
from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path

import pytest

from qsbearing.files import zip_file
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.rexs.source import opened
from qsbearing.files.table import read_table
from qsbearing.studies.design.point_table import table_bytes
from tests.files.doors import answered, judged
from tests.files.rexs.models import b218, xml
from tests.qsbearing.source_text import trees

ROOT = Path(zip_file.__file__).parents[1]
PACKINGS = {
    "stored": zipfile.ZIP_STORED,
    "deflated": zipfile.ZIP_DEFLATED,
    "bzip2": zipfile.ZIP_BZIP2,
    "lzma": zipfile.ZIP_LZMA,
}
MODEL = xml(b218(contacts=False))
EACH = 60
"""Files damaged in each way, of each packing."""
THEMSELVES = {("files/xlsx.py", "load_workbook"), ("studies/store.py", "load")}
"""Calls of packages that open a ZIP themselves: `read_table` and `Store` take whatever these raise."""


def packed(parts: dict[str, bytes], packing: int) -> bytes:
    made = BytesIO()
    with zipfile.ZipFile(made, "w", packing) as folder:
        for name, data in parts.items():
            folder.writestr(name, data)
    return made.getvalue()


def repacked(data: bytes, packing: int) -> bytes:
    with zipfile.ZipFile(BytesIO(data)) as folder:
        return packed({name: folder.read(name) for name in folder.namelist()}, packing)


def damages(data: bytes, seed: object) -> Iterator[tuple[str, bytes]]:
    """With bytes missing at its end or within, and with bytes changed; the first three tell that it is a ZIP."""
    chance = random.Random(str(seed))
    for _ in range(EACH):
        at, length, byte = chance.randrange(4, len(data)), chance.choice((1, 4, 50, 1000)), chance.randrange(256)
        yield f"cut at {at}", data[:at]
        yield f"{length} bytes missing at {at}", data[:at] + data[at + length :]
        yield f"byte {at} is {byte}", data[:at] + bytes([byte]) + data[at + 1 :]


def model_of(path: Path) -> None:
    opened(path).edited([])


def table_of(path: Path) -> None:
    read_table(path)


def rexs(packing: int) -> bytes:
    return packed({"model.rexs": MODEL, "notes.txt": b"hello " * 300}, packing)


def workbook(packing: int) -> bytes:
    pytest.importorskip("openpyxl")
    return repacked(table_bytes({"speed_rpm": [100.0, 200.0]}, ".xlsx"), packing)


@pytest.mark.parametrize("packing", PACKINGS)
@pytest.mark.parametrize(("name", "made", "read"), [("a.rexsz", rexs, model_of), ("a.xlsx", workbook, table_of)])
def test_a_damaged_zip_is_a_sentence(
    packing: str, name: str, made: Callable[[int], bytes], read: Callable[[Path], None], tmp_path: Path
) -> None:
    path, whole, passed = tmp_path / name, made(PACKINGS[packing]), 0
    path.write_bytes(whole)
    read(path)
    for what, data in damages(whole, packing):
        path.write_bytes(data)
        try:
            read(path)
            passed += 1
        except SceneFileError as error:
            assert len(error.errors) == 1 and "Traceback" not in str(error), what
        except Exception as error:
            pytest.fail(f"{what}: {error!r}")
    assert passed < EACH  # some bytes mean nothing, such as those of a date


@pytest.mark.parametrize("packing", PACKINGS)
def test_nothing_is_put_back_beside_a_damaged_file(packing: str, tmp_path: Path) -> None:
    """The model itself is whole: told before it is solved, by both commands that read one."""
    whole = rexs(PACKINGS[packing])
    with zipfile.ZipFile(BytesIO(whole)) as folder:
        place = folder.getinfo("notes.txt")
        start = place.header_offset + 30 + len(place.filename)
    at = start + place.compress_size // 2
    path, made = tmp_path / "model.rexsz", tmp_path / "made"
    path.write_bytes(whole)
    assert answered(["import", path, "--out", made]).code == 0
    scene = sorted(made.glob("*.toml"))[0]
    path.write_bytes(whole[:at] + bytes([whole[at] ^ 0x55]) + whole[at + 1 :])
    damaged = path.read_bytes()
    for command in (["import", path, "--out", tmp_path / "new"], ["run", scene, "--into", path]):
        answer = answered(command)
        judged(answer, packing)
        assert answer.code == 2 and "cannot be unpacked" in answer.error
    assert path.read_bytes() == damaged
    assert sorted(each.name for each in tmp_path.iterdir()) == ["made", "model.rexsz"]


def test_every_call_into_zipfile_passes_the_guard() -> None:
    """Only `files/zip_file.py` has the module; packages that use it are called where everything is caught."""
    having, themselves = set(), set()
    for path, tree in trees(r"zipfile|load_workbook|read_excel|unpack_archive|np\.load", ROOT):
        name = path.relative_to(ROOT).as_posix()
        for node in ast.walk(tree):
            if isinstance(node, ast.Import | ast.ImportFrom):
                modules = [getattr(node, "module", None) or "", *(each.name for each in node.names)]
                having |= {name for each in modules if each.partition(".")[0] == "zipfile"}
            if isinstance(node, ast.Call):
                called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
                owner = getattr(getattr(node.func, "value", None), "id", "")
                if called in ("load_workbook", "read_excel", "unpack_archive") or (called, owner) == ("load", "np"):
                    themselves.add((name, called))
    assert having == {"files/zip_file.py"}
    assert themselves == THEMSELVES
    for function in ast.parse((ROOT / "files" / "zip_file.py").read_text(encoding="utf-8")).body:
        text = ast.unparse(function)
        if isinstance(function, ast.FunctionDef) and "ZipFile(" in text.partition(":\n")[2]:
            assert "except Exception" in text or "with unzipped(" in text, function.name
