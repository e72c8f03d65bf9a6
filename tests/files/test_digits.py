"""Digits are 0 to 9: what else is one to Python, such as ² and ٢, is neither a number nor a fault."""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import pytest

import qsbearing as qs
from qsbearing.files import file_keys, paths
from qsbearing.files.csv_rows import rows_of_csv
from qsbearing.files.designations import read
from qsbearing.files.fits import names as fit_names
from qsbearing.files.rexs.names import version_of
from qsbearing.model.validation import MOST_DIGITS, whole_number
from qsbearing.studies import keys
from qsbearing.systems.sets.bearing_set import BearingSet
from tests.files.doors import answered, judged
from tests.qsbearing.source_text import trees
from tests.systems.sets.arrangements import PAIR_FILE

ROOT = Path(qs.__file__).parent
OTHERS = [chr(code) for code in range(128, sys.maxunicode) if chr(code).isdigit() or chr(code).isdecimal()]
LONG = "9" * 5000
"""More digits than Python makes an integer of."""


def test_one_helper_tells_digits() -> None:
    found = set()
    for path, tree in trees("isdigit|isdecimal|isnumeric", ROOT):
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) and node.attr in ("isdigit", "isdecimal", "isnumeric"):
                found.add(path.relative_to(ROOT).as_posix())
    assert found == {"model/validation.py"}
    assert [whole_number(text) for text in ("0", "12", "", "-1", "1.0", " 1", "1_0", LONG)] == [0, 12, *[None] * 6]
    assert whole_number("9" * MOST_DIGITS) == 10**MOST_DIGITS - 1


def test_no_other_digit_is_a_number_of_anything() -> None:
    document = {"rows": [{"offset_um": 1.0}, {"offset_um": 2.0}]}
    for other in [*OTHERS, LONG]:
        assert whole_number(other) is None
        assert paths.value_at(document, ("rows", other, "offset_um")) is None
        assert paths.plain(("rows", other, "offset_um")) == f"rows.{other}.offset_um"
        assert paths.key_at(("rows", other, "offset_um")) is None
        assert file_keys.find(f"row {other}.offset_um") is None
        assert keys.find(f"effects.ball_diameter_deviations_um.{other}") is None
        assert keys.find(f"ball_diameter_deviations_um_{other}") is None
    for other in OTHERS:
        assert version_of(f"1.{other}") == ()
        assert read(f"720{other}C") is None or read(f"720{other}C").bore == 0  # type: ignore[union-attr]
        assert f"k{other}" not in fit_names("shaft")
        assert rows_of_csv(f"speed_rpm\n{other}\n", Path("a.csv"), (), None)[1] == [other]


@pytest.mark.parametrize("other", ["²", "٢", "２", "0", "3", "-1", "1.5", LONG])
def test_no_command_takes_it_for_a_row(other: str, tmp_path: Path) -> None:
    file = tmp_path / "pair.toml"
    file.write_text(PAIR_FILE, encoding="utf-8")
    assert isinstance(qs.load_set(file), BearingSet)
    for arguments in (
        ["sweep", file, "--vary", f"rows.{other}.offset_um=0,1", "--out", tmp_path / "out.csv"],
        ["stiffness", file, "--vary", f"rows.{other}.offset_um=0,1", "--out", tmp_path / "out.csv"],
        ["find", file, "--vary", f"rows.{other}.offset_um=0:1", "--minimise", "row_1_axial_load"],
    ):
        answer = answered(list(arguments))
        judged(answer, f"{arguments[0]} {other[:10]}")
        assert answer.code == 2
