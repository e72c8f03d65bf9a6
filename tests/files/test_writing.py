"""Temporary files of runs that were killed go with the next run to the same file; those of runs at work stay."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path

import pytest

from qsbearing.cli.files import write_files
from qsbearing.files.output_file import Writer, kept_rows, output_file

pytest.importorskip("fcntl")


def test_what_a_killed_run_left_is_removed(tmp_path: Path) -> None:
    target = tmp_path / "out.csv"
    left, others = tmp_path / ".out.csv.ab12_cde.part", [tmp_path / ".out.csv.kept.part", tmp_path / "out.csv.x.part"]
    for path in (left, *others):
        path.write_text("half")
    with output_file(str(target)) as write:
        assert not left.exists()
        with output_file(str(target)) as other:
            other(b"second")
        write(b"first")  # its own temporary file was not taken for one that was left
    assert target.read_bytes() == b"first"
    assert sorted(tmp_path.iterdir()) == sorted([target, *others])


def test_rows_of_a_run_at_work_are_not_written_over(tmp_path: Path) -> None:
    target = str(tmp_path / "out.csv")
    with kept_rows(target) as (file, part):
        file.write(b"rows")
        file.flush()
        with pytest.raises(OSError, match="another run"), kept_rows(target):
            pass
        assert part.read_bytes() == b"rows"
    assert list(tmp_path.iterdir()) == []


def test_files_of_one_command_are_written_all_or_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As where the disk is full after the HTML of a report, before its PDF."""
    (tmp_path / "a.html").write_text("old")
    fill = Writer.fill

    def full(self: Writer, data: bytes) -> None:
        if data == b"second":
            raise OSError(28, "No space left on device")
        fill(self, data)

    monkeypatch.setattr(Writer, "fill", full)
    with pytest.raises(SystemExit), ExitStack() as stack:
        writers = {name: stack.enter_context(output_file(str(tmp_path / name))) for name in ("a.html", "b.pdf")}
        write_files(writers, {"a.html": lambda: b"first", "b.pdf": lambda: b"second"})
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"a.html": "old"}
