"""Models that are broken or made to do harm: each refused, with the component and the attribute, at once."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.limits import LARGEST_MODEL
from qsbearing.files.rexs.importing import import_model
from tests.files.rexs.models import as_json, b218, json_text, xml, zipped

PLAIN = xml(b218(contacts=False))
DECLARED = (
    b'<!DOCTYPE model [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;">]><model version="1.4">&b;</model>'
)


def changed(old: str, new: str) -> bytes:
    assert old in PLAIN.decode()
    return PLAIN.decode().replace(old, new, 1).encode()


def json_with(name: str, value: Any) -> bytes:
    """The model in JSON, the pitch diameter of its row replaced."""
    tables = as_json(b218(contacts=False))
    row = next(each for each in tables["model"]["components"] if each["type"] == "rolling_bearing_row")
    one = next(each for each in row["attributes"] if each["id"] == "reference_diameter")
    del one["floating_point"]
    one[name] = value
    return json.dumps(tables).encode()


def lying_zip() -> bytes:
    """A ZIP that states a small size for a part that unpacks to much more."""
    data = bytearray(zipped(b" " * (LARGEST_MODEL + 10)))
    small = (100).to_bytes(4, "little")
    size = (LARGEST_MODEL + 10).to_bytes(4, "little")
    assert data.count(size) == 2
    return bytes(data).replace(size, small)


ROW = r"component 7 \(rolling_bearing_row\): reference_diameter"
PITCH = '<attribute id="reference_diameter" unit="mm">125.26</attribute>'
CASES = {
    "entities": (DECLARED, ["declares a document type"]),
    "an external entity": (
        b'<!DOCTYPE model SYSTEM "file:///etc/passwd"><model version="1.4"/>', ["declares a document type"],
    ),
    "another root": (b"<html/>", ["outermost element is <html>"]),
    "no model": (b'{"scene": {}}', ['no table "model"']),
    "not XML": (PLAIN[:-20], ["is not XML"]),
    "not UTF-8": (PLAIN.replace(b"spindle", b"sp\xfcndel"), ["is not UTF-8"]),
    "deep XML": (b"<model>" + b"<a>" * 100_000, ["nested deeper"]),
    "deep JSON": (b'{"model": ' + b"[" * 100_000, ["nested deeper"]),
    "a bomb by its stated size": (zipped(b" " * (LARGEST_MODEL + 1)), ["unpacks to more than 20 MB"]),
    "a bomb that states a small size": (lying_zip(), ["cannot be unpacked|unpacks to more than 20 MB"]),
    "no model in the ZIP": (zipped(PLAIN, "model.txt"), ["is a ZIP with 0 models in 2 files"]),
    "no version": (changed('version="1.4"', 'version="four"'), [r"model: version = 'four': is no version"]),
    "double ids": (changed('component id="4"', 'component id="3"'), ["component 3: stands twice"]),
    "an attribute twice": (changed(PITCH, PITCH * 2), [f"{ROW}: stands twice"]),
    "an id that is none": (changed('component id="4"', 'component id="x"'), ["component: id = 'x': is not a whole"]),
    "a reference to nothing": (
        changed('id="4" role="part"', 'id="77" role="part"'), [r"relation 2 \(assembly\): part = 77: refers to a"],
    ),
    "nan": (changed(">125.26<", ">nan<"), [f"{ROW} = 'nan': is not a finite"]),
    "infinity": (changed(">125.26<", ">1e999<"), ["reference_diameter = '1e999': is not a finite number"]),
    "a comma": (
        changed(">125.26<", ">125,26<"),
        [f"{ROW} = '125,26': is not a number", "Decimals take a point: 125.26"],
    ),
    "a unit of another kind": (
        changed(PITCH, PITCH.replace('"mm"', '"kN"')),
        [f"{ROW}: is in 'kN'", "The data model has it in mm"],
    ),
    "no unit": (changed(PITCH, PITCH.replace('"mm"', '"none"')), ["reference_diameter: has no unit"]),
    "an unknown unit": (changed(PITCH, PITCH.replace('"mm"', '"furlong"')), ["reference_diameter: is in 'furlong'"]),
    "base64 that is none": (
        changed('<attribute id="width" unit="mm">30</attribute>',
                '<attribute id="u_axis_vector" unit="mm"><array code="float64">%%%</array></attribute>'),
        [r"component 6 \(.*B218 \[6\]\): u_axis_vector = 'float64': is no array"],
    ),
    "a skew axis": (
        changed('<attribute id="width" unit="mm">30</attribute>',
                '<attribute id="u_axis_vector" unit="mm"><array><c>1</c><c>1</c><c>0</c></array></attribute>'),
        ["u_axis_vector = .*: is not along the axis of component 3"],
    ),
    "a text for a number": (json_with("floating_point", "125.26 mm"), [f"{ROW} = '125.26 mm': is not"]),
    "true for a number": (json_with("boolean", True), [f"{ROW} = true: is not a number"]),
    "a huge integer": (json_with("integer", 10**400), ["reference_diameter.*: is not a number"]),
    "NaN in JSON": (json_text(b218()).replace(b"125.26", b"NaN"), ["NaN is no number of JSON"]),
    "components that are no list": (b'{"model": {"version": "1.4", "components": 3}}', ["components: is not a list"]),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_it_is_refused_with_its_place(tmp_path: Path, name: str) -> None:
    data, wanted = CASES[name]
    file = tmp_path / "model.rexs"
    file.write_bytes(data)
    with pytest.raises(SceneFileError) as refusal:
        import_model(file)
    for each in wanted:
        refusal.match(each)


def test_all_errors_come_at_once(tmp_path: Path) -> None:
    file = tmp_path / "model.rexs"
    file.write_bytes(changed(">125.26<", ">nan<").replace(b">11.6281<", b">x<").replace(b'"deg">40<', b'"mm">40<'))
    with pytest.raises(SceneFileError, match="3 errors"):
        import_model(file)
