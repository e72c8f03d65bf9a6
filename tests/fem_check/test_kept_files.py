"""Which difference from the commit that was tested is one of records alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from fem_check.running import kept_files
from qsbearing.results import provenance
from tests.fem_check.test_release import commit

PAGE = "Words.\n<!-- table: made by a.py -->\n{}\n<!-- end of table -->\n{}\n"
FIRST = {
    "qsbearing/code.py": "1",
    "fem_check/records/release/patch_test.json": "1",
    "fem_check/records/gate/release/campaign/wild/summary.json": "1",
    "tests/relations.json": "1",
    "tests/systems/spindle.json": "1",
    "qsbearing/reports/evidence.json": "1",
    "README.md": PAGE.format("1", "More words."),
}


def write(root: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")
    commit(root)


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({name: "2" for name in FIRST if "records" in name or name == "tests/relations.json"}, []),
        ({"fem_check/records/release/new.json": "1", "fem_check/records/manifest.json": "2"}, []),
        ({"qsbearing/reports/evidence.json": "2", "README.md": PAGE.format("2\n3", "More words.")}, []),
        ({"README.md": PAGE.format("1", "Other words.")}, ["README.md"]),
        ({"new.md": "words"}, ["new.md"]),
        ({"qsbearing/code.py": "2", "tests/relations.json": "2"}, ["qsbearing/code.py"]),
        ({"tests/systems/spindle.json": "2"}, ["tests/systems/spindle.json"]),
        ({"fem_check/records/release/notes.txt": "2"}, ["fem_check/records/release/notes.txt"]),
    ],
)
def test_only_records_may_follow_the_commit_that_was_tested(
    changed: dict[str, str], named: list[str], tmp_path: Path
) -> None:
    provenance.git("init", "-q", folder=tmp_path)
    write(tmp_path, FIRST)
    tested = provenance.git("rev-parse", "HEAD", folder=tmp_path).strip()
    assert kept_files.others(tested, tmp_path) == []
    write(tmp_path, changed)
    assert kept_files.others(tested, tmp_path) == named


def test_where_a_record_of_the_gate_is_kept() -> None:
    root, records = Path("root"), Path("root/fem_check/records")
    assert kept_files.place_of("release/patch_test.json", root, records) == records / "release/patch_test.json"
    assert kept_files.place_of("repository/tests/relations.json", root, records) == root / "tests/relations.json"
